"""The reader against what the listing prints and what the result file holds"""
import pathlib
import tempfile
import unittest
import unittest.mock

import jobs
import listing
import numpy as np

import axijoint

SECTIONS = ("SECTIONS", "    1       0.0       0.5       2.0       0.5   41      0.0      45.0     180.0",
            "    2       0.3      -0.5       0.3       2.0   26      30.0",
            "OUTPUT", "       0.0      75.0     180.0     250.0")


def close(found, printed):
    """Whether a value agrees with one that was printed with its digits."""
    digits = printed.lstrip("+-").split("E")[0].replace(".", "")
    unit = 10.0**(np.floor(np.log10(abs(float(printed)))) - len(digits) + 1) if float(printed) else 1e-30
    return abs(found - float(printed)) <= 0.50001*unit


class Listing(unittest.TestCase):
    """The paper's case 3, and a chimney with combinations and both families' loads"""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.jobs = {}
        name = jobs.run(cls.folder.name, "case3", jobs.input_deck("case3", *SECTIONS))
        cls.jobs["case3"] = axijoint.open(f"{name}.h5"), name
        name = jobs.run(cls.folder.name, "chimney", jobs.input_deck("chimney"))
        cls.combinations = axijoint.open_combinations(name)
        cls.jobs["chimney"] = cls.combinations[2], f"{name}.2"

    def printed(self, path, heading, n_columns):
        """Rows of the tables under a heading, fields as printed: pairs of the heading and the fields."""
        lines = pathlib.Path(f"{path}.lis").read_text(encoding="utf-8").splitlines()
        for k, line in enumerate(lines):
            if line.startswith(heading):
                for row in lines[k + 2:]:
                    fields = row.split()
                    if not fields:
                        break
                    if len(fields) == n_columns and fields[0].isdigit():
                        yield line, fields

    def compare(self, rows, value):
        """Compare printed rows with values; value(heading, fields) gives the last columns."""
        count = 0
        for line, fields in rows:
            found = value(line, fields)
            for one, text in zip(found, fields[-len(found):]):
                self.assertTrue(close(one, text), f"{line}: {fields}: found {one!r}")
            count += 1
        self.assertGreater(count, 20)

    def test_stored_sections(self):
        for result, _ in self.jobs.values():
            for number in result.section_numbers:
                stored = result.section(number)
                line = result.line(stored.first, stored.last, stored.theta, stored.point.max())
                np.testing.assert_array_equal(line.element, stored.element)
                for name in ("position", "distance", "displacement", "stress"):
                    wanted = getattr(stored, name)
                    np.testing.assert_allclose(getattr(line, name), wanted, rtol=0,
                                               atol=1e-12*abs(wanted).max())
                self.assertEqual(line.table().rows, len(stored.point)*len(stored.theta))

    def test_sections(self):
        for result, path in self.jobs.values():
            def place(line, fields):
                theta = float(line.split("theta = ")[1].split()[0])
                return {"r": float(fields[1]), "z": float(fields[2]), "theta": theta,
                        "body": int(fields[3]), "material": int(fields[4])}
            self.compare(self.printed(path, "DISPLACEMENTS ON SECTION", 8),
                         lambda line, fields: result.displacement(**place(line, fields)))
            self.compare(self.printed(path, "STRESSES ON SECTION", 11),
                         lambda line, fields: result.stress(**place(line, fields)))

    def test_nodes_and_gauss_points(self):
        for result, path in self.jobs.values():
            def row(make):
                tables = {}

                def found(line, fields):
                    theta = float(line.split("theta = ")[1].split()[0])
                    if theta not in tables:
                        tables[theta] = make(theta)
                    values, keys = tables[theta]
                    return values[keys[tuple(int(x) for x in fields[:len(next(iter(keys)))])]]
                return found

            def tabled(table, n_keys):
                names = table.column_names
                values = np.stack([table[name] for name in names[n_keys:]], -1)
                keys = zip(*(table[name] for name in names[:n_keys]))
                return values, {tuple(map(int, key)): k for k, key in enumerate(keys)}
            self.compare(self.printed(path, "TOTAL DISPLACEMENTS", 6),
                         row(lambda theta: tabled(result.nodes(theta), 1)))
            self.compare(self.printed(path, "TOTAL STRESSES AT GAUSS POINTS", 10),
                         row(lambda theta: tabled(result.gauss_stresses(theta), 2)))
            self.compare(self.printed(path, "TOTAL STRESSES AT NODES", 10),
                         row(lambda theta: tabled(result.nodal_stresses(theta), 2)))

    def test_values_at_nodes_are_those_of_the_nodes(self):
        for result, _ in self.jobs.values():
            table = result.nodal_stresses(75.0)
            body = {node: b for nodes, b in zip(result.mesh.element_nodes, result.mesh.element_body)
                    for node in result.mesh.node_label[nodes[nodes >= 0]]}
            for k in range(0, table.rows, 7):
                found = result.stress(table["r"][k], table["z"][k], 75.0, body=body[table["node"][k]],
                                      material=table["material"][k])
                wanted = np.array([table[name][k] for name in axijoint.STRESSES])
                np.testing.assert_allclose(found, wanted, atol=1e-7*max(abs(wanted).max(), 1e-3))

    def test_joints(self):
        for result, path in self.jobs.values():
            table = result.joints()
            printed = listing.tables(pathlib.Path(f"{path}.lis").read_text(encoding="utf-8"))["joints"]
            keyed = {(int(j), int(p), round(t, 3)): k for k, (j, p, t)
                     in enumerate(zip(table["joint"], table["point"], table["theta"]))}
            self.assertEqual(len(printed), table.rows)
            columns = {"sigma": "sigma", "tau_xi": "tau_xi", "tau_theta": "tau_theta", "d_eta": "d_eta",
                       "d_xi": "slip_xi", "d_theta": "slip_theta"}
            for row in printed:
                k = keyed[int(row["joint"]), int(row["point"]), round(row["theta"], 3)]
                self.assertEqual(table["state"][k].lower(), row["state"].lower())
                for name, column in columns.items():
                    self.assertTrue(abs(table[column][k] - row[name]) <= 1e-4*abs(row[name]) + 1e-12,
                                    f"{name}: {row} {table[column][k]}")

    def test_combinations(self):
        self.assertEqual(list(self.combinations), [1, 2])
        self.assertEqual(axijoint.open_combinations(self.jobs["case3"][1]).keys(), {0})
        factors = [list(one.read("loads/case_factor")) for one in self.combinations.values()]
        self.assertEqual(factors, [[1, 0, 0], [1, 1.5, 1]])

    def test_points_outside(self):
        result = self.jobs["case3"][0]
        with self.assertRaisesRegex(axijoint.OutsideError, "1 of 2 points outside the mesh"):
            result.displacement([0.1, 5.0], 0.0)
        with self.assertRaisesRegex(axijoint.OutsideError, "body 2"):
            result.stress(0.1, 0.0, body=2)
        with self.assertRaisesRegex(ValueError, "no material 9"):
            result.stress(0.1, 0.0, material=9)
        found = result.displacement([0.1, 5.0, np.nan], 0.0, outside="nan")
        self.assertTrue(np.isfinite(found[0]).all() and np.isnan(found[1:]).all())

    def test_lines_without_points(self):
        result = self.jobs["case3"][0]
        with self.assertRaisesRegex(axijoint.OutsideError, "all 5 points of the line from r = 50, z = 0 to r = 60, z = 1 are"):
            result.line((50, 0), (60, 1), points=5)
        with self.assertRaisesRegex(ValueError, "no length: its ends are r = 0.1, z = 0.2 and r = 0.1, z = 0.2"):
            result.line((0.1, 0.2), (0.1, 0.2))

    def test_points_at_angles(self):
        """A place is looked for once, whatever angles there are of it"""
        result = self.jobs["case3"][0]
        r, z, theta = np.array([0.1, 0.4, 0.5, 9.0]), np.array([0.3, 0.3, 0.4, 0.0]), np.arange(0, 360, 30)
        with unittest.mock.patch.object(result.mesh, "locate", wraps=result.mesh.locate) as locate:
            found = result.displacement(r[:, None], z[:, None], theta, outside="nan")
            radius, angles = np.meshgrid(r, theta)
            stress = result.stress(radius, 0.3, angles, outside="nan")
        self.assertEqual([len(one.args[0]) for one in locate.call_args_list], [4, 4])
        self.assertEqual((found.shape, stress.shape), ((4, 12, 3), (12, 4, 6)))
        for k in range(3):
            for j, angle in enumerate(theta):
                np.testing.assert_allclose(found[k, j], result.displacement(r[k], z[k], angle), rtol=0, atol=1e-15)
        self.assertTrue(np.isnan(found[3]).all())
        with self.assertRaisesRegex(axijoint.OutsideError, "12 of 48 points outside the mesh, the first at r = 9, z = 0"):
            result.displacement(r[:, None], z[:, None], theta)

    def test_solids_that_meet(self):
        result = self.jobs["case3"][0]
        self.assertTrue((result.stress(0.5, 0.3) == result.stress(0.5, 0.3, body=1)).all())
        self.assertFalse(np.allclose(result.stress(0.5, 0.3), result.stress(0.5, 0.3, body=2)))
        line = result.line((0, 0.5), (2, 0.5), points=9)
        self.assertEqual(line.body.tolist(), [1, 1, 1, 2, 2, 2, 2, 2, 2, 2])


if __name__ == "__main__":
    unittest.main()
