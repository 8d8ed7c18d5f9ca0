"""Decks cut off at every byte, and decks with random faults: never a crash, never a false result"""
import os
import random

from support import HERE, Test, input_deck, read_text, write

# Decks that one process checks
PORTION = 500
# Every so many cuts are run, too
STRIDE = 61
SEED, MUTATIONS = 20240229, 1500


def accepted(program, folder, names):
    """Which decks pass the check, and faults: a crash, or another exit code than 0 or 2"""
    good, faults = set(), []
    for first in range(0, len(names), PORTION):
        portion = names[first:first + PORTION]
        checked = program.run('check', *portion, folder=folder)
        passed = {line.split(':')[0] for line in checked.out.split('\n') if ': ok, ' in line}
        good |= passed
        code = 0 if len(passed) == len(portion) else 2
        if checked.crash() or checked.code != code:
            faults += [f'{name}: {fault}' for name in portion
                       for fault in crash_alone(program, folder, name)]
            faults = faults or [f'expected exit code {code}, found {checked.code}']
    return good, faults


def crash_alone(program, folder, name):
    """Faults of the check of one deck"""
    checked = program.run('check', name, folder=folder)
    return checked.crash() if checked.code in (0, 2) else checked.ended_with(2)


def cut_faults(program, folder, deck, name, whole):
    """Cut a text at every byte. name: of the file that is cut; whole: the least length that is a
    whole text"""
    names = []
    for length in range(len(deck) + 1):
        place = f'{length:05d}'
        write(folder, f'{place}/{name}', deck[:length])
        if name != 'job.dat':
            os.link(os.path.join(folder, 'job.dat'), os.path.join(folder, place, 'job.dat'))
        names.append(f'{place}/job.dat')
    good, faults = accepted(program, folder, names)
    if good != set(names[whole:]):
        wrong = sorted(good ^ set(names[whole:]))
        faults.append(f'cut at byte {", ".join(map(os.path.dirname, wrong[:9]))}: '
                      f'{"accepted" if wrong[0] in good else "refused"}')
    for deck_name in names[:whole:STRIDE]:
        ran = program.run('run', deck_name, '-o', os.path.dirname(deck_name), folder=folder)
        faults += [f'{deck_name}: {fault}' for fault in ran.ended_with(2)]
        if os.path.exists(os.path.join(folder, os.path.dirname(deck_name), 'job.lis')):
            faults.append(f'{deck_name}: found a listing')
    return faults


def cut_deck(program, folder):
    """inputs/case1.dat"""
    deck = input_deck('case1.dat').encode()
    return cut_faults(program, folder, deck, 'job.dat', len(deck) - 1)


def cut_included(program, folder):
    """A file that a deck includes"""
    deck = input_deck('first.dat')
    split = deck.index('FACES')
    write(folder, 'job.dat', deck[:split] + 'INCLUDE   rest.inc\nEND\n')
    rest = deck[split:].encode()
    return cut_faults(program, folder, rest, 'rest.inc', len(rest) - 1)


def cut_includer(program, folder):
    """A deck that includes a file; the file is whole"""
    deck = input_deck('first.dat')
    split, end = deck.index('FACES'), deck.index('FIXEDFACES')
    cut = (deck[:split] + 'INCLUDE   ../faces.inc\n' + deck[end:]).replace('../', '').encode()
    for length in range(len(cut) + 1):
        write(folder, f'{length:05d}/faces.inc', deck[split:end] + 'END\n')
    return cut_faults(program, folder, cut, 'job.dat', len(cut) - 1)


def mutated(deck, dice):
    """A deck with one to three random changes of bytes or lines"""
    for _ in range(dice.choice((1, 1, 1, 2, 3))):
        place, lines = dice.randrange(len(deck)), deck.split(b'\n')
        one, other = dice.randrange(len(lines)), dice.randrange(len(lines))
        kind = dice.randrange(6)
        if kind == 0:
            deck = deck[:place] + bytes([dice.randrange(256)]) + deck[place + 1:]
        elif kind == 1:
            deck = deck[:place] + dice.choice(b'0123456789.+-ED, !\n\t*').to_bytes(1, 'big') + \
                deck[place + dice.randrange(2):]
        elif kind == 2:
            deck = deck[:place] + deck[place + 1:]
        elif kind == 3:
            deck = b'\n'.join(lines[:one] + lines[one + 1:])
        elif kind == 4:
            deck = b'\n'.join(lines[:one] + [lines[other]] + lines[one:])
        else:
            lines[one], lines[other] = lines[other], lines[one]
            deck = b'\n'.join(lines)
    return deck


def mutations(program, folder):
    """Random changes, the same in every run: only exit codes 0 and 2 in the check"""
    dice = random.Random(SEED)
    decks = [input_deck('case1.dat').encode(), input_deck('first.dat').encode(),
             *(read_text(os.path.join(HERE, 'alike', name)).encode()
               for name in ('fixed.dat', 'free.dat', 'explicit.dat'))]
    names = [f'{k}.dat' for k in range(MUTATIONS)]
    for name in names:
        write(folder, name, mutated(dice.choice(decks), dice))
    return accepted(program, folder, names)[1]


def tests(program):
    """One test a deck that is cut"""
    functions = {'inputs/case1.dat at every byte': cut_deck, 'an included file': cut_included,
                 'a deck that includes a file': cut_includer, 'random changes': mutations}
    return [Test(f'cut decks: {name}', lambda folder, function=function: function(program, folder))
            for name, function in functions.items()]
