"""A small program of its own for decks of Owen and Hinton: reads them, solves them and prints the old listing.

It shares nothing with axijoint but the format: initial stiffness iterations, stresses brought back to the criterion by the
projection onto all its planes at once (no sorting of principal stresses), edit descriptors of its own. Needs NumPy.
"""
import itertools
import math

import numpy as np

TRESCA, MISES, MOHR, DRUCKER = 1, 2, 3, 4
RING = {4: ((-1, -1), (1, -1), (1, 1), (-1, 1)),
        8: ((-1, -1), (0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0))}
RING[9] = RING[8] + ((0, 0),)
POINTS = {2: ((-1/math.sqrt(3), 1/math.sqrt(3)), (1.0, 1.0)),
          3: ((-math.sqrt(0.6), 0.0, math.sqrt(0.6)), (5/9, 8/9, 5/9))}


def shapes(n, x, y):
    """Shape functions and their derivatives, as in any book: serendipity or products of Lagrange's"""
    def line(at, s):
        return {-1: (s*(s - 1)/2, s - 0.5), 0: (1 - s*s, -2*s), 1: (s*(s + 1)/2, s + 0.5)}[at]
    values, slopes = np.zeros(n), np.zeros((2, n))
    for i, (a, b) in enumerate(RING[n]):
        if n == 9:
            (f, df), (g, dg) = line(a, x), line(b, y)
            values[i], slopes[:, i] = f*g, (df*g, f*dg)
        elif a and b:
            f, g = (1 + a*x)/2, (1 + b*y)/2
            bubble = a*x + b*y - 1 if n == 8 else 1
            values[i] = f*g*bubble
            slopes[:, i] = (a/2*g*bubble + f*g*a*(n == 8), b/2*f*bubble + f*g*b*(n == 8))
        elif a == 0:
            values[i], slopes[:, i] = (1 - x*x)*(1 + b*y)/2, (-x*(1 + b*y), (1 - x*x)*b/2)
        else:
            values[i], slopes[:, i] = (1 + a*x)*(1 - y*y)/2, (a/2*(1 - y*y), -(1 + a*x)*y)
    return values, slopes


def field(line, first, last, decimals=0):
    """A number of a card by its columns: implied decimals, blanks are zero"""
    text = line[first - 1:last].strip()
    if not text:
        return 0.0
    return float(text) if '.' in text else int(text)/10**decimals


class Deck:
    """A deck in the formats of the book"""

    def __init__(self, text):
        lines = iter(text.split('\n'))
        self.title = next(lines)
        (self.n_nodes, self.n_elements, n_held, self.ntype, self.nnode, n_materials, self.ngaus, self.nalgo, self.ncrit,
         n_increments, _) = (int(v) for v in next(lines).split())
        self.elements = {}
        for _ in range(self.n_elements):
            numbers = [int(v) for v in next(lines).split()]
            self.elements[numbers[0]] = (numbers[1], [k - 1 for k in numbers[2:]])
        self.place = np.full((self.n_nodes, 2), math.nan)
        node = 0
        while node != self.n_nodes:
            line = next(lines)
            node = int(field(line, 1, 5))
            self.place[node - 1] = field(line, 6, 15, 5), field(line, 16, 25, 5)
        for _, nodes in self.elements.values():  # middles of sides
            for i in range(1, 8, 2) if self.nnode > 4 else ():
                if math.isnan(self.place[nodes[i], 0]):
                    self.place[nodes[i]] = (self.place[nodes[i - 1]] + self.place[nodes[(i + 1) % 8]])/2
            if self.nnode == 9 and math.isnan(self.place[nodes[8], 0]):
                # that of the shape functions of the others
                self.place[nodes[8]] = shapes(8, 0.0, 0.0)[0] @ self.place[nodes[:8]]
        self.held = {}
        for _ in range(n_held):
            line = next(lines)
            self.held[int(field(line, 2, 5)) - 1] = (int(field(line, 11, 15)), field(line, 21, 30, 6), field(line, 31, 40, 6))
        self.property = {}
        for _ in range(n_materials):
            number, line = int(next(lines)), next(lines)
            self.property[number] = [field(line, 10*k + 1, 10*k + 10, 5) for k in range(8)]
        next(lines)
        kinds = next(lines)
        self.point, self.gravity, self.edges = {}, 0.0, []
        node = 0
        while int(field(kinds, 1, 5)) and node != self.n_nodes:
            line = next(lines)
            node = int(field(line, 1, 5))
            self.point[node - 1] = field(line, 6, 15, 3), field(line, 16, 25, 3)
        if int(field(kinds, 6, 10)):
            line = next(lines)
            self.gravity = -field(line, 11, 20, 3)*math.cos(math.radians(field(line, 1, 10, 3)))
        for _ in range(int(next(lines)) if int(field(kinds, 11, 15)) else 0):
            nodes = [int(v) - 1 for v in next(lines).split()[1:]]
            line = next(lines)
            self.edges.append((nodes, [(field(line, 20*k + 1, 20*k + 10, 3), field(line, 20*k + 11, 20*k + 20, 3))
                                       for k in range(len(nodes))]))
        self.increments = []
        for _ in range(n_increments):
            line = next(lines)
            self.increments.append((field(line, 1, 10, 5), field(line, 11, 20, 5), int(field(line, 21, 25)),
                                    int(field(line, 31, 35))))


class Criterion:
    """Stresses of one material brought back to its criterion; plastic strain is normal to it"""

    def __init__(self, kind, values):
        self.kind = kind
        young, nu, _, _, strength, self.hardening, angle = values[:7]
        self.shear, self.bulk = young/(2 + 2*nu), young/(3 - 6*nu)
        self.elastic = (self.bulk - 2/3*self.shear)*np.ones((3, 3)) + 2*self.shear*np.eye(3)
        sine, cosine = math.sin(math.radians(angle)), math.cos(math.radians(angle))
        if kind in (TRESCA, MOHR):
            sine, limit, half = (0.0, strength, 1.0) if kind == TRESCA else (sine, strength*cosine, 0.5)
            self.planes = np.array([[half*((k == i)*(1 + sine) - (k == j)*(1 - sine)) for k in range(3)]
                                    for i, j in itertools.permutations(range(3), 2)])
            self.limit = limit
        elif kind == MISES:
            self.scale, self.slope, self.limit = math.sqrt(3), 0.0, strength
        else:
            self.scale, self.slope = 1.0, 6*sine/(math.sqrt(3)*(3 - sine))
            self.limit = 6*strength*cosine/(math.sqrt(3)*(3 - sine))

    def bring_back(self, trial, gained):
        """Principal stresses (points, 3) and multipliers of the increment, for trial stresses; not sorted"""
        limit = self.limit + self.hardening*gained
        if self.kind in (MISES, DRUCKER):
            return self.radial(trial, limit)
        stress, added = trial.copy(), np.zeros(len(trial))
        worst = (trial @ self.planes.T).max(1) - limit
        left = np.flatnonzero(worst > 1e-12*limit.max())
        for n in (1, 2, 3):
            for chosen in itertools.combinations(range(6), n):
                if not left.size:
                    return stress, added
                planes = self.planes[list(chosen)]
                matrix = planes @ self.elastic @ planes.T + self.hardening
                if np.linalg.cond(matrix) > 1e10:
                    continue
                factors = np.linalg.solve(matrix, (trial[left] @ planes.T - limit[left, None]).T).T
                found = trial[left] - factors @ planes @ self.elastic
                bound = limit[left] + self.hardening*factors.sum(1)
                good = (factors >= -1e-14).all(1) & ((found @ self.planes.T).max(1) <= bound + 1e-10*limit.max())
                stress[left[good]], added[left[good]] = found[good], factors[good].sum(1)
                left = left[~good]
        raise AssertionError('no return to the planes')

    def radial(self, trial, limit):
        """The cone scale root(J2) + slope p <= limit, and its apex"""
        mean = trial.mean(1)
        deviator = trial - mean[:, None]
        root = np.sqrt((deviator**2).sum(1)/2)
        over = np.maximum(self.scale*root + self.slope*mean - limit, 0.0)
        added = over/(self.scale**2*self.shear + self.slope**2*self.bulk + self.hardening)
        rest = root - self.scale*self.shear*added
        apex = (rest < 0)
        if apex.any():
            added = np.where(apex, (mean - limit/self.slope)/(self.slope*self.bulk), added)
            rest = np.maximum(rest, 0.0)
        mean = mean - self.slope*self.bulk*added
        return deviator*(rest/np.where(root > 0, root, 1.0))[:, None] + mean[:, None], added


class Body:
    """Elements at their Gauss points, and loads of factor 1"""

    def __init__(self, deck):
        self.deck = deck
        b, weight, owner, nodes_of = [], [], [], []
        self.load = np.zeros(2*deck.n_nodes)
        x, w = POINTS[deck.ngaus]
        for material, nodes in deck.elements.values():
            place = deck.place[nodes]
            for i, j in itertools.product(range(deck.ngaus), repeat=2):
                values, slopes = shapes(deck.nnode, x[i], x[j])
                jacobian = slopes @ place
                slopes = np.linalg.solve(jacobian, slopes)
                radius = values @ place[:, 0]
                matrix = np.zeros((4, 2*deck.nnode))
                matrix[0, ::2], matrix[1, 1::2] = slopes[0], slopes[1]
                matrix[2, ::2], matrix[2, 1::2] = slopes[1], slopes[0]
                matrix[3, ::2] = values/radius
                b.append(matrix)
                weight.append(w[i]*w[j]*np.linalg.det(jacobian)*2*math.pi*radius)
                owner.append(material)
                nodes_of.append([2*k + c for k in nodes for c in (0, 1)])
                self.load[np.array(nodes)*2 + 1] += values*weight[-1]*deck.property[material][3]*deck.gravity
        self.b, self.weight = np.array(b), np.array(weight)
        self.owner, self.unknowns = np.array(owner), np.array(nodes_of)
        for nodes, values in deck.edges:
            self.press(nodes, np.array(values))
        for node, force in deck.point.items():
            self.load[2*node:2*node + 2] += force
        self.held = np.zeros(2*deck.n_nodes, bool)
        self.moved = np.zeros(2*deck.n_nodes)
        for node, (code, u, v) in deck.held.items():
            for c, (is_held, value) in enumerate(((code in (10, 11), u), (code in (1, 11), v))):
                if is_held:
                    self.held[2*node + c], self.moved[2*node + c] = True, value

    def press(self, nodes, values):
        """Pressure and tangential load of an edge, its body on the left, by NGAUS points"""
        for s, w in zip(*POINTS[self.deck.ngaus]):
            if len(nodes) == 3:
                f, df = np.array([s*(s - 1)/2, 1 - s*s, s*(s + 1)/2]), np.array([s - 0.5, -2*s, s + 0.5])
            else:
                f, df = np.array([1 - s, 1 + s])/2, np.array([-0.5, 0.5])
            place = self.deck.place[nodes]
            radius, along = f @ place[:, 0], df @ place
            normal, tangential = f @ values
            force = 2*math.pi*radius*w*np.array([tangential*along[0] - normal*along[1], tangential*along[1] + normal*along[0]])
            for k, node in enumerate(nodes):
                self.load[2*node:2*node + 2] += f[k]*force


def principal(stress):
    """Principal stresses of r, z, rz, theta and the two axes' cosine and sine of twice the angle"""
    middle, half = (stress[:, 0] + stress[:, 1])/2, (stress[:, 0] - stress[:, 1])/2
    radius = np.hypot(half, stress[:, 2])
    safe = np.where(radius > 0, radius, 1.0)
    return np.stack([middle + radius, middle - radius, stress[:, 3]], 1), np.where(radius > 0, half/safe, 1.0), stress[:, 2]/safe


def solve(deck, n_increments=None, tolerance=1e-11, most=20000):
    """States of increments, or of the first of them: displacements, reactions, stresses, effective plastic strain"""
    body = Body(deck)
    laws = {number: Criterion(deck.ncrit, values) for number, values in deck.property.items()}
    elastic = np.zeros((len(body.owner), 4, 4))
    for number, law in laws.items():
        d = np.zeros((4, 4))
        d[np.ix_([0, 1, 3], [0, 1, 3])] = law.elastic
        d[2, 2] = law.shear
        elastic[body.owner == number] = d
    n = 2*deck.n_nodes
    stiffness = np.zeros((n, n))
    parts = np.einsum('p,pki,pkl,plj->pij', body.weight, body.b, elastic, body.b)
    for unknowns, part in zip(body.unknowns, parts):
        stiffness[np.ix_(unknowns, unknowns)] += part
    free = np.flatnonzero(~body.held)
    inverse = np.linalg.inv(stiffness[np.ix_(free, free)])
    u, factor = np.zeros(n), 0.0
    plastic, gained = np.zeros((len(body.owner), 4)), np.zeros(len(body.owner))
    states = []

    def stresses(u):
        strain = np.einsum('pki,pi->pk', body.b, u[body.unknowns])
        trial = np.einsum('pkl,pl->pk', elastic, strain - plastic)
        three, cosine, sine = principal(trial)
        back, added = three.copy(), np.zeros(len(three))
        for number, law in laws.items():
            own = body.owner == number
            back[own], added[own] = law.bring_back(three[own], gained[own])
        middle, half = (back[:, 0] + back[:, 1])/2, (back[:, 0] - back[:, 1])/2
        stress = np.stack([middle + half*cosine, middle - half*cosine, half*sine, back[:, 2]], 1)
        forces = np.zeros(n)
        np.add.at(forces, body.unknowns, np.einsum('p,pki,pk->pi', body.weight, body.b, stress))
        return stress, added, trial, forces

    for step, *_ in deck.increments[:n_increments]:
        factor += step
        load = factor*body.load
        u[body.held] = factor*body.moved[body.held]
        tries, leftovers = [], []
        for _ in range(most):
            stress, added, trial, forces = stresses(u)
            rest = load - forces
            scale = max(np.linalg.norm(load[free]), np.linalg.norm(forces))
            if np.linalg.norm(rest[free]) <= tolerance*scale:
                break
            change = inverse @ rest[free]
            # Anderson's mixing of the last few iterates
            tries, leftovers = (tries + [u[free].copy()])[-8:], (leftovers + [change])[-8:]
            if len(tries) > 1:
                df = np.stack([b - a for a, b in zip(leftovers, leftovers[1:])], 1)
                dx = np.stack([b - a for a, b in zip(tries, tries[1:])], 1)
                share = np.linalg.lstsq(df, change, rcond=1e-12)[0]
                change = change - (dx + df) @ share
            u[free] += change
        else:
            raise AssertionError(f'no equilibrium at factor {factor}: {np.linalg.norm(rest[free])/scale:.2e}')
        plastic = plastic + np.einsum('pkl,pl->pk', np.linalg.inv(elastic), trial - stress)
        gained = gained + added
        states.append((factor, u.copy(), np.where(body.held, -rest, 0.0), stress, gained.copy()))
    return states


def e14(value):
    """E14.6"""
    if value == 0:
        return '  0.000000E+00'
    digits, power = f'{abs(value):.5E}'.split('E')
    power = int(power) + 1
    letter = f'E{power:+03d}' if abs(power) < 100 else f'{power:+04d}'
    return f'{"-" if value < 0 else ""}0.{digits.replace(".", "")}{letter}'.rjust(14)


def listing(deck, states):
    """The listing, with carriage control"""
    lines = ['1' + deck.title, '', '',
             f' NPOIN ={deck.n_nodes:4d}     NELEM ={deck.n_elements:4d}     NVFIX ={len(deck.held):4d}     '
             f'NTYPE ={deck.ntype:4d}     NNODE ={deck.nnode:4d}', '',
             f' NMATS ={len(deck.property):4d}     NGAUS ={deck.ngaus:4d}     NEVAB ={2*deck.nnode:4d}     NALGO ={deck.nalgo:4d}',
             '', f' NCRIT ={deck.ncrit:4d}     NINCS ={len(deck.increments):4d}     NSTRE =   4', '', '',
             ' ELEMENT   PROPERTY      NODE NUMBERS']
    lines += [f' {k:5d}{m:9d}      ' + ''.join(f'{i + 1:5d}' for i in nodes) for k, (m, nodes) in deck.elements.items()]
    lines += ['', '', ' NODE          X          Y']
    lines += [f' {k + 1:5d}{r:10.3f}{z:10.3f}' for k, (r, z) in enumerate(deck.place)]
    for k, ((factor, u, reaction, stress, strain), increment) in enumerate(zip(states, deck.increments)):
        amount = increment[3]
        lines += [f'0     INCREMENT NUMBER {k + 1:5d}', f'0     LOAD FACTOR ={factor:10.5f}']
        if amount > 0:
            lines += ['0     DISPLACEMENTS', '0      NODE      R-DISP.       Z-DISP.']
            lines += [f'{i + 1:10d}{e14(u[2*i])}{e14(u[2*i + 1])}' for i in range(deck.n_nodes)]
        if amount > 1:
            lines += ['0     REACTIONS', '0      NODE      R-REAC.       Z-REAC.']
            lines += [f'{i + 1:10d}{e14(reaction[2*i])}{e14(reaction[2*i + 1])}' for i in sorted(deck.held)]
        if amount > 2:
            lines += ['0  G.P.      RR-STRESS     ZZ-STRESS     RZ-STRESS     TT-STRESS      MAX P.S.      MIN P.S.   ANGLE'
                      '   E.P.S.']
            n = deck.ngaus**2
            for i, element in enumerate(deck.elements):
                lines.append(f'0     ELEMENT NO. ={element:5d}')
                for j in range(n):
                    s = stress[i*n + j]
                    (most, least, _), = principal(s[None])[0]
                    half = (s[0] - s[1])/2
                    angle = math.degrees(math.atan(s[2]/half))/2 if half else 0.0
                    lines.append(f'{j + 1:5d}  ' + ''.join(e14(v) for v in (*s, most, least)) + f'{angle:8.3f}{e14(strain[i*n + j])}')
    return '\n'.join(lines) + '\n'
