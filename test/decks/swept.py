"""Bodies swept through theta: their files, and, where VTK, NumPy and h5py are installed
(`scripts/setup vtk`), what VTK reads in them"""
import os
import resource
import subprocess

from support import HERE, INPUTS, EarlierResults, Test, expected, python_with, read_text, write

VTK = 'numpy, h5py, vtkmodules.vtkIOHDF'
GOOD = os.path.join(HERE, 'good')
# Decks whose swept bodies are checked point by point: all kinds of elements, both families
# of modes, two materials, curved sides
WHOLE = ('bending_6', 'bending_8', 'bending_9', 'bending_mixed', 'tension_mixed_quadratic',
         'joint_triangles', 'curved_bodies', 'shear_4', 'thermal_gradient', 'ring_loads')
# A body that touches the axis in a corner: pyramids; and one of three-node elements, two of
# which have a corner, and one an edge, on the axis
CORNERS = """TITLE
Bodies that touch the axis in corners
CONTROL
3
MATERIALS
1, 1.0, 0.3
2, 2.0, 0.2
NODES
1, 0.0, 0.5
2, 0.5, 0.2
3, 1.0, 0.5
4, 0.5, 0.9
11, 0.0, 2.0
12, 1.0, 2.0
13, 1.0, 3.0
14, 0.0, 3.0
15, 0.5, 2.4
ELEMENTS
1, 1, 1, 1, 2, 3, 4
2, 2, 2, 11, 12, 15
3, 2, 2, 12, 13, 15
4, 1, 2, 13, 14, 15
5, 2, 2, 14, 11, 15
RESTRAINTS
2, 111
3, 111
12, 111
13, 111
RINGLOADS
4, 0, 0, 1.0, 0
4, 2, 0.3, 0, 0.2
4, 3, 1.0, 0, 0, A
15, 1, 1.0, 0.5, 0, A
15, 0, 0, 0, 1.0, A
END
"""
# A disc on a joint that opens and slips step by step
STEPS = """TITLE
Disc pressed, pushed aside, and drawn back
CONTROL
3
MATERIALS
1, 2.0E4, 0.2
LAWS
1, 1.0E4, 2.0E4, 1.0E4, 0.0, 20.0
LAWDETAILS
1, RESULTANT
BLOCKS
1, 1, 8, 3, 2
0, 0, 1, 0.5
2, 1, 8, 3, 2
0, -1, 1, 0
FACES
1, 2, 0, -1, 1, -1
2, 2, 0, 0, 1, 0
3, 1, 0, 0, 1, 0
4, 1, 0, 0.5, 1, 0.5
INTERFACES
1, 2, 3
FIXEDFACES
1, 111
CASE
1, Weight
TRACTIONS
4, 0, 0, -10.0
CASE
2, Push
RESULTANTS
4, LATERAL, 8.0
4, MOMENT, 12.0, {direction}
COMBINE
1, 1, 1.0, 2, 1.0
INCREMENTS
{increments}END
"""
INCREMENTS = ('1.0, 1E-9, 500, 1\n', '0.5, 1E-9, 500, 2\n', '0.4, 1E-9, 500, 2\n', '-0.7, 1E-9, 500, 2\n')


def looked_at(check, folder, name):
    """Faults that VTK finds in the files of a run"""
    done = subprocess.run([python_with(VTK), '-B', '-W', 'ignore', os.path.join(HERE, 'read_swept.py'), check,
                           os.path.join(folder, name)], capture_output=True, text=True, check=False)
    return [f'{done.stdout}{done.stderr}'] if done.returncode else []


def run(program, folder, deck, *options):
    """Faults of a run"""
    return program.run('run', deck, '-o', folder, *options).ended_with(0)


def whole_circle(program, folder, name):
    """A deck without SWEEP, by --vtk"""
    return (run(program, folder, os.path.join(GOOD, name + '.dat'), '--vtk')
            or looked_at('whole', folder, name))


def case_3(program, folder):
    """The paper's case 3"""
    return (run(program, folder, os.path.join(INPUTS, 'case3.dat'), '--vtk')
            or looked_at('case_3', folder, 'case3'))


def corners(program, folder):
    """Elements with a corner on the axis; SWEEP without a card is the whole circle"""
    deck = write(folder, 'corners.dat', CORNERS.replace('END\n', 'SWEEP\nEND\n'))
    return run(program, folder, deck) or looked_at('whole', folder, 'corners')


def part(program, folder):
    """A part of the circle"""
    text = read_text(os.path.join(INPUTS, 'case3.dat'))
    deck = write(folder, 'part.dat', text.replace('\nEND', '\nSWEEP\n-30.0, 100.0, 13\nEND'))
    return run(program, folder, deck) or looked_at('part', folder, 'part')


def combinations(program, folder):
    """Files of each combination"""
    text = read_text(os.path.join(GOOD, 'cases.dat')).replace('COMBINE\n', 'COMBINE\n    3    1       1.0\n')
    deck = write(folder, 'two.dat', text)
    faults = run(program, folder, deck, '--vtk')
    for name in ('two.3', 'two.12'):
        faults = faults or looked_at('whole', folder, name)
    return faults


def steps(program, folder, direction):
    """Increments as time steps, against runs that end with each of them"""
    faults = []
    for n in (0, 1, 2, 3, 4):
        name = f'steps-{n}' if n else 'steps'
        text = STEPS.format(increments=''.join(INCREMENTS[:n or 4]), direction=direction)
        faults = faults or run(program, folder, write(folder, name + '.dat', text), '--vtk')
    return faults or looked_at('steps', folder, 'steps')


def linear_steps(program, folder):
    """Increments of a linear job, whose joint is elastic"""
    deck = os.path.join(GOOD, 'increments.dat')
    return run(program, folder, deck, '--vtk') or looked_at('elastic_joints', folder, 'increments')


def names(program, folder):
    """The files appear if they are asked for only, and the terminal and the listing name them"""
    deck = os.path.join(INPUTS, 'first.dat')
    ran = program.run('run', deck, '-o', folder)
    faults = ran.ended_with(0) + expected('files', ['first.h5', 'first.json', 'first.lis'],
                                          sorted(os.listdir(folder)))
    ran = program.run('run', deck, '-o', folder, '--vtk')
    faults += ran.ended_with(0) + expected(
        'files', ['first.h5', 'first.joints.vtkhdf', 'first.json', 'first.lis', 'first.vtkhdf'],
        sorted(os.listdir(folder)))
    listing = read_text(os.path.join(folder, 'first.lis'))
    for text, word in ((ran.out, '.lis .json .h5 .vtkhdf .joints.vtkhdf'),
                       (listing, '\nfirst.vtkhdf '), (listing, '\nfirst.joints.vtkhdf ')):
        if word not in text:
            faults.append(f'expected {word!r}, found\n{text[-2000:]}')
    return faults


def file_size_limit(program, folder):
    """Each file in turn meets a limit on file sizes; earlier results stay"""
    faults = []
    earlier = EarlierResults(os.path.join(folder, 'results'), 'first')
    for size in (4096, 100000, 150000, 200000, 250000, 300000, 400000):
        ran = program.run('run', os.path.join(INPUTS, 'first.dat'), '--vtk', '-o', earlier.folder,
                          limits=[(resource.RLIMIT_FSIZE, size)])
        if ran.code == 0:
            return faults + [f'the limit {size} is too wide for this test']
        faults += [f'limit {size}: {fault}' for fault in ran.ended_with(5) + earlier.faults()]
    return faults


def occupied(program, folder):
    """A final name that is no file is refused before anything is solved"""
    faults = []
    for ending in ('vtkhdf', 'joints.vtkhdf'):
        place = os.path.join(folder, ending)
        os.makedirs(os.path.join(place, f'first.{ending}'))
        ran = program.run('run', os.path.join(INPUTS, 'first.dat'), '--vtk', '-o', place)
        faults += ran.ended_with(5)
        if f'first.{ending} is a directory' not in ran.err:
            faults.append(f'found {ran.err}')
    return faults


def tests(program):
    """One test a deck"""
    found = [Test('swept/names', lambda folder: names(program, folder)),
             Test('swept/file size limit', lambda folder: file_size_limit(program, folder)),
             Test('swept/occupied', lambda folder: occupied(program, folder))]
    if not python_with(VTK):
        return found
    found += [Test(f'swept/{name}', lambda folder, name=name: whole_circle(program, folder, name))
              for name in WHOLE]
    return found + [Test('swept/case 3', lambda folder: case_3(program, folder)),
                    Test('swept/corners', lambda folder: corners(program, folder)),
                    Test('swept/part', lambda folder: part(program, folder)),
                    Test('swept/combinations', lambda folder: combinations(program, folder)),
                    Test('swept/steps, symmetric', lambda folder: steps(program, folder, 0.0)),
                    Test('swept/steps, both families', lambda folder: steps(program, folder, 40.0)),
                    Test('swept/linear steps', lambda folder: linear_steps(program, folder))]
