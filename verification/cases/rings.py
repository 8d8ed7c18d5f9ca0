"""Plane-strain rings"""
from convergence import Case
from deck import Deck
from material import Isotropic, Orthotropic
from mesh import ALL_TYPES, graded, rectangle, structured
from solution import ANTISYMMETRIC, SYMMETRIC
from solutions.plane_strain import joined_rings, ring_solution

STEEL = Isotropic(2.1e5, 0.3)
WOOD = Orthotropic((1.0e3, 8.0e2, 1.2e4), (0.3, 0.03, 0.04), (300.0, 700.0, 900.0))
INNER, OUTER = 1.0, 2.0
# Cells along r, by degree of the elements
SLICES = {1: (16, 32, 64), 2: (8, 16, 32)}


def free_surfaces(load=0.0, shear=0.0, radii=(INNER, OUTER)):
    """Conditions: sigma_r and tau given outside, nothing inside"""
    a, b = radii
    return [("sigma_r", b, load), ("tau", b, shear), ("sigma_r", a, 0.0), ("tau", a, 0.0)]


def held_outside(radii=(INNER, OUTER)):
    """Conditions: free inside, held outside"""
    a, b = radii
    return [("sigma_r", a, 0.0), ("tau", a, 0.0), ("u", b, 0.0), ("w", b, 0.0)]


def ring_mesh(kind, n, radii, ratio, cells=2):
    """A thin slice; v = 0 on its faces makes plane strain. Refined along r alone: nothing depends on z"""
    a, b = radii
    return structured(kind, n, cells, graded(rectangle(a, b, 0.0, (b - a)/8), ratio))


def plane_strain_deck(kind, n, solutions, title, radii, ratio=1.0):
    """Slice of a ring with its supports v = 0"""
    harmonics = sorted({solution.harmonic for solution in solutions})
    deck = Deck(title, kind, harmonics[-1])
    deck.material(solutions[0].material)
    mesh = ring_mesh(kind, n, radii, ratio)
    deck.mesh(mesh)
    deck.fix(mesh, mesh.nodes_of("bottom", "top"), "010")
    return deck, mesh


def loaded_ring(name, m, sizes=None, ratio=1.0):
    """Ring under sigma_r = -cos m theta outside, tractions by cards"""
    conditions = free_surfaces(-1.0)
    if m == 1:
        conditions = [("sigma_r", OUTER, -1.0), ("tau", OUTER, 0.0), ("u", INNER, 0.0),
                      ("w", INNER, 0.0)]
    solution = ring_solution(f"ring under cos {m} theta", STEEL, m, (INNER, OUTER), conditions)

    def build(kind, n):
        deck, mesh = plane_strain_deck(kind, n, [solution], solution.name, (INNER, OUTER), ratio)
        deck.traction(mesh, "outer", solution.mode, (-1.0, 0.0, 0.0))
        if m == 1:
            deck.fix(mesh, mesh.nodes_of("inner"), "101")
        return deck

    return Case(name, [[solution]], build, sizes=sizes or dict(SLICES))


def high_harmonic(m):
    """The load reaches a depth of some OUTER/m: cells are small outside, and many"""
    return loaded_ring(f"ring_{m}", m, {1: (64, 128, 256), 2: (32, 64, 128)}, ratio=1/max(4, m/8))


def lame():
    """Cylinder under pressure inside"""
    solution = ring_solution("thick cylinder", STEEL, 0, (INNER, OUTER),
                             [("sigma_r", INNER, -1.0), ("sigma_r", OUTER, 0.0)])

    def build(kind, n):
        deck, mesh = plane_strain_deck(kind, n, [solution], solution.name, (INNER, OUTER))
        deck.traction(mesh, "inner", solution.mode, (1.0, 0.0, 0.0))
        return deck

    return Case("thick_cylinder", [[solution]], build, sizes=dict(SLICES))


def kirsch():
    """Hole under tension along x: m = 0 and m = 2; the outer surface carries the exact tractions of
    the infinite body at four radii"""
    far, outer = 400.0, 4.0
    parts = [ring_solution("hole under tension", STEEL, m, (INNER, far),
                           free_surfaces(0.5, -0.5 if m == 2 else 0.0, (INNER, far))) for m in (0, 2)]

    def build(kind, n):
        deck, mesh = plane_strain_deck(kind, n, parts, "Hole under tension", (INNER, outer), 4.0)
        for solution in parts:
            s = [float(x) for x in solution.stress(outer, 0.0)]
            deck.traction(mesh, "outer", solution.mode, (s[0], 0.0, s[4]))
        return deck

    return Case("hole", [parts], build, sizes=dict(SLICES))


def two_rings(m):
    """Two rings with an elastic joint between them"""
    radii, soft = (1.0, 1.5, 2.0), Isotropic(1.0e5, 0.2)
    normal, tangent = 4.0e5, 1.5e5
    conditions = [("sigma_r", 2.0, -1.0), ("tau", 2.0, 0.0), ("u", 1.0, 0.0), ("w", 1.0, 0.0)]
    solutions = joined_rings(f"joined rings, m = {m}", (STEEL, soft), m, radii, (normal, tangent),
                             conditions)

    def build(kind, n):
        deck = Deck(solutions[0].name, kind, m)
        deck.material(STEEL, 1)
        deck.material(soft, 2)
        meshes = [ring_mesh(kind, n, radii[:2], 1.0), ring_mesh(kind, n, radii[1:], 1.0)]
        for number, mesh in enumerate(meshes, start=1):
            deck.mesh(mesh, number)
            deck.fix(mesh, mesh.nodes_of("bottom", "top"), "010")
        deck.fix(meshes[0], meshes[0].nodes_of("inner"), "101")
        deck.traction(meshes[1], "outer", (m, SYMMETRIC), (-1.0, 0.0, 0.0))
        deck.add("LAWS", [(1, tangent, normal, tangent, None, None, "ELASTIC")])
        faces = [deck.face(meshes[0], meshes[0].sides["outer"]),
                 deck.face(meshes[1], meshes[1].sides["inner"])]
        deck.add("INTERFACES", [(1, *faces)])
        return deck

    return Case(f"joined_rings_{m}", [[s] for s in solutions], build, sizes=dict(SLICES))


CASES = [lame(), *[loaded_ring(f"ring_{m}", m) for m in (0, 1, 2, 3, 5, 8)],
         *[high_harmonic(m) for m in (32, 64, 128)], kirsch(), *[two_rings(m) for m in (0, 2, 5)]]
