"""PRINT: the rows that it asks for are those of the whole listing, and what stands for the others are their extremes"""
import os
import re

import listing
from support import HERE, INPUTS, Test, expected, input_deck, read_text, write

# Tables of the whole listing by their words on cards; values by their columns
TABLES = {'AMPLITUDE': 'm = ', 'TOTALS': 'theta = ', 'STRESSES': 'stresses, theta = ', 'NODAL': 'nodal stresses, theta = ', 'STATES': 'joints'}
PLACE = ('node', 'element', 'joint', 'point', 'material', 'r', 'z', 'theta', 'state', 'name')


def run(program, folder, name, cards=''):
    """The listing of the peg with cards of PRINT"""
    deck = input_deck('first.dat').replace('\nEND\n', '\n' + ('PRINT\n' + cards if cards else '') + 'END\n')
    ran = program.run('run', write(folder, f'{name}.dat', deck), '-o', folder)
    if ran.code != 0:
        raise AssertionError(f'exit code {ran.code}\n{ran.err}')
    return read_text(os.path.join(folder, f'{name}.lis'))


def of_word(tables, word):
    """Tables that a word on a card stands for"""
    return {name: rows for name, rows in tables.items() if name.startswith(TABLES[word])}


def chosen_rows(program, folder):
    """Every n-th row, rows of a body, rows of a rectangle, and two cards that add up; of each table"""
    whole, faults = listing.tables(run(program, folder, 'whole')), []
    planes = len({row['theta'] for row in whole['joints']})
    pile = lambda row: row['r'] < 0.5 - 1e-9 or row['z'] < -1e-9 or ('node' in row and row['node'] <= 65)
    cases = {
        ' {}, EVERY, 3': lambda rows, k, row: k//planes % 3 == 0 if 'joint' in row else k % 3 == 0,
        ' {}, ALL, , , 0.5, 0.5, 2, 1': lambda rows, k, row: row['r'] >= 0.5 and row['z'] >= 0.5,
        ' {0}, ALL, , , 0, -1, 0.25, 0\n {0}, ALL, , , 1.5, 0, 2, 1': lambda rows, k, row:
            (row['r'] <= 0.25 and row['z'] <= 0) or (row['r'] >= 1.5 and row['z'] >= 0),
        ' {}, ALL, , 1': lambda rows, k, row: 'joint' in row or pile(row)}
    for number, (card, wanted) in enumerate(cases.items()):
        cards = ''.join(card.format(word) + '\n' for word in TABLES)
        found = listing.tables(run(program, folder, f'case{number}', cards))
        for name, rows in whole.items():
            if not any(name.startswith(start) for start in TABLES.values()):
                faults += expected(f'{card}: {name}', rows, found.get(name))
                continue
            left = [row for k, row in enumerate(rows) if wanted(rows, k, row)]
            if found.get(name, []) != left:
                faults.append(f'{card}: {name}: expected {len(left)} rows of {len(rows)}, found {len(found.get(name, []))}')
    return faults


def extremes(program, folder):
    """Of tables that are too long the least and the largest value of each column, where they stand"""
    whole, text, faults = listing.tables(run(program, folder, 'whole')), run(program, folder, 'short', ' TABLES, UPTO, 1\n'), []
    short = listing.tables(text)
    for word in TABLES:
        faults += expected(f'tables for {word}', [], list(of_word(short, word)))
    found = {}
    for block in text.split('\nEXTREMES OF ')[1:]:
        title, _, count, _, *lines = block.split('\n')
        name = list(listing.tables(title + '\n---\n-\n'))
        if not name:
            continue  # reactions, which are no table here
        rows = whole[name[0]]
        faults += expected(f'{title}: count', f'  0 of {len(rows)} rows', count[:count.index(' listed')])
        for line in lines[:lines.index('')]:
            column, *fields = line.split()
            values = [row[column] for row in rows]
            half = len(fields)//2
            for best, (value, label, *place) in ((min(values), fields[:half]), (max(values), fields[half:])):
                if not abs(float(value) - best) <= 1e-5*abs(best):
                    faults.append(f'{title}: {column}: expected {best}, found {value}')
                if not any(abs(row[column] - best) <= 1e-5*abs(best) and float(label) in (row.get('node'), row.get('element'), row.get('joint'))
                           and abs(row['r'] - float(place[0])) < 1e-4 for row in rows):
                    faults.append(f'{title}: {column} is not {best} at {label}, r = {place[0]}')
            found[title, column] = True
    columns = sum(len([key for key in rows[0] if key not in PLACE]) for word in TABLES for rows in of_word(whole, word).values())
    return faults + expected('columns with extremes', columns, len(found))


def no_table(program, folder):
    """NONE leaves tables out, without a word; the results are what they were"""
    run(program, folder, 'whole')
    text = run(program, folder, 'none', ' TABLES, NONE\n STATES, ALL\n')
    faults = [f'found {word!r}' for word in ('\nDECK', '\nNODES', '\nELEMENTS', '\nJOINTS (', '\nLOADS', 'AMPLITUDES', 'TOTAL', 'REACTIONS, ',
                                             'increment   iteration', 'listed') if word in text]
    faults += [f'expected {word!r}' for word in ('\nMODEL', 'JOINT STRESSES', 'EQUILIBRIUM', 'ERROR BUDGET', 'END OF LISTING') if word not in text]
    compared = program.run('compare', os.path.join(folder, 'whole.h5'), os.path.join(folder, 'none.h5'))
    return faults + expected('compare', 0, compared.code)


def long_tables(program, folder):
    """A job of 10,404 nodes has no table of them unless it asks for one; its listing is short"""
    deck = ('TITLE\nA large block\nCONTROL\n0\nMATERIALS\n1, 1E4, 0.2\nBLOCKS\n1, 1, 4, 101, 101\n1, 0, 2, 1\nFACES\n1, 1, 1, 0, 2, 0\n'
            '2, 1, 1, 1, 2, 1\nFIXEDFACES\n1, 111\nTRACTIONS\n2, 0, 0, 1, 1, , , 1\n')
    deck = deck.replace('2, 0, 0, 1, 1, , , 1', '2, 0, 0, 1')
    faults, lengths = [], []
    for cards in ('', 'PRINT\n COORDS, ALL\n'):
        ran = program.run('run', write(folder, 'large.dat', deck + cards + 'END\n'), '-o', folder)
        faults += ran.ended_with(0)
        lengths.append(len(re.findall('\n', read_text(os.path.join(folder, 'large.lis')))))
    if not lengths[0] < 600 or lengths[1] - lengths[0] < 10404:
        faults.append(f'expected a listing of less than 600 lines, and one with all nodes, found {lengths}')
    return faults


def orders(program, folder):
    """Orders of the nodes: all side by side where that is asked for, else that of the solver, with the same figures"""
    def rows(text):
        table = text.split('order of the nodes')[1].split('harmonic')[0]
        return [re.split(r'  +', line.strip()) for line in table.split('\n')[1:-1]]

    def deck_with(cards):
        return input_deck('first.dat').replace('\nEND\n', f'\nPRINT\n{cards}END\n' if cards else '\nEND\n')

    write(folder, 'whole.dat', deck_with(' TABLES, ALL\n'))
    faults = program.run('run', 'whole.dat', '-o', folder, folder=folder).ended_with(0)
    whole = rows(read_text(os.path.join(folder, 'whole.lis')))
    faults += expected('orders', ['reverse Cuthill-McKee', 'Sloan', 'nested dissection'],
                       [row[0] for row in whole])
    skyline = ['Sloan or Cuthill-McKee', *min(whole[:2], key=lambda row: int(row[2]))[1:]]
    for solver, own in (('SPARSE', whole[2]), ('BAND', whole[0]), ('SKYLINE', skyline)):
        for name, cards, wanted in (('usual', '', [own]), ('none', ' ORDERS, NONE\n', [own]), ('few', ' ORDERS, UPTO, 20\n', [own]),
                                    ('all', ' ORDERS, ALL\n', whole)):
            deck = deck_with(cards)
            ran = program.run('run', write(folder, f'{name}.dat', deck), '-o', folder, '--solver', solver)
            faults += ran.ended_with(0) + expected(f'{solver}, {name}', wanted, rows(read_text(os.path.join(folder, f'{name}.lis'))))
    return faults


def width(program, folder):
    """No listing is wider than 132 columns: errors of several hundred per cent, bodies that yield, increments, elements
    that have yielded and errors where no equilibrium was found"""
    good = os.path.join(HERE, 'good')
    column = read_text(os.path.join(good, 'yield_column.dat')).replace('500.0', '').replace('YIELDDEPTH\n    1       3.0       0.0\n', '')
    decks = [os.path.join(INPUTS, 'hard', 'rigid_joints.dat'), os.path.join(INPUTS, 'pile_clay.dat'), os.path.join(good, 'cuts.dat'),
             write(folder, 'limit.dat', column)]
    program.run('run', *decks, '-o', folder, folder=folder, time_limit=300)
    faults = []
    for deck in decks:
        name = os.path.splitext(os.path.basename(deck))[0]
        text = read_text(os.path.join(folder, f'{name}.lis'))
        faults += [f'{name}: {len(line)} columns: {line}' for line in text.split('\n') if len(line) > 132]
    found = [line for line in read_text(os.path.join(folder, 'limit.lis')).split('\n') if line.endswith(' ***') and line[:10].strip().isdigit()]
    return faults + expected('increments that are marked', 1, len(found))


def named_points(program, folder):
    """Named points at nodes move, increment by increment, as tables of the node say of runs that end there"""
    deck = input_deck('first.dat').replace('\nEND\n', '\nINCREMENTS\n{}POINTS\n 3, 0.5, -0.5, 1, end\n 8, 2.0, 0.0, 2\nEND\n')
    faults, rows = [], {}
    for name, factors in (('half', '0.5\n'), ('whole', '0.5\n0.5\n')):
        ran = program.run('run', write(folder, f'{name}.dat', deck.format(factors)), '-o', folder)
        faults += ran.ended_with(0)
        text = read_text(os.path.join(folder, f'{name}.lis'))
        tables = listing.tables(text)
        for label, place in (('POINT 3, end', (0.5, -0.5)), ('POINT 8, point 8', (2.0, 0.0))):
            for angle in (0, 90, 180):
                block = text.split(f'\n{label}, theta = {angle} degrees\n')[1].split('\n\n')[0].split('\n')[3:]
                rows[name, label, angle] = [[float(word) for word in line.split()] for line in block]
                node = [row for row in tables[f'theta = {angle}'] if (row['r'], row['z']) == place][0]
                faults += expected(f'{name}: {label}, {angle}', [node['u'], node['v'], node['w']], rows[name, label, angle][-1][2:])
    for (name, *which), found in rows.items():
        if name == 'half':
            faults += expected(f'{which}: first increment', found, rows['whole', *which][:1])
    return faults


def tests(program):
    """The tests of this module"""
    return [Test(f'print: {name}', lambda folder, check=check: check(program, folder)) for name, check in {
        'rows': chosen_rows, 'extremes': extremes, 'none': no_table, 'long tables': long_tables, 'orders': orders, 'width': width,
        'named points': named_points}.items()]
