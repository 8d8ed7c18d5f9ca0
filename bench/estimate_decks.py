"""Decks for scripts/bench estimate: those that the constants of `axijoint estimate` are fitted to, and others, users'
jobs, that show how good they are."""
import os
import re

INPUTS = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "inputs")


def inputs(name):
    """A deck of inputs/"""
    with open(os.path.join(INPUTS, name + ".dat"), encoding="utf-8") as file:
        return file.read()


def finer(text, factor):
    """So many times as many elements along each side of every block"""
    section, lines, sizes = "", [], False
    for line in text.split("\n"):
        body = line.split("!")[0].rstrip()
        if line[:1].isalpha():
            section, sizes = line.split()[0], True
        elif section == "BLOCKS" and body:
            if sizes and "," in body:
                fields = body.split(",")
                line = ",".join(fields[:3] + [str(int(n)*factor) for n in fields[3:5]] + fields[5:])
            elif sizes:
                line = f"{body[:15]}{int(body[15:20])*factor:5d}{int(body[20:25])*factor:5d}{body[25:]}"
            sizes = not sizes
        lines.append(line)
    return "\n".join(lines)


def with_harmonics(text, harmonic, planes):
    """Another highest harmonic and number of planes"""
    return re.sub(r"(^CONTROL.*\n(?:!.*\n)*)[ \d]{10}|(^CONTROL.*\n)[ \d]+$",
                  lambda found: f"{found[1] or found[2]}{harmonic:5d}{planes:5d}", text, count=1, flags=re.MULTILINE)


def turned(text):
    """The lateral load turned by 30 degrees, so that both families answer"""
    return re.sub(r"^( +\d+ +LATERAL +\S+).*$", r"\1      30.0", text, flags=re.MULTILINE)


def solid(inner, outer, height, across, along, harmonics, nodes=9, combinations=0):
    """A body held at its bottom, with tractions of all harmonics on its top."""
    lines = ["TITLE", "Estimate", "CONTROL", f"{max(harmonics):5}", "MATERIALS",
             f"{1:5}{1000.0:10.1f}{0.3:10.2f}", "BLOCKS", f"1,1,{nodes},{across},{along}",
             f"{inner},0.0,{outer},{height}", "FACES", f"1,1,{inner},{height},{outer},{height}",
             f"2,1,{inner},0.0,{outer},0.0", "FIXEDFACES", "2,111"]
    lines += ["CASE", "1, all"] if combinations else []
    lines += ["TRACTIONS"] + [f"1,{m},0.1,1.0" for m in harmonics]
    lines += ["COMBINE"] + [f"{k},1,{k}.0" for k in range(1, combinations + 1)] if combinations else []
    return "\n".join(lines + ["END", ""])


def long_joint(across, rows):
    """A pile in a ring of ground, a joint all along with stress before loading and friction that slips in a part of it: so many
    rows of 8-node elements along it, and so many across the pile and the ring"""
    pile, ring = across
    return "\n".join([
        "TITLE", "Long joint", "CONTROL", "    2    9", "MATERIALS", "1, 2.0E4, 0.2", "2, 50.0, 0.3",
        "LAWS", "1, 100.0, 200.0, 100.0, 0.0, 26.0", "LAWDETAILS", "1, RESULTANT, , , , , , -0.05",
        "BLOCKS", f"1, 1, 8, {pile}, {rows}", "0.0, -10.0, 0.5, 0.0", f"2, 2, 8, {ring}, {rows}, 4.0", "0.5, -10.0, 10.0, 0.0",
        "FACES", "1, 1, 0.0, 0.0, 0.5, 0.0", "2, 1, 0.5, -10.0, 0.5, 0.0", "3, 2, 0.5, -10.0, 0.5, 0.0",
        "4, 2, 10.0, -10.0, 10.0, 0.0", "5, 2, 0.5, -10.0, 10.0, -10.0", "INTERFACES", "1, 2, 3", "FIXEDFACES", "4, 111", "5, 111",
        "RESULTANTS", "1, LATERAL, 0.2", "1, AXIAL, -0.06", "INCREMENTS", "0.5, 1.0E-6", "0.5, 1.0E-6", "END", ""])


def fitted():
    """Name: deck, options"""
    decks = {name: (inputs("gallery/" + name), []) for name in
             ("caisson", "flange", "footing", "lined_shaft", "pipe", "plug", "shrink_fit", "tank")}
    decks |= {name: (inputs("hard/" + name), []) for name in
              ("cyclic_pile", "eccentric_disc", "ground_stress", "cone")}
    decks |= {name: (inputs(name), []) for name in ("case1", "case2_balanced", "continuum")}
    decks["case1_2"] = finer(inputs("case1_balanced"), 2), []
    decks["case1_3"] = finer(inputs("case1_balanced"), 3), []
    decks["caisson_2"] = finer(inputs("gallery/caisson"), 2), []
    decks["flange_2"] = finer(inputs("gallery/flange"), 2), []
    decks["footing_2"] = finer(inputs("gallery/footing"), 2), []
    decks["stiff_4"] = finer(inputs("case3_stiff_joint_balanced"), 4), []
    decks["case1_24"] = with_harmonics(turned(inputs("case1_balanced")), 24, 97), []
    decks["caisson_48"] = with_harmonics(inputs("gallery/caisson"), 48, 193), []
    decks["shaft_vtk"] = inputs("gallery/lined_shaft"), ["--vtk"]
    decks["pipe_vtk"] = inputs("gallery/pipe"), ["--vtk"]
    decks["flange_vtk"] = inputs("gallery/flange"), ["--vtk"]
    decks["long_joint"] = long_joint((8, 12), 100), []
    decks["long_joint_band"] = long_joint((8, 12), 100), ["--solver", "band"]
    decks["shaft"] = solid(0.0, 0.4, 8.0, 10, 130, [0, 1, 2]), []
    decks["tube"] = solid(0.9, 1.0, 40.0, 7, 800, [1, 2, 4], nodes=8), []
    decks["base"] = solid(0.0, 6.0, 3.0, 80, 40, [0, 1, 3], nodes=4), []
    decks["slab"] = solid(0.0, 6.0, 3.0, 80, 40, [0, 1, 3], combinations=3), []
    return decks


def shown():
    """Name: deck, options. No constant is fitted to any of these"""
    case3 = inputs("case3_balanced")
    return {"shell": (solid(5.0, 5.2, 20.0, 4, 90, [0, 1, 2], nodes=8), []),
            "block_90k": (solid(0.0, 3.0, 4.0, 40, 60, [0, 1, 2, 3]), []),
            "block_270k": (solid(0.0, 3.0, 4.0, 70, 110, [0, 1, 2]), []),
            "case3": (case3, []),
            "case3_4": (finer(case3, 4), []),
            "monopile": (inputs("monopile"), []),
            "chimney": (inputs("chimney"), []),
            "block": (inputs("block"), []),
            "harmonics": (with_harmonics(turned(inputs("first")), 32, 129), []),
            "monopile_64": (with_harmonics(inputs("monopile"), 64, 257), []),
            "first_vtk": (finer(inputs("first"), 3), ["--vtk"])}


def studies():
    """Name: deck, table, options. The first two were looked at when the constants were set, the others not"""
    case3 = inputs("case3_balanced")
    with open(os.path.join(INPUTS, "friction.csv"), encoding="utf-8") as file:
        friction = file.read()
    return {"friction": (case3, friction, []),
            "moduli": (finer(case3, 2), "LAWS 1 PHI, MATERIALS 1 E\n0:30/20, 1E4; 2E4; 4E4\n", []),
            "histories": (inputs("monopile"), "LAWS 1 PHI\n20:32/8\n", []),
            "estimated": (finer(case3, 2), "LAWS 1 PHI\n0:30/12\n", ["--estimates"])}
