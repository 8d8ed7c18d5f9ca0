"""The largest values of a result, and where they are."""
from functools import lru_cache

import numpy as np

from ..circle import SYMMETRIC
from ..components import DISPLACEMENTS, STRESSES

# Step of the angles at which nodes are looked at [degree], as in what the program says at the end of a run
STEP = 5.0


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


def joint_peaks(joints):
    """Largest pressure, tension, shear stress, gap and slip of a table of joint points: name -> Peak.

    Without tension, or without a gap, their value is 0 or less.
    """
    columns = {"pressure": -joints["sigma"], "tension": joints["sigma"], "shear stress": joints["tau"],
               "gap": joints["gap"], "slip": joints["slip"]}
    found = {}
    for name, values in columns.items():
        row = int(np.argmax(np.where(np.isfinite(values), values, -np.inf)))
        found[name] = Peak(values[row], (joints["r"][row], joints["z"][row]), joints["theta"][row],
                           f"joint {joints['joint'][row]}, point {joints['point'][row]}")
    return found
