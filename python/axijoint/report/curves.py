"""Curves beside the view: their points for all increments, of which the page shows one."""
import numpy as np

from ..resultants import AXIAL, FORCE, MOMENT, along, direction, load_of

# Profiles across the load that are less than this share of those along it are not shown
SLIGHT = 1e-2
# A profile needs as many cuts of one body
LEAST_CUTS = 3


def curves(job, shown):
    """Curves of a job: a list for JSON.

    Each has a title, the titles of x and y, and lines: a name, x and y. Of a `history` these go through the
    increments; of a `profile` x has a list for each increment that the view shows.
    """
    history = job.result.history
    rows = [list(history.increment).index(k) for k in shown if k in history.increment]
    if len(rows) < len(shown):
        return []
    return [one for one in [_displacements(job), *_profiles(job, rows), _work(job)] if one]


def _number(values):
    return [float(f"{value:.6g}") for value in values]


def _at(theta):
    return f"θ = {theta:g}°"


def _unit(name, unit):
    return f"{name} [{unit}]" if unit else name


def _displacements(job):
    """Load against displacement of the named points: along the lateral load if that changes, along z if another does.

    Where no load changes, as where displacements are given, against what is the larger of both.
    """
    history, units, theta = job.result.history, job.units, direction(job.result.history)
    names = history.point_names if "points" in history else []
    if not names or len(history.increment) < 2:
        return None
    load_name, columns, load = load_of(history, theta)
    unit = "" if columns is None else units.force if columns in (AXIAL, FORCE) else units.moment
    points = np.array([history.point(name, theta) for name in names])
    lateral, vertical, _ = abs(points).max(axis=(0, 1))
    moved = 0 if columns in (FORCE, MOMENT) or columns is None and lateral > vertical else 1
    lines = [{"name": name, "x": _number(one[:, moved]), "y": _number(load)} for name, one in zip(names, points)]
    return {"kind": "history", "title": f"Load and displacement at {_at(theta)}",
            "x": _unit(f"{'uv'[moved]} at {_at(theta)}", units.length), "y": _unit(load_name, unit),
            "increments": history.increment.tolist(), "lines": lines}


def _profiles(job, rows):
    """Force, moment and motion along z of each body with several cuts, along the lateral load and, if anything is, across it."""
    result, units = job.result, job.units
    if not result.has("cuts/label"):
        return
    z, body = result.read("cuts/z"), result.read("cuts/body")
    cuts, motion, theta = result.history["cuts"][rows], result.history["cut_motion"][rows], direction(result.history)
    for number in np.unique(body):
        chosen = np.flatnonzero(body == number)
        if len(chosen) < LEAST_CUTS:
            continue
        chosen = chosen[np.argsort(z[chosen])]
        of = f" of body {number}" if number else ""
        # moments have the sign of the figure of a pile: they lean the part below that way, as a force there on the part above does
        for name, values, columns, unit in (("Shear force", cuts, FORCE, units.force), ("Moment", -cuts, MOMENT, units.moment),
                                            ("Axial force", cuts, AXIAL, units.force),
                                            ("Deflection", motion, FORCE, units.length)):
            for where, here in _ways(values[:, chosen], columns, theta):
                title = f"{name}{of}{where}"
                sense = ", leaning that way" if columns == MOMENT else ", tension positive" if columns == AXIAL else ""
                yield {"kind": "profile", "title": title, "x": _unit(f"{name.lower()}{sense}", unit), "y": _unit("z", units.length),
                       "lines": [{"name": title, "x": [_number(row) for row in here], "y": _number(z[chosen])}]}


def _ways(values, columns, theta):
    """Yield where in words, and values of resultants there: along theta, and across it what is not slight beside that."""
    if columns == AXIAL:
        found = [("", values[..., AXIAL])]
    else:
        found = [(f" at {_at(angle)}", along(values, columns, angle)) for angle in (theta, (theta + 90) % 180)]
    largest = max(abs(here).max() for _, here in found)
    for where, here in found:
        if np.ptp(here) > 0 and abs(here).max() > SLIGHT*largest:
            yield where, here


def _work(job):
    """Work, energy and dissipation by increment."""
    history, units = job.result.history, job.units
    if len(history.increment) < 2:
        return None
    lines = [{"name": name, "x": history.increment.tolist(), "y": _number(history[key])}
             for name, key in (("work", "work"), ("elastic energy", "energy"), ("dissipated", "dissipated"))]
    return {"kind": "history", "title": "Work and energy", "x": "increment", "y": _unit("work", units.moment),
            "increments": history.increment.tolist(), "lines": lines}
