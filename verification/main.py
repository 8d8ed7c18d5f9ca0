"""Runs the cases and rewrites the tables of the manual. See scripts/verify."""
import argparse
import concurrent.futures
import os
import pathlib
import sys
import tempfile
import time

import overview
import report
import residual
from cases import all_cases
from program import Program, ProgramError

MANUAL = pathlib.Path(__file__).resolve().parent.parent/"doc"/"verification.md"


def arguments():
    """Command line"""
    parser = argparse.ArgumentParser(prog="scripts/verify", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="cases (default: all)")
    parser.add_argument("--list", action="store_true", help="print the names of the cases")
    parser.add_argument("--check", action="store_true", help="leave the manual as it is")
    parser.add_argument("--long", action="store_true", help="cases that take minutes, too")
    parser.add_argument("-o", dest="directory", type=pathlib.Path, help="keep decks and results here")
    parser.add_argument("--program", required=True, help=argparse.SUPPRESS)
    return parser.parse_args()


def residual_line(solutions):
    """Checks the solutions of a case; a sentence about their residuals"""
    found = [residual.check(solution) for solution in solutions]
    if not found:
        return []
    worst = {name: report.rounding(max(f[name] for f in found)) for name in found[0]}
    surface = f", surface conditions {worst['surface']}" if any(s.surface for s in solutions) else ""
    return [f"Residuals of the exact solution: equilibrium {worst['equilibrium']}, Hooke's law "
            f"{worst['hooke']}{surface}."]


def run_case(case, path, directory):
    """Runs one case: blocks for the manual and misses"""
    try:
        blocks = residual_line(case.solutions)
        tables, misses = case.run(Program(path, directory))
        return blocks + tables, misses
    except (residual.ResidualError, ProgramError) as error:
        return [], [f"{case.name}: {error}"]


def run_cases(cases, args, directory):
    """Runs cases side by side, prints each when it is done, in order; results by name"""
    results = {}
    with concurrent.futures.ProcessPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        jobs = [(case, pool.submit(run_by_name, case.name, args.program, directory))
                for case in cases]
        for case, job in jobs:
            blocks, misses = results[case.name] = job.result()
            print(f"## {case.name}\n", *blocks, *(f"MISSED: {words}" for words in misses),
                  sep="\n", end="\n\n", flush=True)
    return results


def run_by_name(name, path, directory):
    """Runs a case in a process of its own"""
    return run_case(next(case for case in all_cases() if case.name == name), path, directory)


def main():
    """Run, print, rewrite the manual; exit code 1 if a bar is missed, 2 for a wrong name"""
    args = arguments()
    cases = all_cases()
    names = [case.name for case in cases]
    if args.list:
        print(*names, sep="\n")
        return 0
    unknown = set(args.names) - set(names)
    if unknown:
        print(f"verify: no such case: {', '.join(sorted(unknown))}; --list shows all", file=sys.stderr)
        return 2
    misplaced = report.misplaced(MANUAL.read_text(encoding="utf-8"), names)
    if misplaced and not args.check:
        print(f"verify: {MANUAL.name} does not have one place each for: {', '.join(misplaced)}",
              file=sys.stderr)
        return 2
    started = time.monotonic()
    wanted = [case for case in cases if (case.name in args.names if args.names
                                         else args.long or not getattr(case, "long", False))]
    with tempfile.TemporaryDirectory() as scratch:
        directory = args.directory or pathlib.Path(scratch)
        directory.mkdir(parents=True, exist_ok=True)
        results = run_cases(wanted, args, directory)
    misses = [words for _, missed in results.values() for words in missed]
    if not args.check:
        manual = MANUAL.read_text(encoding="utf-8")
        for name, (blocks, missed) in results.items():
            if not missed:
                manual = report.insert(manual, name, blocks)
        manual = overview.insert(manual)
        MANUAL.write_text(manual, encoding="utf-8")
    rows = sum(block.count("\n") - 1 for blocks, _ in results.values() for block in blocks
               if block.startswith("|"))
    print(f"{len(wanted)} cases, {rows} rows, {time.monotonic() - started:.0f} s; "
          f"{len(misses)} bars missed")
    print(*(words.splitlines()[0] for words in misses), sep="\n")
    return 1 if misses else 0


if __name__ == "__main__":
    sys.exit(main())
