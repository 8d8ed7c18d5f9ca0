"""Figures of a job inside the page: data of their own, captions, descriptions in words."""
import base64
import io
import re

import numpy as np

from ..resultants import direction
from ..result import STATES
from .extremes import extremes, joint_peaks
from .markup import Markup, joined, number, running, tag
from .tables import without_rounding

# A vector figure of more bytes than this is put in as pixels
LARGEST_SVG = 400_000
PIXELS_PER_INCH = 200
# Pixels of a page of HTML per inch
PAGE_PIXELS_PER_INCH = 96
# Figures up to this width stand side by side [pixel]
NARROW = 600
NAMES = {"displacement": "Length of the displacement", "sigma_r": "Radial stress σ_r", "sigma_z": "Axial stress σ_z",
         "sigma_theta": "Hoop stress σ_θ", "tau_rz": "Shear stress τ_rz", "tau_rtheta": "Shear stress τ_rθ",
         "tau_ztheta": "Shear stress τ_zθ"}
# Kinds of figures of one direction, or of the planes along it
ALONG_THE_LOAD = ("deformed", "contours", "yielding", "points", "pile", "py", "tz", "pisa")
# Figures of bodies that yield: caption, and in words what it shows
YIELDING = {
    "yielding": ("Yielding", "{planes}: the largest equivalent plastic strain in each element."),
    "yielding_unrolled": ("Yield margin", "The share of the strength that is left, over θ and z, round the circle of the point "
                          "with the largest plastic strain; black line: the edge of what has yielded."),
    "dissipation": ("Dissipation", "{planes}: the largest work per volume that plastic strain "
                    "dissipated in each element in the last increment. Near a limit load it shows where the mechanism shears."),
    "mechanism": ("Mechanism", "{planes}: what the step moved that found no equilibrium, "
                  "enlarged; dashed: at rest.")}


def pictures(job, mark):
    """All figures of a job, each with what it is called, shows and says in words: HTML.

    mark: put before each caption, so that a figure that is cut out still says that its run failed.
    """
    from .. import plot
    shown = []
    for name, figure in _figures(job.result, plot):
        caption, words = describe(job, name)
        source, width, height = embedded(figure, plot)
        shown.append(tag("figure", tag("img", src=source, alt=f"{mark}{caption}. {words}", width=width, height=height),
                         tag("figcaption", tag("strong", running(f"{mark}{caption}.")), " ", running(words)),
                         class_="narrow" if width <= NARROW else None))
    return Markup(f'<div class="figures">\n{joined(shown)}\n</div>')


def _figures(result, plot):
    """Yield name and figure of all kinds that tell something; those of one direction, or of two opposite planes, are along the load."""
    theta = direction(result.history)
    turned, both = plot.Options(angles=(theta,)), plot.Options(angles=(theta, theta + 180))
    for kind, one in plot.KINDS.items():
        if one.tells(result):
            options = turned if kind in ALONG_THE_LOAD else both if kind == "sections" and not result.section_numbers else plot.Options()
            yield from plot.figures(result, [kind], options)


def embedded(figure, plot):
    """A figure as a data URI, with its width and height on the page [pixel]."""
    vector = _saved(figure, plot, "svg", metadata={"Date": None, "Creator": None})
    if len(vector) <= LARGEST_SVG:
        size = [float(re.search(rb'<svg[^>]*?\b%s="([\d.]+)pt"' % side, vector)[1])/72 for side in (b"width", b"height")]
        kind, data = "svg+xml", vector
    else:
        kind, data = "png", _saved(figure, plot, "png", dpi=PIXELS_PER_INCH)
        size = [int.from_bytes(data[k:k + 4], "big")/PIXELS_PER_INCH for k in (16, 20)]
    width, height = (round(x*PAGE_PIXELS_PER_INCH) for x in size)
    return f"data:image/{kind};base64,{base64.b64encode(data).decode('ascii')}", width, height


def _saved(figure, plot, kind, **options):
    with plot.plt.rc_context(plot.SETTINGS):
        file = io.BytesIO()
        figure.savefig(file, format=kind, **options)
        figure.set_layout_engine("none")  # placed now, once is enough
    return file.getvalue()


def describe(job, name):
    """Caption of a figure, and in words what it shows."""
    if name in YIELDING:
        caption, words = YIELDING[name]
        return caption, words.format(planes=f"P{_planes(job)[1:]}")
    kind, _, rest = name.partition("_")
    captions = {"mesh": _mesh, "deformed": _deformed, "contours": _contours, "section": _section, "line": _line,
            "joints": _joints, "convergence": _convergence, "spectrum": _spectrum}
    return captions.get(kind, lambda job, rest: _about(kind, rest))(job, rest)


def _about(kind, rest):
    """Caption of a figure that says itself what it shows."""
    from ..plot import KINDS
    about = KINDS[kind].about
    return about[0].upper() + about[1:], f"Interface {rest.replace('_', ' ')}." if rest else ""


def with_unit(value, unit):
    """A number and its unit."""
    return f"{number(value)} {unit}".rstrip()


def _place(peak):
    return (f"{number(peak.value)} at r = {number(peak.r)}, z = {number(peak.z)}, "
            f"θ = {number(peak.theta)}°")


def _mesh(job, _):
    mesh = job.result.mesh
    return ("Mesh", f"Meridional plane with {len(mesh.coordinates)} nodes, {len(mesh.element_label)} elements and "
            f"{len(mesh.joint_label)} joints; materials, supports, and the loads as they act at θ = 0.")


def _planes(job):
    """The planes of a figure of two, in words: along the load."""
    theta = direction(job.result.history)
    return f"planes θ = {theta:g}° (right) and θ = {theta + 180:g}° (left)"


def _deformed(job, _):
    peak = extremes(job.result)["length"][-1]
    return ("Deformed body", f"Meridional {_planes(job)}, displacements enlarged; dashed: at "
            f"rest. The largest displacement of all angles is {_place(peak)}.")


def _contours(job, name):
    *low, high = extremes(job.result)["length" if name == "displacement" else name]
    unit = job.units.length if name == "displacement" else job.units.stress
    span = f"up to {_place(high)}" if name == "displacement" else \
        f"from {_place(*low)}, to {_place(high)}"
    return (NAMES[name] + (f" [{unit}]" if unit else ""),
            f"Contours on the {_planes(job)}. All angles: {span}.")


def _along(section):
    """Ends and angles of a section in words, and between which values each stress is."""
    ends = " to ".join(f"r = {number(r)}, z = {number(z)}" for r, z in (section.first, section.last))
    angles = ", ".join(f"{number(theta)}°" for theta in section.theta)
    stress = without_rounding(section.stress, 1e-9)[..., 1]
    return (f"From {ends} at θ = {angles}; displacements and stresses that are not zero. σ_z is between "
            f"{number(stress.min())} and {number(stress.max())}, the displacement v between "
            f"{number(section.displacement[..., 1].min())} and {number(section.displacement[..., 1].max())}.")


def _section(job, rest):
    return f"Section {rest}", _along(job.result.section(int(rest)))


def _line(job, rest):
    from ..plot import curves
    theta = direction(job.result.history)
    return ({"across": "Profile across the body", "along": "Profile along the body"}[rest],
            _along(curves.sections(job.result, (theta, theta + 180))[f"line_{rest}"]))


def _joints(job, rest):
    from ..plot.joints import interfaces
    interface = interfaces(job.result)[f"joints_{rest}" if rest else "joints"]
    table = job.result.joints()
    chosen = np.isin(table["joint"], job.result.mesh.joint_label[interface.joints])
    joints = table.where(chosen)
    states = ", ".join(f"{int((joints['state'] == state).sum())} {state}" for state in STATES)
    peak = joint_peaks(job.result, interface.joints)["pressure"]
    pressed = f"largest pressure {_place(peak)}" if peak.value > 0 else "no point is pressed"
    return (f"Joints of interface {rest}" if rest else "Joints",
            f"State, normal stress, shear stress and gap over {interface.coordinate()[0]} and θ. "
            f"Points times planes: {states}; {pressed}.")


def _convergence(job, _):
    path = job.result.convergence()
    states = "; below it, points times planes that slip and are open" if len(job.result.mesh.joint_label) else ""
    return ("Convergence", "Forces out of balance, of the whole or of the worst part, whichever is larger: from "
            f"{number(path['ratio'][0])} to {number(path['ratio'][-1])} in {path.rows} iteration{'s' if path.rows > 1 else ''}{states}.")


def _spectrum(job, _):
    table = job.result.spectrum()
    largest = int(table["displacement"].argmax())
    return ("Harmonics", "Largest amplitude of displacement and stress of each harmonic; the largest displacement is "
            f"that of m = {table['harmonic'][largest]}, {with_unit(table['displacement'][largest], job.units.length)}.")
