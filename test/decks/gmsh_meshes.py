"""Mesh files of Gmsh, and that they give what generated meshes give

The pile and the footing of `inputs/case3.dat` are written as mesh files of both formats, for each
kind of element, and compared with the mesh that BLOCKS make of them.
"""
import json
import os
import re

from listing import tables
from messages import expected_messages, message_faults
from support import INPUTS, Test, expected, input_deck, read_text, write

# Numbers of elements along r in pile and footing, along z below, in and above the socket
DIVISIONS = (4, 6, 2, 8, 4)
# Gmsh's types by the nodes of an element, and of a line
TYPES = {4: 3, 8: 16, 9: 10, 3: 2, 6: 9}
LINE_TYPES = {4: 1, 8: 8, 9: 8, 3: 1, 6: 8}
# Corners and middles of a cell of the half grid, in the order of Gmsh
PLACES = {4: ((0, 0), (2, 0), (2, 2), (0, 2))}
PLACES[8] = PLACES[4] + ((1, 0), (2, 1), (1, 2), (0, 1))
PLACES[9] = PLACES[8] + ((1, 1),)
# Largest difference of results, in the largest value of its column
TOLERANCE = 1e-10


class Mesh:
    """Nodes by number, elements as (type, name of the group, nodes), groups as (dimension, number)"""

    def __init__(self):
        self.nodes = {}
        self.elements = []
        self.groups = {}

    def node(self, place, copy=0):
        """Number of the node at a place, made if it is new"""
        key = (place, copy)
        return self.nodes.setdefault(key, len(self.nodes) + 1)

    def add(self, kind, dimension, group, nodes):
        """Add an element to a group"""
        self.groups.setdefault(group, (dimension, len(self.groups) + 1))
        self.elements.append((kind, group, nodes))

    def format_2(self):
        """The file in format 2.2"""
        lines = ['$MeshFormat', '2.2 0 8', '$EndMeshFormat', *self.names(), '$Nodes', len(self.nodes)]
        lines += [f'{k} {r!r} {z!r} 0' for ((r, z), _), k in self.nodes.items()]
        lines += ['$EndNodes', '$Elements', len(self.elements)]
        for k, (kind, group, nodes) in enumerate(self.elements, 1):
            number = self.groups[group][1]
            lines.append(f'{k} {kind} 2 {number} {number} ' + ' '.join(map(str, nodes)))
        return '\n'.join(map(str, lines + ['$EndElements', '']))

    def format_4(self):
        """The file in format 4.1: an entity for each group"""
        entities = {1: [], 2: []}
        for dimension, number in self.groups.values():
            entities[dimension].append(f'{number} 0 0 0 0 0 0 1 {number} 0 ')
        lines = ['$MeshFormat', '4.1 0 8', '$EndMeshFormat', *self.names(), '$Entities',
                 f'0 {len(entities[1])} {len(entities[2])} 0', *entities[1], *entities[2], '$EndEntities',
                 '$Nodes', f'1 {len(self.nodes)} 1 {len(self.nodes)}', f'2 1 0 {len(self.nodes)}']
        lines += self.nodes.values()
        lines += [f'{r!r} {z!r} 0 ' for (r, z), _ in self.nodes]
        lines += ['$EndNodes', '$Elements']
        blocks = []
        for k, (kind, group, nodes) in enumerate(self.elements, 1):
            if not blocks or blocks[-1][:2] != (kind, group):
                blocks.append((kind, group, []))
            blocks[-1][2].append(f'{k} ' + ' '.join(map(str, nodes)) + ' ')
        lines.append(f'{len(blocks)} {len(self.elements)} 1 {len(self.elements)}')
        for kind, group, elements in blocks:
            dimension, number = self.groups[group]
            lines += [f'{dimension} {number} {kind} {len(elements)}', *elements]
        return '\n'.join(map(str, lines + ['$EndElements', '']))

    def names(self):
        """The section of the names"""
        names = [f'{dimension} {number} "{name}"' for name, (dimension, number) in self.groups.items()]
        return ['$PhysicalNames', len(names), *names, '$EndPhysicalNames']


def grid(size, separate=False, turned=False):
    """Pile and footing of case 3. size: nodes of an element; separate: each body has nodes of its
    own; turned: every other element runs clockwise"""
    a, b, c, d, e = DIVISIONS
    r = [0.5*i/(2*a) for i in range(2*a)] + [0.5 + 1.5*i/(2*b) for i in range(2*b + 1)]
    z = ([-0.5 + 0.5*i/(2*c) for i in range(2*c)] + [i/(2*d) for i in range(2*d)]
         + [1.0 + i/(2*e) for i in range(2*e + 1)])
    mesh = Mesh()

    def node(i, j, body):
        return mesh.node((r[i], z[j]), body if separate else 0)

    def curve(name, body, places):
        for first, last in zip(places[:-2:2], places[2::2]):
            middle = ((first[0] + last[0])//2, (first[1] + last[1])//2)
            nodes = [node(*place, body) for place in (first, last, middle)]
            mesh.add(LINE_TYPES[size], 1, name, nodes[:2 if size in (3, 4) else 3])

    for body in (1, 2):
        for j in range(0, 2*(c + d + e), 2):
            for i in range(0, 2*(a + b), 2):
                pile = i < 2*a and j < 2*(c + d)
                if pile != (body == 1) or (body == 2 and j < 2*c):
                    continue
                nodes = [node(i + x, j + y, body) for x, y in PLACES[size]]
                if turned and (i + j)//2 % 2:
                    order = [0, 3, 2, 1, 7, 6, 5, 4, 8]
                    nodes = [nodes[k] for k in order[:size]]
                mesh.add(TYPES[size], 2, ('pile', 'footing')[body - 1], nodes)
    curve('end', 1, [(i, 0) for i in range(2*a + 1)])
    curve('shaft', 1, [(2*a, j) for j in range(2*c, 2*(c + d) + 1)])
    curve('head', 2, [(i, 2*(c + d)) for i in range(2*a + 1)])
    curve('top of the footing', 2, [(i, 2*(c + d + e)) for i in range(2*(a + b) + 1)])
    return mesh


GROUPS = """GMSH      mesh.msh
GROUPS
BODY          1    1 pile
BODY          2    2 footing
FACE          1      end
FACE          6      top of the footing
JOINT         1      shaft
JOINT         2      head
"""


def block_deck(size, elastic=False):
    """Deck of case 3 with blocks of elements of so many nodes, and results of many digits"""
    deck = re.sub(r'^(    \d    \d)    4(    \d    \d)$', rf'\1    {size}\2', input_deck('case3.dat'), flags=re.M)
    return deck.replace('0.03  500', '1E-8  500')


def gmsh_deck(size):
    """The same with a mesh file"""
    deck = block_deck(size)
    start, end = deck.index('BLOCKS'), deck.index('FIXEDFACES')
    return deck[:start] + GROUPS + deck[end:]


def columns_at_places(folder, program, deck):
    """Rows of the tables of displacements and joint stresses by place; faults if there are none"""
    ran = program.run('run', deck, '-o', folder)
    faults = ran.ended_with(0) + expected('messages', '', ran.err)
    if faults:
        return {}, faults
    found = {}
    for name, rows in tables(read_text(os.path.join(folder, os.path.basename(deck)[:-4] + '.lis'))).items():
        found[name] = rows
    return found, []
