"""Torsion: the antisymmetric mode of harmonic 0, u_theta = -w"""
import numpy as np

from solution import ANTISYMMETRIC, Solution, rows


def shaft(material, twist=1.0e-3):
    """A circular shaft under end torques: u_theta = twist r z"""
    g = material.shear
    return Solution("torsion of a shaft", 0, material,
                    lambda r, z: rows(r, z, 0.0, 0.0, -twist*r*z),
                    lambda r, z: rows(r, z, 0.0, 0.0, 0.0, 0.0, 0.0, -g*twist*r),
                    ANTISYMMETRIC, region=(1e-3, 1.0, 0.0, 2.0))


def cone(material, strength=1.0e-3):
    """A cone with its apex at the origin under end torques (Michell): u_theta = C r/R^3"""
    g = material.shear

    def displacement(r, z):
        return rows(r, z, 0.0, 0.0, -strength*r*(r**2 + z**2)**-1.5)

    def stress(r, z):
        factor = 3*g*strength*r*(r**2 + z**2)**-2.5
        return rows(r, z, 0.0, 0.0, 0.0, 0.0, factor*r, factor*z)

    return Solution("torsion of a cone", 0, material, displacement, stress, ANTISYMMETRIC,
                    region=(1e-3, 1.0, 1.0, 2.0))


def sheared_ring(material, inner, outer, stress):
    """A ring twisted by shear on its inner surface against its outer one, which is held:
    tau_rtheta = tau a^2/r^2"""
    factor = stress*inner**2/(2*material.shear)

    def displacement(r, z):
        return rows(r, z, 0.0, 0.0, -factor*(r/outer**2 - 1/r))

    def stresses(r, z):
        return rows(r, z, 0.0, 0.0, 0.0, 0.0, -stress*inner**2/r**2, 0.0)

    return Solution("ring in torsion", 0, material, displacement, stresses, ANTISYMMETRIC,
                    region=(inner, outer, 0.0, 1.0),
                    surface=[("displacement", np.float64(outer), np.float64(0.0), 2, 0.0)])
