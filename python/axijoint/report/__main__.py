"""Makes a page of HTML about a run.

Usage: python -m axijoint.report NAME|RESULT.h5... [-o FILE] [--no-figures] [--no-view] [--check]
"""
import argparse
import pathlib
import sys

from . import Failure, jobs_of, page, write
from .browser import check


def main(arguments=None):
    """Make and write the page; the exit code."""
    options = parsed(arguments)
    try:
        jobs = [job for word in options.words for job in jobs_of(word)]
        path = path_of(options)
        text = page(jobs, figures=not options.no_figures, views=not options.no_view)
        write(text, path)
    except Failure as failure:
        print(f"report: {failure}", file=sys.stderr)
        return 2
    except ImportError as error:
        print(f"report: {error}; or leave them out: --no-figures, --no-view", file=sys.stderr)
        return 5
    except OSError as error:
        print(f"report: {error}", file=sys.stderr)
        return 5
    print(path)
    if options.check:
        said, good = check(path)
        print(said, file=sys.stdout if good else sys.stderr)
        return 0 if good else 1
    return 0


def parsed(arguments):
    """Options of the command line."""
    parser = argparse.ArgumentParser(prog="report", description="Makes one page of HTML about a run of axijoint: "
                                     "summary, messages, figures, tables, deck.")
    parser.add_argument("words", nargs="+", metavar="NAME|RESULT.h5", help="name of results with their directory "
                        "(all combinations), or result files")
    parser.add_argument("-o", metavar="FILE", type=pathlib.Path, help="the page (default: NAME.html beside the results); "
                        "of a folder that is there: NAME.html in it")
    parser.add_argument("--no-figures", action="store_true", help="tables only; matplotlib is not needed")
    parser.add_argument("--no-view", action="store_true", help="no view in three dimensions, no JavaScript; plotly is not needed")
    parser.add_argument("--check", action="store_true", help="open the page in headless Chromium")
    return parser.parse_args(arguments)


def path_of(options):
    """Where the page goes: the file of -o, NAME.html in the folder of -o, or beside the results."""
    words = options.words
    if options.o and not options.o.is_dir():
        return options.o
    if len(words) > 1:
        raise Failure("several names; say with -o FILE where the page goes")
    path = options.o/pathlib.Path(words[0]).name if options.o else pathlib.Path(words[0])
    if path.suffix in (".h5", ".json", ".lis"):
        path = path.with_suffix("")
    return path.with_name(f"{path.name}.html")


if __name__ == "__main__":
    sys.exit(main())
