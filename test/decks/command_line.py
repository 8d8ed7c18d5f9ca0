"""Commands and options of the program"""
import os
import re
import subprocess

from support import HERE, INPUTS, Test, expected, read_text, write

FIRST = os.path.realpath(os.path.join(INPUTS, 'first.dat'))
# Arguments; exit code; words on standard output; words on standard error
CASES = (
    ((), 0, 'usage: axijoint COMMAND', ''),
    (('help',), 0, 'usage: axijoint COMMAND', ''),
    (('--help',), 0, 'usage: axijoint COMMAND', ''),
    (('help', 'run'), 0, '-o DIR', ''),
    (('help', 'check'), 0, 'usage: axijoint check DECK...', ''),
    (('help', 'card'), 0, '\n  NODES         nodes one by one\n', ''),
    (('help', 'card', 'nodes'), 0, 'NODES: nodes one by one (any number)\n\n  1–5 I    node\n', ''),
    (('help', 'card', 'NODES', '--markdown'), 0, '| 6–15 F | r [length] | | ≥ 0 |\n', ''),
    (('help', 'card', '--markdown'), 0, '| NODES | nodes one by one | any number |\n', ''),
    (('help', 'card', 'TITLE'), 0, 'TITLE: the next card', ''),
    (('help', 'help'), 0, 'usage: axijoint help card [NAME]', ''),
    (('help', 'card', 'FACE'), 2, '', "unknown card 'FACE'; did you mean FACES?\nknown: TITLE CONTROL "),
    (('help', 'card', 'QUADS'), 2, '', "unknown card 'QUADS'\nknown: TITLE CONTROL "),
    (('help', 'card', 'NODES', 'LINES'), 2, '', 'help on one card at a time'),
    (('help', 'card', 'NODES', '--html'), 2, '', "unknown option '--html'\nknown: --markdown"),
    (('run', '--help'), 0, '-o DIR', ''),
    (('--version',), 0, 'axijoint ', ''),
    (('check', FIRST), 0, 'first.dat: ok, 128 nodes, 96 elements, 8 joints', ''),
    (('check', FIRST, FIRST), 0, 'first.dat: ok', ''),
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
    (('run',), 2, '', 'no deck given'),
    (('check',), 2, '', 'no deck given'),
    (('run', FIRST, '-o'), 2, '', 'option -o needs a directory'),
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
    files = [file for file in os.listdir(folder) if file != '-x.json']
    return faults + expected('files', [], files)


def several_decks(program, folder):
    """One bad deck does not stop the rest; the exit code is the largest"""
    write(folder, 'bad.dat', 'TITLE\n')
    ran = program.run('run', 'bad.dat', FIRST, folder=folder)
    faults = ran.ended_with(2)
    return faults + expected('files', ['bad.dat', 'bad.json', 'first.h5', 'first.json',
                                       'first.lis'], sorted(os.listdir(folder)))


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
    return faults


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


def tests(program):
    """One test a command line"""
    functions = {'several decks': several_decks, 'lost output': output_lost,
                 'closed pipe': closed_pipe, 'decks of the manuals': documented_decks,
                 'decks of inputs': input_decks}
    return [Test('command line: ' + (' '.join(case[0]) or 'none'),
                 lambda folder, case=case: case_faults(program, folder, *case))
            for case in CASES] + [
        Test(f'command line: {name}', lambda folder, function=function: function(program, folder))
        for name, function in functions.items()]
