"""The pile and its footing, meshed by BLOCKS and read from Gmsh files of the same mesh"""
import dataclasses
import pathlib

import numpy as np

import report

INPUT = pathlib.Path(__file__).resolve().parents[2]/"inputs"/"case1.dat"
ALLOWED = 1e-10
SURFACES = {1: "pile", 2: "footing"}
# Curves of the mesh: tag -> name, ends
CURVES = {1: ("end of the pile", (0.0, -0.5), (0.5, -0.5)),
          2: ("shaft", (0.5, 0.0), (0.5, 1.0)),
          3: ("head", (0.0, 1.0), (0.5, 1.0)),
          4: ("top", (0.0, 2.0), (2.0, 2.0))}
# Gmsh's numbers of element types, by nodes; of lines, by nodes
SOLID_TYPES, LINE_TYPES = {3: 2, 6: 9, 4: 3, 8: 16, 9: 10}, {2: 1, 3: 8}
GROUPS = """GMSH      {name}
GROUPS
BODY          1    1 pile
BODY          2    2 footing
FACE          1      end of the pile
FACE          6      top
JOINT         1      shaft
JOINT         2      head
"""


def generated_deck(nodes):
    """The deck of inputs, with elements of 3, 4, 6, 8 or 9 nodes and joints at Gauss points"""
    lines = INPUT.read_text(encoding="utf-8").replace("CENTROID", "   GAUSS").splitlines()
    start = lines.index("BLOCKS")
    for i in range(start, lines.index("FACES")):
        if lines[i][:1] not in "!B" and "." not in lines[i]:
            lines[i] = f"{lines[i][:10]}{nodes:5d}{lines[i][15:]}"
    return "\n".join(lines) + "\n"


def gmsh_deck(text, name):
    """The same deck with the mesh of a file"""
    lines = text.splitlines()
    first, last = lines.index("BLOCKS"), lines.index("FIXEDFACES")
    return "\n".join([*lines[:first], *GROUPS.format(name=name).splitlines(), *lines[last:]]) + "\n"


@dataclasses.dataclass
class FileMesh:
    """Mesh as Gmsh has it: one node a place, lines along curves"""
    coordinates: np.ndarray
    # Surface or curve -> nodes of its elements, counted from 1
    surfaces: dict
    curves: dict


def file_mesh(results):
    """Mesh of results with the nodes on both sides of the joints made one"""
    places, node = np.unique(np.round(results.coordinates, 9), axis=0, return_inverse=True)
    surfaces = {1: [], 2: []}
    lines = {}
    for body, nodes in zip(results.element_body, results.element_nodes):
        used = node[nodes[nodes > 0] - 1]
        surfaces[body].append(used + 1)
        sides = 3 if len(used) in (3, 6) else 4
        for k in range(sides):
            a, b = used[k], used[(k + 1) % sides]
            lines[frozenset((a, b))] = [a, b] + ([used[sides + k]] if len(used) > 4 else [])
    curves = {tag: [np.array(edge) + 1 for edge in lines.values()
                    if all(on_line(places[i], start, end) for i in edge[:2])]
              for tag, (_, start, end) in CURVES.items()}
    return FileMesh(places, surfaces, curves)


def on_line(point, start, end):
    """Whether a point lies between two others, on a line along r or z"""
    low, high = np.minimum(start, end) - 1e-9, np.maximum(start, end) + 1e-9
    return bool(np.all(point >= low) and np.all(point <= high))


def physical_names():
    """The section of names, the same in all formats"""
    names = [f'1 {tag} "{name}"' for tag, (name, _, _) in CURVES.items()]
    names += [f'2 {tag} "{name}"' for tag, name in SURFACES.items()]
    return ["$PhysicalNames", str(len(names)), *names, "$EndPhysicalNames"]


def entities(mesh):
    """Curves and surfaces: dimension, tag, type of element, elements"""
    for dimension, groups, types in ((1, mesh.curves, LINE_TYPES), (2, mesh.surfaces, SOLID_TYPES)):
        for tag, elements in groups.items():
            yield dimension, tag, types[len(elements[0])], elements


def format_2(mesh):
    """The file in format 2.2"""
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", *physical_names(),
             "$Nodes", str(len(mesh.coordinates))]
    lines += [f"{i} {r!r} {z!r} 0" for i, (r, z) in enumerate(mesh.coordinates.tolist(), start=1)]
    cards = [f"{kind} 2 {tag} {tag} {' '.join(map(str, nodes))}"
             for _, tag, kind, elements in entities(mesh) for nodes in elements]
    lines += ["$EndNodes", "$Elements", str(len(cards))]
    lines += [f"{i} {text}" for i, text in enumerate(cards, start=1)]
    return "\n".join([*lines, "$EndElements"]) + "\n"


def format_4(mesh):
    """The file in format 4.1"""
    n = len(mesh.coordinates)
    lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", *physical_names(), "$Entities",
             f"0 {len(mesh.curves)} {len(mesh.surfaces)} 0"]
    lines += [f"{tag} 0 -1 0 2 2 0 1 {tag} 0" for groups in (mesh.curves, mesh.surfaces)
              for tag in groups]
    lines += ["$EndEntities", "$Nodes", f"1 {n} 1 {n}", f"2 1 0 {n}", *map(str, range(1, n + 1))]
    lines += [f"{r!r} {z!r} 0" for r, z in mesh.coordinates.tolist()]
    blocks = list(entities(mesh))
    total = sum(len(elements) for *_, elements in blocks)
    lines += ["$EndNodes", "$Elements", f"{len(blocks)} {total} 1 {total}"]
    number = 0
    for dimension, tag, kind, elements in blocks:
        lines.append(f"{dimension} {tag} {kind} {len(elements)}")
        for nodes in elements:
            number += 1
            lines.append(f"{number} {' '.join(map(str, nodes))}")
    return "\n".join([*lines, "$EndElements"]) + "\n"


def ordered(results):
    """Displacements of the nodes and stresses of the Gauss points by body and place"""
    body = np.zeros(len(results.coordinates), dtype=int)
    for number, nodes in zip(results.element_body, results.element_nodes):
        body[nodes[nodes > 0] - 1] = number
    point_body = results.element_body[results.element]
    fields = []
    for values, numbers, places in ((results.displacement, body, results.coordinates),
                                    (results.stress, point_body, results.position)):
        order = np.lexsort((*np.round(places.T, 7), numbers))
        fields.append({mode: array[order] for mode, array in values.items()})
    joints = np.lexsort(np.round(results.joints["position"].T, 7))
    # The normal stress: the sense of xi depends on the order of the nodes
    fields.append({"sigma": results.joints["stress"][:, joints, 1]})
    return fields


@dataclasses.dataclass
class GmshMesh:
    """Same results from the generated mesh and from the file"""
    name: str = "gmsh_mesh"
    solutions: tuple = ()

    def run(self, program):
        """Rows: element types and formats"""
        rows, misses = [], []
        for nodes in SOLID_TYPES:
            text = generated_deck(nodes)
            results = program.run(f"{self.name}_{nodes}", text)
            mesh = file_mesh(results)
            for number, write in (("2.2", format_2), ("4.1", format_4)):
                stem = f"{self.name}_{nodes}_format_{number[0]}"
                (program.directory/f"{stem}.msh").write_text(write(mesh))
                found = program.run(stem, gmsh_deck(text, f"{stem}.msh"))
                worst = [max(np.abs(a[k] - b[k]).max() for k in a)
                         /max(np.abs(values).max() for values in a.values())
                         for a, b in zip(ordered(results), ordered(found))]
                rows.append([f"{nodes}-node", number, *map(report.rounding, worst)])
                if not max(worst) <= ALLOWED:
                    misses.append(f"{self.name}, {nodes}-node, format {number}: {max(worst):.1e}, "
                                  f"allowed {ALLOWED:.0e}")
        headings = ["element", "format", "displacements", "stresses", "normal stress of joints"]
        return [report.table(headings, rows)], misses


CASES = [GmshMesh()]
