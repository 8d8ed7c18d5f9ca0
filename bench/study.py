"""A study beside runs: seconds a row beside one whole run, and how far rows are from runs of the same values. See
scripts/bench and doc/studies.md."""
import argparse
import csv
import json
import os
import random
import re
import statistics
import subprocess
import tempfile
import time

HERE = os.path.dirname(os.path.realpath(__file__))
DECK = os.path.join(HERE, "..", "inputs", "case3_balanced.dat")
COMPARED = ("largest_displacement", "largest_pressure", "work", "energy")


def finer(factor):
    """Case 3 with friction, gaps, and so many times as many elements along each side"""
    text, section, lines = open(DECK, encoding="utf-8").read(), "", []
    for line in text.split("\n"):
        section = line.split()[0] if line[:1].isalpha() else section
        sizes = re.match(r"^( +\d+ +\d+ +\d+) +(\d+) +(\d+)$", line)
        if section == "BLOCKS" and sizes:
            line = f"{sizes[1]}{int(sizes[2])*factor:5d}{int(sizes[3])*factor:5d}"
        lines.append(line)
    return "\n".join(lines).replace("BLOCKS\n", "LAWDETAILS\n    1\nBLOCKS\n", 1)


def with_values(text, phi, c, gap):
    """The deck with the values of a row"""
    law = "    1     1.0E4     2.0E4     1.0E4"
    text = re.sub(re.escape(law) + " +[0-9.]+ +[0-9.]+", f"{law}{c:>10}{phi:>10}", text)
    return text.replace("LAWDETAILS\n    1\n", f"LAWDETAILS\n    1{'':50}{gap:>10}\n")


def timed(words):
    """Seconds of a command"""
    start = time.perf_counter()
    subprocess.run(words, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return time.perf_counter() - start


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--axijoint", required=True)
    parser.add_argument("--quick", action="store_true")
    args = parser.parse_args()
    phi, c, gap = ("0:38/5", "0:0.3/4", "0; 5E-5") if args.quick else ("0:38/20", "0:0.38/20", "0; 2E-5; 5E-5; 1E-4; 2E-4")
    with tempfile.TemporaryDirectory() as folder:
        deck, table = os.path.join(folder, "case3.dat"), os.path.join(folder, "rows.csv")
        text = finer(4)
        for path, content in ((deck, text), (table, f"LAWS 1 PHI, LAWS 1 C, LAWDETAILS 1 GAP\n{phi}, {c}, {gap}\n")):
            with open(path, "w", encoding="utf-8") as file:
                file.write(content)
        print(f"load average {os.getloadavg()[0]:.1f}, OMP_NUM_THREADS={os.environ.get('OMP_NUM_THREADS', '')}")
        print(subprocess.run([args.axijoint, "study", table, deck, "-o", folder, "--processes", "1"], check=False, capture_output=True,
                             text=True).stdout)
        with open(os.path.join(folder, "rows.study.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        seconds, worst, others = [], dict.fromkeys(COMPARED, 0.0), 0
        for row in random.Random(1).sample(rows, 9):
            one = os.path.join(folder, "one.dat")
            with open(one, "w", encoding="utf-8") as file:
                file.write(with_values(text, *(f"{float(row[name]):.8g}" for name in list(row)[1:4])))
            summary = one[:-4] + ".json"
            if os.path.exists(summary):
                os.remove(summary)
            seconds.append(timed([args.axijoint, "run", one, "-o", folder, "--quiet"]))
            with open(summary, encoding="utf-8") as file:
                found = json.load(file)
            others += str(found["exit_code"]) != row["exit_code"]
            for name in COMPARED:
                wanted = found["increments"][-1][name]
                worst[name] = max(worst[name], abs(float(row[name]) - wanted)/abs(wanted))
        everywhere = timed([args.axijoint, "study", table, deck, "-o", os.path.join(folder, "all")])/len(rows)
    row = statistics.median(float(row["seconds"]) for row in rows)
    run = statistics.median(seconds)
    print(f"a run {run:.3f} s (median of {len(seconds)}), a row by one process {row:.4f} s (median): 1/{run/row:.1f} of it")
    print(f"as a study is solved if nothing is said of processes, {everywhere:.4f} s a row (whole study over its rows): "
          f"1/{run/everywhere:.1f} of a run (bar: 1/20)")
    print("largest differences of these runs to their rows: "
          + ", ".join(f"{name} {value:.0e}" for name, value in worst.items()) + f"; other exit codes: {others}")


if __name__ == "__main__":
    main()
