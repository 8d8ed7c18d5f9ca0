"""Curves: profiles along sections, convergence path, spectrum of the harmonics."""
from dataclasses import replace

import numpy as np

from ..components import STRESSES
from ..result import OutsideError
from . import pieces, style
from .options import Options
from .style import plt


def default_lines(result):
    """Lines for a deck without sections: across the middle of the longest interface, and along
    z half-way between it and the least radius.

    Without joints: across and along the middle of the body. Returns pairs of ends (r, z).
    """
    low, high = result.mesh.coordinates.min(axis=0), result.mesh.coordinates.max(axis=0)
    middle = inner = (low + high)/2
    chains = pieces.interfaces(result)
    if chains:
        longest = max(chains, key=lambda one: one.length)
        middle = np.concatenate(longest.lines).mean(axis=0)
        inner = (low + middle)/2
    return [((low[0], middle[1]), (high[0], middle[1])), ((inner[0], low[1]), (inner[0], high[1]))]


def sections(result, angles=None):
    """Sections of the deck by name, or along the default lines; at the deck's angles or others."""
    if result.section_numbers:
        stored = {f"section_{number}": result.section(number) for number in result.section_numbers}
        return stored if angles is None else {
            name: replace(result.line(one.first, one.last, angles, _points(result, one)), number=one.number)
            for name, one in stored.items()}
    found = {}
    for name, ends in zip(("line_across", "line_along"), default_lines(result)):
        try:
            found[name] = result.line(*ends, theta=(0, 180) if angles is None else angles, points=201)
        except OutsideError:  # through a hollow
            continue
    return found


def _points(result, section):
    """Number of points of a section of the deck, those outside the mesh with them."""
    return int(result.attributes_of(f"sections/{section.number}")["points"])


def of_solid(section, options):
    """The rows of a section in the options' body and material."""
    keep = np.ones(len(section.point), bool)
    if options.body is not None:
        keep &= section.body == options.body
    if options.material is not None:
        keep &= section.material == options.material
    rows = {name: getattr(section, name)[keep] for name in
            ("point", "position", "distance", "element", "body", "material")}
    return replace(section, displacement=section.displacement[:, keep], stress=section.stress[:, keep], **rows)


@style.styled
def draw_section(result, section, options=Options()):
    """Displacements and stresses along a line: a Figure. Curves break where solids meet."""
    units = style.Units(result, options)
    shown = _components(section, units)
    rows = -(-len(shown)//3)
    figure, axes = plt.subplots(rows, 3, figsize=(style.TWO_COLUMNS, 0.5 + 1.75*rows), sharex=True,
                                squeeze=False)
    for one, (label, values) in zip(axes.flat, shown):
        plot_pieces(one, section, values)
        one.set_ylabel(label)
        one.tick_params(labelbottom=True)
        one.set_xlabel(units.of_length("distance"))
        style.scaled(one, "y")
    for one in axes.flat[len(shown):]:
        one.remove()
    names = [style.degrees(theta) for theta in section.theta]
    style.legend(figure, "upper right", axes[0, 0].get_lines()[:len(names)], names, ncols=len(names))
    number = "" if section.number is None else f"section {section.number}: "
    figure.suptitle(style.heading(result, options, f"{number}from r = {section.first[0]:g}, "
                                  f"z = {section.first[1]:g} to r = {section.last[0]:g}, "
                                  f"z = {section.last[1]:g}"), x=0.01, ha="left")
    return figure


def _components(section, units):
    """Labels and values (angles, rows) of the components that are not zero all along."""
    found = []
    for labels, values in (([units.of_length(f"${name}$") for name in "uvw"], section.displacement),
                           ([units.of_stress(name) for name in STRESSES], section.stress)):
        largest = abs(values).max()
        found += [(label, values[..., k]) for k, label in enumerate(labels)
                  if abs(values[..., k]).max() > 1e-9*largest]
    return found or [(units.of_length("$u$"), section.displacement[..., 0])]


def plot_pieces(axes, section, values, **options):
    """Curves of values (angles, rows) against the distance; they break where the solid changes."""
    for k in range(len(section.theta)):
        distance, curve = broken(section, values[k])
        axes.plot(distance, curve, **(style.curve(k) | {"marker": ""} | options))
    axes.axhline(0, color="0.7", lw=0.5, zorder=0)


def broken(section, values):
    """Distances and values with nan between the stretches of different solids; points alone are no curve."""
    distance, curve, stretches = [], [], section.pieces()
    for rows in [one for one in stretches if len(one) > 1] or stretches:
        distance += [*section.distance[rows], np.nan]
        curve += [*values[rows], np.nan]
    return np.array(distance), np.array(curve)


@style.styled
def draw_convergence(result, options=Options()):
    """Residual ratio against iterations, below it, where there are joints, points that slip or are open: a Figure.

    None if there is no residual to show: of a linear job, or where no joint slips or opens.
    """
    path = result.convergence()
    if not (path["ratio"] > 0).any():
        return None
    jointed = len(result.mesh.joint_label) > 0
    heights = (3, 2) if jointed else (3,)
    figure, axes = plt.subplots(len(heights), 1, figsize=(4.6, 0.84*sum(heights)), sharex=True, height_ratios=heights, squeeze=False)
    above, lowest = axes[0, 0], axes[-1, 0]
    step = np.arange(1, path.rows + 1)
    marker = {"marker": "o", "markevery": max(1, path.rows//40), "ms": 3}
    ratio = np.where(path["ratio"] > 0, path["ratio"], np.nan)
    above.semilogy(step, ratio, color="black", **marker)
    above.axhline(result.attributes_of("convergence")["tolerance"], color="0.4", ls="--", lw=0.8)
    above.annotate("tolerance", (1, result.attributes_of("convergence")["tolerance"]), (3, 0), va="center",
                   xycoords=("axes fraction", "data"), textcoords="offset points", color="0.25")
    ratio_axis(above.yaxis, np.nanmin(ratio), np.nanmax(ratio))
    above.set_ylabel("forces out of balance, relative")
    if jointed:
        for name, label, (colour, dashes, shape) in zip(("n_open", "n_slip"), ("open", "slip"), style.CURVES):
            lowest.plot(step, path[name], color=colour, ls=dashes, **(marker | {"marker": shape}), label=label)
        lowest.set_ylabel("points × planes")
        lowest.set_ylim(0, max(1, 1.05*max(path["n_open"].max(), path["n_slip"].max())))
        lowest.legend()
    lowest.set_xlabel("iteration")
    for change in np.flatnonzero(np.diff(path["increment"])):
        for one in axes.flat:
            one.axvline(change + 1.5, color="0.75", lw=0.6)
    lowest.xaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(integer=True))
    if options.title:
        figure.suptitle(options.title)
    return figure


def ratio_axis(axis, low, high):
    """Ticks of a logarithmic axis of ratios: 1, 2, 5 within few decades, else powers of ten."""
    if high > 300*low:
        return
    axis.set_major_locator(style.matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(lambda x, _: f"{x:g}")
    axis.set_minor_formatter(style.matplotlib.ticker.NullFormatter())


@style.styled
def draw_spectrum(result, options=Options()):
    """Largest amplitude of displacement and stress of each harmonic: a Figure."""
    units, table = style.Units(result, options), result.spectrum()
    figure, axes = plt.subplots(1, 2, figsize=(style.TWO_COLUMNS, 2.4))
    families = [name for name in ("symmetric", "antisymmetric") if (table["family"] == name).any()]
    width = 0.8/len(families)
    for one, name, unit in zip(axes, ("displacement", "stress"), (units.length, units.stress)):
        largest = table[name].max()
        for k, family in enumerate(families):
            rows = (table["family"] == family) & (table[name] > 1e-12*largest)
            one.bar(table["harmonic"][rows] + (k - (len(families) - 1)/2)*width, table[name][rows], width*0.9,
                    color=("0.35", "white")[k], edgecolor="black", lw=0.6, hatch=("", "////")[k], label=family)
        one.set_yscale("log")
        one.set_xlabel("harmonic $m$")
        one.set_ylabel(units.label(f"largest {name}", unit))
        one.xaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(integer=True))
        one.set_xlim(table["harmonic"].min() - 0.7, table["harmonic"].max() + 0.7)
    if len(families) > 1:
        axes[1].legend()
    if options.title or result.history.increment[-1] > 1:
        figure.suptitle(style.heading(result, options))
    return figure
