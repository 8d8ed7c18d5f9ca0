"""Estimates of `axijoint estimate` beside runs, and the constants fitted anew. See scripts/bench."""
import argparse
import csv
import json
import os
import re
import resource
import subprocess
import tempfile

from estimate_decks import fitted, shown

REPEATS = 3
MEMORY_BAR, TIME_BAR = 0.10, 0.30
MEGABYTE = 2.0**20
# Terms of the phases that a run has a clock for
GROUPS = {"start, write": ("beginning", "files", "lines", "array_bytes", "swept_values"),
          "read": ("reading",), "assemble": ("ordering", "shape_products", "fine_nodes"), "factor": ("factoring", "formed_entries"),
          "solve": ("inverse", "block_entries", "solved_entries", "node_modes", "laws", "sums", "flexibility",
                    "fine_blocks", "stress_modes", "row_stresses")}
# The processor clocks of the listing that these are; what is left of a run is the first
CLOCKS = {"read": ("read",), "assemble": ("assemble",), "factor": ("factor",), "solve": ("joints", "recover")}
STAY = 0.01  # what a change of a constant counts beside what is missing
MEASURED = ("reading", "ordering", "factoring")  # their counts are seconds already


def counts(program, path, options):
    """Count and seconds of each term, the machine's rates, megabytes of memory and disk"""
    text = subprocess.run([program, "estimate", path, "--counts", *options], capture_output=True, text=True, check=True).stdout
    return {name: (float(count), float(seconds)) for name, count, seconds in re.findall(r"^(\S+) +(\S+) +(\S+)$", text, re.M)}


def best_of(several):
    """What is measured, where the machine did the least else: the shortest times, the highest rates"""
    best = dict(several[0])
    for name in ("reading", "ordering", "factoring"):
        best[name] = min(found[name] for found in several)
    for name in ("text_rate", "product_rate"):
        best[name] = max(found[name] for found in several)
    return best


def speeds(found):
    """What seconds of each term are multiplied by on this machine"""
    text, product = (found[name][1]/found[name][0] for name in ("text_rate", "product_rate"))
    return {name: 1.0 if name in MEASURED else product if name == "inverse" else text for name in sum(GROUPS.values(), ())}


def run(program, path, options, folder):
    """Processor seconds by group and in all, peak memory, increments and iterations"""
    best = None
    for _ in range(REPEATS):
        for name in os.listdir(folder):
            os.remove(os.path.join(folder, name))
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([program, "run", path, "--quiet", "-o", folder, *options], capture_output=True, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        total = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        if best is None or total < best["total"]:
            summaries = []
            for name in sorted(os.listdir(folder)):
                if name.endswith(".json"):
                    with open(os.path.join(folder, name), encoding="utf-8") as file:
                        summaries.append(json.load(file))
            last = max(summaries, key=lambda summary: summary["seconds"]["total"])
            best = {"total": total, "memory": max(summary["peak_memory_mb"] for summary in summaries),
                    "disk": sum(os.path.getsize(os.path.join(folder, name)) for name in os.listdir(folder))/MEGABYTE,
                    "increments": sum(len(summary["increments"]) for summary in summaries),
                    "iterations": sum(summary["iterations"] for summary in summaries)}
            with open(os.path.join(folder, os.path.splitext(os.path.basename(last["deck"]))[0]
                                   + (f".{last['combination']}" if last["combination"] else "") + ".lis"),
                      encoding="utf-8") as file:
                clock = dict(re.findall(r"^  (\w+) +\S+ +(\S+) +\S+$", file.read().split("\nTIMES")[1], re.MULTILINE))
            best["groups"] = {name: sum(float(clock[phase]) for phase in phases) for name, phases in CLOCKS.items()}
            best["groups"]["start, write"] = total - sum(best["groups"].values())
    return best


def measure(program, decks, folder):
    """Of each deck: what is predicted with the usual and with the true number of iterations, and what it took"""
    rows = []
    out = os.path.join(folder, "out")
    os.makedirs(out, exist_ok=True)
    for name, (text, options) in decks.items():
        path = os.path.join(folder, name + ".dat")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        found = run(program, path, options, out)
        usual = best_of([counts(program, path, options) for _ in range(REPEATS)])
        once, twice = (counts(program, path, [*options, "--iterations", str(n)]) for n in (1, 2))
        each = found["iterations"]/max(1, found["increments"])
        true = {term: once[term][0] + (each - 1.0)*(twice[term][0] - once[term][0]) if term in ("laws", "sums", "flexibility")
                else usual[term][0] for term in sum(GROUPS.values(), ())}
        rows.append({"deck": name, "found": found, "usual": usual, "true": true, "speeds": speeds(usual)})
    return rows


def predicted(row, group, true=False):
    """Seconds of a group"""
    return sum((row["true"][term] if true else row["usual"][term][0])*row["usual"][term][1]*row["speeds"][term]
               for term in GROUPS[group])


def fit(rows, group):
    """Seconds of one of each term, none below zero: the least squares of what is missing, over the time of the run, and
    of the changes to the present seconds, so that terms that go together keep their proportion"""
    terms = [term for term in GROUPS[group] if term not in ("reading", "ordering")]
    now = [rows[0]["usual"][term][1] for term in terms]
    matrix, right = [], []
    for row in rows:
        known = sum(row["true"][term] for term in GROUPS[group] if term not in terms)
        weight = 1.0/(row["found"]["groups"][group] + 0.1*row["found"]["total"])
        matrix.append([weight*row["true"][term]*row["speeds"][term]*c for term, c in zip(terms, now)])
        right.append(weight*(row["found"]["groups"][group] - known))
    value, trust = [1.0]*len(terms), [1.0]*len(rows)
    for _ in range(30):  # rows that fit badly count less
        for _ in range(300):
            for k in range(len(terms)):
                square = sum(t*line[k]**2 for t, line in zip(trust, matrix)) + STAY
                miss = sum(t*line[k]*(b - sum(x*c for x, c in zip(line, value)))
                           for t, line, b in zip(trust, matrix, right)) + STAY*(1.0 - value[k])
                value[k] = max(0.0, value[k] + miss/square)
        trust = [1.0/max(0.1, abs(b - sum(x*c for x, c in zip(line, value)))) for line, b in zip(matrix, right)]
    return {term: c*x for term, c, x in zip(terms, now, value)}


def fit_swept(rows, constants):
    """Seconds of a number for ParaView, by what runs with such files take beyond the rest"""
    each = []
    for row in rows:
        rest = sum(row["true"][term]*constants.get(term, 1.0)*row["speeds"][term] for group in GROUPS
                   for term in GROUPS[group] if term != "swept_values")
        each.append((row["found"]["total"] - rest)/row["true"]["swept_values"]/row["speeds"]["swept_values"])
    return sorted(each)[len(each)//2]


def show(rows, title):
    """A table, and the largest differences"""
    print(title)
    print("deck         processor s   predicted  ratio  at true iterations (true, assumed)    MB  predicted ratio  "
          "files MB predicted | ratios: " + ", ".join(GROUPS))
    worst = [0.0, 0.0]
    for row in rows:
        found = row["found"]
        total, true = (sum(predicted(row, group, flag) for group in GROUPS) for flag in (False, True))
        memory, disk = row["usual"]["memory"][0], row["usual"]["disk"][0]
        worst = [max(worst[0], abs(total/found["total"] - 1.0)), max(worst[1], abs(memory/found["memory"] - 1.0))]
        print(f"{row['deck']:12} {found['total']:11.3f} {total:11.3f} {total/found['total']:6.2f} {true/found['total']:6.2f}"
              f" ({found['iterations']:4}, {row['usual']['iterations'][0]:4.0f}) {found['memory']:22.1f} {memory:10.1f} "
              f"{memory/found['memory']:5.2f} {found['disk']:9.1f} {disk:9.1f} |"
              + "".join(f" {predicted(row, group, True)/max(1e-9, found['groups'][group]):5.2f}" for group in GROUPS))
    print(f"largest difference: time {100*worst[0]:.0f} % (bar {100*TIME_BAR:.0f} %), "
          f"memory {100*worst[1]:.0f} % (bar {100*MEMORY_BAR:.0f} %)\n")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--axijoint", required=True)
    parser.add_argument("-o", dest="output", required=True)
    parser.add_argument("--quick", action="store_true")
    args = parser.parse_args()
    os.environ["OMP_NUM_THREADS"] = "1"
    print(f"one thread; load average {os.getloadavg()[0]:.1f}")
    with tempfile.TemporaryDirectory() as folder:
        rows = measure(args.axijoint, shown(), folder)
        show(rows, "Decks that nothing was fitted to")
        if not args.quick:
            basis = measure(args.axijoint, fitted(), folder)
            show(basis, "Decks that the constants are fitted to")
            print("The constants of src/estimate/terms.f90, fitted anew:")
            swept = [row for row in basis if row["true"]["swept_values"] > 0.0]
            plain = [row for row in basis if row not in swept]
            constants = {term: seconds for group in GROUPS for term, seconds in fit(plain, group).items()}
            constants["swept_values"] = fit_swept(swept, constants)
            for term, seconds in constants.items():
                print(f"   {term:16} {seconds:.1e}_wp   (now {basis[0]['usual'][term][1]:.1e})")
            usual = basis[0]["usual"]
            print("rates of this machine: " + ", ".join(f"{name} {usual[name][0]:.2e}" for name in ("product_rate", "text_rate")))
    path = os.path.join(args.output, "estimate.csv")
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["deck", "measured_s", "predicted_s", "measured_mb", "predicted_mb"])
        writer.writerows([row["deck"], row["found"]["total"], sum(predicted(row, group) for group in GROUPS),
                          row["found"]["memory"], row["usual"]["memory"][0]] for row in rows)
    print(f"Written: {path}")


if __name__ == "__main__":
    main()
