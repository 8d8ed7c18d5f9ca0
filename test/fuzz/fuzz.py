#!/usr/bin/env python3
"""Inputs changed by chance: whatever is read, the program ends with a documented exit code and in words, and what it
accepts and solves has no NaN, balances, and obeys the laws of its joints

Usage: scripts/fuzz [--count N] [--seed S] [KIND...]

Kinds: decks, legacy (decks of an older program), meshes (Gmsh), tables (of studies), listings and arrays (for compare), states (for --resume). Seeds are the
decks of inputs/ and test/decks; what once failed lies in test/fuzz/corpus and is tried first. Inputs that fail are kept in
build/fuzz.
"""
import glob
import json
import os
import random
import re
import resource
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

HERE = os.path.dirname(os.path.realpath(__file__))
ROOT = os.path.join(HERE, '..', '..')
sys.dont_write_bytecode = True
sys.path[:0] = [HERE, os.path.join(HERE, '..', 'decks')]

import commits
import gmsh_decks
import resumed
from mutate import DECK_KEYWORD, MESH_KEYWORD, bytes_changed, text_changed
from support import CRASH, INPUTS, Program, preload, python_with, read_bytes, write

PORTION, HANGS = 100, 180
# Words that are not the program's
RAW = re.compile(CRASH.pattern + r'|HDF5-DIAG|rror allocating|libgomp|OpenBLAS|AddressSanitizer|runtime error')
# Accepted decks that are solved: so many of those accepted, of at most so many nodes
SOLVED, MOST_NODES = 0.25, 3000
# Address space of a run [byte]: a changed number may ask for any mesh
SPACE = 1500*2**20
CODES = {'check': {0, 2, 5, 6}, 'run': {0, 2, 3, 4, 5, 6}, 'compare': {0, 1, 2, 5, 6}, 'study': {0, 2, 3, 4, 5, 6},
         'resume': {0, 2, 3, 4, 5, 6, 8}}


class Fuzz:
    """A program, a folder, and dice"""

    def __init__(self, program, folder, seed):
        self.program, self.folder, self.dice = program, folder, random.Random(seed)
        # sanitizers reserve all of the address space
        # of the processor's time, as others may use the machine
        self.limits = ((resource.RLIMIT_CPU, HANGS),) + (() if program.sanitized else ((resource.RLIMIT_AS, SPACE),))
        self.found = []
        self.counts = {}
        self.judge = Judge()

    def run(self, *words, folder=None):
        """Run the program: exit code and all that it said"""
        try:
            return self.program.run(*words, folder=folder or self.folder, limits=self.limits, time_limit=20*HANGS)
        except subprocess.TimeoutExpired:
            return None

    def note(self, kind, what, files):
        """Keep what failed"""
        place = os.path.join(ROOT, 'build', 'fuzz')
        for path in files:
            write(place, f'{kind}-{len(self.found)}-{os.path.basename(path)}', read_bytes(path))
        self.found.append(f'{kind}-{len(self.found)}: {what[:300]}')

    def judged(self, kind, command, ran, files):
        """Whether a run ended as it may"""
        self.counts[kind] = self.counts.get(kind, 0) + 1
        if ran is None:
            self.note(kind, 'hangs', files)
        elif ran.code not in CODES[command]:
            self.note(kind, f'exit code {ran.code}: {ran.err}', files)
        elif RAW.search(ran.err):
            self.note(kind, ran.err, files)
        else:
            return True
        return False

    def decks(self, paths, kind, options=()):
        """Check decks, many in a process; then solve some of those that are accepted"""
        accepted = []
        for first in range(0, len(paths), PORTION):
            portion = paths[first:first + PORTION]
            ran = self.run('check', *options, *portion)
            if ran is None or ran.code not in (0, 2) or RAW.search(ran.err):
                for path in portion:  # one of them did it
                    alone = self.run('check', *options, path)
                    if self.judged(kind, 'check', alone, [path]) and alone.code == 0:
                        accepted += re.findall(r'^(.*): ok, (\d+) nodes', alone.out, re.M)
            else:
                self.counts[kind] = self.counts.get(kind, 0) + len(portion)
                accepted += re.findall(r'^(.*): ok, (\d+) nodes', ran.out, re.M)
        chosen = [path for path, nodes in accepted if int(nodes) <= MOST_NODES and self.dice.random() < SOLVED]
        for path in chosen:
            self.solve(path, kind, options)

    def solve(self, path, kind, options):
        """Run a deck, and look at its results"""
        output = os.path.join(self.folder, 'results')
        ran = self.run('run', *options, path, '-o', output, '--threads', '1')
        if not self.judged(f'{kind} solved', 'run', ran, [path]) or ran.code != 0:
            return
        stem = os.path.join(output, os.path.basename(path)[:-4])
        for summary in glob.glob(glob.escape(stem) + '*.json'):
            faults = faults_of_results(summary, self.judge)
            if faults:
                self.note(kind, '; '.join(faults), [path])
        for file in glob.glob(os.path.join(output, '*')):
            os.remove(file)


JUDGE = '''
import json, sys, h5py, numpy

def faults_of(path):
    faults = []
    with h5py.File(path) as file:
        def look(name, item):
            if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and not numpy.isfinite(item[()]).all():
                faults.append("not finite: " + name)
        file.visititems(look)
        if "joints/stress" in file and "joint_materials/kind" in file and len(file["joints/joint"]):
            stress, state = file["joints/stress"][()], file["joints/state"][()]  # (plane, point, 3), (plane, point)
            law = file["mesh/joint_material"][()][file["joints/joint"][()] - 1] - 1
            yields = file["joint_materials/kind"][()][law] == 1
            size = abs(stress).max() or 1.0
            if (abs(stress[state == 2]) > 1e-6*size).any():
                faults.append("stress in open joints")
            bond = file["joint_materials/opening"][()][law] == 2
            if (stress[:, :, 1][:, yields & ~bond] > 1e-6*size).any():
                faults.append("tension without bond")
    return faults

for line in sys.stdin:
    try:
        print(json.dumps(faults_of(line[:-1])), flush=True)
    except Exception as fault:
        print(json.dumps([repr(fault)]), flush=True)
'''


class Judge:
    """A Python that reads results files, one after the other; without NumPy and h5py there is none"""

    def __init__(self):
        python = python_with('numpy, h5py')
        self.process = python and subprocess.Popen([python, '-B', '-c', JUDGE], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def faults(self, path):
        """What is wrong with a file"""
        if not self.process:
            return []
        self.process.stdin.write(path + '\n')
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline() or '["no judgement"]')

    def end(self):
        """End the Python"""
        if self.process:
            self.process.communicate()


def faults_of_results(path, judge):
    """What a summary and its arrays must not hold: NaN, forces out of balance, stress that the laws do not admit"""
    faults = []
    with open(path, encoding='utf-8') as file:
        summary = json.loads(file.read(), parse_constant=lambda word: faults.append(f'{word} in the summary'))
    allowed = max(1e-3, 10*(summary.get('tolerance') or 0))
    for name in ('equilibrium_error', 'part_equilibrium_error')[:1 if summary.get('method') == 'transfer' else 2]:
        if summary.get(name) is not None and summary['exit_code'] == 0 and not summary[name] < allowed:
            faults.append(f'{name} {summary[name]}')
    return faults + judge.faults(path[:-5] + '.h5')


GOOD = ('inputs/*.dat', 'inputs/hard/*.dat', 'test/decks/good/*.dat', 'test/decks/alike/*.dat', 'test/decks/unsolved/*.dat')
BAD = ('test/decks/bad/*.dat',)


def seeds_of_decks(patterns):
    """Decks that are small enough to be read in no time"""
    names = [name for pattern in patterns for name in sorted(glob.glob(os.path.join(ROOT, pattern)))]
    return [data for data in map(read_bytes, names) if len(data) < 20000 and b'INCLUDE' not in data and b'GMSH' not in data]


def fuzz_decks(fuzz, count):
    """Decks"""
    good, bad, paths = seeds_of_decks(GOOD), seeds_of_decks(BAD), []
    for k in range(count):
        text = text_changed(fuzz.dice.choice(bad if fuzz.dice.random() < 0.2 else good), fuzz.dice, DECK_KEYWORD, good + bad)
        paths.append(write(fuzz.folder, f'deck{k}.dat', text))
    fuzz.decks(paths, 'decks')


def fuzz_legacy(fuzz, count):
    """Decks of an older program"""
    seeds = [read_bytes(name) for name in sorted(glob.glob(os.path.join(INPUTS, 'legacy', '*.dat')))]
    seeds = [data for data in seeds if len(data) < 20000]
    paths = [write(fuzz.folder, f'old{k}.dat', text_changed(fuzz.dice.choice(seeds), fuzz.dice)) for k in range(count)]
    fuzz.decks(paths, 'legacy', ('--legacy', 'owen-hinton'))


def fuzz_meshes(fuzz, count):
    """Mesh files as text, and as bytes"""
    seeds = [gmsh_decks.FORMAT_2.encode(), gmsh_decks.FORMAT_4.encode(),
             gmsh_decks.FORMAT_2.replace('2.2 0 8', '2.2 1 8').encode()]
    paths = []
    for k in range(count):
        seed = fuzz.dice.choice(seeds)
        text = bytes_changed(seed, fuzz.dice) if fuzz.dice.random() < 0.2 else text_changed(seed, fuzz.dice, MESH_KEYWORD, seeds)
        write(fuzz.folder, f'mesh{k}.msh', text)
        paths.append(write(fuzz.folder, f'mesh{k}.dat', gmsh_decks.DECK.replace('mesh.msh', f'mesh{k}.msh')))
    fuzz.decks(paths, 'meshes')


def fuzz_tables(fuzz, count):
    """Tables of studies"""
    deck = write(fuzz.folder, 'study.dat', read_bytes(os.path.join(INPUTS, 'first.dat')))
    seeds = [b'LAWS 1 PHI\n20\n35\n', b'! a remark\nLAWS 1 PHI, LAWS 1 C, RESULTANTS 1 VALUE\n0:35:35, 0;0.1, 0.4\n30, 0, 0.2:0.6/2\n']
    for k in range(count):
        table = write(fuzz.folder, f'table{k}.csv', text_changed(fuzz.dice.choice(seeds), fuzz.dice))
        fuzz.judged('tables', 'study', fuzz.run('study', table, deck, '-o', os.path.join(fuzz.folder, 'studies')), [table])


def result_files(fuzz):
    """Results of a small run"""
    deck = write(fuzz.folder, 'small.dat', commits.small(1))
    ran = fuzz.run('run', deck, '-o', fuzz.folder)
    if ran is None or ran.code != 0:
        raise AssertionError(ran and ran.err)
    return os.path.join(fuzz.folder, 'small')


def fuzz_listings(fuzz, count):
    """Listings for compare"""
    stem = result_files(fuzz)
    for k in range(count):
        other = write(fuzz.folder, f'other{k}.lis', text_changed(read_bytes(stem + '.lis'), fuzz.dice))
        fuzz.judged('listings', 'compare', fuzz.run('compare', stem + '.h5', other), [other])


def fuzz_arrays(fuzz, count):
    """Results files for compare"""
    stem = result_files(fuzz)
    for k in range(count):
        other = write(fuzz.folder, f'other{k}.h5', bytes_changed(read_bytes(stem + '.h5'), fuzz.dice))
        fuzz.judged('arrays', 'compare', fuzz.run('compare', other, stem + '.lis'), [other])


def fuzz_states(fuzz, count):
    """States to go on from"""
    folder = os.path.join(fuzz.folder, 'resumed')
    deck = write(folder, 'job.dat', resumed.history(resumed.SHORT))
    environment = dict(fuzz.program.environment, LD_PRELOAD=preload('failing_names'), NAMES_IN=folder, NAMES_KILL='12')
    subprocess.run([fuzz.program.path, 'run', deck, '-o', folder, '--checkpoint', '0'], env=environment, capture_output=True,
                   check=False)
    state = read_bytes(os.path.join(folder, 'job.state'))
    for _ in range(count):
        path = write(folder, 'job.state', bytes_changed(state, fuzz.dice))
        fuzz.judged('states', 'resume', fuzz.run('run', deck, '-o', folder, '--resume'), [path])


KINDS = {'decks': (fuzz_decks, 0.70), 'legacy': (fuzz_legacy, 0.05), 'meshes': (fuzz_meshes, 0.15), 'tables': (fuzz_tables, 0.02),
         'listings': (fuzz_listings, 0.03), 'arrays': (fuzz_arrays, 0.03), 'states': (fuzz_states, 0.02)}


def try_corpus(fuzz):
    """What once failed"""
    paths = [write(fuzz.folder, os.path.basename(path), read_bytes(path)) for path in
             sorted(glob.glob(os.path.join(HERE, 'corpus', '*')))]
    share, globals()['SOLVED'] = SOLVED, 1.0
    fuzz.decks([path for path in paths if path.endswith('.dat')], 'corpus')
    globals()['SOLVED'] = share


def one_kind(program, kind, count, seed):
    """All inputs of a kind"""
    with tempfile.TemporaryDirectory(prefix='axijoint-fuzz-') as folder:
        fuzz = Fuzz(program, folder, seed)
        if kind == 'corpus':
            try_corpus(fuzz)
        else:
            KINDS[kind][0](fuzz, count)
        fuzz.judge.end()
        return fuzz


def all_kinds(program, count, seed, kinds=tuple(KINDS)):
    """Kinds side by side, decks in portions"""
    work = [('corpus', 0)]
    for kind in kinds:
        left = max(1, round(count*(KINDS[kind][1] if len(kinds) > 1 else 1)))
        while left > 0:
            work.append((kind, min(left, 500)))
            left -= 500
    with ThreadPoolExecutor(os.cpu_count()) as workers:
        return list(workers.map(lambda k: one_kind(program, *work[k], f'{seed} {k}'), range(len(work))))


def main(arguments):
    """The command"""
    values = {'--count': 2000, '--seed': int(time.time())}
    for option in values:
        if option in arguments:
            at = arguments.index(option)
            values[option] = int(arguments[at + 1])
            del arguments[at:at + 2]
    kinds = [kind for kind in KINDS if not arguments[1:] or kind in arguments[1:]]
    print(f'seed {values["--seed"]}')
    start = time.time()
    found, counts = [], {}
    for fuzz in all_kinds(Program(arguments[0]), values['--count'], values['--seed'], kinds):
        found += fuzz.found
        for kind, number in fuzz.counts.items():
            counts[kind] = counts.get(kind, 0) + number
    print(', '.join(f'{number} {kind}' for kind, number in counts.items()), f'in {time.time() - start:.0f} s')
    print('\n'.join(found), end='\n' if found else '')
    print(f'{len(found)} findings')
    return bool(found)


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
