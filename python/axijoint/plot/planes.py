"""Two meridional planes side by side: where a point of each is drawn."""
import numpy as np

from . import style
from .style import plt

# Walls thinner than this share of their height are drawn with r stretched
THIN = 1/12
# Bodies narrower than this share of their height have the planes' names beside the axis
NARROW = 1/4


class Planes:
    """Axes for the planes theta and theta + 180 degrees (to the left), of all or of some elements.

    angles     theta of both planes [degree]
    chosen     the elements drawn (index); everything a mask of them
    thin       a wall far from the axis: each plane has axes of its own, with r stretched
    narrow     a body so slender that names of planes would lie on one another above its halves
    figure
    """

    def __init__(self, result, options, extra=0.0, stretch=True):
        mesh = result.mesh
        self.units = style.Units(result, options)
        self.angles = (options.angle, (options.angle + 180) % 360)
        self.mask = result.chosen(options.body, options.material)
        self.chosen = np.flatnonzero(self.mask)
        self.nodes = np.unique(mesh.element_nodes[self.chosen])
        self.nodes = self.nodes[self.nodes >= 0]
        r, z = mesh.coordinates[self.nodes].T
        self.narrow = 2*r.max() < NARROW*np.ptp(z)
        self.thin = bool(stretch and np.ptp(r) < THIN*np.ptp(z) and r.min() > np.ptp(r))
        if self.thin:
            self.figure, (left, right) = plt.subplots(1, 2, figsize=(style.ONE_COLUMN + extra, 5.5), sharey=True)
            self._axes = {self.angles[0]: right, self.angles[1]: left}
        else:
            width = style.TWO_COLUMNS*0.78 if 2*r.max() > 0.8*np.ptp(z) else style.ONE_COLUMN
            height = min(8.5, (width - 0.8 - extra)*np.ptp(z)/(2*r.max())*1.05 + 1.0)
            self.figure, axes = plt.subplots(figsize=(width, max(height, 1.8)))
            self._axes = dict.fromkeys(self.angles, axes)

    @property
    def all_axes(self):
        """The axes, each once."""
        return list(dict.fromkeys(self._axes.values()))

    def axes(self, plane):
        """Axes of a plane."""
        return self._axes[plane]

    def place(self, points, plane):
        """Points (r, z) of a plane as drawn: the second one to the left."""
        return points*np.array([-1.0 if plane == self.angles[1] else 1.0, 1.0])

    def finish(self, title, notes=""):
        """Axes' names, planes' names, title."""
        for axes in self.all_axes:
            axes.autoscale_view()
            axes.set_xlabel(self.units.of_length("$r$"))
            axes.xaxis.set_major_formatter(lambda x, _: f"{abs(x):g}")
        first = self._axes[self.angles[1]]
        first.set_ylabel(self.units.of_length("$z$"))
        if self.thin:
            for plane, axes in self._axes.items():
                axes.xaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(2))
                axes.set_title(style.degrees(plane), fontsize=8)
            notes = "; ".join(one for one in (notes, "$r$ is stretched") if one)
        else:
            first.set_aspect("equal")
            first.xaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(7, steps=[1, 2, 2.5, 5, 10]))
            low, high = first.get_ylim()
            first.axvline(0, color="black", lw=0.6, ls=(0, (8, 2, 1, 2)))
            first.set_ylim(low, high)
            for plane, at, side in zip(self.angles, (0.75, 0.25), (1, -1)):
                if self.narrow:
                    first.annotate(style.degrees(plane), (0, 1.01), (4*side, 0), xycoords=first.get_xaxis_transform(),
                                   textcoords="offset points", ha="left" if side > 0 else "right", va="bottom")
                else:
                    first.text(at, 1.01, style.degrees(plane), transform=first.transAxes, ha="center", va="bottom")
        if self.thin and title:
            self.figure.suptitle(title)
        elif title:
            first.set_title(title, pad=16)
        if notes:
            self.figure.supxlabel(notes, fontsize=7, color="0.25")
        return self.figure


def solids(options):
    """The options' body and material in words."""
    return ", ".join(f"{name} {number}" for name, number in
                     (("body", options.body), ("material", options.material)) if number is not None)
