"""Cases of the manual"""


def all_cases():
    """All cases, in the order of the manual"""
    from cases import capacity, effectivity, envelope, gmsh, hard, piles, rings, shapes, solids, yield_errors, yielding
    return [*solids.CASES, *rings.CASES, *hard.CASES, *shapes.CASES, *gmsh.CASES,
            *effectivity.CASES, *yielding.CASES,
            *capacity.CASES, *envelope.CASES, *piles.CASES,
            *yield_errors.CASES]
