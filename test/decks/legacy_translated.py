"""`axijoint convert` from NASTRAN's decks of solids of revolution and from meshes of Abaqus and CalculiX"""
import json
import math
import os
import re

import legacy_scenes as scenes
import listing
from support import INPUTS, Test, read_text, write


def translated(program, folder, name, text):
    """Convert and solve: what was told, the new deck, summary, tables of the listing"""
    new = os.path.join(folder, 'new.dat')
    if os.path.exists(new):
        os.remove(new)
    ran = program.run('convert', write(folder, name, text), new)
    faults = ran.ended_with(0)
    if faults:
        raise AssertionError('\n'.join(faults))
    faults = program.run('run', '--quiet', new, '-o', folder).ended_with(0)
    if faults:
        raise AssertionError('\n'.join(faults))
    return (ran.err, read_text(new), json.loads(read_text(os.path.join(folder, 'new.json'))),
            listing.tables(read_text(os.path.join(folder, 'new.lis'))))


def inputs(_program, _folder):
    """inputs/legacy is what the scenes make"""
    return [f'write inputs/legacy again: {name}' for name, text in scenes.OTHERS.items()
            if read_text(os.path.join(INPUTS, 'legacy', name)) != text]


def free_fields(*values):
    """An entry in free fields"""
    return ','.join(str(value) for value in values)


def large_fields(*values):
    """An entry in fields of sixteen columns, with its continuation"""
    first = f'{values[0] + "*":<8}' + ''.join(f'{value:<16}' for value in values[1:5])
    if len(values) < 6:
        return first.rstrip()
    return first + '*A\n' + f'{"*A":<8}' + ''.join(f'{value:<16}' for value in values[5:]).rstrip()


def fields(program, folder):
    """Small, free and large fields make the same deck; reals without a letter before their exponent"""
    decks = []
    for k, entry in enumerate((scenes.small_fields, free_fields, large_fields)):
        new = os.path.join(folder, f'{k}.dat')
        faults = program.run('convert', write(folder, 'old.bdf', scenes.nastran(entry)), new).ended_with(0)
        if faults:
            return faults
        decks.append([line for line in read_text(new).split('\n') if not line.startswith('!')])
    faults = [] if '7.8E-009' in '\n'.join(decks[0]) else ['the density of 7.8-9']
    return faults + [f'fields {k}: another deck' for k in (1, 2) if decks[k] != decks[0]]


def nastran(program, folder):
    """The example: what is said of it; loads of harmonics 0 and 1 by their resultants, by hand"""
    said, deck, _, _ = translated(program, folder, 'ring.bdf', scenes.nastran())
    faults = [f'not told: {words}' for words in ('not translated: DISP, line 10', 'POINTAX, line 77',
                                                 'SPCAX of a set that case control does not choose, line 76')
              if words not in said]
    faults += [f'not in the deck: {words}' for words in ('! not translated: line 77 POINTAX',) if words not in deck]
    # 3 over 60 degrees at b = 2, 0.1 high, pulled along theta = 0; twice 4 all round from within
    lateral = 3*2.0*0.1*2*math.sin(math.radians(30))
    text = read_text(os.path.join(folder, 'new.lis'))
    found = re.search(r'lateral force \(along theta = 0\) +(\S+)', text)
    if not found or abs(float(found.group(1)) - lateral) > 1e-6:
        faults.append(f'lateral force: expected {lateral}, found {found and found.group(1)}')
    tractions = [line for line in deck.split('\n')[deck.split('\n').index('TRACTIONS') + 1:] if line[:1].isdigit()][:20]
    inside = [line for line in tractions if line.startswith('1, ')]
    if inside != ['1, 0, 8.0, 0.0, , , , , S']:
        faults.append(f'pressure all round: {inside}')
    return faults


def nastran_lame(program, folder):
    """Pressed from within alone: Lame's displacement, to what eight linear elements give"""
    deck = scenes.nastran().replace('LOAD = 10', 'LOAD = 1')
    _, _, summary, tables = translated(program, folder, 'ring.bdf', deck)
    u = max(row['u'] for row in tables['m = 0'])
    wanted = (1 + 0.3)*4.0/(21000.0*3)*((1 - 0.6) + 4)
    return [] if summary['status'] == 'converged' and abs(u - wanted) < 0.01*wanted else [f'u(a): expected {wanted}, found {u}']


def ring_forces(program, folder):
    """FORCEAX: forces of a harmonic do the work of their values on an amplitude of one; enforced displacements; triangles and
    quadrilaterals given clockwise"""
    deck = scenes.nastran().replace('LOAD = 10', 'LOAD = 5').replace('ENDDATA', '\n'.join((
        scenes.small_fields('FORCEAX', 5, 103, 1, '2.', '1.5', '-2.', '0.'),
        scenes.small_fields('FORCEAX', 5, 204, 'S0T1', '1.', '0.', '0.', '7.'), 'ENDDATA')))
    deck = re.sub(r'CTRAPAX 1       1       101     102     202     201', 'CTRAPAX 1       1       201     202     102     101', deck)
    _, _, _, _ = translated(program, folder, 'ring.bdf', deck)
    text = read_text(os.path.join(folder, 'new.lis'))
    faults = []
    for name, wanted in ((r'lateral force \(along theta = 0\)', 2*(1.5 + 2.0)), (r'axial force \(along z\)', 7.0)):
        found = re.search(name + r' +(\S+)', text)
        if not found or abs(float(found.group(1)) - wanted) > 1e-9:
            faults.append(f'{name}: expected {wanted}, found {found and found.group(1)}')
    moved = scenes.nastran().replace('LOAD = 10', 'LOAD = 99').replace(
        'ENDDATA', scenes.small_fields('SPCAX', 71, 201, 0, 1, '0.001') + '\n' + 'ENDDATA')
    _, _, _, tables = translated(program, folder, 'moved.bdf', moved)
    u = next(row['u'] for row in tables['m = 0'] if row['node'] == 201)
    return faults + ([] if abs(u - 0.001) < 1e-12 else [f'enforced displacement: {u}'])


def abaqus(program, folder, kind, share):
    """Lame's displacement; what is said of what is not translated"""
    said, deck, _, tables = translated(program, folder, 'cylinder.inp', scenes.abaqus(kind))
    u = max(row['u'] for row in tables['m = 0'])
    wanted = (1 + 0.3)*8.0/(21000.0*3)*((1 - 0.6) + 4)
    faults = [] if abs(u - wanted) <= share*wanted else [f'u(a): expected {wanted}, found {u}']
    faults += [f'not told: {words}' for words in ('*EXPANSION', '*NODE PRINT', '*EL PRINT') if f'not translated: {words}, lines' not in said]
    faults += [f'not in the deck: {words}' for words in ('! STEEL', '! node set ENDS:', '! element set INNER:', '! surface BORE: faces 1 to 1')
               if words not in deck]
    return faults


def abaqus_loads(program, folder):
    """*DLOAD on sides, GRAV, CENTRIF, *CLOAD of the whole circle, fixed components by words: resultants by hand"""
    base = scenes.abaqus('CAX4').replace('*DSLOAD\nBORE, P, 8.', '*DLOAD\nBODY, GRAV, 9.81, 0., -1.\nINNER, P4, 8.\n'
                                         'BODY, CENTRIF, 100., 0., 0., 0., 0., 1., 0.\n*CLOAD\n82, 2, 5.')
    base = base.replace('ENDS, 2, 2', 'ENDS, YSYMM').replace('82, 2', '83, 2')
    translated(program, folder, 'loads.inp', base)
    text, deck = read_text(os.path.join(folder, 'new.lis')), read_text(os.path.join(folder, 'new.dat'))
    axial = 5.0 - 9.81*7.8e-9*math.pi*3*0.1
    found = re.search(r'axial force \(along z\) +(\S+)', text)
    faults = [] if found and abs(float(found.group(1)) - axial) < 1e-6 else [f'axial: expected {axial}, found {found and found.group(1)}']
    return faults + [f'not in the deck: {words}' for words in ('ROTATION\n1.0E+001', 'GRAVITY\n-9.81', '50001, 0, 8.0') if words not in deck]


BAD = (
    # the file, what is changed to what, where the error is, what it says
    ('bdf', 'CTRAPAX 1       1       101     102', 'CTRAPAX 1       1       101     977', r':\d+:33-35', 'there is no such ring'),
    ('bdf', 'CTRAPAX 1       1 ', 'CTRAPAX 1       9 ', r':\d+:17', 'there is no such property'),
    ('bdf', 'CTRIAAX 100', 'CCONEAX 100', r':\d+', 'conical shells are no solids'),
    ('bdf', 'RINGAX  102             1.12500', 'RINGAX  102             1.1X500', r':\d+:25-31', 'this is no number'),
    ('bdf', 'AXIC    3', 'AXIC    -3', ':13:9-10', 'this is no highest harmonic'),
    ('bdf', 'SPCAX   72      105     1       12', 'SPCAX   72      105     8       12', r':\d+:25', 'this is no harmonic'),
    ('bdf', '3456', '3956', r':\d+:57-60', 'these are no components'),
    ('bdf', '21000.', '      ', ':14', 'two of E, G and nu are needed'),
    ('inp', 'TYPE=CAX8R', 'TYPE=C3D8', r':\d+', 'no axisymmetric solids'),
    ('inp', 'ENDS, 2, 2', 'END, 2, 2', r':\d+:1-3', 'there is no set of this name'),
    ('inp', 'INNER, S4', 'INNER, S9', r':\d+:8-9', 'this is no side'),
    ('inp', '21000., 0.3', '21x., 0.3', r':\d+:1-4', 'this is no number'),
    ('inp', 'ELSET=BODY, MATERIAL=STEEL', 'ELSET=BODY, MATERIAL=WOOD', r':\d+', 'there is no material WOOD'),
    ('inp', '\n1, 1, 0, 0.', '\n0, 1, 0, 0.', r':5:1', 'this is no number of a node'),
    ('inp', '*STEP', '*INCLUDE, INPUT=a.inp\n*STEP', r':\d+', r'\*INCLUDE is not read'),
    ('inp', 'BORE, P, 8.', 'BOAR, P, 8.', r':\d+:1-4', 'there is no surface of this name'),
    ('inp', '*ELASTIC', '*CONDUCTIVITY', r':\d+', 'material STEEL has no'),
)


def bad(program, folder, kind, old, new, place, words):
    """An error with its place; no new deck"""
    text = scenes.OTHERS[f'cylinder.{kind}']
    if old not in text:
        return [f'nothing to change: {old}']
    ran = program.run('convert', write(folder, f'bad.{kind}', text.replace(old, new, 1)), os.path.join(folder, 'new.dat'))
    faults = ran.ended_with(2)
    if not re.search(rf'bad\.{kind}{place}: error: .*{words}', ran.err):
        faults.append(f'expected {place}: {words}\n{ran.err[:1200]}')
    return faults + (['a new deck'] if os.path.exists(os.path.join(folder, 'new.dat')) else [])


def tests(program):
    """The tests of this module"""

    def test(name, function, *arguments):
        return Test(f'legacy translated: {name}', lambda folder: function(program, folder, *arguments))

    return ([test(name.__name__.replace('_', ' '), name) for name in (inputs, fields, nastran, nastran_lame, ring_forces, abaqus_loads)]
            + [test(f'Abaqus, {kind}', abaqus, kind, share) for kind, share in (('CAX8R', 1e-6), ('CAX8', 1e-5), ('CAX4', 2e-3))]
            + [test(f'bad {kind}, {words}', bad, kind, old, new, place, words) for kind, old, new, place, words in BAD])
