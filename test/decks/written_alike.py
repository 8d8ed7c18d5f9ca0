"""One job written in many ways gives the same results"""
import json
import os
import re

import listing
from support import HERE, Test, read_text, write

FOLDER = os.path.join(HERE, 'alike')
# Keys of the summary that depend on when and where a job was run, and on its deck's text
PASSING = ('date', 'run', 'deck', 'deck_sha256', 'job_sha256', 'file_bytes', 'title', 'seconds', 'error_seconds', 'increment_seconds', 'peak_memory_mb')


def sections(deck):
    """Texts of the sections of a deck, END left out"""
    return re.findall(r'^[A-Z].*\n(?:[^A-Z].*\n|(?<=TITLE\n).*\n)*', deck.rsplit('END', 1)[0], re.M)


def between_cards(deck, text):
    """Put text behind every card; the title belongs to its keyword"""
    head, title, *cards = deck.split('\n')
    return '\n'.join([head, title] + [card + '\n' + text for card in cards[:-1]] + cards[-1:])


def with_files(deck, folder):
    """Move the sections and some entries to included files"""
    title, *others = sections(deck)
    for k, section in enumerate(others):
        lines = section.split('\n')
        write(folder, f'parts/inner/{k}.inc', '\n'.join(lines[2:]) + 'END')
        write(folder, f'parts/{k}.inc', '\n'.join(lines[:2]) + f'\nINCLUDE   inner/{k}.inc\nEND\n')
    includes = ''.join(f'include   parts/{k}.inc\n' for k in range(len(others)))
    return title + includes + 'END\n'


def trailing_comments(deck):
    """Comments behind all cards but the title"""
    head, title, *cards = deck.split('\n')
    return '\n'.join([head, title] + [f'{card:<40} ! 1, 2 \t "é" !' for card in cards[:-1]] + [''])


# Each makes the bytes of a deck that says the same as the given one
WAYS = {
    'lower case': lambda deck, _: deck.lower(),
    'CR LF': lambda deck, _: deck.replace('\n', '\r\n'),
    'CR': lambda deck, _: deck.replace('\n', '\r'),
    'CR LF, CR and LF mixed': lambda deck, _: deck.replace('\n', '\r\n', 9).replace(
        '00\n', '00\r'),
    'byte order mark': lambda deck, _: '\ufeff' + deck,
    'no final newline': lambda deck, _: deck.rstrip('\n'),
    'blanks to column 80': lambda deck, _: '\n'.join(f'{card:<80}' for card in deck.split('\n')),
    'blanks beyond column 80': lambda deck, _: deck.replace('\n', ' ' * 90 + '\n'),
    'blank cards': lambda deck, _: between_cards(deck, '\n   \n'),
    'comment cards': lambda deck, _: between_cards(deck, '! NODES\n$ 1, 2\n!'),
    'trailing comments': lambda deck, _: trailing_comments(deck),
    'comments behind END': lambda deck, _: deck + '\n! END\n$\n\n',
    'sections in reverse order': lambda deck, _: ''.join(reversed(sections(deck))) + 'END\n',
    'included files': with_files,
    'a title of UTF-8': lambda deck, _: deck.replace('Every', 'Jede Größe, φ ≥ 30°'),
    'a blank title': lambda deck, _: re.sub('TITLE\n.*\n', 'TITLE\n\n', deck),
    'no title': lambda deck, _: re.sub('TITLE\n.*\n', '', deck),
}


def results(program, deck, folder):
    """Results part of the listing, and lasting part of the summary; faults if there are none"""
    ran = program.run('run', deck, '-o', folder)
    faults = ran.ended_with(0)
    if faults or ran.err:
        return None, faults or [ran.err]
    name = os.path.splitext(os.path.basename(deck))[0]
    summary = json.loads(read_text(os.path.join(folder, f'{name}.json')))
    return (listing.results(read_text(os.path.join(folder, f'{name}.lis'))),
            {key: value for key, value in summary.items() if key not in PASSING}), []


def same_results(program, decks, folder):
    """Faults unless two decks give the same digits"""
    found = []
    for deck in decks:
        result, faults = results(program, deck, folder)
        if faults:
            return faults
        found.append(result)
    if found[0][1] != found[1][1]:
        return [f'expected the summary\n{found[0][1]}\nfound\n{found[1][1]}']
    for a, b in zip(found[0][0].split('\n'), found[1][0].split('\n')):
        if a != b:
            return [f'expected the line\n{a}\nfound\n{b}']
    return []


def rows_at_places(program, deck, folder):
    """Rows of the displacement tables in the order of their places, and of the sides of a joint"""
    result, faults = results(program, deck, folder)
    if faults:
        raise ValueError(faults[0])
    return {name: sorted(([row[key] for key in ('r', 'z', 'u', 'v', 'w')] for row in rows),
                         key=lambda row: [round(x, 9) for x in row])
            for name, rows in listing.tables(result[0]).items() if name.startswith('m = ')}


def nodes_and_blocks(program, folder):
    """Faults unless nodes, elements, joints and chains give what blocks and faces give"""
    one, other = (rows_at_places(program, os.path.join(FOLDER, deck), folder)
                  for deck in ('explicit.dat', 'blocks.dat'))
    if one.keys() != other.keys() or len(one) != 3:
        return [f'expected three harmonics, found {list(one)} and {list(other)}']
    largest = max(abs(x) for rows in one.values() for row in rows for x in row[2:])
    for name in one:
        error = max(abs(x - y) for a, b in zip(one[name], other[name]) for x, y in zip(a, b))
        if error > 1e-7*largest or len(one[name]) != len(other[name]):
            return [f'{name}: expected the same displacements, found a difference of {error:.1E}'
                    f' of {largest:.1E}']
    return []


def tests(program):
    """One test a way of writing"""
    fixed = os.path.join(FOLDER, 'fixed.dat')
    deck = read_text(fixed)

    def test(name, way):
        def check(folder):
            other = write(folder, 'other.dat', way(deck, folder))
            return same_results(program, [fixed, other], folder)

        return Test(f'written alike: {name}', check)

    free = os.path.join(FOLDER, 'free.dat')
    return [test(name, way) for name, way in WAYS.items()] + [
        Test('written alike: free format',
             lambda folder: same_results(program, [fixed, free], folder)),
        Test('written alike: nodes or blocks', lambda folder: nodes_and_blocks(program, folder))]
