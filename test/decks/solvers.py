"""The solvers agree, and the number of threads changes nothing"""
import ctypes
import json
import os
import re
import resource
import subprocess

from hard_scenes import example
from listing import all_rows
from support import INPUTS, Test, expected, preload, read_text, write

# Of Linux: whether the system gives large pages to a process and those that it starts
PR_SET_THP_DISABLE = 41

# A ring large enough for harmonics to be solved in parallel
RING = """TITLE
Ring under four harmonics
CONTROL
5
MATERIALS
1, 1.0, 0.3
BLOCKS
1, 1, 8, 20, 20
1, 0, 2, 1
FACES
1, 1, 1, 0, 2, 0
2, 1, 1, 1, 2, 1
FIXEDFACES
1, 111
TRACTIONS
2, 0, 0, 1
2, 1, 1, 1, -1
2, 2, 1, 1, 1
2, 5, 1, 1, 1
PRINT
 TABLES, ALL
END
"""


# A pile in a ring, so many pairs of nodes along its joint, 521 with three components each, that half of the flexibilities is kept
# (`one_panel` of linalg/symmetric_half.f90)
LONG_JOINT = """TITLE
Long joint that slips in part
CONTROL
1, 5
MATERIALS
1, 2.0E4, 0.2
2, 50.0, 0.3
LAWS
1, 100.0, 200.0, 100.0, 0.0, 26.0
LAWDETAILS
1, RESULTANT, , , , , , -0.05
BLOCKS
1, 1, 8, 1, 260
0.0, -10.0, 0.5, 0.0
2, 2, 8, 2, 260, 4.0
0.5, -10.0, 10.0, 0.0
FACES
1, 1, 0.0, 0.0, 0.5, 0.0
2, 1, 0.5, -10.0, 0.5, 0.0
3, 2, 0.5, -10.0, 0.5, 0.0
4, 2, 10.0, -10.0, 10.0, 0.0
5, 2, 0.5, -10.0, 10.0, -10.0
INTERFACES
1, 2, 3
FIXEDFACES
4, 111
5, 111
RESULTANTS
1, LATERAL, 0.2
1, AXIAL, -0.06
INCREMENTS
1.0, 1.0E-8
PRINT
 TABLES, ALL
END
"""


def results(program, folder, deck, *options):
    """Listing, without header, solver and times, and summary of a run"""
    ran = program.run('run', deck, '-o', folder, *options)
    if ran.code != 0:
        raise AssertionError(f'{options}: exit code {ran.code}\n{ran.err}')
    stem = os.path.join(folder, os.path.splitext(os.path.basename(deck))[0])
    text = read_text(stem + '.lis')
    tables = text[text.index('\nDISPLACEMENT AMPLITUDES'):text.index('\nTIMES')]
    return tables, json.loads(read_text(stem + '.json'))


def numbers(tables):
    """Displacements of the listing"""
    return [float(word) for line in tables.split('\nTOTAL')[0].splitlines()
            for word in line.split()[3:] if re.fullmatch(r'-?\d\.\d+E[+-]\d+', word)]


def solver_names(program):
    """The solvers of the program, as its help tells them"""
    words = re.search(r'--solver NAME +auto, (.*) \(', program.run('help', 'run').out)[1]
    return re.split(', | or ', words)


def solvers_agree(program, folder):
    """Displacements of all solvers differ by rounding"""
    faults = []
    for deck in (write(folder, 'ring.dat', RING), os.path.join(INPUTS, 'case3.dat'), write(folder, 'long.dat', LONG_JOINT)):
        found = {}
        for solver in solver_names(program):
            tables, summary = results(program, folder, deck, '--solver', solver)
            if summary['solver'] != solver:
                faults.append(f'asked for {solver}, found {summary["solver"]}')
            found[solver] = numbers(tables)
        size = max(map(abs, found['band']))
        for solver in solver_names(program)[1:]:
            worst = max(abs(a - b) for a, b in zip(found['band'], found[solver]))
            if len(found[solver]) != len(found['band']) or worst > 1e-7*size:
                faults.append(f'{deck}: {solver} and band differ by {worst:.1e} of {size:.1e}')
    return faults


def threads_change_nothing(program, folder):
    """One and two threads print the same tables"""
    deck = write(folder, 'ring.dat', RING)
    faults = []
    for solver in ('band', 'sparse'):
        one, two = (results(program, folder, deck, '--solver', solver, '--threads', threads)[0]
                    for threads in '12')
        if one != two:
            faults.append(f'{solver}: the tables of one and of two threads differ')
    return faults


def counts(program, deck, *options):
    """What `estimate` counts, by name"""
    ran = program.run('estimate', deck, '--counts', *options)
    return {name: float(number) for name, number in re.findall(r'^(\S+) +(\S+) +\S+$', ran.out, re.MULTILINE)}


def predicted_memory(program, deck, *options):
    """Memory [MB] that `estimate` expects of the sparse solver, and its factors at once"""
    found = counts(program, deck, '--solver', 'sparse', *options)
    return found['memory'], int(found['factors'])


def memory_changes_nothing(program, folder):
    """With less memory fewer factors are there at once, and every number stays: a linear job, one
    with several combinations, which keeps its factors, and one with joints"""
    fine = RING.replace('1, 1, 8, 20, 20', '1, 1, 8, 70, 70')
    decks = {'linear': (fine, 2, 1),
             'combined': (fine.replace('TRACTIONS', 'CASE\n1, all\nTRACTIONS').replace(
                 'END', 'COMBINE\n1, 1, 1\n2, 1, 2\nEND'), 4, 1),
             'joints': (all_rows(example(3, refined=7, harmonic=4, planes=17)), 5, 1)}
    faults = []
    for name, (text, most, least) in decks.items():
        deck = write(folder, name + '.dat', text)
        options = ('--solver', 'sparse', '--threads', '2')
        stem = name + ('.2' if name == 'combined' else '')
        runs = []
        all_of_it = predicted_memory(program, deck, '--threads', '2')[0]
        for limit in (999999, int(0.87*all_of_it), int(0.78*all_of_it)):
            factors = predicted_memory(program, deck, '--threads', '2', '--memory', str(limit))[1]
            ran = program.run('run', deck, '-o', folder, *options, '--memory', str(limit))
            if ran.code != 0:
                return faults + [f'{name}: exit code {ran.code}\n{ran.err}']
            summary = json.loads(read_text(os.path.join(folder, stem + '.json')))
            text = read_text(os.path.join(folder, stem + '.lis'))
            runs.append((factors, text[text.index('\nDISPLACEMENT AMP'):text.index('\nTIMES')]))
            if summary['peak_memory_mb'] > limit:
                faults.append(f'{name}: {summary["peak_memory_mb"]} MB with a limit of {limit} MB')
        at_once = [run[0] for run in runs]
        if at_once[0] != most or not least <= at_once[2] <= at_once[1] < most:
            faults.append(f'{name}: factors at once {at_once}, expected {most} and less')
        if any(run[1] != runs[0][1] for run in runs):
            faults.append(f'{name}: the tables differ')
    return faults


def memory_too_small(program, folder):
    """A limit that one factor does not fit in, which `estimate` tells, too; one that is no number"""
    deck = write(folder, 'fine.dat', RING.replace('1, 1, 8, 20, 20', '1, 1, 8, 70, 70'))
    faults = []
    for limit, code, words in (('40', 6, 'the limit given leaves'), ('much', 2, 'option --memory')):
        ran = program.run('run', deck, '-o', folder, '--memory', limit)
        faults += ran.ended_with(code) + ([] if words in ran.err else [ran.err])
    words = 'a run here and now would end with exit code 6:\nout of memory'
    for options, told in ((('--memory', '40'), True), ((), False), (('--memory', '40', '--counts'), False)):
        ran = program.run('estimate', deck, *options)
        faults += ran.ended_with(0) + ([] if (words in ran.out) == told else [f'{options}: {ran.out}'])
    # beside the lines of a script
    for options, told in ((('--memory', '40', '--slurm'), True), (('--slurm',), False)):
        ran = program.run('estimate', deck, *options)
        faults += ran.ended_with(0) + ([] if (words in ran.err) == told and words not in ran.out else [f'{options}: {ran.out}{ran.err}'])
    return faults


def stacks_stay_small(program, folder):
    """Threads have stacks of some MB at most: no array of the mesh's size may lie there"""
    deck = write(folder, 'fine.dat', RING.replace('1, 1, 8, 20, 20', '1, 1, 4, 120, 120'))
    ran = program.run('run', deck, '-o', folder, '--threads', '2',
                      limits=[(resource.RLIMIT_STACK, 512*1024)])
    return [] if ran.code == 0 else [f'expected exit code 0, found {ran.code}', ran.err]


def page_faults(program, deck, folder, large):
    """Page faults of a run, where the system may give large pages or not"""
    def begin():
        libc.prctl(PR_SET_THP_DISABLE, 0 if large else 1, 0, 0, 0)

    libc = ctypes.CDLL(None)
    process = subprocess.Popen([program.path, 'run', deck, '-o', folder, '--quiet', '--threads', '1'],
                               env=program.environment, preexec_fn=begin)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if status:
        raise AssertionError(f'ended with {process.returncode}')
    return used.ru_minflt


def pages_are_large(program, folder):
    """Where the system gives large pages to who asks, a job of 90,000 unknowns a harmonic has half the page faults or less"""
    try:
        if '[never]' in read_text('/sys/kernel/mm/transparent_hugepage/enabled'):
            return []
    except FileNotFoundError:
        return []
    deck = write(folder, 'fine.dat', RING.replace('1, 1, 8, 20, 20', '1, 1, 8, 100, 100'))
    small, large = (page_faults(program, deck, folder, large) for large in (False, True))
    return [] if large < 0.5*small else [f'{large} page faults with large pages, {small} without']


def estimate_tells_costs(program, folder):
    """`estimate` has seconds by phase, a total, memory and files, and solves nothing; its sum is right, and solvers differ"""
    deck = write(folder, 'ring.dat', RING)
    ran = program.run('estimate', deck)
    rows = dict(re.findall(r'^ +([a-z]+) +([\d.]+)', ran.out, re.MULTILINE))
    faults = [] if ran.code == 0 else [f'exit code {ran.code}']
    if list(rows) != ['read', 'assemble', 'factor', 'joints', 'errors', 'recover', 'write', 'total', 'memory', 'files']:
        return faults + [f'found {ran.out!r}']
    parts = sum(float(rows[phase]) for phase in list(rows)[:-3])
    if abs(parts - float(rows['total'])) > 0.005:
        faults.append(f'the sum is {parts}: {ran.out!r}')
    entries = {solver: counts(program, deck, '--solver', solver)['solved_entries'] for solver in ('band', 'sparse')}
    if not 1.5*entries['sparse'] < entries['band']:
        faults.append(f'entries of factors {entries}')
    return faults + [f'wrote {name}' for name in os.listdir(folder) if name != 'ring.dat']


def estimate_counts(program, folder):
    """What is counted goes as it must: harmonics and iterations twice, increments, combinations, --vtk, rows"""
    faults = []
    once = write(folder, 'once.dat', example(3, refined=2, harmonic=4, planes=17))
    twice = write(folder, 'twice.dat', example(3, refined=2, harmonic=9, planes=17))
    for options, term, ratio in (((), 'solved_entries', 10/5), ((), 'stress_modes', 10/5), ((), 'fine_blocks', 10/5),
                                 ((), 'shape_products', 1), ((), 'laws', 1), ((), 'sums', 10/5)):
        found = counts(program, twice, *options)[term]/counts(program, once, *options)[term]
        # harmonic 0 has fewer unknowns
        if abs(found/ratio - 1) > (0.15 if term == 'solved_entries' else 1e-6):
            faults.append(f'{term}: {found} times as many with 10 for 5 harmonics, expected {ratio}')
    laws = [counts(program, once, '--iterations', str(n))['laws'] for n in (10, 20, 30)]
    if not laws[1] > laws[0] or abs(laws[2] - 2*laws[1] + laws[0]) > 1e-6*laws[0]:
        faults.append(f'laws of 10, 20 and 30 iterations: {laws}')
    if counts(program, once)['swept_values'] != 0 or not counts(program, once, '--vtk')['swept_values'] > 0:
        faults.append('--vtk is not counted, or always')
    write(folder, 'rows.csv', 'LAWS 1 PHI, MATERIALS 1 E\n0:30/7, 2E4; 3E4\n')
    ran = program.run('estimate', '--study', 'rows.csv', 'once.dat', folder=folder)
    if not ran.out.startswith('rows.csv: 14 rows on 2 structures\n'):
        faults.append(f'found {ran.out!r}{ran.err!r}')
    part = program.run('estimate', '--study', 'rows.csv', 'once.dat', '--part', '1/2', folder=folder)
    if not part.out.startswith('rows.csv: 7 rows on 1 structure\n'):
        faults.append(f'found {part.out!r}{part.err!r}')
    return faults


TUBE = """TITLE
Long elements of a thin tube, and of the ground across a joint
CONTROL
2
MATERIALS
1,2E5,0.3
2,50,0.3
LAWS
1,200,400,200,,,ELASTIC
BLOCKS
1,1,8,1,60
1.95,-300,2,0
2,2,8,60,60
2,-300,62,0
FACES
1,1,1.95,-300,2,-300
2,1,2,-300,2,0
3,2,2,-300,2,0
4,1,1.95,0,2,0
5,2,62,-300,62,0
6,2,2,-300,62,-300
INTERFACES
1,2,3
FIXEDFACES
5,111
6,111
1,111
RESULTANTS
4,LATERAL,1
END
"""


def estimated_memory(program, folder):
    """Memory at the peak of a linear job, one of joints, one of many harmonics, a long tube beside slender elements: within 10 % of
    that of the run, the program itself, which is larger with checks, left aside"""
    empty = write(folder, 'small.dat', RING.replace('1, 1, 8, 20, 20', '1, 1, 8, 2, 2'))
    faults, ground = [], {}
    for name, text in (('small', None), ('linear', RING.replace('1, 1, 8, 20, 20', '1, 1, 8, 90, 90')),
                       ('joints', example(3, refined=6, harmonic=6, planes=33)),
                       ('many harmonics', example(3, harmonic=128, planes=513)), ('tube', TUBE)):
        deck = write(folder, name + '.dat', text) if text else empty
        ran = program.run('run', deck, '-o', folder, '--threads', '1')
        if ran.code != 0:
            return [f'{name}: exit code {ran.code}\n{ran.err}']
        found = json.loads(read_text(os.path.join(folder, name + '.json')))['peak_memory_mb']
        told = counts(program, deck, '--threads', '1')['memory']
        ground[name] = found - told
        if abs(found - told - ground['small']) > 0.1*found:
            faults.append(f'{name}: {found} MB, expected {told} MB, and {ground["small"]} MB more of the program')
    text = read_text(os.path.join(INPUTS, 'monopile.dat'))
    steps = ''.join(f'{factor:10}    1.0E-8         2\n' for factor in (0.2, 0.2, -0.2, -0.2)*25)
    deck = write(folder, 'history.dat', text[:text.index('INCREMENTS')] + 'INCREMENTS\n       1.0    1.0E-8         1\n' + steps
                 + text[text.index('POINTS'):])
    ran = program.run('run', deck, '-o', folder, '--threads', '1')
    found = json.loads(read_text(os.path.join(folder, 'history.json')))['peak_memory_mb'] - ground['small']
    told = counts(program, deck, '--threads', '1')['memory']
    # how often it is written to go on from hangs on the speed of the disk
    return faults + ran.ended_with(0) + expected('history: enough, and not far too much', True, 0.6*told < found < told)


def job_lines(program, folder):
    """`estimate --slurm`: lines that sbatch understands, the largest of several decks, nothing else"""
    small = write(folder, 'small.dat', RING.replace('1, 1, 8, 20, 20', '1, 1, 8, 2, 2'))
    large = write(folder, 'large.dat', RING.replace('1, 1, 8, 20, 20', '1, 1, 8, 60, 60'))
    faults, asked = [], {}
    for name, decks in (('small', [small]), ('large', [large]), ('axijoint', [small, large])):
        ran = program.run('estimate', *decks, '--slurm', '--threads', '2')
        lines = dict(re.findall(r'^#SBATCH --([a-z-]+)=(\S+)$', ran.out, re.MULTILINE))
        if ran.code != 0 or ran.err or len(lines) + ran.out.count('#SBATCH --requeue\n') != ran.out.count('\n'):
            return [f'exit code {ran.code}: {ran.out!r}{ran.err!r}']
        wanted = {'job-name': name, 'nodes': '1', 'ntasks': '1', 'cpus-per-task': '2', 'signal': 'B:USR1@120',
                  'open-mode': 'append'}
        faults += [f'{key}: {lines.get(key)}' for key in wanted if lines.get(key) != wanted[key]]
        if not re.fullmatch(r'\d+M', lines['mem']) or not re.fullmatch(r'\d+:[0-5]\d:00', lines['time']):
            faults.append(f'mem {lines["mem"]}, time {lines["time"]}')
        asked[name] = int(lines['mem'][:-1])
    # what the program takes when it starts differs by some pages from start to start
    if not asked['small'] < asked['large'] or abs(asked['large'] - asked['axijoint']) > 2:
        faults.append(f'memory {asked}')
    named = write(folder, "my deck's #2.v2.dat", RING.replace('1, 1, 8, 20, 20', '1, 1, 8, 2, 2'))
    lines = program.run('estimate', named, '--slurm').out.splitlines()
    faults += expected('name of the job', '#SBATCH --job-name=my_deck_s__2.v2', lines[0])
    ran = program.run('estimate', small, write(folder, 'bad.dat', 'TITLE\n'), '--slurm')
    return faults + ([] if ran.code == 2 and '#SBATCH' not in ran.out else [f'a wrong deck: {ran.code}, {ran.out!r}'])


def few_threads(program, folder):
    """No more threads are made than are asked for, each once, where few points move and there are many planes"""
    deck = write(folder, 'planes.dat', example(2, harmonic=40, planes=161))
    told = os.path.join(folder, 'threads')
    environment = dict(program.environment, LD_PRELOAD=preload('counted_threads'), THREADS_IN=told)
    subprocess.run([program.path, 'run', deck, '-o', folder, '--threads', '4', '--quiet'], env=environment, check=True, timeout=300)
    return expected('threads made', 3, int(read_text(told)))


def tests(program):
    """All of them"""
    return [Test(f'solvers: {name}', lambda folder, check=check: check(program, folder))
            for name, check in (('they agree', solvers_agree),
                                ('threads', threads_change_nothing),
                                ('threads made', few_threads),
                                ('memory', memory_changes_nothing),
                                ('too little memory', memory_too_small),
                                ('stacks', stacks_stay_small),
                                ('large pages', pages_are_large),
                                ('estimate', estimate_tells_costs),
                                ('estimate counts', estimate_counts),
                                ('estimate of memory', estimated_memory),
                                ('estimate for a job script', job_lines))]
