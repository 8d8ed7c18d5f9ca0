"""Changes of texts and bytes that know what they change: fields, cards, sections; numbers and counts of mesh files;
cells of tables; values in binary files"""
import re
import struct

NUMBERS = ('0', '-1', '1', '2', '-0.0', '1E308', '-1E308', '1E-308', '1D400', 'NaN', 'Inf', '-Infinity', '2147483647', '2147483648',
           '-2147483649', '99999999999999999999', '0.1234-101', '1.0D+03', '*****', '1,5', '1e', '.', '+', '1E6', '1E-6', '0.5', '90',
           '89.999', '1/0', '', ' ')
WORDS = ('NEWTON', 'TRANSFER', 'ANDERSON', 'PAPER', 'BOND', 'LATERAL', 'AXIAL', 'ON', 'BAND', 'SPARSE', 'SKYLINE', 'BBAR',
         'x'*300, 'ä', '\u2028', '!', '"', "'", '\0')
BITS = (b'\0', b'\t', b'\r', b'\xef\xbb\xbf', b'\xff', b'\r\n', b'\n\n', b' '*200, b',', b';', b'\x1a')
TOKEN = re.compile(rb'[^\s,;:/]+')


def lines_of(text):
    """Lines without their ends"""
    return text.split(b'\n')


def change_token(text, dice):
    """Another number or word in the place of one; a number also scaled, with another sign, or in another column"""
    tokens = list(TOKEN.finditer(text))
    if not tokens:
        return text
    token = dice.choice(tokens)
    old, kind = token.group(), dice.randrange(6)
    new = dice.choice(NUMBERS).encode()
    if kind == 1:
        new = dice.choice(WORDS).encode()
    elif kind in (2, 3):
        try:
            value = float(old.decode().replace('D', 'E'))
            new = b'%g' % (value*dice.choice((-1, 0, 2, 0.5, 1e6, 1e-6, 1e12, 1.0000001)))
        except (ValueError, UnicodeDecodeError):
            new = dice.choice(tokens).group()
    elif kind == 4:
        new = dice.choice(tokens).group()
    elif kind == 5:
        new = b' '*dice.randrange(1, 6) + old
    if len(new) < len(old) and dice.random() < 0.7:
        new = new.rjust(len(old))  # in its columns
    return text[:token.start()] + new + text[token.end():]


def scale_token(text, dice):
    """A number by some factor, in its columns if it fits there"""
    tokens = [token for token in TOKEN.finditer(text) if re.fullmatch(rb'-?\d+\.\d*(E-?\d+)?', token.group())]
    if not tokens:
        return change_token(text, dice)
    token = dice.choice(tokens)
    value = float(token.group())*dice.choice((-1, 0, 0.5, 0.9, 1.1, 2, 10, 0.1, 1e3, 1e-3, 1e6, 1e-6))
    return text[:token.start()] + (b'%.4g' % value).rjust(len(token.group())) + text[token.end():]


def change_line(text, dice):
    """Lines left out, doubled, changed with each other, moved or cut"""
    lines = lines_of(text)
    one, other = dice.randrange(len(lines)), dice.randrange(len(lines))
    kind = dice.randrange(6)
    if kind == 0:
        del lines[one]
    elif kind == 1:
        lines.insert(other, lines[one])
    elif kind == 2:
        lines[one], lines[other] = lines[other], lines[one]
    elif kind == 3:
        lines[one] = lines[one][:dice.randrange(len(lines[one]) + 1)]
    elif kind == 4:
        lines[one] = b', '.join(lines[one].split())  # free for fixed
    else:
        lines.insert(other, lines.pop(one))
    return b'\n'.join(lines)


def change_bytes(text, dice):
    """Bytes changed, put in, or left out"""
    place = dice.randrange(len(text) + 1)
    kind = dice.randrange(5)
    if kind == 0:
        return text[:place] + bytes([dice.randrange(256)]) + text[place + 1:]
    if kind == 1:
        return text[:place] + dice.choice(BITS) + text[place:]
    if kind == 2:
        return text[:place] + text[place + dice.randrange(1, 9):]
    if kind == 3:
        return text[:place]
    return text[:place] + text[place:place + dice.randrange(1, 200)] + text[place:]


def change_section(text, dice, keyword, others):
    """A section left out, doubled or moved, or one of another deck put in"""
    starts = [m.start() for m in keyword.finditer(text)]
    if len(starts) < 3:
        return change_line(text, dice)
    sections = [text[a:b] for a, b in zip(starts, starts[1:] + [len(text)])]
    head, kind = text[:starts[0]], dice.randrange(4)
    one, other = dice.randrange(len(sections)), dice.randrange(len(sections))
    if kind == 0:
        del sections[one]
    elif kind == 1:
        sections.insert(other, sections[one])
    elif kind == 2:
        sections.insert(other, sections.pop(one))
    else:
        guest = dice.choice(others)
        starts = [m.start() for m in keyword.finditer(guest)]
        if len(starts) > 1:
            k = dice.randrange(len(starts) - 1)
            sections.insert(other, guest[starts[k]:starts[k + 1]])
    return head + b''.join(sections)


DECK_KEYWORD = re.compile(rb'^[A-Z]{4,}', re.M)
MESH_KEYWORD = re.compile(rb'^\$(?!End)', re.M)


def text_changed(text, dice, keyword=None, others=()):
    """One to three changes of a text; often one number by a factor, which may well be accepted"""
    if dice.random() < 0.3:
        return scale_token(text, dice)
    for _ in range(dice.choice((1, 1, 1, 2, 3))):
        kind = dice.randrange(10)
        if kind < 5:
            text = change_token(text, dice)
        elif kind < 7:
            text = change_line(text, dice)
        elif kind < 9 and keyword:
            text = change_section(text, dice, keyword, others)
        else:
            text = change_bytes(text, dice)
    return text


def bytes_changed(data, dice):
    """One to three changes of a binary file: bits, integers and reals of 4 and 8 bytes, zeros, ends"""
    for _ in range(dice.choice((1, 1, 2, 3))):
        place, kind = dice.randrange(len(data) + 1), dice.randrange(7)
        if kind == 0:
            data = data[:place] + bytes([dice.randrange(256)]) + data[place + 1:]
        elif kind == 1:
            value = struct.pack('<i', dice.choice((0, -1, 1, 2**31 - 1, -2**31, 255, 65536)))
            data = data[:place] + value + data[place + 4:]
        elif kind == 2:
            value = struct.pack('<q', dice.choice((0, -1, 1, 2**62, -2**63, 2**31)))
            data = data[:place] + value + data[place + 8:]
        elif kind == 3:
            value = struct.pack('<d', dice.choice((0.0, float('nan'), float('inf'), -1e308, 1e-320)))
            data = data[:place//8*8] + value + data[place//8*8 + 8:]
        elif kind == 4:
            data = data[:place]
        elif kind == 5:
            data = data[:place] + b'\0'*dice.randrange(1, 600) + data[place + 600:]
        else:
            data = data[:place] + data[place:place + 64] + data[place:]
    return data
