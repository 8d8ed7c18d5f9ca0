"""Estimates of the errors of resultants on cuts: beside a finer mesh, cut by cut; none where loads alone act beyond a cut; not known
where they cannot be"""
from hard_decks import close, solved
from support import Test, expected, input_deck, write

KINDS = ('axial_force', 'lateral_force', 'moment', 'torque')
# A pile in a socket, elastic joints along its shaft and below it
PILE = """TITLE
Pile
CONTROL
{control}
MATERIALS
1,2E4,0.17
LAWS
1,1E4,2E4,1E4{law}
BLOCKS
1,1,8,{n},{n}
0,-0.5,0.5,0
1,1,8,{n},{n2}
0,0,0.5,1
2,1,8,{n},{n2}
0.5,0,2,1
2,1,8,{n},{n}
0,1,0.5,2
2,1,8,{n},{n}
0.5,1,2,2
FACES
1,1,0,-0.5,0.5,-0.5
2,1,0.5,0,0.5,1
3,2,0.5,0,0.5,1
4,1,0,1,0.5,1
5,2,0,1,0.5,1
6,2,0,2,2,2
INTERFACES
1,2,3
1,4,5
FIXEDFACES
6,111
CUTS
1,-0.25,1,0.9,8
RESULTANTS
1,LATERAL,0.4,{angle}
1,MOMENT,0.3,{angle}
1,TORQUE,0.1
1,AXIAL,1.0
{more}END
"""
# A tube: pushed sideways at its top, clamped at its foot, perhaps held or on springs below its top, or of two bodies
TUBE = """TITLE
Tube
CONTROL
1
MATERIALS
1,2E4,0.3
BLOCKS
1,1,8,{n},{n2}
0.5,0,1,1
{upper},1,8,{n},{n2}
0.5,1,1,2
1,1,8,{n},{n}
0.5,2,1,2.5
FACES
1,1,0.5,0,1,0
2,{upper},1,1,1,2
3,1,1,2,1,2.5
{bonds}FIXEDFACES
1,111
{held}CUTS
1,0,1,2.5,11
RESULTANTS
{pushed},LATERAL,1
"""


def compared(what, coarse, fine, band, slight=0.1):
    """Faults: errors of cuts that are told too small or too large beside a better run; of a single cut too small beside those of its
    neighbours, too, for along a pile errors cross zero"""
    faults = []
    for kind in KINDS:
        told = [cut[f'{kind}_error'] for cut in coarse]
        true = [abs(rough[kind] - better[kind]) for rough, better in zip(coarse, fine, strict=True)]
        scale = max(cut[kind] for cut in coarse)
        if scale == 0.0:
            faults += expected(f'{what}: {kind}', 0.0, max(told))
            continue
        ratio = max(true)/max(told)
        faults += [] if band[0] < ratio < band[1] else [f'{what}: {kind}, largest true {max(true):.3e}, told {max(told):.3e}']
        for k, error in enumerate(true):
            if error > 2*max(told[max(0, k - 1):k + 2]) + slight*max(told):
                faults.append(f'{what}: {kind} on cut {k + 1}, true {error:.3e}, told {told[k]:.3e}')
    return faults


def pile(program, folder):
    """Joints that hold, and that open and slip; loads at an angle; what all sources leave is their sum"""
    faults = []
    for name, control, better, law in (('elastic', '1,5', '1,5', ',,,ELASTIC'), ('slips', '4,17,,,,,NEWTON', '8,65,,,,,NEWTON', ',0,30,PAPER')):
        def cuts(n, angle=0, control=control, law=law, more=''):
            deck = PILE.format(control=control, law=law, n=n, n2=2*n, angle=angle, more=more)
            return solved(program, folder, 'pile', deck)[0]

        coarse, fine = cuts(3), cuts(10, control=better)
        faults += compared(name, coarse['cut_errors'], fine['cut_errors'], (0.3, 2.0))
        shares = [coarse['errors'][source]['cuts'] for source in ('discretization', 'harmonics', 'planes', 'iteration', 'solver')]
        faults += close(f'{name}: sum', sum(shares), coarse['errors']['sum']['cuts'], 1e-9*sum(shares))
        faults += expected(f'{name}: in words', True, 'resultants on CUTS ' in coarse['errors']['in_words'])
        on_springs = PILE.replace('FIXEDFACES\n6,111', 'SPRINGS\n6,1E4,5E3,5E3').format(
            control=control, law=law, n=3, n2=6, angle=0, more='CUTS\n101,0.1,,1.9,9\n')
        for cut in solved(program, folder, 'pile', on_springs)[0]['cut_errors'][-9:]:  # of all bodies: loads alone act above
            faults += [f'{name}: {kind} of all bodies, told {cut[f"{kind}_error"]:.2e} at z = {cut["z"]}' for kind in KINDS
                       if not cut[f'{kind}_error'] < (1e-9 if name == 'elastic' else 1e-6)]
        if name == 'slips':
            continue
        # another mode carries a load at 90 degrees, and the torque: lengths are the same at any angle
        for one, other in zip(coarse['cut_errors'], cuts(3, 50)['cut_errors'], strict=True):
            for kind in KINDS:
                faults += close(f'at 50 degrees, {kind}', one[f'{kind}_error'], other[f'{kind}_error'], 1e-5*one[kind] + 1e-9)
        target = cuts(2, more='ERROR\n0.2,CUTS\n')
        faults += expected('target', [], [line for line in target['messages'] if 'not met' in line])
        true = max(abs(rough['moment'] - better['moment']) for rough, better in zip(target['cut_errors'], fine['cut_errors'], strict=True))
        faults += expected('met', True, true < 0.002*max(cut['moment'] for cut in fine['cut_errors']))
    return faults


def tube(program, folder):
    """What loads alone act on is exact; springs and other supports are as wrong as the mesh; nothing is known on cuts through a
    support, nor of bodies with common nodes"""
    def cuts(n, held='', upper=1, pushed=3, top='', kind='8', control='1'):
        bonds = '4,1,0.5,2.5,1,2.5\n' if top else ''
        if upper == 2:
            bonds = '4,1,0.5,1,1,1\n5,2,0.5,1,1,1\n6,1,0.5,2,1,2\n7,2,0.5,2,1,2\nINTERFACES\n,4,5,BONDED\n,7,6,BONDED\n'
        deck = TUBE.format(n=n, n2=2*n, held=held + top, upper=upper, pushed=pushed, bonds=bonds)
        deck = deck.replace('CONTROL\n1\n', f'CONTROL\n{control}\n').replace(',1,8,', f',1,{kind},')
        return solved(program, folder, 'tube', deck + 'END\n')[0]

    faults = []
    told = cuts(1)['cut_errors']
    faults += [f'{kind}: told {cut[f"{kind}_error"]:.2e} on cut {cut["cut"]}' for kind in KINDS for cut in told
               if not cut[f'{kind}_error'] < 1e-9]
    for cut in told:  # the load is spread over the wall from z = 2 to 2.5
        above = min(0.5, 2.5 - cut['z'])
        faults += close(f'moment on cut {cut["cut"]}', above/0.5*(2.5 - above/2 - cut['z']), cut['moment'], 1e-7)
    for name, held, last in (('springs', 'SPRINGS\n3,1E3,3E4,1E3\n', 11), ('stiff springs', 'SPRINGS\n3,1E5,1E3,1E5\n', 8)):
        rough, better = (cuts(n, held, pushed=2)['cut_errors'] for n in (3, 12))
        faults += compared(name, rough[:last], better[:last], (0.2, 2.0))
        faults += expected(f'{name}: at their end', last == 11, rough[8]['moment_error'] is not None)
    coarse, fine = (cuts(n, '3,101\n', pushed=2) for n in (2, 12))
    known = [cut['moment_error'] is not None for cut in coarse['cut_errors']]
    faults += expected('held: known', [cut['z'] < 2 for cut in coarse['cut_errors'][:10]], known[:10])
    faults += expected('held: in words', True, f'({sum(known)} of 11 cuts)' in coarse['errors']['in_words'])
    pairs = [pair for pair, is_known in zip(zip(coarse['cut_errors'], fine['cut_errors'], strict=True), known, strict=True) if is_known]
    faults += compared('held', *zip(*pairs, strict=True), (0.4, 2.5))
    # reactions at both ends; elements whose halves are stiffer than they are, too
    fine = cuts(12, top='4,111\n', pushed=2)['cut_errors']
    for name, n, kind, control in (('8-node', 2, '8', '1'), ('4-node', 3, '4', '1'), ('triangles', 2, '6', '1'),
                                   ('reduced rule', 2, '8', '1,,,2'), ('B-bar', 3, '4', '1,,,,,BBAR')):
        told = cuts(n, top='4,111\n', pushed=2, kind=kind, control=control)['cut_errors']
        faults += compared(f'held at both ends, {name}', told, fine, (0.4, 2.5))
    shared = cuts(1, upper=2)
    faults += expected('common nodes', [None]*11, [cut['moment_error'] for cut in shared['cut_errors']])
    faults += expected('common nodes: the budget', None, shared['errors']['discretization']['cuts'])
    both = cuts(1, 'CUTS\n21,1.3,,0.5,2\n', upper=2)['cut_errors']
    faults += expected('common nodes: a cut of all bodies', [True, True], [cut['moment_error'] is not None for cut in both[:2]])
    return faults


def one_kind(program, folder):
    """Where axial force alone acts, rounding of moments is no error of a moment that is zero"""
    deck = PILE.format(control='4,17,,,,,NEWTON', law=',0,30,PAPER', n=2, n2=4, angle=0, more='')
    start = deck.index('RESULTANTS')
    deck = deck[:start] + """CASE
1,axial
RESULTANTS
1,AXIAL,1
CASE
2,lateral
RESULTANTS
1,LATERAL,0.4
COMBINE
1,1,1,2,1
INCREMENTS
1,,,1
END
"""
    faults = []
    for case, kind in ((1, 'axial_force'), (2, 'lateral_force')):
        summary, _ = solved(program, folder, 'one', deck.replace('1,,,1', f'1,,,{case}'))
        share = summary['errors']['sum']['cuts']
        faults += expected(f'{kind}: relative', True, 1e-4 < share < 0.1)
        faults += expected(f'{kind}: acts', True, max(cut[kind] for cut in summary['cut_errors']) > 0.3)
    return faults


def let_go(program, folder):
    """A pile that next to nothing presses on, pushed and let go: what is left of forces is a millionth of what they were, and errors are
    no many times of it"""
    deck = input_deck('monopile.dat')
    for number in ('6.85E-3', '1.0E-3 ', '9.81E-3'):
        deck = deck.replace(number, number.replace('E-3', 'E-9'))
    summary, _ = solved(program, folder, 'let_go', deck)
    known = [summary['errors'][source]['cuts'] for source in ('discretization', 'harmonics', 'planes')]
    return expected(f'told: {known}', True, all(0 < share < 0.5 for share in known))


def without(program, folder):
    """A target of cuts needs some"""
    deck = PILE.format(control='1,5', law=',,,ELASTIC', n=2, n2=4, angle=0, more='ERROR\n1,CUTS\n')
    start = deck.index('CUTS')
    ran = program.run('check', write(folder, 'none.dat', deck[:start] + deck[deck.index('RESULTANTS'):]), folder=folder)
    return ran.ended_with(2) + expected('message', True, 'there is no cut' in ran.out + ran.err)


def tests(program):
    """The tests of this module"""
    named = {'pile': pile, 'tube': tube, 'one kind': one_kind, 'let go': let_go, 'without cuts': without}
    return [Test(f'estimated cuts: {what}', lambda folder, check=check: check(program, folder)) for what, check in named.items()]
