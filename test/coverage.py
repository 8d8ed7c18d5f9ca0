"""Prints what gcovr counted as a table, folder by folder, and holds it against its bars; see scripts/coverage."""
import collections
import json
import pathlib
import sys

MANUAL = pathlib.Path(__file__).resolve().parent.parent/'doc'/'testing.md'
BEGIN, END = '<!-- coverage -->\n', '<!-- /coverage -->\n'
# Least share of lines [percent]
BARS = {'joints': 95.0, 'solver': 95.0, 'element': 95.0, 'assembly': 95.0, 'deck': 95.0}


def counts(summary):
    """Lines, lines run, branches, branches taken of each folder of src, and of all"""
    folders = collections.defaultdict(lambda: [0, 0, 0, 0])
    for file in summary['files']:
        parts = pathlib.PurePosixPath(file['filename']).parts
        for name in (parts[1], 'all'):
            for i, key in enumerate(('line_total', 'line_covered', 'branch_total', 'branch_covered')):
                folders[name][i] += file[key]
    return folders


def share(part, whole):
    """Per cent"""
    return 100.0*part/whole if whole else 100.0


def table(folders):
    """The table, in the manual's way of writing"""
    lines = ['| folder of `src` | lines | run % | branches | taken % | bar |', '|---|---|---|---|---|---|']
    for name in sorted(folders, key=lambda name: (name == 'all', name)):
        line_total, line_run, branch_total, branch_taken = folders[name]
        bar = f'{BARS[name]:.0f}' if name in BARS else ''
        lines.append(f'| {name} | {line_total} | {share(line_run, line_total):.1f} | {branch_total} | '
                     f'{share(branch_taken, branch_total):.1f} | {bar} |')
    return '\n'.join(lines) + '\n'


def main(arguments):
    """Print, write to the manual, judge"""
    folders = counts(json.loads(pathlib.Path(arguments[0]).read_text(encoding='utf-8')))
    text = table(folders)
    print(text, end='')
    if '--manual' in arguments:
        manual = MANUAL.read_text(encoding='utf-8')
        before, after = manual.split(BEGIN)[0], manual.split(END)[1]
        MANUAL.write_text(before + BEGIN + text + END + after, encoding='utf-8')
    missed = [name for name, bar in BARS.items() if share(folders[name][1], folders[name][0]) < bar]
    if '--no-bars' in arguments:
        return 0
    for name in missed:
        print(f'MISSED: {name} has less than {BARS[name]:.0f} % of its lines run')
    return 1 if missed else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
