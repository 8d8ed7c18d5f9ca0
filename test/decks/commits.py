"""Locks on the names of results, and files of a run that get their names as one: whatever name cannot be
given, and wherever a run dies, the files in place are of one run, if need be once the next has begun"""
import glob
import os
import re
import socket
import subprocess
import threading

from support import INPUTS, Test, expected, preload, read_bytes, read_text, write

FIRST = os.path.realpath(os.path.join(INPUTS, 'first.dat'))
ENDINGS = ('h5', 'lis', 'json')
SWEPT = ENDINGS + ('vtkhdf', 'joints.vtkhdf')
# A deck that is small enough to be run some hundred times
SMALL = """TITLE
A ring under pressure
CONTROL
    0
MATERIALS
    1       1.0       0.3
BLOCKS
    1    1    4    1    1
       1.0       0.0       2.0       1.0
FACES
    1    1       1.0       0.0       1.0       1.0
    2    1       1.0       0.0       2.0       0.0
FIXEDFACES
    2  010
CASE
    1 Inside
PRESSURES
    1    0       1.0
COMBINE
    1    1       1.0
    2    1       2.0
END
"""
NOTHING = 'axijoint: the files of an earlier run that died'


def small(combinations):
    """The deck with one combination or two"""
    return SMALL if combinations == 2 else SMALL[:SMALL.index('CASE')] + SMALL[
        SMALL.index('PRESSURES'):SMALL.index('COMBINE')] + 'END\n'


class Place:
    """A folder with results of an earlier run, and a library that lets names fail"""

    def __init__(self, program, folder, combinations, swept, links=True):
        self.program = program
        self.library = preload('failing_names')
        self.deck = write(folder, 'job.dat', small(combinations))
        self.results = os.path.join(folder, 'results')
        self.options = ['--vtk'] if swept else []
        self.stems = ['job'] if combinations == 1 else ['job.1', 'job.2']
        self.endings = SWEPT[:4] if swept else ENDINGS
        self.links = {} if links else {'NAMES_NO_LINKS': '1'}
        self.run()
        self.earlier = self.contents()

    def run(self, *options, deck=None, **fault):
        """Run with a fault; exit code and what it said"""
        environment = dict(self.program.environment, OMP_NUM_THREADS='1', **self.links, **fault)
        if fault or self.links:
            environment.update(LD_PRELOAD=self.library, NAMES_IN=self.results)
        return subprocess.run([self.program.path, 'run', deck or self.deck, '-o', self.results, '--quiet',
                               *self.options, *options], env=environment, capture_output=True, text=True,
                              check=False, timeout=60)

    def contents(self):
        """What is in the folder"""
        return {name: read_bytes(os.path.join(self.results, name)) for name in os.listdir(self.results)}

    def stamps(self, stem):
        """Which runs the files of a set are of"""
        files = [read_bytes(f'{self.results}/{stem}.{ending}') for ending in self.endings]
        stamp = re.search(rb'"run": *"([^"]+)"', files[ENDINGS.index('json')]).group(1)
        return {stamp if stamp in content else b'another' for content in files}

    def put_back(self):
        """The earlier results alone"""
        for name in os.listdir(self.results):
            os.remove(os.path.join(self.results, name))
        for name, content in self.earlier.items():
            write(self.results, name, content)

    def mixed(self):
        """Faults: sets of two runs, or a file that is left"""
        faults = [f'{stem}: files of several runs' for stem in self.stems if len(self.stamps(stem)) > 1]
        found = set(os.listdir(self.results))
        if len(self.stems) > 1:
            found.discard('job.json')  # of an error that is of no combination
        return faults + expected('files', sorted(self.earlier), sorted(found))


def failing(program, folder, combinations, swept, links=True):
    """The n-th name cannot be given, for every n: exit code 5, and each set is the earlier or the new one;
    then the same with all that follow, where the next run has to mend it"""
    place = Place(program, folder, combinations, swept, links)
    faults = []
    for kind in ('NAMES_FAIL', 'NAMES_FAIL_FROM'):
        for n in range(1, 200):
            place.put_back()
            ran = place.run(**{kind: str(n)})
            if ran.returncode == 0:
                break
            found = expected('exit code', 5, ran.returncode)
            if kind == 'NAMES_FAIL_FROM':
                place.run('--memory', '1')
            elif 'mend: ' not in ran.stderr:
                found.append(ran.stderr)
            faults += [f'{kind} {n}: {fault}' for fault in found + place.mixed()]
        fewest = (1 + 2*len(place.endings))*combinations
        if n < fewest:
            faults.append(f'{kind}: only {n} names were given, of {fewest} at least')
    return faults


def dying(program, folder, combinations, swept, links=True):
    """A run dies where it gives or takes the n-th name, for every n. The next run, which cannot solve
    anything in the memory that it is allowed, finds each set whole or makes it so, and removes the rest"""
    place = Place(program, folder, combinations, swept, links)
    faults, told = [], 0
    for n in range(1, 400):
        place.put_back()
        ran = place.run(NAMES_KILL=str(n))
        if ran.returncode != -9:
            break
        inside = bool(glob.glob(place.results + '/*.commit'))
        ran = place.run('--memory', '1')
        found = expected('exit code', 6, ran.returncode) + place.mixed()
        told += inside and NOTHING in ran.stderr
        faults += [f'killed at {n}: {fault}' for fault in found]
    if n < 10 or told < 2*len(place.stems):
        faults.append(f'killed {n - 1} times, {told} times in the middle')
    return faults


def waited_for(program, folder):
    """Every file is on the disk before it gets its name; where earlier ones are replaced, the journal and its name are, too.
    A journal of which a power cut left the name alone ends nothing"""
    place = Place(program, folder, 1, False)
    journal, log = f'{place.results}/job.commit', os.path.join(folder, 'log')
    faults = []
    for replaces in (True, False):
        write(folder, 'log', '')
        place.run(NAMES_LOG=log)
        lines = [line.split(' ', 1) for line in read_text(log).splitlines()]
        named = [path for what, path in lines if what == 'name' and path.startswith(place.results + '/job.')
                 and not path.endswith('.tmp')]
        names = {path: lines.index(['name', path]) for path in named}
        temporary = rf'\.{re.escape(socket.gethostname())}\.\d+\.tmp$'
        synced = {re.sub(temporary, '', path): k for k, (what, path) in enumerate(lines) if what == 'sync'}
        for path in [f'{place.results}/job.{ending}' for ending in ENDINGS]:
            if not synced.get(path, len(lines)) < names.get(path, -1):
                faults.append(f'{path} was named before it was on the disk: {lines}')
        first = min(k for path, k in names.items() if path != journal)
        folders = [k for k, (what, path) in enumerate(lines) if what == 'sync' and path == place.results]
        if replaces != (journal in synced) or replaces != any(names[journal] < k < first for k in folders):
            faults.append(f'journal of a run that {"replaces" if replaces else "is the first"}: {lines}')
        faults += place.mixed()
        for name in place.earlier:
            os.remove(os.path.join(place.results, name))
    write(place.results, 'job.commit', '')
    ran = place.run()
    return faults + expected('exit code', 0, ran.returncode) + place.mixed()


def together(program, folder):
    """Several runs of one name at a time: each writes all its files, or none (exit code 7), and no two at once"""
    place = Place(program, folder, 1, False)
    faults, codes = [], []
    for _ in range(4):
        threads = [threading.Thread(target=lambda: codes.append(place.run())) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        faults += place.mixed()
    ends = [ran.returncode for ran in codes]
    if not {0} <= set(ends) <= {0, 7}:
        faults.append(f'exit codes {ends}')
    for ran in codes:
        if ran.returncode == 7 and not re.search(r'uses this name: process \d+ on this host, \S+, since \d+-.*'
                                                 r'\(run .*job.dat\)\nmend: ', ran.stderr):
            faults.append(ran.stderr)
    return faults


def lock_text(**changes):
    """A lock of a process that has ended"""
    ended = subprocess.Popen(['true'])
    ended.wait()
    fields = {'host': socket.gethostname(), 'installation': '', 'boot': '', 'space': '', 'process': ended.pid,
              'start': 1, 'since': '2026-01-01 00:00:00 +0000', 'batch': '', 'restart': '', 'purpose': 'run x'}
    for field, path in (('installation', '/etc/machine-id'), ('boot', '/proc/sys/kernel/random/boot_id')):
        if os.path.exists(path):
            fields[field] = read_text(path).split('\n', maxsplit=1)[0]
    if os.path.exists('/proc/self/ns/pid'):
        fields['space'] = os.readlink('/proc/self/ns/pid')
    fields.update(changes)
    return 'axijoint lock 1\n' + ''.join(f'{key} {value}\n' for key, value in fields.items()) + 'end\n'


def left_behind(program, folder):
    """Locks of others: dead, alive, a number given anew, another host, an earlier start of the same batch job,
    one that says nothing"""
    place = Place(program, folder, 1, False)
    own = {'process': os.getpid(), 'start': 0}
    faults = []
    for what, text, code, words in (
            ('dead', lock_text(), 0, 'was taken over'),
            ('alive', lock_text(**own), 7, f'process {os.getpid()} on this host'),
            ('number given anew', lock_text(process=os.getpid(), start=1), 0, 'was taken over'),
            ('machine started anew', lock_text(**own, boot='earlier'), 0, 'was taken over'),
            ('another host', lock_text(host='elsewhere'), 7, 'cannot be seen from'),
            ('a host of the same name', lock_text(installation='other'), 7, 'on another host'),
            ('earlier start of the job', lock_text(host='elsewhere', batch='77', restart='0'), 0, 'was taken over'),
            ('the same start of the job', lock_text(host='elsewhere', batch='77', restart='1'), 7, 'remove '),
            ('no lock', 'something\n', 7, 'does not say which')):
        lock = write(place.results, 'job.lock', text)
        ran = place.run(SLURM_JOB_ID='77', SLURM_RESTART_COUNT='1')
        found = expected('exit code', code, ran.returncode)
        if words not in ran.stderr or (code == 7 and 'mend: ' not in ran.stderr):
            found.append(f'expected {words!r}, found\n{ran.stderr}')
        if code == 7:
            found += expected('the lock', text, read_text(lock))
            os.remove(lock)
        faults += [f'{what}: {fault}' for fault in found + place.mixed()]
    # a program without MPI in several processes fights with itself
    lock = write(place.results, 'job.lock', lock_text(**own))
    for n, wanted in (('3', True), ('1', False)):
        ran = place.run(OMPI_COMM_WORLD_SIZE=n)
        faults += expected(f'{n} processes', wanted, f'one of the {n} processes that this one was started with' in ran.stderr)
    os.remove(lock)
    return faults


def taken_over_together(program, folder):
    """A lock that was left behind is taken over by one of several runs, never by two at a time: each that
    ends well has written a set of its own, and none is mixed"""
    place = Place(program, folder, 1, False)
    faults = []
    for _ in range(6):
        write(place.results, 'job.lock', lock_text())
        done = []
        threads = [threading.Thread(target=lambda done=done: done.append(place.run())) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        taken = sum('was taken over' in ran.stderr for ran in done)
        faults += expected('runs that took the lock over', 1, taken) + place.mixed()
        if not {0} <= {ran.returncode for ran in done} <= {0, 7}:
            faults.append(str([(ran.returncode, ran.stderr) for ran in done]))
    return faults


def dying_heirs(program, folder):
    """A run dies while it takes over the lock of a dead one, and the next while it takes over that: in the end
    nothing is left of either"""
    place = Place(program, folder, 1, False)
    faults = []
    for first in range(1, 10):
        for second in range(1, 10):
            place.put_back()
            write(place.results, 'job.lock', lock_text())
            codes = [place.run('--memory', '1', NAMES_KILL=str(n)).returncode for n in (first, second)]
            ran = place.run('--memory', '1')
            found = expected('exit code', 6, ran.returncode) + place.mixed()
            if codes[0] != -9:
                found.append(f'exit codes {codes}')
            faults += [f'killed at {first}, {second}: {fault}' for fault in found]
    return faults


def leftovers(program, folder):
    """Files that dead runs did not complete are removed and told; those of other names, of a process that runs
    and of the user stay"""
    place = Place(program, folder, 1, False)
    ended = subprocess.Popen(['true'])
    ended.wait()
    host = socket.gethostname()
    gone = [f'job.h5.{host}.{ended.pid}.tmp', f'job.lis.{ended.pid}.tmp', 'job.state.elsewhere.1.tmp',
            f'job.json.earlier.{host}.{ended.pid}.tmp']
    kept = [f'job.h5.{host}.{os.getpid()}.tmp', f'job.2.h5.{host}.{ended.pid}.tmp', 'job.notes.tmp', 'job.h5.tmp',
            f'jobs.h5.{host}.{ended.pid}.tmp']
    for name in gone + kept:
        write(place.results, name, 'x')
    ran = place.run()
    faults = expected('exit code', 0, ran.returncode) + expected(
        'files', sorted([*place.earlier, *kept]), sorted(os.listdir(place.results)))
    if 'axijoint: 4 files that earlier runs did not complete were removed' not in ran.stderr:
        faults.append(ran.stderr)
    return faults


def tests(program):
    """One test a kind of fault and of job"""
    jobs = {'': (1, False), ', --vtk': (1, True), ', two combinations': (2, False)}
    found = [Test(f'names: {what}{job}', lambda folder, check=check, size=size: check(program, folder, *size))
             for check, what in ((failing, 'cannot be given'), (dying, 'a run dies')) for job, size in jobs.items()]
    found += [Test(f'names: {what}, no second names',
                   lambda folder, check=check: check(program, folder, 1, False, False))
              for check, what in ((failing, 'cannot be given'), (dying, 'a run dies'))]
    functions = {'on the disk first': waited_for, 'several runs': together, 'locks left behind': left_behind,
                 'one lock, several runs': taken_over_together, 'heirs that die': dying_heirs, 'files left behind': leftovers}
    return found + [Test(f'names: {what}', lambda folder, check=check: check(program, folder))
                    for what, check in functions.items()]
