"""Figures of a result; they need matplotlib.

    from axijoint import plot
    for name, figure in plot.figures(result, ["mesh", "contours"]):
        plot.save(figure, f"out/{name}")

`python -m axijoint.plot RESULT.h5 [-o DIR] [KIND...]` writes them as PNG and SVG.
"""
import pathlib

try:
    import matplotlib  # noqa: F401
except ImportError as error:
    raise ImportError("axijoint.plot needs matplotlib: pip install matplotlib") from error

from . import curves, fields, joints, mesh
from .style import SETTINGS, plt

__all__ = ["KINDS", "figures", "save"]


def _mesh(result):
    yield "mesh", mesh.draw(result)


def _deformed(result):
    yield "deformed", fields.draw_deformed(result)


def _contours(result):
    for name in fields.quantities(result):
        yield f"contours_{name}", fields.draw_contours(result, name)


def _sections(result):
    for name, section in curves.sections(result).items():
        if len(section.point):
            yield name, curves.draw_section(result, section)


def _joints(result):
    for name, interface in joints.interfaces(result).items():
        yield name, joints.draw(result, interface)


def _convergence(result):
    figure = curves.draw_convergence(result)
    if figure is not None:
        yield "convergence", figure


def _spectrum(result):
    yield "spectrum", curves.draw_spectrum(result)


# Kinds of figures: what yields the names and figures of each
KINDS = {"mesh": _mesh, "deformed": _deformed, "contours": _contours, "sections": _sections,
         "joints": _joints, "convergence": _convergence, "spectrum": _spectrum}


def figures(result, kinds=None):
    """Yield name and matplotlib Figure of each figure of some kinds, or of all.

    A figure is closed when the next one is asked for. A linear job has no convergence path, a job
    without joints no joint map.
    """
    for kind in kinds or KINDS:
        if kind not in KINDS:
            raise ValueError(f"there is no kind {kind!r}; there are {', '.join(KINDS)}")
        for name, figure in KINDS[kind](result):
            yield name, figure
            plt.close(figure)


def save(figure, stem):
    """Write a figure as STEM.png and STEM.svg; returns both paths."""
    paths = [pathlib.Path(f"{stem}.{ending}") for ending in ("png", "svg")]
    with plt.rc_context(SETTINGS):
        for path in paths:
            figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)
            figure.set_layout_engine("none")  # placed now, once is enough
    return paths
