"""What grading saves: jobs with ERROR from coarse decks, blocks GRADED and UNIFORM, side by side. See scripts/bench.

True errors are against a mesh of many elements, small at corners, with more harmonics and planes; its own estimated
error stands beside. No constant of the rules was chosen on these rows but on those of the pile without friction."""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass, replace

from goals import COARSE, COARSE_8, Row
import estimate_scenes as scenes
from found_errors import displacement_error, joint_error, read

# A graded run is not worse than a uniform one if it takes at most so many times its unknowns
MARGIN = 1.25
TARGETS = {"DISPL": (1.0, 0.5), "JOINTS": (2.0, 1.0)}


@dataclass
class Answer:
    """What a run with ERROR came to: true error and what it says [%], unknowns of its last round, processor seconds"""
    error: float
    says: float
    unknowns: int
    seconds: float


def rows():
    """Scenes, where they begin, and what their references are like"""
    def friction(angle, **others):
        return {"cohesion": 0.0, "friction": angle} | others

    yield Row("case 3 (k = 1e4, no friction)", scenes.pile, COARSE, friction(0.0))
    yield Row("case 3 (k = 1e4, no friction)", scenes.pile, COARSE_8, friction(0.0))
    yield Row("pile, k = 3e4, 35 degrees", scenes.pile, COARSE_8, friction(35.0, k=3e4))
    yield Row("joints 1E6 times as stiff", scenes.pile, COARSE_8, {"k": 1e10})
    yield Row("joints 1E3 times as soft", scenes.pile, COARSE_8, {"k": 10.0})
    yield Row("stiff pile, E x 100", scenes.pile, COARSE, friction(30.0, young=(2e6, 2e4)))
    yield Row("footing, e = 0.25 R", scenes.footing, COARSE_8, {"e": 0.25}, 3.0)
    yield Row("cone, half of the torque", scenes.cone, COARSE_8, {"share": 0.5}, 10.0, graded=False)
    yield Row("hub, 0.7 of the torque", scenes.shrunk_on, COARSE_8, {"torque": 0.4})
    yield Row("heated plug", scenes.heated, COARSE_8)
    yield Row("rigid disc, e = 0.45 R", scenes.disc, COARSE_8, {"e": 0.45})
    alone = ("DISPL",)
    yield Row("notch, m = 2", scenes.notch, COARSE_8, {"m": 2}, quantities=alone)
    yield Row("notch, another material, m = 1", scenes.notch, COARSE_8, {"m": 1, "ratio": 0.2}, quantities=alone)
    yield Row("built in, nu = 0.2", scenes.built_in, COARSE_8, {"poisson": 0.2}, quantities=alone)
    yield Row("distorted blocks, m = 3", scenes.skew, replace(COARSE_8, harmonic=3), {"m": 3}, quantities=alone)


def decks():
    """Decks of inputs/ as they are, without an ERROR card of their own"""
    for name in ("case1_balanced", "gallery/caisson", "gallery/footing", "gallery/pipe", "gallery/plug", "gallery/tank"):
        with open(os.path.join(scenes.ROOT, "inputs", name + ".dat"), encoding="utf-8") as file:
            deck = file.read()
        if "\nERROR" not in deck and "\nYIELD" not in deck:
            yield name, deck


def with_goal(deck, target, quantity, division, most):
    """A deck with a card of ERROR"""
    head, end, tail = deck.rpartition("\nEND")
    return f"{head}\nERROR\n{target:g}, {quantity}, , {most}, {division}{end}{tail}"


class Bench:
    """Runs decks, and counts what comes of them"""

    def __init__(self, program, folder, most):
        self.program, self.folder, self.most, self.number = program, folder, most, 0
        self.ratios, self.effects, self.worse, self.only, self.lies, self.seconds = [], [], [], [], [], []

    def run(self, deck):
        """Results and processor seconds of a deck; None if it did not run"""
        self.number += 1
        path = os.path.join(self.folder, f"job{self.number}")
        with open(path + ".dat", "w", encoding="utf-8") as file:
            file.write(deck)
        used = cost(path + ".said", [self.program, "run", path + ".dat", "-o", self.folder])
        name = path + ".json"
        if not os.path.exists(name):
            name = path + ".1.json"  # of several combinations the first
        return (read(name[:-5]), used["processor"]) if used["exit_code"] == 0 else None

    def answer(self, deck, quantity, reference):
        """What a run came to beside a reference, if there is one"""
        found = self.run(deck)
        if found is None:
            return None
        result, seconds = found
        last = result.summary["rounds"][-1]
        error = math.nan
        if reference is not None:
            error = 100*(displacement_error if quantity == "DISPL" else joint_error)(result, reference)
        return Answer(error, 100*last["error"], last["unknowns"], seconds)

    def compare(self, name, deck, quantity, target, reference):
        """A line of the table"""
        answers = [self.answer(with_goal(deck, target, quantity, division, self.most), quantity, reference)
                   for division in ("GRADED", "UNIFORM")]
        line = f"{name:32} {quantity:6} {target:4g}"
        for own in answers:
            if own is None:
                line += " | did not run                  "
                continue
            mark = " " if own.says <= target else "~"
            line += f" | {own.error:6.2f} {own.says:6.2f}{mark} {own.unknowns:7d} {own.seconds:6.2f}"
            if own.says <= target < own.error:
                self.lies.append((name, own.error/target))
        print(line, flush=True)
        if None in answers:
            return
        graded, uniform = answers
        if graded.error > 0.0:  # and known
            self.effects.append(graded.says/graded.error)
        if graded.says <= target < uniform.says:
            self.only.append(uniform.unknowns/graded.unknowns)
        elif graded.says <= target:
            self.ratios.append(uniform.unknowns/graded.unknowns)
            self.seconds.append(uniform.seconds/graded.seconds)
            if graded.unknowns > MARGIN*uniform.unknowns:
                self.worse.append(f"{name}, {quantity} {target:g} %")
        elif uniform.says <= target:
            self.worse.append(f"{name}, {quantity} {target:g} % (not met)")

    def verdict(self):
        """What all rows say; false if grading is worse somewhere"""
        print(f"\nBoth met the target in {len(self.ratios)} rows: uniform blocks take {mean(self.ratios):.1f} times the unknowns and "
              f"{mean(self.seconds):.1f} times the seconds (geometric means; {min(self.ratios, default=1):.1f} to {max(self.ratios, default=1):.1f} "
              f"and {min(self.seconds, default=1):.1f} to {max(self.seconds, default=1):.1f}).\nGraded blocks alone met it in {len(self.only)} rows. "
              f"Error told over true error, graded: {min(self.effects):.1f} to {max(self.effects):.1f}, geometric mean {mean(self.effects):.1f}.\n"
              f"Told to be met and not met: {self.lies or 'none'}.\nGraded takes more than {MARGIN:g} times the unknowns: "
              f"{'; '.join(self.worse) or 'nowhere'}.")
        return not self.worse


def mean(values):
    """Geometric mean"""
    values = [value for value in values if value > 0]
    return math.exp(sum(map(math.log, values))/len(values)) if values else 1.0


def cost(said, command):
    """Cost of a command of one thread, by measured.py"""
    here = os.path.dirname(os.path.realpath(__file__))
    found = subprocess.run([sys.executable, os.path.join(here, "measured.py"), said, *command], capture_output=True,
                           text=True, check=True, env=os.environ | {"OMP_NUM_THREADS": "1"})
    return json.loads(found.stdout)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--axijoint", required=True)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", default="")
    args = parser.parse_args()
    print(f"Bar: graded blocks nowhere take more than {MARGIN:g} times the unknowns of uniform ones, and meet what these meet.\n"
          f"True error, error by the program [%] (~ above the target and said so), unknowns of the last round, processor seconds;\n"
          f"graded | uniform. Load average {os.getloadavg()[0]:.1f}\n")
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(args.axijoint, folder, 60000 if args.quick else 150000)
        for row in [replace(row, grade=300.0) for row in rows() if args.only in row.name][::3 if args.quick else 1]:
            found = bench.run(row.reference())
            if found is None:
                print(f"{row.name:32} no reference")
                continue
            own = found[0].summary["errors"]["sum"]
            print(f"{row.name}: the reference says {100*own['displacement']:.2f} % of itself, joint stress "
                  f"{100*(own['joint_stress'] or 0.0):.2f} %")
            for quantity in row.quantities:
                for target in TARGETS[quantity]:
                    bench.compare(f"{row.name}, {row.start.kind}", row.scene(row.start, **row.options), quantity, target, found[0])
        for name, deck in [] if args.quick else decks():
            if args.only in name:
                for quantity in ("DISPL",):
                    bench.compare(name, deck, quantity, 1.0, None)
        met = bench.verdict()
    sys.exit(0 if met else 1)


if __name__ == "__main__":
    main()
