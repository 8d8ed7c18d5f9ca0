"""The paper's Figs. 6 to 17, drawn from our runs"""
import numpy as np
from axijoint.plot import curves, joints, mesh, pieces, style
from axijoint.plot.style import plt
from runs import BOTTOM, CASES, FACE, MOUTH, REFINEMENT
from statements import section_a

PLANES = (180.0, 0.0)
# Section b-b runs along the side face, and on into the footing up to here [m]
END_B = 1.5
REFINED = ("Curves of Figs. 8 to 16 are from the decks' mesh with 8-node elements, "
           f"{REFINEMENT} for each along both directions; Figs. 7 and 17, and the stresses of joints, from the "
           "decks as they are. Section a-a runs where case 1 is open at theta = 0 as well as at pi, as the paper "
           "says; section b-b along the wall of the socket, in the footing. Without joints the corner of the socket is a notch, at which "
           "stress has no limit: these curves leave the pictures.")
CAPTIONS = {6: "Mesh and loads, with the sections a-a and b-b", 7: "Debonding or slip region",
            17: "Processes of convergence"}
CAPTIONS |= {figure: f"Profiles of {what} (case {case})"
             for case, first in ((1, 8), (2, 11), (3, 14))
             for figure, what in zip((first, first + 1, first + 2),
                                     ("vertical stress on cross section a-a", "horizontal stress on cross section "
                                      "b-b", "shear stress on cross section b-b"))}


def all_figures(runs):
    """Yield number of the figure, name, matplotlib Figure."""
    yield 6, "fig06_mesh", draw_mesh(runs["case3"], section_a(runs))
    yield 7, "fig07_regions", draw_regions(runs)
    for case, first in zip(CASES, (8, 11, 14)):
        yield first, f"fig{first:02d}_{case}_sigma_z", draw_a(runs, case)
        for k, (component, name) in enumerate(((0, "sigma_r"), (3, "tau_rz")), first + 1):
            yield k, f"fig{k:02d}_{case}_{name}", draw_b(runs, case, component, name)
    yield 17, "fig17_convergence", draw_convergence(runs)


@style.styled
def draw_mesh(run, section):
    """Fig. 6, with the sections."""
    figure = mesh.draw(run.result)
    axes = figure.axes[0]
    for (r, z), name, place in (((0, section), "a", (2, section)), ((FACE, MOUTH), "b", (FACE, END_B))):
        axes.annotate("", (r, z), place, arrowprops={"arrowstyle": "-", "lw": 1.2, "ls": "-.", "color": "0.2"},
                      zorder=8)
        for x, y in ((r, z), place):
            shift = (0.06 if x > r or name == "b" else -0.06, 0) if name == "a" else (0, 0.07 if y > z else -0.07)
            axes.text(x + shift[0], y + shift[1], name, ha="center", va="center", style="italic", size=10,
                      bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5}, zorder=9)
    return figure


@style.styled
def draw_regions(runs):
    """Fig. 7: states of the vertical interface, one panel a case."""
    figure, axes = plt.subplots(1, 3, figsize=(style.TWO_COLUMNS, 3.0), sharey=True)
    for one, name in zip(axes, CASES):
        result = runs[name].result
        face = next(chain for chain in pieces.interfaces(result) if chain.coordinate()[0] == "z")
        order = np.argsort(face.position[:, 1])
        state = result.read("joints/state")[:, face.points[order]]
        theta = np.degrees(result.read("joints/planes"))
        joints.draw_state(one, theta, face.position[order, 1], state.T)
        joints.axis_of_planes(one, theta)
        one.set_title(f"case {name[-1]}")
    axes[0].set_ylabel(style.Units(runs["case1"].result).of_length("$z$"))
    figure.legend(handles=joints.state_handles(), loc="outside lower center", ncols=3)
    return figure


def add_legend(figure, with_circles):
    """Legend of curves with and without joints."""
    handles = [plt.Line2D([], [], color="black", label="with joints"),
               plt.Line2D([], [], color="0.45", ls="--", label="without joints")]
    if with_circles:
        handles.append(plt.Line2D([], [], color="black", ls="", marker="o", mfc="white",
                                  label="stress of the joints"))
    figure.legend(handles=handles, loc="outside upper right", ncols=len(handles))


@style.styled
def draw_a(runs, case):
    """Figs. 8, 11, 14: sigma_z across the pile and the footing, theta = pi to the left."""
    units = style.Units(runs[case].result)
    z = section_a(runs)
    figure, axes = plt.subplots(figsize=(style.TWO_COLUMNS*0.75, 3.0))
    for name, colour, dashes in (("continuum fine", "0.45", "--"), (f"{case} fine", "black", "-")):
        for theta, side in zip(PLANES, (-1, 1)):
            line = runs[name].result.line((0, z), (2, z), theta, 161)
            distance, curve = curves.broken(line, line.stress[0, :, 1])
            axes.plot(side*distance, curve, color=colour, ls=dashes)
    axes.axhline(0, color="0.7", lw=0.5, zorder=0)
    for x in (-FACE, FACE):
        axes.axvline(x, color="0.4", lw=0.6, ls=":")
    for x, word in ((0, "pile"), (-1.25, "footing"), (1.25, "footing")):
        axes.text(x, 0.02, word, transform=axes.get_xaxis_transform(), ha="center", color="0.25")
    for x, theta in ((0.02, 180), (0.98, 0)):
        axes.text(x, 0.96, style.degrees(theta), transform=axes.transAxes, ha="left" if theta else "right", va="top")
    axes.xaxis.set_major_formatter(lambda x, _: f"{abs(x):g}")
    axes.set_xlim(-2, 2)
    axes.set_ylim(*limits([runs[f"{one} fine"].result.line((0, z), (2, z), PLANES).stress[..., 1]
                           for one in CASES]))
    axes.set_xlabel(units.of_length("$r$"))
    axes.set_ylabel(units.of_stress("sigma_z"))
    add_legend(figure, False)
    return figure


@style.styled
def draw_b(runs, case, component, name):
    """Figs. 9, 10, 12, 13, 15, 16: a stress of the footing along the face, theta = pi to the left."""
    units = style.Units(runs[case].result)
    figure, axes = plt.subplots(1, 2, figsize=(style.TWO_COLUMNS*0.75, 3.4), sharey=True, sharex=True)
    for one, theta in zip(axes, PLANES):
        for run, colour, dashes in (("continuum fine", "0.45", "--"), (f"{case} fine", "black", "-")):
            one.plot(*footing_along_b(runs[run], theta, component), color=colour, ls=dashes)
        rows = runs[case].at(theta)
        # On a vertical face eta is +r where xi is -z, and -r where xi is +z: tau_rz = -tau_xi in both cases
        one.plot(rows["sigma"] if component == 0 else -rows["tau_xi"], rows["z"], ls="", marker="o",
                 color="black", mfc="white", ms=3.5)
        one.axvline(0, color="0.7", lw=0.5, zorder=0)
        one.axhline(BOTTOM, color="0.4", lw=0.6, ls=":")
        one.set_title(style.degrees(theta))
        one.set_xlim(*limits([footing_along_b(runs[f"{each} fine"], theta, component)[0]
                              for each in CASES for theta in PLANES]))
        one.set_xlabel(units.of_stress(name))
    axes[0].set_ylabel(units.of_length("$z$"))
    axes[0].text(0.02, BOTTOM, "end of the pile", transform=axes[0].get_yaxis_transform(), va="bottom",
                 color="0.25", size=7)
    add_legend(figure, True)
    return figure


def footing_along_b(run, theta, component):
    """A stress of the footing along section b-b, and z."""
    line = run.result.line((FACE, MOUTH), (FACE, END_B), theta, 241)
    rows = line.material == 2
    return line.stress[0, rows, component], line.position[rows, 1]


def limits(values):
    """Limits of an axis, the same for all cases: the curves with joints, and some room."""
    low, high = min(one.min() for one in values), max(one.max() for one in values)
    room = 0.08*(high - low)
    return low - room, high + room


@style.styled
def draw_convergence(runs):
    """Fig. 17: residual ratio of cases 1 and 3."""
    figure, axes = plt.subplots(figsize=(style.ONE_COLUMN*1.3, 3.0))
    for name, (colour, dashes, marker), words in zip(("case1", "case3"), style.CURVES,
                                                     ("case 1: C = 2 MPa, $\\varphi$ = 30°", "case 3: C = 0, $\\varphi$ = 0°")):
        path = runs[name].result.convergence()
        axes.plot(np.arange(1, path.rows + 1), 100*path["ratio"], color=colour, ls=dashes, marker=marker, ms=3.5,
                  label=words)
    axes.axhline(3, color="0.4", lw=0.8, ls=":")
    axes.annotate(r"$\varepsilon$ = 3 %", (0.01, 3), (0, 2), xycoords=("axes fraction", "data"),
                  textcoords="offset points", color="0.25")
    axes.set_ylim(bottom=0)
    axes.set_xlabel("iteration")
    axes.set_ylabel(r"$\Psi^r$ / $\Psi_f$ [%]")
    axes.xaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(integer=True))
    axes.legend()
    return figure
