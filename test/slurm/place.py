"""A folder that jobs are submitted from, and what they leave there"""
import csv
import os
import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT/'test/decks')]

from same_bits import digests  # noqa: E402
from support import read_text  # noqa: E402

SCRIPTS = ROOT/'scripts/slurm'
NO_MPI = 'AXIJOINT_MPI names no program for MPI, or there is no mpirun'


class Place:
    """The program, the cluster, and a folder that jobs are submitted from"""

    def __init__(self, program, cluster, folder, history):
        self.program, self.cluster, self.folder, self.history = program, cluster, folder, history
        self.has_mpi = 'AXIJOINT_MPI' in os.environ and shutil.which('mpirun')

    def path(self, *names):
        """A path in the folder"""
        return os.path.join(self.folder, *names)

    def submit(self, script, *words, before=()):
        """Submit one of the scripts: the number of the job"""
        variables = {'AXIJOINT': self.program.path}
        if script == 'mpi.sh':
            variables = {'AXIJOINT_MPI': os.environ['AXIJOINT_MPI'], 'OMPI_MCA_mpi_yield_when_idle': '1',
                         'OMPI_ALLOW_RUN_AS_ROOT': '1', 'OMPI_ALLOW_RUN_AS_ROOT_CONFIRM': '1'}
        return self.cluster.submit(self.folder, *before, SCRIPTS/script, *words, **variables)

    def output(self, job):
        """What a job has printed, all of its starts"""
        return ''.join(read_text(self.path(name)) for name in sorted(os.listdir(self.folder))
                       if re.fullmatch(rf'slurm-{job}(_\d+)?\.out', name))

    def outputs(self):
        """What all jobs have printed, for messages"""
        return ''.join(f'{name}:\n{read_text(self.path(name))}' for name in sorted(os.listdir(self.folder))
                       if name.startswith('slurm-'))


def same(place, one, other):
    """A fault unless two results are the same bits, but for dates and times"""
    texts = digests([place.path(one), place.path(other)])
    return [] if len(set(texts)) == 1 else [f'{one} and {other} differ']


def rows_of(path):
    """Rows of a study but for times"""
    with open(path, encoding='utf-8') as file:
        return [{name: value for name, value in row.items() if name != 'seconds'} for row in csv.DictReader(file)]
