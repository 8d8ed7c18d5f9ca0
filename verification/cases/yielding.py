"""Bodies that yield: specimens at a point of each criterion, thick cylinders and spheres to their collapse"""
import dataclasses
import math

import numpy as np

import report
from deck import Deck
from material import Isotropic
from mesh import ELEMENT_TYPES, polar, rectangle, structured
from program import ProgramError
from solution import ANTISYMMETRIC, SYMMETRIC

REDUCED = ELEMENT_TYPES["8-node reduced"]
YOUNG, POISSON = 1000.0, 0.3
STRENGTH, FRICTION, PRESSURE = 2.0, math.radians(30.0), 1.5
AXIAL, TORSION = (0, SYMMETRIC), (0, ANTISYMMETRIC)
# What of a criterion bears
PLANE, EDGE, APEX = 1, 2, 4
POINT_BAR = 1e-9
COLLAPSE_BAR = 1e-4


def ends(compression):
    """Axial stress at yield of each criterion under a pressure PRESSURE from the side"""
    sine, p = math.sin(FRICTION), PRESSURE
    root = 2.0*STRENGTH*math.cos(FRICTION)
    slope = 2.0*sine/(math.sqrt(3.0)*(3.0 - sine))
    height = 6.0*STRENGTH*math.cos(FRICTION)/(math.sqrt(3.0)*(3.0 - sine))
    if compression:
        steep = -(root + p*(1.0 + sine))/(1.0 - sine)
        return {"TRESCA": -p - STRENGTH, "MISES": -p - STRENGTH, "MOHR": steep, "DRUCKER": steep}
    return {"TRESCA": STRENGTH - p, "MISES": STRENGTH - p, "MOHR": (root - p*(1.0 - sine))/(1.0 + sine),
            "DRUCKER": (height - p*(1.0/math.sqrt(3.0) - 2.0*slope))/(1.0/math.sqrt(3.0) + slope)}


def shear():
    """Shear stress at yield under a pressure from all sides"""
    sine, p = math.sin(FRICTION), PRESSURE
    return {"TRESCA": STRENGTH/2.0, "MISES": STRENGTH/math.sqrt(3.0),
            "MOHR": STRENGTH*math.cos(FRICTION) + p*sine,
            "DRUCKER": (6.0*STRENGTH*math.cos(FRICTION) + 6.0*p*sine)/(math.sqrt(3.0)*(3.0 - sine))}


class Specimen:
    """A solid cylinder pressed from all sides, then pressed, pulled or twisted at its top until all of it yields"""

    def __init__(self, criterion, dilation):
        self.deck = deck = Deck(f"Specimen, {criterion}", REDUCED, 0)
        deck.material(Isotropic(YOUNG, POISSON))
        friction = math.degrees(FRICTION) if criterion in ("MOHR", "DRUCKER") else None
        deck.add("YIELD", [(1, criterion, STRENGTH, friction, dilation if friction else None)])
        self.mesh = structured(REDUCED, 2, 2, rectangle(0.0, 1.0, 0.0, 1.0))
        deck.mesh(self.mesh)
        self.top = deck.face(self.mesh, self.mesh.sides["top"])
        self.mantle = deck.face(self.mesh, self.mesh.sides["outer"])
        self.bottom = deck.face(self.mesh, self.mesh.sides["bottom"])

    def end(self, program, name, moves, pressed, active):
        """Stress amplitudes at the end of moves of the top, {mode: shape (points, 6)}; `active` is what must bear"""
        deck = self.deck
        deck.add("CASE", [(1,)])
        deck.add("PRESSURES", [(face, 0, PRESSURE) for face in pressed])
        deck.add("CASE", [(2,)])
        deck.add("MOVEDFACES", moves)
        deck.add("COMBINE", [(1, 1, 1.0), (1, 2, 1.0)])
        deck.add("INCREMENTS", [(1.0, 1e-12, None, 1)] + [(0.25, 1e-12, 2000, 2)]*4)
        found = program.history(name, deck.text())
        if not np.all(found.active == active):
            raise ProgramError(f"{name}: {np.unique(found.active)} bear instead of {active}")
        return found.stress


@dataclasses.dataclass
class YieldPoint:
    """Stress at yield, uniform in a specimen"""
    name: str = "yield_point"
    solutions: tuple = ()

    def run(self, program):
        """Rows: criteria; columns: ways to yield"""
        rows, misses = [], []
        for criterion in ("TRESCA", "MISES", "MOHR", "DRUCKER"):
            errors = []
            for dilation in (0.0, 30.0) if criterion in ("MOHR", "DRUCKER") else (0.0,):
                errors = [self._axial(program, criterion, dilation, compression) for compression in (True, False)]
                errors.append(self._shear(program, criterion) if dilation == 0.0 else None)
                errors.append(self._apex(program, criterion, dilation) if criterion in ("MOHR", "DRUCKER") else None)
                words = criterion + (f", ψ = {dilation:.0f}°" if criterion in ("MOHR", "DRUCKER") else "")
                rows.append([words, *("" if error is None else report.rounding(error) for error in errors)])
                misses += [f"{self.name}, {words}: off by {error:.1e}" for error in errors
                           if error is not None and not error <= POINT_BAR]
        return [report.table(["criterion", "compression", "extension", "shear", "apex"], rows)], misses

    def _axial(self, program, criterion, dilation, compression):
        specimen = Specimen(criterion, dilation)
        specimen.deck.add("FIXEDFACES", [(specimen.bottom, "010")])
        stress = specimen.end(program, f"{self.name}_{criterion}_{dilation:.0f}_{compression}",
                              [(specimen.top, 0, None, -0.08 if compression else 0.08, None, None, None, None, None, "ONLY")],
                              [specimen.mantle], PLANE if criterion in ("MISES", "DRUCKER") else EDGE)[AXIAL]
        wanted = np.array([-PRESSURE, ends(compression)[criterion], -PRESSURE, 0.0, 0.0, 0.0])
        return np.abs(stress - wanted).max()/np.abs(wanted).max()

    def _shear(self, program, criterion):
        specimen = Specimen(criterion, 0.0)
        specimen.deck.add("FIXEDFACES", [(specimen.bottom, "001")])
        specimen.deck.fix(specimen.mesh, specimen.mesh.sides["bottom"][0][:1], "010")
        stress = specimen.end(program, f"{self.name}_{criterion}_shear",
                              [(specimen.top, 0, None, None, 0.0, None, None, 0.2, "A")],
                              [specimen.mantle, specimen.top, specimen.bottom], PLANE)[TORSION]
        wanted = shear()[criterion]
        return np.abs(np.abs(stress[:, 5]) - wanted).max()/wanted

    def _apex(self, program, criterion, dilation):
        specimen = Specimen(criterion, dilation)
        specimen.deck.add("FIXEDFACES", [(specimen.bottom, "010")])
        stress = specimen.end(program, f"{self.name}_{criterion}_{dilation:.0f}_apex",
                              [(specimen.top, 0, None, 0.1), (specimen.mantle, 0, 0.1)], [], APEX)[AXIAL]
        wanted = STRENGTH/math.tan(FRICTION)*np.array([1.0, 1.0, 1.0, 0.0, 0.0, 0.0])
        return np.abs(stress - wanted).max()/np.abs(wanted).max()


@dataclasses.dataclass
class Thick:
    """A thick cylinder (plane strain) or sphere under pressure from inside: to c, the radius that plastic strain has
    reached, and to collapse (Hill, The mathematical theory of plasticity, V.1 and V.2)"""
    name: str
    words: str
    shape: int          # 1 cylinder, 2 sphere
    law: tuple          # fields of YIELD
    poisson: float
    curve: object       # pressure, outer displacement from c
    steps: tuple        # displacement steps over those of elastic bodies under the pressure 1
    tolerance: float = 1e-8
    sizes: tuple = (8, 16, 32)
    solutions: tuple = ()

    def _deck(self, cells):
        deck = Deck(self.words, REDUCED, 0)
        deck.material(Isotropic(YOUNG, self.poisson))
        deck.add("YIELD", [(1, *self.law)])
        mesh = structured(REDUCED, cells, 1 if self.shape == 1 else 6,
                          rectangle(1.0, 2.0, 0.0, 0.1) if self.shape == 1 else polar(1.0, 2.0))
        deck.mesh(mesh)
        deck.fix(mesh, mesh.nodes_of("bottom", "top") if self.shape == 1 else mesh.nodes_of("bottom"), "010")
        deck.add("PRESSURES", [(deck.face(mesh, mesh.sides["inner"]), 0, 1.0)])
        deck.add("POINTS", [(1, 2.0, 0.0)])
        deck.add("INCREMENTS", [(step, self.tolerance, 2000, None, "DISPLACEMENT") for step in self.steps])
        return deck.text()

    def _errors(self, program, cells):
        """Largest error of the outer displacement at the pressures found between first yield and collapse; error of
        the pressure at the end, where all has yielded; number of these states"""
        found = program.history(f"{self.name}_{cells}", self._deck(cells))
        last = self.curve(2.0)[0]
        moved = found.points[:, 0, 0, 0]
        errors = []
        for pressure, u in zip(found.load_factor, moved):
            if not self.curve(1.0)[0] < pressure < 0.995*last:
                continue
            low, high = 1.0, 2.0
            for _ in range(100):
                middle = 0.5*(low + high)
                low, high = (middle, high) if self.curve(middle)[0] < pressure else (low, middle)
            errors.append(abs(u/self.curve(low)[1] - 1.0))
        return max(errors), abs(found.load_factor[-1]/last - 1.0), len(errors)

    def run(self, program):
        """Rows: meshes"""
        rows, misses, before = [], [], None
        for cells in self.sizes:
            moved, collapse, count = self._errors(program, cells)
            rows.append([self.words, str(cells), str(count), report.rounding(moved), report.rounding(collapse)])
            if count < 2:
                misses.append(f"{self.name}: {count} states between first yield and collapse")
            if before is not None and not (moved < before or moved < 1e-6):
                misses.append(f"{self.name}: errors do not fall with the mesh")
            before = moved
        if not collapse <= COLLAPSE_BAR:
            misses.append(f"{self.name}: collapse off by {collapse:.1e}")
        return [report.table(["body", "cells", "states", "displacement outside", "collapse"], rows)], misses


def tresca_cylinder(strength, poisson):
    """Pressure and outer displacement of a cylinder that has yielded to c"""
    def curve(c):
        return (strength*(math.log(c) + 0.5*(1.0 - (c/2.0)**2)),
                (1.0 - poisson**2)*strength*c**2/(YOUNG*2.0))
    return curve


def sphere(strength, poisson):
    """The same of a sphere"""
    def curve(c):
        return (2.0*strength*math.log(c) + 2.0/3.0*strength*(1.0 - (c/2.0)**3),
                (1.0 - poisson)*strength*c**3/(YOUNG*4.0))
    return curve


def mohr_cylinder(cohesion, friction, poisson):
    """The same of a cylinder of Mohr and Coulomb: where it yields, N sigma_theta - sigma_r = Y, so that
    Y/(N - 1) - sigma_r goes like r^-(1 - 1/N); beyond c, Lame under the pressure at which c yields. The angle of
    dilation is in none of it"""
    sine = math.sin(friction)
    ratio, strength = (1.0 + sine)/(1.0 - sine), 2.0*cohesion*math.cos(friction)/(1.0 - sine)

    def curve(c):
        pressed = strength/(ratio*(4.0 + c**2)/(4.0 - c**2) + 1.0) if c < 2.0 else 0.0
        height = strength/(ratio - 1.0)
        return ((pressed + height)*c**(1.0 - 1.0/ratio) - height,
                (1.0 - poisson**2)/YOUNG*2.0*2.0*pressed*c**2/(4.0 - c**2) if c < 2.0 else math.inf)
    return curve


def thick_cases():
    """Cylinders and spheres"""
    mises = 2.0*STRENGTH/math.sqrt(3.0)
    degrees = math.degrees(FRICTION)
    pipe = (0.8, 0.2, 0.2, 0.3, 3.0, 3.0)
    yield Thick("yield_tresca_cylinder", "cylinder, TRESCA", 1, ("TRESCA", STRENGTH), POISSON,
                tresca_cylinder(STRENGTH, POISSON), pipe)
    yield Thick("yield_mises_cylinder", "cylinder, MISES, ν = 0.4999", 1, ("MISES", STRENGTH), 0.4999,
                tresca_cylinder(mises, 0.4999), pipe, 1e-6)
    ball = (1.8, 0.4, 0.4, 0.4, 6.0, 6.0)
    for criterion in ("TRESCA", "MISES"):
        yield Thick(f"yield_{criterion.lower()}_sphere", f"sphere, {criterion}", 2, (criterion, STRENGTH),
                    POISSON, sphere(STRENGTH, POISSON), ball, sizes=(4, 8, 16))
    for dilation in (0.0, degrees):
        yield Thick(f"yield_mohr_cylinder_{dilation:.0f}", f"cylinder, MOHR, φ = 30°, ψ = {dilation:.0f}°", 1,
                    ("MOHR", STRENGTH, degrees, dilation), POISSON,
                    mohr_cylinder(STRENGTH, FRICTION, POISSON), (1.2, 0.3, 0.3, 0.4, 5.0, 5.0))


CASES = [YieldPoint(), *thick_cases()]
