"""Figures of a result; they need matplotlib.

    from axijoint import plot
    for name, figure in plot.figures(result, ["mesh", "contours"], plot.Options(body=1)):
        plot.save(figure, f"out/{name}")

`python -m axijoint.plot RESULT.h5 [-o DIR] [KIND...]` writes them as PNG and SVG, and tables of some as CSV.
"""
import pathlib
from dataclasses import replace

try:
    import matplotlib  # noqa: F401
except ImportError as error:
    raise ImportError("axijoint.plot needs matplotlib: pip install matplotlib") from error

from ..envelopes import Envelope
from ..studies import Study
from ..table import joined
from . import envelope, states
from .kinds import KINDS, NothingToDraw
from .options import Options
from .style import SETTINGS, plt, settings

__all__ = ["ENVELOPE_KINDS", "FORMATS", "KINDS", "SETTINGS", "STUDY_KINDS", "NothingToDraw", "Options", "figures",
           "kinds_of", "plt", "save", "tables"]

FORMATS = ("png", "svg")
# Kinds of figures of studies, and of envelopes
STUDY_KINDS, ENVELOPE_KINDS = states.KINDS, envelope.KINDS


def kinds_of(result):
    """The kinds of figures that there are of a Result, a Study, or an Envelope."""
    if isinstance(result, Envelope):
        return ENVELOPE_KINDS
    return STUDY_KINDS if isinstance(result, Study) else KINDS


def figures(result, kinds=None, options=Options(), missing=None):
    """Yield name and matplotlib Figure of each figure of some kinds, or of all that tell something.

    result: a Result; a Study, which has the kinds of STUDY_KINDS; an Envelope, which has those of ENVELOPE_KINDS

    A figure is closed when the next one is asked for. missing: called with the kind and the reason for kinds that
    there is nothing to draw of, such as the convergence path of a linear job.
    """
    for kind, view, chosen, suffix in _drawn(result, kinds, options):
        try:
            for name, figure in kinds_of(result)[kind].draw(view, chosen):
                yield name + suffix, figure
                plt.close(figure)
        except NothingToDraw as reason:
            if missing:
                missing(kind, str(reason))


def tables(result, kinds=None, options=Options()):
    """Yield name and Table of what is drawn, of the kinds that have tables; rows of several angles below one another."""
    known = kinds_of(result)
    for kind in _known(kinds, known) or known:
        if known[kind].tables and (kinds or known[kind].tells(result)):
            try:
                found = [dict(known[kind].tables(result, chosen)) for chosen, _ in _by_angle(known[kind], options)]
            except NothingToDraw:
                continue
            yield from ((name, joined([one[name] for one in found])) for name in found[0])


def _drawn(result, kinds, options):
    """Kinds, the view of the increment that each is drawn of, its options, and what these add to the name."""
    known = kinds_of(result)
    for kind in _known(kinds, known) or known:
        if not kinds and not known[kind].tells(result):
            continue
        views = [(result, "")]
        if known[kind].each_increment and options.increments is not None:
            views = [(result.at(number), f"_increment_{number}") for number in options.increments]
        for view, of in views:
            for chosen, at in _by_angle(known[kind], options):
                yield kind, view, chosen, of + at


def _by_angle(kind, options):
    """Options, and what they add to the name, for one angle after another where a kind has figures of one alone."""
    if not kind.each_angle or len(options.angles or ()) < 2:
        return [(options, "")]
    return [(replace(options, angles=(angle,)), f"_theta_{angle:g}") for angle in options.angles]


def _known(kinds, known):
    for kind in kinds or ():
        if kind not in known:
            raise ValueError(f"there is no kind {kind!r}; there are {', '.join(known)}")
    return kinds


def save(figure, stem, formats=FORMATS, options=Options()):
    """Write a figure as STEM.png and STEM.svg, or in other formats; returns the paths."""
    paths = [pathlib.Path(f"{stem}.{ending}") for ending in formats]
    with plt.rc_context(settings(options)):
        for path in paths:
            figure.savefig(path, metadata={"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(path.suffix[1:]))
            figure.set_layout_engine("none")  # placed now, once is enough
    return paths
