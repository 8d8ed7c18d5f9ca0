"""Estimates of errors where bodies yield, beside the true ones"""
import dataclasses

import numpy as np

import report
from cases import capacity, piles

# Rows of elements below and beside a pile, and elements across the ground: coarse
ROWS, ACROSS = ((-9.0, -5.0, 3, 0.25), (-5.0, 0.0, 6, 1.0)), 8
SOURCES = ("planes", "harmonics", "discretization")


def with_planes(deck, planes):
    """A deck with a number of planes for bodies that yield; the usual if it is 0"""
    head, tail = deck.split("CONTROL\n")
    control, tail = tail.split("\n", 1)
    return f"{head}CONTROL\n{control}{','*(8 - control.count(','))}{planes or ''}\n{tail}"


def clay(harmonic, finer, planes, steps):
    """A pile in clay, its head moved"""
    return with_planes(piles.pile(piles.CLAY, harmonic, finer, steps, across=ACROSS, rows=ROWS), planes)


def sand(harmonic, finer, planes, steps):
    """A pile in sand, its head moved"""
    return with_planes(piles.pile(piles.SAND, harmonic, finer, steps, across=ACROSS, rows=ROWS), planes)


def pushed(harmonic, finer, planes, steps):
    """A pile in clay under a force on its head"""
    moved = "MOVEDFACES\n1, 1, 1.0, 0.0, -1.0\n"
    return clay(harmonic, finer, planes, steps).replace(moved, "RESULTANTS\n1, LATERAL, 100.0\n")


def disc(harmonic, finer, planes, steps):
    """A stiff disc in clay, moved"""
    return capacity.disc(8*finer, harmonic, planes=planes or "", moves=steps)


def footing(_harmonic, finer, _planes, steps):
    """A rough footing on clay, pressed"""
    return capacity.footing(3*finer, False, "0, 0.0, -1.0", steps)


def turned(harmonic, finer, planes, steps):
    """A footing under a moment, its work given"""
    return with_planes(capacity.turned_footing(3*finer, harmonic, steps), planes)


def cylinder(_harmonic, finer, _planes, steps):
    """A thick cylinder of Tresca under pressure from inside, 4 elements through its wall"""
    return f"""TITLE
A thick cylinder
CONTROL
0, , , 2
MATERIALS
1, 2.1E5, 0.3
YIELD
1, TRESCA, 240.0
BLOCKS
1, 1, 8, {4*finer}, 1
1.0, 0.0, 2.0, 0.1
FACES
1, 1, 1.0, 0.0, 1.0, 0.1
2, 1, 1.0, 0.0, 2.0, 0.0
3, 1, 1.0, 0.1, 2.0, 0.1
FIXEDFACES
2, 010
3, 010
PRESSURES
1, 0, 100.0
INCREMENTS
""" + "".join(f"{step}, 1E-8\n" for step in steps) + "END\n"


def held(found):
    """Force that holds what is moved, after each increment"""
    return np.abs(found.supports[:, found.face == 1, :2]).max((1, 2))


def moved(found):
    """Largest displacement after each increment"""
    return found.largest


def factor(found):
    """Load factor after each increment"""
    return found.load_factor


@dataclasses.dataclass
class Scene:
    """A deck, the harmonics and meshes that stand for the truth, what is compared at which increments"""
    words: str
    deck: object
    steps: tuple
    ends: tuple          # increments in each of the runs whose errors are estimated
    value: object        # load at the displacement given, or displacement under the load given
    quantity: str
    harmonic: int = 3
    reference: int = 15
    finest: int = 4


SCENES = (
    Scene("thick cylinder", cylinder, (1.2, 0.3, 0.12, 0.03), (1, 2, 4), moved, "displacement", 0, 0, 8),
    Scene("footing, pressed", footing, (0.005, 0.005, 0.01, 0.02, 0.04, 0.1, 0.2), (2, 4, 7), held, "load", 0, 0),
    Scene("footing, turned", turned, (1.3, 1.3, 2.0, 4.0, 8.0, 16.0, 32.0), (2, 4, 7), factor, "load"),
    Scene("disc in clay", disc, (0.01, 0.02, 0.03, 0.04, 0.1, 0.1), (1, 3, 6), held, "load"),
    Scene("pile in clay, moved", clay, piles.CLAY_MOVES, (4, 8, 14), held, "load", finest=2),
    Scene("pile in clay, pushed", pushed, (4.0, 2.0, 2.0, 1.0, 0.7, 0.5), (1, 3, 6), moved, "displacement", finest=2),
    Scene("pile in sand, moved", sand, piles.SAND_MOVES, (2, 6, 12), held, "load", finest=2),
)


@dataclasses.dataclass
class YieldErrors:
    """Estimates over true errors"""
    name: str = "yield_errors"
    scenes: tuple = SCENES
    solutions: tuple = ()
    long: bool = True
    low: float = 0.5    # least sum of estimates over the true error, where that is above `small`
    small: float = 1e-3

    def run(self, program):
        """Rows: scenes and levels; columns: sources"""
        rows, misses = [], []
        for scene in self.scenes:
            more, missed = self._scene(program, scene)
            rows += more
            misses += missed
        return [report.table(["body", "increments", "quantity", *(f"{source}: true" if k == 0 else "estimated / true"
                              for source in SOURCES for k in (0, 1)), "in all: true", "estimated / true", "estimates take"],
                             rows)], misses

    def _scene(self, program, scene):
        def find(words, m, finer, planes, steps):
            return program.history(f"{self.name}_{scene.deck.__name__}_{words}", scene.deck(m, finer, planes, steps))

        m, steps = scene.harmonic, scene.steps
        first = 1 if scene.deck is sand else 0
        usual = find("base", m, 1, 0, steps)
        planes = find("planes", m, 1, 4*m + 1, steps) if m else usual
        harmonics = find("harmonics", scene.reference, 1, 0, steps) if m else usual
        finest = find("finest", m, scene.finest, 0, steps)
        rows, misses = [], []
        for end in scene.ends:
            i = end - 1 + first
            run = find(f"end_{end}", m, 1, 0, steps[:end])
            base, dense, rich, fine = (scene.value(x)[i] for x in (usual, planes, harmonics, finest))
            true = [dense/base - 1.0, rich/dense - 1.0, fine/base - 1.0]
            whole = abs(sum(true))
            errors = run.errors
            cells = []
            for source, value in zip(SOURCES, true):
                estimate = errors[source][scene.quantity]
                cells += [percent(value), over(estimate, value)]
            total = errors["sum"][scene.quantity]
            cells += [percent(whole), over(total, whole), f"{100.0*run.error_seconds/run.seconds:.0f} %"]
            rows.append([scene.words, str(end), scene.quantity, *cells])
            if whole > self.small and total is not None and total < self.low*whole:
                misses.append(f"{self.name}, {scene.words}, {end} increments: {total:.2e} for {whole:.2e}")
        return rows, misses


def percent(value):
    """A share in per cent"""
    return f"{100.0*value:+.2f} %"


def over(estimate, value):
    """An estimate over the true value; a dash where that is nothing, words where there is no estimate"""
    if estimate is None:
        return "not estimated"
    return "–" if not abs(value) > 1e-4 else f"{estimate/abs(value):.1f}"


CASES = [YieldErrors()]
