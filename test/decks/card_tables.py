"""The tables of doc/deck.md: those that the program prints of its cards. Run by itself with the path of the
program, it writes them there"""
import re
import subprocess
import sys
from pathlib import Path

MANUAL = Path(__file__).resolve().parents[2] / 'doc' / 'deck.md'
# A table of the manual that belongs to a card, with its name, and the index of all cards
TABLE = re.compile(r'^\| ([A-Z]+), columns \|.*\n(?:\|.*\n)+', re.MULTILINE)
INDEX = re.compile(r'^\| card \| what it is for \|.*\n(?:\|.*\n)+', re.MULTILINE)


def printed(program, *name):
    """What the program prints of a card, or of all"""
    return subprocess.run([program, 'help', 'card', *name, '--markdown'], check=True, stdout=subprocess.PIPE,
                          encoding='utf-8').stdout


def cards(program):
    """Names of all cards"""
    return re.findall(r'^\| ([A-Z]+) \|', printed(program), re.MULTILINE)


def faults(program):
    """Where the tables of the manual are not those of the program"""
    text = MANUAL.read_text(encoding='utf-8')
    found = [f'expected the index\n{printed(program)}'] if [match[0] for match in INDEX.finditer(text)] != [
        printed(program)] else []
    told = {}
    for match in TABLE.finditer(text):
        told.setdefault(match[1], []).append(match[0])
    for name in cards(program):
        table = printed(program, name)
        if told.pop(name, []) != ([table] if table.strip() else []):
            found.append(f'expected one table of {name}\n{table}')
    return found + [f'found a table of {name}, which is no card' for name in told]


def main():
    """Write the tables into the manual"""
    program = sys.argv[1]
    text = MANUAL.read_text(encoding='utf-8')
    text = INDEX.sub(lambda match: printed(program), text)
    MANUAL.write_text(TABLE.sub(lambda match: printed(program, match[1]), text), encoding='utf-8')


if __name__ == '__main__':
    main()
