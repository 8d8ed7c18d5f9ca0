"""A pile and its ground: soil reactions as curves by depth, deflection and forces along the pile."""
import numpy as np

from ..resultants import AXIAL, FORCE, MOMENT, along
from ..soil import NoShaftError, cuts_through, pile_of, soil_reactions
from ..soil_joints import along_axis, sides_of
from ..table import Table
from . import style
from .options import Options
from .style import plt

# Depths of curves, and increments of profiles, where the options do not say which
DEPTHS, PROFILES = 6, 6


def reactions(result, options):
    """Soil reactions with the options' body, direction and increments: SoilReactions."""
    return soil_reactions(result, options.body, options.angle, options.increments)


def has_shaft(result):
    """Whether soil reactions of the pile are known."""
    try:
        return bool(len(soil_reactions(result, increments=result.history.increment[-1:]).z))
    except NoShaftError:
        return False


def _words(result, soil, across):
    """Where reactions come from: interfaces of the body along z, or across it, with their laws; or cuts."""
    if soil.source == "cuts":
        return "from cuts"
    mesh = result.mesh
    chosen = (sides_of(mesh, soil.body) != 0) & (along_axis(mesh) != across)
    names = [f"{one.name} (law {one.law})" for one in result.interfaces if chosen[one.joints].any()]
    if (chosen & (mesh.joint_interface == 0)).any():
        names.append("JOINTS")
    return " + ".join(names) or "none"


def _chosen(soil, options):
    """Segments whose curves are drawn, from the top."""
    if options.depths:
        return [int(abs(soil.z - depth).argmin()) for depth in options.depths]
    return style.thinned(range(len(soil.z)), DEPTHS)[::-1]


def _by_depth(axes, segments, x, y):
    """Curves of segments from rest on, named at their far ends."""
    points = []
    for k, segment in enumerate(segments):
        along, up = np.append(0, x[:, segment]), np.append(0, y[:, segment])
        axes.plot(along, up, **style.curve(k))
        far = abs(along).argmax()
        points.append((along[far], up[far]))
    axes.axhline(0, color="0.7", lw=0.5, zorder=0)
    axes.axvline(0, color="0.7", lw=0.5, zorder=0)
    axes.xaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(5))
    return points


def _depth_labels(axes, soil, segments, points):
    style.direct_labels(axes, points, [f"$z$ = {soil.z[k]:.4g}" for k in segments])


@style.styled
def draw_curves(result, options, of):
    """p-y or t-z curves against the motion of the pile, and against that relative to the ground: a Figure."""
    units, soil = style.Units(result, options), reactions(result, options)
    value, absolute, relative, name, moved = {
        "py": (soil.p, soil.v, soil.v_relative, "lateral resistance $p$", "deflection $y$"),
        "tz": (soil.t, soil.s, soil.s_relative, "shaft friction $t$", "settlement $s$")}[of]
    panels = 1 if np.isnan(relative).any() else 2
    figure, axes = plt.subplots(1, panels, figsize=(style.TWO_COLUMNS, 3.1), sharey=True, squeeze=False)
    axes, segments = axes[0], _chosen(soil, options)
    for one, moved_by in zip(axes, (absolute, relative)):
        points = _by_depth(one, segments, moved_by, value)
    axes[0].set_ylabel(units.label(name, units.per_length(units.force)))
    axes[0].set_xlabel(units.of_length(f"{moved} of the pile"))
    style.scaled(axes[0], "xy")
    if panels == 2:
        axes[1].set_xlabel(units.of_length(f"{moved} of the pile less that of the ground beside it"))
        style.scaled(axes[1], "x")
    title, way = {"py": ("$p$–$y$ curves", f"along {style.degrees(soil.theta)}"),
                  "tz": ("$t$–$z$ curves", "downwards")}[of]
    figure.suptitle(options.title if options.title is not None else
                    f"{title} of body {soil.body}: {_words(result, soil, False)}; what the pile exerts on "
                    f"the ground, positive {way}; increments {_span(soil.increment)}", fontsize=8)
    figure.canvas.draw()
    _depth_labels(axes[-1], soil, segments, points)
    return figure


def _span(numbers):
    return f"{numbers[0]}–{numbers[-1]}" if len(numbers) > 1 else str(numbers[0])


@style.styled
def draw_pisa(result, options):
    """The four soil reactions of the PISA method: a Figure."""
    units, soil = style.Units(result, options), reactions(result, options)
    figure, axes = plt.subplots(2, 2, figsize=(style.TWO_COLUMNS, 5.4))
    segments = _chosen(soil, options)
    shaft = [_by_depth(one, segments, x, y) for one, x, y in
             ((axes[0, 0], soil.v, soil.p), (axes[0, 1], soil.psi, soil.m))]
    for one, x, y in ((axes[1, 0], soil.v_b, soil.H_b), (axes[1, 1], soil.psi_b, soil.M_b)):
        _by_depth(one, [0], x[:, None], y[:, None])
        for k in style.thinned(range(len(x)), 10):
            one.annotate(str(soil.increment[k]), (x[k], y[k]), (3, -7), textcoords="offset points",
                         fontsize=6.5, color="0.3")
    unit = (units.per_length(units.force), units.per_length(units.moment), units.force, units.moment)
    names = ("distributed lateral load $p$", "distributed moment $m$", "base shear $H_b$", "base moment $M_b$")
    moved = (units.of_length("$v$"), r"$\psi$ [rad]", units.of_length("$v_b$"), r"$\psi_b$ [rad]")
    for one, name, x, of in zip(axes.flat, names, moved, unit):
        one.set_ylabel(units.label(name, of))
        one.set_xlabel(x)
        style.scaled(one)
    axes[0, 0].set_title(f"shaft: {_words(result, soil, False)}")
    axes[1, 0].set_title(f"base, $z$ = {soil.base_z:g}: {_words(result, soil, True)}; numbers: increments")
    figure.suptitle(options.title if options.title is not None else
                    f"Soil reactions on body {soil.body}: resistances, positive towards {style.degrees(soil.theta)};"
                    " moments and rotations that lean the pile that way", fontsize=8)
    figure.canvas.draw()
    for one, points in zip(axes[0], shaft):
        _depth_labels(one, soil, segments, points)
    return figure


def has_cuts(result):
    """Whether the deck has CUTS."""
    return result.has("cuts/body") and len(result.read("cuts/body")) > 0


def has_profile(result):
    """Whether there are several cuts of the body whose profile is drawn: of one there is no curve."""
    return has_cuts(result) and len(cuts_of(result, Options())[1]) > 1


def cuts_of(result, options):
    """Body and rows of the cuts along the pile: those of the options' body, of the pile, or of the first body."""
    if not has_cuts(result):
        raise LookupError("the deck has no CUTS")
    bodies = result.read("cuts/body")
    body = options.body
    if body is None:
        try:
            body = pile_of(result)
        except NoShaftError:
            body = int(bodies[0])
        body = body if body in bodies else int(bodies[0])
    rows = cuts_through(result, body)
    if not len(rows):
        raise LookupError(f"no CUTS of body {body}")
    return body, rows


def profile_table(result, options):
    """Deflection, rotation and resultants along the pile, a row for each increment and cut.

    Moments and rotations lean the pile towards theta; the axial force is tension. How far shear and moment may be off, whatever
    their angle, and the axial force, is known of the last increment alone: nan elsewhere.
    """
    _, rows = cuts_of(result, options)
    history = result.history
    numbers = history.increment if options.increments is None else np.asarray(options.increments)
    places = [_row(history, k) for k in numbers]
    z = result.read("cuts/z")[rows]
    force, motion = history["cuts"][places][:, rows], history["cut_motion"][places][:, rows]

    def turned(values, kind):
        return along(values, kind, options.angle).ravel()
    off = np.full((len(places), len(rows), 3), np.nan)
    off[np.asarray(places) == len(history.increment) - 1] = cut_errors(result)[rows, :3]
    return Table({"increment": np.repeat(numbers, len(rows)),
                  "load_factor": np.repeat(history["load_factor"][places], len(rows)),
                  "z": np.tile(z, len(places)), "theta": np.full(len(places)*len(rows), options.angle),
                  "v": turned(motion, FORCE), "psi": -turned(motion, MOMENT),
                  "H": turned(force, FORCE), "M": -turned(force, MOMENT), "N": force[..., AXIAL].ravel(),
                  "H_error": off[..., 1].ravel(), "M_error": off[..., 2].ravel(), "N_error": off[..., 0].ravel()})


def cut_errors(result):
    """How far axial force, shear, moment and torque on each cut may be off, all sources together: (cuts, 4); nan if not known."""
    if not result.has("errors/on_cuts"):
        return np.full((len(result.read("cuts/z")), 4), np.nan)
    shares = result.read("errors/on_cuts")
    return np.where((shares < 0).any(axis=0), np.nan, shares.sum(axis=0))


def _row(history, increment):
    found = np.flatnonzero(history.increment == increment)
    if not len(found):
        raise ValueError(f"there is no increment {increment}; the file keeps {history.increment.tolist()}")
    return int(found[0])


@style.styled
def draw_profile(result, options):
    """Deflection, rotation, shear, moment and axial force along the pile at increments: a Figure."""
    units = style.Units(result, options)
    body, _ = cuts_of(result, options)
    table = profile_table(result, options)
    numbers = np.unique(table["increment"])
    if options.increments is None:
        numbers = _telling(table, numbers)
    panels = (("v", units.of_length("deflection $v$")), ("psi", r"rotation $\psi$ [rad]"),
              ("H", units.label("shear $H$", units.force)), ("M", units.label("moment $M$", units.moment)),
              ("N", units.label("axial $N$", units.force)))
    figure, axes = plt.subplots(1, 5, figsize=(style.TWO_COLUMNS, 4.2), sharey=True)
    for k, number in enumerate(numbers):
        here = table.where(table["increment"] == number)
        for one, (name, _) in zip(axes, panels):
            one.plot(here[name], here["z"], label=f"{number} (load factor {here['load_factor'][0]:g})",
                     markevery=max(1, here.rows//8), **style.curve(k))
            if name in "HMN":
                off = here[f"{name}_error"]
                one.fill_betweenx(here["z"], here[name] - off, here[name] + off, color=one.lines[-1].get_color(), alpha=0.2, lw=0)
    for one, (name, label) in zip(axes, panels):
        one.axvline(0, color="0.7", lw=0.5, zorder=0)
        one.set_xlabel(label)
        one.xaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(3))
        largest = abs(table[name]).max()
        if largest == 0 or largest < 1e-12*max(abs(table[x]).max() for x in ("H", "M", "N")) and name in "HMN":
            one.set_xlim(-1, 1)
        style.scaled(one, "x")
    axes[0].set_ylabel(units.of_length("$z$"))
    style.legend(figure, "lower center", *axes[0].get_legend_handles_labels(), ncols=3, title="increment")
    figure.suptitle(options.title if options.title is not None else
                    f"Body {body} on its cuts at {style.degrees(options.angle)}: the part above on that below; "
                    "moment and rotation lean it that way, tension is positive" + (
                        "\nshaded, of the last increment: as far as it may be off" if np.isfinite(table["M_error"]).any() else ""), fontsize=8)
    return figure


def _telling(table, numbers):
    """Increments that tell most: some, and among them that of the largest deflection."""
    largest = table["increment"][abs(table["v"]).argmax()]
    few = style.thinned(numbers, PROFILES)
    if largest not in few:
        few[1:-1][abs(few[1:-1] - largest).argmin()] = largest
    return few
