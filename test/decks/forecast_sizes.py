"""What `estimate` says of the size of the files is what a run writes"""
import os
import re

from hard_scenes import example
from support import INPUTS, Test, read_text, write

SIZES = 0.15  # what is told may be beside the true size by this part of it
MEGABYTE = 2.0**20

# A block of many elements, one harmonic
BLOCK = """TITLE
Block
CONTROL
1
MATERIALS
1, 2E4, 0.2
{mesh}FACES
2, 1, 1.0, 0.0, 2.0, 0.0
3, 1, 1.0, 1.0, 2.0, 1.0
FIXEDFACES
2, 111
RESULTANTS
3, LATERAL, 1.0
{more}END
"""
N = 60
BLOCKS = 'BLOCKS\n1, 1, {nodes}, 60, 60\n1.0, 0.0, 2.0, 1.0\n'
STEPS = 12


def card_by_card():
    """The same mesh by NODES and ELEMENTS, which the results repeat"""
    nodes = ''.join(f'{j*(N + 1) + i + 1}, {1 + i/N:.6f}, {j/N:.6f}\n' for j in range(N + 1) for i in range(N + 1))
    elements = ''.join(f'{j*N + i + 1}, 1, 1, {a}, {a + 1}, {a + N + 2}, {a + N + 1}\n'
                       for j in range(N) for i in range(N) for a in [j*(N + 1) + i + 1])
    return f'NODES\n{nodes}ELEMENTS\n{elements}'


def history(lines):
    """The monopile in many increments, with other cards in place of its own ones of cuts and sections"""
    text = read_text(os.path.join(INPUTS, 'monopile.dat'))
    text = re.sub(r'(?ms)^(CUTS|SECTIONS)\b.*?(?=^[A-Z])', '', text)
    start, end = text.index('INCREMENTS'), text.index('POINTS')
    steps = ''.join(f'{factor}, 1E-8, , 2\n' for factor in (0.1, 0.1, -0.1)*(STEPS//3))
    return text[:start] + 'INCREMENTS\n1.0, 1E-8, , 1\n' + steps + text[end:].replace('END\n', lines + 'END\n')


def decks():
    """Name, deck, options"""
    yield 'linear', BLOCK.format(mesh=BLOCKS.format(nodes=4), more=''), ()
    yield 'eight nodes', BLOCK.format(mesh=BLOCKS.format(nodes=8), more=''), ()
    yield 'without estimates', BLOCK.format(mesh=BLOCKS.format(nodes=4), more=''), ('--no-estimates',)
    yield 'all rows', BLOCK.format(mesh=BLOCKS.format(nodes=4), more='PRINT\n TABLES, ALL\n'), ()
    yield 'cards', BLOCK.format(mesh=card_by_card(), more=''), ()
    yield 'joints', example(3, refined=2, harmonic=4, planes=17), ()
    yield 'history', history(''), ()
    yield 'kept stresses', history('KEEP\n STRESSES, ALL\n'), ()
    yield 'sections', history('SECTIONS\n1, 3.0, 0.0, 30.0, 0.0, 3000, 0.0, 90.0, 180.0\n'), ()
    yield 'cuts', history('CUTS\n1, -20.0, 1, 5.0, 4000\n'), ()
    yield 'combinations', read_text(os.path.join(INPUTS, 'chimney.dat')), ()
    yield 'yielding', read_text(os.path.join(INPUTS, 'pile_clay.dat')), ()
    yield 'pictures', read_text(os.path.join(INPUTS, 'monopile.dat')), ('--vtk',)


def told_and_true(program, folder, name, text, options):
    """Bytes that `estimate` tells and that a run writes"""
    deck = write(folder, 'job.dat', text)
    place = os.path.join(folder, 'out')
    told = float(re.search(r'^disk +(\S+)', program.run('estimate', deck, '--counts', *options).out, re.MULTILINE)[1])
    ran = program.run('run', deck, '-o', place, '--quiet', *options)
    if ran.code not in (0, 3):
        raise AssertionError(f'{name}: exit code {ran.code}\n{ran.err}')
    return told*MEGABYTE, sum(os.path.getsize(os.path.join(place, file)) for file in os.listdir(place))


def tests(program):
    """A test for each deck"""
    def made(name, text, options):
        def check(folder):
            told, true = told_and_true(program, folder, name, text, options)
            return [] if abs(told - true) <= SIZES*true else [f'told {told:.0f} bytes, written {true}']
        return Test(f'forecast of sizes: {name}', check)

    return [made(*deck) for deck in decks()]
