"""Joints soft or stiff out of proportion to the bodies: k h/E as it follows by hand, and the change that
ten times the stiffness makes against runs with ten times the stiffness"""
import json
import math
import os
import re

import hard_scenes as scenes
import listing
from support import INPUTS, Test, expected, read_text, write

# Digits of the largest displacement on the terminal and of joint stress in the listing, and what the
# estimate's tolerance (1E-6 of the forces) leaves
CLOSE = 5e-5


class Result:
    """Summary, largest displacement and joint stresses of a run"""

    def __init__(self, program, folder, name, deck):
        ran = program.run('run', write(folder, f'{name}.dat', deck), '-o', folder)
        faults = ran.ended_with(0)
        if faults:
            raise AssertionError('\n'.join([name, *faults]))
        self.out = ran.out
        self.summary = json.loads(read_text(os.path.join(folder, f'{name}.json')))
        self.displacement = float(re.search(r'^largest displacement +(\S+)', ran.out, re.M)[1])
        rows = listing.tables(read_text(os.path.join(folder, f'{name}.lis')))['joints']
        self.stress = [row[key] for row in rows for key in ('tau_xi', 'sigma', 'tau_theta')]

    def law(self, number):
        """What the summary says of a law"""
        return next(law for law in self.summary['joint_stiffness'] if law['law'] == number)


def paper(vertical=1.0, horizontal=1.0, law='PAPER', method='NEWTON'):
    """The paper's case 3, stiffness of both interfaces times a factor"""
    deck = scenes.example(3, harmonic=4, planes=17, tolerance=1e-8, method=method)
    one, two = re.findall(r'LAWS\n(.*)\n', deck)
    for old, factor, kind in ((one, vertical, law), (two, horizontal, 'ELASTIC')):
        number, *stiffness = old.split(', ')[:4]
        fields = [number, *(f'{factor*float(k):.12G}' for k in stiffness)]
        strength = ['0.0', '0.0'] if kind == 'PAPER' else ['', '']
        deck = deck.replace(old, ', '.join(fields + strength + [kind, 'GAUSS']))
    return deck


def ring(stiffness, harmonic):
    """Two rings with an elastic joint between, under cos(m theta): a linear job of one harmonic"""
    deck = scenes.Deck(f'Rings under harmonic {harmonic}', harmonic, harmonic + 2).material(1, 1e4, 0.3)
    deck.law(1, (stiffness,)*3, kind='ELASTIC')
    deck.block(1, 1, 8, 2, 2, 0.5, 0, 1, 1).block(2, 1, 8, 4, 2, 1, 0, 2, 1)
    deck.faces((1, 1, 1, 0, 1, 1), (2, 2, 1, 0, 1, 1), (3, 1, 0.5, 0, 0.5, 1), (4, 2, 2, 0, 2, 1))
    deck.add('INTERFACES', (1, 1, 2)).add('FIXEDFACES', (4, '111'))
    return deck.add('PRESSURES', (3, harmonic, 1.0, 1.0)).text()


def history(factor):
    """A pile in soil, pushed to and fro"""
    return scenes.soil_pile('A cycle', ((1, 1), (0.5, 2), (-0.5, 2), (1, 2)), k=2e-3*factor, tolerance=1e-6)


# Name; deck for a factor of the stiffness; laws concerned
SCENES = (
    ('no tension, soft', lambda f: paper(5e-3*f), [1]),
    ('no tension, very soft', lambda f: paper(1e-4*f), [1]),
    ('no tension, stiff', lambda f: paper(1e4*f), [1]),
    ('another method', lambda f: paper(5e-3*f, method='NEWTON' if f > 1.0 else 'TOTAL'), [1]),
    ('both laws soft', lambda f: paper(1e-3*f, 1e-3*f), [1, 2]),
    ('elastic law of a job with iterations', lambda f: paper(1.0, 1e-3*f), [2]),
    ('elastic joints', lambda f: paper(1e-3*f, 1.0, 'ELASTIC'), [1]),
    ('bonds, soft', lambda f: scenes.example(1, factor=1e-3*f, harmonic=4, planes=17, tolerance=1e-8), [1, 2]),
    ('rings in harmonic 0', lambda f: ring(5.0*f, 0), [1]),
    ('rings in harmonic 2', lambda f: ring(5.0*f, 2), [1]),
    ('rings in harmonic 2, stiff', lambda f: ring(1e7*f, 2), [1]),
    ('a history', history, [1, 2]),
    ('a disc on springs', lambda f: scenes.eccentric_disc(0.4, k=f, young=1e5, n=8, planes=17), [1]),
)


def tenfold(program, folder, make, laws):
    """The change against a run with ten times the stiffness, and the words that tell it"""
    one, other = (Result(program, folder, name, make(factor)) for name, factor in (('one', 1.0), ('other', 10.0)))
    told = one.law(laws[0])['ten_times']
    if told is None:
        return [f'no change is told: {one.summary["joint_stiffness"]}']
    largest = max(map(abs, one.stress))
    wanted = {'displacement': other.displacement/one.displacement - 1.0,
              'joint_stress': max(map(abs, other.stress))/largest - 1.0,
              'joint_stress_anywhere': max(abs(a - b) for a, b in zip(one.stress, other.stress))/largest}
    faults = expected('laws', laws, told['laws'])
    for key, value in wanted.items():
        if abs(told[key] - value) > CLOSE*max(1.0, abs(1.0 + value)):
            faults.append(f'{key}: expected {value:.6f}, found {told[key]:.6f}')
    faults += [f'{key}_anywhere is less than {key}' for key in ('displacement', 'joint_stress')
               if told[f'{key}_anywhere'] < abs(told[key]) - 1e-12]
    words = f'largest displacement {"+" if told["displacement"] >= 0 else "-"}'
    for place, text in (('messages', ' '.join(one.summary['messages'])), ('terminal', one.out)):
        if words not in text:
            faults.append(f'{place}: expected {words!r}, found {text}')
    return faults


def proportions(program, folder):
    """k h/E of the least modulus beside each joint; what is told of laws inside and outside the range"""
    result = Result(program, folder, 'first', read_text(os.path.join(INPUTS, 'first.dat')))
    law = result.law(1)
    faults = expected('kappa', ([0.0625]*2, [0.125]*2, [0.0625]*2), (law['kappa_xi'], law['kappa_eta'], law['kappa_theta']))
    faults += expected('side', ('sensible', None), (law['side'], law['ten_times']))
    faults += expected('messages', [], result.summary['messages'])
    soil = Result(program, folder, 'soil', scenes.soil_pile('p', ((1, 1),), k=1e3)).law(1)
    lengths = (0.5, 0.5)  # of the shaft; E of the soil is 50, of the pile 2E4
    return faults + expected('beside soil', [1e3*length/50.0 for length in lengths], soil['kappa_eta'])


def sides(program, folder):
    """Where the range ends: h = 0.125, E = 2E4. Shear counts if the law has strength in shear, and
    the message names the direction"""
    faults = []
    for k_xi, k_eta, law, side, words in (
            (1.61e2, 1.61e2, 'PAPER', 'sensible', ''), (1.59e2, 1.59e2, 'PAPER', 'soft', 'along eta'),
            (1.59e7, 1.59e7, 'ELASTIC', 'sensible', ''), (1.61e7, 1.61e7, 'ELASTIC', 'stiff', '10 E/h'),
            (1.61e10, 1.61e10, 'PAPER', 'stiff', 'counts as rigid'), (1.61e9, 1.61e9, 'PAPER', 'stiff', '10 E/h'),
            (1.0, 1e4, 'PAPER', 'sensible', ''), (1.0, 1e4, 'ELASTIC', 'soft', 'along xi'),
            (0.0, 1e4, 'ELASTIC', 'sensible', '')):
        deck = paper(law=law)
        old = re.search(r'LAWS\n(.*)\n', deck)[1]
        new = re.sub(r'^(1), .*?, .*?, .*?, ', f'1, {k_xi:G}, {k_eta:G}, 1E4, ' if law == 'ELASTIC' else
                     f'1, {k_xi:G}, {k_eta:G}, {k_eta:G}, ', old)
        if k_xi == k_eta:
            new = new.replace('1E4', f'{k_eta:G}')
        result = Result(program, folder, 'one', deck.replace(old, new))
        faults += expected(f'{new}: side', side, result.law(1)['side'])
        told = [text for text in result.summary['messages'] if 'law 1: joints' in text]
        faults += expected(f'{new}: messages', int(side != 'sensible'), len(told))
        if told and words not in told[0]:
            faults.append(f'{new}: expected {words!r}, found {told[0]!r}')
    return faults


def either_way(program, folder):
    """A little below k h/E = 1e4 a joint has its whole stiffness in the structure, a little above a tenth, and its law the rest: what
    the bodies do is the same, and so it is with a hundred times the stiffness but for E/(k h)"""
    increments = ((1, 1), (0.5, 2), (-0.5, 2), (1, 2))
    below, above, rigid = (Result(program, folder, name, scenes.soil_pile('A cycle', increments, k=k, tolerance=1e-8))
                           for name, k in (('below', 0.9999e6), ('above', 1.0001e6), ('rigid', 1e8)))
    largest, faults = max(map(abs, below.stress)), []
    for name, other, bar in (('above', above, CLOSE), ('rigid', rigid, 1e-3)):
        change = abs(other.displacement/below.displacement - 1.0)
        if change > bar:
            faults.append(f'{name}: the largest displacement is {change:.1e} off')
    change = max(abs(a - b) for a, b in zip(below.stress, above.stress))/largest
    if change > CLOSE:
        faults.append(f'joint stress is {change:.1e} off')
    return faults + expected('k h/E', [True, False], [result.law(1)['kappa_eta'][1] < 1e4 for result in (below, above)])


# A column of two rings, the upper one of which has a neighbour
COLUMN = """TITLE
Column
CONTROL
0
MATERIALS
1, 210000., 0.
3, {filler}, 0.
ORTHOTROPIC
2, {young}, {young}, {round}
0., 0., 0., 80000., {round}, {round}
LAWS
1, 1E6, 1E6, 1E6, , 20.
BLOCKS
1, 1, 8, 1, 2
100., 0., 120., 50.
2, {upper}, 8, 1, 2
100., 50., 120., 100.
2, 3, 8, 1, 2
120., 50., 130., 100.
FACES
1, 1, 100., 50., 120., 50.
2, 2, 100., 50., 120., 50.
3, 1, 100., 0., 120., 0.
4, 2, 100., 100., 120., 100.
INTERFACES
1, 1, 2
FIXEDFACES
3, 010
PRESSURES
4, 0, 100.
END
"""


def beside_softer(program, folder):
    """How stiff a joint may be follows from how the bodies resist it on both sides: not from how soft they are round the circle, as a
    slotted ring, nor from a soft filler that has one end of the joint. The column shortens by p (2 L/E + 1/k)"""
    exact = 100.0*(100.0/210000.0 + 1e-6)
    faults = []
    for name, fields, upper in (('slotted', {'round': 1.0, 'filler': 1.0}, 2), ('very soft', {'round': 1e-2, 'filler': 1e-2}, 2),
                                ('filler', {'round': 1e3, 'filler': 1.0}, 1)):
        result = Result(program, folder, 'column', COLUMN.format(young=210000.0, upper=upper, **fields))
        shortening = max(abs(row['v']) for row in listing.tables(read_text(os.path.join(folder, 'column.lis')))['m = 0'] if row['r'] <= 120.0)
        faults += [] if abs(shortening/exact - 1.0) < 1e-3 else [f'{name}: {shortening:.6f}, exact {exact:.6f}']
        faults += expected(f'{name}: k h/E', True, 95.0 < result.law(1)['kappa_eta'][1] < 95.5)
    return faults


RIGID_DISC = """TITLE
A disc on a joint, pressed beside its middle
CONTROL
1
MATERIALS
1, 1E9, 0.
LAWS
1, 1E4, 1E4, 1E4, {law}
BLOCKS
1, 1, 8, 1, 2
0., 0., 0.5, 1.
2, 1, 8, 1, 1
0., -1., 0.5, 0.
FACES
1, 1, 0., 0., 0.5, 0.
2, 2, 0., 0., 0.5, 0.
3, 2, 0., -1., 0.5, -1.
4, 1, 0., 1., 0.5, 1.
INTERFACES
1, 1, 2
FIXEDFACES
3, 111
RESULTANTS
4, AXIAL, -1.
4, MOMENT, 0.05
END
"""


def pressure_at_edge(program, folder):
    """Pressure under a rigid disc is linear, N/A + M r/I: at points of integration, and at the edge, where the last of Gauss's is not;
    Lobatto's rule has a point there, and nothing more is told"""
    area, inertia = math.pi*0.25, math.pi*0.5**4/4
    faults = []
    for law in ('0., 30.', ',,ELASTIC', '0., 30., PAPER, LOBATTO'):
        result = Result(program, folder, 'disc', RIGID_DISC.format(law=law))
        out, told, listed = result.out, result.summary['edge_pressure'], read_text(os.path.join(folder, 'disc.lis'))
        (value, radius) = map(float, re.search(r'^largest pressure +(\S+) at r = (\S+),', out, re.M).groups())
        faults += [] if abs(value/(1/area + 0.05*radius/inertia) - 1) < 1e-3 else [f'{law}: {value} at {radius}']
        edge = re.search(r'^at an edge of joints +about (\S+) at r = 0.5,', out, re.M)
        there = (edge is not None, told is not None, 'PRESSURE AT AN EDGE OF JOINTS' in listed)
        faults += expected(f'{law}: an edge', ('LOBATTO' not in law,)*3, there)
        if all(there):
            exact = 1/area + 0.05*0.5/inertia
            faults += [] if abs(float(edge[1])/exact - 1) < 6e-3 and edge[0][6:].split('about ')[-1] in listed else [f'{law}: {edge[0]}']  # three digits
            faults += [] if abs(told['value']/exact - 1) < 1e-3 else [f'{law}: {told}']
    return faults


def tests(program):
    """One test a scene"""
    return [Test('stiffness: k h/E', lambda folder: proportions(program, folder)),
            Test('stiffness: whole in the structure or in part', lambda folder: either_way(program, folder)),
            Test('stiffness: beside softer bodies', lambda folder: beside_softer(program, folder)),
            Test('stiffness: pressure at an edge', lambda folder: pressure_at_edge(program, folder)),
            Test('stiffness: range', lambda folder: sides(program, folder))] + [
        Test(f'stiffness: ten times, {name}',
             lambda folder, make=make, laws=laws: tenfold(program, folder, make, laws))
        for name, make, laws in SCENES]
