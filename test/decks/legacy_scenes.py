"""Decks in the format of Owen and Hinton's plasticity program: inputs/legacy, and what is exact of them"""
import math
import os

from support import INPUTS

YOUNG, POISSON, YIELD = 21000.0, 0.3, 24.0
TRESCA, MISES, MOHR, DRUCKER = 1, 2, 3, 4


def grid(rs, zs, place=None):
    """Numbers and coordinates of 8-node elements over two rows of coordinates, elements. Mid-side nodes have no card
    unless places are moved"""
    number, cards, count = {}, {}, 0
    for i in range(2*len(rs) - 1):
        for j in range(2*len(zs) - 1):
            if i % 2 and j % 2:
                continue
            count += 1
            number[i, j] = count
            r, z = (rs[i//2] + rs[(i + 1)//2])/2, (zs[j//2] + zs[(j + 1)//2])/2
            if place:
                cards[count] = place(r, z)
            elif not (i % 2 or j % 2):
                cards[count] = (r, z)
    ring = ((0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1))
    elements = [[number[2*i + a, 2*j + b] for a, b in ring] for i in range(len(rs) - 1) for j in range(len(zs) - 1)]
    return number, cards, elements


def real(value, width, decimals):
    """A number with its point, as many decimals as fit: as many as are asked for, or all that it needs and a field holds"""
    text = f'{value:{width}.{decimals}f}'
    if len(text) > width:
        text = f'{value:{width}.1f}'
    for more in range(decimals + 1, width - 1):
        longer = f'{value:{width}.{more}f}'
        if len(longer) <= width and abs(float(text) - value) > 1e-12*abs(value):
            text = longer
    return text


def deck(title, mesh, held, properties, load, increments, criterion, gauss=2):
    """The cards. held: node, code, values; load: cards; increments: FACTO"""
    _, cards, elements = mesh
    points = max(max(e) for e in elements)
    control = (points, len(elements), len(held), 3, 8, 1, gauss, 2, criterion, len(increments), 4)
    lines = [title, ''.join(f'{v:5d}' for v in control)]
    lines += [''.join(f'{v:5d}' for v in (k + 1, 1, *e)) for k, e in enumerate(elements)]
    lines += [f'{k:5d}{real(r, 10, 5)}{real(z, 10, 5)}' for k, (r, z) in sorted(cards.items())]
    lines += [f' {k:4d}     {code:>5s}     {real(u, 10, 6)}{real(v, 10, 6)}' for k, code, u, v in held]
    lines += ['    1', ''.join(real(v, 10, 5) for v in properties), *load]
    lines += [f'{real(factor, 10, 5)}{0.01:10.5f}{50:5d}{3:5d}{3:5d}' for factor in increments]
    return '\n'.join(lines) + '\n'


def pressed(title, sides, value):
    """Cards of a pressure on sides: element, three nodes"""
    lines = [title, ''.join(f'{v:5d}' for v in (0, 0, 1)), f'{len(sides):5d}']
    for element, nodes in sides:
        lines += [''.join(f'{v:5d}' for v in (element, *nodes)), 3*(real(value, 10, 3) + real(0.0, 10, 3))]
    return lines


def even(first, last, n):
    """n intervals"""
    return [first + (last - first)*k/n for k in range(n + 1)]


def cylinder(criterion, increments, strength=YIELD, angle=0.0, n=16):
    """b = 2a, plane strain, pressed from within by FACTO"""
    mesh = grid(even(1.0, 2.0, n), [0.0, 0.1])
    number = mesh[0]
    held = [(k, '01', 0.0, 0.0) for (i, j), k in sorted(number.items()) if j in (0, 2)]
    return deck('THICK CYLINDER', mesh, held, (YOUNG, POISSON, 0.0, 0.0, strength, 0.0, angle),
                pressed('PRESSURE FROM WITHIN', [(1, (number[0, 2], number[0, 1], number[0, 0]))], 1.0), increments, criterion)


def sphere(criterion, increments, strength=YIELD, angle=0.0, n=8, gauss=2):
    """b = 2a, pressed from within, n elements from the equator to the pole"""

    def place(radius, angle):
        r, z = radius*math.cos(angle), radius*math.sin(angle)
        return (0.0 if abs(angle - math.pi/2) < 1e-9 else r, 0.0 if abs(angle) < 1e-9 else z)
    mesh = grid(even(1.0, 2.0, 3*n//2), even(0.0, math.pi/2, n), place)
    number = mesh[0]
    held = [(k, '01', 0.0, 0.0) for (i, j), k in sorted(number.items()) if j == 0]
    held += [(k, '10', 0.0, 0.0) for (i, j), k in sorted(number.items()) if j == 2*n]
    sides = [(j + 1, (number[0, 2*j + 2], number[0, 2*j + 1], number[0, 2*j])) for j in range(n)]
    return deck('THICK SPHERE', mesh, held, (YOUNG, POISSON, 0.0, 0.0, strength, 0.0, angle),
                pressed('PRESSURE FROM WITHIN', sides, 1.0), increments, criterion, gauss)


def plate(increments):
    """Circular plate, radius 10, 1 thick, held at the middle of its rim, pressed on its top by FACTO"""
    n = 12
    mesh = grid(even(0.0, 10.0, n), [0.0, 0.5, 1.0])
    number = mesh[0]
    held = [(number[2*n, 2], '01', 0.0, 0.0)] + [(number[0, j], '10', 0.0, 0.0) for j in range(5)]
    sides = [(2*i + 2, (number[2*i + 2, 4], number[2*i + 1, 4], number[2*i, 4])) for i in range(n)]
    return deck('CIRCULAR PLATE', mesh, held, (YOUNG, POISSON, 0.0, 0.0, YIELD, 0.0, 0.0),
                pressed('PRESSURE ON TOP', sides, 1.0), increments, TRESCA)


def footing(increments):
    """Rough rigid footing of radius 1 on clay, pushed down by FACTO times 0.01"""
    rs, zs = even(0.0, 1.0, 6) + [1.15, 1.4, 1.8, 2.5, 3.5, 5.0], [-5.0, -3.5, -2.4, -1.6, -1.0, -0.6, -0.35, -0.15, 0.0]
    mesh = grid(rs, zs)
    number, top, last = mesh[0], 2*len(zs) - 2, 2*len(rs) - 2
    held = []
    for (i, j), k in sorted(number.items()):
        if j == top and i <= 12:
            held.append((k, '11', 0.0, -0.01))
        elif j == 0:
            held.append((k, '11', 0.0, 0.0))
        elif i in (0, last):
            held.append((k, '10', 0.0, 0.0))
    return deck('ROUGH FOOTING', mesh, held, (1000.0, 0.49, 0.0, 0.0, 2.0, 0.0, 0.0), ['NO LOADS', f'{0:5d}{0:5d}{0:5d}'],
                increments, TRESCA)


def column(increments):
    """A column that hangs from its top under gravity of 10, density 2.5, 4 long; free at its sides"""
    mesh = grid([0.0, 0.5, 1.0], even(0.0, 4.0, 4))
    number = mesh[0]
    held = [(number[i, 8], '01', 0.0, 0.0) for i in range(5)] + [(number[0, j], '10', 0.0, 0.0) for j in range(8)]
    return deck('HANGING COLUMN', mesh, held, (YOUNG, 0.0, 0.0, 2.5, 1000.0, 0.0, 0.0),
                ['GRAVITY', f'{0:5d}{1:5d}{0:5d}', real(0.0, 10, 3) + real(10.0, 10, 3)], increments, DRUCKER, gauss=3)


def disc(increments, n=16):
    """A turning disc, radius 1, 0.1 thick, rho omega^2 = FACTO. The format has no card for that: forces on the nodes, of
    the whole circle, do the work of the centrifugal force on the shape functions"""
    mesh = grid(even(0.0, 1.0, n), [0.0, 0.05])
    number, cards, _ = mesh
    held = [(number[i, 0], '11' if i == 0 else '01', 0.0, 0.0) for i in range(2*n + 1)]
    held += [(number[0, j], '10', 0.0, 0.0) for j in (1, 2)]
    points = {1: (-1.0, -1.0), 2: (0.0, -1.0), 3: (1.0, -1.0), 4: (1.0, 0.0), 5: (1.0, 1.0), 6: (0.0, 1.0), 7: (-1.0, 1.0), 8: (-1.0, 0.0)}

    def shape(x, y):
        return [(1 + a*x)*(1 + b*y)*(a*x + b*y - 1)/4 if a and b else
                (1 - x*x)*(1 + b*y)/2 if b else (1 + a*x)*(1 - y*y)/2 for a, b in points.values()]
    force = dict.fromkeys(range(1, max(number.values()) + 1), 0.0)
    root = math.sqrt(0.6)
    for nodes in mesh[2]:
        r1, r2 = cards[nodes[0]][0], cards[nodes[2]][0]
        for x, wx in ((-root, 5/9), (0.0, 8/9), (root, 5/9)):
            for y, wy in ((-root, 5/9), (0.0, 8/9), (root, 5/9)):
                r = (r1 + r2)/2 + x*(r2 - r1)/2
                weight = wx*wy*(r2 - r1)/2*0.025*2*math.pi*r*r
                for node, value in zip(nodes, shape(x, y)):
                    force[node] += weight*value
    loads = [f'{k:5d}{real(value, 10, 3)}{real(0.0, 10, 3)}' for k, value in force.items()]
    return deck('TURNING DISC', mesh, held, (YOUNG, POISSON, 0.0, 0.0, YIELD, 0.0, 0.0),
                ['CENTRIFUGAL FORCE', f'{1:5d}{0:5d}{0:5d}', *loads], increments, TRESCA, gauss=3)


def traps():
    """The cylinder with all that the format allows: numbers without points, blanks for zeros, a node given twice"""
    lines = cylinder(MISES, (6.0, 2.0)).split('\n')
    at = lines.index('    1')
    lines[at + 1] = f'{"21000.":>10s}{"30000":>10s}{"":10s}{"":10s}{"24.":>10s}'
    lines[at + 6] = '   1000' .rjust(10) + '          ' + '   1000'.rjust(10) + '          ' + '1.0E0'.rjust(10)
    first = 2 + 16
    lines.insert(first, '    1    100000')
    return '\n'.join(lines)


def small_fields(*values):
    """An entry of NASTRAN in fields of eight columns"""
    return ''.join(f'{value:<8}' for value in values).rstrip()


def nastran(entry=small_fields):
    """A thick cylinder of NASTRAN, b = 2a, two rows of elements, the upper row cut into triangles, plane strain: pressed from
    within all round, pulled sideways at its outer side over 60 degrees; loads of two sets, an enforced displacement of zero"""
    n = 8
    case = ['ID RING,NASTRAN', 'APP DISPLACEMENT', 'SOL 1,1', 'TIME 5', 'CEND', 'TITLE = THICK CYLINDER OF RINGS',
            'AXISYM = COSINE', 'LOAD = 10', 'SPC = 7', 'DISP = ALL', 'BEGIN BULK', '$ harmonics 0 to 3']
    bulk = [('AXIC', 3), ('MAT1', 4, '21000.', '', '.3', '7.8-9'), ('PTRAPAX', 1, '', 4), ('PTRIAAX', 2, '', 4),
            ('LOAD', 10, '1.', '2.', 1, '1.', 2), ('SPCADD', 7, 71, 72)]
    number = {}
    for i in range(n + 1):
        for j in range(3):
            number[i, j] = 100*(j + 1) + i + 1
            bulk.append(('RINGAX', number[i, j], '', f'{1 + i/n:.5f}', f'{0.05*j:.3f}', '', '', 3456 if j != 1 else 456))
    for i in range(n):
        bulk.append(('CTRAPAX', i + 1, 1, number[i, 0], number[i + 1, 0], number[i + 1, 1], number[i, 1]))
        bulk.append(('CTRIAAX', 100 + i, 2, number[i, 1], number[i + 1, 1], number[i + 1, 2]))
        bulk.append(('CTRIAAX', 200 + i, 2, number[i, 1], number[i + 1, 2], number[i, 2]))
    for j in range(2):
        bulk.append(('PRESAX', 1, '4.', number[0, j], number[0, j + 1], '0.', '360.'))
        bulk.append(('PRESAX', 2, '3.', number[n, j], number[n, j + 1], '-30.', '30.'))
    # the ring as a whole goes neither up nor sideways
    bulk += [('SPCAX', 71, number[4, 1], 0, 3), ('SPCAX', 72, number[4, 0], 1, 12), ('SPCAX', 73, number[0, 0], 0, 1),
             ('POINTAX', 999, number[0, 0], '0.')]
    return '\n'.join(case + [entry(*line) for line in bulk] + ['ENDDATA', ''])


def abaqus(kind='CAX8R'):
    """A thick cylinder of Abaqus or CalculiX, b = 2a, pressed from within; plane strain"""
    n = 16
    quadratic = '8' in kind
    number, cards, elements = grid(even(1.0, 2.0, n), [0.0, 0.1])
    lines = ['*HEADING', 'Thick cylinder', '** a comment', '*NODE, NSET=ALL']
    places = {}
    for (i, j), k in number.items():
        if quadratic or not (i % 2 or j % 2):
            places[k] = (i, j)
            lines.append(f'{k}, {1 + i/2/n:.7g}, {0.05*j:.7g}, 0.')
    lines.append(f'*ELEMENT, TYPE={kind}, ELSET=BODY')
    for k, e in enumerate(elements):
        nodes = [e[0], e[2], e[4], e[6]] + ([e[1], e[3], e[5], e[7]] if quadratic else [])
        lines.append(', '.join(str(v) for v in [k + 1, *nodes[:6]]) + (',' if quadratic else ''))
        if quadratic:
            lines.append(', '.join(str(v) for v in nodes[6:]))
    ends = sorted(k for k, (_, j) in places.items() if j in (0, 2))
    lines.append('*NSET, NSET=ENDS')
    lines += [', '.join(str(v) for v in ends[a:a + 8]) for a in range(0, len(ends), 8)]
    lines += ['*ELSET, ELSET=INNER, GENERATE', '1, 1, 1', '*SURFACE, NAME=BORE, TYPE=ELEMENT', 'INNER, S4',
              '*MATERIAL, NAME=STEEL', '*ELASTIC', '21000., 0.3', '*DENSITY', '7.8e-9', '*EXPANSION', '1.2e-5',
              '*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL', '*BOUNDARY', 'ENDS, 2, 2', '*STEP', '*STATIC',
              '*DSLOAD', 'BORE, P, 8.', '*NODE PRINT, NSET=ALL', 'U', '*EL PRINT, ELSET=BODY', 'S', '*END STEP', '']
    return '\n'.join(lines)


def abaqus_rings(between, shift=0.0):
    """Two rings of parts of their own, r from 1 to 1.5 and from there (and a shift) to 2, pressed from within; plane strain. Lines
    say what is between the surfaces FIT and HUB"""
    n = 8
    lines = ['*HEADING', 'Rings', '*NODE, NSET=ALL']
    elements, ends = [], []
    for part, (first, last) in enumerate(((1.0, 1.5), (1.5 + shift, 2.0))):
        number, _, found = grid(even(1.0, 2.0, n), [0.0, 0.1])
        for (i, j), k in number.items():
            lines.append(f'{1000*part + k}, {first + (last - first)*i/2/n:.12g}, {0.05*j:.7g}')
            ends += [1000*part + k] if j in (0, 2) else []
        elements += [[1000*part + k + 1] + [1000*part + e[m] for m in (0, 2, 4, 6, 1, 3, 5, 7)] for k, e in enumerate(found)]
    lines += ['*ELEMENT, TYPE=CAX8R, ELSET=BODY'] + [', '.join(map(str, e)) for e in elements]
    lines += ['*NSET, NSET=ENDS'] + [', '.join(map(str, ends[a:a + 8])) for a in range(0, len(ends), 8)]
    lines += ['*SURFACE, NAME=BORE', '1, S4', '*SURFACE, NAME=FIT', f'{n}, S2', '*SURFACE, NAME=HUB', '1001, S4', '*MATERIAL, NAME=STEEL',
              '*ELASTIC', '21000., 0.3', '*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL', *between, '*BOUNDARY', 'ENDS, 2, 2', '*STEP',
              '*STATIC', '*DSLOAD', 'BORE, P, 8.', '*END STEP', '']
    return '\n'.join(lines)


OTHERS = {'cylinder.bdf': nastran(), 'cylinder.inp': abaqus()}

DECKS = {
    'cylinder.dat': cylinder(MISES, (8.0, 4.0, 4.0)),
    'cylinder_mohr.dat': cylinder(MOHR, (4.0, 4.0, 1.5), 10.0, 30.0),
    'cylinder_tresca.dat': cylinder(TRESCA, (8.0, 6.0), n=128),
    'cylinder_drucker.dat': cylinder(DRUCKER, (4.0, 4.0, 1.5), 10.0, 30.0),
    'sphere_mises.dat': sphere(MISES, (12.0, 8.0, 6.0)),
    'sphere_mohr.dat': sphere(MOHR, (6.0, 6.0, 2.0), 10.0, 30.0),
    'sphere_drucker.dat': sphere(DRUCKER, (6.0, 6.0, 2.0), 10.0, 30.0),
    'disc.dat': disc((50.0, 15.0, 6.0, 2.0)),
    'sphere.dat': sphere(TRESCA, (12.0, 8.0, 6.0)),
    'plate.dat': plate((0.1, 0.22, 0.02, 0.02, 0.02, 0.02)),
    'footing.dat': footing((0.2, 0.3, 0.5, 1.0, 1.0)),
    'column.dat': column((0.5, 0.5)),
    'traps.dat': traps(),
}


def write_inputs():
    """Write inputs/legacy"""
    folder = os.path.join(INPUTS, 'legacy')
    os.makedirs(folder, exist_ok=True)
    for name, text in (DECKS | OTHERS).items():
        with open(os.path.join(folder, name), 'w', encoding='utf-8') as file:
            file.write(text)


if __name__ == '__main__':
    write_inputs()
