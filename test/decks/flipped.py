"""Flipped bits in results files: reading fails, or what is read is right. Only where NumPy and h5py are installed"""
import os
import subprocess

from support import HERE, INPUTS, Test, python_with

# Bits that are flipped in each file, one at a time, at equal distances from its first byte to its last
COUNT = 200


def flipped(program, folder, ending, *options):
    """Nothing wrong is read from a file of a run with a flipped bit"""
    python = python_with('numpy, h5py')
    if not python:
        return []
    ran = program.run('run', os.path.join(INPUTS, 'first.dat'), *options, folder=folder)
    faults = ran.ended_with(0)
    done = subprocess.run([python, '-B', os.path.join(HERE, 'read_flipped.py'), os.path.join(folder, f'first.{ending}'),
                           str(COUNT)], capture_output=True, text=True, check=False)
    if done.returncode:
        faults.append(f'{ending}: exit code {done.returncode}\n{done.stdout}{done.stderr}')
    return faults


def tests(program):
    """One test a kind of file"""
    return [Test('flipped bits: results', lambda folder: flipped(program, folder, 'h5')),
            Test('flipped bits: swept bodies', lambda folder: flipped(program, folder, 'vtkhdf', '--vtk'))]
