"""Fields of cards: what the program says of them, values checked and written."""
from __future__ import annotations

import functools
import json
import math
import operator
import pathlib
from collections.abc import Mapping

from .names import NAMES

LEAST_REAL = 1e-30
LARGEST_REAL = 1e30
LARGEST_INTEGER = 999999999


class DeckError(ValueError):
    """A value that a card cannot have, or a card that a deck cannot have."""


@functools.lru_cache(maxsize=None)
def described():
    """The cards as `axijoint help card --json` lists them: a dictionary by keyword."""
    text = (pathlib.Path(__file__).parent/"cards.json").read_text(encoding="utf-8")
    return {section["card"]: section for section in json.loads(text)}


@functools.lru_cache(maxsize=None)
def rows(card):
    """Names of a card's arguments and the fields of each, those told of together in one list."""
    found = []
    for field in described()[card]["fields"]:
        if field["joined"]:
            found[-1].append(field)
        else:
            found.append([field])
    names = NAMES[card]
    if len(names) != max(len(found), 1):
        raise AssertionError(f"{card} has {len(found)} rows of fields, and {len(names)} names")
    return list(zip(names, found))


def written(card, name, fields, value):
    """Values of one argument as texts, one for each of its fields; blank where there are none."""
    where = f"{card}: {name}"
    values = [value] if len(fields) == 1 else _flat(value)
    if len(values) > len(fields):
        raise DeckError(f"{where} takes {len(fields)} values at most; there are {len(values)}")
    values += [None]*(len(fields) - len(values))
    texts = [""]*len(fields)
    for k, (field, one) in enumerate(zip(fields, values)):
        place = where if len(fields) == 1 else f"{where}[{k}]"
        if one is not None:
            texts[k] = _WRITERS[field["kind"]](place, field, one, fields[0]["allowed"])
        elif field["required"]:
            raise DeckError(f"{place} must be given: {field['name']}")
    return texts


def _flat(value):
    """Values of a sequence, those of pairs in it one by one; of a dictionary its pairs."""
    if value is None:
        return []
    if isinstance(value, Mapping):
        value = value.items()
    if isinstance(value, str) or not hasattr(value, "__iter__"):
        return [value]
    return [one for item in value for one in _flat(item) or [None]]


def _refuse(place, value, reason, allowed=""):
    allowed = f"; allowed: {allowed}" if allowed else ""
    raise DeckError(f"{place} is {value!r}: {reason}{allowed}")


def _check_range(place, field, value, allowed):
    low, high = field["low"], field["high"]
    if value < low or value > high or (field["above_low"] and value == low) \
            or (field["below_high"] and value == high):
        _refuse(place, value, "out of range", allowed or f"{_plain(low)} … {_plain(high)}")


def _plain(value):
    """An end of a range, integers with all their digits."""
    return f"{value:.0f}" if value == int(value) and abs(value) < LARGEST_REAL else f"{value:g}"


def _integer(place, field, value, allowed):
    try:
        if isinstance(value, bool):
            raise TypeError
        value = operator.index(value)
    except TypeError:
        _refuse(place, value, "no integer", allowed)
    # a limit of all integers is not among the words of a field
    _check_range(place, field, value, allowed if value <= LARGEST_INTEGER else "")
    return str(value)


def _real(place, field, value, allowed):
    try:
        if isinstance(value, (bool, str)):
            raise TypeError
        number = float(value)
    except TypeError:
        _refuse(place, value, "no number", allowed)
    if not math.isfinite(number):
        _refuse(place, value, "no finite number", allowed)
    if 0 < abs(number) < LEAST_REAL:
        _refuse(place, value, "too small", "0, or magnitudes from 1E-30")
    if abs(number) > LARGEST_REAL:
        _refuse(place, value, "too large", "magnitudes up to 1E30")
    _check_range(place, field, number, allowed)
    return repr(number).upper()


def _word(place, field, value, _):
    words = ", ".join(field["words"])
    if not isinstance(value, str):
        _refuse(place, value, "no word", words)
    if value.upper() not in field["words"]:
        _refuse(place, value, "not known", words)
    return value.upper()


def _code(place, _, value, __):
    code = str(value)
    if len(code) != 3 or set(code) - {"0", "1"}:
        _refuse(place, value, "no code", "three digits for u, v, w, 1 fixed, 0 free, such as '101'")
    return code


def _text(place, field, value, _):
    text = value.strip() if isinstance(value, str) else ""
    if not text:
        _refuse(place, value, "no text")
    if not (text.isascii() and text.isprintable()) or set(text) & set(",!"):
        _refuse(place, value, "no text of a card", "ASCII without commas and exclamation marks")
    first, last = field["columns"]
    if len(text) > last - first + 1:
        _refuse(place, value, f"more than {last - first + 1} letters")
    return text


_WRITERS = {"integer": _integer, "real": _real, "word": _word, "code": _code, "text": _text}


def cards(fields, texts):
    """The cards of an entry: fixed where all values fit their columns, with commas otherwise."""
    found = []
    for number in range(1, max(field["card"] for field in fields) + 1):
        here = [(field, text) for field, text in zip(fields, texts) if field["card"] == number]
        fixed = _fixed(here)
        if fixed is None:
            last = max([k for k, (_, text) in enumerate(here) if text], default=0)
            fixed = "    " + ", ".join(text for _, text in here[:max(last + 1, 2)])
            if "," not in fixed:
                fixed += ","
        found.append(fixed)
    return found


def _fixed(here):
    """A fixed card; None if a value needs more room."""
    card = ""
    for field, text in here:
        first, last = field["columns"]
        if len(text) > last - first + (first == 1):
            return None
        if text:
            card = card.ljust(first - 1)
            card += f" {text}" if field["kind"] == "text" else text.rjust(last - first + 1)
    return card
