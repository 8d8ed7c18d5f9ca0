"""A pile in clay that yields, by axijoint and, in space, by CalculiX: forces at three displacements beside seconds

The pile of verification/cases/piles.py: bonded, its head moved sideways without turning. Both programs have the same
meridional mesh, one element less fine than the recommended one; CalculiX the half 0 <= theta <= pi. See scripts/bench.
"""
import argparse
import os
import sys
import tempfile

import numpy as np

ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..")
sys.path[:0] = [os.path.join(ROOT, "verification"), os.path.join(ROOT, "verification", "cases")]
import piles
import program as verification
from ccx import numbers
from half_pile import RADIUS, Builder, core, graded, ring
from work_precision import RunError, measure

DISPLACEMENTS = (0.01, 0.04, 0.1)  # of the head [m]
STEPS = (4, 6, 6)                  # increments to each
OUTER = 10.0
# Elements on half the circle (a multiple of 4); from shaft to far side; shares of the rows of axijoint's mesh
SIZES = [(8, 6, 0.6), (12, 6, 0.6), (8, 8, 1.0)]


def rows_of(share):
    """Bottom, top, number and grading of the rows of elements"""
    return tuple((low, high, max(2, round(n*share)), grading) for low, high, n, grading in piles.ROWS)


def annulus(inner, outer):
    """One layer of elements round the pile: s outward, t around"""
    def place(s, t):
        r = inner + s*(outer - inner)
        return r*np.cos(np.pi*t), r*np.sin(np.pi*t)
    return place


def half(around, across, share):
    """Mesh of half the ground with its pile, and the elements of the pile"""
    build, pile = Builder(True), []
    radii = RADIUS + (OUTER - RADIUS)*graded(across, piles.CLAY[-1])
    for low, high, n, grading in rows_of(share):
        ends = low + (high - low)*graded(n, grading)
        for bottom, top in zip(ends[:-1], ends[1:]):
            up = {"up": "head"} if top > -1e-9 else {}
            first = len(build.mesh.elements)
            build.block(1, core, (around//2, around//4, 1), bottom, top, **up)
            build.block(1, ring, (1, around, 1), bottom, top, **up)
            if bottom > -5.0 - 1e-9:
                pile += range(first, len(build.mesh.elements))
            for inner, outer in zip(radii[:-1], radii[1:]):
                build.block(1, annulus(inner, outer), (1, around, 1), bottom, top)
    return build.mesh, pile


def deck_lines(mesh, pile):
    """The deck for CalculiX: the head is moved in three steps"""
    nodes = np.array(mesh.nodes)
    young, poisson = piles.CLAY[:2]
    lines = ["*HEADING", "Pile in clay: half of it. kN, m, kPa", "*NODE, NSET=ALL"]
    lines += [f"{n}, {x:.12g}, {y:.12g}, {z:.12g}" for n, (x, y, z) in enumerate(mesh.nodes, 1)]
    pile = set(pile)
    for name, chosen in (("PILE", True), ("CLAY", False)):
        lines.append(f"*ELEMENT, TYPE=C3D20R, ELSET={name}")
        for number, element in enumerate(mesh.elements, 1):
            if (number - 1 in pile) is chosen:
                lines += numbers([number, *(n + 1 for n in element)])
    held = (np.hypot(nodes[:, 0], nodes[:, 1]) > OUTER*(1 - 1e-6)) | (nodes[:, 2] < -9.0 + 1e-6)
    for name, members in {"PLANE": np.flatnonzero(abs(nodes[:, 1]) < 1e-9), "HELD": np.flatnonzero(held),
                          "HEAD": mesh.nodes_of("head")}.items():
        lines += [f"*NSET, NSET={name}", *numbers([int(n) + 1 for n in members])]
    lines += ["*MATERIAL, NAME=STIFF", "*ELASTIC", "3.0E7, 0.2", "*SOLID SECTION, ELSET=PILE, MATERIAL=STIFF",
              "*MATERIAL, NAME=GROUND", "*ELASTIC", f"{young}, {poisson}", "*PLASTIC", f"{50.0*3.0**0.5:.12g}, 0.0",
              "*SOLID SECTION, ELSET=CLAY, MATERIAL=GROUND",
              "*BOUNDARY", "PLANE, 2, 2", "HELD, 1, 3", "HEAD, 2, 3"]
    for moved, n in zip(DISPLACEMENTS, STEPS):
        lines += ["*STEP, NLGEOM=NO, INC=1000", "*STATIC", f"{1.0/n:.12g}, 1.0, 1E-5, {1.0/n:.12g}", "*BOUNDARY",
                  f"HEAD, 1, 1, {moved}", f"*NODE PRINT, NSET=HEAD, TOTALS=ONLY, FREQUENCY={10*n}", "RF", "*END STEP"]
    return lines


def forces_of(path):
    """Forces on the whole head along x that CalculiX printed, one a step"""
    with open(path, encoding="ascii") as file:
        rows = [line.split() for line in file]
    found = [2.0*float(row[0]) for row in rows if len(row) == 3 and row[0][-4:-2] in ("E+", "E-")]
    return np.array(found)


def calculix(folder, size):
    """Unknowns, forces, cost"""
    mesh, pile = half(*size)
    with open(os.path.join(folder, "job.inp"), "w", encoding="ascii") as file:
        file.write("\n".join(deck_lines(mesh, pile)) + "\n")
    cost = measure(["ccx", "job"], folder, 1, 1)
    return 3*len(mesh.nodes), forces_of(os.path.join(folder, "job.dat")), cost


def axijoint(path, folder, name, across, rows, harmonic=5):
    """Unknowns, forces and seconds, of the same displacements in as many increments"""
    ground = piles.CLAY
    before = (0.0,) + DISPLACEMENTS[:-1]
    moves = [(last - first)/n for first, last, n in zip(before, DISPLACEMENTS, STEPS) for _ in range(n)]
    found = verification.Program(path, folder).history(name, piles.pile(ground, harmonic, 1, moves, across=across, rows=rows))
    return piles.pushed(found)[np.cumsum(STEPS) - 1], found.seconds


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--axijoint", required=True)
    parser.add_argument("--quick", action="store_true")
    args = parser.parse_args()
    words = ", ".join(f"{100*moved:g} %" for moved in DISPLACEMENTS)
    print(f"Pile in clay: force on the head [kN] at displacements of {words} of its diameter; wall-clock seconds, one thread")
    with tempfile.TemporaryDirectory() as folder:
        for k, (around, across, share) in enumerate(SIZES[:1] if args.quick else SIZES):
            own, seconds = axijoint(args.axijoint, folder, f"own{k}", across, rows_of(share))
            unknowns, forces, cost = calculix(folder, (around, across, share))
            if len(forces) != len(DISPLACEMENTS):
                raise RunError(f"CalculiX printed {len(forces)} forces")
            print(f"meridional mesh {across} across, {sum(row[2] for row in rows_of(share))} rows")
            print(f"  CalculiX, {around} on half the circle, {unknowns} unknowns: {np.round(forces, 1)}, {cost.wall:.1f} s")
            print(f"  axijoint, M = 5: {np.round(own, 1)}, {seconds:.1f} s; above CalculiX by "
                  f"{np.round(100*(own/forces - 1), 2)} %, ratio of seconds {cost.wall/seconds:.0f}", flush=True)


if __name__ == "__main__":
    try:
        main()
    except RunError as error:
        sys.exit(f"clay: {error}")
