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
    faults += [f'not told: {words}' for words in ('*NODE PRINT', '*EL PRINT') if f'not translated: {words}, lines' not in said]
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


def rings(stiffness):
    """u at the bore of scenes.abaqus_rings, Lame's for both rings and a layer of a stiffness between them, and its pressure"""
    def u(r, a, b, inside, outside):
        first = (inside*a**2 - outside*b**2)/(b**2 - a**2)
        return 1.3/21000.0*(0.4*first*r + (inside - outside)*a**2*b**2/(b**2 - a**2)/r)

    overlap_by_load = u(1.5, 1.0, 1.5, 8.0, 0.0)
    overlap_by_pressure = u(1.5, 1.5, 2.0, 1.0, 0.0) - u(1.5, 1.0, 1.5, 0.0, 1.0) + (1.0/stiffness if stiffness else 0.0)
    pressure = overlap_by_load/overlap_by_pressure
    return u(1.0, 1.0, 1.5, 8.0, pressure), pressure


def abaqus_contact(program, folder, between, stiffness, words):
    """Two rings in contact, or tied: displacement and pressure by Lame; what is in the deck"""
    _, deck, summary, tables = translated(program, folder, 'rings.inp', scenes.abaqus_rings(between))
    found, (wanted, pressure) = max(row['u'] for row in tables['m = 0']), rings(stiffness)
    faults = [] if abs(found - wanted) < 1e-6*wanted else [f'u(a): expected {wanted}, found {found}']
    if stiffness:
        found = summary['increments'][-1]['largest_pressure']
        faults += [] if abs(found - pressure) < 1e-5*pressure else [f'pressure: expected {pressure}, found {found}']
    elif summary['joints']:
        faults.append('joints between what is tied')
    return faults + [f'not in the deck: {text}' for text in words if text not in deck]


def abaqus_heat(program, folder):
    """A tube warmed from 20 to 120 degrees between ends that stay: u = (1 + nu) alpha T r"""
    text = scenes.abaqus('CAX8R').replace('*STEP\n*STATIC\n*DSLOAD\nBORE, P, 8.', '*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 20.\n'
                                          '*STEP\n*STATIC\n*TEMPERATURE\nALL, 120.')
    said, _, _, tables = translated(program, folder, 'heat.inp', text)
    faults = [f"u at {row['r']}: {row['u']}" for row in tables['m = 0'] if abs(row['u'] - 1.3*1.2e-5*100.0*row['r']) > 1e-6*row['u']]
    return faults + (['told: ' + said] if '*TEMPERATURE' in said or '*INITIAL' in said or '*EXPANSION' in said else [])


def abaqus_orthotropic(program, folder):
    """A tube with three moduli, pressed from within, plane strain: u = C r^n + D r^-n"""
    e, nu12, nu13, nu23 = (9000.0, 4000.0, 21000.0), 0.25, 0.1, 0.12
    text = scenes.abaqus('CAX8R').replace('*ELASTIC\n21000., 0.3', '*ELASTIC, TYPE=ENGINEERING CONSTANTS\n'
                                          f'{e[0]}, {e[1]}, {e[2]}, {nu12}, {nu13}, {nu23}, 2000., 3000.\n1700.')
    _, deck, _, tables = translated(program, folder, 'ortho.inp', text)
    # compliance of r and theta with no strain along z: stress along z follows
    a, b, c = 1/e[0] - nu12**2*e[1]/e[0]**2, 1/e[2] - nu23**2/e[1], -(nu13 + nu12*nu23)/e[0]
    det = a*b - c*c
    c11, c33, c13 = b/det, a/det, -c/det
    n = math.sqrt(c33/c11)
    # sigma_r = (c11 n + c13) C r^(n-1) - (c11 n - c13) D r^(-n-1): -8 at 1, 0 at 2
    f, g = c11*n + c13, c11*n - c13
    first = -8.0/(f - f*2.0**(2*n))
    second = first*f*2.0**(2*n)/g
    faults = [f"u at {row['r']}: {row['u']}, not {wanted}" for row in tables['m = 0']
              for wanted in (first*row['r']**n + second*row['r']**-n,) if abs(row['u'] - wanted) > 1e-5*abs(wanted)]
    cards = 'ORTHOTROPIC\n! STEEL\n1, 9.0E+003, 4.0E+003, 2.1E+004, 0.0, 7.8E-009, 1.2E-005, 1.2E-005\n2.5E-001, 1.2E-001, 1.0E-001, 2.0E+003, 1.7E+003, 3.0E+003'
    return faults[:3] + ([] if cards in deck else [deck[:900]])


def abaqus_plates(program, folder):
    """Two flat plates, one on the other, in elements forty times as long as thick: p h (1/E + 1/k), k for a hundredth of the h/E of
    an element"""
    lines = ['*HEADING', 'Plates', '*NODE, NSET=ALL']
    lines += [f'{100*k + i}, {4.0*i:.1f}, {z}' for k, z in enumerate((0.0, 0.1, 0.1, 0.2)) for i in range(1, 4)]
    lines += ['*ELEMENT, TYPE=CAX4, ELSET=BODY', '1, 1, 2, 102, 101', '2, 2, 3, 103, 102', '3, 201, 202, 302, 301', '4, 202, 203, 303, 302',
              '*SURFACE, NAME=LOW', '1, S3', '2, S3', '*SURFACE, NAME=HIGH', '3, S1', '4, S1', '3, S1', '*SURFACE, NAME=TOP', '3, S3', '4, S3',
              '*MATERIAL, NAME=M', '*ELASTIC', '1000., 0.', '*SOLID SECTION, ELSET=BODY, MATERIAL=M', '*SURFACE INTERACTION, NAME=I',
              '*FRICTION', '0.2,', '*CONTACT PAIR, INTERACTION=I', 'LOW, HIGH', 'HIGH, LOW', '*BOUNDARY', '1, 2', '2, 2', '3, 2',
              '*STEP', '*STATIC', '*DSLOAD', 'TOP, P, 10.', '*END STEP', '*STEP', '*STATIC', '*CHANGE FRICTION, INTERACTION=I', '*FRICTION',
              '0.7,', '*CONTACT PAIR, INTERACTION=I', 'TOP, LOW', '*END STEP', '']
    _, deck, summary, tables = translated(program, folder, 'plates.inp', '\n'.join(lines))
    found, wanted = min(row['v'] for row in tables['m = 0']), -10.0*0.2/1000.0*1.005
    return ([] if abs(found - wanted) < 1e-6*abs(wanted) else [f'v: {found}, not {wanted}']) + (
        [] if summary['joints'] == 2 and exact_angle(0.2) in deck else [f"joints: {summary['joints']}\n{deck[:800]}"])


def exact_angle(friction):
    """Angle of friction as it stands in a deck"""
    return f'{math.degrees(math.atan(friction)):.12E}'[:12]


def abaqus_ties(program, folder):
    """Ties of surfaces of which the second is the smaller, a boundary above them: no face runs where sides are tied; names of
    interactions that are not there, and contact of parts that are tied elsewhere, are said"""
    tie = ('*BOUNDARY', '13, 2', '*SURFACE, NAME=BOTH', '8, S2', '7, S3', '*TIE, NAME=T', 'BOTH, HUB')
    text = scenes.abaqus_rings(tie).replace('BORE, P, 8.', 'BORE, P, 8.\nBOTH, P, 0.')
    said, _, _, tables = translated(program, folder, 'ties.inp', text)
    found, wanted = max(row['u'] for row in tables['m = 0']), rings(0)[0]
    faults = [] if abs(found - wanted) < 1e-6*wanted else [f'u(a): expected {wanted}, found {found}']
    faults += [] if '1 of the 2 sides of the first surface lie on none' in said and '*DSLOAD on sides that are tied' in said else [said]
    pair = ('*SURFACE INTERACTION, NAME=I', '*CONTACT PAIR, INTERACTION=J', 'FIT, HUB')
    ran = program.run('convert', write(folder, 'name.inp', scenes.abaqus_rings(pair)), os.path.join(folder, 'name.dat'))
    faults += ran.ended_with(2) + ([] if 'there is no interaction of the name "J"' in ran.err else [ran.err])
    pair = ('*TIE, NAME=T', 'FIT, HUB', '*SURFACE INTERACTION, NAME=J', '*CONTACT PAIR, INTERACTION=J', 'FIT, HUB')
    ran = program.run('convert', write(folder, 'both.inp', scenes.abaqus_rings(pair)), os.path.join(folder, 'both.dat'))
    return faults + ran.ended_with(0) + ([] if 'they are one body' in ran.err else [ran.err])


def abaqus_apart(program, folder):
    """Surfaces that stand apart, or do not lie on each other: told, and the end says that something is not in the deck"""
    pair = ('*SURFACE INTERACTION, NAME=DRY', '*CONTACT PAIR, INTERACTION=DRY', 'FIT, HUB')
    faults = []
    for shift, words in ((1e-3, 'surfaces that stand apart by up to 0.001'), (0.3, 'none of whose sides lie on each other')):
        new = os.path.join(folder, f'{shift}.dat')
        ran = program.run('convert', write(folder, 'apart.inp', scenes.abaqus_rings(pair, shift)), new)
        faults += ran.ended_with(0)
        faults += [f'{text} not in {ran.err}{ran.out}' for text, said in ((words, ran.err), ('1 thing of the old deck is not in it', ran.out))
                   if text not in said]
    return faults


def abaqus_places(program, folder):
    """An instance that is moved, coordinates that are rounding of 0 with a force on the axis, nodes that no element has, a later
    *BOUNDARY that replaces an earlier one, symmetry by words"""
    base = scenes.abaqus('CAX8R')
    moved = base.replace('*NODE, NSET=ALL', '*PART, NAME=P\n*NODE, NSET=ALL').replace(
        '*MATERIAL', '*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n5., 0., 0.\n*END INSTANCE\n*END ASSEMBLY\n*MATERIAL', 1)
    _, _, _, tables = translated(program, folder, 'moved.inp', moved)
    found, wanted = max(row['u'] for row in tables['m = 0']), 1.3*8.0/(21000.0*(49 - 36))*((1 - 0.6)*36*6 + 49*6)
    faults = [] if abs(found - wanted) < 1e-4*wanted else [f'moved: expected {wanted}, found {found}']
    axis = ('*HEADING\nColumn\n*NODE\n1, -1E-17, 0.\n2, 1., 0.\n3, 1., 2.\n4, 1E-17, 2.\n9, 7., 7.\n*ELEMENT, TYPE=CAX4, ELSET=E\n'
            '1, 1, 2, 3, 4\n*MATERIAL, NAME=M\n*ELASTIC\n1000., 0.\n*SOLID SECTION, ELSET=E, MATERIAL=M\n*NSET, NSET=FOOT\n1, 2\n'
            '*BOUNDARY\nFOOT, ZASYMM\n3, 2, 2, 0.5\n*STEP\n*STATIC\n*BOUNDARY\n3, 2, 2, 0.\n9, 1, 2\n*CLOAD\n4, 2, 3.\n9, 2, 1.\n*END STEP\n')
    said, deck, _, _ = translated(program, folder, 'axis.inp', axis)
    text = read_text(os.path.join(folder, 'new.lis'))
    force = re.search(r'axial force \(along z\) +(\S+)', text)
    faults += [] if force and abs(float(force.group(1)) - 3.0) < 1e-9 else [f'force on the axis: {force and force.group(0)}']
    faults += [f'in the deck: {words}' for words in ('\n9, ', 'MOVEDNODES', 'E-017') if words in deck]
    return faults + [f'not said: {words}' for words in ('*CLOAD on nodes that no element has', '*BOUNDARY of nodes that no element has',) if words not in said]


def nastran_axis(program, folder):
    """FORCEAX on a ring whose radius is rounding of 0 is the force itself"""
    deck = scenes.nastran().replace('LOAD = 10', 'LOAD = 5').replace('ENDDATA', '\n'.join((
        scenes.small_fields('RINGAX', 901, '', '1.-17', '0.', '', '', 346), scenes.small_fields('RINGAX', 902, '', '.1', '0.', '', '', 346),
        scenes.small_fields('RINGAX', 903, '', '.1', '.1', '', '', 3456), scenes.small_fields('RINGAX', 904, '', '-1.-17', '.1', '', '', 3456),
        scenes.small_fields('CTRAPAX', 901, 1, 901, 902, 903, 904), scenes.small_fields('FORCEAX', 5, 901, 0, '1.', '0.', '0.', '7.'), 'ENDDATA')))
    translated(program, folder, 'axis.bdf', deck)
    found = re.search(r'axial force \(along z\) +(\S+)', read_text(os.path.join(folder, 'new.lis')))
    return [] if found and abs(float(found.group(1)) - 7.0) < 1e-9 else [f'axial force: {found and found.group(0)}']


def unknown(program, folder):
    """A file of no program that is known says so, and nothing of cards of another"""
    ran = program.run('convert', write(folder, 'x.bdf', 'SOL 101\nCEND\nBEGIN BULK\nGRID,1,,0.,0.\nENDDATA\n'), os.path.join(folder, 'n.dat'))
    return ran.ended_with(2) + ([] if 'this is no deck of a program that is known' in ran.err and 'NPOIN is' not in ran.err else [ran.err])


CONTACT = (
    # what is between two rings, its stiffness, what the new deck has
    ('hard', ('*SURFACE INTERACTION, NAME=DRY', '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD', '*FRICTION', '0.5,',
              '*CONTACT PAIR, INTERACTION=DRY, TYPE=SURFACE TO SURFACE', 'FIT, HUB'), 100*21000/0.0625,
     ('JOINTS\n! FIT on HUB\n1, 1, ', '2.656505117707799E+001', '1, RESULTANT')),
    ('linear', ('*SURFACE INTERACTION, NAME=SOFT', '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR', '5000.',
                '*CONTACT PAIR, INTERACTION=SOFT', 'HUB, FIT'), 5000.0, ('1, 5.0E+003, 5.0E+003',)),
    ('tied', ('*TIE, NAME=T', 'FIT, HUB'), 0, ('! nodes that are tied',)))

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
    ('inp', 'TYPE=CAX8R', 'TYPE=CAXA81', r':\d+', 'no axisymmetric solids'),
    ('inp', '*STEP', '*TRANSFORM, NSET=ALL\n0., 1., 0., -1., 0., 0.\n*STEP', r':\d+', r'\*TRANSFORM: components along other'),
    ('inp', '*NSET', '*NGEN\n1, 9\n*NSET', r':\d+', r'\*NGEN: nodes and elements that keywords make'),
    ('inp', '*SOLID SECTION', '*SOLIDSECTION', r':\d+', 'element 1 has no material, nor have 15 others'),
    ('inp', '*STEP', '*INSTANCE, NAME=I, PART=P\n0., 0., 0.\n0., 0., 0., 0., 0., 1., 90.\n*STEP', r':\d+', 'an instance that is turned'),
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

    return ([test(name.__name__.replace('_', ' '), name) for name in (inputs, fields, nastran, nastran_lame, nastran_axis, ring_forces,
                                                             abaqus_loads, abaqus_heat, abaqus_orthotropic, abaqus_plates, abaqus_ties, abaqus_apart, abaqus_places, unknown)]
            + [test(f'Abaqus, {kind}', abaqus, kind, share) for kind, share in (('CAX8R', 1e-6), ('CAX8', 1e-5), ('CAX4', 2e-3))]
            + [test(f'Abaqus, contact, {name}', abaqus_contact, *more) for name, *more in CONTACT]
            + [test(f'bad {kind}, {words}', bad, kind, old, new, place, words) for kind, old, new, place, words in BAD])
