"""What programs cost, and the errors they leave for it: runs, their costs, and the cheapest that meet a bar"""
import csv
import json
import os
import subprocess
import sys
from dataclasses import dataclass

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import LogLocator, NullFormatter

HERE = os.path.dirname(os.path.realpath(__file__))
COLORS = ["#1b6ca8", "#c77d1e", "#2f8f4e", "#8d4fa8", "#b03a48", "#5f6b6d", "#a39a1c", "#222222", "#d86f9e"]
PRICES = {"wall": "wall-clock time of the program (s)", "memory": "largest memory of the program (MB)"}
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "<", ">"]


class RunError(Exception):
    """A run that did not end well"""


@dataclass(frozen=True)
class Cost:
    """What a run took: wall clock and processor time [s], largest resident memory [MB]"""
    wall: float
    processor: float
    memory: float


def run_once(command, folder, threads):
    """Cost of a run of a program as a whole, from its start to its end"""
    said = os.path.join(folder, "said")
    done = subprocess.run([sys.executable, "-S", "-E", os.path.join(HERE, "measured.py"), said, *command],
                          cwd=folder, env=os.environ | {"OMP_NUM_THREADS": str(threads)}, check=True,
                          stdout=subprocess.PIPE, text=True)
    cost = json.loads(done.stdout)
    exit_code = cost.pop("exit_code")
    if exit_code:
        with open(said, encoding="utf-8", errors="replace") as file:
            words = file.read().strip().splitlines()[-5:]
        raise RunError(f"{' '.join(command)}: exit code {exit_code}\n" + "\n".join(words))
    return Cost(**cost)


def measure(command, folder, threads=1, runs=5, long=5.0):
    """Least cost of several runs; one that takes long is not repeated"""
    costs = []
    while len(costs) < runs and (not costs or costs[-1].wall < long):
        costs.append(run_once(command, folder, threads))
    return Cost(*(min(getattr(cost, name) for cost in costs) for name in ("wall", "processor", "memory")))


class Results:
    """Displacements and joint stresses of a run of axijoint, and its summary"""

    def __init__(self, folder, name="job"):
        with open(os.path.join(folder, name + ".json"), encoding="utf-8") as file:
            self.summary = json.load(file)
        with h5py.File(os.path.join(folder, name + ".h5")) as file:
            self.coordinates = file["mesh/coordinates"][()]
            self.harmonic = file["modes/harmonic"][()]
            self.displacement = file["displacement"][()]
            self.joint_nodes = file["mesh/joint_nodes"][()]
            self.joint_size = file["mesh/joint_size"][()]
            self.joint_law = file["joint_materials/label"][()][file["mesh/joint_material"][()] - 1]

    def amplitudes(self, place, harmonic, component):
        """Amplitudes at the nodes at a place (r, z); there may be several nodes"""
        near = np.flatnonzero(np.hypot(*(self.coordinates - place).T) < 1e-9)
        return self.displacement[list(self.harmonic).index(harmonic)][near, component]

    def largest_pressure(self, law, stiffness, angles=721):
        """Stiffness times the largest overlap at the nodes of the joints of a law, over all angles"""
        cosines = np.cos(np.outer(self.harmonic, np.linspace(0.0, np.pi, angles)))
        largest = 0.0
        for nodes, size in zip(self.joint_nodes[self.joint_law == law] - 1, self.joint_size[self.joint_law == law]):
            one, two, three, four, five, six = nodes
            along = self.coordinates[two] - self.coordinates[one]
            normal = np.array([-along[1], along[0]])/np.hypot(*along)
            for a, b in ((one, four), (two, three), (five, six))[:3 if size == 6 else 2]:
                opening = (self.displacement[:, b, :2] - self.displacement[:, a, :2]) @ normal @ cosines
                largest = max(largest, -stiffness*opening.min())
        return largest


def axijoint(program, folder, deck, threads=1, runs=5, long=5.0):
    """Results and cost of a deck"""
    cost = cost_of_deck(program, folder, deck, threads, runs, long)
    return Results(folder), cost


def cost_of_deck(program, folder, deck, threads=1, runs=5, long=5.0):
    """Cost of a deck; its results are in the folder"""
    with open(os.path.join(folder, "job.dat"), "w", encoding="ascii") as file:
        file.write(deck)
    return measure([program, "run", "job.dat", "-o", ".", "--threads", str(threads)], folder, threads, runs, long)


@dataclass
class Point:
    """One setting of a program on a problem: its cost, the values it found and their relative errors by name

    Settings of one series differ in what `size` holds, larger being finer: the mesh, perhaps the harmonics.
    `mesh` names the mesh.
    """
    program: str
    family: str
    size: tuple
    threads: int
    unknowns: int
    cost: Cost
    values: dict
    errors: dict
    mesh: str = ""
    problem: str = ""
    series: str = ""

    def __post_init__(self):
        self.mesh = self.mesh or f"{self.size[0]:g}"
        self.series = self.series or self.family

    def finer(self, other):
        """Whether this is the other setting or a finer one of its series"""
        return ((self.program, self.series, self.threads) == (other.program, other.series, other.threads)
                and all(a >= b for a, b in zip(self.size, other.size)))

    def row(self):
        """As a row of a table"""
        problem = {"problem": self.problem} if self.problem else {}
        return problem | {"program": self.program, "setting": self.family, "mesh": self.mesh,
                          "threads": self.threads, "unknowns": self.unknowns, "wall_s": f"{self.cost.wall:.3f}",
                          "processor_s": f"{self.cost.processor:.3f}", "memory_mb": f"{self.cost.memory:.1f}",
                          **{name: f"{value:.7g}" for name, value in self.values.items()},
                          **{f"{name} error": f"{error:.2e}" for name, error in self.errors.items()}}


def write_table(path, points):
    """All points as CSV"""
    rows = [point.row() for point in points]
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(dict.fromkeys(name for row in rows for name in row)))
        writer.writeheader()
        writer.writerows(rows)


def keeps(points, point, name, bar):
    """Whether a point meets a bar, and every finer one of its series too: errors that change their sign may be
    small by chance"""
    return all(abs(p.errors[name]) <= bar for p in points if p.finer(point))


def cheapest(points, bars, price):
    """The point of least price that meets all bars (name: bar) for good; None if there is none"""
    fit = [p for p in points if all(keeps(points, p, name, bar) for name, bar in bars.items())]
    return min(fit, key=price, default=None)


def front(points, name, price):
    """Points that no other point beats in both price and error, the cheapest first"""
    kept = []
    for p in sorted(points, key=lambda p: (getattr(p.cost, price), abs(p.errors[name]))):
        if not kept or abs(p.errors[name]) < abs(kept[-1].errors[name]):
            kept.append(p)
    return kept


def draw(path, points, names, group, title):
    """Errors against time and memory, a column for each name, a colour for each group; lines are the fronts"""
    groups = list(dict.fromkeys(group(p) for p in points))
    figure, panels = plt.subplots(2, len(names), figsize=(5.2*len(names), 7.6), squeeze=False, layout="constrained")
    for row, (price, words) in zip(panels, PRICES.items()):
        for panel, name in zip(row, names):
            for number, label in enumerate(groups):
                own = [p for p in points if group(p) == label and p.errors[name] != 0.0]
                style = {"color": COLORS[number % len(COLORS)]}
                panel.plot([getattr(p.cost, price) for p in own], [abs(100*p.errors[name]) for p in own],
                           MARKERS[number % len(MARKERS)], markersize=4, alpha=0.6, label=label, **style)
                best = front(own, name, price)
                panel.plot([getattr(p.cost, price) for p in best], [abs(100*p.errors[name]) for p in best],
                           linewidth=1.2, **style)
            panel.set(xscale="log", yscale="log", xlabel=words, ylabel=f"error of {name} (%)")
            panel.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            panel.xaxis.set_major_formatter("{x:g}")
            panel.xaxis.set_minor_formatter(NullFormatter())
            panel.grid(True, which="major", linewidth=0.4, color="0.8")
    panels[0][0].legend(frameon=False, fontsize=8)
    figure.suptitle(title, fontsize=10)
    for ending in ("png", "svg"):
        figure.savefig(f"{path}.{ending}", dpi=200)
    plt.close(figure)
