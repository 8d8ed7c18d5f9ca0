"""One deck gives one result, to the last bit, wherever its arrays lie in memory: with other paths,
environments and numbers of threads, and with every block of memory moved by chance

Of results files a hash is compared where NumPy and h5py are installed (`scripts/setup verify` or
`vtk`), else of the summary.
"""
import glob
import json
import os
import subprocess

from hard_scenes import example
from support import HERE, INPUTS, Test, preload, python_with, read_text, write
from written_alike import PASSING

RUNS = 30
# So many equations that two threads factor the second harmonic together, and more than one range of the fine mesh
TWO_HARMONICS = '''TITLE
A body held below, pushed and pressed above
CONTROL
1
MATERIALS
1, 200.0, 0.3
BLOCKS
1, 1, 8, 25, 32
0.0, 0.0, 3.0, 4.0
FACES
1, 1, 0.0, 0.0, 3.0, 0.0
2, 1, 0.0, 4.0, 3.0, 4.0
FIXEDFACES
1, 111
TRACTIONS
2, 0, 0.0, -1.0
2, 1, 0.5, 0.0, -0.5
END
'''


class Run:
    """A run that differs from others in nothing that counts"""

    def __init__(self, number):
        self.threads = str(1 + number % 2)
        self.output = 'o'*(1 + 13*number % 97) + str(number)
        self.filling = 'x'*(37*number % 271)
        self.inside = number % 3 == 0
        self.absolute = number % 5 < 2

    def go(self, program, folder, deck, *options, **environment):
        """Run a deck; the path of its results without their endings"""
        output = os.path.join(folder, self.output)
        os.mkdir(output)
        place = output if self.inside else folder
        paths = [path if self.absolute else os.path.relpath(path, place) for path in (deck, output)]
        done = subprocess.run([program.path, 'run', paths[0], '-o', paths[1], '--threads', self.threads, *options],
                              cwd=place, env=dict(program.environment, FILLING=self.filling, **environment),
                              capture_output=True, text=True, check=False, timeout=60)
        if done.returncode != 0:
            raise AssertionError(f'exit code {done.returncode}\n{done.stderr}')
        return os.path.join(output, os.path.splitext(os.path.basename(deck))[0])


def lasting(path):
    """What a summary says that does not depend on when and where the job was run"""
    summary = json.loads(read_text(path))
    for found in summary.get('rounds', []):
        found.pop('seconds', None)
    return json.dumps({key: value for key, value in summary.items() if key not in PASSING})


def digests(stems):
    """One text for the results of each run"""
    texts = [' '.join(map(lasting, sorted(glob.glob(stem + '*.json')))) for stem in stems]
    python = python_with('numpy, h5py')
    if python is None:
        return texts
    files = [sorted(glob.glob(stem + '*.h5')) for stem in stems]
    done = subprocess.run([python, '-B', os.path.join(HERE, 'digest.py'), *sum(files, [])],
                          capture_output=True, text=True, check=True)
    lines = iter(done.stdout.split())
    return [' '.join([text, *(next(lines) for _ in part)]) for text, part in zip(texts, files)]


def faults_of(stems):
    """Faults unless all runs have one result"""
    found = digests(stems)
    others = [stem for stem, text in zip(stems, found) if text != found[0]]
    return [f'{len(set(found))} results in {len(stems)} runs, others than {stems[0]}: {", ".join(others)}'] \
        if others else []


def other_circumstances(program, folder):
    """Lengths of the output path, of the environment and of arguments, folder, threads"""
    deck = os.path.join(os.path.realpath(INPUTS), 'first.dat')
    return faults_of([Run(k).go(program, folder, deck) for k in range(RUNS)])


def moved_memory(program, folder, deck, *options):
    """Every block of memory at a place of its own"""
    library = preload('moved_memory')
    stems = [Run(k).go(program, folder, deck, *options, LD_PRELOAD=library, SHUFFLE=str(k))
             for k in range(RUNS//5)]
    return faults_of(stems)


def tests(program):
    """First other circumstances, then moved memory for each solver and several decks"""

    def moved(name, deck, *options):
        def check(folder):
            path = write(folder, 'case.dat', deck) if '\n' in deck else os.path.join(os.path.realpath(INPUTS), deck)
            return moved_memory(program, folder, path, *options)

        return Test(f'same bits: {name}', check)

    fine = example(3, nodes=8, harmonic=6, planes=25)
    history = read_text(os.path.join(INPUTS, 'monopile.dat'))
    without_sections = history[:history.index('SECTIONS')] + 'END\n'
    return [Test('same bits: circumstances', lambda folder: other_circumstances(program, folder))] + [
        moved(f'moved memory, {solver}', fine, '--solver', solver) for solver in ('band', 'skyline', 'sparse')] + [
        moved('moved memory, many harmonics', example(3, harmonic=24, planes=97)),
        moved('moved memory, bonds', example(2, nodes=9, harmonic=4, planes=17)),
        moved('moved memory, Anderson', example(3, factor=10.0, method='ANDERSON', tolerance=1e-6)),
        moved('moved memory, joints out of proportion', example(3, factor=5e-3, harmonic=4, planes=17)),
        moved('moved memory, combinations', 'chimney.dat'),
        # fields are found beside the iterations, with stresses where sections show these, and without
        moved('moved memory, a history', 'monopile.dat'),
        moved('moved memory, a history without sections', without_sections),
        moved('moved memory, two harmonics', TWO_HARMONICS)]
