"""Studies from Python: one deck in many states, by one process or spread over those of an executor."""
from __future__ import annotations

import os
import pathlib
import subprocess
import time
from collections.abc import Sequence
from typing import Any, Protocol

from .deck import Deck
from .program import RunError, _Folder, find_program
from .studies import ENDING, Study
from .study_table import Columns, table_text


class Future(Protocol):
    """What a submitted call returns."""

    def result(self) -> Any:
        """What the call returned, when it has."""


class Executor(Protocol):
    """What spreads calls: concurrent.futures.Executor, and all that has its `submit`."""

    def submit(self, function: Any, /, *arguments: Any) -> Future:
        """Have a call made."""


class StudyError(RunError):
    """Parts of a study that did not come to their end.

    parts   by the numbers of these parts: what the program said, or how its process failed

    What the other parts did, and the rows that these had done, is kept in the folder of the study: the same call
    goes on from there.
    """

    def __init__(self, exit_code: int, parts: dict[int, str], of: int) -> None:
        alike: dict[str, list[str]] = {}
        for part, said in parts.items():
            alike.setdefault(said, []).append(str(part))
        super().__init__(exit_code, "\n".join(f"part {', '.join(numbers)} of {of}: {said}"
                                              for said, numbers in alike.items()))
        if exit_code == 0:  # the program did not say anything
            self.args = (self.messages,)
        self.parts = parts


def study(deck: Deck | str | os.PathLike[str], table: Columns | str | os.PathLike[str],
          executor: Executor | None = None, parts: int | None = None,
          folder: str | os.PathLike[str] | None = None, *, name: str = "job", threads: int | None = None,
          estimates: bool = False, options: Sequence[str] = (),
          program: str | os.PathLike[str] | None = None) -> Study:
    """Solve a deck in the states of a table, as `axijoint study` does: a Study.

    deck: a Deck, or the path of a file
    table: the path of a file; its text, of two lines or more; or a dictionary or pandas.DataFrame from names of
        columns, such as "LAWS 1 PHI", to a sequence with a cell for each line, or to one cell for all lines: a
        number, a word, or a text of doc/studies.md, "0:40:2" or "NORMAL 30 2". None, nan and "" leave what the deck says
    executor: where the program runs, anything in the sense of concurrent.futures: groups of rows (those of one
        structure together) are submitted as parts, and gathered here. Without it one process solves all rows
    parts: number of groups; without it the number of the executor's workers if it is one of the standard library,
        else that of this machine's processors
    folder: where table, deck and results are written, made if it is not there; processes of other machines must see it
        under the same path. Without it all is kept as long as the Study is
    name: of the files of a Deck and of a table that is no file: NAME.dat, NAME.csv, NAME.study.h5, NAME.study.csv
    threads: harmonics at once; without it 1 in each process of an executor
    estimates: estimates of the errors of each row, too
    options: further options of `axijoint study`
    program: path of the program; otherwise `find_program()`

    Rows that cannot be solved raise nothing: `exit_codes` of the Study tells. A wrong deck or table raises a RunError
    with the program's message; parts that fail raise a StudyError, and the same call then goes on with what is kept in
    the folder.
    """
    kept = _Folder() if folder is None else None
    place = pathlib.Path(kept.path if kept else folder or ".").resolve()
    place.mkdir(parents=True, exist_ok=True)
    path = _table_path(table, place, name)
    deck_path = deck.write(place/f"{name}.dat") if isinstance(deck, Deck) else deck
    if threads is None and executor is not None:
        threads = 1
    # what it did at the end tells that it came there; nobody sees it
    options = [one for one in options if one != "--quiet"]
    command = [os.path.abspath(program or find_program()), "study", str(path), os.path.abspath(deck_path), "-o",
               str(place), *options, *(["--estimates"] if estimates else []),
               *(["--threads", str(threads)] if threads else [])]
    if executor is None:
        _check(run_command(command))
    else:
        count = parts or getattr(executor, "_max_workers", None) or os.cpu_count() or 1
        _spread(executor, command, count)
        _check(run_command([*command, "--part", f"0/{count}"]))
    found = Study(place/f"{path.stem}{ENDING}")
    found.folder = kept  # removed with the last who has it
    return found


def _table_path(table: Columns | str | os.PathLike[str], place: pathlib.Path, name: str) -> pathlib.Path:
    """The path of a table, which is written if it is no file."""
    if isinstance(table, (str, os.PathLike)) and "\n" not in os.fspath(table):
        return pathlib.Path(table).resolve()
    if isinstance(table, os.PathLike):
        raise ValueError(f"the path of the table, {table!s}, has an end of line")
    path = place/f"{name}.csv"
    path.write_text(table if isinstance(table, str) else table_text(table), encoding="utf-8")
    return path


def run_command(command: Sequence[str], _begin: int = 0) -> tuple[int, str, str]:
    """Run a command: exit code, and what it printed. Of plain types, so that it can be sent to other processes.

    _begin: any number; Dask takes calls with equal arguments for one and the same
    """
    done = subprocess.run(command, capture_output=True, encoding="utf-8", errors="replace",
                          stdin=subprocess.DEVNULL, check=False)
    return done.returncode, done.stdout, done.stderr


def _ended(out: str) -> bool:
    """Whether a study came to its end, whatever the exit codes of its rows: it then says what it did."""
    return out.startswith("study ")


def _check(outcome: tuple[int, str, str]) -> None:
    code, out, said = outcome
    if not _ended(out):
        raise RunError(code, said.strip("\n") or out.strip("\n"))


def _spread(executor: Executor, command: list[str], count: int) -> None:
    """Run the parts of a study, and raise a StudyError if some do not come to their end."""
    begin = time.time_ns()
    futures = [executor.submit(run_command, [*command, "--part", f"{part}/{count}"], begin)
               for part in range(1, count + 1)]
    failed: dict[int, str] = {}
    largest, cause = 0, None
    for part, future in enumerate(futures, 1):
        try:
            code, out, said = future.result()
        except Exception as error:  # whatever the executor raises
            failed[part] = f"{type(error).__name__}: {error}"
            cause = error
            continue
        if not _ended(out):
            failed[part] = said.strip("\n") or out.strip("\n") or f"ended with exit code {code}"
            largest = max(largest, code)
    if failed:
        raise StudyError(largest, failed, count) from cause
