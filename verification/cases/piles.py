"""Piles in ground that yields, pushed sideways: in clay, in sand, back and forth"""
import dataclasses
import math

import numpy as np

import report

CLAY = (3.0e4, 0.49, f"2, MISES, {50.0*math.sqrt(3.0)}", "")
SAND = (4.0e4, 0.3, "2, MOHR, 1.0, 30.0, 0.0", """CASE
1
GRAVITY
-10.0
INSITU
, 0.0, 18.0, 0.5
""")
WIDTH, SHAFT, GROUND = 1.0, 1.8, 1.8  # diameter [m], densities [t/m3]


def pile(ground, harmonic, finer, moves, load=None):
    """A pile 1 m wide and 5 m long (kN, m), its head moved sideways without turning; or an elastic deck with a load in
    every harmonic if `load` says so"""
    young, poisson, law, before = ground
    n = finer
    case = 2 if before else 1
    pushed = f"""MOVEDFACES
1, 1, 1.0, 0.0, -1.0
""" if load is None else "TRACTIONS\n" + "".join(f"1, {m}, 1.0, 1.0, {0.0 if m == 0 else -1.0}\n" for m in range(harmonic + 1))
    steps = "".join(f"{move}, , , {case}\n" for move in moves)
    return f"""TITLE
A pile pushed sideways
CONTROL
{harmonic}, , , 2
MATERIALS
1, 3.0E7, 0.2, {SHAFT}
2, {young}, {poisson}, {GROUND}
{f"YIELD{chr(10)}{law}" if load is None else "!"}
BLOCKS
1, 1, 8, {n}, {6*n}
0.0, -5.0, 0.5, 0.0
1, 2, 8, {6*n}, {6*n}, 10.0
0.5, -5.0, 10.0, 0.0
1, 2, 8, {n}, {3*n}
0.0, -9.0, 0.5, -5.0
1, 2, 8, {6*n}, {3*n}, 10.0
0.5, -9.0, 10.0, -5.0
FACES
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
    return np.abs(found.supports[:, :, 1]).max(1)


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
    drift: float         # change of the force from cycle to cycle; inf: shown, not judged
    recommended: int = 5
    reference: int = 15
    bar: float = 1.0     # difference of M = 5 and more to M = 15 [%]
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
        wanted, steps = pushed(found[self.reference, 1])[-len(self.moves):], len(self.moves)
        for (m, finer), run in found.items():
            force = pushed(run)[-steps:]
            off = 100.0*np.abs(force/wanted - 1.0).max()
            rows.append([self.words, str(m), "twice finer" if finer == 2 else "as it is", f"{force[steps//2]:.1f}",
                         f"{force[-1]:.1f}", f"{off:.2f} %", str(int(run.iterations.sum())),
                         str(int(run.solutions.sum())), f"{run.seconds:.1f}"])
            if run.no_equilibrium_at is not None:
                misses.append(f"{self.name}: M = {m}: no equilibrium at {run.no_equilibrium_at}")
            if finer == 1 and m >= self.recommended and not off <= self.bar:
                misses.append(f"{self.name}: M = {m} is off by {off:.2f} %")
        run = found[self.recommended, 1]
        ratio = run.seconds/elastic/(len(self.moves) if self.each else 1)
        text = (f"{self.words}, M = {self.recommended}, coarse: {run.seconds:.1f} s, an elastic analysis of all these harmonics "
                f"{elastic:.2f} s: {ratio:.0f} elastic analyses{' an increment' if self.each else ''} (bar {self.most:.0f}).")
        if not ratio <= self.most:
            misses.append(f"{self.name}: {ratio:.0f} elastic analyses")
        tables = [report.table(["pile", "M", "mesh", "force half way", "force at the end", "difference to M = 15", "iterations",
                                "solutions", "seconds"], rows), text]
        cycle, more = self._cycles(program)
        return tables + [cycle], misses + more

    def _cycles(self, program):
        found = program.history(f"{self.name}_cycles", pile(self.ground, 3, 1, self.forth))
        force = pushed(found)[-len(self.forth):]
        drift = abs(force[-1]/force[-5] - 1.0)  # four increments a cycle
        spent = np.diff(found.dissipated)
        text = (f"Back and forth twice, M = 3: the force after the second cycle differs by {100.0*drift:.2f} % from that after "
                f"the first; the least work dissipated in an increment is {spent.min():.2g} of {found.dissipated[-1]:.3g} in all.")
        misses = [] if spent.min() >= -1e-9*found.dissipated[-1] else [f"{self.name}: dissipation falls by {spent.min():.1e}"]
        return text, misses + ([] if drift <= self.drift else [f"{self.name}: drift of {100.0*drift:.1f} %"])


CLAY_MOVES = (0.0025,)*2 + (0.005,)*4 + (0.0075,)*2 + (0.01,)*6
SAND_MOVES = (0.0025,)*4 + (0.005,)*8
CYCLES = (1, 1, -2, -2, 2, 2, -2, -2, 2, 2)
CASES = [Pile("yield_pile_clay", "clay, to 10 % D", CLAY, CLAY_MOVES, tuple(0.01*step for step in CYCLES), 60.0, False, 0.01),
         Pile("yield_pile_sand", "sand, to 5 % D", SAND, SAND_MOVES, tuple(0.005*step for step in CYCLES), 30.0, True, math.inf)]
