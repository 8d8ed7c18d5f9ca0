"""Decks of one call by several processes: the same results, exit codes and words as one after the other"""
import json
import os
import random
import signal
import subprocess
import time

from support import INPUTS, Test, expected, read_text, write

# What two runs of a deck need not have alike
STAMPS = ('date', 'run', 'file_bytes', 'seconds', 'error_seconds', 'increment_seconds', 'peak_memory_mb')
SHORT = ('first', 'case1', 'chimney')


def decks_in(folder):
    """Decks of a converged job, of two combinations, one with an error, one that is not there"""
    paths = [os.path.join(INPUTS, f'{name}.dat') for name in SHORT]
    return [*paths[:2], write(folder, 'wrong.dat', 'TITLE\nNo end\n'), paths[2], os.path.join(folder, 'absent.dat')]


def summaries(folder):
    """What the summaries in a folder say, without times: their names, keys and values"""
    return {(name, key, repr(value)) for name in os.listdir(folder) if name.endswith('.json')
            for key, value in json.loads(read_text(os.path.join(folder, name))).items() if key not in STAMPS}


def blocks(text):
    """What is said of each deck, without times, in any order"""
    lines = [line for line in text.splitlines() if not line.startswith(('time', 'files'))]
    return sorted(block.strip() for block in '\n'.join(lines).split('deck ')[1:])


def same_results(program, folder):
    """Files, exit codes and words"""
    decks = decks_in(folder)
    alone = program.run('run', *decks, '-o', 'alone', folder=folder)
    faults = alone.ended_with(2)
    for n in ('2', '9'):
        together = program.run('run', '--processes', n, *decks, '-o', f'by{n}', '--threads', '4', folder=folder)
        faults += together.ended_with(2)
        faults += expected('files', sorted(os.listdir(os.path.join(folder, 'alone'))), sorted(os.listdir(os.path.join(folder, f'by{n}'))))
        faults += [f'{name}: {key} is {value} in one of both' for name, key, value in
                   summaries(os.path.join(folder, 'alone')) ^ summaries(os.path.join(folder, f'by{n}'))]
        faults += program.run('compare', 'alone/first.h5', f'by{n}/first.h5', '--relative', '0', folder=folder).ended_with(0)
        faults += expected('what is said of decks', blocks(alone.out), blocks(together.out))
        faults += expected('errors', sorted(alone.err.splitlines()), sorted(together.err.splitlines()))
    return faults


def little_memory(program, folder):
    """Who has too little of the memory that processes share is told that it is a share"""
    ran = program.run('run', '--processes', '2', *decks_in(folder)[:2], '-o', 'out', '--memory', '40', folder=folder)
    return ran.ended_with(6) + expected('words', 2, ran.err.count('the limit is the share of one of 2 processes, '))


def begin_long(program, folder, *options):
    """Two decks that take long and one that does not, by two processes, once both of them are at work; with their numbers"""
    text = read_text(os.path.join(INPUTS, 'monopile.dat')).replace('\n    4   17\n', '\n   48  193\n')
    decks = [write(folder, f'{name}.dat', text) for name in ('long', 'longer')] + [os.path.join(INPUTS, 'first.dat')]
    process = subprocess.Popen([program.path, 'run', *decks, '-o', folder, '--processes', '2', '--quiet', *options],
                               env=program.environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    children, end = [], time.time() + 60
    while len(children) < 2 and time.time() < end:
        children = [int(number) for number in os.listdir('/proc') if number.isdigit() and parent_of(number) == process.pid
                    and os.path.exists(os.path.join(folder, 'long.lock')) and os.path.exists(os.path.join(folder, 'longer.lock'))]
        time.sleep(0.01)
    return decks, process, children


def parent_of(number):
    """Number of the process that started one; 0 if it has ended"""
    try:
        return int(read_text(f'/proc/{number}/stat').rsplit(')', 1)[1].split()[1])
    except OSError:
        return 0


def deck_of(number):
    """Deck of a process"""
    return read_text(f'/proc/{number}/cmdline').rstrip('\0').rsplit('\0', 1)[1]


def one_dies(program, folder):
    """A process that is killed is told of; the others end"""
    decks, process, children = begin_long(program, folder)
    faults = expected('processes', sorted(decks[:2]), sorted(deck_of(child) for child in children))
    os.kill(next(child for child in children if deck_of(child) == decks[0]), signal.SIGKILL)
    _, said = process.communicate(timeout=300)
    faults += expected('exit code', 128 + signal.SIGKILL, process.returncode)
    for words in ('long.dat: its process was ended by signal 9', '1 of 3 decks did not end well: ', f'long.dat ({128 + signal.SIGKILL})'):
        if words not in said:
            faults.append(f'{words!r} is not said: {said}')
    done = sorted(name for name in os.listdir(folder) if name.endswith('.json'))
    return faults + expected('results', ['first.json', 'longer.json'], done)


def told_to_end(program, folder):
    """A signal ends all, and `--resume` goes on"""
    decks, process, children = begin_long(program, folder, '--checkpoint', '0')
    states, end = [os.path.join(folder, f'{name}.state') for name in ('long', 'longer')], time.time() + 60
    while not all(map(os.path.exists, states)) and time.time() < end:
        time.sleep(0.01)
    process.send_signal(signal.SIGTERM)
    _, said = process.communicate(timeout=60)
    faults = expected('exit code', 75, process.returncode)
    faults += expected('processes that are left', [], [child for child in children if os.path.exists(f'/proc/{child}')])
    if '; 1 were not begun' not in said:
        faults.append(f'what was not begun is not told: {said}')
    faults += [f'{path} is gone' for path in states if not os.path.exists(path)]
    faults += expected('locks that are left', [], [name for name in os.listdir(folder) if name.endswith('.lock')])
    again = program.run('run', *decks, '-o', folder, '--processes', '3', '--resume', '--quiet', folder=folder, time_limit=300)
    faults += [f'not gone on from: {path}' for path in states if f'there is no state {path}' in again.err]
    return faults + again.ended_with(0) + expected('results', 3, len([name for name in os.listdir(folder) if name.endswith('.h5')]))


def told_at_random(program, folder):
    """A signal at any moment, also while processes begin, ends the batch: either all is done, or the exit code says that it is not"""
    text, chance, faults, stopped = read_text(os.path.join(INPUTS, 'first.dat')), random.Random(1), [], 0
    decks = [write(folder, f'{k}.dat', text) for k in range(8)]
    for turn in range(16):
        place = os.path.join(folder, str(turn))
        process = subprocess.Popen([program.path, 'run', *decks, '-o', place, '--processes', '3', '--quiet'], env=program.environment,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True)
        time.sleep(chance.uniform(0.02, 0.5))
        signal_sent = chance.choice((signal.SIGTERM, signal.SIGINT, signal.SIGUSR1))
        if turn % 2:
            os.killpg(process.pid, signal_sent)  # as a terminal does
        else:
            process.send_signal(signal_sent)
        _, said = process.communicate(timeout=60)
        done = len([name for name in os.listdir(place) if name.endswith('.h5')]) if os.path.isdir(place) else 0
        before = -process.returncode == signal_sent and done == 0  # it had not yet begun to take note of signals
        if process.returncode != (0 if done == len(decks) else 75) and not before:
            faults.append(f'exit code {process.returncode} after signal {signal_sent} with {done} of {len(decks)} results: {said}')
        stopped += process.returncode == 75
    return faults + ([] if stopped else ['no batch was stopped: the moments are wrong'])


def names(program, folder):
    """Results of a combination that would be those of another deck are refused, whoever reads them"""
    text = read_text(os.path.join(INPUTS, 'chimney.dat'))
    decks = [write(folder, 'tower.dat', text), write(folder, 'tower.2.dat', read_text(os.path.join(INPUTS, 'first.dat')))]
    outcome = program.run('run', *decks, '--processes', '2', '-o', folder, folder=folder)
    faults = outcome.ended_with(2)
    if 'results would be written to files of' not in outcome.err:
        faults.append(f'the clash is not told: {outcome.err}')
    return faults


def tests(program):
    """All of them"""
    return [Test(f'batch: {name}', lambda folder, check=check: check(program, folder)) for name, check in (
        ('same results', same_results), ('a process dies', one_dies), ('told to end', told_to_end),
        ('told to end at any moment', told_at_random), ('names', names),
        ('little memory', little_memory))]
