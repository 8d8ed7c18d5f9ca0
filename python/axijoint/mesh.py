"""The mesh of the meridional plane, and where points lie in it.

Nodes, elements, joints and materials count from 0 here; labels are the numbers of the deck.
"""
from collections import defaultdict
from functools import cached_property

import numpy as np

from . import elements

# Share of an element's extent by which its box is widened; curved sides may leave the box of the nodes
STRAIGHT_MARGIN, CURVED_MARGIN = 1e-5, 0.25
# Nodes of sides 1-2 and 4-3 of joints of 4 and of 6 nodes, in order along them
SIDES = {4: ([0, 1], [3, 2]), 6: ([0, 4, 1], [3, 5, 2])}


class Mesh:
    """Nodes, elements and joints.

    coordinates       r and z of the nodes, (nodes, 2)
    node_label        numbers of the nodes in the deck
    fixed             whether u, v, w of a node are held in every harmonic, (nodes, 3)
    element_label, element_body, element_size
    element_material  index of the material
    material_label    numbers of the materials
    element_nodes     (elements, 9); -1 beyond the nodes of an element
    joint_label, joint_size
    joint_material    index of the law
    law_label         numbers of the laws
    joint_interface   number of the card of INTERFACES, 0 for one of JOINTS
    joint_nodes       (joints, 6); -1 beyond
    """

    def __init__(self, read):
        self.coordinates = read("mesh/coordinates")
        self.fixed = read("mesh/fixed").astype(bool)
        for name in ("node_label", "element_label", "element_body", "element_size", "joint_label",
                     "joint_size"):
            setattr(self, name, read(f"mesh/{name}"))
        for name in ("element_material", "element_nodes", "joint_material", "joint_nodes"):
            setattr(self, name, read(f"mesh/{name}") - 1)
        self.joint_interface = read("mesh/joint_interface")
        self.material_label = read("materials/label")
        self.law_label = read("joint_materials/label")
        self._bins = None

    @cached_property
    def joint_bodies(self):
        """Bodies at side 1-2 and at side 4-3 of each joint, (joints, 2)."""
        of_edge = {key: self.element_body[element] for key, (element, _) in self.boundary().items()}
        return np.array([[of_edge.get(frozenset(nodes[side]), 0) for side in ([0, 1], [3, 2])]
                         for nodes in self.joint_nodes]).reshape(-1, 2)

    def nodes_of(self, element):
        """Nodes of an element."""
        return self.element_nodes[element, :self.element_size[element]]

    def groups(self, chosen=None):
        """Yield (size, elements) for each size of elements, among all or the chosen ones."""
        chosen = np.arange(len(self.element_size)) if chosen is None else chosen
        for size in np.unique(self.element_size[chosen]):
            yield int(size), chosen[self.element_size[chosen] == size]

    def boundary(self, chosen=None):
        """Edges that one element alone has: dictionary of frozenset of corner nodes -> (element, nodes)."""
        found = defaultdict(list)
        for size, group in self.groups(chosen):
            for local in elements.edges(size):
                for element, nodes in zip(group, self.element_nodes[group][:, local]):
                    found[frozenset((nodes[0], nodes[-1]))].append((element, nodes))
        return {key: edges[0] for key, edges in found.items() if len(edges) == 1}

    def locate(self, points):
        """Which elements points lie in.

        points: r and z, (points, 2). Returns three arrays, one entry a hit: point, element, natural
        coordinates (hits, 2); sorted by point, then element. A point has one hit for each solid - a
        body and a material - that it lies in: several where they meet, none outside the mesh.
        """
        points = np.asarray(points, float)
        point, element = self._candidates(points)
        natural = np.empty((len(point), 2))
        inside = np.zeros(len(point), bool)
        for size in np.unique(self.element_size[element]):
            chosen = np.flatnonzero(self.element_size[element] == size)
            nodes = self.coordinates[self.element_nodes[element[chosen], :size]]
            natural[chosen], inside[chosen] = elements.find_natural(nodes, points[point[chosen]])
        point, element, natural = point[inside], element[inside], natural[inside]
        order = np.lexsort((element, point))
        point, element, natural = point[order], element[order], natural[order]
        solid = np.stack([point, self.element_body[element], self.element_material[element]], -1)
        _, first = np.unique(solid, axis=0, return_index=True)
        first.sort()
        return point[first], element[first], natural[first]

    def _boxes(self):
        """Least and greatest r and z of each element, widened."""
        low, high = np.empty((2, len(self.element_size), 2))
        for size, group in self.groups():
            nodes = self.coordinates[self.element_nodes[group, :size]]
            straight = size == elements.corners(size)
            low[group], high[group] = nodes.min(axis=1), nodes.max(axis=1)
            margin = (high[group] - low[group]).max(axis=1, keepdims=True)
            margin = margin*(STRAIGHT_MARGIN if straight else CURVED_MARGIN)
            low[group] -= margin
            high[group] += margin
        return low, high

    def _make_bins(self):
        """A grid of boxes, and the elements that reach into each."""
        low, high = self._boxes()
        origin, end = low.min(axis=0), high.max(axis=0)
        count = np.maximum(1, int(np.sqrt(len(low)))*np.ones(2, int))
        width = np.where(end > origin, (end - origin)/count, 1)
        first = np.clip(((low - origin)/width).astype(int), 0, count - 1)
        last = np.clip(((high - origin)/width).astype(int), 0, count - 1)
        span = last - first + 1
        element = np.repeat(np.arange(len(low)), span.prod(axis=1))
        place = np.arange(len(element)) - np.repeat(np.cumsum(span.prod(axis=1)) - span.prod(axis=1),
                                                    span.prod(axis=1))
        cell = ((first[element, 0] + place % span[element, 0])*count[1]
                + first[element, 1] + place//span[element, 0])
        order = np.argsort(cell, kind="stable")
        start = np.searchsorted(cell[order], np.arange(count.prod() + 1))
        self._bins = low, high, origin, width, count, start, element[order]

    def _candidates(self, points):
        """Pairs of a point and an element in whose box it lies."""
        if self._bins is None:
            self._make_bins()
        low, high, origin, width, count, start, listed = self._bins
        with np.errstate(invalid="ignore"):
            near = ((points >= low.min(axis=0)) & (points <= high.max(axis=0))).all(axis=1)
        known = np.flatnonzero(near)
        place = np.clip(((points[known] - origin)/width).astype(int), 0, count - 1)
        cell = place[:, 0]*count[1] + place[:, 1]
        number = start[cell + 1] - start[cell]
        point = np.repeat(known, number)
        offset = np.arange(len(point)) - np.repeat(np.cumsum(number) - number, number)
        element = listed[np.repeat(start[cell], number) + offset]
        inside = ((points[point] >= low[element]) & (points[point] <= high[element])).all(axis=1)
        return point[inside], element[inside]
