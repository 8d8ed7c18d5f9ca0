"""Exact solutions in polynomials: rigid motions, constant strain, bending, flexure, weight, potentials

All bodies may touch the axis. Stresses are written out by hand; residual.py compares them with the
displacements.
"""
import numpy as np

from solution import SYMMETRIC, Solution, rows

SOLID = (1e-3, 1.0, 0.0, 2.0)


def rigid_motions(material, family):
    """Rigid motions that a family has: m = 0 along z or round it; m = 1 along x and round y"""
    def stress(r, z):
        return rows(r, z, *[0.0]*6)

    def add(name, m, displacement):
        motions.append(Solution(name, m, material, displacement, stress, family, region=SOLID))

    motions = []
    if family == SYMMETRIC:
        add("translation along z", 0, lambda r, z: rows(r, z, 0.0, 1.0, 0.0))
    else:
        add("rotation round z", 0, lambda r, z: rows(r, z, 0.0, 0.0, r))
    # A translation and a rotation in one, as both are of harmonic 1
    add("translation and rotation across z", 1, lambda r, z: rows(r, z, 1.0 + z, -r, -1.0 - z))
    return motions


def constant_strain(material, family=SYMMETRIC):
    """States of constant strain in x, y, z: m = 0 (e_xx = e_yy, e_zz), m = 1 (g_xz), m = 2
    (e_xx = -e_yy); antisymmetric g_yz and g_xy"""
    young, nu, g = material.young, material.poisson, material.shear
    a, b, c, d, e = 1.0e-3, -0.4e-3, 0.7e-3, -0.3e-3, 0.9e-3
    factor = young/((1 + nu)*(1 - 2*nu))
    sigma_r, sigma_z = factor*(a + nu*b), factor*((1 - nu)*b + 2*nu*a)
    states = []
    if family == SYMMETRIC:
        states.append(Solution("constant strain", 0, material,
                               lambda r, z: rows(r, z, a*r, b*z, 0.0),
                               lambda r, z: rows(r, z, sigma_r, sigma_z, sigma_r, 0.0, 0.0, 0.0),
                               family, region=SOLID))
    states.append(Solution("constant strain", 1, material,
                           lambda r, z: rows(r, z, c*z, d*r, -c*z),
                           lambda r, z: rows(r, z, 0.0, 0.0, 0.0, g*(c + d), 0.0, -g*(c + d)),
                           family, region=SOLID))
    states.append(Solution("constant strain", 2, material,
                           lambda r, z: rows(r, z, e*r, 0.0, -e*r),
                           lambda r, z: rows(r, z, 2*g*e, 0.0, -2*g*e, 0.0, -2*g*e, 0.0),
                           family, region=SOLID))
    return states


def turned_patch(material):
    """Constant strain m = 0 of a solid with turned orthotropy: u = a r, v = b z + c r, with b and c
    such that sigma_r = sigma_theta and tau_rz = 0, as equilibrium wants of constant stress"""
    stiffness, a = material.elasticity(), 1.0e-3
    columns = stiffness[:, [1, 3]]
    equations = np.array([columns[0] - columns[2], columns[3]])
    base = stiffness[:, [0, 2]].sum(axis=1)*a
    b, c = np.linalg.solve(equations, -np.array([base[0] - base[2], base[3]]))
    sigma = base + columns @ [b, c]
    return Solution("constant strain, turned orthotropy", 0, material,
                    lambda r, z: rows(r, z, a*r, b*z + c*r, 0.0),
                    lambda r, z: rows(r, z, sigma[0], sigma[1], sigma[2], 0.0, 0.0, 0.0),
                    region=(0.5, 1.0, 0.0, 1.0))


def pure_bending(material, family=SYMMETRIC):
    """Bending of a shaft by end moments: sigma_z = E kappa r cos theta (Timoshenko and Goodier)"""
    young, nu, kappa = material.young, material.poisson, 1.0e-3
    return Solution("pure bending", 1, material,
                    lambda r, z: rows(r, z, -kappa/2*(z**2 + nu*r**2), kappa*r*z,
                                      kappa/2*(z**2 - nu*r**2)),
                    lambda r, z: rows(r, z, 0.0, young*kappa*r, 0.0, 0.0, 0.0, 0.0),
                    family, region=SOLID)


def flexure(material, radius=1.0, length=2.0, force=1.0):
    """St-Venant's flexure of a cantilever of circular section by a lateral force at z = length, held
    near z = 0: sigma_z = -P (L - z) x/I; in x, y the shear stresses of Timoshenko and Goodier"""
    young, nu, g = material.young, material.poisson, material.shear
    inertia = np.pi*radius**4/4
    slope = force/(young*inertia)
    shear = force*(3 + 2*nu)/(8*inertia*(1 + nu))
    ratio = (1 - 2*nu)/(3 + 2*nu)
    warp = nu*slope/2 - shear/g

    def displacement(r, z):
        curvature = slope*(z - length)
        turn = slope*(z**2/2 - length*z)
        deflection = slope*(length*z**2/2 - z**3/6)
        warping = shear*radius**2*r/g + warp*r**3/3
        return rows(r, z, deflection - nu*curvature*r**2/2, turn*r + warping,
                    -deflection - nu*curvature*r**2/2)

    def stress(r, z):
        return rows(r, z, 0.0, force*(z - length)*r/inertia, 0.0, shear*(radius**2 - r**2), 0.0,
                    -shear*(radius**2 - ratio*r**2))

    return Solution("flexure", 1, material, displacement, stress, region=(1e-3, radius, 0.0, length))


def hanging_column(material, gravity=10.0, length=2.0):
    """A column under its weight, hung at z = length: sigma_z = rho g z, nothing else"""
    weight = material.density*gravity
    nu, c = material.poisson, weight/material.young
    return Solution("self weight", 0, material,
                    lambda r, z: rows(r, z, -nu*c*r*z, c/2*(z**2 + nu*r**2 - length**2), 0.0),
                    lambda r, z: rows(r, z, 0.0, weight*z, 0.0, 0.0, 0.0, 0.0),
                    body_force=lambda r, z: rows(r, z, 0.0, -weight, 0.0), region=SOLID)


def shear_column(material, gravity=10.0, length=2.0, family=SYMMETRIC):
    """A solid column under lateral gravity: u_x = k (L^2 - z^2) in pure shear, tau_xz = -rho g z; its
    mantle carries t_z = -rho g z cos theta"""
    weight = material.density*gravity
    k = weight/(2*material.shear)
    return Solution("lateral gravity, shear", 1, material,
                    lambda r, z: rows(r, z, k*(length**2 - z**2), 0.0, k*(z**2 - length**2)),
                    lambda r, z: rows(r, z, 0.0, 0.0, 0.0, -weight*z, 0.0, weight*z),
                    family, body_force=lambda r, z: rows(r, z, weight, 0.0, -weight), region=SOLID)


def harmonic_gradient(material, m, family=SYMMETRIC):
    """u = grad(r^m z cos m theta): quadratic for m = 2; no change of volume, sigma = 2 G grad u"""
    a, g = 1.0e-3, material.shear

    def displacement(r, z):
        return rows(r, z, a*m*r**(m - 1)*z, a*r**m, -a*m*r**(m - 1)*z)

    def stress(r, z):
        second = 2*g*a*m*(m - 1)*r**(m - 2)*z
        mixed = 2*g*a*m*r**(m - 1)
        return rows(r, z, second, 0.0, -second, mixed, -second, -mixed)

    return Solution(f"gradient of r^{m} z cos {m} theta", m, material, displacement, stress, family,
                    region=SOLID)


def boussinesq_field(material, m, family=SYMMETRIC):
    """2 G u = grad(z psi) - 4 (1 - nu) psi e_z with the harmonic psi = r^m z cos m theta"""
    a, g, nu = 1.0e-3, material.shear, material.poisson

    def displacement(r, z):
        return rows(r, z, a*m*r**(m - 1)*z**2, a*(2 - 4*(1 - nu))*r**m*z, -a*m*r**(m - 1)*z**2)

    def stress(r, z):
        volume = -4*nu*g*a*r**m  # lambda times the change of volume
        second = 2*g*a*m*(m - 1)*r**(m - 2)*z**2
        mixed = g*a*m*r**(m - 1)*z*(4 - 4*(1 - nu))
        return rows(r, z, volume + second, volume + 2*g*a*(2 - 4*(1 - nu))*r**m, volume - second,
                    mixed, -second, -mixed)

    return Solution(f"Boussinesq field of r^{m} z cos {m} theta", m, material, displacement, stress,
                    family, region=SOLID)
