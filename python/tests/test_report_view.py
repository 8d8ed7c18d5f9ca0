"""The view of the page: what it holds is what the result holds; drawn only where plotly and Chromium are installed"""
import base64
import json
import pathlib
import re
import shutil
import tempfile
import unittest
import unittest.mock

import jobs
import numpy as np

from axijoint import report, units
from axijoint.report import browser, curves, view

try:
    import plotly
except ImportError:
    plotly = None
CHROMIUM = any(map(shutil.which, browser.PROGRAMS))


def reals(packed):
    """Reals from what the page holds."""
    return np.frombuffer(base64.b64decode(packed["data"]), "<i2")*packed["scale"]


def numbers(text):
    """Numbers of points from what the page holds."""
    return np.frombuffer(base64.b64decode(text), "<u4")


MOVED = """TITLE
A column whose head is moved aside towards 60 degrees
CONTROL
    1
INCREMENTS
0.5
1.0
MATERIALS
    1     1.0E3       0.0
BLOCKS
    1    1    8    2    4
0.0, 0.0, 1.0, 4.0
FACES
5, 1, 0.0, 0.0, 1.0, 0.0
6, 1, 0.0, 4.0, 1.0, 4.0
FIXEDFACES
    5  111
MOVEDFACES
6, 1, 0.05, 0.0, -0.05, 0.05, 0.0, -0.05, S, EVERY
6, 1, 0.0866025403784439, 0.0, -0.0866025403784439, , , , A, EVERY
POINTS
1, 0.0, 4.0, , head
"""
CUTS = "CUTS\n1, 1.0, 1\n2, 2.0, 1\n3, 3.0, 1\n"


class Views(unittest.TestCase):
    """The monopile with stresses of two increments; a chimney of two combinations and both families"""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        keep = {"monopile": ("KEEP", "  STRESSES      ONLY    3")}
        cls.jobs = {}
        for name in ("monopile", "chimney"):
            path = jobs.run(cls.folder.name, name, jobs.input_deck(name, *keep.get(name, ())))
            cls.jobs[name] = report.jobs_of(path)

    def check(self, job, found):
        """Points, amplitudes, triangles and joints of what the page holds."""
        result, mesh = job.result, job.result.mesh
        position = np.frombuffer(base64.b64decode(found["position"]), "<f4").reshape(-1, 2).astype(float)
        modes, length = len(found["harmonic"]), abs(mesh.coordinates).max()
        for row, increment in enumerate(found["increments"]):
            at = result.at(increment)
            u = reals(found["u"][row]).reshape(modes, -1, 3)
            for one in found["bodies"]:
                used = np.unique(numbers(one["cells"]))[::29]
                told = at.displacement(*position[used].T, 0.0, body=one["body"], outside="nan")
                self.assertTrue(np.isfinite(told).mean() > 0.9)  # some are outside by their rounding
                symmetric = np.array(found["family"]) == 1
                size = abs(at.displacement_amplitude).max()
                known = np.isfinite(told[:, 0])
                np.testing.assert_allclose(u[symmetric][:, used, :2].sum(0)[known], told[known, :2], atol=2e-4*size*modes)
        for one in found["bodies"]:
            corners = position[numbers(one["cells"]).reshape(-1, 3)]
            (a, b), (c, d) = np.moveaxis(corners[:, 1:] - corners[:, :1], (1, 2), (0, 1))
            area = (a*d - b*c)/2
            self.assertGreater(area.min(), -1e-7*length**2)
            yield one["body"], area.sum()

    def test_data_are_those_of_the_result(self):
        found, notes = view.data(self.jobs["monopile"][0])
        self.assertEqual((found["increments"], notes), (list(range(1, 9)), []))
        self.assertEqual([k for k, one in zip(found["increments"], found["s"]) if one], [3, 8])
        areas = dict(self.check(self.jobs["monopile"][0], found))
        self.assertAlmostEqual(areas[1], 0.08*25, 3)
        self.assertAlmostEqual(areas[2], 30*36 - 0.08*20, 1)
        joints, result = found["joints"], self.jobs["monopile"][0].result
        np.testing.assert_array_equal(np.round(reals(joints["values"][5][0])), result.at(6).read("joints/state").ravel())
        np.testing.assert_allclose(reals(joints["values"][5][3]), np.maximum(result.at(6).read("joints/jump")[..., 1].ravel(), 0),
                                   atol=1e-5)
        titles = [one["title"] for one in found["curves"]]
        self.assertEqual(titles, ["Load and displacement at θ = 0°", "Shear force of body 1 at θ = 0°", "Moment of body 1 at θ = 0°",
                                  "Axial force of body 1", "Deflection of body 1 at θ = 0°", "Work and energy"])
        # with the sign of the figure of the pile, which stands on the same page, and in words
        self.assertAlmostEqual(found["curves"][2]["lines"][0]["x"][5][-1], 100, 3)
        self.assertEqual([found["curves"][k]["x"] for k in (2, 3)], ["moment, leaning that way [MN m]", "axial force, tension positive [MN]"])
        for job in self.jobs["chimney"]:
            self.assertEqual(len(dict(self.check(job, view.data(job)[0]))), len(set(job.result.mesh.element_body)))

    def test_modes_of_all_increments(self):
        """A load that is taken back leaves its modes in the view of the increments before"""
        law, details = "    1     100.0     200.0     100.0       0.0      26.0\n", r"LAWDETAILS .*\n.*\n"
        text = re.sub(details, "", jobs.input_deck("monopile").replace(law, "1, 100.0, 200.0, 100.0, , , ELASTIC\n"))
        job, = report.jobs_of(jobs.run(self.folder.name, "unloaded", text))
        found, _ = view.data(job)
        self.assertEqual(found["harmonic"], [0, 1])
        dict(self.check(job, found))

    def test_curves_are_along_the_load(self):
        """A pile that is pushed towards 60 degrees: what it carries and how it moves there, as along 0 if it is pushed there"""
        plain = self.jobs["monopile"][0]
        turned, = report.jobs_of(jobs.run(self.folder.name, "turned", jobs.turned_monopile(60)))
        found, wanted = (curves.curves(job, range(1, 9)) for job in (turned, plain))
        self.assertEqual([one["title"].replace("60°", "0°") for one in found], [one["title"] for one in wanted])
        self.assertIn("Moment of body 1 at θ = 60°", [one["title"] for one in found])
        self.assertEqual((found[0]["x"], found[0]["y"]), ("u at θ = 60° [m]", "lateral force [MN]"))
        self.assertAlmostEqual(max(found[0]["lines"][0]["y"]), 5, 4)
        for one, other in zip(found, wanted):
            values, straight = (np.array(curve["lines"][0]["x"]) for curve in (one, other))
            np.testing.assert_allclose(values, straight, rtol=0, atol=0.01*abs(straight).max(), err_msg=one["title"])

    def test_curves_of_displacements_that_are_given(self):
        """Reactions balance one another: the direction is that of what cuts carry, or of the reactions of a face"""
        for name, cuts, titles in (("with_cuts", CUTS, ["Shear force", "Moment", "Deflection"]), ("without", "", [])):
            job, = report.jobs_of(jobs.run(self.folder.name, name, f"{MOVED}{cuts}END\n"))
            found = curves.curves(job, [1, 2])
            self.assertEqual([one["title"] for one in found[1:-1]], [f"{one} of body 1 at θ = 60°" for one in titles])
            self.assertEqual(found[0]["x"], "u at θ = 60°")
            np.testing.assert_allclose(found[0]["lines"][0]["x"], [0.05, 0.15], rtol=1e-6)

    def test_curves_across_the_load(self):
        """Loads that turn: profiles along the largest of them and across it"""
        cuts = np.zeros((2, 3, 6))
        cuts[0, :, 1], cuts[1, :, 4] = 1, 2
        history = {"applied": cuts[:, 0], "cuts": cuts, "cut_motion": cuts, "increment": np.array([1, 2])}
        result = unittest.mock.Mock(history=history, read={"cuts/z": np.arange(3.0), "cuts/body": np.zeros(3, int)}.get)
        job = unittest.mock.Mock(result=result, units=units.Units("", ""))
        found = {one["title"]: one["lines"][0]["x"] for one in curves._profiles(job, [0, 1])}
        self.assertEqual(found["Shear force at θ = 90°"], [[0]*3, [2]*3])
        self.assertEqual(found["Shear force at θ = 0°"], [[1]*3, [0]*3])

    def test_data_keep_within_their_size(self):
        job = self.jobs["monopile"][0]
        with unittest.mock.patch("axijoint.report.view.MOST_WHOLE", 0):
            whole, notes = view.data(job)
            self.assertEqual(notes, ["the section is shown by the corner nodes of its elements"])
            self.assertLess(whole["points"], 350)
            areas = dict(self.check(job, whole))
            self.assertAlmostEqual(areas[1], 0.08*25, 3)
            for largest in (20_000, 30_000, 60_000):
                found, notes = view.data(job, largest)
                self.assertEqual(found["increments"][-1], 8)
                self.assertLess(len(found["increments"]), 8)
                fields = [one for one in found["u"] + found["s"] if one]
                self.assertLessEqual(sum(len(one["data"]) for one in fields)*3/4, largest + 3)
                self.assertIn("of 8 increments are shown", notes[-2])

    @unittest.skipIf(plotly is None, "plotly is not installed: scripts/setup plot")
    def test_the_page_is_of_one_file(self):
        chimney = self.jobs["chimney"]
        text = report.page(chimney, figures=False, views=True)
        self.assertEqual(text.count("plotly.js v"), 1)
        blocks = re.findall(r'<script type="application/json" id="([^"]+)">(.*?)</script>', text)
        self.assertEqual(len(blocks), 2)
        for identifier, block in blocks:
            self.assertIn(f'data-view="{identifier}"', text)
            self.assertNotIn("<", block)
            json.loads(block)
        self.assertNotRegex(re.sub(r"<script.*?</script>", "", text, flags=re.S), r"https?:|url\(|@import")
        self.assertNotRegex(text, r"<script[^>]+src=")

    @unittest.skipIf(plotly is None or not CHROMIUM, "plotly or Chromium is not installed")
    def test_chromium_draws_it(self):
        page = pathlib.Path(self.folder.name)/"page.html"
        report.write(report.page(self.jobs["monopile"], figures=False, views=True), page)
        said, good = browser.check(page)
        self.assertTrue(good, said)
        self.assertEqual(said.count("1 of 1 views drawn, 0 other files asked for, not wider than the window"), 2, said)


if __name__ == "__main__":
    unittest.main()
