"""Elastic materials: stress = D (strain - expansion T), in the order r, z, theta, rz, r-theta, z-theta"""
import dataclasses
import math

import numpy as np

# Directions (1 = r, 2 = z, 3 = theta) of the six components of strain and stress
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


@dataclasses.dataclass(frozen=True)
class Isotropic:
    """Young's modulus [stress], Poisson's ratio, density [mass/volume], thermal expansion"""
    young: float
    poisson: float
    density: float = 0.0
    expansion: float = 0.0

    @property
    def shear(self):
        """Shear modulus [stress]"""
        return self.young/(2*(1 + self.poisson))

    def elasticity(self):
        """D, shape (6, 6)"""
        lame = self.young*self.poisson/((1 + self.poisson)*(1 - 2*self.poisson))
        d = np.diag([2*self.shear]*3 + [self.shear]*3)
        d[:3, :3] += lame
        return d

    def expansions(self):
        """Free strain per temperature, shape (6)"""
        return np.array([self.expansion]*3 + [0.0]*3)

    def cards(self, number):
        """Section and data cards that define the material"""
        constants = [self.young, self.poisson]
        if self.density or self.expansion:
            constants += [self.density, self.expansion]
        return "MATERIALS", [[number, *constants]]


@dataclasses.dataclass(frozen=True)
class Orthotropic:
    """Moduli E1 E2 E3, ratios nu12 nu23 nu13 (contraction along the second direction under stress
    along the first), G12 G23 G13; directions 1 and 2 in the meridional plane, `angle` from r to 1
    counterclockwise [degree], 3 along theta; density; expansions along 1, 2, 3"""
    moduli: tuple
    ratios: tuple
    shears: tuple
    angle: float = 0.0
    density: float = 0.0
    expansion: tuple = (0.0, 0.0, 0.0)

    def elasticity(self):
        """D in r, z, theta: the tensor of the material directions, turned about theta"""
        (e1, e2, e3), (nu12, nu23, nu13) = self.moduli, self.ratios
        compliance = np.zeros((6, 6))
        compliance[:3, :3] = [[1/e1, -nu12/e1, -nu13/e1],
                              [-nu12/e1, 1/e2, -nu23/e2],
                              [-nu13/e1, -nu23/e2, 1/e3]]
        g12, g23, g13 = self.shears
        compliance[3:, 3:] = np.diag([1/g12, 1/g13, 1/g23])
        local = np.linalg.inv(compliance)
        tensor = np.zeros((3, 3, 3, 3))
        for a, (i, j) in enumerate(PAIRS):
            for b, (k, l) in enumerate(PAIRS):
                for first in ((i, j), (j, i)):
                    for second in ((k, l), (l, k)):
                        tensor[first + second] = local[a, b]
        q = self._directions()
        turned = np.einsum("ai,bj,ck,dl,abcd->ijkl", q, q, q, q, tensor)
        return np.array([[turned[first + second] for second in PAIRS] for first in PAIRS])

    def expansions(self):
        """Free strain per temperature in r, z, theta, shape (6); shear strains are angles"""
        q = self._directions()
        strain = q.T @ np.diag(self.expansion) @ q
        return np.array([strain[pair]*(1 if pair[0] == pair[1] else 2) for pair in PAIRS])

    def _directions(self):
        """Rows: the directions 1, 2, 3 in r, z, theta"""
        c, s = math.cos(math.radians(self.angle)), math.sin(math.radians(self.angle))
        return np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])

    def cards(self, number):
        """Section and data cards that define the material"""
        first = [number, *self.moduli, self.angle, self.density, *self.expansion[:2]]
        return "ORTHOTROPIC", [first, [*self.ratios, *self.shears, self.expansion[2]]]
