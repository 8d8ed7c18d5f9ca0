"""The section swept round the axis: points and cells, for views in three dimensions.

A section point is a node with one material, as its smoothed stresses are, or the centre of an element of
8 nodes. Elements of 6, 8 and 9 nodes are divided into four, so that all cells are linear.
"""
from functools import cached_property

import numpy as np

from . import circle, elements

# Cells of an element by its number of nodes; 8 is the centre
CELLS = {3: [(0, 1, 2)], 4: [(0, 1, 2, 3)], 6: [(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)],
         9: [(0, 4, 8, 7), (4, 1, 5, 8), (8, 5, 2, 6), (7, 8, 6, 3)]}
CELLS[8] = CELLS[9]


class Sweep:
    """Section points of a Result, and what is known there.

    position      r and z, (points, 2)
    node          node of each point, -1 at the centre of an element of 8 nodes, (points)
    places        point of each node of each element, with the centre in place 8, (elements, 9)
    """

    def __init__(self, result):
        mesh = result.mesh
        self.result, self._count = result, len(result.read("stress/nodal_node"))
        self.places = result.value_of.copy()
        self._eights = np.flatnonzero(mesh.element_size == 8)
        self.places[self._eights, 8] = self._count + np.arange(len(self._eights))
        self.node = np.concatenate([result.read("stress/nodal_node") - 1, np.full(len(self._eights), -1)])
        self.position = self.with_centres(mesh.coordinates[self.node[:self._count]])

    def with_centres(self, values):
        """Values at the nodes' points, (..., points, components), with those that shape functions give at centres."""
        share, _ = elements.shape_functions(8, np.zeros((1, 2)))
        centres = np.einsum("n,...enc->...ec", share[0], values[..., self.places[self._eights, :8], :])
        return np.concatenate([values, centres], -2)

    @cached_property
    def displacement(self):
        """Amplitudes u, v, w, (modes, points, 3)."""
        return self.with_centres(self.result.displacement_amplitude[:, self.node[:self._count]])

    @cached_property
    def stress(self):
        """Amplitudes of the smoothed stresses, (modes, points, 6)."""
        return self.with_centres(self.result.nodal_amplitude)

    def at(self, amplitude, angles):
        """Totals on planes, (angles, points, components); angles in degrees."""
        result = self.result
        return np.stack([circle.totals(amplitude, result.harmonic, result.family,
                                       np.full(amplitude.shape[1], float(angle))) for angle in angles])

    def cells(self, chosen=None):
        """Yield linear cells of all or the chosen elements, triangles and quadrilaterals: elements, points (cells, 3 or 4)."""
        for size, group in self.result.mesh.groups(chosen):
            pattern = np.array(CELLS[size])
            yield np.repeat(group, len(pattern)), self.places[group][:, pattern].reshape(-1, pattern.shape[1])
