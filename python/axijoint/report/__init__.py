"""A page of HTML about a run: one file that opens offline in any browser.

    from axijoint import report
    report.write(report.page(report.jobs_of("out/case3")), "case3.html")

`python -m axijoint.report NAME` does the same. Figures need matplotlib, the view in three dimensions plotly.
"""
import os
import pathlib

from . import budget, summary, tables, view
from .job import Failure, Job, jobs_of
from .look import CSS
from .markup import Markup, escaped, joined, tag

__all__ = ["Failure", "Job", "jobs_of", "page", "write"]

# Rows of a deck that are shown at its beginning and at its end
SHOWN_CARDS = 1000


def page(jobs, figures=True, views=False):
    """The page of one Job, or of several, one after the other: HTML.

    figures: whether it has the figures; views: whether it has a view to turn of each job, with plotly
    """
    several = len(jobs) > 1
    first = jobs[0]
    heading = first.title if not several or len({job.title for job in jobs}) == 1 else "Several runs"
    word = next((summary.VERDICTS[job.verdict][0] for job in jobs if job.verdict != "converged"), None)
    parts = [tag("p", f"Report of axijoint {first.tags.get('version', '')}", class_="sort"), tag("h1", heading)]
    parts += [summary.overview(jobs, names(jobs))] if several else [summary.verdict(first)]
    parts.append(contents(jobs, figures, views))
    same_deck = several and len({job.result.deck if job.result else None for job in jobs}) == 1
    parts += [chapter(job, name, several, figures, not same_deck, views and view.LARGEST//len(jobs)) for job, name in zip(jobs, names(jobs))]
    if same_deck and first.result:
        parts.append(tag("section", tag("h2", "Deck"), deck(first), id="deck"))
    parts.append(tag("footer", tag("p", f"Made by axijoint from {', '.join(job.name for job in jobs)}.")))
    if views:
        parts.append(view.scripts())
    title = f"{word}: {heading}" if word else heading
    head = tag("head", tag("meta", charset="utf-8"), "\n",
               tag("meta", name="viewport", content="width=device-width, initial-scale=1"), "\n",
               tag("title", title), "\n", Markup(f"<style>\n{CSS}\n</style>"))
    return f"<!DOCTYPE html>\n<html lang=\"en\">\n{head}\n<body>\n<main>\n{joined(parts)}\n</main>\n</body>\n</html>\n"


def names(jobs):
    """Short names of jobs: combinations of one deck, or files."""
    if len({job.tags.get("deck") for job in jobs}) == 1 and all(job.combination for job in jobs):
        return [f"Combination {job.combination}" for job in jobs]
    return [job.name for job in jobs]


def sections(job, figures, views):
    """Identifier, heading and function of each section that a job has."""
    if job.result is None:
        return [("messages", "Messages", summary.messages)]
    tabular = lambda function: lambda job: joined(function(job))  # noqa: E731
    found = [("summary", "Summary", summary.summary), ("messages", "Messages", summary.messages),
             ("errors", "Error budget", budget.errors)]
    if views:
        found.append(("view", "View", lambda job: view.element(job, f"{job.name.replace(' ', '_')}-view", views)))
    if figures:
        found.append(("figures", "Figures", _pictures))
    found += [("largest", "Largest values", tabular(tables.largest)),
              ("points", "Points", tabular(tables.points)),
              ("equilibrium", "Resultants and equilibrium", tabular(tables.equilibrium)),
              ("materials", "Materials", tabular(tables.materials)), ("laws", "Joint laws", tabular(tables.laws)),
              ("loads", "Loads", tabular(tables.loads)), ("increments", "Increments", tabular(tables.increments)),
              ("yielding", "Yielding", tabular(tables.yielding)),
              ("harmonics", "Harmonics", tabular(tables.equations)), ("sections", "Sections", tabular(tables.sections))]
    present = {"laws": len(job.result.mesh.law_label), "sections": len(job.result.section_numbers),
               "points": "points" in job.result.history and len(job.result.history.point_names) > 0,
               "errors": budget.known(job), "yielding": isinstance(job.summary.get("yielding"), dict)}
    return [one for one in found if present.get(one[0], True)]


def _pictures(job):
    from .pictures import pictures
    return pictures(job, summary.mark(job))


def identifier(job, name, several):
    """Identifier of a section in the page."""
    return f"{escaped(job.name.replace(' ', '_'))}-{name}" if several else name


def contents(jobs, figures, views):
    """Table of contents."""
    several = len(jobs) > 1
    rows = []
    for job, name in zip(jobs, names(jobs)):
        links = [tag("li", tag("a", title, href=f"#{identifier(job, key, several)}"))
                 for key, title, _ in sections(job, figures, views)]
        rows += [tag("li", tag("a", name, href=f"#{identifier(job, 'job', True)}"), tag("ul", *links))] \
            if several else links
    rows.append(tag("li", tag("a", "Deck", href="#deck"))) if _has_one_deck(jobs) else None
    return tag("nav", tag("strong", "Contents"), tag("ul", *rows), aria_label="Contents")


def _has_one_deck(jobs):
    decks = {job.result.deck if job.result else None for job in jobs}
    return len(decks) == 1 and None not in decks


def chapter(job, name, several, figures, with_deck, views=0):
    """All sections of one job."""
    found = []
    level = "h3" if several else "h2"
    if several:
        found += [tag("h2", name), tag("p", job.title), summary.verdict(job)]
    for key, title, function in sections(job, figures, views):
        found.append(tag("section", tag(level, f"{title}{summary.suffix(job)}"), function(job),
                         id=identifier(job, key, several), class_={"sections": "many", "view": "view-section"}.get(key)))
    if with_deck and job.result:
        found.append(tag("section", tag(level, "Deck"), deck(job), id=identifier(job, "deck", several)))
    return tag("article", *found, class_="job", id=identifier(job, "job", True) if several else None)


def deck(job):
    """Cards of the deck; of a long one its beginning and its end."""
    lines = job.result.deck.rstrip("\n").split("\n")
    left_out = len(lines) - 2*SHOWN_CARDS
    if left_out > 0:
        lines = [*lines[:SHOWN_CARDS], f"⋮ {left_out} lines left out; all are in the listing", *lines[-SHOWN_CARDS:]]
    return joined([tag("p", "As read, included files in place: ", tag("code", job.tags.get("deck", ""))),
                   tag("pre", "\n".join(lines))])


def write(text, path):
    """Write a page under its name only when it is complete."""
    path = pathlib.Path(path)
    part = path.with_name(f"{path.name}.{os.getpid()}.tmp")
    try:
        part.write_text(text, encoding="utf-8")
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
