"""Tables of a listing as numbers"""
import re

COLUMNS = {
    'displacements': ('node', 'r', 'z', 'u', 'v', 'w'),
    'stresses': ('element', 'point', 'r', 'z', 'sigma_r', 'sigma_z', 'sigma_theta', 'tau_rz',
                 'tau_rtheta', 'tau_ztheta'),
    'joints': ('joint', 'point', 'r', 'z', 'theta', 'tau_xi', 'sigma', 'tau_theta', 'd_xi',
               'd_eta', 'd_theta', 'state'),
    'node stresses': ('node', 'material', 'r', 'z', 'sigma_r', 'sigma_z', 'sigma_theta', 'tau_rz',
                      'tau_rtheta', 'tau_ztheta'),
    'points': ('point', 'r', 'z', 'body', 'material', 'u', 'v', 'w'),
    'point stresses': ('point', 'r', 'z', 'body', 'material', 'sigma_r', 'sigma_z', 'sigma_theta',
                       'tau_rz', 'tau_rtheta', 'tau_ztheta'),
    'cuts': ('cut', 'z', 'body', 'axial', 'shear', 'shear_90', 'moment', 'moment_90', 'torque'),
    'faces': ('face', 'axial', 'force', 'force_90', 'moment', 'moment_90', 'torque'),
    'equilibrium': ('applied', 'reacted', 'sum'),
}
HEADINGS = (
    (re.compile(r'DISPLACEMENT AMPLITUDES, harmonic (\d+) symmetric'), 'm = {}', 'displacements'),
    (re.compile(r'DISPLACEMENT AMPLITUDES, harmonic (\d+) antisymmetric'), 'm = {} A',
     'displacements'),
    (re.compile(r'TOTAL DISPLACEMENTS, theta = (\S+) degrees'), 'theta = {}', 'displacements'),
    (re.compile(r'TOTAL STRESSES AT GAUSS POINTS, theta = (\S+) degrees'), 'stresses, theta = {}',
     'stresses'),
    (re.compile(r'TOTAL STRESSES AT NODES, theta = (\S+) degrees'), 'nodal stresses, theta = {}',
     'node stresses'),
    (re.compile(r'JOINT STRESSES(), RELATIVE DISPLACEMENTS'), 'joints', 'joints'),
    (re.compile(r'DISPLACEMENTS ON SECTION (.*) degrees'), 'section {}', 'points'),
    (re.compile(r'STRESSES ON SECTION (.*) degrees'), 'stresses, section {}', 'point stresses'),
    (re.compile(r'RESULTANTS ON CUTS()'), 'cuts', 'cuts'),
    (re.compile(r'REACTIONS OF SUPPORTED FACES()'), 'faces', 'faces'),
    (re.compile(r'EQUILIBRIUM()'), 'equilibrium', 'equilibrium'),
)
RESULTANTS = {'axial force': 'axial', 'lateral force (along theta = 0)': 'lateral',
              'moment (lifts theta = 0)': 'moment', 'torque': 'torque',
              'lateral force (along theta = 90)': 'lateral_90',
              'moment (lifts theta = 90)': 'moment_90'}


def all_rows(deck):
    """A deck whose listing has all tables whole, however long they are"""
    if '\nPRINT\n' in deck:
        return deck
    above, end, below = deck.rpartition('\nEND')
    return above + '\nPRINT\n TABLES, ALL' + end + below


def tables(text):
    """Tables by name; each a list of rows, each row a dictionary by the names of its columns"""
    found, lines, k = {}, text.split('\n'), 0
    while k < len(lines):
        for heading, name, kind in HEADINGS:
            match = heading.match(lines[k])
            if match:
                rows = []
                k += 2
                while k < len(lines) and lines[k].strip():
                    rows.append(row(kind, lines[k]))
                    k += 1
                found[name.format(match[1])] = [r for r in rows if r]
        k += 1
    return found


def row(kind, line):
    """One row of a table; None if the line is none"""
    name = ''
    if kind == 'equilibrium':
        words = [word for word in RESULTANTS if line.strip().startswith(word)]
        if not words:
            return None
        name, line = RESULTANTS[words[0]], line.split(')', 1)[1]
    fields = line.split()
    if len(fields) != len(COLUMNS[kind]):
        return None
    values = dict(zip(COLUMNS[kind], fields))
    try:
        values = {key: field if key in ('state', 'body') else float(field) for key, field in values.items()}
    except ValueError:
        return None
    values['name'] = name
    return values


def results(text):
    """The part of a listing that does not depend on how the deck is written, when it was run and
    how long it took"""
    return text[text.index('\nMODEL\n'):text.index('\nTIMES ')]
