"""Studies from Python: tables of all kinds, executors, parts that fail, what comes back"""
import concurrent.futures
import importlib.util
import os
import pathlib
import tempfile
import unittest

import jobs
import numpy as np

import axijoint
from axijoint import spread
from axijoint.study_table import table_text

MISSING = {name: f"{name} is not installed: scripts/setup python" for name in ("pandas", "xarray", "distributed")
           if importlib.util.find_spec(name) is None}
DECK = jobs.ROOT/"inputs/case3_balanced.dat"
TABLE = {"LAWS 1 PHI": "0; 20; 35", "MATERIALS 1 E": [2.0e4, 1.8e4], "RESULTANTS 1 VALUE": "0.2; 0.4"}


def needs(name):
    """Skips a test, and says why, where a package is not installed."""
    return unittest.skipIf(name in MISSING, MISSING.get(name, ""))


class Texts(unittest.TestCase):
    """Tables from columns"""

    def test_columns_of_all_kinds(self):
        text = table_text({"SAMPLES": 8, "LAWS 1 PHI": "NORMAL 30 2", "CONTROL planes": [8, 16.0, None],
                           "MATERIALS 1 E": np.array([2e4, 1e-5, np.nan]), "LAWS 1 C": [[0, 0.1], "0:1:0.5", ""]})
        self.assertEqual(text.splitlines(), [
            "SAMPLES, LAWS 1 PHI, CONTROL planes, MATERIALS 1 E, LAWS 1 C", "8, NORMAL 30 2, 8, 20000, 0; 0.1",
            "8, NORMAL 30 2, 16, 1e-05, 0:1:0.5", "8, NORMAL 30 2, , , "])

    def test_an_empty_cell_of_one_column_is_a_line(self):
        for cell in (None, np.nan, "", " "):
            self.assertEqual(table_text({"LAWS 1 PHI": [25, cell]}), 'LAWS 1 PHI\n25\n""\n')

    def test_all_digits_are_kept(self):
        for value in (1/3, 1e300, np.nextafter(1.0, 2.0), 2**53 + 2.0):
            self.assertEqual(float(table_text({"LAWS 1 C": value}).splitlines()[1]), value)

    def test_what_is_no_table(self):
        for columns, said in (({}, "no columns"), ({"A": [1, 2], "B": [1]}, "A 2, B 1"), ({"A": "1, 2"}, "comma"),
                              ({"A, B": 1}, "comma")):
            with self.assertRaisesRegex(ValueError, said):
                table_text(columns)
        for columns in ({1: 2}, {"A": [True]}, {"A": [object()]}):
            with self.assertRaises(TypeError):
                table_text(columns)


class Studies(unittest.TestCase):
    """Twelve states of a deck, solved by one process, and by others in parts"""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.whole = axijoint.study(DECK, TABLE, folder=cls.folder/"whole", threads=1)

    def same(self, found):
        """The same digits as the study by one process"""
        self.assertEqual(found.rows.column_names, self.whole.rows.column_names)
        for name, column in self.whole.rows.items():
            if name != "seconds":
                np.testing.assert_array_equal(found.rows[name], column, name)

    def test_rows(self):
        rows = self.whole.rows
        self.assertEqual(rows.rows, 12)
        np.testing.assert_array_equal(rows["MATERIALS 1 E"], np.repeat([2.0e4, 1.8e4], 6))
        np.testing.assert_array_equal(rows["LAWS 1 PHI"], np.tile(np.repeat([0, 20, 35], 2), 2))
        np.testing.assert_array_equal(rows["RESULTANTS 1 VALUE"], np.tile([0.2, 0.4], 6))
        np.testing.assert_array_equal(self.whole.exit_codes, 0)
        for name in ("largest_displacement", "work"):
            np.testing.assert_array_equal(self.whole.values(name)[:, 0], rows[name])
        with self.assertRaisesRegex(ValueError, "largest_displacement"):
            self.whole.values("displacement")

    def test_names_in_any_case(self):
        rows = self.whole.rows
        for name in ("Laws 1 phi", "laws 1 PHI", "LAWS 1 PHI"):
            np.testing.assert_array_equal(rows[name], self.whole.read("varied")[:, self.whole.columns.index("LAWS 1 PHI")])
            np.testing.assert_array_equal(rows.where([2, 3])[name], rows[name][[2, 3]])
            self.assertIn(name, rows)
        self.assertNotIn("LAWS 1", rows)
        np.testing.assert_array_equal(self.whole.values("Work"), self.whole.values("work"))
        with self.assertRaisesRegex(KeyError, "no column 'LAWS 1 FI'; there are row, LAWS 1 PHI"):
            rows["LAWS 1 FI"]

    def test_get_and_copy_take_names_in_any_case(self):
        rows = self.whole.rows
        for table in (rows, rows.copy()):
            np.testing.assert_array_equal(table.get("laws 1 phi"), rows["LAWS 1 PHI"])
            self.assertIsNone(table.get("LAWS 1 FI"))
            self.assertEqual(table.get("LAWS 1 FI", 3), 3)
        self.assertEqual(rows.copy().rows, 12)

    def test_quiet(self):
        """What a study prints is not what tells that it came to its end"""
        self.same(axijoint.study(DECK, TABLE, folder=self.folder/"quiet", threads=1, options=["--quiet"]))
        with concurrent.futures.ThreadPoolExecutor(2) as executor:
            self.same(axijoint.study(DECK, TABLE, executor, folder=self.folder/"quiet parts", options=["--quiet"]))
        with self.assertRaisesRegex(axijoint.RunError, "no field of LAWS"):
            axijoint.study(DECK, {"LAWS 1 FI": [1, 2]}, options=["--quiet"])

    def test_a_row_is_a_run(self):
        text = DECK.read_text()
        # Of row 9: phi = 20, E = 1.8E4, value = 0.2
        for old, new in (("    1     2.0E4 ", "    1     1.8E4 "),
                         ("       0.0       0.0     PAPER", "       0.0      20.0     PAPER"),
                         ("   LATERAL       0.4", "   LATERAL       0.2")):
            self.assertEqual(text.count(old), 1)
            text = text.replace(old, new)
        alone = axijoint.open(f"{jobs.run(self.folder, 'alone', text)}.h5").increments
        for name in ("largest_displacement", "largest_pressure", "work", "dissipated"):
            np.testing.assert_allclose(self.whole.rows[name][8], alone[name][-1], rtol=1e-9)

    def test_tables_of_all_kinds(self):
        text = "LAWS 1 PHI, MATERIALS 1 E, RESULTANTS 1 VALUE\n0; 20; 35, 2.0E4, 0.2; 0.4\n0; 20; 35, 1.8E4, 0.2; 0.4\n"
        path = self.folder/"states.csv"
        path.write_text(text)
        self.same(axijoint.study(str(DECK), text, threads=1))
        found = axijoint.study(DECK, path, folder=self.folder/"path", threads=1)
        self.same(found)
        self.assertEqual(found.path.name, "states.study.h5")
        self.same(axijoint.open_study(found.path))

    @needs("pandas")
    def test_data_frames(self):
        import pandas
        columns = {name: self.whole.rows[name] for name in TABLE}
        self.same(axijoint.study(DECK, pandas.DataFrame(columns), threads=1))
        frame = self.whole.to_pandas()
        self.assertEqual(list(frame.columns), self.whole.rows.column_names)
        np.testing.assert_array_equal(frame["work"], self.whole.rows["work"])

    def test_words_stay_words(self):
        found = axijoint.study(DECK, "LAWS 1 kind of law\nELASTIC\nPAPER\n", threads=1)
        self.assertEqual(list(found.rows["LAWS 1 KIND OF LAW"]), ["ELASTIC", "PAPER"])

    def test_increments(self):
        found = axijoint.study(jobs.ROOT/"inputs/monopile.dat", {"LAWS 1 PHI": [20, 30]}, threads=1)
        self.assertEqual(list(found.increments), [8, 8])
        data = found.values("load_factor")
        self.assertEqual(data.shape, (2, 8))
        np.testing.assert_array_equal(data[:, -1], found.rows["load_factor"])
        if "xarray" not in MISSING:
            array = found.to_xarray()
            np.testing.assert_array_equal(array["work"].sel(row=2, increment=5), found.values("work")[1, 4])
            self.assertEqual(list(array["LAWS 1 PHI"]), [20, 30])

    def test_statistics(self):
        table, work = self.whole.statistics(), self.whole.rows["work"]
        row = list(table["quantity"]).index("work")
        self.assertAlmostEqual(table["mean"][row]/work.mean(), 1, 12)
        self.assertEqual(table["greatest"][row], work.max())
        # The program's interval is by samples of its own; both stray by some 3 % of their width
        wanted = np.array([table["mean from"][row], table["mean to"][row]])
        found = self.whole.confidence("work")
        np.testing.assert_allclose(found, wanted, atol=0.15*np.ptp(wanted))
        low, high = self.whole.confidence("work", np.median, (0.25, 0.75))
        self.assertTrue(work.min() <= low <= np.median(work) <= high <= work.max())

    def test_executors_of_the_standard_library(self):
        for pool in (concurrent.futures.ThreadPoolExecutor, concurrent.futures.ProcessPoolExecutor):
            with pool(2) as executor:
                self.same(axijoint.study(DECK, TABLE, executor))
                self.same(axijoint.study(DECK, TABLE, executor, parts=5, folder=self.folder/pool.__name__))
            self.assertEqual(sorted(os.listdir(self.folder/pool.__name__)),
                             ["job.csv", "job.study.csv", "job.study.h5"])

    @needs("distributed")
    def test_dask(self):
        import distributed
        with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, \
                distributed.Client(cluster) as client:
            self.same(axijoint.study(DECK, TABLE, client, parts=3))
            self.same(axijoint.study(DECK, TABLE, client.get_executor(), parts=3))

    def failing(self, script):
        """A program that fails in part 2 as long as there is a file `fail`"""
        path = self.folder/"failing.sh"
        path.write_text("#!/bin/sh\n"
                        f"case \"$*\" in *'--part 2/3'*) [ ! -e {self.folder}/fail ] || {{ {script}; }};; esac\n"
                        f"exec {os.environ['AXIJOINT']} \"$@\"\n")
        path.chmod(0o755)
        (self.folder/"fail").touch()
        return path

    def test_a_part_that_fails(self):
        for script, code, said in (("echo 'no room on the disk' >&2; exit 5", 5, "part 2 of 3: no room on the disk"),
                                   ("kill -9 $$", 0, "part 2 of 3: ended with exit code -9")):
            place = self.folder/said[-5:]
            program = self.failing(script)
            with concurrent.futures.ThreadPoolExecutor(2) as executor:
                with self.assertRaisesRegex(axijoint.StudyError, said) as caught:
                    axijoint.study(DECK, TABLE, executor, 3, place, program=program)
                self.assertEqual((caught.exception.exit_code, list(caught.exception.parts)), (code, [2]))
                self.assertFalse((place/"job.study.h5").exists())
                done = [line for part in (1, 3)
                        for line in (place/f"job.study.{part}of3.rows").read_text().splitlines()[1:]]
                self.assertEqual(len(done), 8)
                (self.folder/"fail").unlink()
                found = axijoint.study(DECK, TABLE, executor, 3, place, program=program)
            self.same(found)
            # Rows that were done are not solved again: their times stay
            for line in done:
                number, _, _, seconds = line.split(",")[1:5]
                self.assertAlmostEqual(found.rows["seconds"][int(number) - 1], float(seconds), 12)

    def test_a_process_that_dies(self):
        class Dying(concurrent.futures.ThreadPoolExecutor):
            """Its second call raises"""
            def submit(self, function, /, *arguments):
                return super().submit((lambda *_: 1/0) if "2/3" in arguments[0] else function, *arguments)
        with Dying(2) as executor, self.assertRaisesRegex(
                axijoint.StudyError, "^part 2 of 3: ZeroDivisionError: division by zero$"):
            axijoint.study(DECK, TABLE, executor, 3)

    def test_wrong_tables(self):
        with concurrent.futures.ThreadPoolExecutor(2) as executor:
            for given in (None, executor):
                with self.assertRaisesRegex(axijoint.RunError, "no field of LAWS has this name") as caught:
                    axijoint.study(DECK, {"LAWS 1 PHY": 10}, given)
                self.assertEqual(caught.exception.exit_code, 2)
                self.assertEqual(str(caught.exception).count("LAWS 1 PHY"), 1)

    def test_rows_that_cannot_be_solved(self):
        table = {"LAWS 1 kind of law": [None, "ELASTIC", None], "LAWS 1 PHI": [None, 20, 10]}
        with concurrent.futures.ThreadPoolExecutor(2) as executor:
            for given in (None, executor):
                found = axijoint.study(DECK, table, given, threads=1)
                self.assertEqual(list(found.exit_codes), [0, 2, 0])
                self.assertEqual(list(found.increments), [1, 0, 1])
                self.assertTrue(found.rows["message"][1])
                self.assertTrue(np.isnan(found.rows["work"][1]))
                self.assertTrue(np.isnan(found.rows["LAWS 1 PHI"][0]))

    def test_the_value_of_the_deck_in_a_table_of_one_column(self):
        found = axijoint.study(DECK, {"LAWS 1 PHI": [20, None, np.nan, "", 10]}, threads=1)
        np.testing.assert_array_equal(found.rows["LAWS 1 PHI"], [20, np.nan, np.nan, np.nan, 10])
        self.assertEqual(list(found.increments), [1, 1, 1, 1, 1])

    def test_files_of_other_kinds(self):
        result = axijoint.run(DECK, self.folder/"run", threads=1)
        with self.assertRaisesRegex(ValueError, "is no file of a study"):
            axijoint.open_study(result.path)

    def test_what_is_sent_can_be_sent(self):
        import pickle
        self.assertIs(pickle.loads(pickle.dumps(spread.run_command)), spread.run_command)


if __name__ == "__main__":
    unittest.main()
