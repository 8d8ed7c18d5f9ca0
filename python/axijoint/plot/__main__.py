"""Writes figures of results as PNG and SVG, and tables of some as CSV."""
import argparse
import pathlib
import sys
from dataclasses import replace

from .. import open as open_result, open_envelope, open_study
from ..envelopes import ENVELOPE_ENDING
from ..history import NotKeptError
from ..studies import ENDING
from . import ENVELOPE_KINDS, FORMATS, KINDS, STUDY_KINDS, Options, figures, kinds_of, save, tables
from .style import plt

EVERY_FORMAT = ("png", "svg", "pdf")
# What opens a file of an ending, and its kinds of figures
SORTS = {ENDING: (open_study, STUDY_KINDS), ENVELOPE_ENDING: (open_envelope, ENVELOPE_KINDS), "": (open_result, KINDS)}


def numbers(of):
    """Reads numbers between commas: `1,3,5`; of integers, ranges, too: `1-5`."""
    def read(text):
        found = []
        try:
            for part in text.split(","):
                first, dash, last = part.strip().partition("-")
                if of is int and dash and first:
                    if int(last) < int(first):
                        raise argparse.ArgumentTypeError(f"the range {part.strip()} descends; write {last}-{first}")
                    found += range(int(first), int(last) + 1)
                else:
                    found.append(of(part))
        except ValueError as error:
            raise argparse.ArgumentTypeError(f"{text!r} is no list of numbers between commas, such as "
                                             + ("1,3-5" if of is int else "0,90")) from error
        return tuple(found)
    return read


def words(text):
    """Reads words between commas."""
    return tuple(word.strip() for word in text.split(","))


def listed(head, kinds):
    """Lines that tell of kinds."""
    return "\n".join([f"{head}:", *(f"  {name:<12} {kind.about}" for name, kind in kinds.items())])


def parser():
    """The parser of the command line."""
    one = argparse.ArgumentParser(
        prog="plot", formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Writes figures of results of axijoint, NAME_FIGURE.png and .svg, and tables of some, "
        "NAME_TABLE.csv.", epilog="\n\n".join((
            listed("kinds", KINDS), listed("kinds of studies, NAME.study.h5", STUDY_KINDS),
            listed("kinds of envelopes, NAME.envelope.h5", ENVELOPE_KINDS),
            "Lists are numbers between commas: 0,90; increments 1,3-5. A list or range that begins with a minus sign "
            "needs =: --depths=-2,-5.")))
    add = one.add_argument
    add("words", nargs="+", metavar="RESULT.h5 | KIND",
        help="files of results or studies, and kinds of figures (default: all)")
    add("-o", metavar="DIR", type=pathlib.Path, default=pathlib.Path("."),
        help="directory of the figures (default: the current one)")
    add("--body", type=int, metavar="N", help="only this body; the pile")
    add("--material", type=int, metavar="N", help="only this material")
    add("--range", type=numbers(float), metavar="A,B", help="least and greatest value of colours or radius")
    add("--angle", "--angles", dest="angles", type=numbers(float), metavar="A,...",
        help="theta of planes and curves, direction of forces and displacements [degree]")
    add("--increment", "--increments", dest="increments", type=numbers(int), metavar="N,...", help="increments")
    add("--depth", "--depths", dest="depths", type=numbers(float), metavar="Z,...",
        help="heights z of curves by depth (r on interfaces across z)")
    add("--enlargement", type=float, metavar="X", help="displacements are drawn so many times larger")
    add("--quantity", "--quantities", dest="quantities", type=words, metavar="NAME,...", help="quantities of studies")
    add("--against", type=words, metavar="COLUMN[,COLUMN]", help="columns of studies that quantities are drawn against")
    add("--title", metavar="TEXT", help="in place of the figures' titles")
    add("--units", type=words, metavar="FORCE,LENGTH[,STRESS]", help="names of units in labels")
    add("--format", type=words, default=FORMATS, metavar="png,svg,pdf",
        help="formats of the figures (default: png,svg)")
    add("--style", metavar="FILE", help="style sheet of matplotlib")
    return one


def fault_of(given, kinds, paths):
    """What is wrong with the command line, in words; None if nothing is."""
    missing = [path for path in paths if not path.is_file()]
    if missing or not paths:
        what = f"{missing[0]} is neither a file nor a kind of figure" if missing else "no result file"
        return f"{what}; kinds: {', '.join(KINDS)}; of studies: {', '.join(STUDY_KINDS)}; " \
            f"of envelopes: {', '.join(ENVELOPE_KINDS)}"
    first = {stem_of(path): path for path in reversed(paths)}
    double = [path for path in paths if first[stem_of(path)] is not path]
    if double:
        return f"{first[stem_of(double[0])]} and {double[0]} would have figures of the same names; draw them one after the other " \
            "with different -o"
    if len({sort_of(path) for path in paths}) > 1:
        return "results, studies and envelopes are drawn by commands of their own"
    _, known = SORTS[sort_of(paths[0])]
    strange = [kind for kind in kinds if kind not in known]
    if strange:
        return f"{paths[0]} has no figure of kind {strange[0]}; it has {', '.join(known)}"
    unknown = [name for name in given.format if name not in EVERY_FORMAT]
    if unknown:
        return f"there is no format {unknown[0]!r}; there are {', '.join(EVERY_FORMAT)}"
    if given.range and (len(given.range) != 2 or not given.range[0] < given.range[1]):
        return "--range wants two ascending numbers, as --range=-0.5,1"
    if given.units and len(given.units) not in (2, 3):
        return "--units wants force and length, or force, length and stress, as MN,m,MPa"
    if given.enlargement is not None and not given.enlargement > 0:
        return "--enlargement wants a positive number"
    if given.style and given.style not in plt.style.available and not pathlib.Path(given.style).is_file():
        return f"--style: there is no file {given.style}, and matplotlib has no such style"
    options = options_of(given)
    for name in options.given():
        heeding = [kind for kind, one in known.items() if name in one.takes]
        if not set(kinds or known) & set(heeding):
            return f"no kind of {', '.join(kinds or known)} heeds --{name}; " \
                f"those that do: {', '.join(heeding) or 'none'}"
    return None


def sort_of(path):
    """What a file is of, by its name: a place in SORTS."""
    return next((ending for ending in SORTS if path.name.endswith(ending)), "")


def stem_of(path):
    """How names of figures of a file begin."""
    return path.name.removesuffix(".h5")


def options_of(given):
    """Options of the command line."""
    return Options(given.body, given.material, given.range, given.angles, given.increments, given.depths,
                   given.enlargement, given.title, given.units, given.style, given.quantities, given.against)


def main(arguments=None):
    """Draw and write; the exit code."""
    given = parser().parse_intermixed_args(arguments)
    every = KINDS | STUDY_KINDS | ENVELOPE_KINDS
    kinds = [word for word in given.words if word in every]
    paths = [pathlib.Path(word) for word in given.words if word not in every]
    fault = fault_of(given, kinds, paths)
    if fault:
        print(f"plot: {fault}", file=sys.stderr)
        return 2
    try:
        given.o.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        print(f"plot: -o {given.o}: no directory can be made there: {error.strerror}", file=sys.stderr)
        return 2
    code = 0
    for path in paths:
        try:
            opened, _ = SORTS[sort_of(path)]
            result = opened(path)
            code = max(code, write(result, given.o/stem_of(path), kinds, given))
        except (OSError, ValueError) as error:
            print(f"plot: {path}: {error}", file=sys.stderr)
            return 2
    return code


def write(result, stem, kinds, given):
    """Write the figures and tables of a result, and say what is written; 1 if something is not kept, else 0."""
    options = options_of(given)
    for number in options.increments or ():
        result.at(number)  # nothing is written if there is none

    def missing(kind, reason):
        if kinds:
            print(f"plot: {result.path}: no figure of kind {kind}: {reason}", file=sys.stderr)
    written, code = set(), 0
    for name, table in tables(result, kinds, options):
        if name not in written:
            written.add(name)
            table.write_csv(f"{stem}_{name}.csv")
            print(f"{stem}_{name}.csv")
    for kind, chosen in each_of(result, kinds, options):
        try:
            for name, figure in figures(result, [kind], chosen, missing):
                print(" ".join(str(one) for one in save(figure, f"{stem}_{name}", given.format, options)))
        except NotKeptError as error:
            print(f"plot: {result.path}: {kind}: {error}", file=sys.stderr)
            code = 1
    return code


def each_of(result, kinds, options):
    """Kinds, and the options for one increment after another where each has figures of its own."""
    known = kinds_of(result)
    for kind in kinds or [name for name, one in known.items() if one.tells(result)]:
        if known[kind].each_increment and options.increments:
            for number in options.increments:
                yield kind, replace(options, increments=(number,))
        else:
            yield kind, options


if __name__ == "__main__":
    sys.exit(main())
