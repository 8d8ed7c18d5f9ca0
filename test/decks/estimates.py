"""Estimates of errors where they are hard to come by: joints that reach the axis"""
from hard_decks import solved
from support import Test

# A disc on soil, pressed and pushed sideways, with a joint that reaches the axis
FOOTING = """TITLE
Disc on soil
CONTROL
2,,,,,,NEWTON
MATERIALS
1,10000,0.2
LAWS
1,40000,40000,40000,0,10.0,PAPER,LOBATTO
BLOCKS
1,1,4,{across},{half}
0,0,1,0.5
2,1,4,{across},{along}
0,-2,1,0
2,1,4,{across},{along}
1,-2,3,0
FACES
1,1,0,0.5,1,0.5
2,1,0,0,1,0
3,2,0,0,1,0
4,2,0,-2,3,-2
INTERFACES
1,2,3
FIXEDFACES
4,111
RESULTANTS
1,AXIAL,-4.0
1,LATERAL,0.4
INCREMENTS
1.0,1E-8
END
"""


def reaches_axis(program, folder):
    """A point on the axis has no weight in the rule of 4-node elements: the error of the mesh is found nevertheless"""
    errors, moved = {}, {}
    for size in (1, 4):
        summary, _ = solved(program, folder, f'axis{size}', FOOTING.format(across=3*size, half=2*size, along=4*size))
        errors[size], moved[size] = summary['errors']['discretization'], summary['increments'][-1]['largest_displacement']
    least, found = abs(moved[1]/moved[4] - 1.0), errors[1]
    faults = [] if least < found['displacement'] < 0.5 else [f'displacement: estimate {found["displacement"]}, true more than {least}']
    return faults + ([] if 0.3 < found['joint_stress'] < 1.5 else [f'joint stress: estimate {found["joint_stress"]}'])


def tests(program):
    """The tests of this module"""
    named = {'joint that reaches the axis': reaches_axis}
    return [Test(f'estimates: {name}', lambda folder, function=function: function(program, folder)) for name, function in named.items()]
