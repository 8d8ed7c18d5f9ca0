"""A displacement that is linear in x, y, z is exact in every element: values at any point are known."""
import tempfile
import unittest

import jobs
import numpy as np

import axijoint

YOUNG, POISSON = 3.0e4, 0.25
SLOPE = np.array([(2.0e-3, 0.5e-3, 0.7e-3), (-0.3e-3, 1.0e-3, 0.4e-3), (0.9e-3, -0.6e-3, -1.5e-3)])
CORNERS = [(0.4, -0.1), (1.6, 0.0), (1.3, 1.2), (0.5, 0.9)]


def amplitudes(r, z):
    """(harmonic, family) -> u, v, w of the displacement SLOPE (x, y, z)."""
    (a, b, c), (d, e, f), (g, h, i) = SLOPE
    return {(0, "S"): ((a + e)/2*r, i*z, 0), (0, "A"): (0, 0, -(d - b)/2*r),
            (1, "S"): (c*z, g*r, -c*z), (1, "A"): (f*z, h*r, -f*z),
            (2, "S"): ((a - e)/2*r, 0, -(a - e)/2*r), (2, "A"): ((b + d)/2*r, 0, -(b + d)/2*r)}


def deck(size):
    """A block of distorted elements of one size; the displacements of its sides are given."""
    cards = ["TITLE", "linear displacement", "CONTROL", "    2", "MATERIALS",
             f"1,{YOUNG},{POISSON}", "BLOCKS", f"1,1,{size},3,2,1.5,0.7",
             ",".join(f"{x}" for corner in CORNERS for x in corner), "FACES"]
    sides = list(zip(CORNERS, CORNERS[1:] + CORNERS[:1]))
    cards += [f"{k},1,{a[0]},{a[1]},{b[0]},{b[1]}" for k, (a, b) in enumerate(sides, 1)] + ["MOVEDFACES"]
    for k, ends in enumerate(sides, 1):
        first, last = (amplitudes(*end) for end in ends)
        for (m, family), values in first.items():
            held = range(3) if m else (2,) if family == "A" else (0, 1)
            fields = [f"{value:.6G}" if i in held else "" for both in (values, last[m, family])
                      for i, value in enumerate(both)]
            cards.append(",".join([str(k), str(m), *fields, family]))
    return "\n".join([*cards, "END", ""])


class LinearField(unittest.TestCase):
    """Displacements and stresses at random points."""

    @classmethod
    def setUpClass(cls):
        random = np.random.default_rng(1)
        a, b = random.uniform(0, 1, (2, 40, 1))
        c = np.array(CORNERS)
        cls.r, cls.z = ((1 - a)*(1 - b)*c[0] + a*(1 - b)*c[1] + a*b*c[2] + (1 - a)*b*c[3]).T
        cls.theta = random.uniform(-360, 360, 40)
        strain = (SLOPE + SLOPE.T)/2
        stress = YOUNG/(1 + POISSON)*(strain + POISSON/(1 - 2*POISSON)*np.trace(strain)*np.eye(3))
        cls.wanted = stress[[0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]

    def check(self, size):
        with tempfile.TemporaryDirectory() as folder:
            result = axijoint.open(f"{jobs.run(folder, 'linear', deck(size))}.h5")
            turn = np.radians(self.theta)
            place = np.stack([self.r*np.cos(turn), self.r*np.sin(turn), self.z])
            found = result.displacement(self.r, self.z, self.theta, cartesian=True)
            np.testing.assert_allclose(found, (SLOPE @ place).T, rtol=0, atol=1e-13)
            for source in ("nodal", "gauss"):
                found = result.stress(self.r, self.z, self.theta, cartesian=True, source=source)
                np.testing.assert_allclose(found, np.tile(self.wanted, (40, 1)), rtol=0, atol=1e-8)

    def test_three_nodes(self):
        self.check(3)

    def test_four_nodes(self):
        self.check(4)

    def test_six_nodes(self):
        self.check(6)

    def test_eight_nodes(self):
        self.check(8)

    def test_nine_nodes(self):
        self.check(9)


if __name__ == "__main__":
    unittest.main()
