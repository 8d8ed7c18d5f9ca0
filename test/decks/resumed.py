"""Runs that are stopped or die, and go on: a signal, a file, kill -9 at chance and at every state that is
written. The results are those of an uninterrupted run, to the last bit, and nothing that was done is lost"""
import hashlib
import os
import random
import re
import signal
import subprocess
import time

import yielding
from commits import Place
from same_bits import digests
from support import INPUTS, Test, expected, input_deck, preload, read_bytes, read_text, write

FACTORS = (0.3, 0.2, 0.2, 0.1, 0.1, 0.1, -0.3, -0.3, -0.4, -0.3, -0.3, -0.4, 0.3, 0.4, 0.5, 0.3, 0.2, 0.1, 0.1, 0.1)
SHORT = (0.5, 0.5, -1.5, 1.0)
CONTROL = 'CONTROL                         ! highest harmonic M\n    4\n'
DETAILS = '{:5d}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n'


def history(factors=FACTORS, method='NEWTON', details=None, lines=''):
    """The peg of first.dat, pushed to and fro"""
    deck = input_deck('first.dat').replace(CONTROL, f'CONTROL\n    2{"":35}{method:>10}\n')
    if details:
        lines += 'LAWDETAILS\n' + DETAILS.format(1, *details)
    lines += 'INCREMENTS\n' + ''.join(f'{factor:10}{"1.0E-7":>10}{400:5d}\n' for factor in factors)
    return deck.replace('\nEND', '\n' + lines + 'END')


JOBS = {
    'history': history(),
    'TRANSFER': history(SHORT, 'TRANSFER').replace('1.0E-7', '1.0E-3'),
    'ANDERSON': history(SHORT, 'ANDERSON'),
    'softening': history(SHORT, details=('RESULTANT', 'BOND', '0.1', '20.0', '', '', '')).replace(
        '       0.0      30.0', '       1.0      30.0'),
    'bonds': history(SHORT, details=('RESULTANT', 'BOND', '', '', '', '', '')).replace('       0.0      30.0',
                                                                                   '       1.0      30.0'),
    'gap': history(SHORT, details=('RESULTANT', '', '', '', '', '1.0E-5', '')),
    'two combinations': history(SHORT, lines='COMBINE\n    1    1       1.0\n    2    1       0.7\n'),
    'yielding': history(SHORT, lines='YIELD\n1, MISES, 2.5\n'),
    'yielding without joints': yielding.pile(2, 0, (1.0, 0.5, 0.5, -2.0)),
    'yielding under given displacements': yielding.steered(yielding.pile(2, 0, (1.0, 8.0, 2.0, -1.0))),
    'rounds': history(SHORT[:3], lines='ERROR\n2.0, DISPL\n'),
}


class Runs:
    """Runs of one deck in a folder"""

    def __init__(self, program, folder, deck, *options):
        self.program = program
        self.folder = folder
        self.deck = write(folder, 'job.dat', deck)
        self.options = options
        self.whole = self.stems('whole')
        ran = self.run('whole')
        if ran.returncode not in (0, 3):
            raise AssertionError(ran.stderr)
        self.whole = self.stems('whole')
        self.code = ran.returncode

    def stems(self, output):
        """Paths of the results without their endings"""
        folder = os.path.join(self.folder, output)
        names = sorted(os.listdir(folder)) if os.path.isdir(folder) else []
        return [os.path.join(folder, name[:-3]) for name in names if name.endswith('.h5')]

    def words(self, output, *options):
        """Command line of a run that keeps every step"""
        return [self.program.path, 'run', self.deck, '-o', os.path.join(self.folder, output), '--quiet',
                '--checkpoint', '0', *self.options, *options]

    def start(self, output, *options, **environment):
        """Begin a run that keeps every step"""
        # tests that are run in the background ignore SIGINT, those by nohup SIGHUP, and hand that on
        def heed():
            for number in (signal.SIGINT, signal.SIGHUP):
                signal.signal(number, signal.SIG_DFL)
        return subprocess.Popen(self.words(output, *options), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                preexec_fn=heed,
                                text=True, env=dict(self.program.environment, OMP_NUM_THREADS='1', **environment))

    def run(self, output, *options, **environment):
        """Run to its end"""
        process = self.start(output, *options, **environment)
        out, err = process.communicate(timeout=120)
        return subprocess.CompletedProcess(process.args, process.returncode, out, err)

    def interrupted(self, output, seconds, number, *options):
        """Run, with a signal after some time"""
        process = self.start(output, *options)
        time.sleep(seconds)
        process.send_signal(number)
        out, err = process.communicate(timeout=120)
        return subprocess.CompletedProcess(process.args, process.returncode, out, err)

    def same(self, output):
        """Faults, unless the results are those of the run that was not interrupted, and nothing else is there"""
        stems = self.stems(output)
        faults = expected('results', [os.path.basename(stem) for stem in self.whole],
                          [os.path.basename(stem) for stem in stems])
        if faults:
            return faults
        for whole, stem in zip(self.whole, stems):
            texts = digests([whole, stem])
            if texts[0] != texts[1]:
                faults.append(f'{stem}: others than without interruption')
        return faults + expected('files', sorted(os.listdir(os.path.join(self.folder, 'whole'))),
                                 sorted(os.listdir(os.path.join(self.folder, output))))

    def state(self, output):
        """How far a state is, in words; empty if there is none"""
        try:
            content = read_bytes(os.path.join(self.folder, output, 'job.state'))
        except FileNotFoundError:  # a run that came to its end takes it away
            return ''
        return re.search(rb'\nplace (.*)\n', content).group(1).decode()


def increments_of(place):
    """Increments that are done at a place"""
    found = re.match(r'(a part of )?increment (\d+) of', place)
    return 0 if not found else int(found.group(2)) - bool(found.group(1))


def killed(program, folder, kills):
    """kill -9 at random moments: the next run goes on from where it was, and the end is the same"""
    runs = Runs(program, folder, JOBS['history'])
    begun = time.monotonic()
    runs.run('timed')
    length = time.monotonic() - begun
    chance = random.Random(1)
    faults, done, going_on = [], 0, 0
    while done < kills or (3*going_on < done and done < 10*kills):
        output, far = f'killed{done}', 0
        for _ in range(4):  # the last one may come to its end
            process, begun = runs.start(output, '--resume'), time.monotonic()
            try:
                process.wait(chance.uniform(0.1, 1.0)*length)
                ended = time.monotonic() - begun
            except subprocess.TimeoutExpired:
                ended = 0
            seen = increments_of(runs.state(output))  # reported before the end
            process.kill()
            err = process.communicate()[1]
            found = re.search(r'goes on from \S+, (.*) of \d+-', err)
            if found:
                going_on += 1
                if increments_of(found.group(1)) < far:
                    faults.append(f'went on from increment {found.group(1)}, {far} were done')
            if process.returncode == 0:
                if ended and not found:  # a whole run: the machine was busier before
                    length = min(length, ended)
                break
            done += 1
            far = increments_of(runs.state(output))
            if far < seen and not runs.stems(output):  # with results in place there is nothing to keep any more
                faults.append(f'{seen} increments were kept, {far} after the end')
            if far == 0 and not runs.stems(output):  # the machine is busier now
                length *= 1.1
        ran = runs.run(output, '--resume')
        faults += expected('exit code', runs.code, ran.returncode) + runs.same(output)
        if faults:
            return faults + [ran.stderr]
    return faults if 3*going_on >= done else [f'{going_on} of {done} killed runs were gone on with']


def every_state(program, folder, deck, step):
    """A run dies where it writes or removes the n-th name, for every n or some: the next goes on"""
    runs = Runs(program, folder, deck)
    library = preload('failing_names')
    faults, places = [], set()
    n = 3
    while True:
        output = f'n{n}'
        ran = runs.run(output, LD_PRELOAD=library, NAMES_KILL=str(n), NAMES_IN=folder)
        if ran.returncode != -9:
            break
        places.add(runs.state(output))
        ran = runs.run(output, '--resume')
        found = expected('exit code', runs.code, ran.returncode) + runs.same(output)
        faults += [f'killed at {n}: {fault}\n{ran.stderr}' for fault in found]
        n += step
    return faults if len(places) > 2 else [f'killed at {places} only']


def signals(program, folder):
    """Signals of schedulers, of a terminal, of a limit of processor time: exit code 75, one line that says how to go on, earlier results stay"""
    runs = Runs(program, folder, JOBS['history'])
    faults = []
    for number in (signal.SIGTERM, signal.SIGUSR1, signal.SIGINT, signal.SIGUSR2, signal.SIGHUP, signal.SIGXCPU):
        output = number.name
        runs.run(output)
        earlier = {name: read_bytes(os.path.join(folder, output, name)) for name in os.listdir(os.path.join(folder, output))}
        process = runs.start(output)
        wait_for(lambda output=output: increments_of(runs.state(output)) > 2)
        process.send_signal(number)
        err = process.communicate(timeout=60)[1]
        found = expected('exit code', 75, process.returncode)
        place = runs.state(output)
        line = f'axijoint: {runs.deck}: stopped by {number.name} after {place}; --resume goes on from ' \
            f'{folder}/{output}/job.state\n'
        found += expected('message', line, err)
        for name, content in earlier.items():
            if read_bytes(os.path.join(folder, output, name)) != content:
                found.append(f'{name} was changed')
        found += expected('files', sorted([*earlier, 'job.state']), sorted(os.listdir(os.path.join(folder, output))))
        ran = runs.run(output, '--resume')
        found += expected('exit code', 0, ran.returncode) + runs.same(output)
        if f'goes on from {folder}/{output}/job.state, {place} of' not in ran.stderr:
            found.append(ran.stderr)
        faults += [f'{number.name}: {fault}' for fault in found]
    return faults


def wait_for(condition):
    """Wait until something is so, a minute at most"""
    end = time.monotonic() + 60
    while not condition():
        if time.monotonic() > end:
            raise AssertionError('nothing happened for a minute')
        time.sleep(0.002)


def interrupted_twice(program, folder):
    """A second SIGINT ends the run at once; one that the process was told to ignore is ignored; the next run
    takes over the lock of the dead"""
    runs = Runs(program, folder, JOBS['history'])
    process = runs.start('twice')
    wait_for(lambda: increments_of(runs.state('twice')) > 1)
    process.send_signal(signal.SIGSTOP)  # so that the first is not heeded before the second
    process.send_signal(signal.SIGINT)
    process.send_signal(signal.SIGCONT)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    faults = [] if process.returncode in (-signal.SIGINT, 75) else [f'exit code {process.returncode}']
    ran = runs.run('twice', '--resume')
    faults += expected('exit code', 0, ran.returncode) + runs.same('twice')
    ignoring = subprocess.Popen(['sh', '-c', 'trap "" INT; exec "$@"', 'sh', *runs.words('none')],
                                stderr=subprocess.DEVNULL, env=program.environment)
    wait_for(lambda: increments_of(runs.state('none')) > 1)
    ignoring.send_signal(signal.SIGINT)
    return faults + expected('exit code of one that ignores it', 0, ignoring.wait(60)) + runs.same('none')


def while_reading(program, folder):
    """SIGTERM while the deck comes from the standard input: exit code 75, and nothing is left"""
    with subprocess.Popen([program.path, 'run', '-', '-o', 'out'], cwd=folder, stdin=subprocess.PIPE,
                          stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                          env=dict(program.environment, OMP_WAIT_POLICY='PASSIVE')) as process:
        process.stdin.write('TITLE\n')
        process.stdin.flush()
        time.sleep(1.0)
        process.send_signal(signal.SIGTERM)
        time.sleep(0.1)
        _, err = process.communicate(input_deck('first.dat').split('\n', 1)[1], timeout=60)
    return expected('exit code', 75, process.returncode) + expected('files', [], os.listdir(folder)) + expected(
        'message', 'axijoint: stdin: stopped by SIGTERM before anything was kept\n', err)


def stop_file(program, folder):
    """A file NAME.STOP ends the run, and is gone then; one from before the run is removed and told"""
    runs = Runs(program, folder, JOBS['history'])
    os.mkdir(os.path.join(folder, 'out'))
    write(folder, 'out/job.STOP', '')
    process = runs.start('out', '--threads', '1')
    wait_for(lambda: increments_of(runs.state('out')) > 1)
    process.send_signal(signal.SIGSTOP)
    write(folder, 'out/job.STOP', '')
    time.sleep(1.1)  # it is looked for once a second
    process.send_signal(signal.SIGCONT)
    err = process.communicate(timeout=60)[1]
    faults = expected('exit code', 75, process.returncode) + expected(
        'files', ['job.state'], sorted(os.listdir(os.path.join(folder, 'out'))))
    for words in ('stopped by a STOP file after increment', 'a STOP file from before this run was removed'):
        if words not in err:
            faults.append(f'expected {words!r}, found {err}')
    ran = runs.run('out', '--resume')
    return faults + expected('exit code', 0, ran.returncode) + runs.same('out')


def stopped(program, folder, deck=JOBS['history']):
    """A run that was stopped somewhere, and the path of its state"""
    runs = Runs(program, folder, deck)
    process = runs.start('out')
    wait_for(lambda: increments_of(runs.state('out')) > 2)
    process.terminate()
    process.communicate(timeout=60)
    return runs, os.path.join(folder, 'out', 'job.state')


def signed(content):
    """A state whose hash is right whatever was changed"""
    return content[:-65] + hashlib.sha256(content[:-65]).hexdigest().encode() + b'\n'


def refused(program, folder):
    """States that are damaged, cut, of another deck, solver, version: exit code 8, and they stay as they are"""
    runs, path = stopped(program, folder)
    state = read_bytes(path)
    deck = read_text(runs.deck)
    chance = random.Random(3)
    spots = [0, 20, len(state) - 1, *(chance.randrange(len(state)) for _ in range(20))]
    cases = [(f'byte {spot}', state[:spot] + bytes([state[spot] ^ 1]) + state[spot + 1:], deck, (), 'state')
             for spot in spots]
    cases += [(f'cut at {length}', state[:length], deck, (), 'state')
              for length in (0, 1, 64, 100, len(state) - 1)]
    version = re.search(rb'\nprogram axijoint (.*)\n', state).group(1)
    cases += [
        ('another deck', state, deck.replace('0.4', '0.5', 1), (), 'is of another deck: the cards'),
        ('a comment more', state, '! new\n' + deck, (), 'is of another deck'),
        ('another solver', state, deck, ('--solver', 'band'), 'with the solver of the deck, not BAND'),
        ('another version', signed(state.replace(b'axijoint ' + version, b'axijoint 0.0.1', 1)), deck, (),
         'is of axijoint 0.0.1, and this is axijoint'),
        ('another format', signed(b'axijoint state 9' + state[16:]), deck, (), 'of another version of axijoint'),
        ('other bytes', signed(state[:-200] + state[-65:]), deck, (), 'is of another'),
    ]
    faults = []
    for what, content, text, options, words in cases:
        write(folder, 'out/job.state', content)
        write(folder, 'job.dat', text)
        ran = runs.run('out', '--resume', *options)
        found = expected('exit code', 8, ran.returncode)
        if words not in ran.stderr or 'mend: run without --resume' not in ran.stderr:
            found.append(f'expected {words!r}, found {ran.stderr}')
        if read_bytes(path) != content or os.listdir(os.path.join(folder, 'out')) != ['job.state']:
            found.append('the state did not stay alone')
        faults += [f'{what}: {fault}' for fault in found]
    return faults


def forgotten(program, folder):
    """A run without --resume that finds a state puts it aside and says so; when it is done both are gone. A run
    with --resume that finds none begins anew and says so"""
    runs, path = stopped(program, folder)
    place, state = runs.state('out'), read_bytes(path)
    process = runs.start('out')
    wait_for(lambda: os.path.exists(path) and os.path.exists(path + '.old'))
    process.terminate()
    err = process.communicate(timeout=60)[1]
    faults = expected('the earlier state', state, read_bytes(path + '.old'))
    if f'left its state ({place}, 20' not in err or f'now {path}.old; --resume would have gone on' not in err:
        faults.append(err)
    os.replace(path + '.old', path)  # as the message suggests
    ran = runs.run('out', '--resume')
    faults += expected('exit code', 0, ran.returncode) + runs.same('out')
    write(folder, 'anew/job.state', state)
    write(folder, 'anew/job.state.old', state)
    ran = runs.run('anew')
    faults += expected('exit code', 0, ran.returncode) + runs.same('anew')
    faults += expected('the one before that', True, 'of a run before that, is gone' in ran.stderr)
    ran = runs.run('none', '--resume')
    if f'there is no state {folder}/none/job.state to go on from: the run begins anew' not in ran.stderr:
        faults.append(ran.stderr)
    return faults + expected('exit code', 0, ran.returncode) + runs.same('none')


def foreign(program, folder):
    """A file of somebody else with the name of a state is neither renamed, nor replaced, nor removed"""
    runs, path = stopped(program, folder)
    state, text = read_bytes(path), b'states of the soil\n'
    faults = []
    for name, others, options, code, words in (
            ('job.state', {}, (), 5, 'job.state is no state of axijoint'),
            ('job.state', {}, ('--resume',), 8, 'move that file away first'),
            ('job.state.old', {}, (), 0, 'job.state.old is no state of axijoint, and is left as it is'),
            ('job.state.old', {'job.state': state}, (), 5, 'job.state.old is no state of axijoint, and the state'),
            ('job.state.old', {'job.state': state}, ('--resume',), 0, 'goes on from')):
        output = f'other{len(os.listdir(folder))}'
        for file, content in {name: text, **others}.items():
            write(folder, f'{output}/{file}', content)
        ran = runs.run(output, *options)
        found = expected('exit code', code, ran.returncode) + ([] if words in ran.stderr else [ran.stderr])
        left = {name: text, **(others if code else {})}
        for file, content in left.items():
            kept = os.path.join(folder, output, file)
            if not os.path.isfile(kept) or read_bytes(kept) != content:
                found.append(f'{file} was changed')
        faults += [f'{name} {options}: {fault}' for fault in found]
    os.makedirs(os.path.join(folder, 'folder', 'job.state'))
    ran = runs.run('folder')
    return faults + expected('exit code', 5, ran.returncode) + expected(
        'files', True, os.path.isdir(os.path.join(folder, 'folder', 'job.state')))


def stop_folder(program, folder):
    """A folder that is named like a STOP file cannot be removed: the run says so and does not begin"""
    runs = Runs(program, folder, JOBS['history'])
    os.makedirs(os.path.join(folder, 'out', 'job.STOP'))
    ran = runs.run('out')
    faults = expected('exit code', 5, ran.returncode)
    if 'job.STOP would end the run at once, and cannot be removed: ' not in ran.stderr or 'was removed' in ran.stderr:
        faults.append(ran.stderr)
    os.rmdir(os.path.join(folder, 'out', 'job.STOP'))
    return faults + expected('exit code', 0, runs.run('out').returncode)


def written_already(program, folder):
    """Of two combinations the first is not solved again, unless its results are not there as they were"""
    runs = Runs(program, folder, JOBS['two combinations'])
    faults = []
    for change, words in ((False, 'the results of combination 1 are written already'), (True, '')):
        output = f'out{change}'
        process = runs.start(output)
        wait_for(lambda output=output: 'combination 2' in runs.state(output))
        process.terminate()
        process.communicate(timeout=60)
        first = os.path.join(folder, output, 'job.1.json')
        if change:
            write(folder, f'{output}/job.1.json', '{}')
        before = os.stat(first).st_ino
        ran = runs.run(output, '--resume')
        faults += expected('exit code', 0, ran.returncode) + runs.same(output)
        faults += expected('written again', change, os.stat(first).st_ino != before)
        if words not in ran.stderr or bool(words) != ('already' in ran.stderr):
            faults.append(ran.stderr)
    return faults


def done_already(program, folder):
    """Decks whose results are there are not solved again by --resume: not if the deck, the solver or the files are others, and not
    where a later run left a state. Decks that did not end well are named at the end"""
    decks = [write(folder, name, input_deck('first.dat')) for name in ('a.dat', 'b.dat')]
    two = write(folder, 'two.dat', JOBS['two combinations'])
    broken = write(folder, 'broken.dat', input_deck('first.dat').replace('LAWS', 'FLAWS', 1))

    def run(*words):
        ran = program.run('run', *words, '-o', folder, '--resume', folder=folder)
        return ran.code, ran.out.count('status '), ran.err.count('results are there already'), ran.err

    code, solved, left, _ = run(decks[0], two)
    faults = expected('first start: code, solved, left', (0, 3, 0), (code, solved, left))
    code, solved, left, _ = run(decks[0], two, decks[1])
    faults += expected('second start', (0, 1, 2), (code, solved, left))
    code, solved, left, err = run(decks[0], broken, two, decks[1])
    faults += expected('with a broken deck', (2, 0, 3), (code, solved, left))
    faults += expected('last line', True, '1 of 4 decks did not end well: ' in err and err.rstrip().endswith('broken.dat (2)'))
    os.unlink(os.path.join(folder, 'two.2.lis'))
    faults += expected('a listing is gone', (0, 2, 1), run(decks[0], two)[:3])
    write(folder, 'a.h5', '')
    faults += expected('arrays are cut off', (0, 1, 1), run(*decks)[:3])
    write(folder, 'b.lis', read_text(os.path.join(folder, 'b.lis'))[:-40])
    faults += expected('a listing is cut off', (0, 1, 1), run(*decks)[:3])
    faults += expected('no estimates', (0, 1, 0), run(decks[0], '--no-estimates')[:3])
    faults += expected('estimates after all', (0, 1, 0), run(decks[0])[:3])
    faults += expected('another solver', (0, 1, 0), run(decks[0], '--solver', 'band')[:3])
    faults += expected('the deck\'s solver again', (0, 1, 0), run(decks[0])[:3])
    faults += expected('a file more', (0, 1, 0), run(decks[0], '--vtk')[:3])
    write(folder, 'a.dat', input_deck('first.dat').replace('0.4', '0.3'))
    faults += expected('deck changed', (0, 1, 1), run(*decks)[:3])
    faults += expected('files of another deck', (0, 1, 0), run(decks[0], '--vtk')[:3])
    write(folder, 'two.json', '{\n  "program": "axijoint",\n  "status": "error",\n}\n')
    faults += expected('two again', (0, 0, 1), run(two)[:3])
    faults += expected('summary of an error', False, os.path.exists(os.path.join(folder, 'two.json')))
    turned = write(folder, 'slides.dat', input_deck('first.dat').replace('   LATERAL       0.4', '     AXIAL     100.0'))
    faults += expected('a mechanism', (4, 1, 0), run(turned)[:3])
    code, solved, left, err = run(turned)
    faults += expected('a mechanism again', (4, 0, 1), (code, solved, left)) + expected('its code', True, 'with exit code 4' in err)
    little = write(folder, 'little.dat', input_deck('first.dat').replace('\nEND', '\nERROR\n0.3\nEND'))
    faults += expected('too little memory', (0, 1, 0), run(little, '--memory', '56')[:3])
    return faults + expected('more memory', (0, 1, 0), run(little)[:3])


def disk_full(program, folder):
    """A state that cannot be written does not end the run, which says so once"""
    place = Place(program, folder, 1, False)
    place.deck = write(folder, 'job.dat', JOBS['gap'])
    place.run('--checkpoint', '0')
    earlier = place.contents()
    faults = []
    for n in (2, 3, 4):  # the lock is the first name
        ran = place.run('--checkpoint', '0', NAMES_FAIL=str(n))
        faults += expected('exit code', 0, ran.returncode) + expected(
            'files', sorted(earlier), sorted(place.contents()))
        state = os.path.join(place.results, 'job.state')
        if ran.stderr.count('warning') != 1 or f'axijoint: warning: the state {state} cannot be written: ' not in ran.stderr:
            faults.append(f'the state was not written, and it says: {ran.stderr}')
        faults += expected('whether anything was kept', n > 2, 'goes on from what was kept before' in ran.stderr)
    return faults


def option_faults(program, folder):
    """Values of --checkpoint that are none"""
    faults = []
    for value in ('x', '-1', '', '1e'):
        ran = program.run('run', os.path.join(INPUTS, 'first.dat'), '--checkpoint', value, folder=folder)
        faults += ran.ended_with(2)
        if f"option --checkpoint: found '{value}', allowed is a number of minutes from 0" not in ran.err:
            faults.append(ran.err)
    return faults


def signal_in_metis(program, folder):
    """SIGTERM while METIS orders the nodes, which takes it for an error of its own: a wish like any other"""
    runs = Runs(program, folder, history(SHORT))
    ran = runs.run('cut', LD_PRELOAD=preload('signal_in_metis'))
    faults = expected('exit code', 75, ran.returncode) + ([] if 'stopped by SIGTERM' in ran.stderr else [ran.stderr])
    runs.run('cut', '--resume')
    return faults + runs.same('cut')


def tests(program):
    """One test a way to be stopped"""
    functions = {'signals': signals, 'interrupted twice': interrupted_twice, 'while reading': while_reading,
                 'STOP file': stop_file, 'states that are refused': refused, 'states that are forgotten': forgotten,
                 'states of others': foreign, 'STOP folder': stop_folder,
                 'written already': written_already, 'done already': done_already, 'states that cannot be written': disk_full, 'while METIS works': signal_in_metis,
                 '--checkpoint': option_faults}
    found = [Test(f'resumed: {what}', lambda folder, check=check: check(program, folder))
             for what, check in functions.items()]
    for what, deck in JOBS.items():
        step = 11 if what == 'history' else 5
        found.append(Test(f'resumed: {what}', lambda folder, deck=deck, step=step: every_state(
            program, folder, deck, step)))
        found.append(Test(f'resumed: {what}, at every name', lambda folder, deck=deck: every_state(
            program, folder, deck, 1), long=True))
    return found + [Test('resumed: killed', lambda folder: killed(program, folder, 12)),
                    Test('resumed: killed 500 times', lambda folder: killed(program, folder, 500), long=True)]
