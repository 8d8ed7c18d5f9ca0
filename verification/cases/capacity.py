"""Ground that yields under a load all round it or at one side: a disc pushed through clay, a footing, piles"""
import dataclasses
import math

import numpy as np

import report

# Clay: undrained shear strength 1, rigidity of a disc and a joint beside it
YOUNG, POISSON, STIFF, JOINT = 300.0, 0.49, 3.0e5, 3.0e4
ROUGH = 4.0*math.sqrt(2.0) + 2.0*math.pi


def between(adhesion):
    """Limit of a disc over width and shear strength: lower bound (Randolph and Houlsby, Geotechnique 34, 1984), which
    is exact for adhesion 1; the upper bound is at most 0.65 % higher (Martin and Randolph, Geotechnique 56, 2006)"""
    angle = math.asin(adhesion)
    return math.pi + 2.0*angle + 4.0*math.cos(math.pi/4.0 - angle/2.0)*(math.sqrt(2.0) + math.sin(math.pi/4.0 - angle/2.0))


def disc(cells, harmonic, adhesion=None, planes="", moves=(0.01, 0.02, 0.03, 0.04, 0.1, 0.1)):
    """A stiff disc of radius 1 that is moved through clay; with a joint round it that bears a share of the shear
    strength, pressed so that it does not open"""
    law = "" if adhesion is None else f"""LAWS
1, {JOINT}, {JOINT}, {JOINT}, {adhesion}, 0.0
LAWDETAILS
1, RESULTANT, , , , , , -30.0
"""
    join = "" if adhesion is None else """5, 2, 1.0, 0.0, 1.0, 1.0
6, 1, 1.0, 0.0, 1.0, 1.0
INTERFACES
1, 5, 6
"""
    return f"""TITLE
A stiff disc pushed sideways through clay
CONTROL
{harmonic}, , , 2, , , , , {planes}
MATERIALS
1, {YOUNG}, {POISSON}
2, {STIFF}, 0.2
YIELD
1, MISES, {math.sqrt(3.0)}
{law}BLOCKS
{1 if adhesion is None else 2}, 2, 8, 1, 1
0.5, 0.0, 1.0, 1.0
1, 1, 8, {cells}, 1, 100.0
1.0, 0.0, 12.0, 1.0
FACES
1, {1 if adhesion is None else 2}, 0.5, 0.0, 0.5, 1.0
2, 1, 12.0, 0.0, 12.0, 1.0
3, 1, 1.0, 0.0, 12.0, 0.0
4, 1, 1.0, 1.0, 12.0, 1.0
{join}FIXEDFACES
2, 111
3, 010
4, 010
MOVEDFACES
1, 1, 1.0, 0.0, -1.0
INCREMENTS
""" + "".join(f"{move},\n" for move in moves) + "END\n"


def limit(found):
    """Force on the disc at the end over width and shear strength, from the far side, which carries it"""
    return np.abs(found.supports[-1, :, 1]).max()/2.0


@dataclasses.dataclass
class DiscMeshes:
    """Disc in clay: bonded, and with joints of ever more shear strength"""
    name: str = "yield_disc"
    sizes: tuple = (8, 16, 32)
    adhesions: tuple = (0.0, 0.25, 0.5, 0.75, 1.0)
    solutions: tuple = ()
    bar: float = 0.01    # above what is exact, or the upper bound

    def run(self, program):
        """Rows: joints; columns: meshes"""
        rows, misses = [], []
        for adhesion in (None, *self.adhesions):
            exact = ROUGH if adhesion is None else between(adhesion)
            harmonic = 7 if adhesion is None else 11  # a joint that slips is not smooth round the disc
            off = [limit(program.history(f"{self.name}_{adhesion}_{cells}", disc(cells, harmonic, adhesion)))/exact - 1.0
                   for cells in self.sizes]
            words = "bonded" if adhesion is None else f"joint, C = {adhesion} s_u"
            rows.append([words, f"{exact:.3f}", *(f"{100.0*value:+.2f} %" for value in off)])
            upper = 1.0 if adhesion in (None, 1.0) else 1.0065
            if not 0.0 < off[-1] <= (1.0 + self.bar)*upper - 1.0:
                misses.append(f"{self.name}, {words}: {100.0*off[-1]:+.2f} % on the finest mesh")
        return [report.table(["disc", "exact, or lower bound", *(f"{cells} cells" for cells in self.sizes)], rows)], misses


@dataclasses.dataclass
class DiscPlanes:
    """Disc in clay: harmonics and planes"""
    name: str = "yield_planes"
    cells: int = 8
    harmonics: tuple = (1, 2, 3, 4, 5, 7, 10, 16)
    solutions: tuple = ()
    long: bool = True
    bar: float = 0.005  # of 2M + 1 planes against 4M + 1, from M = 3 on

    def run(self, program):
        """Rows: harmonics; columns: planes"""
        rows, misses = [], []
        for m in self.harmonics:
            cells, values = [], []
            for planes in (m + 1, m + 2, 2*m + 1, 4*m + 1):
                found = program.history(f"{self.name}_{m}_{planes}", disc(self.cells, m, planes=planes))
                values.append(limit(found))
                solutions = int(found.solutions.sum())
                cells.append(f"{values[-1]:.3f} ({solutions})" if found.no_equilibrium_at is None else
                             f"{values[-1]:.3f}, none beyond {found.load_factor[-1]:.3g}")
            rows.append([str(m), *cells])
            if m >= 3 and not abs(values[2]/values[3] - 1.0) <= self.bar:
                misses.append(f"{self.name}, M = {m}: 2M + 1 planes {values[2]:.3f}, 4M + 1 planes {values[3]:.3f}")
        return [report.table(["M", "M + 1 planes", "M + 2", "2M + 1", "4M + 1"], rows)], misses


def footing(cells, joint, moved, moves, harmonic=0):
    """A rigid footing of radius 1 on clay of Tresca, elements graded to its edge, bonded to it or by a joint that
    bears the shear strength of the clay"""
    base = f"""2, 2, 8, {cells}, 1, 0.1
0.0, 0.0, 1.0, 0.25
""" if joint else ""
    faces = """4, 2, 0.0, 0.0, 1.0, 0.0
5, 2, 0.0, 0.25, 1.0, 0.25
INTERFACES
1, 1, 4
""" if joint else ""
    law = f"""LAWS
1, {JOINT}, {JOINT}, {JOINT}, 1.0, 0.0
LAWDETAILS
1, RESULTANT, , , , , , -30.0
""" if joint else ""
    return f"""TITLE
A rough rigid footing on clay
CONTROL
{harmonic}, , , 2
MATERIALS
1, {YOUNG}, {POISSON}
2, {STIFF}, 0.2
YIELD
1, TRESCA, 2.0
{law}BLOCKS
1, 1, 8, {cells}, {2*cells}, 0.1, 0.05
0.0, -4.0, 1.0, 0.0
1, 1, 8, {2*cells}, {2*cells}, 20.0, 0.05
1.0, -4.0, 6.0, 0.0
{base}FACES
1, 1, 0.0, 0.0, 1.0, 0.0
2, 1, 0.0, -4.0, 6.0, -4.0
3, 1, 6.0, -4.0, 6.0, 0.0
{faces}FIXEDFACES
2, 111
3, 111
MOVEDFACES
{5 if joint else 1}, {moved}
INCREMENTS
""" + "".join(f"{move},\n" for move in moves) + "END\n"


def turned_footing(cells, harmonic, steps):
    """A stiff footing, bonded to the clay, under a moment of 1; displacements are given"""
    return f"""TITLE
A footing that is turned
CONTROL
{harmonic}, , , 2
MATERIALS
1, {YOUNG}, {POISSON}
2, {STIFF}, 0.2
YIELD
1, TRESCA, 2.0
BLOCKS
1, 1, 8, {cells}, {2*cells}, 0.1, 0.05
0.0, -4.0, 1.0, 0.0
1, 1, 8, {2*cells}, {2*cells}, 20.0, 0.05
1.0, -4.0, 6.0, 0.0
1, 2, 8, {cells}, 1, 0.1
0.0, 0.0, 1.0, 0.25
FACES
2, 1, 0.0, -4.0, 6.0, -4.0
3, 1, 6.0, -4.0, 6.0, 0.0
5, 1, 0.0, 0.25, 1.0, 0.25
FIXEDFACES
2, 111
3, 111
RESULTANTS
5, MOMENT, 1.0
INCREMENTS
""" + "".join(f"{step}, , , , DISPLACEMENT\n" for step in steps) + "END\n"


def scoop():
    """Least moment of a spherical scoop that turns under a footing over A D s_u: an upper bound"""
    best = math.inf
    for height in np.linspace(0.0, 2.0, 401):  # of the centre above the ground
        radius = math.hypot(1.0, height)
        nodes, weights = np.polynomial.legendre.leggauss(40)
        polar = 0.5*math.atan2(1.0, height)*(nodes + 1.0)  # from the downward axis to the edge
        angle = np.linspace(0.0, 2.0*math.pi, 400, endpoint=False)
        lever = radius*np.sqrt(1.0 - (np.sin(polar)[:, None]*np.sin(angle))**2)
        area = radius**2*np.sin(polar)*weights*0.5*math.atan2(1.0, height)
        best = min(best, float((area*lever.mean(1)).sum()*2.0*math.pi))
    return best/(math.pi*2.0)


@dataclasses.dataclass
class Footing:
    """Footing: vertical, sliding, overturning"""
    name: str = "yield_footing"
    sizes: tuple = (3, 6, 12)
    solutions: tuple = ()
    pressed: tuple = (0.005, 0.005, 0.01, 0.02, 0.04, 0.1, 0.2)
    moved: tuple = (0.005, 0.005, 0.01, 0.02, 0.04, 0.1)
    turned: tuple = (1.3, 1.3, 2.0, 4.0, 8.0, 16.0, 32.0)

    def _capacities(self, program, words, component, scale, joint, moved, moves, harmonic, sizes):
        found = []
        for cells in sizes:
            run = program.history(f"{self.name}_{words}_{joint}_{cells}", footing(cells, joint, moved, moves, harmonic))
            found.append(abs(run.supports[-1, -1, component])/scale)
        return found

    def run(self, program):
        """Rows: loads; columns: meshes"""
        rows, misses = [], []
        jobs = (("V0", "V₀ / A s_u, bonded", 0, math.pi, False, "0, 0.0, -1.0", self.pressed, 0, 6.05, 0.0, 0.03),
                ("V0", "V₀ / A s_u, joint, C = s_u", 0, math.pi, True, "0, 0.0, -1.0", self.pressed, 0, 6.05, -0.005, 0.02),
                ("H0", "H₀ / A s_u, joint, C = s_u", 1, math.pi, True, "1, 1.0, 0.0, -1.0", self.moved, 3, 1.0, -1e-3, 0.005))
        for key, words, component, scale, joint, moved, moves, harmonic, exact, low, high in jobs:
            found = self._capacities(program, key, component, scale, joint, moved, moves, harmonic,
                                     self.sizes if harmonic == 0 else self.sizes[:2])
            rows.append(self._row(words, exact, found))
            if not low <= found[-1]/exact - 1.0 <= high:
                misses.append(f"{self.name}, {words}: {found[-1]:.3f} instead of {exact:.3f}")
        bound = scoop()
        found = [program.history(f"{self.name}_M0_{cells}", turned_footing(cells, 3, self.turned)).load_factor[-1]
                 /(2.0*math.pi) for cells in self.sizes]
        words = "M₀ / A D s_u, bonded"
        rows.append(self._row(words, bound, found))
        if not abs((2.0*found[-1] - found[-2])/bound - 1.0) <= 0.02 or not bound < found[-1] < found[-2]:
            misses.append(f"{self.name}, {words}: {found} with a bound of {bound:.3f}")
        return [report.table(["load", "exact; of M₀ upper bound", *(f"{cells} cells" for cells in self.sizes),
                              "extrapolated"], rows)], misses


    def _row(self, words, exact, found):
        """A row of the table; the error halves with the elements, as it is that of the edge"""
        cells = [f"{value:.3f} ({100.0*(value/exact - 1.0):+.2f} %)" for value in found]
        return [words, f"{exact:.3f}", *cells, *[""]*(len(self.sizes) - len(cells)), f"{2.0*found[-1] - found[-2]:.3f}"]


CASES = [DiscMeshes(), DiscPlanes(), Footing()]
