"""Shape functions, natural coordinates, components"""
import unittest

import jobs
import numpy as np

from axijoint import circle, elements

assert jobs.ROOT


def distorted(size):
    """Nodes of an element with curved sides, if it has nodes there."""
    places = elements.TRIANGLE if elements.corners(size) == 3 else elements.SQUARE
    x, y = places[:size].T
    return np.stack([2 + x + .15*y + .1*x*y, 1 + y - .2*x - .06*x*x + .04*y*y], -1)


def inner_points(size, count=30):
    """Natural coordinates of random points inside."""
    points = np.random.default_rng(size).uniform(-1, 1, (count, 2))
    if elements.corners(size) == 4:
        return points
    a, b = (points.T + 1)/2
    return np.stack([a*(1 - b), b], -1)


class Elements(unittest.TestCase):
    """All sizes"""

    def test_functions_are_one_at_their_node(self):
        for size in (3, 4, 6, 8, 9):
            places = elements.TRIANGLE if elements.corners(size) == 3 else elements.SQUARE
            value, _ = elements.shape_functions(size, places[:size])
            np.testing.assert_allclose(value, np.eye(size), atol=1e-15)

    def test_derivatives(self):
        step = 1e-6
        for size in (3, 4, 6, 8, 9):
            points = inner_points(size)
            _, derivative = elements.shape_functions(size, points)
            for axis in (0, 1):
                shift = step*np.eye(2)[axis]
                high, low = (elements.shape_functions(size, points + s)[0] for s in (shift, -shift))
                np.testing.assert_allclose(derivative[..., axis], (high - low)/(2*step), atol=1e-9)

    def test_natural_coordinates_come_back(self):
        for size in (3, 4, 6, 8, 9):
            points = inner_points(size)
            value, _ = elements.shape_functions(size, points)
            nodes = np.tile(distorted(size), (len(points), 1, 1))
            natural, inside = elements.find_natural(nodes, value @ distorted(size))
            self.assertTrue(inside.all())
            np.testing.assert_allclose(natural, points, atol=1e-12)

    def test_points_outside_are_outside(self):
        for size in (3, 4, 6, 8, 9):
            nodes = distorted(size)[None]
            for place in ((10., 10.), (2., -5.), (-1., 1.)):
                natural, inside = elements.find_natural(nodes, np.array([place]))
                self.assertFalse(inside[0])
                self.assertTrue(np.isnan(natural).all())

    def test_cartesian_stress_has_the_same_principal_stresses(self):
        random = np.random.default_rng(3)
        stress, theta = random.normal(size=(20, 6)), random.uniform(0, 360, 20)
        turned = circle.cartesian_stress(stress, theta)
        xx, yy, zz, xy, yz, xz = turned.T
        same = np.stack([xx, zz, yy, xz, xy, yz], -1)  # x, y, z in the order of r, theta, z
        principal = circle.principal_stresses(stress)
        np.testing.assert_allclose(circle.principal_stresses(same), principal, atol=1e-12)
        np.testing.assert_allclose(circle.principal_stresses(turned, cartesian=True), principal, atol=1e-12)


if __name__ == "__main__":
    unittest.main()
