"""What each approximation of a run leaves of the error, as its summary says it: key `errors`."""
from .markup import is_number, joined, number, running, table, tag

COLUMNS = {"energy": "energy", "displacement": "displacement", "joint_stress": "joint stress", "points": "at POINTS", "cuts": "on CUTS", "sections": "on SECTIONS",
           "load": "load"}

# What stands before values of the whole that are not plain by their keys
SENTENCES = {"softness": "Softness, how many times faster than the load the displacement grew at last"}


def said_of(job):
    """What the summary of a run says of it; None if nothing. Without an equilibrium it means nothing, but where bodies
    yield it is of the last one."""
    bodies = job.summary.get("yielding")
    if isinstance(bodies, dict) and isinstance(bodies.get("errors"), dict):
        return bodies["errors"]
    found = job.summary.get("errors")
    return found if job.verdict == "converged" and isinstance(found, dict) else None


def known(job):
    """Whether the summary of a run says it."""
    return said_of(job) is not None


def errors(job):
    """Displacement and joint stress in all, in words, then all contributions as a table."""
    budget, seconds = said_of(job), job.summary.get("error_seconds")
    seconds = seconds if isinstance(seconds, dict) else {}
    shares = {source: share for source, share in budget.items() if isinstance(share, dict)}
    said = [_sentence(key, value) for key, value in budget.items() if not isinstance(value, dict) and value is not None]
    present = dict.fromkeys(key for share in shares.values() for key in share if share[key] is not None)
    keys = list(dict.fromkeys([*(key for key in COLUMNS if key in present), *present]))
    rows = [[words(source), *(_cell(share.get(key)) for key in keys), seconds.get(source)]
            for source, share in shares.items()]
    return joined([*said, table("Left by each approximation",
                                ["of", *(COLUMNS.get(key, words(key)) for key in keys), "seconds"], rows,
                                "Estimates, relative; – is not known.", named_rows=True), *_at_points(job), *_on_cuts(job), *_on_sections(job)])


def _at_points(job):
    """How far the displacement of each named point may be off, as a list of a table; an empty one without points."""
    found = [point for point in job.summary.get("point_errors") or [] if isinstance(point, dict)]
    sources = list(dict.fromkeys(key for point in found for key in point if key not in ("point", "name")))
    rows = [[point.get("name"), *(_cell(point.get(key)) for key in sources)] for point in found]
    return [table("Displacements of points", ["point", *map(words, sources)], rows,
                  "Largest round the circle, and how far it may be off, in all and by source [length]; – is not known.",
                  named_rows=True)] if rows else []


def _on_cuts(job):
    """How far the resultants on each cut may be off, as a list of a table; an empty one without cuts."""
    found = [cut for cut in job.summary.get("cut_errors") or [] if isinstance(cut, dict)]
    keys = list(dict.fromkeys(key for cut in found for key in cut if key != "cut"))
    rows = [[cut.get("cut"), *(_cell(cut.get(key)) for key in keys)] for cut in found]
    return [table("Resultants on cuts", ["cut", *map(words, keys)], rows,
                  "Whatever their angle, and how far each may be off, all sources together [length, force, force length]; "
                  "– is not known.", named_rows=True)] if rows else []


def _on_sections(job):
    """How far the stresses along each section may be off, as a list of a table; an empty one without sections."""
    found = [section for section in job.summary.get("section_errors") or [] if isinstance(section, dict)]
    sources = list(dict.fromkeys(key for section in found for key in section if key not in ("section", "points", "judged")))
    rows = [[section.get("section"), f"{section.get('judged')} of {section.get('points')}", *(_cell(section.get(key)) for key in sources)]
            for section in found]
    return [table("Stresses on sections", ["section", "points judged", *map(words, sources)], rows,
                  "Largest of the six stresses along it, round the circle, and how far it may be off, in all and by source [stress]; "
                  "points beside infinite stresses are not judged; – is not known.", named_rows=True)] if rows else []


def line(job):
    """Displacement and joint stress in all, in words; None if they are not known."""
    said = said_of(job).get("in_words") if known(job) else None
    return said if isinstance(said, str) else None


def _sentence(key, value):
    text = value if isinstance(value, str) else number(value) if is_number(value) else str(value)
    return tag("p", f"{SENTENCES.get(key, words(key).capitalize())}: ", tag("strong", running(text)))


def _cell(value):
    return value if is_number(value) else str(value)


def words(name):
    """A key as words."""
    return name.replace("_", " ")
