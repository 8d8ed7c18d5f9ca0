"""Tests of the Python package; only where NumPy and h5py are installed"""
import os
import subprocess

from support import HERE, Test, python_with

FOLDER = os.path.join(HERE, '..', '..', 'python', 'tests')
# What draws
DRAWING = ('test_plot', 'test_gallery')


def tests(program):
    """One test for each file of python/tests"""
    drawing = python_with('numpy, h5py, matplotlib, plotly')
    python = drawing or python_with('numpy, h5py')
    if python is None:
        return []
    # test_report and test_convert say what they skip
    names = sorted(name for name in os.listdir(FOLDER)
                   if name.startswith('test_') and (drawing or not name.startswith(DRAWING)))
    return [Test(f'python/{name[5:-3]}', lambda folder, name=name: faults(program, python, name))
            for name in names]


def faults(program, python, name):
    """Faults that a file of tests finds"""
    done = subprocess.run([python, '-B', os.path.join(FOLDER, name)], capture_output=True, text=True,
                          check=False, env=dict(program.environment, AXIJOINT=program.path))
    return [f'exit code {done.returncode}\n{done.stdout}{done.stderr}'] if done.returncode else []
