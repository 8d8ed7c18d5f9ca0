"""Writes decks, in free format"""
import numpy as np

from mesh import edge_functions
from solution import FAMILY_LETTER, SYMMETRIC


# Whether the outward normal lies to the right (+1) or to the left of a side of a structured mesh
OUTWARD = {"inner": -1, "outer": 1, "bottom": 1, "top": -1}


def field(value, digits=17):
    """A number or word as a field of a card; None is a blank field"""
    if value is None:
        return ""
    if isinstance(value, str):
        return value
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if abs(value) < 1e-30:
        return "0.0"
    return (repr(float(value)) if digits == 17 else f"{float(value):.{digits}g}").upper()


def card(*values):
    """A card in free format of at most 80 columns, with as many digits as have room"""
    for digits in (17, 16, 15, 14):
        text = ",".join(field(value, digits) for value in values) + ","
        if len(text) <= 80:
            return text
    raise ValueError(f"no room on a card: {text}")


class Deck:
    """One job: bodies are meshes or blocks; loads and supports are taken from exact solutions"""

    def __init__(self, title, kind, highest, harmonics=None):
        self.title, self.kind, self.highest = title, kind, highest
        self.sections, self.offsets, self.faces = [], {}, 0
        self.meshes, self.modes = [], set()
        self.harmonics = harmonics

    def add(self, keyword, cards):
        """A section"""
        if cards:
            self.sections.append((keyword, [card(*values) for values in cards]))

    def material(self, material, number=1):
        """Cards of a material"""
        self.add(*material.cards(number))

    def mesh(self, mesh, material=1):
        """Nodes and elements of a mesh, a body of its own"""
        body = len(self.meshes) + 1
        first = sum(len(other.coordinates) for other in self.meshes)
        first_element = sum(len(other.elements) for other in self.meshes)
        self.meshes.append(mesh)
        self.offsets[id(mesh)] = first
        self.add("NODES", [(first + i + 1, r, z) for i, (r, z) in enumerate(mesh.coordinates)])
        self.add("ELEMENTS", [(first_element + i + 1, material, body, *(first + nodes + 1))
                              for i, nodes in enumerate(mesh.elements)])

    def node(self, mesh, index):
        """Number of a node in the deck"""
        return int(self.offsets[id(mesh)] + index + 1)

    def fix(self, mesh, nodes, code):
        """Holds components of nodes in every mode; code: three digits"""
        self.add("RESTRAINTS", [(self.node(mesh, i), code) for i in nodes])

    def face(self, mesh, edges):
        """A face along edges; its number"""
        self.faces += 1
        nodes = [self.node(mesh, i) for i in [edges[0][0], *edges[:, -1]]]
        cards, start = [], 0
        while start < len(nodes) - 1:
            cards.append((self.faces, *nodes[start:start + 8]))
            start += 7
        self.add("CHAINS", cards)
        return self.faces

    def traction(self, mesh, side, mode, first, last=None):
        """Amplitudes t_r, t_z, t_theta along a side, linear from its first to its last point"""
        number = self.face(mesh, mesh.sides[side])
        harmonic, family = mode
        values = [number, harmonic, *first, *(last if last is not None else [None]*3)]
        self.add("TRACTIONS", [values + ([FAMILY_LETTER[family]] if family != SYMMETRIC else [])])

    def move(self, mesh, nodes, solution, components="uvw"):
        """Holds nodes at an exact displacement; in other modes they are held at zero"""
        r, z = mesh.coordinates[nodes].T
        exact = solution.displacement(r, z).T
        cards = []
        for i, at_r, value in zip(nodes, r, exact):
            free = released_on_axis(at_r, solution.mode)
            values = [x if c in components and c not in free else None
                      for c, x in zip("uvw", value)]
            if any(x is not None for x in values):
                cards.append((self.node(mesh, i), solution.harmonic, *values,
                              FAMILY_LETTER[solution.family]))
        self.add("MOVEDNODES", cards)

    def load_side(self, mesh, side, solution):
        """The exact traction on a side as ring loads, the work-equivalent nodal forces"""
        forces = nodal_forces(mesh, mesh.sides[side], solution, OUTWARD[side])
        cards = []
        for i in np.unique(mesh.sides[side]):
            r = mesh.coordinates[i, 0]
            values = ring_load(r, forces[i], solution.mode)
            if values is not None:
                cards.append((self.node(mesh, i), solution.harmonic, *values,
                              FAMILY_LETTER[solution.family]))
        if solution.family == SYMMETRIC:
            cards = [values[:-1] for values in cards]
        self.add("RINGLOADS", cards)

    def text(self):
        """The deck"""
        control = [self.highest, None, None, None]
        if self.kind is not None and self.kind.gauss_points:
            control[3] = self.kind.gauss_points
        if self.kind is not None and self.kind.bbar:
            control += [None, "BBAR"]
        lines = ["TITLE", self.title[:80], "CONTROL", card(*control)]
        if self.harmonics:
            lines += ["HARMONICS"] + [card(m) for m in self.harmonics]
        for keyword, cards in self.sections:
            lines += [keyword, *cards]
        # a quarter of the shortest wave farther what is zero at 0 is largest
        angles = [0.0, 90.0/self.highest] if self.highest else [0.0]
        return "\n".join([*lines, "OUTPUT", card(*angles), "END"]) + "\n"


def released_on_axis(r, mode):
    """Components that the conditions on the axis decide, so that no card may prescribe them"""
    if r != 0.0:
        return ""
    if mode[0] == 0:
        return "uw"
    return "vw" if mode[0] == 1 else "uvw"


def nodal_forces(mesh, edges, solution, outward):
    """Work of the exact traction over the whole circle on unit amplitudes, shape (nodes, 3)"""
    t, w = np.polynomial.legendre.leggauss(8)
    value, slope = edge_functions(edges.shape[1], t)
    circle = 2*np.pi if solution.harmonic == 0 else np.pi
    forces = np.zeros((len(mesh.coordinates), 3))
    for edge in edges:
        x = mesh.coordinates[edge]
        r, z = (value @ x).T
        r_t, z_t = (slope @ x).T
        length = np.hypot(r_t, z_t)
        traction = solution.traction(r, z, outward*z_t/length, -outward*r_t/length)
        forces[edge] += circle*np.einsum("pn,p,cp->nc", value, w*length*r, traction)
    return forces


def ring_load(r, force, mode):
    """Components q_r, q_z, q_theta that give nodal forces; None if there are none"""
    if not np.any(force):
        return None
    circle = 2*np.pi if mode[0] == 0 else np.pi
    if r > 0.0:
        return tuple(force/(circle*r))
    if mode[0] == 0:
        return (None, force[1], None)
    # On the axis w = -u: the lateral force is the work on u = 1, w = -1
    return (force[0] - force[2], None, None) if mode[0] == 1 else None
