"""Rings in plane strain (v = 0): Lame, Michell, Lekhnitskii, with body forces and temperatures

Displacements of a mode m are sums of monomials (U, W) (r/s)^k ln(r/s)^q. With them the equations of
equilibrium of a material with C_rr, C_tt, C_rt, G_rt become M(k) (U, W) = -f, where

    M(k) = [ k S_r + m S_s - S_t ]      S_r = (C_rr k + C_rt, C_rt m)
           [ (k + 1) S_s - m S_t ]      S_t = (C_rt k + C_tt, C_tt m)
                                        S_s = G (-m, k - 1)

are the stresses sigma_r, sigma_theta, tau_rtheta of (U, W) r^k, over r^(k-1). Where det M(k) = 0 the
ring is free of load: four exponents (two for m = 0), for an isotropic ring +-(m + 1), +-(m - 1)
(Michell 1899; for cylindrical orthotropy Lekhnitskii, Anisotropic plates). A double root, and a load
at a root, needs a logarithm. The four constants follow from the conditions at both radii.
"""
import dataclasses

import numpy as np

from solution import SYMMETRIC, Solution, rows

# Components of displacement and stress that a condition may name
COMPONENTS = {"u": ("displacement", 0), "w": ("displacement", 2),
              "sigma_r": ("stress", 0), "tau": ("stress", 4)}


@dataclasses.dataclass
class Monomial:
    """(U, W) (r/s)^k ln(r/s)^q, q = 0 or 1"""
    amplitude: np.ndarray
    power: float
    log: int
    radius: float

    def value(self, r):
        """U and W times the function, shape (2, points)"""
        x = r/self.radius
        log = np.log(x) if self.log else 1.0
        return np.multiply.outer(self.amplitude, x**self.power*log)

    def slope(self, r):
        """Derivative by r"""
        x = r/self.radius
        by_r = self.power*np.log(x) + 1.0 if self.log else self.power
        return np.multiply.outer(self.amplitude, x**(self.power - 1)*by_r)/self.radius


def displacement_of(monomials, r):
    """u and w of a sum of monomials, shape (2, points)"""
    return sum(term.value(r) for term in monomials)


def stress_of(monomials, m, d, r, free=0.0):
    """Six stresses of a sum of monomials; `free` are the thermal stresses D alpha T"""
    u, w = displacement_of(monomials, r)
    u_r, w_r = sum(term.slope(r) for term in monomials)
    strain_r, strain_theta = u_r, (u + m*w)/r
    shear = w_r - (w + m*u)/r
    none = 0*u
    return np.array([d[0, 0]*strain_r + d[0, 2]*strain_theta, d[1, 0]*strain_r + d[1, 2]*strain_theta,
                     d[2, 0]*strain_r + d[2, 2]*strain_theta, none, d[4, 4]*shear, none]) - free


def balance_matrix(k, m, d):
    """M(k), shape (2, 2)"""
    s_r = np.array([d[0, 0]*k + d[0, 2], d[0, 2]*m])
    s_t = np.array([d[0, 2]*k + d[2, 2], d[2, 2]*m])
    s_s = d[4, 4]*np.array([-m, k - 1.0])
    return np.array([k*s_r + m*s_s - s_t, (k + 1)*s_s - m*s_t])


def balance_slope(k, m, d):
    """dM/dk: M is a quadratic in k, so a central difference is exact"""
    return (balance_matrix(k + 1, m, d) - balance_matrix(k - 1, m, d))/2


def exponents(m, d):
    """The exponents of load-free modes; det M is a quadratic in k^2"""
    if m == 0:
        root = np.sqrt(d[2, 2]/d[0, 0])
        return [root, -root]
    if abs(d[0, 0] - d[2, 2]) < 1e-12*d[0, 0]:
        return [m + 1.0, m - 1.0, 1.0 - m, -1.0 - m]
    k = np.array([0.0, 1.0, 2.0])
    squares = np.roots(np.polyfit(k**2, [np.linalg.det(balance_matrix(x, m, d)) for x in k], 2))
    if m == 1:
        # The rigid motion, a double root
        squares[np.argmin(np.abs(squares))] = 0.0
    roots = np.sqrt(squares)
    assert np.isrealobj(roots), "complex exponents"
    return [*roots, *-roots]


def null_vector(matrix):
    """Vector that a singular 2 x 2 matrix turns to zero"""
    return np.linalg.svd(matrix)[2][-1]


def free_modes(m, d, inner, outer):
    """Load-free modes, each a list of monomials; growing ones scaled to the outer radius"""
    modes = []
    for k in exponents(m, d):
        radius = outer if k > 0 else inner or outer
        if m == 0:
            modes.append([Monomial(np.array([1.0, 0.0]), k, 0, radius)])
            continue
        vector = null_vector(balance_matrix(k, m, d))
        plain = Monomial(vector, k, 0, radius)
        if k == 0.0 and any(term.power == 0.0 for mode in modes for term in mode):
            companion = np.linalg.lstsq(balance_matrix(0.0, m, d),
                                        -balance_slope(0.0, m, d) @ vector, rcond=None)[0]
            modes.append([Monomial(vector, 0.0, 1, radius), Monomial(companion, 0.0, 0, radius)])
        else:
            modes.append([plain])
    return modes


def particular(m, d, power, force, radius):
    """Monomials in balance with a body force (f_r, f_theta) (r/s)^(power - 2)"""
    matrix = balance_matrix(power, m, d)
    right = -np.asarray(force)*radius**2
    if not np.any(right):
        return []
    if m == 0:
        return [Monomial(np.array([right[0]/matrix[0, 0], 0.0]), power, 0, radius)]
    vector = null_vector(matrix)
    system = np.column_stack([matrix, balance_slope(power, m, d) @ vector])
    if np.linalg.cond(matrix) < 1e12:
        return [Monomial(np.linalg.solve(matrix, right), power, 0, radius)]
    found = np.linalg.lstsq(system, right, rcond=1e-12)[0]
    return [Monomial(found[:2], power, 0, radius), Monomial(found[2]*vector, power, 1, radius)]


class Ring:
    """Modes of one ring, whose factors are to be found from conditions"""

    def __init__(self, material, m, inner, outer, spin=0.0, lateral=0.0, temperatures=()):
        """Radii (inner 0: a disc); square of the angular velocity (m = 0); acceleration along
        theta = 0 (m = 1); temperature as pairs (T, k) of terms T r^k"""
        self.material, self.m, self.inner, self.outer = material, m, inner, outer
        self.spin, self.lateral, self.temperatures = spin, lateral, temperatures
        d = material.elasticity()
        self.d, self.heat = d, d @ material.expansions()
        modes = free_modes(m, d, inner, outer)
        if inner == 0.0:
            # In a disc: no power below 1, the rigid motion of m = 1 apart
            modes = [mode for mode in modes
                     if mode[0].power > 0 or (m == 1 and mode[0].power == 0 and len(mode) == 1)]
        self.modes = modes
        self.loaded = self._loaded()
        self.factors = np.zeros(len(modes))

    def _loaded(self):
        terms = []
        density = self.material.density
        if self.spin:
            terms += particular(self.m, self.d, 3.0, [density*self.spin*self.outer, 0.0], self.outer)
        if self.lateral:
            force = density*self.lateral*np.array([1.0, -1.0])
            terms += particular(self.m, self.d, 2.0, force, self.outer)
        for value, k in self.temperatures:
            # Equilibrium of -D alpha T; T r^k = T s^k (r/s)^k
            force = value*self.outer**(k - 1)*np.array(
                [-(k*self.heat[0] + self.heat[0] - self.heat[2]), self.m*self.heat[2]])
            terms += particular(self.m, self.d, k + 1.0, force, self.outer)
        return terms

    def temperature(self, r):
        """Amplitude of the temperature"""
        return sum((value*r**k for value, k in self.temperatures), 0.0*r)

    def _component(self, terms, component, r, free):
        field, index = COMPONENTS[component]
        if not terms:
            return -free[index] if field == "stress" else 0.0
        if field == "displacement":
            return displacement_of(terms, r)[index//2]
        return stress_of(terms, self.m, self.d, r, free)[index]

    def row(self, component, r):
        """A component at r as a linear function of the factors: coefficients and constant"""
        r = np.float64(r)
        none = np.zeros(6)
        return (np.array([self._component(mode, component, r, none) for mode in self.modes]),
                self._component(self.loaded, component, r, self.heat*self.temperature(r)))

    def monomials(self):
        """All monomials with their factors"""
        scaled = [Monomial(factor*term.amplitude, term.power, term.log, term.radius)
                  for factor, mode in zip(self.factors, self.modes) for term in mode]
        return scaled + self.loaded

    def solution(self, name, family, conditions=()):
        """The ring as an exact solution; conditions: (component, r, value)"""
        terms, m, density = self.monomials(), self.m, self.material.density

        def displacement(r, z):
            u, w = displacement_of(terms, r)
            return rows(r, z, u, 0.0, w)

        def stress(r, z):
            free = np.multiply.outer(self.heat, self.temperature(r))
            return rows(r, z, *stress_of(terms, m, self.d, r, free))

        def body_force(r, z):
            return rows(r, z, density*(self.spin*r + self.lateral), 0.0, -density*self.lateral)

        surface = [(COMPONENTS[name_][0], np.float64(r), np.float64(0.0), COMPONENTS[name_][1], value)
                   for name_, r, value in conditions]
        least = self.inner or 1e-3*self.outer
        return Solution(name, m, self.material, displacement, stress, family, body_force,
                        lambda r, z: rows(r, z, self.temperature(r))[0],
                        (least, self.outer, 0.0, 1.0), surface)


def solve_rings(equations, rings):
    """Sets the factors of rings. An equation: terms [(ring, component, r, factor)] and their sum"""
    starts = np.cumsum([0] + [len(ring.modes) for ring in rings])
    matrix = np.zeros((len(equations), starts[-1]))
    right = np.zeros(len(equations))
    for i, (terms, total) in enumerate(equations):
        right[i] = total
        for ring, component, r, factor in terms:
            coefficients, constant = ring.row(component, r)
            j = rings.index(ring)
            matrix[i, starts[j]:starts[j + 1]] += factor*coefficients
            right[i] -= factor*constant
    scale = np.abs(matrix).max(axis=1)
    factors = np.linalg.lstsq(matrix/scale[:, None], right/scale, rcond=1e-13)[0]
    for j, ring in enumerate(rings):
        ring.factors = factors[starts[j]:starts[j + 1]]


def ring_solution(name, material, m, radii, conditions, family=SYMMETRIC, **loads):
    """One ring under conditions (component, r, value) at its surfaces"""
    ring = Ring(material, m, *radii, **loads)
    if m == 0:
        conditions = [condition for condition in conditions if condition[0] in ("u", "sigma_r")]
    solve_rings([([(ring, component, r, 1.0)], value) for component, r, value in conditions], [ring])
    return ring.solution(name, family, conditions)


def joined_rings(name, materials, m, radii, stiffness, conditions, family=SYMMETRIC):
    """Two rings with an elastic joint at the middle radius: normal and circumferential stiffness"""
    a, c, b = radii
    inside, outside = Ring(materials[0], m, a, c), Ring(materials[1], m, c, b)
    equations = [([(inside if r < c else outside, component, r, 1.0)], value)
                 for component, r, value in conditions]
    for stress, jump, k in zip(("sigma_r", "tau"), ("u", "w"), stiffness):
        equations.append(([(inside, stress, c, 1.0), (outside, stress, c, -1.0)], 0.0))
        equations.append(([(outside, jump, c, 1.0), (inside, jump, c, -1.0),
                           (inside, stress, c, -1.0/k)], 0.0))
    if m == 0:
        equations = [e for e in equations if e[0][0][1] in ("u", "sigma_r")]
    solve_rings(equations, [inside, outside])
    return [ring.solution(name, family, [k for k in conditions if (k[1] < c) == (ring is inside)])
            for ring in (inside, outside)]
