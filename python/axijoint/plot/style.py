"""How figures look: sizes, line styles and maps that a grey print keeps apart, labels with units."""
import functools

import matplotlib
import numpy as np

from .. import units
from .options import Options

matplotlib.use("Agg", force=False)
import matplotlib.pyplot as plt  # noqa: E402

# Width of a figure across one and two columns of a page [inch]
ONE_COLUMN, TWO_COLUMNS = 3.5, 7.1
SETTINGS = {
    "figure.dpi": 100, "savefig.dpi": 300, "savefig.bbox": "tight", "savefig.pad_inches": 0.04,
    "figure.constrained_layout.use": True, "figure.facecolor": "white",
    "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans"], "mathtext.fontset": "dejavusans",
    "font.size": 8, "axes.titlesize": 8.5, "axes.labelsize": 8.5, "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5, "legend.fontsize": 7.5, "figure.titlesize": 9,
    "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.6,
    "xtick.major.width": 0.6, "ytick.major.width": 0.6, "xtick.direction": "out",
    "lines.linewidth": 1.2, "lines.markersize": 4, "legend.frameon": False, "hatch.linewidth": 0.5,
    "axes.prop_cycle": matplotlib.cycler(color=["black"]), "svg.hashsalt": "axijoint",
    "image.cmap": "cividis"}  # its lightness grows all the way: dark is small
# Curves: colour (dark to light), dashes, marker
CURVES = [("black", "-", "o"), ("0.45", "--", "s"), ("0.2", ":", "^"), ("0.55", "-.", "D"),
          ("0.3", (0, (5, 1, 1, 1, 1, 1)), "v"), ("0.6", "-", "x")]
SYMBOLS = {"sigma_r": r"\sigma_r", "sigma_z": r"\sigma_z", "sigma_theta": r"\sigma_\theta",
           "tau_rz": r"\tau_{rz}", "tau_rtheta": r"\tau_{r\theta}", "tau_ztheta": r"\tau_{z\theta}",
           "sigma": r"\sigma", "tau": r"\tau", "tau_xi": r"\tau_\xi", "tau_eta": r"\tau_\eta",
           "displacement": r"|u|"}


class Units(units.Units):
    """Units of a result, or those of options, as labels of axes."""

    def __init__(self, result, options=Options()):
        super().__init__(result.title, result.deck)
        if options.units:
            self.name(*options.units)

    def of_stress(self, name):
        """Label of a stress component."""
        return self.label(f"${SYMBOLS[name]}$", self.stress)


def settings(options=Options()):
    """The settings of figures, with the style sheet of the options over them."""
    return SETTINGS | (dict(matplotlib.rc_params_from_file(options.style, use_default_template=False))
                       if options.style and options.style not in plt.style.library
                       else dict(plt.style.library.get(options.style, {})))


def styled(draw):
    """Decorator: draw a figure with the settings of this module, and of Options among the arguments."""
    @functools.wraps(draw)
    def drawn(*arguments, **named):
        options = next((one for one in (*arguments, *named.values()) if isinstance(one, Options)), Options())
        with plt.rc_context(settings(options)):
            return draw(*arguments, **named)
    return drawn


def legend(figure, place, *handles, **named):
    """A legend outside the axes: "upper right", "lower center" or "right upper". Matplotlib 3.6 has no such places: there
    the axes leave room for it."""
    if matplotlib.__version_info__ >= (3, 7):
        figure.legend(*handles, loc=f"outside {place}", **named)
        return
    shown = figure.legend(*handles, loc={"right upper": "upper right"}.get(place, place), **named)
    box = shown.get_window_extent(figure.canvas.get_renderer()).transformed(figure.transFigure.inverted())
    width, height = min(0.5, 1.1*box.width), min(0.5, 1.1*box.height)
    rooms = {"upper right": (0.0, 0.0, 1.0, 1.0 - height), "lower center": (0.0, height, 1.0, 1.0 - height),
             "right upper": (0.0, 0.0, 1.0 - width, 1.0)}
    figure.get_layout_engine().set(rect=rooms[place])


def curve(k):
    """Colour, dashes and marker of curve k; a style sheet with colours of its own brings them."""
    colour, dashes, marker = CURVES[k % len(CURVES)]
    colours = plt.rcParams["axes.prop_cycle"].by_key().get("color", ["black"])
    if len(colours) > 1:
        colour = colours[k % len(colours)]
    return {"color": colour, "ls": dashes, "marker": marker,
            "markerfacecolor": "white" if k % 2 else colour, "markeredgewidth": 0.8}


def heading(result, options, words=""):
    """Title of a figure: that of the options, or some words, with the increment in jobs of several."""
    if options.title is not None:
        return options.title
    numbers = result.history.increment
    at = f"increment {result.increment} of {numbers[-1]}" if len(numbers) > 1 else ""
    return ", ".join(one for one in (words, at) if one)


def power_of(largest):
    """Power of ten, a multiple of three, that numbers on an axis are given in; 0 for those that need none."""
    if not 0 < largest < np.inf or 1e-2 < largest < 1e5:
        return 0
    return int(3*np.floor(np.log10(largest)/3 + 1e-9))


def with_power(label, power):
    """A label with a power of ten in front of its unit."""
    if not power:
        return label
    name, bracket, unit = label.rpartition("[")
    return rf"{name}[$10^{{{power}}}$ {unit}" if bracket else rf"{label} [$10^{{{power}}}$]"


def scaled(axes, which="xy"):
    """Powers of ten of the axes' numbers go into their labels, where they hide nothing."""
    for letter in which:
        axis = getattr(axes, f"{letter}axis")
        power = power_of(max(map(abs, getattr(axes, f"get_{letter}lim")())))
        axis.set_major_formatter(lambda x, _, power=power: f"{x/10.0**power:.6g}")
        axis.set_label_text(with_power(axis.get_label_text(), power))


def thinned(numbers, most):
    """At most so many of some numbers, the first and the last among them."""
    numbers = np.asarray(numbers)
    if len(numbers) <= most:
        return numbers
    return numbers[np.unique(np.linspace(0, len(numbers) - 1, most).round().astype(int))]


def direct_labels(axes, points, texts):
    """Names of curves in a column to the right of the axes, each with a thin line to a point of its curve.

    points: x and y of a point of each curve. The column is in the order of y, at distances that keep names apart.
    """
    low, high = axes.get_ylim()
    axes.set_ylim(low, high)
    height = axes.get_position().height*axes.figure.get_figheight()*72
    size = matplotlib.font_manager.FontProperties(size=plt.rcParams["legend.fontsize"]).get_size_in_points()
    step = 1.35*size/height
    share = (np.asarray([y for _, y in points]) - low)/(high - low)
    order = np.argsort(share, kind="stable")
    place = np.clip(share[order], 0, 1)
    for _ in range(200):  # push apart, keep within the axes
        gap = np.diff(place)
        short = np.flatnonzero(gap < step - 1e-9)
        if not len(short):
            break
        for k in short:
            middle = (place[k] + place[k + 1])/2
            place[k], place[k + 1] = middle - step/2, middle + step/2
        place += max(0, -place[0]) - max(0, place[-1] - 1)*(place[-1] - place[0] < 1)
    for k, y in zip(order, place):
        axes.annotate(texts[k], points[k], (1.05, y), textcoords=axes.transAxes, va="center", ha="left",
                      annotation_clip=False, fontsize=size,
                      arrowprops={"arrowstyle": "-", "lw": 0.4, "color": "0.5", "shrinkA": 1, "shrinkB": 2})


def round_down(value):
    """1, 2 or 5 times a power of ten, at most a positive value."""
    power = 10.0**np.floor(np.log10(value))
    return max(m for m in (1, 2, 5) if m*power <= value*(1 + 1e-12))*power


def levels(low, high, count=13):
    """Round levels that cover a range; None if nothing varies."""
    if not high > low or high - low <= 1e-9*max(abs(low), abs(high)):
        return None
    return matplotlib.ticker.MaxNLocator(count, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)


def degrees(theta):
    """An angle in words."""
    return rf"$\theta$ = {float(theta):g}°"
