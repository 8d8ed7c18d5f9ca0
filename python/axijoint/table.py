"""Tables: named columns of equal length."""
import csv

import numpy as np


class Table(dict):
    """A dictionary of columns (NumPy arrays of one length), in order.

    table["r"] is a column, len(table.column_names) their number, table.rows the length;
    table.where(mask) the rows for which a mask holds; table.to_pandas() a pandas.DataFrame.
    """

    @property
    def column_names(self):
        """Names of the columns."""
        return list(self)

    @property
    def rows(self):
        """Number of rows."""
        return len(next(iter(self.values()))) if self else 0

    def where(self, mask):
        """The rows for which a mask (array of logicals) holds, or of a list of numbers of rows."""
        return Table((name, column[mask]) for name, column in self.items())

    def copy(self):
        """A table of the same columns."""
        return type(self)(self)

    def to_pandas(self):
        """The same as a pandas.DataFrame; pandas must be installed."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("Table.to_pandas needs pandas: pip install pandas") from error
        return pandas.DataFrame(dict(self))

    def write_csv(self, path):
        """Write a file of comma-separated values: names of the columns, then the rows with all digits."""
        with open(path, "w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(self)
            writer.writerows(zip(*(getattr(column, "tolist", lambda c=column: c)() for column in self.values())))

    def __repr__(self):
        return f"Table of {self.rows} rows: {', '.join(self)}"


def joined(tables):
    """Tables of the same columns below one another."""
    return Table((name, np.concatenate([one[name] for one in tables])) for name in tables[0])
