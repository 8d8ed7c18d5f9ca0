"""The documents against what they speak of: links, named files, decks, keywords, folders and their uses"""
import os
import re
import subprocess

import card_tables
from support import HERE, INPUTS, Test, expected, python_with, read_text, write

ROOT = os.path.realpath(os.path.join(HERE, '..', '..'))
SKIPPED = ('build', 'bench_results')
LINK = re.compile(r'!?\[[^\]]*\]\(([^()\s]+)\)')
FENCE = re.compile(r'^(```|~~~).*?^\1[^\n]*$', re.MULTILINE | re.DOTALL)
# A name in backticks that begins with a folder of the repository
NAMED = re.compile(r'`((?:app|bench|doc|inputs|packaging|python|scripts|src|test|verification)/[\w./-]*)`')
# A deck: from a TITLE card to an END card, in a fence or indented by four blanks; before it, the exit
# code that it is there to show
EXIT = r'(?:^<!-- exit code (\d+) -->\n\n)?'
FENCED_DECK = re.compile(EXIT + r'^```\w*\n(TITLE\n.*?^END)\n```$', re.MULTILINE | re.DOTALL)
INDENTED_DECK = re.compile(EXIT + r'^(    TITLE\n(?:(?:    .*)?\n)*?    END)$', re.MULTILINE)
# Documents whose decks are meant to be run
RUNNABLE = ('README.md', 'doc/user.md', 'doc/deck.md')
# Documents whose Python is run, one block after the other
PYTHON = ('doc/studies.md',)
PYTHON_BLOCK = re.compile(r'^```python\n(.*?)^```$', re.MULTILINE | re.DOTALL)
# Documents that show the output of a run below its deck, and lines of it that differ from run to run
SHOWING = ('README.md', 'doc/user.md')
CHANGING = ('deck', 'residual ratio', 'equilibrium error', 'time, peak memory', 'files')
INDENTED = re.compile(r'^    \S.*(?:\n    .*)*', re.MULTILINE)
USE = re.compile(r'^\s*use axijoint_([a-z0-9_]+)', re.MULTILINE)


def tests(program):
    """One test a document and one each for keywords and folders"""
    found = [Test(f'documents/{name}', lambda folder, name=name: document_faults(name))
             for name in documents()]
    found += [Test(f'documents/decks of {name}', lambda folder, name=name: deck_faults(program, name, folder))
              for name in RUNNABLE]
    found += [Test(f'documents/outputs of {name}', lambda folder, name=name: output_faults(program, name, folder))
              for name in SHOWING]
    if python_with('numpy, h5py'):
        found += [Test(f'documents/python of {name}', lambda folder, name=name: python_faults(program, name, folder))
                  for name in PYTHON]
    return found + [Test('documents/harmonics', lambda folder: harmonics_faults(program, folder)),
                    Test('documents/keywords', lambda folder: keyword_faults(program, folder)),
                    Test('documents/folders', folder_faults)]


def documents():
    """Paths of all documents"""
    names = []
    for folder, folders, files in os.walk(ROOT):
        folders[:] = sorted(name for name in folders if not name.startswith('.') and name not in SKIPPED)
        names += [os.path.relpath(os.path.join(folder, file), ROOT) for file in sorted(files)
                  if file.endswith('.md')]
    return names


def text_of(name):
    """A document"""
    return read_text(os.path.join(ROOT, name))


def document_faults(name):
    """Links to nothing, and names of files that are not there"""
    text = FENCE.sub('', text_of(name))
    faults = []
    for link in LINK.findall(text):
        if re.match(r'[a-z]+:', link):
            continue
        path, _, anchor = link.partition('#')
        target = os.path.normpath(os.path.join(os.path.dirname(name), path)) if path else name
        if not os.path.exists(os.path.join(ROOT, target)):
            faults.append(f'{link} leads to no file')
        elif anchor and anchor not in anchors(target):
            faults.append(f'{link} leads to no heading of {target}')
    for path in NAMED.findall(text):
        if not os.path.exists(os.path.join(ROOT, path)):
            faults.append(f'there is no {path}')
    return faults


def anchors(name):
    """What links to the headings of a document end with"""
    headings = re.findall(r'^#+ +(.*?) *$', FENCE.sub('', text_of(name)), re.MULTILINE)
    return {re.sub(r'[^\w\- ]', '', heading.lower()).replace(' ', '-') for heading in headings}


def decks(name):
    """Decks of a document, each with the exit code that is told"""
    text = text_of(name)
    indented = [(code, re.sub(r'^    ', '', deck, flags=re.MULTILINE))
                for code, deck in INDENTED_DECK.findall(text)]
    return [(int(code or 0), deck + '\n') for code, deck in FENCED_DECK.findall(text) + indented]


def deck_faults(program, name, folder):
    """Decks that are no file of `inputs` and end with another exit code, or with messages if it is 0"""
    if not decks(name):
        return ['found no deck']
    known = [read_text(os.path.join(INPUTS, file)) for file in os.listdir(INPUTS) if file.endswith('.dat')]
    faults = []
    for number, (code, deck) in enumerate(decks(name), 1):
        if deck in known:
            continue
        ran = program.run('run', write(folder, f'deck{number}.dat', deck), '-o', folder)
        found = ran.ended_with(code) + (expected('messages', '', ran.err) if code == 0 else [])
        faults += [f'deck {number}: {fault}' for fault in found]
    return faults


def python_faults(program, name, folder):
    """What the Python of a document fails with, run in a folder beside `inputs`"""
    blocks = PYTHON_BLOCK.findall(text_of(name))
    if not blocks:
        return ['found no Python']
    os.symlink(INPUTS, os.path.join(folder, 'inputs'))
    done = subprocess.run([python_with('numpy, h5py'), '-B', write(folder, 'blocks.py', '\n'.join(blocks))], cwd=folder,
                          capture_output=True, text=True, check=False,
                          env=dict(program.environment, AXIJOINT=program.path, PYTHONPATH=os.path.join(ROOT, 'python')))
    return [f'{done.stdout}{done.stderr}'] if done.returncode else []


def shown_runs(name):
    """Decks of a document and the output that is shown below them, of runs that converge. Cards between a
    deck and the run belong to it"""
    deck, runs = '', []
    for block in INDENTED.findall(text_of(name)):
        block = re.sub(r'^    ', '', block, flags=re.MULTILINE) + '\n'
        if block.startswith('TITLE\n'):
            deck = block
        elif re.match(r'[A-Z]{4,}\b', block) and deck:
            deck = deck.replace('\nEND\n', f'\n{block}END\n')
        elif block.startswith('$ scripts/run ') and '\nstatus ' in block and ' converged ' in block:
            runs.append((deck, block.splitlines()[1:]))
    return runs


def output_faults(program, name, folder):
    """Lines of a shown output that the program does not print"""
    if not shown_runs(name):
        return ['found no output']
    faults = []
    for number, (deck, lines) in enumerate(shown_runs(name), 1):
        ran = program.run('run', write(folder, f'shown{number}.dat', deck), '-o', folder)
        wanted, found = ([line for line in text if line and not line.startswith(CHANGING)]
                         for text in (lines, ran.out.splitlines()))
        faults += expected(f'output {number}', wanted, found)
    return faults


def harmonics_faults(program, folder):
    """Rows of the table of M in doc/user.md that are not what the first deck of inputs gives"""
    faults = []
    rows = re.findall(r'^\| (\d+) \| ([\d.]+) \| ([\d.]+) \| [\d.]+ \|$', text_of('doc/user.md').partition('| M | ')[2], re.MULTILINE)
    for harmonic, *wanted in rows:
        cards = read_text(os.path.join(INPUTS, 'first.dat')).split('\n')
        cards[[card.split(' ')[0] for card in cards].index('CONTROL') + 1] = f'{harmonic:>5}'
        ran = program.run('run', write(folder, f'{harmonic}.dat', '\n'.join(cards)), '-o', folder)
        found = [re.search(rf'^largest {what} +([\d.]+)', ran.out, re.MULTILINE).group(1) for what in ('displacement', 'pressure')]
        faults += expected(f'M = {harmonic}', wanted, found)
    return faults + ([] if rows else ['found no table of M'])


def keyword_faults(program, folder):
    """Keywords that doc/deck.md has no heading for, tables there that are not those of the program"""
    del folder
    faults = card_tables.faults(program.path)
    headings = ' '.join(re.findall(r'^#+ (.*)$', text_of('doc/deck.md'), re.MULTILINE))
    bold = ' '.join(re.findall(r'\*\*(.*?)\*\*', text_of('doc/deck.md')))
    # GMSH and GROUPS share a section, END stands among the rules of all cards
    elsewhere = ('GMSH', 'GROUPS', 'END')
    keywords = card_tables.cards(program.path)
    if not keywords:
        faults.append('found no keyword')
    for keyword in keywords:
        place = text_of('doc/deck.md') if keyword in elsewhere else headings + ' ' + bold
        if not re.search(rf'\b{keyword}\b', place):
            faults.append(f'doc/deck.md has no section {keyword}')
    return faults


def folder_faults(folder):
    """Where the table of doc/architecture.md differs from the folders of `src`"""
    del folder
    table = text_of('doc/architecture.md').partition('| folder |')[2].partition('\n\n')[0]
    rows = dict(re.findall(r'^\| `([\w/]+)` \|[^|]*\| ([^|]*)\|$', table, re.MULTILINE))
    found = folders_in_use()
    faults = expected('folders', sorted(found), sorted(rows))
    order = list(rows)
    for name, words in rows.items():
        told = {word for word in re.findall(r'[\w/]+', re.sub('all of `[^`]*`', '', words))}
        for whole in re.findall('all of `([^`]*)/`', words):
            told |= {part for part in order if part.startswith(whole + '/')}
        faults += expected(f'folders that {name} uses', sorted(found.get(name, ())), sorted(told))
        faults += [f'{name} uses {used}, which stands below it' for used in sorted(told)
                   if used in order and order.index(used) > order.index(name)]
    return faults


def folders_in_use():
    """Folders of `src`, and those whose modules their files use. A module has the name of its path"""
    source = os.path.join(ROOT, 'src')
    paths = [os.path.relpath(os.path.join(folder, file), source) for folder, _, files in os.walk(source)
             for file in files if file.endswith('.f90')]
    folder_of = {path.removesuffix('.f90').replace('/', '_'): os.path.dirname(path) for path in paths}
    found = {folder: set() for folder in folder_of.values() if folder}
    for path in paths:
        used = {folder_of[module] for module in USE.findall(read_text(os.path.join(source, path)))}
        if os.path.dirname(path):
            found[os.path.dirname(path)] |= used - {os.path.dirname(path)}
    return found
