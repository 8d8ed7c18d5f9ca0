"""Decks for CalculiX of the half pile in its footing, and their results"""
import os

import numpy as np

from half_pile import PILE_END, RADIUS, Density, end_forces, half_pile
from work_precision import measure

YOUNG, POISSON = 2e4, 0.17
NORMAL, SHEAR = 2e4, 1e4  # joint stiffness [MPa/m]
LATERAL, MOMENT = 0.4, 0.8
QUADRATIC = {"C3D8I": False, "C3D20R": True}
NEAR = 1e-9


def numbers(values, per_line=8):
    """Cards of integers"""
    return [", ".join(map(str, values[k:k + per_line])) + ("," if k + per_line < len(values) else "")
            for k in range(0, len(values), per_line)]


def deck_lines(mesh, element_type, solver):
    """The deck: the wall of the socket presses without friction and opens; the head is tied by springs"""
    nodes = np.array(mesh.nodes)
    lines = ["*HEADING", "Pile in its footing, frictionless: half of it. MN, m, MPa", "*NODE, NSET=ALL"]
    lines += [f"{n}, {x:.12g}, {y:.12g}, {z:.12g}" for n, (x, y, z) in enumerate(mesh.nodes, 1)]
    lines.append(f"*ELEMENT, TYPE={element_type}, ELSET=CONCRETE")
    for number, element in enumerate(mesh.elements, 1):
        lines += numbers([number, *(n + 1 for n in element)])
    for name, members in {"PLANE": np.flatnonzero(abs(nodes[:, 1]) < NEAR),
                          "TOP": mesh.nodes_of("top"),
                          "OUTPUT": sorted({tip(mesh), *(n for pair in joint_pairs(mesh) for n in pair)})}.items():
        lines += [f"*NSET, NSET={name}", *numbers([int(n) + 1 for n in members])]
    lines += ["*MATERIAL, NAME=CONCRETE", "*ELASTIC", f"{YOUNG}, {POISSON}",
              "*SOLID SECTION, ELSET=CONCRETE, MATERIAL=CONCRETE"]
    for name in ("shaft", "wall", "head", "roof"):
        lines.append(f"*SURFACE, NAME={name.upper()}, TYPE=ELEMENT")
        lines += [f"{element + 1}, S{face}" for element, face in mesh.faces[name]]
    lines += ["*SURFACE INTERACTION, NAME=PRESS", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{NORMAL}",
              "*SURFACE INTERACTION, NAME=TIE", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED", f"{NORMAL}",
              "*FRICTION", f"1.0, {SHEAR}",
              "*CONTACT PAIR, INTERACTION=PRESS, TYPE=SURFACE TO SURFACE", "SHAFT, WALL",
              "*CONTACT PAIR, INTERACTION=TIE, TYPE=SURFACE TO SURFACE", "HEAD, ROOF",
              "*BOUNDARY", "PLANE, 2, 2", "TOP, 1, 3",
              "*STEP, NLGEOM=NO", f"*STATIC, SOLVER={solver}", "1.0, 1.0", "*CLOAD"]
    for node, (along, tilt) in end_forces(mesh, LATERAL, MOMENT).items():
        lines += [f"{node + 1}, 1, {along:.12g}", f"{node + 1}, 3, {tilt:.12g}"]
    return lines + ["*NODE PRINT, NSET=OUTPUT, FREQUENCY=1", "U", "*END STEP"]


def tip(mesh):
    """Node at the centre of the pile's end"""
    return min(range(len(mesh.nodes)), key=lambda n: np.linalg.norm(np.subtract(mesh.nodes[n], (0, 0, PILE_END))))


def joint_pairs(mesh):
    """Nodes of shaft and wall that stand at one place"""
    place = {tuple(round(x*1e8) for x in mesh.nodes[n]): n for n in mesh.nodes_of("wall")}
    return [(n, place[tuple(round(x*1e8) for x in mesh.nodes[n])]) for n in mesh.nodes_of("shaft")]


def displacements(path):
    """Displacements that the program printed last, by node"""
    found = {}
    with open(path, encoding="ascii") as file:
        for line in file:
            fields = line.split()
            if fields and not fields[0].isdigit():
                found = {}
            elif len(fields) == 4:
                found[int(fields[0]) - 1] = np.array([float(field) for field in fields[1:]])
    return found


def solve(folder, density, element_type, solver, threads, runs=3, long=15.0):
    """Unknowns, lateral displacement of the pile's end, largest pressure of the vertical joint, cost"""
    mesh = half_pile(Density.of(*density), QUADRATIC[element_type])
    with open(os.path.join(folder, "job.inp"), "w", encoding="ascii") as file:
        file.write("\n".join(deck_lines(mesh, element_type, solver)) + "\n")
    cost = measure(["ccx", "job"], folder, threads, runs, long)
    moved = displacements(os.path.join(folder, "job.dat"))
    overlaps = [np.dot(moved[a] - moved[b], (*mesh.nodes[a][:2], 0.0))/RADIUS for a, b in joint_pairs(mesh)]
    return 3*len(mesh.nodes), moved[tip(mesh)][0], NORMAL*max(overlaps), cost
