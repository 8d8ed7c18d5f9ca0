"""Predictions of `axijoint estimate` beside what runs took. See scripts/bench."""

import argparse
import csv
import json
import os
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "test", "decks"))
from hard_scenes import example

REPEATS = 5
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


# Inner and outer radius, height, elements of 9 nodes across and along, harmonics; two with joints
# that slip and open. No constant of `estimate` was fitted to any of them.
DECKS = {"shaft": deck(0.0, 0.4, 8.0, 10, 130, [0, 1, 2]),
         "tube": deck(0.9, 1.0, 40.0, 7, 800, [1, 2, 4]),
         "base": deck(0.0, 6.0, 3.0, 110, 55, [0, 1, 3]),
         "socket": example(3, refined=6, harmonic=5, planes=21),
         "stiff": example(1, refined=9, harmonic=6, planes=25, factor=10.0)}


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
    """Peak memory [MB], wall-clock and processor time of the factorizations [s], the least of all
    runs. On one thread both times are the same unless the machine does something else."""
    found = []
    for _ in range(REPEATS):
        subprocess.run([program, "run", path, "--solver", solver, "--threads", "1", "-o", folder],
                       capture_output=True, check=True)
        stem = os.path.join(folder, os.path.splitext(os.path.basename(path))[0])
        with open(stem + ".json", encoding="utf-8") as file:
            summary = json.load(file)
        with open(stem + ".lis", encoding="utf-8") as file:
            times = re.search(r"^  factor +(\S+) +(\S+)", file.read(), re.MULTILINE)
        found.append((summary["peak_memory_mb"], summary["seconds"]["factor"], float(times[2])))
    return tuple(map(min, zip(*found)))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--axijoint", required=True)
    parser.add_argument("-o", dest="output", required=True)
    args = parser.parse_args()
    rows = []
    print("deck     solver   equations   MB predicted measured ratio   s predicted   wall processor ratio")
    with tempfile.TemporaryDirectory() as folder:
        for name, text in DECKS.items():
            path = os.path.join(folder, name + ".dat")
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            predicted = estimates(args.axijoint, path)
            for solver in SOLVERS:
                equations, memory, seconds = predicted[solver]
                if seconds > LIMIT:
                    print(f"{name:8} {solver:8} {equations:8}   left out: {seconds:.0f} s expected")
                    continue
                memory_run, wall, processor = run(args.axijoint, path, solver, folder)
                rows.append({"deck": name, "solver": solver, "equations": equations,
                             "predicted_mb": memory, "measured_mb": memory_run,
                             "predicted_s": seconds, "measured_s": wall,
                             "measured_processor_s": processor})
                print(f"{name:8} {solver:8} {equations:8}   {memory:12.1f} {memory_run:8.1f} "
                      f"{memory / memory_run:5.2f}   {seconds:11.4f} {wall:8.4f} {processor:7.3f} "
                      f"{seconds / min(wall, processor or wall):5.2f}", flush=True)
    path = os.path.join(args.output, "estimate.csv")
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    memory = max(abs(r["predicted_mb"] / r["measured_mb"] - 1) for r in rows)
    seconds = max(abs(r["predicted_s"] / min(r["measured_s"], r["measured_processor_s"] or r["measured_s"])
                      - 1) for r in rows)
    print(f"Largest difference: memory {100 * memory:.0f} % (bar {100 * MEMORY_BAR:.0f} %), "
          f"time {100 * seconds:.0f} % (bar {100 * TIME_BAR:.0f} %)")
    print(f"Written: {path}")


if __name__ == "__main__":
    main()
