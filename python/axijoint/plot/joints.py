"""Maps of the joints: state, stresses and gap over the interface and round the circle."""
import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from . import pieces, style
from .style import plt

FACES = ("1.0", "0.75", "0.35")
HATCHES = ("", "////", "")
NAMES = ("stick", "slip", "open")


@style.styled
def draw(result, interface):
    """State, normal stress, shear stress and gap of an interface against theta: a Figure."""
    units = style.Units(result)
    theta = np.degrees(result.read("joints/planes"))
    stress, jump, state = (result.read(f"joints/{name}")[:, interface.points]
                           for name in ("stress", "jump", "state"))
    name, place = interface.coordinate()
    order = np.argsort(place)
    place = place[order]
    figure, axes = plt.subplots(1, 4, figsize=(style.TWO_COLUMNS, 3.1), sharey=True)
    shown = draw_state(axes[0], theta, place, state.T[order])
    _state_bar(figure.colorbar(shown, ax=axes[0], orientation="horizontal", aspect=14, pad=0.02))
    shear = np.hypot(stress[..., 0], stress[..., 2])
    panels = ((stress[..., 1], units.of_stress("sigma")),
              (shear, units.label(r"$|\tau|$", units.stress)),
              (jump[..., 1], units.of_length("gap")))
    for one, (values, label) in zip(axes[1:], panels):
        largest = max(abs(values).max(), 1e-300)
        limits = (values.min(), values.max()) if np.ptp(values) > 1e-9*largest else (0, largest)
        shown = one.pcolormesh(theta, place, values.T[order], cmap=style.MAP, shading="nearest",
                               rasterized=True, vmin=limits[0], vmax=limits[1])
        if largest <= 1e-300:
            one.text(0.5, 0.5, "0", transform=one.transAxes, color="white", ha="center", va="center")
            shown.set_clim(0, 1)
        bar = figure.colorbar(shown, ax=one, orientation="horizontal", label=label, aspect=14, pad=0.02)
        bar.locator = style.matplotlib.ticker.MaxNLocator(3)
        bar.formatter.set_powerlimits((-3, 4))
        bar.outline.set_linewidth(0.5)
        bar.update_ticks()
    for one in axes:
        axis_of_planes(one, theta)
    axes[0].set_ylabel(units.of_length(f"${name}$"))
    return figure


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
    """Interfaces by the name of their figure."""
    found = pieces.interfaces(result)
    if len(found) == 1:
        return {"joints": found[0]}
    return {f"joints_{k}": one for k, one in enumerate(found, 1)}
