"""One case of scripts/verify, or all of them, its check of solutions, a row of scripts/bench stability, or all; only where
NumPy and h5py are installed"""
import os
import subprocess

from support import HERE, Test, python_with

FOLDER = os.path.join(HERE, '..', '..', 'verification')
# A solution with one stress off by a millionth must be refused
WRONG_SOLUTION = '''
import dataclasses, sys
sys.path.insert(0, sys.argv[1])
import residual
from material import Isotropic
from solutions.polynomials import flexure
right = flexure(Isotropic(2.1e5, 0.3))
residual.check(right)
for component in range(6):
    def stress(r, z):
        found = right.stress(r, z)
        found[component] = found[component]*(1 + 1e-6) + 1e-6*r*z
        return found
    try:
        residual.check(dataclasses.replace(right, stress=stress))
    except residual.ResidualError:
        continue
    sys.exit(f"a wrong stress {component} passed")
'''


def tests(program):
    """A case, and the check of its solution"""
    if python_with('numpy, h5py') is None:
        return []
    return [Test('verification/shaft', lambda folder: case_faults(program, folder, 'shaft')),
            Test('verification/all cases', lambda folder: case_faults(program, folder), long=True),
            Test('verification/wrong solution', wrong_solution_faults),
            Test('bench/stability', lambda folder: stability_faults(program, folder, '--only', 'joints in a T')),
            Test('bench/stability, all rows', lambda folder: stability_faults(program, folder), long=True)]


def case_faults(program, folder, *names):
    """Faults of some cases, or of all"""
    return faults_of([os.path.join(FOLDER, 'main.py'), '--program', program.path, '--check',
                      '-o', folder, *names])


def stability_faults(program, folder, *rows):
    """Faults of some rows of the stability table, or of all"""
    return faults_of([os.path.join(HERE, '..', '..', 'bench', 'stability.py'), '--program', program.path, *rows, '-o', folder])


def wrong_solution_faults(folder):
    """Faults of the check of solutions"""
    del folder
    return faults_of(['-c', WRONG_SOLUTION, FOLDER])


def faults_of(arguments):
    """Faults of a run of Python"""
    done = subprocess.run([python_with('numpy, h5py'), '-B', *arguments], capture_output=True, text=True, check=False)
    return [f'exit code {done.returncode}\n{done.stdout}{done.stderr}'] if done.returncode else []
