"""Soil reactions of the joints on a pile: segments between the ends of joints along z, joints across z below."""
import numpy as np

from . import circle, elements
from .mesh import SIDES
from .resultants import AXIAL, FORCE, MOMENT, along


def joint_values(result, body, theta, numbers, rows):
    """Segments, reactions and motions of SoilReactions from the joints of a body, by name."""
    mesh = result.mesh
    sign, along = sides_of(mesh, body), along_axis(mesh)
    shaft, base = np.flatnonzero((sign != 0) & along), np.flatnonzero((sign != 0) & ~along)
    resist = _turned(result.history.joint_resultants[rows], theta)*sign[:, None]
    motions = [_Motion(result.at(int(k)), theta) for k in numbers]
    return _shaft(mesh, shaft, sign, resist, motions) \
        | _base(mesh, base if len(base) else shaft, sign, resist if len(base) else 0*resist, motions)


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
    return np.stack([resultants[..., AXIAL], -along(resultants, FORCE, theta), along(resultants, MOMENT, theta)], -1)


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
        shape, _ = elements.line_functions(len(nodes), x)
        for i, motion in enumerate(motions):
            total[i, here] += shape @ motion.of(nodes)
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
