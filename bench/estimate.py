"""Predictions of `axijoint estimate` beside what runs took. See scripts/bench."""

import argparse
import csv
import json
import os
import re
import subprocess
import tempfile

# Name, inner and outer radius, height, elements of 9 nodes across and along, harmonics
DECKS = [("pile", 0.0, 0.5, 5.0, 6, 40, [0, 1]),
         ("ring", 1.0, 2.0, 1.0, 20, 20, [0, 2, 3, 4]),
         ("pipe", 1.0, 1.1, 20.0, 8, 600, [1, 2, 3]),
         ("footing", 0.0, 4.0, 4.0, 60, 60, [0, 1, 2, 3]),
         ("ground", 1.0, 2.0, 1.0, 150, 150, [2, 3])]
SOLVERS = ["band", "sparse"]
LIMIT = 60.0  # longer factorizations are left out [second]
MEMORY_BAR, TIME_BAR = 0.10, 0.30


def deck(inner, outer, height, across, along, harmonics):
    """A body held at its bottom, with tractions of all harmonics on its top."""
    lines = ["TITLE", "Estimate", "CONTROL", f"{max(harmonics):5}", "MATERIALS",
             f"{1:5}{1000.0:10.1f}{0.3:10.2f}", "BLOCKS", f"1,1,9,{across},{along}",
             f"{inner},0.0,{outer},{height}", "FACES", f"1,1,{inner},{height},{outer},{height}",
             f"2,1,{inner},0.0,{outer},0.0", "FIXEDFACES", "2,111", "TRACTIONS"]
    lines += [f"1,{m},0.1,1.0" for m in harmonics]
    return "\n".join(lines + ["END", ""])


def estimates(program, path):
    """Memory [MB] and time [s] of each solver."""
    text = subprocess.run([program, "estimate", path], capture_output=True, text=True, check=True,
                          env=os.environ | {"OMP_NUM_THREADS": "1"})
    found = {}
    for line in text.stdout.splitlines():
        row = re.match(r"\s+(BAND|SKYLINE|SPARSE)" + r"\s+(\S+)"*6, line)
        if row:
            found[row[1].lower()] = (int(row[2]), float(row[6]), float(row[7]))
    return found


def run(program, path, solver, folder):
    """Peak memory [MB] and time of the factorizations [s], the least of three runs."""
    best = None
    for _ in range(3):
        subprocess.run([program, "run", path, "--solver", solver, "--threads", "1", "-o", folder],
                       capture_output=True, check=True)
        name = os.path.splitext(os.path.basename(path))[0] + ".json"
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            summary = json.load(file)
        taken = (summary["peak_memory_mb"], summary["seconds"]["factor"])
        best = taken if best is None or taken[1] < best[1] else best
    return best


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--axijoint", required=True)
    parser.add_argument("-o", dest="output", required=True)
    args = parser.parse_args()
    rows = []
    print("deck     solver   equations   MB predicted measured ratio   s predicted measured ratio")
    with tempfile.TemporaryDirectory() as folder:
        for name, *body in DECKS:
            path = os.path.join(folder, name + ".dat")
            with open(path, "w", encoding="utf-8") as file:
                file.write(deck(*body))
            predicted = estimates(args.axijoint, path)
            for solver in SOLVERS:
                equations, memory, seconds = predicted[solver]
                if seconds > LIMIT:
                    print(f"{name:8} {solver:8} {equations:8}   left out: {seconds:.0f} s expected")
                    continue
                memory_run, seconds_run = run(args.axijoint, path, solver, folder)
                rows.append({"deck": name, "solver": solver, "equations": equations,
                             "predicted_mb": memory, "measured_mb": memory_run,
                             "predicted_s": seconds, "measured_s": seconds_run})
                print(f"{name:8} {solver:8} {equations:8}   {memory:12.1f} {memory_run:8.1f} "
                      f"{memory / memory_run:5.2f}   {seconds:11.4f} {seconds_run:8.4f} "
                      f"{seconds / seconds_run:5.2f}", flush=True)
    path = os.path.join(args.output, "estimate.csv")
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    memory = max(abs(r["predicted_mb"] / r["measured_mb"] - 1) for r in rows)
    seconds = max(abs(r["predicted_s"] / r["measured_s"] - 1) for r in rows)
    print(f"Largest difference: memory {100 * memory:.0f} % (bar {100 * MEMORY_BAR:.0f} %), "
          f"time {100 * seconds:.0f} % (bar {100 * TIME_BAR:.0f} %)")
    print(f"Written: {path}")


if __name__ == "__main__":
    main()
