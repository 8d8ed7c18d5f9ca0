"""Numbers that are rounded otherwise, as on another make of processor, hardly change a state and estimates of errors: every
deck of `inputs`, with the last digits of sines, cosines, tangents, exponentials and logarithms moved by chance"""
import glob
import json
import os
import subprocess

from support import INPUTS, Test, expected, preload, read_text

ROUNDINGS = 2
# Of the largest displacement of an increment, and of estimates, over themselves
STATE, ESTIMATE = 1e-6, 1e-4
# Estimates up to this are of rounding
NOTHING = 1e-9


def found(program, deck, folder, number):
    """What a run found by a rounding, by names; None is the system's own"""
    changed = {} if number is None else {'LD_PRELOAD': preload('other_rounding'), 'SHUFFLE': str(number)}
    output = os.path.join(folder, str(number))
    done = subprocess.run([program.path, 'run', deck, '-o', output, '--quiet'], capture_output=True, text=True, check=False,
                          timeout=500 if program.sanitized else 100, env=dict(program.environment, **changed))
    if done.returncode != 0:
        raise AssertionError(f'exit code {done.returncode}\n{done.stderr}')
    states, estimates, words = {}, {}, {}
    for path in sorted(glob.glob(os.path.join(output, '*.json'))):
        summary, name = json.loads(read_text(path)), os.path.basename(path)
        words[name, 'status'] = summary['status']
        for step in summary.get('increments') or []:
            states[name, step['increment']] = step['largest_displacement']
        for source, share in (summary.get('errors') or {}).items():
            if source in ('discretization', 'harmonics', 'planes', 'sum'):
                estimates.update({(name, source, quantity): value for quantity, value in share.items()})
    return words, states, estimates


def differences(names, one, other, tolerance, least):
    """Faults of numbers that are no longer the same"""
    return [f'{names} {key}: {one[key]} and {other.get(key)}' for key in one if not agree(one[key], other.get(key), tolerance, least)]


def agree(one, other, tolerance, least):
    """Whether two numbers are about the same; what is not known is in both"""
    if one is None or other is None:
        return one is other
    return abs(one - other) <= tolerance*abs(one) + least


def tests(program):
    """One test a deck"""

    def rounded(deck):
        def check(folder):
            faults = []
            words, states, estimates = found(program, deck, folder, None)
            least = NOTHING*max(states.values(), default=0.0)
            for number in range(ROUNDINGS):
                others = found(program, deck, folder, number)
                faults += expected('ends', words, others[0])
                faults += differences('displacement', states, others[1], STATE, least)
                faults += differences('estimate', estimates, others[2], ESTIMATE, NOTHING)
            return faults

        return Test(f'rounding: {os.path.relpath(deck, INPUTS)}', check)

    def other_digits(folder):
        deck = os.path.join(os.path.realpath(INPUTS), 'first.dat')
        return expected('the same digits', False, found(program, deck, folder, None)[1:] == found(program, deck, folder, 0)[1:])

    return [Test('rounding: other digits', other_digits)] + [
        rounded(deck) for deck in sorted(glob.glob(os.path.join(os.path.realpath(INPUTS), '**', '*.dat'), recursive=True))
        if os.sep + 'legacy' + os.sep not in deck]
