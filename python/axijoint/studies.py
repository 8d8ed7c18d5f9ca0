"""Results of studies: many states of a deck."""
from __future__ import annotations

import csv
import os
import pathlib
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from .convert import needed
from .result import text_of
from .table import Table

if TYPE_CHECKING:
    import pandas
    import xarray

ENDING = ".study.h5"


class Rows(Table):
    """Rows of a study. Columns are found whatever the case of their names, as the program finds those of a table."""

    def __missing__(self, name: object) -> np.ndarray:
        own = self._own(name)
        if own is None:
            raise KeyError(f"there is no column {name!r}; there are {', '.join(self)}")
        return self[own]

    def __contains__(self, name: object) -> bool:
        return self._own(name) is not None

    def get(self, name: object, default: Any = None) -> Any:
        """A column, or what is given in its place if there is none."""
        return self[name] if name in self else default

    def where(self, mask: Any) -> Rows:
        """The rows for which a mask holds, or of a list of numbers of rows."""
        return Rows(super().where(mask))

    def _own(self, name: object) -> str | None:
        return next((own for own in self if own.upper() == str(name).upper()), None)


class Study:
    """The results of a study, NAME.study.h5 and NAME.study.csv beside it.

    Rows are those of the table, in its order; see doc/studies.md for what varies and what quantities there are.

    path         the file NAME.study.h5
    columns      names of what varies, such as "LAWS 1 PHI"
    quantities   names of the quantities
    rows         Table with a row each: row, what varies, exit_code, seconds, the quantities at the end of the
                 row's last increment (nan where there is no result), message (also of rows that end well: warnings
                 and remarks); capital and small letters of names are alike
    exit_codes   of the rows: 0 solved, 3 not converged, 4 mechanism, 2 wrong values, ...; (rows)
    increments   numbers of increments; (rows)
    solved       whether the exit code is 0; (rows)
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = pathlib.Path(path)
        self.folder: object = None  # a folder that lasts as long as this object, if the files lie in one
        with h5py.File(self.path, "r") as file:
            if "quantities" not in file.attrs:
                raise ValueError(f"{path} is no file of a study")
            self.columns = text_of(file.attrs["columns"]).splitlines()
            self.quantities = text_of(file.attrs["quantities"]).splitlines()
            self.exit_codes: np.ndarray = file["exit_code"][()]
            self.increments: np.ndarray = file["increments"][()]
        self.solved: np.ndarray = self.exit_codes == 0

    def __repr__(self) -> str:
        return f"Study({str(self.path)!r}): {len(self.exit_codes)} rows, {self.solved.sum()} solved"

    def read(self, name: str) -> np.ndarray:
        """A dataset as it is stored (C order)."""
        with h5py.File(self.path, "r") as file:
            return file[name][()]

    @cached_property
    def rows(self) -> Rows:
        """The rows as a Table."""
        with open(self.path.with_suffix(".csv"), encoding="utf-8", newline="") as file:
            cells = list(csv.DictReader(file))
        numbers = self.read("varied")
        found: dict[str, np.ndarray] = {"row": np.arange(1, len(cells) + 1)}
        for k, name in enumerate(self.columns):
            texts = [row[name] for row in cells]
            found[name] = numbers[:, k] if all(map(_is_number, texts)) else np.array(texts, object)
        found |= {"exit_code": self.exit_codes, "seconds": self.read("seconds")}
        found |= {name: self._last[:, k] for k, name in enumerate(self.quantities)}
        return Rows(found | {"message": np.array([row["message"] for row in cells], object)})

    @cached_property
    def _values(self) -> np.ndarray:
        return self.read("values")

    @cached_property
    def _last(self) -> np.ndarray:
        """Quantities at the end of each row, nan of rows without results, (rows, quantities)."""
        last = np.full((len(self.increments), len(self.quantities)), np.nan)
        there = np.flatnonzero(self.increments)
        last[there] = self._values[there, self.increments[there] - 1]
        return last

    def values(self, name: str) -> np.ndarray:
        """A quantity at the end of every increment, nan beyond those of a row: (rows, increments)."""
        return self._values[:, :, self._place(name)]

    def statistics(self) -> Table:
        """Of each quantity at the end of the rows with exit code 0: count, mean, standard deviation, ...

        A Table with the columns quantity and the statistics of doc/studies.md.
        """
        with h5py.File(self.path, "r") as file:
            names = text_of(file["statistics"].attrs["statistics"]).splitlines()
            values = file["statistics/values"][()]
        return Table({"quantity": np.array(self.quantities, object)}
                     | {name: values[:, k] for k, name in enumerate(names)})

    def confidence(self, name: str, statistic: Callable[[np.ndarray], float] = np.mean,
                   levels: Sequence[float] = (0.025, 0.975), replicates: int = 1000, seed: int = 1) -> np.ndarray:
        """Quantiles of any statistic of a quantity, by samples with replacement from the rows with exit code 0.

        statistic: takes an array of values, as numpy.std or lambda x: numpy.quantile(x, 0.95) do
        levels: probabilities; the default are the ends of the interval of 95 % confidence
        replicates: number of samples; seed: where the random numbers begin
        """
        values = self._last[self.solved, self._place(name)]
        if not len(values):
            raise ValueError("no row has exit code 0")
        random = np.random.default_rng(seed)
        found = [statistic(random.choice(values, len(values))) for _ in range(replicates)]
        return np.quantile(found, levels)

    def to_pandas(self) -> pandas.DataFrame:
        """The rows as a pandas.DataFrame."""
        return self.rows.to_pandas()

    def to_xarray(self) -> xarray.Dataset:
        """Quantities of all increments as an xarray.Dataset (row, increment); what varies are coordinates of rows."""
        xarray = needed("xarray", "Study.to_xarray")
        coords: dict[str, Any] = {"row": self.rows["row"], "increment": np.arange(1, self._values.shape[1] + 1)}
        coords |= {name: ("row", self.rows[name]) for name in self.columns}
        found: dict[str, Any] = {name: (("row", "increment"), self.values(name))
                                 for name in self.quantities if name != "increment"}
        found |= {name: ("row", self.rows[name]) for name in ("exit_code", "seconds", "message")}
        return xarray.Dataset(found | {"increments": ("row", self.increments)}, coords, {"study": str(self.path)})

    def _place(self, name: str) -> int:
        places = {own.upper(): k for k, own in enumerate(self.quantities)}
        if name.upper() not in places:
            raise ValueError(f"there is no quantity {name!r}; there are {', '.join(self.quantities)}")
        return places[name.upper()]


def open_study(path: str | os.PathLike[str]) -> Study:
    """Open the results of a study, NAME.study.h5: a Study."""
    return Study(path)


def _is_number(text: str) -> bool:
    """Whether a cell is blank or a number."""
    try:
        float(text or "0")
    except ValueError:
        return False
    return True
