"""Errors that a run of axijoint has beside a better one: displacements of its nodes, stresses of its joints"""
import json
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "python"))
from axijoint import elements
from axijoint.result import open_result

ANGLES = 64  # most angles at which a largest displacement is looked for, as in the program
# Natural coordinates of the points of a joint, by number
PLACES = {1: (0.0,), 2: (-3**-0.5, 3**-0.5), 3: (-0.6**0.5, 0.0, 0.6**0.5)}
CENTROID, LOBATTO = 1, 3


def read(path):
    """A result and its summary"""
    result = open_result(path + ".h5")
    with open(path + ".json", encoding="utf-8") as file:
        result.summary = json.load(file)
    return result


def largest_vector(amplitudes):
    """Largest vector of (harmonic, family) -> amplitudes (nodes, 3) at any node and angle"""
    count = min(ANGLES, 4*(max(m for m, _ in amplitudes) + 1))
    largest = 0.0
    for angle in 2*np.pi*np.arange(count)/count:
        total = 0.0
        for (m, family), values in amplitudes.items():
            c, s = np.cos(m*angle), np.sin(m*angle)
            total = total + values*([c, c, s] if family == 1 else [s, s, -c])
        largest = max(largest, np.sum(total**2, axis=1).max())
    return np.sqrt(largest)


def amplitudes_of(result):
    """(harmonic, family) -> amplitudes at the nodes"""
    return dict(zip(zip(map(int, result.harmonic), map(int, result.family)), result.displacement_amplitude))


def at_nodes_of(coarse, fine):
    """Amplitudes of a fine result at the nodes of a coarse one, each in its body"""
    mesh = coarse.mesh
    found = {mode: np.full((len(mesh.coordinates), 3), np.nan) for mode in amplitudes_of(fine)}
    body = np.zeros(len(mesh.coordinates), int)
    for element, own in enumerate(mesh.element_body):
        body[mesh.nodes_of(element)] = own
    node, element, natural = fine.mesh.locate(mesh.coordinates)
    keep = fine.mesh.element_body[element] == body[node]
    node, element, natural = node[keep], element[keep], natural[keep]
    for size in np.unique(fine.mesh.element_size[element]):
        chosen = np.flatnonzero(fine.mesh.element_size[element] == size)
        shape, _ = elements.shape_functions(int(size), natural[chosen])
        nodes = fine.mesh.element_nodes[element[chosen], :size]
        for mode, values in amplitudes_of(fine).items():
            found[mode][node[chosen]] = np.einsum("pn,pnc->pc", shape, values[nodes])
    return found


def displacement_error(coarse, fine):
    """Largest error of a displacement over the largest displacement"""
    own, better = amplitudes_of(coarse), at_nodes_of(coarse, fine)
    zero = np.zeros_like(next(iter(own.values())))
    wrong = {mode: own.get(mode, zero) - better.get(mode, zero) for mode in own | better}
    return largest_vector(wrong)/largest_vector(own)


class JointStresses:
    """Stresses along the joints of a result: between the points of a joint by the polynomial through them"""

    def __init__(self, result):
        mesh = result.mesh
        self.ends = mesh.coordinates[mesh.joint_nodes[:, :2]]
        self.law = mesh.joint_material
        self.owner = result.read("joints/joint") - 1
        self.position, self.stress = result.read("joints/position"), result.read("joints/stress")
        self.planes = result.read("joints/planes")
        self.first = {}
        for point, joint in enumerate(self.owner):
            self.first.setdefault(int(joint), point)
        rule = result.read("joint_materials/rule")[self.law]
        self.places = [PLACES[1] if own == CENTROID else np.linspace(-1, 1, size//2) if own == LOBATTO
                       else PLACES[size//2] for own, size in zip(rule, mesh.joint_size)]

    def at(self, place, law, direction):
        """Stresses on all planes at a place, of the joint there along a direction"""
        start, along = self.ends[:, 0], self.ends[:, 1] - self.ends[:, 0]
        length = np.hypot(*along.T)
        share = ((place - start)*along).sum(1)/length**2
        off = np.hypot(*(place - start - share[:, None]*along).T) + length*np.maximum(0, abs(share - 0.5) - 0.5)
        turned = abs(along[:, 0]*direction[1] - along[:, 1]*direction[0])/length > 1e-3*np.hypot(*direction)
        joint = int(np.argmin(off + 1e9*(turned | (self.law != law))))
        places = self.places[joint]
        weights = [np.prod([(2*share[joint] - 1 - b)/(a - b) for b in places if b != a]) for a in places]
        return sum(weight*self.stress[:, self.first[joint] + k] for k, weight in enumerate(weights))


def at_angles(angles, planes, values):
    """Values on planes at other angles, straight between neighbours: the same where the angles are planes"""
    if planes[-1] > np.pi + 1e-9:  # round the whole circle
        planes, values = np.append(planes, 2*np.pi), np.concatenate([values, values[:1]])
    return np.stack([np.interp(angles, planes, column) for column in values.T], axis=-1)


def joint_error(coarse, fine):
    """Largest error of a joint stress over the largest, at the points and planes of the coarse result that are not
    too near to infinite stresses; None without joints"""
    own, better = JointStresses(coarse), JointStresses(fine)
    if not len(own.position):
        return None
    judged = np.ones(len(own.position), bool)
    for place in coarse.summary["singular"]:
        judged &= np.hypot(*(own.position - (place["r"], place["z"])).T) >= place["distance"]
    if not judged.any():
        judged[:] = True
    wrong = largest = 0.0
    for point in np.flatnonzero(judged):
        joint = own.owner[point]
        exact = better.at(own.position[point], own.law[joint], own.ends[joint, 1] - own.ends[joint, 0])
        wrong = max(wrong, abs(at_angles(own.planes, better.planes, exact) - own.stress[:, point]).max())
        largest = max(largest, abs(own.stress[:, point]).max())
    return wrong/largest


def cut_error(coarse, fine):
    """Largest error of a resultant on a cut over the largest of its kind, of the cuts whose error is told; None without cuts"""
    if not coarse.has("cuts"):
        return None
    own, better = (result.read("cuts/resultants") for result in (coarse, fine))
    told = coarse.read("errors/on_cuts")[0, :, 0] >= 0
    wrong, scale = _sizes(own - better)[told].max(0, initial=0.0), _sizes(own).max(0)
    r, z = coarse.mesh.coordinates.T
    arm = np.array([1, 1, *[max(r.max(), np.ptp(z))]*2])
    scale = np.maximum(scale, 0.01*(scale/arm).max()*arm)  # a force that is next to nothing is no measure, nor is a moment
    return (wrong[scale > 0]/scale[scale > 0]).max(initial=0.0)


def section_error(coarse, fine):
    """Largest error of a stress along a section over the largest along any, where it is judged; None without sections"""
    if not coarse.has("errors/on_sections"):
        return None
    wrong, stress = 0.0, coarse.read("errors/section_stress")
    told = coarse.read("errors/on_sections")[0] >= 0
    if not told.any():
        return None
    nodes = coarse.mesh.element_nodes + 1
    infinite = [place["node"] for place in coarse.summary["singular"]]
    infinite = np.flatnonzero(np.isin(coarse.mesh.node_label, infinite)) + 1
    for k, label in enumerate(coarse.summary["section_errors"]):
        where = f"sections/{label['section']}/"
        rows = [_rows(result, where) for result in (coarse, fine)]
        own, better = (result.read(where + "stress") for result in (coarse, fine))
        for row, key in enumerate(rows[0]):
            element = coarse.read(where + "element")[row] - 1
            if key not in rows[1] or not told[k] or np.isin(nodes[element], infinite).any():
                continue
            wrong = max(wrong, abs(own[:, row] - better[:, rows[1].index(key)]).max())
    return wrong/stress.max()


def _rows(result, where):
    """Number of the point, body and material of each row of a section"""
    element = result.read(where + "element") - 1
    return list(zip(result.read(where + "point"), result.mesh.element_body[element], result.mesh.element_material[element], strict=True))


def _sizes(resultants):
    """Axial force, lateral force and moment whatever their angle, torque: (cut, 4)"""
    n, q, m, t, q_90, m_90 = resultants.T
    return np.stack([abs(n), np.hypot(q, q_90), np.hypot(m, m_90), abs(t)], axis=1)
