"""What a run says does not hang on where the load stands, on the unit of length, on what a folder held before, or on the order of
bodies: findings that did"""
import json
import os
import re

import hard_scenes as scenes
from support import INPUTS, Test, expected, read_text, write

# A ring under pressure that goes round it in 36 waves, of one family or the other, or turned by a part of a wave
WAVES = """CONTROL
36
MATERIALS
1,1000,0.3
BLOCKS
1,1,8,4,2
1,0,1.2,0.1
FACES
1,1,1,0,1,0.1
HARMONICS
36
PRESSURES
{loads}END
"""
# A disc under pressure of two cases
DISC = """CONTROL
0
MATERIALS
1,1000,0.2
BLOCKS
1,1,4,2,2
0,0,1,1
FACES
1,1,0,0,1,0
2,1,0,1,1,1
FIXEDFACES
1,111
CASE
1
PRESSURES
2,0,1
CASE
2
PRESSURES
2,0,2
{combine}END
"""
# A cylinder in a hole of a block, pressed, then pushed and twisted; faces 2 and 3 meet
PLUG = """CONTROL
1
MATERIALS
1,2E4,0.2
2,5E3,0.3
LAWS
1,2000,2000,2000,0,20
LAWDETAILS
1,RESULTANT,,,,,{gap},{initial}
BLOCKS
1,1,8,2,4
0,0,0.5,1
2,2,8,3,4
0.5,0,2,1
FACES
1,1,0,1,0.5,1
2,1,0.5,0,0.5,1
3,2,0.5,0,0.5,1
4,2,2,0,2,1
INTERFACES
1,2,3
FIXEDFACES
4,111
{loads}END
"""
DIGITS = 1e-8


def stub(size):
    """A pile in ground: middles of its joints lie at a tenth of the length of shaft and toe from its edge, where stress is infinite"""
    deck = scenes.Deck('Stub', 1, None).material(1, 2e4, 0.2).material(2, 50.0, 0.3).law(1, [2000.0/size]*3, 0.0, 25.0)
    deck.details(1, slip='RESULTANT')
    shaft, toe, ground = (0.5, -2.0, 0.5, 0.0), (0.0, -2.0, 0.5, -2.0), [(0.5, -2.0, 4.0, 0.0), (0.0, -4.0, 0.5, -2.0), (0.5, -4.0, 4.0, -2.0)]

    def scaled(place):
        return [size*x for x in place]

    deck.block(1, 1, 8, 2, 4, *scaled((0.0, -2.0, 0.5, 0.0)))
    for (across, along), place in zip(((4, 4), (2, 2), (4, 2)), ground):
        deck.block(2, 2, 8, across, along, *scaled(place))
    deck.faces(*((number, body, *scaled(place)) for number, body, place in
                 ((1, 1, shaft), (2, 2, shaft), (3, 1, toe), (4, 2, toe), (5, 1, (0.0, 0.0, 0.5, 0.0)), (6, 2, (0.0, -4.0, 4.0, -4.0)),
                  (7, 2, (4.0, -4.0, 4.0, 0.0)))))
    deck.add('INTERFACES', (1, 1, 2), (1, 3, 4)).add('FIXEDFACES', (6, '111'), (7, '101'))
    return deck.resultants((5, 'LATERAL', size**2), (5, 'AXIAL', -5.0*size**2)).text()


def summary_of(program, folder, name, text, code=0):
    """Summary of a deck, which ends with an exit code"""
    ran = program.run('run', write(folder, f'{name}.dat', text), '-o', folder)
    if ran.ended_with(code):
        raise AssertionError(f'{name}: exit code {ran.code}: {ran.err}')
    return json.loads(read_text(os.path.join(folder, f'{name}.json')))


def same(name, wanted, found):
    """Faults: a figure that is another one"""
    return [] if abs(found - wanted) <= DIGITS*abs(wanted) else [f'{name}: expected {wanted}, found {found}']


def elastic_joints(program, folder):
    """Elastic joints under a lateral load, wherever it points and whatever angles are printed"""
    faults, first = [], None
    text = read_text(os.path.join(INPUTS, 'first.dat'))
    laws = re.search(r'LAWS[^\n]*\n([^\n]*)\n', text).group(1)
    text = text.replace(laws, '1,1E4,2E4,1E4,,,ELASTIC')
    for angle, output in ((0, ''), (45, ''), (270, ''), (0, 'OUTPUT\n90\n'), (37, 'OUTPUT\n10\n')):
        deck = text.replace('    1   LATERAL       0.4', f'1,LATERAL,0.4,{angle}').replace('\nEND', f'\n{output}END')
        summary = summary_of(program, folder, 'turned', deck)
        found = [summary['increments'][-1][key] for key in ('largest_displacement', 'largest_pressure', 'largest_shear')]
        found += [summary['errors']['sum'][key] for key in ('displacement', 'joint_stress')]
        first = first or found
        for k, (a, b) in enumerate(zip(first, found)):
            faults += same(f'{angle} degrees, {output.split()[-1:]}: figure {k + 1}', a, b)
    return faults


def short_waves(program, folder):
    """The largest displacement of waves of ten degrees, wherever their crests are"""
    faults, first = [], None
    for loads in ('1,36,1\n', '1,36,1,,A\n', '1,36,0.6\n1,36,0.8,,A\n'):
        found = summary_of(program, folder, 'waves', WAVES.format(loads=loads))['increments'][-1]['largest_displacement']
        first = first or found
        faults += same(loads.strip(), first, found)
    return faults


def last_residual(program, folder):
    """The residual of the last increment is that of its last equilibrium, not of the step beyond"""
    loads = 'CASE\n1\nRESULTANTS\n1,AXIAL,1\n1,TORQUE,0.1\nCOMBINE\n1,1,1\nINCREMENTS\n0.5\n1.5\n'
    summary = summary_of(program, folder, 'beyond', PLUG.format(gap='', initial=-1, loads=loads), code=4)
    last = summary['increments'][-1]
    return [] if 0.5 < last['load_factor'] < 2 and last['residual'] <= 1e-6 else [str(last)]


def unit_of_length(program, folder):
    """Points at the distance from which on stress is judged are judged in all units"""
    faults, first = [], None
    for size in (1.0, 1e-3, 0.3, 1e3):
        found = summary_of(program, folder, 'unit', stub(size))['errors']['discretization']['joint_stress']
        first = first or found
        faults += [] if abs(found - first) <= 1e-5*first else [f'size {size}: expected {first}, found {found}']
    return faults


def point_on_two_bodies(program, folder):
    """A point of bodies that move apart is named, and is of the lowest whatever their order; none of bodies that share their nodes"""
    faults = []
    deck = PLUG.format(gap='', initial='', loads='RESULTANTS\n1,LATERAL,0.4\nPOINTS\n1,0.5,0.5\n')
    body_1, body_2 = '1,1,8,2,4\n0,0,0.5,1\n', '2,2,8,3,4\n0.5,0,2,1\n'
    bonded = deck.replace('1,2,3\nFIXED', ',2,3,BONDED\nFIXED')
    for name, text, warned in (('named', deck, 1), ('turned', deck.replace(body_1 + body_2, body_2 + body_1), 1), ('bonded', bonded, 0),
                               ('given', deck.replace('1,0.5,0.5\n', '1,0.5,0.5,2\n'), 0)):
        ran = program.run('run', write(folder, f'{name}.dat', text), '-o', folder)
        faults += ran.ended_with(0)
        faults += expected(f'{name}: warnings', warned, ran.err.count('point 1 lies on bodies 1 and 2, which move apart: it follows body 1'))
    return faults


def other_results(program, folder):
    """Results of combinations that the deck has no longer are named, once"""
    faults = []
    combine = ['1,1,1\n', '2,2,1\n', '3,1,1,2,1\n']
    for n, wanted in ((3, None), (2, 'disc.3.h5 beside the results is not of this run: the deck has no such combination'),
                      (0, 'disc.1.h5 and 2 more beside the results are not of this run: the deck has no such combinations')):
        text = DISC.format(combine='COMBINE\n' + ''.join(combine[:n])) if n else DISC.format(combine='').replace('CASE\n2\nPRESSURES\n2,0,2\n', '')
        ran = program.run('run', write(folder, 'disc.dat', text), '-o', folder, '--quiet')
        faults += ran.ended_with(0)
        faults += expected(f'{n} combinations: warnings', 1 if wanted else 0, ran.err.count('beside the results'))
        faults += [] if not wanted or wanted in ran.err else [ran.err]
    return faults


def turning_slip(program, folder):
    """Where torque slides joints that other loads slide, too, a remark says that the way there counts, and errors are at least so large"""
    faults = []
    for torque, wanted in ((0.0, 0), (0.25, 1)):
        loads = f'CASE\n1\nRESULTANTS\n1,AXIAL,-1\n1,TORQUE,{torque}\nCOMBINE\n1,1,1\n'
        summary = summary_of(program, folder, 'turning', PLUG.format(gap='', initial=-1, loads=loads))
        faults += expected(f'torque {torque}: remarks', wanted, sum(line.startswith('slip of joints turns') for line in summary['messages']))
    return faults


def motion_of_a_mechanism(program, folder):
    """A disc that is overturned tilts, and one that slides slides, wherever the load points"""
    faults = []
    for name, text, word in (('overturned', scenes.overturn(1.01), 'tilts'), ('slid', scenes.slide(1.01, scenes.RESULTANT), 'slides sideways')):
        for angle in (0, 30, 45, 90, 200):
            turned = re.sub(r'^(2, (?:LATERAL|MOMENT), \S+)$', rf'\1, {angle}', text, flags=re.MULTILINE)
            messages = ' '.join(summary_of(program, folder, name, turned, code=4)['messages'])
            found = re.search(r'the part with node \d+ ([a-z ]+) \(harmonic (\d+)', messages)
            faults += expected(f'{name} at {angle} degrees', (word, '1'), found and found.groups())
    return faults


def tests(program):
    """The tests of this module"""
    return [Test(f'turned: {function.__name__.replace("_", " ")}', lambda folder, function=function: function(program, folder))
            for function in (elastic_joints, short_waves, last_residual, unit_of_length, point_on_two_bodies, other_results, turning_slip,
                             motion_of_a_mechanism)]
