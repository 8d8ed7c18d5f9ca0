"""The view in three dimensions: what the page holds of a job, and the elements that show it.

The page has the amplitudes of the harmonics at section points, as integers of 16 bits with a scale; `view.js` sums
them round the circle and draws with plotly. Of sections with many elements only corner nodes are held, of
jobs with more data than LARGEST fewer increments, and at last no stresses; the page says so.
"""
import base64
import json
import pathlib

import numpy as np

from ..components import STRESSES
from ..joint_points import JointPoints
from ..result import STATES
from ..sweep import Sweep
from .curves import curves
from .markup import Markup, escaped, joined, tag

# Bytes of data of all jobs of a page; base64 takes a third more, plotly 4.8 million
LARGEST = 6_000_000
# Sections of more elements are shown by their corner nodes
MOST_WHOLE = 2500
# Modes whose amplitudes of all increments are smaller, of the largest of any, are left out
LEAST_MODE = 1e-5
# Joint quantities: what they are called, and the colours of states
JOINT_VALUES = ("state", "pressure", "shear stress", "gap", "slip")


class Section:
    """Points of the section, its cells and its outlines, in full or by corner nodes alone."""

    def __init__(self, result):
        sweep, mesh = Sweep(result), result.mesh
        self.result, self.sweep, self.whole = result, sweep, len(mesh.element_size) <= MOST_WHOLE
        self.bodies = [self._body(int(body)) for body in np.unique(mesh.element_body)]
        used = np.unique(np.concatenate([np.concatenate([one["cells"].ravel(), one["edges"].ravel()])
                                         for one in self.bodies]))
        renumbered = np.zeros(len(sweep.position), int)
        renumbered[used] = np.arange(len(used))
        for one in self.bodies:
            one["cells"], one["edges"] = renumbered[one["cells"]], renumbered[one["edges"]]
        self.points = used

    def _body(self, body):
        mesh, places = self.result.mesh, self.sweep.places
        chosen = np.flatnonzero(mesh.element_body == body)
        if self.whole:
            cells = [corners for _, corners in self.sweep.cells(chosen)]
        else:
            cells = [places[group, :3 if size in (3, 6) else 4] for size, group in mesh.groups(chosen)]
        triangles = [corners[:, [0, k, k + 1]] for corners in cells for k in range(1, corners.shape[1] - 1)]
        edges = []
        for element, nodes in mesh.boundary(chosen).values():
            if (mesh.coordinates[nodes, 0] <= 0).all():
                continue
            place = dict(zip(mesh.element_nodes[element].tolist(), places[element].tolist()))
            line = [place[int(node)] for node in nodes]
            if len(line) == 3:  # first, middle, last
                line = line if self.whole else line[::2]
            edges += list(zip(line[:-1], line[1:]))
        return {"body": body, "cells": np.concatenate(triangles), "edges": np.array(edges)}


def data(job, largest=LARGEST):
    """What the page holds of a job: a dictionary for JSON, and notes on what is left out."""
    result = job.result
    section = Section(result)
    history = result.history
    kept = [int(k) for k in history.increments_of("displacement")]
    stressed = {int(k) for k in history.increments_of("stress")}
    size = np.max([np.linalg.norm(result.at(k).displacement_amplitude, axis=-1).max(-1) for k in kept], axis=0)
    modes = np.flatnonzero(size >= LEAST_MODE*size.max(initial=0))
    points = len(section.points)
    shown, with_stress, notes = _within(kept, stressed, points*len(modes), largest)
    if not section.whole:
        notes.append("the section is shown by the corner nodes of its elements")
    views = {k: result.at(k) for k in shown}
    found = {"increments": shown, "factors": [float(history["load_factor"][list(history.increment).index(k)])
                                              if k in history.increment else None for k in shown],
             "harmonic": result.harmonic[modes].tolist(), "family": result.family[modes].tolist(), "bodies": [],
             "units": {"length": job.units.length, "stress": job.units.stress}, "stresses": list(STRESSES),
             "points": points, "position": exact(section.sweep.position[section.points]), "u": [], "s": []}
    for k, view in views.items():
        at = Sweep(view)
        found["u"].append(packed(at.displacement[modes][:, section.points]))
        found["s"].append(packed(at.stress[modes][:, section.points]) if k in with_stress else None)
    for one in section.bodies:
        found["bodies"].append({"body": one["body"], "cells": numbers(one["cells"]), "edges": numbers(one["edges"])})
    found["joints"] = _joints(result, views, modes)
    found["curves"] = curves(job, shown)
    return found, notes


def _within(kept, stressed, amplitudes, largest):
    """Increments that are shown, those with stresses, and notes, so that the data are not too many."""
    notes, with_stress = [], [k for k in kept if k in stressed]
    left = largest//2 - 6*amplitudes*len(with_stress)
    if left < 3*amplitudes:
        with_stress, left = with_stress[-1:], largest//2 - 6*amplitudes
    if left < 3*amplitudes:
        with_stress, left = [], largest//2
        notes.append("stresses are left out, as they are too many")
    number = max(1, min(len(kept), left//max(3*amplitudes, 1)))
    places = np.unique(np.round(np.linspace(len(kept) - 1, 0, number)).astype(int))
    shown = [kept[k] for k in places]
    if len(shown) < len(kept):
        notes.append(f"{len(shown)} of {len(kept)} increments are shown, as the others are too many data")
    return shown, set(with_stress) & set(shown), notes


def _joints(result, views, modes):
    """Joints: their ends, side 1-2, with amplitudes there; their points on planes with what was found."""
    mesh, points = result.mesh, JointPoints(result)
    if not len(points.owner):
        return None
    ends = mesh.joint_nodes[:, :2]
    kept = set(result.history.increments_of("joints").tolist())
    found = {"planes": points.part().theta.tolist(), "mirrored": points.half,
             "position": exact(mesh.coordinates[ends].reshape(-1, 2)), "count": len(ends),
             "points": np.bincount(points.owner, minlength=len(ends)).tolist(), "u": [], "values": [],
             "names": list(JOINT_VALUES), "states": list(map(str, STATES))}
    for k, view in views.items():
        found["u"].append(packed(view.displacement_amplitude[modes][:, ends.ravel()]))
        if k not in kept:
            found["values"].append(None)
            continue
        field = JointPoints(view).part()
        values = field.state, np.maximum(-field.sigma, 0), field.tau, field.gap, field.slip
        found["values"].append([packed(one) for one in values])
    return found


def packed(values):
    """Reals as integers of 16 bits: a scale and base64, little-endian."""
    values = np.asarray(values, float)
    scale = float(abs(values).max(initial=0))/32767 or 1.0
    return {"scale": scale, "data": base64.b64encode(np.round(values/scale).astype("<i2").tobytes()).decode("ascii")}


def exact(values):
    """Reals of 32 bits, for places: thin walls lie far from the axis."""
    return base64.b64encode(np.ascontiguousarray(values, "<f4").tobytes()).decode("ascii")


def numbers(values):
    """Numbers of points: base64 of integers of 32 bits."""
    return base64.b64encode(np.ascontiguousarray(values, "<u4").tobytes()).decode("ascii")


def element(job, identifier, largest=LARGEST):
    """The view of a job: what shows it, and its data."""
    found, notes = data(job, largest)
    words = "Turn it with the mouse or a finger."
    if notes:
        words += " " + "; ".join(notes).capitalize() + "."
    text = json.dumps(found, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    return joined([tag("div", class_="view", id=f"{identifier}-shown", data_view=f"{identifier}-data"),
                   tag("p", words, class_="note"), tag("noscript", tag("p", "The view needs JavaScript.")),
                   Markup(f'<script type="application/json" id="{escaped(identifier)}-data">{text}</script>')])


def scripts():
    """plotly, whole, and what draws the views: elements at the end of the page."""
    import plotly
    library = (pathlib.Path(plotly.__file__).parent/"package_data/plotly.min.js").read_text(encoding="utf-8")
    own = (pathlib.Path(__file__).parent/"view.js").read_text(encoding="utf-8")
    return Markup("\n".join("<script>" + text.replace("</script", "<\\/script") + "</script>" for text in (library, own)))
