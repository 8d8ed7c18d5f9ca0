"""Tests of the Python package; only where NumPy and h5py are installed"""
import os
import subprocess

from support import HERE, Test

FOLDER = os.path.join(HERE, '..', '..', 'python', 'tests')
PYTHON = '/usr/bin/python3'


def tests(program):
    """One test for each file of python/tests"""
    if subprocess.run([PYTHON, '-c', 'import numpy, h5py'], capture_output=True, check=False).returncode:
        return []
    names = sorted(name for name in os.listdir(FOLDER) if name.startswith('test_'))
    return [Test(f'python/{name[5:-3]}', lambda folder, name=name: faults(program, name))
            for name in names]


def faults(program, name):
    """Faults that a file of tests finds"""
    done = subprocess.run([PYTHON, '-B', os.path.join(FOLDER, name)], capture_output=True, text=True,
                          check=False, env=dict(program.environment, AXIJOINT=program.path))
    return [f'exit code {done.returncode}\n{done.stdout}{done.stderr}'] if done.returncode else []
