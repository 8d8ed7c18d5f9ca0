"""Decks and results of axijoint: cards written and run from Python; displacements and stresses at any point.

    deck = axijoint.Deck("A title (MN, m, MPa)")            # a method for each card
    result = axijoint.run(deck)

    import axijoint
    result = axijoint.open("case3.h5")
    result.displacement(0.5, 0.25, theta=90, body=1)        # u, v, w
    result.stress([0.1, 0.2], 0.25)[:, 1]                   # sigma_z at two points, theta = 0
    result.line((0, 0.5), (2, 0.5), theta=[0, 180]).table() # along a line
    result.at(3).displacement(0.5, 0.25)                    # at the end of increment 3

    study = axijoint.study("case3.dat", {"LAWS 1 PHI": "0:40:5", "LAWS 1 C": "0; 0.1"})
    study.rows["largest_displacement"]                      # of 18 states

Angles are in degrees, as in the deck and the listing; everything else is in the units of the deck.
Figures are made by `axijoint.plot`, which needs matplotlib.
"""
from .circle import cartesian_displacement, cartesian_stress, principal_stresses
from .components import DISPLACEMENTS, STRESSES
from .deck import Deck, DeckError
from .history import NotKeptError
from .program import RunError, run, run_combinations
from .result import STATES, OutsideError, Result, open_combinations
from .result import open_result as open
from .section import Section
from .soil import SoilReactions, soil_reactions
from .spread import StudyError, study
from .studies import Study, open_study
from .envelopes import Envelope, open_envelope
from .table import Table

__all__ = ["DISPLACEMENTS", "STATES", "STRESSES", "Deck", "DeckError", "NotKeptError", "OutsideError", "Result",
           "RunError", "Section", "SoilReactions", "Study", "StudyError", "Table", "cartesian_displacement",
           "cartesian_stress", "open", "open_combinations", "open_envelope", "open_study", "principal_stresses", "run",
           "run_combinations", "soil_reactions", "study"]
__version__ = "0.1.0"
