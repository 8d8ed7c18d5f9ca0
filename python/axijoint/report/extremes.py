"""The largest values of a result, and where they are."""
from functools import lru_cache

import numpy as np

from ..components import DISPLACEMENTS, STRESSES
from ..joint_points import JointPoints
from .waves import Waves

# Components that go round the axis
AROUND = ("w", "tau_rtheta", "tau_ztheta")
# What is looked for in joints, of a JointField
JOINT_VALUES = {"pressure": lambda field: -field.sigma, "tension": lambda field: field.sigma,
                "shear stress": lambda field: field.tau, "gap": lambda field: field.gap, "slip": lambda field: field.slip}
# Of joints that do not yield: which amplitudes, of which components, with which sign
JOINT_WAVES = {"pressure": ("stress", [1], -1), "tension": ("stress", [1], 1), "shear stress": ("stress", [0, 2], 1),
               "gap": ("gap", [1], 1), "slip": ("jump", [0, 2], 1)}


class Peak:
    """A value and its place: r, z, theta [degree], and in words what is there."""

    def __init__(self, value, position, theta, where):
        self.value, self.theta, self.where = float(value), float(theta), where
        self.r, self.z = (float(x) for x in position)

    def cells(self):
        """Cells of a table."""
        return [self.value, self.r, self.z, self.theta, self.where]


@lru_cache(maxsize=4)
def extremes(result):
    """Smallest and largest of each component, and the largest length of the displacement: name -> Peaks.

    Displacements are those of the nodes, stresses those smoothed to the nodes, anywhere round the circle.
    """
    mesh, owner = result.mesh, result.read("stress/nodal_node") - 1

    def peak(amplitude, names, nodes, sign):
        value, point, theta = Waves(result.harmonic, result.family, amplitude, [name in AROUND for name in names]).largest(sign)
        return Peak(value, mesh.coordinates[nodes[point]], theta, f"node {mesh.node_label[nodes[point]]}")
    every, moved = np.arange(len(mesh.node_label)), result.displacement_amplitude
    found = {"length": [peak(moved, DISPLACEMENTS, every, 1)]}
    for names, amplitude, nodes in ((DISPLACEMENTS, moved, every), (STRESSES, result.nodal_amplitude, owner)):
        found |= {name: [peak(amplitude[..., k, None], [name], nodes, sign) for sign in (-1, 1)] for k, name in enumerate(names)}
    return found


def joint_peaks(result, joints=None):
    """Largest pressure, tension, shear stress, gap and slip of all joints or of some (index): name -> Peak.

    Without tension, or without a gap, their value is 0 or less. Of joints that yield they are those on the planes of their
    law, of others anywhere round the circle, as the program tells them.
    """
    points = JointPoints(result)
    owner, position, labels = points.owner, result.read("joints/position"), result.mesh.joint_label
    chosen = np.flatnonzero(np.isin(owner, owner if joints is None else joints))
    largest, known = (_on_planes, points.on_planes()) if points.yields else (_anywhere, points.amplitudes())
    found = {}
    for name in JOINT_VALUES:
        value, one, theta = largest(known, name, chosen)
        point = chosen[one]
        place = point - np.searchsorted(owner, owner[point]) + 1
        found[name] = Peak(value, position[point], theta, f"joint {labels[owner[point]]}, point {place}")
    return found


def _on_planes(field, name, chosen):
    """The largest value of some joint points on the planes of their law, which of them it is of, and the angle."""
    values = JOINT_VALUES[name](field)[:, chosen].T
    values = np.where(np.isfinite(values), values, -np.inf)
    point, plane = np.unravel_index(values.argmax(), values.shape)
    return values[point, plane], point, field.theta[plane]


def _anywhere(known, name, chosen):
    """The same anywhere round the circle, of amplitudes."""
    of, components, sign = JOINT_WAVES[name]
    harmonic, family, amplitudes = known
    value, point, theta = Waves(harmonic, family, amplitudes[of][:, chosen][..., components],
                                [k == 2 for k in components]).largest(sign)
    value *= sign
    return max(value, 0) if name == "gap" else value, point, theta
