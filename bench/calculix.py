"""Case 3 of the paper by axijoint and, in space, by CalculiX, both on graded meshes: seconds and memory at equal error, of
one analysis and of a state of a study. See scripts/bench and doc/benchmarks.md.

Seconds are processor seconds of whole processes of one thread, the least of several runs. axijoint is timed in two ways:
`run` as a user has it, with listing, results file and estimates of errors; and `study` of one row, which estimates no
errors and lists nothing, as CalculiX does not. What is found is that of `run`; both solve the same equations.
"""
import argparse
import csv
import itertools
import os
import sys
import tempfile
from dataclasses import dataclass

import ccx
import work_precision
from work_precision import Cost, Point, RunError, cheapest, keeps, measure, run_once

ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..")
sys.path.insert(0, os.path.join(ROOT, "test", "decks"))
from hard_scenes import example

# CalculiX: C3D20R, SPOOLES. Ratio of the largest to the least element; meshes: elements on the half circle, refinement of
# the base mesh. Only meshes whose elements round the circle are not much longer than high: see doc/benchmarks.md
UNIFORM = [(4, 0.25), (4, 0.5), (8, 0.5), (8, 0.75), (8, 1), (12, 1)]
GRADED = [(4, 0.25), (4, 0.5), (8, 0.5), (8, 0.75), (8, 1), (12, 0.75), (12, 1), (12, 1.5), (16, 1)]
MESHES = {1: UNIFORM, 2: GRADED, 3: [*GRADED, (16, 1.5), (16, 2)]}
QUICK = 10  # elements on the half circle, at most
# axijoint: nodes of an element, ratio, refinement of the base mesh; highest harmonic and planes
NODES, RATIOS, REFINEMENTS = (8, 9), (1, 3, 5, 10), (0.5, 0.625, 0.75, 0.875, 1, 1.25, 1.5, 2)
CIRCLES = ((2, 9), (4, 9), (4, 17), (8, 33))
TOLERANCE = 1e-6
# The reference, the last of these: refinement, ratio, highest harmonic, planes; 9-node elements
REFERENCES = ((3, 30, 16, 65), (4, 100, 16, 65))
BARS = [{"displacement": 0.01, "pressure": 0.05}, {"displacement": 0.005, "pressure": 0.02},
        {"displacement": 0.002, "pressure": 0.01}, {"displacement": 0.001, "pressure": 0.005}]
# CalculiX's seconds over axijoint's: of one analysis, by error of displacement; of a state of a study
FASTER, FASTER_STATE = {0.002: 100, 0.001: 300}, 1000
LISTED = 4  # settings of axijoint that are timed again, by seconds and by unknowns
LAW, STIFFNESS = 1, 2e4
# Tables of a study; their first rows are the deck's own state
TABLES = {"load and gap, without friction": "INCREMENTS 1 FACTOR, LAWDETAILS 1 GAP\n1:0.05/20, 0:2E-4/20\n",
          "friction and gap": "LAWS 1 PHI, LAWDETAILS 1 GAP\n0:38/20, 0:2E-4/20\n"}
SMALLEST = """TITLE
One element
CONTROL
0,
MATERIALS
1, 1.0, 0.2
BLOCKS
1, 1, 4, 1, 1
0.0, 0.0, 1.0, 1.0
FACES
1, 1, 0.0, 0.0, 1.0, 0.0
2, 1, 0.0, 1.0, 1.0, 1.0
FIXEDFACES
1, 111
RESULTANTS
2, AXIAL, 1.0
END
"""
SMALLEST_IN_SPACE = """*NODE, NSET=ALL
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
*ELEMENT, TYPE=C3D8I, ELSET=E
1, 1, 2, 3, 4, 5, 6, 7, 8
*MATERIAL, NAME=M
*ELASTIC
1., 0.2
*SOLID SECTION, ELSET=E, MATERIAL=M
*BOUNDARY
1, 1, 3
2, 1, 3
3, 1, 3
4, 1, 3
*STEP
*STATIC
*CLOAD
5, 3, 1.
*NODE PRINT, NSET=ALL
U
*END STEP
"""


@dataclass(frozen=True)
class Setting:
    """How axijoint computes case 3"""
    nodes: int
    harmonic: int
    planes: int
    ratio: float
    refined: float

    def deck(self, tolerance=TOLERANCE):
        """The deck; the end of the pile is a point whose displacement studies have, too"""
        text = example(3, refined=self.refined, nodes=self.nodes, harmonic=self.harmonic, planes=self.planes,
                       ratio=self.ratio, tolerance=tolerance)
        return text.replace("\nEND", "\nLAWDETAILS\n 1,\nPOINTS\n 1, 0.0, -0.5\nEND")


def values_of(results):
    """What is compared: lateral displacement of the pile's end at its axis, largest pressure of the joint"""
    return {"displacement": float(results.amplitudes((0.0, -0.5), 1, 0)[0]),
            "pressure": float(results.largest_pressure(LAW, STIFFNESS))}


def reference(program, folder):
    """Values of the finest run, and what the step to it changed"""
    found = []
    for refined, ratio, harmonic, planes in REFERENCES:
        results, _ = work_precision.axijoint(program, folder, Setting(9, harmonic, planes, ratio, refined).deck(1e-9), runs=1)
        found.append(values_of(results))
    return found[-1], {name: abs(found[0][name]/found[-1][name] - 1.0) for name in found[-1]}


def axijoint_points(program, folder, exact, quick):
    """axijoint over meshes, elements, harmonics"""
    for nodes, (harmonic, planes), ratio in itertools.product(NODES, CIRCLES, RATIOS):
        for refined in REFINEMENTS[:6:2] if quick else REFINEMENTS:
            setting = Setting(nodes, harmonic, planes, ratio, refined)
            results, cost = work_precision.axijoint(program, folder, setting.deck(), runs=3)
            found = point("axijoint", f"{nodes} nodes, M = {harmonic}, {planes} planes, 1:{ratio}", (refined,),
                          results.summary["unknowns"], cost, values_of(results), exact)
            found.setting = setting
            yield found


def calculix_points(folder, exact, quick):
    """CalculiX over meshes"""
    for ratio, meshes in MESHES.items():
        for around, refined in meshes:
            if quick and around > QUICK:
                continue
            unknowns, displacement, pressure, cost = ccx.solve(folder, (around, refined, ratio), "C3D20R", "SPOOLES", 1)
            found = point("CalculiX", f"C3D20R, 1:{ratio}", (around, refined), unknowns, cost,
                          {"displacement": displacement, "pressure": pressure}, exact)
            found.mesh = f"{around} x {refined:g}"
            yield found


def point(program, family, size, unknowns, cost, values, exact):
    """A point of the curves, with its errors"""
    return Point(program, family, size, 1, unknowns, cost, values,
                 {name: values[name]/exact[name] - 1.0 for name in exact})


def show(p):
    """Prints one line of the table"""
    print(f"{p.program:9} {p.family:32} {p.mesh:>8} {p.unknowns:8} {p.cost.wall:8.3f} {p.cost.processor:8.3f} "
          f"{p.cost.memory:7.0f} {p.values['displacement']:11.5e} {100*p.errors['displacement']:7.3f} "
          f"{p.values['pressure']:7.3f} {100*p.errors['pressure']:7.3f}", flush=True)


def study(program, folder, deck, table, runs):
    """Cost of a study, and its rows; there is nothing to go on from"""
    for name, text in (("job.dat", deck), ("rows.csv", table)):
        with open(os.path.join(folder, name), "w", encoding="ascii") as file:
            file.write(text)
    costs = []
    for _ in range(runs):
        for ending in ("rows", "csv", "h5"):
            if os.path.exists(os.path.join(folder, f"rows.study.{ending}")):
                os.remove(os.path.join(folder, f"rows.study.{ending}"))
        costs.append(run_once([program, "study", "rows.csv", "job.dat", "-o", ".", "--threads", "1", "--quiet"], folder, 1))
    with open(os.path.join(folder, "rows.study.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return Cost(*(min(getattr(cost, name) for cost in costs) for name in ("wall", "processor", "memory"))), rows


def by_itself(program, folder, exact, target):
    """A job with ERROR, from a coarse mesh with M = 2: what the program finds where nobody knows the mesh"""
    deck = Setting(8, 2, 9, 1, 0.5).deck().replace("\nEND", f"\nERROR\n {100*target:g}, DISPL\nEND")
    results, cost = work_precision.axijoint(program, folder, deck, runs=3)
    values = values_of(results)
    print(f"  ERROR {100*target:g} %: {cost.processor:.3f} s, {results.summary['unknowns']} unknowns, off by "
          + ", ".join(f"{100*(values[name]/exact[name] - 1):+.3f} % of {name}" for name in exact))


def floors(program, folder):
    """What programs cost that compute next to nothing; seconds of the least study of one row and of the least run"""
    def told(words, cost):
        print(f"{words:44} {cost.wall:8.4f} {cost.processor:8.4f} {cost.memory:7.1f}", flush=True)
        return cost.processor

    print("\nWhat the start and files cost                  wall s    cpu s      MB")
    told("axijoint --version", measure([program, "--version"], folder, runs=20))
    run = told("axijoint run, one element, harmonic 0", work_precision.cost_of_deck(program, folder, SMALLEST, runs=20))
    row = told("axijoint study of one row of it", study(program, folder, SMALLEST, "RESULTANTS 1 VALUE\n1\n", 20)[0])
    with open(os.path.join(folder, "job.inp"), "w", encoding="ascii") as file:
        file.write(SMALLEST_IN_SPACE)
    told("ccx, one element", measure(["ccx", "job"], folder, runs=20))
    return row, run


class Verdict:
    """Bars that were missed"""

    def __init__(self):
        self.missed = []

    def say(self, words, ratio, bar):
        """A line with a ratio and, if there is one, its bar"""
        verdict = ""
        if bar is not None:
            verdict = f" (bar {bar}: {'met' if ratio >= bar else 'MISSED'})"
            if ratio < bar:
                self.missed.append(words)
        print(f"  {words}: {ratio:.0f}{verdict}", flush=True)


@dataclass
class Timed:
    """What a setting of axijoint takes, timed again: `run`, `study` of one row, states of studies"""
    point: Point
    run: Cost
    row: Cost
    states: dict


def timed(program, folder, found):
    """Times a setting again; other work on the machine disturbs the few runs of the table"""
    deck = found.setting.deck()
    run = work_precision.cost_of_deck(program, folder, deck, runs=10)
    row, rows = study(program, folder, deck, "INCREMENTS 1 FACTOR\n1\n", 10)
    if abs(float(rows[0]["point 1 u"])/found.values["displacement"] - 1.0) > 1e-9:
        raise RunError("a row of a study has another displacement than the run")
    states = {}
    for words, table in TABLES.items():
        cost, rows = study(program, folder, deck, table, 1)
        if any(row["exit_code"] != "0" for row in rows):
            raise RunError("a row of the study was not solved")
        states[words] = Cost(cost.wall/len(rows), cost.processor/len(rows), cost.memory)
    return Timed(found, run, row, states)


def shortlist(points, bars):
    """Settings of axijoint that meet the bars for good and are the cheapest of these, or have the fewest unknowns"""
    fit = [p for p in points if p.program == "axijoint" and all(keeps(points, p, name, bar) for name, bar in bars.items())]
    kept = []
    for price in (lambda p: p.cost.processor, lambda p: p.unknowns):
        kept += [p for p in sorted(fit, key=price)[:LISTED] if p not in kept]
    return kept


def compare(program, folder, points, exact, least, verdict):
    """Prints the cheapest settings that meet each pair of bars, and the ratios of their seconds"""
    for bars in BARS:
        print("\n" + ", ".join(f"{100*bar:g} % of {name}" for name, bar in bars.items()))
        space = cheapest([p for p in points if p.program == "CalculiX"], bars, lambda p: p.cost.processor)
        settings = [timed(program, folder, p) for p in shortlist(points, bars)]
        if space is None or not settings:
            print(f"no setting of {'CalculiX' if space is None else 'axijoint'}")
            continue
        show(space)
        print("  the most that start and files of axijoint allow: {:.0f} by a study of one row, {:.0f} by a run".format(
            *(space.cost.processor/floor for floor in least)))

        def say(words, cost_of, bar, unit=1.0, space=space, settings=settings):
            """The cheapest setting by one way to time it"""
            best = min(settings, key=lambda s: cost_of(s).processor)
            cost = cost_of(best)
            print(f"  {words}: {unit*cost.processor:.4g} {'ms' if unit > 1.0 else 's'} (wall {unit*cost.wall:.4g}), {cost.memory:.0f} MB")
            show(best.point)
            verdict.say("CalculiX / axijoint", space.cost.processor/cost.processor, bar)
            print(f"    in wall-clock seconds {space.cost.wall/cost.wall:.0f}, in memory {space.cost.memory/cost.memory:.1f}")

        say("study of one row", lambda s: s.row, FASTER.get(bars["displacement"]))
        say("run, with estimates and listing", lambda s: s.run, None)
        for words in TABLES:
            say(f"a state of 400, {words}", lambda s, words=words: s.states[words], FASTER_STATE, 1e3)
        by_itself(program, folder, exact, bars["displacement"])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--axijoint", required=True)
    parser.add_argument("-o", dest="output", required=True)
    parser.add_argument("--quick", action="store_true")
    args = parser.parse_args()
    print("Bars: CalculiX's processor seconds over axijoint's at equal error, without estimates and listing: "
          + ", ".join(f"{bar} at {100*error:g} %" for error, bar in FASTER.items())
          + f"; a state of a study: {FASTER_STATE} at each error")
    print(f"load average {os.getloadavg()[0]:.1f}")
    points, verdict = [], Verdict()
    with tempfile.TemporaryDirectory() as folder:
        least = floors(args.axijoint, folder)
        exact, step = reference(args.axijoint, folder)
        words = [f"base mesh refined {refined} times, 1:{ratio}" for refined, ratio, _, _ in REFERENCES]
        print(f"\nReference: axijoint, 9-node elements, M = 16, 65 planes, {words[1]}: displacement\n"
              f"{exact['displacement']:.6e} m, pressure {exact['pressure']:.4f} MPa; the step from {words[0]} changed them by "
              f"{100*step['displacement']:.4f} % and {100*step['pressure']:.4f} %")
        print("\nprogram   setting                              mesh unknowns   wall s    cpu s      MB"
              " displacement  error% pressure error%")
        for found in itertools.chain(calculix_points(folder, exact, args.quick),
                                     axijoint_points(args.axijoint, folder, exact, args.quick)):
            show(found)
            points.append(found)
        compare(args.axijoint, folder, points, exact, least, verdict)
    path = os.path.join(args.output, "calculix.csv")
    work_precision.write_table(path, points)
    figure = os.path.join(args.output, "calculix")
    work_precision.draw(figure, points, ["displacement", "pressure"],
                        lambda p: p.family if p.program == "CalculiX" else f"axijoint, {p.family[:7]}",
                        "Case 3, frictionless: pile displacement and largest joint pressure; one thread")
    print(f"\nload average {os.getloadavg()[0]:.1f}\nWritten: {path}, {figure}.png and .svg")
    if verdict.missed:
        sys.exit(f"{len(verdict.missed)} bars missed")


if __name__ == "__main__":
    try:
        main()
    except RunError as error:
        sys.exit(f"calculix: {error}")
