"""Bonded interfaces and slits: against one body, against ever stiffer joints, against a penny-shaped crack"""
import json
import math
import os

import hard_scenes as scenes
import listing
from support import Test, expected, read_text, write

# Opening of the crack in the middle: the mesh leaves so much, the far boundary and the listing far less
CRACK_ERROR = 5e-3
# Digits of the listing
LISTED = 2e-7


def run(program, folder, deck):
    """Summary and tables of a deck that must converge"""
    ran = program.run('run', write(folder, 'bonded.dat', deck), '-o', folder)
    if ran.code != 0:
        raise AssertionError(f'exit code {ran.code}: {ran.err}')
    return (json.loads(read_text(os.path.join(folder, 'bonded.json'))),
            listing.tables(read_text(os.path.join(folder, 'bonded.lis'))))


def largest_difference(found, wanted, radius=math.inf):
    """Largest difference of displacements at the same places within a radius, over the largest displacement"""
    worst = 0.0
    for name in (key for key in wanted if key.startswith('m = ')):
        at = {(row['r'], row['z']): row for row in wanted[name]}
        scale = max(abs(row[c]) for row in wanted[name] for c in 'uvw')
        for row in found[name]:
            if row['r'] < radius:
                worst = max(worst, *(abs(row[c] - at[row['r'], row['z']][c])/scale for c in 'uvw'))
    return worst


def two_rings(outer, nodes, bond):
    """A peg in a ring that is held outside, under forces of harmonics 0 and 1; `outer` is the body of the ring"""
    deck = scenes.Deck('A peg in a ring', 2, 9).material(1, 4e4, 0.3).material(2, 1e4, 0.2)
    deck.block(1, 1, nodes, 3, 4, 0.0, 0.0, 0.5, 1.0).block(outer, 2, nodes, 4, 4, 0.5, 0.0, 1.5, 1.0)
    deck.faces((1, 1, 0.0, 1.0, 0.5, 1.0), (4, outer, 1.5, 0.0, 1.5, 1.0))
    if bond:
        deck.faces((2, 1, 0.5, 0.0, 0.5, 1.0), (3, 2, 0.5, 1.0, 0.5, 0.0)).add('INTERFACES', (None, 2, 3, 'BONDED'))
    deck.add('FIXEDFACES', (4, '111'))
    return deck.resultants((1, 'LATERAL', 0.3), (1, 'AXIAL', 0.7), (1, 'MOMENT', 0.2), (1, 'TORQUE', 0.1)).text()


def one_body(nodes):
    """Two bodies, bonded, give what one body gives"""
    def check(folder, program):
        _, one = run(program, folder, two_rings(1, nodes, False))
        summary, two = run(program, folder, two_rings(2, nodes, True))
        error = largest_difference(two, one)
        faults = [f'displacements differ by {error:.1E}'] if not error <= LISTED else []
        faults += expected('rows', {key: len(rows) for key, rows in one.items() if key.startswith('m = ')},
                           {key: len(rows) for key, rows in two.items() if key.startswith('m = ')})
        return faults + expected('joints', 0, summary['joints'])
    return check


def half_bonded(nodes, stiffness):
    """A peg that is bonded to its socket below and in contact above; bonded by joints of a stiffness if one is given"""
    deck = scenes.Deck('A peg, half bonded', 4, 17).material(1, 4e4, 0.3).material(2, 1e4, 0.2)
    deck.law(1, (1e5, 1e5, 1e5), 0.5, 20.0)
    deck.block(1, 1, nodes, 3, 12, 0.0, 0.0, 0.5, 1.5).block(2, 2, nodes, 4, 8, 0.5, 0.0, 1.5, 1.0)
    deck.faces((1, 1, 0.0, 1.5, 0.5, 1.5), (2, 1, 0.5, 0.5, 0.5, 1.0), (3, 2, 0.5, 0.5, 0.5, 1.0),
               (4, 1, 0.5, 0.0, 0.5, 0.5), (5, 2, 0.5, 0.0, 0.5, 0.5), (6, 2, 1.5, 0.0, 1.5, 1.0))
    if stiffness:
        deck.add('LAWS', (2, stiffness, stiffness, stiffness, None, None, 'ELASTIC'))
    deck.add('INTERFACES', (1, 2, 3, 'JOINTS', 'shaft'), (2 if stiffness else None, 4, 5, None if stiffness else 'BONDED'))
    deck.add('FIXEDFACES', (6, '111'))
    return deck.resultants((1, 'LATERAL', 0.5), (1, 'AXIAL', -0.2), (1, 'TORQUE', 0.1)).text()


def limit_of_stiff(nodes):
    """The peg moves as with joints in place of the bond, the difference falls like 1/k"""
    def check(folder, program):
        summary, bonded = run(program, folder, half_bonded(nodes, None))
        states = summary['joint_states']
        faults = [f'some state does not occur: {states}'] if 0 in states.values() else []
        errors = [largest_difference(run(program, folder, half_bonded(nodes, k))[1], bonded, 0.499) for k in (1e7, 1e8, 1e9)]
        for softer, stiffer in zip(errors, errors[1:]):
            if not 8.0 < softer/stiffer < 12.0:
                faults.append(f'differences {errors} do not fall like 1/k')
        return faults
    return check


def crack(law):
    """A penny-shaped crack of radius 1 in a cylinder of radius and height 20, pressed open from inside"""
    deck = scenes.Deck('A penny-shaped crack', 0, None).material(1, 1e3, 0.3).add('LAWS', law)
    fine, coarse = 1.0/40.0, 300.0
    for body, height, low, high in ((1, coarse, 0.0, 20.0), (2, 1.0/coarse, -20.0, 0.0)):
        deck.add('BLOCKS', (body, 1, 8, 10, 16, fine, height), (0.0, low, 1.0, high))
        deck.add('BLOCKS', (body, 1, 8, 14, 16, coarse, height), (1.0, low, 20.0, high))
        deck.faces((10*body + 1, body, 0.0, 0.0, 1.0, 0.0), (10*body + 2, body, 1.0, 0.0, 20.0, 0.0))
    deck.faces((5, 2, 0.0, -20.0, 20.0, -20.0))
    deck.add('INTERFACES', (1, 11, 21), (None, 12, 22, 'BONDED')).add('FIXEDFACES', (5, '010'))
    return deck.add('PRESSURES', (11, 0, 1.0), (21, 0, 1.0)).text()


def opens_like_sneddon(law):
    """Sneddon: opening 8 (1 - nu^2) p/(pi E) sqrt(1 - r^2); stresses at the tip like distance^-1/2"""
    def check(folder, program):
        summary, tables = run(program, folder, crack(law))
        middle = 8.0*(1.0 - 0.3**2)/(math.pi*1e3)
        points = sorted((row['r'], row['d_eta']) for row in tables['joints'] if row['theta'] == 0.0)
        faults = [f'opening {d} at r = {r}' for r, d in points
                  if r < 0.9 and not abs(d - middle*math.sqrt(1.0 - r**2)) <= CRACK_ERROR*middle]
        faults += expected('singular places', 1, len(summary['singular']))
        if not faults and not abs(summary['singular'][0]['exponent'] + 0.5) < 0.005:
            faults.append(f'singular: {summary["singular"]}')
        return faults
    return check


def two_elements(supported, loaded, moved):
    """Two bonded rings of one element each: nodes 2 and 11 are one, and 3 and 14"""
    deck = scenes.Deck('Two bonded rings', 1, 9).material(1, 4e4, 0.3).material(2, 1e4, 0.2)
    deck.add('NODES', (1, 0.5, 0.0), (2, 1.0, 0.0), (3, 1.0, 1.0), (4, 0.5, 1.0))
    deck.add('NODES', (11, 1.0, 0.0), (12, 1.5, 0.0), (13, 1.5, 1.0), (14, 1.0, 1.0))
    deck.add('ELEMENTS', (1, 1, 1, 1, 2, 3, 4), (2, 2, 2, 11, 12, 13, 14))
    deck.faces((2, 1, 1.0, 0.0, 1.0, 1.0), (3, 2, 1.0, 0.0, 1.0, 1.0)).add('INTERFACES', (None, 2, 3, 'BONDED'))
    deck.add('RESTRAINTS', *((node, code) for node, code in zip(supported, ('110', '001'))), (1, '111'))
    deck.add('RINGLOADS', *((node, 0, 0.1, 0.2) for node in loaded))
    return deck.add('MOVEDNODES', (moved, 1, None, 1e-3)).text()


def either_number(folder, program):
    """Supports, forces and displacements on either number act on the one node; those of both add up"""
    _, first = run(program, folder, two_elements((2, 2), (3, 3), 3))
    faults = []
    for cards in (((11, 11), (14, 14), 14), ((2, 11), (3, 14), 14), ((11, 2), (14, 3), 3)):
        error = largest_difference(run(program, folder, two_elements(*cards))[1], first)
        if not error <= 1e-12:
            faults.append(f'{cards}: displacements differ by {error:.1E}')
    nodes = [row['node'] for row in first['m = 0']]
    return faults + expected('nodes in the tables', [1, 2, 3, 4, 12, 13], nodes)


def bodies_that_touch(folder, program):
    """Two bodies bonded to a third touch without joints: between them is a slit, whose tip is named"""
    deck = scenes.Deck('A slit without joints', 0, None).material(1, 4e4, 0.3)
    deck.block(1, 1, 8, 2, 4, 0.5, 0.0, 1.0, 1.0).block(2, 1, 8, 2, 2, 1.0, 0.0, 1.5, 0.5)
    deck.block(3, 1, 8, 2, 2, 1.0, 0.5, 1.5, 1.0)
    deck.faces((1, 1, 1.0, 0.0, 1.0, 0.5), (2, 1, 1.0, 0.5, 1.0, 1.0), (3, 2, 1.0, 0.0, 1.0, 0.5),
               (4, 3, 1.0, 0.5, 1.0, 1.0), (7, 1, 0.5, 0.0, 0.5, 1.0), (8, 3, 1.5, 0.5, 1.5, 1.0))
    deck.add('INTERFACES', (None, 1, 3, 'BONDED'), (None, 2, 4, 'BONDED')).add('FIXEDFACES', (7, '111'))
    summary, tables = run(program, folder, deck.resultants((8, 'AXIAL', 1.0)).text())
    ends = sorted(row['v'] for row in tables['m = 0'] if (row['r'], row['z']) == (1.5, 0.5))
    faults = [] if len(ends) == 2 and ends[1] > 2.0*abs(ends[0]) else [f'the slit does not open: {ends}']
    tips = [place for place in summary['singular'] if (place['r'], place['z']) == (1.0, 0.5)]
    return faults + expected('tips', 1, len(tips))


# A pile without weight, bonded into ground with in-situ stress; its body has the card, if any
GROUND = '''CONTROL
0
MATERIALS
1,3E4,0.2,{density}
2,30,0.3,2E-3
BLOCKS
1,1,8,2,4
0,-3,0.5,0
2,2,8,5,4
0.5,-3,5,0
2,2,8,2,3
0,-5,0.5,-3
2,2,8,5,3
0.5,-5,5,-3
FACES
1,1,0.5,-3,0.5,0
2,2,0.5,-3,0.5,0
3,1,0,-3,0.5,-3
4,2,0,-3,0.5,-3
5,2,0,-5,5,-5
6,2,5,-5,5,0
INTERFACES
,1,2,BONDED
,3,4,BONDED
FIXEDFACES
5,111
6,101
GRAVITY
-9.81,
INSITU
2,0,0.01962,0.5
{card}END
'''


def in_situ_stress(folder, program):
    """The card of a body is of that alone, and not of another bonded to it: its weight and tractions on their boundary are looked at"""
    faults = []
    weight, jump = 'material 1: gamma = 0, -density g_z = 0.01962', 'in-situ stresses of bodies 1 and 2, which are bonded, do not match'
    for density, card, code, said in ((0.0, '', 2, (jump,)), (0.0, '1,0,0,0,,,MEANT\n', 0, ()), (2e-3, '', 2, (weight, jump)),
                                      (2e-3, '1,0,0.01962,0.5\n', 0, ()), (2e-3, '1,0,0.01962,1.5\n', 2, (jump,))):
        ran = program.run('check', write(folder, 'ground.dat', GROUND.format(density=density, card=card)))
        faults += ran.ended_with(code)
        faults += [f'density {density}, card {card!r}: {text!r}: {ran.err}' for text in (weight, jump) if ran.err.count(text) != (text in said)]
    return faults


def tests(program):
    """All tests"""
    def made(name, check):
        return Test(f'bonded/{name}', lambda folder: check(folder, program))

    return ([made('either number', either_number), made('bodies that touch', bodies_that_touch),
             made('in-situ stress', in_situ_stress)]
            + [made(f'one body, {nodes} nodes', one_body(nodes)) for nodes in (3, 4, 6, 8, 9)]
            + [made(f'stiff joints, {nodes} nodes', limit_of_stiff(nodes)) for nodes in (4, 8)]
            + [made('crack, contact', opens_like_sneddon((1, 1.0, 1.0, 1.0, 0.0, 0.0))),
               made('crack, soft elastic joint', opens_like_sneddon((1, 0.0, 1e-6, 0.0, None, None, 'ELASTIC')))])
