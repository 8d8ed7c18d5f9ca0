"""Units that a deck names."""
import re

# Known units in N, m and Pa
POUND, GRAVITY = 4.4482216152605, 9.80665
FORCES = {"N": 1.0, "kN": 1e3, "MN": 1e6, "GN": 1e9, "kgf": GRAVITY, "tf": 1e3*GRAVITY, "t": 1e3*GRAVITY, "lbf": POUND,
          "lb": POUND, "kip": 1e3*POUND, "kips": 1e3*POUND}
LENGTHS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "in": 0.0254, "ft": 0.3048}
STRESSES = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "bar": 1e5, "psi": POUND/0.0254**2, "ksi": 1e3*POUND/0.0254**2,
            "psf": POUND/0.3048**2, "ksf": 1e3*POUND/0.3048**2}
# Others of stress, such as kN/m2, kip/in^2, N/mm²
QUOTIENT = re.compile(r"(\w+) ?/ ?(\w+?)(?:\^2|\*\*2|2|²)")
# Share within which a unit of stress is force/length²
ALIKE = 1e-3


class Units:
    """Units that the deck names: in its title, or in a comment `Units: force, length, stress`.

    force, length, stress: their names; empty where the deck names none. Where a third word is no unit of stress, or
    another one than force/length², in which stresses are whatever the deck says, that of stress is force/length².
    """

    def __init__(self, title, deck):
        self.force = self.length = self.stress = ""
        texts = re.findall(r"\(([^()]*)\)", title)
        texts += re.findall(r"^[!$]\s*Units?:\s*([^.\n]*)", deck, re.MULTILINE | re.IGNORECASE)
        for text in texts:
            names = [name.strip() for name in text.split(",")]
            if len(names) in (2, 3) and names[0] in FORCES and names[1] in LENGTHS:
                self.name(*names[:2], *(name for name in names[2:] if _agrees(*names)))
                return

    def name(self, force, length, stress=None):
        """Name the units."""
        self.force, self.length, self.stress = force, length, stress or f"{force}/{length}²"

    def per_length(self, unit):
        """A unit over that of length."""
        return f"{unit}/{self.length}" if unit else ""

    def label(self, name, unit=""):
        """A label: a name or a symbol, and the unit in brackets."""
        return f"{name} [{unit}]" if unit else name

    def of_length(self, name):
        """Label of a length."""
        return self.label(name, self.length)

    @property
    def moment(self):
        """Unit of moments."""
        return f"{self.force} {self.length}" if self.force else ""


def _agrees(force, length, stress):
    """Whether a name is that of a unit of stress, and this is force/length²."""
    quotient = QUOTIENT.fullmatch(stress)
    if quotient and quotient[1] in FORCES and quotient[2] in LENGTHS:
        size = FORCES[quotient[1]]/LENGTHS[quotient[2]]**2
    else:
        size = STRESSES.get(stress, 0.0)
    return abs(size*LENGTHS[length]**2/FORCES[force] - 1) < ALIKE
