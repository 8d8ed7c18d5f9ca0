"""Whether ERROR keeps what it promises: targets over true errors, from coarse decks. See scripts/bench."""
import argparse
import os
import sys
import tempfile

ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..")
sys.path.insert(1, os.path.join(ROOT, "test", "decks"))
import work_precision
from hard_scenes import eccentric_disc, eccentric_exact, example

TARGETS = (5.0, 2.0, 1.0, 0.5)
# Elements and refinement of the base mesh that runs begin with; M = 2, 9 planes
STARTS = ((4, 1), (8, 0.5))
# The reference of a case
FINE = {"nodes": 9, "refined": 4, "harmonic": 12, "planes": 49, "tolerance": 1e-6}


def with_goal(deck, target):
    """A deck with a target for its displacements"""
    return deck.replace("\nEND", f"\nERROR\n{target}, DISPL\nEND")


def lateral(results):
    """Displacement of the pile's end"""
    return float(results.amplitudes((0.0, -0.5), 1, 0)[0])


def rotation(results):
    """Rotation of the disc"""
    return abs(float(results.amplitudes((1.0, 0.1), 1, 1)[0]))


def scenes(run):
    """Names, decks to begin with, exact or reference values, and what is compared"""
    for ratio in (0.3, 0.5, 0.7):
        yield (f"disc, e/R = {ratio}, 4 elements",
               eccentric_disc(ratio, n=4, planes=9, harmonic=2), eccentric_exact(ratio)[0], rotation)
    for number in (1, 2, 3):
        for factor in (0.1, 1.0, 10.0):
            reference = lateral(run(example(number, factor=factor, **FINE))[0])
            for nodes, refined in STARTS:
                deck = example(number, factor=factor, nodes=nodes, refined=refined, harmonic=2, planes=9,
                               tolerance=1e-6)
                yield f"case {number}, joints x {factor:g}, {nodes} nodes", deck, reference, lateral


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--axijoint", required=True)
    parser.add_argument("-o", dest="output", required=True)
    parser.add_argument("--quick", action="store_true")
    args = parser.parse_args()
    targets = TARGETS[:3] if args.quick else TARGETS
    kept = runs = 0
    ratios = []
    print("Displacement: true error / estimate [%], rounds, seconds of the program, for targets of "
          + ", ".join(f"{target:g} %" for target in targets))
    with tempfile.TemporaryDirectory() as folder:
        def run(deck):
            return work_precision.axijoint(args.axijoint, folder, deck, threads=2, runs=1)

        for name, deck, exact, value in scenes(run):
            line = f"{name:32}"
            for target in targets:
                results, cost = run(with_goal(deck, target))
                error = 100*abs(value(results)/exact - 1.0)
                last = results.summary["rounds"][-1]
                runs += 1
                kept += error <= target
                ratios.append(100*last["error"]/max(error, 1e-12))
                line += (f" | {error:5.2f} /{100*last['error']:5.2f}{' ' if error <= target else '!'}"
                         f" {len(results.summary['rounds'])} {cost.wall:5.2f}")
            print(line, flush=True)
    below = sum(ratio < 1.0 for ratio in ratios)
    print(f"{kept} of {runs} below the target; the estimate was below the true error in {below}, at worst "
          f"{min(ratios):.2f} times it")


if __name__ == "__main__":
    try:
        main()
    except work_precision.RunError as error:
        sys.exit(f"goals: {error}")
