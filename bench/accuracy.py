"""Errors against seconds and memory of axijoint, over all that a user can choose. See scripts/bench."""
import argparse
import itertools
import json
import os
import sys
import tempfile
from dataclasses import dataclass

ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..")
sys.path[1:1] = [os.path.join(ROOT, "verification"), os.path.join(ROOT, "test", "decks")]
import work_precision
from hard_scenes import eccentric_disc, eccentric_exact, example
from work_precision import Point, RunError, cheapest

import cases.rings
import cases.solids
from mesh import ELEMENT_TYPES
from program import Results as ExactResults

LAW, STIFFNESS = 1, 2e4
ECCENTRICITY = 0.5
BARS = [0.05, 0.01, 0.001]
# Exact solutions without planes: flexure of a cantilever (m = 1), a ring under cos 5 theta, two rings with an
# elastic joint between them under cos 2 theta
EXACT = [cases.solids.flexure(), cases.rings.loaded_ring("ring_5", 5), cases.rings.two_rings(2)]
KINDS = ["4-node", "4-node B-bar", "8-node", "8-node reduced", "9-node"]
CELLS = [4, 8, 16, 32, 64]


@dataclass(frozen=True)
class Setting:
    """What a user chooses; planes from 0 to pi"""
    nodes: int = 8
    mesh: float = 1
    harmonic: int = 4
    planes: int = 17
    method: str = "NEWTON"
    tolerance: float = 1e-6

    def family(self):
        """Everything but the mesh"""
        return (f"{self.nodes} nodes, M = {self.harmonic}, {self.planes} planes, {self.method} "
                f"{self.tolerance:.0e}")

    def series(self):
        """Everything but mesh and harmonics; planes by their rule"""
        rule = "M + 1" if self.planes == self.harmonic + 1 else "4 M + 1"
        return f"{self.nodes} nodes, {rule} planes, {self.method} {self.tolerance:.0e}"


def settings(meshes, harmonics, quick):
    """Meshes x elements x harmonics x planes, then methods x tolerances with 8-node elements"""
    meshes = {nodes: sizes[:-1] if quick else sizes for nodes, sizes in meshes.items()}
    for nodes, harmonic in itertools.product(meshes, harmonics):
        for planes, size in itertools.product((harmonic + 1, 4*harmonic + 1), meshes[nodes]):
            yield Setting(nodes, size, harmonic, planes)
    for method, tolerance in itertools.product(("NEWTON", "TOTAL", "ANDERSON", "TRANSFER"), (0.03, 1e-3, 1e-6)):
        for size in meshes[8]:
            if (method, tolerance) != ("NEWTON", 1e-6):
                yield Setting(8, size, 4, 17, method, tolerance)


class PaperCase:
    """A case of the paper's example; cases 1 and 2 with the bond law. The reference is a finer run"""

    # Element types and meshes that ERROR begins with
    starts = ((4, 1), (8, 0.5), (9, 0.5))

    def __init__(self, number):
        self.name = f"case {number}"
        self.number = number
        self.step = None

    def deck(self, setting):
        """The deck of a setting"""
        return example(self.number, refined=setting.mesh, nodes=setting.nodes, harmonic=setting.harmonic,
                       planes=setting.planes, method=setting.method, tolerance=setting.tolerance)

    def reference(self, run):
        """Values of the finest of two runs; remembers what the step to it changed"""
        coarse, fine = (self.values(run(self.deck(Setting(9, mesh, 16, 65)))) for mesh in (4, 8))
        self.step = {name: abs(coarse[name]/fine[name] - 1.0) for name in fine}
        return fine

    @staticmethod
    def values(results):
        """Lateral displacement of the pile's end, largest pressure of the vertical joint"""
        return {"displacement": float(results.amplitudes((0.0, -0.5), 1, 0)[0]),
                "joint pressure": float(results.largest_pressure(LAW, STIFFNESS))}

    @staticmethod
    def settings(quick):
        """Settings to try"""
        sizes = [0.5, 1, 2, 4]
        return settings({4: sizes, 8: sizes, 9: sizes}, (2, 4, 8), quick)


class Disc:
    """The rigid disc under an eccentric load, of which half lifts: exact by quadrature"""

    name = "eccentric disc"
    step = None
    starts = ((4, 4), (8, 4))

    @staticmethod
    def deck(setting):
        """The deck of a setting; the mesh is the number of elements along the radius"""
        return eccentric_disc(ECCENTRICITY, n=setting.mesh, planes=setting.planes, harmonic=setting.harmonic,
                              method=setting.method, nodes=setting.nodes, tolerance=setting.tolerance)

    @staticmethod
    def reference(run):
        """Exact rotation and largest pressure"""
        del run
        rotation, _, pressure = eccentric_exact(ECCENTRICITY)
        return {"rotation": rotation, "joint pressure": pressure}

    @staticmethod
    def values(results):
        """Rotation, and the largest pressure of the joint"""
        return {"rotation": abs(float(results.amplitudes((1.0, 0.1), 1, 1)[0])),
                "joint pressure": float(results.largest_pressure(LAW, 1.0))}

    @staticmethod
    def settings(quick):
        """Settings to try"""
        sizes = [4, 8, 16, 32, 64]
        return settings({4: sizes, 8: sizes[:-1], 9: sizes[:-1]}, (2, 4, 8), quick)


def nonlinear_points(problem, program, folder, quick):
    """Points of a problem with joints, over its settings; runs that do not converge are left out and named"""
    exact = problem.reference(lambda deck: work_precision.axijoint(program, folder, deck, threads=2, runs=1)[0])
    print(f"\n{problem.name}: reference " + ", ".join(f"{name} {value:.6g}" for name, value in exact.items())
          + ("" if problem.step is None else "; the step to it changed " + ", ".join(
              f"{name} by {100*step:.3f} %" for name, step in problem.step.items())))
    for setting in problem.settings(quick):
        try:
            results, cost = work_precision.axijoint(program, folder, problem.deck(setting), runs=3, long=1.0)
        except RunError as error:
            print(f"{setting.family()}, mesh {setting.mesh:g}: {str(error).splitlines()[0].split(': ')[-1]}")
            continue
        values = problem.values(results)
        yield Point("axijoint", setting.family(), (setting.mesh, setting.harmonic), 1,
                    results.summary["unknowns"], cost, values,
                    {name: values[name]/exact[name] - 1.0 for name in exact}, problem=problem.name,
                    series=setting.series())


def goal_points(problem, program, folder, points):
    """Lines on what ERROR makes of coarse decks: true error, rounds, cost over that of the cheapest setting"""
    name = next(iter(points[0].errors))
    best = cheapest(points, {name: 0.01}, lambda p: p.cost.wall)
    exact = points[0].values[name]/(1.0 + points[0].errors[name])
    lines = []
    for nodes, mesh in problem.starts:
        start = Setting(nodes, mesh, 2, 9)
        deck = problem.deck(start).replace("\nEND", "\nERROR\n1.0, DISPL\nEND")
        results, cost = work_precision.axijoint(program, folder, deck, runs=5, long=1.0)
        error = problem.values(results)[name]/exact - 1.0
        rounds = results.summary["rounds"]
        lines.append(f"{problem.name}: ERROR 1 % from {nodes} nodes, mesh {mesh:g}: {cost.wall:.3f} s, "
                     f"{cost.wall/best.cost.wall:.1f} times {best.family}, mesh {best.mesh} ({best.cost.wall:.3f} s); "
                     f"{name} {100*abs(error):.2f} % off, estimate {100*rounds[-1]['error']:.2f} %, "
                     f"{len(rounds)} rounds")
    return lines


class MeasuredProgram:
    """A program as the cases of the verification want it, which remembers what its last run took"""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        self.cost = self.unknowns = None

    def run(self, name, text):
        """Runs a deck; its results"""
        del name
        self.cost = work_precision.cost_of_deck(self.program, self.folder, text, runs=3)
        with open(os.path.join(self.folder, "job.json"), encoding="utf-8") as file:
            self.unknowns = json.load(file)["unknowns"]
        return ExactResults(os.path.join(self.folder, "job.h5"))


def exact_points(case, program, folder, quick):
    """Points of an exact solution, over element types and meshes"""
    print(f"\n{case.name}: exact")
    measured = MeasuredProgram(program, folder)
    for kind, cells in itertools.product(KINDS, CELLS[:-1] if quick else CELLS):
        displacement, stress = case.errors(measured, ELEMENT_TYPES[kind], cells)
        errors = {"displacements": displacement, "stresses": stress}
        yield Point("axijoint", kind, (cells,), 1, measured.unknowns, measured.cost, {}, errors, problem=case.name)


def show(p):
    """Prints one line of the table"""
    print(f"{p.family:45} {p.mesh:>5} {p.unknowns:8} {p.cost.wall:8.3f} {p.cost.processor:8.3f} {p.cost.memory:7.0f}"
          + "".join(f" {error:10.2e}" for error in p.errors.values()), flush=True)


def recommend(points, step):
    """Lines that name the setting of least processor time for each bar; it must keep it on finer meshes and with
    more harmonics, too, so series of one number of harmonics are no candidates where others have several. Bars
    that the step to the reference does not clear by far are not judged"""
    lines = []
    highest = {p.series: {q.size[1:] for q in points if q.series == p.series} for p in points}
    most = max(map(len, highest.values()))
    points = [p for p in points if len(highest[p.series]) == most]
    for name, bar in itertools.product(points[0].errors, BARS):
        best = cheapest(points, {name: bar}, lambda p: p.cost.processor)
        words = "no setting tried"
        if step and bar < 3*step[name]:
            words = f"the reference is not known well enough (step {100*step[name]:.2g} %)"
        elif best is not None:
            words = (f"use {best.family}, mesh {best.mesh}: {best.cost.processor:.3f} s of processor time, "
                     f"{best.cost.memory:.0f} MB, error {100*abs(best.errors[name]):.2g} %")
        lines.append(f"{points[0].problem}: for {100*bar:g} % of {name} {words}")
    return lines


def kind_of(p):
    """Element type of a point"""
    return p.family.split(",")[0]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--axijoint", required=True)
    parser.add_argument("-o", dest="output", required=True)
    parser.add_argument("--quick", action="store_true")
    args = parser.parse_args()
    points, advice, goals = [], [], []
    problems = [(case.name, exact_points, case) for case in EXACT]
    problems += [(p.name, nonlinear_points, p) for p in (Disc(), *map(PaperCase, (1, 2, 3)))]
    for name, points_of, problem in problems:
        own = []
        with tempfile.TemporaryDirectory() as folder:
            for found in points_of(problem, args.axijoint, folder, args.quick):
                if not own:
                    print(f"{'setting':45} {'mesh':>5} unknowns   wall s    cpu s      MB"
                          + "".join(f" {what[:10]:>10}" for what in found.errors))
                own.append(found)
                show(found)
            if problem not in EXACT:
                goals += goal_points(problem, args.axijoint, folder, own)
        work_precision.draw(os.path.join(args.output, "accuracy_" + name.replace(" ", "_")), own,
                            list(own[0].errors), kind_of, f"{name}; one thread")
        advice += recommend(own, getattr(problem, "step", None))
        points += own
    print("", *advice, "", *goals, sep="\n")
    path = os.path.join(args.output, "accuracy.csv")
    work_precision.write_table(path, points)
    print(f"\nWritten: {path}, and a figure of each problem, accuracy_*.png and .svg")


if __name__ == "__main__":
    try:
        main()
    except RunError as error:
        sys.exit(f"accuracy: {error}")
