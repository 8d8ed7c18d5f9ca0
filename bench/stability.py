"""Runs the hard cases and prints a table with a verdict on each. See scripts/bench."""
import argparse
import csv
import pathlib
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[1:1] = [str(ROOT/"verification"), str(ROOT/"test"/"decks")]

# pylint: disable=wrong-import-position
import report
import stability_joints
import stability_limits
import stability_solids
from stability_case import FAILED, HEADINGS, VERDICTS, Runs, row

MANUAL = ROOT/"doc"/"verification.md"
BEGIN, END = "<!-- bench stability -->\n", "<!-- end of stability -->"
# Columns of the manual; the CSV file has all
SHOWN = [name for name in HEADINGS if name != "remark"]
# Numbers that differ from machine to machine where they are rounding
ROUNDED = ("worst error", "backward error", "residual ratio")


def manual_text(rows):
    """Table for the manual, and below it what there is to say about its rows"""
    table = report.table(SHOWN, [[shown(name, line) for name in SHOWN] for line in rows])
    remarks = [f"- **{line['case']}** ({line['verdict']}): {line['remark']}." for line in rows
               if line["verdict"] not in VERDICTS[:2]]
    return "\n".join([table, "", counted(rows), "", *remarks, *([""] if remarks else [])])


def shown(name, line):
    """A field in the manual: rounding as a power of ten above it, but what is beyond its bar as it is"""
    value = line[name]
    if name not in ROUNDED or value in ("–", "0"):
        return value
    if name == "worst error" and line["verdict"] not in VERDICTS[:2]:
        return value
    return report.rounding(float(value))


def counted(rows):
    """How many rows have each verdict"""
    found = [line["verdict"] for line in rows]
    return f"{len(rows)} rows: " + ", ".join(f"{found.count(word)} {word}" for word in VERDICTS) + "."


def rewrite_manual(rows):
    """Puts the table between its markers"""
    before, rest = MANUAL.read_text(encoding="utf-8").split(BEGIN)
    _, after = rest.split(END)
    MANUAL.write_text(f"{before}{BEGIN}\n{manual_text(rows)}\n{END}{after}", encoding="utf-8")


def arguments():
    """Command line"""
    parser = argparse.ArgumentParser(prog="scripts/bench stability", description=__doc__)
    parser.add_argument("--program", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--manual", action="store_true", help="rewrite the table of doc/verification.md")
    parser.add_argument("--only", default="", help="cases whose name has these words")
    parser.add_argument("-o", dest="output", type=pathlib.Path, required=True)
    args = parser.parse_args()
    if args.manual and args.only:
        parser.error("--manual needs all cases")
    return args


def main():
    """Run, print, write; exit code 1 if a row has FAILED"""
    args = arguments()
    everything = [*stability_solids.CASES, *stability_joints.CASES, *stability_limits.CASES]
    cases = [case for case in everything if args.only in case.name]
    rows = []
    with tempfile.TemporaryDirectory() as folder, \
            open(args.output/"stability.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, HEADINGS)
        writer.writeheader()
        for case in cases:
            line = row(case, Runs(args.program, folder))
            rows.append(line)
            writer.writerow(line)
            print(f"{line['verdict']:11} {line['case']:48.48} {line['range']:34.34} {line['worst error']:>8}"
                  f" {line['its bar']:>8} {line['iterations']:>9} {line['backward error']:>8}"
                  f" {line['residual ratio']:>8} {line['remark']}", flush=True)
    print(counted(rows))
    if args.manual:
        rewrite_manual(rows)
    return 1 if any(line["verdict"] == FAILED for line in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
