"""The largest values of a result, and where they are."""
from functools import lru_cache

import numpy as np

from ..circle import SYMMETRIC
from ..components import DISPLACEMENTS, STRESSES
from ..joint_points import JointPoints

# Step of the angles at which nodes are looked at [degree], as in what the program says at the end of a run
STEP = 5.0
# Where joints do not yield, between these: steps to where it is looked for something larger, and the least of them [degree]
AROUND, LEAST_STEP = np.array([0, 0.25, -0.25, 0.5, -0.5, 0.75, -0.75, 1, -1]), 1e-4
# What is looked for in joints, of a JointField
JOINT_VALUES = {"pressure": lambda field: -field.sigma, "tension": lambda field: field.sigma,
                "shear stress": lambda field: field.tau, "gap": lambda field: field.gap, "slip": lambda field: field.slip}


class Peak:
    """A value and its place: r, z, theta [degree], and in words what is there."""

    def __init__(self, value, position, theta, where):
        self.value, self.theta, self.where = float(value), float(theta), where
        self.r, self.z = (float(x) for x in position)

    def cells(self):
        """Cells of a table."""
        return [self.value, self.r, self.z, self.theta, self.where]


def angles(result):
    """Angles at which nodes are looked at; half a circle if all is symmetric."""
    end = 180 if (result.family == SYMMETRIC).all() else 360 - STEP
    return np.arange(0.0, end + STEP/2, STEP)


@lru_cache(maxsize=4)
def extremes(result):
    """Smallest and largest of each component, and of the length of the displacement: name -> two Peaks.

    Displacements are those of the nodes, stresses those smoothed to the nodes.
    """
    found = {}
    labels = result.mesh.node_label
    owner = result.read("stress/nodal_node") - 1
    for theta in angles(result):
        moved, stress = result.nodal_displacement(theta), result.nodal_stress_values(theta)
        for names, values, nodes in ((("length",), np.linalg.norm(moved, axis=1)[:, None], None),
                                     (DISPLACEMENTS, moved, None), (STRESSES, stress, owner)):
            _keep(found, names, np.where(np.isfinite(values), values, 0.0), nodes, theta)
    return {name: [Peak(value, result.mesh.coordinates[node], theta, f"node {labels[node]}")
                   for value, node, theta in pair] for name, pair in found.items()}


def _keep(found, names, values, nodes, theta):
    """Replace what is surpassed at an angle."""
    low, high = values.argmin(axis=0), values.argmax(axis=0)
    for k, name in enumerate(names):
        here = [(values[row, k], row if nodes is None else nodes[row], theta) for row in (low[k], high[k])]
        before = found.setdefault(name, here)
        before[0] = min(before[0], here[0], key=lambda one: one[0])
        before[1] = max(before[1], here[1], key=lambda one: one[0])


def joint_peaks(result, joints=None):
    """Largest pressure, tension, shear stress, gap and slip of all joints or of some (index): name -> Peak.

    Without tension, or without a gap, their value is 0 or less. Of joints that yield they are those on the planes of their
    law, of others anywhere round the circle, as the program tells them.
    """
    owner, position, labels = JointPoints(result).owner, result.read("joints/position"), result.mesh.joint_label
    chosen = np.flatnonzero(np.isin(owner, owner if joints is None else joints))
    found = {}
    for name, (values, theta) in _largest_of_points(result).items():
        point = chosen[values[chosen].argmax()]
        place = point - np.searchsorted(owner, owner[point]) + 1
        found[name] = Peak(values[point], position[point], theta[point], f"joint {labels[owner[point]]}, point {place}")
    return found


@lru_cache(maxsize=4)
def _largest_of_points(result):
    """The largest values of each joint point, and the angles where they are: name -> two arrays (points)."""
    points = JointPoints(result)
    field, found = points.part(), {}
    for name, of in JOINT_VALUES.items():
        values = np.where(np.isfinite(of(field)), of(field), -np.inf)
        largest, theta = values.max(axis=0), field.theta[values.argmax(axis=0)]
        found[name] = (largest, theta) if points.yields else _climbed(points, of, theta, field.theta[1] - field.theta[0])
    return found


def _climbed(points, of, theta, step):
    """The largest values of joint points, and where, between the angles beside some [degree]."""
    while step > LEAST_STEP:
        tried = theta + step*AROUND[:, None]
        values = of(points.at(tried))
        theta = np.take_along_axis(tried, values.argmax(axis=0)[None], 0)[0]
        step /= 4
    return values.max(axis=0), theta % 360
