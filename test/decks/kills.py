"""Runs that are killed while they write: `kill_test`, a few rounds"""
import os
import subprocess

from support import HERE, INPUTS, Test

ROUNDS = '8'


def killed(program, _):
    """Faults that kill_test finds"""
    done = subprocess.run([os.path.join(HERE, 'kill_test'), program.path,
                           os.path.join(INPUTS, 'first.dat'), ROUNDS], capture_output=True,
                          text=True, timeout=300, check=False,
                          env=dict(program.environment, KILL_SEED='1'))
    return [] if done.returncode == 0 else [done.stdout + done.stderr]


def tests(program):
    """One test for all rounds"""
    return [Test('killed runs', lambda folder: killed(program, folder))]
