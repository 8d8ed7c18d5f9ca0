"""Piles in ground that yields, pushed sideways: in clay, in sand, back and forth"""
import dataclasses
import math

import numpy as np

import report

# Young's modulus, Poisson's ratio, law, what comes before the push, method; elements from the shaft to the far side, last to first
CLAY = (3.0e4, 0.49, f"2, MISES, {50.0*math.sqrt(3.0)}", "", "NEWTON", 12, 200.0)
SAND = (4.0e4, 0.3, "2, MOHR, 1.0, 30.0, 0.0", """CASE
1
GRAVITY
-10.0
INSITU
, 0.0, 18.0, 0.5
""", "ANDERSON", 8, 100.0)
# Bottom and top of rows of elements, number of rows, last to first of them: finer to the surface and to the base
ROWS = ((-9.0, -5.0, 6, 0.125), (-5.0, -2.5, 4, 10.0), (-2.5, 0.0, 3, 1.0/3.0))
COARSE = 6, 10.0, ((-9.0, -5.0, 3, 1.0), (-5.0, 0.0, 6, 1.0))  # elements across, last to first, rows
WIDTH, SHAFT, GROUND = 1.0, 1.8, 1.8  # diameter [m], densities [t/m3]


def pile(ground, harmonic, finer, moves, load=None, across=None, rows=ROWS):
    """A pile 1 m wide and 5 m long (kN, m), its head moved sideways without turning; or an elastic deck with a load in
    every harmonic if `load` says so; elements across the ground and rows of elements"""
    young, poisson, law, before, method, usual, outward = ground
    across = across or usual
    case = 2 if before else 1
    pushed = f"""MOVEDFACES
1, 1, 1.0, 0.0, -1.0
""" if load is None else "TRACTIONS\n" + "".join(f"1, {m}, 1.0, 1.0, {0.0 if m == 0 else -1.0}\n" for m in range(harmonic + 1))
    blocks = "".join(f"""1, {1 if low >= -5.0 else 2}, 8, {finer}, {finer*n}, 1.0, {grading}
0.0, {low}, 0.5, {high}
1, 2, 8, {finer*across}, {finer*n}, {outward}, {grading}
0.5, {low}, 10.0, {high}
""" for low, high, n, grading in rows)
    steps = "".join(f"{move}, , , {case}\n" for move in moves)
    return f"""TITLE
A pile pushed sideways
CONTROL
{harmonic}, , , 2{f', , , , {method}' if load is None else ''}
MATERIALS
1, 3.0E7, 0.2, {SHAFT}
2, {young}, {poisson}, {GROUND}
{f"YIELD{chr(10)}{law}" if load is None else "!"}
BLOCKS
{blocks}FACES
1, 1, 0.0, 0.0, 0.5, 0.0
2, 1, 0.0, -9.0, 10.0, -9.0
3, 1, 10.0, -9.0, 10.0, 0.0
FIXEDFACES
2, 111
3, 111
{before if load is None else ""}{f"CASE{chr(10)}2{chr(10)}" if before and load is None else ""}{pushed}""" + (
        f"""COMBINE
1, 1, 1.0
1, 2, 1.0
""" if before and load is None else "") + (("INCREMENTS\n" + ("1.0, , , 1\n" if before else "") + steps)
                                           if load is None else "") + "END\n"


def pushed(found):
    """Lateral force on the head after each increment"""
    return np.abs(found.supports[:, found.face == 1, 1]).sum(1)


@dataclasses.dataclass
class Pile:
    """Load and displacement: harmonics, mesh, what it takes; and back and forth"""
    name: str
    words: str
    ground: tuple
    moves: tuple
    forth: tuple
    most: float          # elastic analyses; over increments if `each`
    each: bool
    drift: float         # change of the force in the last cycle
    recommended: int = 5
    reference: int = 15
    bar: float = 1.0     # difference of M = 5 and more to M = 15, and to the twice finer mesh [%]
    coarse: bool = False  # whether it goes back and forth on the coarse mesh
    solutions: tuple = ()
    long: bool = True

    def run(self, program):
        """Rows: harmonics and meshes; then the cycles"""
        rows, misses = [], []
        elastic = min(program.seconds(f"{self.name}_elastic_{k}", pile(self.ground, self.recommended, 1, (), load=True))
                      for k in range(3))
        found = {}
        for m, finer in ((1, 1), (3, 1), (5, 1), (7, 1), (self.reference, 1), (self.recommended, 2)):
            found[m, finer] = program.history(f"{self.name}_{m}_{finer}", pile(self.ground, m, finer, self.moves))
        before = 1 if self.ground[3] else 0
        for (m, finer), run in found.items():
            if run.no_equilibrium_at is not None:
                misses.append(f"{self.name}: M = {m}: no equilibrium at {run.no_equilibrium_at}")
                continue
            force = pushed(run)[before:]
            wanted = pushed(found[(self.reference, 1) if finer == 1 else (self.recommended, 1)])[before:]
            off = 100.0*np.abs(wanted/force - 1.0).max()
            rows.append([self.words, str(m), "twice finer" if finer == 2 else "as it is", f"{force[len(force)//2]:.1f}",
                         f"{force[-1]:.1f}", f"{off:.2f} %", str(int(run.iterations.sum())),
                         str(int(run.solutions.sum())), f"{run.processor:.1f}"])
            if m >= self.recommended and not off <= self.bar:
                misses.append(f"{self.name}: M = {m} is off by {off:.2f} %")
        run = found[self.recommended, 1]
        ratio = run.processor/elastic/(len(self.moves) if self.each else 1)
        text = (f"{self.words}, M = {self.recommended}, the mesh as it is: {run.processor:.1f} s, {100.0*run.error_seconds/run.seconds:.0f} % of it for its estimates of errors; an elastic analysis of all these harmonics "
                f"{elastic:.2f} s: {ratio:.0f} elastic analyses{' an increment' if self.each else ''} with the estimates (bar {self.most:.0f}).")
        if not ratio <= self.most:
            misses.append(f"{self.name}: {ratio:.0f} elastic analyses")
        tables = [report.table(["pile", "M", "mesh", "force half way", "force at the end", "difference", "iterations",
                                "solutions", "seconds"], rows), text]
        cycle, more = self._cycles(program)
        return tables + [cycle], misses + more

    def _cycles(self, program):
        ground, rows = self.ground, ROWS
        if self.coarse:
            ground, rows = (*ground[:-2], *COARSE[:2]), COARSE[2]
        found = program.history(f"{self.name}_cycles", pile(ground, 3, 1, self.forth, rows=rows))
        peaks = pushed(found)[-len(self.forth):][1::4]  # four increments a cycle
        spent = np.diff(found.dissipated)
        text = (f"Back and forth, M = 3{', on the coarse mesh' if self.coarse else ''}: force after the first push and after each cycle {', '.join(f'{x:.1f}' for x in peaks)}; "
                f"the last cycle changed it by {100.0*abs(peaks[-1]/peaks[-2] - 1.0):.2f} %. "
                f"The least work dissipated in an increment is {spent.min():.2g} of {found.dissipated[-1]:.3g} in all.")
        misses = [] if spent.min() >= -1e-9*found.dissipated[-1] else [f"{self.name}: dissipation falls by {spent.min():.1e}"]
        if found.no_equilibrium_at is not None:
            misses.append(f"{self.name}: back and forth: no equilibrium at {found.no_equilibrium_at}")
        steps = np.abs(np.diff(peaks))
        if not abs(peaks[-1]/peaks[-2] - 1.0) <= self.drift:
            misses.append(f"{self.name}: the last cycle changes the force by {100.0*steps[-1]/peaks[-2]:.2f} %")
        if not (steps[1:] <= np.maximum(steps[:-1], 1e-4*peaks[-1])).all():
            misses.append(f"{self.name}: cycles change the force by ever more: {steps}")
        return text, misses


CLAY_MOVES = (0.0025,)*2 + (0.005,)*4 + (0.0075,)*2 + (0.01,)*6
SAND_MOVES = (0.0025,)*4 + (0.005,)*8


def cycles(size, n):
    """A push in two increments and n cycles back and forth"""
    return (size, size) + (-2.0*size, -2.0*size, 2.0*size, 2.0*size)*n


CASES = [Pile("yield_pile_clay", "clay, to 10 % D", CLAY, CLAY_MOVES, cycles(0.01, 2), 60.0, False, 0.01),
         Pile("yield_pile_sand", "sand, to 5 % D", SAND, SAND_MOVES, cycles(0.005, 8), 30.0, True, 0.01, coarse=True)]
