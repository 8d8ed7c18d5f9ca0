"""Studies: rows against runs of decks with the same values, tables with faults, studies that are killed, parts"""
import csv
import glob
import itertools
import json
import math
import os
import random
import re
import signal
import subprocess
import time

from hard_decks import close
from solvers import RING
from support import HERE, INPUTS, Test, expected, input_deck, python_with, read_text, write

# Decks whose fields are varied one by one, and what of the summary a row must agree with
VARIED = ('first', 'monopile', 'chimney')
# A study has one combination: of the two of the chimney that with all load cases
LAST_COMBINATION_ALONE = ('\n    1    1       1.0\n    2    1', '\n    2    1')
# What a row is compared by: name in the table of results, path in the summary of a run
LARGEST = (('largest_displacement', 'largest_displacement'), ('largest_pressure', 'largest_pressure'),
           ('largest_shear', 'largest_shear'), ('work', 'work'), ('energy', 'energy'), ('dissipated', 'dissipated'),
           ('n_slip', 'slip'), ('n_open', 'open'))

CASE3 = """LAWS 1 PHI, LAWS 1 C, RESULTANTS 1 VALUE
{lines}
"""


def rows_of(path):
    """Rows of a table of results"""
    with open(path, encoding='utf-8') as file:
        return list(csv.DictReader(file))


def study(program, folder, table, deck, *options, code=0, name='table'):
    """Run a study; its rows, and faults"""
    path = write(folder, f'{name}.csv', table)
    ran = program.run('study', path, deck, '-o', folder, '--quiet', *options, folder=folder, time_limit=300)
    faults = ran.ended_with(code)
    results = os.path.join(folder, f'{name}.study.csv')
    return (rows_of(results) if os.path.exists(results) else []), faults


def changed(text, section, card, first, last, value):
    """The text of a deck with another value in columns of a card (counted from 0 in its section)"""
    lines, where, count = text.split('\n'), None, 0
    for k, line in enumerate(lines):
        if line[:1].isalpha():
            where = line.split()[0]
        elif where == section and line.strip() and line.lstrip()[0] not in '!$':
            if count == card:
                line = line.split('!')[0].ljust(last)
                lines[k] = line[:first - 1] + value.rjust(last - first + 1) + line[last:]
                return '\n'.join(lines)
            count += 1
    raise LookupError(f'{section} has no card {card}')


def cards_of(program):
    """What the program says of its cards"""
    return {card['card']: card for card in json.loads(program.run('help', 'card', '--json').out)}


def fields_of(program, text):
    """Fields of the cards of a deck that can be varied: section, entry, field, value, another"""
    cards = cards_of(program)
    where, entry, seen = None, 0, set()
    for line in text.split('\n'):
        if line[:1].isalpha():
            where, entry = line.split()[0], 0
            continue
        if where not in cards or not line.strip() or line.lstrip()[0] in '!$':
            continue
        entry += 1
        fields = cards[where]['fields']
        if not fields or max(field['card'] for field in fields) > 1:
            continue
        for field in fields:
            first, last = field['columns']
            value = line.split('!')[0][first - 1:last].strip()
            if field['kind'] != 'real' or not value or (where, field['name']) in seen:
                continue
            seen.add((where, field['name']))
            other = float(value)*1.01 if float(value) else 0.01
            yield where, entry, field, value, f'{other:.6g}'


def number_of(text, section, entry):
    """How a table calls an entry"""
    numbered = {'MATERIALS', 'LAWS', 'LAWDETAILS', 'FACES', 'POINTS', 'CUTS', 'SECTIONS', 'CASE', 'SHAPES'}
    if section not in numbered:
        return entry
    where, count = None, 0
    for line in text.split('\n'):
        if line[:1].isalpha():
            where = line.split()[0]
        elif where == section and line.strip() and line.lstrip()[0] not in '!$':
            count += 1
            if count == entry:
                return int(line[:5])
    raise LookupError(section)


def compared(row, run, what):
    """Faults of a row beside the summary of a run"""
    faults = expected(f'{what}: exit code', str(run['exit_code']), row['exit_code'])
    if faults or run['exit_code'] not in (0, 3, 4):
        return faults
    last = run['increments'][-1]
    for name, key in LARGEST:
        wanted, found = float(last[key]), float(row[name])
        if abs(found - wanted) > 1e-6*max(abs(wanted), abs(float(last['energy'])) if key in (
                'work', 'energy', 'dissipated') else 0.0) + 1e-12*abs(wanted):
            faults.append(f'{what}: {name} is {found}, of a run by itself {wanted}')
    return faults


def every_field(program, folder, deck):
    """A row for each real on the cards of a deck, against a run of the deck with that value"""
    text, faults, head, lines, runs = input_deck(f'{deck}.dat'), [], [], [], []
    text = text.replace(*LAST_COMBINATION_ALONE)
    path = write(folder, f'{deck}.dat', text)
    for section, entry, field, _, other in fields_of(program, text):
        name = f"{section} {number_of(text, section, entry)} {field['name']}"
        one = changed(text, section, entry - 1, *field['columns'], other)
        head.append(name)
        runs.append((name, other, write(folder, f'one{len(runs)}.dat', one)))
    for k, (_, other, _) in enumerate(runs):
        lines.append(','.join(other if i == k else '' for i in range(len(runs))))
    table = write(folder, 'fields.csv', '\n'.join([', '.join(head), *lines, '']))
    ran = program.run('study', table, path, '-o', folder, '--quiet', folder=folder, time_limit=300)
    faults += ran.crash()
    rows = rows_of(os.path.join(folder, 'fields.study.csv'))
    faults += expected('rows', len(runs), len(rows))
    for row, (name, other, one) in zip(rows, runs):
        program.run('run', one, '-o', folder, '--quiet', folder=folder)
        summary = json.loads(read_text(one[:-4] + '.json'))
        faults += compared(row, summary, f'{name} = {other}')
    if not runs:
        faults.append('no field was varied')
    return faults


def controls(program, folder):
    """Load factors, harmonics and rules of elements, which no real tells, in turn: each row is that of a run by itself, and
    rows that differ in load alone share a structure"""
    text = input_deck('case3_balanced.dat').replace('\nEND', '\nINCREMENTS\n       1.0\nEND')
    table = ('INCREMENTS 1 FACTOR, CONTROL highest harmonic M, CONTROL number of Gauss points (linear)\n'
             '0.5;1, 2;4, 2;3\n')
    ran = program.run('study', write(folder, 'controls.csv', table), write(folder, 'whole.dat', text), '-o', folder, '--threads', '1',
                      folder=folder)
    faults = ran.ended_with(0)
    if '8 solved now with 4 structures' not in ran.out:
        faults.append(f'not with 4 structures: {ran.out}')
    rows = rows_of(os.path.join(folder, 'controls.study.csv'))
    for row, (factor, harmonic, points) in zip(rows, itertools.product(('0.5', '1'), ('2', '4'), ('2', '3'))):
        one = changed(changed(changed(text, 'INCREMENTS', 0, 1, 10, factor), 'CONTROL', 0, 1, 5, harmonic), 'CONTROL', 0, 11, 15, points)
        faults += program.run('run', write(folder, 'one.dat', one), '-o', folder, '--quiet', folder=folder).ended_with(0)
        faults += compared(row, json.loads(read_text(os.path.join(folder, 'one.json'))), f'{factor}, {harmonic}, {points}')
    found = {row['largest_displacement'] for row in rows}
    return faults + expected('rows, all different', (8, 8), (len(rows), len(found)))


def planes(program, folder):
    """`planes` are those of joints, though bodies have planes, too: each row is that of a run by itself"""
    text, counts = input_deck('case3_balanced.dat'), ('9', '17')
    rows, faults = study(program, folder, 'CONTROL planes\n' + ';'.join(counts) + '\n', write(folder, 'planes.dat', text))
    for row, count in zip(rows, counts):
        one = write(folder, 'one.dat', changed(text, 'CONTROL', 0, 6, 10, count))
        faults += program.run('run', one, '-o', folder, '--quiet', folder=folder).ended_with(0)
        faults += compared(row, json.loads(read_text(os.path.join(folder, 'one.json'))), f'{count} planes')
    return faults + expected('rows, all different', (2, 2), (len(rows), len({row['largest_displacement'] for row in rows})))


def yielding(program, folder):
    """A body that yields in every other row, with estimates of errors: each row has its own"""
    text = input_deck('first.dat').replace('\nLAWS', '\n    2     3.0E4      0.17\nYIELD\n    2     MISES       1.0\nLAWS', 1)
    deck = write(folder, 'yielding.dat', text)
    for order in ('1\n2\n1\n', '2\n1\n2\n'):
        ran = program.run('study', write(folder, 'yielding.csv', 'YIELD 2 MATERIAL\n' + order), deck, '-o', folder, '--estimates', folder=folder)
        faults = ran.ended_with(0)
        rows = rows_of(os.path.join(folder, 'yielding.study.csv')) if not faults else []
        for row, material in zip(rows, order.split()):
            one = changed(text, 'YIELD', 0, 1, 5, material)
            faults += program.run('run', write(folder, 'one.dat', one), '-o', folder, '--quiet', folder=folder).ended_with(0)
            summary = json.loads(read_text(os.path.join(folder, 'one.json')))
            faults += compared(row, summary, f'material {material}')
            told = (summary.get('yielding') or summary)['errors']['sum']['displacement']
            faults += close(f'error, material {material}', told, float(row['error_displacement']), 1e-12)
        if faults:
            return faults
        os.remove(os.path.join(folder, 'yielding.study.csv'))
    return expected('rows, and different displacements', (3, 2), (len(rows), len({row['largest_displacement'] for row in rows})))


def order_does_not_matter(program, folder):
    """The same rows in another order, in parts, and after a kill give the same digits"""
    deck = os.path.join(INPUTS, 'case3_balanced.dat')
    values = [f'{phi}, {c}, {h}' for phi in (0, 20, 35) for c in (0, 0.2) for h in (0.2, 0.4)]
    one, faults = study(program, folder, CASE3.format(lines='\n'.join(values)), deck, name='one')
    values.reverse()
    other, more = study(program, folder, CASE3.format(lines='\n'.join(values)), deck, name='other')
    faults += more
    bare = [{key: value for key, value in row.items() if key not in ('row', 'seconds')} for row in one]
    back = [{key: value for key, value in row.items() if key not in ('row', 'seconds')} for row in reversed(other)]
    if bare != back:
        faults.append('the order of the rows changes their digits')
    table = write(folder, 'parts.csv', CASE3.format(lines='0;20;35, 0;0.2, 0.2;0.4'))
    for part in (3, 1):
        faults += program.run('study', table, deck, '-o', folder, '--part', f'{part}/3', '--quiet', folder=folder).ended_with(0)
    if os.path.exists(os.path.join(folder, 'parts.study.csv')):
        faults.append('a part has written the files of the whole')
    ran = program.run('study', table, deck, '-o', folder, '--part', '0/3', folder=folder)
    faults += ran.ended_with(0)
    if not re.search('12 rows, 4 solved now with [0-9]+ structures?, 8 done before\n', ran.out):
        faults.append(f'rows of two parts of three are told otherwise:\n{ran.out}')
    parts = [{key: value for key, value in row.items() if key not in ('row', 'seconds')}
             for row in rows_of(os.path.join(folder, 'parts.study.csv'))]
    if parts != bare:
        faults.append('parts give other digits than the whole')
    left = [name for name in os.listdir(folder) if name.endswith('.rows')]
    return faults + expected('journals that are left', [], left)


def other_parts(program, folder):
    """Rows that parts have done are not solved again by parts of another number, nor are those of others counted among theirs"""
    deck = os.path.join(INPUTS, 'case3_balanced.dat')
    table, faults = CASE3.format(lines='0;20;35, 0;0.2, 0.2;0.4'), []
    path = write(folder, 'parts.csv', table)
    for part, said in (('3/3', '4 rows, 4 solved now'), ('1/3', '4 rows, 4 solved now'), ('1/2', '6 rows, 2 solved now'), ('2/2', '6 rows, 2 solved now'),
                       ('2/3', '4 rows, 0 solved now'), ('0/3', '12 rows, 0 solved now')):
        ran = program.run('study', path, deck, '-o', folder, '--part', part, folder=folder)
        faults += ran.ended_with(0) + ([] if said in ran.out else [f'part {part}: {said!r} is not said in\n{ran.out}'])
    whole, more = study(program, folder, table, deck, name='whole')
    return faults + more + same_rows(whole, rows_of(os.path.join(folder, 'parts.study.csv')))


def processes(program, folder):
    """Rows by three processes have the digits of one, also when one of them is killed; told to end, all end, and the
    same study by two goes on"""
    deck = os.path.join(INPUTS, 'case3_balanced.dat')
    # enough rows that each process still has some when the last has begun
    table = CASE3.format(lines='0:38/30, 0;0.2, 0.2;0.4')
    whole, faults = study(program, folder, table, deck, name='whole')
    apart, more = study(program, folder, table, deck, '--processes', '3', name='apart')
    faults += more + same_rows(whole, apart)
    path = write(folder, 'lost.csv', table)
    command = [program.path, 'study', path, deck, '-o', folder, '--processes', '3']
    for number, words in ((signal.SIGKILL, 'was ended by signal 9'), (signal.SIGTERM, 'stopped by SIGTERM')):
        parent = subprocess.Popen(command, env=program.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        children = []
        while parent.poll() is None and not all(os.path.exists(os.path.join(folder, f'lost.study.{k}of3.rows')) for k in (1, 2, 3)):
            time.sleep(0.002)
        if parent.poll() is None:
            with open(f'/proc/{parent.pid}/task/{parent.pid}/children', encoding='ascii') as file:
                children = [int(child) for child in file.read().split()]
            os.kill(children[1] if number == signal.SIGKILL else parent.pid, number)
        _, said = parent.communicate()
        if said.count(words) != 1:
            faults.append(f'{words!r} is not said once: {said}')
        faults += expected('exit code', 0 if number == signal.SIGKILL else 75, parent.returncode)
        if number == signal.SIGKILL:
            faults += same_rows(whole, rows_of(os.path.join(folder, 'lost.study.csv')))
    again = program.run(*command[1:-1], '2', folder=folder, time_limit=300)
    faults += again.ended_with(0) + same_rows(whole, rows_of(os.path.join(folder, 'lost.study.csv')))
    left = [name for name in os.listdir(folder) if name.endswith(('.rows', '.lock', '.tmp'))]
    return faults + expected('journals that are left', [], left)


def shared(program, folder):
    """Many rows go to as many processes as there are threads, with the digits of one"""
    deck, table = os.path.join(INPUTS, 'case3_balanced.dat'), CASE3.format(lines='0:38/120, 0;0.2, 0.2;0.4')
    whole, faults = study(program, folder, table, deck, '--processes', '1', name='whole')
    for threads, means in (('1', '1 structure'), ('2', '2 processes')):
        name = f'by{threads}'
        ran = program.run('study', write(folder, f'{name}.csv', table), deck, '-o', folder, '--threads', threads, folder=folder,
                          time_limit=300)
        faults += ran.ended_with(0) + same_rows(whole, rows_of(os.path.join(folder, f'{name}.study.csv')))
        if f'480 solved now with {means}' not in ran.out:
            faults.append(f'with {threads} threads not solved with {means}: {ran.out}')
        told = program.run('estimate', deck, '--study', os.path.join(folder, f'{name}.csv'), '--threads', threads, folder=folder)
        if ('rows by 2 processes' in told.out) != (threads == '2'):
            faults.append(f'what {threads} threads make of it is not foretold: {told.out}')
    return faults


def little_memory(program, folder):
    """Rows that processes find no memory for, as they share it, are solved by the first, which has all of it by then"""
    deck = write(folder, 'ring.dat', RING.replace('1, 1, 8, 20, 20', '1, 1, 8, 60, 60'))
    table = 'MATERIALS 1 E\n1; 2; 3; 4\n'
    whole, faults = study(program, folder, table, deck, name='whole')
    told = program.run('estimate', deck, '--study', os.path.join(folder, 'whole.csv'), '--counts', '--threads', '1', folder=folder)
    needed = float(dict(line.split()[:2] for line in told.out.splitlines())['memory'])
    short = program.run('study', write(folder, 'short.csv', table), deck, '-o', folder, '--processes', '2', '--threads', '2', '--memory',
                        str(round(1.25*needed)), folder=folder, time_limit=300)
    faults += short.ended_with(0) + same_rows(whole, rows_of(os.path.join(folder, 'short.study.csv')))
    return faults + expected('parts that had too little memory', 2, short.err.count('ended with exit code 6; what it left is solved here'))


def stop_file(program, folder):
    """A STOP file ends a study, by however many processes its rows are solved"""
    faults = []
    table = CASE3.format(lines='0:38/500, 0;0.2, 0.2;0.4')
    for n_processes in ('1', '2'):
        name = f'by{n_processes}'
        command = [program.path, 'study', write(folder, f'{name}.csv', table), os.path.join(INPUTS, 'case3_balanced.dat'), '-o', folder,
                   '--processes', n_processes, '--quiet']
        process = subprocess.Popen(command, env=program.environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while process.poll() is None and rows_in_journals(folder, f'{name}.study') < 10:
            time.sleep(0.01)
        write(folder, f'{name}.study.STOP', '')
        _, said = process.communicate()
        faults += expected(f'exit code by {n_processes}', 75, process.returncode)
        if said.count('stopped by a STOP file') != 1:
            faults.append(f'the STOP file is not told of once: {said}')
        if not rows_in_journals(folder, f'{name}.study'):
            faults.append('what was done is gone')
        left = [file for file in os.listdir(folder) if file.startswith(name) and file.endswith(('.STOP', '.lock', '.study.csv'))]
        faults += expected('files that are left', [], left)
    return faults


def killed(program, folder, rounds, n_processes, lines='0:38/20, 0:0.4/5, 0.2;0.4'):
    """Kill a study at random moments: what was done stays, and the end is the same to the last digit"""
    deck = os.path.join(INPUTS, 'case3_balanced.dat')
    table = CASE3.format(lines=lines)
    whole, faults = study(program, folder, table, deck, name='whole')
    path = write(folder, 'killed.csv', table)
    table_of_results = os.path.join(folder, 'killed.study.csv')
    command = [program.path, 'study', path, deck, '--processes', n_processes, '-o', folder, '--quiet']
    start = time.time()
    subprocess.run([*command[:-3], '-o', os.path.join(folder, 'timed'), '--quiet'], env=program.environment, check=True)
    length, chance = time.time() - start, random.Random(1)
    kills = done = 0
    while kills < rounds:
        process = subprocess.Popen(command, env=program.environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        try:
            process.wait(chance.uniform(0.0, 1.2*length*min(1.0, 20/rounds)))
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.wait()
        kills += 1
        now = rows_in_journals(folder, 'killed.study')
        if process.returncode == 0 or os.path.exists(table_of_results):  # ended; killed while it removes journals, perhaps
            faults += same_rows(whole, rows_of(table_of_results))
            os.remove(table_of_results)
            done = 0
            continue
        if now < done:
            faults.append(f'{done} rows were done, {now} are left')
        done = now
    faults += program.run(*command[1:], folder=folder, time_limit=300).ended_with(0)
    faults += same_rows(whole, rows_of(os.path.join(folder, 'killed.study.csv')))
    left = [name for name in os.listdir(folder) if name.startswith('killed') and name.endswith('.rows')]
    return faults + expected('journals that are left', [], left)


def dead_parts(program, folder):
    """A whole study removes what parts left that were killed, with their locks, and nothing of one that lives"""
    deck = os.path.join(INPUTS, 'case3_balanced.dat')
    path = write(folder, 'table.csv', CASE3.format(lines='0:38/200, 0;0.2, 0.2;0.4'))
    parts, faults = {}, []
    try:
        for k in (1, 2):
            parts[k] = subprocess.Popen([program.path, 'study', path, deck, '-o', folder, '--part', f'{k}/3', '--quiet'],
                                        env=program.environment, stderr=subprocess.DEVNULL)
            while parts[k].poll() is None and rows_in_journals(folder, f'table.study.{k}of3') < 5:
                time.sleep(0.01)
            parts[k].send_signal(signal.SIGKILL if k == 1 else signal.SIGSTOP)
        parts[1].wait()
        faults += program.run('study', path, deck, '-o', folder, '--quiet', folder=folder, time_limit=300).crash()
        left = sorted(name for name in os.listdir(folder) if name.startswith('table.study.'))
        faults += expected('files', ['table.study.2of3.lock', 'table.study.2of3.rows', 'table.study.csv', 'table.study.h5'], left)
    finally:
        for process in parts.values():
            process.kill()
            process.wait()
    return faults


def rows_in_journals(folder, name):
    """Number of rows that stand in the journals of a study and its parts"""
    rows = set()
    for path in glob.glob(os.path.join(folder, f'{name}*.rows')):
        rows.update(line.split(',')[1] for line in read_text(path).split('\n')[1:-1])
    return len(rows)


def same_rows(wanted, found):
    """Faults if rows differ but for their times"""
    one, other = ([{key: value for key, value in row.items() if key != 'seconds'} for row in rows]
                  for rows in (wanted, found))
    return [] if one == other else ['a study that was killed ends with other digits']


# Tables with a fault: what is said, and the columns that the caret points at
FAULTS = (
    ('LAWS 1 PHY\n10\n', 'no field of LAWS has this name', 'friction angle (phi)'),
    ('LAW 1 PHI\n10\n', 'the column names no section of a deck', 'did you mean LAWS?'),
    ('LAWS 7 PHI\n10\n', 'the deck has no such card of LAWS', 'LAWS 1, 2'),
    ('RESULTANTS 3 VALUE\n10\n', 'the deck has no such card of RESULTANTS', 'RESULTANTS 1 to 2, by their order'),
    ('LAWS 1 PHI\n95\n', 'the friction angle is not below 90', '0 <= phi < 90'),
    ('LAWS 1 PHI\n10, 20\n', 'the line has 2 cells, the head of the table 1', 'divide cells by commas'),
    ('LAWS 1 PHI\n0:40\n', 'the range is not complete', 'FIRST : LAST : STEP'),
    ('LAWS 1 PHI\n0:40:-1\n', 'the step does not lead', 'FIRST : LAST : STEP'),
    ('LAWS 1 PHI\n0:100:10\n', 'the friction angle leaves its range', '0 <= phi < 90'),
    ('LAWS 1 PHI\nNORMAL 30\n', 'NORMAL takes 2 numbers', 'UNIFORM low high'),
    ('LAWS 1 PHI\nNORMAL 30 2\n', 'nothing says how many rows are drawn', 'add a column SAMPLES'),
    ('LAWS 1 PHI, SAMPLES\n30, 10\n', 'nothing is drawn', 'leave SAMPLES blank'),
    ('LAWS 1 PHI, SAMPLES\nNORMAL 30 -2, 3\n', 'the deviation, or scale, is not above zero', 'UNIFORM low high'),
    ('LAWS 1 PHI, SAMPLES\nUNIFORM 30 2, 3\n', 'the upper end is not above the lower', 'UNIFORM low high'),
    ('LAWS 1 PHI, SAMPLES\nNORMAL 30 2, 0\n', 'the number of SAMPLES is too small', '1 to 999999999'),
    ('LAWS 1 PHI, SAMPLES\nNORMAL 60 20, 500\n', 'a value is drawn that the card does not take', 'TRUNCATED'),
    ('LAWS 1 PHI, LAWS 1 phi\n1, 2\n', 'this column is there before', ''),
    ('LAWS 1 friction angle, LAWS 1 PHI\n20, 0\n', 'this column is there before'),
    ('BLOCKS 2 ratio\n1\n', 'several fields of BLOCKS have this name', 'ratio along 1-2 (ratio), ratio along 2-3 (ratio)'),
    ('FACES 1 r\n1\n', 'several fields of FACES have this name', 'allowed: '),
    ('CONTROL bodies\n1\n', 'several fields of CONTROL have this name', 'number of planes for bodies'),
    ('LAWS 1 law\nELASTI\n', 'the law is not an integer', ''),
    ('LAWS 1 kind of law\nELASTI\n', 'is unknown', 'did you mean ELASTIC?'),
    ('LAWS 1 PHI\n', 'the table has no rows', 'the first line names what varies'),
    ('LAWS 1 PHI\n10;;20\n', 'a value of the list is blank', ''),
    ('LAWS 1 PHI\n1O\n', 'is not a number', ''),
)


def wrong_tables(program, folder):
    """Each fault in a table is placed and told in words, and nothing is written"""
    deck, faults = os.path.join(INPUTS, 'case3_balanced.dat'), []
    for k, (table, *said) in enumerate(FAULTS):
        path = write(folder, f'wrong{k}.csv', table)
        ran = program.run('study', path, deck, '-o', folder, folder=folder)
        faults += [f'{table!r}: {fault}' for fault in ran.ended_with(2)]
        faults += [f'{table!r}: {part!r} is not said in\n{ran.err}' for part in said if part not in ran.err]
        if ran.err.count(': error: ') != 1:
            faults.append(f'{table!r}: not one error in\n{ran.err}')
        if 'rows' not in said[0] and '^' not in ran.err and 'drawn that' not in said[0]:
            faults.append(f'{table!r}: no place is pointed at in\n{ran.err}')
    left = [name for name in os.listdir(folder) if 'study' in name]
    return faults + expected('files', [], left)


def taken_names(program, folder):
    """What is no file is not replaced by a file of a study or an envelope, nor written to"""
    faults, deck = [], write(folder, 'block.dat', input_deck('block.dat'))
    table = write(folder, 'rows.csv', 'LAWS 1 PHI\n30\n')
    for name in ('rows.study.csv', 'rows.study.h5', 'rows.study.rows', 'block.envelope.csv', 'block.envelope.h5', 'block.envelope.rows'):
        path = os.path.join(folder, name)
        os.mkfifo(path)
        words = ('study', table, deck) if 'study' in name else ('envelope', deck, '--cases', '2')
        ran = program.run(*words, '-o', folder, '--quiet', folder=folder, time_limit=60)
        faults += [f'{name}: {fault}' for fault in ran.ended_with(5)]
        if f'{name} is neither a file nor free' not in ran.err:
            faults.append(f'{name}: {ran.err}')
        os.remove(path)
    return faults + expected('files', ['block.dat', 'rows.csv'], sorted(os.listdir(folder)))


def files_of_others(program, folder):
    """A deck, a table and other files that are named like what a study removes or renames stay, and the study says so"""
    faults = []
    content, text = input_deck('block.dat'), 'my rows\n'
    journal = 'axijoint study, rows that are done; of another\n'
    for files, deck, words in (
            ({'rows.study.STOP': content}, 'rows.study.STOP', 'rows.study.STOP, a file of the deck'),
            ({'rows.study.csv': content}, 'rows.study.csv', 'rows.study.csv, a file of the deck'),
            ({'rows.study.rows': text}, None, 'rows.study.rows does not hold rows'),
            ({'rows.study.rows.old': text, 'rows.study.rows': journal}, None, 'rows.study.rows.old does not hold rows')):
        place = os.path.join(folder, str(len(os.listdir(folder))))
        paths = {write(place, name, what): what for name, what in files.items()}
        table = write(place, 'rows.csv', 'LAWS 1 PHI\n30\n')
        path = os.path.join(place, deck) if deck else write(place, 'block.dat', content)
        ran = program.run('study', table, path, '-o', place, '--quiet', folder=folder, time_limit=60)
        faults += [f'{words}: {fault}' for fault in ran.ended_with(5)] + ([] if words in ran.err else [ran.err])
        for file, what in paths.items():
            if not os.path.isfile(file) or read_text(file) != what:
                faults.append(f'{file} was changed')
    os.makedirs(os.path.join(folder, 'stop', 'rows.study.STOP'))
    ran = program.run('study', table, path, '-o', 'stop', '--quiet', folder=folder, time_limit=60)
    return faults + ran.ended_with(5) + ([] if 'rows.study.STOP would end the run at once' in ran.err else [ran.err])


def taken_back(program, folder):
    """Rows that were put aside, as a table was changed for a while, are taken back by the study that they are of"""
    deck = os.path.join(INPUTS, 'case3_balanced.dat')
    faults, said = [], []
    for values in ('30; 31; 32; 33', '40; 41', '30; 31; 32; 33'):
        table = write(folder, 'rows.csv', f'LAWS 1 PHI\n{values}\n')
        ran = program.run('study', table, deck, '-o', folder, '--part', '1/2', folder=folder)
        faults += ran.ended_with(0)
        said.append(ran.err)
    journals = sorted(name for name in os.listdir(folder) if '.rows' in name)
    faults += expected('journals', 2, len(journals))
    faults += expected('put aside', [False, True, True], ['are ' in err and '.old now' in err for err in said])
    return faults + expected('done before', [False, False, True], ['2 rows of 4 were done before' in err for err in said])


def another_mesh(program, folder):
    """Rows of another mesh are none of a study, nor directions of an envelope: what parts left of it is told, and stays"""
    mesh = read_text(os.path.join(INPUTS, 'peg.msh'))
    deck, table = write(folder, 'peg.dat', input_deck('peg.dat')), write(folder, 'rows.csv', 'LAWS 1 PHI\n30; 31; 32; 33\n')
    words, faults = 'rows of 1 part of another study of this name', []
    for rounds, (said, left) in enumerate(((False, 0), (True, 1))):
        write(folder, 'peg.msh', mesh)
        faults += program.run('study', table, deck, '-o', folder, '--part', '1/2', '--quiet', folder=folder).ended_with(0)
        write(folder, 'peg.msh', mesh + '\n'*rounds)
        ran = program.run('study', table, deck, '-o', folder, '--part', '0/2', folder=folder)
        faults += ran.ended_with(0) + expected(f'mesh {rounds}', (said, left), (words in ran.err, len(glob.glob(f'{folder}/*.rows'))))
    return faults


def bad_rows(program, folder):
    """Values that a deck cannot have together: the row says so, the others are solved"""
    table = 'MATERIALS 1 E, LAWS 1 kind of law, LAWS 1 phi\n2E4,,\n2E4,ELASTIC,20\n1E4,,\n'
    path = write(folder, 'rows.csv', table)
    ran = program.run('study', path, os.path.join(INPUTS, 'case3_balanced.dat'), '-o', folder, folder=folder)
    faults = ran.ended_with(2)
    rows = rows_of(os.path.join(folder, 'rows.study.csv'))
    faults += expected('exit codes', ['0', '2', '0'], [row['exit_code'] for row in rows])
    if 'row 2' not in ran.err or not rows[1]['message']:
        faults.append(f'nothing is said of row 2: {ran.err}')
    # its lines stand side by side, so that a line is a row; what another process left of it is told alike
    again = os.path.join(folder, 'again')
    faults += program.run('study', path, os.path.join(INPUTS, 'case3_balanced.dat'), '-o', again, '--part', '1/1', folder=folder).crash()
    ran = program.run('study', path, os.path.join(INPUTS, 'case3_balanced.dat'), '-o', again, folder=folder)
    faults += ran.ended_with(2)
    for place in (folder, again):
        text = read_text(os.path.join(place, 'rows.study.csv'))
        faults += expected('lines', 4, len(text.splitlines()))
        if ' / allowed: ' not in text:
            faults.append(text)
    return faults + expected('message', rows[1]['message'], rows_of(os.path.join(again, 'rows.study.csv'))[1]['message'])


def samples(program, folder):
    """Samples are those of their distributions: one in each part of a Latin hypercube, means, ends, the same again"""
    table = ('SAMPLES, SEED, SAMPLER, LAWS 1 PHI, LAWS 1 C, RESULTANTS 1 VALUE, MATERIALS 1 E, MATERIALS 2 E\n'
             '8, 3, LHS, UNIFORM 10 30, LOGNORMAL 0.2 0.05, NORMAL 0.4 0.02, TRUNCATED 2E4 4E3 1.5E4 2.5E4, '
             'WEIBULL 5 1E4 1E4\n')
    deck = os.path.join(INPUTS, 'case3_balanced.dat')
    path = write(folder, 'few.csv', table)
    # what rows end with is not looked at: some find no equilibrium
    faults = program.run('study', path, deck, '-o', folder, '--quiet', folder=folder, time_limit=300).crash()
    rows = rows_of(os.path.join(folder, 'few.study.csv'))
    phi = sorted(float(row['LAWS 1 PHI']) for row in rows)
    for k, value in enumerate(phi):
        if not 10 + 20*k/8 <= value <= 10 + 20*(k + 1)/8:
            faults.append(f'no Latin hypercube: {value} is not in part {k + 1} of 8')
    for name, low, high in (('MATERIALS 1 E', 1.5e4, 2.5e4), ('MATERIALS 2 E', 1e4, 9e9), ('LAWS 1 C', 0, 9e9)):
        values = [float(row[name]) for row in rows]
        if not low <= min(values) <= max(values) <= high:
            faults.append(f'{name} is drawn outside its ends: {values}')
    for name, mean, spread in (('RESULTANTS 1 VALUE', 0.4, 0.02), ('LAWS 1 C', 0.2, 0.05)):
        values = [float(row[name]) for row in rows]
        if abs(sum(values)/8 - mean) > spread/4:
            faults.append(f'{name} has the mean {sum(values)/8}')
    program.run('study', path, deck, '-o', os.path.join(folder, 'again'), '--quiet', folder=folder, time_limit=300)
    again = rows_of(os.path.join(folder, 'again', 'few.study.csv'))
    return faults + same_rows(rows, again)


def arrays(program, folder):
    """The HDF5 file has what the table has, all increments, and statistics that NumPy finds, too"""
    python = python_with('numpy, h5py')
    if python is None:
        return []
    rows, faults = study(program, folder, 'POINTS 1 R, LAWS 1 PHI\n,20;25;30\n', os.path.join(INPUTS, 'monopile.dat'))
    faults += expected('rows', 3, len(rows))
    done = subprocess.run([python, '-B', os.path.join(HERE, 'read_study.py'), os.path.join(folder, 'table.study')],
                          capture_output=True, text=True, check=False)
    return faults + ([f'{done.stdout}{done.stderr}'] if done.returncode else [])


def turned_points(program, folder):
    """Points of a study move where the load points, be that along 90 degrees"""
    text = read_text(os.path.join(INPUTS, 'first.dat')).replace('\nEND', '\nPOINTS\n1, 0.5, -0.5, 1, head\nEND')
    found, faults = {}, []
    for angle in (0, 90):
        deck = write(folder, 'turned.dat', text.replace('    1   LATERAL       0.4', f'1, LATERAL, 0.4, {angle}'))
        rows, more = study(program, folder, 'LAWS 1 PHI\n30\n', deck)
        found[angle], faults = rows[0], faults + more
    for one, other in (('head u', 'head u_90'), ('head v', 'head v_90')):
        wanted, moved = float(found[0][one]), float(found[90][other])
        faults += [] if abs(moved/wanted - 1.0) < 1e-6 else [f'{other} is {moved}, but {one} of the load along 0 degrees {wanted}']
    return faults


def envelope(program, folder, deck, *options, code=0):
    """Find an envelope; its rows, and faults"""
    ran = program.run('envelope', deck, '-o', folder, '--quiet', *options, folder=folder, time_limit=300)
    name = os.path.splitext(os.path.basename(deck))[0]
    return rows_of(os.path.join(folder, f'{name}.envelope.csv')), ran.ended_with(code)


def capacities(program, folder):
    """A stiff block under its weight V: it slides at V tan(phi), turns at 2/3 V R tan(phi) of even pressure, and its
    moment is below V R, by less with more harmonics; a search that is killed ends alike"""
    weight, slope = 2.0, math.tan(math.radians(30))
    # four harmonics in place of eight take a quarter of the time
    deck = write(folder, 'block.dat', input_deck('block.dat').replace('    8   33', '    4   33'))
    rows, faults = envelope(program, folder, deck, '--cases', '2', '--directions', '2', '--tolerance', '0.002')
    for row in rows:
        found = float(row['capacity'])
        if not -0.003 <= found/(weight*slope) - 1 <= 1e-6 or row['exit_code'] != '4':
            faults.append(f'slides at {found}, not at {weight*slope}: {row}')
    light = write(folder, 'light.dat', read_text(deck).replace('AXIAL      -2.0', 'AXIAL   -2.0E-7'))
    rows, more = envelope(program, folder, light, '--cases', '2')
    faults += more + expected('directions of one case', ['1.0', '-1.0'], [str(float(row['direction of case 2'])) for row in rows])
    for row in rows:
        if abs(float(row['capacity'])/(weight*slope*1e-7) - 1) > 0.01:
            faults.append(f'a light block slides at {row["capacity"]}, not at {weight*slope*1e-7}')
    (row,), more = envelope(program, folder, deck, '--cases', '4+', '--directions', '1', '--tolerance', '0.002')
    faults += more
    exact = 2/3*weight*slope
    if abs(float(row['capacity'])/exact - 1) > 0.01:
        faults.append(f"turns at {row['capacity']}, not at {exact}")
    (row,), more = envelope(program, folder, deck, '--cases', '3+', '--directions', '1', '--tolerance', '0.002')
    faults += more
    if not 0.9 <= float(row['capacity'])/weight <= 1:
        faults.append(f"tips over at {row['capacity']}, not a little below {weight}")
    rows, more = envelope(program, folder, deck, '--cases', '2,4+', '--directions', '5')
    faults += more
    for row, other in zip(rows, reversed(rows)):
        found, without = float(row['capacity']), float(row['no equilibrium found at'])
        if row['exit_code'] != '4' or not 0.99*without <= found <= without:
            faults.append(f'no mechanism, or more than 1 % open: {row}')
        if abs(found/float(other['capacity']) - 1) > 0.02:
            faults.append(f'the load turned round: {found} and {other["capacity"]}')
    wrong = program.run('envelope', deck, '--cases', '5', '-o', folder, folder=folder)
    faults += wrong.ended_with(2)
    if 'allowed are load cases of the deck, each once: 1, 2, 3, 4' not in wrong.err:
        faults.append(wrong.err)
    faults += expected('names of the program', 1, wrong.err.count('axijoint: '))
    return faults


def paths_of_an_envelope(program, folder):
    """A block that slides and tips over at once: paths of other steps end elsewhere. What is told of a direction is of
    one path: a mechanism that begins at this capacity, or none where the iteration found nothing. Less than the
    tolerance is open"""
    deck = write(folder, 'block.dat', input_deck('block.dat').replace('    8   33', '    2   33'))
    faults = []
    for tolerance in ('0.015', '0.01'):
        ran = program.run('envelope', deck, '-o', folder, '--quiet', '--cases', '2+,3+', '--directions', '4', '--tolerance', tolerance,
                          folder=folder, time_limit=300)
        rows = rows_of(os.path.join(folder, 'block.envelope.csv'))
        faults += ran.ended_with(3 if any(row['exit_code'] == '3' for row in rows) else 0)
        for row in rows:
            found, without = float(row['capacity']), float(row['no equilibrium found at'])
            if not 0 < without - found <= float(tolerance)*without:
                faults.append(f'more than {tolerance} open: {row}')
            # the weight comes first
            said = re.search('beyond the load factor ([0-9.]+):', row['mechanism'])
            if bool(said) != (row['exit_code'] == '4') or said and abs(float(said.group(1)) - 1 - found) > 1e-5*found:
                faults.append(f'not how a path of this capacity ended: {row}')
    return faults


def comes_first(program, folder):
    """What comes before a load grows has the factors of COMBINE, as in a run: a block of 0.5 times 3 times its weight of 2
    slides at 3 tan(phi), whatever factor its lateral load has there. Nothing is searched if the deck does not say which
    factor, or if what comes first has no equilibrium"""
    text = input_deck('block.dat').replace('    8   33', '    4   33')
    combined = '    1    1       1.0    2       0.5    3       0.5    4       0.2'
    first = '       1.0    1.0E-6  200    1'
    half = text.replace(combined, '    1    1       0.5    2       3.0').replace(first, '       3.0    1.0E-6  200    1')
    rows, faults = envelope(program, folder, write(folder, 'half.dat', half), '--cases', '2', '--tolerance', '0.002')
    for row in rows:
        faults += close('slides', 3*math.tan(math.radians(30)), float(row['capacity']), 0.01)
        if 'case 1 at 1.5, ' not in row['mechanism']:
            faults.append(f'not 1.5 of the weight: {row["mechanism"]}')
    # combinations that agree on what comes first are as good as one
    agree = half.replace('2       3.0', '2       3.0\n    2    1       0.5    3       2.0')
    again, more = envelope(program, folder, write(folder, 'agree.dat', agree), '--cases', '2', '--tolerance', '0.002')
    faults += more + expected('capacities of decks that agree', [row['capacity'] for row in rows], [row['capacity'] for row in again])
    for name, deck, code, words in (
            ('several', agree.replace('    2    1       0.5', '    2    1       0.6'), 2,
             'load case 1 comes first, and combinations give it the factors 0.5 and 0.6'),
            ('none', half.replace('    1    1       0.5', '    1    4       0.5'), 2,
             'load case 1 comes first, and no combination has it'),
            ('lifted', text.replace('AXIAL      -2.0', 'AXIAL       2.0'), 4,
             'no equilibrium was found of the increments that come first, so nothing can be searched\n'
             'no equilibrium was found beyond the load factor 0: the part with node 1 moves along z (harmonic 0 symmetric)\n')):
        ran = program.run('envelope', write(folder, f'{name}.dat', deck), '--cases', '2', '-o', folder, folder=folder)
        faults += [f'{name}: {fault}' for fault in ran.ended_with(code)] + ([] if words in ran.err else [f'{name}: {ran.err}'])
        faults += expected('files', [f'{name}.dat'], [file for file in os.listdir(folder) if file.startswith(name)])
    return faults


def warned(program, folder):
    """Warnings of the deck and remarks on the results that a run tells stand in the message of a row that ends well, too, and
    the end of the study says how many rows have some; of those that say why a row ended otherwise, that comes first"""
    faults = []
    for name, text, column, values in (
            ('layers', read_text(os.path.join(HERE, 'good', 'in_situ_layers_apart.dat')), 'MATERIALS 1 E', '""'),
            ('torn', input_deck('case2_balanced.dat').replace('INCREMENTS\n', 'LAWDETAILS\n1,RESULTANT,BOND\nINCREMENTS\n'), 'LAWS 1 PHI', '30'),
            ('soft', input_deck('first.dat').replace('E4', 'E0'), 'LAWS 1 PHI', '30'),
            ('moves off', input_deck('block.dat').replace('AXIAL      -2.0', 'AXIAL       2.0'), 'LAWS 1 PHI', '30')):
        deck = write(folder, f'{name}.dat', text)
        code = 4 if name == 'moves off' else 0
        faults += program.run('run', deck, '-o', folder, '--quiet', folder=folder).ended_with(code)
        told = json.loads(read_text(os.path.join(folder, f'{name}.json')))['messages']
        table = write(folder, 'rows.csv', f'{column}\n{values}\n')
        ran = program.run('study', table, deck, '-o', folder, folder=folder)
        faults += [f'{name}: {fault}' for fault in ran.ended_with(code)]
        (row,) = rows_of(os.path.join(folder, 'rows.study.csv'))
        said = row['message'].split(' / ')
        faults += [f'{name}: a run does not say {line!r}, but {told}' for line in said if line not in told]
        faults += [f'{name}: the row does not say {line!r}' for line in told if ('warning: ' in line or 'bonds' in line) and line not in said]
        if not row['message'] or code == 4 and not said[0].startswith('no equilibrium was found beyond'):
            faults.append(f'{name}: not said in a row: {told}')
        if ('1 converged row with warnings or remarks: column message' in ran.out) != (code == 0):
            faults.append(f'{name}: {ran.out}')
    # without estimates nobody knows what a coarse tolerance leaves
    coarse = 'INCREMENTS\n       1.0    1.0E-2\nRESULTANTS'
    deck = write(folder, 'coarse.dat', input_deck('first.dat').replace('RESULTANTS', coarse, 1))
    for options, words in (((), ['a tolerance of 0.01 may leave joint stresses several per cent wrong (default 1E-6)']),
                           (('--estimates',), [''])):
        rows, more = study(program, folder, 'LAWS 1 PHI\n30\n', deck, *options)
        faults += more + expected('messages', words, [row['message'] for row in rows])
    # what a run refuses when all cards are read is refused in a row, too
    deck = write(folder, 'yields.dat', read_text(os.path.join(HERE, 'bad', 'yield_in_situ.dat')).replace('MOHR, 0.01', 'MOHR, 1.0'))
    rows, more = study(program, folder, 'YIELD 1 STRENGTH\n0.01\n1.0\n', deck, '--processes', '1', code=2)
    faults += more + expected('exit codes', ['2', '0'], [row['exit_code'] for row in rows])
    return faults + ([] if 'in-situ stress is beyond yield' in rows[0]['message'] else [rows[0]['message']])


def kept(program, folder):
    """A row follows all increments, whatever the deck keeps of them: its work is that of a run that keeps all"""
    deck = input_deck('monopile.dat')
    keeps = write(folder, 'keeps.dat', deck.replace('POINTS ', 'KEEP\n  SERIES        LAST\nPOINTS ', 1))
    whole = write(folder, 'whole.dat', deck)
    ran = program.run('study', write(folder, 'rows.csv', 'LAWS 1 PHI\n26\n'), keeps, '-o', folder, '--estimates', folder=folder)
    faults = ran.ended_with(0)
    for path in (keeps, whole):
        faults += program.run('run', path, '-o', folder, '--quiet', folder=folder).ended_with(0)
    (row,) = rows_of(os.path.join(folder, 'rows.study.csv'))
    fine, coarse = (json.loads(read_text(os.path.join(folder, f'{name}.json'))) for name in ('whole', 'keeps'))
    faults += compared(row, fine, 'a row, and a run that keeps all increments')
    words = 'sums over the increments that SERIES of KEEP keeps'
    if not any(words in line for line in coarse['messages']) or words in row['message']:
        faults.append(f'{words!r} is true of a run that keeps fewer alone: {coarse["messages"]}, {row["message"]}')
    return faults


def structures(program, folder):
    """As many structures as a study makes are foretold: cells that keep the deck's value lie between given ones, and rows
    that the deck refuses need none"""
    deck = os.path.join(INPUTS, 'first.dat')
    table = write(folder, 'rows.csv', 'CONTROL M, LAWS 1 k_eta, BLOCKS 1 n2, RESULTANTS 1 VALUE\n,,,0.1;0.2\n0;2;3,,,\n,1.0E5;1.0E3,,\n'
                  ',,5,\n,,,0.3;0.4\n')
    ran = program.run('study', table, deck, '-o', folder, '--processes', '1', folder=folder)
    made = re.search('solved now with ([0-9]+) structures', ran.out)
    told = program.run('estimate', deck, '--study', table, folder=folder)
    foretold = re.search('10 rows on ([0-9]+) structures', told.out)
    if not made or not foretold:
        return [f'{ran.out}{ran.err}', f'{told.out}{told.err}']
    return ran.ended_with(2) + expected('structures', ('5', '5'), (made.group(1), foretold.group(1)))


def as_written(program, folder):
    """Heads in quotes, tabs beside commas, symbols of fields; a code is told as it was written"""
    deck = write(folder, 'first.dat', input_deck('first.dat'))
    write(folder, 'written.csv', '"BLOCKS 2 n1"\t,\tFACES 4 r2 , FIXEDFACES 1 CODE\n6,2.0\t,101\n,,111\n')
    ran = program.run('study', 'written.csv', deck, folder=folder)
    rows = rows_of(os.path.join(folder, 'written.study.csv'))
    faults = ran.ended_with(4)
    faults += expected('code', ['101', '111'], [row['FIXEDFACES 1 CODE'] for row in rows])
    faults += expected('elements', ['6', ''], [row['BLOCKS 2 N1'] for row in rows])
    faults += expected('exit codes', ['4', '0'], [row['exit_code'] for row in rows])
    return faults + ([] if 'FIXEDFACES 1 CODE = 101' in ran.err else [ran.err])


def tests(program):
    """All of them"""
    found = [Test(f'studies/every field of {deck}', lambda folder, deck=deck: every_field(program, folder, deck))
             for deck in VARIED]
    return found + [
        Test('studies/controls', lambda folder: controls(program, folder)),
        Test('studies/planes', lambda folder: planes(program, folder)),
        Test('studies/yielding', lambda folder: yielding(program, folder)),
        Test('studies/turned points', lambda folder: turned_points(program, folder)),
        Test('studies/order and parts', lambda folder: order_does_not_matter(program, folder)),
        Test('studies/other parts', lambda folder: other_parts(program, folder)),
        Test('studies/processes', lambda folder: processes(program, folder)),
        Test('studies/wrong tables', lambda folder: wrong_tables(program, folder)),
        Test('studies/taken names', lambda folder: taken_names(program, folder)),
        Test('studies/files of others', lambda folder: files_of_others(program, folder)),
        Test('studies/taken back', lambda folder: taken_back(program, folder)),
        Test('studies/another mesh', lambda folder: another_mesh(program, folder)),
        Test('studies/as written', lambda folder: as_written(program, folder)),
        Test('studies/bad rows', lambda folder: bad_rows(program, folder)),
        Test('studies/samples', lambda folder: samples(program, folder)),
        Test('studies/arrays', lambda folder: arrays(program, folder)),
        Test('studies/envelope of a block', lambda folder: capacities(program, folder)),
        Test('studies/paths of an envelope', lambda folder: paths_of_an_envelope(program, folder)),
        Test('studies/what comes first in an envelope', lambda folder: comes_first(program, folder)),
        Test('studies/warned', lambda folder: warned(program, folder)),
        Test('studies/kept', lambda folder: kept(program, folder)),
        Test('studies/structures foretold', lambda folder: structures(program, folder)),
        Test('studies/shared', lambda folder: shared(program, folder)),
        Test('studies/dead parts', lambda folder: dead_parts(program, folder)),
        Test('studies/STOP file', lambda folder: stop_file(program, folder)),
        Test('studies/little memory', lambda folder: little_memory(program, folder)),
        Test('studies/killed', lambda folder: killed(program, folder, 8, '1', '0:38/5, 0;0.2, 0.2;0.4')),
        Test('studies/killed, two processes', lambda folder: killed(program, folder, 8, '2', '0:38/5, 0;0.2, 0.2;0.4')),
        Test('studies/killed 250 times', lambda folder: killed(program, folder, 250, '1'), long=True),
        Test('studies/killed 250 times, two processes', lambda folder: killed(program, folder, 250, '2'), long=True)]
