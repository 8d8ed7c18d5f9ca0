"""The meridional planes theta and theta + 180 side by side: deformed mesh, contours."""
import textwrap

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.tri import Triangulation

from ..components import STRESSES
from . import pieces, style
from .options import Options
from .planes import Planes, solids

# Largest displacement as drawn, over the extent of the body
SHOWN = 0.08
# Shares of the drawn area that colours leave below and above if extremes would take most of the colours
OUTSIDE = 0.005
# How many times wider than the rest the whole range may be before colours leave extremes out
TOO_WIDE = 3.0
# Values beyond the colours by more than this share of them are told
CLEARLY = 0.05


@style.styled
def draw_deformed(result, options=Options()):
    """Deformed mesh on two opposite planes, enlarged, over the outlines at rest: a Figure."""
    mesh, planes = result.mesh, Planes(result, options, stretch=False)
    moved = {plane: result.nodal_displacement(plane) for plane in planes.angles}
    largest = max(np.linalg.norm(one[planes.nodes, :2], axis=1).max() for one in moved.values())
    scale = options.enlargement or (1.0 if largest == 0 else style.round_down(
        SHOWN*np.ptp(mesh.coordinates[planes.nodes], axis=0).max()/largest))
    for plane, displacement in moved.items():
        axes = planes.axes(plane)
        rest = [planes.place(line, plane) for line in pieces.outlines(mesh, mesh.coordinates, planes.mask)]
        axes.add_collection(LineCollection(rest, colors="0.6", lw=0.7, linestyles=[(0, (4, 2))]))
        positions = mesh.coordinates + scale*displacement[:, :2]
        edges = [planes.place(line, plane) for line in pieces.element_edges(mesh, positions, planes.chosen)]
        axes.add_collection(LineCollection(edges, colors="0.45", lw=0.35))
        shape = [planes.place(line, plane) for line in pieces.outlines(mesh, positions, planes.mask)]
        axes.add_collection(LineCollection(shape, colors="black", lw=1.0))
    enlarged = f"displacements {f'{scale:,.0f}' if scale >= 1 else f'{scale:g}'} times enlarged"
    words = f"{enlarged}, the largest {largest:.3g} {planes.units.length}".rstrip() if largest > 0 \
        else "no displacement"
    title = style.heading(result, options, ", ".join(one for one in (solids(options), words) if one))
    return planes.finish(title)


def quantities(result):
    """Quantities that contours are drawn of, by name: displacement and the stresses that are not zero."""
    stress = [result.nodal_stress_values(plane) for plane in (0.0, 180.0)]
    largest = max(abs(one).max() for one in stress)
    names = [name for k, name in enumerate(STRESSES)
             if max(abs(one[:, k]).max() for one in stress) > 1e-9*largest]
    return ["displacement", *names]


@style.styled
def draw_contours(result, name, options=Options()):
    """Contours of `displacement` (length of the vector) or of a stress on two opposite planes: a Figure."""
    mesh, planes = result.mesh, Planes(result, options, extra=0.6)
    drawn = {plane: _triangles(result, name, plane, planes.chosen) for plane in planes.angles}
    low, high = min(one[1].min() for one in drawn.values()), max(one[1].max() for one in drawn.values())
    units = planes.units
    label = units.of_length(f"${style.SYMBOLS[name]}$") if name == "displacement" else units.of_stress(name)
    limits = options.range or _limits(drawn.values(), low, high)
    steps = style.levels(*limits)
    if steps is None:
        return planes.finish(style.heading(result, options, f"{label}: {low:.4g} everywhere"))
    extend = {(True, True): "both", (True, False): "min", (False, True): "max", (False, False): "neither"}[
        bool(low < steps[0]), bool(high > steps[-1])]
    for plane, (points, found, corners) in drawn.items():
        axes, grid = planes.axes(plane), Triangulation(*planes.place(points, plane).T, corners)
        filled = axes.tricontourf(grid, found, levels=steps, extend=extend)
        axes.tricontour(grid, found, levels=steps, colors="white", linewidths=0.4, linestyles="solid")
        if low < 0 < high:
            axes.tricontour(grid, found, levels=[0.0], colors="black", linewidths=0.8, linestyles="solid")
        lines = [planes.place(line, plane) for line in pieces.outlines(mesh, mesh.coordinates, planes.mask)]
        axes.add_collection(LineCollection(lines, colors="black", lw=0.8))
    bar = planes.figure.colorbar(filled, ax=planes.all_axes, shrink=0.85, pad=0.02, label=label)
    bar.outline.set_linewidth(0.5)
    bar.set_ticks(steps[::int(np.ceil(len(steps)/(5*planes.figure.get_figheight())))])
    if steps[0] < 0 < steps[-1]:
        bar.ax.axhline(0, color="black", lw=1.0)
    title = style.heading(result, options, solids(options))
    return planes.finish(title, _beyond(result, name, planes, steps) if extend != "neither" else "")


def _values(result, name, plane):
    """Values (values, 1 or 3) of a quantity, and their places in the elements."""
    if name == "displacement":
        return result.nodal_displacement(plane), result.mesh.element_nodes
    return result.nodal_stress_values(plane)[:, [STRESSES.index(name)]], result.value_of


def _triangles(result, name, plane, chosen):
    """Points, values and corners of the triangles of a plane."""
    points, found, corners = pieces.triangles(result.mesh, *_values(result, name, plane), chosen=chosen)
    return points, np.linalg.norm(found, axis=1) if name == "displacement" else found[:, 0], corners


def _limits(drawn, low, high):
    """Range of the colours: all values, or, where extremes of a small area would take most of it, those of the rest."""
    values, areas = [], []
    for points, found, corners in drawn:
        (r1, z1), (r2, z2), (r3, z3) = points[corners].transpose(1, 2, 0)
        areas.append(abs((r2 - r1)*(z3 - z1) - (r3 - r1)*(z2 - z1)))
        values.append(found[corners].mean(axis=1))
    values, areas = np.concatenate(values), np.concatenate(areas)
    order = np.argsort(values)
    share = np.cumsum(areas[order])/areas.sum()
    least, most = values[order][np.searchsorted(share, (OUTSIDE, 1 - OUTSIDE))]
    return (least, most) if high - low > TOO_WIDE*(most - least) > 0 else (low, high)


def _beyond(result, name, planes, steps):
    """What the colours leave out, in words: the materials and their values."""
    mesh, words = result.mesh, []
    for k, label in enumerate(mesh.material_label):
        mine = planes.chosen[mesh.element_material[planes.chosen] == k]
        found = []
        for plane in planes.angles:
            values, index = _values(result, name, plane)
            places = np.concatenate([index[group, :size].ravel() for size, group in mesh.groups(mine)] or [[]])
            found.append(np.linalg.norm(values[places.astype(int)], axis=1) if name == "displacement"
                         else values[places.astype(int), 0])
        found = np.concatenate(found)
        room = CLEARLY*(steps[-1] - steps[0])
        if len(found) and (found.min() < steps[0] - room or found.max() > steps[-1] + room):
            words.append(f"material {label} from {found.min():.3g} to {found.max():.3g}")
    return "\n".join(textwrap.wrap("beyond the colours: " + ", ".join(words), 90)) if words else ""
