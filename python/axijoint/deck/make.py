"""Writes `cards.json` and `cards.py` of this folder: python -m axijoint.deck.make PROGRAM

`cards.json` is what `axijoint help card --json` prints; `cards.py` has a method for each card of it.
"""
from __future__ import annotations

import keyword
import pathlib
import subprocess
import sys
import textwrap

from .fields import described, rows

FOLDER = pathlib.Path(__file__).parent
TYPES = {"integer": "int", "real": "float", "word": "str", "code": "str", "text": "str"}
HEAD = '''"""A method for each card. Written by `python -m axijoint.deck.make PROGRAM`: change nothing here."""
from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Literal, Union

Integers = Union[int, Sequence[int]]
Reals = Union[float, Sequence[Union[float, None]], Sequence[Sequence[float]]]
Path = Union[str, os.PathLike[str]]

class Cards:
    """The cards of a deck."""

    def _entry(self, card: str, *values: object) -> None:
        raise NotImplementedError

    def _path(self, card: str, path: Path) -> None:
        raise NotImplementedError
'''


def listed(program):
    """What the program lists of its cards."""
    return subprocess.run([program, "help", "card", "--json"], check=True, stdout=subprocess.PIPE,
                          encoding="utf-8").stdout


def method_name(card):
    """Name of the method of a card; `yield` is a word of Python."""
    name = card.lower()
    return name + "_" if keyword.iskeyword(name) else name


def methods():
    """The text of `cards.py`."""
    parts = [HEAD]
    for card, section in described().items():
        if section["form"] == "entries":
            parts.append(_entry(card, section))
        elif section["form"] in ("include", "file"):
            parts.append(f'    def {method_name(card)}(self, path: Path) -> None:\n'
                         + _docstring([f"{card}: {section['purpose']}."]) + f'        self._path("{card}", path)\n')
    return "\n".join(parts)


def _type(fields):
    """Type of an argument."""
    kinds = {field["kind"] for field in fields}
    if len(fields) == 1 and kinds == {"word"}:
        return "Literal[" + ", ".join(f'"{word}"' for word in fields[0]["words"]) + "]"
    if len(fields) == 1:
        return TYPES[fields[0]["kind"]]
    if len(kinds) > 1:
        return "Mapping[int, float]"
    return "Integers" if kinds == {"integer"} else "Reals"


def _entry(card, section):
    """A method for the entries of a card."""
    arguments, told, leading = ["self"], [], True
    for name, fields in rows(card):
        required = any(field["required"] for field in fields)
        if leading and not required:
            arguments.append("*")
            leading = False
        kind = _type(fields)
        arguments.append(f"{name}: {kind}" if required else f"{name}: {kind} | None = None")
        first = fields[0]
        words = [first["meaning"]]
        words += [f"if not given: {first['blank']}"] if first["blank"] else []
        words += [f"allowed: {first['allowed']}"] if first["allowed"] else []
        told.append(f"{name}: {'; '.join(words)}")
    head = f"    def {method_name(card)}("
    call = f'        self._entry("{card}", '
    values = [name for name, _ in rows(card)]
    return (head + _wrapped(arguments, len(head)) + ") -> None:\n"
            + _docstring([f"{card}: {section['purpose']}.", "", *told]) + call + _wrapped(values, 20) + ")\n")


def _wrapped(words, margin):
    """Words with commas in lines, none of them divided."""
    lines = textwrap.wrap(", ".join(word.replace(" ", "\0") for word in words), 108 - margin,
                          break_long_words=False, break_on_hyphens=False)
    return ("\n" + " "*margin).join(lines).replace("\0", " ")


def _docstring(lines):
    """A docstring in lines of at most 112 letters."""
    wrapped = []
    for line in lines:
        wrapped += textwrap.wrap(line, 104, subsequent_indent="    ") or [""]
    text = "\n".join(" "*8 + line if line else "" for line in wrapped)
    return f'        """{text.strip()}' + ('"""\n' if len(wrapped) == 1 else '\n        """\n')


def main():
    """Write both files."""
    (FOLDER/"cards.json").write_text(listed(sys.argv[1]), encoding="utf-8")
    described.cache_clear()
    (FOLDER/"cards.py").write_text(methods(), encoding="utf-8")


if __name__ == "__main__":
    main()
