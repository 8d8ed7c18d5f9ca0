"""Makes the gallery: eleven jobs, a picture of each, and results beside a calculation by hand.

    scripts/gallery            writes doc/gallery.md and doc/pictures/gallery_NAME.png
    scripts/gallery --check    runs the jobs, compares with the hand calculations, and says what is out of date

The page keeps a digest of each deck and of what draws it: with another, the picture is out of date.
"""
import hashlib
import pathlib
import re
import sys

import numpy as np

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1])]
import axijoint  # noqa: E402
from axijoint.sweep import Sweep  # noqa: E402
from axijoint.units import Units  # noqa: E402
import zone_in_space  # noqa: E402
from gallery_jobs import JOBS  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE, PICTURES = ROOT/"doc/gallery.md", ROOT/"doc/pictures"
# Largest displacement in the picture, of the extent
SHOWN_SIZE = 1/20
HEAD = """# Gallery

Eleven jobs, each from its deck by one command, `scripts/run DECK -o out`; `scripts/plot`, `scripts/report` and
[Python](../python/README.md) show more of them. The pictures are the meridional planes θ = 0 (right) and 180 degrees (left),
displacements enlarged. `scripts/gallery` makes this page and its pictures; its numbers are compared with calculations by hand, and a test
fails if one is further off than it may be, or if the page is not that of the decks.
"""


def name_of(job):
    """What a colour shows, for the picture."""
    return {"u": "displacement along x", "sigma_z": "σ_z", "sigma_theta": "σ_θ", "tau_rz": "τ_rz"}[job.colour]


def draw(result, job, path):
    """The two planes, deformed and coloured."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    whole = result
    if job.increment:
        result = result.at(job.increment)
    sweep, units = Sweep(result), Units(result.title, result.deck)
    cells = [corners for _, corners in sweep.cells()]
    triangles = np.concatenate([corners[:, [0, k, k + 1]] for corners in cells for k in range(1, corners.shape[1] - 1)])
    moved = sweep.at(sweep.displacement, (0.0, 180.0))
    extent = np.ptp(sweep.position, axis=0).max()
    factor = float(f"{SHOWN_SIZE*extent/np.sqrt((moved**2).sum(-1)).max():.1g}")
    figure, axes = plt.subplots(1, 2 if job.curve else 1, figsize=(9.2 if job.curve else 6.4, 4.4), layout="constrained",
                                squeeze=False)
    if job.curve:
        job.curve(axes[0, 1], whole, units)
    axes = axes[0, 0]
    planes, values = [], []
    for side, plane in zip((1, -1), (0, 1)):
        place = sweep.position + factor*moved[plane, :, :2]
        planes.append(place*(side, 1))
        values.append(moved[plane, :, 0]*side if job.colour == "u" else
                      sweep.at(sweep.stress, (180.0*plane,))[0, :, axijoint.STRESSES.index(job.colour)])
    low, high = np.percentile(np.concatenate(values), (0.5, 99.5)) if job.colour != "u" else \
        (min(map(np.min, values)), max(map(np.max, values)))
    levels = np.linspace(low, high if high > low else low + 1, 17)
    for place, value in zip(planes, values):
        shown = axes.tricontourf(*place.T, triangles, np.clip(value, levels[0], levels[-1]), levels=levels, cmap="viridis")
        outlines(axes, result, sweep, place)
    axes.set_aspect("equal")
    unit = units.length if job.colour == "u" else units.stress
    figure.colorbar(shown, ax=axes, label=name_of(job) + (f" [{unit}]" if unit else ""), shrink=0.9)
    axes.set(xlabel=f"r [{units.length}]" if units.length else "r", ylabel=f"z [{units.length}]" if units.length else "z",
             title=f"displacements × {factor:g}")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def outlines(axes, result, sweep, place):
    """Outlines of the bodies."""
    mesh = result.mesh
    for body in np.unique(mesh.element_body):
        for element, nodes in mesh.boundary(np.flatnonzero(mesh.element_body == body)).values():
            if (mesh.coordinates[nodes, 0] > 0).any():
                local = [int(np.flatnonzero(mesh.element_nodes[element] == node)[0]) for node in nodes]
                axes.plot(*place[sweep.places[element, local]].T, color="black", linewidth=0.5)


def digest(job):
    """Of the deck, the job and what draws it."""
    parts = [(ROOT/job.deck).read_bytes(), repr((job.told, job.colour, job.increment, job.zone)).encode(),
             *(pathlib.Path(__file__).with_name(name).read_bytes() for name in
               ("make_gallery.py", "gallery_jobs.py", *(["zone_in_space.py"] if job.zone else [])))]

    return hashlib.sha256(b"\0".join(parts)).hexdigest()[:16]


def solved(job):
    """Its Result."""
    return axijoint.run_combinations(ROOT/job.deck, threads=1)[job.combination]


def rows(name, job, result):
    """Rows of the table of a job, and what is further off than it may be."""
    lines, faults = ["| | found | by hand | apart | may be |", "|---|---|---|---|---|"], []
    for what, found, wanted, allowed in job.check(result):
        apart = abs(found - wanted)/abs(wanted)
        if not apart <= allowed:
            faults.append(f"{name}: {what}: found {found:g}, by hand {wanted:g}, {apart:.1e} apart")
        told = f"{100*apart:.2g} %" if apart > 1e-6 else "below 1E-6"
        lines.append(f"| {what} | {found:.5g} | {wanted:.5g} | {told} | {f'{100*allowed:g} %' if allowed > 1e-6 else '1E-6'} |")
    return lines, faults


def page(pictures):
    """Text of the page, and faults; pictures are drawn on the way if they are wanted."""
    parts, faults = [HEAD], []
    for name, job in JOBS.items():
        result = solved(job)
        lines, wrong = rows(name, job, result)
        faults += wrong
        if pictures:
            (zone_in_space.draw if job.zone else draw)(result, job, PICTURES/f"gallery_{name}.png")
        note = " ".join(job.check.__doc__.split())
        parts.append("\n".join([f"## {job.told}", "", f"`{job.deck}` <!-- {digest(job)} -->", "",
                                f"![{job.told}](pictures/gallery_{name}.png)", "", note, "", *lines, ""]))
    return "\n".join(parts), faults


def main():
    """Make or check it; the exit code."""
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        sys.exit(__doc__)
    text, faults = page(pictures=not check)
    if check:
        kept = PAGE.read_text(encoding="utf-8") if PAGE.exists() else ""
        if kept != text:
            differ = [line for line in text.splitlines() if line not in kept.splitlines()]
            faults.append("doc/gallery.md is out of date, make it by scripts/gallery:\n  " + "\n  ".join(differ[:5]))
        missing = [found for found in re.findall(r"pictures/\w+\.png", text) if not (ROOT/"doc"/found).exists()]
        faults += [f"doc/{found} is missing" for found in missing]
    elif not faults:
        PAGE.write_text(text, encoding="utf-8")
        print(PAGE)
    print("\n".join(faults) or "gallery: eleven jobs agree with the calculations by hand", file=sys.stderr if faults else sys.stdout)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
