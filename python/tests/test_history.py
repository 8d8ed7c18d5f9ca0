"""Increments of a result: series, and views of the fields"""
import shutil
import tempfile
import unittest

import h5py
import jobs
import numpy as np

import axijoint

INCREMENTS = "\nINCREMENTS "
STOPPED = 4


class Increments(unittest.TestCase):
    """The monopile, whole and stopped at an increment"""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        text = jobs.input_deck("monopile", "KEEP", "  STRESSES      ONLY    2")
        cls.result = axijoint.open(f"{jobs.run(cls.folder.name, 'whole', text)}.h5")
        head, tail = text.split(INCREMENTS)
        lines = tail.split("\n")
        cards = next(k for k, line in enumerate(lines[1:], 1) if line[:1].isalpha())
        stopped = head + INCREMENTS + "\n".join(lines[:STOPPED + 1] + lines[cards:])
        cls.stopped = axijoint.open(f"{jobs.run(cls.folder.name, 'stopped', stopped)}.h5")

    def close(self, found, wanted, share=1e-12):
        np.testing.assert_allclose(found, wanted, rtol=0, atol=share*abs(np.asarray(wanted)).max())

    def test_view_is_the_run_stopped_there(self):
        view, stopped = self.result.at(STOPPED), self.stopped
        self.assertEqual((view.increment, stopped.increment, self.result.increment), (STOPPED, STOPPED, 8))
        self.close(view.displacement(3.0, [5.0, -7.3], 30.0, body=1),
                   stopped.displacement(3.0, [5.0, -7.3], 30.0, body=1))
        self.close(view.nodal_displacement(180.0), stopped.nodal_displacement(180.0))
        for column in ("sigma", "tau", "gap", "slip"):
            self.close(view.joints()[column], stopped.joints()[column], 1e-9)
        self.assertTrue((view.joints()["state"] == stopped.joints()["state"]).all())
        for name in ("cuts/resultants", "resultants/applied", "reaction"):
            self.close(view.read(name), stopped.read(name), 1e-9)
        paths = [one.convergence() for one in (view, stopped)]  # the last increment of a run may iterate longer
        self.assertEqual(*(sorted(set(path["increment"])) for path in paths))
        self.assertEqual(*(path.where(path["increment"] < STOPPED)["n_slip"].tolist() for path in paths))
        self.close(view.section(1).displacement, stopped.section(1).displacement)
        self.close(view.section(1).stress, stopped.section(1).stress, 1e-9)
        self.assertGreater(abs(view.nodal_displacement() - self.result.nodal_displacement()).max(), 1e-3)

    def test_views_share_the_mesh_and_leave_the_result_alone(self):
        before = self.result.displacement_amplitude
        self.assertIs(self.result.at(1).mesh, self.result.mesh)
        self.assertIs(self.result.at(1).at(8).mesh, self.result.mesh)
        self.assertFalse((self.result.at(1).displacement_amplitude == before).all())
        self.assertIs(self.result.displacement_amplitude, before)
        self.close(self.result.at(1).at(8).displacement_amplitude, before, 0)

    def test_stresses_where_kept(self):
        self.assertEqual(self.result.history.increments_of("stress").tolist(), [2, 8])
        self.assertEqual(self.result.at(2).stress(3.0, -5.0, body=1).shape, (6,))
        self.assertNotEqual(self.result.at(2).stress(3.0, -5.0, body=1)[1],
                            self.result.stress(3.0, -5.0, body=1)[1])
        with self.assertRaisesRegex(axijoint.NotKeptError, "stresses of increment 3 .* of 2, 8.*STRESSES ALL"):
            self.result.at(3).stress(3.0, -5.0)
        with self.assertRaisesRegex(axijoint.NotKeptError, "/errors/displacement is of increment 8"):
            self.result.at(3).read("errors/displacement")
        for name in ("resultants", "convergence"):
            with self.assertRaises(axijoint.NotKeptError):
                self.result.at(3).attributes_of(name)
        with self.assertRaisesRegex(ValueError, "no increment 9"):
            self.result.at(9)

    def test_series(self):
        history = self.result.history
        self.assertEqual(self.result.increments["load_factor"].round(12).tolist(),
                         [1, 1.2, 1.4, 1.6, 1.8, 2, 1.5, 1])
        self.assertEqual(history.point_names, ["mudline", "head", "toe"])
        for k in (1, 6):
            self.close(history.point("head", 90.0)[k - 1], self.result.at(k).displacement(3, 5, 90.0))
            self.close(history.point(2, 60.0, cartesian=True)[k - 1],
                       self.result.at(k).displacement(3, 5, 60.0, cartesian=True))
        with self.assertRaisesRegex(ValueError, "no point 'tip'; there is mudline, head, toe"):
            history.point("tip")
        self.assertEqual([one.name for one in self.result.interfaces], ["shaft", "plug", "toe"])
        self.assertEqual([len(one.joints) for one in self.result.interfaces], [12, 12, 1])
        total = sum(history.interface(name) for name in ("shaft", "plug", 3))
        self.close(total[:, 1:3], -history["applied"][:, 1:3], 1e-6)

    def test_series_as_stored(self):
        """Groups name their datasets"""
        history = self.result.history
        with self.assertRaisesRegex(KeyError, "history/points .* is a group; datasets in it: .*history/points/displacement, "):
            history["points"]
        with self.assertRaisesRegex(KeyError, "/mesh .* is a group"):
            self.result.read("mesh")
        self.assertEqual(history["points/position"].shape, (3, 2))
        self.assertEqual(history["joint_amplitude"].shape[:2], (8, len(self.result.harmonic)))
        for name in history.names:
            if name not in ("points", "sections"):
                self.assertTrue(len(history[name]) > 0, name)

    def test_only_what_is_asked_for_is_read(self):
        path = f"{self.folder.name}/hollow.h5"
        shutil.copy(self.result.path, path)
        with h5py.File(path, "a") as file:
            for name in ("joint_stress", "joint_amplitude", "stress", "cuts"):
                del file[f"history/{name}"]
        hollow = axijoint.open(path)
        self.close(hollow.at(3).nodal_displacement(), self.result.at(3).nodal_displacement(), 0)
        with self.assertRaisesRegex(KeyError, "history/joint_stress"):
            hollow.at(3).joints()


class Yielding(unittest.TestCase):
    """A pile in clay, whose plastic strain is kept of the last increment"""

    def test_what_is_of_the_end(self):
        with tempfile.TemporaryDirectory() as folder:
            result = axijoint.open(f"{jobs.run(folder, 'pile_clay', jobs.input_deck('pile_clay'))}.h5")
            last, view = result.increment, result.at(3)
            for name in ("equivalent", "plastic_strain", "active", "margin", "stress", "dissipation"):
                with self.assertRaisesRegex(axijoint.NotKeptError, f"/yield/{name} is of increment {last}, the last, alone"):
                    view.read(f"yield/{name}")
                np.testing.assert_array_equal(result.at(last).read(f"yield/{name}"), result.read(f"yield/{name}"))
            with self.assertRaises(axijoint.NotKeptError):
                view.attributes_of("yield")
            for name in ("planes", "strength", "stress_point", "load_factor"):
                np.testing.assert_array_equal(view.read(f"yield/{name}"), result.read(f"yield/{name}"))


class OneIncrement(unittest.TestCase):
    """A job of one increment keeps its series too"""

    def test_first(self):
        with tempfile.TemporaryDirectory() as folder:
            result = axijoint.open(f"{jobs.run(folder, 'first', jobs.input_deck('first'))}.h5")
            self.assertEqual(result.increments.rows, 1)
            np.testing.assert_array_equal(result.at(1).displacement_amplitude, result.displacement_amplitude)
            np.testing.assert_array_equal(result.at(1).nodal_amplitude, result.nodal_amplitude)


if __name__ == "__main__":
    unittest.main()
