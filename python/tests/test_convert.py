"""Results for xarray, pandas and PyVista, each where it is installed; and what is said where it is not"""
import importlib.util
import tempfile
import unittest
import unittest.mock

import jobs
import numpy as np

import axijoint
from axijoint import elements

MISSING = {name: f"{name} is not installed: scripts/setup python" for name in ("pandas", "xarray", "pyvista")
           if importlib.util.find_spec(name) is None}


def needs(name):
    """Skips a test, and says why, where a package is not installed."""
    return unittest.skipIf(name in MISSING, MISSING.get(name, ""))


def volume(mesh):
    """Volume of the bodies by Gauss points, exact for straight sides."""
    total, g = 0.0, np.sqrt(1/3)
    for size, group in mesh.groups():
        if elements.corners(size) == 3:
            natural, weight = np.array([(1/6, 1/6), (2/3, 1/6), (1/6, 2/3)]), 1/6
        else:
            natural, weight = g*np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]), 1.0
        value, slope = elements.shape_functions(size, natural)
        nodes = mesh.coordinates[mesh.element_nodes[group, :size]]
        area = np.linalg.det(np.einsum("eni,pnk->epik", nodes, slope))
        total += (area*np.einsum("en,pn->ep", nodes[..., 0], value)).sum()*weight*2*np.pi
    return total


class Conversions(unittest.TestCase):
    """A monopile with stresses of two increments, a block of triangles with both families' loads"""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        keep = "KEEP", "  STRESSES      ONLY    3"
        for name, cards in (("monopile", keep), ("chimney", ())):
            jobs.run(cls.folder.name, name, jobs.input_deck(name, *cards))
        cls.monopile = axijoint.open(f"{cls.folder.name}/monopile.h5")
        cls.chimney = axijoint.open(f"{cls.folder.name}/chimney.2.h5")

    def test_what_is_not_installed_is_named(self):
        for name in ("pandas", "xarray", "pyvista"):
            with unittest.mock.patch.dict("sys.modules", {name: None}):
                with self.assertRaisesRegex(ImportError, f"to_{name} needs {name}: pip install {name}"):
                    getattr(self.chimney, f"to_{name}")()

    @needs("pandas")
    def test_pandas(self):
        frames = self.monopile.to_pandas(theta=30.0)
        self.assertEqual(list(frames["increments"]["increment"]), list(range(1, 9)))
        for name, table in (("nodes", self.monopile.nodes(30.0)), ("joints", self.monopile.joints())):
            self.assertEqual(list(frames[name].columns), table.column_names)
            np.testing.assert_array_equal(frames[name]["r"], table["r"])
        self.assertEqual(len(frames["nodal_stresses"]), self.monopile.nodal_stresses().rows)

    @needs("xarray")
    def test_xarray(self):
        for result in (self.monopile, self.chimney):
            data = result.to_xarray()
            for k in result.history.increment:
                here, view = data.sel(increment=k), result.at(int(k))
                np.testing.assert_array_equal(here["displacement"], view.displacement_amplitude)
                np.testing.assert_array_equal(here["joint_stress"], view.read("joints/stress"))
                np.testing.assert_array_equal(here["applied"], view.read("resultants/applied"))
                np.testing.assert_array_equal(here["cuts"], view.read("cuts/resultants"))
        data = self.monopile.to_xarray()
        np.testing.assert_array_equal(np.isfinite(data["nodal_stress"]).all(("mode", "value", "stress")),
                                      [k in (3, 8) for k in range(1, 9)])
        np.testing.assert_array_equal(data["nodal_stress"].sel(increment=3), self.monopile.at(3).nodal_amplitude)
        self.assertEqual(data.sizes["plane"], 17)
        self.assertEqual(float(data["cuts"].sel(increment=6, resultant="lateral")[-2]),
                         float(self.monopile.history["cuts"][5, -2, 1]))

    @needs("xarray")
    def test_xarray_of_what_is_kept(self):
        """Increments whose fields are kept, and whose series are not"""
        keep = "KEEP", "    SERIES     EVERY    3", "  DISPLACE      ONLY    4    6", "    JOINTS      LAST"
        result = axijoint.open(f"{jobs.run(self.folder.name, 'keep', jobs.input_deck('monopile', *keep))}.h5")
        data = result.to_xarray()
        self.assertEqual(data["increment"].values.tolist(), result.history.known.tolist())
        for k in result.history.known:
            here = data.sel(increment=k)
            series, field = (k in numbers for numbers in (result.history.increment, result.history.increments_of("displacement")))
            for name, there in (("work", series), ("cuts", series), ("displacement", field), ("joint_state", k == 8)):
                self.assertEqual(bool(np.isfinite(here[name]).all()), there, f"{name} {k}")
        self.assertIn(4, set(result.history.known.tolist()) - set(result.history.increment.tolist()))
        np.testing.assert_array_equal(data["displacement"].sel(increment=4), result.at(4).displacement_amplitude)
        np.testing.assert_array_equal(data["work"].sel(increment=6), result.increments["work"][1])

    @needs("pyvista")
    def test_pyvista(self):
        for result in (self.monopile, self.monopile.at(2), self.chimney):
            grid = result.to_pyvista(sectors=60)
            sizes = grid.compute_cell_sizes()["Volume"]
            angle = 2*np.pi/60
            self.assertAlmostEqual(abs(sizes).sum()/volume(result.mesh)*angle/np.sin(angle), 1, 10)
            self.assertTrue((sizes[grid.celltypes == 12] > 0).all())
            self.assertEqual(set(grid["body"]), set(result.mesh.element_body))
            self.assertEqual("sigma_z" in grid.point_data, result.increment != 2)
            # Points of the tallest body's cells, against the interpolation
            chosen = np.unique(grid.extract_cells(grid["body"] == 1)["vtkOriginalPointIds"])[::97]
            x, y, z = grid.points[chosen].T
            r, theta = np.hypot(x, y), np.degrees(np.arctan2(y, x))
            found = result.displacement(r, z, theta, body=1, cartesian=True)
            np.testing.assert_allclose(grid["displacement"][chosen], found, atol=1e-5*abs(found).max())


if __name__ == "__main__":
    unittest.main()
