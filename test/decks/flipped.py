"""Flipped bits in results files: reading fails, or what is read is right. Only where NumPy and h5py are installed"""
import json
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


# Groups that `axijoint compare` looks into, of a deck with cuts and sections and of one that yields
GROUPS = (('sections', ('history', 'history/points', 'sections', 'sections/1', 'cuts', 'supports', 'joints')),
          ('yield_column', ('history', 'history/points', 'yield')))
# Byte of a group's header in which a bit is flipped: the checksum of the header guards it
IN_HEADER = 12
ADDRESSES = """import h5py, json, sys
with h5py.File(sys.argv[1]) as file:
    print(json.dumps([h5py.h5o.get_info(file[name].id).addr for name in sys.argv[2:]]))"""


def damaged_groups(program, folder):
    """A group that is there and cannot be opened is none that lacks: neither file of a comparison may have one"""
    python = python_with('numpy, h5py')
    if not python:
        return []
    faults = []
    for name, groups in GROUPS:
        program.run('run', os.path.join(HERE, 'good', f'{name}.dat'), '-o', folder, folder=folder)
        sound, hurt = (os.path.join(folder, f'{name}{ending}.h5') for ending in ('', '_hurt'))
        done = subprocess.run([python, '-B', '-c', ADDRESSES, sound, *groups], capture_output=True, text=True, check=True)
        with open(sound, 'rb') as file:
            whole = file.read()
        for group, address in zip(groups, json.loads(done.stdout)):
            flipped_bit = bytearray(whole)
            flipped_bit[address + IN_HEADER] ^= 4
            with open(hurt, 'wb') as file:
                file.write(flipped_bit)
            for pair in ((hurt, sound), (sound, hurt), (hurt, hurt)):
                compared = program.run('compare', *pair, folder=folder)
                faults += [f'{name}, /{group}: {fault}' for fault in compared.ended_with(2)]
    return faults


def tests(program):
    """One test a kind of file, and one of comparisons"""
    return [Test('flipped bits: groups', lambda folder: damaged_groups(program, folder)),
            Test('flipped bits: results', lambda folder: flipped(program, folder, 'h5')),
            Test('flipped bits: swept bodies', lambda folder: flipped(program, folder, 'vtkhdf', '--vtk'))]
