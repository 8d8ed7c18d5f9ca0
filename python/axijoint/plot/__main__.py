"""Writes figures of results as PNG and SVG.

Usage: python -m axijoint.plot RESULT.h5... [-o DIR] [KIND...]
"""
import argparse
import pathlib
import sys

from .. import open as open_result
from . import KINDS, figures, save


def main(arguments=None):
    """Draw and write; the exit code."""
    parser = argparse.ArgumentParser(
        prog="plot", description="Writes figures of results of axijoint as PNG and SVG: NAME_FIGURE.png "
        "and .svg.", epilog="kinds: " + ", ".join(KINDS))
    parser.add_argument("words", nargs="+", metavar="RESULT.h5 | KIND",
                        help="result files, and kinds of figures (default: all)")
    parser.add_argument("-o", metavar="DIR", type=pathlib.Path, default=pathlib.Path("."),
                        help="directory of the figures (default: the current one)")
    options = parser.parse_intermixed_args(arguments)
    kinds = [word for word in options.words if word in KINDS]
    paths = [pathlib.Path(word) for word in options.words if word not in KINDS]
    missing = [path for path in paths if not path.is_file()]
    if missing or not paths:
        what = f"{missing[0]} is neither a file nor a kind of figure" if missing else "no result file"
        print(f"plot: {what}; kinds: {', '.join(KINDS)}", file=sys.stderr)
        return 2
    options.o.mkdir(parents=True, exist_ok=True)
    for path in paths:
        try:
            result = open_result(path)
        except (OSError, ValueError) as error:
            print(f"plot: {path}: {error}", file=sys.stderr)
            return 2
        for name, figure in figures(result, kinds):
            written = save(figure, options.o/f"{path.name.removesuffix('.h5')}_{name}")
            print(" ".join(str(one) for one in written))
    return 0


if __name__ == "__main__":
    sys.exit(main())
