"""Soil reactions on a pile: what a one-dimensional model of it needs, from the joints round it.

The four reactions are those of the PISA method for monopiles (Burd et al., Geotechnique 70, 2020): distributed
lateral load p against the deflection v, distributed moment m against the rotation psi, base shear H_b
against v_b, base moment M_b against psi_b; and along the axis the shaft friction t and the base force V_b
against the settlement s.

Signs: reactions are what the pile exerts on the ground, so that they resist motions of their own sign. p, v
and H_b are positive along the direction asked for (theta); m, M_b, psi and psi_b where they lean the pile towards
it - the opposite of MOMENT of a deck and of moments in tables, which lift that side; t, V_b and s
downwards.
"""
from dataclasses import dataclass

import numpy as np

from . import circle
from .table import Table

# Nodes of the two sides of a joint of 4 and of 6 nodes, in order along it
SIDES = {4: ([0, 1], [3, 2]), 6: ([0, 4, 1], [3, 5, 2])}
# Columns of resultants along theta = 0 and 90 degrees, and the family that moves so
FORCE, MOMENT = (1, 4), (2, 5)


class NoShaftError(LookupError):
    """A body without joints along z has no soil reactions."""


@dataclass
class SoilReactions:
    """Reactions by increment and by segment of the shaft, on which p, m and t are constant.

    body                   number of the pile's body
    theta                  direction of p, v and H_b [degree]
    increment              numbers of the increments
    load_factor            sums of their load factors
    low, high              ends of the segments, (segments), from the lowest on
    p, m, t                resistance per length, (increments, segments)
    v, psi, s              motion of the pile at the middle of the segments, likewise
    v_relative, s_relative motion of the pile less that of the ground at the joints
    base_z                 height of the base
    H_b, M_b, V_b          resistance of the base, (increments); zeros without joints across z
    v_b, psi_b, s_b        motion of the base
    """
    body: int
    theta: float
    increment: np.ndarray
    load_factor: np.ndarray
    low: np.ndarray
    high: np.ndarray
    p: np.ndarray
    m: np.ndarray
    t: np.ndarray
    v: np.ndarray
    psi: np.ndarray
    s: np.ndarray
    v_relative: np.ndarray
    s_relative: np.ndarray
    base_z: float
    H_b: np.ndarray
    M_b: np.ndarray
    V_b: np.ndarray
    v_b: np.ndarray
    psi_b: np.ndarray
    s_b: np.ndarray

    @property
    def z(self):
        """Middles of the segments."""
        return (self.low + self.high)/2

    def totals(self):
        """Horizontal force and moment about the origin that all reactions add up to: (increments) each."""
        length = self.high - self.low
        return ((self.p*length).sum(axis=1) + self.H_b,
                ((self.m + self.p*self.z)*length).sum(axis=1) + self.M_b + self.H_b*self.base_z)

    def shaft_table(self):
        """A row for each increment and segment."""
        count, n = self.p.shape
        columns = {"increment": np.repeat(self.increment, n), "load_factor": np.repeat(self.load_factor, n),
                   "z_low": np.tile(self.low, count), "z_high": np.tile(self.high, count),
                   "z": np.tile(self.z, count)}
        names = ("v", "p", "psi", "m", "s", "t", "v_relative", "s_relative")
        return Table(columns | {name: getattr(self, name).ravel() for name in names})

    def base_table(self):
        """A row for each increment."""
        names = ("v_b", "H_b", "psi_b", "M_b", "s_b", "V_b")
        return Table({"increment": self.increment, "load_factor": self.load_factor,
                      "z": np.full(len(self.increment), self.base_z)}
                     | {name: getattr(self, name) for name in names})


def soil_reactions(result, body=None, theta=0.0, increments=None):
    """Reactions of all joints on a body: SoilReactions.

    body: the pile; without it, of the bodies with joints the one that reaches least far from the axis.
    Joints along z are its shaft, those across z its base; what is inside and outside a tube is added up.
    """
    mesh = result.mesh
    body = pile_of(result) if body is None else body
    sign = sides_of(mesh, body)
    along = along_axis(mesh)
    shaft, base = np.flatnonzero((sign != 0) & along), np.flatnonzero((sign != 0) & ~along)
    if not len(shaft):
        raise NoShaftError(f"body {body} has no joints along z")
    history = result.history
    wanted = history.increment if increments is None else np.asarray(increments)
    wanted = wanted[np.isin(wanted, history.increments_of("displacement"))]
    rows = np.searchsorted(history.increment, wanted)
    resist = _turned(history.joint_resultants[rows], theta)*sign[:, None]
    motions = [_Motion(result.at(int(k)), theta) for k in wanted]
    shaft_values = _shaft(mesh, shaft, sign, resist, motions)
    base_values = _base(mesh, base if len(base) else shaft, sign, resist if len(base) else 0*resist, motions)
    return SoilReactions(body, theta, wanted, history["load_factor"][rows], **shaft_values, **base_values)


def pile_of(result):
    """Number of the body with joints that reaches least far from the axis; of several the tallest."""
    mesh = result.mesh
    bodies = sorted(set(mesh.joint_bodies.ravel().tolist()))
    if not bodies:
        raise NoShaftError("there are no joints")

    def reach(body):
        r, z = mesh.coordinates[mesh.element_nodes[mesh.element_body == body][:, :3]].reshape(-1, 2).T
        return r.max(), -np.ptp(z)
    return min(bodies, key=reach)


def along_axis(mesh):
    """Whether each joint is along z rather than across it."""
    r, z = abs(np.diff(mesh.coordinates[mesh.joint_nodes[:, :2]], axis=1)[:, 0]).T
    return z > r


def sides_of(mesh, body):
    """1 where a body is on side 1-2 of a joint, -1 on side 4-3, 0 elsewhere: (joints)."""
    a, b = mesh.joint_bodies.T
    return (a == body).astype(int) - (b == body)


def _turned(resultants, theta):
    """Resistances (V downwards, H, leaning M) from forces on side 1-2: (increments, joints, 3)."""
    c, s = circle.cosine(theta), circle.sine(theta)
    force, moment = (c*resultants[..., k[0]] + s*resultants[..., k[1]] for k in (FORCE, MOMENT))
    return np.stack([resultants[..., 0], -force, moment], -1)


class _Motion:
    """Mean motion of circles: deflection along theta, leaning, settlement."""

    def __init__(self, result, theta):
        amplitude, self.mesh = result.displacement_amplitude, result.mesh
        self.around = sum(factor*_mode(result, amplitude, 1, family) for factor, family
                          in ((circle.cosine(theta), 1), (circle.sine(theta), 2)))
        self.along = _mode(result, amplitude, 0, 1)

    def of(self, nodes):
        """Deflection, leaning and settlement of nodes, (..., 3)."""
        u, v, w = np.moveaxis(self.around[nodes], -1, 0)
        r = self.mesh.coordinates[nodes, 0]
        return np.stack([(u - w)/2, -v/np.where(r > 0, r, np.inf), -self.along[nodes, 1]], -1)


def _mode(result, amplitude, harmonic, family):
    found = np.flatnonzero((result.harmonic == harmonic) & (result.family == family))
    return amplitude[found[0]] if len(found) else np.zeros(amplitude.shape[1:])


def _shaft(mesh, joints, sign, resist, motions):
    """Values of the segments between all ends of the joints."""
    heights = np.sort(mesh.coordinates[mesh.joint_nodes[joints, :2], 1], axis=1)
    ends = np.unique(heights)
    ends = ends[np.append(True, np.diff(ends) > 1e-9*np.ptp(ends))]
    overlap = np.minimum.outer(ends[1:], heights[:, 1]) - np.maximum.outer(ends[:-1], heights[:, 0])
    overlap[overlap < 1e-9*np.ptp(ends)] = 0
    filled = overlap.any(axis=1)
    overlap, low, high = overlap[filled], ends[:-1][filled], ends[1:][filled]
    share = overlap/np.diff(heights, axis=1)[:, 0]
    t, p, m = np.moveaxis(np.einsum("sj,ijc->isc", share, resist[:, joints]), -1, 0)/(high - low)
    mine, other = (_at_heights(mesh, joints, sign*side, (low + high)/2, overlap > 0, motions)
                   for side in (1, -1))
    (v, psi, s), relative = np.moveaxis(mine, -1, 0), np.moveaxis(mine - other, -1, 0)
    return {"low": low, "high": high, "p": p, "m": m, "t": t, "v": v, "psi": psi, "s": s,
            "v_relative": relative[0], "s_relative": relative[2]}


def _at_heights(mesh, joints, sign, z, touching, motions):
    """Mean motion, over the joints that touch each segment, of one of their sides: (increments, segments, 3)."""
    total = np.zeros((len(motions), len(z), 3))
    for k, joint in enumerate(joints):
        nodes = side_of(mesh, joint, sign[joint])
        first, last = mesh.coordinates[nodes[[0, -1]], 1]
        here = touching[:, k]
        x = (2*z[here] - first - last)/(last - first)
        shape = [(1 - x)/2, (1 + x)/2] if len(nodes) == 2 else [x*(x - 1)/2, 1 - x**2, x*(x + 1)/2]
        for i, motion in enumerate(motions):
            total[i, here] += np.transpose(shape) @ motion.of(nodes)
    return total/touching.sum(axis=1)[:, None]


def side_of(mesh, joint, sign):
    """Nodes of side 1-2 (sign 1) or of side 4-3 (sign -1) of a joint, in order along it."""
    return mesh.joint_nodes[joint, SIDES[int(mesh.joint_size[joint])][0 if sign > 0 else 1]]


def _base(mesh, joints, sign, resist, motions):
    """Values of the base; moments about r = 0 at its lowest height."""
    heights = mesh.coordinates[mesh.joint_nodes[joints, :2], 1]
    base_z = float(heights.min())
    along, force, moment = np.moveaxis(resist[:, joints], -1, 0)
    moment = moment + force*(heights.mean(axis=1) - base_z)
    motion = np.zeros((len(motions), 3))
    weight = np.zeros(2)
    for joint in joints:
        nodes = side_of(mesh, joint, sign[joint])[[0, -1]]
        r = mesh.coordinates[nodes, 0]
        area = (np.ptp(r) or np.ptp(mesh.coordinates[nodes, 1]))*r
        weight += area.sum(), (area*r**2).sum()
        for i, one in enumerate(motions):
            moved = one.of(nodes)
            motion[i] += (area[:, None]*moved*np.stack([np.ones(2), r**2, np.ones(2)], -1)).sum(axis=0)
    v_b, psi_b, s_b = (motion/weight[[0, 1, 0]]).T
    return {"base_z": base_z, "H_b": force.sum(axis=1), "M_b": moment.sum(axis=1), "V_b": along.sum(axis=1),
            "v_b": v_b, "psi_b": psi_b, "s_b": s_b}
