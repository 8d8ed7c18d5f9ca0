"""The meridional planes theta = 0 and 180 side by side: deformed mesh, contours."""
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.tri import Triangulation

from ..components import STRESSES
from . import pieces, style
from .style import plt

PLANES = (0.0, 180.0)
# Largest displacement as drawn, over the extent of the body
SHOWN = 0.08


def mirrored(points, plane):
    """Points of a plane as drawn: theta = 180 to the left."""
    return points*np.array([1.0 if plane == PLANES[0] else -1.0, 1.0])


def _axes(result, extra=0.0):
    extent = np.ptp(result.mesh.coordinates, axis=0)
    width = style.TWO_COLUMNS*0.78 if 2*extent[0] > 0.8*extent[1] else style.ONE_COLUMN
    height = min(8.5, (width - 0.8 - extra)*extent[1]/(2*extent[0])*1.05 + 1.0)
    return plt.subplots(figsize=(width, height))


def _finish(axes, units, title):
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.set_xlabel(units.of_length("$r$"))
    axes.set_ylabel(units.of_length("$z$"))
    axes.xaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(7, steps=[1, 2, 2.5, 5, 10]))
    axes.xaxis.set_major_formatter(lambda x, _: f"{abs(x):g}")
    low, high = axes.get_ylim()
    axes.axvline(0, color="black", lw=0.6, ls=(0, (8, 2, 1, 2)))
    axes.text(0.25, 1.01, style.degrees(180), transform=axes.transAxes, ha="center", va="bottom")
    axes.text(0.75, 1.01, style.degrees(0), transform=axes.transAxes, ha="center", va="bottom")
    axes.set_ylim(low, high)
    if title:
        axes.set_title(title, pad=16)


@style.styled
def draw_deformed(result):
    """Deformed mesh on theta = 0 and 180, enlarged, over the outlines at rest: a Figure."""
    mesh, units = result.mesh, style.Units(result)
    figure, axes = _axes(result)
    moved = {plane: result.nodal_displacement(plane) for plane in PLANES}
    largest = max(np.linalg.norm(one[:, :2], axis=1).max() for one in moved.values())
    scale = style.round_down(SHOWN*np.ptp(mesh.coordinates, axis=0).max()/largest) if largest > 0 else 1.0
    for plane, displacement in moved.items():
        rest = [mirrored(line, plane) for line in pieces.outlines(mesh, mesh.coordinates)]
        axes.add_collection(LineCollection(rest, colors="0.6", lw=0.7, linestyles=[(0, (4, 2))]))
        positions = mesh.coordinates + scale*displacement[:, :2]
        edges = [mirrored(line, plane) for line in pieces.element_edges(mesh, positions)]
        axes.add_collection(LineCollection(edges, colors="0.45", lw=0.35))
        shape = [mirrored(line, plane) for line in pieces.outlines(mesh, positions)]
        axes.add_collection(LineCollection(shape, colors="black", lw=1.0))
    enlarged = f"displacements {f'{scale:,.0f}' if scale >= 1 else f'{scale:g}'} times enlarged"
    _finish(axes, units, f"{enlarged}, the largest {largest:.3g} {units.length}".rstrip() if largest > 0
            else "no displacement")
    return figure


def quantities(result):
    """Quantities that contours are drawn of, by name: displacement and the stresses that are not zero."""
    stress = [result.nodal_stress_values(plane) for plane in PLANES]
    largest = max(abs(one).max() for one in stress)
    names = [name for k, name in enumerate(STRESSES)
             if max(abs(one[:, k]).max() for one in stress) > 1e-9*largest]
    return ["displacement", *names]


@style.styled
def draw_contours(result, name):
    """Contours of `displacement` (length of the vector) or of a stress on theta = 0 and 180: a Figure."""
    mesh, units = result.mesh, style.Units(result)
    figure, axes = _axes(result, extra=0.6)
    drawn = []
    for plane in PLANES:
        if name == "displacement":
            values, index = result.nodal_displacement(plane), mesh.element_nodes
            points, found, corners = pieces.triangles(mesh, values, index)
            found = np.linalg.norm(found, axis=1)
        else:
            values = result.nodal_stress_values(plane)[:, [STRESSES.index(name)]]
            points, found, corners = pieces.triangles(mesh, values, result.value_of)
            found = found[:, 0]
        drawn.append((mirrored(points, plane), found, corners))
    low, high = min(one[1].min() for one in drawn), max(one[1].max() for one in drawn)
    steps = style.levels(low, high)
    label = units.of_length(f"${style.SYMBOLS[name]}$") if name == "displacement" else units.of_stress(name)
    if steps is None:
        _finish(axes, units, f"{label}: {low:.4g} everywhere")
        return figure
    for points, found, corners in drawn:
        grid = Triangulation(*points.T, corners)
        filled = axes.tricontourf(grid, found, levels=steps, cmap=style.MAP)
        axes.tricontour(grid, found, levels=steps, colors="white", linewidths=0.4, linestyles="solid")
        if low < 0 < high:
            axes.tricontour(grid, found, levels=[0.0], colors="black", linewidths=0.8, linestyles="solid")
    for plane in PLANES:
        lines = [mirrored(line, plane) for line in pieces.outlines(mesh, mesh.coordinates)]
        axes.add_collection(LineCollection(lines, colors="black", lw=0.8))
    bar = figure.colorbar(filled, ax=axes, shrink=0.85, pad=0.02, label=label)
    bar.outline.set_linewidth(0.5)
    bar.set_ticks(steps)
    if low < 0 < high:
        bar.ax.axhline(0, color="black", lw=1.0)
    _finish(axes, units, "")
    return figure
