"""What is followed from increment to increment: work, energy and dissipation balance where they must, whatever stress was there before;
the largest displacement is one number, whoever tells it"""
import csv
import json
import math
import os
import re

from hard_decks import close, solved
from plugs import first, plug
from support import INPUTS, expected, Test, read_text, write

# Two discs, one on the other, with a joint between: pressure from above, where a case is, is a step of its own
DISCS = """TITLE
Two discs
CONTROL
0,,,2
MATERIALS
1,1.0E4,0.3,1.8
LAWS
1,1.0E4,1.0E4,1.0E4,{law}
{before}BLOCKS
1,1,8,2,2
0,0,1,1
2,1,8,2,2
0,-1,1,0
FACES
1,1,0,1,1,1
2,1,0,0,1,0
3,2,0,0,1,0
4,2,0,-1,1,-1
5,1,1,0,1,1
6,2,1,-1,1,0
INTERFACES
1,2,3
FIXEDFACES
4,111
5,100
6,100
{loads}END
"""
PRESSED = 'PRESSURES\n1,0,50.\n'
# A disc of 9-node elements with the reduced rule, on a smooth floor
REDUCED = """TITLE
Disc
CONTROL
0,,,2
MATERIALS
1,1000,0.3
BLOCKS
1,1,9,{n},{n}
0,0,1,1
FACES
1,1,0,1,1,1
2,1,0,0,1,0
FIXEDFACES
2,010
PRESSURES
1,0,1
END
"""
# Two discs, pressed and then pushed sideways
SHEARED = """TITLE
Pressed, then sheared
CONTROL
2,33
MATERIALS
1,{young},0.2
LAWS
1,{stiffness},{stiffness},{stiffness},0,30
LAWDETAILS
1,COMPONENTS
BLOCKS
1,1,8,8,2
0,-0.5,1,0
2,1,8,8,2
0,0,1,0.5
FACES
1,1,0,0,1,0
2,2,0,0,1,0
3,1,0,-0.5,1,-0.5
4,2,0,0.5,1,0.5
INTERFACES
1,1,2
FIXEDFACES
3,111
CASE
1
RESULTANTS
4,AXIAL,{pressed}
CASE
2
RESULTANTS
4,LATERAL,{pushed},0
COMBINE
1,1,1,2,1
INCREMENTS
1,,,1
1,,,2
END
"""
# Two discs, one drawn over the other against springs above, with a joint that dilates by its angle of friction
LIFTED = """TITLE
Drawn and lifted
CONTROL
1,17
MATERIALS
1,1E9,0
LAWS
1,1000,2000,1000,0,35
LAWDETAILS
1,RESULTANT,,,,35
BLOCKS
1,1,8,2,1
0,-0.5,1,0
2,1,8,2,1
0,0,1,0.5
FACES
1,1,0,-0.5,1,-0.5
2,1,0,0,1,0
3,2,0,0,1,0
4,2,0,0.5,1,0.5
INTERFACES
1,2,3
FIXEDFACES
1,111
4,001,0,,A
4,010,1
SPRINGS
4,500,0,0
CASE
1
RESULTANTS
4,AXIAL,-4
CASE
2
MOVEDFACES
4,1,1,,-1,,,,S
COMBINE
1,1,1,2,1
INCREMENTS
1,1E-9,,1
"""
IN_GROUND = """CASE
1,ground
INSITU
,2.,18.,.5
PRESSURES
1,0,18.
GRAVITY
-10.,
CASE
2,load
PRESSURES
1,0,50.
COMBINE
1,1,1.,2,1.
INCREMENTS
1.,1E-9,,1
0.5,1E-9,,2
0.5,1E-9,,2
"""


# Stress in situ and more than the loads that balance it, in one step or two
AT_ONCE = IN_GROUND[:IN_GROUND.index('CASE\n2')].replace('18.\nGRAVITY', '68.\nGRAVITY') + 'INCREMENTS\n'


def last_increment(program, folder, text):
    """Increments of a deck that converges"""
    summary, _ = solved(program, folder, 'quantities', text)
    return summary['increments']


def energies(program, folder):
    """Loads do the work that is stored: elastic joints and others that stick, in the ground, with a stress before that loads nothing"""
    faults = []
    for law in (',,ELASTIC', '0.,30.'):
        for before, loads in (('', PRESSED + 'INCREMENTS\n0.5,1E-9\n0.5,1E-9\n'), ('', IN_GROUND),
                              ('', AT_ONCE + '1.,1E-9\n'), ('', AT_ONCE + '0.5,1E-9\n0.5,1E-9\n'),
                              ('LAWDETAILS\n1,,,,,,,-1000.\n', PRESSED + 'INCREMENTS\n0.5,1E-9\n0.5,1E-9\n')):
            if before and 'ELASTIC' in law:
                continue
            last = last_increment(program, folder, DISCS.format(law=law, before=before, loads=loads))[-1]
            faults += close(f'{law} {before}{loads[:4]}: energy', last['work'], last['energy'] + last['dissipated'], 1e-9*last['work'])
    return faults


def dissipation(program, folder):
    """Friction takes work and gives none back, be all of it turned in one step"""
    faults = []
    for friction in ('10.0', '30.0'):
        text = first(f'1, 1.0E4, 2.0E4, 1.0E4, 0.0, {friction}', 'INCREMENTS', '1.0,', '-1.0,')
        series = last_increment(program, folder, text)
        faults += [f'phi = {friction}: {now["dissipated"]} after {before["dissipated"]}' for before, now in zip(series, series[1:])
                   if now['dissipated'] < before['dissipated']]
        faults += [] if series[0]['dissipated'] > 0.0 else [f'phi = {friction}: nothing slides']
    return faults


def dissipation_in_units(program, folder):
    """Shear that is rounding before joints slip does not decide what is dissipated, in other units either"""
    found = []
    for unit in (1.0, 3.7):
        text = SHEARED.format(young=1e4*unit, stiffness=1e3*unit, pressed=-unit, pushed=0.5*unit)
        found.append(last_increment(program, folder, text)[-1]['dissipated']/unit)
    return close('dissipated', found[0], found[1], 1e-6*found[0]) + ([] if found[0] > 0.0 else ['nothing slides'])


def lifting(program, folder):
    """Slip that lifts as much as friction resists dissipates nothing: what is done by the load is stored"""
    last = last_increment(program, folder, LIFTED + 10*'4E-4,1E-9,,2\n' + 'END\n')[-1]
    faults = close('energy', last['work'], last['energy'] + last['dissipated'], 1e-4*last['work'])
    return faults + close('dissipated', 0.0, last['dissipated'], 1e-2*last['work'])


def largest_displacement(program, folder):
    """Of many harmonics together: on the screen, in summary and table of a study, and of points that are named the largest"""
    text = read_text(os.path.join(INPUTS, 'first.dat')).replace('\nEND', '\nPOINTS\n1, 0.5, -0.5, 1, rim\nEND')
    ran = program.run('run', write(folder, 'whole.dat', text), '-o', folder)
    faults = ran.ended_with(0)
    told = float(re.search(r'^largest displacement +(\S+)', ran.out, re.MULTILINE).group(1))
    found = json.loads(read_text(os.path.join(folder, 'whole.json')))['increments'][-1]['largest_displacement']
    faults += close('on the screen', found, told, 1e-5*found)
    write(folder, 'rows.csv', 'LAWS 1 PHI\n30.0\n')
    faults += program.run('study', 'rows.csv', 'whole.dat', folder=folder).ended_with(0)
    with open(os.path.join(folder, 'rows.study.csv'), encoding='utf-8') as file:
        row = next(csv.DictReader(file))
    return faults + close('of the study', found, float(row['largest_displacement']), 1e-12*found)


def remarks(program, folder):
    """What the user should know stands on the screen, too"""
    text = read_text(os.path.join(INPUTS, 'first.dat')).replace('\nEND', '\nHARMONICS\n1, 4\nEND')
    ran = program.run('run', write(folder, 'left_out.dat', text), '-o', folder)
    messages = json.loads(read_text(os.path.join(folder, 'left_out.json')))['messages']
    said = re.findall(r'^remark +(.+)$', ran.out, re.MULTILINE)
    faults = [] if any('results may be far off' in line for line in said) else [ran.out]
    return faults + expected('remarks', messages, said)


# Joints that do not yield; joints that slip and a pull that takes the peg out of them
STAYS, SLIPS = (',,,ELASTIC', ''), (',0.05,10.0', '1,AXIAL,-0.5\nINCREMENTS\n0.3\n0.3\n0.4\n')


def softer(program, folder, factor, joints=STAYS):
    """The first deck with other joints, all stiffnesses times a factor: faults, remarks on large displacements, the largest"""
    law, more = joints
    text = read_text(os.path.join(INPUTS, 'first.dat')).replace('    1     2.0E4      0.17', f'1,{2e4*factor:.6E},0.17')
    stiffness = ','.join(f'{factor*value:.6E}' for value in (1e4, 2e4, 1e4))
    text = text.replace('    1     1.0E4     2.0E4     1.0E4       0.0      30.0', f'1,{stiffness}{law}').replace('END\n', f'{more}END\n')
    faults = program.run('run', write(folder, 'soft.dat', text), '-o', folder).ended_with(0 if joints == STAYS else 4)
    summary = json.loads(read_text(os.path.join(folder, 'soft.json')))
    said = [line for line in summary['messages'] if line.startswith('displacements are not small')]
    return faults, said, summary['increments'][-1]['largest_displacement']


def not_small(program, folder):
    """Displacements above a twentieth of diameter or height are named: of bodies far too soft, also where these have no equilibrium
    under the whole load, and of those where they are just above, not where they are just below; the listing cuts no word of that"""
    diameter = 4.0
    faults, _, largest = softer(program, folder, 1.0)
    for factor, joints, wanted in ((1e-3, STAYS, 1), (1e-3, SLIPS, 1), (0.98*largest/(0.05*diameter), STAYS, 1),
                                   (1.02*largest/(0.05*diameter), STAYS, 0), (1.0, STAYS, 0)):
        more, said, found = softer(program, folder, factor, joints)
        faults += more + expected(f'{factor}: remarks', wanted, len(said))
        if said:
            told = re.search(r'up to (\S+), (\S+) % of diameter', said[0])
            faults += close('displacement', found, float(told.group(1)), 1e-5*found)
            faults += close('part', 100*found/diameter, float(told.group(2)), 0.06)
            listing = read_text(os.path.join(folder, 'soft.lis')).replace('\n  ', ' ')
            faults += [] if said[0] in listing else ['the listing cuts a word']
    return faults


def nothing_moves(program, folder):
    """Loads of zero are named; not where a part moves off under any load, and stands where it stood"""
    faults = []
    for load, code, wanted in (('1,LATERAL,0,4', 0, 1), ('1,AXIAL,-0.4', 4, 0), ('1,LATERAL,0.4', 0, 0)):
        text = read_text(os.path.join(INPUTS, 'first.dat')).replace('    1   LATERAL       0.4', load)
        faults += program.run('run', write(folder, 'still.dat', text), '-o', folder).ended_with(code)
        messages = json.loads(read_text(os.path.join(folder, 'still.json')))['messages']
        faults += expected(f'{load}: remarks', wanted, sum(line.startswith('nothing moves') for line in messages))
    return faults


def fading(program, folder):
    """A state of cohesion that is not lost in the end is not given up for rounding far below the tolerance"""
    deck = plug('Fades', [('AXIAL', -0.862305264804), ('MOMENT', 0.84299)], stiffness=(153658.7, 307317.4, 153658.7), friction=35.0,
                cohesion=1.0, young=(2e4, 5e3), poisson=(0.2, 0.3), above=0.6, head=0.5, nodes=4, across=(2, 3), harmonic=3,
                details={'slip': 'RESULTANT', 'opening': 'REVERSIBLE', 'dilation': 32.647})
    ran = program.run('run', write(folder, 'fades.dat', deck.text()), '-o', folder)
    messages = ' '.join(json.loads(read_text(os.path.join(folder, 'fades.json')))['messages'])
    found = re.search(r'a tolerance of (\S+) can be reached', messages)
    return [] if ran.code in (0, 3, 4) and not (found and float(found.group(1)) < 1e-6) else [messages]


def reduced_rule(program, folder):
    """A rule that leaves elements without stiffness is named where that ends the run or spoils it"""
    faults = []
    for n, code in ((4, 3), (1, 4)):
        ran = program.run('run', write(folder, 'reduced.dat', REDUCED.format(n=n)), '-o', folder)
        faults += ran.ended_with(code)
        faults += [] if 'the reduced rule (2 in columns 16-20 of CONTROL)' in ran.out + ran.err else [ran.out + ran.err]
    return faults


def smaller_steps(program, folder):
    """Increments that are halved where joints slip are named, as results depend on the path; others are not"""
    faults = []
    iterations = 30
    for short in (False, True):
        text = read_text(os.path.join(INPUTS, 'first.dat')).replace('LATERAL       0.4', 'LATERAL      10.0')
        text = text.replace('\nEND', f'\nINCREMENTS\n0.01,1E-6\n0.99,1E-6,{iterations}\nEND')
        faults += program.run('run', write(folder, 'steps.dat', text), '-o', folder).ended_with(0)
        summary = json.loads(read_text(os.path.join(folder, 'steps.json')))
        steps = [step['increment'] for step in summary['residuals']]
        named = [re.match(r'increments? ([0-9, ]+) in smaller steps', line).group(1) for line in summary['messages'] if 'smaller' in line]
        faults += expected(f'named of {iterations} iterations', [str(i) for i in (1, 2) if steps.count(i) > 1], named)
        faults += expected(f'smaller steps in {iterations} iterations', short, len(steps) > 2)
        # Two thirds of what the step takes as a whole: too few for it by any rounding, and enough for a part of it
        iterations = 2 * summary['increments'][-1]['iterations'] // 3
    return faults


def infinite_at_the_axis(program, folder):
    """A solid disc that is softer round the circle than along r: displacements go like r^lambda, and nodes on the axis are named with
    lambda - 1 by Lekhnitskii's roots, of the harmonics that are solved; none where all powers are above one"""
    deck = """TITLE
A solid disc with three moduli
CONTROL
{m}
ORTHOTROPIC
1, 1E4, 1E4, {around}
0.0, 0.0, 0.0, {shear}, {shear}, {shear}
BLOCKS
1, 1, 8, 4, 1
0.0, 0.0, 100.0, 5.0
FACES
1, 1, 100.0, 0.0, 100.0, 5.0
2, 1, 0.0, 0.0, 100.0, 0.0
FIXEDFACES
2, 010
PRESSURES
1, {m}, -1.0
END
"""
    faults, along, shear = [], 1e4, 1e3
    for m, around in ((0, 2.5e3), (0, 4e4), (2, 2.5e3), (2, 4e4), (7, 2.5e3)):
        summary, _ = solved(program, folder, 'disc', deck.format(m=m, around=around, shear=shear))
        b = along*shear + m**2*along*around + around*shear
        power = math.sqrt((b - math.sqrt(b**2 - 4*along*around*(shear*(m**2 - 1))**2))/(2*along*shear)) if m else math.sqrt(around/along)
        wanted = [(0.0, 0.0), (0.0, 5.0)] if power < 0.95 else []
        faults += expected(f'places, m = {m}', wanted, [(place['r'], place['z']) for place in summary['singular']])
        faults += [fault for place in summary['singular'] for fault in close(f'exponent, m = {m}', power - 1, place['exponent'], 1e-6)]
    return faults


def tests(program):
    """The tests of this module"""
    return [Test(f'quantities: {function.__name__.replace("_", " ")}', lambda folder, function=function: function(program, folder))
            for function in (energies, dissipation, dissipation_in_units, lifting, largest_displacement, remarks, not_small, nothing_moves, fading,
                             smaller_steps, reduced_rule, infinite_at_the_axis)]
