"""Figures of envelopes: factors of two load cases that joints can carry."""
from itertools import combinations

import numpy as np

from . import style
from .kinds import Kind, NothingToDraw
from .options import Options
from .style import plt

MECHANISM, NOT_FOUND, NO_END = 4, 3, 0


@style.styled
def draw_envelope(envelope, options=Options()):
    """Factors at the capacity, each pair of load cases in axes of its own."""
    ended = envelope.exit_codes == MECHANISM
    bounds = envelope.exit_codes == NOT_FOUND
    if len(envelope.cases) < 2 or not (ended | bounds).any():
        raise NothingToDraw("one load case, or loads without end in all directions")
    pairs = list(combinations(range(len(envelope.cases)), 2))
    figure, axes = plt.subplots(1, len(pairs), figsize=(0.8 + 3.2*len(pairs), 3.2), squeeze=False)
    factors = envelope.factors
    size = np.abs(factors[ended | bounds]).max()
    for one, (i, j) in zip(axes[0], pairs):
        if len(envelope.cases) == 2:
            # neighbours that end in a mechanism are joined
            neighbours = np.where((ended | bounds)[:, None], factors, np.nan)
            closed = np.vstack([neighbours, neighbours[:1]])
            whole = (np.abs(envelope.directions[0] - envelope.directions[-1]) < 1.5*np.abs(
                np.diff(envelope.directions, axis=0)).max()).all()
            one.plot(*(closed if whole else neighbours).T, **style.curve(0))
        one.plot(factors[ended, i], factors[ended, j], ls="", marker="o", ms=3, color="C0", label="mechanism")
        if bounds.any():
            one.plot(factors[bounds, i], factors[bounds, j], ls="", marker="^", ms=4, mfc="none", color="C1",
                     label="no equilibrium found beyond")
        for direction in envelope.directions[envelope.exit_codes == NO_END]:
            one.plot(*(np.outer([0.0, 1.1*size], direction[[i, j]])).T, color="0.6", lw=0.6, ls=":")
        if (envelope.exit_codes == NO_END).any():
            one.plot([], [], color="0.6", lw=0.6, ls=":", label="no end")
        one.set_xlabel(f"factor of case {envelope.cases[i]}")
        one.set_ylabel(f"factor of case {envelope.cases[j]}")
        one.set_aspect("equal")
        one.grid(True, lw=0.3)
    style.legend(figure, "lower center", *axes[0, 0].get_legend_handles_labels(), ncols=3)
    figure.suptitle(options.title or f"{envelope.path.name.removesuffix('.envelope.h5')}: what joints carry")
    return figure


def _draw(envelope, options):
    yield "envelope", draw_envelope(envelope, options)


KINDS = {"envelope": Kind("factors of two load cases that joints carry", _draw)}
