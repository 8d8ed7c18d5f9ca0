"""Prints what the joint solver needs: iterations, differences to the loops, time. See scripts/bench."""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

import h5py

ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..")
sys.path.insert(0, os.path.join(ROOT, "test", "decks"))
from hard_scenes import eccentric_disc, eccentric_exact, example

FACTORS = [0.01, 0.1, 1.0, 10.0, 100.0, 1000.0, 1e6]
PROPORTIONS = [10.0**k for k in range(-6, 7)]
LOOP_MOST = 20000  # iterations of the loops; what has not converged by then is shown as -


class Run:
    """A finished run: exit code, summary, arrays"""

    def __init__(self, program, deck):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "job.dat"), "w", encoding="ascii") as file:
                file.write(deck)
            done = subprocess.run([program, "run", "job.dat", "-o", "."], cwd=folder, check=False,
                                  capture_output=True, text=True)
            self.code = done.returncode
            self.summary = {}
            if not os.path.exists(os.path.join(folder, "job.json")):
                print(done.stderr)
                return
            with open(os.path.join(folder, "job.json"), encoding="utf-8") as file:
                self.summary = json.load(file)
            with h5py.File(os.path.join(folder, "job.h5")) as file:
                self.displacement = file["displacement"][()]
                self.stress = file["joints/stress"][()]
                self.coordinates = file["mesh/coordinates"][()]

    def differs(self, other):
        """Largest differences of displacements and joint stresses, over the largest of the other"""
        if self.code or other.code:
            return "        -        -"
        pairs = ((self.displacement, other.displacement), (self.stress, other.stress))
        return "".join(f" {abs(a - b).max()/abs(b).max():8.1e}" for a, b in pairs)

    def end(self):
        """How it ended, in words"""
        if self.code == 0:
            return ""
        return next((m for m in self.summary.get("messages", []) if "last equilibrium" in m
                     or "no equilibrium" in m), "no results")


def iterations(program):
    """The paper's cases with stiffer and softer joints, by Newton and by the loops"""
    print("Paper's cases, M = 8, 33 planes, tolerance 1E-10 (cases 1 and 2: bond law). Differences of "
          "displacement and\njoint stress over the largest; TRANSFER at 3 % and to 1E-10; - did not converge")
    print("case  stiffness exit iterations residual    TOTAL its   difference        "
          "TRANSFER 3 %       TRANSFER 1E-10")
    for number in (1, 2, 3):
        for factor in FACTORS:
            newton = Run(program, example(number, factor=factor))
            line = (f"{number:4} {factor:10g} {newton.code:4} {newton.summary.get('iterations', -1):10}"
                    f" {newton.summary.get('residual_ratio', -1):9.1e}")
            if factor <= 10.0:
                loops = [Run(program, example(number, factor=factor, method=method, tolerance=tolerance,
                                              most=LOOP_MOST))
                         for method, tolerance in (("TOTAL", 1e-10), ("TRANSFER", 0.03), ("TRANSFER", 1e-10))]
                line += f" {loops[0].summary['iterations']:9} "
                line += "  ".join(newton.differs(loop) if k == 0 else loop.differs(newton)
                                  for k, loop in enumerate(loops))
            print(line, newton.end(), flush=True)


def proportions(program):
    """Case 3 with k h / E from 1E-6 to 1E6"""
    print("\nCase 3, tolerance 1E-6\n k h / E exit iterations")
    for value in PROPORTIONS:
        run = Run(program, example(3, factor=value/0.125, tolerance=1e-6))
        print(f"{value:8.0e} {run.code:4} {run.summary['iterations']:10}", run.end(), flush=True)


def discs(program):
    """Eccentric disc: errors of rotation and largest pressure on three meshes"""
    print("\nDisc pressed at e/R: relative errors of rotation and largest pressure\n e/R elements planes"
          " iterations  rotation  pressure")
    for ratio in (0.1, 0.3, 0.5, 0.7, 0.9):
        rotation, _, pressure = eccentric_exact(ratio)
        for n, planes in ((8, 17), (16, 33), (32, 65), (64, 129)):
            run = Run(program, eccentric_disc(ratio, n=n, planes=planes))
            place = [k for k, (r, z) in enumerate(run.coordinates) if abs(r - 1) + abs(z) < 1e-9][-1]
            depth, tilt = -run.displacement[0, place, 1], abs(run.displacement[1, place, 1])
            print(f"{ratio:4} {n:8} {planes:6} {run.summary['iterations']:10} {tilt/rotation - 1:9.1e}"
                  f" {(depth + tilt)/pressure - 1:9.1e}", flush=True)


def times(program, runs):
    """Joint phase against the elastic phases, case 3 refined four times"""
    deck = example(3, refined=4, tolerance=1e-10)
    found = [Run(program, deck).summary for _ in range(runs)]
    seconds = [s["seconds"] for s in found]
    elastic = [s["assemble"] + s["factor"] for s in seconds]
    joints = [s["joints"] for s in seconds]
    ratios = [j/e for j, e in zip(joints, elastic)]
    print(f"\nCase 3 refined 4 times, M = 8, 33 planes, tolerance 1E-10: {found[0]['unknowns']} unknowns in all, "
          f"{found[0]['iterations']} iterations, {found[0]['status']}\n"
          f"median of {runs}: assembly and factorization {statistics.median(elastic):.3f} s, joints "
          f"{statistics.median(joints):.3f} s, joints / elastic {statistics.median(ratios):.2f} "
          f"({min(ratios):.2f} to {max(ratios):.2f}); all / elastic {1 + statistics.median(ratios):.2f}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--quick", action="store_true")
    args = parser.parse_args()
    times(args.program, 3 if args.quick else 9)
    discs(args.program)
    proportions(args.program)
    iterations(args.program)


if __name__ == "__main__":
    main()
