"""The largest of sums of harmonics: none is larger anywhere round the circle, and few are looked at closely"""
import unittest
import unittest.mock

import jobs  # where the package is
import numpy as np

from axijoint import circle
from axijoint.report.waves import Waves

FAMILIES = ((1,), (2,), (1, 2))
# Components of a displacement, and all: its length
PARTS = ([0], [1], [2], [0, 1, 2])


def modes(highest, families):
    """Harmonics and families up to one."""
    return np.tile(np.arange(highest + 1), len(families)), np.repeat(families, highest + 1)


def of(values, part):
    """What is looked for."""
    return np.linalg.norm(values, axis=-1) if len(part) > 1 else values[..., part[0]]


class LargestOfWaves(unittest.TestCase):
    """Random amplitudes"""

    def check(self, amplitude, harmonic, family):
        """Nothing is larger at 1440 angles, and it is what is at its place."""
        fine = np.arange(0, 360, 0.25)
        values = np.stack([circle.totals(amplitude, harmonic, family, angle) for angle in fine])
        for part in PARTS:
            for sign in (1,) if len(part) > 1 else (-1, 1):
                value, point, theta = Waves(harmonic, family, amplitude[..., part], [k == 2 for k in part]).largest(sign)
                wanted, size = sign*of(values, part), abs(of(values, part)).max()
                self.assertLessEqual(wanted.max() - sign*value, 1e-11*size)
                self.assertLessEqual(sign*value - wanted.max(), 1e-3*size)
                there = circle.totals(amplitude[:, [point]], harmonic, family, np.array([theta]))[0]
                self.assertAlmostEqual(of(there, part), value, delta=1e-11*size)

    def test_nothing_is_larger(self):
        """Two points of any: of many peaks one beside a lower sample may be the highest"""
        random = np.random.default_rng(1)
        for highest in (0, 1, 5, 12):
            for family in FAMILIES:
                for _ in range(4):
                    self.check(random.normal(size=(len(modes(highest, family)[0]), 2, 3)), *modes(highest, family))

    def test_the_first_of_equal_ones(self):
        amplitude = np.zeros((37, 50, 1))
        amplitude[36, 10:] = 2.0
        self.assertEqual(Waves(*modes(36, (1,)), amplitude, [False]).largest(), (2.0, 10, 0.0))
        self.assertEqual(Waves(*modes(36, (1,)), 0*amplitude, [False]).largest(-1), (0.0, 0, 0.0))

    def test_few_are_looked_at_closely(self):
        """Of 3000 points those that may hold the largest, whose number does not grow with the harmonics"""
        random, climbed = np.random.default_rng(1), Waves._climbed
        for highest in (6, 36):
            harmonic, family = modes(highest, (1, 2))
            amplitude, count = random.normal(size=(len(harmonic), 3000, 1))/(1 + harmonic[:, None, None]), []
            with unittest.mock.patch.object(Waves, "_climbed", lambda *all: count.append(len(all[-1])) or climbed(*all)):
                Waves(harmonic, family, amplitude, [False]).largest()
            self.assertTrue(0 < sum(count) < 100, count)


if __name__ == "__main__":
    unittest.main()
