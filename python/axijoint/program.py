"""Runs the program on decks."""
from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
import tempfile
import weakref
from collections.abc import Mapping, Sequence

from .deck import Deck
from .result import Result, result_files

# Exit codes with which results are written, though the job did not come to its end
NO_RESULTS, NOT_CONVERGED, MECHANISM = {}, 3, 4
MEANINGS = {2: "the deck has errors", NOT_CONVERGED: "not converged", MECHANISM: "singular or a mechanism",
            5: "input or output failed", 6: "not enough memory", 7: "another run writes these results",
            8: "a state that cannot be gone on from", 70: "internal error", 75: "stopped"}

# What the program says where results of the same job are there and --resume leaves them
LEFT = "its results are there already"


class RunError(RuntimeError):
    """A job that did not come to its end.

    exit_code   of the program: 2 deck, 3 not converged, 4 singular or a mechanism, 5 input or output, 6 memory,
                75 stopped by a signal
    messages    what the program said, with cards and carets
    results     results of this run by combination, none that an earlier one has left: of a job that did not converge,
                and the last equilibrium before a mechanism; mostly empty else
    """

    def __init__(self, exit_code: int, messages: str, results: Mapping[int, Result] = NO_RESULTS) -> None:
        super().__init__(f"{MEANINGS.get(exit_code, 'failed')} (exit code {exit_code})\n{messages}")
        self.exit_code, self.messages, self.results = exit_code, messages, dict(results)


class _Folder:
    """A folder that is there as long as this object."""

    def __init__(self) -> None:
        self.path = tempfile.mkdtemp(prefix="axijoint_")
        weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)


def find_program() -> str:
    """Path of the program: the environment variable AXIJOINT, or what the wheel of this package carries, or
    `axijoint` among the commands."""
    found = os.environ.get("AXIJOINT") or _carried() or shutil.which("axijoint")
    if not found:
        raise FileNotFoundError("no program axijoint: put it on the PATH, name it in the environment variable "
                                "AXIJOINT, or give run(..., program=PATH); scripts/build release prints its path")
    return found


def _carried() -> str | None:
    """Path of the program in a wheel that carries it (scripts/wheel)"""
    try:
        from axijoint_program import PATH
    except ModuleNotFoundError:
        return None
    return PATH


def run(deck: Deck | str | os.PathLike[str], directory: str | os.PathLike[str] | None = None, *,
        name: str = "job", threads: int | None = None, options: Sequence[str] = (),
        program: str | os.PathLike[str] | None = None) -> Result:
    """Solve a deck: its Result. Raises a RunError with the program's messages if that fails.

    deck: a Deck, or the path of a file
    directory: where deck and results are written, made if it is not there; without it they are kept only as
        long as the Result is
    name: of the files of a Deck: NAME.dat, NAME.lis, NAME.json, NAME.h5
    threads: harmonics at once
    options: further options of `axijoint run`, such as ["--vtk"]
    program: path of the program; otherwise `find_program()`

    A job of several combinations has several results: `run_combinations` returns them.
    """
    found = run_combinations(deck, directory, name=name, threads=threads, options=options, program=program)
    if len(found) > 1:
        raise ValueError(f"the job has the combinations {', '.join(map(str, found))}; use run_combinations")
    return found.popitem()[1]


def run_combinations(deck: Deck | str | os.PathLike[str], directory: str | os.PathLike[str] | None = None, *,
                     name: str = "job", threads: int | None = None, options: Sequence[str] = (),
                     program: str | os.PathLike[str] | None = None) -> dict[int, Result]:
    """The same for jobs of any number of combinations: a dictionary from their numbers, 0 of one alone."""
    kept = _Folder() if directory is None else None
    folder = pathlib.Path(kept.path if kept else directory)
    folder.mkdir(parents=True, exist_ok=True)
    path = deck.write(folder/f"{name}.dat") if isinstance(deck, Deck) else pathlib.Path(deck)
    if threads is not None:
        options = [*options, "--threads", str(threads)]
    before = _stamps(folder/path.stem)
    done = subprocess.run([program or find_program(), "run", "-o", folder, *options, "--", path],
                          capture_output=True, encoding="utf-8", errors="replace", check=False)
    results = _results(folder/path.stem, before, path, "--resume" in options, LEFT in done.stderr)
    for result in results.values():
        result.folder = kept  # which is removed with the last of them
    if done.returncode != 0:
        raise RunError(done.returncode, done.stderr.strip("\n") or done.stdout.strip("\n"), results)
    if not results:
        raise FileNotFoundError(f"the run has no results {folder/path.stem}.h5; the program said\n{done.stderr}{done.stdout}")
    return results


def _stamps(path: pathlib.Path) -> dict[pathlib.Path, str]:
    """Stamps of the runs that results of a name are of, by their files."""
    found = {}
    for file in result_files(path):
        try:
            found[file] = str(Result(file).attributes.get("run"))
        except (OSError, ValueError):  # no results, or not whole
            continue
    return found


def _results(path: pathlib.Path, before: Mapping[pathlib.Path, str], deck: pathlib.Path, resumed: bool,
             left: bool) -> dict[int, Result]:
    """Results of a run by combination.

    path: of the results, without ending; before: stamps before the run; deck: the path of its deck
    resumed, left: whether it went on from another, which wrote some of them, or left all of them as they were
    """
    stamps = _stamps(path)
    new = {file for file, stamp in stamps.items() if before.get(file) != stamp}
    found = [Result(file) for file in (stamps if left or resumed and new else new)]
    if not found:
        return {}
    text = deck.read_text(encoding="utf-8", errors="replace").splitlines() if left else []
    # Of what was left, files may be of another deck, which was run since
    own = max(found, key=lambda one: (one.path in new, one.deck.splitlines() == text, one.path.stat().st_mtime_ns)).deck
    return {one.combination: one for one in sorted(found, key=lambda one: one.combination) if one.deck == own}
