"""The decks in `bad`: each must fail with the messages that its comment cards expect"""
import json
import os

from messages import expected_messages, layout_faults, message_faults
from support import EarlierResults, HERE, Test, expected, read_bytes, read_text

FOLDER = os.path.join(HERE, 'bad')


def deck_faults(program, deck, folder, wanted, results):
    """Check and run one deck: messages, carets, exit code, and what is left in `results`"""
    name = os.path.splitext(os.path.basename(deck))[0]
    earlier = EarlierResults(os.path.join(results, 'earlier'), name)
    ran = program.run('run', deck, '-o', earlier.folder, folder=folder)
    faults = ran.ended_with(2) + earlier.faults() + expected('standard output', '', ran.out)
    more, found = message_faults(wanted, ran)
    faults += more
    for message in found:
        path = os.path.join(folder, message.file)
        if os.path.isfile(path):
            lines = read_bytes(path).replace(b'\r\n', b'\n').replace(b'\r', b'\n')
            faults += layout_faults(message, lines.removeprefix(b'\xef\xbb\xbf').split(b'\n'))
    checked = program.run('check', deck, folder=folder)
    faults += checked.ended_with(2)
    if checked.err != ran.err:
        faults.append(f'`run` says\n{ran.err}`check` says\n{checked.err}')
    return faults + summary_faults(program, deck, folder, name, os.path.join(results, 'none'))


def summary_faults(program, deck, folder, name, results):
    """Run a deck without earlier results: only a summary that tells the error may be left"""
    os.mkdir(results)
    program.run('run', deck, '-o', results, folder=folder)
    faults = expected('files', [f'{name}.json'], os.listdir(results))
    if not faults:
        summary = json.loads(read_text(os.path.join(results, f'{name}.json')))
        faults += expected('status', 'error', summary['status'])
        faults += expected('exit_code', 2, summary['exit_code'])
    return faults


def tests(program):
    """One test a deck"""

    def test(name):
        wanted = expected_messages(read_text(os.path.join(FOLDER, name)))

        def check(folder):
            if not any(message.kind == 'error' for message in wanted):
                return ['the deck expects no error']
            return deck_faults(program, name, FOLDER, wanted, folder)

        return Test(f'bad/{name}', check)

    return [test(name) for name in sorted(os.listdir(FOLDER)) if name.endswith('.dat')]
