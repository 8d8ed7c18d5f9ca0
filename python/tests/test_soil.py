"""Soil reactions on a pile: made-up files with numbers by hand, and the balance of the monopile"""
import tempfile
import unittest
import warnings

import h5py
import jobs
import numpy as np

import axijoint

# Two quadrilaterals of a pile (body 1, r 0-1, z 0-4), two of the ground beside it (body 2), one below it
NODES = [(0, 0), (1, 0), (0, 3), (1, 3), (0, 4), (1, 4),  # 1-6 the pile
         (1, 0), (2, 0), (1, 3), (2, 3), (1, 4), (2, 4),  # 7-12 the ground beside it
         (0, -1), (1, -1), (0, 0), (1, 0)]                # 13-16 the ground below it
ELEMENTS = [(1, 2, 4, 3), (3, 4, 6, 5), (7, 8, 10, 9), (9, 10, 12, 11), (13, 14, 16, 15)]
BODIES = [1, 1, 2, 2, 2]
# The lower joint of the shaft has the pile at side 1-2, the upper one at side 4-3; the last is the base
JOINTS = [(2, 4, 9, 7), (9, 11, 6, 4), (1, 2, 16, 15)]
# What side 4-3 exerts on side 1-2: V, H, M, T, H90, M90, joint by joint
RESULTANTS = [(6, -9, 3, 0, 12, 0), (-2, 5, -4, 0, 0, 0), (10, -7, 2, 0, 0, 8)]


def write(path, joints=JOINTS, resultants=RESULTANTS):
    """A file with what the reader needs, and a rigid motion of the pile: 0.1 aside, leaning 0.02, 0.003 down."""
    height = np.array([z for _, z in NODES])
    radius = np.array([r for r, _ in NODES])
    pile = np.arange(len(NODES)) < 6
    amplitude = np.zeros((2, len(NODES), 3))
    aside = np.where(pile, 0.1 + 0.02*height, 0.01)
    amplitude[0, :, 1] = np.where(pile, -0.003, -0.001)
    amplitude[1, :, 0], amplitude[1, :, 2] = aside, -aside
    amplitude[1, :, 1] = np.where(pile, -0.02*radius, 0)
    n = len(joints)
    data = {"mesh/coordinates": np.array(NODES, float), "mesh/node_label": np.arange(1, 17),
            "mesh/fixed": np.zeros((16, 3), int), "mesh/element_label": np.arange(1, 6),
            "mesh/element_body": BODIES, "mesh/element_size": [4]*5, "mesh/element_material": [1]*5,
            "mesh/element_nodes": [list(one) + [0]*5 for one in ELEMENTS], "mesh/joint_label": np.arange(1, n + 1),
            "mesh/joint_size": [4]*n, "mesh/joint_material": [1]*n, "mesh/joint_interface": [0]*n,
            "mesh/joint_nodes": [list(one) + [0]*2 for one in joints], "materials/label": [1],
            "joint_materials/label": [1], "modes/harmonic": [0, 1], "modes/family": [1, 1],
            "displacement": amplitude, "history/increment": [1], "history/load_factor": [1.0],
            "history/joint_resultants": np.array([resultants], float)}
    with h5py.File(path, "w") as file:
        for name, values in data.items():
            file[name] = values
        file.attrs.update({"program": "axijoint", "title": "By hand", "status": "converged", "combination": 0})
    return axijoint.open(path)


class ByHand(unittest.TestCase):
    """Three joints"""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.result = write(f"{self.folder.name}/hand.h5")

    def test_pile_is_found(self):
        self.assertEqual(axijoint.soil_reactions(self.result).body, 1)
        np.testing.assert_array_equal(self.result.mesh.joint_bodies, [(1, 2), (2, 1), (1, 2)])

    def test_reactions(self):
        soil = axijoint.soil_reactions(self.result)
        np.testing.assert_allclose((soil.low, soil.high), ([0, 3], [3, 4]))
        # on the pile H is -9 over 3 and -5 over 1; it resists the opposite
        np.testing.assert_allclose(soil.p, [[3, 5]])
        np.testing.assert_allclose(soil.m, [[1, 4]])
        np.testing.assert_allclose(soil.t, [[2, 2]])
        self.assertEqual((soil.base_z, soil.H_b[0], soil.M_b[0], soil.V_b[0]), (0, 7, 2, 10))

    def test_motions(self):
        soil = axijoint.soil_reactions(self.result)
        np.testing.assert_allclose(soil.v, [[0.13, 0.17]])
        np.testing.assert_allclose(soil.v_relative, [[0.12, 0.16]])
        np.testing.assert_allclose(soil.psi, [[0.02, 0.02]])
        np.testing.assert_allclose(soil.s, [[0.003, 0.003]])
        np.testing.assert_allclose(soil.s_relative, [[0.002, 0.002]])
        np.testing.assert_allclose((soil.v_b, soil.psi_b, soil.s_b), [[0.1], [0.02], [0.003]])

    def test_totals(self):
        force, moment = axijoint.soil_reactions(self.result).totals()
        self.assertAlmostEqual(force[0], 9 + 5 + 7)
        self.assertAlmostEqual(moment[0], (3 + 9*1.5) + (4 + 5*3.5) + 2)

    def test_direction(self):
        soil = axijoint.soil_reactions(self.result, theta=90.0)
        np.testing.assert_allclose(soil.p, [[-4, 0]])
        np.testing.assert_allclose(soil.v, [[0, 0]])
        self.assertEqual((soil.H_b[0], soil.M_b[0]), (0, 8))
        oblique = axijoint.soil_reactions(self.result, theta=60.0)
        np.testing.assert_allclose(oblique.p, [[3*0.5 - 4*0.75**0.5, 5*0.5]])
        np.testing.assert_allclose(oblique.v, [[0.13*0.5, 0.17*0.5]])

    def test_inside_and_outside_are_added(self):
        """A further joint from z = 0 to 4 with V, H, M = 8, -4, 12 on the pile: 2, 1 and 3 per length everywhere."""
        tube = write(f"{self.folder.name}/tube.h5", [*JOINTS, (2, 6, 11, 7)], [*RESULTANTS, (8, -4, 12, 0, 0, 0)])
        tube.mesh.joint_bodies[3] = 1, 2
        soil = axijoint.soil_reactions(tube)
        np.testing.assert_allclose(soil.p, [[3 + 1, 5 + 1]])
        np.testing.assert_allclose(soil.m, [[1 + 3, 4 + 3]])
        np.testing.assert_allclose(soil.t, [[2 + 2, 2 + 2]])
        np.testing.assert_allclose(soil.v, [[0.13, 0.17]])
        force, moment = soil.totals()
        self.assertAlmostEqual(force[0], 9 + 5 + 7 + 4)
        self.assertAlmostEqual(moment[0], (3 + 9*1.5) + (4 + 5*3.5) + 2 + (12 + 4*2))

    def test_the_other_side(self):
        """What the ground resists is the opposite of what the pile does."""
        pile, ground = (axijoint.soil_reactions(self.result, body=body) for body in (1, 2))
        np.testing.assert_allclose(ground.p[0], -pile.p[0])
        np.testing.assert_allclose(ground.v_relative, -pile.v_relative)

    def test_no_such_body(self):
        with self.assertRaisesRegex(LookupError, "body 7 has no joints along z"):
            axijoint.soil_reactions(self.result, body=7)


class Monopile(unittest.TestCase):
    """inputs/monopile.dat: joints outside, inside and below the wall of a tube"""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.result = axijoint.open(f"{jobs.run(cls.folder.name, 'monopile', jobs.input_deck('monopile'))}.h5")
        cls.soil = axijoint.soil_reactions(cls.result)

    def test_sums_are_what_is_applied(self):
        applied = self.result.history["applied"]
        force, moment = self.soil.totals()
        self.assertLess(abs(force - applied[:, 1]).max(), 1e-6*5.0)
        self.assertLess(abs(moment + applied[:, 2]).max(), 1e-6*125.0)
        self.assertEqual(abs(applied[:, 2]).max().round(6), 125.0)

    def test_sums_between_cuts_are_what_cuts_lose(self):
        soil, z = self.soil, self.result.read("cuts/z")
        cuts = self.result.history["cuts"]
        shear, lean, axial = cuts[..., 1], -cuts[..., 2], cuts[..., 0]
        place = {round(float(height), 6): k for k, height in enumerate(z)}
        count = 0
        for k, (low, high) in enumerate(zip(soil.low, soil.high)):
            a, b = place.get(round(float(low), 6)), place.get(round(float(high), 6))
            if a is None or b is None:
                continue
            length = high - low
            np.testing.assert_allclose(soil.p[:, k]*length, shear[:, b] - shear[:, a], atol=1e-6*5)
            np.testing.assert_allclose(soil.m[:, k]*length + soil.p[:, k]*length**2/2,
                                       lean[:, b] + shear[:, b]*length - lean[:, a], atol=1e-6*125)
            # tension on the part below, and the steel's weight between the cuts
            weight = 6.85e-3*9.81*np.pi*(3.0**2 - 2.92**2)*length
            np.testing.assert_allclose(soil.t[:, k]*length, weight + axial[:, a] - axial[:, b], atol=1e-6*5)
            count += 1
        self.assertGreaterEqual(count, 6)

    def test_cuts_give_the_same(self):
        cuts, joints = axijoint.soil_reactions(self.result, source="cuts"), self.soil
        self.assertEqual((cuts.source, joints.source), ("cuts", "joints"))
        for name in ("H_b", "M_b"):
            np.testing.assert_allclose(getattr(cuts, name), getattr(joints, name), atol=1e-6*5)
        for found, wanted, applied in zip(cuts.totals(), joints.totals(), (5, 125)):
            np.testing.assert_allclose(found, wanted, atol=1e-6*applied)
        self.assertTrue(np.isnan(cuts.v_relative).all())
        self.assertTrue((abs(cuts.p[:, cuts.low >= 0]) < 1e-6).all())

    def test_bonded_toe(self):
        """What the toe takes is known from cuts alone."""
        text = jobs.input_deck("monopile").replace("    1    6    7    JOINTS    ", "         6    7    BONDED    ")
        text = text.replace("    2       0.0   9.81E-3       0.5", "    2       0.0   9.81E-3       0.5" + 20*" " + "MEANT")
        cards = "CUTS" + text.split("\nCUTS")[1].split("SECTIONS")[0]
        result = axijoint.open(f"{jobs.run(self.folder.name, 'bonded', text)}.h5")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            soil = axijoint.soil_reactions(result)
        self.assertEqual(soil.source, "cuts")
        applied = result.history["applied"]
        force, moment = soil.totals()
        self.assertLess(abs(force - applied[:, 1]).max(), 1e-6*5.0)
        self.assertLess(abs(moment + applied[:, 2]).max(), 1e-6*125.0)
        with self.assertWarnsRegex(UserWarning, "toe of body 1: bonded; .* source='cuts' has it, from CUTS of body 1"):
            joints = axijoint.soil_reactions(result, source="joints")
        self.assertGreater(abs(joints.totals()[0] - applied[:, 1]).max(), 1e-2*5.0)
        uncut = axijoint.open(f"{jobs.run(self.folder.name, 'uncut', text.replace(cards, ''))}.h5")
        with self.assertRaisesRegex(LookupError, "toe of body 1: bonded, .* CUTS of body 1 alone"):
            axijoint.soil_reactions(uncut)

    def test_motion_is_that_of_the_cuts(self):
        motion, z = self.result.history["cut_motion"], self.result.read("cuts/z")
        for found, column, sign in ((self.soil.v, 1, 1), (self.soil.psi, 2, -1), (self.soil.s, 0, -1)):
            wanted = sign*np.array([np.interp(self.soil.z, z, row) for row in motion[..., column]])
            self.assertLess(abs(found - wanted).max(), 0.02*abs(wanted).max())

    def test_increments(self):
        some = axijoint.soil_reactions(self.result, increments=[6, 8])
        np.testing.assert_array_equal(some.p, self.soil.p[[5, 7]])
        self.assertEqual(some.shaft_table().rows, 2*len(some.z))
        self.assertEqual(some.base_table()["load_factor"].round(12).tolist(), [2, 1])


if __name__ == "__main__":
    unittest.main()
