"""Joints round the circle, how far their faces stand apart, and the figures and largest values of them"""
import base64
import json
import pathlib
import tempfile
import unittest

import h5py
import jobs
import numpy as np

try:
    from axijoint import plot
    from overlaps import overlaps
except ImportError:
    plot = None

import axijoint
from axijoint import report
from axijoint.joint_points import JointPoints
from axijoint.report import view
from axijoint.report.extremes import joint_peaks

LAW = "    1     1.0E4     2.0E4     1.0E4       0.0      30.0\n"
ELASTIC = "1, 1.0E4, 2.0E4, 1.0E4, , , ELASTIC\n"
PUSH = "    1   LATERAL       0.4\n"
# Not symmetric: pushed along 40 degrees, pulled and twisted
ASKEW = "    1   LATERAL       0.4      40.0\n    1     AXIAL       0.2\n    1    TORQUE       0.1\n"
# Faces are 2E-4 apart before loading
APART = "LAWDETAILS\n1, RESULTANT, REVERSIBLE, , , , 2.0E-4\n"
APART_BY = 2e-4
ELASTIC_DECKS = ("curved_bodies", "in_situ_sum", "increments", "joint_cone_4", "joint_cone_6", "joint_cylinders_centroid",
                 "joint_cylinders_lobatto", "joint_tension_lobatto_8", "joint_triangles")


def peg(law=LAW, load=ASKEW, cards=""):
    """The peg of inputs/first.dat with another law, other loads, further cards."""
    deck = jobs.input_deck("first", *cards.splitlines())
    assert LAW in deck and PUSH in deck
    return deck.replace(LAW, law).replace(PUSH, load)


class Peg(unittest.TestCase):
    """A peg in a block"""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)

    def result(self, name, *changes, **named):
        """Result of a peg that is otherwise."""
        return axijoint.open(f"{jobs.run(self.folder.name, name, peg(*changes, **named))}.h5")


class Elastic(Peg):
    """Joints that do not yield, under loads of both families"""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        outputs = {"usual": "", "other": "OUTPUT\n270.0, 90.0, 0.0, 180.0, 40.0", "single": "OUTPUT\n      40.0"}
        cls.jobs = {name: cls.result(cls, name, ELASTIC, cards=cards) for name, cards in outputs.items()}

    def test_sums_are_those_of_the_file(self):
        """At the angles of OUTPUT the sums of the harmonics are what the program found there, whatever the joints are like"""
        results = list(self.jobs.values())
        for name in ELASTIC_DECKS:
            text = (jobs.ROOT/f"test/decks/good/{name}.dat").read_text(encoding="utf-8")
            results.append(axijoint.open(f"{jobs.run(self.folder.name, name, text)}.h5"))
        for result in results:
            for increment in result.history.increments_of("joints"):
                points = JointPoints(result.at(int(increment)))
                wanted = points.on_planes()
                found = points.at(wanted.theta)
                for one in ("stress", "jump", "gap"):
                    np.testing.assert_allclose(getattr(found, one), getattr(wanted, one), rtol=0,
                                               atol=1e-12*max(abs(getattr(wanted, one)).max(), 1e-12), err_msg=str(result))

    def test_table_at_angles(self):
        usual, other = self.jobs["usual"].joints(theta=[270, 40]), self.jobs["other"].joints()
        self.assertEqual(self.jobs["usual"].joints()["theta"].max(), 180)
        for theta in (270, 40):
            here, there = (one.where(np.isclose(one["theta"], theta)) for one in (usual, other))
            for name in ("sigma", "tau", "gap", "slip"):
                np.testing.assert_allclose(here[name], there[name], rtol=1e-9, atol=1e-15)
        with self.assertRaisesRegex(ValueError, "joints yield.* on the planes of their law alone"):
            self.result("yielding", load=PUSH).joints(theta=30)

    @unittest.skipIf(plot is None, "matplotlib is not installed")
    def test_pressure_round_the_circle(self):
        """It is the same whatever OUTPUT says, and no mirror image"""
        tables = [table for result in self.jobs.values() for _, table in plot.tables(result, ["pressure"])]
        for table in tables:
            np.testing.assert_allclose(table["pressure"], tables[0]["pressure"], atol=1e-12)
        whole, other = tables[0], self.jobs["other"].joints()
        self.assertEqual(np.unique(whole["theta"]).tolist(), list(range(0, 360, 5)))
        here = whole.where(whole["theta"] == 270)
        for z, pressure in zip(here["z"], here["pressure"]):
            there = np.isclose(other["z"], z) & np.isclose(other["theta"], 270)
            np.testing.assert_allclose(pressure, -other["sigma"][there], rtol=1e-9)
        self.assertAlmostEqual(here["pressure"][here["z"].argmin()], -0.311335, 6)

    @unittest.skipIf(plot is None, "matplotlib is not installed")
    def test_map_of_the_joints(self):
        """Angles ascend round the circle, whatever OUTPUT says"""
        for result in self.jobs.values():
            for name, figure in plot.figures(result, ["joints"]):
                self.assertEqual(overlaps(figure), [], name)
                cells = figure.axes[1].collections[0]
                edges = cells.get_coordinates()[0, :, 0]
                self.assertTrue((np.diff(edges) > 0).all())
                np.testing.assert_allclose((edges[1:] + edges[:-1])/2, np.arange(0, 360, 5), atol=1e-9)
                self.assertEqual(figure.axes[1].get_xlim(), (0, 355))
                self.assertAlmostEqual(cells.get_array().min(), -result.history["largest_pressure"][0], 6)

    def test_largest_of_the_report(self):
        """They are what the program says, not the largest of the angles of OUTPUT"""
        for name, result in self.jobs.items():
            found = joint_peaks(result)
            for key, series in (("pressure", "largest_pressure"), ("shear stress", "largest_shear")):
                self.assertAlmostEqual(found[key].value, result.history[series][0], 9)
            summary = json.loads((pathlib.Path(self.folder.name)/f"{name}.json").read_text(encoding="utf-8"))
            self.assertAlmostEqual(found["pressure"].value, summary["increments"][0]["largest_pressure"], 9)
            page = report.page(report.jobs_of(pathlib.Path(self.folder.name)/name), figures=False)
            self.assertIn("0.968578 MPa at joint 1, point 2, r = 0.5, z = 0.0264156, θ = 40°", page)
        for law in (LAW, ELASTIC):
            for load in (PUSH, ASKEW):
                result = self.result("either", law, load)
                self.assertAlmostEqual(joint_peaks(result)["pressure"].value, result.history["largest_pressure"][0], 9)

    def test_view_of_the_page(self):
        """Its cells go round the circle, too"""
        for name in self.jobs:
            job, = report.jobs_of(pathlib.Path(self.folder.name)/name)
            found = view.data(job)[0]["joints"]
            self.assertEqual((found["mirrored"], found["planes"]), (False, list(range(0, 360, 5))))
            pressure = np.frombuffer(base64.b64decode(found["values"][0][1]["data"]), "<i2")*found["values"][0][1]["scale"]
            self.assertAlmostEqual(pressure.max(), job.result.history["largest_pressure"][0], 4)


class Symmetric(Peg):
    """Joints under a load that is symmetric"""

    @unittest.skipIf(plot is None, "matplotlib is not installed")
    def test_mirror_image(self):
        for law in (LAW, ELASTIC):
            result = self.result("symmetric", law, PUSH)
            (_, table), = plot.tables(result, ["pressure"])
            for z in np.unique(table["z"]):
                here = table.where(table["z"] == z)
                turned = np.interp((360 - here["theta"]) % 360, here["theta"], here["pressure"])
                np.testing.assert_allclose(turned, here["pressure"], atol=1e-12)
                self.assertTrue((np.diff(here["theta"]) > 0).all())
            self.assertGreater(table["theta"].max(), 330)

    @unittest.skipIf(plot is None, "matplotlib is not installed")
    def test_a_load_that_is_not(self):
        """Of both families the planes of the law go round the circle themselves"""
        result = self.result("turned", LAW, ASKEW)
        (_, table), = plot.tables(result, ["pressure"])
        np.testing.assert_allclose(np.unique(table["theta"]), np.degrees(result.read("joints/planes")))
        self.assertGreater(table["theta"].max(), 330)


class Gap(Peg):
    """How far faces stand apart: a peg in a hole that is too large"""

    def test_gap(self):
        result = self.result("apart", LAW + APART, PUSH, cards="SWEEP\n       0.0     180.0    8")
        joints, d_eta = result.joints(), result.read("joints/jump")[..., 1].ravel()
        np.testing.assert_array_equal(joints["d_eta"], d_eta)
        np.testing.assert_array_equal(joints["gap"], np.maximum(d_eta + APART_BY, 0))
        self.assertTrue((joints["gap"][joints["state"] == "open"] > 0).all())
        self.assertTrue((joints["gap"][joints["sigma"] < 0] == 0).all())
        self.assertTrue((d_eta[joints["state"] == "open"] < 0).any())  # open, and nearer than before
        if plot is not None:
            (_, figure), = plot.figures(result, ["joints"])
            self.assertAlmostEqual(figure.axes[3].collections[0].get_array().max(), joints["gap"].max(), 12)
        self.assertEqual(joint_peaks(result)["gap"].value, joints["gap"].max())
        with h5py.File(f"{self.folder.name}/apart.joints.vtkhdf") as file:
            np.testing.assert_array_equal(np.unique(file["VTKHDF/CellData/gap"]), np.unique(joints["gap"]))
        job, = report.jobs_of(pathlib.Path(self.folder.name)/"apart")
        shown = view.data(job)[0]["joints"]
        packed = shown["values"][0][shown["names"].index("gap")]
        self.assertAlmostEqual(32767*packed["scale"], joints["gap"].max(), 9)


if __name__ == "__main__":
    unittest.main()
