"""The V-H-M envelope of a footing on clay, 60 points by one study"""
import csv
import dataclasses
import math
import os
import subprocess

import report
from cases.capacity import scoop, turned_footing
from program import ProgramError

THICK = 0.25
# Loads at which each alone is at its limit, shear strength and radius 1: vertical, sliding, moment
ALONE = (6.05*math.pi, math.pi, scoop()*2.0*math.pi)
STEPS = (0.4, 0.4, 0.4, 0.8, 1.6, 3.2, 6.4)


def directions():
    """Loads over those of `ALONE`: vertical to in-plane angles 15 to 90 degrees, sliding and moment of all signs"""
    for tilt in range(15, 91, 15):
        for turn in range(0, 180, 18):
            a, b = math.radians(tilt), math.radians(turn)
            yield tilt, turn, (math.cos(a), math.sin(a)*math.cos(b), math.sin(a)*math.sin(b))


def table():
    """Rows of the study: axial, lateral force and moment at the top of the footing"""
    lines = ["RESULTANTS 1 VALUE, RESULTANTS 2 VALUE, RESULTANTS 3 VALUE"]
    for _, _, (v, h, m) in directions():
        force = ALONE[1]*h
        lines.append(f"{-ALONE[0]*v:.12g}, {force:.12g}, {ALONE[2]*m + THICK*force:.12g}")
    return "\n".join(lines) + "\n"


@dataclasses.dataclass
class Envelope:
    """Load factors that 60 directions of load end with, displacements being given"""
    name: str = "yield_envelope"
    cells: int = 4
    bar: float = 1.25    # of the loads alone: the error of so coarse a mesh
    solutions: tuple = ()
    long: bool = True

    def _rows(self, program):
        deck = turned_footing(self.cells, 3, STEPS).replace(
            "5, MOMENT, 1.0\n", "5, AXIAL, -1.0\n5, LATERAL, 1.0\n5, MOMENT, 1.0\n")
        (program.directory/f"{self.name}.dat").write_text(deck)
        (program.directory/f"{self.name}.csv").write_text(table())
        done = subprocess.run([program.path, "study", f"{self.name}.csv", f"{self.name}.dat", "-o", "."],
                              cwd=program.directory, capture_output=True, text=True, env=os.environ, check=False)
        if done.returncode:
            raise ProgramError(f"{self.name}: exit code {done.returncode}\n{done.stderr}")
        with open(program.directory/f"{self.name}.study.csv", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def run(self, program):
        """Rows: share of the vertical load; columns: from sliding alone to moment alone and on, over each alone"""
        factors = [float(row["load_factor"]) for row in self._rows(program)]
        rows, misses, turns = [], [], sorted({turn for _, turn, _ in directions()})
        found = dict(zip(((tilt, turn) for tilt, turn, _ in directions()), factors))
        for tilt in sorted({tilt for tilt, _, _ in directions()}):
            rows.append([f"{tilt}°", *(f"{found[tilt, turn]:.3f}" for turn in turns)])
        if len(factors) != 60:
            misses.append(f"{self.name}: {len(factors)} points")
        ways = {"sliding": found[90, 0], "moment": found[90, 90],
                "largest vertical load": max(factor*math.cos(math.radians(tilt)) for (tilt, _), factor in found.items())}
        misses += [f"{self.name}: {words} {value:.3f} of what it is alone" for words, value in ways.items()
                   if not (0.8 if words.startswith("largest") else 1.0) <= value <= self.bar]
        return [report.table(["V, H-M", *(f"{turn}°" for turn in turns)], rows)], misses


CASES = [Envelope()]
