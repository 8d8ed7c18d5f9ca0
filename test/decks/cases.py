"""Load cases add up, and a load turned about the axis turns its results"""
import json
import math
import os

import listing
from messages import expected_messages, message_faults
from support import Test, expected, input_deck, read_text, write

RING = """TITLE
Ring under two load cases
CONTROL
6
MATERIALS
1, 1.0, 0.3, 2.0, 1E-3
BLOCKS
1, 1, 8, 3, 3
1, 0, 2, 1
FACES
1, 1, 1, 0, 2, 0
2, 1, 1, 1, 2, 1
3, 1, 2, 0, 2, 1
SPRINGS
1, 5.0, 3.0, 3.0
SHAPES
1, PATCH, {patch}
OUTPUT
{output}
"""
LOADS = """CASE
4, A patch of pressure
PRESSURES
3, , 0.3, , , 1
CASE
2, Turned and warmed
GRAVITY
-1.0, 0.5, {turned}
RESULTANTS
2, TORQUE, 0.7
2, MOMENT, 0.4, {turned}
"""
# Digits of the listing
LISTED = 2e-7


def run(program, folder, name, deck):
    """Run a deck, and the tables of each of its listings by file name"""
    ran = program.run('run', write(folder, f'{name}.dat', deck), '-o', folder)
    if ran.code != 0:
        raise AssertionError(f'exit code {ran.code}\n{ran.err}')
    return {file: listing.tables(read_text(os.path.join(folder, file)))
            for file in os.listdir(folder) if file.startswith(name) and file.endswith('.lis')}


def difference(wanted, found):
    """Largest difference of displacements, over the largest displacement"""
    size = max(abs(value) for row in wanted for value in row)
    return max(abs(a - b) for one, two in zip(wanted, found) for a, b in zip(one, two)) / size


def components(rows):
    return [(row['u'], row['v'], row['w']) for row in rows]


def combinations_add_up(program, folder):
    """Each combination has its files, and is the sum of its load cases"""
    deck = RING.format(patch='-20, 50', output='0, 70') + LOADS.format(turned=30)
    alone = run(program, folder, 'alone', deck + 'END\n')
    faults = expected('files', ['alone.2.lis', 'alone.4.lis'], sorted(alone))
    together = run(program, folder, 'sum', deck + 'COMBINE\n7, 4, 2.0, 2, -3.0\n8, 2, 0.5\nEND\n')
    faults += expected('files', ['sum.7.lis', 'sum.8.lis'], sorted(together))
    for theta in ('theta = 0', 'theta = 70'):
        first, second = (components(alone[f'alone.{k}.lis'][theta]) for k in (4, 2))
        wanted = [[2*a - 3*b for a, b in zip(*rows)] for rows in zip(first, second)]
        error = difference(wanted, components(together['sum.7.lis'][theta]))
        if not error <= LISTED:
            faults.append(f'{theta}: the combination differs from the sum by {error:.1E}')
    summary = json.loads(read_text(os.path.join(folder, 'sum.8.json')))
    return faults + expected('combination', 8, summary['combination'])


def turned_load(program, folder):
    """Shape and directions turned by 50 degrees: at angles turned by as much nothing changes"""
    one = LOADS.format(turned=0) + 'COMBINE\n1, 4, 1.0, 2, 1.0\nEND\n'
    two = LOADS.format(turned=50) + 'COMBINE\n1, 4, 1.0, 2, 1.0\nEND\n'
    here = run(program, folder, 'here', RING.format(patch='-20, 30', output='0, 90, 200') + one)
    there = run(program, folder, 'there', RING.format(patch='30, 80', output='50, 140, 250') + two)
    faults = []
    for angle in (0, 90, 200):
        error = difference(components(here['here.lis'][f'theta = {angle}']),
                           components(there['there.lis'][f'theta = {angle + 50}']))
        if not error <= LISTED:
            faults.append(f'theta = {angle}: the turned results differ by {error:.1E}')
    return faults


def not_combined(program, folder):
    """Increments of load cases that no combination puts together"""
    deck = RING.format(patch='-20, 30', output='0') + LOADS.format(turned=0) + 'INCREMENTS\n1, , , 4\n1, , , 2\n'
    wanted = expected_messages(f'! warns: {deck.count(chr(10)) - 1}: warning: INCREMENTS names load cases, and no '
                               'COMBINE puts them together', 'warns')
    return message_faults(wanted, program.run('check', write(folder, 'job.dat', deck + 'END\n')))[0]


def increments_of_cases(program, folder):
    """The listing says which load case each increment is of, and the factor that this case has come to; names of cases are kept"""
    deck = RING.format(patch='-20, 30', output='0') + LOADS.format(turned=0) + 'COMBINE\n1, 4, 1.0, 2, 1.0\n'
    run(program, folder, 'steps', deck + 'INCREMENTS\n1, , , 4\n0.5, , , 2\n-0.25, , , 4\n0.5\nEND\n')
    lines = read_text(os.path.join(folder, 'steps.lis')).split('LOAD INCREMENTS\n')[1].splitlines()[2:7]
    found = [line.split()[-2:] for line in lines]
    faults = expected('of case, its total', [['4', '1.0000000E+00'], ['2', '5.0000000E-01'], ['4', '7.5000000E-01'], ['all', '-']], found[1:])
    run(program, folder, 'plain', deck + 'INCREMENTS\n1\nEND\n')
    return faults + expected('of all cases', False, 'of case' in read_text(os.path.join(folder, 'plain.lis')))


# A pile pressed on ground by 1 at r = 0 to 0.5, pushed by 0.4 at z = 0.5, held by nothing but its shaft and its toe
INTERFACES = """TITLE
Pile
CONTROL
1,17,,,,,NEWTON
MATERIALS
1,2E4,0.2
LAWS
1,1E4,2E4,1E4,0,30,PAPER
2,1E4,2E4,1E4,,,ELASTIC
BLOCKS
1,1,8,2,4
0,-1,0.5,0
1,1,8,2,2
0,0,0.5,0.5
2,1,8,3,4
0.5,-1,2,0
2,1,8,2,2
0,-2,0.5,-1
2,1,8,3,2
0.5,-2,2,-1
FACES
1,1,0,0.5,0.5,0.5
2,1,0.5,-1,0.5,0
3,2,0.5,-1,0.5,0
4,1,0,-1,0.5,-1
5,2,0,-1,0.5,-1
6,2,0,-2,2,-2
INTERFACES
1,2,3,JOINTS,shaft
2,4,5,JOINTS,toe
FIXEDFACES
6,111
RESULTANTS
1,AXIAL,-1
1,LATERAL,0.4,{angle}
END
"""


def interfaces_listed(program, folder):
    """What interfaces carry balances the loads of the body that they hold, whatever the angle; areas and their shares"""
    faults, shares = [], []
    for angle in (0, 90):
        ran = program.run('run', write(folder, 'pile.dat', INTERFACES.format(angle=angle)), '-o', folder)
        text = read_text(os.path.join(folder, 'pile.lis'))
        lines = text[text.index('RESULTANTS OF INTERFACES'):].split('\n')
        rows = {one.split()[0]: [float(word) for word in one.split()[1:] + other.split()[1:]] for one, other in zip(
            lines[3:5], lines[6:8], strict=True)}
        total = [sum(column) for column in zip(*(row[:6] for row in rows.values()), strict=True)]
        along = [0.4, 0] if angle == 0 else [0, 0.4]
        # the load is 1 downwards, 0.4 sideways at z = 0.5; a moment lifts the side that it is named after
        wanted = [1, *(-x for x in along), *(0.5*x for x in along), 0]
        faults += ran.ended_with(0)
        faults += [f'{angle} degrees: {total}' for one, other in zip(total, wanted, strict=True) if abs(one - other) > 1e-5]
        for name, area in (('shaft', math.pi), ('toe', math.pi/4)):
            if abs(rows[name][6] - area) > 1e-6 or abs(sum(rows[name][7:]) - 1) > 0.002:
                faults.append(f'{name}: {rows[name]}')
        faults += expected('elastic joints', [1, 0, 0], rows['toe'][7:]) + expected('a part slips or opens', True, rows['shaft'][7] < 1)
        shares.append(rows['shaft'][7:])
    return faults + expected('shares at 90 degrees', True, max(abs(a - b) for a, b in zip(*shares, strict=True)) < 0.03)


def round_the_circle(program, folder):
    """Least and largest stresses of a load that points anywhere are those along 0 degrees, turned; at such an angle of OUTPUT the table
    there has the same; in a job round the axis there is no table"""
    found, faults = {}, []
    for angle in (0, 47):
        deck = INTERFACES.format(angle=angle).replace('FIXEDFACES', f'OUTPUT\n{angle},{angle + 90},{angle + 180}\nFIXEDFACES')
        faults += program.run('run', write(folder, 'pile.dat', deck), '-o', folder).ended_with(0)
        text = read_text(os.path.join(folder, 'pile.lis'))
        lines = text[text.index('EXTREMES OF TOTAL STRESSES AT GAUSS POINTS ROUND THE CIRCLE'):].split('\n')[3:9]
        rows = {line.split()[0]: [float(word) for word in line.split()[1:]] for line in lines}
        found[angle] = rows
        here = text[text.index(f'TOTAL STRESSES AT GAUSS POINTS, theta = {angle} degrees'):].split('\n')
        sigma_z = [float(line.split()[5]) for line in here[3:here.index('')] if line.strip() and line.split()[0].isdigit()]
        faults += expected(f'least at {angle} degrees', True, abs(rows['sigma_z'][4] - angle) < 1
                           and abs(min(sigma_z) - rows['sigma_z'][0]) < 1e-3*abs(min(sigma_z)))
    for name, row in found[0].items():
        turned = found[47][name]
        scale = max(abs(row[0]), abs(row[5]))
        for k in (0, 5):
            apart = (turned[k + 4] - row[k + 4] - 47) % 360
            if abs(turned[k] - row[k]) > 1e-2*scale or name.startswith('sigma') and turned[k + 1] == row[k + 1] and min(apart, 360 - apart) > 3:
                faults.append(f'{name}: {row}, turned {turned}')
    plain = INTERFACES.format(angle=0).replace('1,LATERAL,0.4,0\n', '')
    program.run('run', write(folder, 'plain.dat', plain), '-o', folder)
    return faults + expected('round the axis', False, 'ROUND THE CIRCLE' in read_text(os.path.join(folder, 'plain.lis')))


def take_each_other_away(program, folder):
    """Loads that take each other away leave nothing, also of several cases: no mechanism, and no errors of what rounding leaves"""
    peg, faults = input_deck('first.dat').replace('0.17\n', '0.17              1.0E-5\n'), []
    push = '    1   LATERAL       0.4\n'
    for name, (cards, further) in {
            'pulled both ways': ('1, AXIAL, 0.4\n1, AXIAL, -0.4\n', ''),
            'pushed both ways': (f'{push}1, LATERAL, 0.4, 180.0\n', ''),
            'three ways': (''.join(f'1, LATERAL, 0.4, {angle}\n' for angle in (10, 130, 250)), ''),
            'heated and cooled': ('', 'TEMPERATURES\n1, 0, 0.7\nCASE\n2\nTEMPERATURES\n1, 0, 0.1\nCOMBINE\n1, 1, 1.0, 2, -7.0\n'),
            'moved there and back': ('', 'MOVEDFACES\n1, 1, 0.7, 0.0, -0.7\nCASE\n2\nMOVEDFACES\n1, 1, 0.1, 0.0, -0.1\n'
                                     'COMBINE\n1, 1, 1.0, 2, -7.0\n'),
            'by two cases': ('1, AXIAL, 0.7\n', 'CASE\n2\nRESULTANTS\n1, AXIAL, 0.1\nCOMBINE\n1, 1, 1.0, 2, -7.0\n')}.items():
        deck = peg.replace(push, cards).replace('\nEND', f'\n{further}END')
        ran = program.run('run', write(folder, 'peg.dat', deck), '-o', folder)
        faults += [f'{name}: {fault}' for fault in ran.ended_with(0)]
        faults += expected(f'{name}: nothing moves', True, 'nothing moves: loads are zero' in ran.out)
        faults += expected(f'{name}: errors', True, 'nothing that is known leaves an error' in ran.out)
    return faults


def tests(program):
    """The tests of this module"""
    return [Test('load cases: combinations', lambda folder: combinations_add_up(program, folder)),
            Test('load cases: turned load', lambda folder: turned_load(program, folder)),
            Test('load cases: not combined', lambda folder: not_combined(program, folder)),
            Test('load cases: increments', lambda folder: increments_of_cases(program, folder)),
            Test('load cases: interfaces', lambda folder: interfaces_listed(program, folder)),
            Test('load cases: taken away', lambda folder: take_each_other_away(program, folder)),
            Test('load cases: round the circle', lambda folder: round_the_circle(program, folder))]
