"""Tests of the Python package; only where NumPy and h5py are installed"""
import os
import subprocess

from support import HERE, Test

FOLDER = os.path.join(HERE, '..', '..', 'python', 'tests')
PYTHON = '/usr/bin/python3'
# With matplotlib, where `scripts/setup plot` has been run, and with pandas, xarray and PyVista after
# `scripts/setup python`
PLOT_PYTHON = os.path.join(HERE, '..', '..', '.tools', 'venv', 'bin', 'python3')


def tests(program):
    """One test for each file of python/tests"""
    names = sorted(name for name in os.listdir(FOLDER) if name.startswith('test_'))
    plots = [name for name in names if name.startswith(('test_plot', 'test_report', 'test_convert', 'test_gallery'))]
    found = [(PYTHON, name) for name in names if name not in plots] if has(PYTHON, 'numpy, h5py') else []
    if has(PLOT_PYTHON, 'matplotlib, h5py'):
        found += [(PLOT_PYTHON, name) for name in plots]
    elif found:
        found += [(PYTHON, name) for name in ('test_report.py', 'test_convert.py')]  # say what they skip
    return [Test(f'python/{name[5:-3]}',
                 lambda folder, python=python, name=name: faults(program, python, name))
            for python, name in found]


def has(python, modules):
    """Whether a Python has some modules"""
    return os.access(python, os.X_OK) and not subprocess.run(
        [python, '-c', f'import {modules}'], capture_output=True, check=False).returncode


def faults(program, python, name):
    """Faults that a file of tests finds"""
    done = subprocess.run([python, '-B', os.path.join(FOLDER, name)], capture_output=True, text=True,
                          check=False, env=dict(program.environment, AXIJOINT=program.path))
    return [f'exit code {done.returncode}\n{done.stdout}{done.stderr}'] if done.returncode else []
