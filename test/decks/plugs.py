"""Bodies that joints alone hold, in holes of another: what holds none, what stays elastic, loads that are taken away,
little friction; and scenes drawn at random, each of which ends with a state or a mechanism"""
import json
import os
import random
import re

from hard_decks import close, solved
from hard_scenes import Deck
from support import INPUTS, Test, expected, read_text, write

# What is drawn at random
SCENES, SEED = 60, 20261126


def plug(title, loads, *, stiffness, friction, cohesion=0.0, details=None, young=(2e4, 2e4), poisson=(0.2, 0.2), expansion=0.0, inner=0.0, below=0.5,
         above=0.5, outer=2.0, height=1.0, head=0.0, nodes=8, across=(2, 3), along=4, harmonic=2, planes=None, method='NEWTON'):
    """A plug (body 1, face 1 its top), perhaps with a head above, in the hole of a block that is held outside"""
    deck = Deck(title, harmonic, planes, method)
    for number in (0, 1):
        deck.material(number + 1, young[number], poisson[number], 0.0, expansion)
    deck.law(1, stiffness, cohesion, friction)
    if details is not None:
        deck.details(1, **details)
    deck.block(1, 1, nodes, across[0], along, inner, 0, below, 0, above, height, inner, height)
    if head > 0.0:
        deck.block(1, 1, nodes, across[0], 1, inner, height, above, height + head)
    deck.block(2, 2, nodes, across[1], along, below, 0, outer, 0, outer, height, above, height)
    deck.faces((1, 1, inner, height + head, above, height + head), (2, 1, below, 0, above, height), (3, 2, below, 0, above, height),
               (4, 2, outer, 0, outer, height))
    deck.add('INTERFACES', (1, 2, 3)).add('FIXEDFACES', (4, '111'))
    return deck.resultants(*((1, *load) for load in loads))


def even(k):
    """The same stiffness along xi, eta, theta"""
    return (k, k, k)


def nothing_holds(program, folder):
    """A plug with a gap round it, pulled along its own axis, never touches, whatever the unit of length"""
    faults = []
    for size in (0.1, 0.31, 1.0, 3.7, 10.0):
        deck = plug('A plug that nothing holds', [('AXIAL', 1.0)], stiffness=even(2.1e5), friction=30.0, young=(2.1e5, 2.1e5),
                    details={'slip': 'COMPONENTS', 'gap': 0.002*size}, below=0.2*size, above=0.2*size, outer=0.8*size,
                    height=0.9*size, nodes=9, along=3)
        summary, _ = solved(program, folder, 'free', deck.text(), code=4)
        faults += [] if 'moves along z' in str(summary['messages']) else [f'size {size}: {summary["messages"]}']
    return faults


def stays_elastic(program, folder):
    """A tapered plug with pressure round it, all of which sticks: displacements in proportion to the load, stiff joints or not"""
    faults = []
    for k in (2e5, 7.9e5, 8e5, 4e6):
        for method in ('NEWTON', 'ANDERSON'):
            found = []
            for load in (0.25, 0.5, 1.0):
                deck = plug('Pressed round', [('AXIAL', load)], stiffness=even(k), friction=30.0, above=0.55, harmonic=0, method=method,
                            details={'initial': -2.0})
                summary, tables = solved(program, folder, 'taper', deck.text())
                found.append(max(abs(row['v']) for row in tables['m = 0'])/load)
                faults += expected(f'k = {k}, {method}: points that slip', 0, summary['joint_states']['slip'])
            faults += close(f'k = {k}, {method}: displacement', found[0], max(found, key=lambda u: abs(u - found[0])), 1e-6*found[0])
    return faults


def taken_back(program, folder):
    """A cone is pressed in, a part of the load taken back: friction turns, takes no work out, and steps hardly matter"""
    found = []
    for steps in (1, 2, 4, 10):
        deck = plug('A cone', [('AXIAL', -3.84179)], stiffness=(1.35648e6, 1.35648e7, 1.35648e7), friction=40.0, inner=0.2, below=0.7,
                    above=0.892382, young=(287.348, 76673.4), poisson=(0.45, 0.3), across=(2, 1), along=2, harmonic=0,
                    details={'slip': 'COMPONENTS'})
        deck.add('INCREMENTS', (1.0,), *steps*[(-0.270621/steps,)])
        summary, _ = solved(program, folder, 'cone', deck.text())
        series = summary['increments']
        if any(after['dissipated'] < 0.999*before['dissipated'] for before, after in zip(series, series[1:])):
            return [f'{steps} steps: friction does work: {[now["dissipated"] for now in series]}']
        found.append(series[-1]['largest_displacement'])
    return [fault for u in found for fault in close('displacement', found[-1], u, 1e-3*found[-1])]


def all_taken_back(program, folder):
    """Loads come, and all go again: what is left is nothing, and no error is a part of it"""
    faults = []
    for loads, options in (([('MOMENT', 0.04)], {'friction': 45.0}), ([('MOMENT', -0.02), ('LATERAL', 0.01)], {'friction': 5.0}),
                           ([('TORQUE', -0.007)], {'friction': 20.0, 'cohesion': 0.05}), ([('LATERAL', 0.3)], {'friction': 0.0})):
        deck = plug('Loaded and not', loads, stiffness=(1e4, 2e4, 1e4), **options)
        deck.add('INCREMENTS', *((factor,) for factor in (0.3, 0.3, 0.4, -1.0)))
        summary, _ = solved(program, folder, 'back', deck.text())
        faults += expected('status', 'converged', summary['status'])
        left, most = (summary['increments'][k]['largest_displacement'] for k in (3, 2))
        faults += [] if left <= 0.3*most else [f'{loads}: {left:.2E} is left of {most:.2E}']
    return faults


def stands_where_it_was_left(program, folder):
    """All loads go: the peg stays where they left it, however strict the tolerance, and goes on from there"""
    faults = []
    for more in ([], ['0.1']):
        found = []
        for tolerance in ('1E-6', '1E-8', '1E-9', '1E-10'):
            steps = [f'{factor}, {tolerance}' for factor in ['1.0', '-1.0', *more]]
            summary, _ = solved(program, folder, 'left', first('1, 1.0E4, 2.0E4, 1.0E4, 0.0, 30', 'INCREMENTS', *steps))
            found.append([increment['largest_displacement'] for increment in summary['increments']])
        for most, left, *_ in found:
            faults += [] if left > 0.05*most else [f'the peg jumps back: {left:.3E} is left of {most:.3E}']
        faults += [fault for u in found for fault in close(f'displacement of the last of {len(u)} steps', found[-1][-1], u[-1],
                                                           0.01*found[-1][-1])]
    return faults


def wholly_unloaded(program, folder):
    """All loads go where a little of them finds no equilibrium, and where joints that are judged carried nothing"""
    faults = []
    scenes = ({'loads': [('AXIAL', 0.0253), ('MOMENT', -0.0504)], 'stiffness': (25.12, 251.2, 25.12), 'friction': 15.0, 'cohesion': 0.05,
               'young': (42801.27, 167.397), 'poisson': (0.1013, 0.27154), 'details': {'gap': 2.0288e-4}, 'nodes': 4, 'harmonic': 3},
              {'loads': [('AXIAL', 0.0731437)], 'stiffness': (18351354.8, 183513548.0, 18351354.8), 'friction': 30.0, 'cohesion': 0.5,
               'young': (387776.886, 19618.4246), 'poisson': (0.394333, 0.155922), 'nodes': 8, 'harmonic': 1})
    for number, scene in enumerate(scenes):
        deck = plug('Wholly unloaded', **scene)
        deck.add('INCREMENTS', (1.0,), (-1.0,))
        summary, _ = solved(program, folder, 'wholly', deck.text())
        faults += expected(f'scene {number}: status', 'converged', summary['status'])
    return faults


def slides_freely(program, folder):
    """Without friction the peg slides along its axis as it likes: no error is told by where it goes, nor is one by rounding"""
    faults, found = [], []
    for held in ([], ['FIXEDFACES', '1, 010, 0, 0']):
        of_changes = []
        for change in range(12):
            law = f'1, 1.0E4, 2.0E4, {1e4*(1.0 + change*1e-12):.14E}, 0.0, 0.0'
            summary, _ = solved(program, folder, 'slides', first(law, *held))
            of_changes.append([summary['errors']['sum'][name] for name in ('displacement', 'joint_stress')])
        for errors in zip(*of_changes):
            faults += [fault for error in errors for fault in close('estimated error', errors[0], error, 1e-4*errors[0])]
        found.append(of_changes[0][0])
    faults += close('estimated error, held along the axis and not', found[1], found[0], 0.1*found[1])
    return faults


def needs_no_load(program, folder):
    """A displacement is given along which nothing resists: it is reached, by no load"""
    faults = []
    for loads, details in (([('AXIAL', 1.0)], None), ([('LATERAL', 1.0)], {'gap': 0.01})):
        deck = plug('Goes by itself', loads, stiffness=even(2e4), friction=0.0, details=details, harmonic=1)
        deck.add('YIELD', (2, 'MISES', 1e9)).add('INCREMENTS', *3*[(1.0, None, None, None, 'DISPLACEMENT')])
        summary, _ = solved(program, folder, 'goes', deck.text())
        found = [increment['largest_displacement'] for increment in summary['increments']]
        faults += [fault for k in (1, 2) for fault in close(f'{loads}: displacement', (k + 1)*found[0], found[k], 1e-3*found[k])]
        faults += [f'{loads}: a load factor of {increment["load_factor"]:.1E}' for increment in summary['increments']
                   if abs(increment['load_factor']) > 1e-8]
    return faults


def never_yields(program, folder):
    """A criterion that nothing reaches changes nothing, beside joints with gap and cohesion"""
    faults = []
    for load in (0.003, 0.03, 0.3):
        found = []
        for strength in (None, 1e9):
            deck = plug('Never yields', [('LATERAL', 100*load)], stiffness=even(1e6), friction=0.0, cohesion=25.0, young=(3e7, 3e4),
                        poisson=(0.2, 0.45), details={'gap': 0.002}, outer=10.0, height=5.0, across=(1, 4), along=4, harmonic=3)
            if strength:
                deck.add('YIELD', (2, 'MISES', strength))
            summary, _ = solved(program, folder, 'never', deck.text())
            found.append(summary['increments'][-1]['largest_displacement'])
        faults += close(f'load {load}: displacement', found[0], found[1], 1e-5*found[0])
    return faults


def want_of_iterations(program, folder):
    """One iteration is not enough for joints beside bodies that may yield: that is said, and nothing of a mechanism"""
    deck = plug('One iteration', [('LATERAL', 0.3)], stiffness=(1e4, 2e4, 1e4), friction=30.0)
    deck.add('YIELD', (2, 'MISES', 1e9)).add('INCREMENTS', (1.0, 1e-6, 1))
    summary, _ = solved(program, folder, 'one', deck.text(), code=3)
    return [] if 'INCREMENTS allows no more iterations' in str(summary['messages']) else [str(summary['messages'])]


def rounds_foretold(program, folder):
    """What a job with an error target is said to take is that of its last round"""
    found = []
    for more in ([], ['ERROR', '0.1,']):
        path = write(folder, 'told.dat', first('1, 1.0E4, 2.0E4, 1.0E4, 0.0, 30.0', *more))
        text = program.run('estimate', path, '--threads', '1').out
        found.append([float(value) for value in re.findall(r'^  (?:memory|files) +([0-9.]+) MB', text, re.MULTILINE)])
    (memory, files), (more_memory, more_files) = found
    return [] if more_memory > memory and more_files > 5*files else [f'{found}']


def nothing_opens(program, folder):
    """A torque on joints with cohesion, none of which is pressed or pulled: elastic, in any number of steps"""
    faults = []
    for steps in (1, 2, 5):
        deck = plug('Bonded', [('TORQUE', -0.02)], stiffness=(28061.0, 56123.0, 28061.0), cohesion=0.05, friction=0.0, young=(4.6e5, 2e4))
        deck.add('INCREMENTS', *steps*[(1.0/steps,)])
        summary, _ = solved(program, folder, 'bonded', deck.text())
        if summary['iterations'] > 2*steps or summary['joint_states']['slip'] > 0:
            faults.append(f'{steps} steps: {summary["iterations"]} iterations, {summary["joint_states"]}')
    return faults


def first(law, *more):
    """The deck of the README with another law"""
    card = '    1     1.0E4     2.0E4     1.0E4       0.0      30.0'
    text = read_text(os.path.join(INPUTS, 'first.dat'))
    if card not in text:
        raise AssertionError('first.dat has another law')
    text = text.replace(card, law)
    return text.replace('\nEND', ''.join('\n' + line for line in more) + '\nEND')


def little_friction(program, folder):
    """The first deck with next to no friction has a state"""
    faults = []
    for angle in (0.2, 0.5, 1.0, 1.5, 3.0):
        summary, _ = solved(program, folder, 'first', first(f'1, 1.0E4, 2.0E4, 1.0E4, 0.0, {angle}'))
        faults += expected(f'{angle} degrees', 'converged', summary['status'])
    return faults


def dilates(program, folder):
    """Cohesion beside dilation: a point that slides up does not count as one that opens"""
    faults = []
    for steps in (['1.0'], ['0.5', '0.5']):
        summary, _ = solved(program, folder, 'first', first('1, 1.0E4, 2.0E4, 1.0E4, 0.1, 30', 'LAWDETAILS', '1, RESULTANT, , , , 5.0',
                                                            'INCREMENTS', *(f'{step},' for step in steps)))
        faults += expected(f'{len(steps)} steps', 'converged', summary['status'])
    return faults


def in_proportion(program, folder):
    """Without cohesion, gap and stress before, a state grows with the load, however it was found"""
    faults, found = [], []
    for load in (0.125, 1.0, 8.0):
        deck = plug('Pressed and hot', [('AXIAL', -3.0697*load)], stiffness=(1.84344e8, 1.84344e9, 1.84344e8), friction=30.0,
                    young=(7423.88, 336.006), outer=1.5, head=0.4, nodes=4, across=(1, 1), along=1, harmonic=0, poisson=(0.0, 0.0), expansion=1e-5,
                    details={'slip': 'COMPONENTS'})
        deck.add('TEMPERATURES', (2, 0, 571.157*load))
        _, tables = solved(program, folder, 'hot', deck.text())
        found.append([row[c]/load for row in tables['m = 0'] for c in 'uv'])
    largest = max(map(abs, found[1]))
    for other in (found[0], found[2]):
        faults += [f'{a} and {b}' for a, b in zip(found[1], other) if abs(a - b) > 1e-5*largest]
    return faults


def no_friction_unloaded(program, folder):
    """Without friction, pressed before and by the load, which is taken away: the stress before is no stress that is left"""
    deck = plug('Unloaded', [('MOMENT', -0.06)], stiffness=(2335.63, 4671.27, 467.127), friction=0.0, details={'initial': -0.44},
                young=(328.156, 107.082), poisson=(0.45, 0.2), head=0.5, nodes=8, along=2, harmonic=2)
    text = deck.add('SPRINGS', (1, 10.0, 10.0, 10.0)).add('INCREMENTS', (1.0, 1e-8), (-1.0, 1e-8)).text()
    summary, _ = solved(program, folder, 'unloaded', text)
    return expected('status', 'converged', summary['status'])


def let_go(program, folder):
    """A hot cone is pressed in, then cold and let go: it stands free of all joints, where rounding is no force that moves it"""
    deck = plug('Let go', [('AXIAL', -0.312719)], stiffness=(5953.74, 11907.5, 11907.5), friction=25.0, below=0.7, above=1.09913, nodes=9,
                young=(116.445, 10226.8), poisson=(0.3, 0.2), expansion=1e-5, inner=0.2, across=(1, 3), along=2, harmonic=0,
                details={'slip': 'COMPONENTS'})
    deck.add('TEMPERATURES', (1, 0, 503.015)).add('INCREMENTS', (1.0, 1e-5), (-1.0, 1e-5))
    summary, _ = solved(program, folder, 'let_go', deck.text().replace('4, 2, 2, 0, 2, 1\n', '4, 2, 0.7, 0, 2, 0\n'))
    return expected('status', 'converged', summary['status']) + expected('points that touch', 0, summary['joint_states']['stick'])


def far_beyond(program, folder):
    """The monopile under a million times its wind: joints carry next to nothing of the load, yet their state is found to the tolerance"""
    text = re.sub(r'(LATERAL|MOMENT)( +)(-?[\d.]+)', lambda found: f'{found[1]}{float(found[3])*1e6:{len(found[2]) + len(found[3])}.2E}',
                  read_text(os.path.join(INPUTS, 'monopile.dat')))
    summary, _ = solved(program, folder, 'far', text)
    moved = summary['increments'][-1]['largest_displacement']
    return expected('status', 'converged', summary['status']) + ([] if moved > 10.0 else [f'moved by {moved} only'])


def rules_in_ground(program, folder):
    """Points at nodes do not integrate in-situ stress as bodies do: that is said, once for a law"""
    text = read_text(os.path.join(INPUTS, 'monopile.dat'))
    law = next(line for line in text.split('\n') if line.startswith('LAWS') or 'LAWS' in line)
    lines = text.split('\n')
    card = lines.index(law) + 1
    lines[card] = lines[card].ljust(65)[:65] + 'LOBATTO'
    ran = program.run('check', write(folder, 'rules.dat', '\n'.join(lines)), folder=folder)
    said = (ran.out + ran.err).count('points of LOBATTO do not integrate in-situ stress')
    return ran.ended_with(0) + expected('warnings', 1, said)


def drawn(generator):
    """A scene drawn at random"""
    choose, uniform = generator.choice, generator.uniform
    harmonic = choose((1, 2, 4))
    young = (2e4*10**choose((0, 0, uniform(-4, 4))), 2e4*10**choose((0, 0, uniform(-3, 3))))
    k = 1e4*10**choose((0, uniform(-3, 3), uniform(-1, 1)))
    loads = [(kind, choose((1, -1))*0.4*10**uniform(-2, 1))
             for kind in generator.sample(('LATERAL', 'AXIAL', 'MOMENT', 'TORQUE'), choose((1, 1, 2, 3)))]
    deck = plug('Drawn', loads, stiffness=(k, 2*k, k), friction=choose((0.0, 5.0, 20.0, 30.0, 45.0)),
                cohesion=choose((0.0, 0.0, 0.0, 0.05)), young=young, nodes=choose((4, 8)), harmonic=harmonic, head=choose((0.0, 0.5)),
                above=choose((0.5, 0.5, 0.6)), planes=choose((4*harmonic + 1, 4*harmonic + 2)))
    steps = choose((None, (1.0,), (0.5, 0.5), (1.0, -0.5, 0.5), (0.3, 0.3, 0.4, -1.0)))
    return (deck if steps is None else deck.add('INCREMENTS', *((step,) for step in steps))).text()


def at_random(program, folder):
    """Each scene ends with a state in equilibrium, or with a mechanism that is named; one, whose law loses its cohesion
    at once, with points that change their state for ever, where no mechanism is shown"""
    generator, faults, ends, restless = random.Random(SEED), [], {0: 0, 4: 0}, 0
    for number in range(SCENES):
        path = write(folder, f'drawn{number}.dat', drawn(generator))
        ran = program.run('run', path, '-o', folder, '--threads', '1')
        with open(path[:-3] + 'json', encoding='utf-8') as file:
            summary = json.load(file)
        if ran.code == 3 and any('change their state for ever' in text and 'try BOND' in text for text in summary['messages']):
            restless += 1
            continue
        if ran.code not in ends:
            faults.append(f'scene {number}: exit code {ran.code}: {summary["messages"]}')
            continue
        ends[ran.code] += 1
        if ran.code == 0 and not summary['part_equilibrium_error'] <= 1e-5:
            faults.append(f'scene {number}: forces of {summary["part_equilibrium_error"]:.1E} are out of balance')
        if ran.code == 4 and not any('no equilibrium was found beyond' in text for text in summary['messages']):
            faults.append(f'scene {number}: no mechanism is named: {summary["messages"]}')
    faults += [] if restless <= 1 else [f'{restless} scenes find no end']
    return faults + ([] if min(ends.values()) >= SCENES//6 else [f'too much of one kind: {ends}'])


def tests(program):
    """The tests of this module"""
    named = {'nothing holds': nothing_holds, 'all sticks': stays_elastic, 'a part taken back': taken_back,
             'all taken back': all_taken_back, 'stands where it was left': stands_where_it_was_left,
             'wholly unloaded': wholly_unloaded, 'slides freely': slides_freely, 'needs no load': needs_no_load,
             'want of iterations': want_of_iterations, 'rounds foretold': rounds_foretold, 'never yields': never_yields,
             'nothing opens': nothing_opens, 'little friction': little_friction, 'dilation and cohesion': dilates,
             'in proportion': in_proportion, 'let go': let_go, 'far beyond': far_beyond,
             'unloaded without friction': no_friction_unloaded, 'rules in the ground': rules_in_ground, 'at random': at_random}
    return [Test(f'plugs: {name}', lambda folder, function=function: function(program, folder)) for name, function in named.items()]
