"""Every figure is written; only where matplotlib is installed"""
import contextlib
import io
import os
import pathlib
import tempfile
import unittest
import xml.etree.ElementTree

import jobs

try:
    from axijoint import plot
    from axijoint.plot import __main__ as command
    from axijoint.plot import pieces
except ImportError:
    plot = None

import axijoint

CONTOURS = {f"contours_{name}" for name in ("displacement", "sigma_r", "sigma_z", "sigma_theta", "tau_rz")}
LINES = {"line_across", "line_along"}
ALWAYS = {"mesh", "deformed", "convergence", "spectrum"} | CONTOURS
WANTED = {"case3": ALWAYS | LINES | {"joints_1", "joints_2"}, "first": ALWAYS | LINES | {"joints"},
          "chimney.2": ALWAYS | {"section_1", "joints"}}


@unittest.skipIf(plot is None, "matplotlib is not installed")
class Figures(unittest.TestCase):
    """Figures of some decks of inputs"""

    def results(self, folder, name):
        jobs.run(folder, name.split(".")[0], jobs.input_deck(name.split(".")[0]))
        return pathlib.Path(folder)/f"{name}.h5"

    def check(self, name):
        with tempfile.TemporaryDirectory() as folder:
            result = axijoint.open(self.results(folder, name))
            found = {}
            for figure_name, figure in plot.figures(result):
                found[figure_name] = plot.save(figure, pathlib.Path(folder)/figure_name)
            self.assertEqual(found.keys(), WANTED[name])
            for png, svg in found.values():
                self.assertEqual(png.read_bytes()[:4], b"\x89PNG")
                self.assertTrue(xml.etree.ElementTree.parse(svg).getroot().tag.endswith("svg"))

    def test_case3(self):
        self.check("case3")

    def test_chimney(self):
        self.check("chimney.2")

    def test_first(self):
        self.check("first")

    def test_a_linear_job_without_joints(self):
        with tempfile.TemporaryDirectory() as folder:
            result = axijoint.open(self.results(folder, "continuum"))
            self.assertEqual(list(plot.figures(result, ["joints", "convergence"])), [])

    def test_command(self):
        with tempfile.TemporaryDirectory() as folder:
            path = self.results(folder, "first")
            with contextlib.redirect_stdout(io.StringIO()):
                self.assertEqual(command.main([str(path), "mesh", "-o", f"{folder}/out", "spectrum"]), 0)
            self.assertEqual(sorted(os.listdir(f"{folder}/out")),
                             [f"first_{kind}.{ending}" for kind in ("mesh", "spectrum")
                              for ending in ("png", "svg")])
            with contextlib.redirect_stderr(io.StringIO()) as said:
                self.assertEqual(command.main([str(path), "nothing"]), 2)
            self.assertIn("nothing is neither a file nor a kind of figure", said.getvalue())

    def test_triangles_cover_the_body(self):
        with tempfile.TemporaryDirectory() as folder:
            mesh = axijoint.open(self.results(folder, "first")).mesh
            points, values, corners = pieces.triangles(mesh, mesh.coordinates, mesh.element_nodes)
            self.assertLess(abs(values - points).max(), 1e-12)
            (r1, z1), (r2, z2), (r3, z3) = points[corners].transpose(1, 2, 0)
            area = ((r2 - r1)*(z3 - z1) - (r3 - r1)*(z2 - z1))/2
            self.assertTrue((area > 0).all())
            self.assertAlmostEqual(area.sum(), 0.5*1.5 + 1.5*1.0, 12)


if __name__ == "__main__":
    unittest.main()
