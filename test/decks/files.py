"""Result files that cannot be written, and memory that does not suffice"""
import os
import re
import resource
import subprocess

from support import EarlierResults, INPUTS, Test, expected, preload, read_bytes, read_text, write

FIRST = os.path.realpath(os.path.join(INPUTS, 'first.dat'))
MANUAL = os.path.join(INPUTS, '..', 'doc', 'user.md')
MEBIBYTE = 2**20
# A mesh whose factor takes some 500 MiB
LARGE = """TITLE
A mesh too large for the memory
CONTROL
0, , , , BAND
MATERIALS
1, 1.0, 0.3
BLOCKS
1, 1, 4, 200, 200
0, 0, 1, 1
FACES
1, 1, 0, 0, 1, 0
2, 1, 0, 1, 1, 1
FIXEDFACES
1, 010
TRACTIONS
2, 0, 0, 1.0
END
"""
# The same, small, in two combinations
COMBINED = LARGE.replace('200, 200', '2, 2').replace('TRACTIONS', 'CASE\n1, Pull\nTRACTIONS').replace(
    '\nEND', '\nCASE\n2, Weight\nGRAVITY\n-1.0\nCOMBINE\n10, 1, 1.0\n20, 1, 1.0, 2, 1.0\nEND')


def failed(ran, code, words):
    """Faults unless a run ended with a code and said why"""
    faults = ran.ended_with(code)
    if words not in ran.err or 'mend: ' not in ran.err:
        faults.append(f'expected {words!r} and how to mend it, found\n{ran.err}')
    return faults


def missing(program, folder):
    """The directory for results does not exist, nor the one above it: both are made"""
    ran = program.run('run', FIRST, '-o', 'above/below/', folder=folder)
    return ran.ended_with(0) + expected('files', ['first.h5', 'first.json', 'first.lis'],
                                        sorted(os.listdir(os.path.join(folder, 'above', 'below'))))


def not_made(program, folder):
    """The directory for results cannot be made below a file"""
    write(folder, 'file', 'not a directory')
    ran = program.run('run', FIRST, '-o', 'file/below', folder=folder)
    return failed(ran, 5, 'the directory file/below for the results cannot be made') + expected(
        'files', ['file'], os.listdir(folder))


def is_file(program, folder):
    """The directory for results is a file"""
    write(folder, 'place', 'a file\n')
    ran = program.run('run', FIRST, '-o', 'place', folder=folder)
    return failed(ran, 5, 'place') + expected('the file', 'a file\n',
                                              read_text(os.path.join(folder, 'place')))


def read_only(program, folder):
    """The directory for results may not be written"""
    earlier = EarlierResults(os.path.join(folder, 'results'), 'job')
    deck = write(folder, 'job.dat', read_text(FIRST))
    os.chmod(folder, 0o755)
    os.chmod(earlier.folder, 0o555)
    ran = program.run_as_nobody('run', deck, '-o', 'results', folder=folder)
    os.chmod(earlier.folder, 0o755)
    return failed(ran, 5, 'results') + earlier.faults()


def occupied(program, folder, make):
    """A final name that is no file is refused, whichever of the three"""
    faults = []
    for ending in ('lis', 'json', 'h5'):
        place = os.path.join(folder, ending)
        os.mkdir(place)
        make(os.path.join(place, f'first.{ending}'))
        ran = program.run('run', FIRST, '-o', place)
        faults += failed(ran, 5, f'first.{ending}')
        faults += [f'found {name}' for name in os.listdir(place)
                   if name not in (f'first.{ending}', 'first.json')]
    return faults


def long_name(program, folder):
    """A name that leaves no room for the endings of results: what to do is a shorter one, not more room on the disk"""
    faults = []
    for length in (245, 251):  # the last one leaves none for the ending itself
        deck = write(folder, length*'n', read_text(FIRST))
        ran = program.run('run', deck, '-o', folder)
        faults += ran.ended_with(5)
        if 'mend: a shorter name, or a shorter path' not in ran.err or 'make room' in ran.err:
            faults.append(f'{length} letters: {ran.err[-400:]}')
    return faults


def deck_named_like_a_result(program, folder):
    """A deck is not overwritten by its own results, nor is a file that it includes"""
    faults = []
    included = write(folder, 'parts.h5', 'END\n')
    deck = read_text(FIRST)
    for name, text in (('job.lis', deck), ('job.json', deck), ('job.h5', deck),
                       ('parts.dat', deck.replace('\nFACES', '\nINCLUDE   parts.h5\nFACES'))):
        path = write(folder, name, text)
        ran = program.run('run', path, '-o', folder)
        faults += [f'{name}: {fault}' for fault in ran.crash()]
        if ran.code not in (2, 5):
            faults.append(f'{name}: expected exit code 2 or 5, found {ran.code}')
        if read_bytes(path) != text.encode() or read_bytes(included) != b'END\n':
            faults.append(f'{name}: the deck was overwritten')
    return faults


def deck_named_like_what_is_removed(program, folder):
    """Nor is a deck, or a file that it includes, taken for a state, a STOP file or what an earlier run did not complete"""
    faults = []
    deck = read_text(FIRST)
    for name in ('job.state', 'job.STOP', 'parts.state', 'parts.state.old', 'parts.STOP', 'parts.lis.host.1.tmp'):
        place = os.path.join(folder, name)
        included = name.startswith('parts')
        path = write(place, name, '! nothing\nEND\n' if included else deck)
        if included:
            write(place, 'parts.dat', deck.replace('\nFACES', f'\nINCLUDE   {name}\nFACES'))
        earlier = read_bytes(path)
        ran = program.run('run', os.path.join(place, 'parts.dat') if included else path, '-o', place)
        faults += [f'{name}: {fault}' for fault in failed(ran, 5, f'{name}, a file of the deck')]
        if not os.path.isfile(path) or read_bytes(path) != earlier:
            faults.append(f'{name}: it was changed')
    return faults


def link(folder):
    """Make a symbolic link to a file, and check in the end that the file is as it was"""
    target = write(folder, 'target', 'kept\n')
    return lambda path: os.symlink(target, path)


def file_size_limit(program, folder):
    """Each file in turn meets a limit on file sizes; earlier results stay"""
    faults = []
    earlier = EarlierResults(os.path.join(folder, 'results'), 'first')
    for size in (0, 1, 600, 4096, 100000, 260000):
        ran = program.run('run', FIRST, '-o', earlier.folder,
                          limits=[(resource.RLIMIT_FSIZE, size)])
        faults += [f'limit {size}: {fault}' for fault in failed(ran, 5, 'File too large')
                   + earlier.faults()]
    return faults


def full_disk(program, folder):
    """A small file system runs full: exit code 5, earlier results stay. It takes root to mount it;
    where that is not allowed the limit on file sizes has to do"""
    place = os.path.join(folder, 'disk')
    os.mkdir(place)
    script = '''
        mount -t tmpfs -o size=64k axijoint "$1" 2>/dev/null || exit 77
        for file in lis json h5; do echo earlier >"$1/first.$file"; done
        "$2" run "$3" -o "$1" >/dev/null
        status=$?
        ls "$1"
        cat "$1"/first.*
        exit $status'''
    ran = subprocess.run(['unshare', '-m', 'sh', '-c', script, 'sh', place, program.path, FIRST],
                         capture_output=True, text=True, env=program.environment, timeout=60,
                         check=False)
    if ran.returncode in (1, 77) and 'axijoint' not in ran.stderr:
        return []
    faults = expected('exit code', 5, ran.returncode)
    faults += expected('files', 'first.h5\nfirst.json\nfirst.lis\n' + 3*'earlier\n', ran.stdout)
    return faults + ([] if 'mend: ' in ran.stderr else [ran.stderr])


def memory(program, folder):
    """Whatever does not fit into the memory that is allowed, from the first card to the factor: one message"""
    deck = write(folder, 'large.dat', LARGE)
    earlier = EarlierResults(os.path.join(folder, 'results'), 'large')
    faults = []
    for limit in (100, 140, 180, 220, 260, 300, 350, 400, 450):
        ran = program.run('run', deck, '-o', earlier.folder, '--threads', '1',
                          limits=[(resource.RLIMIT_AS, limit*MEBIBYTE)])
        found = failed(ran, 6, 'out of memory') + earlier.faults()
        if ran.err.count('mend: ') != 1:
            found.append(ran.err)
        faults += [f'{limit} MiB: {fault}' for fault in found]
    return faults


def little_memory(program, folder):
    """A small job runs within the address space that the manual says, and a program with all checks, whose code is
    larger, within little more"""
    said = re.search(r'small job runs within (\d+) MiB on one thread and (\d+) MiB on two, `check` within (\d+)',
                     read_text(MANUAL))
    faults = []
    for words, limit in zip((['run', '--threads', '1'], ['run', '--threads', '2'], ['check']), said.groups()):
        ran = program.run(words[0], FIRST, *words[1:], *(['-o', folder] if words[0] == 'run' else []),
                          limits=[(resource.RLIMIT_AS, (int(limit) + 32)*MEBIBYTE)])
        faults += [f'{" ".join(words)}, {limit} MiB: {fault}' for fault in ran.ended_with(0)]
    return faults


def stack(program, folder):
    """The stack cannot grow"""
    deck = write(folder, 'job.dat', read_text(FIRST))
    faults = []
    for limit in (16, 24, 32, 48, 64, 96, 128, 256):
        ran = program.run('run', deck, '-o', folder, limits=[(resource.RLIMIT_STACK, limit*1024)])
        if ran.code not in (0, -11):  # -11: before the program begins, nobody can say anything
            faults += [f'{limit} kB: {fault}' for fault in failed(ran, 6, 'the stack')]
        elif ran.crash() and limit > 128:
            faults += ran.crash()
    return faults


def not_utf8(program, folder):
    """A comment that is not UTF-8 draws a warning, and all that is written is UTF-8"""
    deck = os.path.join(folder, 'old.dat')
    with open(deck, 'wb') as file:
        file.write(read_text(os.path.join(INPUTS, 'first.dat')).replace('\nLAWS', '\n! Stöße\nLAWS', 1).encode('latin-1'))
    ran = program.run('run', deck, '-o', folder)
    faults = ran.ended_with(0) + expected('warnings', 1, ran.err.count('a comment is not valid UTF-8'))
    for ending in ('lis', 'json'):
        with open(os.path.join(folder, f'old.{ending}'), encoding='utf-8') as file:
            text = file.read()
        faults += expected(f'{ending}: the comment', ending == 'lis', '! St??e' in text)
    return faults


def mended(program, folder):
    """The summary of an error goes when the mended deck has results of several combinations under names of their own; a file
    of somebody else's with that name stays"""
    deck = write(folder, 'job.dat', COMBINED.replace('COMBINE', 'COMBIN'))
    faults = program.run('run', deck, '-o', folder, folder=folder).ended_with(2)
    faults += expected('files of the error', ['job.dat', 'job.json'], sorted(os.listdir(folder)))
    write(folder, 'job.dat', COMBINED)
    faults += program.run('run', deck, '-o', folder, folder=folder).ended_with(0)
    results = [f'job.{label}.{ending}' for label in (10, 20) for ending in ('h5', 'json', 'lis')]
    faults += expected('files', [*results, 'job.dat'], sorted(os.listdir(folder)))
    write(folder, 'job.json', '{"status": "error"}')
    faults += program.run('run', deck, '-o', folder, folder=folder).ended_with(0)
    return faults + expected('files', sorted([*results, 'job.dat', 'job.json']), sorted(os.listdir(folder)))


def lost_output(program, folder):
    """What is meant for the screen finds no room, or nobody who takes it: exit code 5 whatever the command, and results as
    without that"""
    table = write(folder, 'table.csv', 'LAWS 1 PHI\n20\n')
    faults = expected('exit code', 0, program.run('run', FIRST, '-o', folder).code)
    for words in (['check', FIRST], ['run', FIRST, '-o', folder], ['study', table, FIRST, '-o', folder],
                  ['estimate', FIRST], ['compare', '--print-format'], ['help'], ['help', 'card'], ['help', '--man'], ['--version'],
                  ['compare', os.path.join(folder, 'first.lis'), os.path.join(folder, 'first.h5')]):
        name = ' '.join(words[:2])
        with open('/dev/full', 'wb') as full:
            ran = program.run(*words, stdout=full)
        faults += [f'{name}: {fault}' for fault in failed(ran, 5, 'the output for the screen could not be written: '
                                                           'No space left on device')]
        closed = subprocess.run(['sh', '-c', '"$@" >&-', 'sh', program.path, *words], capture_output=True, text=True,
                                env=program.environment, timeout=60, check=False)
        faults += [f'{name}: {fault}' for fault in expected('exit code without an output', 5, closed.returncode)]
        if 'Bad file descriptor' not in closed.stderr:
            faults.append(f'{name}: {closed.stderr}')
    left = subprocess.run(['sh', '-c', '("$@"; echo $? >&2) | :', 'sh', program.path, 'run', FIRST, '-o', folder],
                          capture_output=True, text=True, env=program.environment, timeout=60, check=False)
    return faults + expected('exit code when nobody reads', '0', left.stderr.strip())


def read_once(program, folder):
    """A run reads the folder of its results once, of one combination or of two: folders of large batches take long to read"""
    library = preload('counted_folders')
    faults = []
    for name, text in (('one', COMBINED.replace('20, 1, 1.0, 2, 1.0\n', '')), ('two', COMBINED)):
        deck, told = write(folder, f'{name}.dat', text), os.path.join(folder, 'times')
        results = os.path.join(folder, 'results')
        environment = dict(program.environment, LD_PRELOAD=library, FOLDER=results, TIMES_IN=told)
        for run in ('the first', 'the next'):
            subprocess.run([program.path, 'run', deck, '-o', results, '--quiet'], env=environment, check=True, capture_output=True, timeout=60)
            faults += expected(f'{name}: {run} run reads it', 1, int(read_text(told)))
    return faults


def tests(program):
    """One test a way to fail"""
    functions = {
        'no directory': missing, 'no directory can be made': not_made, 'a file for a directory': is_file,
        'read-only directory': read_only, 'file size limit': file_size_limit,
        'long name': long_name,
        'a deck named like a result': deck_named_like_a_result,
        'a deck named like what is removed': deck_named_like_what_is_removed,
        'full disk': full_disk, 'memory limit': memory, 'memory limit of small jobs': little_memory, 'stack limit': stack,
        'a comment that is not UTF-8': not_utf8, 'output that is lost': lost_output, 'a deck that was mended': mended,
        'a folder is read once': read_once,
        'directory for a file': lambda program, folder: occupied(program, folder, os.mkdir),
        'pipe for a file': lambda program, folder: occupied(program, folder, os.mkfifo),
    }

    def symbolic_link(folder):
        faults = occupied(program, folder, link(folder))
        return faults + expected('target', 'kept\n', read_text(os.path.join(folder, 'target')))

    return [Test('files: symbolic link for a file', symbolic_link)] + [
        Test(f'files: {name}', lambda folder, function=function: function(program, folder))
        for name, function in functions.items()]
