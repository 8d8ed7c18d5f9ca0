"""`axijoint convert`: what means something else than it seems to, or cannot be translated, in files of Abaqus and CalculiX, of
NASTRAN, of Owen and Hinton's program"""
import math
import os
import re

import legacy_scenes as scenes
import listing
from support import Test, read_text, write

SAME = 1e-9


def bar(*step, before=(), heading='Bar', low='LOW'):
    """A bar of Abaqus, 2 high, radius 1, E = 1000, no Poisson's ratio, that stands on its lower end: the lower half of density 2, the
    upper one of density 3"""
    lines = ['*HEADING', heading, '*NODE']
    lines += [f'{3*j + i + 1}, {i/2}, {j/2}' for j in range(5) for i in range(3)]
    for name, first, row in ((low, 1, 0), ('UP', 101, 2)):
        lines.append(f'*ELEMENT, TYPE=CAX4, ELSET={name}')
        for k in range(4):
            a = 3*(row + k//2) + k % 2 + 1
            lines.append(f'{first + k}, {a}, {a + 1}, {a + 4}, {a + 3}')
    for name, section, density in (('A', low, 2), ('B', 'UP', 3)):
        lines += [f'*MATERIAL, NAME={name}', '*ELASTIC', '1000., 0.', '*DENSITY', f'{density}.',
                  f'*SOLID SECTION, ELSET={section}, MATERIAL={name}']
    lines += ['*NSET, NSET=FOOT, GENERATE', '1, 3, 1', '*NSET, NSET=TOP', '13, 14, 15', '*BOUNDARY', 'FOOT, 2, 2']
    return '\n'.join([*lines, *before, '*STEP', '*STATIC', *step, '*END STEP', ''])


def ring(*bulk, case=('LOAD = 1', 'SPC = 7'), harmonic=3, title='RING', inner='1.0'):
    """A ring of NASTRAN of one element, from r = 1 to 2, 1 high, E = 1000, no Poisson's ratio, that stands on rings 1 and 2"""
    cards = ['ID A,B', 'SOL 1', 'CEND', f'TITLE = {title}', 'AXISYM = COSINE', *case, 'BEGIN BULK', f'AXIC,{harmonic}']
    if not any(card.startswith('MAT1') for card in bulk):
        cards.append('MAT1,1,1000.,,0.,2.')
    cards += ['PTRAPAX,1,,1', 'CTRAPAX,1,1,1,2,3,4']
    cards += [f'RINGAX,{k},,{r},{z},,,456' for k, r, z in ((1, inner, '0.'), (2, '2.', '0.'), (3, '2.', '1.'), (4, inner, '1.'))]
    cards += [f'SPCAX,7,{k},S0T{harmonic},123,0.' for k in (1, 2)]
    return '\n'.join([*cards, *bulk, 'ENDDATA', ''])


class Converted:
    """What `axijoint convert` and `axijoint run` make of a text: what is said, the new deck, its displacements by node"""

    def __init__(self, program, folder, name, text):
        self.folder, self.program, self.new = folder, program, os.path.join(folder, 'new.dat')
        if os.path.exists(self.new):
            os.remove(self.new)
        ran = program.run('convert', write(folder, name, text), self.new)
        self.faults = ran.ended_with(0)
        self.said = ran.err
        self.deck = read_text(self.new).split('\n') if os.path.exists(self.new) else []

    def section(self, keyword):
        """Cards of a section without remarks"""
        if keyword not in self.deck:
            return []
        cards = self.deck[self.deck.index(keyword) + 1:]
        ends = [k for k, card in enumerate(cards) if re.fullmatch('[A-Z]+', card)]
        return [card for card in cards[:ends[0]] if not card.startswith('!')]

    def solve(self):
        """Displacements of harmonic 0 by node"""
        self.faults += self.program.run('run', '--quiet', self.new, '-o', self.folder).ended_with(0)
        if self.faults:
            raise AssertionError('\n'.join(self.faults))
        return {row['node']: row for row in listing.tables(read_text(os.path.join(self.folder, 'new.lis')))['m = 0']}

    def expect(self, keyword, *cards):
        """A section has these cards"""
        if self.section(keyword) != list(cards):
            self.faults.append(f'{keyword}: expected {list(cards)}, found {self.section(keyword)}')
        return self

    def told(self, *words):
        """This was said"""
        self.faults += [f'not told: {text}\n{self.said[:1500]}' for text in words if text not in self.said]
        return self


def body_loads(program, folder):
    """GRAV and CENTRIF act on their sets: the displacement of the top by hand, cards of the new deck"""
    faults = []
    for lines, wanted, densities in (
            ((', GRAV, 10., 0., -1., 0.',), 0.055, ['1, 1.0E+003, 0.0, 2.0', '2, 1.0E+003, 0.0, 3.0']),
            (('LOW, GRAV, 10., 0., -1., 0.', 'UP, GRAV, 10., 0., -1., 0.'), 0.055, ['1, 1.0E+003, 0.0, 2.0', '2, 1.0E+003, 0.0, 3.0']),
            (('UP, GRAV, 10., 0., -1., 0.',), 0.045, ['2, 1.0E+003, 0.0, 3.0', '3, 1.0E+003, 0.0, 0.0']),
            (('LOW, GRAV, 10., 0., -1., 0.',), 0.010, ['1, 1.0E+003, 0.0, 2.0', '4, 1.0E+003, 0.0, 0.0']),
            (('1, GRAV, 10., 0., -1., 0.', '2, GRAV, 10., 0., -1., 0.', 'UP, GRAV, 10., 0., -1., 0.'), None,
             ['1, 1.0E+003, 0.0, 2.0', '2, 1.0E+003, 0.0, 3.0', '3, 1.0E+003, 0.0, 0.0'])):
        got = Converted(program, folder, 'bar.inp', bar('*DLOAD', *lines)).expect('GRAVITY', '-1.0E+001')
        got.expect('MATERIALS', *densities)
        v = -got.solve()[13]['v']
        faults += got.faults
        if wanted and abs(v - wanted) > 1e-8:
            faults.append(f'{lines}: expected {wanted}, found {v}')
    for lines, materials in ((('UP, CENTRIF, 4., 0., 0., 0., 0., 1., 0.',), ['2, 1.0E+003, 0.0, 3.0', '3, 1.0E+003, 0.0, 0.0']),
                             (('UP, CENTRIF, 4., 0., 0., 0., 0., 1., 0.', 'LOW, CENTRIF, 4., 0., 0., 0., 0., 1., 0.'),
                              ['1, 1.0E+003, 0.0, 2.0', '2, 1.0E+003, 0.0, 3.0'])):
        faults += Converted(program, folder, 'bar.inp', bar('*DLOAD', *lines)).expect('ROTATION', '2.0').expect('MATERIALS', *materials).faults
    return faults


def gravity_directions(program, folder):
    """A direction that is no unit vector is one; one across the axis is left out, and said to be"""
    got = Converted(program, folder, 'bar.inp', bar('*DLOAD', ', GRAV, 10., 0., -2.'))
    faults = got.expect('GRAVITY', '-1.0E+001').told('the direction of GRAV has the length 2').faults
    for direction in ('1., -1., 0.', '0., 0., -1.'):
        got = Converted(program, folder, 'bar.inp', bar('*DLOAD', f', GRAV, 10., {direction}'))
        faults += got.expect('GRAVITY').told('not translated: *DLOAD of kind GRAV across the axis, line').faults
    got = Converted(program, folder, 'bar.inp', bar('*DLOAD', ', CENTRIF, 4., 0., 0., 0., 1., 0., 0.'))
    return faults + got.expect('ROTATION').told('not translated: *DLOAD of kind CENTRIF about another axis, line').faults


def sets_of_nodes(program, folder):
    """*NSET of a set of elements has their nodes, each once; GENERATE those that are there, however far it goes; nodes and elements
    may stand below the sets"""
    held = [f'{k}, 110' for k in range(1, 4)] + [f'{k}, 100' for k in range(4, 10)]
    faults = []
    for lines in (('*NSET, NSET=WALL, ELSET=LOW',), ('*NSET, NSET=WALL, GENERATE', '1, 9')):
        got = Converted(program, folder, 'bar.inp', bar(before=(*lines, '*BOUNDARY', 'WALL, 1, 1')))
        faults += got.expect('RESTRAINTS', *held).faults
    text = bar('*CLOAD', 'ODD, 2, 1.', before=('*NSET, NSET=ODD, GENERATE', '3, 2000000000, 6'))
    for way in (text, text.replace('*NODE\n', '*NSET, NSET=ODD, GENERATE\n3, 2000000000, 6\n*NODE\n', 1).replace(
            '*NSET, NSET=ODD, GENERATE\n3, 2000000000, 6\n*STEP', '*STEP')):
        got = Converted(program, folder, 'bar.inp', way)
        faults += got.faults + ([] if [card.split(',')[0] for card in got.section('RINGLOADS')] == ['3', '9', '15'] else
                                [f"GENERATE: {got.section('RINGLOADS')}"])
    return faults


def left_out(program, folder):
    """What is not translated for a reason: the reason is said, and no card is made of it"""
    time = ('*AMPLITUDE, NAME=RAMP', '0., 0., 1., 0.5')
    faults = []
    for lines, keyword, cards, words in (
            (('*DLOAD, AMPLITUDE=RAMP', '103, P3, 5.'), 'PRESSURES', (), '*DLOAD of kind P3 with AMPLITUDE=RAMP'),
            (('*DLOAD, AMPLITUDE=RAMP', ', GRAV, 10., 0., -1.'), 'GRAVITY', (), '*DLOAD of kind GRAV with AMPLITUDE=RAMP'),
            (('*CLOAD, AMPLITUDE=RAMP', '13, 2, 7.'), 'RINGLOADS', (), '*CLOAD of component 2 with AMPLITUDE=RAMP'),
            (('*CLOAD', '13, 1, 5.', '13, 2, 7.'), 'RINGLOADS', ('13, 0, , 7.0',), '*CLOAD of component 1 on the axis'),
            (('*BOUNDARY, TYPE=VELOCITY', 'TOP, 2, 2, 0.25'), 'MOVEDNODES', (), '*BOUNDARY with TYPE=VELOCITY'),
            (('*BOUNDARY, AMPLITUDE=RAMP', 'TOP, 2, 2, 0.25', '15, 1'), 'MOVEDNODES', (), '*BOUNDARY with AMPLITUDE=RAMP'),
            (('*BOUNDARY, AMPLITUDE=RAMP', 'TOP, 2, 2, 0.25', '15, 1'), 'RESTRAINTS', ('1, 010', '2, 010', '3, 010', '15, 100'), ''),
            (('*BOUNDARY, USER', 'TOP, 2, 2'), 'RESTRAINTS', ('1, 010', '2, 010', '3, 010'), '*BOUNDARY with USER')):
        got = Converted(program, folder, 'bar.inp', bar(*lines, before=time))
        line = bar(*lines, before=time).split('\n').index(lines[1]) + 1
        faults += got.expect(keyword, *cards).faults
        if words:
            faults += got.told('not translated: ' + words, f'line {line}\n').faults
    return faults


def parameters(program, folder):
    """Parameters of keywords that are translated: those that are not known are listed, each at its line; those that change nothing
    are passed over"""
    faults = []
    text = bar('*CLOAD, FOLLOWER', '15, 2, 7.', '*DLOAD, OP=NEW', '103, P3, 5.')
    for old, new, words in (
            ('*STEP', '*STEP, NLGEOM=YES, INC=5,\n PERTURBATION, NAME=one', ('NLGEOM=YES of *STEP', 'PERTURBATION of *STEP')),
            ('*STEP', '*Step, nlgeom', ('NLGEOM of *STEP',)),
            ('*STATIC', '*STATIC, RIKS', ('RIKS of *STATIC',)),
            ('*SOLID SECTION, ELSET=LOW,', '*SOLID SECTION, ELSET=LOW, ORIENTATION=O, CONTROLS=C,',
             ('ORIENTATION=O of *SOLID SECTION', 'CONTROLS=C of *SOLID SECTION')),
            ('*ELASTIC', '*ELASTIC, DEPENDENCIES=1', ('DEPENDENCIES=1 of *ELASTIC',)),
            ('*DENSITY', '*DENSITY, DEPENDENCIES=1', ('DEPENDENCIES=1 of *DENSITY',)),
            ('*BOUNDARY', '*BOUNDARY, FIXED', ('FIXED of *BOUNDARY',)),
            ('*STEP', '*STEP, NLGEOM=NO, INC=5, UNSYMM=YES', ()),
            ('*ELASTIC', '*ELASTIC, TYPE=ISOTROPIC, MODULI=LONG TERM', ()),
            ('*NODE', '*NODE, SYSTEM=R, NSET=ALL', ()),
            ('*NSET, NSET=FOOT, GENERATE', '*NSET, NSET=FOOT, INTERNAL, GENERATE', ())):
        got = Converted(program, folder, 'bar.inp', text.replace(old, new, 1))
        lines = text.replace(old, new, 1).upper().split('\n')
        wanted = ('FOLLOWER of *CLOAD', *words)
        for word in wanted:
            at = [k for k, line in enumerate(lines, 1) if word.split(' of ')[0] in line]
            got.told(f'bar.inp:{at[0]}: warning: not translated: {word}, line {at[0]}\n')
        faults += got.faults
        if got.said.count('not translated') != len(wanted):
            faults.append(f'{new}: {got.said}')
    return faults


def fields(program, folder):
    """Fields of entries that are translated: those that are not read are listed unless they are blank or zero"""
    cards = ('MAT1,1,1000.,,0.,2.,1.-5,20.,0.', ',3.,4.,5.,6', 'PRESAX,1,5.,3,4,0.,360.,7', 'GRAV,1,4,10.,0.,0.,-1.', 'SPCAX,7,3,1,1,0.,8')
    got = Converted(program, folder, 'ring.bdf', ring(*cards).replace('SOL 1', 'SOL 3,1').replace('1,2,3,4\n', '1,2,3,4,30.\n'))
    lines = ring(*cards).split('\n')
    faults = got.expect('GRAVITY').faults
    for card, words in ((cards[0], 'field 7 of MAT1, 1.-5'), (cards[0], 'field 8 of MAT1, 20.'), (cards[1], 'field 13 of MAT1, 6'),
                        (cards[2], 'field 8 of PRESAX, 7'), (cards[3], 'GRAV in coordinate system 4'), (cards[4], 'field 7 of SPCAX, 8'),
                        ('CTRAPAX,1,1,1,2,3,4', 'field 8 of CTRAPAX, 30.'), ('SOL 1', 'SOL 3,1: linear statics is translated')):
        faults += got.told(f'not translated: {words}, line {lines.index(card) + 1}\n').faults
    if got.said.count('not translated') != 8:
        faults.append(got.said)
    got = Converted(program, folder, 'ring.bdf', ring('MAT1,1,1000.,500.,0.,2.'))
    faults += got.faults + ([got.said] if 'MAT1' in got.said else [])
    got = Converted(program, folder, 'ring.bdf', ring('MAT1,1,1000.,400.,0.,2.'))
    return faults + got.told('not translated: G of MAT1, which is not that of E and nu, line').faults


def tables(program, folder):
    """*ELASTIC and *DENSITY of several temperatures: the first line counts, the others are said to be left out"""
    text = bar('*DLOAD', '103, P3, 5.').replace('1000., 0.\n*DENSITY\n2.', '1000., 0., 20.\n500., 0.3, 300.\n*DENSITY\n2., 20.\n1., 300.', 1)
    got = Converted(program, folder, 'bar.inp', text).expect('MATERIALS', '1, 1.0E+003, 0.0, 2.0', '2, 1.0E+003, 0.0, 3.0')
    first = text.split('\n').index('500., 0.3, 300.') + 1
    return got.told(f'not translated: *ELASTIC of other temperatures than that of its first line, line {first}',
                    f'not translated: *DENSITY of other temperatures than that of its first line, line {first + 3}').faults


def boundaries_anew(program, folder):
    """OP=NEW on the first *BOUNDARY of a step removes what is above, on later ones nothing; OP=MOD adds"""
    faults = []
    for lines, cards in ((('*BOUNDARY, OP=NEW', '1, 1, 2'), ['1, 110']),
                         (('*BOUNDARY, OP=NEW', '1, 1, 2', '*BOUNDARY, OP=NEW', '2, 2'), ['1, 110', '2, 010']),
                         (('*BOUNDARY, OP=MOD', '1, 1, 2'), ['1, 110', '2, 010', '3, 010']),
                         (('*BOUNDARY', '1, 1', '*BOUNDARY, OP=NEW', '2, 1'), ['1, 110', '2, 110', '3, 010'])):
        faults += Converted(program, folder, 'bar.inp', bar(*lines)).expect('RESTRAINTS', *cards).faults
    return faults


def radial_force_on_axis(program, folder):
    """A radial force on the axis in Owen and Hinton's format is said to be left out; the axial one is there"""
    text = scenes.disc((1.0,))
    at = next(k for k, line in enumerate(text.split('\n')) if line.startswith('CENTRIFUGAL')) + 2
    lines = text.split('\n')
    lines[at] = f'{1:5d}{7.0:10.3f}{3.0:10.3f}'
    got = Converted(program, folder, 'disc.dat', '\n'.join(lines)).told(
        f'disc.dat:{at + 1}:11-15: warning: F_r on the axis, where nothing moves along r')
    return got.faults + ([] if got.section('RINGLOADS')[:1] == ['1, 0, , 3.0'] else [f"{got.section('RINGLOADS')[:1]}"])


def force_of_harmonics(program, folder):
    """FORCEAX over a sequence of harmonics says the same as a card for each: FP is left out in harmonic 0 alone"""
    texts = (('FORCEAX,1,3,S0T3,2.0,0.,4.,-5.',), [f'FORCEAX,1,3,{m},2.0,0.,4.,-5.' for m in range(4)])
    decks = [Converted(program, folder, 'ring.bdf', ring(*cards)) for cards in texts]
    faults = decks[0].told('not translated: FORCEAX of FP in harmonic 0, which is torsion').faults + decks[1].faults
    if decks[0].section('RINGLOADS') != decks[1].section('RINGLOADS'):
        faults.append(f"a sequence: {decks[0].section('RINGLOADS')}\na card each: {decks[1].section('RINGLOADS')}")
    for m, card in enumerate(decks[0].section('RINGLOADS')):
        found = [float(field) for field in card.split(', ')[2:5]]
        length = (4 if m == 0 else 2)*math.pi
        wanted = [0.0, -10/length, 8/length if m else 0.0]
        if any(abs(a - b) > SAME for a, b in zip(found, wanted)):
            faults.append(f'harmonic {m}: expected {wanted}, found {found}')
    return faults


def subcases(program, folder):
    """Of several subcases the first is translated, with what stands above all of them, and this is said; a single one is none"""
    both = ('SPC = 7', 'SUBCASE 1', ' LOAD = 1', 'SUBCASE 2', ' LOAD = 2', ' SPC = 9')
    bulk = ('PRESAX,1,5.,3,4,0.,360.', 'PRESAX,2,50.,3,4,0.,360.', 'SPCAX,9,4,S0T3,1,0.')
    held = [f'{k}, 111, , , 0, 3, S' for k in (1, 2)]
    got = Converted(program, folder, 'ring.bdf', ring(*bulk, case=both))
    line = ring(*bulk, case=both).split('\n').index('SUBCASE 2') + 1
    faults = got.expect('RESTRAINTS', *held).expect('TRACTIONS', '1, 0, 0.0, 5.0, , , , , S').told(
        f'not translated: case control of further subcases: SUBCASE 1, the first, is translated, lines {line} to {line + 2}',
        'not translated: PRESAX of a set that SUBCASE 1, the subcase that is translated, does not choose, line',
        'not translated: SPCAX of a set that SUBCASE 1, the subcase that is translated, does not choose, line').faults
    got = Converted(program, folder, 'ring.bdf', ring(bulk[0], case=both[:3]))
    faults += got.expect('RESTRAINTS', *held).expect('TRACTIONS', '1, 0, 0.0, 5.0, , , , , S').faults
    return faults + ([f'said of a single subcase: {got.said}'] if 'not translated' in got.said else [])


def titles(program, folder):
    """Titles that are too long, or keywords here, make decks that can be read"""
    long, wide = 'x y '*30, 'ä b '*30
    faults = []
    for heading, wanted in ((long, long[:79]), (wide, wide[:79]), ('Control', '"Control"'), ('End', '"End"'), ('NODES  7', '"NODES  7"'),
                            ('Nodes of a pile', 'Nodes of a pile'), (' End', ' End')):
        for name, text, title in (('bar.inp', bar('*DLOAD', '103, P3, 5.', heading=heading), wanted),
                                  ('ring.bdf', ring('PRESAX,1,5.,3,4,0.,360.', title=heading), wanted.upper().strip()),
                                  ('old.dat', scenes.cylinder(scenes.MISES, (1.0,)).replace('THICK CYLINDER', heading, 1), wanted)):
            if name == 'ring.bdf' and (heading == wide or heading.startswith(' ')):
                continue
            got = Converted(program, folder, name, text)
            faults += got.faults
            if got.deck[1:2] != [title]:
                faults.append(f'{name}: expected {title}, found {got.deck[1:2]}')
            faults += program.run('check', got.new).ended_with(0)
            if len(heading) > 80:
                faults += got.told('the title is cut to 80 characters').faults
    return faults


def headings(program, folder):
    """Further lines of a heading are remarks"""
    got = Converted(program, folder, 'bar.inp', bar('*DLOAD', '103, P3, 5.', heading='Bar\nof two halves\nEnd'))
    got.solve()
    return got.faults + ([] if got.deck[1] == 'Bar' and {'! of two halves', '! End'} <= set(got.deck) else got.deck[:6])


def force_on_axis(program, folder):
    """FORCEAX on the axis: the axial force in harmonic 0; what else there is, is left out and said to be"""
    got = Converted(program, folder, 'ring.bdf', ring('FORCEAX,1,4,0,2.,0.,0.,-5.', inner='0.')).expect('RINGLOADS', '4, 0, , -1.0E+001')
    faults = got.faults + (['said without need'] if 'FORCEAX' in got.said else [])
    faults += program.run('check', got.new).ended_with(0)
    got = Converted(program, folder, 'ring.bdf', ring('FORCEAX,1,4,S0T2,2.,1.,0.,-5.', inner='0.')).expect('RINGLOADS', '4, 0, , -1.0E+001')
    faults += got.told('not translated: FORCEAX on the axis, but for FZ in harmonic 0, line').faults
    return faults + program.run('check', got.new).ended_with(0)


def moved_around(program, folder):
    """SPCAX of component 2 that is not zero: in harmonics above 0; in harmonic 0 it is torsion, which is said"""
    cards = [f'3, {m}, , , 1.0E-001, S, , , ONLY' for m in (1, 2)]
    got = Converted(program, folder, 'ring.bdf', ring('SPCAX,7,3,S0T2,2,0.1')).expect('MOVEDNODES', *cards)
    faults = got.told('not translated: SPCAX of component 2 in harmonic 0, which is torsion, line').faults
    faults += program.run('check', got.new).ended_with(0)
    got = Converted(program, folder, 'ring.bdf', ring('SPCAX,7,3,S0T1,12,0.1')).expect(
        'MOVEDNODES', '3, 0, 1.0E-001, , , S, , , ONLY', '3, 1, 1.0E-001, , 1.0E-001, S, , , ONLY')
    faults += got.faults + program.run('check', got.new).ended_with(0)
    got = Converted(program, folder, 'ring.bdf', ring('SPCAX,7,3,1,5,0.1')).expect('MOVEDNODES')
    return faults + got.told('not translated: SPCAX of a rotation').faults


BAD = (
    # what, the text, its ending, where the error is, what it says
    ('gravity that differs', bar('*DLOAD', 'LOW, GRAV, 10., 0., -1.', 'UP, GRAV, 9., 0., -1.'), 'inp', r':\d+',
     'GRAV of this line acts on element 1, and not alike on element 101'),
    ('gravity twice', bar('*DLOAD', ', GRAV, 10., 0., -1.', 'UP, GRAV, 10., 0., -1.'), 'inp', r':\d+:1-2', r'element 101 has GRAV of line \d+ already'),
    ('gravity and rotation of other sets', bar('*DLOAD', ', GRAV, 10., 0., -1.', 'UP, CENTRIF, 4., 0., 0., 0., 0., 1., 0.'), 'inp', r':\d+',
     'CENTRIF of this line acts on element 101, and not alike on element 1'),
    ('gravity of no set', bar('*DLOAD', 'NONE, GRAV, 10., 0., -1.'), 'inp', r':\d+:1-4', 'there is no set of this name'),
    ('gravity without direction', bar('*DLOAD', ', GRAV, 10.'), 'inp', r':\d+', 'GRAV has no direction'),
    ('pressure over nothing', ring('PRESAX,1,5.,3,4,330.,30.'), 'bdf', r':\d+:22-24', 'the second angle is not above the first'),
    ('a negative square', bar('*DLOAD', ', CENTRIF, -4., 0., 0., 0., 0., 1., 0.'), 'inp', r':\d+:12-14', 'no square of an angular velocity'),
)


TRIANGLES = '''*HEADING
Two triangles
*NODE
1, 1., 0.
2, 2., 0.
3, 2., 1.
4, 1., 1.
*ELEMENT, TYPE=CAX3, ELSET=E
1, 1, 2, 3
2, 1, 3, 4
*MATERIAL, NAME=M
*ELASTIC
1000., 0.
*SOLID SECTION, ELSET=E, MATERIAL=M
*BOUNDARY
1, 2
2, 2
'''

BAD += (
    ('another file', ring("INCLUDE 'loads.bdf'"), 'bdf', r':\d+', 'INCLUDE is not read'),
    ('another file in case control', ring(case=("INCLUDE 'case.bdf'", 'LOAD = 1')), 'bdf', ':6', 'INCLUDE is not read'),
    ('a material twice', ring('MAT1,1,1000.,,0.,2.', 'MAT1,1,2000.,,0.,2.'), 'bdf', r':\d+:6', 'a material of this number is there already'),
    ('a material that is not there', ring('MAT1,2,1000.,,0.,2.'), 'bdf', r':\d+:11', 'its property has material 1, and there is no MAT1'),
    ('an element twice', ring('CTRAPAX,1,1,1,2,3,4'), 'bdf', r':\d+:9', 'an element of this number is there already'),
    ('a property twice', ring('PTRIAAX,1,,1'), 'bdf', r':\d+:9', 'a property of this number is there already'),
    ('displacements of no components', ring('SPCAX,7,3,1,X,0.1'), 'bdf', r':\d+:13', 'these are no components'),
    ('a held node that is not there', bar('*BOUNDARY', '99, 2, 2'), 'inp', r':\d+:1-2', 'there is no node 99'),
    ('cylindrical coordinates', bar().replace('*NODE', '*NODE, SYSTEM=C', 1), 'inp', ':3:8-15', 'coordinates that are not r and z'),
    ('coordinates from elsewhere', bar().replace('*NODE', '*SYSTEM\n0., 0., 0., 0., 1., 0.\n*NODE', 1), 'inp', ':3',
     r'\*SYSTEM: coordinates that are not r and z'),
    ('nodes of another file', bar().replace('*NODE', '*NODE, INPUT=nodes.inp', 1), 'inp', ':3:8-22', 'another file is not read'),
    ('elastic constants that are not isotropic', bar().replace('*ELASTIC', '*ELASTIC, TYPE=TRACTION', 1), 'inp',
     r':\d+:11-23', r'\*ELASTIC of this type is not translated'),
    ('nodes of no elements', bar(before=('*NSET, NSET=WALL, ELSET=NONE',)), 'inp', r':\d+', 'there is no set NONE'),
    ('GENERATE backwards', bar(before=('*NSET, NSET=X, GENERATE', '3, 1, -1')), 'inp', r':\d+', 'GENERATE has no numbers from 3 to 1 in steps of -1'),
    ('GENERATE from below', bar(before=('*NSET, NSET=X, GENERATE', '3, 1')), 'inp', r':\d+', 'GENERATE has no numbers from 3 to 1 in steps of 1'),
    ('GENERATE of nothing', bar(before=('*NSET, NSET=X, GENERATE', '16, 2000000000')), 'inp', r':\d+', 'none of these numbers is there'),
    ('a fourth side of a triangle, P4', TRIANGLES + '*STEP\n*DLOAD\n1, P4, 5.\n*END STEP\n', 'inp', ':20:4-5',
     'element 1 is a triangle and has no such side'),
    ('a fourth side of a triangle, S4', TRIANGLES + '*SURFACE, NAME=S\nE, S4\n*STEP\n*DSLOAD\nS, P, 5.\n*END STEP\n', 'inp', ':19:4-5',
     'element 1 is a triangle and has no such side'),
)


def quotes(program, folder):
    """Names in quotes, with blanks, are found wherever they stand"""
    before = ('*NSET, NSET="right end"', '13, 14, 15', '*ELSET, ELSET="last one"', '104', '*SURFACE, NAME="up here"', '"last one", S3')
    step = ('*CLOAD', '"Right End", 2, 0.', '*DLOAD', '"last one", P3, 2.', '"Low Set", GRAV, 10., 0., -1.', '*DSLOAD', '"up here", P, 3.')
    got = Converted(program, folder, 'bar.inp', bar(*step, before=before, low='"low set"'))
    got.expect('PRESSURES', '50001, 0, 2.0', '1, 0, 3.0').expect('GRAVITY', '-1.0E+001')
    return got.faults + ([] if len(got.section('RINGLOADS')) == 3 else [f"{got.section('RINGLOADS')}"])


def no_name(program, folder):
    """A dash is no name of a new deck"""
    ran = program.run('convert', write(folder, 'bar.inp', bar('*DLOAD', '103, P3, 5.')), '-', folder=folder)
    faults = ran.ended_with(5)
    faults += [] if 'is no name of a new deck' in ran.err else [ran.err]
    return faults + (['a file named -'] if os.path.exists(os.path.join(folder, '-')) else [])


UNREADABLE = (
    # what, the text, what is wrong with the new deck
    ('clockwise', bar('*DLOAD', '103, P3, 5.').replace('1, 1, 2, 5, 4\n', '1, 4, 5, 2, 1\n', 1), 'the nodes of element 1 run clockwise'),
    ('pressure inside a body', bar('*DLOAD', 'LOW, P3, 5.'), 'the edge 5-4 is inside a body'),
)


def unreadable(program, folder, text, words):
    """A new deck that cannot be read is said to be so"""
    new = os.path.join(folder, 'new.dat')
    ran = program.run('convert', write(folder, 'bar.inp', text), new)
    faults = ran.ended_with(2)
    if 'new.dat: written, but it has errors' not in ran.err or not re.search(rf'new\.dat:\d+.*error: .*{words}', ran.err):
        faults.append(f'expected {words}\n{ran.err[:1200]}')
    faults += [f'said: {ran.out}'] if 'solves it' in ran.out else []
    return faults + ([] if os.path.exists(new) else ['no new deck'])


def bad(program, folder, text, ending, place, words):
    """An error with its place; no new deck"""
    ran = program.run('convert', write(folder, f'bad.{ending}', text), os.path.join(folder, 'new.dat'))
    faults = ran.ended_with(2)
    if not re.search(rf'bad\.{ending}{place}: error: .*{words}', ran.err):
        faults.append(f'expected {place}: {words}\n{ran.err[:1200]}')
    return faults + (['a new deck'] if os.path.exists(os.path.join(folder, 'new.dat')) else [])


def continued_keywords(program, folder):
    """A keyword that goes on after a comma at the end of its line is that of one line; data after a comma too many are data"""
    text = bar('*DLOAD', 'EALL, GRAV, 9.81, 0., -1., 0.', before=('*ELSET, ELSET=EALL', 'LOW, UP'))
    whole = Converted(program, folder, 'bar.inp', text)
    apart = [re.sub(', *([A-Z]+=)', r',\n ** between\n  \1', line) if line.startswith('*') else line for line in text.split('\n')]
    commas = [line + ',' if line in ('*ELASTIC', '*DENSITY', '*DLOAD', '*NODE') else line for line in text.split('\n')]
    faults = whole.faults
    for lines in (apart, commas):
        other = Converted(program, folder, 'bar.inp', '\n'.join(lines))
        if '\n'.join(lines) == text or other.faults or other.deck != whole.deck:
            faults.append(f'another deck of\n{lines}')
    return faults


def sections_first(program, folder):
    """Sections that stand above the materials that they name"""
    lines = bar('*CLOAD', '15, 2, 7.').split('\n')
    sections = [line for line in lines if line.startswith('*SOLID SECTION')]
    first = lines.index('*MATERIAL, NAME=A')
    moved = lines[:first] + sections + [line for line in lines[first:] if line not in sections]
    as_they_were, other = (Converted(program, folder, 'bar.inp', '\n'.join(text)) for text in (lines, moved))
    return as_they_were.faults + other.faults + ([] if other.deck == as_they_were.deck else ['another deck'])


def plastic(program, folder):
    """A bar of Abaqus that yields: the force that draws it by a hundredth is that of uniaxial stress, with and without hardening"""
    faults = []
    for rows, slope in ((('1., 0.',), 0.0), (('1., 0.', '1.5, 0.1'), 5.0), (('1., 0.', '1.5, 0.1', '1.6, 0.3'), 5.0)):
        text = bar('*BOUNDARY', 'TOP, 2, 2, 0.02').replace('1000., 0.', '\n'.join(['1000., 0.', '*PLASTIC', *rows]))
        new = Converted(program, folder, 'plastic.inp', text)
        faults += [f'{rows}: {words}: {not told}' for words, told in (('beyond this line as up to it', len(rows) > 1), ('beyond its second line', len(rows) > 2))
                   if (words in new.said) != told]
        new.solve()
        stress = (1.0 + slope*0.01)/(1.0 + slope/1000.0)
        found = [row['sigma_z'] for row in listing.tables(read_text(os.path.join(folder, 'new.lis')))['stresses, theta = 0']]
        faults += new.faults + ([] if max(abs(value - stress) for value in found) < 1e-6 else [f'{rows}: {stress}, {found}'])
    for rows in (('0., 0.',), ('1., 0.01',), ('1., 0.', '0.9, 0.1'), ('1., 0.', '1.1, 0.')):
        ran = program.run('convert', write(folder, 'bad.inp', bar().replace('1000., 0.', '\n'.join(['1000., 0.', '*PLASTIC', *rows]))), os.path.join(folder, 'bad.dat'))
        faults += ran.ended_with(2)
    return faults


def variants(program, folder):
    """Variants of elements have the rule that their name says: those of CAX8R the reduced one"""
    faults, decks = [], {}
    for kind, like, warned in (('CAX8R', 'CAX8R', ''), ('CAX8RH', 'CAX8R', 'reduced'), ('CAX8RT', 'CAX8R', 'reduced'), ('CAX8', 'CAX8', ''),
                               ('CAX8H', 'CAX8', 'full'), ('CAX4', 'CAX4', ''), ('CAX4R', 'CAX4', 'full'), ('CAX4RH', 'CAX4', 'full')):
        new = Converted(program, folder, 'variant.inp', scenes.abaqus(kind))
        decks[kind] = new.deck
        faults += new.faults + ([] if decks[kind] == decks[like] else [f'{kind} is not {like}'])
        said = re.findall(r'is taken as element of \d nodes with the (.*) rule', new.said)
        faults += [] if said == [warned]*bool(warned) else [f'{kind}: {said}']
    return faults + ([] if decks['CAX8R'] != decks['CAX8'] else ['CAX8R is CAX8'])


def tests(program):
    """The tests of this module"""

    def test(name, function, *arguments):
        return Test(f'legacy misread: convert, {name}', lambda folder: function(program, folder, *arguments))

    return ([test(function.__name__.replace('_', ' '), function) for function in (body_loads, gravity_directions, sets_of_nodes, left_out, parameters, fields, tables, boundaries_anew,
                      radial_force_on_axis, force_of_harmonics, subcases, titles, headings, force_on_axis,
                      moved_around, quotes, no_name, continued_keywords, sections_first, variants, plastic)]
            + [test(f'new deck, {name}', unreadable, text, words) for name, text, words in UNREADABLE]
            + [test(name, bad, text, ending, place, words) for name, text, ending, place, words in BAD])
