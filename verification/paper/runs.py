"""Runs of the paper's cases, and of changed copies of their decks"""
import json
import os
import pathlib
import re
import subprocess

import axijoint

INPUTS = pathlib.Path(__file__).resolve().parents[2]/"inputs"
CASES = ("case1", "case2", "case3")
# Radius of the vertical interface of the reconstruction, its ends, and depth of the sections [m]
FACE, MOUTH, BOTTOM = 0.5, 0.0, 1.0
# Curves are drawn from the decks' mesh with 8-node elements, this many for each along both directions
REFINEMENT = 4


class Run:
    """One deck that was run: `result` (axijoint.Result) and `summary` (the JSON summary).

    vertical: table of the joints of the vertical interface, which may open and slip.
    """

    def __init__(self, program, deck, folder):
        done = subprocess.run([program, "run", deck, "-o", folder], capture_output=True, text=True,
                              check=False, env=os.environ)
        if done.returncode:
            raise SystemExit(f"paper: {deck}: exit code {done.returncode}\n{done.stderr}")
        self.result = axijoint.open(folder/f"{deck.stem}.h5")
        self.summary = json.loads((folder/f"{deck.stem}.json").read_text())
        joints = self.result.joints()
        self.vertical = joints.where(abs(joints["r"] - FACE) < 1e-6)

    @property
    def loops(self):
        """Iterations."""
        return self.summary["iterations"]

    def states(self, state):
        """Number of joint points on planes in a state."""
        return self.summary["joint_states"][state]

    def at(self, theta):
        """Vertical interface on one plane [degree], z ascending."""
        rows = self.vertical.where(abs(self.vertical["theta"] - theta) < 1e-6)
        return rows.where(rows["z"].argsort())

    def largest(self, key):
        """Largest magnitude of a column on the vertical interface."""
        return abs(self.vertical[key]).max()


def all_runs(program, folder):
    """Run everything; dictionary from names to Runs. `NAME fine` is NAME on the finer mesh."""
    decks = {name: INPUTS/f"{name}.dat" for name in
             (*CASES, "continuum", "case3_stiff_joint", "case3_stiff_pile")}
    tight = {"INCREMENTS": lambda card: f"{card[:10]}{'1.0E-6':>10}{5000:5d}"}
    for highest in (4, 8):
        change = {"CONTROL": lambda card, m=highest: f"{m:5d}{33:5d}{card[10:]}"} | tight
        decks[f"case3_M{highest}"] = changed(decks["case3"], folder, f"case3_M{highest}", change)
    for name in (*CASES, "continuum"):
        change = {"BLOCKS": finer} if name == "continuum" else {"BLOCKS": finer, "LAWS": at_gauss_points}
        decks[f"{name} fine"] = changed(decks[name], folder, f"{name}_fine", change)
    return {name: Run(program, deck, folder) for name, deck in decks.items()}


def changed(deck, folder, name, change):
    """Copy of a deck with changed cards: {section: function of a data card}."""
    section, lines, seen = "", [], set()
    for line in deck.read_text().splitlines():
        word = re.match(r"[A-Za-z]+", line)
        if word:
            section = word.group().upper()
        elif section in change and line.strip() and line[0] not in "!$":
            line = change[section](line)
            seen.add(section)
        lines.append(line)
    if seen != set(change):
        raise SystemExit(f"paper: {deck} has no cards in {set(change) - seen}")
    path = folder/f"{name}.dat"
    path.write_text("\n".join(lines) + "\n")
    return path


def finer(card):
    """First card of a block with 8-node elements, REFINEMENT times as many in both directions."""
    fields = card.split()
    if "." in card:  # second card: the corners
        return card
    body, material, _, n1, n2 = map(int, fields)
    return f"{body:5d}{material:5d}{8:5d}{n1*REFINEMENT:5d}{n2*REFINEMENT:5d}"


def at_gauss_points(card):
    """Card of a law for the joints of 8-node elements, which have no rule at the centroid."""
    return f"{card[:65]}{'GAUSS':>10}{card[75:]}"
