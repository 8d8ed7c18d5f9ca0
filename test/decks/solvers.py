"""The solvers agree, and the number of threads changes nothing"""
import json
import os
import re
import resource

from hard_scenes import example
from support import INPUTS, Test, read_text, write

# A ring large enough for harmonics to be solved in parallel
RING = """TITLE
Ring under four harmonics
CONTROL
5
MATERIALS
1, 1.0, 0.3
BLOCKS
1, 1, 8, 20, 20
1, 0, 2, 1
FACES
1, 1, 1, 0, 2, 0
2, 1, 1, 1, 2, 1
FIXEDFACES
1, 111
TRACTIONS
2, 0, 0, 1
2, 1, 1, 1, -1
2, 2, 1, 1, 1
2, 5, 1, 1, 1
END
"""


def results(program, folder, deck, *options):
    """Listing, without header, solver and times, and summary of a run"""
    ran = program.run('run', deck, '-o', folder, *options)
    if ran.code != 0:
        raise AssertionError(f'{options}: exit code {ran.code}\n{ran.err}')
    stem = os.path.join(folder, os.path.splitext(os.path.basename(deck))[0])
    text = read_text(stem + '.lis')
    tables = text[text.index('\nDISPLACEMENT AMPLITUDES'):text.index('\nTIMES')]
    return tables, json.loads(read_text(stem + '.json'))


def numbers(tables):
    """Displacements of the listing"""
    return [float(word) for line in tables.split('\nTOTAL')[0].splitlines()
            for word in line.split()[3:] if re.fullmatch(r'-?\d\.\d+E[+-]\d+', word)]


def solver_names(program):
    """The solvers of the program, as its help tells them"""
    words = re.search(r'--solver NAME +auto, (.*) \(', program.run('help', 'run').out)[1]
    return re.split(', | or ', words)


def solvers_agree(program, folder):
    """Displacements of all solvers differ by rounding"""
    faults = []
    for deck in (write(folder, 'ring.dat', RING), os.path.join(INPUTS, 'case3.dat')):
        found = {}
        for solver in solver_names(program):
            tables, summary = results(program, folder, deck, '--solver', solver)
            if summary['solver'] != solver:
                faults.append(f'asked for {solver}, found {summary["solver"]}')
            found[solver] = numbers(tables)
        size = max(map(abs, found['band']))
        for solver in solver_names(program)[1:]:
            worst = max(abs(a - b) for a, b in zip(found['band'], found[solver]))
            if len(found[solver]) != len(found['band']) or worst > 1e-7*size:
                faults.append(f'{deck}: {solver} and band differ by {worst:.1e} of {size:.1e}')
    return faults


def threads_change_nothing(program, folder):
    """One and two threads print the same tables"""
    deck = write(folder, 'ring.dat', RING)
    faults = []
    for solver in ('band', 'sparse'):
        one, two = (results(program, folder, deck, '--solver', solver, '--threads', threads)[0]
                    for threads in '12')
        if one != two:
            faults.append(f'{solver}: the tables of one and of two threads differ')
    return faults


def predicted_memory(program, deck, *options):
    """Memory [MB] that `estimate` expects of the sparse solver, and its factors at once"""
    ran = program.run('estimate', deck, *options)
    row = re.search(r'^ +SPARSE( +\S+){3} +(\d+) +(\S+)', ran.out, re.MULTILINE)
    return float(row[3]), int(row[2])


def memory_changes_nothing(program, folder):
    """With less memory fewer factors are there at once, and every number stays: a linear job, one
    with several combinations, which keeps its factors, and one with joints"""
    fine = RING.replace('1, 1, 8, 20, 20', '1, 1, 8, 70, 70')
    decks = {'linear': (fine, 2, 1),
             'combined': (fine.replace('TRACTIONS', 'CASE\n1, all\nTRACTIONS').replace(
                 'END', 'COMBINE\n1, 1, 1\n2, 1, 2\nEND'), 4, 1),
             'joints': (example(3, refined=7, harmonic=4, planes=17), 5, 1)}
    faults = []
    for name, (text, most, least) in decks.items():
        deck = write(folder, name + '.dat', text)
        options = ('--solver', 'sparse', '--threads', '2')
        stem = name + ('.2' if name == 'combined' else '')
        runs = []
        for limit in (999999, None):
            if limit is None:
                limit = int(0.87*predicted_memory(program, deck, '--threads', '2')[0])
            factors = predicted_memory(program, deck, '--threads', '2', '--memory', str(limit))[1]
            ran = program.run('run', deck, '-o', folder, *options, '--memory', str(limit))
            if ran.code != 0:
                return faults + [f'{name}: exit code {ran.code}\n{ran.err}']
            summary = json.loads(read_text(os.path.join(folder, stem + '.json')))
            text = read_text(os.path.join(folder, stem + '.lis'))
            runs.append((factors, text[text.index('\nDISPLACEMENT AMP'):text.index('\nTIMES')]))
            if summary['peak_memory_mb'] > limit:
                faults.append(f'{name}: {summary["peak_memory_mb"]} MB with a limit of {limit} MB')
        if runs[0][0] != most or not least <= runs[1][0] < most:
            faults.append(f'{name}: factors at once {runs[0][0]} and {runs[1][0]}, expected {most} and less')
        if runs[0][1] != runs[1][1]:
            faults.append(f'{name}: the tables differ')
    return faults


def memory_too_small(program, folder):
    """A limit that one factor does not fit in; one that is no number"""
    deck = write(folder, 'fine.dat', RING.replace('1, 1, 8, 20, 20', '1, 1, 8, 70, 70'))
    faults = []
    for limit, code, words in (('40', 6, 'the limit given leaves'), ('much', 2, 'option --memory')):
        ran = program.run('run', deck, '-o', folder, '--memory', limit)
        faults += ran.ended_with(code) + ([] if words in ran.err else [ran.err])
    return faults


def stacks_stay_small(program, folder):
    """Threads have stacks of some MB at most: no array of the mesh's size may lie there"""
    deck = write(folder, 'fine.dat', RING.replace('1, 1, 8, 20, 20', '1, 1, 4, 120, 120'))
    ran = program.run('run', deck, '-o', folder, '--threads', '2',
                      limits=[(resource.RLIMIT_STACK, 512*1024)])
    return [] if ran.code == 0 else [f'expected exit code 0, found {ran.code}', ran.err]


def estimate_tells_costs(program, folder):
    """`estimate` has a line for each solver and solves nothing"""
    ran = program.run('estimate', write(folder, 'ring.dat', RING))
    rows = re.findall(r'^ +([A-Z]+) +(\d+)', ran.out, re.MULTILINE)
    faults = [] if ran.code == 0 else [f'exit code {ran.code}']
    if [row[0].lower() for row in rows] != solver_names(program) or len({row[1] for row in rows}) != 1:
        faults.append(f'found {ran.out!r}')
    return faults + [f'wrote {name}' for name in os.listdir(folder) if name != 'ring.dat']


def tests(program):
    """All of them"""
    return [Test(f'solvers: {name}', lambda folder, check=check: check(program, folder))
            for name, check in (('they agree', solvers_agree),
                                ('threads', threads_change_nothing),
                                ('memory', memory_changes_nothing),
                                ('too little memory', memory_too_small),
                                ('stacks', stacks_stay_small),
                                ('estimate', estimate_tells_costs))]
