"""The page about a run: well-formed, of one file, true; its figures only where matplotlib is installed"""
import base64
import contextlib
import html.parser
import io
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest
import unittest.mock

import h5py
import numpy as np

import jobs

import axijoint
from axijoint import report
from axijoint.report import __main__ as command
from axijoint.report import budget, extremes, markup
import yielding as yielding_decks

try:
    from axijoint import plot
except ImportError:
    plot = None
try:
    import plotly
except ImportError:
    plotly = None

EMPTY = {"meta", "img", "br"}
# Figures that a page has, but as no pictures: to draw one takes half a second
NOT_DRAWN = unittest.mock.patch("axijoint.report.pictures.embedded", lambda figure, plot: ("data:image/png;base64,", 300, 200))
NASTY = '<script>alert("x")</script> &amp; "Größe" </title> 45° (MN, m, MPa)'
SORTS = ["all_fixed", "cases", "cuts", "gravity", "in_situ", "joint_cone_6", "joint_cylinders_elastic", "moved_face",
         "not_converged", "orthotropic_bending_8", "orthotropic_tension_4", "ring_loads", "sections", "springs",
         "supported_faces", "tension_mixed", "thermal_gradient", "torque", "unload_to_zero", "zero_load"]


WAVES = """TITLE
A ring under sin 36 theta
CONTROL
36
MATERIALS
1, 1000.0, 0.3
BLOCKS
1, 1, 8, 4, 2
1.0, 0.0, 2.0, 0.5
FACES
1, 1, 2.0, 0.0, 2.0, 0.5
2, 1, 1.0, 0.0, 1.0, 0.5
FIXEDFACES
2, 111
HARMONICS
36
PRESSURES
1, 36, 10.0, , A
END
"""
# A rigid disc that no tension holds, pressed by N = 100, then tilted by M = 50 towards 60 degrees: of a circle on springs
# 0.6480 of the area stays pressed
LIFTED = """TITLE
A disc that lifts (kN, m, kPa)
CONTROL
   12   97
MATERIALS
1, 1E8, 0.2
LAWS
1, 1E5, 1E5, 1E5, 0.0, 45.0
BLOCKS
1, 1, 8, 6, 2
0.0, 0.0, 1.0, 0.5
2, 1, 8, 6, 1
0.0, -0.2, 1.0, 0.0
FACES
1, 1, 0.0, 0.0, 1.0, 0.0
2, 2, 0.0, 0.0, 1.0, 0.0
3, 2, 0.0, -0.2, 1.0, -0.2
4, 1, 0.0, 0.5, 1.0, 0.5
INTERFACES
1, 1, 2, , base
FIXEDFACES
3, 111
CASE
1, Weight
RESULTANTS
4, AXIAL, -100.0
CASE
2, Wind
RESULTANTS
4, MOMENT, -20.0, 60.0
COMBINE
1, 1, 1.0, 2, 1.25
INCREMENTS
1.0, , , 1
2.5, , , 2
-0.5, , , 2
POINTS
1, 1.0, 0.0, 1, edge
END
"""


class Page(html.parser.HTMLParser):
    """What a page holds; elements must close in order, addresses stay inside it."""

    def __init__(self, text, views=False):
        super().__init__(convert_charrefs=True)
        self.views = views
        self.open, self.faults, self.images, self.identifiers, self.targets = [], [], [], [], []
        self.texts, self.tags = {}, []
        self.feed(text)
        self.close()
        self.faults += [f"{name} stays open" for name in self.open]
        self.faults += [f"no {target}" for target in self.targets if target not in self.identifiers]
        if len(set(self.identifiers)) < len(self.identifiers):
            self.faults.append("an identifier twice")

    def handle_starttag(self, name, attributes):
        found = dict(attributes)
        self.tags.append(name)
        if name not in EMPTY:
            self.open.append(name)
        if "id" in found:
            self.identifiers.append(found["id"])
        for key, value in attributes:
            if key.startswith("on") or value is None or key == "src" and not value.startswith("data:image/") \
                    or key == "href" and not value.startswith("#"):
                self.faults.append(f"<{name} {key}={value!r:.60}>")
        if name == "a":
            self.targets.append(found["href"][1:])
        if name == "img":
            self.images.append(found)
        if name in ("link", "iframe", "object", "base") or name == "script" and not self.views:
            self.faults.append(f"<{name}>")

    def handle_endtag(self, name):
        if not self.open or self.open.pop() != name:
            self.faults.append(f"</{name}> at {self.getpos()}")

    def handle_data(self, data):
        for name in set(self.open):
            self.texts[name] = self.texts.get(name, "") + data


class Reports(unittest.TestCase):
    """Pages of some runs"""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def page(self, name, figures=False):
        """A page about results, checked."""
        text = report.page(report.jobs_of(self.folder/name), figures)
        self.assertNotRegex(re.sub(r'"data:[^"]*"', "", text), r"https?:|url\(|@import")
        found = Page(text)
        self.assertEqual(found.faults, [])
        self.assertTrue(all(image["alt"].strip() for image in found.images))
        return found

    def mechanism(self, name, title):
        """Run a disc that is pushed more than its friction holds."""
        deck = (jobs.ROOT/"inputs/hard/sliding_disc.dat").read_text(encoding="utf-8")
        self.assertIn("0.99, , , 2", deck)
        deck = deck.replace("0.99, , , 2", "1.01, , , 2").replace("A pressed disc slides (m-MN)", title)
        return jobs.run(self.folder, name, deck, exit_code=4)

    def test_numbers_are_those_of_the_run(self):
        path = jobs.run(self.folder, "case3", jobs.input_deck("case3"))
        page, result = self.page("case3"), axijoint.open(f"{path}.h5")
        largest = max(abs(complex(*map(abs, row[:2]))) for row in result.nodal_displacement(180).tolist())
        self.assertIn(f"{largest:.6g} m at node 5, r = 0.5, z = -0.5, θ = 180°", page.texts["td"])
        summary = json.loads(pathlib.Path(f"{path}.json").read_text(encoding="utf-8"))
        self.assertIn(f"{summary['unknowns']} of all harmonics", page.texts["td"])
        states = summary["joint_states"]
        self.assertGreater(min(states["slip"], states["open"]), 0)
        self.assertIn(f"{states['slip']} slip, {states['open']} open", page.texts["td"])
        for message in summary["messages"]:
            self.assertIn(message, page.texts["li"])
        self.assertIn("Converged in 17 iterations", page.texts["div"])
        self.assertEqual(page.texts["pre"].strip(), result.deck.strip())

    def test_largest_values_are_those_round_the_circle(self):
        """Of a high harmonic, whose peaks lie between multiples of 5 degrees, of many, and of symmetric ones alone"""
        for name, text, digits in (("waves", WAVES, 12), ("monopile", jobs.turned_monopile(37), 3),
                                   ("first", jobs.input_deck("first"), 3)):
            result = axijoint.open(f"{jobs.run(self.folder, name, text)}.h5")
            found, fine = extremes.extremes(result), np.arange(0, 360, 0.5)
            self.assertAlmostEqual(found["length"][-1].value/result.history["largest_displacement"][-1], 1, digits)
            moved = np.array([result.nodal_displacement(theta) for theta in fine])
            stress = np.array([result.nodal_stress_values(theta) for theta in fine])
            for names, values in ((axijoint.DISPLACEMENTS, moved), (axijoint.STRESSES, stress)):
                for k, quantity in enumerate(names):
                    low, high = (peak.value for peak in found[quantity])
                    size, least, largest = abs(values[..., k]).max(), values[..., k].min(), values[..., k].max()
                    self.assertTrue(least - 1e-3*size <= low <= least + 1e-12*size, f"{name} {quantity}: {low}, {least}")
                    self.assertTrue(largest - 1e-12*size <= high <= largest + 1e-3*size, f"{name} {quantity}: {high}, {largest}")
            for quantity in axijoint.DISPLACEMENTS:  # at their places
                for peak in found[quantity]:
                    node = result.mesh.node_label.tolist().index(int(peak.where.split()[1]))
                    there = result.nodal_displacement(peak.theta)[node, axijoint.DISPLACEMENTS.index(quantity)]
                    self.assertAlmostEqual(there, peak.value, delta=1e-12*abs(moved).max())

    def test_a_mechanism_is_said_first_and_a_title_cannot_break_the_page(self):
        self.mechanism("disc", NASTY)
        page = self.page("disc")
        self.assertEqual(page.texts["h1"], NASTY)
        self.assertEqual(page.texts["title"], f"NOT CONVERGED: MECHANISM: {NASTY}")
        self.assertIn("no equilibrium was found beyond the load factor", page.texts["div"])
        self.assertEqual(page.texts["h2"].count("last equilibrium before a mechanism"), page.tags.count("h2") - 1)

    def test_not_converged(self):
        deck = jobs.input_deck("case3").replace("0.03  500", "0.03    3")
        jobs.run(self.folder, "case3", deck, exit_code=3)
        page = self.page("case3")
        self.assertTrue(page.texts["title"].startswith("NOT CONVERGED: "))
        self.assertIn("Do not use these numbers", page.texts["div"])
        self.assertNotIn("Error budget", page.texts["main"])

    def test_which_state_is_shown(self):
        """Of a history: after which increment, with what of each load case, and what came out of the others"""
        jobs.run(self.folder, "lifted", LIFTED)
        page = self.page("lifted")
        for words in ("state shown", "end of increment 3 of 3: load case 1 (Weight) times 1, load case 2 (Wind) times 2.5",
                      "Results by increment", "Displacements of points", "u at 60° [m]"):
            self.assertIn(words, page.texts["main"])
        job, = report.jobs_of(self.folder/"lifted")
        self.assertEqual(job.case_names, ["Weight", "Wind"])
        self.assertEqual(job.case_factors().tolist(), [1, 2.5])
        self.mechanism("disc", "A disc slides (m, MN)")
        self.assertIn("last equilibrium, in increment 2 of 2: load case 1", self.page("disc").texts["td"])
        jobs.run(self.folder, "first", jobs.input_deck("first"))
        self.assertNotIn("state shown", self.page("first").texts["th"])

    def test_increments_of_displacements(self):
        """Increments that give displacements are told, and load cases without a name have none"""
        deck = yielding_decks.steered(yielding_decks.cylinder((0.3, 0.4)))
        jobs.run(self.folder, "steered", deck)
        page = self.page("steered")
        self.assertIn("displacement", page.texts["td"])
        self.assertIn("end of increment 2 of 2: load case 1 times 0.7", page.texts["td"])

    def test_what_interfaces_carry(self):
        """Forces, moments and the share of the area that is pressed, of a disc that lifts"""
        jobs.run(self.folder, "lifted", LIFTED)
        job, = report.jobs_of(self.folder/"lifted")
        found = Page(markup.joined(report.tables.equilibrium(job)))
        self.assertIn("Interfaces", found.texts["caption"])
        self.assertIn("base", found.texts["th"])
        points = axijoint.joint_points.JointPoints(job.result)
        self.assertAlmostEqual(points.areas().sum(), np.pi, 12)
        stick, slip, lost = points.shares([*range(6)])
        self.assertAlmostEqual(stick + slip + lost, 1, 12)
        self.assertAlmostEqual(stick + slip, 0.648, delta=0.004)
        force = job.result.history.interface("base")[-1]
        for value, wanted in zip(force, (100, 0, 25, 0, 0, 50*np.sin(np.pi/3))):
            self.assertAlmostEqual(value, wanted, delta=1e-4)
            self.assertIn(markup.number(value), found.texts["td"])
        self.assertEqual(found.texts["p"].count("Moments are positive where they lift the side θ = 0"), 2)

    def test_infinite_stresses_and_edges_are_told(self):
        jobs.run(self.folder, "first", jobs.input_deck("first"))
        page = self.page("first")
        self.assertIn("Infinite stresses", page.texts["caption"])
        for words in ("at 2 nodes: see", "by a line through the points before it"):
            self.assertIn(words, page.texts["td"])

    def test_bodies_that_yield(self):
        """Their strength stands with the materials, and it is they that cannot carry the load"""
        jobs.run(self.folder, "beyond", yielding_decks.pile(2, 0, (4.0, 2.0)), exit_code=4)
        page = self.page("beyond")
        self.assertIn("Materials that yield", page.texts["caption"])
        self.assertNotIn("The joints cannot carry", page.texts["div"])
        self.assertRegex(page.texts["div"], "(The bodies|Bodies and joints) cannot carry the load")

    def test_combinations(self):
        jobs.run(self.folder, "chimney", jobs.input_deck("chimney"))
        page = self.page("chimney")
        self.assertEqual(page.tags.count("pre"), 1)
        self.assertEqual(page.tags.count("article"), 2)
        for words in ("All 2 runs converged", "Combination 1", "Combination 2", "Section 1, θ = 180°"):
            self.assertIn(words, page.texts["main"])
        self.assertEqual(page.texts["nav"].count("Sections"), 2)
        cards = jobs.input_deck("chimney").replace("    1    1       1.0\n", "")
        jobs.run(self.folder, "chimney", cards)
        self.assertEqual([job.name for job in report.jobs_of(self.folder/"chimney")], ["chimney"])
        (self.folder/"chimney.h5").replace(self.folder/"chimney.2.h5")
        (self.folder/"chimney.json").unlink()
        self.assertIn("The deck of chimney.1 is not that of chimney.2", self.page("chimney").texts["div"])

    def test_an_error_and_files_of_two_runs(self):
        jobs.run(self.folder, "wrong", "TITLE\nNothing & <nobody>\nCONTROL\n    x\nEND\n", exit_code=2)
        page = self.page("wrong")
        self.assertIn("ERROR: NO RESULTS", page.texts["div"])
        self.assertIn("    4 |     x\n      | ^^^^^\n", page.texts["pre"])
        path = jobs.run(self.folder, "first", jobs.input_deck("first"))
        file = pathlib.Path(f"{path}.json")
        file.write_text(file.read_text(encoding="utf-8").replace('"run": "', '"run": "1'), encoding="utf-8")
        page = self.page("first")
        self.assertIn("are of different runs", page.texts["div"])
        self.assertNotIn("peak memory", page.texts["th"])
        file.unlink()
        self.assertIn("first.json is missing", self.page("first").texts["div"])

    def test_error_budget(self):
        path = jobs.run(self.folder, "case3", jobs.input_deck("case3"))
        summary = json.loads(pathlib.Path(f"{path}.json").read_text(encoding="utf-8"))
        page = self.page("case3")
        for source, share in summary["errors"].items():
            if source != "in_words":
                self.assertIn(source, page.texts["th"])
                for value in share.values():
                    self.assertIn(markup.number(value), page.texts["td"])
        said = summary["errors"]["in_words"]
        self.assertIn(f"In words: {said}", page.texts["p"].replace("\u00a0", " "))
        self.assertIn(said, page.texts["td"])

    def test_error_budget_of_other_sources(self):
        job = unittest.mock.Mock(verdict="converged", summary={"errors": {
            "mesh": {"displacement": 0.0123}, "planes": {"displacement": None, "note": "a < b"}, "largest": "mesh"}})
        page = Page(budget.errors(job))
        self.assertEqual(page.faults, [])
        for words in ("0.0123", "a < b", "mesh"):
            self.assertIn(words, page.texts["table"])
        job.summary["errors"] = None
        self.assertFalse(budget.known(job))

    def test_pages_of_decks_of_all_sorts(self):
        decks = [jobs.ROOT/f"test/decks/good/{name}.dat" for name in SORTS]
        done = subprocess.run([os.environ["AXIJOINT"], "run", *decks, "-o", self.folder], capture_output=True,
                              check=False)
        self.assertIn(done.returncode, (0, 3, 4))
        for deck in decks:
            with self.subTest(deck.stem):
                self.assertIn("Resultants", self.page(deck.stem).texts["caption"])

    def test_a_deck_that_is_not_utf_8(self):
        """Letters of Latin-1 in a comment, and what is an end of a line there, are shown in place"""
        deck = jobs.input_deck("first", "! Faserbeton f\u00fcr Pf\u00e4hle \u0085 B25")
        path = jobs.run(self.folder, "first", deck.encode("latin-1"))
        with h5py.File(f"{path}.h5", "r+") as file:  # as earlier programs wrote it
            del file["deck"]
            file["deck"] = np.bytes_(deck.encode("latin-1"))
        self.assertEqual(axijoint.open(f"{path}.h5").deck.strip(), deck.strip())
        with NOT_DRAWN:
            page = self.page("first", figures=plot is not None)
        self.assertIn("f\u00fcr Pf\u00e4hle", page.texts["pre"])
        self.assertEqual(page.texts["pre"].count("\n"), deck.rstrip("\n").count("\n"))

    def test_numbers(self):
        for value, words in ((-0.0, "0"), (1.5e-7, "1.5E-7"), (float("nan"), "–"), (None, "–"), (12, "12"),
                             (-2.5e12, "-2.5E12")):
            self.assertEqual(markup.number(value), words)
        self.assertEqual(markup.escaped("a\x00\x1b\ud800<'\""), "a\ufffd\ufffd\ufffd&lt;&#x27;&quot;")

    def test_command(self):
        path = jobs.run(self.folder, "first", jobs.input_deck("first"))
        with contextlib.redirect_stdout(io.StringIO()) as said:
            self.assertEqual(command.main([f"{path}.h5", "--no-figures", "--no-view"]), 0)
            self.assertEqual(command.main([str(path), "--no-figures", "--no-view", "-o", f"{path}_2.html"]), 0)
            folder = pathlib.Path(self.folder)/"pages"
            folder.mkdir()
            self.assertEqual(command.main([f"{path}.h5", "--no-figures", "--no-view", "-o", str(folder)]), 0)
        self.assertEqual(said.getvalue(), f"{path}.html\n{path}_2.html\n{folder/'first.html'}\n")
        self.assertEqual(*(pathlib.Path(f"{path}{end}.html").read_bytes() for end in ("", "_2")))
        for words, cause in (([f"{path}.dat"], "scripts/run"), ([f"{path}3"], "there is no"),
                             ([str(path)]*2, "-o FILE"), ([f"{path}.lis.h5"], "there is no file")):
            with contextlib.redirect_stderr(io.StringIO()) as said:
                self.assertEqual(command.main(words), 2)
            self.assertIn(cause, said.getvalue())

    @unittest.skipIf(plot is None, "matplotlib is not installed")
    def test_figures(self):
        self.mechanism("disc", NASTY)
        page, result = self.page("disc", figures=True), axijoint.open(self.folder/"disc.h5")
        self.assertEqual(len(page.images), len(list(plot.figures(result))))
        for image in page.images:
            kind, data = re.fullmatch(r"data:image/(svg\+xml|png);base64,(.*)", image["src"]).groups()
            begin = base64.b64decode(data, validate=True)[:200]
            self.assertTrue(begin.startswith(b"\x89PNG") if kind == "png" else b"<?xml" in begin)
            self.assertTrue(int(image["width"]) > 0 and int(image["height"]) > 0)
            self.assertTrue(image["alt"].startswith("LAST EQUILIBRIUM BEFORE A MECHANISM: "))

    @unittest.skipIf(plot is None, "matplotlib is not installed")
    def test_figures_of_a_pile_are_along_the_load(self):
        jobs.run(self.folder, "turned", jobs.turned_monopile(60))
        titles = []
        with unittest.mock.patch("axijoint.report.pictures.embedded", lambda figure, plot: (
                titles.append(figure.get_suptitle()) or "data:image/png;base64,", 300, 200)):
            self.page("turned", figures=True)
        for words in ("Load and displacement at", "p$–$y$ curves", "on its cuts at", "positive towards"):
            title, = (one for one in titles if words in one)
            self.assertIn(r"$\theta$ = 60°", title)
        for name in ("deformed", "contours_sigma_z", "yielding"):
            self.assertIn("lanes θ = 60° (right) and θ = 240° (left)",
                          " ".join(report.pictures.describe(report.jobs_of(self.folder/"turned")[0], name)))

    @unittest.skipIf(plot is None, "matplotlib is not installed")
    def test_figures_of_bodies_that_yield(self):
        jobs.run(self.folder, "pile_clay", jobs.input_deck("pile_clay"))
        jobs.run(self.folder, "beyond", yielding_decks.pile(2, 0, (4.0, 2.0)), exit_code=4)
        with NOT_DRAWN:  # what they are is said beside them
            said = [image["alt"] for name in ("pile_clay", "beyond") for image in self.page(name, figures=True).images]
        for words in ("Yielding. Planes .* plastic strain", "Yield margin. The share of the strength", "Dissipation. Planes .* work",
                      "Mechanism. Planes .* what the step moved"):
            self.assertTrue(any(re.search(words, one) for one in said), f"{words}: {said}")
        self.assertEqual([one for one in said if "Interface unrolled" in one], [])

    @unittest.skipIf(plot is None, "matplotlib is not installed")
    def test_large_figures_become_pixels(self):
        jobs.run(self.folder, "first", jobs.input_deck("first"))
        figures = plot.figures
        with unittest.mock.patch("axijoint.report.pictures.LARGEST_SVG", 0), \
                unittest.mock.patch.object(plot, "figures", lambda *of: figures(*of) if of[1][0] in ("mesh", "spectrum") else ()):
            page = self.page("first", figures=True)
        self.assertTrue(all(image["src"].startswith("data:image/png;") for image in page.images))
        self.assertTrue(all(200 < int(image["width"]) < 900 for image in page.images))


if __name__ == "__main__":
    unittest.main()
