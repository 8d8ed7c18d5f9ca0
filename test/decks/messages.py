"""The messages about a deck: those that the program prints, and those that comments expect"""
import re

HEADLINE = re.compile(r'(?:(?P<file>(?!\d+:)[^:\n]+):)?(?:(?P<line>\d+):)?'
                      r'(?:(?P<first>\d+)(?:-(?P<last>\d+))?:)? ?'
                      r'(?P<kind>error|warning): (?P<text>.*)$')
LABELLED = re.compile(r'  (found|allowed|mend): +(.*)$')
COMMENT = re.compile(r'! (expect|warns|found|allowed|mend): (.*)$')
COUNTS = re.compile(r'(\d+) errors?, (\d+) warnings?$')

BINARY = 'control characters'


class Message:
    """One error or warning"""

    def __init__(self, headline):
        self.file = headline['file']
        self.line = headline['line']
        self.first = headline['first']
        self.last = headline['last'] or headline['first']
        self.kind = headline['kind']
        self.text = headline['text']
        self.labelled = {}
        self.card = None   # lines that show the card and the caret
        self.caret = None

    def __str__(self):
        place = ''
        if self.line:
            place = f'{self.line}:'
        if self.first:
            place += self.first + (f'-{self.last}' if self.last != self.first else '') + ':'
        labelled = ''.join(f'\n  {label}: {text}' for label, text in self.labelled.items())
        return f'{place} {self.kind}: {self.text}{labelled}'.strip()

    def answers(self, wanted):
        """Whether this message is the one that is wanted: same place, its text in ours"""
        return ((wanted.file in (None, self.file)) and self.kind == wanted.kind
                and (self.line, self.first, self.last) == (wanted.line, wanted.first, wanted.last)
                and wanted.text in self.text
                and all(text in self.labelled.get(label, '')
                        for label, text in wanted.labelled.items()))


def expected_messages(deck, label='expect'):
    """Messages that the comment cards of a deck expect: `! expect: 9:6-15: error: r is negative`,
    and below it `! mend: ...`, `! allowed: ...` or `! found: ...` if these are to be checked"""
    messages = []
    for card in deck.split('\n'):
        match = COMMENT.match(card)
        if match and match[1] == label:
            headline = HEADLINE.match(match[2])
            if not headline:
                raise ValueError(f'{card!r} is no expectation')
            messages.append(Message(headline))
        elif match and messages and match[1] not in ('expect', 'warns'):
            messages[-1].labelled[match[1]] = match[2]
    return messages


def printed_messages(text):
    """Messages in the standard error output, and the numbers of errors and warnings that it ends
    with; None if it has other lines"""
    messages, counts = [], None
    for line in text.rstrip('\n').split('\n'):
        headline, labelled = HEADLINE.match(line), LABELLED.match(line)
        if counts is not None:
            return None, None
        if labelled:
            messages[-1].labelled[labelled[1]] = labelled[2]
        elif re.match(r' *\d+ \| ?', line):
            messages[-1].card = line
        elif re.match(r' *\| +\^+$', line):
            messages[-1].caret = line
        elif COUNTS.match(line):
            counts = tuple(int(count) for count in COUNTS.match(line).groups())
        elif headline:
            messages.append(Message(headline))
        else:
            return None, None
    return messages, counts


def printable(card):
    """A card as messages show it: one character a byte"""
    return ''.join(chr(byte) if 32 <= byte < 127 else ' ' if byte == 9 else '?' for byte in card)


def layout_faults(message, cards):
    """Faults of the lines below a headline: the card, and the caret under its columns. cards: the
    lines of the file as bytes"""
    faults = []
    if message.line is None:
        return faults
    start = f'{message.line:>5} | '
    shown = start + printable(cards[int(message.line) - 1])
    if BINARY in message.text:  # the rest of the line may be anything
        shown = shown[:len(start) + int(message.last)]
    if message.card is None or message.card.rstrip() != shown.rstrip():
        faults.append(f'expected the card {shown!r}, found {message.card!r}')
    caret = None
    if message.first:
        first, last = int(message.first), int(message.last)
        caret = ' ' * (len(start) - 2) + '|' + ' ' * first + '^' * (last - first + 1)
    if message.caret != caret:
        faults.append(f'expected the caret line {caret!r}, found {message.caret!r}')
    return faults


def message_faults(wanted, outcome):
    """Faults of all messages but their layout: exactly those that are wanted, in this order, and
    their counts at the end"""
    found, counts = printed_messages(outcome.err)
    if found is None:
        return [f'expected messages only, found\n{outcome.err}'], []
    faults = []
    if len(found) != len(wanted) or not all(a.answers(b) for a, b in zip(found, wanted)):
        faults.append('expected\n' + '\n'.join(map(str, wanted)))
        faults.append('found\n' + '\n'.join(map(str, found)))
    right = tuple(sum(m.kind == kind for m in found) for kind in ('error', 'warning'))
    if counts != right:
        faults.append(f'expected the counts {right}, found {counts}')
    return faults, found
