"""Units that a deck names."""
import re

FORCES = {"N", "kN", "MN", "GN", "kgf", "tf", "t", "lbf", "lb", "kip", "kips"}
LENGTHS = {"m", "cm", "mm", "in", "ft"}
# Any unit of stress, such as MPa, kN/m2, kip/in^2
STRESS = re.compile(r"[\w/^. ²]{1,12}")


class Units:
    """Units that the deck names: in its title, or in a comment `Units: force, length, stress`.

    force, length, stress: their names; empty where the deck names none. Without a name of its own, the unit of
    stress is force/length².
    """

    def __init__(self, title, deck):
        self.force = self.length = self.stress = ""
        texts = re.findall(r"\(([^()]*)\)", title)
        texts += re.findall(r"^[!$]\s*Units?:\s*([^.\n]*)", deck, re.MULTILINE | re.IGNORECASE)
        for text in texts:
            names = [name.strip() for name in text.split(",")]
            if len(names) in (2, 3) and names[0] in FORCES and names[1] in LENGTHS \
                    and all(STRESS.fullmatch(name) for name in names[2:]):
                self.name(*names)
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
