"""What a report is about: the files of one run, and how it ended."""
import json
import pathlib
import re

from ..result import open_result
from ..units import Units


class Failure(Exception):
    """A report cannot be made; the text says why, and what to do."""


class Job:
    """The files of one run, of one load combination if there are several.

    path     the files without ending
    name     their name
    result   Result of NAME.h5; None after a run that ended with an error
    summary  what NAME.json says; {} if it is missing, or of another run
    notes    what is wrong with the files
    """

    def __init__(self, path):
        self.path, self.notes = pathlib.Path(path), []
        self.name = self.path.name
        self.summary = self._read_summary()
        self.result = None
        file = with_ending(self.path, ".h5")
        if file.is_file():
            try:
                self.result = open_result(file)
            except (OSError, ValueError, KeyError) as error:
                raise Failure(f"{file} cannot be read: {error}") from error
            self._compare_runs()
        elif not self.summary:
            raise Failure(f"{with_ending(self.path, '.json')} is no summary of axijoint")
        self.units = Units(self.result.title, self.result.deck) if self.result else Units("", "")

    def _read_summary(self):
        file = with_ending(self.path, ".json")
        try:
            found = json.loads(file.read_text(encoding="utf-8"))
        except FileNotFoundError:
            self.notes.append(f"{file.name} is missing: times, memory and the error budget are not known.")
            return {}
        except (OSError, ValueError) as error:
            self.notes.append(f"{file.name} cannot be read: {error}")
            return {}
        return found if isinstance(found, dict) and found.get("program") == "axijoint" else {}

    def _compare_runs(self):
        if self.summary and self.summary.get("run") != self.result.attributes.get("run"):
            self.notes.append(f"{self.name}.json and {self.name}.h5 are of different runs. What stands here is that of "
                              f"{self.name}.h5; times, memory and the error budget are left out.")
            self.summary = {}

    @property
    def tags(self):
        """Attributes of the result file, or the summary where there is none."""
        return self.result.attributes if self.result else self.summary

    @property
    def title(self):
        """Title card, or the deck's name."""
        title = self.result.title if self.result else self.summary.get("title")
        return title or self.name

    @property
    def messages(self):
        """Warnings, remarks, how the iteration ended: a list of texts."""
        if self.summary:
            return list(self.summary.get("messages") or [])
        return self.result.messages if self.result else []

    @property
    def combination(self):
        """Number of the load combination; 0 if there is one only."""
        return int(self.tags.get("combination") or 0)

    @property
    def case_names(self):
        """Names of the load cases, empty where they have none."""
        found = [name.strip() for name in self.result.attributes_of("loads").get("case_names", "").split("\n")]
        count = len(self.result.read("loads/case_label"))
        return (found + [""]*count)[:count]

    def case_factors(self):
        """Factor that each load case acts with in the state shown, that of the combination and the increments together."""
        history = self.result.history
        return history["case_factor"][list(history.increment).index(self.result.increment)]

    @property
    def state(self):
        """Which state of the history results are of, in words; None of a job of one increment."""
        history = self.result.history
        count = len(self.result.read("increments/factor"))
        if count < 2:
            return None
        cases = [f"load case {label}{f' ({name})' if name else ''} times {factor:.6g}" for label, name, factor in
                 zip(self.result.read("loads/case_label"), self.case_names, self.case_factors())]
        where = {"converged": "end of", "mechanism": "last equilibrium, in"}.get(self.verdict, "last state, in")
        return f"{where} increment {self.result.increment} of {count}: {', '.join(cases)}"

    @property
    def verdict(self):
        """How the run ended: converged, mechanism, not_converged or error."""
        status = self.tags.get("status")
        if self.result is None:
            return "error"
        if status == "converged":
            return "converged"
        return "mechanism" if self.tags.get("exit_code") == 4 else "not_converged"


def with_ending(path, ending):
    """A path and one more ending."""
    return path.with_name(path.name + ending)


def jobs_of(word):
    """Jobs of a word of the command line: NAME with its directory, or one of its files."""
    path = pathlib.Path(word)
    if path.suffix in (".h5", ".json", ".lis"):
        if not path.is_file():
            raise Failure(f"there is no file {path}")
        return [Job(path.with_suffix(""))]
    stems = found_stems(path)
    if stems:
        jobs = [Job(stem) for stem in stems]
        note_other_decks(jobs)
        return jobs
    if path.is_file():
        raise Failure(f"{path} is no result. If it is a deck, run it first:\n"
                      f"  scripts/run {path} -o out\n  scripts/report out/{path.stem}")
    raise Failure(f"there is no {path}.h5 and no {path}.json. Give the name of results, with their directory:\n"
                  "  scripts/run inputs/case3.dat -o out\n  scripts/report out/case3")


def found_stems(path):
    """NAME, or NAME.1, NAME.2, ... in the order of their numbers: those written last, if there are both."""
    if not path.parent.is_dir():
        return []
    pattern = re.compile(re.escape(path.name) + r"\.(\d+)\.(h5|json)")
    numbers = {int(match[1]) for match in map(pattern.fullmatch, (one.name for one in path.parent.iterdir()))
               if match}
    several = [with_ending(path, f".{k}") for k in sorted(numbers)]
    return max([[path], several], key=lambda stems: max(map(time_of, stems), default=-1.0)) \
        if several or time_of(path) >= 0 else []


def time_of(path):
    """When the files of a run were written; -1 if there are none."""
    files = [with_ending(path, ending) for ending in (".h5", ".json")]
    return max((file.stat().st_mtime for file in files if file.is_file()), default=-1.0)


def note_other_decks(jobs):
    """Say of combinations whose deck is not that of the one written last that they are older."""
    newest = max(jobs, key=lambda job: time_of(job.path))
    for job in jobs:
        if job.result and newest.result and job.result.deck != newest.result.deck:
            job.notes.append(f"The deck of {job.name} is not that of {newest.name}, which was written later: these may be "
                             "results of an earlier run.")
