"""Bodies that yield: plastic zones and dissipation on two opposite planes, zones round the axis, what moves beyond the limit
load."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import PowerNorm
from matplotlib.tri import Triangulation

from .. import circle
from . import pieces, style
from .options import Options
from .planes import Planes, solids
from .style import plt

# Largest displacement of a mechanism as drawn, over the extent of the body
SHOWN = 0.08
# Points whose radius differs by less than this share of it lie round one circle
SAME_RADIUS = 1e-3
# A plastic strain below this share of the largest is none
NONE = 1e-9


def has(result):
    """Whether bodies of a result can yield."""
    return result.has("yield/equivalent")


def plane_at(result, theta):
    """Index of the plane of the criteria that lies nearest an angle [degree]; all repeats, or is mirrored, beyond the
    last of them."""
    planes = np.degrees(result.read("yield/planes"))
    if len(planes) == 1:
        return 0
    step = planes[1] - planes[0]
    mirrored = planes[-1] <= 180.0 + 1e-6
    period = 2.0*planes[-1] if mirrored else planes[-1] + step
    theta = theta % period
    if mirrored:
        theta = min(theta, period - theta)
    return int(round(theta/step)) % len(planes)


@style.styled
def draw_zones(result, options=Options()):
    """Elements by their largest equivalent plastic strain, on two opposite planes: a Figure."""
    return _by_element(result, options, result.read("yield/equivalent"), "equivalent plastic strain",
                       "plastic strain up to {:.3g}")


@style.styled
def draw_dissipation(result, options=Options()):
    """Elements by the largest work that plastic strain dissipated in them per volume in the last increment, on two
    opposite planes: a Figure; None if there is none. Near a limit load it shows where the mechanism shears."""
    values = result.read("yield/dissipation")
    if not values.max() > 0.0:
        return None
    units = style.Units(result, options)
    return _by_element(result, options, values, units.label("work dissipated per volume", units.stress),
                       "dissipated per volume up to {:.3g}", power=0.5)  # edges of what moves are singular


def _by_element(result, options, of_points, label, words, power=1.0):
    """Elements by the largest value of their points, shape (planes, points), on two opposite planes; words of the
    heading for that of all; colours go with a power of the values."""
    mesh, planes, element = result.mesh, Planes(result, options, extra=0.6, stretch=False), result.read("stress/element") - 1
    by_element = {}
    for plane in planes.angles:
        by_element[plane] = np.zeros(len(mesh.element_material))
        np.maximum.at(by_element[plane], element, of_points[plane_at(result, plane)])
    high = max(values[planes.chosen].max() for values in by_element.values())
    limits = options.range or (0.0, high if high > 0.0 else 1.0)
    for plane, values in by_element.items():
        axes = planes.axes(plane)
        yielded = planes.chosen[values[planes.chosen] > NONE*high]
        shapes = [planes.place(polygon, plane) for polygon in pieces.element_polygons(mesh, mesh.coordinates, yielded)]
        order = [one for _, group in mesh.groups(yielded) for one in group]
        drawn = axes.add_collection(PolyCollection(shapes, array=values[order], norm=PowerNorm(power, *limits),
                                                   cmap="viridis_r", edgecolors="none"))
        lines = [planes.place(line, plane) for line in pieces.element_edges(mesh, mesh.coordinates, planes.chosen)]
        axes.add_collection(LineCollection(lines, colors="0.75", lw=0.2))
        lines = [planes.place(line, plane) for line in pieces.outlines(mesh, mesh.coordinates, planes.mask)]
        axes.add_collection(LineCollection(lines, colors="black", lw=0.8))
    bar = planes.figure.colorbar(drawn, ax=planes.all_axes, shrink=0.85, pad=0.02, label=label)
    bar.outline.set_linewidth(0.5)
    return planes.finish(style.heading(result, options, ", ".join(
        one for one in (solids(options), words.format(high)) if one)))


def _circle(result):
    """Radius of the points round which most plastic strain is found, and the points there, from below."""
    strain, position = result.read("yield/equivalent"), result.read("stress/position")
    radius = position[strain.max(axis=0).argmax(), 0]
    points = np.flatnonzero(abs(position[:, 0] - radius) <= SAME_RADIUS*max(radius, 1e-12))
    return radius, points[np.argsort(position[points, 1])]


@style.styled
def draw_unrolled(result, options=Options()):
    """The share of the strength that is left, round the circle of the point with the largest plastic strain: a Figure;
    None if nothing has yielded or the points of the circle lie at one height."""
    strain, margin = result.read("yield/equivalent"), result.read("yield/margin")
    if not strain.max() > 0.0:
        return None
    radius, points = _circle(result)
    z = result.read("stress/position")[points, 1]
    if len(np.unique(z)) < 3:
        return None
    units = style.Units(result, options)
    theta = np.arange(0.0, 361.0, 5.0)
    values = np.array([margin[plane_at(result, angle)][points] for angle in theta])
    marked = np.array([strain[plane_at(result, angle)][points] > NONE*strain.max() for angle in theta])
    figure, axes = plt.subplots(figsize=(style.TWO_COLUMNS*0.78, 3.4))
    across, along = np.meshgrid(theta, z, indexing="ij")
    grid = Triangulation(across.ravel(), along.ravel())
    filled = axes.tricontourf(grid, values.ravel(), levels=np.linspace(0.0, 1.0, 11), cmap="viridis")
    if marked.any() and not marked.all():
        axes.tricontour(grid, marked.ravel().astype(float), levels=[0.5], colors="black", linewidths=1.0)
    bar = figure.colorbar(filled, ax=axes, pad=0.02, label="yield margin")
    bar.outline.set_linewidth(0.5)
    axes.set_xlabel(r"$\theta$ [degree]")
    axes.set_xticks(np.arange(0, 361, 45))
    axes.set_ylabel(units.of_length("$z$"))
    title = style.heading(result, options, f"round r = {radius:.4g}, black line: has yielded")
    if title:
        axes.set_title(title)
    return figure


@style.styled
def draw_mechanism(result, options=Options()):
    """What the step that found no equilibrium moved, on two opposite planes: a Figure; None if there is none."""
    if not result.has("yield/failing_displacement"):
        return None
    mesh, planes = result.mesh, Planes(result, options, stretch=False)
    amplitude = result.read("yield/failing_displacement")
    moved = {plane: circle.totals(amplitude, result.harmonic, result.family,
                                  np.full(amplitude.shape[1], float(plane))) for plane in planes.angles}
    largest = max(np.linalg.norm(one[planes.nodes, :2], axis=1).max() for one in moved.values())
    if not largest > 0.0:
        return None
    scale = SHOWN*np.ptp(mesh.coordinates[planes.nodes], axis=0).max()/largest
    for plane, displacement in moved.items():
        axes = planes.axes(plane)
        rest = [planes.place(line, plane) for line in pieces.outlines(mesh, mesh.coordinates, planes.mask)]
        axes.add_collection(LineCollection(rest, colors="0.6", lw=0.7, linestyles=[(0, (4, 2))]))
        positions = mesh.coordinates + scale*displacement[:, :2]
        for lines, colour, width in ((pieces.element_edges(mesh, positions, planes.chosen), "0.45", 0.35),
                                     (pieces.outlines(mesh, positions, planes.mask), "black", 1.0)):
            axes.add_collection(LineCollection([planes.place(line, plane) for line in lines], colors=colour, lw=width))
    factor = float(result.attributes_of("yield")["no_equilibrium_at"])
    return planes.finish(style.heading(result, options, ", ".join(
        one for one in (solids(options), f"what moves at the load factor {factor:.5g}, not to scale") if one)))
