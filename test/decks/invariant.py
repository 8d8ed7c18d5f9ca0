"""One job told in other words: other units, mirrored, turned about the axis, with other numbers of nodes and bodies, other
sides of the joints, in other circumstances

The scene is a pile in two layers of ground, pressed, then pushed sideways and twisted, so that both families of harmonics
are there: joints that slip with friction, stand open, and one that closes a gap, in a history of four increments. Where
floating-point numbers are the same, so must be the results, bit by bit; where they are others, they may differ by
rounding (`BAR`). The results of every increment are compared by `read_invariant.py`, where NumPy and h5py are installed.
Each comparison is also made in a way that is slightly wrong, which it must find.
"""
import json
import os
import random
import subprocess

from hard_scenes import LENGTH, METRE, STRESS, UNITS, WEIGHT, Deck
from same_bits import digests
from support import HERE, Test, preload, python_with, read_text, write

# Largest difference of displacements, relative displacements and stresses of joints, over the largest of each
BAR = 1e-9
# Body, material, cells along r and z, opposite corners
RECTANGLES = ((1, 1, 2, 3, 0, -2, 0.5, 0), (1, 1, 2, 2, 0, 0, 0.5, 1), (2, 2, 2, 3, 0.5, -2, 2, 0), (2, 3, 2, 1, 0, -3, 0.5, -2),
              (2, 3, 2, 1, 0.5, -3, 2, -2), (3, 1, 1, 1, 0.5, 0.5, 1, 1))
# Faces: body and end points
SHAFT, TOE, COLLAR = (0.5, -2, 0.5, 0), (0, -2, 0.5, -2), (0.5, 0.5, 0.5, 1)
FACES = {1: (1, 0, 1, 0.5, 1), 2: (1, *SHAFT), 3: (2, *SHAFT), 4: (1, *TOE), 5: (2, *TOE), 6: (1, *COLLAR), 7: (3, *COLLAR),
         8: (2, 0, -3, 2, -3), 9: (2, 2, -3, 2, 0), 10: (3, 1, 0.5, 1, 1)}
HARMONICS, PLANES = 3, 13


class Words:
    """How the scene is told"""

    def __init__(self, units=METRE, mirrored=False, turn=0.0, seed=None, bodies=(1, 2, 3), swapped=False, load=1.0):
        self.units, self.turn, self.bodies, self.swapped, self.load = units, turn, bodies, swapped, load
        self.up = -1 if mirrored else 1
        self.numbers = None if seed is None else random.Random(seed)

    def body(self, number):
        """Its number in the deck"""
        return self.bodies[number - 1]

    def ends(self, corners):
        """Pairs of r and z, mirrored if all is"""
        return [self.up*x if k % 2 else x for k, x in enumerate(corners)]

    def mesh(self, deck):
        """Blocks in the order of the bodies' numbers; or the same mesh node by node, with numbers by chance"""
        if self.numbers:
            return self.single(deck)
        for body, material, n1, n2, *corners in sorted(RECTANGLES, key=lambda rectangle: self.body(rectangle[0])):
            deck.block(self.body(body), material, 8, n1, n2, *self.ends(corners))

    def single(self, deck):
        """Nodes and 8-node elements in any order, elements from any corner"""
        dice, places, elements = self.numbers, {}, []
        labels = iter(dice.sample(range(1, 99999), 999))
        for body, material, n1, n2, r1, z1, r2, z2 in RECTANGLES:
            def node(i, j):
                place = (body, round(r1 + (r2 - r1)*i/(2*n1), 9), self.up*round(z1 + (z2 - z1)*j/(2*n2), 9))
                return places.setdefault(place, None) or places.update({place: next(labels)}) or places[place]
            for i in range(0, 2*n1, 2):
                for j in range(0, 2*n2, 2):
                    ring = [node(i + a, j + b) for a, b in ((0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1))]
                    first = dice.randrange(0, 8, 2)
                    ring = [ring[(first + self.up*k) % 8] for k in range(8)]  # counterclockwise
                    elements.append((material, self.body(body), *ring))
        nodes = [(label, (float(r), LENGTH), (float(z), LENGTH)) for (_, r, z), label in places.items()]
        dice.shuffle(nodes)
        dice.shuffle(elements)
        deck.add('NODES', *nodes)
        deck.add('ELEMENTS', *((number, *element) for number, element in zip(dice.sample(range(1, 9999), len(elements)), elements)))

    def text(self):
        """The deck"""
        deck = Deck('A pile, pressed, pushed and twisted', HARMONICS, PLANES, units=self.units)
        deck.add('MATERIALS', *((number, (young, STRESS), ratio, (0.02, WEIGHT)) for number, young, ratio in (
            (1, 2e3, 0.2), (2, 50.0, 0.3), (3, 200.0, 0.25))))
        deck.law(1, (200.0, 400.0, 100.0), 0.002, 25.0).law(2, (500.0, 500.0, 500.0), 0.0, 35.0).law(3, (1e3, 1e3, 1e3), 0.0, 15.0)
        deck.details(1, residual=(0.0, 20.0), initial=-0.02).details(2).details(3, gap=2e-4)
        self.mesh(deck)
        deck.faces(*((number, self.body(body), *self.ends(ends)) for number, (body, *ends) in FACES.items()))
        order = (lambda a, b: (b, a)) if self.swapped else lambda a, b: (a, b)
        deck.add('INTERFACES', (1, *order(2, 3)), (2, *order(4, 5)), (3, *order(6, 7)))
        deck.add('FIXEDFACES', (8, '111'), (9, '111'), (10, '111'))
        deck.add('CASE', (1, 'weight')).add('GRAVITY', (-1.0*self.up,)).resultants((1, 'AXIAL', -0.05*self.up))
        deck.add('CASE', (2, 'pushed')).resultants(
            (1, 'LATERAL', 0.06*self.load, 15.0 + self.turn), (1, 'MOMENT', 0.01*self.up, 70.0 + self.turn), (1, 'TORQUE', 0.005))
        deck.add('COMBINE', (1, 1, 1.0, 2, 1.0))
        return deck.add('INCREMENTS', *((factor, 1e-11, 200, case) for factor, case in (
            (1.0, 1), (0.5, 2), (0.5, 2), (-0.6, 2)))).text()


def solved(program, folder, name, deck, *options, **environment):
    """Run a deck: path of its results without their endings"""
    path = write(folder, f'{name}.dat', deck)
    done = subprocess.run([program.path, 'run', path, '-o', os.path.join(folder, 'out'), *options],
                          env=dict(program.environment, **environment), capture_output=True, text=True, check=False, timeout=60)
    if done.returncode != 0:
        raise AssertionError(f'exit code {done.returncode}\n{done.stderr}')
    return os.path.join(folder, 'out', name)


def scene_is_worth_it(summary):
    """Faults unless joints hold, slip and are open, and both families are there"""
    states, families = json.loads(read_text(summary))['joint_states'], json.loads(read_text(summary))['families']
    return ([] if min(states.values()) > 0 else [f'expected points that stick, slip and are open, found {states}']) + (
        [] if len(set(families)) == 2 else ['expected both families'])


def same(program, folder, told, motion, wrong):
    """Faults unless a scene told in other words has the same results, and unless wrong ones are seen. The motion says how
    the results differ: powers of the units, `mirrored`, `turn` [degree], `swapped`"""
    one, other = solved(program, folder, 'one', Words().text()), solved(program, folder, 'other', told.text())
    faults = scene_is_worth_it(one + '.json')
    python = python_with('numpy, h5py')
    if python is None:
        return faults
    for changes in (motion, {**motion, **wrong}):
        done = subprocess.run([python, '-B', os.path.join(HERE, 'read_invariant.py'), one + '.h5', other + '.h5', json.dumps(changes)],
                              capture_output=True, text=True, check=False)
        if done.returncode:
            return faults + [done.stderr]
        found = json.loads(done.stdout)
        if changes == motion and not max(found.values()) <= BAR:
            faults.append(f'differences above {BAR:g}: {found}')
        if changes != motion and not max(found.values()) > 10*BAR:
            faults.append(f'what is wrong by {wrong} is not seen: {found}')
    return faults


def same_hash(program, folder, circumstances):
    """Faults unless all bits of the results are the same, and unless another load gives others"""
    wanted = solved(program, os.path.join(folder, 'first'), 'job', Words().text())
    found = solved(program, os.path.join(folder, 'again'), 'job', Words().text(), *circumstances.get('options', ()),
                   **circumstances.get('environment', {}))
    other = solved(program, os.path.join(folder, 'other'), 'job', Words(load=1 + 1e-11).text())
    one, two, three = digests([wanted, found, other])
    return ([] if one == two else ['other bits']) + ([] if one != three else ['another load has the same bits'])


def german(program, folder):
    """A decimal comma in the locale, which is set as in a program that carries axijoint"""
    place = os.path.join(folder, 'locales')
    os.mkdir(place)
    made = subprocess.run(['localedef', '-i', 'de_DE', '-f', 'UTF-8', os.path.join(place, 'de_DE.UTF-8')], capture_output=True,
                          text=True, check=False) if os.path.exists('/usr/share/i18n/locales/de_DE') else None
    if made is None or made.returncode:
        print('invariant: de_DE is left out, as the sources of locales (Debian: locales) are not installed')
        return []
    return same_hash(program, folder, {'environment': {
        'LOCPATH': place, 'LC_ALL': 'de_DE.UTF-8', 'LANG': 'de_DE.UTF-8', 'LD_PRELOAD': preload('user_locale')}})


def blanks(program, folder):
    """Blanks at both ends of a deck's name and of folders belong to them"""
    deck, plain = Words().text(), os.path.join(folder, 'plain')
    wanted = solved(program, plain, 'job', deck)
    place = os.path.join(folder, ' in ')
    for name, out in (('job', ' out '), ('job ', 'out')):
        path = write(place, name + '.dat' if name == 'job' else name, deck)
        ran = program.run('run', os.path.basename(path), '-o', out, folder=place)
        if ran.code != 0:
            return [f'{name!r}, {out!r}: exit code {ran.code}: {ran.err}']
        stem = os.path.join(place, out, name)
        if not os.path.exists(stem + '.h5'):
            return [f'{stem!r}.h5 is not there, but {sorted(os.walk(place))}']
        one, two = digests([wanted, stem])
        if one != two:
            return [f'{name!r}, {out!r}: other bits']
    return [f'left: {name!r}' for name in os.listdir(place) if name not in ('job.dat', 'job ', 'out', ' out ')]


def tests(program):
    """One test a change of words"""
    told = {
        'mm-N': (Words(UNITS[1]), {'length': UNITS[1].length, 'force': UNITS[1].force}, {'force': UNITS[1].force*(1 + 1e-7)}),
        'ft-kip': (Words(UNITS[2]), {'length': UNITS[2].length, 'force': UNITS[2].force}, {'length': UNITS[2].length*(1 + 1e-7)}),
        'mirrored': (Words(mirrored=True), {'mirrored': True}, {'mirrored': False}),
        'turned by 90 degrees': (Words(turn=90.0), {'turn': 90.0}, {'turn': 90.00001}),
        'turned by a plane': (Words(turn=180.0/(PLANES - 1)), {'turn': 180.0/(PLANES - 1)}, {'turn': 0.0}),
        'other numbers': (Words(seed=3), {}, {'numbered': True}),
        'other bodies': (Words(bodies=(3, 1, 2)), {'bodies': (3, 1, 2)}, {'bodies': (1, 2, 3)}),
        'other sides': (Words(swapped=True), {'swapped': True}, {'swapped': False}),
        'all at once': (Words(UNITS[2], True, 45.0, 8, (2, 3, 1), True),
                        {'length': UNITS[2].length, 'force': UNITS[2].force, 'mirrored': True, 'turn': 45.0, 'bodies': (2, 3, 1), 'swapped': True},
                        {'swapped': False}),
    }
    kept = {
        'two threads': {'options': ('--threads', '2')},
        'three threads': {'options': ('--threads', '3')},
        'another environment': {'environment': {'LANG': 'tr_TR.UTF-8', 'TZ': 'Asia/Kathmandu', 'COLUMNS': '40', 'GFORTRAN_CONVERT_UNIT': 'swap',
                                                'OMP_SCHEDULE': 'dynamic', 'MALLOC_PERTURB_': '165', 'HOME': '/nowhere'}},
    }
    return ([Test(f'invariant: {name}', lambda folder, case=case: same(program, folder, *case)) for name, case in told.items()]
            + [Test(f'invariant: {name}', lambda folder, case=case: same_hash(program, folder, case)) for name, case in kept.items()]
            + [Test('invariant: locale de_DE', lambda folder: german(program, folder)),
               Test('invariant: blanks in paths', lambda folder: blanks(program, folder))])
