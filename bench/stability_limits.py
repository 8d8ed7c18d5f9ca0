"""Hard cases that end in words as well as numbers: capacities, cycles, units, no load, no support"""
import os

import hard_decks
import hard_scenes as scenes
import numpy as np
from stability_case import EPSILON, EXPECTED, FAILED, LIMITED, Case, Finding, judged
from stability_joints import TOLERANCE, difference
from support import HERE, read_text


def below(make):
    """99 % of a capacity is carried"""
    def check(runs):
        ran = runs.attempt("below", make(0.99))
        if ran.code != 0:
            return Finding(FAILED, words=f"exit code {ran.code} at 99 %: {ran.messages[:200]}")
        return judged(ran.summary["part_equilibrium_error"], 10*TOLERANCE)

    return check


def beyond(make, motion):
    """101 % of a capacity: a mechanism that is named, within a 64th of the increment below the capacity"""
    def check(runs):
        text = make(1.01)
        ran = runs.attempt("beyond", text)
        said = "no equilibrium was found beyond the load factor" in ran.messages and motion in ran.messages
        if ran.code != 4 or not said:
            return Finding(FAILED, words=f"exit code {ran.code}: {ran.messages[:200]}")
        reached = float(ran.messages.split("beyond the load factor ")[1].split(":")[0])
        share = reached - 1 if "INCREMENTS" in text else 1.01*reached
        error, bar = abs(1 - share), 0.01 + 1.01/64
        return Finding(EXPECTED if error <= bar else FAILED, error, bar,
                       f"exit code 4, a part {motion or 'moves'}")

    return check


def capacities():
    """Two rows a capacity"""
    for name, (make, motion) in scenes.CAPACITIES.items():
        yield Case(f"capacity: {name}", "99 % of the load", "exact capacity; forces out of balance",
                   "10 × tolerance 1e-6", below(make))
        yield Case(f"capacity: {name}", "101 % of the load", "exact capacity; load carried last",
                   "1 % + last halving of the increment, 1/64", beyond(make, motion))


def cycles(runs):
    """The reversible law has no state, and the program says what it found in its place"""
    ran = runs.attempt("cycle", scenes.example(2, factor=10.0, bond=False, tolerance=TOLERANCE))
    if ran.code != 0 or "cohesion fades over an opening" not in ran.messages:
        return Finding(FAILED, words=f"exit code {ran.code}: {ran.messages[:200]}")
    return Finding(EXPECTED, words="converged, and says where and over which opening cohesion fades")


def bonds(runs):
    """The same scene with the bond law has a state, by Newton and by the loop"""
    found = []
    for method in ("NEWTON", "TOTAL"):
        runs.run(f"bond_{method}", scenes.example(2, factor=10.0, tolerance=1e-10, most=20000, method=method))
        found.append(runs.results(f"bond_{method}"))
    return judged(difference(*found), 1e-8)


def in_units(make):
    """One scene in three systems of units: results in the first, and the same iterations"""
    def check(runs):
        found, counts, condition = [], [], 0.0
        for units in scenes.UNITS:
            results = runs.run(units.name, make(units))
            counts.append(runs.tally.iterations[-1])
            condition = max(condition, runs.condition(units.name))
            found.append([np.array(list(results.displacement.values()))/units.length,
                          results.joints["jump"]/units.length,
                          results.joints["stress"]/units.of(1.0, *scenes.STRESS)])
        error = max(np.abs(a - b).max()/np.abs(b).max() for one in found[1:] for a, b in zip(one, found[0]))
        rounding = 100*EPSILON*condition
        finding = judged(error, 1e-10, f"{error:.1e} instead of 1e-10, within what rounding may leave: 100 ε × "
                         f"condition = {rounding:.0e}")
        if len(set(counts)) > 1:
            finding = Finding(FAILED, error, 1e-10, f"iterations differ: {counts}")
        elif finding.verdict == LIMITED and error > rounding:
            finding = Finding(FAILED, error, 1e-10, f"more than 100 ε × condition = {rounding:.0e}")
        return finding

    return check


def units():
    """A row a scene"""
    for name, make in hard_decks.IN_UNITS.items():
        yield Case(f"units: {name}", "m-MN, mm-N, ft-kip", "the scene in m-MN; same iterations", "1e-10",
                   in_units(make))


def no_load(runs):
    """Loads of zero, and no loads at all: nothing moves"""
    decks = []
    for number in (1, 3):
        text = scenes.example(number)
        decks.append(text.replace("LATERAL, 0.4", "LATERAL, 0.0").replace("MOMENT, 0.8", "MOMENT, 0.0"))
        decks.append(text[:text.index("RESULTANTS")] + text[text.index("INCREMENTS"):])
    error = 0.0
    for i, deck in enumerate(decks):
        results = runs.run(f"zero_{i}", deck)
        error = max([error, *(np.abs(values).max() for values in results.displacement.values()),
                     np.abs(results.joints["stress"]).max()])
    return judged(error, 0.0)


def free_body(path):
    """A deck that lacks a support: exit code 4, the free motion in words, no results"""
    text = read_text(path)
    said = [line.split("says: ")[1] for line in text.splitlines() if line.startswith("! says: ")]

    def check(runs):
        ran = runs.attempt("free", text)
        good = (ran.code == 4 and all(words in ran.messages for words in said)
                and not (runs.directory/"free.h5").exists())
        return Finding(EXPECTED if good else FAILED, words=f"exit code {ran.code}; {said[0]}")

    lines = text.splitlines()
    return Case(f"unrestrained: {lines[lines.index('TITLE') + 1]}", "", "",
                "exit code 4, the motion named, no results", check)


def unrestrained():
    """A row a deck of test/decks/unsolved"""
    folder = os.path.join(HERE, "unsolved")
    return [free_body(os.path.join(folder, name)) for name in sorted(os.listdir(folder))
            if name.startswith("free_")]


CASES = [*capacities(),
         Case("reversible law that cycles", "case 2, joints × 10", "", "equilibrium with cohesion that fades, said",
              cycles),
         Case("the same with BOND", "case 2, joints × 10", "self-consistent: method TOTAL",
              "100 × tolerance 1e-10", bonds),
         *units(),
         Case("zero load", "loads of 0, and none; cases 1 and 3", "exact: 0", "exactly 0", no_load),
         *unrestrained()]
