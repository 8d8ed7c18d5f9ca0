"""Commands and options of the program"""
import os
import re
import shutil
import subprocess
import sys

from support import HERE, INPUTS, Test, expected, preload, read_text, write

FIRST = os.path.realpath(os.path.join(INPUTS, 'first.dat'))
# Arguments; exit code; words on standard output; words on standard error
CASES = (
    ((), 0, 'usage: axijoint COMMAND', ''),
    (('help',), 0, 'usage: axijoint COMMAND', ''),
    (('--help',), 0, 'usage: axijoint COMMAND', ''),
    (('help', 'run'), 0, '-o DIR', ''),
    (('help', 'envelope'), 0, 'usage: axijoint envelope DECK --cases LIST [--directions N]', ''),
    (('help', 'check'), 0, 'usage: axijoint check DECK...', ''),
    (('help', 'card'), 0, '\n  NODES         nodes one by one\n', ''),
    (('help', 'card', 'nodes'), 0, 'NODES: nodes one by one (any number)\n\n  1–5 I    node\n', ''),
    (('help', 'card', 'NODES', '--markdown'), 0, '| 6–15 F | r [length] | | ≥ 0 |\n', ''),
    (('help', 'card', '--markdown'), 0, '| NODES | nodes one by one | any number |\n', ''),
    (('help', 'card', 'NODES', '--json'), 0, '"kind": "real", "card": 1, "columns": [6, 15], ', ''),
    (('help', 'card', 'PRINT'), 0, 'least r, least z, largest r, largest z of a rectangle', ''),
    (('help', 'card', 'TITLE'), 0, 'TITLE: the next card', ''),
    (('help', 'help'), 0, 'usage: axijoint help [COMMAND]', ''),
    (('help', '--man'), 0, '\n.SS compare\n', ''),
    (('help', '--completion', 'bash'), 0, '\ncomplete -o filenames -F _axijoint axijoint', ''),
    (('help', '--completion', 'zsh'), 0, '\nautoload -U +X bashcompinit', ''),
    (('help', '--completion', 'fish'), 2, '', "unknown shell 'fish'\nknown: bash zsh"),
    (('help', '--completion'), 2, '', "unknown shell ''\nknown: bash zsh"),
    (('help', 'card', 'FACE'), 2, '', "unknown card 'FACE'; did you mean FACES?\nknown: TITLE CONTROL "),
    (('help', 'card', 'QUADS'), 2, '', "unknown card 'QUADS'\nknown: TITLE CONTROL "),
    (('help', 'card', 'NODES', 'LINES'), 2, '', 'help on one card at a time'),
    (('help', 'card', 'NODES', '--html'), 2, '', "unknown option '--html'\nknown: --markdown --json"),
    (('run', '--help'), 0, '-o DIR', ''),
    (('--version',), 0, 'axijoint ', ''),
    (('check', FIRST), 0, 'first.dat: ok, 128 nodes, 96 elements, 8 joints', ''),
    (('check', FIRST, FIRST), 0, 'first.dat: ok', ''),
    (('check', '--quiet', FIRST), 0, '', ''),
    (('run', FIRST, '--quiet', '--verbose'), 2, '', 'only one of --quiet and --verbose'),
    (('run', FIRST, FIRST, '--processes', '0'), 2, '', "option --processes: found '0', allowed is a number from 1 on"),
    (('run', FIRST, FIRST, '--processes', '2'), 2, '', 'would write the same result files'),
    (('run', FIRST, '--quit'), 2, '', "unknown option '--quit'; did you mean --quiet?"),
    (('run', 'frist.dat'), 2, '', 'frist.dat: error: there is no such file'),
    (('run', '.', '-o', 'out'), 2, '', '.: error: this is a directory, not a file'),
    (('help', 'compare'), 0, 'Exit codes: 0 same; 1 different', ''),
    (('compare', 'a', '--help'), 0, 'usage: axijoint compare A B', ''),
    (('compare', '--print-format'), 0, 'HEADING TOTAL DISPLACEMENTS, theta = {theta}', ''),
    (('compare', FIRST), 2, '', 'two files are compared'),
    (('compare', FIRST, FIRST), 2, '', 'this is no listing of axijoint'),
    (('compare', FIRST, 'absent'), 2, '', 'this is no listing of axijoint'),
    (('compare', FIRST, FIRST, '--relativ', '1'), 2, '', "did you mean --relative?"),
    (('compare', FIRST, FIRST, '--worst', '-1'), 2, '', 'allowed is a number from 0'),
    (('compare', FIRST, FIRST, '--tolerance', 'u'), 2, '', 'NAME=RELATIVE,ABSOLUTE'),
    (('compare', FIRST, FIRST, '--relative', '-1'), 2, '', 'allowed is a number from 0'),
    (('compare', FIRST, FIRST, '--allow-missing', 'x'), 2, '', 'tables, columns, rows, all'),
    (('help', 'rum'), 2, '', "unknown command 'rum'; did you mean run?"),
    (('chek', FIRST), 2, '', "unknown command 'chek'; did you mean check?"),
    (('solve', FIRST), 2, '', "unknown command 'solve'"),
    ((FIRST,), 2, '', f'mend: axijoint run {FIRST} runs this file\n'),
    (('run',), 2, '', 'no deck given'),
    (('check',), 2, '', 'no deck given'),
    (('run', FIRST, '-o'), 2, '', 'option -o needs DIR'),
    (('run', FIRST, '-o', '--quiet'), 2, '', "option -o needs DIR, found '--quiet', which is an option itself\n"
     'mend: a folder of this name is ./--quiet\n'),
    (('run', FIRST, '--threads', '--'), 2, '', "option --threads needs N, found '--', which is an option itself\n"),
    (('run', FIRST, '--solver', '-h'), 2, '', "option --solver needs NAME, found '-h', which is an option itself\n"),
    (('envelope', FIRST, '--cases', '-o', 'out'), 2, '', "option --cases needs LIST, found '-o', which is an option itself\n"),
    (('estimate', '--study', '--slurm', FIRST), 2, '', 'mend: a file of this name is ./--slurm\n'),
    (('compare', FIRST, FIRST, '--skip', '--worst', '3'), 2, '', "option --skip needs NAME, found '--worst', which is an option itself"),
    (('compare', FIRST, FIRST, '--format-a', '--exact-digits'), 2, '', 'mend: a file of this name is ./--exact-digits\n'),
    (('run', FIRST, '-o', ''), 2, '', 'option -o has an empty value'),
    (('estimate', FIRST, '--iterations', '0'), 2, '', "option --iterations: found '0', allowed is"),
    (('estimate', FIRST, '--estimates'), 2, '', 'options --estimates and --part go with --study TABLE'),
    (('study', FIRST, 'rows.csv'), 2, '', 'the table comes first, then the deck; use: axijoint study rows.csv '),
    (('estimate', FIRST, FIRST, '--study', 'rows.csv'), 2, '', 'a study has one table and one deck; use: axijoint estimate'),
    (('estimate', FIRST, '--study', 'rows.csv'), 2, '', 'rows.csv: error: there is no such file'),
    (('run', FIRST, '--fast'), 2, '', "unknown option '--fast'"),
    (('check', FIRST, '-o', '.'), 2, '', "unknown option '-o'"),
    (('run', '--', '-x.dat'), 2, '', '-x.dat: error: there is no such file'),
    (('run', FIRST, './first.dat'), 2, '', 'would write the same result files'),
)


def case_faults(program, folder, arguments, code, out, err):
    """Run with arguments in an empty folder, which must stay so"""
    ran = program.run(*arguments, folder=folder)
    faults = ran.ended_with(code)
    for words, text in ((out, ran.out), (err, ran.err)):
        if words not in text or bool(words) != bool(text):
            faults.append(f'expected {words!r}, found {text!r}')
    return faults + expected('files', [], os.listdir(folder))


def folder_like_an_option(program, folder):
    """A folder called like an option is made where its name is written so"""
    ran = program.run('run', FIRST, '-o', './--quiet', '--quiet', folder=folder)
    return ran.ended_with(0) + expected('files', ['--quiet'], os.listdir(folder))


def several_decks(program, folder):
    """One bad deck does not stop the rest; the exit code is the largest"""
    write(folder, 'bad.dat', 'TITLE\n')
    ran = program.run('run', 'bad.dat', FIRST, folder=folder)
    faults = ran.ended_with(2)
    return faults + expected('files', ['bad.dat', 'bad.json', 'first.h5', 'first.json',
                                       'first.lis'], sorted(os.listdir(folder)))


def piped(program, folder, text, *arguments):
    """Run with a text as standard input"""
    return subprocess.run([program.path, *arguments], input=text, cwd=folder, text=True,
                          env=program.environment, capture_output=True, check=False, timeout=60)


def standard_input(program, folder):
    """The deck -: its files and messages are called stdin, includes begin at the current folder, and
    a refined job is read again though its text comes only once"""
    deck = read_text(FIRST)
    ran = piped(program, folder, deck, 'run', '-', '-o', 'out')
    faults = expected('exit code', 0, ran.returncode) + expected(
        'files', ['stdin.h5', 'stdin.json', 'stdin.lis'],
        sorted(os.listdir(os.path.join(folder, 'out'))))
    if not re.search(r'^deck +stdin$', ran.stdout, re.M):
        faults.append(f'the deck is not called stdin:\n{ran.stdout}')
    lines = deck.split('\n')
    write(folder, 'part.dat', '\n'.join(lines[4:6] + ['END', '']))
    split = '\n'.join(lines[:4] + ['INCLUDE   part.dat'] + lines[6:])
    for text, command, code, words in (
            (split, 'check', 0, 'stdin: ok, 128 nodes'), (deck, 'estimate', 0, 'stdin: 1538 unknowns in 5 harmonics'),
            (deck.replace('END', 'ERROR\n      5.0\nEND'), 'run', 0, 'stdin'),
            ('', 'run', 2, 'stdin: error: nothing came from the standard input'),
            (deck.replace('LAT', 'LOT'), 'check', 2, 'stdin:24:6-15: error: the kind of')):
        ran = piped(program, folder, text, command, '-')
        faults += expected(f'exit code of {command}', code, ran.returncode)
        if words not in ran.stdout + ran.stderr:
            faults.append(f'expected {words!r}, found\n{ran.stdout}{ran.stderr}')
    return faults


def quiet(program, folder):
    """--quiet: no word of a run that converges; of one that does not, on the error output alone"""
    ran = program.run('run', FIRST, '--quiet', folder=folder)
    faults = ran.ended_with(0) + expected('output', '', ran.out + ran.err)
    faults += expected('files', ['first.h5', 'first.json', 'first.lis'], sorted(os.listdir(folder)))
    deck = read_text(FIRST).replace('END', 'INCREMENTS\n       1.0              1\nEND')
    ran = program.run('run', write(folder, 'one.dat', deck), '--quiet', folder=folder)
    faults += ran.ended_with(3) + expected('output', '', ran.out)
    if 'one.dat: *** NOT CONVERGED ***' not in ran.err or '\nINCREMENTS allows no more iterations\n' not in ran.err:
        faults.append(f'the end is not told:\n{ran.err}')
    return faults


def reason(program, folder):
    """Without equilibrium the lines on the terminal say why"""
    deck = read_text(FIRST).replace('END', 'INCREMENTS\n       1.0              1\nEND')
    ran = program.run('run', write(folder, 'one.dat', deck), folder=folder)
    faults = ran.ended_with(3)
    if not re.search(r'^reason +INCREMENTS allows no more iterations$', ran.out, re.M):
        faults.append(f'no reason is told:\n{ran.out}')
    return faults


def verbose(program, folder):
    """--verbose: a line at each stage with the time since the start, in printing characters"""
    ran = program.run('run', FIRST, '--verbose', folder=folder)
    faults = ran.ended_with(0)
    stages = re.findall(r'^axijoint: \d+:\d\d:\d\d (\w+) .*\n', ran.err, re.M)
    faults += expected('stages', ['reading', 'assembling', 'factoring', 'condensing', 'increment'],
                       stages)
    if re.search(r'[^ -~\n]', ran.err):
        faults.append(f'found control characters: {ran.err!r}')
    return faults


def environment(program, folder):
    """What libraries are told of the environment is what scripts/environment sets, and what the user has
    set stays"""
    if not sys.platform.startswith('linux'):
        return []
    names = ('OMP_WAIT_POLICY', 'GOMP_SPINCOUNT', 'OPENBLAS_NUM_THREADS', 'OPENBLAS_CORETYPE')
    bare = {name: value for name, value in program.environment.items() if name not in names}
    script = os.path.join(HERE, '..', '..', 'scripts', 'environment')
    faults, library = [], preload('told_environment')
    for given, words in [({'OMP_WAIT_POLICY': 'ACTIVE', 'OPENBLAS_CORETYPE': 'HASWELL'}, ['--version']),
                         ({'OPENBLAS_NUM_THREADS': '', 'GOMP_SPINCOUNT': '7'}, ['--version']), ({}, ['--version']),
                         ({}, ['run', 'missing.dat'])]:
        printed = subprocess.run(['bash', '-c', f'. "{script}"; env'], env=bare | given, text=True,
                                 capture_output=True, check=True).stdout
        wanted = sorted(line for line in printed.split('\n') if line.split('=')[0] in names)
        told = subprocess.run([program.path, *words], env=bare | given | {'LD_PRELOAD': library}, cwd=folder, text=True,
                              capture_output=True, check=False).stderr
        found = sorted(line for line in told.split('\n') if line.split('=')[0] in names)
        faults += expected(f'environment of {words[0]} with {given}', wanted, found)
    return faults


def completed(program, folder):
    """Completion in bash: commands, options, words that are their values, cards, files"""
    write(folder, 'pile.dat', '')
    source = program.run('help', '--completion', 'bash').out
    faults = []
    for words, found in ((('axijoint', 'es'), 'estimate'), (('axijoint', 'run', '--q'), '--quiet'),
                         (('axijoint', 'run', '--solver', 's'), 'skyline sparse'),
                         (('scripts/run', '--verb'), '--verbose'),
                         (('axijoint', 'help', 'card', 'BLO'), 'BLOCKS'),
                         (('axijoint', 'run', 'pi'), 'pile.dat')):
        script = source + f"""
COMP_WORDS=({' '.join(words)}); COMP_CWORD={len(words) - 1}; _axijoint {words[0]}
echo "${{COMPREPLY[*]}}"
"""
        ran = subprocess.run(['bash', '-c', script], cwd=folder, capture_output=True, text=True,
                             check=False)
        faults += expected(' '.join(words), found, ran.stdout.replace('\n', ' ').strip())
    return faults


def manual_page(program, folder):
    """groff, where it is, has nothing to say against the manual page"""
    if not shutil.which('groff'):
        return []
    path = write(folder, 'axijoint.1', program.run('help', '--man').out)
    ran = subprocess.run(['groff', '-man', '-Tascii', '-ww', path], capture_output=True, text=True,
                         check=False)
    return expected('warnings', '', ran.stderr)


def output_lost(program, folder):
    """Standard output closed, or on a full disk: no crash, and the files are whole"""
    faults = []
    for redirection in ('>/dev/full', '>&-', '2>&-', '>&- 2>&- <&-', '>/dev/full 2>/dev/full'):
        for command in ('--version', 'help run', f'check {FIRST}', f'run {FIRST} -o .'):
            ran = subprocess.run(f'"{program.path}" {command} {redirection}', shell=True,
                                 cwd=folder, env=program.environment, stderr=subprocess.PIPE,
                                 stdout=subprocess.PIPE, text=True, check=False, timeout=60)
            if ran.returncode not in (0, 5) or re.search('Backtrace|Fortran', ran.stderr):
                faults.append(f'{command} {redirection}: exit code {ran.returncode}\n{ran.stderr}')
        text = read_text(os.path.join(folder, 'first.lis'))
        if not text.startswith('=====') or 'END OF LISTING' not in text[-40:]:
            faults.append(f'{redirection}: the listing is not whole')
        os.remove(os.path.join(folder, 'first.lis'))
    return faults


def closed_pipe(program, folder):
    """Nobody reads the standard output: no crash, and the files are whole"""
    ran = subprocess.run(f'"{program.path}" run {FIRST} -o . | true', shell=True, cwd=folder,
                         env=program.environment, stderr=subprocess.PIPE, text=True, check=False,
                         timeout=60)
    faults = expected('files', ['first.h5', 'first.json', 'first.lis'], sorted(os.listdir(folder)))
    if re.search('Backtrace|Fortran', ran.stderr):
        faults.append(f'found a crash\n{ran.stderr}')
    bad = write(folder, 'bad.dat', 'TITLE\n')
    for command, code in ((f'check {FIRST} {bad}', 2), ('help card', 0), (f'estimate {FIRST} {bad}', 2)):
        reader, writer = os.pipe()
        os.close(reader)
        ran = subprocess.run([program.path, *command.split()], cwd=folder, env=program.environment, stdout=writer, stderr=subprocess.PIPE,
                             check=False, timeout=60)
        os.close(writer)
        faults += expected(f'exit code of {command}', code, ran.returncode)
    return faults


def longer_names(program, folder):
    """Results of combinations and of swept joints have longer names than their deck: none replaces those of another deck of the call"""
    faults = []
    first = read_text(FIRST)
    combined = first.replace('RESULTANTS', 'CASE\n1, all\nRESULTANTS').replace('\nEND', '\nCOMBINE\n1, 1, 1.0\n2, 1, 0.5\nEND')
    for decks, options in ((('job.dat', 'job.1.dat'), ()), (('job.1.dat', 'job.dat'), ()), (('swept.dat', 'swept.joints.dat'), ('--vtk',))):
        for name in decks:
            write(folder, name, combined if name == 'job.dat' else first)
        ran = program.run('run', *decks, '--quiet', *options, folder=folder)
        faults += ran.ended_with(2) + ([] if 'results would be written to files of' in ran.err else [ran.err])
    return faults + program.run('run', 'swept.dat', 'swept.joints.dat', '--quiet', folder=folder).ended_with(0)


def documented_decks(program, folder):
    """The decks of the manuals pass the check without a warning"""
    faults = []
    for manual in ('doc/deck.md', 'README.md'):
        text = read_text(os.path.join(HERE, '..', '..', manual))
        decks = re.findall(r'^```deck\n(.*?)^```', text, re.M | re.S)
        decks += [re.sub('^    ', '', deck, flags=re.M)
                  for deck in re.findall(r'^    TITLE\n(?:    .*\n)+', text, re.M)]
        if not decks:
            faults.append(f'{manual} has no deck')
        for deck in decks:
            checked = program.run('check', write(folder, 'job.dat', deck))
            faults += checked.ended_with(0) + expected(manual, '', checked.err)
    return faults


def input_decks(program, _):
    """The decks for users pass the check without a warning"""
    decks = [os.path.join(INPUTS, name) for name in sorted(os.listdir(INPUTS))
             if name.endswith('.dat')]
    checked = program.run('check', *decks)
    return checked.ended_with(0) + expected('warnings', '', checked.err)


def values_of_options(program, _):
    """`scripts/run` takes no value of an option for a deck: it knows all options of `run` that have one"""
    usage = program.run('help', 'run').out.split('\n\n')[0]
    wanted = sorted(re.findall(r'\[(--?[a-z]+) [A-Z]', usage))
    known = re.search(r'^ *(-o .*)\) value_follows=true', read_text(os.path.join(HERE, '..', '..', 'scripts', 'run')), re.M)
    return expected('options with a value', wanted, sorted(known.group(1).split(' | ')))


def tests(program):
    """One test a command line"""
    functions = {'several decks': several_decks, 'lost output': output_lost,
                 'closed pipe': closed_pipe, 'longer names': longer_names,
                 'standard input': standard_input, '--quiet': quiet, '--verbose': verbose,
                 'environment': environment, 'completion': completed, 'manual page': manual_page, 'decks of the manuals': documented_decks,
                 'decks of inputs': input_decks, 'values of options': values_of_options,
                 'folder like an option': folder_like_an_option}
    return [Test('command line: ' + (' '.join(case[0]) or 'none'),
                 lambda folder, case=case: case_faults(program, folder, *case))
            for case in CASES] + [
        Test(f'command line: {name}', lambda folder, function=function: function(program, folder))
        for name, function in functions.items()]
