"""The mesh: materials, joints, supports, loads."""
from collections import defaultdict

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from .. import circle
from . import pieces, style
from .options import Options
from .style import plt

FILLS = [("0.86", ""), ("1.0", ""), ("0.72", ""), ("0.93", "...."), ("1.0", "////"), ("0.8", "xxxx")]
LAW_LINES = ["-", (0, (3, 1)), (0, (1, 1)), (0, (4, 1, 1, 1))]
NAMES = ("u", "v", "w")


@style.styled
def draw(result, options=Options()):
    """Mesh with materials, joints, supports and loads: a Figure."""
    mesh, units = result.mesh, style.Units(result, options)
    extent = np.ptp(mesh.coordinates, axis=0)
    width = 4.6 if extent[1] < 1.6*extent[0] else 3.4
    figure, axes = plt.subplots(figsize=(width, min(8.5, 0.8 + 0.72*width*extent[1]/extent[0])))
    handles = _materials(axes, mesh) + _joints(axes, result) + _bonded(result)
    handles += _supports(axes, mesh, extent.max()) + _springs(axes, result, extent.max())
    handles += _loads(axes, result, extent.max())
    axes.plot([0, 0], [mesh.coordinates[:, 1].min() - 0.06*extent.max(),
                       mesh.coordinates[:, 1].max() + 0.06*extent.max()], color="black", lw=0.6,
              ls=(0, (8, 2, 1, 2)), clip_on=False)
    axes.set_aspect("equal")
    axes.set_xlabel(units.of_length("$r$"))
    axes.set_ylabel(units.of_length("$z$"))
    axes.xaxis.set_major_locator(style.matplotlib.ticker.MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]))
    handles += _applied(result, units)
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1), borderaxespad=0,
                handlelength=2.6)
    if options.title:
        axes.set_title(options.title)
    return figure


def _materials(axes, mesh):
    handles = []
    for k, label in enumerate(mesh.material_label):
        chosen = np.flatnonzero(mesh.element_material == k)
        if not len(chosen):
            continue
        colour, hatch = FILLS[k % len(FILLS)]
        axes.add_collection(PolyCollection(pieces.element_polygons(mesh, mesh.coordinates, chosen),
                                           facecolor=colour, edgecolor="0.4", lw=0.35, hatch=hatch))
        handles.append(Patch(facecolor=colour, edgecolor="0.4", hatch=hatch, label=f"material {label}"))
    axes.add_collection(LineCollection(pieces.outlines(mesh, mesh.coordinates), colors="black", lw=0.8))
    axes.autoscale_view()
    return handles


def _joints(axes, result):
    mesh, handles = result.mesh, []
    if not len(mesh.joint_label):
        return []
    kinds = result.read("joint_materials/kind")
    for k, label in enumerate(mesh.law_label):
        joints = np.flatnonzero(mesh.joint_material == k)
        if not len(joints):
            continue
        lines = [pieces.edge_points(mesh.coordinates[pieces.side_nodes(mesh, j)]) for j in joints]
        dashes = LAW_LINES[k % len(LAW_LINES)]
        axes.add_collection(LineCollection(lines, colors="white", lw=3.4, zorder=3))
        mine = [one for one in pieces.interfaces(result) if one.law == label]
        chains = [_chain(one) for one in mine]
        axes.add_collection(LineCollection(chains, colors="black", lw=2.4, linestyles=[dashes], zorder=4,
                                           capstyle="butt"))
        names = dict.fromkeys(one.name for one in mine if one.name)
        name = f"joints, law {label}" + (" (elastic)" if kinds[k] == 0 else "") \
            + (": " + ", ".join(names) if names else "")
        handles.append(Line2D([], [], color="black", lw=2.4, ls=dashes, label=name))
    return handles


def _bonded(result):
    """Names of bonded interfaces: an entry of the legend without a symbol."""
    names = ", ".join(one.name for one in result.interfaces if one.law is None)
    return [Line2D([], [], ls="", label=f"bonded: {names}")] if names else []


def _chain(interface):
    """One polyline of an interface."""
    lines = list(interface.lines)
    if len(lines) > 1 and np.linalg.norm(lines[1] - lines[0][0], axis=1).min() < \
            np.linalg.norm(lines[1] - lines[0][-1], axis=1).min():
        lines[0] = lines[0][::-1]
    for k in range(1, len(lines)):
        if np.linalg.norm(lines[k][0] - lines[k - 1][-1]) > np.linalg.norm(lines[k][-1] - lines[k - 1][-1]):
            lines[k] = lines[k][::-1]
    return np.concatenate(lines)


def outer_edges(mesh):
    """Edges at the surface: element and nodes in counterclockwise order of the element."""
    joined = set()
    for joint, nodes in enumerate(mesh.joint_nodes):
        joined |= {frozenset((nodes[0], nodes[1])), frozenset((nodes[2], nodes[3]))}
    return {key: nodes for key, (_, nodes) in mesh.boundary().items() if key not in joined}


def _normal(nodes):
    """Outer normal of an edge in counterclockwise order."""
    along = nodes[-1] - nodes[0]
    return np.array([along[1], -along[0]])/np.linalg.norm(along)


def _supports(axes, mesh, size):
    """Fixed edges as hatched strips, nodes that are fixed alone as triangles."""
    strips, covered = defaultdict(list), set()
    for nodes in outer_edges(mesh).values():
        held = mesh.fixed[nodes].all(axis=0)
        if held.any() and (mesh.coordinates[nodes, 0] > 0).any():
            strips[tuple(held)].append(nodes)
            covered |= {(node, c) for node in nodes for c in np.flatnonzero(held)}
    handles = []
    for k, (held, edges) in enumerate(sorted(strips.items(), reverse=True)):
        hatch = ("//////", "......", "xxxxxx", "||||||")[k % 4]
        for nodes in edges:
            line = pieces.edge_points(mesh.coordinates[nodes])
            back = line + 0.03*size*_normal(mesh.coordinates[nodes])
            axes.fill(*np.concatenate([line, back[::-1]]).T, facecolor="none", edgecolor="0.25",
                      hatch=hatch, lw=0, clip_on=False)
        name = "fixed: " + ", ".join(n for n, h in zip(NAMES, held) if h)
        handles.append(Patch(facecolor="white", edgecolor="0.25", hatch=hatch, lw=0, label=name))
    alone = defaultdict(list)
    for node in np.flatnonzero(mesh.fixed.any(axis=1)):
        held = [c for c in np.flatnonzero(mesh.fixed[node]) if (node, c) not in covered]
        if held:
            alone[tuple(held)].append(node)
    for (held, nodes), marker in zip(sorted(alone.items()), "^>sDv<p"):
        axes.plot(*mesh.coordinates[nodes].T, ls="", marker=marker, mfc="white", mec="black", ms=5,
                  clip_on=False, zorder=6)
        name = "fixed: " + ", ".join(NAMES[c] for c in held)
        handles.append(Line2D([], [], ls="", marker=marker, mfc="white", mec="black", label=name))
    return handles


def _springs(axes, result, size):
    """Zigzags on edges that rest on springs."""
    if not result.has("springs") or not len(result.read("springs/nodes")):
        return []
    mesh, ends = result.mesh, outer_edges(result.mesh)
    springs = result.read("springs/nodes")[:, :2] - 1
    for nodes in springs[::-(-len(springs)//10)]:
        edge = ends.get(frozenset(nodes))
        if edge is None:
            continue
        x = mesh.coordinates[edge]
        normal, along = _normal(x), (x[-1] - x[0])/np.linalg.norm(x[-1] - x[0])
        t = np.array([0, .25, .35, .5, .65, .75, 1])[:, None]
        side = np.array([0, 0, 1, -1, 1, 0, 0])[:, None]
        zigzag = x[[0, -1]].mean(axis=0) + 0.04*size*t*normal + 0.006*size*side*along
        axes.plot(*zigzag.T, color="black", lw=0.7, clip_on=False)
        ground = zigzag[-1] + 0.01*size*np.array([[-1], [1]])*along
        axes.plot(*ground.T, color="black", lw=1.2, clip_on=False)
    return [Line2D([], [], color="black", lw=0.7, marker=(3, 0, 180), ms=5, label="springs to the ground")]


def _loads(axes, result, size):
    """Tractions and ring loads in the plane theta = 0 as arrows, weight in words."""
    if not result.has("loads"):
        return []
    mesh, factor = result.mesh, result.read("loads/case_factor")
    starts, arrows = [], []
    for group, of in (("edge", _edge_arrows), ("ring", _ring_arrows)):
        read = {name: result.read(f"loads/{group}/{name}") for name in ("harmonic", "family", "case")}
        if not len(read["case"]):
            continue
        weight, _ = circle.mode_factors(read["harmonic"], read["family"], 0.0)
        found = of(result, weight*factor[read["case"] - 1])
        if found:
            group_starts, group_arrows = (np.array(part) for part in zip(*found))
            length = np.linalg.norm(group_arrows, axis=1).max()
            if length > 0:
                starts.append(group_starts)
                arrows.append(group_arrows*0.13*size/length)
    handles = []
    if starts:
        starts, arrows = np.concatenate(starts), np.concatenate(arrows)
        keep = np.linalg.norm(arrows, axis=1) > 0.01*size
        starts, arrows = starts[keep], arrows[keep]
        inward = _points_inward(mesh, starts, arrows)
        tails = np.where(inward[:, None], starts - arrows, starts)
        for tail, arrow in zip(tails, arrows):
            axes.annotate("", xy=tail + arrow, xytext=tail, annotation_clip=False, zorder=7,
                          arrowprops={"arrowstyle": "-|>", "lw": 0.9, "color": "black", "shrinkA": 0,
                                      "shrinkB": 0, "mutation_scale": 7})
        every = np.concatenate([tails, tails + arrows])
        axes.update_datalim(every)
        axes.autoscale_view()
        handles.append(Line2D([], [], color="black", lw=0.9, marker=">", ms=4, markevery=[1],
                              label=r"loads at $\theta$ = 0"))
    weights = factor[result.read("loads/body/case") - 1] if len(result.read("loads/body/case")) else []
    if np.any(np.asarray(weights) != 0):
        handles.append(Line2D([], [], color="black", lw=0, marker=r"$\downarrow$", ms=9,
                              label="forces on the mass"))
    return handles


def _edge_arrows(result, weight):
    """Middle of loaded edges, and mean traction there at theta = 0."""
    total = defaultdict(lambda: np.zeros(2))
    nodes, traction = result.read("loads/edge/nodes") - 1, result.read("loads/edge/traction")
    for edge, values, one in zip(nodes, traction, weight):
        total[tuple(edge[:2])] += one*values[:2, :2].mean(axis=0)
    return _thinned([(result.mesh.coordinates[list(edge)].mean(axis=0), value)
                     for edge, value in total.items()])


def _ring_arrows(result, weight):
    """Place and force at theta = 0 of loaded circles."""
    total = defaultdict(lambda: np.zeros(2))
    for node, force, one in zip(result.read("loads/ring/node") - 1, result.read("loads/ring/force"), weight):
        total[node] += one*force[:2]
    return [(result.mesh.coordinates[node], value) for node, value in total.items()]


def _thinned(arrows, most=24):
    """Not more arrows than the eye can tell apart."""
    if len(arrows) <= most:
        return arrows
    arrows.sort(key=lambda one: (round(one[0][0], 9), round(one[0][1], 9)))
    return arrows[::int(np.ceil(len(arrows)/most))]


def _points_inward(mesh, starts, arrows):
    """Whether arrows point into the body: these end at its surface."""
    step = 1e-3*np.ptp(mesh.coordinates, axis=0).max()
    ahead = starts + step*arrows/np.linalg.norm(arrows, axis=1)[:, None]
    back = starts - step*arrows/np.linalg.norm(arrows, axis=1)[:, None]
    inside, behind = np.zeros((2, len(starts)), bool)
    inside[mesh.locate(ahead)[0]] = True
    behind[mesh.locate(back)[0]] = True
    return inside & ~behind


def _applied(result, units):
    """Resultants of the applied loads, in words: entries of the legend without a symbol."""
    names = ("axial force", "lateral force", "moment", "torque", "lateral force at 90°", "moment at 90°")
    of = (units.force, units.force, units.moment, units.moment, units.force, units.moment)
    values = result.read("resultants/applied")
    words = [f"{name} {value:.4g} {unit}".rstrip() for name, value, unit in zip(names, values, of)
             if abs(value) > 1e-9*abs(values).max()]
    about = "\n(moments about the origin)" if any(word.startswith("moment") for word in words) else ""
    return [Line2D([], [], ls="", label=word) for word in (["", f"resultants of the loads:{about}"] if words else [])
            + words]
