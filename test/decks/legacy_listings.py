"""Listings of Owen and Hinton's program: what --listing prints against a small program of its own and closed forms, and what
`axijoint compare` makes of such listings, of altered ones, too"""
import json
import math
import os
import random
import re
import subprocess

import legacy_scenes as scenes
from support import HERE, INPUTS, Test, python_with, read_text, write

FLAG = ('--legacy', 'owen-hinton')
LISTING = ('--listing', 'owen-hinton')
# The states of yielding bodies are found by other iterations, which end at other residuals; where a deck is near its collapse
# these move it more
ALIKE, NEAR_COLLAPSE = ('--relative', '2E-5', '--of-table', '1E-6'), ('--relative', '2E-3', '--of-table', '1E-4')
# Increments that the small program is asked for: those below collapse
BELOW_COLLAPSE = {'disc.dat': 3, 'plate.dat': 2}


def printed(program, folder, name, text, code=0, options=FLAG):
    """Run a deck: path and lines of its old listing"""
    ran = program.run('run', '--quiet', *options, *LISTING, write(folder, f'{name}.dat', text), '-o', folder)
    faults = ran.ended_with(code)
    if faults:
        raise AssertionError('\n'.join(faults))
    path = os.path.join(folder, f'{name}.owen-hinton.lis')
    return path, read_text(path).split('\n')


def tables(lines):
    """Increments of a listing: displacements, reactions by node; stresses by element and point"""
    found, kind, element = [], None, 0
    for line in lines:
        if 'INCREMENT NUMBER' in line:
            found.append(({}, {}, {}))
            kind = None
        elif 'R-DISP' in line or 'R-REAC' in line or 'RR-STRESS' in line:
            kind = 0 if 'R-DISP' in line else 1 if 'R-REAC' in line else 2
        elif 'ELEMENT NO' in line:
            element = int(line.split('=')[1])
        elif line.startswith('0'):
            kind = None
        elif kind == 2 and line:
            found[-1][2][element, int(line[:5])] = [line[7 + 14*i:21 + 14*i] for i in range(6)] + [line[91:99], line[99:113]]
        elif kind is not None and line:
            found[-1][kind][int(line[:10])] = [line[10:24], line[24:38]]
    return found


def exponential(value):
    """E14.6"""
    if value == 0:
        return '  0.000000E+00'
    digits, power = f'{abs(value):.5E}'.split('E')
    return f'{"-" if value < 0 else ""}0.{digits.replace(".", "")}E{int(power) + 1:+03d}'.rjust(14)


def last_digit(text):
    """One unit of the last digit of a number in E14.6"""
    return 10.0**(int(text[-3:]) - 6)


def places(text):
    """Places of the nodes with numbers, of the Gauss points by element and point, of an 8-node deck with straight sides in
    rows: r alone, since they are rectangles"""
    lines = text.split('\n')
    n_nodes, n_elements, *_, = (int(v) for v in lines[1].split())
    gauss = int(lines[1].split()[6])
    elements = [[int(v) for v in line.split()] for line in lines[2:2 + n_elements]]
    r = {}
    for line in lines[2 + n_elements:]:
        r[int(line[:5])] = float(line[5:15])
        if int(line[:5]) == n_nodes:
            break
    points = {}
    steps = (-1/math.sqrt(3), 1/math.sqrt(3)) if gauss == 2 else (-math.sqrt(0.6), 0.0, math.sqrt(0.6))
    for number, _, *nodes in elements:
        first, last = r[nodes[0]], r[nodes[2]]
        for i, k in enumerate((1, 5)):
            r.setdefault(nodes[k], (first + last)/2)
        for k in (3, 7):
            r.setdefault(nodes[k], r[nodes[(k + 1) % 8]])
        for i, step in enumerate(steps):
            for j in range(gauss):
                points[number, i*gauss + j + 1] = (first + last)/2 + step*(last - first)/2
    return r, points


def off(where, wanted, text, units=1):
    """A fault unless a printed number is the wanted one to so many units of its last digit"""
    text_wanted = exponential(wanted)
    if abs(float(text) - float(text_wanted)) <= (units + 0.01)*last_digit(text_wanted):
        return []
    return [f'{where}: expected {text_wanted}, found {text}']


def lame(program, folder, criterion):
    """The thick cylinder while it is elastic: every displacement and stress as printed, to one unit of the last digit"""
    text = scenes.cylinder(criterion, (8.0,), 10.0 if criterion > scenes.MISES else scenes.YIELD,
                           30.0 if criterion > scenes.MISES else 0.0, n=128)
    _, lines = printed(program, folder, 'lame', text)
    (displacement, _, stress), = tables(lines)
    if criterion > scenes.MISES:
        # the same deck, stronger: elastic at this pressure
        _, lines = printed(program, folder, 'strong', scenes.cylinder(criterion, (8.0,), 40.0, 30.0, n=128))
        (displacement, _, stress), = tables(lines)
    r, points = places(text)
    p, nu = 8.0/3, scenes.POISSON
    faults = [fault for k, (u, _) in displacement.items()
              for fault in off(f'u of node {k}', (1 + nu)*p/scenes.YOUNG*((1 - 2*nu)*r[k] + 4/r[k]), u)]
    for key, values in stress.items():
        x = points[key]
        for name, k, wanted in (('RR', 0, p*(1 - 4/x**2)), ('ZZ', 1, 2*nu*p), ('TT', 3, p*(1 + 4/x**2))):
            faults += off(f'{name} at {key}', wanted, values[k])
        if float(values[7]) != 0:
            faults.append(f'plastic strain at {key} of an elastic state: {values[7]}')
    return faults[:5] + ([] if len(displacement) == 643 and len(stress) == 512 else ['not all was printed'])


def hill(program, folder):
    """Tresca's cylinder under p = 14: the plastic radius c by Hill; outside it Lame's stresses of the ring"""
    text = scenes.DECKS['cylinder_tresca.dat']
    _, lines = printed(program, folder, 'hill', text)
    stress = tables(lines)[1][2]
    points = places(text)[1]
    low, high = 1.0, 2.0
    for _ in range(80):
        c = (low + high)/2
        low, high = (c, high) if scenes.YIELD*(math.log(c) + (1 - c*c/4)/2) < 14.0 else (low, c)
    worst = 0.0
    for key, values in stress.items():
        x = points[key]
        if x < c + 1/128:
            if x < c - 1/128 and not float(values[7]) > 0:
                return [f'{key} at r = {x} has not yielded']
            continue
        if float(values[7]) != 0:
            return [f'{key} at r = {x} has yielded']
        k = scenes.YIELD*c*c/8
        worst = max(worst, abs(float(values[0]) - k*(1 - 4/x**2))/scenes.YIELD, abs(float(values[3]) - k*(1 + 4/x**2))/scenes.YIELD)
    return [] if worst < 2e-5 else [f'stresses of the elastic ring are off by {worst:.2e} of the yield stress']


def sphere_lame(program, folder):
    """The thick sphere while it is elastic, 24 by 16 elements: displacements to the digits of the largest, stresses to three"""
    text = scenes.sphere(scenes.MISES, (12.0,), n=16, gauss=3)
    _, lines = printed(program, folder, 'lame', text)
    displacement = tables(lines)[0][0]
    nu, p = scenes.POISSON, 12.0
    place = {int(line[:5]): (float(line[5:15]), float(line[15:25])) for line in text.split('\n')[2 + 384:2 + 384 + 1233]}
    largest = p/(scenes.YOUNG*7)*((1 - 2*nu) + (1 + nu)*4)
    worst = 0.0
    for node, values in displacement.items():
        r, z = place[node]
        radius = math.hypot(r, z)
        u = radius*p/(scenes.YOUNG*7)*((1 - 2*nu) + (1 + nu)*4/radius**3)
        worst = max(worst, abs(float(values[0]) - u*r/radius), abs(float(values[1]) - u*z/radius))
    return [] if worst <= 2e-6*largest else [f'displacements are off by {worst/largest:.2e} of the largest']


def sphere_friction(program, folder, name):
    """Mohr and Coulomb, Drucker and Prager in a sphere: the same, equilibrium of the plastic part by a power of r, outside it
    Lame's ring; the displacement of the outer side"""
    _, lines = printed(program, folder, 'sphere', scenes.DECKS[name])
    displacement = tables(lines)[2][0]
    sine, cosine, cohesion, p, b, nu = 0.5, math.cos(math.radians(30)), 10.0, 14.0, 2.0, scenes.POISSON
    head, power = cohesion*cosine/sine, 4*sine/(1 + sine)

    def outside(c):  # pressure on the ring outside c that makes it yield there
        k = b**3/c**3
        return 2*cohesion*cosine*(k - 1)/((1 + sine)*(k/2 + 1) + (1 - sine)*(k - 1))
    low, high = 1.0, 1.9999
    for _ in range(80):
        c = (low + high)/2
        low, high = (c, high) if (outside(c) + head)*c**power - head < p else (low, c)
    wanted = outside(c)*c**3*b/(scenes.YOUNG*(b**3 - c**3))*1.5*(1 - nu)
    found = max(float(u) for u, _ in list(displacement.values())[-17:])
    return [] if 1.01 < c < 1.9 and abs(found - wanted) < 1e-3*wanted else [f'u(b): expected {wanted:.6g} (c = {c:.4f}), found {found:.6g}']


def disc(program, folder):
    """A turning disc: Timoshenko's stresses away from the rim, and rho omega^2 b^2 = 3 sigma_y when all of it yields"""
    text = scenes.DECKS['disc.dat']
    _, lines = printed(program, folder, 'disc', text, 4)
    found = tables(lines)
    points = places(text)[1]
    nu, half, load = scenes.POISSON, 0.05, 50.0
    extra = nu*(1 + nu)/(6*(1 - nu))
    faults = []
    for (element, point), values in found[0][2].items():
        r, z = points[element, point], 0.025*(1 + (-math.sqrt(0.6), 0.0, math.sqrt(0.6))[(point - 1) % 3])
        if r > 0.8:
            continue
        across = extra*(half**2 - 3*z*z)
        for k, wanted in ((0, (3 + nu)/8*(1 - r*r) + across), (3, (3 + nu)/8 - (1 + 3*nu)/8*r*r + across)):
            if abs(float(values[k]) - load*wanted) > 1e-3*load*0.4:
                faults.append(f'stress {k} at r = {r:.4f}: expected {load*wanted:.6g}, found {values[k]}')
    summary = json.loads(read_text(os.path.join(folder, 'disc.json')))
    factors = [increment['load_factor'] for increment in summary['increments']]
    if not 71.0 <= factors[-1] <= 72.72:
        faults.append(f'full plastic speed: expected 72, found {factors[-1]}')
    return faults[:5]


def against(program, folder, name):
    """The listing of a deck against that of the small program, and axijoint's results against it"""
    python = python_with('numpy')
    if python is None:
        return []
    text = scenes.DECKS[name].replace('   0.01000   50', '   0.00001   50')
    path, _ = printed(program, folder, 'new', text, 4 if name in BELOW_COLLAPSE else 0)
    other = os.path.join(folder, 'small.lis')
    # plain names of modules: the small program is not installed
    done = subprocess.run([python, '-c', 'import sys; sys.path.insert(0, sys.argv[1]); import old_program as p; '
                           'd = p.Deck(open(sys.argv[2]).read()); '
                           's = p.solve(d, int(sys.argv[4])); open(sys.argv[3], "w").write(p.listing(d, s))',
                           HERE, os.path.join(folder, 'new.dat'), other, str(BELOW_COLLAPSE.get(name, 99))],
                          capture_output=True, text=True, check=False,
                          env=dict(os.environ, OPENBLAS_NUM_THREADS='1'))
    if done.returncode:
        return [done.stderr[-500:]]
    options = NEAR_COLLAPSE if name in ('footing.dat', 'plate.dat', 'disc.dat') else ALIKE
    if name in BELOW_COLLAPSE:
        options += ('--allow-missing', 'tables')
    faults = []
    for one in (path, os.path.join(folder, 'new.h5')):
        ran = program.run('compare', one, other, *options)
        n = int(re.search(r'(\d+) tables?, ', ran.out.split('\n')[-2] if ran.out else '0 tables, ').group(1))
        if ran.code != 0 or n < 3*BELOW_COLLAPSE.get(name, 2):
            faults.append(f'{os.path.basename(one)}, exit code {ran.code}\n' + ran.err[:500] + '\n'.join(
                line for line in ran.out.split('\n') if 'differs' in line or 'only in' in line or ':' in line[:12])[:1500])
    return faults


def same_listing(program, folder):
    """The deck that `convert` writes prints the same listing, and so does the run without --legacy"""
    deck = scenes.cylinder(scenes.MISES, (8.0, 4.0)).replace('    3    3\n', '    0    1\n', 1)
    _, lines = printed(program, folder, 'old', deck)
    new = os.path.join(folder, 'new.dat')
    faults = program.run('convert', os.path.join(folder, 'old.dat'), new).ended_with(0)
    _, again = printed(program, folder, 'new', read_text(new), options=())
    first, second = tables(lines)
    if [bool(part) for part in first] != [True, False, False] or [bool(part) for part in second] != [True]*3:
        faults.append('NOUTP is not heeded')
    return faults + ([] if lines == again else ['the listings differ'])


def no_room(program, folder):
    """Numbers without room in their fields: asterisks as in the old program, told at the end and in the warnings"""
    deck = scenes.cylinder(scenes.MISES, (20000.0,)).replace('     1.000     0.000', '    0.0004     0.000')
    _, lines = printed(program, folder, 'wide', deck)
    faults = [] if any(line.startswith('0     LOAD FACTOR =**********') for line in lines) else ['no asterisks']
    told = next((k for k, line in enumerate(lines) if 'VALUES WITHOUT ROOM IN THEIR FIELDS: 1' in line), 0)
    factor = next((k for k, line in enumerate(lines) if 'LOAD FACTOR' in line), 0)
    if not told or lines[told + 1].strip() != f'LINE {factor + 1}, FROM COLUMN 20: 20000':
        faults.append('not told at the end: ' + ' '.join(lines[-3:]))
    summary = json.loads(read_text(os.path.join(folder, 'wide.json')))
    if '1 value without room' not in json.dumps(summary):
        faults.append('no warning')
    return faults + program.run('compare', os.path.join(folder, 'wide.owen-hinton.lis'), os.path.join(folder, 'wide.h5')).ended_with(0)


def refused(program, folder):
    """Jobs that the layout has no place for, before anything is solved; wrong words"""
    faults = []
    ran = program.run('run', *LISTING, os.path.join(INPUTS, 'first.dat'), '-o', folder)
    faults += ran.ended_with(2) + ([] if 'has no place' in ran.err else [ran.err[:500]])
    ring = ('TITLE\n\nCONTROL\n    1\nMATERIALS\n    1    1.0E5       0.2       0.0\nNODES\n    1       1.0       0.0\n'
            '    2       2.0       0.0\n    3       2.0       1.0\n    4       1.0       1.0\nELEMENTS\n    1    1    1    1    2    3    4\n'
            'RESTRAINTS\n    1  111\n    2  111\nRINGLOADS\n    4    1       1.0\nEND\n')
    triangle = ring.replace('    1    1    1    1    2    3    4', '    1    1    1    1    2    3\n    2    1    1    1    3    4')
    triangle = triangle.replace('    4    1       1.0', '    4    0       1.0')
    for text, words in ((ring, 'other harmonics than 0'), (triangle, 'triangles')):
        ran = program.run('run', *LISTING, write(folder, 'job.dat', text), '-o', folder)
        faults += ran.ended_with(2) + ([] if words in ran.err else [f'expected {words}\n{ran.err[:500]}'])
    if any(name.endswith(('.h5', '.lis')) for name in os.listdir(folder)):
        faults.append('files of a refused job')
    # its name is taken: none of the files appears
    os.mkdir(os.path.join(folder, 'taken.owen-hinton.lis'))
    ran = program.run('run', *FLAG, *LISTING, write(folder, 'taken.dat', scenes.DECKS['column.dat']), '-o', folder)
    faults += ran.ended_with(5) + ([] if 'is a directory' in ran.err else [ran.err])
    faults += ['files beside a name that is taken'] if os.path.exists(os.path.join(folder, 'taken.h5')) else []
    ran = program.run('run', '--listing', 'adina', 'job.dat')
    return faults + ran.ended_with(2) + ([] if 'owen-hinton' in ran.err else [ran.err])


# ---- altered listings

def number_fields(lines):
    """Numbers of results that are no rounding: line, first column, last, and whether it stands in E14.6"""
    found, kind = [], None
    for k, line in enumerate(lines):
        if 'R-DISP' in line or 'R-REAC' in line or 'RR-STRESS' in line:
            kind = line.split()[-1]
        elif line.startswith('0'):
            kind = kind if 'ELEMENT NO' in line else None
        elif kind and line:
            fields = [(10, 24), (24, 38)] if 'S.' not in kind else [(7 + 14*i, 21 + 14*i) for i in range(6)] + [(99, 113)]
            found += [(k, *field, True) for field in fields]
            if 'S.' in kind:
                found.append((k, 91, 99, False))
    return [(k, a, b, e) for k, a, b, e in found if abs(float(lines[k][a:b])) > 1e-4]


WAYS = (
    # what is done to a number in E14.6, and whether it is then another one
    ('D for E', False, lambda t: t.replace('E', 'D')),
    ('no letter', False, lambda t: re.sub(r'E([+-])', r'\g<1>0', t)),
    ('blank for the sign of the exponent', False, lambda t: t.replace('E+', 'E ')),
    ('more digits', False, lambda t: t.replace('E', '0E')[1:] if t.startswith(' ') else t),
    ('another sign', True, lambda t: (t.replace('-0.', ' 0.') if '-0.' in t else t.replace(' 0.', '-0.'))),
    ('ten times', True, lambda t: t[:-2] + f'{(int(t[-3:]) + 1) % 100:02d}' if t[-3] == '+' else t[:-3] + '+02'),
    ('third digit', True, lambda t: t[:6] + '0123456789'[(int(t[6]) + 5) % 10] + t[7:]),
    ('last digit by five', True, lambda t: t[:9] + '0123456789'[(int(t[9]) + 5) % 10] + t[10:]),
    ('asterisks', True, lambda t: '*'*14),
    ('smallest', True, lambda t: '  0.123457-101'),
)


def altered(program, folder):
    """40 numbers of a listing, altered in ten ways: all of a way at once, and each alone; as many differ as were altered"""
    path, lines = printed(program, folder, 'base', scenes.DECKS['cylinder_mohr.dat'])
    chooser = random.Random(20)
    wide = [field for field in number_fields(lines) if field[3]]
    rows = {}
    for field in wide:
        rows.setdefault(field[0], field)
    chosen = chooser.sample(sorted(rows.values()), 40)
    faults = []

    def judged(name, fields, change, n_wanted, count=None):
        new = list(lines)
        for k, a, b, _ in fields:
            new[k] = new[k][:a] + change(new[k][a:b]) + new[k][b:]
            if (new[k] == lines[k]):
                faults.append(f'{name}: nothing altered in {lines[k]}')
        ran = program.run('compare', path, write(folder, 'altered.lis', '\n'.join(new)))
        found = re.search(r'(\d+) differ', ran.out)
        n = int(found.group(1)) if found else -1
        if n != n_wanted or ran.code != (1 if n_wanted or count else 0):
            faults.append(f'{name}, {len(fields)} numbers: expected {n_wanted} that differ, found {n}, exit code {ran.code}\n{ran.err[:400]}')

    for name, differs, change in WAYS:
        fields = chosen
        if name == 'blank for the sign of the exponent':
            fields = [f for f in chosen if 'E+' in lines[f[0]][f[1]:f[2]]]
        elif name == 'more digits':
            fields = [f for f in chosen if lines[f[0]][f[1]:f[2]].startswith(' ')]
        judged(name, fields, change, len(fields) if differs else 0)
    for i, field in enumerate(chosen):
        name, differs, change = WAYS[4 + i % 6]
        judged(f'{name}, alone', [field], change, 1)
    angles = [f for f in number_fields(lines) if not f[3] and abs(float(lines[f[0]][f[1]:f[2]])) > 1.0]
    if angles:
        judged('angle', chooser.sample(angles, min(5, len(angles))), lambda t: f'{float(t)*0.9:8.3f}', min(5, len(angles)))
    return faults[:6]


def other_pages(program, folder):
    """The same listing without carriage control, with heads of pages within tables, printed twice at an iteration, overprinted
    headings, with other numbers of elements and nodes"""
    path, lines = printed(program, folder, 'base', scenes.DECKS['sphere.dat'])
    pages = []
    for k, line in enumerate(lines):
        if k % 50 == 49:
            pages += ['1PROGRAM PLAST     THICK SPHERE            PAGE ' + str(k//50 + 1), '0', '      1980  2']
            pages[-1] = ''
        pages.append(line)
        if 'DISPLACEMENTS' in line:
            pages.append('+' + line[1:])
    bare = [line[1:] if line[:1] in '01 ' else line for line in lines]
    ruled = []
    for line in lines:
        if line.startswith('0     DISPL') or line.startswith('0     REAC'):
            ruled += ['', '-'*41, ' ' + line[6:], ' Values are given at Nodal Points', '-'*41, '']
        ruled.append(' ' + line[1:] if line.startswith('0') else line)
    twice = '\n'.join(lines).split('0     INCREMENT NUMBER')
    head, table, rest = re.match(r'(.*?)(0     DISPLACEMENTS.*?)(0     REACTIONS.*)', twice[1], re.S).groups()
    twice[1] = head + table.replace('E-0', 'E-1') + table + rest
    cases = {'pages': pages, 'bare': [' ' + line for line in bare], 'stripped': bare, 'ruled': ruled,
             'twice': '0     INCREMENT NUMBER'.join(twice).split('\n'), 'ends': [line + '\r' for line in lines]}
    faults = []
    for name, text in cases.items():
        ran = program.run('compare', path, write(folder, f'{name}.lis', '\n'.join(text)))
        if ran.code != 0 or '9 tables' not in ran.out:
            faults.append(f'{name}: exit code {ran.code}\n{ran.err[:400]}{ran.out[-400:]}')
    return faults


def renumbered(program, folder):
    """Elements in another order and from other corners, nodes with other numbers: Gauss points are matched by their places"""
    text = scenes.DECKS['sphere.dat']
    lines = text.split('\n')
    n_nodes, n_elements = (int(v) for v in lines[1].split()[:2])
    new = list(range(1, n_nodes))
    random.Random(3).shuffle(new)
    number = dict(zip(range(1, n_nodes + 1), new + [n_nodes]))
    elements = [[int(v) for v in line.split()] for line in lines[2:2 + n_elements]]
    turned, label = [], {}
    for k, (old, material, *nodes) in enumerate(reversed(elements)):
        turn = 2*(k % 4)
        label[old] = k + 1
        turned.append(''.join(f'{v:5d}' for v in (k + 1, material, *(number[i] for i in nodes[turn:] + nodes[:turn]))))
    nodes = lines[2 + n_elements:2 + n_elements + n_nodes]
    moved = sorted(f'{number[int(line[:5])]:5d}{line[5:]}' for line in nodes)
    rest = lines[2 + n_elements + n_nodes:]
    n_held = int(lines[1].split()[2])
    rest[:n_held] = [f' {number[int(line[:5])]:4d}{line[5:]}' for line in rest[:n_held]]
    for k, line in enumerate(rest):
        if re.fullmatch(r'( +\d+){4}', line) and len(line) == 20:
            old, *three = (int(v) for v in line.split())
            rest[k] = ''.join(f'{v:5d}' for v in (label[old], *(number[i] for i in three)))
    other = '\n'.join(lines[:2] + turned + moved + rest)
    one, _ = printed(program, folder, 'one', text)
    two, _ = printed(program, folder, 'two', other)
    ran = program.run('compare', one, two, '--relative', '2E-5', '--of-table', '1E-6')
    faults = ran.ended_with(0) + ([] if 'by r, z' in ran.out else ['not by place'])
    ran = program.run('compare', os.path.join(folder, 'one.h5'), two, '--relative', '2E-5', '--of-table', '1E-6')
    return faults + ran.ended_with(0) + ([] if not faults else [ran.out[-1500:]])


def unreadable(program, folder):
    """Rows that cannot be read, plane listings: line, columns, exit code 2; missing increments and rows count"""
    path, lines = printed(program, folder, 'base', scenes.cylinder(scenes.MISES, (8.0, 4.0)))
    row = next(k for k, line in enumerate(lines) if 'R-DISP' in line) + 3
    start = '\n'.join(lines).index('0     INCREMENT NUMBER     2')
    cases = ((lines[:row] + [lines[row][:24] + '  0.12.345E+00'] + lines[row + 1:], 2, f'x.lis:{row + 1}:'),
             (lines[:row] + [lines[row][:24]] + lines[row + 1:], 2, 'too few values'),
             (lines[:row] + [lines[row] + '  0.1E+00'] + lines[row + 1:], 2, 'too many values'),
             ([line.replace('R-DISP.', 'X-DISP.') for line in lines], 2, 'plane stress or strain'),
             (lines[:row] + lines[row + 1:], 1, '1 row in one file only'),
             ('\n'.join(lines)[:start].split('\n'), 1, '3 tables in one file only'))
    faults = []
    for new, code, words in cases:
        ran = program.run('compare', path, write(folder, 'x.lis', '\n'.join(new)))
        faults += ran.ended_with(code) + ([] if words in ran.out + ran.err else [f'expected {words}\n{ran.err[:500]}{ran.out[-300:]}'])
    # an increment that the old listing lacks is not passed over in a result file either
    ran = program.run('compare', os.path.join(folder, 'base.h5'), os.path.join(folder, 'x.lis'))
    return faults + ran.ended_with(1)


def missing_harmonic(program, folder):
    """--allow-missing does not pass over a harmonic that only one file has"""
    old, _ = printed(program, folder, 'old', scenes.footing((0.1,)))
    deck = os.path.join(folder, 'new.dat')
    faults = program.run('convert', os.path.join(folder, 'old.dat'), deck).ended_with(0)
    # elastic, with a side load of harmonic 1 besides
    lines = read_text(deck).split('\n')
    del lines[lines.index('YIELD'):lines.index('NODES')]
    lines[lines.index('CONTROL') + 1] = lines[lines.index('CONTROL') + 1].replace('0,', '1,', 1)
    lines[lines.index('INCREMENTS'):lines.index('INCREMENTS')] = ['RINGLOADS', '300, 1, 0.01']
    write(folder, 'new.dat', '\n'.join(lines))
    faults += program.run('run', '--quiet', deck, '-o', folder).ended_with(0)
    ran = program.run('compare', os.path.join(folder, 'new.h5'), old, '--allow-missing', 'all', '--relative', '1', '--of-table', '10')
    return faults + ran.ended_with(1) + ([] if 'of harmonics' in ran.out else [ran.out[-800:]])


def tests(program):
    """The tests of this module"""

    def test(name, function, *arguments):
        return Test(f'legacy listing: {name}', lambda folder: function(program, folder, *arguments))

    names = ('Tresca', 'von Mises', 'Mohr-Coulomb', 'Drucker-Prager')
    return ([test(f'elastic cylinder to the last digit, {name}', lame, k + 1) for k, name in enumerate(names)]
            + [test(f'closed form, {name}', sphere_friction, name) for name in ('sphere_mohr.dat', 'sphere_drucker.dat')]
            + [test(name.__name__.replace('_', ' '), name) for name in
               (hill, sphere_lame, disc, same_listing, no_room, refused, altered, other_pages, renumbered, unreadable,
                missing_harmonic)]
            + [test(f'small program, {name}', against, name) for name in scenes.DECKS if name != 'traps.dat'])
