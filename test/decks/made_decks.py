"""Bad decks whose bytes are awkward to keep in a file: they are made here"""
import gzip
import os

from bad_decks import deck_faults
from messages import expected_messages
from support import EarlierResults, Test, expected, write

DECK = """TITLE
One element
CONTROL
    2
MATERIALS
    1     2.0E4       0.3
NODES
    1       0.5       0.0
    2       1.5       0.0
    3       1.5       1.0
    4       0.5       1.0
ELEMENTS
    1    1    1    1    2    3    4
RESTRAINTS
    1  111    2
RINGLOADS
    3    1       1.0
END
"""
NODE = '    2       1.5       0.0'
NOT_TEXT = 'error: the file is not a text: it contains control characters'


def replaced(old, new, deck=DECK):
    """The deck with one replacement, as bytes"""
    old, new, deck = (x.encode() if isinstance(x, str) else x for x in (old, new, deck))
    assert deck.count(old) == 1, old
    return deck.replace(old, new)


def including(name):
    """The deck, including a file before its ring loads"""
    return replaced('RINGLOADS', f'INCLUDE   {name}\nRINGLOADS')


POISSON = replaced('0.3', '0.5')
# Name: bytes of the deck, the message expected, other files by name
DECKS = {
    'tab on a fixed card': (replaced(NODE, '    2\t  1.5       0.0'),
                            '9:6: error: there is a tab on a fixed card'),
    'tab on a keyword card': (replaced('NODES\n', 'NODES\t    4\n'),
                              '7:6: error: there is a tab on a fixed card'),
    'NUL': (replaced(NODE, '    2       1.5      \0000.0'), f'9:22: {NOT_TEXT}'),
    'escape sequence in the title': (replaced('One', '\033[1mOne'), f'2:1: {NOT_TEXT}'),
    'form feed': (replaced('NODES', '\fNODES'), f'7:1: {NOT_TEXT}'),
    'control Z at the end': (DECK.encode() + b'\x1a', f'19:1: {NOT_TEXT}'),
    'UTF-16': (DECK.encode('utf-16'), f'1:4: {NOT_TEXT}'),
    'gzip': (gzip.compress(DECK.encode(), mtime=0), f'1:1: {NOT_TEXT}'),
    'empty': (b'', 'error: the file is empty'),
    'byte order mark alone': (b'\xef\xbb\xbf', 'error: the file is empty'),
    'line feed alone': (b'\n', '1: error: the file ends without END'),
    'CR LF': (POISSON.replace(b'\n', b'\r\n'),
              "6:16-25: error: Poisson's ratio is not below 0.5"),
    'CR': (POISSON.replace(b'\n', b'\r'), "6:16-25: error: Poisson's ratio is not below 0.5"),
    'CR LF, CR and LF': (POISSON.replace(b'\n', b'\r\n', 2).replace(b'4\n', b'4\r'),
                         "6:16-25: error: Poisson's ratio is not below 0.5"),
    'byte order mark': (b'\xef\xbb\xbf' + replaced('TITLE', 'TITEL'),
                        '1:1-5: error: this keyword is unknown'),
    'Latin-1 in a field': (replaced(NODE, b'    2       1.5\xb1      0.0'),
                           '9:16: error: this character is not ASCII'),
    'no-break space': (replaced(NODE, '    2       1.5\u00a0     0.0'),
                       '9:16-17: error: this character is not ASCII'),
    'truncated UTF-8': (replaced(NODE, b'    2       1.5      \xe2\x88'),
                        '9:22-23: error: this character is not ASCII'),
    'endless exponent': (replaced(NODE, '2, 1.5E+99999999999999999999, 0.0'),
                         '9:4-28: error: r is too large'),
    'endless integer': (replaced(NODE, '99999999999999999999999999, 1.5, 0.0'),
                        '9:1-26: error: the node is too large'),
    'value of 500 digits': (replaced(NODE, '2, 1.5, 0.' + '0' * 500),
                            '9:401-510: error: there is text beyond column 400'),
    'included file without END': (including('a.inc'), 'a.inc:2: error: the file ends without END',
                                  {'a.inc': 'MATERIALS\n2, 1.0, 0.2\n'}),
    'included file that is empty': (including('a.inc'), '16:11-15: error: the included file a.inc: '
                                    'the file is empty', {'a.inc': ''}),
    'included file that is binary': (including('a.inc'), f'a.inc:1:3: {NOT_TEXT}',
                                     {'a.inc': '1,\0'}),
    'fault in an included file': (including('d/a.inc'),
                                  'd/b.inc:2:7-9: error: Poisson\'s ratio is not below 0.5',
                                  {'d/a.inc': 'INCLUDE   b.inc\nEND\n',
                                   'd/b.inc': 'MATERIALS\n2,1.0,0.7\nEND\n'}),
    'card after the END of an included file': (
        including('a.inc'), 'a.inc:3:1-9: error: there is a card after END',
        {'a.inc': 'MATERIALS\nEND\n2,1.0,0.2\n'}),
    'number given in two files': (
        including('a.inc'), 'a.inc:2:1: error: material 1 is given twice, first on line 6',
        {'a.inc': 'MATERIALS\n1,1.0,0.2\nEND\n'}),
    'files that include each other': (
        including('a.inc'), 'b.inc:1:11-15: error: the file includes itself in a loop',
        {'a.inc': 'INCLUDE   b.inc\nEND\n', 'b.inc': 'INCLUDE   a.inc\nEND\n'}),
    'files that include files 30 deep': (
        including('0.inc'), '19.inc:1:11-16: error: files include files more than 20 deep',
        {**{f'{k}.inc': f'INCLUDE   {k + 1}.inc\nEND\n' for k in range(30)}, '30.inc': 'END\n'}),
}


def made_faults(program, folder, content, expectation, others=()):
    """Write a deck and the files that it includes, and run it"""
    place = os.path.join(folder, 'decks')
    write(place, 'job.dat', content)
    for name in others:
        write(place, name, others[name])
    wanted = expected_messages(f'! expect: {expectation}')
    return deck_faults(program, 'job.dat', place, wanted, os.path.join(folder, 'results'))


def refused(program, folder, deck, words, run=None):
    """Faults unless the program refuses what is no readable file"""
    name = os.path.splitext(os.path.basename(deck))[0]
    earlier = EarlierResults(os.path.join(folder, 'results'), name or 'job')
    os.chmod(folder, 0o755)
    os.chmod(earlier.folder, 0o777)
    ran = (run or program.run)('run', deck, '-o', earlier.folder, folder=folder)
    faults = ran.ended_with(2) + earlier.faults()
    lines = ran.err.split('\n')
    if words not in lines[0]:
        faults.append(f'expected {words!r}, found {lines[0]!r}')
    return faults + expected('last line', '1 error, 0 warnings', lines[-2])


def unreadable(program, folder):
    """A deck that the user may not read"""
    os.chmod(write(folder, 'job.dat', DECK), 0)
    return refused(program, folder, 'job.dat', 'job.dat: error: ', run=program.run_as_nobody)


def made(folder, make, name='job.dat'):
    """Make something that is no file"""
    make(os.path.join(folder, name))
    return name


def included_link(program, folder, target, words):
    """An INCLUDE card that names a symbolic link"""
    place = os.path.join(folder, 'decks')
    os.mkdir(place)
    os.symlink(target, os.path.join(place, 'a.inc'))
    return made_faults(program, folder, including('a.inc'),
                       f'16:11-15: error: the included file a.inc: {words}')


def many_errors(program, folder):
    """Of more than 100 errors the first 100 are told, and all are counted"""
    cards = ''.join(f'{k}, -1.0, 0.0\n' for k in range(11, 262))
    deck = write(folder, 'job.dat', replaced(NODE + '\n', NODE + '\n' + cards))
    checked = program.run('check', deck)
    faults = checked.ended_with(2)
    faults += expected('errors told', 100, checked.err.count(': error: '))
    faults += expected('last lines', ['... and 151 errors more that are not shown',
                                      '251 errors, 0 warnings'], checked.err.split('\n')[-3:-1])
    return faults


def tests(program):
    """One test a deck"""

    def test(name, check):
        return Test(f'made deck: {name}', check)

    def loop(path):
        os.symlink(path, path)

    return [test(name, lambda folder, case=case: made_faults(program, folder, *case))
            for name, case in DECKS.items()] + [
        test('missing', lambda folder: refused(
            program, folder, 'job.dat', 'job.dat: error: there is no such file')),
        test('no name', lambda folder: refused(program, folder, '', 'error: the path is empty')),
        test('directory', lambda folder: refused(
            program, folder, made(folder, os.mkdir), 'job.dat: error: this is a directory')),
        test('pipe', lambda folder: refused(
            program, folder, made(folder, os.mkfifo), 'job.dat: error: this is not a regular')),
        test('device', lambda folder: refused(
            program, folder, '/dev/zero', '/dev/zero: error: this is not a regular file')),
        test('symbolic link to a device', lambda folder: refused(
            program, folder, made(folder, lambda path: os.symlink('/dev/zero', path)),
            'job.dat: error: this is not a regular file')),
        test('included link to a device', lambda folder: included_link(
            program, folder, '/dev/null', 'this is not a regular file')),
        test('included link to nothing', lambda folder: included_link(
            program, folder, 'nothing', 'this is a link that leads to no file')),
        test('symbolic link to itself', lambda folder: refused(
            program, folder, made(folder, loop), 'job.dat: error: the file cannot be read')),
        test('unreadable', lambda folder: unreadable(program, folder)),
        test('many errors', lambda folder: many_errors(program, folder)),
    ]
