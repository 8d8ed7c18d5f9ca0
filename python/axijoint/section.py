"""Results along straight lines."""
from dataclasses import dataclass
from typing import Optional

import numpy as np

from .components import DISPLACEMENTS, STRESSES
from .table import Table


@dataclass
class Section:
    """Results along a straight line of the meridional plane, a row for each point and solid.

    number         number in the deck; None if it is none of the deck
    first, last    r and z of the ends
    theta          angles [degree], (angles)
    point          number of each row's point along the line, from 1
    position       r and z, (rows, 2)
    distance       from the first end, (rows)
    element, body, material   numbers of the deck, (rows)
    displacement   u, v, w, (angles, rows, 3)
    stress         r, z, theta, rz, r-theta, z-theta, (angles, rows, 6)
    """
    number: Optional[int]
    first: np.ndarray
    last: np.ndarray
    theta: np.ndarray
    point: np.ndarray
    position: np.ndarray
    distance: np.ndarray
    element: np.ndarray
    body: np.ndarray
    material: np.ndarray
    displacement: np.ndarray
    stress: np.ndarray

    def table(self):
        """All angles below one another: a Table."""
        count, n = len(self.theta), len(self.point)
        columns = {"theta": np.repeat(self.theta, n)}
        for name in ("point", "distance", "element", "body", "material"):
            columns[name] = np.tile(getattr(self, name), count)
        columns["r"], columns["z"] = np.tile(self.position, (count, 1)).T
        values = self.displacement.reshape(count*n, 3), self.stress.reshape(count*n, 6)
        for names, array in zip((DISPLACEMENTS, STRESSES), values):
            columns |= {name: array[:, k] for k, name in enumerate(names)}
        return Table(columns)

    def pieces(self):
        """Rows of each stretch in one solid, in order: curves break where the solid changes."""
        found, latest = [], {}
        for row, solid in enumerate(zip(self.body.tolist(), self.material.tolist())):
            piece = latest.get(solid)
            if piece is None or self.point[row] - self.point[piece[-1]] > 1:
                piece = latest[solid] = []
                found.append(piece)
            piece.append(row)
        return [np.array(piece) for piece in found]


def line_rows(mesh, points):
    """Points of a line, elements, natural coordinates: a row for each solid that a point lies in.

    Where solids meet, the one that the line comes from stands first, as in the listing, and where it
    comes from none of them, that of the last element.
    """
    point, element, natural = mesh.locate(points)
    order = np.lexsort((-element, point))
    point, element, natural = point[order], element[order], natural[order]
    solid = np.stack([mesh.element_body[element], mesh.element_material[element]], -1)
    order = np.arange(len(point))
    begins = np.flatnonzero(np.diff(point, prepend=-1))
    for begin, end in zip(begins, np.append(begins[1:], len(point))):
        if end - begin == 1 or begin == 0:
            continue
        before = solid[order[begin - 1]]
        for k in range(begin + 1, end):
            if (solid[order[k]] == before).all():
                order[[begin, k]] = order[[k, begin]]
                break
    return point[order], element[order], natural[order]
