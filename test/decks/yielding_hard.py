"""Bodies that yield at their limits: nearly incompressible, without cohesion, with steps far too large, at the apex,
with strengths far apart, yielding everywhere at once, and with joints that slip at the same time. Each ends in
equilibrium, with what is known of it, or in words"""
import math
import os

import listing
from support import Test, expected, read_text
from yielding import COLLAPSE, YIELD_STRESS, cylinder, footing, off, run, steered

# Uniform specimen: height and radius 1, Young's modulus, Poisson's ratio
YOUNG, POISSON = 1000.0, 0.3
WORDS = 'no equilibrium was found beyond the load factor'


def specimen(law, axial, lateral, factors):
    """A cylinder whose top and mantle are moved: strain and stress are uniform"""
    return f"""TITLE
Specimen
CONTROL
0, , , 2
MATERIALS
1, {YOUNG}, {POISSON}
YIELD
1, {law}
BLOCKS
1, 1, 8, 2, 2
0.0, 0.0, 1.0, 1.0
FACES
1, 1, 0.0, 0.0, 1.0, 0.0
2, 1, 0.0, 1.0, 1.0, 1.0
3, 1, 1.0, 0.0, 1.0, 1.0
FIXEDFACES
1, 010
MOVEDFACES
2, 0, , {axial}
3, 0, {lateral}
INCREMENTS
""" + ''.join(f'{factor}, 1E-10\n' for factor in factors) + 'END\n'


def principal(folder, name):
    """Forces on top and mantle at the end, as stresses"""
    rows = listing.tables(read_text(os.path.join(folder, f'{name}.lis')))['stresses, theta = 0']
    return [(row['sigma_r'], row['sigma_z'], row['sigma_theta']) for row in rows]


def apex(criterion):
    """Pulled apart in all directions far beyond the apex: a mean stress of c cot(phi) at every point, no shear"""
    def check(folder, program):
        wanted = 2.0/math.tan(math.radians(30.0))
        faults = []
        for dilation in (30.0, 0.0):
            run(program, folder, specimen(f'{criterion}, 2.0, 30.0, {dilation}', 0.1, 0.1, (0.5, 0.5)))
            for stresses in principal(folder, 'yielding'):
                faults += sum((off(f'{criterion}, psi = {dilation}', stress, wanted, 1e-6) for stress in stresses), [])
        return faults
    return check


def everywhere_at_once(folder, program):
    """One step to thirty times the yield strain: every point is at yield, the stress is known"""
    run(program, folder, specimen('MISES, 2.0', 0.06, -0.03, (1.0,)))
    return sum((off('sigma_z - sigma_r', z - r, 2.0, 1e-6) for r, z, _ in principal(folder, 'yielding')), [])


def nearly_incompressible(folder, program):
    """nu = 0.499999: the collapse of the cylinder as with any nu. Rounding allows a tolerance of 1e-6; with 1e-8 no
    equilibrium is found, in words"""
    deck = cylinder((1.0, 0.4, 0.2, 0.1), 32).replace(', 0.3\n', ', 0.499999\n', 1)
    strict = run(program, folder, deck.replace('0.4, 1E-8\n0.2, 1E-8\n0.1, 1E-8\n', ''), (0, 4))
    faults = [] if strict['exit_code'] == 0 else expected(
        'words', True, any('no equilibrium was found' in text for text in strict['messages']))
    deck = deck.replace('1E-8', '1E-6')
    summary = run(program, folder, deck, (4,))
    reached = 100.0*summary['increments'][-1]['load_factor']
    return faults + off('collapse', reached, COLLAPSE, 2e-3)


def first_step_too_large(folder, program):
    """Loads up to a million times the collapse: halves of the step find equilibrium, or there is none, in words"""
    faults = []
    for factor in (3.0, 30.0, 1e6):
        summary = run(program, folder, cylinder((factor,)), (4,))
        faults += expected(f'words at {factor}', True, any('no equilibrium' in text for text in summary['messages']))
        reached = 100.0*summary['increments'][-1]['load_factor']
        if not 0.0 <= reached <= COLLAPSE*(1.0 + 1e-3):
            faults.append(f'factor {factor}: reached {reached} of {COLLAPSE}')
        if factor < 10.0 and reached < COLLAPSE - 100.0*factor/64.0*1.5:
            faults.append(f'factor {factor}: only {reached} of {COLLAPSE}')
    return faults


def few_iterations(folder, program):
    """A displacement far beyond the collapse and two iterations a step, so that the smallest step is tried by each way there
    is: in words"""
    deck = steered(cylinder((30.0,))).replace('1E-8,,', '1E-8, 2,')
    summary = run(program, folder, deck, (4,))
    faults = expected('words', True, any(WORDS in text for text in summary['messages']))
    reached = 100.0*summary['increments'][-1]['load_factor']
    if not 0.0 < reached < COLLAPSE*(1.0 + 1e-3):
        faults.append(f'reached {reached}, collapse at {COLLAPSE}')
    return faults


def rings_far_apart(folder, program):
    """A weak ring in one ten thousand times as strong: the strong one bears what is beyond the weak one"""
    deck = f"""TITLE
A weak ring in a strong one
CONTROL
0, , , 2
MATERIALS
1, 2.1E5, 0.3
2, 2.1E5, 0.3
YIELD
1, TRESCA, {YIELD_STRESS/1e4}
2, TRESCA, {YIELD_STRESS}
BLOCKS
1, 1, 8, 4, 1
1.0, 0.0, 1.2, 0.1
1, 2, 8, 24, 1
1.2, 0.0, 2.0, 0.1
FACES
1, 1, 1.0, 0.0, 1.0, 0.1
2, 1, 1.0, 0.0, 2.0, 0.0
3, 1, 1.0, 0.1, 2.0, 0.1
FIXEDFACES
2, 010
3, 010
PRESSURES
1, 0, 100.0
INCREMENTS
0.5, 1E-8
0.5, 1E-8
0.1, 1E-8
0.1, 1E-8
0.1, 1E-8
END
"""
    limit = YIELD_STRESS*(math.log(2.0/1.2) + 1e-4*math.log(1.2))
    summary = run(program, folder, deck, (4,))
    reached = 100.0*summary['increments'][-1]['load_factor']
    return off('collapse', reached, limit, 3e-3)


def sand(cohesion):
    """A rigid disc pressed into sand that holds by its weight alone"""
    return f"""TITLE
A pile in sand
CONTROL
3, , , 2
MATERIALS
1, 3.0E7, 0.2, 2.0
2, 4.0E4, 0.3, 2.0
YIELD
2, MOHR, {cohesion}, 30.0, 0.0
BLOCKS
1, 1, 8, 1, 3
0.0, -3.0, 0.5, 0.0
1, 2, 8, 4, 3
0.5, -3.0, 4.0, 0.0
1, 2, 8, 1, 1
0.0, -4.0, 0.5, -3.0
1, 2, 8, 4, 1
0.5, -4.0, 4.0, -3.0
FACES
1, 1, 0.0, 0.0, 0.5, 0.0
2, 1, 0.0, -4.0, 4.0, -4.0
3, 1, 4.0, -4.0, 4.0, 0.0
FIXEDFACES
2, 111
3, 111
CASE
1
GRAVITY
-10.0
INSITU
, 0.0, 20.0, 0.5
CASE
2
RESULTANTS
1, LATERAL, 20.0
COMBINE
1, 1, 1.0
1, 2, 1.0
INCREMENTS
1.0, , , 1
1.0, , , 2
1.0, , , 2
1.0, , , 2
-3.0, , , 2
END
"""


def without_cohesion(folder, program):
    """c = 1e-6 holds as c = 1e-3 does; there and back"""
    found = [run(program, folder, sand(cohesion))['increments'] for cohesion in (1e-3, 1e-6)]
    faults = expected('increments', (5, 5), tuple(len(rows) for rows in found))
    for one, other in zip(*found):
        if one['largest_displacement'] > 0.0:
            faults += off('displacement', other['largest_displacement'], one['largest_displacement'], 2e-2)
    return faults


def drawn(cohesion, strength):
    """A long steel shaft drawn through soil, with a joint between them: nothing moves along r, so shear stress follows
    from equilibrium alone"""
    return f"""TITLE
A shaft that is drawn
CONTROL
0, , , 2
MATERIALS
1, 300.0, 0.49
2, 3.0E5, 0.2
YIELD
1, MISES, {math.sqrt(3.0)*strength}
LAWS
1, 1E5, 1E5, 1E5, {cohesion}, 0.0
LAWDETAILS
1, RESULTANT, , , , , , -10.0
BLOCKS
1, 2, 8, 1, 1
0.5, 0.0, 1.0, 1.0
2, 1, 8, 8, 1, 20.0
1.0, 0.0, 3.0, 1.0
FACES
1, 1, 0.5, 1.0, 1.0, 1.0
5, 1, 0.5, 0.0, 1.0, 0.0
6, 2, 1.0, 0.0, 3.0, 0.0
7, 2, 1.0, 1.0, 3.0, 1.0
2, 1, 1.0, 0.0, 1.0, 1.0
3, 2, 1.0, 0.0, 1.0, 1.0
4, 2, 3.0, 0.0, 3.0, 1.0
INTERFACES
1, 2, 3
FIXEDFACES
4, 111
1, 100
5, 100
6, 100
7, 100
RESULTANTS
1, AXIAL, {2.0*math.pi}
INCREMENTS
0.4,
0.4,
0.15,
0.1,
0.1,
END
"""


def drawn_out(folder, program):
    """Joint and soil yield together: the weaker of them gives way, and is named"""
    faults = []
    for cohesion in (0.5, 0.999, 3.0):
        summary = run(program, folder, drawn(cohesion, 1.0), (4,))
        reached = summary['increments'][-1]['load_factor']
        faults += off(f'C = {cohesion}', reached, min(cohesion, 1.0), 2e-2)
        slips = any('joints came to no equilibrium' in text for text in summary['messages'])
        faults += expected(f'C = {cohesion}: the joint gives way', cohesion < 0.9, slips) if cohesion != 0.999 else []
    return faults


def too_much_for_a_footing(folder, program):
    """A pressure on ground, twice the limit at once: in words"""
    deck = footing(3).split('MOVEDFACES')[0] + 'PRESSURES\n1, 0, 12.0\nINCREMENTS\n1.0,\nEND\n'
    summary = run(program, folder, deck, (4,))
    return expected('words', True, any('no equilibrium' in text for text in summary['messages']))


def tests(program):
    """All tests"""
    def made(name, check):
        return Test(f'yielding/hard: {name}', lambda folder: check(folder, program))

    return [made('apex of MOHR', apex('MOHR')), made('apex of DRUCKER', apex('DRUCKER')),
            made('everywhere at once', everywhere_at_once), made('nearly incompressible', nearly_incompressible),
            made('first step too large', first_step_too_large), made('few iterations', few_iterations),
            made('strengths far apart', rings_far_apart), made('without cohesion', without_cohesion),
            made('drawn out', drawn_out), made('too much for a footing', too_much_for_a_footing)]
