"""What a result file keeps of increments (`/history`, doc/results.md)."""
import re

import numpy as np

from . import circle
from .table import Table

# Amplitudes of what /joints/jump has on planes
JUMPS = "joint_amplitude"
# Datasets of the end of the run: that of /history with the same by increment, and the numbers of these increments
KEPT = {"displacement": ("displacement", "displacement_increment"),
        "reaction": ("reaction", "displacement_increment"),
        "joints/jump": (JUMPS, "joint_increment"),
        "joints/stress": ("joint_stress", "joint_increment"),
        "joints/state": ("joint_state", "joint_increment"),
        "stress/amplitude": ("stress", "stress_increment"),
        "stress/nodal": ("nodal_stress", "stress_increment"),
        "cuts/resultants": ("cuts", "increment"), "cuts/motion": ("cut_motion", "increment"),
        "supports/reacted": ("supports", "increment"),
        "resultants/applied": ("applied", "increment"), "resultants/reacted": ("reacted", "increment")}
SECTION = re.compile(r"sections/\d+/(displacement|stress)")
# What there is of the end of the run alone, and groups with such attributes
OF_THE_END = re.compile(r"(error|errors)(/|$)|yield/(plastic_strain|active|equivalent|margin|stress|dissipation|"
                        r"failing_displacement|error_load|error_displacement)$")
ATTRIBUTES_OF_THE_END = ("error", "errors", "resultants", "convergence", "yield")
# What is kept by the root of a name, in words, and cards of KEEP that keep more
WORDS = {"displacement": "displacements", "reaction": "reactions", "stress": "stresses"}
CARDS = {"displacement": "DISPLACE", "reaction": "DISPLACE", "joints": "JOINTS", "stress": "STRESSES"}
COLUMNS = ("increment", "load_factor", "equilibrium", "iterations", "residual", "n_slip", "n_open",
           "largest_displacement", "largest_pressure", "largest_shear", "work", "energy", "dissipated")


class NotKeptError(LookupError):
    """Something of an increment that the file does not keep."""


class History:
    """Series by increment; read when they are asked for, and kept.

    history["work"]            any dataset of /history, as stored: the first axis is the increment; of a group
                               history["points/position"]
    history.names              names of these datasets and groups
    history.increment          numbers of the increments, (increments); of what else is kept
                               of some increments alone, history.increments_of("displacement"), ...
    history.point_names        names of the points of POINTS
    history.joint_resultants   (increments, joints, 6), in the order of mesh.joint_label
    """

    def __init__(self, result):
        self._result = result
        self._read = {}

    def __getitem__(self, name):
        if name not in self._read:
            self._read[name] = self._result.read(f"history/{name}")
        return self._read[name]

    def __contains__(self, name):
        return self._result.has(f"history/{name}")

    def __repr__(self):
        return f"History of {len(self.increment)} increments: {', '.join(self.names)}"

    @property
    def names(self):
        """Names of the datasets and groups."""
        return self._result.names_in("history")

    @property
    def increment(self):
        """Numbers of the increments that series are kept of."""
        return self["increment"]

    @property
    def known(self):
        """Numbers of the increments that series or fields are kept of, ascending: those that `Result.at` takes."""
        return np.unique(np.concatenate([self.increment, *map(self.increments_of, ("displacement", "joints", "stress"))]))

    def increments_of(self, what):
        """Numbers of the increments that `displacement`, `joints` or `stress` is kept of, the last included."""
        dataset = {"joints": "joint_increment"}.get(what, f"{what}_increment")
        return self[dataset] if dataset in self else self.increment[-1:]

    def table(self):
        """Table of the increments: load factor, iterations, residual, joint states, work and energy."""
        return Table((name, self[name]) for name in COLUMNS)

    @property
    def joint_resultants(self):
        """What the body at side 4-3 exerts on that at side 1-2, joint by joint: (increments, joints, 6).

        Axial force, lateral force, moment, torque, lateral force and moment at 90 degrees; moments are
        about r = 0 at the mean z of nodes 1 and 2.
        """
        return self["joint_resultants"]

    def interface(self, wanted):
        """Sum of the joint resultants of an interface (name or number), (increments, 6).

        What body b exerts on body a; moments about the origin.
        """
        return joint_sums(self._result, np.concatenate([one.joints for one in self._result.interfaces_of(wanted)]))

    @property
    def point_names(self):
        """Names of the points of POINTS, in their order."""
        names = self._result.attributes_of("history/points")["names"].splitlines()
        return names[:len(self["points/label"])]

    def point(self, name, theta=0.0, cartesian=False):
        """Displacements u, v, w of a named point, or that of a number, at an angle: (increments, 3).

        cartesian: x, y, z in place of r, z, theta.
        """
        total = circle.totals(np.moveaxis(self["points/displacement"], 1, 0)[:, :, self._point(name)],
                              self._result.harmonic, self._result.family,
                              np.full(len(self["points/displacement"]), float(theta)))
        return circle.cartesian_displacement(total, np.full(len(total), float(theta))) if cartesian else total

    def point_position(self, name):
        """r and z of a named point."""
        return self["points/position"][self._point(name)]

    def _point(self, name):
        names, labels = self.point_names, self["points/label"].tolist()
        if name in names:
            return names.index(name)
        if name in labels:
            return labels.index(name)
        raise ValueError(f"there is no point {name!r}; there is {', '.join(names) or 'none'}")


def joint_sums(result, joints):
    """Sum of the resultants of some joints (index), moments about the origin: (increments, 6)."""
    mesh = result.mesh
    part = result.history.joint_resultants[:, joints].copy()
    height = mesh.coordinates[mesh.joint_nodes[joints, :2], 1].mean(axis=1)
    part[..., 2] -= part[..., 1]*height
    part[..., 5] -= part[..., 4]*height
    return part.sum(axis=1)


def place_of(file, name, increment):
    """Where a dataset of an increment is in the file: the name, and the row of it.

    What does not change from increment to increment is where it always is.
    """
    last = int(file["history/increment"][-1])
    if increment == last:
        return name, ()
    if OF_THE_END.match(name):
        raise NotKeptError(f"/{name} is of increment {last}, the last, alone")
    kept, numbers = KEPT.get(name, (None, None))
    if SECTION.fullmatch(name):
        kept, numbers = name, "increment"
    if kept is None:
        return name, ()
    numbers = file[f"history/{numbers}"][()].tolist() if f"history/{numbers}" in file else [last]
    if increment in numbers:
        return f"history/{kept}", numbers.index(increment)
    root = name.split("/")[0]
    more = f"; a card of KEEP keeps more: `{CARDS[root]} ALL`" if root in CARDS else ""
    raise NotKeptError(f"{WORDS.get(root, root)} of increment {increment} are not kept, only those of "
                       f"{', '.join(map(str, numbers))}{more}")
