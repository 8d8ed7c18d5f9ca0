"""Estimates of the errors of stresses along sections: beside exact solutions and finer runs; which points are judged, and where nothing
is known"""
import os

from estimated_cuts import PILE, TUBE
from hard_decks import close, solved
from support import Test, expected, read_text, write

# A ring in plane strain under outer pressure like cos m theta
RING = """TITLE
Ring
CONTROL
{m}
HARMONICS
{m},
MATERIALS
1,3E4,0.3
BLOCKS
1,1,{kind},{n},1
1,0,2,0.1
FACES
1,1,2,0,2,0.1
2,1,1,0,2,0
3,1,1,0.1,2,0.1
FIXEDFACES
2,010
3,010
PRESSURES
1,{m},1
SECTIONS
1,1,0.05,2,0.05,21
{more}END
"""


def stresses(folder, name, number=1):
    """Stresses along a section of a run, by its listing: (angle, point, body, material) -> r and six of them"""
    found, title = {}, None
    for line in read_text(os.path.join(folder, f'{name}.lis')).split('\n'):
        fields = line.split()
        if line.startswith(f'STRESSES ON SECTION {number},'):
            title = line
        elif title and len(fields) == 11 and fields[0].isdigit():
            found[title, fields[0], fields[3], fields[4]] = [float(field) for field in (fields[1], *fields[5:])]
        elif title and not fields:
            title = None
    return found


def largest(one, other):
    """Largest difference of two sets of stresses, where both have them"""
    return max(abs(a - b) for key in one.keys() & other.keys() for a, b in zip(one[key][1:], other[key][1:], strict=True))


def told(summary, number=1):
    """What the summary says of a section"""
    return next(section for section in summary['section_errors'] if section['section'] == number)


def lame(program, folder):
    """A ring that is pressed all round: the exact stresses"""
    faults = []
    for kind, n, band in ((4, 4, (0.5, 1.5)), (4, 12, (0.6, 1.4)), (8, 3, (0.5, 1.5)), (8, 6, (0.5, 1.4)), (9, 4, (0.5, 1.5)), (6, 3, (0.4, 1.5))):
        summary, _ = solved(program, folder, 'lame', RING.format(m=0, kind=kind, n=n, more=''))
        exact = {key: (r, -4/3 + 4/3/r**2, row[1], -4/3 - 4/3/r**2, 0, 0, 0)
                 for key, (r, *row) in stresses(folder, 'lame').items()}
        true = largest(stresses(folder, 'lame'), exact)
        error = told(summary)['error']
        faults += [] if band[0] < true/error < band[1] else [f'{kind}-node, {n}: true {true:.3e}, told {error:.3e}']
        faults += close('stress', 8/3, told(summary)['stress'], true + 1e-6)
    return faults


def waves(program, folder):
    """The same in waves round the circle, beside a fine mesh; angles at which it is listed do not count"""
    faults = []
    for m in (2, 5):
        solved(program, folder, 'fine', RING.format(m=m, kind=9, n=40, more=''))
        for kind, n in ((4, 6), (8, 4), (9, 3)):
            summary, _ = solved(program, folder, 'ring', RING.format(m=m, kind=kind, n=n, more=''))
            true = largest(stresses(folder, 'ring'), stresses(folder, 'fine'))
            ratio = true/told(summary)['error']
            faults += [] if 0.4 < ratio < 1.6 else [f'm = {m}, {kind}-node: true {true:.3e}, told {told(summary)["error"]:.3e}']
            more = 'OUTPUT\n12,34\n'
            other = solved(program, folder, 'ring', RING.format(m=m, kind=kind, n=n, more=more))[0]
            faults += close('at other angles', told(summary)['error'], told(other)['error'], 1e-9)
    return faults


def pile(program, folder):
    """Joints that open and slip: mesh and harmonics, both not too small; the same at another angle"""
    faults = []
    line = 'SECTIONS\n1,0.25,-0.3,0.25,0.9,13\n2,0,0.55,1.8,0.55,13\nOUTPUT\n{}\n'
    angles = ','.join(str(22.5*k) for k in range(8)) + '\n180'
    deck = PILE.replace('RESULTANTS', line + 'RESULTANTS')

    def run(name, n, control, angle=0):
        return solved(program, folder, name, deck.replace('{}', angles).format(
            control=control, law=',0,30,PAPER', n=n, n2=2*n, angle=angle, more=''))[0]

    summary = run('pile', 3, '4,33,,,,,NEWTON')
    run('discretization', 10, '4,33,,,,,NEWTON')
    run('harmonics', 3, '16,65,,,,,NEWTON')
    for source in ('discretization', 'harmonics'):
        for number in (1, 2):
            error = told(summary, number)[source]
            true = largest(stresses(folder, 'pile', number), stresses(folder, source, number))
            faults += [] if 0.2 < true/error < 2.0 else [f'{source}, section {number}: true {true:.3e}, told {error:.3e}']
    found = summary['errors']
    shares = [found[source]['sections'] for source in ('discretization', 'harmonics', 'planes', 'iteration', 'solver')]
    faults += close('sum', sum(shares), found['sum']['sections'], 1e-9*sum(shares))
    faults += expected('in words', True, 'stress on SECTIONS ' in found['in_words'])
    # loads at angles of planes: lines are the same
    turned = run('turned', 3, '4,33,,,,,NEWTON', angle=45)
    for number in (1, 2):
        one, other = told(summary, number), told(turned, number)
        faults += close(f'turned, section {number}: stress', one['stress'], other['stress'], 1e-5*one['stress'])
        faults += close(f'turned, section {number}: error', one['error'], other['error'], 0.02*one['error'])
    return faults


def judged(program, folder):
    """Points in an element at a corner are not judged; a section all of such points has no error; a target is met"""
    deck = TUBE.format(n=2, n2=4, held='', upper=1, pushed=3, bonds='')
    lines = 'SECTIONS\n1,0.5,0,0.5,2.5,11\n2,0.5,0.1,1,0.1,5\n3,0.5,1.1,1,1.1,5\n'
    summary, _ = solved(program, folder, 'tube', deck.replace('CUTS', lines + 'CUTS') + 'END\n')
    found = [told(summary, number) for number in (1, 2, 3)]
    faults = expected('judged', [9, 0, 5], [section['judged'] for section in found])
    faults += expected('no error', [True, False, True], [section['error'] is not None for section in found])
    faults += expected('in words', True, '(14 of 21 points, away from infinite ones)' in summary['errors']['in_words'])
    goal = deck.replace('CUTS', 'SECTIONS\n3,0.5,1.1,1,1.1,5\nCUTS') + 'ERROR\n2,SECTIONS\nEND\n'
    summary, _ = solved(program, folder, 'goal', goal)
    faults += expected('target', [], [line for line in summary['messages'] if 'not met' in line])
    fine = TUBE.format(n=12, n2=24, held='', upper=1, pushed=3, bonds='').replace('CUTS', 'SECTIONS\n3,0.5,1.1,1,1.1,5\nCUTS') + 'END\n'
    solved(program, folder, 'fine', fine)
    true = largest(stresses(folder, 'goal', 3), stresses(folder, 'fine', 3))
    return faults + expected('met', True, true < 0.02*told(summary, 3)['stress'])


def unknown(program, folder):
    """Mean stress that swings from point to point; a target of sections needs some"""
    deck = RING.format(m=2, kind=8, n=3, more='').replace('CONTROL\n2\n', 'CONTROL\n2,,,2\n').replace(',0.3\n', ',0.499\n')
    summary, _ = solved(program, folder, 'swings', deck)
    faults = expected('reduced rule', None, told(summary)['error'])
    faults += expected('in the budget', None, summary['errors']['discretization']['sections'])
    deck = RING.format(m=2, kind=8, n=3, more='ERROR\n1,SECTIONS\n').replace('SECTIONS\n1,1,0.05,2,0.05,21\n', '', 1)
    ran = program.run('check', write(folder, 'none.dat', deck), folder=folder)
    return faults + ran.ended_with(2) + expected('message', True, 'there is no line' in ran.out + ran.err)


def tests(program):
    """The tests of this module"""
    named = {'exact': lame, 'waves': waves, 'pile': pile, 'judged': judged, 'unknown': unknown}
    return [Test(f'estimated sections: {what}', lambda folder, check=check: check(program, folder)) for what, check in named.items()]
