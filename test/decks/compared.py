"""`axijoint compare`: pairs whose verdict is known from how they were made"""
import os
import random
import re
import threading

import listing
import old_listing
from support import HERE, INPUTS, Test, expected, read_bytes, read_text, write

SAME, DIFFERENT, UNREADABLE = 0, 1, 2
REAL = re.compile(r'(?<![\w.])-?\d\.\d+E[+-]\d\d(?!\d)')
EXACT = ('--relative', '0', '--of-table', '0', '--of-file', '0')
RING7 = os.path.join(INPUTS, 'ring7.fmt')
# Tables whose rows begin with the number of a node
NODE_TABLES = re.compile(r'NODES \(|DISPLACEMENT AMPL|TOTAL DISPL|TOTAL STRESSES AT NODES|REACTIONS, h')


class Base:
    """Results that the pairs are made from, solved once"""

    def __init__(self, program):
        self.program = program
        self.lock = threading.Lock()
        self.solved = {}

    def solve(self, deck, folder, *options, code=0):
        """Text of the listing, bytes of the HDF5 file and name of a run of a deck"""
        key = (deck, options)
        with self.lock:
            if key not in self.solved:
                place = os.path.join(folder, 'base')
                os.makedirs(place)
                ran = self.program.run('run', deck, '-o', place, *options)
                if ran.code != code:
                    raise AssertionError(f'{deck}: exit code {ran.code}\n{ran.err}')
                self.solved[key] = {name.split('.', 1)[1]: read_bytes(os.path.join(place, name))
                                    for name in os.listdir(place)}
        return self.solved[key]

    def text(self, folder):
        """The listing of the paper's case 3"""
        return self.solve(os.path.join(INPUTS, 'case3.dat'), folder)['lis'].decode()


class Lines:
    """The lines of a listing, and its tables"""

    def __init__(self, text):
        self.lines = text.split('\n')
        start = self.lines.index('MODEL')
        self.tables = []
        k = start
        while k < len(self.lines) - 1:
            if self.lines[k + 1].startswith('---') and self.lines[k]:
                first = k + 3
                last = first
                while self.lines[last].strip():
                    last += 1
                self.tables.append((k, first, last))
                k = last
            k += 1

    def find(self, heading):
        """Index of the heading, of the first row and behind the last of a table"""
        return next(table for table in self.tables if self.lines[table[0]].startswith(heading))

    def results(self):
        """The tables that are compared and have reals in their rows"""
        return [table for table in self.tables if re.match(
            'NODES|DISPL|TOTAL|JOINT STR|REACTIONS|EQUIL', self.lines[table[0]])]

    def text(self):
        return '\n'.join(self.lines)

    def each_row(self, change, heading=''):
        """Change every row of the tables whose headings begin so"""
        for head, first, last in self.results():
            if self.lines[head].startswith(heading):
                for k in range(first, last):
                    self.lines[k] = change(self.lines[k])
        return self


def every_real(text, change):
    """Change the reals of all rows"""
    return Lines(text).each_row(lambda row: REAL.sub(lambda real: change(real[0]), row)).text()


def value_at(text, heading, row, column, new):
    """Put another text in place of a value; new: a text, or a function of the old one"""
    lines = Lines(text)
    place = lines.find(heading)[1] + row
    fields = list(re.finditer(r'\S+', lines.lines[place]))
    old = fields[column]
    value = new(old[0]) if callable(new) else new
    line = lines.lines[place]
    before = fields[column - 1].end()
    lines.lines[place] = f'{line[:before]} {value:>{old.end() - before - 1}}{line[old.end():]}'
    return lines.text()


AMPLITUDES = 'DISPLACEMENT AMPLITUDES, harmonic 1'
JOINTS = 'JOINT STRESSES'
STRESSES = 'TOTAL STRESSES AT GAUSS POINTS, theta = 0'


def scaled(factor):
    return lambda old: f'{float(old)*factor:.7E}'


def units_of_last_digit(n):
    """The number with its last digit changed by n units"""
    def change(old):
        mantissa, exponent = old.split('E')
        digits = f'{float(mantissa) + n*10.0**-(len(mantissa.split(".")[1])):.{len(mantissa.split(".")[1])}f}'
        return f'{digits}E{exponent}'
    return change


def renumber(text):
    """Other numbers for all nodes, and rows in their order"""
    lines = Lines(text)
    first, last = lines.find('NODES (')[1:]
    old = [int(lines.lines[k][:10]) for k in range(first, last)]
    new = random.Random(7).sample(range(1, 3*len(old)), len(old))
    number = dict(zip(old, new))
    for head, first, last in lines.results():
        if NODE_TABLES.match(lines.lines[head]):
            rows = [f'{number[int(row[:10])]:10d}{row[10:]}' for row in lines.lines[first:last]]
            lines.lines[first:last] = sorted(rows, key=lambda row: int(row[:10]))
    return lines.text()


def shuffle(text):
    """The rows of every table in another order"""
    lines = Lines(text)
    for head, first, last in lines.results():
        if not re.match('EQUIL|REACTIONS OF', lines.lines[head]):
            rows = lines.lines[first:last]
            random.Random(11).shuffle(rows)
            lines.lines[first:last] = rows
    return lines.text()


def exchanged(text, heading, nodes):
    """Two nodes with each other's values"""
    lines = Lines(text)
    first, last = lines.find(heading)[1:]
    one, two = (next(k for k in range(first, last) if int(lines.lines[k][:10]) == node) for node in nodes)
    lines.lines[one], lines.lines[two] = (lines.lines[one][:36] + lines.lines[two][36:],
                                          lines.lines[two][:36] + lines.lines[one][36:])
    return lines.text()


def without_table(text, heading):
    lines = Lines(text)
    head, _, last = lines.find(heading)
    del lines.lines[head:last + 1]
    return lines.text()


def extra_harmonic(text):
    """Harmonic 4 once more, as harmonic 8"""
    lines = Lines(text)
    head, _, last = lines.find('DISPLACEMENT AMPLITUDES, harmonic 4')
    block = [line.replace('harmonic 4', 'harmonic 8') for line in lines.lines[head:last + 1]]
    lines.lines[head:head] = block
    return lines.text()


def without_row(text, heading):
    lines = Lines(text)
    del lines.lines[lines.find(heading)[1] + 3]
    return lines.text()


def swapped_columns(text, heading=AMPLITUDES):
    """u and v in each other's columns"""
    return Lines(text).each_row(lambda row: row[:36] + row[51:66] + row[36:51] + row[66:],
                                heading).text()


def minus_w(text):
    """w of the other sign"""
    def change(row):
        return f'{row[:66]}{-float(row[66:]):15.7E}'
    return Lines(text).each_row(change, 'DISPLACEMENT').each_row(change, 'TOTAL DISPL').text()


def per_radian(text):
    """Reactions for one radian"""
    lines = Lines(text)
    for m in range(5):
        factor = 1/(3.141592653589793*(2 if m == 0 else 1))
        lines.each_row(lambda row, factor=factor: row[:36] + ''.join(
            f'{factor*float(row[k:k + 15]):15.7E}' for k in (36, 51, 66)), f'REACTIONS, harmonic {m}')
    return lines.text()


def millimetres(text):
    """Lengths of amplitudes and nodes times 1000: only exponents change"""
    def longer(field):
        mantissa, exponent = field.split('E')
        return field if float(mantissa) == 0 else f'{mantissa}E{int(exponent) + 3:+03d}'
    lines = Lines(text)
    for heading in ('NODES (', 'DISPLACEMENT', 'TOTAL DISPL'):
        lines.each_row(lambda row: REAL.sub(lambda real: longer(real[0]), row), heading)
    for heading in ('TOTAL STRESSES', 'REACTIONS, h', 'JOINT STR'):
        skipped = 2
        lines.each_row(lambda row: REAL.sub(lambda real: longer(real[0]), row, skipped), heading)
    return Lines(lines.text()).each_row(
        lambda row: row[:84] + REAL.sub(lambda real: longer(real[0]), row[84:]) if 'E' in row else row,
        'JOINT STR').text()


def own_format(program, changes):
    """The built-in description with changed cards"""
    text = program.run('compare', '--print-format').out
    for pattern, new in changes:
        text, n = re.subn(pattern, new, text, flags=re.M)
        if n == 0:
            raise AssertionError(f'the built-in format has no {pattern}')
    return text


def fewer_digits(old):
    return f'{float(old):{len(old)}.4E}'


def big(exponent_text):
    """A number of three-digit exponent in place of u of the second node"""
    return lambda text: value_at(text, AMPLITUDES, 1, 3, exponent_text)


def identity(text):
    return text


# Name; changes of A and of B; verdict; options; words of the report. What is the same is so whatever
# is printed: only spelling, order, numbers or rounding change
PAIRS = (
    ('the file itself', identity, identity, SAME, (), '0 differ'),
    ('another date, path and time', identity, lambda t: t.replace('\ndate    20', '\ndate    19').replace(
        '\nrun     20', '\nrun     19').replace('case3.dat', 'old.dat'), SAME, EXACT, '0 differ'),
    ('D exponents', identity, lambda t: every_real(t, lambda x: x.replace('E', 'D')), SAME, EXACT, ''),
    ('small letters', identity, lambda t: every_real(t, str.lower), SAME, EXACT, ''),
    ('missing exponent letter', big('1.2345E+101'), big('1.2345+101'), SAME, EXACT, ''),
    ('missing exponent letter, shifted', big('1.2345E+101'), big('0.12345+102'), SAME, EXACT, ''),
    ('missing exponent letter, other digits', big('1.2345E+101'), big('1.2355+101'), DIFFERENT, (), '1 differ'),
    ('missing exponent letter, other exponent', big('1.2345E+101'), big('1.2345+102'), DIFFERENT, (), '1 differ'),
    ('negative zero', identity, lambda t: t.replace(' 0.0000000E+00', '-0.0000000E+00'), SAME, EXACT, ''),
    ('zeros of rounding', lambda t: t.replace(' 0.0000000E+00', ' 1.0000000E-17'),
     lambda t: t.replace(' 0.0000000E+00', '-3.1000000E-18'), SAME, (), ''),
    ('zero against what is not small', identity, lambda t: value_at(t, AMPLITUDES, 0, 4, '1.2E-08'),
     DIFFERENT, (), '1 differ in 1 table'),
    ('other numbers of nodes', identity, renumber, SAME, EXACT, 'that differ least'),
    ('other order of rows', identity, shuffle, SAME, EXACT, ''),
    ('other numbers, one value changed', identity, lambda t: renumber(value_at(
        t, AMPLITUDES, 40, 3, scaled(1.001))), DIFFERENT, (), '1 differ in 1 table'),
    ('values of both sides of a joint exchanged', identity, lambda t: exchanged(t, AMPLITUDES, (20, 63)),
     DIFFERENT, (), 'differ in 1 table'),
    ('the same with other numbers', identity, lambda t: renumber(exchanged(
        t, 'TOTAL DISPLACEMENTS, theta = 0', (20, 63))), DIFFERENT, (), 'differ in 1 table'),
    ('fewer digits', identity, lambda t: every_real(t, fewer_digits), SAME, EXACT, 'agree to the digits printed'),
    ('fewer digits, one other', identity, lambda t: value_at(every_real(t, fewer_digits), AMPLITUDES, 7, 3,
                                                              units_of_last_digit(2)), DIFFERENT, (), '1 differ'),
    ('one unit of the last digit', identity, lambda t: value_at(t, AMPLITUDES, 7, 3, units_of_last_digit(1)),
     SAME, EXACT, '1 value agree'),
    ('one unit of the last digit, exact digits', identity, lambda t: value_at(
        t, AMPLITUDES, 7, 3, units_of_last_digit(1)), DIFFERENT, EXACT + ('--exact-digits',), '1 differ'),
    ('two units of the last digit', identity, lambda t: value_at(t, AMPLITUDES, 7, 3, units_of_last_digit(2)),
     DIFFERENT, EXACT, '1 differ'),
    ('two units within the tolerance', identity, lambda t: value_at(
        t, AMPLITUDES, 7, 3, units_of_last_digit(2)), SAME, (), ''),
    ('a value changed by 0.001', identity, lambda t: value_at(t, AMPLITUDES, 7, 3, scaled(1.001)), DIFFERENT,
     (), 'differs: u at node 8, r 0.25, z -0.25'),
    ('the same within a wide tolerance', identity, lambda t: value_at(t, AMPLITUDES, 7, 3, scaled(1.001)),
     SAME, ('--tolerance', 'displacement=2E-3'), 'displacement: relative 0.002'),
    ('the same within an absolute tolerance', identity, lambda t: value_at(t, AMPLITUDES, 7, 3, scaled(1.001)),
     SAME, ('--tolerance', 'u=0,2E-6'), ''),
    ('the same in the wrong quantity', identity, lambda t: value_at(t, STRESSES, 7, 5, scaled(1.001)),
     DIFFERENT, ('--tolerance', 'displacement=2E-3'), '1 differ'),
    ('asterisks in one', identity, lambda t: value_at(t, AMPLITUDES, 7, 3, '*************'), DIFFERENT, (),
     '1 value cannot be compared'),
    ('asterisks passed over', identity, lambda t: value_at(t, AMPLITUDES, 7, 3, '*************'), SAME,
     ('--allow-unknown',), '1 cannot be compared'),
    ('asterisks that touch a number', identity, lambda t: re.sub(
        r'\*{4} +(?=[-\d])', '****', value_at(t, AMPLITUDES, 7, 4, '****')), SAME,
     ('--allow-unknown',), '1 cannot be compared'),
    ('NaN in both', lambda t: value_at(t, AMPLITUDES, 7, 3, 'NaN'), lambda t: value_at(
        t, AMPLITUDES, 7, 3, 'nan'), DIFFERENT, (), '1 cannot be compared'),
    ('NaN in both passed over', lambda t: value_at(t, AMPLITUDES, 7, 3, 'NaN'), lambda t: value_at(
        t, AMPLITUDES, 7, 3, '+NaN'), SAME, ('--allow-unknown',), '1 cannot be compared'),
    ('NaN in one', identity, lambda t: value_at(t, AMPLITUDES, 7, 3, 'NaN'), DIFFERENT, ('--allow-unknown',),
     '1 differ'),
    ('infinities', lambda t: value_at(t, AMPLITUDES, 7, 3, 'Infinity'), lambda t: value_at(
        t, AMPLITUDES, 7, 3, '-Infinity'), DIFFERENT, ('--allow-unknown',), '1 differ'),
    ('infinity in one', identity, lambda t: value_at(t, AMPLITUDES, 7, 3, 'Inf'), DIFFERENT,
     ('--allow-unknown',), '1 differ'),
    ('numbers of nodes that do not fit', identity, lambda t: Lines(t).each_row(
        lambda row: '*'*10 + row[10:], 'TOTAL DISPL').text(), SAME, EXACT, ''),
    ('another angle, and a row missing', identity, lambda t: without_row(t, 'TOTAL DISPL').replace(
        'TOTAL DISPLACEMENTS, theta = 90 ', 'TOTAL DISPLACEMENTS, theta = 91 '), DIFFERENT, (),
     '167 rows only in A'),
    ('columns that touch', identity, lambda t: Lines(t).each_row(lambda row: re.sub(
        r'(?<=\d) -(?=\d\.)', '-', row), 'DISPLACEMENT').text(), SAME, EXACT, ''),
    ('form feeds', identity, lambda t: t.replace('\nTOTAL', '\n\fTOTAL'), SAME, EXACT, ''),
    ('line ends of another system', identity, lambda t: t.replace('\n', '\r\n'), SAME, EXACT, ''),
    ('blanks at the ends', identity, lambda t: t.replace('\n', '   \n'), SAME, EXACT, ''),
    ('columns swapped', identity, swapped_columns, DIFFERENT, (), 'in 1 table'),
    ('a table missing', identity, lambda t: without_table(t, JOINTS), DIFFERENT, (), '1 table in one file only'),
    ('a table missing, allowed', identity, lambda t: without_table(t, JOINTS), SAME,
     ('--allow-missing', 'tables'), '1 table in one file only'),
    ('a harmonic more', identity, extra_harmonic, DIFFERENT, (), 'm = 8, family = symmetric\n  only in B: 166'),
    ('a harmonic more, never allowed', extra_harmonic, identity, DIFFERENT, ('--allow-missing', 'all'), '1 of them of harmonics'),
    ('a harmonic less, never allowed', identity, extra_harmonic, DIFFERENT, ('--allow-missing', 'tables'), 'only in B: 166'),
    ('a row missing', identity, lambda t: without_row(t, AMPLITUDES), DIFFERENT, (), '1 row only in A'),
    ('a row missing, allowed', identity, lambda t: without_row(t, AMPLITUDES), SAME,
     ('--allow-missing', 'rows'), 'node 4, r 0.375, z -0.5'),
    ('another joint state', identity, lambda t: value_at(t, JOINTS, 1, 11, 'stick'), DIFFERENT, (),
     'A slip'),
    ('a table skipped', identity, lambda t: value_at(t, JOINTS, 1, 11, 'stick'), SAME, ('--skip', 'joints'),
     'not compared, as asked: joints'),
    ('a name to skip that neither has', identity, identity, UNREADABLE, ('--skip', 'joints', '--skip', 'jounts'),
     "unknown quantity, column or table 'jounts'; did you mean joints?"),
    ('a name with a tolerance that neither has', identity, identity, UNREADABLE, ('--tolerance', 'u=1E-3', '--tolerance', 'joints=1'),
     "unknown quantity or column 'joints'"),
    ('a quantity that neither has', identity, identity, SAME, ('--skip', 'moment', '--tolerance', 'jump=1E-3'), '0 differ'),
    ('not converged in one', identity, lambda t: t.replace('\nstatus  converged in', (
        '\nstatus  *** NOT CONVERGED *** residual')), DIFFERENT, (), 'B not_converged'),
    ('w of the other sign', identity, minus_w, DIFFERENT, (), 'differ'),
    ('reactions per radian', identity, per_radian, DIFFERENT, (), 'differ'),
    ('cut in the middle', identity, lambda t: t[:len(t)//2], UNREADABLE, (), ''),
    ('without its last line', identity, lambda t: t[:t.rindex('END OF')], UNREADABLE, (), 'the file is cut off'),
    ('empty', identity, lambda t: '', UNREADABLE, (), 'the file is empty'),
    ('bytes', identity, lambda t: t[:5000] + '\0\1\2' + t[5000:], UNREADABLE, (), 'this is no text'),
    ('another text', identity, lambda t: 'a letter\nto a friend\n', UNREADABLE, (), 'this is no listing of axijoint'),
    ('a number with a letter', identity, lambda t: value_at(t, AMPLITUDES, 7, 3, '1.23x567E-03'), UNREADABLE, (),
     'error: this is no number'),
    ('a value lost', identity, lambda t: value_at(t, AMPLITUDES, 7, 5, ''), UNREADABLE, (),
     'the line has too few values'),
    ('a value more', identity, lambda t: value_at(t, AMPLITUDES, 7, 5, '1.0E+00 2.0E+00'), UNREADABLE, (),
     'the line has too many values'),
)

W_CHANGED = ((r'^   COLUMN w displacement', '   COLUMN w displacement factor=-1'),)
# The same with a format for B
FORMATTED = (
    ('w of the other sign', minus_w, W_CHANGED, SAME, EXACT),
    ('w of the same sign', lambda text: text + '\n', W_CHANGED, DIFFERENT, ()),
    ('reactions per radian', per_radian, ((r'(COLUMN R_. force)', r'\1 factor=pi factor_m0=2*pi'),), SAME, EXACT),
    ('reactions per radian, factor of m = 0 forgotten', per_radian,
     ((r'(COLUMN R_. force)', r'\1 factor=pi'),), DIFFERENT, ()),
    ('millimetres', millimetres, ((r'^( *COLUMN +\S+ +(coordinate|displacement|jump)\b.*)', r'\1 factor=1E-3'),), SAME, EXACT),
    ('metres for millimetres', lambda text: text + '\n',
     ((r'^( *COLUMN +\S+ +(coordinate|displacement|jump)\b.*)', r'\1 factor=1E-3'),), DIFFERENT, ()),
    ('theta not read', lambda text: text + '\n', ((r'^   COLUMN theta angle heading\n', ''),), DIFFERENT, ()),
    ('columns in another order', lambda text: swapped_columns(text, 'DISPLACEMENT'),
     ((r'(TABLE displacement amplitudes\n(?:.*\n){7}) *(COLUMN u .*\n) *(COLUMN v .*\n)', r'\1\3\2'),),
     SAME, EXACT),
)


def pair(base, folder, change_a, change_b, code, options, words):
    """Verdict on two texts"""
    text = base.text(folder)
    a, b = change_a(text), change_b(text)
    if code == SAME and a == b and change_b is not identity:
        return ['the pair is no pair: both texts are the same']
    write(folder, 'a.lis', a)
    write(folder, 'b.lis', b)
    return verdict(base.program, folder, ('a.lis', 'b.lis', *options), code, words) + \
        verdict(base.program, folder, ('b.lis', 'a.lis', *options), code, '')


def verdict(program, folder, arguments, code, words):
    """Faults of the exit code, of the last line, and of words that are missing"""
    ran = program.run('compare', *arguments, folder=folder)
    faults = ran.ended_with(code)
    if code == UNREADABLE:
        faults += expected('report', '', ran.out)
        text = ran.err
    else:
        faults += expected('messages', '', ran.err)
        text = ran.out
        last = ran.out.rstrip().split('\n')[-1].split(':')[0]
        faults += expected('verdict', 'SAME' if code == SAME else 'DIFFERENT', last)
    if words not in text:
        faults.append(f'expected {words!r}')
    if faults:
        faults += [line for line in text.split('\n') if re.search('differs:| only in |DIFF|error', line)][:12]
    return faults


def formatted(base, folder, change, changes, code, options):
    """Verdict on a listing and one that needs a format"""
    text = base.text(folder)
    write(folder, 'a.lis', text)
    write(folder, 'b.lis', change(text))
    write(folder, 'b.fmt', own_format(base.program, changes))
    return verdict(base.program, folder, ('a.lis', 'b.lis', '--format-b', 'b.fmt', *options), code, '')


def result_files(base, folder):
    """HDF5 files with each other and with listings"""
    deck = read_text(os.path.join(INPUTS, 'case3.dat'))
    one = base.solve(os.path.join(INPUTS, 'case3.dat'), folder)
    more = re.sub(r'^( +1 +LATERAL +)   0\.4', r'\g<1>0.4004', deck, flags=re.M)
    if more == deck:
        return ['the load of the deck was not found']
    ran = base.program.run('run', write(folder, 'more.dat', more), '-o', folder)
    faults = ran.ended_with(0)
    write(folder, 'one.h5', one['h5'])
    write(folder, 'one.lis', one['lis'])
    write(folder, 'cut.h5', one['h5'][:len(one['h5'])//2])
    for a, b, options, code in (('one.h5', 'one.h5', (), SAME), ('one.h5', 'more.h5', (), DIFFERENT),
                                ('one.h5', 'more.h5', ('--relative', '0.5', '--of-table', '0.01'), SAME),
                                ('one.h5', 'one.lis', (), SAME), ('one.lis', 'one.h5', (), SAME),
                                ('more.lis', 'one.h5', (), DIFFERENT),
                                ('more.lis', 'more.h5', ('--relative', '1E-9'), SAME),
                                ('one.h5', 'cut.h5', (), UNREADABLE),
                                ('one.h5', 'one.h5', ('--format-a', RING7), UNREADABLE),
                                ('one.h5', 'absent.h5', (), UNREADABLE), ('one.h5', '.', (), UNREADABLE)):
        faults += [f'{a} {b}: {fault}'
                   for fault in verdict(base.program, folder, (a, b, *options), code, '')]
    return faults


def histories(base, folder):
    """HDF5 files whose ends are the same and whose increments are not; of the fields of increments those count that both files
    keep, and a listing has none"""
    deck = read_text(os.path.join(INPUTS, 'first.dat'))
    deck = re.sub(r'^( +1 +1\.0E4 +2\.0E4 +1\.0E4).*', r'\g<1>                       ELASTIC', deck, flags=re.M)
    deck = deck.replace('END\n', 'POINTS\n    1       0.0       1.0\nINCREMENTS\n       0.5\n       0.5\nEND\n')
    faults = []
    for name, text in (('a', deck), ('b', deck.replace('       0.5\n       0.5\nEND', '       9.0\n      -8.0\nEND')),
                       ('kept', deck.replace('INCREMENTS', 'KEEP\n  DISPLACE      LAST\n    JOINTS      LAST\nINCREMENTS'))):
        faults += base.program.run('run', '--quiet', write(folder, f'{name}.dat', text), '-o', folder).ended_with(0)
    for b, options, code, words in (
            ('a.h5', (), SAME, 'work of increments'), ('a.h5', (), SAME, 'in both files, and not compared: /history/joint_amplitude'),
            ('b.h5', (), DIFFERENT, 'load_factor at increment 1'), ('b.lis', (), SAME, ''),
            ('b.h5', ('--skip', 'increments', '--skip', 'work of increments', '--skip', 'force', '--skip', 'moment'), DIFFERENT,
             'increment = 1, m = 1, family = symmetric'),
            ('b.h5', ('--skip', 'increments', '--skip', 'work of increments', '--skip', 'force', '--skip', 'moment', '--skip', 'displacement'), DIFFERENT,
             'joints, increment = 1'),
            ('kept.h5', (), SAME, 'only in A'), ('kept.h5', (), SAME, 'displacement amplitudes, increment = 2')):
        faults += [f'{b} {options}: {fault}' for fault in verdict(base.program, folder, ('a.h5', b, *options), code, words)]
    return faults


def joints_in_another_order(base, folder):
    """Resultants of joints by increment go by the places of the joints, which may have other numbers"""
    deck = read_text(os.path.join(INPUTS, 'first.dat'))
    turned = deck
    for face, body in ((2, 1), (3, 2)):
        turned = turned.replace(f'    {face}    {body}       0.5       0.0       0.5       1.0', f'    {face}    {body}       0.5       1.0       0.5       0.0')
    faults = [] if turned != deck else ['nothing to turn']
    for name, text in (('a', deck), ('b', turned)):
        faults += base.program.run('run', '--quiet', write(folder, f'{name}.dat', text), '-o', folder).ended_with(0)
    return faults + verdict(base.program, folder, ('a.h5', 'b.h5'), SAME, 'joint resultants of increments\n  8 rows matched by')


def yielding(base, folder):
    """HDF5 files of bodies that yield: plastic strain, its work, and the margin count, each by itself"""
    deck = read_text(os.path.join(INPUTS, 'pile_clay.dat'))
    faults = []
    for name, text in (('a', deck), ('b', deck.replace('MISES      86.6', 'MISES      95.0'))):
        faults += base.program.run('run', '--quiet', write(folder, f'{name}.dat', text), '-o', folder).ended_with(0)
    faults += verdict(base.program, folder, ('a.h5', 'a.h5'), SAME, 'in both files, and not compared: /yield/active')
    tables = ('plastic strain amplitudes', 'yielding, equivalent', 'yielding, margin', 'yielding, dissipation',
              'yielding of increments', 'plastic work of increments')
    others = ('increments', 'work of increments', 'status', 'joints', *(f'{kind}' for kind in ('displacement', 'jump', 'stress', 'force', 'moment')))
    for table in tables:
        options = [word for name in (*others, *(other for other in tables if other != table)) for word in ('--skip', name)]
        faults += [f'{table}: {fault}' for fault in verdict(base.program, folder, ('a.h5', 'b.h5', *options), DIFFERENT, table)]
    return faults


def cut_motions(base, folder):
    """Motions of cuts count: forces that are the same, and a stiffness that is not"""
    deck = """TITLE
A rod
CONTROL
    1
MATERIALS
1, 1.0E4, 0.0
BLOCKS
    1    1    4    1    4
       0.0       0.0       1.0       4.0
FACES
    1    1       0.0       0.0       1.0       0.0
    2    1       0.0       4.0       1.0       4.0
FIXEDFACES
    1  111
RESULTANTS
    2     AXIAL       1.0
CUTS
    1       2.1
END
"""
    faults = []
    for name, text in (('a', deck), ('b', deck.replace('1.0E4', '2.0E4'))):
        faults += base.program.run('run', '--quiet', write(folder, f'{name}.dat', text), '-o', folder).ended_with(0)
    skipped = [word for name in ('displacement amplitudes', 'increments', 'work of increments', 'motion of cuts of increments')
               for word in ('--skip', name)]
    return faults + verdict(base.program, folder, ('a.h5', 'b.h5', *skipped), DIFFERENT, 'motion of cuts\n')


def held_by_nodes(base, folder):
    """Result files of jobs without a supported face: of nodes held, of the axis alone, of nothing that
    moves; and of one with moved faces in the antisymmetric family, whose lateral resultants are zero"""
    faults = []
    for name in ('curved_bodies', 'shear_8', 'all_fixed', 'moved_face'):
        one = base.solve(os.path.join(HERE, 'good', f'{name}.dat'), os.path.join(folder, name))
        if ('REACTIONS OF SUPPORTED FACES' in one['lis'].decode()) != (name == 'moved_face'):
            faults.append(f'{name} has, or has not, a supported face')
        for ending in ('h5', 'lis'):
            write(folder, f'{name}.{ending}', one[ending])
        for a, b in (('h5', 'h5'), ('h5', 'lis'), ('lis', 'h5')):
            faults += [f'{name}, {a} {b}: {fault}' for fault in
                       verdict(base.program, folder, (f'{name}.{a}', f'{name}.{b}'), SAME, 'equilibrium')]
    return faults


def combinations(base, folder):
    """Listings of combinations, and of another solver"""
    files = {}
    deck = os.path.join(INPUTS, 'chimney.dat')
    for solver in ('band', 'sparse'):
        place = os.path.join(folder, solver)
        os.makedirs(place)
        files[solver] = base.solve(deck, place, '--solver', solver)
        for name in ('1.lis', '1.h5', '2.lis', '2.h5'):
            write(place, name, files[solver][name])
    return verdict(base.program, folder, ('band/2.lis', 'sparse/2.lis'), SAME, 'displacements on sections') + \
        verdict(base.program, folder, ('band/1.lis', 'sparse/2.lis'), DIFFERENT, '') + \
        verdict(base.program, folder, ('band/2.lis', 'sparse/2.h5'), SAME, 'cuts') + \
        verdict(base.program, folder, ('band/1.lis', 'sparse/1.h5'), SAME, 'cuts')


def mechanism(base, folder):
    """Listings of a run that ended in a mechanism"""
    deck = read_text(os.path.join(INPUTS, 'first.dat'))
    pulled = re.sub(r'1   LATERAL       0.4', '1     AXIAL      -0.4', deck)
    ran = base.program.run('run', write(folder, 'pulled.dat', pulled), '-o', folder)
    if ran.code != 4 or not os.path.exists(os.path.join(folder, 'pulled.lis')):
        return [f'exit code {ran.code}, found {os.listdir(folder)}\n{ran.err}']
    text = read_text(os.path.join(folder, 'pulled.lis'))
    write(folder, 'd.lis', every_real(text, lambda x: x.replace('E', 'D')))
    return verdict(base.program, folder, ('pulled.lis', 'd.lis', *EXACT), SAME, '')


def parsed(text):
    """Tables of a listing with nodes and reactions"""
    tables = listing.tables(text)
    lines = Lines(text)
    first, last = lines.find('NODES (')[1:]
    tables['nodes'] = [dict(zip(('node', 'r', 'z'), map(float, row.split()[:3])))
                       for row in lines.lines[first:last]]
    for m in range(5):
        first, last = lines.find(f'REACTIONS, harmonic {m}')[1:]
        tables[f'reactions m = {m}'] = [
            dict(zip(('node', 'r', 'z', 'R_u', 'R_v', 'R_w'), map(float, row.split())))
            for row in lines.lines[first:last]]
    return tables


def old_program(base, folder):
    """A listing of RING7 and ours; a wrong value, a wrong sign and a lost page are found"""
    text = base.text(folder)
    tables = parsed(text)
    old = old_listing.old_listing(tables)
    write(folder, 'new.lis', text)
    write(folder, 'old.lis', old)
    allowed = ('--allow-missing', 'tables', '--allow-missing', 'columns')
    ours = ('new.lis', 'old.lis', '--format-b', RING7, *allowed)
    faults = verdict(base.program, folder, ours + EXACT, SAME, 'SAME: 12 tables')
    write(folder, 'new.h5', base.solve(os.path.join(INPUTS, 'case3.dat'), folder)['h5'])
    # RING7 prints the places of joints from our listing, which has five digits of them
    faults += verdict(base.program, folder, ('old.lis', 'new.h5', '--format-a', RING7, *allowed,
                                             '--coordinates', '1E-5'), SAME, 'SAME: 12 tables')

    def change(rows):
        return [dict(row, u=row['u']*1.0001) if row['node'] == 77 else row for row in rows]
    write(folder, 'old.lis', old_listing.old_listing(tables, change))
    faults += verdict(base.program, folder, ours, DIFFERENT, 'differs: u at node 77')
    pages = old.split('\n1RING7')
    write(folder, 'old.lis', '\n1RING7'.join(pages[:9] + pages[10:]))
    faults += verdict(base.program, folder, ours, DIFFERENT, 'only in A')
    write(folder, 'old.lis', old)
    description = read_text(RING7)
    write(folder, 'wrong.fmt', description.replace('factor=-1E-3 blank', 'factor=1E-3 blank'))
    wrong = ('new.lis', 'old.lis', '--format-b', 'wrong.fmt', *allowed)
    faults += verdict(base.program, folder, wrong, DIFFERENT, 'differs: w at node')
    write(folder, 'wrong.fmt', description.replace('7-20', '7-18').replace('21-34', '19-34'))
    faults += verdict(base.program, folder, wrong, UNREADABLE, 'old.lis:')
    write(folder, 'other.lis', old)
    return faults + verdict(base.program, folder, (
        'old.lis', 'other.lis', '--format-a', RING7, '--format-b', RING7), SAME, '')


# Cards of a format with a fault; place and words of the message
BAD_CARDS = (
    ('TABEL nodes', '1:1-5', 'did you mean TABLE?'),
    ('HEADING X', '1:1-7', 'there is no TABLE card above'),
    ('TABLE x\nHEADING X\nCOLUMN r', '3:7-8', 'the column has no kind'),
    ('TABLE x\nHEADING X\nCOLUMN r coordinat', '3:10-18', 'did you mean coordinate?'),
    ('TABLE x\nHEADING X\nCOLUMN q coordinate', '1:', 'a coordinate has the name q'),
    ('TABLE x\nHEADING X\nCOLUMN u stress 20-11', '3:17-21', 'neither a place nor an option'),
    ('TABLE x\nHEADING X\nCOLUMN u stress factor=2pi', '3:24-26', 'this is no factor'),
    ('TABLE x\nHEADING X\nCOLUMN u stress factor=0', '3:24', 'this is no factor'),
    ('TABLE x\nHEADING X\nCOLUMN u stress factro=1', '3:17-22', 'did you mean factor?'),
    ('TABLE x\nHEADING X\nCOLUMN u stress blank=0', '3:23', 'missing zero above'),
    ('TABLE x\nHEADING X\nCOLUMN u word word=a', '3:20', 'word=PRINTED:MEANT'),
    ('TABLE x\nHEADING X\nSKIP two\nCOLUMN u stress', '3:5-8', 'SKIP needs a number of lines'),
    ('TABLE x\nHEADING X\nENDS SOON\nCOLUMN u stress', '3:5-9', 'ENDS needs to say'),
    ('TABLE x\nHEADING X\nCOLUMN u stress\nCOLUMN v stress 1-9', '1:', 'fixed and free columns'),
    ('TABLE x\nHEADING X\nCOLUMN u stress\nCOLUMN u stress', '1:', 'two columns have the name u'),
    ('TABLE x\nCOLUMN u stress', '1:', 'no HEADING card'),
    ('TABLE x\nHEADING X', '1:', 'no COLUMN card'),
    ('TABLE x\nHEADING X\nENDS HEADING\nCOLUMN u stress', '1:', 'a table without rows'),
    ('TABLE', '1:1-5', 'nothing follows TABLE'),
    ('CARRIAGE YES', '1:1-12', 'stands alone'),
    ('! nothing', '1:', 'describes no table'),
)


def bad_formats(base, folder):
    """Each wrong card has a message with its place"""
    write(folder, 'a.lis', base.text(folder))
    faults = []
    for cards, place, words in BAD_CARDS:
        write(folder, 'bad.fmt', cards + '\n')
        ran = base.program.run('compare', 'a.lis', 'a.lis', '--format-a', 'bad.fmt', folder=folder)
        found = ran.ended_with(2)
        if not ran.err.startswith(f'bad.fmt:{place}') or words not in ran.err:
            found.append(f'expected {place} {words!r}, found\n{ran.err}')
        faults += [f'{cards!r}: {fault}' for fault in found]
    return faults


def damaged(base, folder, count=12):
    """Files with random damage end with a verdict or a message, never with a crash"""
    base.text(folder)
    mixer = random.Random(1984)
    whole = base.solve(os.path.join(INPUTS, 'case3.dat'), folder)
    listings = Lines(whole['lis'].decode())
    start = listings.find('NODES (')[0]
    description = base.program.run('compare', '--print-format').out.encode()
    write(folder, 'a.lis', whole['lis'])
    write(folder, 'a.h5', whole['h5'])
    faults = []
    for k in range(count):
        lines = list(listings.lines)
        for _ in range(3):
            place = mixer.randrange(start, len(lines) - 5)
            lines[place] = hurt(lines[place].encode(), mixer).decode('latin-1')
        write(folder, 'b.lis', '\n'.join(lines))
        write(folder, 'b.fmt', hurt(description, mixer))
        write(folder, 'b.h5', hurt(whole['h5'], mixer))
        for words in (('a.lis', 'b.lis'), ('a.lis', 'a.lis', '--format-b', 'b.fmt'), ('a.h5', 'b.h5')):
            ran = base.program.run('compare', *words, folder=folder)
            found = ran.crash()
            if ran.code not in (SAME, DIFFERENT, UNREADABLE):
                found.append(f'exit code {ran.code}')
            faults += [f'{k} {words}: {fault}\n{ran.err[-500:]}' for fault in found]
    return faults


def hurt(content, mixer):
    """Bytes lost, doubled or replaced at a random place"""
    first = mixer.randrange(len(content) + 1)
    last = min(len(content), first + mixer.randrange(1, 12))
    middle = mixer.choice((b'', 2*content[first:last], bytes(mixer.choices(b' .-+*E19nx{}=', k=last - first))))
    return content[:first] + middle + content[last:]


def tests(program):
    """One test a pair"""
    base = Base(program)
    functions = {'HDF5': result_files, 'histories': histories, 'joints in another order': joints_in_another_order, 'yielding': yielding, 'motions of cuts': cut_motions,
                 'held by nodes': held_by_nodes, 'combinations': combinations, 'mechanism': mechanism,
                 'a program of the eighties': old_program, 'wrong formats': bad_formats,
                 'damaged files': damaged}
    return [Test(f'compare: {case[0]}', lambda folder, case=case: pair(base, folder, *case[1:]))
            for case in PAIRS] + [
        Test(f'compare with a format: {case[0]}',
             lambda folder, case=case: formatted(base, folder, *case[1:]))
        for case in FORMATTED] + [
        Test(f'compare: {name}', lambda folder, function=function: function(base, folder))
        for name, function in functions.items()]
