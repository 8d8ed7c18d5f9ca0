"""Bodies that touch the axis: patches, bending, flexure, weight, torsion, spheres"""
import math

import numpy as np

from convergence import Case
from deck import Deck
from material import Isotropic, Orthotropic
from mesh import conical, graded, polar, rectangle, shaken, structured, wavy
from solution import ANTISYMMETRIC, SYMMETRIC
from solutions import polynomials, spheres, torsion

STEEL = Isotropic(2.1e5, 0.3)
HEAVY = Isotropic(2.0e4, 0.2, 2.5e-3)
TURNED = Orthotropic((1.2e4, 8.0e2, 1.5e3), (0.3, 0.2, 0.25), (700.0, 300.0, 900.0), 30.0)
SHAFT = rectangle(0.0, 1.0, 0.0, 2.0)
# Cells along the longer direction
SOLIDS = {1: (8, 16, 32), 2: (8, 16, 32)}


def quadratic(kind):
    """Whether an element holds all quadratic fields on a rectangular mesh"""
    return kind.degree == 2


def every(kind):
    """Any element: for linear fields"""
    del kind
    return True


def start(title, kind, material, mesh, solutions):
    """A deck with material and mesh, in the harmonics of the solutions"""
    deck = Deck(title, kind, max(solution.harmonic for solution in solutions))
    deck.material(material)
    deck.mesh(mesh)
    return deck


def irregular(kind, n, place=SHAFT, size=0.25):
    """A mesh of straight sides whose inner nodes are moved at random; the reduced rule, which is not
    exact on such cells, gets rectangles"""
    mesh = structured(kind, n//2, n, place)
    if kind.gauss_points:
        return mesh
    return shaken(mesh, size*np.ptp(mesh.coordinates[:, 1])/n)


def held_all_round(name, solutions, make_mesh, contains, material, **more):
    """Exact displacements on the whole surface"""
    def build(kind, n):
        mesh = make_mesh(kind, n)
        deck = start(name, kind, material, mesh, solutions)
        for solution in solutions:
            deck.move(mesh, mesh.boundary, solution)
        return deck

    return Case(name, [solutions], build, contains=contains, sizes=dict(SOLIDS), **more)


def rigid(name, family):
    """Rigid motions: no strain; the stress scale is that of strains of 1"""
    return held_all_round(name, polynomials.rigid_motions(STEEL, family), irregular, every, STEEL,
                          stress_scale=STEEL.young)


def patch(name, family):
    """Constant strain, displacements given"""
    return held_all_round(name, polynomials.constant_strain(STEEL, family), irregular,
                          every, STEEL)


def patch_under_tractions():
    """Constant strain, tractions on the mantle and on top"""
    solutions = polynomials.constant_strain(STEEL)

    def build(kind, n):
        mesh = irregular(kind, n)
        deck = start("Patch under tractions", kind, STEEL, mesh, solutions)
        for solution in solutions:
            s = solution.stress(np.float64(1.0), np.float64(1.0))
            deck.move(mesh, mesh.nodes_of("bottom"), solution)
            deck.traction(mesh, "outer", solution.mode, (s[0], s[3], s[4]))
            deck.traction(mesh, "top", solution.mode, (s[3], s[1], s[5]))
        return deck

    return Case("patch_under_tractions", [solutions], build, contains=every,
                sizes=dict(SOLIDS))


def turned_patch():
    """Orthotropic material, direction 1 turned by 30 degrees"""
    return held_all_round("patch_turned", [polynomials.turned_patch(TURNED)],
                          lambda kind, n: irregular(kind, n, rectangle(0.5, 1.5, 0.0, 2.0)),
                          every, TURNED)


def pure_bending():
    """Held below, sigma_z on top by a traction linear in r"""
    solution = polynomials.pure_bending(STEEL)

    def build(kind, n):
        mesh = structured(kind, n//2, n, SHAFT)
        deck = start("Pure bending", kind, STEEL, mesh, [solution])
        deck.move(mesh, mesh.nodes_of("bottom"), solution)
        edge = float(solution.stress(np.float64(1.0), np.float64(2.0))[1])
        deck.traction(mesh, "top", solution.mode, (0.0, 0.0, 0.0), (0.0, edge, 0.0))
        return deck

    return Case("pure_bending", [[solution]], build, contains=quadratic, reduced_exact=False,
                sizes=dict(SOLIDS))


def flexure():
    """Held below, loaded on top by the shear stresses of the exact solution; distorted cells"""
    solution = polynomials.flexure(STEEL)

    def build(kind, n):
        mesh = structured(kind, n//2, n, wavy(SHAFT))
        deck = start("Flexure of a cantilever", kind, STEEL, mesh, [solution])
        deck.move(mesh, mesh.nodes_of("bottom"), solution)
        deck.load_side(mesh, "top", solution)
        return deck

    return Case("flexure", [[solution]], build, sizes=dict(SOLIDS))


def self_weight():
    """Hung at its top, whose nodes follow the exact solution"""
    solution = polynomials.hanging_column(HEAVY)

    def build(kind, n):
        mesh = structured(kind, n//2, n, SHAFT)
        deck = start("Column under its weight", kind, HEAVY, mesh, [solution])
        deck.move(mesh, mesh.nodes_of("top"), solution)
        deck.add("GRAVITY", [(-10.0,)])
        return deck

    return Case("self_weight", [[solution]], build, contains=quadratic, sizes=dict(SOLIDS))


def lateral_gravity():
    """Gravity along theta = 30 degrees: both families; the mantle carries the shear of its solution"""
    angle = 30.0
    parts = {SYMMETRIC: math.cos(math.radians(angle)), ANTISYMMETRIC: math.sin(math.radians(angle))}
    solutions = [polynomials.shear_column(HEAVY, 10.0*part, family=family)
                 for family, part in parts.items()]

    def build(kind, n):
        mesh = structured(kind, n//2, n, SHAFT)
        deck = start("Lateral gravity", kind, HEAVY, mesh, solutions)
        deck.fix(mesh, mesh.nodes_of("top"), "111")
        for solution in solutions:
            end = solution.stress(np.float64(1.0), np.float64(2.0))[3]
            deck.traction(mesh, "outer", solution.mode, (0.0, 0.0, 0.0), (0.0, end, 0.0))
        deck.add("GRAVITY", [(None, 10.0, angle)])
        return deck

    return Case("lateral_gravity", [solutions], build, contains=quadratic, sizes=dict(SOLIDS))


def gradient(name, family):
    """Quadratic field of harmonic 2"""
    return held_all_round(name, [polynomials.harmonic_gradient(STEEL, 2, family)],
                          lambda kind, n: structured(kind, n//2, n, SHAFT), quadratic, STEEL)


def boussinesq(name, family):
    """Harmonic 3, all six stresses; held below, tractions elsewhere; distorted cells"""
    solution = polynomials.boussinesq_field(STEEL, 3, family)

    def build(kind, n):
        mesh = structured(kind, n//2, n, wavy(SHAFT))
        deck = start(solution.name, kind, STEEL, mesh, [solution])
        deck.move(mesh, mesh.nodes_of("bottom"), solution)
        deck.load_side(mesh, "outer", solution)
        deck.load_side(mesh, "top", solution)
        return deck

    return Case(name, [[solution]], build, sizes=dict(SOLIDS))


def shaft():
    """Round shaft: held below, a torque on top; exact but for the 3-node element"""
    torque, twist = math.pi/2*STEEL.shear*1.0e-3, 1.0e-3
    solution = torsion.shaft(STEEL, twist)

    def build(kind, n):
        mesh = structured(kind, n//2, n, SHAFT)
        deck = start("Torsion of a shaft", kind, STEEL, mesh, [solution])
        deck.fix(mesh, mesh.nodes_of("bottom"), "111")
        deck.add("RESULTANTS", [(deck.face(mesh, mesh.sides["top"]), "TORQUE", torque)])
        return deck

    return Case("shaft", [[solution]], build, contains=lambda kind: kind.nodes != 3,
                reduced_exact=False, sizes=dict(SOLIDS))


def turned_shaft():
    """Round shaft: its top turned by MOVEDFACES, linear along the face"""
    twist, length = 1.0e-3, 2.0
    solution = torsion.shaft(STEEL, twist)

    def build(kind, n):
        mesh = structured(kind, n//2, n, SHAFT)
        deck = start("Shaft turned at its top", kind, STEEL, mesh, [solution])
        deck.fix(mesh, mesh.nodes_of("bottom"), "111")
        top = deck.face(mesh, mesh.sides["top"])
        deck.add("MOVEDFACES", [(top, 0, None, None, 0.0, None, None, -twist*length, "A")])
        return deck

    return Case("turned_shaft", [[solution]], build, contains=lambda kind: kind.nodes != 3,
                sizes=dict(SOLIDS))


def cone():
    """Truncated cone, its mantle free"""
    solution = torsion.cone(STEEL)

    def build(kind, n):
        mesh = structured(kind, n//2, n, conical(0.5, 1.0, 2.0))
        deck = start("Torsion of a cone", kind, STEEL, mesh, [solution])
        deck.move(mesh, mesh.nodes_of("bottom"), solution)
        deck.load_side(mesh, "top", solution)
        return deck

    return Case("cone", [[solution]], build, sizes=dict(SOLIDS))


def sphere():
    """Pressure by cards on the curved inner surface"""
    solution = spheres.hollow_sphere(STEEL, 1.0, 2.0, 1.0)

    def build(kind, n):
        mesh = structured(kind, n, n, polar(1.0, 2.0))
        deck = start("Hollow sphere", kind, STEEL, mesh, [solution])
        deck.fix(mesh, mesh.nodes_of("bottom"), "010")
        deck.add("PRESSURES", [(deck.face(mesh, mesh.sides["inner"]), 0, 1.0)])
        return deck

    return Case("hollow_sphere", [[solution]], build, sizes=dict(SOLIDS))


def cavity():
    """Spherical cavity, the surface at radius 3 under the tractions of the infinite body"""
    solution = spheres.spherical_cavity(STEEL, 1.0, 1.0)

    def build(kind, n):
        mesh = structured(kind, n, n, graded(polar(1.0, 3.0), 3.0))
        deck = start("Spherical cavity", kind, STEEL, mesh, [solution])
        deck.fix(mesh, mesh.nodes_of("bottom"), "010")
        deck.move(mesh, mesh.nodes_of("outer"), solution)
        return deck

    return Case("cavity", [[solution]], build, sizes=dict(SOLIDS))


CASES = [rigid("rigid_symmetric", SYMMETRIC), rigid("rigid_antisymmetric", ANTISYMMETRIC),
         patch("patch_symmetric", SYMMETRIC), patch("patch_antisymmetric", ANTISYMMETRIC),
         patch_under_tractions(), turned_patch(), pure_bending(), flexure(), self_weight(),
         lateral_gravity(), gradient("gradient_symmetric", SYMMETRIC),
         gradient("gradient_antisymmetric", ANTISYMMETRIC),
         boussinesq("field_3_symmetric", SYMMETRIC), boussinesq("field_3_antisymmetric", ANTISYMMETRIC),
         shaft(), turned_shaft(), cone(), sphere(), cavity()]
