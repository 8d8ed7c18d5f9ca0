"""What a row of the stability table is: a case with its bar, stated first, and what a run found"""
import dataclasses
import json
import math
import os
import subprocess
from typing import Callable

import h5py
from program import Program, ProgramError, Results

EPSILON = 2.0**-52
# Words of a verdict
OK, EXPECTED, LIMITED, FAILED = VERDICTS = ("ok", "as expected", "limited", "FAILED")


@dataclasses.dataclass
class Case:
    """A row before it is run. `reference` says what the error is measured against, `bar` where its
    bar comes from; `check` runs the decks and returns a Finding"""
    name: str
    scope: str
    reference: str
    bar: str
    check: Callable


@dataclasses.dataclass
class Finding:
    """What a case found: verdict, worst error and its bar (None: no number), what there is to say"""
    verdict: str
    error: float = None
    bar: float = None
    words: str = ""


def judged(error, bar, limit=None):
    """ok within the bar; beyond it limited, if a limit was stated for the case, else FAILED. An error
    of 1 and more, no digit right, is FAILED whatever was stated"""
    if error <= bar:
        return Finding(OK, error, bar)
    return Finding(LIMITED if limit and error < 1 else FAILED, error, bar, limit or "")


def worst(found, limit=None):
    """Judges the (error, bar, where) that comes nearest to its bar or is farthest beyond it; NaN is
    beyond all"""
    error, bar, where = max(found, key=lambda one: math.inf if math.isnan(one[0]) else one[0]/one[1])
    finding = judged(error, bar, limit)
    if finding.verdict != OK:
        beyond = [f"{at}: {e:.1e}" for e, b, at in found if not e <= b and at]
        places = "beyond the bar: " + ", ".join(beyond) if where else ""
        finding.words = "; ".join(filter(None, [limit, places]))
    return finding


@dataclasses.dataclass
class Tally:
    """What runs needed: iterations of each, worst backward error, worst residual over its tolerance"""
    iterations: list = dataclasses.field(default_factory=list)
    backward: list = dataclasses.field(default_factory=list)
    residual: list = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class Attempt:
    """A run that may end in any way"""
    code: int
    messages: str
    summary: dict


def stem(name):
    """A name as that of a file"""
    return "".join(c if c.isalnum() or c in "._-" else "_" for c in name)


class Runs(Program):
    """The program, with a tally of its runs"""

    def __init__(self, path, directory):
        super().__init__(path, directory)
        self.tally = Tally()

    def run(self, name, text):
        """Runs a deck that must be solved; its results"""
        results = super().run(stem(name), text)
        self._count(name)
        return results

    def attempt(self, name, text):
        """Runs a deck, however it ends"""
        deck = self.directory/f"{name}.dat"
        deck.write_text(text)
        for ending in ("json", "h5", "lis"):
            (self.directory/f"{name}.{ending}").unlink(missing_ok=True)
        done = subprocess.run([self.path, "run", deck, "-o", self.directory, "--threads", "1"], check=False,
                              capture_output=True, text=True, env=os.environ)
        summary = self.summary(name)
        if (self.directory/f"{name}.h5").exists():
            self._count(name)
        return Attempt(done.returncode, " ".join([*summary.get("messages", []), done.stderr]), summary)

    def summary(self, name):
        """The summary of a run, empty if there is none"""
        path = self.directory/f"{stem(name)}.json"
        return json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}

    def results(self, name):
        """All arrays that the tables need"""
        return Results(self.directory/f"{stem(name)}.h5")

    def condition(self, name):
        """Largest condition of an equation system of a run"""
        with h5py.File(self.directory/f"{stem(name)}.h5") as file:
            return float(file["equations/condition"][()].max())

    def _count(self, name):
        summary = self.summary(name)
        with h5py.File(self.directory/f"{stem(name)}.h5") as file:
            self.tally.backward.append(float(file["equations/backward_error"][()].max(initial=0.0)))
        self.tally.iterations.append(summary["iterations"])
        if summary["residual_ratio"] is not None:
            self.tally.residual.append(summary["residual_ratio"])


HEADINGS = ("case", "range", "reference", "bar from", "worst error", "its bar", "iterations",
            "backward error", "residual ratio", "verdict", "remark")


def row(case, runs):
    """Runs a case: a row of the table, as words"""
    runs.tally = Tally()
    try:
        found = case.check(runs)
    except (ProgramError, LookupError, OSError, ValueError) as error:
        found = Finding(FAILED, words=f"{type(error).__name__}: {str(error).splitlines()[-1]}")
    if found.verdict not in VERDICTS or (found.verdict == OK and (not case.reference or found.error is None)):
        found = Finding(FAILED, words="every row needs a verdict, and a verdict ok a reference")
    tally = runs.tally
    counts = sorted({min(tally.iterations), max(tally.iterations)}) if tally.iterations else []
    return dict(zip(HEADINGS, (
        case.name, case.scope, case.reference, case.bar, number(found.error), number(found.bar),
        " – ".join(map(str, counts)), number(max(tally.backward, default=None)),
        number(max(tally.residual, default=None)), found.verdict, found.words or "")))


def number(value):
    """A number as words"""
    return "–" if value is None else "0" if value == 0.0 else f"{value:.1e}"
