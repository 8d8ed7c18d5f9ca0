"""Tables of studies as text."""
from __future__ import annotations

import math
import numbers
from collections.abc import Mapping, Sequence
from typing import Any, Union

Cell = Union[float, int, str, None, Sequence[Any]]
Columns = Mapping[str, Union[Cell, Sequence[Cell]]]

# Integers below are written without a decimal point
EXACT = 1e15


def table_text(columns: Columns) -> str:
    """The text of a table from its columns.

    A column is a sequence with a cell for each line, or one cell that all lines have: a number, or a text. Within a
    sequence a cell may be a sequence itself: a list of values.
    """
    names = list(columns)
    if not names:
        raise ValueError("the table has no columns")
    found = {}
    for name in names:
        if not isinstance(name, str):
            raise TypeError(f"the column {name!r} is called by no text such as 'LAWS 1 PHI'")
        found[name] = _cells(columns[name])
    lengths = {name: len(cells) for name, cells in found.items() if isinstance(cells, list)}
    if len(set(lengths.values())) > 1:
        raise ValueError("columns differ in length: " + ", ".join(f"{name} {n}" for name, n in lengths.items()))
    lines = next(iter(lengths.values()), 1)
    rows = [", ".join(_text(name, cells[k] if isinstance(cells, list) else cells) for name, cells in found.items())
            for k in range(lines)]
    # a line of one empty cell would be a blank line, which is none of the table
    rows = [row if row.strip() else '""' for row in rows]
    return "\n".join([", ".join(_plain("head", name) for name in names), *rows, ""])


def _cells(column: Any) -> Any:
    """The cells of a column as a list; of one cell that all lines have, the cell."""
    if column is None or isinstance(column, (str, numbers.Real)):
        return column
    return column.tolist() if hasattr(column, "tolist") else list(column)


def _text(name: str, cell: Any) -> str:
    """A cell as a text."""
    if hasattr(cell, "item"):  # a number of NumPy
        cell = cell.item()
    if cell is None or isinstance(cell, str):
        return _plain(name, cell or "")
    if isinstance(cell, bool) or not isinstance(cell, (numbers.Real, Sequence)):
        raise TypeError(f"{name}: {cell!r} is neither a number nor a text nor a list of them")
    if isinstance(cell, Sequence):
        return "; ".join(_text(name, one) for one in cell)
    value = float(cell)
    if math.isnan(value):
        return ""
    return str(int(value)) if value.is_integer() and abs(value) < EXACT else repr(value)


def _plain(name: str, text: str) -> str:
    """A text that may stand in a cell."""
    if set(text) & set(",\n\r"):
        raise ValueError(f"{name}: {text!r} has a comma or an end of line")
    return text
