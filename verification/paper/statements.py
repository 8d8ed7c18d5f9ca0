"""What the paper says, and whether our runs show it"""
from dataclasses import dataclass

import numpy as np

from runs import BOTTOM, CASES, FACE, MOUTH

# A jump of a curve, or a difference of two, counts from this share of the largest value on
VISIBLE = 0.1


@dataclass
class Statement:
    """A statement of the paper.

    figures   numbers of the figures it belongs to; none if it has none
    says      what the paper says, or what must hold
    shown     whether our runs show it
    numbers   the figures behind it
    """
    figures: tuple
    says: str
    shown: bool
    numbers: str


def all_statements(runs):
    """All Statements, in the order of the figures."""
    return [*regions(runs), *vertical_stress(runs), *horizontal_stress(runs), *shear_stress(runs),
            *convergence(runs), *equilibrium(runs), *variations(runs)]


def section_a(runs):
    """z of section a-a. The text does not give it, but says that case 1 is open there at theta = 0 as well as at
    pi: the middle of where it is so; of the socket, if it is nowhere."""
    both = np.intersect1d(*(open_heights(runs["case1"], theta) for theta in (0, 180)))
    return float(both.min() + both.max())/2 if len(both) else (MOUTH + BOTTOM)/2


def regions(runs):
    """Fig. 7"""
    case1, case3 = runs["case1"], runs["case3"]
    for name, run in ((name, runs[name]) for name in CASES):
        counts = f"open {run.states('open')}, slip {run.states('slip')}"
        if name == "case1":
            yield Statement((7,), "In case 1 the interface debonds and nowhere slips.",
                            run.states("open") > 0 and run.states("slip") == 0, counts)
        elif name == "case3":
            yield Statement((7,), "In case 3, which is frictionless, the interface slips.",
                            run.states("slip") > 0, counts)
        else:
            yield Statement((7,), "Case 2 lies between the extreme cases 1 and 3: points slip, fewer than in case 3.",
                            0 < run.states("slip") < case3.states("slip"),
                            f"{counts}; case 3 slip {case3.states('slip')}")
    at_zero, at_pi = (open_heights(case1, theta) for theta in (0, 180))
    mouth, bottom = case1.vertical["z"].min(), case1.vertical["z"].max()
    yield Statement((7,), "Debonding occurs on the side of theta = pi as well as of theta = 0: at the mouth on the "
                    "one, deep in the socket on the other.",
                    mouth in at_pi and mouth not in at_zero and bottom in at_zero and bottom not in at_pi,
                    f"case 1 is open at pi: z = {span(at_pi)}; at 0: z = {span(at_zero)}")


def vertical_stress(runs):
    """Figs. 8, 11, 14"""
    z = section_a(runs)
    whole = face_values(runs["continuum fine"], 1, z)
    for name, figure in zip(CASES, (8, 11, 14)):
        run = runs[f"{name} fine"]
        values = face_values(run, 1, z)
        largest = abs(run.result.line((0, z), (2, z), (0, 180)).stress[..., 1]).max()
        jumps = [abs(np.subtract(*values[theta])) for theta in (0, 180)]
        smooth = [abs(np.subtract(*whole[theta])) for theta in (0, 180)]
        yield Statement((figure,), "The distribution of sigma_z is discontinuous on the side face of the pile; it is "
                        "not without joints.",
                        min(jumps) > VISIBLE*largest > max(smooth),
                        f"jump at theta = 0 {jumps[0]:.2f}, at pi {jumps[1]:.2f} MPa, without joints "
                        f"{max(smooth):.3f}; largest sigma_z {largest:.2f}")
    for side, theta, material, ends in (("outside the pile at theta = 0", 0, 2, (FACE, 2.0)),
                                        ("inside the pile at theta = pi", 180, 1, (0.0, FACE))):
        first, third = (runs[f"{name} fine"].result.stress(np.linspace(*ends, 51), z, theta, material=material)[:, 1]
                        for name in ("case1", "case3"))
        largest = max(abs(runs[f"{name} fine"].result.line((0, z), (2, z), (0, 180)).stress[..., 1]).max()
                      for name in ("case1", "case3"))
        apart = abs(first - third).max()
        yield Statement((8, 14), f"The effect of friction is seen between Figs. 8 and 14 {side}.",
                        apart > VISIBLE*largest, f"sigma_z of cases 1 and 3 up to {apart:.2f} MPa apart there, "
                        f"{apart/largest:.0%} of the largest; {VISIBLE:.0%} counts as seen")


def horizontal_stress(runs):
    """Figs. 9, 12, 15"""
    for name, figure in zip(CASES, (9, 12, 15)):
        run = runs[name]
        centres = [centre_of_pressure(run.at(theta)) for theta in (0, 180)]
        middle = (MOUTH + BOTTOM)/2
        yield Statement((figure,), "The distribution of sigma_r shows leverage: pressure at the mouth at theta = 0, "
                        "and deep in the socket at theta = pi.",
                        centres[0] < middle < centres[1],
                        f"centre of the pressure on the interface: z = {centres[0]:.2f} m at theta = 0, "
                        f"{centres[1]:.2f} m at pi")
    largest = [-runs[name].at(0)["sigma"].min() for name in CASES]
    yield Statement((9, 12, 15), "The effect of friction on the propagation of stress is seen clearly (theta = 0): the "
                    "less friction, the more pressure.", largest[0] < largest[1] < largest[2],
                    "largest pressure at theta = 0: " + ", ".join(f"case {k} {p:.2f}" for k, p in
                                                                  enumerate(largest, 1)) + " MPa")


def shear_stress(runs):
    """Figs. 10, 13, 16"""
    for name, figure in zip(CASES, (10, 13, 16)):
        run = runs[name]
        crossing = abs(run.at(0)["tau_xi"]).max()
        near = footing_at_face(runs[f"{name} fine"], 3)
        near = near[(near[:, 0] > MOUTH + 0.1) & (near[:, 0] < BOTTOM - 0.1), 1]
        largest = footing_at_face(runs["case1 fine"], 3)[:, 1]
        numbers = (f"largest |tau_xi| of the joints at theta = 0 {crossing:.3f} MPa; largest |tau_rz| of the footing "
                   f"at the face, 0.1 m from its ends {abs(near).max():.2f} MPa")
        if name == "case3":
            yield Statement((figure,), "tau_rz is not propagated on the plane theta = 0: the interface is frictionless.",
                            crossing == 0.0 and abs(near).max() < VISIBLE*abs(largest).max(), numbers)
        else:
            yield Statement((figure,), "tau_rz is propagated through the interface on the plane theta = 0.",
                            crossing > 0 and abs(near).max() > VISIBLE*abs(largest).max(), numbers)


def convergence(runs):
    """Fig. 17"""
    case1, case2, case3 = (runs[name] for name in CASES)
    for name in ("case1", "case3"):
        ratio = runs[name].result.convergence()["ratio"]
        above = np.flatnonzero(ratio <= 0.2)[0]
        early = (ratio[0] - ratio[above])/max(above, 1)
        late = (ratio[above] - ratio[-1])/max(len(ratio) - 1 - above, 1)
        yield Statement((17,), "The ratio falls rapidly to about 20 %; thereafter the decrease an iteration becomes "
                        f"smaller (case {name[-1]}).", late < early,
                        f"{early:.1%} an iteration down to 20 %, {late:.1%} thereafter")
    yield Statement((17,), "Convergence is faster where no slip occurs (case 1) than without friction (case 3).",
                    case1.loops < case3.loops,
                    f"iterations to 3 %: case 1 {case1.loops}, case 2 {case2.loops}, case 3 {case3.loops}")


def equilibrium(runs):
    """What any run must show"""
    for name, run in runs.items():
        if name.startswith("continuum"):
            continue
        error, part = (run.summary[key] for key in ("equilibrium_error", "part_equilibrium_error"))
        yield Statement((), f"{name}: converged, and global equilibrium holds to the residual reported.",
                        run.summary["status"] == "converged" and error <= run.summary["residual_ratio"],
                        f"residual ratio {run.summary['residual_ratio']:.1e}, equilibrium error {error:.1e} "
                        f"on the whole, {part:.1e} on the worst part")
    case3, eight = runs["case3"].summary, runs["case3_M8"].summary
    yield Statement((), "The pile's own equilibrium comes with the tolerance: 3 % leaves more than 1e-6 does.",
                    eight["part_equilibrium_error"] < case3["part_equilibrium_error"],
                    f"{case3['part_equilibrium_error']:.1e} and {eight['part_equilibrium_error']:.1e} of the load")


def variations(runs):
    """What the text says without a figure"""
    case3, stiff, pile = (runs[name] for name in ("case3", "case3_stiff_joint", "case3_stiff_pile"))
    yield Statement((), "Ten times stiffer joints need more iterations.", stiff.loops > case3.loops,
                    f"{case3.loops} -> {stiff.loops}")
    yield Statement((), "Ten times stiffer joints carry more stress.",
                    stiff.largest("sigma") > case3.largest("sigma"),
                    f"largest |sigma| {case3.largest('sigma'):.3f} -> {stiff.largest('sigma'):.3f} MPa")
    four, eight = (runs[f"case3_M{m}"].largest("sigma") for m in (4, 8))
    yield Statement((), "M = 4 is sufficient: it almost coincides with M = 8 (33 planes, 1e-6).",
                    abs(four/eight - 1) < 0.02,
                    f"largest |sigma| {four:.4f} and {eight:.4f} MPa, {abs(four/eight - 1):.2%} apart")
    same = ((pile.vertical["state"] == "open") == (case3.vertical["state"] == "open")).mean()
    yield Statement((), "With a stiffer pile and stiffer joints the result is almost that of case 3: it opens almost "
                    "where case 3 opens.", same > 0.8, f"{same:.0%} of the points on planes agree")


def open_heights(run, theta):
    """Heights z at which the vertical interface is open on a plane."""
    rows = run.at(theta)
    return rows["z"][rows["state"] == "open"]


def span(heights):
    """Range of heights in words."""
    return f"{min(heights):.2f} to {max(heights):.2f}" if len(heights) else "nowhere"


def face_values(run, component, z):
    """theta -> stress of the pile and of the footing where a section z = const crosses the face."""
    return {theta: [float(run.result.stress(FACE, z, theta, material=material)[component])
                    for material in (1, 2)] for theta in (0, 180)}


def footing_at_face(run, component, theta=0, points=81):
    """z and a stress of the footing along the face: (points, 2)."""
    z = np.linspace(MOUTH, BOTTOM, points)
    return np.stack([z, run.result.stress(FACE, z, theta, material=2)[:, component]], -1)


def centre_of_pressure(rows):
    """z of the resultant of the pressure on the interface, on one plane; points count alike."""
    pressure = np.maximum(-rows["sigma"], 0)
    return float((rows["z"]*pressure).sum()/pressure.sum())
