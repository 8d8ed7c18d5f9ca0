"""Told errors against what finer meshes and more harmonics change, where the ones at hand mislead: shafts that slip beside a toe that
bears, torque near what joints can carry, heat that hides bending; slip that turns round on the circle"""
import json
import os
import re

import hard_scenes as scenes
from support import Test, input_deck, read_text, write

# Least part of the change by half the elements that is told: the error is that change and what still finer meshes add to it; and of
# that by elements of a quarter of the size
LEAST = {2: 0.7, 4: 0.5}
# And most
MOST = 3.0


def pile(n, *, nodes, stiffness, friction, loads, weight=False, formulation='PLAIN', depth=10.0, outer=8.0, harmonic=0, toe=(1, 4, 5)):
    """A pile in ground, joints along its shaft and below its toe; `n` times as many elements along both sides"""
    deck = scenes.Deck('Pile', harmonic, None)
    deck.lines[-1] = f'{harmonic},,,,,{formulation}'
    deck.material(1, 2e4, 0.2, 2.4).material(2, 50.0, 0.3, 1.8).law(1, stiffness, 0.0, friction).details(1, slip='RESULTANT')
    below = 1.6*depth
    deck.block(1, 1, nodes, 2*n, 4*n, 0.0, -depth, 0.5, 0.0)
    deck.block(2, 2, nodes, 5*n, 4*n, 0.5, -depth, outer, 0.0, ratio=8.0).block(2, 2, nodes, 2*n, 2*n, 0.0, -below, 0.5, -depth)
    deck.block(2, 2, nodes, 5*n, 2*n, 0.5, -below, outer, -depth, ratio=8.0)
    deck.faces((1, 1, 0.0, 0.0, 0.5, 0.0), (2, 1, 0.5, -depth, 0.5, 0.0), (3, 2, 0.5, -depth, 0.5, 0.0), (4, 1, 0.0, -depth, 0.5, -depth),
               (5, 2, 0.0, -depth, 0.5, -depth), (6, 2, 0.0, -below, outer, -below), (7, 2, outer, -below, outer, 0.0))
    deck.add('INTERFACES', (1, 2, 3), toe).add('FIXEDFACES', (6, '111'), (7, '101'))
    if weight:
        deck.add('CASE', (1, 'weight')).add('GRAVITY', (-10.0,)).add('INSITU', (2, 0.0, 18.0, 0.6), (1, 0.0, 18.0, 0.6, None, None, 'MEANT'))
        deck.add('CASE', (2, 'loads'))
    deck.resultants(*((1, *load) for load in loads))
    if weight:
        deck.add('COMBINE', (1, 1, 1.0, 2, 1.0)).add('INCREMENTS', (1.0, None, None, 1), (1.0, None, None, 2))
    return deck.text()


def rod(n):
    """A rod on a plate that is held outside, heated and pulled"""
    deck = scenes.Deck('Heated rod', 0, None).add('MATERIALS', (1, 2e5, 0.3, 0.0, 1.2e-5))
    deck.block(1, 1, 4, 2*n, 7*n, 0.0, 0.0, 0.05, 0.3).block(1, 1, 4, 2*n, n, 0.0, 0.3, 0.05, 0.32)
    deck.block(1, 1, 4, 4*n, n, 0.05, 0.3, 0.3, 0.32).faces((1, 1, 0.0, 0.0, 0.05, 0.0), (2, 1, 0.3, 0.3, 0.3, 0.32))
    return deck.add('FIXEDFACES', (2, '111')).resultants((1, 'AXIAL', 0.002)).add('TEMPERATURES', (1, 0, 12.0)).text()


def tee(n):
    """A thin tube with a flange outside, both in long elements, pulled outwards: a frame of walls that are joined"""
    deck = scenes.Deck('Flange', 0, None)
    deck.lines[-1] = '0,17,2,2'
    deck.add('MATERIALS', (1, 2e5, 0.3)).block(1, 1, 8, n, 4*n, 1.95, 0.0, 2.0, 4.0).block(1, 1, 8, n, n, 1.95, 4.0, 2.0, 4.05)
    deck.block(1, 1, 8, n, 4*n, 1.95, 4.05, 2.0, 8.0).block(1, 1, 8, 2*n, n, 2.0, 4.0, 3.0, 4.05)
    deck.faces((1, 1, 1.95, 0.0, 2.0, 0.0), (2, 1, 1.95, 8.0, 2.0, 8.0), (3, 1, 3.0, 4.0, 3.0, 4.05))
    return deck.add('FIXEDFACES', (1, '111')).add('TRACTIONS', (2, 0, 1.0, 0.2), (3, 0, 0.0, 0.2)).text()


SCENES = {
    'shaft that slips, 4-node': lambda n: pile(n, nodes=4, stiffness=[2e3]*3, friction=20.0, loads=[('AXIAL', -2.0)], formulation='BBAR'),
    'shaft that slips, 8-node': lambda n: pile(n, nodes=8, stiffness=[2e3]*3, friction=20.0, loads=[('AXIAL', -2.0)]),
    'stiffer shaft': lambda n: pile(n, nodes=4, stiffness=[2e4]*3, friction=20.0, loads=[('AXIAL', -2.0)]),
    'torque': lambda n: pile(n, nodes=8, stiffness=[2e3]*3, friction=20.0, loads=[('AXIAL', -18.0), ('TORQUE', 18.0)], weight=True,
                             depth=2.0, outer=4.0, harmonic=1),
    'bonded toe': lambda n: pile(n, nodes=4, stiffness=[2e3]*3, friction=20.0, loads=[('AXIAL', -2.0)], toe=(None, 4, 5, 'BONDED')),
    'heated rod': rod,
    'tube with a flange': tee}


def told(scene, times):
    """A test: what is told of the mesh's part of the error of the largest displacement, and what finer elements change of it"""
    def check(folder, program):
        largest, error = [], None
        for n in (1, times):
            ran = program.run('run', write(folder, 'mesh.dat', scene(n)), '-o', folder)
            if ran.ended_with(0):
                return ran.ended_with(0)
            summary = json.loads(read_text(os.path.join(folder, 'mesh.json')))
            largest.append(summary['increments'][-1]['largest_displacement'])
            error = error or summary['errors']['discretization']['displacement']
        change = abs(largest[1] - largest[0])/largest[0]
        return [] if error is not None and LEAST[times]*change <= error <= MOST*change else [f'told {error}, {times} times finer: {change}']
    return check


# A card of INCREMENTS of inputs/monopile.dat: half of what pushes it goes
LET_GO = '      -0.5    1.0E-8         2\n'


def monopile(n, held=False):
    """The monopile of inputs/monopile.dat, pushed in its ground, perhaps held, and let go, with `n` times as many elements along both
    sides"""
    before, blocks, after = re.fullmatch(r'(.*\nBLOCKS[^\n]*\n)(.*?)(\nFACES.*)', input_deck('monopile.dat'), re.DOTALL).groups()
    lines = blocks.split('\n')
    for k in range(0, len(lines), 2):
        lines[k] = lines[k][:15] + ''.join(f'{n*int(lines[k][column:column + 5]):5d}' for column in (15, 20)) + lines[k][25:]
    return before + '\n'.join(lines) + (after.replace(LET_GO, LET_GO.replace('-0.5', ' 0.0') + LET_GO, 1) if held else after)


def slip_that_lasts(folder, program, held):
    """What the mesh left while loads were larger stays in the slip, and is told at the points with names"""
    found = []
    for n in (1, 2):
        ran = program.run('run', write(folder, 'mesh.dat', monopile(n, held)), '-o', folder)
        if ran.ended_with(0):
            return ran.ended_with(0)
        found.append(json.loads(read_text(os.path.join(folder, 'mesh.json')))['point_errors'])
    return [f'{own["name"]}: told {own["discretization"]}, changed {change}' for own, other in zip(*found)
            for change in [abs(other['displacement'] - own['displacement'])]
            if not LEAST[2]*change <= own['discretization'] <= MOST*change]


def harmonics_that_last(folder, program):
    """So is what harmonics left, if half of the load goes; where all of it does, errors are told as at least what they are"""
    found, words = [], []
    half = input_deck('monopile.dat').replace(LET_GO, '', 1)
    for deck in (half, half.replace('\n    4   17\n', '\n   16   65\n'), input_deck('monopile.dat')):
        ran = program.run('run', write(folder, 'pile.dat', deck), '-o', folder)
        if ran.ended_with(0):
            return ran.ended_with(0)
        summary = json.loads(read_text(os.path.join(folder, 'pile.json')))
        found.append(summary['point_errors'])
        words.append('displacement at least' in summary['errors']['in_words'])
    return [f'{own["name"]}: told {own["harmonics"]}, changed {change}' for own, other in zip(*found[:2])
            for change in [abs(other['displacement'] - own['displacement'])]
            if own['name'] != 'toe' and not LEAST[2]*change <= own['harmonics'] <= MOST*change] + (  # which turns aside
                [] if words == [False, False, True] else [f'at least: half of the load gone {words[:2]}, all {words[2]}'])


def lining(harmonic):
    """A lining in ground that presses it more from above than from the sides; it slips both ways from its crown"""
    deck = scenes.Deck('Lining', harmonic, None).material(1, 2e4, 0.2).material(2, 100.0, 0.3).law(1, [1e4]*3, 0.0, 10.0)
    deck.details(1, slip='RESULTANT').block(1, 1, 8, 2, 1, 2.8, 0.0, 3.0, 0.5).block(2, 2, 8, 10, 1, 3.0, 0.0, 30.0, 0.5, ratio=15.0)
    deck.faces((1, 1, 3.0, 0.0, 3.0, 0.5), (2, 2, 3.0, 0.0, 3.0, 0.5), (3, 2, 30.0, 0.0, 30.0, 0.5), (4, 1, 2.8, 0.0, 3.0, 0.0),
               (5, 1, 2.8, 0.5, 3.0, 0.5), (6, 2, 3.0, 0.0, 30.0, 0.0), (7, 2, 3.0, 0.5, 30.0, 0.5))
    deck.add('INTERFACES', (1, 1, 2)).add('FIXEDFACES', *((face, '010') for face in (4, 5, 6, 7)))
    return deck.add('TRACTIONS', (3, 0, -0.75, 0.0, 0.0), (3, 2, 0.25, 0.0, -0.25)).text()


def turns_round(folder, program):
    """Where slip turns round, pressure has a peak that each doubling of M raises by as much again"""
    largest, error = [], None
    for harmonic in (4, 128):
        ran = program.run('run', write(folder, 'lining.dat', lining(harmonic)), '-o', folder)
        if ran.ended_with(0):
            return ran.ended_with(0)
        summary = json.loads(read_text(os.path.join(folder, 'lining.json')))
        largest.append(summary['increments'][-1]['largest_pressure'])
        error = error or summary['errors']['harmonics']['joint_stress']
    change = abs(largest[1] - largest[0])/largest[0]
    return [] if 0.5*change <= error <= 2.0*change else [f'told {error}, up to M = 128: {change}']


def tests(program):
    """The tests of this module"""
    return [Test(f'halved: {name}', lambda folder, check=told(scene, 4 if scene is rod else 2): check(folder, program))
            for name, scene in SCENES.items()] + [
                Test('halved: slip that turns round', lambda folder: turns_round(folder, program)),
                *(Test(f'halved: slip that lasts{words}', lambda folder, held=held: slip_that_lasts(folder, program, held))
                  for words, held in (('', False), (', loads held', True))),
                Test('halved: harmonics of slip that lasts', lambda folder: harmonics_that_last(folder, program))]
