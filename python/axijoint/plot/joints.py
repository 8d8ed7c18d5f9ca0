"""Maps of the joints: state, stresses and gap over the interface and round the circle."""
import re

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from ..joint_points import JointPoints
from . import pieces, style
from .options import Options
from .style import plt

FACES = ("1.0", "0.75", "0.35")
HATCHES = ("", "////", "")
NAMES = ("stick", "slip", "open")


@style.styled
def draw(result, interface, options=Options()):
    """State, normal stress, shear stress, gap and slip of an interface against theta: a Figure."""
    units = style.Units(result, options)
    field, points = JointPoints(result).part(), interface.points
    theta = field.theta
    name, place = interface.coordinate()
    order = np.argsort(place)
    place = place[order]
    figure, axes = plt.subplots(1, 5, figsize=(style.TWO_COLUMNS, 3.3), sharey=True)
    shown = draw_state(axes[0], theta, place, field.state[:, points].T[order])
    _state_bar(figure.colorbar(shown, ax=axes[0], orientation="horizontal", aspect=12, pad=0.02))
    panels = ((field.sigma, units.of_stress("sigma")), (field.tau, units.label(r"$|\tau|$", units.stress)),
              (field.gap, units.of_length("gap")), (field.slip, units.of_length("slip")))
    for one, (values, label) in zip(axes[1:], panels):
        _map(figure, one, theta, place, values[:, points].T[order], label)
    for one in axes:
        axis_of_planes(one, theta)
    axes[0].set_ylabel(units.of_length(f"${name}$"))
    figure.suptitle(style.heading(result, options, words(result, interface)), x=0.01, ha="left", fontsize=8)
    return figure


def _map(figure, axes, theta, place, values, label):
    """Values over theta and the place as colours, with a bar below."""
    largest = max(abs(values).max(), 1e-300)
    limits = (values.min(), values.max()) if np.ptp(values) > 1e-9*largest else (0, largest)
    shown = axes.pcolormesh(theta, place, values, shading="nearest", rasterized=True,
                            vmin=limits[0], vmax=limits[1])
    if largest <= 1e-300:
        axes.text(0.5, 0.5, "0", transform=axes.transAxes, color="white", ha="center", va="center")
        shown.set_clim(0, 1)
    power = style.power_of(largest) if largest > 1e-300 else 0
    bar = figure.colorbar(shown, ax=axes, orientation="horizontal", label=style.with_power(label, power), aspect=12,
                          pad=0.02, format=lambda x, _: f"{x/10.0**power:.6g}")
    bar.locator = style.matplotlib.ticker.MaxNLocator(3)
    bar.outline.set_linewidth(0.5)
    bar.update_ticks()


def words(result, interface):
    """Name, law, faces and bodies of an interface, and which side stresses act on."""
    (body_a, body_b), (face_a, face_b) = interface.bodies, interface.faces
    name = interface.name or f"joints {_span(result.mesh.joint_label[interface.joints])}"
    side = f"face {face_a} of body {body_a} to face {face_b} of body {body_b}" if face_a and face_b \
        else f"body {body_a} to body {body_b}"
    return f"{name} (law {interface.law}), from {side}"


def _span(labels):
    return f"{labels.min()}–{labels.max()}" if len(labels) > 1 else str(labels[0])


def _state_bar(bar):
    """Names the states in place of numbers."""
    bar.set_ticks([0, 1, 2], labels=NAMES)
    bar.set_label("state")
    bar.ax.fill([0.5, 1.5, 1.5, 0.5], [0, 0, 1, 1], facecolor="none", edgecolor="0.2", lw=0,
                hatch=HATCHES[1], transform=bar.ax.get_xaxis_transform())
    bar.ax.tick_params(length=0)
    bar.outline.set_linewidth(0.5)


def axis_of_planes(axes, theta):
    """Ticks of the angle, in degrees."""
    axes.set_xlabel(r"$\theta$ [°]")
    axes.set_xticks(np.linspace(0, 360 if theta.max() > 181 else 180, 5))
    axes.set_xlim(theta.min(), theta.max())


def draw_state(axes, theta, place, state):
    """Stick, slip and open as white, hatched and dark cells; state has the shape (place, theta)."""
    colours = ListedColormap(FACES)
    shown = axes.pcolormesh(theta, place, state, cmap=colours, vmin=-0.5, vmax=2.5, shading="nearest",
                            edgecolor="0.6", lw=0.2)
    edges_x, edges_y = cell_edges(theta), cell_edges(place)
    for i, j in zip(*np.nonzero(state == 1)):
        axes.fill([edges_x[j], edges_x[j + 1], edges_x[j + 1], edges_x[j]],
                  [edges_y[i], edges_y[i], edges_y[i + 1], edges_y[i + 1]],
                  facecolor="none", edgecolor="0.2", lw=0, hatch=HATCHES[1])
    return shown


def cell_edges(middle):
    """Edges of cells around ascending values, half-way between them."""
    if len(middle) == 1:
        return np.array([middle[0] - 0.5, middle[0] + 0.5])
    inner = (middle[1:] + middle[:-1])/2
    return np.concatenate([[2*middle[0] - inner[0]], inner, [2*middle[-1] - inner[-1]]])


def state_handles():
    """Handles of a legend for the states."""
    return [Patch(facecolor=face, edgecolor="0.4", lw=0.5, hatch=hatch, label=name)
            for face, hatch, name in zip(FACES, HATCHES, NAMES)]


def interfaces(result):
    """Interfaces by the name of their figure: joints_NAME, joints_N of the Nth without a name."""
    chains = pieces.interfaces(result)
    if len(chains) == 1 and (not chains[0].name or chains[0].name == f"interface {chains[0].number}"):
        return {"joints": chains[0]}
    found = {}
    for k, one in enumerate(chains, 1):
        plain = not one.name or one.name == f"interface {one.number}"
        name = f"joints_{k}" if plain else "joints_" + re.sub(r"\W+", "_", one.name).strip("_")
        found[name if name not in found else f"{name}_{k}"] = one
    return found
