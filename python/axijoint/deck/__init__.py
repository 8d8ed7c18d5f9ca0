"""Decks written in Python: `Deck` has a method for each card."""
from .deck import Deck
from .fields import DeckError

__all__ = ["Deck", "DeckError"]
