"""What figures are made of: outlines, triangles of elements, interfaces of joints."""
from collections import defaultdict

import numpy as np

from .. import elements

# Pieces that an edge of a quadratic element is drawn with
PIECES = 6


def edge_points(nodes):
    """Points along an edge of two or three nodes (first, middle, last), (points, 2)."""
    if len(nodes) == 2:
        return np.asarray(nodes, float)
    t = np.linspace(-1, 1, PIECES + 1)[:, None]
    return t*(t - 1)/2*nodes[0] + (1 - t**2)*nodes[1] + t*(t + 1)/2*nodes[2]


def element_edges(mesh, positions, chosen=None):
    """Polylines of all edges of the elements (or of the chosen ones), each once."""
    seen, lines = set(), []
    for size, group in mesh.groups(chosen):
        for local in elements.edges(size):
            for nodes in mesh.element_nodes[group][:, local]:
                key = frozenset((nodes[0], nodes[-1]))
                if key not in seen:
                    seen.add(key)
                    lines.append(edge_points(positions[nodes]))
    return lines


def outlines(mesh, positions, chosen=None):
    """Polylines of the edges at which solids end or meet others, without the axis.

    chosen: which elements (mask); without it, all.
    """
    solids = np.stack([mesh.element_body, mesh.element_material], -1)
    solids = np.unique(solids if chosen is None else solids[chosen], axis=0)
    lines = []
    for body, material in solids:
        inside = (mesh.element_body == body) & (mesh.element_material == material)
        for _, nodes in mesh.boundary(np.flatnonzero(inside)).values():
            if (mesh.coordinates[nodes, 0] <= 0).all():
                continue
            lines.append(edge_points(positions[nodes]))
    return lines


def element_polygons(mesh, positions, chosen):
    """Closed polygons of the elements."""
    polygons = []
    for size, group in mesh.groups(chosen):
        for element in group:
            nodes = mesh.element_nodes[element]
            polygons.append(np.concatenate([edge_points(positions[nodes[list(local)]])[:-1]
                                            for local in elements.edges(size)]))
    return polygons


def triangles(mesh, values, index, divisions=None, chosen=None):
    """Elements cut into triangles, for contours.

    values: (values, components); index: the value of each node of each element, (elements, 9); chosen: numbers of
    the elements, without it all.
    Returns points (points, 2), values (points, components) and triangles (triangles, 3). Points are
    shared within a solid, so that contours go on from element to element and end where solids meet.
    """
    points, found, solids, corners, offset = [], [], [], [], 0
    for size, group in mesh.groups(chosen):
        n = divisions or (2 if size in (3, 4) else 4)
        natural, pattern = _cut(elements.corners(size), n)
        value, _ = elements.shape_functions(size, natural)
        nodes = mesh.coordinates[mesh.element_nodes[group, :size]]
        points.append(np.einsum("pn,eni->epi", value, nodes).reshape(-1, 2))
        found.append(np.einsum("pn,enc->epc", value, values[index[group, :size]])
                     .reshape(-1, values.shape[1]))
        solid = mesh.element_body[group]*len(mesh.material_label) + mesh.element_material[group]
        solids.append(np.repeat(solid, len(natural)))
        start = offset + len(natural)*np.arange(len(group))
        corners.append((start[:, None, None] + pattern).reshape(-1, 3))
        offset += len(natural)*len(group)
    points, found, solids = (np.concatenate(parts) for parts in (points, found, solids))
    extent = np.ptp(points, axis=0).max()
    key = np.column_stack([solids, np.round((points - points.min(axis=0))/extent*1e7)])
    _, first, place = np.unique(key, axis=0, return_index=True, return_inverse=True)
    corners = place.reshape(-1)[np.concatenate(corners)]
    return points[first], found[first], corners


def _cut(n_corners, n):
    """Points and triangles of the reference element, cut n times along each side."""
    t = np.linspace(0, 1, n + 1)
    x, y = (a.ravel() for a in np.meshgrid(t, t, indexing="ij"))
    number = np.arange((n + 1)**2).reshape(n + 1, n + 1)
    a, b, c, d = (q.ravel() for q in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]))
    lower, upper = np.stack([a, b, d], -1), np.stack([b, c, d], -1)
    if n_corners == 4:
        return np.stack([2*x - 1, 2*y - 1], -1), np.concatenate([lower, upper])
    inside = x + y < 1 + 1e-9
    rename = np.cumsum(inside) - 1
    cut = np.concatenate([lower, upper])
    return np.stack([x, y], -1)[inside], rename[cut[inside[cut].all(axis=1)]]


class Interface:
    """Joints of one card of INTERFACES, or of one law in JOINTS, that hang together, with their points in order.

    number    of the card; 0 of joints of JOINTS
    name      of the card; empty of joints of JOINTS
    law       number of the law
    bodies    numbers of the bodies at side 1-2 and at side 4-3
    faces     their faces; zeros if there are none
    joints    the joints (index), in order
    lines     polylines of side 1-2 of each joint
    points    joint points (index), in order along the interface
    distance  of these points from the beginning of the interface
    position  r and z of the points
    """

    def __init__(self, result, joints):
        mesh = result.mesh
        self.law = int(mesh.law_label[mesh.joint_material[joints[0]]])
        self.number = int(mesh.joint_interface[joints[0]])
        card = result.interfaces[self.number - 1] if self.number else None
        self.name = card.name if card else ""
        self.faces = (card.face_a, card.face_b) if card else (0, 0)
        self.bodies = tuple(map(int, mesh.joint_bodies[joints[0]]))
        self.joints = joints
        self.lines = [edge_points(mesh.coordinates[side_nodes(mesh, joint)]) for joint in joints]
        owner, position = result.read("joints/joint") - 1, result.read("joints/position")
        start, points, distances = 0.0, [], []
        last = None
        for k, joint in enumerate(joints):
            ends = self.lines[k][[0, -1]]
            if last is None:
                ahead = self.lines[k + 1][[0, -1]] if k + 1 < len(joints) else ends[1:]
                if np.linalg.norm(ahead - ends[0], axis=1).min() < np.linalg.norm(ahead - ends[1], axis=1).min():
                    ends = ends[::-1]
            elif np.linalg.norm(ends[1] - last) < np.linalg.norm(ends[0] - last):
                ends = ends[::-1]
            length = np.linalg.norm(np.diff(self.lines[k], axis=0), axis=1).sum()
            mine = np.flatnonzero(owner == joint)
            chord = ends[1] - ends[0]
            share = (position[mine] - ends[0]) @ chord/(chord @ chord)
            order = np.argsort(share)
            points.append(mine[order])
            distances.append(start + share[order]*length)
            start, last = start + length, ends[1]
        self.points, self.distance = np.concatenate(points), np.concatenate(distances)
        self.length = start
        self.position = position[self.points]

    def coordinate(self):
        """Name and values of what the points are drawn against: z, r or the distance s."""
        r, z = self.position.T
        extent = np.ptp(self.position, axis=0).max()
        if np.ptp(r) < 1e-6*extent:
            return "z", z
        if np.ptp(z) < 1e-6*extent:
            return "r", r
        return "s", self.distance


def side_nodes(mesh, joint):
    """Nodes of side 1-2 of a joint, in order along it."""
    nodes = mesh.joint_nodes[joint]
    return nodes[[0, 4, 1]] if mesh.joint_size[joint] == 6 else nodes[:2]


def interfaces(result):
    """All Interfaces: joints of one card and one law that hang together on both sides, end to end."""
    mesh = result.mesh
    at_node = defaultdict(list)
    for joint, nodes in enumerate(mesh.joint_nodes):
        for pair in ((nodes[0], nodes[3]), (nodes[1], nodes[2])):
            at_node[mesh.joint_interface[joint], mesh.joint_material[joint], pair].append(joint)
    neighbours = defaultdict(set)
    for joints in at_node.values():
        if len(joints) == 2:
            neighbours[joints[0]].add(joints[1])
            neighbours[joints[1]].add(joints[0])
    chains, seen = [], set()
    for wanted in (1, 2, 0):  # ends of open chains first, then closed ones, then single joints
        for joint in range(len(mesh.joint_nodes)):
            if joint in seen or len(neighbours[joint]) != wanted:
                continue
            chain = [joint]
            seen.add(joint)
            while ahead := sorted(neighbours[chain[-1]] - seen):
                chain.append(ahead[0])
                seen.add(ahead[0])
            chains.append(chain)
    return [Interface(result, chain) for chain in sorted(chains)]
