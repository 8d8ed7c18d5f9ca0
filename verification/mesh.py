"""Structured meshes of all element types, and their shape functions

Elements list their nodes as the ELEMENTS card does: counterclockwise from a corner, corners and
mid-sides in turn, the centre last.
"""
import dataclasses

import numpy as np


@dataclasses.dataclass(frozen=True)
class ElementType:
    """Nodes of an element, and what the CONTROL card says of it"""
    name: str
    nodes: int
    # Polynomial degree p: displacements of order p + 1, stresses of order p
    degree: int
    gauss_points: int = 0
    bbar: bool = False

    @property
    def quadratic(self):
        """Whether sides have a middle node"""
        return self.degree == 2

    @property
    def triangle(self):
        """Whether the element is a triangle"""
        return self.nodes in (3, 6)


ELEMENT_TYPES = {kind.name: kind for kind in (
    ElementType("4-node", 4, 1), ElementType("4-node B-bar", 4, 1, bbar=True),
    ElementType("8-node", 8, 2), ElementType("8-node reduced", 8, 2, gauss_points=2),
    ElementType("9-node", 9, 2), ElementType("3-node", 3, 1), ElementType("6-node", 6, 2))}
ALL_TYPES = tuple(ELEMENT_TYPES.values())

# Places (a, b) of the nodes of a cell on its grid: of 2 x 2 lines, or of 3 x 3 with middles
CORNERS = ((0, 0), (1, 0), (1, 1), (0, 1))
PERIMETER = ((0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1))
CELLS = {4: (CORNERS,), 8: (PERIMETER,), 9: (PERIMETER + ((1, 1),),),
         3: ((CORNERS[0], CORNERS[1], CORNERS[2]), (CORNERS[0], CORNERS[2], CORNERS[3])),
         6: (((0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 1)),
             ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)))}


@dataclasses.dataclass
class Mesh:
    """Nodes and elements of one body"""
    kind: ElementType
    # Shape (nodes, 2)
    coordinates: np.ndarray
    # Indices of nodes, shape (elements, nodes per element)
    elements: np.ndarray
    # Name of a side -> its edges, along the side: nodes from end to end, shape (edges, 2 or 3)
    sides: dict

    def nodes_of(self, *sides):
        """Nodes of sides, each once"""
        return np.unique(np.concatenate([self.sides[side].ravel() for side in sides]))

    @property
    def boundary(self):
        """Nodes of all sides"""
        return self.nodes_of(*self.sides)


def structured(kind, n, m, place):
    """A mesh of n x m cells. `place(s, t)` puts the unit square in the (r, z) plane, s and t along r
    and z in the sense of rotation; sides: inner s = 0, outer s = 1, bottom t = 0, top t = 1"""
    step = 2 if kind.quadratic else 1
    lines = np.full((step*n + 1, step*m + 1), -1)
    elements = []
    for j in range(m):
        for i in range(n):
            for cell in CELLS[kind.nodes]:
                elements.append([(step*i + a, step*j + b) for a, b in cell])
    used = sorted({node for element in elements for node in element}, key=lambda node: node[::-1])
    for number, node in enumerate(used):
        lines[node] = number
    s, t = np.array(used, dtype=float).T/[[step*n], [step*m]]
    coordinates = np.column_stack(np.broadcast_arrays(*place(s, t)))
    return Mesh(kind, coordinates, np.array([[lines[node] for node in e] for e in elements]),
                {"inner": edges(lines[0], step), "outer": edges(lines[-1], step),
                 "bottom": edges(lines[:, 0], step), "top": edges(lines[:, -1], step)})


def edges(line, step):
    """Cuts a line of nodes into edges"""
    return np.array([line[i:i + step + 1] for i in range(0, len(line) - 1, step)])


def rectangle(r0, r1, z0, z1):
    """Place of a rectangle"""
    return lambda s, t: (r0 + (r1 - r0)*s, z0 + (z1 - z0)*t)


def polar(inner, outer):
    """Place of a quarter of a hollow sphere: s along its radius, t from the plane z = 0 to the axis"""
    def place(s, t):
        size, angle = inner + (outer - inner)*s, np.pi/2*t
        return size*np.where(t == 1.0, 0.0, np.cos(angle)), size*np.sin(angle)
    return place


def conical(slope, z0, z1):
    """Place of a truncated cone with its apex at the origin"""
    return lambda s, t: (s*slope*(z0 + (z1 - z0)*t), z0 + (z1 - z0)*t)


def graded(place, ratio):
    """The same with cells along s in geometric progression: last to first as `ratio`"""
    if ratio == 1.0:
        return place
    return lambda s, t: place((ratio**s - 1)/(ratio - 1), t)


def wavy(place, size=0.08):
    """The same with smoothly distorted cells inside; the sides stay"""
    def distorted(s, t):
        bump = size*np.sin(np.pi*s)*np.sin(np.pi*t)
        return place(s + bump*np.cos(2*t + 1), t - bump*np.cos(3*s))
    return distorted


def shaken(mesh, size, seed=1985):
    """A mesh of straight sides with its inner corners moved at random by up to `size`"""
    generator = np.random.default_rng(seed)
    step = 2 if mesh.kind.quadratic else 1
    x = mesh.coordinates.copy()
    corners = np.unique(mesh.elements[:, 0:8:step])
    inside = np.setdiff1d(corners, mesh.boundary)
    x[inside] += size*(2*generator.random((len(inside), 2)) - 1)
    if mesh.kind.quadratic:
        around = 6 if mesh.kind.triangle else 8
        for element in mesh.elements:
            ring = element[:around]
            x[ring[1::2]] = (x[ring[0::2]] + x[np.roll(ring[0::2], -1)])/2
            if mesh.kind.nodes == 9:
                x[element[8]] = x[ring[0::2]].mean(axis=0)
    return dataclasses.replace(mesh, coordinates=x)


def shape_functions(nodes, xi, eta):
    """Shape functions and their derivatives by xi, eta at points: shapes (points, nodes) and
    (points, nodes, 2); a quadrilateral is -1 .. 1, a triangle has the corners (0, 0), (1, 0), (0, 1)"""
    if nodes in (3, 6):
        return triangle_functions(nodes, xi, eta)
    x, y = np.array([[-1, -1], [0, -1], [1, -1], [1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0]]).T
    if nodes == 4:
        x, y = x[::2], y[::2]
    a, b = np.multiply.outer(xi, x), np.multiply.outer(eta, y)
    p, q = xi[:, None], eta[:, None]
    if nodes == 4:
        return (1 + a)*(1 + b)/4, np.stack([x*(1 + b)/4, y*(1 + a)/4], axis=-1)
    if nodes == 9:
        return lagrange_functions(xi, eta)
    corner, along = (x*y != 0), (x == 0)
    value = np.where(corner, (1 + a)*(1 + b)*(a + b - 1)/4,
                     np.where(along, (1 - p**2)*(1 + b)/2, (1 + a)*(1 - q**2)/2))
    by_xi = np.where(corner, x*(1 + b)*(2*a + b)/4,
                     np.where(along, -p*(1 + b), x*(1 - q**2)/2))
    by_eta = np.where(corner, y*(1 + a)*(a + 2*b)/4,
                      np.where(along, y*(1 - p**2)/2, -q*(1 + a)))
    return value, np.stack([by_xi, by_eta], axis=-1)


def lagrange_functions(xi, eta):
    """9-node element: products of parabolas"""
    def parabolas(t):
        return (np.array([t*(t - 1)/2, 1 - t**2, t*(t + 1)/2]), np.array([t - 0.5, -2*t, t + 0.5]))
    (f, df), (g, dg) = parabolas(xi), parabolas(eta)
    order = PERIMETER + ((1, 1),)
    value = np.array([f[a]*g[b] for a, b in order]).T
    slope = np.array([[df[a]*g[b], f[a]*dg[b]] for a, b in order])
    return value, np.moveaxis(slope, 2, 0)


def triangle_functions(nodes, xi, eta):
    """3- and 6-node triangles"""
    l = np.array([1 - xi - eta, xi, eta])
    d = np.array([[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]])
    ones = np.ones_like(xi)
    if nodes == 3:
        return l.T, np.multiply.outer(ones, d)
    value, slope = [], []
    for i in range(3):
        j = (i + 1) % 3
        value += [l[i]*(2*l[i] - 1), 4*l[i]*l[j]]
        slope += [np.multiply.outer(4*l[i] - 1, d[i]),
                  4*(np.multiply.outer(l[i], d[j]) + np.multiply.outer(l[j], d[i]))]
    return np.array(value).T, np.stack(slope, axis=1)


def edge_functions(nodes, t):
    """Shape functions of an edge from end to end and their slopes at t in -1 .. 1: (points, nodes)"""
    if nodes == 2:
        return np.array([(1 - t)/2, (1 + t)/2]).T, np.multiply.outer(np.ones_like(t), [-0.5, 0.5])
    return (np.array([t*(t - 1)/2, 1 - t**2, t*(t + 1)/2]).T,
            np.array([t - 0.5, -2*t, t + 0.5]).T)


def points_of(kind, n=4):
    """Integration points xi, eta and weights, exact to the degree 2 n - 2 at least"""
    t, w = np.polynomial.legendre.leggauss(n)
    xi, eta = (x.ravel() for x in np.meshgrid(t, t, indexing="ij"))
    weight = np.multiply.outer(w, w).ravel()
    if not kind.triangle:
        return xi, eta, weight
    # The square folded to a triangle
    a, b = (1 + xi)/2, (1 + eta)/2
    return a*(1 - b), b, weight*(1 - b)/4
