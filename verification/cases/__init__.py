"""Cases of the manual"""


def all_cases():
    """All cases, in the order of the manual"""
    from cases import effectivity, gmsh, hard, rings, shapes, solids
    return [*solids.CASES, *rings.CASES, *hard.CASES, *shapes.CASES, *gmsh.CASES,
            *effectivity.CASES]
