"""Tables in Markdown, and their places in the manual"""
import math
import re


def table(headings, rows):
    """A table as lines of text"""
    lines = ["| " + " | ".join(headings) + " |", "|" + "---|"*len(headings)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def errors(values):
    """Errors of a row of meshes"""
    return ", ".join(f"{value:.1e}" for value in values)


def rounding(value):
    """An error at the level of rounding, which differs from machine to machine: a power of ten above"""
    if not value < 1e-9:
        return f"{value:.1e}"
    return "< 1e-13" if value < 1e-13 else f"< 1e{math.ceil(math.log10(value))}"


MARKS = re.compile(r"(?P<begin><!-- verify: (?P<name>\w+) -->\n).*?(?P<end><!-- end -->)", re.DOTALL)


def misplaced(manual, names):
    """Cases that have no place in the manual or several, and places without a case"""
    places = [match["name"] for match in MARKS.finditer(manual)]
    return sorted(name for name in {*names, *places}
                  if places.count(name) != 1 or name not in names)


def insert(manual, name, blocks):
    """Puts blocks of text between the markers of a case in the manual's text"""
    text = "\n" + "\n\n".join(blocks) + "\n\n"
    return MARKS.sub(lambda match: match["begin"] + text + match["end"] if match["name"] == name
                     else match[0], manual)
