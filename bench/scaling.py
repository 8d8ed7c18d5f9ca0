"""One process beside several by MPI: whole run and phases, memory, bytes exchanged, and what a model made of the run of
one process says of more. See scripts/bench and doc/scaling.md."""
import argparse
import math
import mmap
import os
import re
import subprocess
import tempfile

BAR = 1.8  # of two ranks
PHASES = ("read", "assemble", "factor", "joints", "recover", "write", "total")
# Share of `recover` that every rank does for itself: largest displacements, samples of stresses
REDUNDANT_RECOVER = 0.35
BYTES_PER_SECOND = 2.0e9  # between processes of one machine
BORROWED = 4 << 30  # more than two ranks take


def deck(n, harmonics):
    """A thick tube of n x n elements of 9 nodes, held at its bottom, under a pressure of every harmonic"""
    lines = ["TITLE", "A tube under pressures round it", "CONTROL", f"{harmonics - 1}", "MATERIALS", "1, 2e4, 0.3",
             "BLOCKS", f"1, 1, 9, {n}, {n}", ".5, 0, 1.5, 1", "FACES", "1, 1, .5, 0, 1.5, 0", "2, 1, 1.5, 0, 1.5, 1",
             "FIXEDFACES", "1, 111", "PRESSURES"]
    return "\n".join(lines + [f"2, {m}, 1, 1" for m in range(harmonics)] + ["END", ""])


def borrow_memory():
    """Touch memory and give it back: a machine that lends memory on demand takes its time for the first touch, which
    is not to count against the run that comes first, or that takes more than the one before"""
    with mmap.mmap(-1, BORROWED) as memory:
        for place in range(0, BORROWED, mmap.PAGESIZE):
            memory[place] = 1


def run(words, path, folder):
    """Wall-clock and processor time of each phase of rank 0 [s], its peak memory and exchanged bytes [MB]"""
    borrow_memory()
    subprocess.run([*words, "run", path, "-o", folder, "--quiet"], check=True)
    return found_in(folder, os.path.basename(path)[:-len(".dat")])


def side_by_side(words, path, folders):
    """As `run`, of the first of runs that go at once and know nothing of each other"""
    borrow_memory()
    started = [subprocess.Popen([*words, "run", path, "-o", folder, "--quiet"]) for folder in folders]
    if any(process.wait() for process in started):
        raise RuntimeError("a run failed")
    return found_in(folders[0], os.path.basename(path)[:-len(".dat")])


def found_in(folder, job):
    """What the listing says of times, memory and exchanged bytes"""
    with open(os.path.join(folder, job + ".lis"), encoding="utf-8") as file:
        text = file.read()
    text = text[text.index("\nTIMES"):]
    found = {name: tuple(map(float, re.search(rf"^  {name} +(\S+) +(\S+)", text, re.MULTILINE).groups()))
             for name in PHASES}
    for name in ("peak memory", "exchanged"):
        match = re.search(rf"^  {name} +(\S+) MB", text, re.MULTILINE)
        found[name] = float(match[1]) if match else 0.0
    return found


def least(runs):
    """The least of each number of some runs"""
    return {name: tuple(map(min, zip(*(r[name] for r in runs)))) if name in PHASES else min(r[name] for r in runs)
            for name in runs[0]}


def model(one, measured_harmonics, harmonics, ranks, exchanged):
    """Seconds of parts that all ranks do, of harmonics of one rank, of what rank 0 writes, of exchange"""
    seconds = {name: one[name][1]/measured_harmonics for name in PHASES}
    own = seconds["factor"] + seconds["joints"] + (1 - REDUNDANT_RECOVER)*seconds["recover"]
    same = one["read"][1] + one["assemble"][1] + REDUNDANT_RECOVER*seconds["recover"]*harmonics
    return (same, own*math.ceil(harmonics/ranks), seconds["write"]*harmonics,
            0.0 if ranks == 1 else exchanged/measured_harmonics*harmonics*2**20/BYTES_PER_SECOND)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--axijoint", required=True)
    parser.add_argument("--mpi", required=True)
    parser.add_argument("--quick", action="store_true")
    args = parser.parse_args()
    n, harmonics, rounds = (60, 16, 2) if args.quick else (150, 16, 3)
    print(f"Bar: {BAR} of two ranks. Processors: {os.cpu_count()}; load when it began: {os.getloadavg()[0]:.1f}")
    mpirun = ["mpirun", "--quiet", "--oversubscribe", "--bind-to", "none", "-n", "2", args.mpi]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "tube.dat")
        with open(path, "w", encoding="utf-8") as file:
            file.write(deck(n, harmonics))
        apart = [os.path.join(folder, name) for name in ("first", "second")]
        found = [(run([args.axijoint], path, folder), run(mpirun, path, folder), side_by_side([args.axijoint], path, apart))
                 for _ in range(rounds)]
    one, two, beside = (least([runs[k] for runs in found]) for k in range(3))
    print(f"{3*(2*n + 1)*2*n:,} unknowns x {harmonics} harmonics; least of {rounds} rounds; load at the end: "
          f"{os.getloadavg()[0]:.1f}\n\nphase     seconds of 1, 2 ranks  ratio   processor s of rank 0  ratio   "
          "two runs side by side  limit")
    for name in PHASES + ("solution",):
        (a, c), (b, d), (e, _) = ([sum(r[p][k] for p in ("factor", "joints")) for k in (0, 1)] if name == "solution" else r[name]
                                  for r in (one, two, beside))
        print(f"{name:9} {a:9.2f} {b:9.2f} {a/b:9.2f} {c:13.2f} {d:9.2f} {c/d:6.2f} {e:17.2f} {2*a/e:12.2f}")
    print("limit: twice one run over two that go at once and know nothing of each other: as fast as this machine makes two "
          "processes, whatever they share")
    print(f"memory of a rank {one['peak memory']:.0f}, {two['peak memory']:.0f} MB; exchanged {two['exchanged']:.0f} MB")
    said = sum(model(one, harmonics, harmonics, 2, two["exchanged"]))
    print(f"model of two ranks {said:.1f} s, processor time of rank 0 {two['total'][1]:.1f} s, "
          f"{100*(said/two['total'][1] - 1):+.0f} %\n\nModel, seconds (all ranks the same + own harmonics + writing + "
          "exchange)\nharmonics ranks     same      own    write exchange    total speedup")
    for count in (16, 128, 1024):
        alone = sum(model(one, harmonics, count, 1, 0.0))
        for ranks in (1, 2, 4, 16, 128, 1024):
            if ranks > count:
                continue
            parts = model(one, harmonics, count, ranks, two["exchanged"])
            print(f"{count:9} {ranks:5}" + "".join(f"{x:9.1f}" for x in (*parts, sum(parts))) +
                  f"{alone/sum(parts):8.1f}")


if __name__ == "__main__":
    main()
