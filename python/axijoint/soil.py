"""Soil reactions on a pile: what a one-dimensional model of it needs, from the joints round it.

The four reactions are those of the PISA method for monopiles (Burd et al., Geotechnique 70, 2020): distributed
lateral load p against the deflection v, distributed moment m against the rotation psi, base shear H_b
against v_b, base moment M_b against psi_b; and along the axis the shaft friction t and the base force V_b
against the settlement s.

Signs: reactions are what the pile exerts on the ground, so that they resist motions of their own sign. p, v
and H_b are positive along the direction asked for (theta); m, M_b, psi and psi_b where they lean the pile towards
it - the opposite of MOMENT of a deck and of moments in tables, which lift that side; t, V_b and s
downwards.
"""
import warnings
from dataclasses import dataclass

import numpy as np

from .resultants import AXIAL, FORCE, MOMENT, along
from .soil_joints import along_axis, joint_values, sides_of
from .table import Table


class NoShaftError(LookupError):
    """A body without joints along z, or bonded and without cuts, has no soil reactions."""


@dataclass
class SoilReactions:
    """Reactions by increment and by segment of the shaft, on which p, m and t are constant.

    body                   number of the pile's body
    theta                  direction of p, v and H_b [degree]
    source                 "joints" or "cuts"
    increment              numbers of the increments
    load_factor            sums of their load factors
    low, high              ends of the segments, (segments), from the lowest on
    p, m, t                resistance per length, (increments, segments)
    v, psi, s              motion of the pile at the middle of the segments, likewise
    v_relative, s_relative motion of the pile less that of the ground at the joints; nan from cuts
    base_z                 height of the base
    H_b, M_b, V_b          resistance of the base, (increments); zeros without joints across z
    v_b, psi_b, s_b        motion of the base
    """
    body: int
    theta: float
    source: str
    increment: np.ndarray
    load_factor: np.ndarray
    low: np.ndarray
    high: np.ndarray
    p: np.ndarray
    m: np.ndarray
    t: np.ndarray
    v: np.ndarray
    psi: np.ndarray
    s: np.ndarray
    v_relative: np.ndarray
    s_relative: np.ndarray
    base_z: float
    H_b: np.ndarray
    M_b: np.ndarray
    V_b: np.ndarray
    v_b: np.ndarray
    psi_b: np.ndarray
    s_b: np.ndarray

    @property
    def z(self):
        """Middles of the segments."""
        return (self.low + self.high)/2

    def totals(self):
        """Horizontal force and moment about the origin that all reactions add up to: (increments) each."""
        length = self.high - self.low
        return ((self.p*length).sum(axis=1) + self.H_b,
                ((self.m + self.p*self.z)*length).sum(axis=1) + self.M_b + self.H_b*self.base_z)

    def shaft_table(self):
        """A row for each increment and segment."""
        count, n = self.p.shape
        columns = {"increment": np.repeat(self.increment, n), "load_factor": np.repeat(self.load_factor, n),
                   "z_low": np.tile(self.low, count), "z_high": np.tile(self.high, count),
                   "z": np.tile(self.z, count), "theta": np.full(count*n, self.theta)}
        names = ("v", "p", "psi", "m", "s", "t", "v_relative", "s_relative")
        return Table(columns | {name: getattr(self, name).ravel() for name in names})

    def base_table(self):
        """A row for each increment."""
        names = ("v_b", "H_b", "psi_b", "M_b", "s_b", "V_b")
        return Table({"increment": self.increment, "load_factor": self.load_factor,
                      "z": np.full(len(self.increment), self.base_z), "theta": np.full(len(self.increment), self.theta)}
                     | {name: getattr(self, name) for name in names})


def soil_reactions(result, body=None, theta=0.0, increments=None, source=None):
    """Reactions of the ground on a body, from the joints round it or from cuts through it: SoilReactions.

    body: the pile; without it, of the bodies with interfaces the one that reaches least far from the axis.
    source: "joints": those along z are the shaft, those across z the base, what is inside and outside a
        tube is added up; "cuts": what the resultants on CUTS of the body differ by, loads on the pile and its weight
        between them included, and the lowest of them as the base. Without it, cuts where bodies are bonded to it.
        Joints alone leave out what goes through bonded interfaces, of which a warning tells.
    """
    body = pile_of(result) if body is None else body
    bonded = _bonded(result, body)
    source = _source(result, body, bonded) if source is None else source
    if source not in ("joints", "cuts"):
        raise ValueError(f"source is {source!r}; it may be 'joints' or 'cuts'")
    if source == "joints" and bonded:
        warnings.warn(f"{bonded} of body {body}: bonded; what goes through there is not in the reactions of the joints. "
                      f"source='cuts' has it, from CUTS of body {body}", stacklevel=2)
    if source == "joints" and not (along_axis(result.mesh) & (sides_of(result.mesh, body) != 0)).any():
        raise NoShaftError(f"body {body} has no joints along z")
    history = result.history
    numbers = history.increment if increments is None else np.asarray(increments)
    unknown = np.setdiff1d(numbers, history.increment)
    if len(unknown):
        raise ValueError(f"there is no increment {unknown[0]}; the file keeps {history.increment.tolist()}")
    if source == "joints":
        numbers = numbers[np.isin(numbers, history.increments_of("displacement"))]
    rows = np.searchsorted(history.increment, numbers)
    values = joint_values(result, body, theta, numbers, rows) if source == "joints" \
        else _cut_values(result, body, theta, rows)
    return SoilReactions(body, theta, source, numbers, history["load_factor"][rows], **values)


def _bonded(result, body):
    """Names of the interfaces that bond another body to this one, with commas between."""
    return ", ".join(one.name for one in result.interfaces if one.law is None and body in (one.body_a, one.body_b))


def _source(result, body, bonded):
    """Joints, unless an interface bonds another body to this one."""
    if not bonded:
        return "joints"
    if len(cuts_through(result, body)) < 2:
        raise NoShaftError(f"{bonded} of body {body}: bonded, and forces there are known from CUTS of "
                           f"body {body} alone; the deck has fewer than two")
    return "cuts"


def cuts_through(result, body):
    """The cuts (index) of a body, from the lowest on."""
    if not result.has("cuts/body"):
        return np.empty(0, int)
    rows = np.flatnonzero(result.read("cuts/body") == body)
    return rows[np.argsort(result.read("cuts/z")[rows], kind="stable")]


def _cut_values(result, body, theta, rows):
    """Segments between neighbouring cuts; p is constant on each."""
    cuts = cuts_through(result, body)
    if len(cuts) < 2:
        raise NoShaftError(f"the deck has fewer than two CUTS of body {body}")
    z = result.read("cuts/z")[cuts]

    def turned(values):  # axial, along theta, leaning
        return values[..., AXIAL], along(values, FORCE, theta), -along(values, MOMENT, theta)
    axial, shear, lean = turned(result.history["cuts"][rows][:, cuts])
    up, aside, turn = turned(result.history["cut_motion"][rows][:, cuts])
    length, middle = np.diff(z), (lambda values: (values[:, 1:] + values[:, :-1])/2)
    p = np.diff(shear, axis=1)/length
    m = np.diff(lean, axis=1)/length + shear[:, 1:] - p*length/2
    unknown = np.full(p.shape, np.nan)
    return {"low": z[:-1], "high": z[1:], "p": p, "m": m, "t": -np.diff(axial, axis=1)/length,
            "v": middle(aside), "psi": middle(turn), "s": -middle(up), "v_relative": unknown, "s_relative": unknown,
            "base_z": float(z[0]), "H_b": shear[:, 0], "M_b": lean[:, 0], "V_b": -axial[:, 0],
            "v_b": aside[:, 0], "psi_b": turn[:, 0], "s_b": -up[:, 0]}


def pile_of(result):
    """Number of the body with interfaces that reaches least far from the axis; of several the tallest."""
    mesh = result.mesh
    bodies = set(mesh.joint_bodies.ravel().tolist())
    bodies = sorted(bodies | {body for one in result.interfaces for body in (one.body_a, one.body_b)})
    if not bodies:
        raise NoShaftError("there are no interfaces")

    def reach(body):
        r, z = mesh.coordinates[mesh.element_nodes[mesh.element_body == body][:, :3]].reshape(-1, 2).T
        return r.max(), -np.ptp(z)
    return min(bodies, key=reach)
