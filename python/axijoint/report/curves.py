"""Curves beside the view: their points for all increments, of which the page shows one."""
import numpy as np

# Resultants as they are stored, and what a cut calls them
LATERAL, MOMENT, AXIAL = 1, 2, 0
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


def _unit(name, unit):
    return f"{name} [{unit}]" if unit else name


def _displacements(job):
    """Load against displacement of the named points, along the load that changes most."""
    history, units = job.result.history, job.units
    names = history.point_names if "points" in history else []
    if not names or len(history.increment) < 2:
        return None
    applied = history["applied"]
    lateral = np.ptp(applied[:, LATERAL]) > 0
    load = applied[:, LATERAL if lateral else AXIAL]
    what, y = ("u at θ = 0", "lateral load") if lateral else ("v at θ = 0", "axial load")
    if np.ptp(load) == 0:
        load, y, unit = history["load_factor"], "load factor", ""
    else:
        unit = units.force
    lines = [{"name": name, "x": _number(history.point(name)[:, 0 if lateral else 1]), "y": _number(load)} for name in names]
    return {"kind": "history", "title": "Load and displacement", "x": _unit(what, units.length), "y": _unit(y, unit),
            "increments": history.increment.tolist(), "lines": lines}


def _profiles(job, rows):
    """Force, moment and motion along z of each body with several cuts."""
    result, units = job.result, job.units
    if not result.has("cuts/label"):
        return
    z, body = result.read("cuts/z"), result.read("cuts/body")
    cuts, motion = result.history["cuts"][rows], result.history["cut_motion"][rows]
    for number in np.unique(body):
        chosen = np.flatnonzero(body == number)
        if len(chosen) < LEAST_CUTS:
            continue
        chosen = chosen[np.argsort(z[chosen])]
        of = f" of body {number}" if number else ""
        for title, values, column, unit in ((f"Shear force{of}", cuts, LATERAL, units.force),
                                            (f"Moment{of}", cuts, MOMENT, units.moment),
                                            (f"Axial force{of}", cuts, AXIAL, units.force),
                                            (f"Deflection{of}", motion, LATERAL, units.length)):
            if np.ptp(values[:, chosen, column]) > 0:
                yield {"kind": "profile", "title": title, "x": _unit(title.split(" of")[0].lower(), unit),
                       "y": _unit("z", units.length),
                       "lines": [{"name": title, "x": [_number(row) for row in values[:, chosen, column]],
                                  "y": _number(z[chosen])}]}


def _work(job):
    """Work, energy and dissipation by increment."""
    history, units = job.result.history, job.units
    if len(history.increment) < 2:
        return None
    lines = [{"name": name, "x": history.increment.tolist(), "y": _number(history[key])}
             for name, key in (("work", "work"), ("elastic energy", "energy"), ("dissipated", "dissipated"))]
    return {"kind": "history", "title": "Work and energy", "x": "increment", "y": _unit("work", units.moment),
            "increments": history.increment.tolist(), "lines": lines}
