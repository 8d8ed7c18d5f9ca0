"""The decks in `good`, with the results that their comment cards expect, and in `unsolved`

    ! expect: joint_states.open = 0              a key of the summary; `exit`: the exit code
    ! expect: in_situ.parts.0.weight = 1         in a list: the place, from 0 on
    ! expect: m = 1: u = -1.0E-3*(z**2 + 0.3*r**2)    amplitudes of harmonic 1 at all nodes
    ! expect: node 7, m = 1: u = 1.2E-3          at one node
    ! expect: m = 0 A: w = -1.0E-3*r             of the antisymmetric family
    ! expect: stresses, theta = 0: sigma_z = 10  at all Gauss points
    ! expect: joints: sigma = -10                at all joint points on all planes
    ! expect: reacted: axial = -3.2              resultants: axial, lateral, moment, torque, and
                                                 lateral_90, moment_90 at theta = 90
    ! warns: 7: warning: ...                     a warning; without one there must be none

An expression may name the columns of its row, pi, and the functions sqrt, sin and cos. The largest
error may be 1E-5 times the largest value expected (the listing shows positions with five digits),
or what follows `within` times it; where 0 is expected, it may be 1E-12, or what follows `within`. A value of
the summary is as expected, or differs by no more than what follows `within`.
"""
import json
import math
import os
import re

import listing
from messages import expected_messages, message_faults
from support import EarlierResults, HERE, Test, expected, read_bytes, read_text

CARD = re.compile(r'! (?:expect): (?:(?P<table>[^:]*): )?(?P<name>[\w.]+) = (?P<value>.+?)'
                  r'(?: within (?P<within>\S+))?$')
SAYS = re.compile(r'! (exit|says): (.*)$')
FUNCTIONS = {'pi': math.pi, 'sqrt': math.sqrt, 'sin': math.sin, 'cos': math.cos,
             '__builtins__': {}}
# Mark of results that are not converged; tolerances: relative, and absolute where 0 is expected
LABEL = '*** NOT CONVERGED ***'
LISTED = 1e-5
ROUNDING = 1e-12


def rows_of(table, tables):
    """Rows that an expectation is about"""
    node = re.match(r'node (\d+), (.*)$', table)
    if node:
        return [row for row in tables.get(node[2], []) if row['node'] == int(node[1])]
    if table in ('applied', 'reacted'):
        return tables['equilibrium']
    return tables.get(table, [])


def value_faults(card, tables):
    """Faults of one expectation of a table"""
    table, name = card['table'], card['name']
    rows = rows_of(table, tables)
    if table in ('applied', 'reacted'):
        rows = [row for row in rows if row['name'] == name]
        name = table
    if not rows:
        return [f'{card[0]}: found no such rows']
    wanted = [eval(card['value'], FUNCTIONS, row) for row in rows]
    largest = max(map(abs, wanted))
    tolerance = float(card['within'] or LISTED)*largest
    if largest == 0:
        tolerance = float(card['within'] or ROUNDING)
    errors = [abs(row[name] - value) for row, value in zip(rows, wanted)]
    k = max(range(len(rows)), key=lambda k: math.inf if math.isnan(errors[k]) else errors[k])
    if not errors[k] <= tolerance:
        return [f'{card[0]}: expected {wanted[k]:.8G} within {tolerance:.1E}, found {rows[k][name]}'
                f' (error {errors[k]:.1E}) in {rows[k]}']
    return []


def summary_value(summary, name):
    """A value of the summary; a dot leads inside, a number into a list"""
    for key in name.split('.'):
        summary = summary[int(key) if isinstance(summary, list) else key]
    return summary


def summary_faults(card, summary):
    """Faults of one expectation of the summary"""
    found = summary_value(summary, card['name'])
    wanted = json.loads(card['value'])
    if card['within']:
        good = abs(found - wanted) <= float(card['within'])
    else:
        good = found == wanted
    return [] if good else [f'{card[0]}: found {found}']


def whole_faults(folder, name, summary, text):
    """Faults of the three files as such"""
    faults = expected('files', sorted(f'{name}.{ending}' for ending in ('h5', 'json', 'lis')),
                      sorted(os.listdir(folder)))
    if not text.rstrip().split('\n')[-1].startswith('END OF LISTING'):
        faults.append('the listing has no end')
    with open(os.path.join(folder, f'{name}.h5'), 'rb') as file:
        faults += expected('first bytes of the HDF5 file', b'\x89HDF\r\n\x1a\n', file.read(8))
    if not re.search(f'^run +{re.escape(summary["run"])}$', text, re.MULTILINE):
        faults.append('listing and summary are not of the same run')
    return faults


def label_faults(converged, text, summary, results):
    """Faults unless header, tables of results, last line, summary and HDF5 file say that the
    results are not converged, or unless none does"""
    headings = re.findall(r'^(?:DISPLACEMENT|TOTAL|STRESSES|RESULTANTS|JOINT STRESSES|REACTIONS|EQUILIBRIUM|END OF).*|'
                          r'^status .*', text, re.MULTILINE)
    faults = [f'the line {line!r} is wrongly labelled' for line in headings
              if (LABEL in line) == converged]
    status = 'converged' if converged else 'not_converged'
    faults += expected('status', status, summary['status'])
    if not converged and LABEL not in summary['messages'][0]:
        faults.append('the messages of the summary do not tell it')
    if (b'not_converged' in results) == converged:
        faults.append('the HDF5 file has another status')
    return faults


def good_faults(program, deck, folder):
    """Run a deck and compare"""
    name = os.path.splitext(os.path.basename(deck))[0]
    cards = [CARD.match(card) for card in read_text(deck).split('\n')
             if card.startswith('! expect: ')]
    if not cards or None in cards:
        return ['an expectation is lacking or cannot be understood']
    code = [int(card['value']) for card in cards if card['name'] == 'exit']
    ran = program.run('run', deck, '-o', folder)
    faults = ran.ended_with(code[0] if code else 0)
    if faults:
        return faults
    if not ran.out.startswith('deck '):
        faults.append(f'expected the brief summary only, found\n{ran.out}')
    warnings = expected_messages(read_text(deck), 'warns')
    if warnings or ran.err:
        faults += message_faults(warnings, ran)[0]
    text = read_text(os.path.join(folder, f'{name}.lis'))
    summary = json.loads(read_text(os.path.join(folder, f'{name}.json')))
    tables = listing.tables(text)
    faults += whole_faults(folder, name, summary, text)
    faults += label_faults(ran.code == 0, text, summary,
                           read_bytes(os.path.join(folder, f'{name}.h5')))
    for card in cards:
        if card['name'] == 'exit':
            faults += expected('exit_code', code[0], summary['exit_code'])
        else:
            faults += value_faults(card, tables) if card['table'] else summary_faults(card, summary)
    return faults


def unsolved_faults(program, deck, folder):
    """Run a deck that passes the check but cannot be solved: exit code and words, no results"""
    name = os.path.splitext(os.path.basename(deck))[0]
    cards = [SAYS.match(card) for card in read_text(deck).split('\n') if SAYS.match(card)]
    code = int(next(card[2] for card in cards if card[1] == 'exit'))
    checked = program.run('check', deck)
    earlier = EarlierResults(folder, name)
    ran = program.run('run', deck, '-o', folder)
    faults = checked.ended_with(0) + ran.ended_with(code) + earlier.faults()
    for card in cards:
        if card[1] == 'says' and card[2] not in ran.err:
            faults.append(f'expected the words {card[2]!r}, found\n{ran.err}')
    return faults


def tests(program):
    """One test a deck"""

    def test(kind, name, faults):
        path = os.path.join(HERE, kind, name)
        return Test(f'{kind}/{name}', lambda folder: faults(program, path, folder))

    return [test(kind, name, faults)
            for kind, faults in (('good', good_faults), ('unsolved', unsolved_faults))
            for name in sorted(os.listdir(os.path.join(HERE, kind))) if name.endswith('.dat')]
