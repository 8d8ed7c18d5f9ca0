"""What the options of figures are, and which of them a kind of figure takes."""
from dataclasses import dataclass, fields
from typing import Optional, Sequence

# Options that all figures take
COMMON = ("title", "units", "style")


@dataclass(frozen=True)
class Options:
    """How figures are drawn; None leaves the choice to the figure.

    body, material  draw only this body, only this material (numbers of the deck)
    range           least and greatest value of the colours, or of the radius of polar plots
    angles          theta [degree]: of planes, curves, or the direction of forces and displacements; figures that have one
                    of them are drawn for each
    increments      numbers of the increments
    depths          heights z of curves by depth
    enlargement     displacements are drawn so many times larger
    title           in place of the figure's own
    units           names of the units of force, length and stress, or of force and length
    quantities      of studies: names of those to draw
    against         of studies: names of the columns to draw against
    style           path or name of a style sheet of matplotlib, put over that of the figures
    """
    body: Optional[int] = None
    material: Optional[int] = None
    range: Optional[Sequence[float]] = None
    angles: Optional[Sequence[float]] = None
    increments: Optional[Sequence[int]] = None
    depths: Optional[Sequence[float]] = None
    enlargement: Optional[float] = None
    title: Optional[str] = None
    units: Optional[Sequence[str]] = None
    style: Optional[str] = None
    quantities: Optional[Sequence[str]] = None
    against: Optional[Sequence[str]] = None

    def given(self):
        """Names of the options that are given and not common to all figures."""
        return [one.name for one in fields(self)
                if one.name not in COMMON and getattr(self, one.name) is not None]

    @property
    def angle(self):
        """The first angle; 0 without one."""
        return float(self.angles[0]) if self.angles else 0.0
