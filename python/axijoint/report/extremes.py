"""The largest values of a result, and where they are."""
from functools import lru_cache

import numpy as np

from ..circle import SYMMETRIC, totals
from ..components import DISPLACEMENTS, STRESSES
from ..joint_points import JointPoints

# Angles at which nodes are looked at first: the fewest, and for each wave of the highest harmonic
LEAST_ANGLES, ANGLES_OF_A_WAVE = 72, 16
# A sum of harmonics grows between these by at most (M step)^2/8 of its largest size, the square of a length by four times as much
GROWTH = (2*np.pi/ANGLES_OF_A_WAVE)**2/8*4
# Between angles, at nodes and where joints do not yield: steps to where it is looked for something larger, and the least
# of them [degree]
AROUND, LEAST_STEP = np.array([0, 0.25, -0.25, 0.5, -0.5, 0.75, -0.75, 1, -1]), 1e-4
# A share by which values at two angles differ by rounding
ROUNDING = 1e-12
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


@lru_cache(maxsize=4)
def extremes(result):
    """Smallest and largest of each component, and of the length of the displacement: name -> two Peaks.

    Displacements are those of the nodes, stresses those smoothed to the nodes, anywhere round the circle.
    """
    mesh, found = result.mesh, {}
    moved, stress = result.displacement_amplitude, result.nodal_amplitude
    every, owner = np.arange(len(mesh.node_label)), result.read("stress/nodal_node") - 1
    for names, amplitude, of, nodes in ((("length",), moved, _length, every), (DISPLACEMENTS, moved, np.asarray, every),
                                        (STRESSES, stress, np.asarray, owner)):
        ends = [Peak(value, mesh.coordinates[nodes[point]], theta, f"node {mesh.node_label[nodes[point]]}")
                for value, point, theta in _largest(result, np.where(np.isfinite(amplitude), amplitude, 0.0), of)]
        found |= {name: [ends[k], ends[len(names) + k]] for k, name in enumerate(names)}
    return found


def _length(moved):
    return np.linalg.norm(moved, axis=-1, keepdims=True)


def _largest(result, amplitude, of):
    """Yield the value, the point and the angle of the least of each component round the circle, then of the largest.

    amplitude: (modes, points, components); of: makes of their sums (..., components) what is looked for
    """
    def at(theta, points=slice(None)):
        values = of(totals(amplitude[:, points], result.harmonic, result.family, theta))
        return np.concatenate([-values, values], -1)
    highest = int(result.harmonic.max(initial=0))
    count = max(LEAST_ANGLES, ANGLES_OF_A_WAVE*highest) if highest else 1
    angles = np.arange(count//2 + 1 if (result.family == SYMMETRIC).all() else count)*360/count
    values, place = _first(map(at, angles))
    size = values.max(axis=0).reshape(2, -1).max(axis=0)  # of both signs
    for k, largest in enumerate(np.tile(size, 2)):
        first = int(values[:, k].argmax())
        peak = values[first, k], first, angles[place[first, k]]
        if highest and largest > 0:
            near = np.flatnonzero(values[:, k] >= peak[0] - GROWTH*largest)
            climbed, theta = _climbed(lambda tried, near=near, k=k: np.array([at(angle, near)[:, k] for angle in tried]),
                                      angles[place[near, k]], 360/count)
            best = climbed.argmax()
            if climbed[best] - peak[0] > ROUNDING*largest:
                peak = climbed[best], near[best], theta[best]
        yield peak[0] if k >= len(size) else -peak[0], *peak[1:]


def _first(fields):
    """The largest of fields at each point, and the first that has it, but for rounding."""
    for k, values in enumerate(fields):
        if k == 0:
            largest, place = values.copy(), np.zeros(values.shape, int)
        better = values > largest + ROUNDING*abs(largest)
        largest[better], place[better] = values[better], k
    return largest, place


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
        found[name] = (largest, theta) if points.yields else _climbed(
            lambda tried, of=of: of(points.at(tried)), theta, field.theta[1] - field.theta[0])
    return found


def _climbed(at, theta, step):
    """The largest values of points, and where, between the angles beside some [degree].

    at: gives the values at angles (tries, points)
    """
    while step > LEAST_STEP:
        tried = theta + step*AROUND[:, None]
        values = at(tried)
        theta = np.take_along_axis(tried, values.argmax(axis=0)[None], 0)[0]
        step /= 4
    return values.max(axis=0), theta % 360
