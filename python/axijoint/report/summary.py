"""How a run ended, in large letters if it failed; its main numbers; its messages."""
from . import budget
from .extremes import extremes, joint_peaks
from .markup import Markup, joined, number, running, table, tag, with_unit

# Of each way to end: the word at the top, what it means
VERDICTS = {
    "converged": ("Converged", ""),
    "not_converged": ("NOT CONVERGED", "No equilibrium: what stands here is the last state of the iteration. Do not use "
                      "these numbers."),
    "mechanism": ("NOT CONVERGED: MECHANISM", "{what} cannot carry the load. What stands here is the last "
                  "equilibrium, of a smaller load."),
    "error": ("ERROR: NO RESULTS", "The run ended with an error; there are no results.")}


def mark(job):
    """What stands before the captions of a run that failed."""
    return {"not_converged": "NOT CONVERGED: ", "mechanism": "LAST EQUILIBRIUM BEFORE A MECHANISM: "}.get(job.verdict, "")


def suffix(job):
    """What stands behind the headings of a run that failed."""
    return {"not_converged": " – not converged", "mechanism": " – last equilibrium before a mechanism"}.get(
        job.verdict, "")


def verdict(job):
    """Box at the top of a run."""
    word, means = VERDICTS[job.verdict]
    means = means.format(what=_bearing(job))
    failed = job.verdict != "converged"
    parts = [tag("p", word if failed else _converged(job), class_="word")]
    if means:
        parts.append(tag("p", means, class_="means"))
    if job.verdict in ("mechanism", "not_converged"):
        parts += [tag("p", running(message)) for message in job.messages[:2]]
    if job.verdict == "error":
        parts.append(tag("p", "Deck ", tag("code", job.tags.get("deck") or ""), f", run of {job.tags.get('date')}, exit code "
                         f"{job.tags.get('exit_code')}."))
    parts += [tag("p", running(f"Warning: {note}")) for note in job.notes]
    warnings = len(job.messages)
    if warnings and not failed:
        parts.append(tag("p", f"{warnings} message{'s' if warnings > 1 else ''}: see “Messages”."))
    return tag("div", *parts, class_="status failed" if failed else "status")


def _bearing(job):
    """What bears the load up to where it yields: joints, bodies, or both."""
    bodies = isinstance(job.summary.get("yielding"), dict)
    return ("Bodies and joints" if len(job.result.mesh.joint_label) else "The bodies") if bodies else "The joints"


def _converged(job):
    path = job.result.convergence()
    if not path.rows:
        return "Converged (linear)"
    tolerance = job.result.attributes_of("convergence")["tolerance"]
    return f"Converged in {path.rows} iteration{'s' if path.rows > 1 else ''} (tolerance {number(tolerance)})"


def overview(jobs, names):
    """Several runs: which failed, and their main numbers in one table."""
    failed = [(job, name) for job, name in zip(jobs, names) if job.verdict != "converged"]
    parts = [tag("p", f"{name}: {VERDICTS[job.verdict][0]}", class_="word") for job, name in failed] or \
        [tag("p", f"All {len(jobs)} runs converged", class_="word")]
    box = tag("div", *parts, class_="status failed" if failed else "status")
    units = {(job.units.length, job.units.stress) for job in jobs if job.result}
    length, stress = units.pop() if len(units) == 1 else ("", "")
    head = ["run", "status", "iterations", "residual ratio", "part equilibrium error", with_unit("largest displacement", length),
            with_unit("largest pressure", stress), "open"]
    rows = [[name, VERDICTS[job.verdict][0], *_main_numbers(job)] for job, name in zip(jobs, names)]
    return joined([box, table("Overview", head, rows, named_rows=True)])


def _main_numbers(job):
    if job.result is None:
        return [None]*6
    joints = job.result.joints()
    peaks = joint_peaks(job.result) if joints.rows else {}
    opened = int((joints["state"] == "open").sum()) if joints.rows else None
    return [job.result.convergence().rows, job.result.attributes_of("convergence")["residual_ratio"],
            job.result.attributes_of("resultants")["part_equilibrium_error"], extremes(job.result)["length"][-1].value,
            peaks["pressure"].value if peaks and peaks["pressure"].value > 0 else None, opened]


def summary(job):
    """Main numbers of a run."""
    rows = [*_tags(job), *_model(job), *_outcome(job), *_cost(job)]
    return table("", ["", ""], [[name, value] for name, value in rows if value not in (None, "")], named_rows=True)


def _tags(job):
    tags, units = job.tags, job.units
    named = ", ".join(unit for unit in (units.force, units.length, units.stress) if unit)
    return [("title", job.title), ("deck", tag("code", tags.get("deck", ""))), ("run", tags.get("date")),
            ("program", f"{tags.get('program')} {tags.get('version')}"),
            ("load combination", str(job.combination) if job.combination else None),
            ("units", f"{named} (force, length, stress)" if named else "those of the deck, which does not name them")]


def _model(job):
    mesh, result = job.result.mesh, job.result
    equations = int(result.read("equations/number").sum())
    harmonics = sorted(set(int(m) for m in result.harmonic))
    families = " and ".join(name for number_, name in ((1, "symmetric"), (2, "antisymmetric"))
                            if (result.family == number_).any())
    planes = len(result.read("joints/planes")) if len(mesh.joint_label) else None
    return [("mesh", f"{len(mesh.coordinates)} nodes, {len(mesh.element_label)} elements, "
             f"{len(mesh.joint_label)} joints"),
            ("unknowns", f"{equations} of all harmonics together"),
            ("harmonics", f"{_ranges(harmonics)}, {families}"),
            ("planes of the joint law", str(planes) if planes else None),
            ("solver", job.summary.get("solver")), ("joint iteration", job.summary.get("method") if planes else None)]


def _ranges(numbers):
    """Numbers in words: 0 to 4, or 0, 3, 6."""
    if len(numbers) > 2 and numbers == list(range(numbers[0], numbers[-1] + 1)):
        return f"{numbers[0]} to {numbers[-1]}"
    return ", ".join(map(str, numbers))


def _outcome(job):
    result = job.result
    path, errors = result.attributes_of("convergence"), result.attributes_of("resultants")
    rows = [("status", VERDICTS[job.verdict][0]), ("state shown", job.state), ("iterations", str(result.convergence().rows or "none (linear)")),
            ("residual ratio", f"{number(path['residual_ratio'])} (tolerance {number(path['tolerance'])})"),
            ("equilibrium error", f"{number(errors['equilibrium_error'])} on the whole, "
             f"{number(errors['part_equilibrium_error'])} on the worst part")]
    other = job.summary.get("other_loop_difference")
    if other is not None:
        words = "from Newton's method" if job.summary.get("method") == "transfer" else \
            "that the transfer of stresses to 3 % would leave"
        rows.append(("joint stress, difference", f"{number(other)} of the largest, {words}"))
    rows.append(("errors", budget.line(job)))
    rows.append(("largest displacement", _at(extremes(result)["length"][-1], job.units.length)))
    joints = result.joints()
    if joints.rows:
        states = ", ".join(f"{int((joints['state'] == state).sum())} {state}" for state in ("stick", "slip", "open"))
        rows.append(("joint states", f"{states} (points times planes)"))
        units = {"pressure": job.units.stress, "gap": job.units.length}
        peaks = joint_peaks(result)
        rows += [(f"largest {name}", _at(peaks[name], unit)) for name, unit in units.items()]
        rows.append(("pressure at an edge of joints", _edge(job)))
    infinite = job.summary.get("singular")
    if infinite:
        rows.append(("infinite stresses", f"at {len(infinite)} node{'s' if len(infinite) > 1 else ''}: see “Largest values”"))
    return rows


def _edge(job):
    """Pressure at an edge of joints, beyond their last points, where it is larger than at these; None otherwise."""
    edge = job.summary.get("edge_pressure")
    if not isinstance(edge, dict):
        return None
    return (f"about {number(edge['value'])} {job.units.stress}".strip() + f" at r = {number(edge['r'])}, z = {number(edge['z'])}, "
            f"θ = {number(edge['theta'])}°, by a line through the points before it")


def _at(peak, unit):
    if peak.value <= 0:
        return "none"
    value = f"{number(peak.value)} {unit}".strip()
    return f"{value} at {peak.where}, r = {number(peak.r)}, z = {number(peak.z)}, θ = {number(peak.theta)}°"


def _cost(job):
    seconds = job.summary.get("seconds") or {}
    phases = ", ".join(f"{name} {value:.3f}" for name, value in seconds.items()
                       if name != "total" and isinstance(value, (int, float)))
    total, memory = seconds.get("total"), job.summary.get("peak_memory_mb")
    return [("time", f"{total:.3f} s ({phases})" if isinstance(total, (int, float)) else None),
            ("peak memory", f"{memory:.0f} MB" if isinstance(memory, (int, float)) else None)]


def _message(text):
    """A message; one of several lines keeps its columns, as carets point at cards."""
    return tag("pre", text) if "\n" in text else running(text)


def messages(job):
    """Warnings, remarks, how the iteration ended; after an error its causes."""
    if not job.messages:
        return tag("p", "None.")
    return Markup(f'<ul class="messages">\n{joined(tag("li", _message(message)) for message in job.messages)}\n</ul>')
