"""Envelopes: what loads joints can carry, direction by direction."""
from __future__ import annotations

import os
import pathlib

import h5py
import numpy as np

ENVELOPE_ENDING = ".envelope.h5"


class Envelope:
    """The results of `axijoint envelope`, NAME.envelope.h5; see doc/studies.md.

    path         the file
    cases        numbers of the load cases
    directions   unit vectors, (directions, cases)
    capacity     largest factor that equilibrium was found for, (directions)
    without      least factor at which none was found; 0 where there is no end
    exit_codes   4 a mechanism: the capacity; 3 a lower bound; 0 no end; (directions)
    factors      of the cases at the capacity, (directions, cases)
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = pathlib.Path(path)
        with h5py.File(self.path, "r") as file:
            if "capacity" not in file:
                raise ValueError(f"{path} is no file of an envelope")
            self.cases: np.ndarray = file["cases"][()]
            self.directions: np.ndarray = file["directions"][()]
            self.capacity: np.ndarray = file["capacity"][()]
            self.without: np.ndarray = file["without"][()]
            self.exit_codes: np.ndarray = file["exit_code"][()]

    def __repr__(self) -> str:
        return f"Envelope({str(self.path)!r}): {len(self.capacity)} directions of cases {self.cases.tolist()}"

    @property
    def factors(self) -> np.ndarray:
        """Factors of the load cases at the capacity, (directions, cases)."""
        return self.capacity[:, None]*self.directions


def open_envelope(path: str | os.PathLike[str]) -> Envelope:
    """Open NAME.envelope.h5."""
    return Envelope(path)
