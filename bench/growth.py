"""How whole runs grow: with unknowns, with harmonics, with joint points. Processor seconds, memory, phases and exponents; bars
on these. See scripts/bench."""
import argparse
import json
import math
import os
import re
import subprocess
import sys
import tempfile

import estimate_decks
import whole

HERE = os.path.dirname(os.path.realpath(__file__))
RUN_BAR, MEMORY_BAR = 1.5, 1.15            # powers of the unknowns
HARMONICS_BAR, SUMS_BAR, FROM = 1.1, 1.2, 8  # powers of M, from this M on
DENSE_BAR = 0.02                           # share of a run that dense steps may take which grow as the cube of the joint points
LEAST_SECONDS, LEAST_MIB = 0.02, 1.0       # less is the start of the program, and tells no exponent
SHORT, LONG = 2.0, 20.0                    # seconds below which a run is done thrice (--quick: twice), and above which once
DENSE_ORDER = 0.25                         # dense steps are of at least so many times the unknowns of the joint points
PRODUCTS = ("dgemv_", "ssymv_")            # products of matrices and vectors: squares, not cubes
ROW = "MATERIALS 1 E\n"                    # a study of one row, of the value that the deck has
COLUMNS = ("processor", "MiB", *whole.PHASES, "estimates", "iteration")
TAIL = 2000                                # bytes at the end of a listing in which the times stand
TIMES = re.compile(r"^  (%s) +\S+ +(\S+) +\S+$" % "|".join(whole.PHASES), re.MULTILINE)


class Measured:
    """What a run took: least processor seconds of some, with the memory and phases of that one; or why it took nothing"""

    def __init__(self, args, text, folder, size, label, options=(), study=None):
        self.size, self.label, self.values, self.why = size, label, {}, ""
        self.unknowns, self.iterations, self.solver = "", "", ""
        deck = os.path.join(folder, "job.dat")
        with open(deck, "w", encoding="utf-8") as file:
            file.write(text)
        words = [args.axijoint, "run", deck, "-o", folder, "--quiet", *options]
        if study:
            with open(os.path.join(folder, "rows.csv"), "w", encoding="utf-8") as file:
                file.write(study)
            words = [args.axijoint, "study", os.path.join(folder, "rows.csv"), deck, "-o", folder, "--quiet"]
        done, most = 0, 1
        while done < most:
            for name in ("job.json", "rows.study.csv", "rows.study.rows", "rows.study.h5"):
                if os.path.exists(os.path.join(folder, name)):
                    os.remove(os.path.join(folder, name))
            seconds, mib, code, said = spent(words, folder)
            if code:
                self.why = f"exit code {code}: {said}"
                return
            if not self.values or seconds < self.values["processor"]:
                self.values = {"processor": seconds, "MiB": mib}
                if not study:
                    self.read(os.path.join(folder, "job"))
            done += 1
            most = 1 if seconds > LONG else 2 if seconds > SHORT or args.quick else 3

    def read(self, path):
        """What the summary and the times of the listing say; estimates, which are in joints and recover, have seconds of the clock:
        they are taken to wait as much as these phases do"""
        with open(path + ".json", encoding="utf-8") as file:
            summary = json.load(file)
        with open(path + ".lis", "rb") as file:
            file.seek(max(0, os.path.getsize(file.name) - TAIL))
            self.values |= {name: float(seconds) for name, seconds in TIMES.findall(file.read().decode())}
        self.unknowns, self.iterations, self.solver = summary["unknowns"], summary["iterations"], summary["solver"]
        clock = summary["seconds"]["joints"] + summary["seconds"]["recover"]
        worked = self.values["joints"] + self.values["recover"]
        self.values["estimates"] = sum(summary["error_seconds"].values())*worked/clock
        if self.iterations:
            self.values["iteration"] = (worked - self.values["estimates"])/self.iterations


def spent(words, folder):
    """Processor seconds and MiB at the peak of a command, its exit code, and the first line of what it says; by measured.py"""
    said = os.path.join(folder, "said")
    found = subprocess.run([sys.executable, "-S", "-E", os.path.join(HERE, "measured.py"), said, *words], capture_output=True,
                           text=True, check=True)
    cost = json.loads(found.stdout)
    with open(said, encoding="utf-8", errors="replace") as file:
        lines = [line.strip() for line in file if line.strip()]
    return cost["processor"], cost["memory"], cost["exit_code"], lines[0][:150] if lines else ""


def exponent(rows, column):
    """Least squares of logarithms over some rows; none if one is too small to tell"""
    least = LEAST_MIB if column == "MiB" else LEAST_SECONDS
    if column == "iteration":
        least /= 20
    pairs = [(math.log(row.size), math.log(row.values[column])) for row in rows if row.values.get(column, 0.0) >= least]
    if len(pairs) < max(2, len(rows)):
        return None
    x, y = (sum(column)/len(pairs) for column in zip(*pairs))
    return sum((a - x)*(b - y) for a, b in pairs)/sum((a - x)**2 for a, _ in pairs)


def table(title, what, rows):
    """Print rows as they come, then the exponents between neighbours and of the whole range; give the rows that ended"""
    print(f"\n{title}")
    print(f"{what:>16} {'unknowns':>9} {'solver':>7} {'iterations':>10} " + " ".join(f"{name:>9}" for name in COLUMNS), flush=True)
    ended = []
    for row in rows:
        head = f"{row.label:>16} {row.unknowns:>9} {row.solver:>7} {row.iterations:>10} "
        if row.why:
            print(head + row.why, flush=True)
            continue
        ended.append(row)
        print(head + " ".join(f"{row.values[name]:9.{1 if name == 'MiB' else 4 if name == 'solved' else 3}f}" if name in row.values
                              else f"{'-':>9}" for name in COLUMNS), flush=True)
    for before, after in zip(ended, ended[1:]):
        print(exponents(f"{before.label} - {after.label}", [before, after]))
    print(exponents("exponent of all", ended), flush=True)
    return ended


def exponents(label, rows):
    """A line of exponents"""
    found = [exponent(rows, name) for name in COLUMNS]
    return f"{label:>45} " + " ".join(f"{'-':>9}" if value is None else f"{value:9.2f}" for value in found)


class Verdicts:
    """Bars that were held or missed"""

    def __init__(self):
        self.lines, self.missed = [], 0

    def judge(self, what, rows, column, bar):
        """Hold the exponent of all rows, and that of the three largest, against a bar: the start of the program makes the former
        less"""
        values = [value for value in (exponent(rows, column), exponent(rows[-3:], column)) if value is not None]
        if len(rows) < 3 or not values:
            self.note(f"{what}: not known", False)
        else:
            self.note(f"{what}: {max(values):.2f} (bar {bar:g})", max(values) <= bar)

    def note(self, line, held):
        """A line, and whether it is as it should be"""
        self.missed += not held
        self.lines.append(f"{'held  ' if held else 'MISSED'}  {line}")

    def say(self):
        """All lines"""
        print("\nVerdicts\n" + "\n".join(self.lines))


def grown(args, folder, verdicts):
    """Linear jobs of eight harmonics"""
    sides = [(30, 37), (42, 53), (60, 75)]
    if not args.quick:
        sides += [(85, 105), (120, 148)]
    if args.full:
        sides += [(170, 210), (260, 320)]
    for estimates in (True, False):
        rows = table(f"Unknowns of a harmonic: linear jobs of eight harmonics, {'with' if estimates else 'without'} estimates of errors",
                     "of a harmonic", (linear(args, folder, side, estimates) for side in sides))
        said = "unknowns, with estimates" if estimates else "unknowns, without"
        verdicts.judge(f"{said}: seconds of the run", rows, "processor", RUN_BAR)
        verdicts.judge(f"{said}: memory", rows, "MiB", MEMORY_BAR)


def linear(args, folder, side, estimates):
    """A linear job of so many elements along each side"""
    across, along = side
    nodes = (2*across + 1)*(2*along + 1) - across*along
    text = estimate_decks.solid(0.0, 3.0, 4.0, across, along, list(range(8)), nodes=8)
    return Measured(args, text, folder, 3*nodes, f"{3*nodes}", study=None if estimates else ROW + "1000.0\n")


def of_harmonics(args, folder, verdicts):
    """Harmonics at a fixed mesh"""
    highest = [1, 2, 4, 8, 16, 32] + ([] if args.quick else [64, 128]) + ([256] if args.full else [])
    planes = {"case 3 twice as fine, 4 M + 1 planes": whole.case3(2),
              "monopile, eight increments, 4 M + 1 planes": estimate_decks.inputs("monopile")}
    jobs = {"linear job, all harmonics loaded": lambda m: estimate_decks.solid(0.0, 3.0, 4.0, 20, 25, list(range(m + 1)), nodes=8)}
    jobs |= {title: lambda m, text=text: estimate_decks.with_harmonics(text, m, 4*m + 1) for title, text in planes.items()}
    for title, make in jobs.items():
        rows = table(f"Harmonics 0 to M: {title}", "M", (Measured(args, make(m), folder, m, f"M = {m}") for m in highest))
        rows = [row for row in rows if row.size >= FROM]
        verdicts.judge(f"harmonics, {title.split(',')[0]}: seconds of the run from M = {FROM} on", rows, "processor", HARMONICS_BAR)
        if title in planes:
            verdicts.judge(f"harmonics, {title.split(',')[0]}: seconds of joints an iteration without estimates", rows, "iteration",
                           SUMS_BAR)


def along(args, folder, verdicts):
    """Joint points, the mesh refined along the joint alone"""
    sizes = [4, 13, 40, 133] + ([] if args.quick else [400]) + ([800, 1667] if args.full else [])
    narrow, wide, sparse = (2, 3), (8, 12), ("--solver", "sparse")
    jobs = {"narrow bodies, solver by itself": (narrow, (), 1667), "narrow bodies, sparse solver": (narrow, sparse, 800)}
    if not args.quick:
        jobs["wide bodies, solver by itself"] = (wide, (), 400)
    if args.full:
        jobs["wide bodies, sparse solver"] = (wide, sparse, 400)
    for title, (across, options, most) in jobs.items():
        here = [n for n in sizes if n <= most]
        rows = table(f"Joint points: {title}, {sum(across)} elements across, harmonics 0 to 2", "joint points",
                     (Measured(args, estimate_decks.long_joint(across, n), folder, 3*n, str(3*n), options) for n in here))
        verdicts.judge(f"joint points, {title}: seconds of the run", rows, "processor", RUN_BAR)
        if rows:
            share(args, folder, title, rows[-1], estimate_decks.long_joint(across, rows[-1].size//3), options, verdicts)


def share(args, folder, title, row, text, options, verdicts):
    """What of the processor seconds are dense steps whose order grows with the joint points, by calls that are timed"""
    shim, told, deck = (os.path.join(folder, name) for name in ("dense_calls.so", "dense.txt", "job.dat"))
    if not os.path.exists(shim):
        subprocess.run(["gcc", "-O2", "-shared", "-fPIC", "-o", shim, os.path.join(HERE, "preload", "dense_calls.c"), "-ldl"], check=True)
    with open(deck, "w", encoding="utf-8") as file:
        file.write(text)
    seconds, _, code, said = spent(["env", f"LD_PRELOAD={shim}", f"DENSE_CALLS={told}", args.shared, "run", deck, "-o", folder,
                                    "--quiet", *options], folder)
    if code:
        verdicts.note(f"joint points, {title}: share of dense steps not known, exit code {code}: {said}", False)
        return
    with open(told, encoding="utf-8") as file:
        calls = [(name, int(order), int(count), float(time)) for name, order, count, time in map(str.split, file)]
    if not calls:
        verdicts.note(f"joint points, {title}: share of dense steps not known, no calls were seen", False)
        return
    calls.sort(key=lambda call: -call[3])
    print(f"  routines of BLAS and LAPACK at {row.label} joint points, {seconds:.1f} s: " + ", ".join(
        f"{name.strip('_')} of order {order} and more {100*time/seconds:.1f} %" for name, order, _, time in calls[:6]))
    cubic = sum(time for name, order, _, time in calls if name not in PRODUCTS and order >= DENSE_ORDER*3*row.size)
    verdicts.note(f"joint points, {title}: dense cubic steps {100*cubic/seconds:.1f} % of the run at {row.label} points "
                  f"(bar {100*DENSE_BAR:g} %)", cubic <= DENSE_BAR*seconds)


def main():
    """Bars, tables, verdicts; exit code 1 if a bar is missed"""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--axijoint", required=True)
    parser.add_argument("--shared", required=True, help="the same program with a shared BLAS, whose calls are looked at")
    parser.add_argument("--quick", action="store_true", help="small sizes")
    parser.add_argument("--full", action="store_true", help="largest sizes, too")
    parser.add_argument("--only", default="", help="parts whose names contain this: unknowns, harmonics, points")
    args = parser.parse_args()
    os.environ["OMP_NUM_THREADS"] = "1"
    whole.head()
    print(f"Bars, exponents of all sizes and of the three largest: unknowns: run {RUN_BAR:g}, memory {MEMORY_BAR:g}; harmonics from "
          f"M = {FROM} on: run {HARMONICS_BAR:g},\n  joints an iteration without estimates {SUMS_BAR:g}; joint points: run {RUN_BAR:g}, "
          f"no dense step that grows as their cube above {100*DENSE_BAR:g} % of the run\n"
          "Theory: factorization n^1.5, entries of factors n log n, all else n; sums on planes M log M\n"
          "Processor seconds of one thread: of the whole process, least of a few; of its phases; of its estimates, which are part of "
          "joints and recover;\n  of joints and recover without estimates by the iteration")
    verdicts = Verdicts()
    with tempfile.TemporaryDirectory(prefix="axijoint-growth-") as folder:
        for name, part in {"unknowns": grown, "harmonics": of_harmonics, "points": along}.items():
            if args.only in name:
                part(args, folder, verdicts)
    verdicts.say()
    print(f"{verdicts.missed} missed")
    return verdicts.missed > 0


if __name__ == "__main__":
    sys.exit(main())
