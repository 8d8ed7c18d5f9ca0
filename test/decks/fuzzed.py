"""A few inputs changed by chance, the same in every run, and those that once failed; `scripts/fuzz` tries any number"""
import os
import sys

from support import HERE, Test

COUNT, SEED = 100, 18


def fuzzed(program, _folder):
    """All kinds of inputs"""
    sys.path.insert(0, os.path.join(HERE, '..', 'fuzz'))
    import fuzz  # it stands in a folder of its own, with what once failed

    return [fault for part in fuzz.all_kinds(program, COUNT, SEED) for fault in part.found]


def tests(program):
    """One test"""
    return [Test('fuzzed inputs', lambda folder: fuzzed(program, folder))]
