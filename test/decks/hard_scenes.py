"""Scenes of joints that open and slip, as decks in any units, with the loads that they can carry

Lengths are in m and forces in MN before `Units` changes them. All cards are free, with 12 digits.
"""
import math
import os
import sys
from dataclasses import dataclass


@dataclass(frozen=True)
class Units:
    """Units of a deck: how many of them make 1 m and 1 MN"""
    name: str = 'm-MN'
    length: float = 1.0
    force: float = 1.0

    def of(self, value, force=0, length=0):
        """A value [MN^force m^length] in these units"""
        return value * self.force**force * self.length**length


METRE = Units()
UNITS = (METRE, Units('mm-N', 1e3, 1e6), Units('ft-kip', 1/0.3048, 1/4.4482216152605e-3))
# Powers of force and length of what cards hold
STRESS, STIFFNESS, WEIGHT, FORCE, MOMENT, LENGTH = ((1, -2), (1, -3), (1, -3), (1, 0), (1, 1), (0, 1))
KINDS = {'LATERAL': FORCE, 'AXIAL': FORCE, 'MOMENT': MOMENT, 'TORQUE': MOMENT}


class Deck:
    """A deck that is being written"""

    def __init__(self, title, harmonic, planes, method='NEWTON', units=METRE):
        self.units = units
        self.lines = ['TITLE', f'{title} ({units.name})']
        self.add('CONTROL', (harmonic, planes, '', '', '', '', method))

    def add(self, section, *cards):
        """Cards of a section; a pair (value, powers) is a quantity, None a blank field"""
        self.lines.append(section)
        self.lines += [', '.join(map(self.field, card)) + (',' if len(card) == 1 else '')
                       for card in cards]
        return self

    def field(self, value):
        """A field as text"""
        if value is None:
            return ''
        if isinstance(value, tuple):
            number, (force, length) = value
            value = float(self.units.of(number, force, length))
        return f'{value:.12G}' if isinstance(value, float) else str(value)

    def material(self, number, young, poisson, *more):
        """A card of MATERIALS"""
        return self.add('MATERIALS', (number, (young, STRESS), poisson, *more))

    def law(self, number, stiffness, cohesion=0.0, friction=0.0, kind='PAPER', rule='GAUSS'):
        """A card of LAWS; stiffness along xi, eta, theta"""
        plastic = ((cohesion, STRESS), friction) if kind == 'PAPER' else (None, None)
        return self.add('LAWS', (number, *((k, STIFFNESS) for k in stiffness), *plastic, kind, rule))

    def details(self, number, slip='RESULTANT', opening='REVERSIBLE', residual=(None, None), dilation=None,
                gap=0.0, initial=0.0):
        """A card of LAWDETAILS"""
        cohesion, friction = residual
        return self.add('LAWDETAILS', (number, slip, opening,
                                       None if cohesion is None else (cohesion, STRESS), friction,
                                       dilation, (gap, LENGTH), (initial, STRESS)))

    def block(self, body, material, nodes, n1, n2, *corners, ratio=None, along=None):
        """Two cards of BLOCKS; ratios of the last to the first element along both sides"""
        return self.add('BLOCKS', (body, material, nodes, n1, n2, ratio, *(() if along is None else (along,))),
                        tuple((float(x), LENGTH) for x in corners))

    def faces(self, *faces):
        """Cards of FACES: number, body, r1, z1, r2, z2"""
        return self.add('FACES', *((number, body, *((float(x), LENGTH) for x in ends))
                                   for number, body, *ends in faces))

    def resultants(self, *resultants):
        """Cards of RESULTANTS: face, kind, value, direction"""
        return self.add('RESULTANTS', *((face, kind, (float(value), KINDS[kind]), *more)
                                        for face, kind, value, *more in resultants))

    def text(self):
        """The deck"""
        return '\n'.join(self.lines) + '\nEND\n'


def disc(title, *, k=1.0, shear=None, cohesion=0.0, friction=30.0, details=None, n=4, planes=17, harmonic=2,
         young=1e4, nodes=4, rule='GAUSS', radius=1.0, height=0.1, units=METRE, method='NEWTON'):
    """A stiff disc (body 2, face 2 its top) on a fixed plate, with a joint between; loads follow"""
    shear = k if shear is None else shear
    deck = Deck(title, harmonic, planes, method, units).material(1, young, 0.2)
    deck.law(1, (shear, k, shear), cohesion, friction, rule=rule)
    if details is not None:
        deck.details(1, **details)
    deck.block(1, 1, nodes, n, 1, 0, -height, radius, 0).block(2, 1, nodes, n, 1, 0, 0, radius, height)
    deck.faces((1, 2, 0, 0, radius, 0), (2, 2, 0, height, radius, height), (3, 1, 0, 0, radius, 0),
               (4, 1, 0, -height, radius, -height))
    return deck.add('INTERFACES', (1, 3, 1)).add('FIXEDFACES', (3, '111'), (4, '111'))


def eccentric_disc(ratio, *, n=32, planes=65, harmonic=4, units=METRE, method='NEWTON', k=1.0, young=1e7, nodes=4,
                   tolerance=None):
    """A disc of radius 1 pressed by 1 at an eccentricity"""
    deck = disc(f'Disc pressed at e/R = {ratio:g}', k=k, n=n, planes=planes, harmonic=harmonic, units=units,
                method=method, young=young, nodes=nodes)
    deck.resultants((2, 'AXIAL', -1.0), (2, 'MOMENT', ratio))
    return (deck if tolerance is None else deck.add('INCREMENTS', (1.0, float(tolerance), 500))).text()


def eccentric_exact(ratio, k=1.0):
    """Rotation, depth at the centre of a rigid disc (radius 1, force 1), largest pressure"""

    def integrals(c, count=20000):
        """Integrals of (x + c)+ and x (x + c)+ over the disc, by Simpson's rule in x = cos t"""
        last = math.pi if c >= 1.0 else math.acos(-c)
        step = last/count
        force = moment = 0.0
        for i in range(count + 1):
            x = math.cos(i*step)
            value = (1 if i in (0, count) else 4 if i % 2 else 2)*(x + c)*2*math.sin(i*step)**2
            force += value
            moment += x*value
        return force*step/3, moment*step/3

    low, high = -1 + 1e-9, 10.0
    for _ in range(60):
        c = 0.5*(low + high)
        force, moment = integrals(c, 2000)
        low, high = (c, high) if moment/force > ratio else (low, c)
    force, _ = integrals(c)
    rotation = 1.0/(k*force)
    return rotation, rotation*c, k*rotation*(1.0 + c)


MU = math.tan(math.radians(30.0))
RESULTANT, COMPONENTS = {'slip': 'RESULTANT'}, {'slip': 'COMPONENTS'}


def pressed(deck, *loads, share, force=1.0, tolerance=None):
    """Pressed by a force first, then loaded by a share of other loads"""
    deck.add('CASE', (1, 'pressed')).resultants((2, 'AXIAL', -force))
    deck.add('CASE', (2, 'loaded')).resultants(*loads)
    deck.add('COMBINE', (1, 1, 1.0, 2, 1.0))
    return deck.add('INCREMENTS', (1.0, tolerance, None, 1), (repr(float(share)), tolerance, None, 2)).text()


def slide(share, slip, units=METRE, method='NEWTON', direction=None, height=0.1, tolerance=None,
          **options):
    """A pressed disc pushed sideways, its moment about the joint taken away"""
    capacity = MU*(1.0 if slip['slip'] == 'RESULTANT' else 4/math.pi)
    more = () if direction is None else (direction,)
    deck = disc('A pressed disc slides', details=slip, units=units, method=method, height=height, **options)
    return pressed(deck, (2, 'LATERAL', capacity, *more), (2, 'MOMENT', capacity*height, *more), share=share,
                   tolerance=tolerance)


def slide_cohesion(share, units=METRE, method='NEWTON'):
    """A disc without weight, held by cohesion, pushed sideways: pi R^2 C"""
    deck = disc('A glued disc slides', cohesion=0.7, friction=0.0, units=units, method=method,
                details={'slip': 'RESULTANT', 'opening': 'BOND'})
    return pressed(deck, (2, 'LATERAL', 0.7*math.pi), (2, 'MOMENT', 0.07*math.pi), share=share)


def slide_residual(share, units=METRE, method='NEWTON'):
    """Cohesion is lost once a point slips: beyond it only friction is left, (C A + mu N) at first"""
    capacity = 0.3*math.pi + MU
    deck = disc('A glued disc softens', cohesion=0.3, units=units, method=method,
                details={'slip': 'RESULTANT', 'opening': 'BOND', 'residual': (0.0, 20.0)})
    return pressed(deck, (2, 'LATERAL', capacity), (2, 'MOMENT', 0.1*capacity), share=share)


def slide_dilating(share, units=METRE, method='NEWTON'):
    """Dilation lifts the disc, and leaves its weight and mu N as they are"""
    return slide(share, {'slip': 'RESULTANT', 'dilation': 10.0}, units, method)


def slide_up(psi, load, method='NEWTON'):
    """A pressed disc on a dilating joint pushed against springs, far enough to stand above where it stood:
    deck, and the exact displacements sideways and upwards"""
    k, spring = 10.0, 0.2
    deck = disc('A disc slides up', k=k, young=1e6, details={'slip': 'RESULTANT', 'dilation': psi}, method=method)
    deck.add('SPRINGS', (2, 0.0, (spring, STIFFNESS), (spring, STIFFNESS)))
    deck.resultants((2, 'AXIAL', -1.0), (2, 'LATERAL', load), (2, 'MOMENT', 0.1*MU))
    sideways = (load - MU)/(math.pi*spring)
    return deck.text(), sideways, (sideways - MU/(math.pi*k))*math.tan(math.radians(psi)) - 1/(math.pi*k)


def twist(share, units=METRE, method='NEWTON', young=1e4):
    """A pressed disc is twisted: 2/3 mu N R"""
    deck = disc('A pressed disc is twisted', details=RESULTANT, units=units, method=method, young=young)
    return pressed(deck, (2, 'TORQUE', 2/3*MU), share=share)


def twist_cohesion(share, units=METRE, method='NEWTON'):
    """A glued disc is twisted: 2/3 pi R^3 C"""
    deck = disc('A glued disc is twisted', cohesion=0.7, friction=0.0, units=units, method=method,
                details={'slip': 'COMPONENTS', 'opening': 'BOND'})
    return pressed(deck, (2, 'TORQUE', 2/3*math.pi*0.7), share=share)


def lift(share, units=METRE, method='NEWTON'):
    """A pressed disc is lifted: N"""
    deck = disc('A disc is lifted', details=RESULTANT, units=units, method=method)
    return pressed(deck, (2, 'AXIAL', 1.0), share=share)


def overturn(share, units=METRE, method='NEWTON', young=1e4):
    """A pressed disc is tilted until it stands on the outermost joint points alone"""
    n = 8
    edge = 1.0 - (0.5 - 0.5/math.sqrt(3.0))/n
    deck = disc('A disc is overturned', n=n, planes=17, details=RESULTANT, units=units, method=method, young=young)
    return pressed(deck, (2, 'MOMENT', edge), share=share)


def pile(title, *, cohesion=0.0, friction=0.0, details=None, base=False, nodes=4, radius=0.5, length=2.0,
         n=8, k=1e3, harmonic=1, planes=9, units=METRE, method='NEWTON', young=1e6):
    """A stiff pile (body 1, face 1 its top) in a fixed tube or socket with a joint"""
    wall = radius + 0.5
    deck = Deck(title, harmonic, planes, method, units).material(1, young, 0.0)
    deck.law(1, (k, k, k), cohesion, friction)
    if details is not None:
        deck.details(1, **details)
    deck.block(1, 1, nodes, 2, n, 0, 0, radius, length).block(2, 1, nodes, 1, n, radius, 0, wall, length)
    deck.faces((1, 1, 0, length, radius, length), (2, 1, radius, 0, radius, length),
               (3, 2, radius, 0, radius, length), (4, 2, wall, 0, wall, length))
    deck.add('INTERFACES', (1, 2, 3))
    if base:
        deck.block(2, 1, nodes, 2, 1, 0, -0.5, radius, 0).block(2, 1, nodes, 1, 1, radius, -0.5, wall, 0)
        deck.faces((5, 1, 0, 0, radius, 0), (6, 2, 0, 0, radius, 0), (7, 2, 0, -0.5, wall, -0.5))
        deck.law(2, (k, k, k), 0.0, 30.0).add('INTERFACES', (2, 5, 6)).add('FIXEDFACES', (7, '111'))
    return deck.add('FIXEDFACES', (4, '111'))


def pull_out(share, units=METRE, method='NEWTON', base=False, nodes=4):
    """A pile is pulled out: 2 pi R L C, whatever presses it; a base joint without tension adds nothing"""
    deck = pile('A pile is pulled out', cohesion=0.3, base=base, nodes=nodes, units=units, method=method,
                details={'slip': 'RESULTANT', 'opening': 'BOND', 'initial': -0.2})
    return deck.resultants((1, 'AXIAL', share*2*math.pi*0.5*2.0*0.3)).text()


def pull_out_of_socket(share, units=METRE, method='NEWTON'):
    """Two joints meet at the toe of the pile"""
    return pull_out(share, units, method, base=True)


def pull_out_quadratic(share, units=METRE, method='NEWTON'):
    """With 8-node elements"""
    return pull_out(share, units, method, nodes=8)


def pull_and_twist(share, units=METRE, method='NEWTON'):
    """Pull P and torque T on a bonded shaft: P^2 + (T/R)^2 = (2 pi R L C)^2"""
    capacity = 2*math.pi*0.5*2.0*0.3
    deck = pile('A pile is pulled and twisted', cohesion=0.3, units=units, method=method,
                details={'slip': 'RESULTANT', 'opening': 'BOND', 'initial': -0.2})
    return deck.resultants((1, 'AXIAL', share*0.6*capacity), (1, 'TORQUE', share*0.8*capacity*0.5)).text()


def stiff_shaft(method='NEWTON'):
    """A clamped pile with a stiff shaft on a soft toe, where Newton's steps run away though it stands"""
    deck = pile('A clamped pile, stiff shaft', friction=30.0, base=True, k=1e8, method=method,
                details={'slip': 'RESULTANT', 'initial': -0.1})
    deck.resultants((1, 'LATERAL', 0.2), (1, 'AXIAL', -0.3))
    return deck.text().replace('2, 100000000, 100000000, 100000000', '2, 1, 1, 1')


def tube_in_ground(young=31000.0, times=1.0):
    """A tube stands in ground whose stress comes before any weight: it pushes the tube up, the shaft slips all along, and
    the toe opens. Then the weight, and a wind in two increments. `times`: the stiffness of the joints"""
    deck = Deck('Tube in ground', 3, 13).material(1, young, 0.22, 2.5e-3).material(2, 41.0, 0.31, 1.9e-3)
    deck.law(1, (310.0*times, 710.0*times, 310.0*times), 0.0, 24.0).details(1)
    deck.block(1, 1, 8, 2, 7, 0.43, -5.3, 0.61, 0).block(1, 1, 8, 2, 2, 0.43, 0, 0.61, 1.1)
    deck.block(2, 2, 8, 5, 7, 0.61, -5.3, 6.7, 0, ratio=4.0).block(2, 2, 8, 5, 3, 0.61, -9, 6.7, -5.3, ratio=4.0, along=0.4)
    deck.block(2, 2, 8, 2, 3, 0.43, -9, 0.61, -5.3, along=0.4)
    deck.faces((1, 1, 0.43, 1.1, 0.61, 1.1), (2, 1, 0.61, -5.3, 0.61, 0), (3, 2, 0.61, -5.3, 0.61, 0),
               (4, 2, 0.43, -9, 6.7, -9), (5, 2, 6.7, -9, 6.7, 0), (6, 1, 0.43, -5.3, 0.61, -5.3),
               (7, 2, 0.43, -5.3, 0.61, -5.3))
    deck.add('INTERFACES', (1, 2, 3), (1, 6, 7)).add('FIXEDFACES', (5, '101'), (4, '111'))
    deck.add('CASE', (1, 'weight')).add('GRAVITY', (-9.81,)).add('CASE', (2, 'stress of the ground'))
    deck.add('INSITU', (1, 0.0, 0.0, 0.0, None, None, 'MEANT'), (2, 0.0, 0.018639, 0.6, None, None, 'MEANT'))
    deck.add('CASE', (3, 'wind')).resultants((1, 'LATERAL', 0.21)).add('COMBINE', (1, 1, 1.0, 2, 1.0, 3, 1.0))
    return deck.add('INCREMENTS', (1.0, 1e-8, None, 2), (1.0, 1e-8, None, 1), (0.5, 1e-8, None, 3),
                    (0.5, 1e-8, None, 3)).text()


def push_through(share, units=METRE, method='NEWTON'):
    """Friction under an initial stress holds a pile: 2 pi R L mu sigma"""
    deck = pile('A clamped pile is pushed through', friction=30.0, units=units, method=method,
                details={'slip': 'RESULTANT', 'initial': -0.4})
    return deck.resultants((1, 'AXIAL', -share*2*math.pi*0.5*2.0*0.4*MU)).text()


def cone(share, units=METRE, method='NEWTON'):
    """A plug in a cone (r = a to 2 a over a height 2 a; nothing resists along xi) is pressed and
    twisted: p = N / (pi (R^2 - r^2)), T = mu p 2/3 pi (R^3 - r^3) / sin alpha. a is half a foot:
    twelve digits of eight coordinates would not fit a card"""
    a = 0.1524
    pressure = 1.0/(3*math.pi*a**2)
    torque = MU*pressure*2/3*math.pi*7*a**3*math.sqrt(5.0)
    deck = Deck('A plug in a cone is twisted', 2, 9, method, units).material(1, 1e4, 0.2)
    deck.law(1, (0.0, 10.0, 10.0), 0.0, 30.0)
    deck.block(1, 1, 4, 2, 8, 0, 0, a, 0, 2*a, 2*a, 0, 2*a)
    deck.block(2, 1, 4, 1, 8, a, 0, 3*a, 0, 4*a, 2*a, 2*a, 2*a)
    deck.faces((1, 1, a, 0, 2*a, 2*a), (2, 1, 0, 2*a, 2*a, 2*a), (3, 2, a, 0, 2*a, 2*a),
               (4, 2, 3*a, 0, 4*a, 2*a))
    deck.add('INTERFACES', (1, 1, 3)).add('FIXEDFACES', (4, '111'), (3, '111'))
    return pressed(deck, (2, 'TORQUE', torque), share=share)


# Name: deck of a share of the load that the joint can carry, and how it fails
CAPACITIES = {
    'slides, resultant law': (lambda share, *a: slide(share, RESULTANT, *a), 'slides sideways'),
    'slides, component law': (lambda share, *a: slide(share, COMPONENTS, *a, planes=65), 'slides sideways'),
    'slides at 30 degrees': (lambda share, *a: slide(share, RESULTANT, *a, direction=30.0), 'slides sideways'),
    'slides, 8-node, Lobatto': (lambda share, *a: slide(share, RESULTANT, *a, nodes=8, rule='LOBATTO'),
                                'slides sideways'),
    'slides, cohesion': (slide_cohesion, 'slides sideways'),
    'slides, residual strength': (slide_residual, 'slides sideways'),
    'slides, dilation': (slide_dilating, ''),  # it lifts as it slides: either motion may be named
    'twisted': (twist, 'turns about z'),
    'twisted, cohesion': (twist_cohesion, 'turns about z'),
    'lifted': (lift, 'moves along z'),
    'overturned': (overturn, 'tilts'),
    'pulled out': (pull_out, 'moves along z'),
    'pulled out of a socket': (pull_out_of_socket, 'moves along z'),
    'pulled out, 8-node': (pull_out_quadratic, 'moves along z'),
    'pulled and twisted': (pull_and_twist, ''),
    'pushed through': (push_through, 'moves along z'),
    'twisted in a cone': (cone, 'turns about z'),
}


def example(number, *, factor=1.0, method='NEWTON', tolerance=1e-10, most=500, harmonic=8, planes=33, bond=True,
            refined=1, nodes=4, units=METRE, ratio=None):
    """The example of the paper (inputs/case1.dat to case3.dat): joint stiffness times a factor, and
    the bond law in cases 1 and 2; elements of so many nodes; ratio of the largest element to the least, where they
    are small at the shaft and the ends of the socket"""
    cohesion, friction = {1: (2.0, 30.0), 2: (0.5, 30.0), 3: (0.0, 0.0)}[number]
    deck = Deck(f'Case {number}, joint stiffness x {factor:g}', harmonic, planes, method, units)
    deck.material(1, 2e4, 0.17).material(2, 2e4, 0.17)
    stiffness = tuple(k*factor for k in (1e4, 2e4, 1e4))
    deck.law(1, stiffness, cohesion, friction).law(2, stiffness, kind='ELASTIC')
    if bond and cohesion > 0.0:
        deck.details(1, 'COMPONENTS', 'BOND')
    large, small = (None, None) if ratio is None else (float(ratio), 1.0/ratio)
    socket = ((8, 0, 1, None),) if ratio is None else ((4, 0, 0.5, large), (4, 0.5, 1, small))
    blocks = [(1, 4, 2, small, small, 0, -0.5, 0.5, 0), *((1, 4, n, small, along, 0, low, 0.5, high) for n, low, high, along in socket),
              *((2, 6, n, large, along, 0.5, low, 2, high) for n, low, high, along in socket),
              (2, 6, 4, large, large, 0.5, 1, 2, 2), (2, 4, 4, small, large, 0, 1, 0.5, 2)]
    for body, n1, n2, across, along, *corners in blocks:
        deck.block(body, body, nodes, round(n1*refined), round(n2*refined), *corners, ratio=across, along=along)
    deck.faces((1, 1, 0, -0.5, 0.5, -0.5), (2, 1, 0.5, 0, 0.5, 1), (3, 2, 0.5, 0, 0.5, 1),
               (4, 1, 0, 1, 0.5, 1), (5, 2, 0, 1, 0.5, 1), (6, 2, 0, 2, 2, 2))
    deck.add('INTERFACES', (1, 2, 3), (2, 4, 5)).add('FIXEDFACES', (6, '111'))
    deck.resultants((1, 'LATERAL', 0.4), (1, 'MOMENT', 0.8))
    return deck.add('INCREMENTS', (1.0, float(tolerance), most)).text()


def soil_pile(title, increments, *, friction=25.0, cohesion=0.0, gravity=0.0, details=None,
              k=2e3, harmonic=4, planes=17, units=METRE, method='NEWTON', lateral=0.05, tolerance=None):
    """A pile in soil that stands on its toe: case 1 its weight and the stress of the ground (K0 = 0.5),
    case 2 a lateral load on its head; increments are pairs of factor and case"""
    deck = Deck(title, harmonic, planes, method, units)
    deck.add('MATERIALS', (1, (2e4, STRESS), 0.2, (0.02, WEIGHT)),
             (2, (50.0, STRESS), 0.3, (0.02, WEIGHT)))
    deck.law(1, (k, k, k), cohesion, friction).law(2, (k, k, k), kind='ELASTIC')
    if details is not None:
        deck.details(1, **details)
    head = 0 if gravity > 0.0 else 1  # above the ground no stress of the ground is in balance
    if head:
        deck.block(1, 1, 4, 2, 2, 0, 0, 0.5, 1)
    deck.block(1, 1, 4, 2, 8, 0, -4, 0.5, 0).block(2, 2, 4, 6, 8, 0.5, -4, 5, 0, ratio=5.0).block(2, 2, 4, 2, 3, 0, -6, 0.5, -4)
    deck.block(2, 2, 4, 6, 3, 0.5, -6, 5, -4, ratio=5.0)
    deck.faces((1, 1, 0, head, 0.5, head), (2, 1, 0.5, -4, 0.5, 0), (3, 2, 0.5, -4, 0.5, 0),
               (4, 1, 0, -4, 0.5, -4), (5, 2, 0, -4, 0.5, -4), (6, 2, 0, -6, 5, -6), (7, 2, 5, -6, 5, 0))
    deck.add('INTERFACES', (1, 2, 3), (2, 4, 5)).add('FIXEDFACES', (6, '111'), (7, '111'))
    deck.add('CASE', (1, 'weight'))
    if gravity > 0.0:
        # the unit weight is that of the material times a factor without a unit
        ground = ((0.0, LENGTH), (0.02*gravity, WEIGHT), 0.5)
        deck.add('GRAVITY', (-gravity,)).add('INSITU', (1, *ground), (2, *ground))
    else:
        deck.resultants((1, 'AXIAL', -1e-3))
    deck.add('CASE', (2, 'lateral')).resultants((1, 'LATERAL', lateral))
    deck.add('COMBINE', (1, 1, 1.0, 2, 1.0))
    return deck.add('INCREMENTS', *((float(f), tolerance, None, case) for f, case in increments)).text()


def stiff_plug(method='NEWTON'):
    """A plug in soft ground by joints without friction ten thousands of times as stiff, pressed in: sweeps over such
    joints run away, Newton's steps do not"""
    deck = Deck('A plug on stiff joints', 4, 17, method)
    deck.add('MATERIALS', (1, 2.27e4, 0.2), (2, 13.7, 0.3))
    deck.law(1, (600000.0,)*3, rule='LOBATTO').details(1).law(2, (10500.0,)*3, rule='LOBATTO').details(2)
    deck.block(1, 1, 3, 2, 2, 0, 0, 0.5, 0.5).block(1, 1, 3, 2, 4, 0, -2, 0.5, 0).block(2, 2, 3, 3, 4, 0.5, -2, 3, 0)
    deck.block(2, 2, 3, 3, 2, 0.5, -3, 3, -2).block(2, 2, 3, 2, 2, 0, -3, 0.5, -2)
    deck.faces((1, 1, 0, 0.5, 0.5, 0.5), (2, 1, 0.5, -2, 0.5, 0), (3, 2, 0.5, -2, 0.5, 0), (4, 1, 0, -2, 0.5, -2),
               (5, 2, 0, -2, 0.5, -2), (6, 2, 0, -3, 3, -3), (7, 2, 3, -3, 3, 0))
    deck.add('INTERFACES', (1, 2, 3), (2, 4, 5)).add('FIXEDFACES', (6, '111'), (7, '111'))
    return deck.resultants((1, 'AXIAL', -0.1)).add('INCREMENTS', (1.0, 1e-7, 20000)).text()


def stiff_caisson(factors):
    """A caisson in joints as good as rigid that only friction holds along its sides, on a soft joint under its tip, pressed in
    and pushed sideways. `factors`: the increments"""
    deck = Deck('A caisson on stiff joints', 1, 6).add('MATERIALS', (1, 2000.0, 0.3), (2, 1400.0, 0.4))
    deck.law(1, (6.4e8,)*3, 0.0, 30.0).details(1, slip='RESULTANT')
    deck.law(2, (7.6,)*3, 0.0, 20.0, rule='LOBATTO').details(2, slip='RESULTANT')
    deck.block(1, 2, 8, 1, 2, 1, -1, 1.2, 0).block(1, 2, 8, 1, 1, 1, 0, 1.2, 0.3).block(2, 1, 8, 2, 2, 0, -1, 1, 0)
    deck.block(2, 1, 8, 2, 2, 1.2, -1, 3, 0).block(2, 1, 8, 2, 2, 0, -2, 1, -1).block(2, 1, 8, 1, 2, 1, -2, 1.2, -1)
    deck.block(2, 1, 8, 2, 2, 1.2, -2, 3, -1)
    deck.faces((1, 1, 1, -1, 1, 0), (2, 2, 1, -1, 1, 0), (3, 1, 1.2, -1, 1.2, 0), (4, 2, 1.2, -1, 1.2, 0),
               (5, 1, 1, -1, 1.2, -1), (6, 2, 1, -1, 1.2, -1), (7, 1, 1, 0.3, 1.2, 0.3), (8, 2, 0, -2, 3, -2),
               (9, 2, 3, -2, 3, 0))
    deck.add('INTERFACES', (1, 1, 2), (1, 3, 4), (2, 5, 6)).add('FIXEDFACES', (8, '111'), (9, '101'))
    deck.resultants((7, 'AXIAL', -1.0), (7, 'LATERAL', 0.5))
    return deck.add('INCREMENTS', *((factor, 1e-8) for factor in factors)).text()


def loose_plug(times):
    """A plug in a hole with a gap all round, pushed sideways until it touches at its mouth and at its foot. `times`: the
    stiffness of the joints"""
    deck = Deck('A plug in a hole too wide', 4, 17).add('MATERIALS', (1, 5200.0, 0.45), (2, 9300.0, 0.4))
    deck.law(1, (7e5*times,)*3, 0.0, 20.0).details(1, slip='RESULTANT', gap=1.9e-4)
    deck.block(1, 2, 4, 2, 2, 0, -2, 0.5, 0).block(1, 2, 4, 2, 1, 0, 0, 0.5, 0.5).block(2, 1, 4, 2, 2, 0.5, -2, 2.5, 0)
    deck.faces((1, 1, 0.5, -2, 0.5, 0), (2, 2, 0.5, -2, 0.5, 0), (3, 1, 0, 0.5, 0.5, 0.5), (4, 2, 2.5, -2, 2.5, 0))
    deck.add('INTERFACES', (1, 1, 2)).add('FIXEDFACES', (4, '111')).resultants((3, 'LATERAL', 0.56))
    return deck.text()


def ring_in_ground(turn=0.0, skew=0.0, held=None, twist=0.0):
    """A ring in ground that presses it oval and slips along it; nothing keeps both from turning about the axis. `turn`: where
    the load points to. `skew`: a further load, so that no plane is one of symmetry. `held`: a node held in torsion alone.
    `twist`: a torque"""
    deck = Deck('A ring in ground', 8, 33).add('MATERIALS', (1, 3e4, 0.2), (2, 500.0, 0.3))
    deck.law(1, (1e3, 1e4, 1e3), 0.0, 20.0).details(1)
    deck.block(1, 1, 8, 1, 1, 3, 0, 3.3, 1).block(2, 2, 8, 6, 1, 3.3, 0, 12, 1, ratio=4.0)
    deck.faces((1, 1, 3.3, 0, 3.3, 1), (2, 2, 3.3, 0, 3.3, 1), (3, 2, 12, 0, 12, 1), (4, 1, 3, 0, 3.3, 0),
               (5, 1, 3, 1, 3.3, 1), (6, 2, 3.3, 0, 12, 0), (7, 2, 3.3, 1, 12, 1))
    deck.add('INTERFACES', (1, 1, 2)).add('FIXEDFACES', *((face, '010') for face in (4, 5, 6, 7)))
    deck.add('SHAPES', (1, 'COSINE', 2, float(turn)), (2, 'COSINE', 4, turn + 10.0))
    deck.add('PRESSURES', (3, 0, 1.0), (3, None, 0.9, None, None, 1), (3, None, skew, None, None, 2))
    if held:
        deck.add('RESTRAINTS', (held, '001', None, None, 0, 0, 'A'))
    if twist:
        deck.resultants((3, 'TORQUE', twist))
    return deck.add('INCREMENTS', (1.0, 1e-9)).text()


def slipping_ground(pressure=0.0, method='NEWTON'):
    """Ground with an inclined joint: its stress (K0 = 0.2) balances its weight, but the joint carries too little shear for
    that. Weight, and pressure on the inner part"""
    deck = Deck('Ground with an inclined joint', 0, 9, method)
    deck.add('MATERIALS', (1, 200.0, 0.3, 0.002), (2, 200.0, 0.3, 0.002))
    deck.law(1, (1e3, 1e3, 1e3), 0.0, 30.0).details(1, slip='RESULTANT')
    deck.block(1, 1, 8, 3, 8, 0, -4, 1, -4, 2, 0, 0, 0).block(2, 2, 8, 5, 8, 1, -4, 6, -4, 6, 0, 2, 0)
    deck.faces((1, 1, 1, -4, 2, 0), (2, 2, 1, -4, 2, 0), (3, 1, 0, -4, 1, -4), (4, 2, 1, -4, 6, -4), (5, 2, 6, -4, 6, 0),
               (6, 1, 0, 0, 2, 0))
    deck.add('INTERFACES', (1, 1, 2)).add('FIXEDFACES', (3, '010'), (4, '010'), (5, '100'))
    deck.add('CASE', (1, 'weight')).add('GRAVITY', (-10.0,)).add('INSITU', (1, 0.0, 0.02, 0.2), (2, 0.0, 0.02, 0.2))
    if pressure:
        deck.add('PRESSURES', (6, 0, pressure))
    return deck.add('INCREMENTS', (1.0, 1e-8, None, 1)).text()


def monopile(method='NEWTON', ring=True, unload=True):
    """A steel monopile in two layers of ground: its weight and K0 = 0.5, then wind in four steps, which press its head
    against a guide ring with a clearance of 1 mm, and let go in two steps"""
    deck = Deck('A monopile in two layers', 4, 17, method)
    deck.add('MATERIALS', (1, 2.1e5, 0.3, 0.077), (2, 30.0, 0.3, 0.010), (3, 80.0, 0.25, 0.011))
    deck.law(1, (60.0, 120.0, 60.0), 0.0, 29.0).law(2, (1e3, 2e3, 1e3), 0.0, 20.0)
    deck.details(1).details(2, gap=1e-3)
    deck.block(1, 1, 8, 1, 12, 2.9, -20, 3, 4).block(1, 1, 8, 1, 1, 2.9, 4, 3, 5).block(4, 1, 8, 1, 1, 3, 4, 3.5, 5)
    for body, r1, r2, n, ratio in ((2, 3, 30, 6, 6.0), (3, 0, 2.9, 3, None)):
        deck.block(body, 2, 8, n, 4, r1, -8, r2, 0, ratio=ratio).block(body, 3, 8, n, 6, r1, -20, r2, -8, ratio=ratio)
    deck.block(2, 3, 8, 6, 3, 3, -30, 30, -20, ratio=6.0).block(2, 3, 8, 1, 3, 2.9, -30, 3, -20)
    deck.block(2, 3, 8, 3, 3, 0, -30, 2.9, -20)
    deck.faces((1, 1, 2.9, 5, 3, 5), (2, 1, 3, -20, 3, 0), (3, 2, 3, -20, 3, 0), (4, 1, 2.9, -20, 2.9, 0),
               (5, 3, 2.9, -20, 2.9, 0), (6, 1, 2.9, -20, 3, -20), (7, 2, 2.9, -20, 3, -20), (8, 3, 0, -20, 2.9, -20),
               (9, 2, 0, -20, 2.9, -20), (10, 2, 0, -30, 30, -30), (11, 2, 30, -30, 30, 0), (12, 1, 3, 4, 3, 5),
               (13, 4, 3, 4, 3, 5), (14, 4, 3.5, 4, 3.5, 5))
    deck.add('INTERFACES', (1, 2, 3), (1, 4, 5), (1, 6, 7), (1, 8, 9), *(((2, 12, 13),) if ring else ()))
    deck.add('FIXEDFACES', (10, '111'), (11, '101'), (14, '111'))
    deck.add('CASE', (1, 'weight')).add('GRAVITY', (-1.0,))
    deck.add('INSITU', (1, 0.0, 0.0, 0.0, 0.0, None, 'MEANT'), *((body, *layer) for body in (2, 3) for layer in (
        (0.0, 0.010, 0.5, 0.0, 2), (-8.0, 0.011, 0.5, -0.08, 3))))
    deck.add('CASE', (2, 'wind')).resultants((1, 'LATERAL', 2.0), (1, 'MOMENT', -60.0)).add('COMBINE', (1, 1, 1.0, 2, 1.0))
    steps = [(1.0, 1), *[(0.25, 2)]*4, *([(-0.5, 2)]*2 if unload else ())]
    return deck.add('INCREMENTS', *((factor, None, 20000, case) for factor, case in steps)).text()


def waves(harmonic, beside=None):
    """A pile in a socket whose free face is pressed by cos(m theta), and next to nothing of another harmonic"""
    deck = Deck(f'Pressed by cos({harmonic} theta)', 12, 13).material(1, 2e4, 0.17)
    deck.law(1, (1e4, 2e4, 1e4), 0.0, 30.0)
    deck.block(1, 1, 4, 4, 12, 0, -0.5, 0.5, 1).block(2, 1, 4, 6, 8, 0.5, 0, 2, 1)
    deck.faces((1, 1, 0.5, 0, 0.5, 1), (2, 2, 0.5, 0, 0.5, 1), (3, 2, 0.5, 1, 2, 1), (4, 1, 0.5, -0.5, 0.5, 0))
    deck.add('INTERFACES', (1, 1, 2)).add('FIXEDFACES', (3, '111'))
    loads = [(4, harmonic, 0.4, 0.4), (4, 0, -0.1, -0.1)]
    if beside is not None:
        loads.append((4, beside, 1e-28, 1e-28))
    return deck.add('PRESSURES', *loads).add('INCREMENTS', (1.0, 1e-10)).text()


def with_reference(deck, *lines):
    """A deck with comments above its first card"""
    return ''.join(f'! {line}\n' for line in lines) + deck


def hard_inputs():
    """The decks of inputs/hard by name, each with its reference"""
    cycle = [(1, 1), (1, 2), (-1, 2), (-1, 2), (1, 2), (1, 2)]
    rotation, depth, pressure = eccentric_exact(0.5)
    decks = {
        'eccentric_disc': with_reference(
            eccentric_disc(0.5), 'A rigid disc without tension under it, pressed by 1 at e = R/2: half of it lifts.',
            f'Exact: rotation {rotation:.9f} (v of harmonic 1 at r = 1), depth at the centre {depth:.9f}',
            f'(v of harmonic 0), largest pressure {pressure:.9f}.'),
        'sliding_disc': with_reference(
            slide(0.99, RESULTANT), 'A disc pressed by 1 and pushed sideways by 99 % of its resistance tan(30).',
            'Exact: holds; at 1.01 in the last card it slides (exit code 4). With COMPONENTS instead of',
            'RESULTANT it holds up to 4/pi times as much.'),
        'twisted_disc': with_reference(
            twist(0.99), 'A disc pressed by 1 and twisted by 99 % of its resistance 2/3 tan(30).',
            'Exact: holds; at 1.01 in the last card it turns (exit code 4).'),
        'overturned_disc': with_reference(
            overturn(0.99), 'A disc tilted until it stands on the outermost joint points alone, at 99 % of that moment.',
            'Exact for the points of this mesh: holds; at 1.01 in the last card it tilts (exit code 4).'),
        'pulled_out': with_reference(
            pull_out_of_socket(0.99), 'A bonded pile pulled out of a socket by 99 % of 2 pi R L C; two joints meet at its toe.',
            'Exact: holds; a load of 101 % pulls it out (exit code 4).'),
        'pulled_and_twisted': with_reference(
            pull_and_twist(0.99), 'A bonded shaft pulled by P and twisted by T, 99 % of P^2 + (T/R)^2 = (2 pi R L C)^2.',
            'Exact: holds; loads of 101 % turn it out (exit code 4).'),
        'cone': with_reference(
            cone(0.99), 'A plug in a cone, pressed and twisted by 99 % of its resistance: an inclined joint.',
            'Exact: T = mu p 2/3 pi (R^3 - r^3)/sin(alpha) with p = N/(pi (R^2 - r^2)).'),
        'cyclic_pile': with_reference(
            soil_pile('A pile in soil, pushed to and fro', cycle, friction=0.0, tolerance=1e-9),
            'A frictionless pile shaft: gaps open on either side in turn and close again.',
            'Exact: after each half cycle the head stands where it stood, the other way round.'),
        'ground_stress': with_reference(
            soil_pile('K0, then a lateral load', [(1, 1), (1, 2)], gravity=1.0, details=RESULTANT),
            'Weight and stress of the ground (K0 = 0.5) in a pile shaft, then a lateral load.',
            'Exact after the first increment: no displacement, sigma = 0.5 gamma z on the shaft.'),
        'reversible_cycle': with_reference(
            example(2, factor=10.0, bond=False, tolerance=1e-6), "Case 2 with joints ten times as stiff, the paper's law: "
            'cohesion comes back when a point closes.', 'The law has no state with equilibrium: '
            'cohesion fades over a small opening, which a remark says.'),
        'rigid_joints': with_reference(
            example(3, factor=1e6, tolerance=1e-6), 'Case 3 with joints a million times as stiff, k h/E = 1E5.',
            'Converges; the remark says that they are out of proportion.'),
    }
    return {f'{name}.dat': text for name, text in decks.items()}


def main(folder):
    """Write the decks of inputs/hard"""
    for name, text in hard_inputs().items():
        with open(os.path.join(folder, name), 'w', encoding='ascii') as file:
            file.write(text)


if __name__ == '__main__':
    main(sys.argv[1])
