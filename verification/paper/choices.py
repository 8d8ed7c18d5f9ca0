"""What the paper's choices leave: its jobs beside the same in equilibrium, and with one choice of the paper's each"""
from dataclasses import dataclass

import numpy as np
from runs import INPUTS, Run, changed

JOBS = ("case1", "case2", "case3", "case3_stiff_joint", "case3_stiff_pile")


def field(card, first, last, text):
    """A card with another text in the columns first to last, at their end"""
    return f"{card:80}"[:first - 1] + f"{text:>{last - first + 1}}" + f"{card:80}"[last:]


# What the paper chooses otherwise than NAME_balanced.dat, as changes of its cards
CHOICES = {
    "joints at their centroids": {"LAWS": lambda card: field(card, 66, 75, "CENTROID")},
    "five planes": {"CONTROL": lambda card: field(card, 6, 10, "5")},
    "tolerance 3 %": {"INCREMENTS": lambda card: field(card, 11, 20, "0.03")},
    "stress accumulated": {"CONTROL": lambda card: field(card, 41, 50, "TRANSFER")},
    "stress accumulated, to 3 %": {"CONTROL": lambda card: field(card, 41, 50, "TRANSFER"),
                                   "INCREMENTS": lambda card: field(card, 11, 20, "0.03")},
}


@dataclass(frozen=True)
class Row:
    """A job as it was run"""
    name: str
    says: str
    iterations: int
    pressure: float
    displacement: float
    # Differences to the job in equilibrium, over its values
    of_pressure: float
    of_displacement: float


def all_choices(program, folder):
    """Rows of all jobs: in equilibrium, with one choice of the paper's, as in the paper"""
    for name in JOBS:
        deck = INPUTS/f"{name}_balanced.dat"
        ours = Run(program, deck, folder)
        yield row(name, "in equilibrium", ours, ours)
        for number, (says, change) in enumerate(CHOICES.items()):
            path = changed(deck, folder, f"{name}_choice{number}", change)
            yield row(name, says, Run(program, path, folder), ours)
        yield row(name, "as in the paper", Run(program, INPUTS/f"{name}.dat", folder), ours)


def row(name, says, run, ours):
    """One row: largest pressure of the joints and largest displacement, beside those of our run"""
    values, wanted = figures(run), figures(ours)
    return Row(name, says, run.loops, *values, *(value/right - 1 for value, right in zip(values, wanted)))


def figures(run):
    """Largest pressure and displacement"""
    sweep = (run.result.nodal_displacement(theta) for theta in range(0, 181, 5))
    return (-run.result.joints()["sigma"].min(),
            max(float(np.linalg.norm(values, axis=-1).max()) for values in sweep))


def table(rows):
    """Lines of the table in text"""
    yield f"{'job':18} {'':27} {'loops':>5} {'pressure':>9} {'':>7} {'displacement':>12}"
    for one in rows:
        yield (f"{one.name:18} {one.says:27} {one.iterations:5d} {one.pressure:9.4g} {one.of_pressure:+7.1%} "
               f"{one.displacement:12.5g} {one.of_displacement:+7.1%}")
