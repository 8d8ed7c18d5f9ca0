"""Calls of the system that fail, one after the other, in small runs of every command

Whatever fails - memory, a mapping, open, write, a write of half the bytes, fsync, close, rename, unlink, once or from then
on - the run ends with an exit code of the table and one message, or does its work all the same. The results in place are those
of one run, earlier or new, and what is left besides is gone after the next run. `scripts/preload/failing_calls.c` is loaded before other libraries and
makes the calls fail. As deck tests some of all calls fail, by `scripts/faults` all of them:

Usage: scripts/faults [--all | --sample N] [JOB...]
       scripts/faults --space STEPS [COMMAND...]
"""
import errno
import os
import random
import re
import resource
import subprocess
import sys
import tempfile
import time

from commits import small
from same_bits import digests
from support import CRASH, Program, Test, input_deck, preload, read_bytes, read_text, write

ERRORS = {'memory': (errno.ENOMEM,), 'map': (errno.ENOMEM,), 'open': (errno.EMFILE, errno.EACCES),
          'write': (errno.ENOSPC, errno.EIO), 'short': (0,), 'sync': (errno.EIO,), 'close': (errno.EIO,),
          'rename': (errno.EIO, errno.ENOSPC), 'unlink': (errno.EACCES,)}
# 2: a deck, table or file to compare that cannot be opened. A short write is no fault: the rest is written.
CODES = {'memory': (6,), 'map': (6,), 'open': (2, 5, 7, 8), 'short': ()}
RAW = re.compile(CRASH.pattern + r'|HDF5-DIAG|rror allocating|llocation would|libgomp|OpenBLAS|MPI_|\*\*\*|Operating system')
HANGS = 30
# Requests for memory that fail in one run of a sweep
PIECE = 5000
HISTORY = 'INCREMENTS\n' + ''.join(f'{factor:10}{"1.0E-7":>10}{400:5d}\n' for factor in (0.5, 0.5, -0.5)) + 'END\n'
# Jobs of the deck tests
SAMPLED = ('check', 'run ring', 'run two', 'run vtk', 'run history', 'resume', 'study', 'compare')
STUDY = 'LAWS 1 PHI\n20\n35\n'


class Job:
    """A command, the decks that it takes, and the results it writes"""

    def __init__(self, words, deck='', stems=(), extra=None, first=(), dies=0):
        self.words = words
        self.deck = deck
        self.stems = stems
        self.extra = extra or {}
        self.first = first  # what is run before
        self.dies = dies  # the name that a run before writes when it is killed, so that a state is left


def jobs():
    """The runs in which calls fail"""
    peg = input_deck('first.dat')
    history = peg.replace('\nEND\n', '\n' + HISTORY)
    return {
        'help': Job(['help', 'card']),
        'check': Job(['check', 'job.dat'], peg),
        'run ring': Job(['run', 'job.dat', '-o', '.'], small(1), ('job',)),
        'run peg': Job(['run', 'job.dat', '-o', '.'], peg, ('job',)),
        'run band': Job(['run', 'job.dat', '-o', '.', '--solver', 'BAND'], small(1), ('job',)),
        'run two': Job(['run', 'job.dat', '-o', '.'], small(2), ('job.1', 'job.2')),
        'run mesh': Job(['run', 'peg.dat', '-o', '.'], '', ('peg',), {
            'peg.dat': input_deck('peg.dat'), 'peg.msh': input_deck('peg.msh')}),
        'run vtk': Job(['run', 'job.dat', '-o', '.', '--vtk'], small(1), ('job',)),
        'run history': Job(['run', 'job.dat', '-o', '.', '--checkpoint', '0'], history, ('job',)),
        'resume': Job(['run', 'job.dat', '-o', '.', '--checkpoint', '0', '--resume'], history, ('job',), dies=12),
        'study': Job(['study', 'table.csv', 'job.dat', '-o', '.'], peg, ('table.study',), {'table.csv': STUDY}),
        'compare': Job(['compare', 'job.h5', 'job.lis'], small(1), first=['run', 'job.dat', '-o', '.']),
    }


class Place:
    """A folder with earlier results, in which calls fail"""

    def __init__(self, program, folder, job):
        self.program, self.job = program, job
        self.library = preload('failing_calls')
        self.count = os.path.join(folder, 'count')
        self.folder = os.path.join(folder, 'job')
        os.mkdir(self.folder)
        if job.deck:
            write(self.folder, 'job.dat', job.deck)
        for name, text in job.extra.items():
            write(self.folder, name, text)
        if job.first:
            self.run(words=job.first)
        self.code = self.run().returncode
        self.earlier = {**self.contents(), **self.state()}
        self.stems = [os.path.join(self.folder, stem) for stem in job.stems]
        self.hashes = digests(self.stems) if job.stems and job.words[0] == 'run' else []

    def state(self):
        """The state that a run leaves which dies when it writes its n-th name"""
        if not self.job.dies:
            return {}
        environment = dict(self.program.environment, LD_PRELOAD=preload('failing_names'), NAMES_IN='./',
                           NAMES_KILL=str(self.job.dies))
        words = [word for word in self.job.words if word != '--resume']
        subprocess.run([self.program.path, *words], cwd=self.folder, env=environment, capture_output=True, check=False)
        state = {'job.state': self.contents()['job.state']}
        self.run()
        return state

    def run(self, words=None, **settings):
        """Run the job, with a fault or without"""
        environment = dict(self.program.environment, OMP_NUM_THREADS='1', HDF5_USE_FILE_LOCKING='FALSE')
        if settings:
            environment.update(LD_PRELOAD=self.library, FAULT_IN=self.folder, FAULT_COUNT=self.count,
                               **{f'FAULT{name}': str(value) for name, value in settings.items()})
        return subprocess.run([self.program.path, *(words or self.job.words)], cwd=self.folder, env=environment,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, errors='replace', check=False,
                              timeout=20*HANGS if '_SWEEP' in settings else HANGS)

    def contents(self):
        """What is in the folder"""
        return {name: read_bytes(os.path.join(self.folder, name)) for name in sorted(os.listdir(self.folder))}

    def put_back(self):
        """The earlier results alone"""
        for name in os.listdir(self.folder):
            os.remove(os.path.join(self.folder, name))
        for name, content in self.earlier.items():
            write(self.folder, name, content)

    def calls(self, kind):
        """How many calls of a kind there are"""
        if os.path.exists(self.count):
            os.remove(self.count)
        self.put_back()
        self.run(**{'': kind})
        return int(re.search(r'calls (\d+)', read_text(self.count)).group(1))

    def faults_of(self, kind, number, on, cause):
        """What is not in order when a call fails, and maybe all that follow"""
        self.put_back()
        try:
            ran = self.run(**{'': kind, '_AT': number, '_ON': on, '_ERRNO': cause})
        except subprocess.TimeoutExpired:
            return ['hangs']
        faults = [] if ran.returncode == self.code else self.judged(ran, CODES.get(kind, (5,)))
        if RAW.search(ran.stdout + ran.stderr) or ran.returncode < 0:
            faults.append('words of the run-time library: ' + ran.stderr)
        if ran.returncode == self.code and self.hashes and digests(self.stems) != self.hashes:
            faults.append('exit code 0 and other results')
        return faults + self.left()

    def judged(self, ran, codes):
        """Faults in exit code and message of a run that failed"""
        faults = [] if ran.returncode in codes else [f'exit code {ran.returncode}: {ran.stderr}']
        if ran.stderr.count('mend: ') != 1 and not (ran.returncode == 2 and ran.stderr.count(' error: ') == 1):
            faults.append(f'not one message: {ran.stderr!r}')
        return faults

    def left(self):
        """Faults in the files: partial ones, of several runs, or such that the next run leaves"""
        if not self.job.stems:
            return []
        self.run(words=[*self.job.words, '--memory', '1'])
        faults = [f'left: {name}' for name in sorted(set(os.listdir(self.folder)) - set(self.earlier))
                  if not (name.endswith(('.state', '.state.old')) or '.rows' in name or name == 'job.json')]  # of an error
        for stem in self.job.stems:
            kept = [name for name in self.earlier if name.startswith(stem + '.')
                    and name.endswith(('.h5', '.lis', '.json', '.vtkhdf', '.study.csv'))]
            now = self.contents()
            same = [name for name in kept if now.get(name) == self.earlier[name]]
            missing = [name for name in kept if name not in now]
            faults += [f'lost: {name}' for name in missing]
            if same and len(same) < len(kept) and self.job.words[0] == 'run':
                faults.append(f'of the earlier run are {same}, of another the rest of {kept}')
        return faults


def sweep(place, first=1, last=10**9, step=1, on=0):
    """Requests for memory that fail, all in one run: those tried, and what was not in order. Where the run does its
    work in another way that is looked at again, in a run of its own"""
    if os.path.exists(place.count):
        os.remove(place.count)
    place.put_back()
    place.run(**{'': 'memory', '_SWEEP': f'{first}:{last}:{step}', '_ERRNO': errno.ENOMEM, '_ON': on})
    lines = read_text(place.count).splitlines()
    found = re.search(r'tried (\d+), not in order (\d+)', lines[-1])
    if not found:
        return 0, ['the run itself did not end\n' + '\n'.join(lines[-5:])]
    faults = []
    for line in lines[:-1]:
        went_on = re.match(rf'call (\d+): exit code {place.code}, 0 files left', line)
        if not went_on:
            faults.append(line)
        elif on == 0:
            faults += [f'call {went_on.group(1)}: {fault}'
                       for fault in place.faults_of('memory', int(went_on.group(1)), 0, errno.ENOMEM)]
    return int(found.group(1)), faults


def sample(program, folder, name, chance):
    """A call of each kind fails in a job, by chance"""
    place = Place(program, folder, jobs()[name])
    faults = []
    for kind, causes in ERRORS.items():
        n = place.calls(kind)
        if n > 0:
            number, on = chance.randint(1, n), chance.randint(0, 1)
            faults += [f'{kind} {number} of {n}{" and on" if on else ""}: {fault}'
                       for fault in place.faults_of(kind, number, on, chance.choice(causes))]
    return faults


def whole(program, name, every):
    """All calls fail in a job, one after the other; prints a row for each kind of call"""
    bad = 0
    with tempfile.TemporaryDirectory(prefix='axijoint-faults-') as folder:
        place = Place(program, folder, jobs()[name])
        for kind, causes in ERRORS.items():
            for on in (0, 1):
                start = time.time()
                n = place.calls(kind)
                if kind == 'memory':
                    tried, faults = 0, []
                    for first in range(1, n + 1, PIECE*every):  # each in a time that a hang would stand out from
                        more = sweep(place, first, first + PIECE*every - 1, every, on)
                        tried, faults = tried + more[0], faults + more[1]
                else:
                    tried = 0
                    faults = []
                    for number in range(1, n + 1, every):
                        for cause in causes:
                            tried += 1
                            faults += [f'{number} of {n}, errno {cause}: {fault}'
                                       for fault in place.faults_of(kind, number, on, cause)]
                print(f'{name:12} {kind:7} {"from there on" if on else "once":13} {n:8} calls {tried:8} tried '
                      f'{len(faults):5} not in order {time.time() - start:7.0f} s', flush=True)
                print('\n'.join('   ' + fault for fault in faults[:12]), end='\n' if faults else '', flush=True)
                bad += len(faults)
    return bad


BLOCK = ('TITLE\nA block of 999 by 999\nCONTROL\n0\nMATERIALS\n1, 1E4, 0.2\nBLOCKS\n1, 1, 4, 999, 999\n1, 0, 2, 1\nFACES\n1, 1, 1, 0, 2, 0\n'
         '2, 1, 1, 1, 2, 1\nFIXEDFACES\n1, 111\nTRACTIONS\n2, 0, 0, 1\nEND\n')
# Least and largest address space of the sweep [MiB]; what a command is given to end [s]
LEAST_SPACE, MOST_SPACE, SPACE_TIME = 60, {'check': 1500, 'run': 16000}, 1200


def spaces(program, command, steps):
    """A large block under limits of the address space, from too little for the libraries to enough; prints a row for each"""
    bad = 0
    ratio = (MOST_SPACE[command]/LEAST_SPACE)**(1/(steps - 1))
    for step in range(steps):
        space = round(LEAST_SPACE*ratio**step)
        with tempfile.TemporaryDirectory(prefix='axijoint-faults-') as folder:
            deck = write(folder, 'block.dat', BLOCK)
            start = time.time()
            words = [command, deck] + (['-o', folder] if command == 'run' else [])
            try:
                ran = program.run(*words, folder=folder, time_limit=SPACE_TIME, limits=[(resource.RLIMIT_AS, space*2**20)])
                # 127: the system's loader finds no room for the libraries
                faults = [] if ran.code in (0, 6) or ran.code == 127 and 'shared librar' in ran.err else [f'exit code {ran.code}']
                faults += ['words of the run-time library'] if RAW.search(ran.out + ran.err) or ran.code < 0 else []
                if ran.code == 6 and ran.err.count('mend: ') != 1:
                    faults.append('not one message')
                if ran.code != 0:
                    faults += [f'left {name}' for name in os.listdir(folder) if name not in ('block.dat', 'block.json')]
                words = f'exit {ran.code:3}  {ran.err.strip()[:110]}'
            except subprocess.TimeoutExpired:
                faults, words = ['hangs'], ''
        bad += len(faults)
        print(f'{command:6} {space:6} MiB {time.time() - start:6.0f} s  {words}' + ''.join('\n   ' + fault for fault in faults), flush=True)
        if not faults and ran.code == 0:
            break  # enough
    return bad


def tests(program):
    """Samples of a few jobs"""
    chance = random.Random(18)
    return [Test(f'faults: {name}', lambda folder, name=name, seed=chance.random(): sample(
        program, folder, name, random.Random(seed))) for name in SAMPLED]


def main(arguments):
    """The whole of them"""
    every = 97
    if '--all' in arguments:
        arguments.remove('--all')
        every = 1
    if '--sample' in arguments:
        at = arguments.index('--sample')
        every = int(arguments[at + 1])
        del arguments[at:at + 2]
    program = Program(arguments[0])
    if '--space' in arguments:
        at = arguments.index('--space')
        steps = int(arguments[at + 1])
        del arguments[at:at + 2]
        bad = sum(spaces(program, command, steps) for command in MOST_SPACE if not arguments[1:] or command in arguments[1:])
        print(f'{bad} not in order')
        return bad > 0
    names = [name for name in jobs() if not arguments[1:] or any(word in name for word in arguments[1:])]
    bad = sum(whole(program, name, every) for name in names)
    print(f'{bad} not in order')
    return bad > 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
