"""Tables of a job: what it is made of, what acts on it, what came out."""
import numpy as np

from ..circle import ANTISYMMETRIC, SYMMETRIC
from ..components import DISPLACEMENTS, STRESSES
from ..history import joint_sums
from ..joint_points import JointPoints
from ..result import STATES
from ..resultants import direction
from .extremes import extremes, joint_peaks
from .markup import Markup, number, table, with_unit

SYMBOLS = {name: Markup(text) for name, text in {
    "sigma_r": "σ<sub>r</sub>", "sigma_z": "σ<sub>z</sub>", "sigma_theta": "σ<sub>θ</sub>",
    "tau_rz": "τ<sub>rz</sub>", "tau_rtheta": "τ<sub>rθ</sub>", "tau_ztheta": "τ<sub>zθ</sub>", "u": "u", "v": "v",
    "w": "w", "length": "length of the displacement"}.items()}
RULES = {1: "centroid", 2: "Gauss", 3: "Lobatto"}
RESULTANTS = ("axial force", "lateral force", "moment", "torque", "lateral force at 90°", "moment at 90°")
# Sign of moments: the opposite of where a pile leans, as figures of piles have them
LIFTS = "Moments are positive where they lift the side θ = 0, or 90°,"
CRITERIA = ("ELASTIC", "TRESCA", "MISES", "MOHR", "DRUCKER")
FAMILIES = {SYMMETRIC: "symmetric", ANTISYMMETRIC: "antisymmetric"}


def per(unit, length):
    """One unit over another; empty if one is not known."""
    return f"{unit}/{length}" if unit and length else ""


def materials(job):
    """Isotropic and orthotropic materials."""
    read, units = job.result.read, job.units
    labels, turned = read("materials/label"), read("materials/orthotropic") != 0
    expansion = read("materials/expansion").reshape(-1, 3)
    elements = [int((job.result.mesh.element_material == k).sum()) for k in range(len(labels))]
    columns = {"number": labels, "elements": elements, with_unit("E", units.stress): read("materials/young"),
               "ν": read("materials/poisson"), "density": read("materials/density"),
               "expansion": expansion[:, 0]}
    plain = [row for row, skip in zip(zip(*columns.values()), turned) if not skip]
    if plain:
        yield table("Isotropic materials", columns, plain)
    if turned.any():
        yield table("Orthotropic materials", *_orthotropic(job, turned, expansion))
    if job.result.has("yield/criterion"):
        yield from _yielding_materials(job, labels)


def _yielding_materials(job, labels):
    """Criteria and strengths of the materials that yield."""
    read, units = job.result.read, job.units
    names = ("strength", "friction", "dilation", "hardening", "tension", "gradient", "level")
    values = {name: read(f"yield/{name}") for name in names}
    rows = []
    for k in np.flatnonzero(read("yield/criterion") > 0):
        strength, friction, dilation, hardening, tension, gradient, level = (float(values[name][k]) for name in names)
        rows.append([labels[k], CRITERIA[int(read("yield/criterion")[k])], strength, *np.degrees([friction, dilation]), hardening,
                     tension if tension >= 0 else None, gradient or None, level if gradient else None])
    head = ["number", "criterion", with_unit("strength", units.stress), "φ [°]", "ψ [°]", with_unit("H'", units.stress),
            with_unit("tension", units.stress), with_unit("gradient", per(units.stress, units.length)),
            with_unit(Markup("z<sub>s</sub>"), units.length)]
    yield table("Materials that yield", head, rows, "Strength: the uniaxial yield stress of TRESCA and MISES, the cohesion of MOHR and "
                "DRUCKER; below z_s it grows by the gradient times the depth. Tension – is what the criterion allows.")


def _orthotropic(job, chosen, expansion):
    read, units = job.result.read, job.units
    head = ["number", "angle [°]", *(Markup(f"E<sub>{k}</sub>") for k in (1, 2, 3)),
            *(Markup(f"ν<sub>{k}</sub>") for k in (12, 23, 13)),
            *(Markup(f"G<sub>{k}</sub>") for k in (12, 23, 13)), "density",
            *(Markup(f"α<sub>{k}</sub>") for k in (1, 2, 3))]
    rows = [[label, np.degrees(angle), *moduli, *ratios, *shears, density, *alpha]
            for label, angle, moduli, ratios, shears, density, alpha, keep in
            zip(read("materials/label"), read("materials/angle"), read("materials/moduli"), read("materials/ratios"),
                read("materials/shears"), read("materials/density"), expansion, chosen) if keep]
    note = f"Moduli in {units.stress}." if units.stress else None
    return head, rows, note


def laws(job):
    """Laws of the joints."""
    read, units, mesh = job.result.read, job.units, job.result.mesh
    labels = read("joint_materials/label")
    if not len(labels):
        return
    stiffness = read("joint_materials/stiffness").reshape(-1, 3)
    unit = per(units.stress, units.length)
    head = ["number", "joints", "rule", "law", *(with_unit(Markup(f"k<sub>{k}</sub>"), unit) for k in "ξηθ"),
            with_unit("C", units.stress), "φ [°]"]
    elastic = read("joint_materials/kind") == 0
    cohesion, friction = read("joint_materials/cohesion"), read("joint_materials/friction")
    rule = read("joint_materials/rule")
    rows = [[labels[k], int((mesh.joint_material == k).sum()), RULES.get(int(rule[k]), str(rule[k])),
             "elastic" if elastic[k] else "opens and slips", *stiffness[k],
             None if elastic[k] else cohesion[k], None if elastic[k] else np.degrees(np.arctan(friction[k]))]
            for k in range(len(labels))]
    yield table("Laws of the joints", head, rows)
    details = [k for k in range(len(labels)) if not elastic[k]]
    if details:
        yield table("Laws that yield, in detail", *_law_details(job, details))


def _law_details(job, chosen):
    read, units = job.result.read, job.units
    head = ["number", "slip by", "opening", with_unit("residual C", units.stress), "residual φ [°]", "dilation [°]",
            with_unit("gap", units.length), with_unit("initial stress", units.stress)]
    columns = {name: read(f"joint_materials/{name}") for name in
               ("label", "slip", "opening", "residual_cohesion", "residual_friction", "dilation", "gap",
                "initial_stress")}
    rows = []
    for k in chosen:
        one = {name: values[k] for name, values in columns.items()}
        rows.append([one["label"], {1: "components", 2: "resultant"}.get(int(one["slip"]), "–"),
                     {1: "reversible", 2: "bond"}.get(int(one["opening"]), "–"), one["residual_cohesion"],
                     *(np.degrees(np.arctan(one[name])) for name in ("residual_friction", "dilation")),
                     one["gap"], one["initial_stress"]])
    return head, rows


def loads(job):
    """Load cases with their factors, loads of each kind, springs."""
    read = job.result.read
    labels, factors = read("loads/case_label"), read("loads/case_factor")
    yield table("Load cases of this combination", ["load case", "name", "factor", "acts with"],
                zip(labels, job.case_names, factors, job.case_factors()),
                "Acts with: the factor times what the increments of the case add up to, in the state shown.")
    rows = [row for kind in ("edge", "ring", "body", "prescribed") for row in _loads_of(read, kind, labels)]
    if rows:
        yield table("Loads, without the factors of their cases",
                    ["kind", "load case", "m", "family", "number", "largest along r", "along z", "along θ"], rows,
                    "Amplitudes of each harmonic: tractions of edges, generalized forces of rings, accelerations of "
                    "bodies, given displacements. Temperature and stress of the ground are in the deck.")
    stiffness = read("springs/stiffness").reshape(-1, 3)
    if len(stiffness):
        distinct, count = np.unique(stiffness, axis=0, return_counts=True)
        yield table("Springs to the ground", ["edges", "normal", "along the edge", "along θ"],
                    [[int(n), *values] for n, values in zip(count, distinct)])


def _loads_of(read, kind, labels):
    """Rows for the loads of a kind that have case, harmonic and family in common."""
    case, harmonic, family = (read(f"loads/{kind}/{name}") for name in ("case", "harmonic", "family"))
    if not len(case):
        return
    name = {"edge": "tractions", "ring": "rings", "body": "accelerations", "prescribed": "displacements"}[kind]
    values = _load_values(read, kind, len(case))
    spin = np.sqrt(read("loads/body/spin_squared")) if kind == "body" else np.zeros(len(case))
    for key in sorted(set(zip(case.tolist(), harmonic.tolist(), family.tolist()))):
        rows = (case == key[0]) & (harmonic == key[1]) & (family == key[2])
        here = values[rows]
        largest = [here[abs(here[:, k]).argmax(), k] for k in range(3)]
        words = f"{name}, {number(spin[rows].max())} rad per time" if spin[rows].any() else name
        yield [words, labels[key[0] - 1], key[1], FAMILIES.get(key[2], "–"), int(rows.sum()), *largest]


def _load_values(read, kind, count):
    """Values along r, z, theta, (rows, 3); of edges, the largest of their three nodes."""
    if kind == "edge":
        traction = read("loads/edge/traction").reshape(count, 3, 3)
        largest = abs(traction).argmax(axis=1)
        return np.take_along_axis(traction, largest[:, None], 1)[:, 0]
    if kind == "prescribed":
        values = np.zeros((count, 3))
        values[np.arange(count), read("loads/prescribed/component") - 1] = read("loads/prescribed/value")
        return values
    return read({"ring": "loads/ring/force", "body": "loads/body/acceleration"}[kind]).reshape(count, 3)


def yielding(job):
    """Bodies that yield: what the increments took, how much has yielded, what was dissipated."""
    bodies = job.summary["yielding"]
    keys = ("increment", "load_factor", "iterations", "solutions", "yielded", "dissipated")
    said = [f"Least yield margin {number(bodies['least_margin'])} (1 without shear, 0 at yield); largest equivalent plastic "
            f"strain {number(bodies['largest_plastic_strain'])}."]
    if bodies["no_equilibrium_at"] is not None:
        said.append(f"No equilibrium was found at the load factor {number(bodies['no_equilibrium_at'])}.")
    yield table("Bodies that yield", ["increment", "load factor", "iterations", "elastic solutions", "points yielded",
                                      "dissipated"], [[row[key] for key in keys] for row in bodies["increments"]],
                " ".join(said))


def increments(job):
    """Load increments, and the convergence path."""
    read = job.result.read
    factor = read("increments/factor")
    if len(factor):
        case = read("increments/case") if job.result.has("increments/case") else np.zeros(len(factor), int)
        labels = read("loads/case_label")
        given = read("increments/given") if job.result.has("increments/given") else np.zeros(len(factor), int)
        columns = {"increment": range(1, len(factor) + 1), "factor": factor,
                   "load case": [str(labels[k - 1]) if k else "all" for k in case],
                   "given": ["displacement" if k else "load" for k in given], "tolerance": read("increments/tolerance"),
                   "most iterations": read("increments/max_iterations")}
        if not given.any():
            del columns["given"]
        yield table("Load increments", columns, zip(*columns.values()))
    yield from _history(job)
    path = job.result.convergence()
    if path.rows:
        yield table("Convergence path", ["increment", "iteration", "load factor", "residual ratio", "slip", "open"],
                    zip(*path.values()), "slip, open: joint points times planes; ratio of the whole or of the worst part, whichever is larger.")


def _history(job):
    """What came out of each increment, where there are several."""
    found, units = job.result.increments, job.units
    if found.rows < 2:
        return
    columns = {"increment": found["increment"], "load factor": found["load_factor"], "iterations": found["iterations"],
               "slip": found["n_slip"], "open": found["n_open"],
               with_unit("largest displacement", units.length): found["largest_displacement"],
               with_unit("largest pressure", units.stress): found["largest_pressure"],
               with_unit("work", units.moment): found["work"], with_unit("elastic energy", units.moment): found["energy"],
               with_unit("dissipated", units.moment): found["dissipated"]}
    lost = [str(k) for k, balanced in zip(found["increment"], found["equilibrium"]) if not balanced]
    note = "At the end of each increment. Load factor: the sum over all load cases; slip, open: joint points times planes; dissipated: by " \
        "slip and plastic strain."
    yield table("Results by increment", columns, zip(*columns.values()),
                note + (f" Not reached in equilibrium: increment {', '.join(lost)}." if lost else ""))


def points(job):
    """Displacements of the named points at the end of each increment, along the lateral load."""
    history, units = job.result.history, job.units
    theta, rows = direction(history), []
    for name in history.point_names:
        r, z = history.point_position(name)
        for k, (increment, one, two) in enumerate(zip(history.increment, history.point(name, theta), history.point(name, theta + 180))):
            rows.append([name if k == 0 else "", r, z, increment, *one, *two[:2]])
    here, there = (f"{angle:g}°" for angle in (theta, (theta + 180) % 360))
    yield table("Displacements of points", ["point", "r", "z", "increment", *(with_unit(f"{name} at {here}", units.length) for name in "uvw"),
                                            *(with_unit(f"{name} at {there}", units.length) for name in "uv")], rows,
                "u along r (outwards), v along z (upwards), w along θ; in the direction of the largest lateral load of the increments, without any that of "
                "reactions, and opposite.")


def equilibrium(job):
    """Resultants of loads and reactions, their sum; cuts."""
    read, units = job.result.read, job.units
    kinds = (units.force, units.force, units.moment, units.moment, units.force, units.moment)
    head = [with_unit(name, unit) for name, unit in zip(RESULTANTS, kinds)]
    applied, reacted = read("resultants/applied"), read("resultants/reacted")
    rows = [["loads", *applied], ["reactions", *reacted], ["sum", *(applied + reacted)]]
    if job.result.has("supports/face"):
        rows += [[f"reactions of face {face}" if face else "reactions of nodes of no face", *values]
                 for face, values in zip(read("supports/face"), read("supports/reacted").reshape(-1, 6))]
    errors = job.result.attributes_of("resultants")
    yield table("Resultants", ["of", *head], rows, f"Forces along z, θ = 0 and 90°. {LIFTS} about the origin r = z = 0. "
                f"Equilibrium error: {number(errors['equilibrium_error'])} on the whole, "
                f"{number(errors['part_equilibrium_error'])} on the worst part, of the largest resultant of the loads.",
                named_rows=True)
    labels = read("cuts/label") if job.result.has("cuts") else []
    if len(labels):
        rows = [[label, z, body or "all", *values] for label, z, body, values in
                zip(labels, read("cuts/z"), read("cuts/body"), read("cuts/resultants").reshape(-1, 6))]
        names = ("axial force", "shear force", *RESULTANTS[2:4], "shear force at 90°", "moment at 90°")
        yield table("Cuts", ["cut", "z", "body", *(with_unit(name, unit) for name, unit in zip(names, kinds))], rows,
                    f"What the part above exerts on the part below; tension is positive. {LIFTS} of the part below, "
                    "about r = 0 at the cut.")
    yield from _interfaces(job, head)


def _interfaces(job, head):
    """What goes through interfaces at the end of the increment shown, and how much of their area does it."""
    result, units = job.result, job.units
    mesh = result.mesh
    groups = [(one.name, one.law, one.joints) for one in result.interfaces if len(one.joints)]
    alone = np.flatnonzero(mesh.joint_interface == 0)
    if len(alone):
        groups.append(("joints of JOINTS", None, alone))
    if not groups:
        return
    points, rows = JointPoints(result), []
    area = points.areas()
    for name, law, joints in groups:
        forces = joint_sums(result, joints)[list(result.history.increment).index(result.increment)]
        whole = float(area[np.isin(points.owner, joints)].sum())
        rows.append([name, law, *forces, whole, *(100*share for share in points.shares(joints))])
    area_unit = f"{units.length}²" if units.length else ""
    note = (f"What the body at side 4-3 (body b) exerts on that at side 1-2 (body a). {LIFTS} of body a, about the origin r = z = 0. "
            "Shares of the area, by the planes of the law: points that are open carry nothing, the others touch or are glued; elastic "
            "joints always stick, in tension, too.")
    if (result.read("joint_materials/initial_stress") != 0).any():
        note += " Without the initial stress of LAWDETAILS, which loads nothing."
    yield table("Interfaces", ["interface", "law", *head, with_unit("area", area_unit), "stick [%]", "slip [%]", "open [%]"], rows, note,
                named_rows=True)


def largest(job):
    """Largest values of displacements, stresses and joints."""
    found, units = extremes(job.result), job.units
    rows = []
    for name, peaks in found.items():
        unit = units.stress if name in STRESSES else units.length
        if name == "length" or any(peak.value for peak in peaks):
            rows += [[with_unit(SYMBOLS[name], unit), word, *peak.cells()]
                     for word, peak in zip(("smallest", "largest")[-len(peaks):], peaks)]
    head = ["quantity", "end", "value", "r", "z", "θ [°]", "where"]
    yield table("Nodes", head, rows, "Stresses are smoothed to the nodes; values are the largest round the circle. "
                "What is zero is left out.",
                named_rows=True)
    yield from _infinite(job)
    joints = job.result.joints()
    if joints.rows:
        yield table("Joints", *_joint_rows(job), "Slip is the relative displacement along the joint, its elastic part included: joints "
                    "that stick have some.", named_rows=True)
        yield table("States (points × planes)", ["law", *STATES],
                    [[int(law), *(int(((joints["law"] == law) & (joints["state"] == state)).sum())
                                  for state in STATES)] for law in np.unique(joints["law"])])


def _infinite(job):
    """Nodes where no mesh brings stresses nearer, as the summary names them."""
    found = [one for one in job.summary.get("singular") or [] if isinstance(one, dict)]
    if found:
        yield table("Infinite stresses", ["node", "r", "z", "power of the distance"],
                    [[one.get(key) for key in ("node", "r", "z", "exponent")] for one in found],
                    "Stresses of the exact solution are infinite at these nodes: values there, and near them, depend on the mesh and grow "
                    "as it is refined. They are not to be held against a strength.")


def _joint_rows(job):
    units, mesh, rows = job.units, job.result.mesh, []
    laws = mesh.law_label[mesh.joint_material]
    for law in np.unique(laws):
        for name, peak in joint_peaks(job.result, np.flatnonzero(laws == law)).items():
            unit = units.length if name in ("gap", "slip") else units.stress
            cells = peak.cells() if peak.value > 0 else [None, None, None, None, "none"]
            rows.append([with_unit(name, unit), int(law), *cells])
    return ["largest", "law", "value", "r", "z", "θ [°]", "where"], rows


def sections(job):
    """Values along the sections of the deck, angle by angle; components that are zero are left out."""
    for name in job.result.section_numbers:
        section = job.result.section(name)
        if not len(section.point):
            continue
        titles = [*(with_unit(name, job.units.length) for name in DISPLACEMENTS),
                  *(with_unit(SYMBOLS[name], job.units.stress) for name in STRESSES)]
        for k, theta in enumerate(section.theta):
            values = np.hstack([without_rounding(section.displacement[k]), without_rounding(section.stress[k])])
            shown = [j for j in range(len(titles)) if values[:, j].any()]
            rows = [[point, distance, *place, body, *here] for point, distance, place, body, here in
                    zip(section.point, section.distance, section.position, section.body, values[:, shown])]
            yield table(f"Section {name}, θ = {number(theta)}°",
                        ["point", "distance", "r", "z", "body", *(titles[j] for j in shown)], rows)


def without_rounding(values, share=1e-13):
    """Values that are nothing but rounding beside the largest are zero: at most a share of it."""
    return np.where(abs(values) > share*abs(values).max(initial=0), values, 0.0)


def equations(job):
    """Equations of each harmonic, and what it contributes."""
    read, spectrum = job.result.read, job.result.spectrum()
    names = ("number", "factor_entries", "smallest_pivot", "backward_error", "condition")
    columns = [read(f"equations/{name}") for name in names]
    yield table("Harmonics", ["m", "family", with_unit("largest displacement", job.units.length),
                              with_unit("largest stress", job.units.stress), "equations", "entries of the factor",
                              "smallest pivot", "backward error", "condition"],
                zip(spectrum["harmonic"], spectrum["family"], spectrum["displacement"], spectrum["stress"], *columns))
