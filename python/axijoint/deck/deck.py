"""Decks written in Python."""
from __future__ import annotations

import os
import pathlib

from .cards import Cards
from .fields import DeckError, cards, described, rows, written

MOST_LETTERS = 80


class Deck(Cards):
    """A deck, card by card: a method for each card of the manual, `axijoint help card` and doc/deck.md.

        deck = Deck("A disc under its weight (MN, m, MPa)")
        deck.control(0)
        deck.materials(1, young=2.1e5, poisson=0.3, density=7.85e-3)
        deck.blocks(material=1, nodes=8, n1=4, n2=2, corners=[(0, 0), (1, 0.1)])

    Arguments have the names, units, ranges and defaults that the methods' docstrings tell; what is not given is
    blank on the card. Points and other things of several values take a sequence; None in it is a blank.
    A name, kind or value that a card cannot have is refused at once, by a TypeError or a DeckError. Cards stand in
    the order of the calls: loads belong to the CASE called before them. Reals keep all their digits.

    title: the title card, 80 letters at most, not a keyword alone
    """

    def __init__(self, title: str = "") -> None:
        if len(title) > MOST_LETTERS or not title.isprintable():
            raise DeckError(f"the title has {len(title)} letters; allowed are {MOST_LETTERS}, on one line")
        word, _, behind = title.partition(" ")
        if word.upper() in described() and not behind.strip(" 0123456789"):  # which the program takes for the keyword
            raise DeckError(f"the title {title!r} is a keyword alone")
        self.title = title
        self._lines: list[str] = []
        self._open = ""
        self._once: set[str] = set()

    def _entry(self, card: str, *values: object) -> None:
        """One entry of a section, which is opened if another one is open."""
        section = described()[card]
        fields, texts = [], []
        for (name, of_row), value in zip(rows(card), values):
            fields += of_row
            texts += written(card, name, of_row, value)
        if section["once"] and card in self._once:
            raise DeckError(f"{card} stands once in a deck, and is there already")
        if not any(texts) and not section["alone"]:
            raise DeckError(f"{card}: nothing is given")
        self._once.add(card)
        self._begin(card)
        if any(texts):
            self._lines += cards(fields, texts)

    def _path(self, card: str, path: str | os.PathLike[str]) -> None:
        """The path of a file on a keyword's card."""
        text = os.fspath(path)
        fault = "must not be absolute" if os.path.isabs(text) else "must not contain .." \
            if ".." in pathlib.PurePath(text).parts else "must be ASCII without commas" \
            if not text.isascii() or set(text) & set(",!") else "is too long" \
            if len(text) > MOST_LETTERS - 10 else ""
        if fault:
            raise DeckError(f"{card}: the path {text!r} {fault}")
        if described()[card]["once"] and card in self._once:
            raise DeckError(f"{card} stands once in a deck, and is there already")
        self._once.add(card)
        self._lines.append(f"{card:10}{text}")
        self._open = ""

    def _begin(self, card: str) -> None:
        if card != self._open:
            self._lines.append(card)
        self._open = card

    def comment(self, text: str) -> None:
        """A comment, a card for each of its lines."""
        self._lines += [f"! {line}" for line in text.splitlines()]

    @property
    def text(self) -> str:
        """All cards, from TITLE to END."""
        return "\n".join(["TITLE", self.title, *self._lines, "END", ""])

    def __str__(self) -> str:
        return self.text

    def write(self, path: str | os.PathLike[str]) -> pathlib.Path:
        """Write the deck into a file; returns its path."""
        path = pathlib.Path(path)
        path.write_text(self.text, encoding="utf-8")
        return path
