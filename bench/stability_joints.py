"""Hard cases of joints: soft and rigid, open all round, in a T"""
import h5py
import hard_scenes as scenes
import numpy as np
from cases.rings import STEEL, ring_mesh, two_rings
from deck import Deck
from mesh import ELEMENT_TYPES
from solution import SYMMETRIC
from solutions.plane_strain import ring_solution
from stability_case import EPSILON, FAILED, LIMITED, OK, Case, Finding, judged, worst
from stability_solids import CEA, ENERGY, against_interpolant

# k h / E of joints
PROPORTIONS = [10.0**k for k in range(-6, 7)]
RIGID = 1e5  # what joints that can yield count with at most
TOLERANCE = 1e-6


def elastic_joints(name):
    """Two rings with an elastic joint of any stiffness between them"""
    kind, cells = ELEMENT_TYPES[name], 16

    def one(runs, proportion, m):
        stiffness = proportion*STEEL.young/(0.5/cells)
        case = two_rings(m, stiffness, stiffness/2)
        deck = case.build(kind, cells)
        results = runs.run(f"elastic_{name}_{proportion:g}_{m}", deck.text())
        solutions = [solution for body in case.bodies for solution in body]
        found = [results.nodal((m, SYMMETRIC), len(mesh.coordinates), deck.offsets[id(mesh)])
                 for mesh in deck.meshes]
        return against_interpolant(deck.meshes, solutions, found)

    def check(runs):
        return worst([(*one(runs, proportion, m), f"k h/E = {proportion:g}, m = {m}")
                      for proportion in PROPORTIONS for m in (0, 2, 5)])

    return Case(f"elastic joints, {name}", "k h/E = 1e-6 … 1e6; m = 0, 2, 5", ENERGY, CEA, check)


def difference(one, other):
    """Largest difference of displacements and joint stresses, over the largest of the other"""
    modes = one.displacement.keys() | other.displacement.keys()
    if one.displacement.keys() != other.displacement.keys():
        return float("nan") if modes else 0.0
    size = max(np.abs(values).max() for values in other.displacement.values())
    moved = max(np.abs(one.displacement[mode] - other.displacement[mode]).max() for mode in modes)
    stress = np.abs(one.joints["stress"] - other.joints["stress"]).max()
    return max(moved/size, stress/np.abs(other.joints["stress"]).max())


def stiff_and_soft(runs):
    """The paper's case 3 to 1E-6, against the same to 1E-8: rounding leaves 1E-9 where joints are soft by 1E-6"""
    found = []
    for proportion in PROPORTIONS[:-2]:
        one, other = (runs.run(f"case_3_{proportion:g}_{tolerance:g}",
                               scenes.example(3, factor=proportion/0.125, tolerance=tolerance))
                      for tolerance in (TOLERANCE, 1e-8))
        found.append((difference(one, other), 100*TOLERANCE, f"k h/E = {proportion:g}"))
    return worst(found)


def rigid(runs):
    """Case 3 with joints as good as rigid: displacements as with k h/E = 1E3"""
    wanted = runs.run("case_3_rigid", scenes.example(3, factor=1e3/0.125, tolerance=TOLERANCE)).displacement
    size = max(np.abs(values).max() for values in wanted.values())
    found, ends = [], []
    for proportion in PROPORTIONS[-3:]:
        ran = runs.attempt("rigid", scenes.example(3, factor=proportion/0.125, tolerance=TOLERANCE))
        if ran.code == 3 and "stiff out of proportion" in ran.messages:
            ends.append(f"k h/E = {proportion:g}: no equilibrium found, exit code 3; the program says that "
                        "such joints are stiff out of proportion and that 10 E/h is as good as rigid")
        elif ran.code:
            return Finding(FAILED, words=f"k h/E = {proportion:g}: exit code {ran.code}: {ran.messages[:200]}")
        else:
            moved = runs.results("rigid").displacement
            found.append((max(np.abs(moved[mode] - wanted[mode]).max() for mode in wanted)/size, 0.01,
                          f"k h/E = {proportion:g}"))
    finding = worst(found)
    if ends and finding.verdict == OK:
        return Finding(LIMITED, finding.error, finding.bar, "; ".join(ends))
    return finding


def law_kept(runs):
    """The paper's case 3: joint stress against the law, worked out anew from the relative displacement"""
    found = []
    for proportion in PROPORTIONS[:-1]:
        factor = proportion/0.125
        runs.run("law", scenes.example(3, factor=factor, tolerance=TOLERANCE))
        with h5py.File(runs.directory/"law.h5") as file:
            yields = file["mesh/joint_material"][()][file["joints/joint"][()] - 1] == 1
            jump, stress = (file[f"joints/{name}"][()][:, yields] for name in ("jump", "stress"))
        wanted = np.zeros_like(stress)
        wanted[..., 1] = 2e4*factor*np.minimum(jump[..., 1], 0.0)
        found.append((np.abs(stress - wanted).max()/np.abs(stress).max(), TOLERANCE, f"k h/E = {proportion:g}"))
    return worst(found)


def jumps_of(results, nodes):
    """Relative displacements xi, eta, theta at the points of 4-node joints on all planes, summed from the
    amplitudes at the nodes: shape (planes, points, 3); nodes: (points, 4), counted from 0"""
    first, last = results.coordinates[nodes[:, 0]], results.coordinates[nodes[:, 1]]
    along = last - first
    length = np.linalg.norm(along, axis=1)
    t_r, t_z = (along/length[:, None]).T
    place = np.linalg.norm(results.joints["position"] - first, axis=1)/length
    weight = np.array([place - 1, -place, place, 1 - place]).T
    theta = results.joints["planes"][:, None, None]
    jump = 0.0
    for (m, _), values in results.displacement.items():
        factors = np.concatenate([np.cos(m*theta), np.cos(m*theta), np.sin(m*theta)], axis=2)
        jump = jump + factors*np.einsum("pn,pnc->pc", weight, values[nodes])
    u, v, w = np.moveaxis(jump, 2, 0)
    return np.stack([u*t_r + v*t_z, v*t_r - u*t_z, w], axis=2)


def jumps_agree(runs):
    """Case 3: what the bodies do at the joints is what the law was given, times k in terms of stress"""
    found = []
    for proportion in PROPORTIONS[:-1]:
        factor = proportion/0.125
        results = runs.run("jumps", scenes.example(3, factor=factor, tolerance=TOLERANCE))
        with h5py.File(runs.directory/"jumps.h5") as file:
            nodes = file["mesh/joint_nodes"][()][results.joints["joint"] - 1, :4] - 1
        apart = jumps_of(results, nodes) - results.joints["jump"]
        stress = np.abs(factor*np.array([1e4, 2e4, 1e4])*apart).max()/np.abs(results.joints["stress"]).max()
        found.append((stress, 100*TOLERANCE, f"k h/E = {proportion:g}"))
    return worst(found)


def rings_apart(name, proportions):
    """A ring drawn off another by sigma_r = 1 + 0.03 cos 2 theta: the joint is open all round"""
    kind, cells, radii = ELEMENT_TYPES[name], 16, (1.0, 1.5, 2.0)
    loads = {0: 1.0, 2: 0.03}

    def deck_of(stiffness):
        deck = Deck("A ring drawn off another", kind, 4)
        deck.material(STEEL)
        meshes = [ring_mesh(kind, cells, radii[:2], 1.0), ring_mesh(kind, cells, radii[1:], 1.0)]
        for mesh in meshes:
            deck.mesh(mesh)
            deck.fix(mesh, mesh.nodes_of("bottom", "top"), "010")
        deck.fix(meshes[0], meshes[0].nodes_of("inner"), "101")
        for m, load in loads.items():
            deck.traction(meshes[1], "outer", (m, SYMMETRIC), (load, 0.0, 0.0))
        deck.add("LAWS", [(1, stiffness, stiffness, stiffness, 0.0, 0.0)])
        deck.add("INTERFACES", [(1, deck.face(meshes[0], meshes[0].sides["outer"]),
                                 deck.face(meshes[1], meshes[1].sides["inner"]))])
        return deck, meshes[1]

    def check(runs):
        found, ends = [], []
        for proportion in proportions:
            deck, outer = deck_of(proportion*STEEL.young/(0.5/cells))
            ran = runs.attempt(f"apart_{name}_{round(np.log10(proportion)) + 6}", deck.text())
            if ran.code == 3 and "stiff out of proportion" in ran.messages:
                ends.append(f"k h/E = {proportion:g}: exit code 3, stiff out of proportion")
                continue
            results = runs.results(f"apart_{name}_{round(np.log10(proportion)) + 6}")
            sign = "" if "stiff out of proportion" in ran.messages else " (no remark)"
            for m, load in loads.items():
                exact = ring_solution("", STEEL, m, radii[1:], [
                    ("sigma_r", 2.0, load), ("tau", 2.0, 0.0), ("sigma_r", 1.5, 0.0), ("tau", 1.5, 0.0)])
                nodal = results.nodal((m, SYMMETRIC), len(outer.coordinates), deck.offsets[id(outer)])
                error, bar = against_interpolant([outer], [exact], [nodal])
                found.append((error, bar + TOLERANCE, f"k h/E = {proportion:g}{sign}, m = {m}"))
        finding = worst(found)
        if ends and finding.verdict == OK:
            return Finding(LIMITED, finding.error, finding.bar, "; ".join(ends))
        return finding

    return Case(f"open all round, {name}", f"k h/E = {proportions[0]:.0e} … {proportions[-1]:.0e}; m = 0 and 2",
                ENERGY, CEA + " + tolerance 1e-6", check)


def pile_without_joint(runs):
    """A pile shaft whose gap never closes, against the same deck without that interface"""
    steps = [(1, 1), (1, 2)]
    text = scenes.soil_pile("Open", steps, friction=0.0, details={"slip": "COMPONENTS", "gap": 5.0})
    one = runs.run("open", text)
    two = runs.run("none", scenes.soil_pile("None", steps, friction=0.0).replace("INTERFACES\n1, 2, 3\n",
                                                                               "INTERFACES\n"))
    size = max(np.abs(values).max() for values in two.displacement.values())
    error = max(np.abs(one.displacement[mode] - two.displacement[mode]).max() for mode in two.displacement)
    return judged(error/size, TOLERANCE)


PRESSURE, TILT, YOUNG = 1.0, 0.3, 1e4


def tee_deck(nodes, stiffness):
    """A pile and a ring round it on a slab, joints between all three: they meet at r = 0.5, z = 0. Pressure
    and bending on top; without Poisson's effect the shaft carries nothing beyond its initial stress"""
    deck = scenes.Deck("Joints in a T", 2, 9).material(1, YOUNG, 0.0)
    deck.law(1, (stiffness,)*3, 0.0, 30.0).law(2, (stiffness,)*3, 0.0, 30.0).details(2, initial=-0.2)
    for body, *corners in ((1, 0, 0, 0.5, 1), (2, 0.5, 0, 1, 1), (3, 0, -0.5, 0.5, 0), (3, 0.5, -0.5, 1, 0)):
        deck.block(body, 1, nodes, 2, 2, *corners)
    deck.faces((1, 1, 0.5, 0, 0.5, 1), (2, 2, 0.5, 0, 0.5, 1), (3, 1, 0, 0, 0.5, 0), (4, 3, 0, 0, 0.5, 0),
               (5, 2, 0.5, 0, 1, 0), (6, 3, 0.5, 0, 1, 0), (7, 1, 0, 1, 0.5, 1), (8, 2, 0.5, 1, 1, 1),
               (9, 3, 0, -0.5, 1, -0.5))
    deck.add("INTERFACES", (2, 1, 2), (1, 3, 4), (1, 5, 6)).add("FIXEDFACES", (9, "111"))
    deck.add("TRACTIONS", *((face, 0, None, -PRESSURE) for face in (7, 8)),
             (7, 1, None, 0.0, None, None, 0.5*TILT), (8, 1, None, 0.5*TILT, None, None, TILT))
    return deck.text()


def tee_exact(r, z, above, stiffness):
    """u, v, w of harmonics 0 and 1: sigma_z = -p + c x in all bodies, and its jump over k"""
    s, none = z + 0.5, 0*r
    rotation = TILT/stiffness*above
    bend = TILT*s**2/(2*YOUNG) + rotation*z
    return {0: np.array([none, -PRESSURE*s/YOUNG - PRESSURE/stiffness*above, none]).T,
            1: np.array([-bend, TILT*r*s/YOUNG + rotation*r, bend]).T}


def tee_error(runs, proportion):
    """Largest error of the displacements, over the largest"""
    stiffness = proportion*YOUNG/0.25
    results = runs.run("tee", tee_deck(8, float(f"{stiffness:.12G}")))
    above = np.ones(len(results.coordinates))
    for body, nodes in zip(results.element_body, results.element_nodes):
        if body == 3:
            above[nodes[nodes > 0] - 1] = 0.0
    exact = tee_exact(*results.coordinates.T, above, stiffness)
    size = max(np.abs(values).max() for values in exact.values())
    error = max(np.abs(values - (exact.get(m, 0.0) if family == SYMMETRIC else 0.0)).max()
                for (m, family), values in results.displacement.items())
    return error/size


def tee(runs):
    """8-node elements hold the exact field: what is left is rounding"""
    return worst([(tee_error(runs, proportion), 100*EPSILON*runs.condition("tee"), f"k h/E = {proportion:g}")
                  for proportion in PROPORTIONS if proportion <= RIGID])


def rigid_tee(runs):
    """Joints that count as rigid, against the exact field of their whole stiffness"""
    return worst([(tee_error(runs, proportion), 10/RIGID, f"k h/E = {proportion:g}") for proportion in (1e6, 1e9)])


CASES = [*[elastic_joints(name) for name in ("4-node", "8-node")],
         Case("case 3, tolerance 1e-6", "k h/E = 1e-6 … 1e4", "self-consistent: tolerance 1e-8",
              "100 × tolerance", stiff_and_soft),
         Case("case 3, rigid joints", "k h/E = 1e4, 1e5, 1e6", "self-consistent: displacements at k h/E = 1e3",
              "1 %: ten times E/(k h) of the reference", rigid),
         Case("case 3, law of the joints", "k h/E = 1e-6 … 1e5", "σ = k min(d, 0), τ = 0 from the relative "
              "displacement", "tolerance 1e-6", law_kept),
         Case("case 3, bodies and joints", "k h/E = 1e-6 … 1e5",
              "self-consistent: relative displacement of the bodies × k", "100 × tolerance", jumps_agree),
         Case("joints in a T", "k h/E = 1e-6 … 1e5", "exact, displacements", "100 ε × condition", tee),
         Case("rigid joints in a T", "k h/E = 1e6, 1e9", "exact, displacements", "1e-4: ten times E/(k h) of what counts",
              rigid_tee),
         *[rings_apart(name, proportions) for name in ("4-node", "8-node")
           for proportions in (PROPORTIONS[:9], PROPORTIONS[9:])],
         Case("open shaft of a pile", "gap never closes", "self-consistent: no interface", "tolerance 1e-6",
              pile_without_joint)]
