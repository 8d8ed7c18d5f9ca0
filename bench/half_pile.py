"""Hexahedra for one half (0 <= theta <= pi) of the pile in its footing: the example of the paper in space

The dimensions are those of inputs/case3.dat. Across the axis the pile is a square core with a ring around it.
Nodes of pile and footing that touch at rest stand at the same places, and are two.
"""
import math
from dataclasses import dataclass, field

import numpy as np

RADIUS, OUTER = 0.5, 2.0
PILE_END, MOUTH, MIDDLE, ROOF, TOP = -0.5, 0.0, 0.5, 1.0, 2.0
CORE = 0.54*RADIUS  # half the side of the square core
# Corners of an element: bottom, top. Then the middles of its edges: bottom, top, between
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
MIDDLES = [(1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2),
           (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)]
# Faces by the direction they look in: number of the face in CalculiX, corners in order
INWARD, OUTWARD, DOWN, UP = 6, 4, 1, 2
FACE_CORNERS = {INWARD: (3, 0, 4, 7), OUTWARD: (1, 2, 6, 5), DOWN: (0, 1, 2, 3), UP: (4, 5, 6, 7)}
FACE_MIDDLES = {INWARD: (11, 16, 15, 19), OUTWARD: (9, 18, 13, 17), DOWN: (8, 9, 10, 11), UP: (12, 13, 14, 15)}


@dataclass(frozen=True)
class Density:
    """Elements along the edges of the blocks; the ratio of the largest to the least element along the radius and the height,
    where elements are small at the shaft and at the ends of the socket"""
    around: int   # on the half circle: a multiple of 4
    ring: int     # of the pile, from the core to its shaft
    end: int      # along the pile outside of the socket
    half: int     # along half the socket
    footing: int  # of the footing, outward
    cover: int    # of the footing, above the socket
    ratio: float = 1.0

    @classmethod
    def of(cls, around, meridional, ratio=1.0):
        """`around` elements on the half circle; meridional mesh of inputs/case3.dat times `meridional`, of whose elements
        along the pile's radius the core takes one"""
        def times(n):
            return max(1, round(n*meridional))
        return cls(around, max(1, times(4) - 1), times(2), times(4), times(6), times(4), ratio)


@dataclass
class Mesh:
    """Nodes [m], elements by their nodes, and the named faces: pairs of element and face"""
    quadratic: bool
    nodes: list = field(default_factory=list)
    elements: list = field(default_factory=list)
    faces: dict = field(default_factory=dict)

    def face_nodes(self, element, face):
        """Nodes of a face of an element: corners, then middles"""
        places = FACE_CORNERS[face] + (FACE_MIDDLES[face] if self.quadratic else ())
        return [self.elements[element][k] for k in places]

    def nodes_of(self, name):
        """Nodes of the named faces, each once"""
        return sorted({n for element, face in self.faces[name] for n in self.face_nodes(element, face)})


def core_edge(t):
    """The point of the core's edge at the share t of the half circle"""
    s = 4*t
    if s <= 1.0:
        return CORE, CORE*s
    return (CORE*(2.0 - s), CORE) if s <= 3.0 else (-CORE, CORE*(4.0 - s))


def core(s, t):
    """Core: s along x, t along y"""
    return CORE*(2*s - 1), CORE*t


def ring(s, t):
    """Pile around its core: s outward, t around"""
    x, y = core_edge(t)
    return (1 - s)*x + s*RADIUS*math.cos(math.pi*t), (1 - s)*y + s*RADIUS*math.sin(math.pi*t)


def annulus(s, t):
    """Footing around the pile: s outward, t around"""
    r = RADIUS + s*(OUTER - RADIUS)
    return r*math.cos(math.pi*t), r*math.sin(math.pi*t)


def graded(n, ratio):
    """Ends of n elements between 0 and 1, the last `ratio` times as long as the first"""
    lengths = ratio**(np.arange(n)/max(1, n - 1))
    return np.concatenate([[0.0], np.cumsum(lengths)])/lengths.sum()


class Builder:
    """Adds blocks to a mesh; nodes at one place in one body are one"""

    def __init__(self, quadratic):
        self.mesh = Mesh(quadratic)
        self.places = {}

    def node(self, body, point):
        """Number of the node of a body at a point"""
        key = (body, *(round(x*1e8) for x in point))
        if key not in self.places:
            self.places[key] = len(self.mesh.nodes)
            self.mesh.nodes.append(point)
        return self.places[key]

    def block(self, body, cross_section, n, low, high, ratios=(1.0, 1.0), **faces):
        """n elements along s, t and z between two heights; ratios of the last to the first element along s and z; faces
        name its sides: side=name"""
        shape = CORNERS + (MIDDLES if self.mesh.quadratic else [])
        across, along = graded(n[0], ratios[0]), low + (high - low)*graded(n[2], ratios[1])
        for k in range(n[2]):
            for j in range(n[1]):
                for i in range(n[0]):
                    nodes = []
                    for a, b, c in shape:
                        x, y = cross_section(between(across, i, a/2), (j + b/2)/n[1])
                        nodes.append(self.node(body, (x, y, between(along, k, c/2))))
                    self.mesh.elements.append(nodes)
                    at = {"inward": (INWARD, i == 0), "outward": (OUTWARD, i == n[0] - 1),
                          "down": (DOWN, k == 0), "up": (UP, k == n[2] - 1)}
                    for side, name in faces.items():
                        face, there = at[side]
                        if there:
                            self.mesh.faces.setdefault(name, []).append((len(self.mesh.elements) - 1, face))


def between(ends, element, share):
    """The place at a share of an element, from its ends"""
    return float((1 - share)*ends[element] + share*ends[element + 1])


def half_pile(density, quadratic):
    """Pile (body 1) and footing (body 2), with the faces end, shaft, wall, head, roof, top"""
    build, d = Builder(quadratic), density
    quarter, first, last = d.around//4, d.ratio, 1/d.ratio  # small elements at the first or last end
    sockets = ((MOUTH, MIDDLE, first), (MIDDLE, ROOF, last))
    for section, n, ratio in ((core, (2*quarter, quarter), 1.0), (ring, (d.ring, d.around), last)):
        shaft = {"outward": "shaft"} if section is ring else {}
        build.block(1, section, (*n, d.end), PILE_END, MOUTH, (ratio, last), down="end")
        for low, high, along in sockets:
            build.block(1, section, (*n, d.half), low, high, (ratio, along), **shaft, **({"up": "head"} if high == ROOF else {}))
        build.block(2, section, (*n, d.cover), ROOF, TOP, (ratio, first), down="roof", up="top")
    for low, high, along in sockets:
        build.block(2, annulus, (d.footing, d.around, d.half), low, high, (first, along), inward="wall")
    build.block(2, annulus, (d.footing, d.around, d.cover), ROOF, TOP, (first, first), up="top")
    return build.mesh


def shape_functions(s, t, quadratic):
    """Shape functions of a face of 4 or 8 nodes and their derivatives along s and t, at one point"""
    signs = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    if not quadratic:
        return (np.array([(1 + a*s)*(1 + b*t)/4 for a, b in signs]),
                np.array([[a*(1 + b*t)/4, b*(1 + a*s)/4] for a, b in signs]))
    values = [(1 + a*s)*(1 + b*t)*(a*s + b*t - 1)/4 for a, b in signs]
    slopes = [[a*(1 + b*t)*(2*a*s + b*t)/4, b*(1 + a*s)*(a*s + 2*b*t)/4] for a, b in signs]
    for a, b in ((0, -1), (1, 0), (0, 1), (-1, 0)):
        if a == 0:
            values.append((1 - s*s)*(1 + b*t)/2)
            slopes.append([-s*(1 + b*t), b*(1 - s*s)/2])
        else:
            values.append((1 + a*s)*(1 - t*t)/2)
            slopes.append([a*(1 - t*t)/2, -t*(1 + a*s)])
    return np.array(values), np.array(slopes)


def end_forces(mesh, lateral, moment):
    """Nodal forces on the half of the pile's end: a shear stress along x of resultant `lateral`, and a normal
    stress in proportion to x of the moment `moment`, both on the whole pile

    The stresses are those on the area and the moment of inertia of the mesh's own end, so that the resultants
    are exact on every mesh.
    """
    point, weight = np.polynomial.legendre.leggauss(3)
    area = inertia = 0.0
    unit = {}
    for element, face in mesh.faces["end"]:
        nodes = mesh.face_nodes(element, face)
        places = np.array([mesh.nodes[n][:2] for n in nodes])
        for s, ws in zip(point, weight):
            for t, wt in zip(point, weight):
                values, slopes = shape_functions(s, t, mesh.quadratic)
                size = ws*wt*abs(np.linalg.det(slopes.T @ places))
                x = values @ places[:, 0]
                area += size
                inertia += size*x*x
                for node, value in zip(nodes, values):
                    unit.setdefault(node, np.zeros(2))
                    unit[node] += size*value*np.array([1.0, x])
    return {node: (lateral/2/area*along, moment/2/inertia*tilt) for node, (along, tilt) in unit.items()}
