"""Histories whose end hangs on the way there: what estimates do not see of them is said, no target counts as met by it, loads that
go are the same whichever cards take them, and a mechanism has the name of what moves"""
import os

from hard_decks import close, solved
from support import INPUTS, Test, expected, read_text

# A wheel shrunk on a shaft, symmetric about z = 5 but for its mesh: cooled, then turned fast
WHEEL = """TITLE
Wheel on a shaft
CONTROL
0
MATERIALS
1,2.1E5,0.3,7.85E-9
2,2.1E5,0.3,7.85E-9,1.2E-5
LAWS
1,1E6,1E7,1E6,,12.0
LAWDETAILS
1,RESULTANT
BLOCKS
1,1,8,6,3,,1.5
0,0,20,10
2,2,8,8,3,,1.5
20,0,60,10
FACES
1,1,20,0,20,10
2,2,20,0,20,10
6,1,0,0,20,0
INTERFACES
1,1,2
SPRINGS
6,1.0
CASE
1
TEMPERATURES
2,0,-100
CASE
2
{other}
COMBINE
1,1,1,2,1
POINTS
1,0,0,1,shaft below
2,0,10,1,shaft above
3,60,0,2,hub below
4,60,10,2,hub above
INCREMENTS
1,,,1
1,,,2
{more}END
"""
# A cone in ground, whose stress at rest has shear along the cone, pushed a little
CONE = """TITLE
Cone
CONTROL
2
MATERIALS
1,60,0.25,1E-3
LAWS
1,100,200,100,1E6,26
LAWDETAILS
1,RESULTANT
BLOCKS
1,1,8,3,6
0,-10,2,-10,4,0,0,0
2,1,8,6,6
2,-10,20,-10,20,0,4,0
2,1,8,3,4
0,-14,2,-14,2,-10,0,-10
2,1,8,6,4
2,-14,20,-14,20,-10,2,-10
FACES
1,1,0,0,4,0
2,1,2,-10,4,0
3,2,2,-10,4,0
4,1,0,-10,2,-10
5,2,0,-10,2,-10
6,2,0,-14,20,-14
7,2,20,-14,20,0
INTERFACES
1,2,3
1,4,5
FIXEDFACES
6,111
7,101
CASE
1
GRAVITY
-9.81
INSITU
,0,9.81E-3,0.5
CASE
2
RESULTANTS
1,LATERAL,0.001
COMBINE
1,1,1,2,1
INCREMENTS
1,1E-8,,1
1,1E-8,,2
ERROR
5
END
"""
# A rod that is pulled out of a rigid hub, by a joint that loses cohesion and friction as it slips
ROD = """TITLE
Rod in a hub
CONTROL
0
MATERIALS
1,1000,0
2,1E6,0
LAWS
1,40,1000,25,0.1,25
LAWDETAILS
1,RESULTANT,,0,{residual},,,-0.5
BLOCKS
1,1,8,2,20
0,0,0.1,4
2,2,8,1,20
0.1,0,0.2,4
FACES
1,1,0.1,0,0.1,4
2,2,0.1,0,0.1,4
3,1,0,4,0.1,4
4,2,0.2,0,0.2,4
INTERFACES
1,1,2
FIXEDFACES
4,111
RESULTANTS
3,AXIAL,{force}
INCREMENTS
1,1E-8
{more}END
"""
# A ring on its bed: pressed, turned, then pushed until it slides
ANNULUS = """TITLE
Ring on its bed
CONTROL
1,41
MATERIALS
1,1E9,0.2
LAWS
1,700,14,900,0,9.108
LAWDETAILS
1,COMPONENTS
BLOCKS
1,1,8,4,1
0.4,-0.5,1,0
2,1,8,4,2
0.4,0,1,0.5
FACES
1,1,0.4,0,1,0
2,2,0.4,0,1,0
3,1,0.4,-0.5,1,-0.5
4,2,0.4,0.5,1,0.5
INTERFACES
1,1,2
FIXEDFACES
3,111
CASE
1
RESULTANTS
4,AXIAL,-10
CASE
2
RESULTANTS
4,TORQUE,1
CASE
3
RESULTANTS
4,LATERAL,1
COMBINE
1,1,1,2,1,3,1
INCREMENTS
1,1E-9,,1
0.5,1E-9,,2
3,1E-9,,3
END
"""


def first(cases, increments, pressed=True):
    """The peg of inputs/first.dat under load cases (kind, value), pressed all round by 0.3 at first or not; increments: (factor, case)"""
    text = read_text(os.path.join(INPUTS, 'first.dat'))
    text = text[:text.index('RESULTANTS')]
    if pressed:
        text = text.replace('BLOCKS ', 'LAWDETAILS\n1,RESULTANT,,,,,,-0.3\nBLOCKS ')
    for number, (kind, value) in enumerate(cases, 1):
        text += f'CASE\n{number}\nRESULTANTS\n1,{kind},{value}\n'
    text += 'COMBINE\n' + ''.join(f'1,{number},1\n' for number in range(1, len(cases) + 1))
    return text + 'INCREMENTS\n' + ''.join(f'{factor},1E-8,,{case}\n' for factor, case in increments) + 'END\n'


def says(summary, words):
    """Whether a message has the words"""
    return any(words in line for line in summary['messages'])


def lasting_slip(program, folder):
    """Slip of earlier increments that stays, whichever loads took those away under which it came, is said; the wheel's mid-heights
    show that it matters: they coincide but for errors. A target does not count as met"""
    faults = []
    for other in ('ROTATION\n3000', 'TEMPERATURES\n2,0,80'):
        summary, _ = solved(program, folder, 'wheel', WHEEL.format(other=other, more='ERROR\n0.5\n'))
        words = summary['errors']['in_words']
        faults += expected(f'{other!r}: at least', True, words.startswith('displacement at least'))
        faults += expected(f'{other!r}: remark', True, says(summary, 'slipped in earlier increments'))
        faults += expected(f'{other!r}: missed', True, says(summary, 'was not met') and says(summary, 'not all errors are known'))
    once = WHEEL.format(other='ROTATION\n3000', more='').replace('1,,,2\n', '')
    summary, _ = solved(program, folder, 'fit', once)
    faults += expected('the fit alone', False, 'at least' in summary['errors']['in_words'])
    for cases, increments in (((('LATERAL', 0.4),), ((1, 1), (-0.999, 1))), ((('LATERAL', 0.4), ('LATERAL', -0.4)), ((1, 1), (0.999, 2)))):
        summary, _ = solved(program, folder, 'peg', first(cases, increments))
        faults += expected(f'{cases}: at least', True, summary['errors']['in_words'].startswith('displacement at least'))
    summary, _ = solved(program, folder, 'peg', first((('LATERAL', 0.4),), ((0.5, 1), (0.5, 1))))
    faults += expected('loads that grow', False, 'at least' in summary['errors']['in_words'])
    summary, _ = solved(program, folder, 'cone', CONE)
    faults += expected('ground at rest: slip', 0, sum(increment['slip'] for increment in summary['increments']))
    faults += expected('ground at rest', (False, False), ('at least' in summary['errors']['in_words'], says(summary, 'not met')))
    held = ROD.format(residual='', force=20, more='').replace('1,RESULTANT,,0,,', '1,RESULTANT,,,,').replace(
        'FIXEDFACES\n4,111', 'FIXEDFACES\n4,111\n5,111').replace('INTERFACES', '5,1,0,0,0.1,0\nINTERFACES').replace(
        'INCREMENTS\n1,', 'INCREMENTS\n0.5,1E-8\n0.5,')
    summary, _ = solved(program, folder, 'held', held)
    return faults + expected('bodies that others hold', False, 'at least' in summary['errors']['in_words'])


def softening(program, folder):
    """Which points soften hangs on their order: that is said, and a target does not count as met; not of a law that loses nothing"""
    faults = []
    for residual, wanted in ((10.0, True), ('', False)):
        summary, _ = solved(program, folder, 'rod', ROD.format(residual=residual, force=0.29299, more='ERROR\n2\n').replace(
            '1,RESULTANT,,0,,', '1,RESULTANT,,,,'))
        faults += expected(f'{residual}: at least', wanted, summary['errors']['in_words'].startswith('displacement at least'))
        faults += expected(f'{residual}: missed', wanted, says(summary, 'was not met'))
        faults += expected(f'{residual}: remark', wanted, says(summary, 'softened as they slipped'))
    return faults


def turning(program, folder):
    """Slip along a peg that a lateral load turns aside at once is said to; not in as many increments as make a way of it, nor where
    it goes on or back"""
    faults = []
    pulled = (('AXIAL', -0.485), ('LATERAL', 0.2))
    for cases, increments, wanted in ((pulled, ((1, 1), (1, 2)), True), (pulled, ((1, 1), *[(0.05, 2)]*20), False),
                                      (pulled, (*[(0.02, 1)]*50, (1, 2)), True), (pulled[:1], ((0.9, 1), (0.1, 1)), False)):
        summary, _ = solved(program, folder, 'peg', first(cases, increments))
        faults += expected(f'{len(increments)} increments, {increments[-1]}: turns', wanted, says(summary, 'turns within an increment'))
    return faults


def no_load(program, folder):
    """Loads that go leave the same behind, whether a factor of their case takes them away or another case"""
    faults = []
    for n in (1, 10):
        one, _ = solved(program, folder, 'one', first((('LATERAL', 0.4),), ((1, 1), *[(-1/n, 1)]*n), pressed=False))
        two, _ = solved(program, folder, 'two', first((('LATERAL', 0.4), ('LATERAL', -0.4)), ((1, 1), *[(1/n, 2)]*n), pressed=False))
        left = [summary['increments'][-1]['largest_displacement'] for summary in (one, two)]
        faults += close(f'{n} increments', left[0], left[1], 1e-5*left[0]) + expected('something is left', True, left[0] > 1e-6)
    return faults


def sliding_ring(program, folder):
    """A ring that is pressed on its bed slides, and is said to: not to move along z"""
    summary, _ = solved(program, folder, 'ring', ANNULUS, code=4)
    return expected('mechanism', True, says(summary, 'slides sideways') or 'slides sideways' in read_text(os.path.join(folder, 'ring.lis')))


def tests(program):
    """The tests of this module"""
    named = {'lasting slip': lasting_slip, 'softening': softening, 'turning slip': turning, 'no load left': no_load,
             'sliding ring': sliding_ring}
    return [Test(f'paths: {name}', lambda folder, function=function: function(program, folder)) for name, function in named.items()]
