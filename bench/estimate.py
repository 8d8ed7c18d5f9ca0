"""Estimates of `axijoint estimate` beside runs, and the constants fitted anew. See scripts/bench."""
import argparse
import csv
import json
import math
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile

from estimate_decks import fitted, inputs, shown, studies

LEAST_RUNS, MOST_RUNS, LEAST_SECONDS = 3, 10, 2.0  # of each deck, one after the other
PROBES = 4  # of the machine's rates before each
RATES = ("text_rate", "product_rate")
MEMORY_BAR, TIME_BAR = 0.10, 0.30
MEGABYTE = 2.0**20
# Terms of the phases that a run has a clock for
GROUPS = {"start, write": ("beginning", "files", "lines", "array_bytes", "swept_values", "rows"),
          "read": ("reading",), "assemble": ("ordering", "shape_products", "fine_nodes"), "factor": ("factoring", "formed_entries"),
          "solve": ("inverse", "block_entries", "solved_entries", "node_modes", "laws", "sums", "flexibility",
                    "fine_blocks", "stress_modes", "row_stresses", "cut_states", "line_values")}
# The processor clocks of the listing that these are; what is left of a run is the first
CLOCKS = {"read": ("read",), "assemble": ("assemble",), "factor": ("factor",), "solve": ("joints", "recover")}
# Processor seconds and peak memory [KiB] of a command
USED = """import resource, subprocess, sys
subprocess.run(sys.argv[1:], check=True)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(used.ru_utime + used.ru_stime, used.ru_maxrss)"""
STAY = 0.02  # what a change of a constant counts beside what is missing
MEASURED = ("reading", "ordering", "factoring")  # their counts are seconds already


def counts(program, path, options):
    """Count and seconds of each term, the machine's rates, megabytes of memory and disk"""
    text = subprocess.run([program, "estimate", path, "--counts", *options], capture_output=True, text=True, check=True).stdout
    return {name: (float(count), float(seconds)) for name, count, seconds in re.findall(r"^(\S+) +(\S+) +(\S+)$", text, re.M)}


def speeds(found):
    """What seconds of each term are multiplied by on this machine"""
    text, product = (found[name][1]/found[name][0] for name in ("text_rate", "product_rate"))
    return {name: 1.0 if name in MEASURED else product if name == "inverse" else text for name in sum(GROUPS.values(), ())}


def run(program, path, options, folder):
    """Processor seconds by group and in all, peak memory, increments and iterations of one run"""
    for name in os.listdir(folder):
        os.remove(os.path.join(folder, name))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "run", path, "--quiet", "-o", folder, *options], capture_output=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    total = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    summaries, listing = [], ""
    for name in os.listdir(folder):
        if name.endswith(".json"):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                summaries.append(json.load(file))
        if name.endswith(".lis"):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                listing = max(listing, file.read().split("\nTIMES")[1], key=total_of)
    clock = dict(re.findall(r"^  (\w+) +\S+ +(\S+) +\S+$", listing, re.MULTILINE))
    groups = {name: sum(float(clock[phase]) for phase in phases) for name, phases in CLOCKS.items()}
    return {"total": total, "groups": groups | {"start, write": total - sum(groups.values())},
            "memory": max(summary["peak_memory_mb"] for summary in summaries),
            "disk": sum(os.path.getsize(os.path.join(folder, name)) for name in os.listdir(folder))/MEGABYTE,
            "increments": sum(len(summary["increments"]) for summary in summaries),
            "iterations": sum(summary["iterations"] for summary in summaries)}


def total_of(listing):
    """Seconds of a run until its listing was written: clocks run on from combination to combination"""
    found = re.search(r"^  total +(\S+)", listing, re.MULTILINE)
    return float(found[1]) if found else 0.0


def on_average(program, folder, once):
    """Means of what `once` finds of a deck, which begins with processor seconds, run after run; and the rates of the machine meanwhile:
    its speed changes within a tenth of a second where others share it"""
    tiny = os.path.join(folder, "tiny.dat")
    with open(tiny, "w", encoding="utf-8") as file:
        file.write(inputs("first"))
    found, probes = [], []
    while len(found) < LEAST_RUNS or len(found) < MOST_RUNS and sum(one[0] for one in found) < LEAST_SECONDS:
        probes += [counts(program, tiny, []) for _ in range(PROBES)]
        found.append(once())
    rates = {name: (statistics.harmonic_mean(probe[name][0] for probe in probes), probes[0][name][1]) for name in RATES}
    return [statistics.fmean(column) for column in zip(*found)], rates


def measure(program, decks, folder):
    """Of each deck: what is predicted with the usual and with the true number of iterations, and what it took"""
    rows = []
    out = os.path.join(folder, "out")
    os.makedirs(out, exist_ok=True)
    for name, (text, options) in decks.items():
        path = os.path.join(folder, name + ".dat")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        last = {}

        def once():
            last.update(run(program, path, options, out))
            return [last["total"], *last["groups"].values()]

        (total, *groups), rates = on_average(program, folder, once)
        found = last | {"total": total, "groups": dict(zip(last["groups"], groups))}
        usual = counts(program, path, options) | rates
        single, double = (counts(program, path, [*options, "--iterations", str(n)]) for n in (1, 2))
        each = found["iterations"]/max(1, found["increments"])
        true = {term: single[term][0] + (each - 1.0)*(double[term][0] - single[term][0]) if term in ("laws", "sums", "flexibility")
                else usual[term][0] for term in sum(GROUPS.values(), ())}
        rows.append({"deck": name, "found": found, "usual": usual, "true": true, "speeds": speeds(usual)})
    return rows


def measure_studies(program, folder):
    """A line for each study: rows, structures, processor seconds and memory, predicted and measured"""
    print("study        rows, structures  processor s   predicted  ratio     MB  predicted ratio")
    for name, (deck, table, options) in studies().items():
        paths = [os.path.join(folder, f"{name}.{ending}") for ending in ("csv", "dat")]
        for path, text in zip(paths, (table, deck)):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        # a process begins with the peak memory of the one that starts it: a small one in between
        def once():
            used = subprocess.run([sys.executable, "-c", USED, program, "study", *paths, "-o", tempfile.mkdtemp(dir=folder), "--quiet",
                                   *options], capture_output=True, text=True, check=True).stdout.split()
            return [float(used[0]), float(used[1])/1024.0]

        (total, memory), rates = on_average(program, folder, once)
        told = counts(program, paths[1], ["--study", paths[0], *options]) | rates
        size = re.match(r".*: (\d+) rows? on (\d+)", subprocess.run(
            [program, "estimate", paths[1], "--study", paths[0]], capture_output=True, text=True, check=True).stdout)
        speed = speeds(told)
        seconds = sum(told[term][0]*told[term][1]*speed[term] for term in speed)
        print(f"{name:12} {size[1]:>5}, {size[2]:>10} {total:12.3f} {seconds:11.3f} {seconds/total:6.2f} {memory:6.1f} "
              f"{told['memory'][0]:10.1f} {told['memory'][0]/memory:5.2f}")
    print()


def predicted(row, group, true=False):
    """Seconds of a group"""
    return sum((row["true"][term] if true else row["usual"][term][0])*row["usual"][term][1]*row["speeds"][term]
               for term in GROUPS[group])


def fit(rows, group):
    """Seconds of one of each term: the least sum over decks of |log(predicted/measured)|, each by the share of the group
    in its run; terms that go together keep their proportion, as a change by a factor costs a little, too"""
    terms = [term for term in GROUPS[group] if term not in ("reading", "ordering")]
    data = []
    for row in rows:
        known = sum(row["true"][term] for term in GROUPS[group] if term not in terms)
        data.append((known, [row["true"][term]*row["speeds"][term]*row["usual"][term][1] for term in terms],
                     max(1e-4, row["found"]["groups"][group]), row["found"]["groups"][group]/row["found"]["total"]))

    def miss(logs):
        factors = [math.exp(x) for x in logs]
        return STAY*sum(x*x for x in logs) + sum(
            share*abs(math.log((known + sum(f*c for f, c in zip(factors, each)) + 1e-6)/found))
            for known, each, found, share in data)

    logs, step = [0.0]*len(terms), 1.0
    least = miss(logs)
    while step > 0.02:
        better = False
        for k in range(len(terms)):
            for sign in (step, -step):
                tried = logs[:k] + [logs[k] + sign] + logs[k + 1:]
                value = miss(tried)
                if value < least:
                    logs, least, better = tried, value, True
        step = step if better else 0.6*step
    return {term: rows[0]["usual"][term][1]*math.exp(x) for term, x in zip(terms, logs)}


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
        measure_studies(args.axijoint, folder)
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
