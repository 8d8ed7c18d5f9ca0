"""One page of tables that leads the manual, made from the tables below it"""
import re

import report

BEGIN, END = "<!-- overview -->\n", "<!-- end of the overview -->"
HEADING = "| element | cells | error of displacements | order |"


def insert(manual):
    """The manual with its overview as its tables are now"""
    head, rest = manual.split(BEGIN)
    _, tail = rest.split(END)
    text = "\n" + "\n\n".join(overview(tail)) + "\n\n"
    return head + BEGIN + text + END + tail


def overview(manual):
    """Blocks: what is exact, what converges, what is beyond its bar and said so"""
    tables = {}
    for section, problem, rows in convergence_tables(manual):
        tables.setdefault((section, problem), []).extend(rows)
    exact, converging = [], []
    for (section, problem), rows in tables.items():
        name = f"[{problem}](#{anchor(problem)})"
        if all(row[3] == "exact" for row in rows):
            kinds = list(dict.fromkeys(row[0] for row in rows))
            exact.append([section, name, ", ".join(kinds), largest(row[2] for row in rows)])
        else:
            converging.append([section, name, *(last(rows, kind) for kind in ("4-node", "8-node", "9-node")),
                               orders(rows, 3), orders(rows, 5)])
    verdicts = count_verdicts(manual)
    return [
        "Fields that the elements hold, which must come out to rounding:",
        report.table(["of", "problem", "elements", "largest error of displacements"], exact),
        "Exact solutions that the elements approach: errors of displacements, relative, on the finest mesh "
        "(64 cells for 4-node elements, 32 for others), and the orders that all kinds of elements were seen to have:",
        report.table(["of", "problem", "4-node", "8-node", "9-node", "orders, displacements", "orders, stresses"],
                     converging),
        "Hard cases ([Stability](#stability)): " + ", ".join(f"{count} {word}" for word, count in verdicts) + ".",
    ]


def convergence_tables(manual):
    """Section, problem and rows of each table of errors"""
    section = problem = ""
    lines = iter(manual.splitlines())
    for line in lines:
        if line.startswith("## "):
            section = line[3:]
        elif line.startswith("### "):
            problem = line[4:]
        elif line.startswith(HEADING):
            next(lines)
            rows = []
            for row in lines:
                if not row.startswith("|"):
                    break
                rows.append([cell.strip() for cell in row.strip("|").split("|")])
            yield section, problem, rows


def anchor(heading):
    """Where a heading can be linked to"""
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


def value(text):
    """The last number of a cell; a bound counts as itself"""
    return float(re.findall(r"\d(?:\.\d+)?e[-+]\d+", text)[-1])


def largest(cells):
    """The cell with the largest value"""
    return max(cells, key=value)


def last(rows, kind):
    """The largest error of displacements of a kind of element on the finest mesh"""
    found = [row for row in rows if row[0] == kind]
    if not found:
        return "–"
    worst = max(found, key=lambda row: value(row[2]))
    return "exact" if worst[3] == "exact" else f"{value(worst[2]):.1e}"


def orders(rows, column):
    """Least and greatest order"""
    found = [float(row[column]) for row in rows if re.fullmatch(r"-?\d+\.\d+", row[column])]
    return f"{min(found):.2f} … {max(found):.2f}" if found else "–"


def count_verdicts(manual):
    """Numbers of the verdicts of the table of stability"""
    words = ("ok", "as expected", "limited", "FAILED")
    cells = [line.strip("|").split("|")[-1].strip() for line in manual.splitlines() if line.startswith("| ")]
    return [(word, cells.count(word)) for word in words]
