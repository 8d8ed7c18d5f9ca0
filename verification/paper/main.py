"""Runs the paper's cases, draws its figures anew, and says which of its statements our runs show.

Usage: scripts/paper [-o DIR] [--check]
"""
import argparse
import html
import pathlib
import sys
import tempfile

from choices import all_choices, table
from figures import CAPTIONS, REFINED, all_figures
from runs import all_runs
from statements import all_statements

from axijoint import plot

HEAD = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>The paper's example</title><style>
body { font: 16px/1.45 sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; }
img { max-width: 100%; max-height: 30em; } figure { margin: 0 0 0.5em 0; } figcaption { font-weight: bold; }
td { vertical-align: top; padding: 0.15em 0.8em 0.15em 0; } .no { font-weight: bold; } .n { color: #444; }
</style></head><body>
<h1>The example of Kobori and Chikata (1985)</h1>
"""
FOOT = "</body></html>\n"


def main():
    """Run, draw, write the index, print the statements."""
    parser = argparse.ArgumentParser(prog="paper", description=__doc__.splitlines()[0])
    parser.add_argument("-o", metavar="DIR", type=pathlib.Path, help="directory of figures, index and results "
                        "(default: paper)")
    parser.add_argument("--check", action="store_true", help="print the statements only; write nothing, "
                        "unless -o is given")
    parser.add_argument("--program", required=True, help=argparse.SUPPRESS)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.o or pathlib.Path(scratch if options.check else "paper")
        results = folder/"results"
        results.mkdir(parents=True, exist_ok=True)
        runs = all_runs(options.program, results)
        statements = all_statements(runs)
        choices = list(all_choices(options.program, results))
        if not options.check:
            write(folder, runs, statements, choices)
    for one in statements:
        print(f"{mark(one):9}  {label(one)}{one.says}\n{'':11}{one.numbers}")
    missing = sum(not one.shown for one in statements)
    print("What the paper's choices leave, each alone and all together (largest pressure of joints, largest displacement):")
    print("\n".join(table(choices)))
    print(f"{len(statements) - missing} of {len(statements)} statements shown")
    if not options.check:
        print(f"figures: {folder/'index.html'}")
    return 1 if missing and options.check else 0


def mark(statement):
    """Whether a statement is shown, in words."""
    return "shown" if statement.shown else "NOT SHOWN"


def label(statement):
    """Figures of a statement, in words."""
    return f"Fig. {', '.join(map(str, statement.figures))}: " if statement.figures else ""


def write(folder, runs, statements, choices):
    """Figures, and the page that holds them."""
    page = [HEAD, "<p>The dimensions are not in the text of the paper; those of <code>inputs/case*.dat</code> were "
            f"chosen to fit its results. {REFINED} Whether a statement is shown is decided by the numbers of these "
            "runs.</p>\n"]
    for number, name, figure in all_figures(runs):
        plot.save(figure, folder/name)
        plot.plt.close(figure)
        page.append(f'<figure><a href="{name}.svg"><img src="{name}.png" alt="Fig. {number}"></a>'
                    f"<figcaption>Fig. {number}. {CAPTIONS[number]}</figcaption></figure>\n")
        page.append(rows(one for one in statements if number in one.figures))
    page += ["<h2>Without a figure</h2>\n", rows(one for one in statements if not one.figures),
             "<h2>What the paper's choices leave</h2>\n<p>Each alone and all together, beside the same job in equilibrium: "
             f"largest pressure of joints, largest displacement.</p>\n<pre>{html.escape(chr(10).join(table(choices)))}</pre>\n", FOOT]
    (folder/"index.html").write_text("".join(page), encoding="utf-8")


def rows(statements):
    """Statements as a table."""
    lines = [f'<tr><td class="{"yes" if one.shown else "no"}">{mark(one)}</td><td>{html.escape(one.says)}<br>'
             f'<span class="n">{html.escape(one.numbers)}</span></td></tr>\n' for one in statements]
    return f"<table>\n{''.join(lines)}</table>\n" if lines else ""


if __name__ == "__main__":
    sys.exit(main())
