"""Case 3 of the paper by axijoint and, in space, by CalculiX: errors beside seconds. See scripts/bench."""
import argparse
import itertools
import os
import sys
import tempfile

import ccx
import work_precision
from work_precision import Point, RunError, cheapest

ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..")
sys.path.insert(0, os.path.join(ROOT, "test", "decks"))
from hard_scenes import example

# Element type, solver; meshes: elements on a quarter of the half circle, meridional mesh as half the base mesh
# times. The iterative solver took twice the time of SPOOLES for C3D20R and is left out there
RUNS = [("C3D20R", "SPOOLES", [(1, 0.5), (1, 1), (2, 1), (2, 2), (3, 3)]),
        ("C3D8I", "SPOOLES", [(1, 1), (2, 1), (2, 2), (3, 3), (4, 4)]),
        ("C3D8I", "ITERATIVE CHOLESKY", [(1, 1), (2, 1), (2, 2), (3, 3), (4, 4)])]
# Elements of so many nodes, with the refinements of the base mesh; highest harmonic and planes
REFINEMENTS = {4: [0.5, 1, 2, 4], 8: [0.5, 1, 2, 4], 9: [0.5, 1, 2, 4]}
CIRCLES = [(2, 9), (4, 17), (8, 33)]
TOLERANCE = 1e-6
REFERENCES = [4, 8]  # refinements of the reference: 9-node elements, M = 16, 65 planes
BARS = [{"displacement": 0.01, "pressure": 0.05}, {"displacement": 0.005, "pressure": 0.02},
        {"displacement": 0.002, "pressure": 0.01}]
THREADS = [1, 2]
LAW, STIFFNESS = 1, 2e4


def values_of(results):
    """What is compared: lateral displacement of the pile's end at its axis, largest pressure of the joint"""
    return {"displacement": float(results.amplitudes((0.0, -0.5), 1, 0)[0]),
            "pressure": float(results.largest_pressure(LAW, STIFFNESS))}


def reference(program, folder):
    """Values of the finest run, and what the step to it changed"""
    found = []
    for refined in REFERENCES:
        deck = example(3, refined=refined, nodes=9, harmonic=16, planes=65)
        results, _ = work_precision.axijoint(program, folder, deck, threads=2, runs=1)
        found.append(values_of(results))
    return found[1], {name: abs(found[0][name]/found[1][name] - 1.0) for name in found[1]}


def axijoint_points(program, folder, exact, threads, quick):
    """axijoint over meshes, elements, harmonics"""
    for nodes, refinements in REFINEMENTS.items():
        for harmonic, planes in CIRCLES:
            for refined in refinements[:3] if quick else refinements:
                deck = example(3, refined=refined, nodes=nodes, harmonic=harmonic, planes=planes, tolerance=TOLERANCE)
                results, cost = work_precision.axijoint(program, folder, deck, threads)
                yield point("axijoint", f"{nodes} nodes, M = {harmonic}, {planes} planes", refined, threads,
                            results.summary["unknowns"], cost, values_of(results), exact)


def calculix_points(folder, exact, threads, quick):
    """CalculiX over meshes, elements, solvers"""
    for element_type, solver, meshes in RUNS:
        for number, density in enumerate(meshes[:3] if quick else meshes):
            unknowns, displacement, pressure, cost = ccx.solve(folder, density, element_type, solver, threads)
            found = point("CalculiX", f"{element_type} {solver}", number, threads, unknowns, cost,
                          {"displacement": displacement, "pressure": pressure}, exact)
            found.mesh = f"{4*density[0]} x {density[1]/2:g}"
            yield found


def point(program, family, size, threads, unknowns, cost, values, exact):
    """A point of the curves, with its errors"""
    return Point(program, family, (size,), threads, unknowns, cost, values,
                 {name: values[name]/exact[name] - 1.0 for name in exact})


def show(p):
    """Prints one line of the table"""
    print(f"{p.program:9} {p.family:27} {p.mesh:>8} {p.threads} {p.unknowns:8} {p.cost.wall:8.2f} "
          f"{p.cost.processor:8.2f} {p.cost.memory:7.0f} {p.values['displacement']:11.5e} "
          f"{100*p.errors['displacement']:7.2f} {p.values['pressure']:7.3f} {100*p.errors['pressure']:7.2f}",
          flush=True)


def compare(points):
    """Prints the cheapest settings that meet each pair of bars, and the ratio of their seconds"""
    for threads in THREADS:
        for bars in BARS:
            words = ", ".join(f"{100*bar:g} % of {name}" for name, bar in bars.items())
            print(f"\n{words}; {threads} thread{'s' if threads > 1 else ''}")
            best = {}
            for program in ("CalculiX", "axijoint"):
                own = [p for p in points if p.program == program and p.threads == threads]
                best[program] = cheapest(own, bars, lambda p: p.cost.wall)
                if best[program] is None:
                    print(f"{program:9} no setting of this run")
                else:
                    show(best[program])
            if all(best.values()):
                one, two = best["CalculiX"].cost, best["axijoint"].cost
                print(f"CalculiX / axijoint: {one.wall/two.wall:.1f} in wall-clock seconds, "
                      f"{one.processor/two.processor:.1f} in processor seconds, "
                      f"{one.memory/two.memory:.1f} in memory")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--axijoint", required=True)
    parser.add_argument("-o", dest="output", required=True)
    parser.add_argument("--quick", action="store_true")
    args = parser.parse_args()
    points = []
    with tempfile.TemporaryDirectory() as folder:
        exact, step = reference(args.axijoint, folder)
        print(f"Reference: axijoint, 9-node elements, base mesh refined {REFERENCES[1]} times, M = 16, 65 planes: "
              f"displacement\n{exact['displacement']:.6e} m, pressure {exact['pressure']:.4f} MPa; the step from "
              f"{REFERENCES[0]} times changed them by {100*step['displacement']:.3f} % and "
              f"{100*step['pressure']:.3f} %")
        print("\nprogram   setting                         mesh t unknowns   wall s    cpu s      MB"
              " displacement error% pressure error%")
        for threads in THREADS:
            for found in itertools.chain(calculix_points(folder, exact, threads, args.quick),
                                         axijoint_points(args.axijoint, folder, exact, threads, args.quick)):
                show(found)
                points.append(found)
    compare(points)
    path = os.path.join(args.output, "calculix.csv")
    work_precision.write_table(path, points)
    figure = os.path.join(args.output, "calculix")
    one = [p for p in points if p.threads == 1]
    work_precision.draw(figure, one, ["displacement", "pressure"],
                        lambda p: p.family if p.program == "CalculiX" else f"axijoint, {p.family[:7]}",
                        "Case 3, frictionless: pile displacement and largest joint pressure; one thread")
    print(f"\nWritten: {path}, {figure}.png and .svg")


if __name__ == "__main__":
    try:
        main()
    except RunError as error:
        sys.exit(f"calculix: {error}")
