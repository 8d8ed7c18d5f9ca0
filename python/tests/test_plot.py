"""Every figure is written; only where matplotlib is installed"""
import contextlib
import io
import json
import os
import pathlib
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree

import jobs
import numpy as np

try:
    from axijoint import plot
    from axijoint.plot import __main__ as command
    from axijoint.plot import curves, fields, pieces, style, yielding
    from overlaps import overlaps
except ImportError:
    plot = None

import axijoint
import yielding as yielding_decks

CONTOURS = {f"contours_{name}" for name in ("displacement", "sigma_r", "sigma_z", "sigma_theta", "tau_rz")}
LINES = {"line_across", "line_along"}
ALWAYS = {"mesh", "deformed", "convergence", "spectrum"} | CONTOURS
WANTED = {"case3": ALWAYS | LINES | {"joints_1", "joints_2", "pressure_1", "pressure_2"},
          "first": ALWAYS | LINES | {"joints", "pressure"},
          "chimney.2": ALWAYS | {"section_1", "joints", "pressure"}}
TOWER = """TITLE
A tower
CONTROL
1
MATERIALS
1, 2.1E8, 0.3
BLOCKS
1, 1, 8, 1, 45
1.985, 0.0, 2.015, 90.0
FACES
1, 1, 1.985, 0.0, 2.015, 0.0
2, 1, 1.985, 90.0, 2.015, 90.0
FIXEDFACES
1, 111
RESULTANTS
2, LATERAL, 1.0
END
"""
RINGS = """TITLE
Two rings with a gap between them
CONTROL
1
MATERIALS
1, 2.1E8, 0.3
BLOCKS
1, 1, 8, 2, 2
1.0, 0.0, 1.4, 1.0
2, 1, 8, 2, 2
1.8, 0.0, 2.0, 1.0
FACES
1, 1, 1.0, 0.0, 1.4, 0.0
2, 2, 1.8, 0.0, 2.0, 0.0
3, 1, 1.0, 1.0, 1.4, 1.0
FIXEDFACES
1, 111
2, 111
RESULTANTS
3, LATERAL, 1.0
END
"""
# Of a pile, and the tables with them
OF_PILE = {"points", "energy", "pile", "py", "tz", "pisa"}
INTERFACES = {f"{kind}_{name}" for kind in ("joints", "pressure") for name in ("shaft", "plug", "toe")}
TABLES = {"points", "increments", "pile", "pisa_shaft", "pisa_base", "pressure"}


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
                self.assertEqual(overlaps(figure), [], figure_name)
                found[figure_name] = plot.save(figure, pathlib.Path(folder)/figure_name)
            self.assertEqual(found.keys(), WANTED[name])
            for png, svg in found.values():
                self.assertEqual(png.read_bytes()[:4], b"\x89PNG")
                self.assertTrue(xml.etree.ElementTree.parse(svg).getroot().tag.endswith("svg"))

    def test_case3(self):
        self.check("case3")

    def test_chimney(self):
        self.check("chimney.2")

    def test_what_dissipates_and_where_there_is_a_profile(self):
        """Plastic strain is no slip; a profile needs several cuts, not several increments"""
        with tempfile.TemporaryDirectory() as folder:
            jobs.run(folder, "beyond", yielding_decks.pile(2, 0, (1.0, 1.0)))
            jobs.run(folder, "first", jobs.input_deck("first", "CUTS", "1, -0.25, 1"))
            jobs.run(folder, "cuts", jobs.input_deck("first", "CUTS", "1, -0.4, 1, 0.9, 5", "INCREMENTS", "0.5", "0.5"))
            beyond, first, cuts = (axijoint.open(f"{folder}/{name}.h5") for name in ("beyond", "first", "cuts"))
            for result, words in ((beyond, "dissipated by plastic strain"), (cuts, "dissipated by slip")):
                (_, figure), = plot.figures(result, ["energy"])
                self.assertIn(words, [line.get_label() for line in figure.axes[0].lines])
            tells = plot.KINDS["pile"].tells
            self.assertEqual([tells(beyond), tells(first), tells(cuts)], [False, False, True])
            jobs.run(folder, "one", jobs.input_deck("first", "CUTS", "1, -0.4, 1, 0.9, 5"))
            self.assertTrue(tells(axijoint.open(f"{folder}/one.h5")))
            (_, figure), = plot.figures(cuts, ["mesh"])
            words = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
            self.assertIn("resultants of the loads:\n(moments about the origin)", words)

    def test_a_tower(self):
        """Far taller than wide: names of planes, and ticks, keep apart"""
        with tempfile.TemporaryDirectory() as folder:
            jobs.run(folder, "tower", TOWER)
            for name, figure in plot.figures(axijoint.open(pathlib.Path(folder)/"tower.h5"), ["mesh", "deformed"]):
                self.assertEqual(overlaps(figure), [], name)

    def test_lines_through_hollows(self):
        """No line is drawn where there is nothing; points of a section that goes on outside are where the deck has them"""
        with tempfile.TemporaryDirectory() as folder:
            jobs.run(folder, "rings", RINGS)
            self.assertEqual([name for name, _ in plot.figures(axijoint.open(f"{folder}/rings.h5"), ["sections"])], ["line_across"])
            deck = jobs.input_deck("first", "SECTIONS", "1, 0.0, 0.5, 4.0, 0.5, 41, 0.0")
            result = axijoint.open(f"{jobs.run(folder, 'first', deck)}.h5")
            turned, = curves.sections(result, (90.0,)).values()
            np.testing.assert_allclose(turned.position, result.section(1).position, atol=1e-12)

    def test_bodies_that_yield(self):
        """Plastic zones where the pile presses; planes are found at all angles, mirrored beyond 180 degrees"""
        with tempfile.TemporaryDirectory() as folder:
            result = axijoint.open(self.results(folder, "pile_clay"))
            found = dict(plot.figures(result, ["yielding"]))
            self.assertEqual(found.keys(), {"yielding", "yielding_unrolled", "dissipation"})
            for name, figure in found.items():
                self.assertEqual(overlaps(figure), [], name)
            angles = [float(angle) for angle in result.read("yield/planes")*180/3.141592653589793]
            for k, angle in enumerate(angles):
                for same in (angle, angle + 1, -angle, 360 - angle, 360 + angle):
                    self.assertEqual(yielding.plane_at(result, same), k, same)
            linear = axijoint.open(self.results(folder, "continuum"))
            self.assertEqual(list(plot.figures(linear, ["yielding"])), [])

    def test_a_mechanism(self):
        """A load beyond the limit: what moves is drawn"""
        with tempfile.TemporaryDirectory() as folder:
            jobs.run(folder, "beyond", yielding_decks.pile(2, 0, (4.0, 2.0)), exit_code=4)
            result = axijoint.open(pathlib.Path(folder)/"beyond.h5")
            found = dict(plot.figures(result, ["yielding"]))
            self.assertIn("mechanism", found)
            self.assertEqual(overlaps(found["mechanism"]), [])
            dissipated = result.read("yield/dissipated")
            self.assertAlmostEqual(self.dissipation(result), dissipated[-1] - dissipated[dissipated < dissipated[-1]].max(initial=0.0),
                                   delta=1e-10*dissipated[-1])

    def dissipation(self, result):
        """Integral of the work dissipated per volume"""
        return (result.read("yield/dissipation")*result.read("yield/point_weight")).sum(1) @ result.read("yield/plane_weight")

    def test_dissipation(self):
        """A thick cylinder of TRESCA at its collapse, displacements given: nothing but plastic flow u = C/r, so that the
        work per volume of an increment is strength times C/r^2, and in all what is told of the increment"""
        with tempfile.TemporaryDirectory() as folder:
            jobs.run(folder, "collapse", yielding_decks.steered(yielding_decks.cylinder((1.0, 0.2, 0.3, 0.4, 8.0, 8.0), 16)))
            result = axijoint.open(pathlib.Path(folder)/"collapse.h5")
            dissipated, density = result.read("yield/dissipated"), result.read("yield/dissipation")
            self.assertAlmostEqual(self.dissipation(result)/(dissipated[-1] - dissipated[-2]), 1.0, delta=1e-10)
            radius = result.read("stress/position")[:, 0]
            moved = yielding_decks.INSIDE*np.diff(result.read("history/largest_displacement"))[-1]
            exact = yielding_decks.YIELD_STRESS*moved/radius**2
            self.assertLess(abs(density/exact - 1.0).max(), 5e-3)

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
            for place, reason in ((str(path), "File exists"), (f"{path}/out", "Not a directory")):
                with contextlib.redirect_stderr(io.StringIO()) as said:
                    self.assertEqual(command.main([str(path), "mesh", "-o", place]), 2)
                self.assertEqual(said.getvalue(), f"plot: -o {place}: no directory can be made there: {reason}\n")

    def test_studies(self):
        tables = {"grid": {"LAWS 1 PHI": "0:30:10", "RESULTANTS 1 VALUE": "0.2;0.4", "LAWS 1 C": "0;0.1"},
                  "words": {"LAWS 1 kind of law": [None, "ELASTIC", None], "LAWS 1 PHI": [10, 20, 30]},
                  "samples": {"SAMPLES": 20, "LAWS 1 PHI": "UNIFORM 10 30", "LAWS 1 C": "UNIFORM 0 0.1"}}
        drawn = {"grid": {"curves", "map"}, "words": {"curves"}, "samples": {"curves", "map", "histogram"}}
        with tempfile.TemporaryDirectory() as folder:
            for name, table in tables.items():
                study = axijoint.study(jobs.ROOT/"inputs/case3_balanced.dat", table, folder=folder, name=name,
                                       threads=1)
                found = set()
                for figure_name, figure in plot.figures(study):
                    self.assertEqual(overlaps(figure), [], f"{name} {figure_name}")
                    found.add(figure_name)
                self.assertEqual(found, drawn[name])
            grid = axijoint.open_study(f"{folder}/grid.study.h5")
            self.heights_of_curves(grid)
            self.means_of_maps(grid, axijoint.open_study(f"{folder}/samples.study.h5"))
            self.command_of_studies(folder)

    def test_an_envelope(self):
        """A block whose base slides: factors in the figure are those of the file"""
        deck = (jobs.ROOT/"inputs/block.dat").read_text(encoding="utf-8").replace("    8   33\n", "    2    9\n")
        with tempfile.TemporaryDirectory() as folder:
            path = f"{folder}/block.dat"
            with open(path, "w", encoding="utf-8") as file:
                file.write(deck)
            subprocess.run([os.environ["AXIJOINT"], "envelope", path, "--cases", "2,4+", "--directions", "3",
                            "--tolerance", "0.1", "-o", folder, "--quiet"], check=False, stdout=subprocess.DEVNULL)
            path = f"{folder}/block.envelope.h5"
            envelope = axijoint.open_envelope(path)
            (name, figure), = plot.figures(envelope)
            self.assertEqual((name, overlaps(figure)), ("envelope", []))
            points = figure.axes[0].get_lines()[1].get_xydata()
            np.testing.assert_array_equal(points, envelope.factors[envelope.exit_codes == 4])
            self.assertGreaterEqual(len(points), 2)
            with contextlib.redirect_stdout(io.StringIO()):
                self.assertEqual(command.main([path, "-o", f"{folder}/out"]), 0)
            self.assertEqual(len(os.listdir(f"{folder}/out")), 2)
            with self.assertRaisesRegex(ValueError, "is no file of an envelope"):
                axijoint.open_envelope(self.results(folder, "first"))

    def heights_of_curves(self, study):
        """Each curve has the values of its rows"""
        options = plot.Options(quantities=["work"], against=["LAWS 1 phi"])
        (_, figure), = plot.figures(study, ["curves"], options)
        found = [line.get_ydata() for line in figure.axes[0].get_lines()]
        rows = study.rows
        wanted = [rows["work"][(rows["LAWS 1 C"] == c) & (rows["RESULTANTS 1 VALUE"] == force)]
                  for force in (0.2, 0.4) for c in (0, 0.1)]
        self.assertEqual(len(found), 4)
        for one, other in zip(found, wanted):
            np.testing.assert_array_equal(one, other)
        options = plot.Options(quantities=["work"], against=["LAWS 1 PHI", "LAWS 1 C"])
        (_, figure), = plot.figures(study, ["map"], options)
        cells = figure.axes[0].collections[0].get_array()
        alike = (rows["LAWS 1 C"] == 0.1) & (rows["LAWS 1 PHI"] == 20)
        self.assertAlmostEqual(cells[1, 2], np.mean(rows["work"][alike]), 15)

    def means_of_maps(self, grid, samples):
        """A map says over what it takes the mean, also under a title of one's own; nothing where it takes none"""
        for study, said in ((grid, "mean over LAWS 1 C"), (samples, "")):
            for title in (None, "A title"):
                (_, figure), = plot.figures(study, ["map"], plot.Options(
                    against=[name for name in ("LAWS 1 PHI", "RESULTANTS 1 VALUE", "LAWS 1 C") if name in study.columns][:2],
                    title=title))
                self.assertEqual(figure.get_supxlabel(), said)

    def command_of_studies(self, folder):
        """Files of studies on the command line"""
        path = f"{folder}/grid.study.h5"
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(command.main([path, "map", "--quantity", "work,n_open", "-o", f"{folder}/out"]), 0)
        self.assertEqual(sorted(os.listdir(f"{folder}/out")), ["grid.study_map.png", "grid.study_map.svg"])
        result = self.results(folder, "first")
        for words, said in (([path, "mesh"], "has no figure of kind mesh; it has curves, map, histogram"),
                            ([path, str(result)], "commands of their own"),
                            ([str(result), "map"], "has no figure of kind map"),
                            ([path, "--body", "1"], "no kind of curves, map, histogram heeds --body"),
                            ([str(result), "--against", "LAWS 1 PHI"], "heeds --against; those that do: none"),
                            ([path, "--quantity", "wrok"], "there is no quantity 'wrok'; there are increment"),
                            ([path, "--against", "LAWS 1 K"], "there are LAWS 1 PHI, RESULTANTS 1 VALUE, LAWS 1 C")):
            with contextlib.redirect_stderr(io.StringIO()) as told:
                self.assertEqual(command.main(words), 2, words)
            self.assertIn(said, told.getvalue())

    def test_triangles_cover_the_body(self):
        with tempfile.TemporaryDirectory() as folder:
            mesh = axijoint.open(self.results(folder, "first")).mesh
            points, values, corners = pieces.triangles(mesh, mesh.coordinates, mesh.element_nodes)
            self.assertLess(abs(values - points).max(), 1e-12)
            (r1, z1), (r2, z2), (r3, z3) = points[corners].transpose(1, 2, 0)
            area = ((r2 - r1)*(z3 - z1) - (r3 - r1)*(z2 - z1))/2
            self.assertTrue((area > 0).all())
            self.assertAlmostEqual(area.sum(), 0.5*1.5 + 1.5*1.0, 12)


@unittest.skipIf(plot is None, "matplotlib is not installed")
class Monopile(unittest.TestCase):
    """Figures of a history, and options"""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.path = f"{jobs.run(cls.folder.name, 'monopile', jobs.input_deck('monopile'))}.h5"
        cls.result = axijoint.open(cls.path)

    def figures(self, *kinds, **options):
        """Figures by name; each has no overlapping texts."""
        found = {}
        for name, figure in plot.figures(self.result, kinds, plot.Options(**options)):
            self.assertEqual(overlaps(figure), [], name)
            found[name] = figure
        return found

    def run_command(self, *words):
        with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as said:
            code = command.main([self.path, *words])
        return code, out.getvalue(), said.getvalue()

    def test_kinds_of_a_history(self):
        found = self.figures("points", "energy", "pile", "py", "tz", "pisa", "joints", "pressure")
        self.assertEqual(found.keys(), OF_PILE | INTERFACES)
        self.assertEqual({name for name, _ in plot.tables(self.result)}, TABLES)
        self.assertIn("shaft (law 1), from face 2 of body 1 to face 3 of body 2",
                      found["joints_shaft"].get_suptitle())
        self.assertIn("[MN/m]", found["py"].axes[0].get_ylabel())

    def test_curves_are_those_of_the_table(self):
        soil = axijoint.soil_reactions(self.result)
        (figure,) = self.figures("pisa", depths=(-3.4, -19)).values()
        for axes, x, y in zip(figure.axes[:2], (soil.v, soil.psi), (soil.p, soil.m)):
            for depth, line in zip((-3.4, -19), (one for one in axes.lines if len(one.get_xdata()) > 2)):
                segment = abs(soil.z - depth).argmin()
                np.testing.assert_array_equal(line.get_xdata()[1:], x[:, segment])
                np.testing.assert_array_equal(line.get_ydata()[1:], y[:, segment])

    def test_how_far_cuts_may_be_off(self):
        """The errors of resultants on cuts are those of the summary; of earlier increments they are not known"""
        (_, table), = plot.tables(self.result, ["pile"], plot.Options())
        last = table.where(table["increment"] == table["increment"].max())
        told = {cut["z"]: cut for cut in json.loads(pathlib.Path(self.path).with_suffix(".json").read_text())["cut_errors"]}
        for z, moment, axial in zip(last["z"], last["M_error"], last["N_error"]):
            self.assertAlmostEqual(moment, told[z]["moment_error"], delta=1e-9)
            self.assertAlmostEqual(axial, told[z]["axial_force_error"], delta=1e-9)
        self.assertTrue(np.isnan(table.where(table["increment"] == 1)["M_error"]).all())

    def test_points_along_the_load(self):
        """Force, moment and displacement of POINTS turn with the angle"""
        path = jobs.run(self.folder.name, "turned", jobs.turned_monopile(60))
        turned = axijoint.open(f"{path}.h5")
        (_, figure), = plot.figures(turned, ["points"], plot.Options(angles=(60,)))
        self.assertEqual(figure.axes[0].get_ylabel(), "applied lateral force [MN]")
        self.assertAlmostEqual(figure.axes[0].get_lines()[0].get_ydata().max(), 5, 12)
        for theta, share in ((60, 1), (0, 0.5), (150, 0), (240, -1)):
            (_, table), = plot.tables(turned, ["points"], plot.Options(angles=(theta,)))
            (_, pile), = plot.tables(turned, ["pile"], plot.Options(angles=(theta,)))
            reactions = [one for _, one in plot.tables(turned, ["pisa"], plot.Options(angles=(theta,)))]
            self.assertEqual({angle for one in (table, pile, *reactions) for angle in one["theta"]}, {theta})
            np.testing.assert_allclose(table["lateral_force"][5], 5*share, atol=1e-12)
            np.testing.assert_allclose(table["moment"][5], -125*share, atol=1e-10)
        (_, figure), = plot.figures(turned, ["points"], plot.Options(angles=(150,)))
        self.assertEqual(figure.axes[0].get_ylabel(), "applied lateral force at 240° [MN]")

    def test_increments_bodies_and_range(self):
        (whole,) = self.figures("deformed", increments=(6,), enlargement=40).items()
        self.assertEqual(whole[0], "deformed_increment_6")
        self.assertIn("40 times enlarged", whole[1].axes[0].get_title())
        self.assertIn("increment 6 of 8", whole[1].axes[0].get_title())

        def colours(**options):
            return fields.draw_contours(self.result, "sigma_z", plot.Options(**options))
        steel, ground, everything = colours(body=1), colours(material=3, range=(-0.1, 0.02)), colours()
        self.assertGreater(steel.axes[-1].get_ylim()[1], 2)  # the wall's own range, not that of the ground
        np.testing.assert_allclose(ground.axes[-1].get_ylim(), (-0.1, 0.02))
        self.assertLess(np.ptp(everything.axes[-1].get_ylim()), 0.2*np.ptp(steel.axes[-1].get_ylim()))
        self.assertRegex(everything.get_supxlabel(), "beyond the colours: material 1 from -1.9")
        for figure in (steel, ground, everything):
            self.assertEqual(overlaps(figure), [])
            plot.plt.close(figure)

    def test_stresses_that_are_not_kept(self):
        code, out, said = self.run_command("contours", "deformed", "--increments", "3,4", "-o", self.folder.name, "--format", "svg")
        self.assertEqual(code, 1)
        for name in ("contours_displacement_increment_3", "contours_displacement_increment_4", "deformed_increment_4"):
            self.assertIn(f"{name}.svg", out)
        self.assertIn("stresses of increment 3 are not kept", said)

    def test_options_of_the_command(self):
        sheet = pathlib.Path(self.folder.name)/"own.mplstyle"
        sheet.write_text("axes.prop_cycle: cycler('color', ['ff0000', '00ff00'])\n")
        code, out, _ = self.run_command(
            "energy", "pisa", "-o", f"{self.folder.name}/out", "--format", "svg,pdf", "--style", str(sheet),
            "--units", "kN,m", "--title", "Bored pile")
        self.assertEqual(code, 0)
        self.assertEqual(sorted(os.listdir(f"{self.folder.name}/out")), sorted(
            [f"monopile_{kind}.{ending}" for kind in ("energy", "pisa") for ending in ("pdf", "svg")]
            + [f"monopile_{table}.csv" for table in ("increments", "pisa_shaft", "pisa_base")]))
        self.assertIn("#ff0000", pathlib.Path(f"{self.folder.name}/out/monopile_energy.svg").read_text())
        rows = pathlib.Path(f"{self.folder.name}/out/monopile_pisa_base.csv").read_text().splitlines()
        self.assertEqual((rows[0], len(rows)), ("increment,load_factor,z,theta,v_b,H_b,psi_b,M_b,s_b,V_b", 9))

    def test_faults_of_the_command_line(self):
        for words, said in ((("mesh", "--depth", "3"), "no kind of mesh heeds --depths; those that do: py"),
                            (("--format", "gif"), "no format 'gif'"), (("--range", "3,1"), "two ascending numbers"),
                            (("--units", "MN"), "--units wants"), (("--enlargement", "0"), "a positive number"),
                            (("--style", "nothing.mplstyle"), "no file nothing.mplstyle"),
                            (("pile", "--increments", "9"), "no increment 9"),
                            ((self.path, "mesh"), "monopile.h5 would have figures of the same names"),
                            (("pile", "--body", "2"), "no CUTS of body 2"),
                            (("sections", "--body", "1"), "no section runs through")):
            code, _, found = self.run_command(*words, "-o", self.folder.name)
            self.assertIn(said, found)
            self.assertEqual(code, 0 if said.startswith(("no CUTS", "no section")) else 2)

    def test_nothing_is_written_after_a_fault(self):
        again = pathlib.Path(self.folder.name)/"again"/"monopile.h5"
        again.parent.mkdir()
        again.write_bytes(pathlib.Path(self.path).read_bytes())
        out = pathlib.Path(self.folder.name)/"nothing"
        for words, said in (((str(again), "mesh"), f"{self.path} and {again} would have figures of the same names"),
                            (("energy", "pressure", "--increments", "1,9"), "no increment 9")):
            code, wrote, found = self.run_command(*words, "-o", str(out))
            self.assertIn(said, found)
            self.assertEqual((code, wrote, list(out.glob("*"))), (2, "", []))
        with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()) as found:
            command.main([self.path, "energy", "pressure", "--increments", "3-1", "-o", str(out)])
        self.assertRegex(found.getvalue(), "--increments: the range 3-1 descends; write 1-3\n$")
        self.assertEqual(list(out.glob("*")), [])

    def test_figures_of_each_angle(self):
        """Of kinds with one direction, angles have figures of their own, and rows of their own in tables"""
        out = pathlib.Path(self.folder.name)/"angles"
        kinds = ("pile", "points", "deformed", "pisa")
        code, _, said = self.run_command(*kinds, "--angles", "0,60", "--format", "svg", "-o", str(out))
        self.assertEqual((code, said), (0, ""))
        self.assertEqual({path.name for path in out.glob("*.svg")},
                         {f"monopile_{kind}_theta_{at}.svg" for kind in kinds for at in (0, 60)})
        both, one = (dict(plot.tables(self.result, kinds, plot.Options(angles=angles))) for angles in ((0, 60), (60,)))
        self.assertEqual(both.keys(), {"pile", "points", "pisa_shaft", "pisa_base"})
        for name, table in both.items():
            np.testing.assert_equal(dict(table.where(table["theta"] == 60)), dict(one[name]))
            self.assertEqual(table.rows, 2*one[name].rows)
        self.assertEqual(len(self.figures("sections", angles=(0, 60))), 1)
        self.assertEqual(self.figures("deformed", angles=(0, 60), increments=(6,)).keys(),
                         {"deformed_increment_6_theta_0", "deformed_increment_6_theta_60"})

    def test_labels_beside_curves_keep_apart(self):
        figure, axes = plot.plt.subplots()
        axes.plot([0, 1], [0, 1])
        style.direct_labels(axes, [(1, y) for y in (0.9, 0.5, 0.5, 0.51, 0.0, 0.001)], list("abcdef"))
        self.assertEqual(overlaps(figure), [])
        plot.plt.close(figure)

    def test_powers_of_ten(self):
        found = [style.power_of(x) for x in (0, 1e-12, 0.0009, 0.002, 0.05, 7, 9e4, 2e5, np.inf)]
        self.assertEqual(found, [0, -12, -6, -3, 0, 0, 0, 3, 0])
        self.assertEqual(style.with_power("$v$ [m]", -3), "$v$ [$10^{-3}$ m]")
        self.assertEqual(style.with_power("share", 6), "share [$10^{6}$]")


if __name__ == "__main__":
    unittest.main()
