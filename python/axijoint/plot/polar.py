"""Polar plots of the pressure in joints round the circle."""
import numpy as np

from ..joint_points import JointPoints
from ..table import Table
from . import joints, style
from .style import plt

# Heights and increments of a figure where the options do not say which
PLACES, CURVES = 3, 4


def _rows(interface, options):
    """Joint points at the places asked for, or at some along the interface."""
    _, place = interface.coordinate()
    if options.depths:
        return [int(interface.points[abs(place - depth).argmin()]) for depth in options.depths]
    order = np.argsort(place)[::-1]
    n = len(order)
    chosen = order[[n//2]] if n < PLACES else order[[n//6, n//2, n - 1 - n//6]]
    return [int(interface.points[k]) for k in chosen]


def _increments(result, options):
    """Increments to draw: those asked for, or some of those whose joints are kept."""
    if options.increments is not None:
        return list(options.increments)
    kept = result.history.increments_of("joints")
    largest = result.history.increment[result.history["largest_pressure"].argmax()]
    few = style.thinned(kept, CURVES)
    if largest in kept and largest not in few:
        few[1:-1][abs(few[1:-1] - largest).argmin()] = largest
    return few.tolist()


def pressure_round(result, points):
    """theta [degree] round the whole circle and pressure there, (points, angles)."""
    field = JointPoints(result).around()
    return field.theta, -field.sigma[:, points].T


@style.styled
def draw(result, options, interface):
    """Pressure round the circle at some places of an interface, a curve for each increment: a Figure."""
    units, rows = style.Units(result, options), _rows(interface, options)
    letter, _ = interface.coordinate()
    figure, axes = plt.subplots(1, len(rows), figsize=(max(3.4, style.TWO_COLUMNS*len(rows)/3), 3.2),
                                subplot_kw={"projection": "polar"}, squeeze=False)
    largest, pulled = 0.0, False
    for k, number in enumerate(_increments(result, options)):
        theta, pressure = pressure_round(result.at(number), rows)
        largest, pulled = max(largest, pressure.max()), pulled or pressure.min() < -1e-6*abs(pressure).max()
        pressure = np.maximum(pressure, 0)
        for one, values in zip(axes[0], pressure):
            closed = np.radians(np.append(theta, 360 + theta[0]))
            one.plot(closed, np.append(values, values[0]), label=f"increment {number}",
                     markevery=max(1, len(theta)//16), **(style.curve(k) | {"ms": 3}))
    for one, row in zip(axes[0], rows):
        place = interface.position[interface.points == row][0]
        value = place[0] if letter == "r" else place[1] if letter == "z" else \
            interface.distance[interface.points == row][0]
        one.set_title(units.of_length(f"${letter}$ = {value:.4g}").replace("[", "").replace("]", ""), pad=10)
        one.set_rlim(*(options.range or (0, 1.05*largest if largest > 0 else 1)))
        one.set_rlabel_position(112)
        one.yaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(3))
        one.set_xticks(np.radians(np.arange(0, 360, 45)))
        one.tick_params(axis="both", pad=-1, labelsize=6.5)
        one.grid(lw=0.4, color="0.85")
    style.legend(figure, "lower center", *axes[0, 0].get_legend_handles_labels(), ncols=4)
    figure.suptitle(options.title if options.title is not None else
                    f"Pressure (−σ) {units.label('', units.stress).strip()} in the joints: "
                    f"{joints.words(result, interface)}{'; 0 where they pull' if pulled else ''}", fontsize=8)
    return figure


def table(result, options):
    """A row for each interface, place, increment and angle."""
    parts = []
    for interface in joints.interfaces(result).values():
        rows = _rows(interface, options)
        for number in _increments(result, options):
            theta, pressure = pressure_round(result.at(number), rows)
            for row, values in zip(rows, pressure):
                n, (r, z) = len(theta), interface.position[interface.points == row][0]
                parts.append({"interface": np.full(n, interface.name), "increment": np.full(n, number),
                              "r": np.full(n, r), "z": np.full(n, z), "theta": theta, "pressure": values})
    return Table((name, np.concatenate([one[name] for one in parts])) for name in parts[0]) if parts else Table()
