"""What an exact solution is: amplitudes of displacement and stress of one mode, as functions of r, z

Amplitudes multiply cos(m theta) and sin(m theta) as in doc/results.md: symmetric (1) u, v ~ cos,
w ~ sin; antisymmetric (2) u, v ~ sin, w ~ -cos. All functions also take complex r and z, so that
they can be differentiated by complex steps.
"""
import dataclasses
from typing import Callable

import numpy as np

SYMMETRIC, ANTISYMMETRIC = 1, 2
FAMILY_LETTER = {SYMMETRIC: "S", ANTISYMMETRIC: "A"}


def rows(r, z, *components):
    """Stacks components, each a number or an array like r, to an array (components, points)"""
    shape = np.broadcast(r, z).shape
    return np.array([np.broadcast_to(component, shape) for component in components])


def no_body_force(r, z):
    """Without body force"""
    return rows(r, z, 0.0, 0.0, 0.0)


def no_temperature(r, z):
    """Without change of temperature"""
    return rows(r, z, 0.0)[0]


@dataclasses.dataclass
class Solution:
    """One mode of an exact solution"""
    name: str
    harmonic: int
    material: object
    # u, v, w [length], shape (3, points); r, z, theta, rz, r-theta, z-theta [stress], (6, points)
    displacement: Callable
    stress: Callable
    family: int = SYMMETRIC
    # Force per volume along r, z, theta, shape (3, points); change of temperature, (points)
    body_force: Callable = no_body_force
    temperature: Callable = no_temperature
    # Least and largest r and z of the body, for random points
    region: tuple = (0.1, 1.0, 0.0, 1.0)
    # Conditions on the surface: (r, z, index of the stress or displacement, value wanted)
    surface: list = dataclasses.field(default_factory=list)

    @property
    def mode(self):
        """Harmonic and family"""
        return self.harmonic, self.family

    def traction(self, r, z, n_r, n_z):
        """Amplitudes of t_r, t_z, t_theta on a surface with outward normal n, shape (3, points)"""
        s = self.stress(r, z)
        return np.array([s[0]*n_r + s[3]*n_z, s[3]*n_r + s[1]*n_z, s[4]*n_r + s[5]*n_z])
