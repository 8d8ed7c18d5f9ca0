"""Checks exact solutions: equilibrium in cylindrical coordinates, Hooke's law, surface conditions

Derivatives are complex steps, Im f(x + ih)/h: exact to rounding, and independent of the derivatives
that the solution's author took by hand.
"""
import numpy as np

STEP = 1e-30
POINTS = 200
ALLOWED = 1e-10


class ResidualError(Exception):
    """A solution that does not satisfy its equations"""


def derivatives(function, r, z):
    """Value, derivative by r and by z"""
    return (function(r, z), function(r + 1j*STEP, z + 0j).imag/STEP,
            function(r + 0j, z + 1j*STEP).imag/STEP)


def strain_terms(solution, r, z):
    """The terms that make up each of the six strains, shape (6, 3, points)"""
    m = solution.harmonic
    (u, v, w), (u_r, v_r, w_r), (u_z, v_z, w_z) = derivatives(solution.displacement, r, z)
    zero = 0*u
    return np.array([[u_r, zero, zero], [v_z, zero, zero], [u/r, m*w/r, zero],
                     [u_z, v_r, zero], [-m*u/r, w_r, -w/r], [w_z, -m*v/r, zero]])


def equilibrium_terms(solution, r, z):
    """The terms of the three equations of equilibrium, shape (3, 6, points)"""
    m = solution.harmonic
    s, by_r, by_z = derivatives(solution.stress, r, z)
    f = solution.body_force(r, z)
    zero = 0*s[0]
    return np.array([
        [by_r[0], by_z[3], m*s[4]/r, s[0]/r, -s[2]/r, f[0] + zero],
        [by_r[3], by_z[1], m*s[5]/r, s[3]/r, zero, f[1] + zero],
        [by_r[4], by_z[5], -m*s[2]/r, 2*s[4]/r, zero, f[2] + zero]])


def random_points(solution):
    """Points in the region of a solution, the same in every run"""
    generator = np.random.default_rng(1985)
    r0, r1, z0, z1 = solution.region
    return (r0 + (r1 - r0)*generator.random(POINTS), z0 + (z1 - z0)*generator.random(POINTS))


def ratio(residual, scale):
    """Largest residual over scale; 0 if there is nothing at all"""
    largest = np.max(np.abs(residual))
    return 0.0 if largest == 0.0 else largest/scale


def residuals(solution):
    """Largest residuals of equilibrium, of Hooke's law and of the surface conditions, each over the
    size of the terms that cancel in it"""
    r, z = random_points(solution)
    stress = solution.stress(r, z)
    d, expansions = solution.material.elasticity(), solution.material.expansions()
    terms = strain_terms(solution, r, z)
    free = np.outer(expansions, solution.temperature(r, z))
    hooke = stress - d @ (terms.sum(axis=1) - free)
    size = np.abs(d) @ (np.abs(terms).sum(axis=1) + np.abs(free))
    balance = equilibrium_terms(solution, r, z)
    return {"equilibrium": ratio(balance.sum(axis=1), np.max(np.abs(balance).sum(axis=1))
                                 + np.max(size)/max(abs(x) for x in solution.region)),
            "hooke": ratio(hooke, np.max(size)),
            "surface": surface_residual(solution, np.max(size))}


def surface_residual(solution, stress_scale):
    """Largest fault of the surface conditions, relative to the stresses or displacements"""
    worst = 0.0
    r, z = random_points(solution)
    displacement_scale = np.max(np.abs(solution.displacement(r, z)))
    for field, at_r, at_z, component, value in solution.surface:
        if field == "stress":
            found, scale = solution.stress(at_r, at_z), max(stress_scale, abs(value))
        else:
            found, scale = solution.displacement(at_r, at_z), displacement_scale
        worst = max(worst, np.max(np.abs(found[component] - value))/scale)
    return worst


def check(solution):
    """Residuals of a solution; raises ResidualError if one is too large"""
    found = residuals(solution)
    for name, value in found.items():
        if not value <= ALLOWED:
            raise ResidualError(f"{solution.name}, m = {solution.harmonic}: residual of {name} is "
                                f"{value:.1e}, allowed {ALLOWED:.0e}: the solution is not exact")
    return found
