"""Runs the benchmark of the solvers; prints its table; writes CSV and figure. See scripts/bench."""

import argparse
import csv
import io
import math
import os
import statistics
import subprocess
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

QUICK = [13, 21, 31, 43, 61, 85, 121]
DEFAULT = QUICK + [171, 241, 301]
FULL = DEFAULT + [401, 501]
SOLVERS = ["band", "skyline", "sparse"]
COLORS = {"band": "#1b6ca8", "skyline": "#c77d1e", "sparse": "#2f8f4e"}
ROUNDS = 4  # of the comparison with the peers
COMPARED = [61, 121, 211, 301]  # sizes of the comparison alone; --full goes on to 501
LEAST_FIT = 5000  # unknowns from which on exponents are fitted: below, overhead hides them
PEER_COLUMNS = ["solver", "order", "analysis_s", "factorization_s", "repeated_s", "solve_s",
                "operations", "factor_mb", "factor_entries", "lapack_ratio", "processor_share"]
# Theory of square meshes: exponents of time and of memory
THEORY = {"band": ("n^2", 2.0, "n^1.5", lambda n: n**1.5),
          "skyline": ("n^2", 2.0, "n^1.5", lambda n: n**1.5),
          "sparse": ("n^1.5", 1.5, "n log n", lambda n: n * math.log(n))}


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--peers", required=True)
    parser.add_argument("--mkl", default="")
    parser.add_argument("-o", dest="output", required=True)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--peers-only", action="store_true")
    return parser.parse_args()


def call(command, **environment):
    """Output of a program; None, with its words, if it fails."""
    done = subprocess.run(command, capture_output=True, text=True, env=os.environ | environment)
    if done.returncode:
        print(f"  {os.path.basename(command[0])} failed: {done.stderr.strip() or done.returncode}")
        return None
    return done.stdout


def measure(program, side, *options):
    text = call([program, str(side), *options])
    if text is None:
        raise SystemExit(1)
    return list(csv.DictReader(io.StringIO(text)))


def measure_peers(args, matrix):
    """One line of each peer that was built."""
    drivers = [("cholmod", []), ("mumps", []), ("pardiso", [args.mkl, "own"]),
               ("pardiso", [args.mkl, "given"])]
    rows = []
    for name, options in drivers:
        path = os.path.join(args.peers, name)
        if not os.path.exists(path):
            continue
        text = call([path, matrix, *options], OMP_NUM_THREADS="1")
        if text:
            rows.append(dict(zip(PEER_COLUMNS, text.strip().split(","))))
    return rows


def number(row, column):
    return float(row[column]) if row.get(column) else math.nan


def show(value, width, digits=3):
    return f"{value:{width}.{digits}g}" if math.isfinite(value) else " " * (width - 1) + "-"


def print_rows(rows):
    for row in rows:
        print(f"{row['unknowns']:>8} {row['solver']:8}{row['threads']:>2}{row['harmonics']:>3}"
              + "".join(show(number(row, c), 9) for c in
                        ("order_s", "analysis_s", "assembly_parts_s", "assembly_matrix_s",
                         "factorization_s", "repeated_s", "solve_s", "operations"))
              + show(number(row, "gflops"), 7) + show(number(row, "dgemm_fraction"), 7, 2)
              + show(number(row, "factor_mb"), 9) + show(number(row, "factor_entries"), 10)
              + show(number(row, "backward_error"), 9, 2) + show(number(row, "lapack_ratio"), 9, 2)
              + show(number(row, "expected_s"), 9) + show(number(row, "processor_share"), 6, 2)
              + "  " + row["note"], flush=True)


def single(rows, solver):
    return [r for r in rows if r["solver"] == solver and r["threads"] == "1"
            and r["harmonics"] == "1"]


def slope(x, y):
    """Exponent by least squares of logarithms."""
    x, y = [math.log(v) for v in x], [math.log(v) for v in y]
    mean_x, mean_y = statistics.fmean(x), statistics.fmean(y)
    return (sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y))
            / sum((a - mean_x) ** 2 for a in x))


def fit(rows, solver):
    """Exponents of time and entries, measured and of theory over the same sizes."""
    large = [r for r in single(rows, solver) if int(r["unknowns"]) >= LEAST_FIT]
    timed = [r for r in large if r["factorization_s"]]
    if len(timed) < 2:
        return None
    n = [int(r["unknowns"]) for r in large]
    return {"time": slope([int(r["unknowns"]) for r in timed],
                          [number(r, "factorization_s") for r in timed]),
            "entries": slope(n, [number(r, "factor_entries") for r in large]),
            "theory_time": THEORY[solver][1],
            "theory_entries": slope(n, [THEORY[solver][3](v) for v in n])}


def print_fits(rows):
    fits = {solver: fit(rows, solver) for solver in SOLVERS}
    print(f"\nExponents of time and of entries of the factor, from {LEAST_FIT} unknowns on")
    for solver, found in fits.items():
        if found:
            time_law, _, entry_law, _ = THEORY[solver]
            print(f"  {solver:8} time {found['time']:.2f} (theory {time_law}), entries "
                  f"{found['entries']:.2f} (theory {entry_law}: {found['theory_entries']:.2f})")
    return fits


def compare(args, side, rounds):
    """Sparse solver and peers in turn on one matrix, so that all meet the same disturbances."""
    ours, peers = [], []
    with tempfile.TemporaryDirectory() as folder:
        matrix = os.path.join(folder, "matrix")
        for k in range(rounds):
            options = ["--solvers", "sparse", "--harmonics", "8" if side <= 301 else "5"]
            ours += measure(args.program, side, *options, *(["--dump", matrix] if k == 0 else []))
            for row in measure_peers(args, matrix):
                peers.append({"nodes_per_side": side, "unknowns": ours[0]["unknowns"],
                              "round": k + 1} | row)
    return ours, peers


def least(rows, column):
    """Least of the rounds: what disturbs a round only ever adds to its time."""
    found = [number(r, column) for r in rows if r.get(column)]
    return min(found) if found else math.nan


def print_comparison(ours, peers):
    own, kept = least(ours, "factorization_s"), least(ours, "repeated_s")
    print(f"\n{ours[0]['unknowns']} unknowns, one thread: least of {len(ours)} rounds of 3 in turn; "
          "`again`: into memory kept from the factorization before")
    print("  solver   order      analysis s  factor s  again s  solve s   GFLOP/s  MB     "
          "LAPACK ratio")
    print(f"  axijoint given      {least(ours, 'analysis_s'):10.3f} {own:9.3f} {kept:8.3f}"
          f" {least(ours, 'solve_s'):8.3f}  {number(ours[0], 'operations') / own / 1e9:8.1f}"
          f"  {number(ours[0], 'factor_mb'):5.0f}  {number(ours[0], 'lapack_ratio'):.2g}"
          f"  ({number(ours[0], 'operations') / own / 1e9 / max(number(r, 'dgemm_gflops') for r in ours):.2f} of dgemm)")
    best = {"factorization_s": (math.inf, ""), "repeated_s": (math.inf, "")}
    for name, order in dict.fromkeys((r["solver"], r["order"]) for r in peers):
        mine = [r for r in peers if (r["solver"], r["order"]) == (name, order)]
        for column, known in best.items():
            if least(mine, column) < known[0]:
                best[column] = (least(mine, column), f"{name} ({order})")
        time, again = least(mine, "factorization_s"), least(mine, "repeated_s")
        print(f"  {name:8} {order:9} {least(mine, 'analysis_s'):11.3f} {time:9.3f} {show(again, 8)}"
              f" {least(mine, 'solve_s'):8.3f}  {least(mine, 'operations') / time / 1e9:8.1f}"
              f"  {least(mine, 'factor_mb'):5.0f}  {least(mine, 'lapack_ratio'):.2g}")
    if not peers:
        print("  no peer is installed: scripts/setup peers")
        return
    for column, value, words in (("factorization_s", own, "in fresh memory"),
                                 ("repeated_s", kept, "into memory that was kept")):
        if math.isfinite(best[column][0]):
            print(f"Factorization {words}, axijoint / best peer ({best[column][1]}): "
                  f"{value / best[column][0]:.2f}")


def print_shares(rows, ours, side):
    """Assembly and threads, the least of all rounds, at the size of the comparison."""
    mine = [r for r in rows + ours if r["nodes_per_side"] == str(side) and r["solver"] == "sparse"]
    one = least([r for r in mine if r["harmonics"] == "1"], "factorization_s")
    many = {threads: [r for r in mine if r["harmonics"] != "1" and r["threads"] == threads]
            for threads in ("1", "2")}
    times = {}
    for threads, found in many.items():
        if not found:
            continue
        parts, matrix = least(found, "assembly_parts_s"), least(found, "assembly_matrix_s")
        times[threads] = least(found, "factorization_s")
        print(f"Assembly of {found[0]['harmonics']} harmonics at {found[0]['unknowns']} unknowns on "
              f"{threads} thread(s): integration {parts:.3f} s, matrices {matrix:.3f} s; "
              f"{(parts + matrix) / one:.2f} of one factorization ({one:.3f} s); least of {len(found)}")
    alone = [r for r in mine if r["harmonics"] == "1"]
    shared = least(alone, "shared_s")
    if math.isfinite(shared):
        print(f"One harmonic on 2 threads: {least(alone, 'repeated_s') / shared:.2f} times as fast as on 1 "
              f"({least(alone, 'repeated_s'):.4f} s and {shared:.4f} s, memory kept); least of {len(alone)}")
    if {"1", "2"} <= times.keys():
        print(f"{many['2'][0]['harmonics']} harmonics on 2 threads: {times['1'] / times['2']:.2f} times as "
              f"fast as on 1 ({times['1']:.2f} s and {times['2']:.2f} s); least of {len(many['2'])}")


def curve(axes, rows, column, solver, label):
    mine = [r for r in single(rows, solver) if r[column]]
    x, y = [int(r["unknowns"]) for r in mine], [number(r, column) for r in mine]
    axes.plot(x, y, "o-", color=COLORS[solver], label=label, markersize=4)
    return x, y


def draw(rows, fits, ours, peers, output):
    figure, ((time, entries), (rate, other)) = plt.subplots(2, 2, figsize=(11, 8.5))
    for solver in SOLVERS:
        found = fits[solver]
        law, exponent, entry_law, theory = THEORY[solver]
        measured = f"{solver}: $n^{{{found['time']:.2f}}}$, theory ${braces(law)}$" if found else solver
        x, y = curve(time, rows, "factorization_s", solver, measured)
        guide(time, x, y, lambda n: n**exponent, COLORS[solver])
        measured = (f"{solver}: $n^{{{found['entries']:.2f}}}$, theory ${braces(entry_law)}$"
                    if found else solver)
        x, y = curve(entries, rows, "factor_entries", solver, measured)
        guide(entries, x, y, theory, COLORS[solver])
        curve(rate, rows, "dgemm_fraction", solver, solver)
    for axes, title, unit in ((time, "Factorization of one harmonic, one thread", "seconds"),
                              (entries, "Entries of the factor", "entries"),
                              (rate, "Rate against a large matrix product", "fraction of dgemm")):
        axes.set(xscale="log", xlabel="unknowns", ylabel=unit, title=title)
        axes.grid(alpha=0.3)
        axes.legend(fontsize=8)
    time.set_yscale("log")
    entries.set_yscale("log")
    bars(other, ours, peers)
    figure.text(0.01, 0.01, "dashed: theory through the last point", fontsize=8)
    figure.tight_layout(rect=(0, 0.02, 1, 1))
    for kind in ("png", "svg"):
        figure.savefig(os.path.join(output, f"solvers.{kind}"), dpi=130)


def braces(law):
    return law.replace("n^1.5", "n^{1.5}").replace("log", r"\,\log\,")


def guide(axes, x, y, law, color):
    if x:
        axes.plot(x, [y[-1] * law(n) / law(x[-1]) for n in x], "--", color=color, alpha=0.5)


def bars(axes, ours, peers):
    times = {"axijoint\n(given)": [number(r, "factorization_s") for r in ours]}
    for row in peers:
        times.setdefault(f"{row['solver']}\n({row['order']})", []).append(
            number(row, "factorization_s"))
    heights = [min(v) for v in times.values()]
    colors = [COLORS["sparse"]] + ["#8a8f98"] * (len(heights) - 1)
    axes.bar(list(times), heights, color=colors)
    for k, height in enumerate(heights):
        axes.text(k, height, f"{height:.2f}", ha="center", va="bottom", fontsize=8)
    axes.set(title=f"Factorization at {ours[0]['unknowns']} unknowns, one thread", ylabel="seconds")
    axes.tick_params(axis="x", labelsize=8)


def write(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


def compare_sizes(args, sides):
    """The comparison with the peers alone"""
    all_ours, all_peers = [], []
    for side in sides:
        ours, peers = compare(args, side, ROUNDS if side <= 301 else 2)
        print_comparison([r for r in ours if r["harmonics"] == "1"], peers)
        print_shares([], ours, side)
        all_ours += ours
        all_peers += peers
        write(os.path.join(args.output, "rounds.csv"), all_ours)
        if all_peers:
            write(os.path.join(args.output, "peers.csv"), all_peers)


def main():
    args = arguments()
    sides = QUICK if args.quick else FULL if args.full else DEFAULT
    compared = 121 if args.quick else 301
    if args.peers_only:
        compare_sizes(args, [121] if args.quick else COMPARED + [501]*args.full)
        return
    print("unknowns solver thr har  order s  analy s  parts s matrix s factor s  again s  solve s    flops"
          " GFLOP/s dgemm MB factor   entries  backw.e  LAPACK  expect s  cpu  note")
    rows = []
    for side in sides:
        found = measure(args.program, side, "--harmonics", "8" if side <= 301 else "5")
        print_rows(found)
        rows += found
        write(os.path.join(args.output, "solvers.csv"), rows)
    fits = print_fits(rows)
    ours, peers = compare(args, compared, 1 if args.quick else ROUNDS)
    alone = [r for r in ours if r["harmonics"] == "1"]
    print_comparison(alone, peers)
    if peers:
        write(os.path.join(args.output, "peers.csv"), peers)
    print_shares(rows, ours, compared)
    write(os.path.join(args.output, "rounds.csv"), ours)
    draw(rows, fits, alone, peers, args.output)
    print(f"Written: {args.output}/solvers.csv, solvers.png, solvers.svg"
          + (", peers.csv" if peers else ""))


if __name__ == "__main__":
    main()
