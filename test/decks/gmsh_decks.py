"""Mesh files with one fault each: the message names the file and the line"""
import os
import random

from cut_decks import accepted, cut_faults, mutated
from made_decks import made_faults
from support import Test, expected, input_deck, read_text, write
from written_alike import same_results

DECK = """TITLE
Two rings from a mesh file
CONTROL
    2
MATERIALS
    1     2.0E4       0.3
LAWS
    1     1.0E4     2.0E4     1.0E4       0.0      30.0
GMSH      mesh.msh
GROUPS
      BODY    1    1 inner ring
      BODY    2    1 outer ring
      FACE    1      outside
      FACE    2      bottom
     JOINT    1      wall
FIXEDFACES
    1  111
TRACTIONS
    2    1       1.0
END
"""

FORMAT_2 = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
5
1 3 "bottom"
1 4 "wall"
1 5 "outside"
2 1 "inner ring"
2 2 "outer ring"
$EndPhysicalNames
$Nodes
7
1 0.5 0 0
2 1 0 0
3 2 0 0
4 0.5 1 0
5 1 1 0
6 2 1 0
7 9 9 9
$EndNodes
$Elements
6
1 15 2 0 1 7
2 1 2 3 3 1 2
3 1 2 4 4 2 5
4 1 2 5 5 3 6
5 3 2 1 1 1 2 5 4
6 3 2 2 2 2 3 6 5
$EndElements
"""

FORMAT_4 = """$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
5
1 3 "bottom"
1 4 "wall"
1 5 "outside"
2 1 "inner ring"
2 2 "outer ring"
$EndPhysicalNames
$Entities
1 3 2 0
1 9 9 9 0 
1 0.5 0 0 1 0 0 1 3 2 1 -2 
2 1 0 0 1 1 0 1 4 2 2 -5 
3 2 0 0 2 1 0 1 5 2 3 -6 
1 0.5 0 0 1 1 0 1 1 0 
2 1 0 0 2 1 0 1 2 0 
$EndEntities
$Nodes
2 7 1 7
0 1 0 1
7
9 9 9
2 1 1 6
1
2
3
4
5
6
0.5 0 0 0 0
1 0 0 1 0
2 0 0 2 0
0.5 1 0 0 1
1 1 0 1 1
2 1 0 2 1
$EndNodes
$Elements
6 6 1 6
0 1 15 1
1 7 
1 1 1 1
2 1 2 
1 2 1 1
3 2 5 
1 3 1 1
4 3 6 
2 1 3 1
5 1 2 5 4 
2 2 3 1
6 2 3 6 5 
$EndElements
"""

# Mesh files that are changed at random
SEED, MUTATIONS = 20260111, 600

# Name: text that is replaced, what replaces it, the message expected
FAULTS_2 = {
    'not a mesh': ('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n', '// footing.geo\n',
                   '1: error: this is not a mesh file of Gmsh: it does not begin with $MeshFormat'),
    'format 2': ('2.2 0 8', '2 0 8', '2:1: error: this format cannot be read'),
    'format 4.0': ('2.2 0 8', '4 0 8', '2:1: error: this format cannot be read'),
    'binary': ('2.2 0 8', '2.2 1 8', '2:5: error: the mesh file is binary'),
    'format line short': ('2.2 0 8', '2.2', '2: error: the mark of binary files is lacking at the end of the line'),
    'format not ended': ('$EndMeshFormat\n', '', '3:1-14: error: the section $MeshFormat is not ended'),
    'names more': ('5\n1 3', '6\n1 3', '11: error: $PhysicalNames announces 6 names, but has 5'),
    'names fewer': ('5\n1 3', '4\n1 3', '10: error: $PhysicalNames has more lines than it announces'),
    'name without marks': ('"wall"', 'wall', '7: error: the name of the group is not between quotation marks'),
    'name dimension': ('1 4 "wall"', '4 4 "wall"', '7:1: error: the dimension is out of range'),
    'named twice': ('1 4 "wall"', '1 3 "wall"', '7:3: error: physical curve "bottom" is named twice'),
    'nodes more': ('7\n1 0.5', '8\n1 0.5', '21: error: $Nodes announces 8 nodes, but has 7'),
    'nodes fewer': ('7\n1 0.5', '6\n1 0.5', '20: error: $Nodes has more lines than it announces'),
    'nodes endless': ('7\n1 0.5', '2000000000\n1 0.5',
                      '13:1-10: error: the number of nodes is more than the file can hold'),
    'nodes negative': ('7\n1 0.5', '-7\n1 0.5', '13:1-2: error: the number of nodes is out of range'),
    'node twice': ('4 0.5 1 0', '3 0.5 1 0', '17:1: error: node 3 is given twice, first on line 16'),
    'node zero': ('4 0.5 1 0', '0 0.5 1 0', '17:1: error: the number of the node is out of range'),
    'node too large': ('4 0.5 1 0', '18446744073709551616 0.5 1 0',
                       '17:1-20: error: the number of the node is out of range'),
    'node number real': ('4 0.5 1 0', '4.5 0.5 1 0', '17:1-3: error: the number of the node is not an integer'),
    'x not finite': ('4 0.5 1 0', '4 nan 1 0', '17:3-5: error: x is not a finite number'),
    'y infinite': ('4 0.5 1 0', '4 0.5 -Inf 0', '17:7-10: error: y is not a finite number'),
    'y too large': ('4 0.5 1 0', '4 0.5 1e31 0', '17:7-10: error: y is too large'),
    'y overflows': ('4 0.5 1 0', '4 0.5 1e999999999999 0', '17:7-20: error: y is too large'),
    'y not a number': ('4 0.5 1 0', '4 0.5 1..0 0', '17:7-10: error: y is not a number'),
    'z lacking': ('4 0.5 1 0', '4 0.5 1', '17: error: z is lacking at the end of the line'),
    'node line long': ('4 0.5 1 0', '4 0.5 1 0 5 1 1 0', '17:11: error: the line has too many values'),
    'off the plane': ('4 0.5 1 0', '4 0.5 1 0.25',
                      '17: error: node 4 is not in the plane z = 0: z = 0.25'),
    'behind the axis': ('1 0.5 0 0', '1 -0.5 0 0', '14: error: node 1 lies behind the axis: r = x is negative'),
    'nodes not ended': ('$EndNodes\n', '', '21:1-9: error: the section $Nodes is not ended'),
    'no nodes': (FORMAT_2[FORMAT_2.index('$Nodes'):FORMAT_2.index('$Elements')], '',
                 '12:1-9: error: the elements come before the nodes'),
    'no elements': (FORMAT_2[FORMAT_2.index('$Elements'):], '', '21: error: the file has no section $Elements'),
    'nodes alone lacking': (FORMAT_2[FORMAT_2.index('$Nodes'):], '', '11: error: the file has no section $Nodes'),
    'parametric nodes, too': ('$EndNodes\n', '$EndNodes\n$ParametricNodes\n', '22:1-16: error: the section $ParametricNodes is there twice'),
    'nodes twice': ('$EndNodes\n', '$EndNodes\n$Nodes\n', '22:1-6: error: the section $Nodes is there twice'),
    'elements more': ('6\n1 15', '7\n1 15', '30: error: $Elements announces 7 elements, but has 6'),
    'elements fewer': ('6\n1 15', '5\n1 15', '29: error: $Elements has more lines than it announces'),
    'cut off': ('6 3 2 2 2 2 3 6 5\n$EndElements\n', '',
                '28: error: $Elements announces 6 elements, but the file ends after 5'),
    'cut off in an element': ('3 6 5\n$EndElements\n', '3 6', '29: error: a node is lacking at the end of the line'),
    'cut off at the end': ('$EndElements\n', '', '29: error: the file ends inside the section $Elements'),
    'element node missing': ('6 3 2 2 2 2 3 6 5', '6 3 2 2 2 2 3 8 5', '29:15: error: node 8 is not in $Nodes'),
    'element node twice': ('6 3 2 2 2 2 3 6 5', '6 3 2 2 2 2 3 3 5', '29:15: error: the element has node 3 twice'),
    'element line long': ('6 3 2 2 2 2 3 6 5', '6 3 2 2 2 2 3 6 5 4', '29:19: error: the line has too many values'),
    'element twice': ('6 3 2 2 2 2 3 6 5', '5 3 2 2 2 2 3 6 5', '29: error: element 5 is given twice, first on line 28'),
    'element repeated': ('6 3 2 2 2 2 3 6 5', '6 3 2 1 2 5 4 1 2',
                         '29: error: element 6 has the same nodes as element 5 on line 28'),
    'tetrahedron': ('6 3 2 2 2 2 3 6 5', '6 4 2 2 2 2 3 6 5',
                    '29:3: error: an element of type 4 (a tetrahedron) cannot be used'),
    'third order': ('6 3 2 2 2 2 3 6 5', '6 36 2 2 2 2 3 6 5',
                    '29:3-4: error: an element of type 36 (a quadrangle of order 3 or more) cannot be used'),
    'tag lacking': ('6 3 2 2 2 2 3 6 5', '6 3 2 2', '29: error: a tag is lacking at the end of the line'),
    'line outside': ('$Elements\n', '7\n$Elements\n', '22: error: the line belongs to no section'),
    'end outside': ('$Elements\n', '$EndNodes\n$Elements\n', '22: error: the line belongs to no section'),
    'unknown section not ended': ('$Elements\n', '$NodeData\n$Elements\n',
                                  '31: error: the file ends inside the section $NodeData'),
    'byte in a number': ('4 0.5 1 0', '4 0.5\x001 1 0', '17:3-7: error: x is not a number'),
}
FAULTS_4 = {
    'binary': ('4.1 0 8', '4.1 1 8', '2:5: error: the mesh file is binary'),
    'partitioned': ('$Entities\n', '$PartitionedEntities\n', '12:1-20: error: the mesh is partitioned'),
    'entities more': ('1 3 2 0', '1 3 3 0', '20: error: $Entities announces 7 entities, but has 6'),
    'entities fewer': ('1 3 2 0', '1 3 1 0', '19: error: $Entities has more lines than it announces'),
    'entity short': ('1 0 0 1 1 0 1 4 2 2 -5 ', '1 0 0 1 1 0', '16: error: the number of physical groups is lacking'),
    'entity group lacking': ('1 0 0 1 1 0 1 4 2 2 -5 ', '1 0 0 1 1 0 1',
                             '16: error: the number of a physical group is lacking'),
    'entity group zero': ('1 0 0 1 1 0 1 4 2 2 -5 ', '1 0 0 1 1 0 1 0 2 2 -5', '16:17: error: a physical group has the number 0'),
    'entity box': ('2 1 0 0 1 1 0 1 4 2', '2 1 0 zero 1 1 0 1 4 2', '16:7-10: error: a coordinate of the entity is not a number'),
    'nodes more': ('2 7 1 7', '2 8 1 7', '38: error: $Nodes announces 8 nodes, but its blocks have 7'),
    'nodes fewer': ('2 7 1 7', '2 6 1 7', '26:7: error: the number of nodes is out of range'),
    'blocks of nodes more': ('2 7 1 7', '3 7 1 7', '39: error: $Nodes announces 3 blocks, but has 2'),
    'block of nodes more': ('2 1 1 6', '2 1 1 5', '32: error: y is lacking at the end of the line'),
    'node twice': ('\n6\n0.5', '\n3\n0.5', '32:1: error: node 3 is given twice, first on line 29'),
    'x not finite': ('0.5 1 0 0 1', 'inf 1 0 0 1', '36:1-3: error: x is not a finite number'),
    'off the plane': ('1 1 0 1 1\n', '1 1 1e-3 1 1\n', '37: error: node 5 is not in the plane z = 0: z = 0.001'),
    'behind the axis': ('0.5 1 0 0 1', '-0.5 1 0 0 1', '36: error: node 4 lies behind the axis'),
    'elements more': ('6 6 1 6', '6 7 1 6', '53: error: $Elements announces 7 elements, but its blocks have 6'),
    'elements fewer': ('6 6 1 6', '6 5 1 6', '52:7: error: the number of elements is out of range'),
    'block of elements more': ('2 2 3 1', '2 2 3 2', '52:7: error: the number of elements is out of range'),
    'type and dimension': ('2 2 3 1', '2 2 1 1', '52:5: error: elements of type 1 do not fit an entity of dimension 2'),
    'hexahedron': ('2 2 3 1', '3 2 5 1', '52:5: error: an element of type 5 (a hexahedron) cannot be used'),
    'element node missing': ('6 2 3 6 5', '6 2 3 6 9', '53:9: error: node 9 is not in $Nodes'),
    'cut off': ('2 2 3 1\n6 2 3 6 5 \n$EndElements\n', '', '51: error: $Elements announces 6 blocks, but the file ends after 5'),
}


def mesh_faults(program, folder, mesh, old, new, expectation):
    """Write the deck and the mesh file at fault, and run the deck"""
    assert mesh.count(old) == 1, old
    return made_faults(program, folder, DECK, f'mesh.msh:{expectation}', {'mesh.msh': mesh.replace(old, new)})


# The same with separate nodes at one place, and the curves of both sides in one group
SEPARATE = (FORMAT_2.replace('\n7\n1 0.5', '\n9\n1 0.5').replace('$EndNodes', '8 1 0 0\n9 1 1 0\n$EndNodes')
            .replace('2 3 6 5\n', '8 3 6 9\n7 1 2 4 4 9 8\n').replace('\n6\n1 15', '\n7\n1 15'))
# One side of the joint with middle nodes, the other without
MIDDLES = (SEPARATE.replace('\n9\n1 0.5', '\n13\n1 0.5')
           .replace('$EndNodes', '10 1.5 0 0\n11 2 0.5 0\n12 1.5 1 0\n13 1 0.5 0\n$EndNodes')
           .replace('6 3 2 2 2 8 3 6 9', '6 16 2 2 2 8 3 6 9 10 11 12 13'))

# Each makes the bytes of a mesh file that says the same
WAYS = {
    'separate nodes': SEPARATE,
    'format 4.1': FORMAT_4,
    'CR LF': FORMAT_2.replace('\n', '\r\n'),
    'CR': FORMAT_4.replace('\n', '\r'),
    'byte order mark': '\ufeff' + FORMAT_2,
    'blank lines and blanks': FORMAT_4.replace('\n', ' \t\n \n'),
    'no final newline': FORMAT_2.rstrip('\n'),
    'further sections': '$Comments\n$Nodes\n$EndComments\n' + FORMAT_2 + '$NodeData\n1\n"u"\n$EndNodeData\n',
    'numbers of groups': FORMAT_2.replace(' "outside"', ' ""').replace('"wall"', '"the wall"'),
    'rounding of zeros': FORMAT_2.replace('3 2 0 0', '3 2 0 -1e-13').replace('6 2 1 0', '6 2 1 2e-13'),
    'elements of no group': FORMAT_2.replace('\n6\n1 15', '\n7\n7 1 2 0 9 4 5\n1 15'),
    'a clockwise element': FORMAT_4.replace('6 2 3 6 5', '6 2 5 6 3'),
    'parametric nodes': FORMAT_2.replace('Nodes\n', 'ParametricNodes\n').replace('1 0.5 0 0\n', '1 0.5 0 0 0 1\n')
                        .replace('2 1 0 0\n', '2 1 0 0 1 2 0.25\n').replace('5 1 1 0\n', '5 1 1 0 2 1 0.5 1.5\n'),
    'all forms of reals': FORMAT_2.replace(' 0.5 ', ' +5.0E-01 ').replace(' 2 0 0', ' 20.0000000000000000000e-1 -0 0.')
                                  .replace(' 1 1 0', ' 1. .01d+2 0.0'),
}


def alike(program, folder, mesh):
    """Faults unless two mesh files give the same digits"""
    decks = []
    # the interface has the name of its group: a group of another name has it in both
    twin = FORMAT_2.replace('"wall"', '"the wall"') if '"the wall"' in mesh else FORMAT_2
    for name, text in (('one', twin), ('other', mesh)):
        deck = DECK
        if '"the wall"' in text:
            deck = deck.replace(' wall', ' "the wall"')
        if ' ""' in text:
            deck = deck.replace(' outside', ' 5')
        write(folder, f'{name}/mesh.msh', text)
        decks.append(write(folder, f'{name}/job.dat', deck))
    return same_results(program, decks, folder)


def several_groups(program, folder):
    """Format 2.2 repeats an element for each of its groups: a curve that is face and joint at once
    in one group each, and a body in a group that no card names"""
    more = ['7 1 2 7 3 1 2', '8 3 2 8 1 1 2 5 4', '9 3 2 8 2 2 3 6 5', '10 1 2 9 4 5 2']
    mesh = FORMAT_2.replace('\n6\n1 15', '\n10\n1 15').replace('$EndElements', '\n'.join([*more, '$EndElements']))
    return alike(program, folder, mesh)


# Eight elements round a hole, its edges in no order; the first runs from 7 to 6
HOLE = [(7, 6), (10, 11), (6, 10), (11, 7)]
RING = [(k, k + 1, k + 5, k + 4) for k in (1, 2, 3, 5, 7, 9, 10, 11)]
# The upper side from the axis on, in two directions and in no order
UPPER = [(15, 14), (15, 16), (13, 14)]


def holed_mesh(lines):
    """A square of sixteen nodes with a hole, whose curve `face` has some lines"""
    nodes = [f'{4*j + i + 1} {i} {j} 0' for j in range(4) for i in range(4)]
    elements = [f'1 2 1 1 {a} {b}' for a, b in lines] + [f'3 2 2 2 {a} {b} {c} {d}' for a, b, c, d in RING]
    return '\n'.join(['$MeshFormat', '2.2 0 8', '$EndMeshFormat', '$Nodes', '16', *nodes, '$EndNodes',
                      '$Elements', str(len(elements)), *(f'{k} {e}' for k, e in enumerate(elements, 1)),
                      '$EndElements', ''])


def same_face(program, folder, mesh, group, chain):
    """Faults unless tractions that vary along a face of GROUPS are those along a face of CHAINS"""
    bodies = DECK[DECK.index('      BODY'):DECK.index('      FACE')]
    deck = DECK.replace('    2    1       1.0\n', '2, 1, 1.0, 2.0, , 5.0, 7.0\n')
    deck = deck.replace('      FACE    2      bottom\n', f' FACE, 2, , {group}\n')
    if group == '1':
        deck = deck.replace(bodies, '      BODY    1    1 2\n').replace('     JOINT    1      wall\n', '')
        deck = deck.replace('LAWS\n    1     1.0E4     2.0E4     1.0E4       0.0      30.0\n', '')
        deck = deck.replace('      FACE    1      outside\n', '').replace('FIXEDFACES\n    1  111', 'RESTRAINTS\n    4  111')
    decks = [deck, deck.replace(f' FACE, 2, , {group}\n', '') .replace('END\n', f'CHAINS\n2, {chain}\nEND\n')]
    for k, text in enumerate(decks):
        write(folder, f'{k}/mesh.msh', mesh)
        decks[k] = write(folder, f'{k}/job.dat', text)
    return same_results(program, decks, folder)


def changed_files(program, folder):
    """Mesh files with random faults: never a crash"""
    dice = random.Random(SEED)
    for k in range(MUTATIONS):
        write(folder, f'{k}/job.dat', DECK)
        write(folder, f'{k}/mesh.msh', mutated(dice.choice((FORMAT_2, FORMAT_4)).encode(), dice))
    return accepted(program, folder, [f'{k}/job.dat' for k in range(MUTATIONS)])[1]


def cut_file(program, folder, mesh):
    """A mesh file cut off at every byte"""
    write(folder, 'job.dat', DECK)
    return cut_faults(program, folder, mesh.encode(), 'mesh.msh', len(mesh) - 1)


def example(program, folder):
    """The example of the manual and of `inputs` is the same text, and can be solved"""
    manual = read_text(os.path.join(os.path.dirname(__file__), '..', '..', 'doc', 'deck.md'))
    faults = []
    for name in ('peg.geo', 'peg.dat'):
        if input_deck(name) not in manual:
            faults.append(f'{name} is not in doc/deck.md as it is in inputs')
    write(folder, 'peg.dat', input_deck('peg.dat'))
    write(folder, 'peg.msh', input_deck('peg.msh'))
    ran = program.run('run', 'peg.dat', folder=folder)
    return faults + ran.ended_with(0) + expected('messages', '', ran.err)


# Name: mesh file, group of the face, chain of the same nodes
FACES = {
    'along a curve': (FORMAT_2, 'bottom', '1, 2'),
    'along a curve, 4.1': (FORMAT_4, 'bottom', '1, 2'),
    'against a curve': (FORMAT_2.replace('2 1 2 3 3 1 2', '2 1 2 3 3 2 1'), 'bottom', '2, 1'),
    'against a curve, 4.1': (FORMAT_4.replace('0 1 3 2 1 -2', '0 1 -3 2 1 -2'), 'bottom', '2, 1'),
    'of lines in no order': (holed_mesh(UPPER), '1', '16, 15, 14, 13'),
    'round a hole': (holed_mesh(HOLE), '1', '7, 6, 10, 11, 7'),
}


def tests(program):
    """One test a mesh file"""

    def test(name, check, *arguments):
        return Test(f'mesh file: {name}', lambda folder: check(program, folder, *arguments))

    return ([test(f'2.2: {name}', mesh_faults, FORMAT_2, *case) for name, case in FAULTS_2.items()]
            + [test(f'4.1: {name}', mesh_faults, FORMAT_4, *case) for name, case in FAULTS_4.items()]
            + [test(f'alike: {name}', alike, mesh) for name, mesh in WAYS.items()]
            + [test(f'face {name}', same_face, *case) for name, case in FACES.items()]
            + [test('cut off, 2.2', cut_file, FORMAT_2), test('cut off, 4.1', cut_file, FORMAT_4),
               test('changed at random', changed_files),
               Test('mesh file: middle nodes on one side of a joint', lambda folder: made_faults(
                   program, folder, DECK, '15:22-25: error: the elements on both sides of the curve at '
                   'r = 1, z = 0 have different middle nodes', {'mesh.msh': MIDDLES})),
               test('several groups', several_groups), test('example', example)])
