"""Loads given as functions of theta: a patch of pressure, and a load that is turned"""
import dataclasses
import math

import numpy as np

import report
from cases.rings import INNER, OUTER, STEEL, plane_strain_deck
from deck import Deck
from mesh import ALL_TYPES, ELEMENT_TYPES, rectangle, structured
from solution import ANTISYMMETRIC, SYMMETRIC
from solutions.plane_strain import Ring, ring_solution, solve_rings

HALF_ANGLE = 7.2
HIGHEST = (5, 10, 20, 40, 80)
# Harmonics of the reference: what is above changes no digit shown
REFERENCE = 3000
ANGLES = np.radians(np.linspace(0.0, 180.0, 3601))


def patch_coefficient(m):
    """Fourier coefficient of the patch: 1 for |theta| < HALF_ANGLE"""
    alpha = math.radians(HALF_ANGLE)
    return alpha/math.pi if m == 0 else 2*math.sin(m*alpha)/(m*math.pi)


def left_out(highest):
    """Root mean square of what harmonics above `highest` carry, over that of the patch (Parseval)"""
    total = 2*math.radians(HALF_ANGLE)
    kept = 2*math.pi*patch_coefficient(0)**2
    kept += math.pi*sum(patch_coefficient(m)**2 for m in range(1, highest + 1))
    return math.sqrt(1 - kept/total)


def listed_rest(listing):
    """What a listing says is left out of the load of the first PRESSURES card"""
    for line in listing.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[1:2] == ["PRESSURES,"]:
            return float(words[0])
    raise ValueError(f"{listing} does not say what is left out of the load")


@dataclasses.dataclass
class PatchPressure:
    """A ring held inside under a pressure of 1 on |theta| < 7.2 degrees"""
    name: str = "patch_pressure"
    # Harmonics whose solutions are put into their equations
    checked: tuple = (0, 1, 2, 5, 20, 80, 640)

    @property
    def solutions(self):
        """Some of the solutions summed, to be checked"""
        return [ring_solution("ring held inside", STEEL, m, (INNER, OUTER), self._conditions())
                for m in self.checked]

    @staticmethod
    def _conditions():
        return [("sigma_r", OUTER, -1.0), ("tau", OUTER, 0.0), ("u", INNER, 0.0), ("w", INNER, 0.0)]

    def _exact(self, m, radius):
        """u outside and sigma_theta at a radius under sigma_r = -cos m theta"""
        ring = Ring(STEEL, m, INNER, OUTER)
        conditions = [c for c in self._conditions() if m or c[0] in ("u", "sigma_r")]
        solve_rings([([(ring, name, r, 1.0)], value) for name, r, value in conditions], [ring])
        solution = ring.solution("", SYMMETRIC)
        return (solution.displacement(np.float64(OUTER), 0.0)[0],
                solution.stress(np.float64(radius), 0.0)[2])

    @staticmethod
    def _deck(highest):
        kind = ELEMENT_TYPES["8-node reduced"]
        solution = ring_solution("Patch of pressure", STEEL, highest, (INNER, OUTER), [])
        deck, mesh = plane_strain_deck(kind, 64, [solution], solution.name, (INNER, OUTER), 1/16)
        deck.fix(mesh, mesh.nodes_of("inner"), "101")
        deck.add("SHAPES", [(1, "PATCH", -HALF_ANGLE, HALF_ANGLE)])
        deck.add("PRESSURES", [(deck.face(mesh, mesh.sides["outer"]), None, 1.0, None, None, 1)])
        return deck, mesh

    def _measure(self, program, highest):
        """Displacement under the load, peak hoop stress at the outermost points, and their radius; what
        the listing says is left out of the load"""
        deck, mesh = self._deck(highest)
        name = f"{self.name}_{highest}"
        results = program.run(name, deck.text())
        node = mesh.sides["outer"][0][0]
        point = np.argmax(results.position[:, 0])
        modes = [mode for mode in results.displacement if mode[1] == SYMMETRIC]
        u = sum(results.nodal(mode, len(mesh.coordinates))[node, 0] for mode in modes)
        hoop = sum(results.stress[mode][point, 2]*np.cos(mode[0]*ANGLES) for mode in modes)
        return (u, hoop[np.argmax(np.abs(hoop))], results.position[point, 0],
                listed_rest(program.directory/f"{name}.lis"))

    def run(self, program):
        """Rows: highest harmonics"""
        found = [self._measure(program, highest) for highest in HIGHEST]
        radius = found[0][2]
        terms = np.array([self._exact(m, radius) for m in range(REFERENCE + 1)]).T
        terms *= [patch_coefficient(m) for m in range(REFERENCE + 1)]
        cosines = np.cos(np.outer(np.arange(REFERENCE + 1), ANGLES))
        rows, misses = [], []
        for highest, (u, hoop, _, rest) in zip(HIGHEST, found):
            partial = self._sums(terms, cosines, highest)
            whole = self._sums(terms, cosines, REFERENCE)
            rows.append([str(highest), f"{100*rest:.1f} %", f"{u:.5e}",
                         f"{100*(u/whole[0] - 1):+.2f} %", f"{hoop:.4f}",
                         f"{100*(hoop/whole[1] - 1):+.2f} %"])
            for what, value, exact in (("displacement", u, partial[0]), ("stress", hoop, partial[1]),
                                       ("load left out", rest, left_out(highest))):
                if not abs(value/exact - 1) <= 1e-3:
                    misses.append(f"{self.name}, M = {highest}: {what} {value:.5e}, sum of the exact "
                                  f"solutions {exact:.5e}, allowed 0.1 %")
        rows.append(["exact", "0", f"{whole[0]:.5e}", "", f"{whole[1]:.4f}", ""])
        headings = ["M", "load left out", "u at θ = 0", "error", "peak hoop stress", "error"]
        return [report.table(headings, rows)], misses

    @staticmethod
    def _sums(terms, cosines, highest):
        u = terms[0, :highest + 1].sum()
        hoop = terms[1, :highest + 1] @ cosines[:highest + 1]
        return u, hoop[np.argmax(np.abs(hoop))]


@dataclasses.dataclass
class TurnedLoad:
    """A load of many harmonics, and the same load turned by an angle: both families in one run"""
    name: str = "turned_load"
    angle: float = 37.0
    highest: int = 12
    allowed: float = 1e-12
    solutions: tuple = ()

    def _deck(self, kind, turn):
        deck = Deck(f"A load turned by {turn} degrees", kind, self.highest)
        deck.material(STEEL)
        mesh = structured(kind, 4, 8, rectangle(0.0, 1.0, 0.0, 2.0))
        deck.mesh(mesh)
        deck.fix(mesh, mesh.nodes_of("bottom"), "111")
        deck.add("SHAPES", [(1, "PATCH", turn - 25.0, turn + 25.0), (2, "COSINE", 3, turn)])
        faces = [deck.face(mesh, mesh.sides[side]) for side in ("outer", "top")]
        deck.add("PRESSURES", [(faces[0], None, 1.0, 2.0, None, 1)])
        deck.add("TRACTIONS", [(faces[1], None, 0.3, -0.2, 0.1, None, None, None, None, 2)])
        deck.add("RESULTANTS", [(faces[1], "LATERAL", 0.5, turn), (faces[1], "MOMENT", 0.2, turn)])
        return deck, mesh

    def _difference(self, program, kind):
        """Largest difference of displacements and stresses over their largest value"""
        fields = []
        for turn in (0.0, self.angle):
            deck, mesh = self._deck(kind, turn)
            results = program.run(f"{self.name}_{kind.name.replace(' ', '_')}_{turn}", deck.text())
            fields.append((results.displacement, results.stress))
        turned = math.radians(self.angle)
        worst = []
        for straight, found in zip(*fields):
            size = max(np.abs(values).max() for values in straight.values())
            difference = 0.0
            for (m, family), values in found.items():
                first, second = straight.get((m, SYMMETRIC), 0.0), straight.get((m, ANTISYMMETRIC), 0.0)
                c, s = math.cos(m*turned), math.sin(m*turned)
                # A sum of cos m (theta - t) and sin m (theta - t), and so for w
                wanted = first*c - second*s if family == SYMMETRIC else first*s + second*c
                difference = max(difference, np.abs(values - wanted).max())
            worst.append(difference/size)
        return worst

    def run(self, program):
        """Rows: element types"""
        rows, misses = [], []
        for kind in ALL_TYPES:
            worst = self._difference(program, kind)
            rows.append([kind.name, *map(report.rounding, worst)])
            if not max(worst) <= self.allowed:
                misses.append(f"{self.name}, {kind.name}: {max(worst):.1e}, allowed {self.allowed:.0e}")
        return [report.table(["element", "displacements", "stresses"], rows)], misses


CASES = [PatchPressure(), TurnedLoad()]
