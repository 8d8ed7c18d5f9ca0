"""Units that decks name"""
import unittest

import jobs  # noqa: F401  finds the package

from axijoint.units import Units


class Names(unittest.TestCase):
    """Of titles and comments"""

    def units(self, title, deck=""):
        found = Units(title, deck)
        return found.force, found.length, found.stress

    def test_units_of_stress(self):
        for words in ("MN, m, MPa", "kN, m, kPa", "N, mm, MPa", "MN, m, N/mm2", "kN, m, kN/m^2", "N, mm, N/mm²", "kip, in, ksi",
                      "lbf, in, psi", "lb, ft, psf", "tf, m, tf/m2", "kN, mm, GPa", "kgf, cm, kgf / cm2"):
            self.assertEqual(self.units(f"A pile ({words})"), tuple(words.split(", ")))
            self.assertEqual(self.units("A pile", f"TITLE\n! Units: {words}. More\n"), tuple(words.split(", ")))

    def test_what_is_none(self):
        """Stresses are in force/length² whatever the third word is"""
        for third in ("kPa", "run 3", "kN/m2", "psi", "Pas", "m/m2", "MN/m", "second try", "load case of winter"):
            self.assertEqual(self.units(f"A pile (MN, m, {third})"), ("MN", "m", "MN/m²"), third)
        self.assertEqual(self.units("A pile (MN, m)"), ("MN", "m", "MN/m²"))
        for title in ("A pile", "A pile (m, MN)", "A pile (MN, m, MPa, s)", "A pile (run 3)", "A pile (MN)"):
            self.assertEqual(self.units(title), ("", "", ""), title)


if __name__ == "__main__":
    unittest.main()
