"""Prints what the joint solver needs: iterations, differences to the loops, time. See scripts/bench."""

import argparse
import json
import math
import os
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
            if factor <= 100.0:
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


def disc_errors(program, ratio, n, planes, young=1e7):
    """Iterations, relative errors of rotation and largest pressure of a disc pressed at e/R"""
    rotation, _, pressure = eccentric_exact(ratio)
    run = Run(program, eccentric_disc(ratio, n=n, planes=planes, young=young))
    place = [k for k, (r, z) in enumerate(run.coordinates) if abs(r - 1) + abs(z) < 1e-9][-1]
    depth, tilt = -run.displacement[0, place, 1], abs(run.displacement[1, place, 1])
    return run.summary["iterations"], tilt/rotation - 1, (depth + tilt)/pressure - 1


def discs(program):
    """Eccentric disc: errors of rotation and largest pressure on several meshes, and their orders"""
    print("\nDisc pressed at e/R: relative errors of rotation and largest pressure\n e/R elements planes"
          " iterations  rotation  pressure")
    for ratio in (0.1, 0.3, 0.5, 0.7, 0.9):
        for n, planes in ((8, 17), (16, 33), (32, 65), (64, 129)):
            print("{:4} {:8} {:6} {:10} {:9.1e} {:9.1e}".format(ratio, n, planes,
                                                                *disc_errors(program, ratio, n, planes)))
    print("Order from root mean squares over e/R = 0.30, 0.35, ..., 0.70 (one by one they scatter: the edge of "
          "the\ncontact lies anywhere between points)")
    for what, grids in (("elements, 257 planes", [(n, 257) for n in (4, 8, 16, 32)]),
                        ("planes, 64 elements", [(64, p) for p in (9, 17, 33, 65)]),
                        ("both", [(4, 9), (8, 17), (16, 33), (32, 65)])):
        means = []
        for n, planes in grids:
            found = [disc_errors(program, 0.3 + 0.05*k, n, planes, young=1e8)[1] for k in range(9)]
            means.append(math.sqrt(sum(error**2 for error in found)/len(found)))
        order = math.log2(means[0]/means[-1])/(len(means) - 1)
        print(f"{what:22}", " ".join(f"{mean:8.1e}" for mean in means), f"order {order:.2f}")


def times(classical, runs):
    """What joints cost beside an elastic solution of the same harmonics, and the classical loop"""
    deck = example(3, refined=4, tolerance=1e-6)
    elastic = deck.replace("0, 0, PAPER", ", , ELASTIC").replace(
        "RESULTANTS", "\n".join(["PRESSURES", *(f"1, {m}, 1E-9" for m in range(9)), "RESULTANTS"]))
    with tempfile.TemporaryDirectory() as folder:
        names = [os.path.join(folder, name) for name in ("elastic.dat", "joints.dat")]
        for name, text in zip(names, (elastic, deck)):
            with open(name, "w", encoding="ascii") as file:
                file.write(text)
        lines = subprocess.run([classical, *names, str(runs)], check=True, capture_output=True,
                               text=True).stdout.splitlines()
    found = dict(zip(lines[0].split(","), map(float, lines[1].split(","))))
    loop = found["elastic_s"] + found["loop_s"]
    print(f"\nCase 3 refined 4 times, M = 8, 33 planes, tolerance 1E-6: analysis without reading and writing, "
          f"least of {runs}\n"
          f"elastic, the same harmonics        {found['elastic_s']:8.3f} s (assembly and factorization "
          f"{found['elastic_assemble_factor_s']:.3f} s)\n"
          f"with joints, {found['iterations']:.0f} Newton iterations  {found['all_s']:8.3f} s (phase of the joints "
          f"{found['joints_phase_s']:.3f} s), residual {found['residual']:.1e}\n"
          f"the solutions alone                {found['elastic_alone_s']:8.3f} s and {found['joints_alone_s']:.3f} s: "
          f"ratio {found['joints_alone_s']/found['elastic_alone_s']:.2f} (without stresses and error estimates)\n"
          f"loop by back-substitutions         {loop:8.3f} s, {found['sweeps']:.0f} sweeps, displacements differ by "
          f"{found['difference']:.1e}\n"
          f"whole analyses: joints / elastic {found['all_s']/found['elastic_s']:.2f}; loop / Newton {loop/found['all_s']:.1f}, "
          f"beyond the elastic solution {found['loop_s']/found['joints_s']:.0f}")


def estimates(program):
    """Estimates that harmonics and planes leave of joint stress, over the difference to twice the harmonics and
    to four times as many intervals between planes"""
    print("\nEstimated over found error of joint stress (all but bonds): harmonics against 2 M (6 for 2), planes against "
          "four\ntimes the intervals")
    scenes = [(f"case 3 x {factor:g}", lambda m, n, factor=factor: example(3, factor=factor, harmonic=m, planes=n),
               ((2, 9), (4, 17), (8, 33))) for factor in (0.1, 1.0, 10.0, 100.0)]
    scenes += [(f"disc {ratio}", lambda m, n, ratio=ratio: eccentric_disc(ratio, n=8, harmonic=m, planes=n, young=1e4),
                ((2, 9), (4, 17), (4, 65))) for ratio in (0.3, 0.5, 0.7)]
    ratios = []
    for name, make, settings in scenes:
        found = []
        for m, n in settings:
            run = Run(program, make(m, n))
            errors = run.summary["errors"]
            more = Run(program, make(6 if m == 2 and name.startswith("case") else 2*m, n)).stress
            finer = Run(program, make(m, 4*(n - 1) + 1)).stress[::4]
            for source, other in (("harmonics", more), ("planes", finer)):
                true = abs(other - run.stress).max()/abs(run.stress).max()
                found.append(errors[source]["joint_stress"]/true)
        ratios += found
        print(f"{name:14}", " ".join(f"{ratio:6.2f}" for ratio in found), flush=True)
    good = sum(0.3 <= ratio <= 3.0 for ratio in ratios)
    print(f"{good} of {len(ratios)} between 0.3 and 3; all between {min(ratios):.2f} and {max(ratios):.1f}")


def increments(program):
    """What the order in which bonds break changes: few load increments against a hundred"""
    print("\nBonds: displacement and largest joint stress after 1 and 5 increments against 100; iterations")
    for number in (1, 2):
        for factor in (1.0, 10.0, 100.0, 1000.0):
            deck = example(number, factor=factor)
            head, _, _ = deck.partition("INCREMENTS\n")
            runs = [Run(program, head + "INCREMENTS\n" + f"{1/n:.12g}, 1E-10, 500\n"*n + "END\n") for n in (1, 5, 100)]
            print(f"{number:4} {factor:6g}", "  ".join(f"{run.differs(runs[-1])} {run.summary['iterations']:5}"
                                                    for run in runs[:-1]), flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--classical", required=True)
    parser.add_argument("--quick", action="store_true")
    args = parser.parse_args()
    times(args.classical, 3 if args.quick else 15)
    discs(args.program)
    proportions(args.program)
    estimates(args.program)
    increments(args.program)
    iterations(args.program)


if __name__ == "__main__":
    main()
