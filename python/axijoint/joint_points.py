"""Joint points: what they carry and how far their faces stand apart, on planes or anywhere round the circle."""
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import circle, elements
from .mesh import SIDES

# Angles round the circle: the fewest, and for each wave of the highest harmonic, as the program looks for the largest
LEAST_ANGLES, ANGLES_OF_A_WAVE = 72, 8
# Rule of joints with points at both ends
LOBATTO = 3
# Components that are of the other sign on a mirror image: those round the axis
MIRROR = np.array([1, 1, -1])


@dataclass
class JointField:
    """Joint points at some angles.

    theta     the angles [degree], (angles); or those of each point, (angles, points)
    stress    tau_xi, sigma, tau_theta, (angles, points, 3)
    jump      relative displacements d_xi, d_eta, d_theta, (angles, points, 3)
    gap       how far the faces stand apart, d_eta with the gap before loading; 0 where they touch, (angles, points)
    state     0 stick, 1 slip, 2 open, (angles, points)
    """
    theta: np.ndarray
    stress: np.ndarray
    jump: np.ndarray
    gap: np.ndarray
    state: np.ndarray

    @property
    def sigma(self):
        """Normal stress, tension positive, (angles, points)."""
        return self.stress[..., 1]

    @property
    def tau(self):
        """Size of the shear stress, (angles, points)."""
        return np.hypot(self.stress[..., 0], self.stress[..., 2])

    @property
    def slip(self):
        """Size of the tangential relative displacement, elastic part included, (angles, points)."""
        return np.hypot(self.jump[..., 0], self.jump[..., 2])

    def with_mirror_image(self):
        """Round the whole circle, from 0 to 180 degrees and the mirror image of what is between."""
        inner = np.flatnonzero((self.theta > 1e-9) & (self.theta < 180 - 1e-9))[::-1]
        return JointField(*map(np.concatenate, (
            (self.theta, 360 - self.theta[inner]), (self.stress, self.stress[inner]*MIRROR),
            (self.jump, self.jump[inner]*MIRROR), (self.gap, self.gap[inner]), (self.state, self.state[inner]))))


class JointPoints:
    """The joint points of a Result, at its increment.

    owner    joint of each point, counted from 0 as in `result.mesh`
    yields   whether any joint can open or slip: then values are known on the planes of the law alone, else at any angle
    half     whether all modes are symmetric: 180 to 360 degrees are the mirror image
    """

    def __init__(self, result):
        self._result = result
        self.owner = result.read("joints/joint") - 1
        law = result.mesh.joint_material[self.owner]
        self._gap = result.read("joint_materials/gap")[law]
        self._stiffness = result.read("joint_materials/stiffness").reshape(-1, 3)[law]
        self.yields = bool(result.read("joint_materials/kind")[law].any())
        self.half = bool((result.family == circle.SYMMETRIC).all())

    def on_planes(self):
        """As the file has them: on the planes of the law or, where no joint yields, at the angles of OUTPUT."""
        stress, jump, state = (self._result.read(f"joints/{name}") for name in ("stress", "jump", "state"))
        return self._field(np.degrees(self._result.read("joints/planes")), stress, jump, state)

    def at(self, theta):
        """Sums of the harmonics where no joint yields, at angles (angles), or (angles, points) [degree]."""
        if self.yields:
            raise ValueError("joints yield: what they carry is known on the planes of their law alone")
        theta = np.asarray(theta, float)
        jump = self._jump(theta if theta.ndim == 2 else theta[:, None])
        return self._field(theta, self._at_rest + self._stiffness*jump, jump, np.zeros(jump.shape[:2], int))

    def amplitudes(self):
        """Of joints that do not yield: harmonics, families, and by name amplitudes of `stress`, `jump`, and `gap` in d_eta.

        Those of a name are (modes, points, 3); a mode of each family without waves holds what is there at rest.
        """
        result, rest = self._result, np.zeros((2, len(self.owner), 3))
        jump = np.concatenate([result.jump_amplitude, rest])
        stress, gap = self._stiffness*jump, jump.copy()
        stress[-2, :, :2], stress[-1, :, 2], gap[-2, :, 1] = self._at_rest[:, :2], -self._at_rest[:, 2], self._gap
        return (np.append(result.harmonic, [0, 0]), np.append(result.family, [circle.SYMMETRIC, circle.ANTISYMMETRIC]),
                {"stress": stress, "jump": jump, "gap": gap})

    def part(self):
        """Round the circle, or from 0 to 180 degrees if the rest is the mirror image; angles ascend."""
        if self.yields:
            return self.on_planes()
        count = max(LEAST_ANGLES, ANGLES_OF_A_WAVE*int(self._result.harmonic.max(initial=0)))
        angles = np.arange(count)*360/count
        return self.at(angles[:count//2 + 1] if self.half else angles)

    def around(self):
        """Round the whole circle; angles ascend."""
        return self.part().with_mirror_image() if self.half else self.part()

    def areas(self):
        """Area of the joint that each point stands for, the whole circle round, (points)."""
        mesh, rule = self._result.mesh, self._result.read("joint_materials/rule")[self._result.mesh.joint_material]
        found = np.empty(len(self.owner))
        for joint, first, place, weight in places(self.owner, rule):
            nodes = mesh.joint_nodes[joint, SIDES[int(mesh.joint_size[joint])][0]]
            value, slope = elements.line_functions(len(nodes), place)
            length = np.linalg.norm(slope @ mesh.coordinates[nodes], axis=1)
            found[first:first + len(place)] = 2*np.pi*(value @ mesh.coordinates[nodes, 0])*length*weight
        return found

    def shares(self, joints):
        """Shares of the area of some joints (index) that stick, slip, and are open: (3)."""
        chosen = np.isin(self.owner, joints)
        area, state = self.areas()[chosen], self.around().state[:, chosen]
        return np.array([area @ (state == k).mean(axis=0) for k in range(3)])/area.sum()

    def _field(self, theta, stress, jump, state):
        return JointField(theta, stress, jump, np.maximum(jump[..., 1] + self._gap, 0), state)

    def _jump(self, theta):
        result = self._result
        return circle.totals(result.jump_amplitude, result.harmonic, result.family, theta)

    @cached_property
    def _at_rest(self):
        """Stress without relative displacements, in situ and of the laws, (points, 3): the same all round."""
        field = self.on_planes()
        return field.stress[0] - self._stiffness*self._jump(field.theta[:1, None])[0]


def jumps(mesh, owner, rule, displacement):
    """Amplitudes of the relative displacements d_xi, d_eta, d_theta of joint points, (modes, points, 3).

    owner: joint of each point; rule: that of each joint; displacement: amplitudes of the nodes, (modes, nodes, 3).
    """
    found = np.empty((len(displacement), len(owner), 3))
    for joint, first, place, _ in places(owner, rule):
        size, n = int(mesh.joint_size[joint]), len(place)
        value, slope = elements.line_functions(size//2, place)
        here, there = (mesh.joint_nodes[joint, side] for side in SIDES[size])
        along = slope @ mesh.coordinates[here]
        cosine, sine = (along/np.linalg.norm(along, axis=1, keepdims=True)).T
        u, v, w = np.einsum("pn,mnc->cmp", value, displacement[:, there] - displacement[:, here])
        found[:, first:first + n] = np.stack([cosine*u + sine*v, cosine*v - sine*u, w], -1)
    return found


def places(owner, rule):
    """Yield each joint, its first point, and places and weights of its points from -1 to 1.

    owner: joint of each point; rule: that of each joint.
    """
    count = np.bincount(owner, minlength=len(rule))
    for joint, (first, n) in enumerate(zip(np.cumsum(count) - count, count)):
        if rule[joint] == LOBATTO:
            place = np.linspace(-1, 1, n)
            weight = np.array({2: [1, 1], 3: [1/3, 4/3, 1/3]}[int(n)])
        else:
            place, weight = np.polynomial.legendre.leggauss(n)
        yield joint, first, place, weight
