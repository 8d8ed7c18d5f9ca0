"""Stiffnesses out of all proportion: up to which ratio a job is solved, and how far off what is accepted may be

Jobs with exact solutions, in which one stiffness is smaller than another by more and more powers of ten. The tests hold what
doc/user.md says of them; `scripts/verify limits` prints the table there, by the program itself.
"""
import json
import math
import os
import re
import sys
import tempfile
from dataclasses import dataclass
from typing import Callable

import hard_scenes as scenes
import listing
from support import Program, Test, read_text, write

YOUNG, PRESSURE, CELLS = 1e5, 2.0, 4
DECADES = range(3, 19)


def column(title):
    """A deck of harmonic 0"""
    return scenes.Deck(title, 0, 9)


def cylinder(deck, body, material, low, high, r1=0, r2=1):
    """A cylinder or ring with elements of a quarter of its height"""
    return deck.block(body, material, 8, CELLS, CELLS, r1, low, r2, high)


def pressed(deck, face):
    """The load"""
    return deck.add('PRESSURES', (face, 0, PRESSURE, PRESSURE))


def on_springs(ratio):
    """Springs to the ground under a cylinder; the ratio is E/(k h) with the height h of an element"""
    soft = YOUNG*CELLS/ratio
    deck = cylinder(column('A cylinder on springs').material(1, YOUNG, 0.0), 1, 1, 0, 1)
    deck.faces((1, 1, 0, 0, 1, 0), (2, 1, 0, 1, 1, 1)).add('SPRINGS', (1, soft, soft, soft))
    return pressed(deck, 2).text(), lambda r, z: -PRESSURE*(1/soft + z/YOUNG)


def twisted(ratio):
    """The same, twisted by a shear stress that grows with r: family A of harmonic 0"""
    soft = YOUNG*CELLS/ratio
    deck = cylinder(column('A cylinder on springs is twisted').material(1, YOUNG, 0.0), 1, 1, 0, 1)
    deck.faces((1, 1, 0, 0, 1, 0), (2, 1, 0, 1, 1, 1)).add('SPRINGS', (1, soft, soft, soft)).add('RESTRAINTS', (1, '010'))
    deck.add('RESULTANTS', (2, 'TORQUE', PRESSURE*math.pi/2))
    return deck.text(), lambda r, z: PRESSURE*r*(1/soft + z*2/YOUNG)


def on_joint(ratio, kind='ELASTIC'):
    """A joint between two cylinders, which cannot open, or which can open and slip"""
    soft = YOUNG*CELLS/ratio
    deck = column('Two cylinders, a soft joint between').material(1, YOUNG, 0.0)
    deck.law(1, (soft, soft, soft), 0.0, 30.0, kind=kind)
    cylinder(cylinder(deck, 1, 1, 0, 1), 2, 1, -1, 0)
    deck.faces((1, 1, 0, 0, 1, 0), (2, 1, 0, 1, 1, 1), (3, 2, 0, 0, 1, 0), (4, 2, 0, -1, 1, -1))
    deck.add('INTERFACES', (1, 3, 1)).add('FIXEDFACES', (4, '111'))
    return pressed(deck, 2).text(), lambda r, z, above: -PRESSURE*((1 + z)/YOUNG + (1/soft if above else 0))


def one_upon_the_other(ratio):
    """A stiff cylinder on a soft one, of one body: E over E"""
    soft = YOUNG/ratio
    deck = column('Stiff upon soft').material(1, YOUNG, 0.0).material(2, soft, 0.0)
    cylinder(cylinder(deck, 1, 1, 0, 1), 1, 2, -1, 0)
    deck.faces((2, 1, 0, 1, 1, 1), (4, 1, 0, -1, 1, -1)).add('FIXEDFACES', (4, '111'))
    return pressed(deck, 2).text(), lambda r, z: -PRESSURE*(min(z + 1, 1)/soft + max(z, 0)/YOUNG)


def side_by_side(ratio):
    """A stiff ring round a soft cylinder, both shortened by the same"""
    soft = YOUNG/ratio
    deck = column('Stiff beside soft').material(1, YOUNG, 0.0).material(2, soft, 0.0)
    cylinder(cylinder(deck, 1, 2, 0, 1), 1, 1, 0, 1, 1, 2)
    deck.faces((1, 1, 0, 0, 2, 0), (2, 1, 0, 1, 2, 1)).add('FIXEDFACES', (1, '010'))
    deck.add('MOVEDFACES', (2, 0, None, -PRESSURE/YOUNG, None))
    return deck.text(), lambda r, z: -PRESSURE*z/YOUNG


# Two by two distorted 9-node elements, of whose sides the corners, and one middle, are given
DISTORTED = """TITLE
A cylinder that can hardly change its volume
CONTROL
0
MATERIALS
1, {young}, {poisson:.17g}
NODES
1, 0.0, 0.0
3, 0.6, 0.0
5, 1.0, 0.0
21, 0.0, 0.6
23, 0.4, 0.5
25, 1.0, 0.6
41, 0.0, 1.0
43, 0.6, 1.0
45, 1.0, 1.0
24, 0.7, 0.6
ELEMENTS
1, 1, 1, 1, 2, 3, 13, 23, 22, 21, 11, 12
2, 1, 1, 3, 4, 5, 15, 25, 24, 23, 13, 14
3, 1, 1, 43, 42, 41, 31, 21, 22, 23, 33, 32
4, 1, 1, 23, 24, 25, 35, 45, 44, 43, 33, 34
FACES
1, 1, 0, 0, 1, 0
2, 1, 0, 1, 1, 1
FIXEDFACES
1, 010
PRESSURES
2, 0, {pressure}, {pressure}
END
"""


def squeezed(ratio):
    """A cylinder of distorted elements; the ratio is that of bulk to shear modulus, 2 (1 + nu)/(3 (1 - 2 nu))"""
    poisson = (3*ratio - 2)/(6*ratio + 2)
    return DISTORTED.format(young=YOUNG, poisson=poisson, pressure=PRESSURE), lambda r, z: -PRESSURE*z/YOUNG


@dataclass(frozen=True)
class Case:
    """A job by its ratio, and words for it; largest decade that must be solved, smallest that must be refused, each a decade
    beside what was found; what accepted displacements and stresses may be off by, over the largest, or over the stress of
    the soft body, where no remark says how much more; component and stress that are looked at"""
    make: Callable
    words: str
    solved: int
    refused: int
    displacement: float
    stress: float
    component: str = 'v'
    of: str = 'sigma_z'


CASES = {
    'springs': Case(on_springs, 'body on springs, E/(k h)', 9, 12, 1e-6, 1e-5),
    'springs, twisted': Case(twisted, 'body on springs, twisted, E/(k h)', 9, 12, 1e-6, 1e-5, 'w', 'tau_ztheta'),
    'elastic joint': Case(on_joint, 'elastic joint between bodies, E/(k h)', 9, 12, 1e-6, 1e-5),
    'joint': Case(lambda ratio: on_joint(ratio, 'PAPER'), 'joint that can open and slip, E/(k h)', 11, 14, 1e-6, 1e-5),
    'upon': Case(one_upon_the_other, 'stiff body upon soft one, E/E', 9, 12, 1e-6, 1e-5),
    'squeezed': Case(squeezed, 'nearly incompressible, distorted elements, K/G', 8, 11, 1e-6, 1e-3),
    'beside': Case(side_by_side, 'stiff ring round soft body, E/E', 18, 99, 1e-6, 1e-5),
}


def found(program, folder, case, decade):
    """Exit code; errors of displacement and stress over exact values; residual ratio, condition number, and what a remark says
    that stresses may be off by, 0 without one"""
    deck, exact = case.make(10.0**decade)
    ran = program.run('run', write(folder, 'job.dat', deck), '-o', folder)
    if not os.path.exists(os.path.join(folder, 'job.lis')):
        return ran.code, math.nan, math.nan, math.nan, math.nan, 0.0
    tables = listing.tables(read_text(os.path.join(folder, 'job.lis')))
    summary = json.loads(read_text(os.path.join(folder, 'job.json')))
    rows = next(tables[name] for name in (('m = 0 A',) if case.component == 'w' else ('m = 0',)))
    half = len(rows)//2
    off = size = 0.0
    for k, row in enumerate(rows):
        wanted = exact(row['r'], row['z'], k < half) if exact.__code__.co_argcount == 3 else exact(row['r'], row['z'])
        value = -row['w'] if case.component == 'w' and wanted*row['w'] < 0 else row[case.component]
        off, size = max(off, abs(value - wanted)), max(size, abs(wanted))
    wrong = 0.0
    for row in tables['stresses, theta = 0']:
        wanted = PRESSURE*(row['r'] if case.of == 'tau_ztheta' else 1.0)
        least = 10.0**-decade if case.make is side_by_side and row['r'] < 1 else 1.0
        wrong = max(wrong, abs(abs(row[case.of]) - wanted*least)/(PRESSURE*least))
    os.remove(os.path.join(folder, 'job.lis'))
    told = re.search(r'rounding may leave stresses off by (\S+) of the largest, displacements by less', ' '.join(ran.out.split()))
    return (ran.code, off/size, wrong, summary['residual_ratio'], max(mode['condition'] for mode in summary['modes']),
            float(told[1]) if told else 0.0)


def held(program, folder, case):
    """Faults unless it is solved and refused where the manual says so, and what is accepted is as near as it says"""
    faults = []
    for decade in DECADES:
        code, displacement, stress, _, _, told = found(program, folder, case, decade)
        if code not in (0, 3, 4) and not (case.make is squeezed and decade > 15):  # in sixteen digits that is nu = 1/2
            faults.append(f'1E{decade}: exit code {code}')
        if decade <= case.solved and code != 0:
            faults.append(f'1E{decade}: expected to be solved, exit code {code}')
        if decade >= case.refused and code == 0:
            faults.append(f'1E{decade}: expected to be refused, displacements off by {displacement:.1E}, stresses by {stress:.1E}')
        if code == 0 and not (displacement <= max(case.displacement, told) and stress <= max(case.stress, told)):
            faults.append(f'1E{decade}: accepted, but displacements are off by {displacement:.1E}, stresses by {stress:.1E}, told {told:.1E}')
    return faults


def tests(program):
    """One test a job"""
    return [Test(f'limits: {name}', lambda folder, case=case: held(program, folder, case)) for name, case in CASES.items()]


def refined(ratio, n=7):
    """Stress of a bar on a spring under a force, n elements, relative errors: by double precision; refined by residuals in
    extended precision; and of the true displacements, rounded to double precision"""
    import numpy as np
    stiffness, spring = float(n), float(n)/(1.3*ratio)
    matrix = np.zeros((n + 1, n + 1))
    for k in range(n):
        matrix[k:k + 2, k:k + 2] += stiffness*np.array([[1.0, -1.0], [-1.0, 1.0]])
    matrix[0, 0] += spring
    load = np.zeros(n + 1)
    load[-1] = force = 0.7
    lower = np.linalg.inv(np.linalg.cholesky(matrix))
    solve = lambda force: lower.T @ (lower @ force)
    stress = lambda moved: float(abs(stiffness*np.diff(moved)/force - 1).max())
    plain = better = solve(load)
    for _ in range(5):
        better = better + solve((load - matrix.astype(np.longdouble) @ better.astype(np.longdouble)).astype(float))
    true = (np.longdouble(force)*(1/np.longdouble(spring) + np.arange(n + 1)/np.longdouble(stiffness))).astype(float)
    return stress(plain), stress(better), stress(true)


def main(path, *options):
    """Print the table of the manual; with --rows every run; and what refinement could give"""
    program = Program(path)
    print('| job, ratio | solved up to | refused from | accepted: displacements off by | stresses off by |')
    print('|---|---|---|---|---|')
    for case in CASES.values():
        runs = {}
        with tempfile.TemporaryDirectory(prefix='axijoint-limits-') as folder:
            for decade in DECADES:
                runs[decade] = found(program, folder, case, decade)
                if '--rows' in options:
                    code, displacement, stress, residual, condition, told = runs[decade]
                    print(f'  {case.words:44} 1E{decade:<3} exit {code}  displacement {displacement:.1E}  stress {stress:.1E}  '
                          f'residual {residual:.1E}  condition {condition:.1E}  told {told:.1E}', flush=True)
        good = [decade for decade, run in runs.items() if run[0] == 0]
        bad = [decade for decade, run in runs.items() if run[0] != 0]
        print(f'| {case.words} | {f"1E{max(good)}" if good else "-"} | {f"1E{min(bad)}" if bad else "-"} | '
              f'{max(runs[k][1] for k in good):.0E} | {max(runs[k][2] for k in good):.0E} |', flush=True)
    print('\nA bar on a spring, errors of its stress: double precision, refined by extended precision, true displacements rounded')
    for decade in (6, 9, 12):
        print(f'  1E{decade:<4}' + '  '.join(f'{error:.1E}' for error in refined(10.0**decade)))


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
