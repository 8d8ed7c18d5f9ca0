"""Hard cases of solids: incompressible, next to the axis, high harmonics, contrast, slender cells"""
import dataclasses

import numpy as np

from cases.hard import TINY, Incompressible, disc_place
from cases.rings import INNER, OUTER, STEEL, free_surfaces, plane_strain_deck
from cases.solids import start
from deck import Deck
from material import Isotropic
from mesh import ELEMENT_TYPES, points_of, rectangle, shape_functions, structured
from norms import displacement_error
from solution import ANTISYMMETRIC, SYMMETRIC
from solutions import polynomials
from solutions.plane_strain import joined_rings, ring_solution
from stability_case import EPSILON, FAILED, LIMITED, Case, Finding, judged, worst

ROUNDING = 1e-9  # what rounding may leave of a field that the elements hold, as in scripts/verify
CEA = "2 × energy error of the interpolant (Céa: 1 × for exact integrals) + 1e-9"
ENERGY = "exact, energy norm"


def strains(m, r, u, by_r, by_z):
    """Amplitudes of the six strains from displacements (3, points) and their slopes"""
    return np.array([by_r[0], by_z[1], (u[0] + m*u[2])/r, by_z[0] + by_r[1],
                     by_r[2] - (u[2] + m*u[0])/r, by_z[2] - m*u[1]/r])


def energies(mesh, solution, amplitudes):
    """Energy of the error of a field, and of the exact solution, by 4 x 4 points an element"""
    xi, eta, weight = points_of(mesh.kind)
    value, slope = shape_functions(mesh.kind.nodes, xi, eta)
    corners, nodal = mesh.coordinates[mesh.elements], amplitudes[mesh.elements]
    jacobian = np.einsum("pnd,enc->epdc", slope, corners)
    slopes = np.linalg.solve(jacobian, np.einsum("pnd,enc->epdc", slope, nodal))
    r, z = np.einsum("pn,enc->cep", value, corners).reshape(2, -1)
    u = np.einsum("pn,enc->cep", value, nodal).reshape(3, -1)
    by_r, by_z = (slopes[:, :, k].reshape(-1, 3).T for k in (0, 1))
    volume = (weight*np.linalg.det(jacobian)).ravel()*r
    d = solution.material.elasticity()
    exact = np.linalg.solve(d, solution.stress(r, z))
    error = strains(solution.harmonic, r, u, by_r, by_z) - exact
    return [np.sum(volume*np.einsum("ip,ij,jp->p", e, d, e)) for e in (error, exact)]


def energy_error(parts):
    """Relative energy error of parts (mesh, solution, amplitudes) of one body"""
    error, size = np.sum([energies(*part) for part in parts], axis=0)
    return np.sqrt(error/size)


def against_interpolant(meshes, solutions, amplitudes, extra=0.0):
    """Energy error and its bar from the interpolant of the exact solution at the nodes"""
    exact = [solution.displacement(*mesh.coordinates.T).T for mesh, solution in zip(meshes, solutions)]
    interpolated = energy_error(list(zip(meshes, solutions, exact)))
    return energy_error(list(zip(meshes, solutions, amplitudes))), 2*interpolated + ROUNDING + extra


def incompressible(name, bar, limit=None):
    """Ring under cos 2 theta with nu up to 0.499999"""
    def check(runs):
        errors = Incompressible().errors(runs, ELEMENT_TYPES[name])
        found = judged(max(errors), bar, limit)
        warned = "nearly incompressible" in " ".join(
            runs.summary(f"incompressible_{name.replace(' ', '_')}_0.499999")["messages"])
        if found.verdict == LIMITED and name == "4-node" and not warned:
            return Finding(FAILED, found.error, bar, "locks without a warning")
        return found

    return Case(f"nearly incompressible, {name}", "ν = 0.3 … 0.499999", "exact (ring, m = 2)",
                "twice the 1 % that the mesh keeps at ν = 0.3", check)


def incompressible_patch(name):
    """Constant strain with nu up to 0.499999: rounding alone"""
    def check(runs):
        found = []
        for ratio in (0.3, 0.4999, 0.499999):
            found.append((*patch(runs, f"patch_{name}_{ratio}", ELEMENT_TYPES[name], Isotropic(2.1e5, ratio),
                                 rectangle(0.0, 1.0, 0.0, 2.0)), f"ν = {ratio}"))
        return worst(found)

    return Case(f"constant strain, {name}", "ν = 0.3 … 0.499999; m = 0, 1, 2", "exact, displacements",
                "100 ε × condition", check)


def patch(runs, name, kind, material, place, make=polynomials.constant_strain):
    """Exact displacements on the surface of a body: error of displacements, 100 eps cond"""
    made = make(material)
    solutions = made if isinstance(made, list) else [made]
    mesh = structured(kind, 4, 4, place)
    deck = start(name, kind, material, mesh, solutions)
    for solution in solutions:
        deck.move(mesh, mesh.boundary, solution)
    name = name.replace(" ", "_")
    results = runs.run(name, deck.text())
    errors = [displacement_error(mesh, [s], {s.mode: results.nodal(s.mode, len(mesh.coordinates))})
              for s in solutions]
    return max(errors), 100*EPSILON*runs.condition(name)


def outwards(cells):
    """Radii from 0 to 1 that crowd at the outside, where high harmonics live"""
    return 1.0 - (1.0 - np.linspace(0.0, 1.0, cells + 1))**2


AXIS = {"nodes at r = 0": (outwards(48), 0.0),
        # The hole of the mesh takes (r / R)^2 of the energy or less: 1e-6 in the norm, times 10 for its
        # stresses
        "first nodes at r = 1e-6": (np.maximum(outwards(48), TINY), 1e-5),
        "nodes at 0 and 1e-6, graded": (np.concatenate([[0.0], np.geomspace(TINY, 0.1, 24),
                                                        0.1 + 0.9*outwards(40)[1:]]), 0.0)}


def disc_solution(m, family=SYMMETRIC):
    """Disc under sigma_r = cos m theta outside; m = 1 with the shear that balances it"""
    conditions = [("sigma_r", 1.0, 1.0), ("tau", 1.0, 1.0 if m == 1 else 0.0)]
    if m == 1:
        conditions.append(("u", 1.0, 0.0))
    return ring_solution(f"disc, m = {m}", STEEL, m, (0.0, 1.0), conditions, family)


def on_axis(words, name):
    """Discs with nodes on and next to the axis, every harmonic from 0 to 128 in one run"""
    kind, (radii, extra) = ELEMENT_TYPES[name], AXIS[words]

    def errors(runs, harmonics):
        deck = Deck(f"Discs, {words}", kind, harmonics[-1], harmonics)
        deck.material(STEEL)
        mesh = structured(kind, len(radii) - 1, 1, disc_place(radii))
        deck.mesh(mesh)
        deck.fix(mesh, mesh.nodes_of("bottom", "top"), "010")
        if harmonics == [1]:
            deck.fix(mesh, mesh.sides["outer"][0][:1], "100")
        solutions = [disc_solution(m) for m in harmonics]
        for solution in solutions:
            deck.traction(mesh, "outer", solution.mode, (1.0, 0.0, 1.0 if solution.harmonic == 1 else 0.0))
        results = runs.run(f"axis_{words}_{name}_{harmonics[0]}", deck.text())
        return [(*against_interpolant([mesh], [s], [results.nodal(s.mode, len(mesh.coordinates))], extra),
                 f"m = {s.harmonic}") for s in solutions]

    def check(runs):
        # A support holds in every harmonic; only 1 needs one
        return worst(errors(runs, [0, *range(2, 129)]) + errors(runs, [1]))

    return Case(f"{words}, {name}", "every m = 0 … 128", ENERGY,
                CEA + (" + 1e-5 for the hole in the mesh" if extra else ""), check)


def high_harmonics(name):
    """Rings under cos m theta to m = 128, both families"""
    kind = ELEMENT_TYPES[name]

    def check(runs):
        solutions = [ring_solution("ring", STEEL, m, (INNER, OUTER), free_surfaces(-1.0), family)
                     for m in (0, 2, 3, 5, 8, 16, 32, 64, 128) for family in (SYMMETRIC, ANTISYMMETRIC)
                     if m or family == SYMMETRIC]
        deck, mesh = plane_strain_deck(kind, 48, solutions, "Rings to m = 128", (INNER, OUTER), 1/16)
        for solution in solutions:
            deck.traction(mesh, "outer", solution.mode, (-1.0, 0.0, 0.0))
        results = runs.run(f"high_{name}", deck.text())
        return worst([(*against_interpolant([mesh], [s], [results.nodal(s.mode, len(mesh.coordinates))]),
                       f"m = {s.harmonic}") for s in solutions])

    return Case(f"high harmonics, {name}", "m = 0, 2, 3, 5, 8, 16, 32, 64, 128; both families", ENERGY, CEA,
                check)


def contrast(name):
    """Two rings grown together, one 1e-6 to 1e6 times as stiff as the other"""
    kind, radii, cells = ELEMENT_TYPES[name], (1.0, 1.5, 2.0), 16

    def one(runs, factor, m):
        materials = (STEEL, Isotropic(STEEL.young*factor, 0.2))
        conditions = free_surfaces(-1.0, radii=(1.0, 2.0))
        solutions = joined_rings("", materials, m, radii, (np.inf, np.inf), conditions)
        deck, mesh = plane_strain_deck(kind, cells, solutions, f"Contrast {factor:g}", (1.0, 2.0))
        inside = mesh.coordinates[mesh.elements, 0].mean(axis=1) < radii[1]
        text = second_material(deck, materials[1], ~inside)
        deck.traction(mesh, "outer", (m, SYMMETRIC), (-1.0, 0.0, 0.0))
        results = runs.run(f"contrast_{name}_{factor:g}_{m}", text())
        meshes = [dataclasses.replace(mesh, elements=mesh.elements[part]) for part in (inside, ~inside)]
        return against_interpolant(meshes, solutions, [results.nodal((m, SYMMETRIC), len(mesh.coordinates))]*2)

    def check(runs):
        return worst([(*one(runs, factor, m), f"E₂/E₁ = {factor:g}, m = {m}")
                      for factor in (1e-6, 1e-3, 1e3, 1e6) for m in (0, 2, 5)])

    return Case(f"modulus contrast, {name}", "E₂/E₁ = 1e-6 … 1e6; m = 0, 2, 5", ENERGY, CEA, check)


def second_material(deck, material, used):
    """Gives the elements marked in `used` a second material; a function that returns the deck's text"""
    deck.material(material, 2)
    for keyword, cards in deck.sections:
        if keyword == "ELEMENTS":
            for i in np.flatnonzero(used):
                number, _, rest = cards[i].split(",", 2)
                cards[i] = f"{number},2,{rest}"
    return deck.text


SHAPES = {"flat": rectangle(0.0, 1.0, 0.0, 1e-4), "tall": rectangle(0.0, 1.0, 0.0, 1e4)}


def slender(name, words, make=polynomials.constant_strain):
    """Cells 1e4 times as long as wide under constant strain, or pure bending"""
    def check(runs):
        return worst([(*patch(runs, f"slender_{shape}_{name}_{words}", ELEMENT_TYPES[name], STEEL, place, make),
                       shape) for shape, place in SHAPES.items()])

    return Case(f"aspect ratio, {words}, {name}", "1e4, flat and tall", "exact, displacements",
                "100 ε × condition", check)


CASES = [incompressible("4-node", 0.02, "locks, as the manual says; the program warns and names BBAR"),
         incompressible("4-node B-bar", 0.02), incompressible("8-node reduced", 0.02),
         incompressible("8-node", 0.02, "locks a little on this coarse mesh; the reduced rule does not"),
         *[incompressible_patch(name) for name in ("4-node", "4-node B-bar", "8-node reduced")],
         *[on_axis(words, name) for words in AXIS for name in ("4-node", "8-node")],
         *[high_harmonics(name) for name in ("4-node", "8-node")],
         *[contrast(name) for name in ("4-node", "8-node")],
         *[slender(name, "constant strain") for name in ("4-node", "4-node B-bar", "8-node", "6-node")],
         *[slender(name, "pure bending", polynomials.pure_bending) for name in ("8-node", "9-node")]]
