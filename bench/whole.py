"""Whole runs: what of their time is the analysis, assembly, factorization and one solution that nobody can do without, and what
is all the rest; a history with joints beside its elastic analysis; and both beside earlier commits. See scripts/bench."""
import argparse
import csv
import json
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time

import bounds
import estimate_decks

HERE = os.path.dirname(os.path.realpath(__file__))
RECORD = os.path.join(HERE, "history.csv")
COLUMNS = ("processor", "commit", "threads", "job", "unknowns", "processor_seconds", "seconds", "error_percent", "load",
           "kernels")
PHASES = ("read", "assemble", "factor", "joints", "recover", "write")


def linear(across, along):
    """A body held below, with tractions of two harmonics above: 8-node elements"""
    return estimate_decks.solid(0.0, 3.0, 4.0, across, along, [0, 1], nodes=8)


def case3(factor):
    """The paper's case 3, finer by a factor"""
    return estimate_decks.finer(estimate_decks.inputs("case3_balanced"), factor)


def monopile(factor, elastic=False, stiffer=1.0):
    """A pile with weight, stress of the ground before it, gap and friction, pushed and half let go, perhaps with joints so many
    times stiffer; or its elastic analysis, all loads at once on joints that neither open nor slip, in as many harmonics, which
    next to nothing loads"""
    text = estimate_decks.finer(estimate_decks.with_harmonics(estimate_decks.inputs("monopile"), 8, 33), factor)
    if elastic:
        text = re.sub(r"^(LAWS.*\n +1 +100.0 +200.0 +100.0) +0.0 +26.0$", r"\1" + " "*20 + "ELASTIC", text, flags=re.MULTILINE)
        text = re.sub(r"^(LAWDETAILS|INCREMENTS).*\n(?: .*\n)+", "", text, flags=re.MULTILINE)
        loads = "".join(f"{1:5}{m:5}{'1.0E-6':>10}\n" for m in range(2, 9))
        text = text.replace("COMBINE ", f"PRESSURES\n{loads}COMBINE ", 1)
    law = "".join(f"{k:10}" for k in (100.0, 200.0, 100.0))
    if law not in text:
        raise AssertionError("inputs/monopile.dat has another law of joints")
    return text.replace(law, "".join(f"{stiffer*k:10}" for k in (100.0, 200.0, 100.0)))


JOBS = {"linear 10k": lambda: linear(30, 37), "linear 30k": lambda: linear(50, 67), "linear 100k": lambda: linear(90, 123),
        "linear 300k": lambda: linear(160, 208), "linear 1M": lambda: linear(290, 382),
        **{f"case 3, {n} times": lambda n=n: case3(n) for n in (1, 2, 4, 8)}}
HISTORIES = {**{f"monopile, {n} times": lambda n=n: (monopile(n), monopile(n, True)) for n in (1, 2, 3)},
             # k h/E up to 1600, which the program calls stiff out of proportion
             "monopile, 100 k": lambda: (monopile(1, stiffer=100.0), monopile(1, True, stiffer=100.0))}


class Pair:
    """A job that runs twice at once, each by one thread: what the machine lets two threads do that share nothing"""

    def __init__(self, program, text):
        self.runs = [Run(program, text, 1) for _ in range(2)]
        self.clocks = []

    def once(self):
        """Run both once more"""
        for run, process in [(run, run.begin()) for run in self.runs]:
            run.end(process)
        self.clocks.append(statistics.mean(run.clocks[-1] for run in self.runs))

    def finish(self):
        """Find the median of the seconds of either"""
        self.clock = statistics.median(self.clocks)
        for run in self.runs:
            run.finish()
        return self


class Run:
    """A job that is run some times: medians of its times, and what its summary says"""

    def __init__(self, program, text, workers=None):
        self.program = program
        self.environment = os.environ | ({"OMP_NUM_THREADS": str(workers)} if workers else {})
        self.folder = tempfile.TemporaryDirectory()
        self.deck = os.path.join(self.folder.name, "job.dat")
        self.times, self.clocks, self.parts, self.writings = [], [], [], []
        with open(self.deck, "w", encoding="utf-8") as file:
            file.write(text)

    def once(self):
        """Run it once more"""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        process = self.begin()
        process.wait()
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.times.append(after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime)
        self.end(process)

    def begin(self):
        """Start it"""
        return subprocess.Popen([self.program, "run", self.deck, "-o", self.folder.name, "--quiet"], stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True, env=self.environment)

    def end(self, process):
        """Wait for its end and read what it says"""
        _, said = process.communicate()
        if process.returncode:
            raise SystemExit(f"exit code {process.returncode}: {said}")
        with open(self.deck[:-4] + ".json", encoding="utf-8") as file:
            self.summary = json.load(file)
        with open(self.deck[:-4] + ".lis", encoding="utf-8") as file:
            listing = file.read()
        self.listing = len(listing)  # bytes
        self.written = sum(os.path.getsize(self.deck[:-4] + ending) for ending in (".lis", ".json", ".h5"))
        self.writings.append(float(re.findall(r"^  write +\S+ +(\S+)", listing, re.MULTILINE)[-1]))
        self.clocks.append(self.summary["seconds"]["total"])
        self.parts.append([*(self.summary["seconds"][name] for name in PHASES), self.summary["increment_seconds"],
                           sum(self.summary["error_seconds"].values())])

    def finish(self):
        """Find the medians"""
        self.folder.cleanup()
        self.writing = min(self.writings)  # processor seconds until the listing ends
        self.processor, self.clock = statistics.median(self.times or [0.0]), statistics.median(self.clocks)
        *self.phases, self.increments, self.estimates = (statistics.median(column) for column in zip(*self.parts))
        self.unknowns = self.summary["unknowns"]
        errors = self.summary.get("errors") or {}
        total = errors.get("sum", {}) if isinstance(errors, dict) else {}
        self.error = 100*(total.get("displacement") or 0.0)
        self.iterations = self.summary["iterations"]
        return self

    def needed(self):
        """Seconds of assembling, with orders and analysis, factorization and solution, without estimates of errors"""
        return sum(self.phases[1:4]) - self.estimates


def by_turns(rounds, *runs):
    """Run jobs one after the other, again and again: what a machine does meanwhile meets all of them"""
    for _ in range(rounds):
        for run in runs:
            run.once()
    return [run.finish() for run in runs]


def processor():
    """The make of the processor: its name, family and model where that names no product, since some hosts call very different
    makes by one name; and that it has no AVX-512"""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        text = file.read()
    name, family, model = ((re.findall(rf"^{key}\s*:\s*(.*)", text, re.MULTILINE) or [""])[0].strip()
                           for key in ("model name", "cpu family", "model"))
    if not re.search(r"\d", name):
        name = f"{name} family {family} model {model}"
    return name + ("" if re.search(r"\bavx512f\b", text) else " without AVX-512")


def kernels():
    """Kernels of matrix products that are asked for: by the user, or as the program does (scripts/environment)"""
    return os.environ.get("OPENBLAS_CORETYPE", "as the library chooses")


def commit():
    """The commit, with a plus if files were changed since"""
    short = subprocess.run(["git", "-C", HERE, "describe", "--always", "--dirty=+"], check=False, capture_output=True, text=True)
    return short.stdout.strip() or "unknown"


def threads():
    """Threads that runs may take"""
    return os.environ.get("OMP_NUM_THREADS") or str(os.cpu_count())


def record(rows):
    """Append lines of jobs"""
    new = not os.path.exists(RECORD)
    with open(RECORD, "a", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if new:
            writer.writerow(COLUMNS)
        for job, run in rows:
            writer.writerow([processor(), commit(), threads(), job, run.unknowns, f"{run.processor:.3f}", f"{run.clock:.3f}",
                             f"{run.error:.3g}", f"{os.getloadavg()[0]:.1f}", kernels()])


def head():
    """What the figures are of"""
    print(f"{processor()}, kernels {kernels()}, {threads()} threads, load average {os.getloadavg()[0]:.1f}, commit {commit()}")


def whole(args):
    """Linear jobs and case 3: shares of the phases, and the whole over what is needed"""
    head()
    print(f"{'job':16} {'unknowns':>9} {'seconds':>8} {'processor':>9} " + " ".join(f"{name:>8}" for name in PHASES)
          + "  estimates  whole/needed  estimated error")
    rows, shares, files = [], [], {}
    machine = bounds.Machine(args.axijoint, threads())
    for job, make in JOBS.items():
        if args.quick and job in ("linear 300k", "linear 1M", "case 3, 8 times") or not args.full and job == "linear 1M":
            continue
        run = Run(args.axijoint, make())
        for _ in range(args.rounds):
            run.once()
        files[job] = objects(run.deck[:-4] + ".h5", run.folder.name)
        rows.append((job, run.finish()))
        shares.append((job, run, *bounds.least_seconds(args.axijoint, make(), run, machine)))
        print(f"{job:16} {run.unknowns:9} {run.clock:8.3f} {run.processor:9.3f} "
              + " ".join(f"{100*part/run.clock:7.1f}%" for part in run.phases)
              + f"  {100*run.estimates/run.clock:8.1f}%  {run.clock/max(run.needed(), 1e-9):12.2f}  {run.error:.3g} %", flush=True)
    print(f"bounds of these shares: {machine}")
    print(f"{'job':16} {'':27} " + " ".join(f"{name:>8}" for name in PHASES) + "   sum  fresh memory")
    for job, run, least, touching in shares:
        print(f"{job:16} {'':27} " + " ".join(f"{100*least[name]/run.clock:7.1f}%" for name in PHASES)
              + f"  {100*sum(least.values())/run.clock:3.0f}%  {100*touching/run.clock:11.0f}%")
    floor(rows, files)
    text(args)
    start(args)
    pauses(args)
    batches(args)
    return rows


def floor(rows, files):
    """The least whole/needed of a run that does what is needed and writes its results file, which takes HDF5 some time whatever the
    values are"""
    print("least whole/needed of a run that reads, estimates and lists nothing: milliseconds of what is needed, of as many bytes in as "
          "many arrays by HDF5")
    for job, run in rows:
        if files[job]:
            written = float(files[job][2])
            print(f"{job:16} {1e3*run.needed():9.1f} {written:8.2f} {1.0 + 1e-3*written/run.needed():8.2f}")


def text(args):
    """Numbers to text: bytes of the listing over processor seconds of writing it, all tables less none"""
    job = linear(50, 67)
    runs = by_turns(args.rounds, *(Run(args.axijoint, job.replace("END\n", f"PRINT\n    TABLES{rows:>10}\nEND\n"))
                                   for rows in ("ALL", "NONE")))
    bytes_more, seconds_more = (getattr(runs[0], name) - getattr(runs[1], name) for name in ("listing", "writing"))
    print(f"tables as text: {bytes_more/1e6:.1f} MB in {seconds_more:.3f} s, {bytes_more/1e6/max(seconds_more, 1e-9):.0f} MB/s")


def start(args):
    """What the start costs: the smallest deck beside the program that does nothing, one that only loads its libraries, and an empty
    one; least and median milliseconds of a processor, and by the clock"""
    with tempfile.TemporaryDirectory() as folder:
        source, empty, loads = (os.path.join(folder, name) for name in ("empty.c", "empty", "loads"))
        with open(source, "w", encoding="utf-8") as file:
            file.write("int main(void) { return 0; }\n")
        needed = re.findall(r"NEEDED.*\[(.*)\]", subprocess.run(["readelf", "-d", args.axijoint], check=True, capture_output=True,
                                                               text=True).stdout)
        paths = dict(re.findall(r"(\S+) => (\S+)", subprocess.run(["ldd", args.axijoint], check=True, capture_output=True,
                                                                  text=True).stdout))
        subprocess.run(["gcc", source, "-o", empty], check=True)
        subprocess.run(["gcc", source, "-o", loads, "-Wl,--no-as-needed", *(paths[name] for name in needed if name in paths)], check=True)
        print(f"start: {len(paths)} libraries; milliseconds of a processor, least and median of {6*args.rounds}, and by the clock")
        deck = os.path.join(HERE, "..", "inputs", "first.dat")
        commands = (("an empty program", [empty]), ("that loads the libraries", [loads]),
                    ("axijoint --version", [args.axijoint, "--version"]),
                    ("run inputs/first.dat", [args.axijoint, "run", deck, "-o", folder, "--quiet"]))
        times = [[] for _ in commands]
        for _ in range(6*args.rounds):
            for (_, words), found in zip(commands, times):
                before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
                subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
                ended, after = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
                found.append((1e3*(after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime), 1e3*(ended - begun)))
        for (what, _), found in zip(commands, times):
            print(f"  {what:26}" + "  ".join(f" {min(one):6.1f} {statistics.median(one):6.1f}" for one in zip(*found)))
        with open(os.path.join(folder, "first.json"), encoding="utf-8") as file:
            phases = json.load(file)["seconds"]
        print("  its phases by the clock:    " + ", ".join(f"{name} {1e3*phases[name]:.1f}" for name in PHASES))
        found = objects(os.path.join(folder, "first.h5"), folder)
        if found:
            arrays, attributes, least, median = found
            print(f"  its {arrays} arrays and {attributes} attributes by HDF5 alone, which is started already: {least}, {median} by the clock")


def pauses(args):
    """Runs after a pause beside runs that follow at once, by turns; medians by the clock. Hosts of virtual machines may take memory
    that nobody uses, and give it back page by page when it is first touched: who starts one run waits for that"""
    seconds = 4.0
    print(f"after a pause of {seconds:.0f} s: milliseconds, of a run that follows at once, ratio, peak memory [MB]")
    for job, make in {"inputs/first.dat": lambda: estimate_decks.inputs("first"), **{name: JOBS[name] for name in ("case 3, 4 times", "linear 30k")}}.items():
        rested, next_one = (Run(args.axijoint, make()) for _ in range(2))
        for _ in range(args.rounds):
            time.sleep(seconds)
            rested.once()
            next_one.once()
        first, second = rested.finish(), next_one.finish()
        print(f"  {job:26} {1e3*first.clock:8.1f} {1e3*second.clock:8.1f}   {first.clock/second.clock:.2f} {first.summary['peak_memory_mb']:6.0f}",
              flush=True)


def batches(args):
    """Many decks: one after the other by all threads, and one a process by as many processes, by turns; medians by the clock"""
    print(f"batches, {threads()} threads; milliseconds of a deck one after the other, by processes, ratio")
    for what, n, deck in (("inputs/first.dat", 40, estimate_decks.inputs("first")), ("inputs/monopile.dat", 12, estimate_decks.inputs("monopile"))):
        with tempfile.TemporaryDirectory() as folder:
            decks = [os.path.join(folder, f"{k}.dat") for k in range(n)]
            for path in decks:
                with open(path, "w", encoding="utf-8") as file:
                    file.write(deck)
            ways = ([], ["--processes", str(threads())])
            times = [[] for _ in ways]
            for _ in range(args.rounds):
                for options, found in zip(ways, times):
                    begun = time.perf_counter()
                    subprocess.run([args.axijoint, "run", *decks, "-o", folder, "--quiet", "--threads", str(threads()), *options], check=True)
                    found.append(1e3*(time.perf_counter() - begun)/n)
        after, apart = (statistics.median(found) for found in times)
        print(f"  {n} decks like {what:20} {after:8.1f} {apart:8.1f}   {after/apart:.2f}", flush=True)


def objects(path, folder):
    """Numbers of arrays and attributes of a results file, and least and median milliseconds by the clock of writing them alone;
    nothing where HDF5 is not where Debian has it"""
    program = os.path.join(folder, "objects")
    options = subprocess.run(["pkg-config", "--cflags", "--libs", "hdf5-serial"], check=False, capture_output=True, text=True).stdout
    archives = os.path.join(HERE, "..", "build", "archives")  # as the program has it, where there are any
    if not options or subprocess.run(["gcc", "-O2", os.path.join(HERE, "rates", "hdf5_objects.c"), "-o", program, "-L" + archives,
                                      *options.split()], check=False).returncode:
        return []
    return subprocess.run([program, path, os.path.join(folder, "objects.h5")], check=True, capture_output=True, text=True).stdout.split()


def history(args):
    """Histories with joints beside their elastic analyses in the same harmonics: the seconds of the increments over those of
    the elastic analysis, without its estimates of errors and with them; two threads beside one, by the clock, and what the
    machine allows: twice the seconds of a run by one thread over those of two such runs at once"""
    head()
    print("increments over elastic analysis, without and with its estimates: bar 1; two threads: bar 1.7 times as fast, of which two "
          "runs at once allow what is said behind")
    print(f"{'job':18} {'unknowns':>9} {'iterations':>10} {'seconds':>8} {'increments':>10} {'estimates':>9} {'elastic':>8} "
          f"{'increments/elastic':>18} {'with estimates':>14} {'whole/elastic':>13} {'two threads':>11} {'allowed':>7}  estimated error")
    rows = []
    for job, make in HISTORIES.items():
        if args.quick and job != "monopile, 1 times":
            continue
        text, elastic_text = make()
        run, elastic, two, pair = by_turns(args.rounds, Run(args.axijoint, text, 1), Run(args.axijoint, elastic_text, 1),
                                           Run(args.axijoint, text, 2), Pair(args.axijoint, text))
        rows.append((job, run if threads() == "1" else two))
        alone = elastic.clock - elastic.estimates
        print(f"{job:18} {run.unknowns:9} {run.iterations:10} {run.clock:8.3f} {run.increments:10.3f} {run.estimates:9.3f} {alone:8.3f} "
              f"{run.increments/alone:18.2f} {run.increments/elastic.clock:14.2f} {run.clock/elastic.clock:13.2f} "
              f"{run.clock/two.clock:11.2f} {2.0*run.clock/pair.clock:7.2f}  {run.error:.3g} %", flush=True)
    return rows


def check(args):
    """Some jobs beside the last line of the same make of processor, number of threads and, where it tells them, kernels"""
    head()
    if not os.path.exists(RECORD):
        raise SystemExit("there is no bench/history.csv yet: scripts/bench whole --record writes it")
    with open(RECORD, encoding="utf-8") as file:
        last = {row["job"]: row for row in csv.DictReader(file)
                if (row["processor"], row["threads"]) == (processor(), threads()) and row["kernels"] in ("", kernels())}
    if not last:
        raise SystemExit("bench/history.csv has no line of this make and number of threads yet: scripts/bench whole --record")
    print(f"{'job':18} {'processor':>9} {'before':>8} {'ratio':>6}  estimated error, before  commit")
    for job, make in {**JOBS, **HISTORIES}.items():
        if job not in last or args.quick and float(last[job]["processor_seconds"]) > 3.0:
            continue
        text = make()
        run, = by_turns(args.rounds, Run(args.axijoint, text if isinstance(text, str) else text[0]))
        before = last[job]
        print(f"{job:18} {run.processor:9.3f} {float(before['processor_seconds']):8.3f} "
              f"{run.processor/float(before['processor_seconds']):6.2f}  {run.error:.3g} %, {before['error_percent']} %  {before['commit']}",
              flush=True)
    return []


def main():
    """The command"""
    parser = argparse.ArgumentParser()
    parser.add_argument("question", choices=("whole", "history", "check"))
    parser.add_argument("--axijoint", required=True)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--record", action="store_true")
    args = parser.parse_args()
    args.rounds = 3 if args.quick else 5
    rows = {"whole": whole, "history": history, "check": check}[args.question](args)
    if args.record:
        record(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
