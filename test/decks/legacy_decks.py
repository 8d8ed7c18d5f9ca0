"""Decks of Owen and Hinton's program: inputs/legacy against closed forms, conversion, and a deck for each of its errors"""
import json
import math
import os
import re

import legacy_scenes as scenes
import listing
from support import HERE, INPUTS, Test, expected, read_text, write

FLAG = ('--legacy', 'owen-hinton')


def solved(program, folder, name, text, code=0):
    """Run a deck: summary and tables of the listing"""
    ran = program.run('run', *FLAG, write(folder, f'{name}.dat', text), '-o', folder)
    faults = ran.ended_with(code)
    if faults:
        raise AssertionError('\n'.join(faults))
    return (json.loads(read_text(os.path.join(folder, f'{name}.json'))),
            listing.tables(read_text(os.path.join(folder, f'{name}.lis'))))


def near(what, wanted, found, share):
    """A fault unless a number is within a share of another"""
    return [] if abs(found - wanted) <= share*abs(wanted) else [f'{what}: expected {wanted:.8g}, found {found:.8g}']


def largest(summary):
    """Largest displacement of every increment"""
    return [increment['largest_displacement'] for increment in summary['increments']]


def cylinder(program, folder):
    """Elastic under p = 8: Lame's displacement, to the digits printed"""
    found = largest(solved(program, folder, 'cylinder', scenes.DECKS['cylinder.dat'])[0])
    a, b, nu = 1.0, 2.0, scenes.POISSON
    wanted = (1 + nu)*8.0*a/(scenes.YOUNG*(b*b - a*a))*((1 - 2*nu)*a*a + b*b)
    return near('u(a), p = 8', wanted, found[0], 1e-5) + ([] if found[2] > 2.2*found[0] else ['does not yield'])


def cylinder_mohr(program, folder):
    """Yielding as by Mohr and Coulomb: the elastic ring outside radius c gives the displacement of the outer side"""
    _, tables = solved(program, folder, 'mohr', scenes.DECKS['cylinder_mohr.dat'])
    b, nu, sine, cosine, cohesion, p = 2.0, scenes.POISSON, 0.5, math.cos(math.radians(30.0)), 10.0, 9.5
    head, power = cohesion*cosine/sine, 2*sine/(1 + sine)

    def outside(c):
        return 2*cohesion*cosine/((b*b + c*c)/(b*b - c*c)*(1 + sine) + 1 - sine)
    low, high = 1.0, 1.9999
    for _ in range(60):
        middle = (low + high)/2
        low, high = (middle, high) if (outside(middle) + head)*middle**power - head < p else (low, middle)
    wanted = 2*outside(low)*low**2*b*(1 - nu*nu)/(scenes.YOUNG*(b*b - low*low))
    found = [row['u'] for row in tables['m = 0'] if abs(row['r'] - b) < 1e-9]
    return near('u(b), p = 9.5', wanted, found[0], 2e-3)


def sphere(program, folder):
    """Lame's displacement, then Hill's with the plastic radius"""
    found = largest(solved(program, folder, 'sphere', scenes.DECKS['sphere.dat'])[0])
    nu, young, strength, b3 = scenes.POISSON, scenes.YOUNG, scenes.YIELD, 8.0
    elastic = 12.0/(young*(b3 - 1))*((1 - 2*nu) + (1 + nu)*b3/2)

    def pressure(c):
        return 2*strength*(math.log(c) + (1 - c**3/b3)/3)
    low, high = 1.0, 2.0
    for _ in range(60):
        middle = (low + high)/2
        low, high = (middle, high) if pressure(middle) < 20.0 else (low, middle)
    plastic = strength/young*((1 - nu)*low**3 - 2/3*(1 - 2*nu)*(1 - low**3/b3) - 2*(1 - 2*nu)*math.log(low))
    return near('u(a), p = 12', elastic, found[0], 1e-3) + near('u(a), p = 20', plastic, found[1], 5e-3)


def plate(program, folder):
    """Collapse of a simply supported plate by Tresca: 6 M0/R^2 = 0.36"""
    summary, _ = solved(program, folder, 'plate', scenes.DECKS['plate.dat'], 4)
    factors = [increment['load_factor'] for increment in summary['increments']]
    return near('collapse', 0.36, factors[-1], 0.01)


def footing(program, folder):
    """Rough rigid footing on clay: at least 6.05 s_u A, by this mesh up to a tenth more"""
    summary, _ = solved(program, folder, 'footing', scenes.DECKS['footing.dat'])
    work = [increment['work'] for increment in summary['increments']]
    ratio = (work[-1] - work[-2])/0.01/math.pi
    return [] if summary['status'] == 'converged' and 6.05 < ratio < 6.66 else [f'V/(s_u A) = {ratio:.4f}']


def column(program, folder):
    """A hanging column: rho g L^2/(2 E)"""
    found = largest(solved(program, folder, 'column', scenes.DECKS['column.dat'])[0])
    return near('lengthening', 2.5*10*16/(2*scenes.YOUNG), found[-1], 1e-9)


def traps(program, folder):
    """Numbers without points, blanks, a node given twice: each told, results as of the deck without"""
    ran = program.run('run', *FLAG, write(folder, 'traps.dat', scenes.DECKS['traps.dat']), '-o', folder)
    plain, _ = solved(program, folder, 'plain', scenes.cylinder(scenes.MISES, (6.0, 2.0)))
    with_traps = json.loads(read_text(os.path.join(folder, 'traps.json')))
    faults = ran.ended_with(0) + expected('displacements', largest(plain), largest(with_traps))
    for words in ('100000, read as 1', '30000, read as 0.3', '1000, read as 1', 'node 1 is given again'):
        faults += [] if words in ran.err else [f'not told: {words}\n{ran.err}']
    return faults


def converted(program, folder, name):
    """The new deck gives the same results, to the last digit of the summary"""
    old, new = os.path.join(INPUTS, 'legacy', name), os.path.join(folder, 'new.dat')
    if read_text(old) != scenes.DECKS[name]:
        return [f'write inputs/legacy again: {name} is not what legacy_scenes.py makes']
    faults = program.run('convert', old, new).ended_with(0)
    code = 4 if name in ('plate.dat', 'disc.dat') else 0
    faults += program.run('run', *FLAG, old, '-o', folder).ended_with(code)
    faults += program.run('run', new, '-o', folder).ended_with(code)
    if name == 'disc.dat':
        factor = json.loads(read_text(os.path.join(folder, 'disc.json')))['increments'][-1]['load_factor']
        if f'{factor:.1f} for 72' not in read_text(os.path.join(HERE, '..', '..', 'doc', 'legacy.md')):
            faults.append(f'the disc stops at {factor}, which doc/legacy.md does not say')
    one, two = (json.loads(read_text(os.path.join(folder, f'{stem}.json'))) for stem in (name[:-4], 'new'))
    return faults + [f'{key} differs' for key in ('increments', 'iterations', 'residual_ratio', 'largest_displacement')
                     if one.get(key) != two.get(key)]


def changed(line, first, text):
    """The cylinder with a text in another place: line from 1, column from 1"""
    lines = scenes.DECKS['cylinder.dat'].split('\n')
    lines[line - 1] = lines[line - 1][:first - 1] + text + lines[line - 1][first - 1 + len(text):]
    return '\n'.join(lines)


def stray():
    """A node with coordinates that no element has any more"""
    lines = changed(FIRST_ELEMENT + 15, 26, '    2').split('\n')
    lines.insert(FIRST_NODE + 32, '   82   2.00000   0.05000')
    return '\n'.join(lines)


FIRST_ELEMENT, FIRST_NODE = 3, 3 + 16
FIRST_HELD = FIRST_NODE + 34
# A deck for each error of the old program that a deck can have: number, line, columns from-to, the deck. 7 (NDOFN) and 21
# (width of the front) are no longer to be had: nothing gives the one, nothing limits the other
ERRORS = (
    (1, 2, '5', changed(2, 1, '    0')), (2, 2, '3-5', changed(2, 1, '  800')), (3, 2, '15', changed(2, 11, '    0')),
    (3, 2, '13-15', changed(2, 11, '  900')), (4, 2, '50', changed(2, 46, '    0')), (5, 2, '20', changed(2, 16, '    4')),
    (6, 2, '25', changed(2, 21, '    5')), (8, 2, '30', changed(2, 26, '    0')), (9, 2, '45', changed(2, 41, '    5')),
    (10, 2, '35', changed(2, 31, '    4')), (11, 2, '40', changed(2, 36, '    7')), (12, 2, '55', changed(2, 51, '    3')),
    (13, FIRST_NODE + 1, '', changed(FIRST_NODE + 1, 6, '   1.00000   0.00000')),
    (14, FIRST_ELEMENT, '10', changed(FIRST_ELEMENT, 6, '    2')), (15, FIRST_ELEMENT, '20', changed(FIRST_ELEMENT, 16, '    0')),
    (16, FIRST_ELEMENT, '18-20', changed(FIRST_ELEMENT, 16, '  900')), (17, FIRST_ELEMENT, '20', changed(FIRST_ELEMENT, 16, '    1')),
    (18, 0, '', changed(FIRST_ELEMENT + 15, 26, '    2')), (19, FIRST_NODE + 33, '', stray()),
    (20, FIRST_HELD + 2, '', changed(FIRST_ELEMENT, 16, '   83')),
    (22, FIRST_HELD, '3-5', changed(FIRST_HELD, 2, ' 900')), (23, FIRST_HELD, '15', changed(FIRST_HELD, 11, '    0')),
    (24, FIRST_HELD + 1, '5', changed(FIRST_HELD + 1, 2, '   1')),
)


def old_error(program, folder, number, line, columns, text):
    """An error with its old number, at its place"""
    ran = program.run('check', *FLAG, write(folder, 'bad.dat', text))
    faults = ran.ended_with(2)
    place = rf'bad\.dat:{line or "[0-9]+"}:{columns + ":" if columns else ""} error: .*\(error {number} of the old program\)'
    return faults if re.search(place, ran.err) else faults + [f'expected {place}\n{ran.err[:1500]}']


# All that is said of a deck of our own
OWN = 'first.dat: error: this is a deck of axijoint already\n  mend:    axijoint run DECK solves it as it is\n1 error, 0 warnings'


def refused(program, folder):
    """Plane stress and strain, a deck that ends too early, values in wrong columns, unknown programs and formats"""
    faults = []
    deck = scenes.DECKS['cylinder.dat']
    cases = [(changed(2, 16, '    1'), (), 'bad.dat:2:20: error: NTYPE is plane stress'),
             (changed(2, 16, '    2'), (), 'NTYPE is plane strain'),
             ('\n'.join(deck.split('\n')[:40]), (), 'the deck ends here; a node'),
             (deck + 'MORE\n', (), 'a card after the last increment'),
             (changed(FIRST_NODE, 8, '1.0.0'), (), 'r is no number')]
    for text, options, words in cases:
        ran = program.run('check', *FLAG, *options, write(folder, 'bad.dat', text))
        faults += ran.ended_with(2) + ([] if words in ran.err else [f'expected {words}\n{ran.err[:800]}'])
    path, own = write(folder, 'good.dat', deck), os.path.join(INPUTS, 'first.dat')
    for words, found in ((('check', path), 'axijoint run --legacy owen-hinton DECK solves it'),
                         (('check', '--legacy', 'adina', path), 'owen-hinton'),
                         (('check', '--format', 'x.fmt', path), '--format goes with --legacy'),
                         (('convert', path), 'use: axijoint convert OLD NEW'),
                         (('convert', own, os.path.join(folder, 'new.dat')), OWN), (('check', *FLAG, own), OWN)):
        ran = program.run(*words)
        faults += ran.ended_with(2) + ([] if found in ran.err else [f'expected {found}\n{ran.err[:800]}'])
    return faults


def nothing_overwritten(program, folder):
    """The new deck takes a name that is free: not the old deck's, by whatever path, nor that of anything else"""
    text, faults = scenes.DECKS['cylinder.dat'], []
    old, other = write(folder, 'old.dat', text), write(folder, 'other.dat', 'mine')
    places = {name: os.path.join(folder, name) for name in ('hard', 'soft', 'pipe', 'folder', 'loose')}
    os.link(old, places['hard'])
    os.symlink(old, places['soft'])
    os.symlink('nowhere', places['loose'])
    os.mkfifo(places['pipe'])
    os.mkdir(places['folder'])
    before = {name: os.lstat(place).st_ino for name, place in places.items()}
    for new, words in ((old, 'is the old deck itself'), (places['hard'], 'is the old deck itself'),
                       (places['soft'], 'is the old deck itself'), (other, 'is there already'), (places['loose'], 'is a symbolic link'),
                       (places['pipe'], 'is neither a file nor free'), (places['folder'], 'is a directory')):
        ran = program.run('convert', old, new)
        faults += ran.ended_with(5) + ([] if f'{new} {words}' in ran.err and 'mend: ' in ran.err else [f'{words}\n{ran.err}'])
    after = {name: os.lstat(place).st_ino for name, place in places.items()}
    return (faults + expected('files', before, after) + expected('what they say', (text, 'mine'), (read_text(old), read_text(other)))
            + expected('names', 7, len(os.listdir(folder))))


def dialect(program, folder):
    """Elements and properties in other columns, described by a file of formats"""
    lines = scenes.DECKS['cylinder.dat'].split('\n')
    for k in range(FIRST_ELEMENT - 1, FIRST_NODE - 1):
        words = lines[k].split()
        lines[k] = f' {words[0]:>5s}{words[1]:>9s}      ' + ''.join(f'{word:>5s}' for word in words[2:])
    formats = write(folder, 'port.fmt', '! a port\nelement  1X,I5,I9,6X,8I5\n')
    one, _ = solved(program, folder, 'book', scenes.DECKS['cylinder.dat'])
    ran = program.run('run', *FLAG, '--format', formats, write(folder, 'port.dat', '\n'.join(lines)), '-o', folder)
    two = json.loads(read_text(os.path.join(folder, 'port.json')))
    wrong = program.run('check', *FLAG, '--format', write(folder, 'bad.fmt', 'element 1X,Q5\n'), formats)
    return (ran.ended_with(0) + expected('displacements', largest(one), largest(two)) + wrong.ended_with(2)
            + ([] if 'bad.fmt:1: a card and its format' in wrong.err else [wrong.err]))


def formats(program, folder):
    """A format in brackets, as Fortran has it, is taken; one that is none, or has too few values, is refused. An exponent does not
    take the decimals of a number without a point"""
    text = scenes.DECKS['cylinder.dat']
    _, one = solved(program, folder, 'book', text)
    faults = []
    ran = program.run('run', *FLAG, '--format', write(folder, 'a.fmt', 'pressure (6F10.3)\nnode (I5,6F10.5)\n'),
                      write(folder, 'a.dat', text), '-o', folder)
    faults += ran.ended_with(0) + expected('displacements', largest(json.loads(read_text(os.path.join(folder, 'book.json')))),
                                           largest(json.loads(read_text(os.path.join(folder, 'a.json')))))
    for card, words in (('pressure 1P6F10.3', 'a card and its format are expected'), ('pressure (6F10.3', 'a card and its format'),
                        ('gravity (F10.3)', 'this format has fewer values than the card'), ('node I5,6F10', 'a card and its format')):
        ran = program.run('check', *FLAG, '--format', write(folder, 'b.fmt', card + '\n'), os.path.join(folder, 'a.dat'))
        faults += ran.ended_with(2) + ([] if f'b.fmt:1: {words}' in ran.err else [f'{card}: {ran.err}'])
    old = next(line for line in text.split('\n') if line.strip().startswith('21000'))
    ran = program.run('check', *FLAG, write(folder, 'c.dat', text.replace(old, f'{"21E3":>10}' + old[10:])))
    faults += [] if 'E has no decimal point' in ran.err and '21E3, read as 0.21' in ran.err else [ran.err[:600]]
    ran = program.run('check', *FLAG, write(folder, 'd.dat', text.replace(old, f'{"21+3":>10}' + old[10:])))
    return faults + ran.ended_with(0) + ([] if '21+3, read as 0.21' in ran.err else [ran.err[:600]])


def dialect_error(program, folder):
    """An old error is placed in the columns of the dialect"""
    lines = scenes.DECKS['cylinder.dat'].split('\n')
    for k in range(FIRST_ELEMENT - 1, FIRST_NODE - 1):
        words = lines[k].split()
        lines[k] = f' {words[0]:>5s}{words[1]:>9s}      ' + ''.join(f'{word:>5s}' for word in words[2:])
    lines[FIRST_ELEMENT - 1] = lines[FIRST_ELEMENT - 1][:14] + '9' + lines[FIRST_ELEMENT - 1][15:]
    formats = write(folder, 'port.fmt', 'element  1X,I5,I9,6X,8I5\n')
    ran = program.run('check', *FLAG, '--format', formats, write(folder, 'bad.dat', '\n'.join(lines)))
    return ran.ended_with(2) + ([] if re.search(r'bad\.dat:3:15: error: MATNO is out of range \(error 14', ran.err) else [ran.err[:800]])


def offered(program, folder):
    """Every old deck that is given as it is gets an offer and nothing else; with its options it is taken. A deck of our own
    with a fault, whatever it is, gets none"""
    faults, folder_of = [], os.path.join(INPUTS, 'legacy')
    for name in sorted(os.listdir(folder_of)):
        ran = program.run('check', os.path.join(folder_of, name), folder=folder)
        if ran.code != 2 or ran.err.count('this looks like') != 1 or '1 error, 0 warnings' not in ran.err:
            faults.append(f'{name}: {ran.err[:300]}')
    bad = os.path.join(INPUTS, '..', 'test', 'decks', 'bad')
    ran = program.run('check', *(os.path.join(bad, name) for name in sorted(os.listdir(bad)) if name.endswith('.dat')),
                      folder=folder, time_limit=300)
    return faults + expected('offers to our own', 0, ran.err.count('this looks like'))


def tests(program):
    """The tests of this module"""

    def test(name, function, *arguments):
        return Test(f'legacy: {name}', lambda folder: function(program, folder, *arguments))

    return ([test(name.__name__.replace('_', ' '), name) for name in
             (cylinder, cylinder_mohr, sphere, plate, footing, column, traps, refused, nothing_overwritten, offered, dialect, formats, dialect_error)]
            + [test(f'converted, {name}', converted, name) for name in scenes.DECKS]
            + [test(f'error {number}, line {line}', old_error, number, line, columns, text)
               for number, line, columns, text in ERRORS])
