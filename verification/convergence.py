"""Convergence cases: one exact solution, all element types, meshes refined by halves"""
import dataclasses
import math
from typing import Callable

import norms
import report
from mesh import ALL_TYPES

ORDER_TOLERANCE = 0.2
PATCH_ALLOWED = 1e-9
SIZES = {1: (8, 16, 32), 2: (4, 8, 16)}


@dataclasses.dataclass
class Case:
    """An exact solution, and how to make decks of it"""
    name: str
    # Solutions of all modes, one list a body
    bodies: list
    # Element type, number n of cells -> Deck
    build: Callable
    kinds: tuple = ALL_TYPES
    # Element type -> whether the solution lies in the space of the elements
    contains: Callable = lambda kind: False
    # Whether the reduced rule, too, integrates the work of its stresses exactly
    reduced_exact: bool = True
    # Polynomial degree -> numbers n of the meshes
    sizes: dict = dataclasses.field(default_factory=lambda: dict(SIZES))
    # Size of stresses that stands for the exact ones where those are zero
    stress_scale: float = None

    @property
    def solutions(self):
        """All solutions, to be checked"""
        return [solution for body in self.bodies for solution in body]

    def run(self, program):
        """Runs all meshes of all element types: table rows and what missed its bar"""
        rows, misses = [], []
        for kind in self.kinds:
            if self.contains(kind) and (self.reduced_exact or not kind.gauss_points):
                row, missed = self._patch_row(program, kind)
            else:
                row, missed = self._order_row(program, kind)
            rows.append(row)
            misses += [f"{self.name}, {kind.name}: {words}" for words in missed]
        headings = ["element", "cells", "error of displacements", "order", "error of stresses", "order"]
        return [report.table(headings, rows)], misses

    def errors(self, program, kind, n):
        """Relative errors of displacements and stresses on one mesh"""
        deck = self.build(kind, n)
        results = program.run(f"{self.name}_{kind.name.replace(' ', '_')}_{n}", deck.text())
        displacement = stress = 0.0
        for body, (mesh, solutions) in enumerate(zip(deck.meshes, self.bodies), start=1):
            nodal = {s.mode: results.nodal(s.mode, len(mesh.coordinates), deck.offsets[id(mesh)])
                     for s in solutions}
            displacement = max(displacement, norms.displacement_error(mesh, solutions, nodal))
            points = results.points_of_body(body)
            gauss = {s.mode: results.stress[s.mode][points] for s in solutions}
            stress = max(stress, norms.stress_error(solutions, results.position[points], gauss,
                                                    self.stress_scale))
        return displacement, stress

    def _patch_row(self, program, kind):
        n = self.sizes[kind.degree][0]
        errors = self.errors(program, kind, n)
        missed = [f"{what} off by {error:.1e}, allowed {PATCH_ALLOWED:.0e}" for what, error in
                  zip(("displacements", "stresses"), errors) if not error <= PATCH_ALLOWED]
        displacement, stress = map(report.rounding, errors)
        return [kind.name, str(n), displacement, "exact", stress, "exact"], missed

    def _order_row(self, program, kind):
        sizes = self.sizes[kind.degree]
        errors = list(zip(*(self.errors(program, kind, n) for n in sizes)))
        orders = [order(values, sizes) for values in errors]
        missed = []
        highest = math.inf if self.contains(kind) else kind.degree + 1 + ORDER_TOLERANCE
        if not kind.degree + 1 - ORDER_TOLERANCE <= orders[0] <= highest:
            missed.append(f"order {orders[0]:.2f} of the displacements, theory {kind.degree + 1}")
        if not orders[1] >= kind.degree - ORDER_TOLERANCE:
            missed.append(f"order {orders[1]:.2f} of the stresses, theory {kind.degree}")
        return [kind.name, ", ".join(map(str, sizes)), report.errors(errors[0]), f"{orders[0]:.2f}",
                report.errors(errors[1]), f"{orders[1]:.2f}"], missed


def order(errors, sizes):
    """Observed order of convergence between the last two meshes"""
    return math.log(errors[-2]/errors[-1])/math.log(sizes[-1]/sizes[-2])
