"""How figures look: sizes, line styles and maps that a grey print keeps apart, labels with units."""
import matplotlib
import numpy as np

from .. import units

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
    "axes.prop_cycle": matplotlib.cycler(color=["black"]), "svg.hashsalt": "axijoint"}
# A map whose lightness grows all the way: dark is small
MAP = "cividis"
# Curves: colour (dark to light), dashes, marker
CURVES = [("black", "-", "o"), ("0.45", "--", "s"), ("0.2", ":", "^"), ("0.55", "-.", "D"),
          ("0.3", (0, (5, 1, 1, 1, 1, 1)), "v"), ("0.6", "-", "x")]
SYMBOLS = {"sigma_r": r"\sigma_r", "sigma_z": r"\sigma_z", "sigma_theta": r"\sigma_\theta",
           "tau_rz": r"\tau_{rz}", "tau_rtheta": r"\tau_{r\theta}", "tau_ztheta": r"\tau_{z\theta}",
           "sigma": r"\sigma", "tau": r"\tau", "tau_xi": r"\tau_\xi", "tau_eta": r"\tau_\eta",
           "displacement": r"|u|"}


class Units(units.Units):
    """Units of a result, as labels of axes."""

    def __init__(self, result):
        super().__init__(result.title, result.deck)

    def of_stress(self, name):
        """Label of a stress component."""
        return self.label(f"${SYMBOLS[name]}$", self.stress)


def styled(draw):
    """Decorator: draw a figure with the settings of this module."""
    def drawn(*arguments, **options):
        with plt.rc_context(SETTINGS):
            return draw(*arguments, **options)
    drawn.__doc__, drawn.__name__ = draw.__doc__, draw.__name__
    return drawn


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
