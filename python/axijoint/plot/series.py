"""Curves by increment: load and displacement of named points, work and energy, residuals."""
import numpy as np

from .. import circle
from ..resultants import AXIAL, FORCE, MOMENT, along, load_of
from ..table import joined
from . import style
from .style import plt

@style.styled
def draw_points(result, options):
    """Load against the displacements of the named points, along theta and along z: a Figure."""
    units, history, theta = style.Units(result, options), result.history, options.angle
    varied, columns, load = load_of(history, theta)
    figure, axes = plt.subplots(1, 2, figsize=(style.TWO_COLUMNS, 2.9), sharey=True)
    load = np.append(0, load)
    for k, name in enumerate(history.point_names):
        lateral, vertical = _along(result, name, theta)
        for one, moved in zip(axes, (lateral, vertical)):
            one.plot(np.append(0, moved), load, label=_place(history, name), **style.curve(k))
    _numbers(axes[0], np.append(0, _along(result, history.point_names[0], theta)[0]), load, history.increment)
    axes[0].set_ylabel(varied if columns is None else
                       units.label(f"applied {varied}", units.force if columns in (AXIAL, FORCE) else units.moment))
    axes[0].set_xlabel(units.of_length(f"displacement along {style.degrees(theta)}"))
    axes[1].set_xlabel(units.of_length("displacement $v$ along $z$"))
    for one in axes:
        one.axhline(0, color="0.7", lw=0.5, zorder=0)
        one.axvline(0, color="0.7", lw=0.5, zorder=0)
        style.scaled(one, "x")
    style.scaled(axes[0], "y")
    style.legend(figure, "lower center", *axes[0].get_legend_handles_labels(),
                 ncols=min(3, len(history.point_names)))
    figure.suptitle(options.title if options.title is not None
                    else f"Load and displacement at {style.degrees(theta)}; numbers: increments")
    return figure


def points_table(result, options):
    """A row for each increment and point: resultants applied, and displacements, along an angle."""
    history, rows = result.history, []
    applied = history["applied"]
    for name in history.point_names:
        r, z = history.point_position(name)
        u, v, w = history.point(name, options.angle).T
        lateral = _along(result, name, options.angle)[0]
        count = len(u)
        rows.append({"point": np.full(count, name), "r": np.full(count, r), "z": np.full(count, z),
                     "theta": np.full(count, options.angle), "increment": history.increment,
                     "load_factor": history["load_factor"], "axial_force": applied[:, AXIAL],
                     "lateral_force": along(applied, FORCE, options.angle),
                     "moment": along(applied, MOMENT, options.angle),
                     "u": u, "v": v, "w": w, "lateral": lateral})
    return joined(rows)


def _along(result, name, theta):
    """Displacements of a point at theta, along that direction and along z."""
    moved = result.history.point(name, theta, cartesian=True)
    return circle.cosine(theta)*moved[:, 0] + circle.sine(theta)*moved[:, 1], moved[:, 2]


def _place(history, name):
    r, z = history.point_position(name)
    return f"{name} ($r$ = {r:g}, $z$ = {z:g})"


def _numbers(axes, x, y, increments):
    """Numbers of increments beside the points of a curve."""
    for k in style.thinned(range(1, len(x)), 10):
        axes.annotate(str(increments[k - 1]), (x[k], y[k]), (3, -7), textcoords="offset points",
                      fontsize=6.5, color="0.3")


def _dissipated_by(result):
    """What dissipates: slip of joints, plastic strain of bodies that yield, or both."""
    by = ["slip"]*bool(len(result.mesh.joint_label)) + ["plastic strain"]*result.has("yield")
    return " ".join(["dissipated", *(["by", " and ".join(by)] if by else [])])


@style.styled
def draw_energy(result, options):
    """Work, energy and dissipation, and the residual and the iterations of each increment: a Figure."""
    units, table = style.Units(result, options), result.increments
    figure, (left, right) = plt.subplots(1, 2, figsize=(style.TWO_COLUMNS, 2.9))
    rest = table["work"] - table["energy"] - table["dissipated"]
    curves = (("work", table["work"]), ("elastic energy", table["energy"]),
              (_dissipated_by(result), table["dissipated"]), ("work less both", rest))
    for k, (name, values) in enumerate(curves):
        left.plot(table["increment"], values, label=name, **style.curve(k))
    left.axhline(0, color="0.7", lw=0.5, zorder=0)
    left.set_ylabel(units.label("energy", units.moment))
    style.scaled(left, "y")
    left.legend(loc="best")
    found = table["residual"] > 0
    right.semilogy(table["increment"][found], table["residual"][found], **style.curve(0))
    right.set_ylabel("forces out of balance / loads (line)")
    lost = table["equilibrium"] == 0
    right.plot(table["increment"][lost & found], table["residual"][lost & found], ls="", marker="x", ms=8,
               color="black", label="not in equilibrium")
    count = right.twinx()
    count.bar(table["increment"], table["iterations"], width=0.5, color="0.85", edgecolor="0.6", lw=0.5)
    count.set_ylabel("iterations (bars)")
    count.yaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(integer=True))
    count.spines["right"].set_visible(True)
    right.set_zorder(count.get_zorder() + 1)
    right.patch.set_visible(False)
    if lost.any():
        right.legend()
    for one in (left, right):
        one.set_xlabel("increment")
        one.xaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(integer=True))
    figure.suptitle(options.title if options.title is not None else "Work and energy, and residuals by increment")
    return figure
