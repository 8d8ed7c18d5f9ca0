"""HTML as text: tags, numbers and tables, all else escaped."""
import html
import math
import re
from numbers import Integral, Real

# Characters that HTML does not allow, and halves of pairs, which UTF-8 does not
FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\ud800-\udfff\ufdd0-\ufdef\ufffe\uffff]")
EMPTY = {"img", "meta", "br"}
NO_BREAK = "\u00a0"
NOTHING = "–"
# Rows of a long table that are shown at its beginning and at its end
SHOWN_ROWS = 150
# A table of at most as many rows is not parted between pages
SHORT = 20


class Markup(str):
    """Text that is HTML already."""


def escaped(value):
    """A text with all that means something in HTML replaced; characters that HTML forbids become �."""
    if isinstance(value, Markup):
        return value
    return Markup(html.escape(FORBIDDEN.sub("\ufffd", str(value))))


def joined(parts, between="\n"):
    """Parts one after the other."""
    return Markup(between.join(escaped(part) for part in parts))


def with_unit(name, unit):
    """A title of a column or a row, and its unit."""
    return Markup(f"{escaped(name)} [{escaped(unit).replace(' ', NO_BREAK)}]") if unit else name


def running(value):
    """Running text: numbers and equations are not broken at the end of a line, indices are set low."""
    text = re.sub(r"([στ])_(\w+)", r"\1<sub>\2</sub>", escaped(value))
    text = re.sub(r" = (?=-?\w)", "\u00a0=\u00a0", text)
    return Markup(re.sub(r"-?\d[\d.]*(E-\d+)?|-\d[\d.]*",
                         lambda match: f'<span class="unit">{match[0]}</span>' if "-" in match[0] else match[0], text))


def tag(name, /, *content, **attributes):
    """An element; attributes that are None are left out, class_ is class."""
    words = "".join(f' {key.rstrip("_").replace("_", "-")}="{escaped(value)}"'
                    for key, value in attributes.items() if value is not None)
    if name in EMPTY:
        return Markup(f"<{name}{words}>")
    return Markup(f"<{name}{words}>{joined(content, '')}</{name}>")


def number(value):
    """A number as text, six digits: 0.25, 1.5E-7; – where there is none."""
    if value is None or isinstance(value, Real) and not math.isfinite(value):
        return NOTHING
    if isinstance(value, Integral):
        return str(int(value))
    mantissa, _, exponent = f"{float(value) + 0.0:.6g}".partition("e")
    return f"{mantissa}E{int(exponent)}" if exponent else mantissa


def is_number(value):
    """Whether a cell is set as a number."""
    return value is None or isinstance(value, Real) and not isinstance(value, bool)


def table(caption, head, rows, note=None, named_rows=False):
    """A table with a caption; the rows of a long one are left out in the middle, which is said.

    rows: cells, numbers or texts. named_rows: the first cell of each row is its name.
    """
    rows = [list(row) for row in rows]
    left_out = len(rows) - 2*SHOWN_ROWS
    if left_out > 0:
        gap = Markup(f'<tr><td colspan="{len(head)}">⋮ {left_out} rows left out; all are in the listing</td></tr>')
        body = [*(_row(row, named_rows) for row in rows[:SHOWN_ROWS]), gap,
                *(_row(row, named_rows) for row in rows[-SHOWN_ROWS:])]
    else:
        body = [_row(row, named_rows) for row in rows]
    titles = tag("tr", *(tag("th", title, scope="col", class_=_alignment(rows, k))
                         for k, title in enumerate(head)))
    parts = [tag("caption", caption) if caption else Markup(), tag("thead", titles) if any(head) else Markup(),
             Markup(f"<tbody>\n{joined(body)}\n</tbody>")]
    shown = tag("div", tag("table", *parts), class_="wide short" if len(rows) <= SHORT else "wide")
    return joined([shown, tag("p", note, class_="note")]) if note else shown


def _alignment(rows, column):
    """Class of a column's title: that of its cells."""
    return "number" if rows and all(is_number(row[column]) for row in rows) else None


def _row(cells, named):
    shown = []
    for k, cell in enumerate(cells):
        kind, scope = ("th", "row") if named and k == 0 else ("td", None)
        shown.append(tag(kind, number(cell), scope=scope, class_="number") if is_number(cell)
                     else tag(kind, cell, scope=scope))
    return tag("tr", *shown)
