"""Prints results of a listing as RING7 would have: another layout, units, signs and numbers"""
import math
import random

STATES = {'stick': 'FIX', 'slip': 'SLD', 'open': 'GAP'}
LINES_A_PAGE = 50


def d_format(value, width, digits):
    """A number in Dw.d: 0.1234D-03, 0.1234-101; zero is blank in tables of nodes"""
    if value == 0:
        return f'{"0." + "0"*digits + "D+00":>{width}}'
    mantissa, exponent = f'{abs(value):.{digits - 1}E}'.split('E')
    power = int(exponent) + 1
    letter = f'D{power:+03d}' if abs(power) < 100 else f'{power:+04d}'
    text = '0.' + mantissa.replace('.', '') + letter
    text = ('-' if value < 0 else '') + text
    if len(text) > width:  # columns touch
        text = text.replace('0.', '.', 1)
    return f'{text:>{width}}'


class Printer:
    """Lines on pages, with carriage control"""

    def __init__(self):
        self.lines = []
        self.page = 0
        self.heads = []

    def new_page(self):
        self.page += 1
        self.lines += [f'1RING7   PILE HEAD                                PAGE {self.page:4d}', '0']
        self.lines += [' ' + head for head in self.heads]

    def put(self, text, control=' '):
        if len(self.lines) % LINES_A_PAGE == 0:
            self.new_page()
        self.lines.append(control + text)

    def table(self, *heads):
        """Headings, repeated on each page"""
        self.heads = list(heads)
        self.lines += ['0'] + [' ' + head for head in heads]


def renumbered(nodes):
    """Other numbers for nodes: from the top, in a fixed but random order on each level"""
    mixer = random.Random(1985)
    order = sorted(nodes, key=lambda row: (-row['z'], mixer.random()))
    return {row['node']: 11 + 3*k for k, row in enumerate(order)}


def component(value, blank_zeros=True):
    return ' '*14 if value == 0 and blank_zeros else d_format(value, 14, 8)


def node_table(printer, head, columns, rows, numbers):
    """A table of nodes; columns: name and factor"""
    printer.table(head, 'NODE' + ''.join(f'{name.upper():>14}' for name, _ in columns))
    for row in sorted(rows, key=lambda row: numbers[row['node']]):
        printer.put(f'{numbers[row["node"]]:5d}' +
                    ''.join(component(factor*row[name]) for name, factor in columns))


def old_listing(tables, change=lambda rows: rows):
    """The text. tables: of listing.tables, with 'reactions m = 0' and so on"""
    printer = Printer()
    printer.new_page()
    numbers = renumbered(tables['nodes'])
    printer.table('NODAL POINT DATA', 'NODE         R         Z')
    for row in sorted(tables['nodes'], key=lambda row: numbers[row['node']]):
        printer.put(f'{numbers[row["node"]]:5d}{1000*row["r"]:10.3f}{1000*row["z"]:10.3f}')
    for m in range(5):
        printer.heads = []
        printer.put(f'HARMONIC NUMBER ={m:3d}', '0')
        node_table(printer, 'NODAL DISPLACEMENTS', (('w', -1e3), ('u', 1e3), ('v', 1e3)),
                   change(tables[f'm = {m}']), numbers)
        radian = 1/((2 if m == 0 else 1)*math.pi)
        node_table(printer, 'NODAL REACTIONS PER RADIAN',
                   (('R_u', radian), ('R_v', radian), ('R_w', -radian)),
                   tables[f'reactions m = {m}'], numbers)
    for theta in sorted({row['theta'] for row in tables['joints']}, reverse=True):
        joint_table(printer, theta, [row for row in tables['joints'] if row['theta'] == theta])
    printer.heads = []
    printer.put('NORMAL END OF RING7', '0')
    return '\n'.join(printer.lines) + '\n'


def joint_table(printer, theta, rows):
    """Joints on one plane; the number of a joint only in its first line"""
    printer.table(f'JOINT RESULTS AT ANGLE {theta:9.3f}', 'JOINT        R         Z        PRESSURE')
    last = 0
    for row in rows:
        number = '     ' if row['joint'] == last else f'{100 - row["joint"]:5.0f}'
        last = row['joint']
        values = (-1e3*row['sigma'], 1e3*row['tau_xi'], -1e3*row['tau_theta'],
                  1e3*row['d_eta'], 1e3*row['d_xi'], -1e3*row['d_theta'])
        printer.put(f'{number}{1000*row["r"]:10.3f}{1000*row["z"]:10.3f}' +
                    ''.join(d_format(value, 13, 6) for value in values) + f'{STATES[row["state"]]:>8}')
    printer.heads = []
    printer.put('END OF JOINT RESULTS')
