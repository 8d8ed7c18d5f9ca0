"""Cases of the manual"""


def all_cases():
    """All cases, in the order of the manual"""
    from cases import rings
    return [*rings.CASES]
