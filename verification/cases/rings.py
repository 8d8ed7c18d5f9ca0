"""Plane-strain rings"""
import numpy as np

from convergence import Case
from deck import Deck
from material import Isotropic, Orthotropic
from mesh import graded, rectangle, structured
from solution import ANTISYMMETRIC, FAMILY_LETTER, SYMMETRIC
from solutions.plane_strain import Ring, joined_rings, ring_solution, solve_rings
from solutions.torsion import sheared_ring

STEEL = Isotropic(2.1e5, 0.3)
HOT = Isotropic(2.1e5, 0.3, 7.85e-9, 1.2e-5)
WOOD = Orthotropic((1.0e3, 8.0e2, 1.2e4), (0.3, 0.03, 0.04), (300.0, 700.0, 900.0),
                   expansion=(3.0e-5, 4.0e-6, 2.0e-5))
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


def ring_mesh(kind, n, radii, ratio):
    """A thin slice; v = 0 on its faces makes plane strain"""
    a, b = radii
    return structured(kind, n, max(1, n//8), graded(rectangle(a, b, 0.0, (b - a)/8), ratio))


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


def two_rings(m, normal=4.0e5, tangent=1.5e5):
    """Two rings with an elastic joint between them: normal and circumferential stiffness"""
    radii, soft = (1.0, 1.5, 2.0), Isotropic(1.0e5, 0.2)
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


def free_ring(name, title, m, material, radii=(INNER, OUTER), family=SYMMETRIC, cards=(),
              held=False, **loads):
    """Ring under a load of its volume; free, or held at its outer surface"""
    conditions = held_outside(radii) if held else free_surfaces(radii=radii)
    if m == 1 and not held:
        raise ValueError("a ring of harmonic 1 must be held")
    solution = ring_solution(title, material, m, radii, conditions, family, **loads)

    def build(kind, n):
        deck, mesh = plane_strain_deck(kind, n, [solution], title, radii)
        for keyword, values in cards:
            deck.add(keyword, values)
        if held:
            deck.fix(mesh, mesh.nodes_of("outer"), "101")
        return deck

    return Case(name, [[solution]], build, sizes=dict(SLICES))


def rotating():
    """Rotation at 100 per time"""
    return free_ring("rotating_cylinder", "rotating cylinder", 0, HOT, spin=1.0e4,
                     cards=[("ROTATION", [(100.0,)])])


def heated(name, m, family, material, held=False):
    """Temperature 50 + 20 r times cos or sin m theta"""
    letter = FAMILY_LETTER[family]
    return free_ring(name, f"temperature of harmonic {m}", m, material, family=family, held=held,
                     temperatures=[(50.0, 0), (20.0, 1)],
                     cards=[("TEMPERATURES", [(None, m, 50.0, 20.0, None, letter)])])


def lateral_ring():
    """Gravity along theta = 0 on a ring held outside"""
    return free_ring("lateral_gravity_ring", "ring under lateral gravity", 1, HOT, held=True,
                     lateral=1.0e4, cards=[("GRAVITY", [(None, 1.0e4)])])


def orthotropic(name, m, family):
    """Cylindrical orthotropy under sigma_r = -cos or -sin m theta outside"""
    solution = ring_solution(f"orthotropic ring, m = {m}", WOOD, m, (INNER, OUTER),
                             free_surfaces(-1.0), family)

    def build(kind, n):
        deck, mesh = plane_strain_deck(kind, n, [solution], solution.name, (INNER, OUTER))
        deck.traction(mesh, "outer", solution.mode, (-1.0, 0.0, 0.0))
        return deck

    return Case(name, [[solution]], build, sizes=dict(SLICES))


def supported():
    """Ring under -cos 2 theta inside, on springs outside: sigma_r = -k_n u, tau = -k_theta w"""
    normal, tangent = 3.0e4, 1.0e4
    ring = Ring(STEEL, 2, INNER, OUTER)
    solve_rings([([(ring, "sigma_r", INNER, 1.0)], -1.0), ([(ring, "tau", INNER, 1.0)], 0.0),
                 ([(ring, "sigma_r", OUTER, 1.0), (ring, "u", OUTER, normal)], 0.0),
                 ([(ring, "tau", OUTER, 1.0), (ring, "w", OUTER, tangent)], 0.0)], [ring])
    solution = ring.solution("ring on springs", SYMMETRIC,
                             [("sigma_r", INNER, -1.0), ("tau", INNER, 0.0)])

    def build(kind, n):
        deck, mesh = plane_strain_deck(kind, n, [solution], solution.name, (INNER, OUTER))
        # Outward normal -r
        deck.traction(mesh, "inner", solution.mode, (1.0, 0.0, 0.0))
        deck.add("SPRINGS", [(deck.face(mesh, mesh.sides["outer"]), normal, 0.0, tangent)])
        return deck

    return Case("springs", [[solution]], build, sizes=dict(SLICES))


def heated_nodes():
    """Temperature 30 r^2 sin 3 theta given at the nodes"""
    solution = ring_solution("temperature at nodes", HOT, 3, (INNER, OUTER), free_surfaces(),
                             ANTISYMMETRIC, temperatures=[(30.0, 2)])

    def build(kind, n):
        deck, mesh = plane_strain_deck(kind, n, [solution], solution.name, (INNER, OUTER))
        deck.add("NODETEMPS", [(deck.node(mesh, i), None, None, 3, 30.0*r**2, "A")
                               for i, r in enumerate(mesh.coordinates[:, 0])])
        return deck

    return Case("node_temperatures", [[solution]], build, sizes=dict(SLICES))


def twisted():
    """Shear tau_rtheta = -1 on the inner surface, in the mode of torsion; held outside"""
    solution = sheared_ring(STEEL, INNER, OUTER, 1.0)

    def build(kind, n):
        deck = Deck(solution.name, kind, 0)
        deck.material(STEEL)
        mesh = ring_mesh(kind, n, (INNER, OUTER), 1.0)
        deck.mesh(mesh)
        deck.fix(mesh, mesh.nodes_of("outer"), "001")
        # Outward normal -r
        deck.traction(mesh, "inner", solution.mode,
                      (0.0, 0.0, -float(solution.stress(np.float64(INNER), 0.0)[4])))
        return deck

    return Case("ring_in_torsion", [[solution]], build, sizes=dict(SLICES))


CASES = [lame(), *[loaded_ring(f"ring_{m}", m) for m in (0, 1, 2, 3, 5, 8)],
         *[high_harmonic(m) for m in (32, 64, 128)], kirsch(), *[two_rings(m) for m in (0, 2, 5)],
         twisted(), rotating(), lateral_ring(), heated("thermal_0", 0, SYMMETRIC, HOT),
         heated("thermal_1", 1, SYMMETRIC, HOT, held=True),
         heated("thermal_2_antisymmetric", 2, ANTISYMMETRIC, HOT), heated_nodes(), supported(),
         orthotropic("orthotropic_tube", 0, SYMMETRIC),
         orthotropic("orthotropic_ring_2", 2, SYMMETRIC),
         orthotropic("orthotropic_ring_3_antisymmetric", 3, ANTISYMMETRIC),
         heated("orthotropic_thermal_2", 2, SYMMETRIC, WOOD)]
