"""Histories and studies that are stopped in the middle, in all ways that Slurm has, and go on"""
import os
import pathlib
import re
import time

from place import NO_MPI, rows_of, same
from support import INPUTS, expected, input_deck, write

# 400 rows
TABLE = 'LAWS 1 PHI, LAWS 1 C, RESULTANTS 1 VALUE\n0:38/20, 0:0.4/10, 0.2;0.4\n'


class History:
    """A deck whose run takes some seconds, and its results without interruption"""

    def __init__(self, program, folder):
        self.folder, self.count = folder, 40
        took = self.run(program)
        self.count = min(4000, int(self.count*12/took))
        self.run(program)

    def text(self, harmonics=4):
        """The peg of first.dat, pushed to and fro"""
        factors = ['0.5', *('0.3', '-0.3')*(self.count//2)]
        cards = ''.join(f'{factor:>10}{"1.0E-7":>10}{400:5d}\n' for factor in factors)
        text = input_deck('first.dat').replace('harmonic M\n    4\n', f'harmonic M\n{harmonics:5d}{"":35}NEWTON\n')
        return text.replace('\nEND', f'\nINCREMENTS\n{cards}END')

    def run(self, program):
        """Run by hand: the time"""
        start = time.time()
        write(self.folder, 'history.dat', self.text())
        faults = program.run('run', 'history.dat', '-o', 'whole', '--threads', '1', folder=self.folder,
                             time_limit=300).ended_with(0)
        if faults:
            raise RuntimeError(faults)
        return time.time() - start


def interrupted(place, end, before=(), again='', script='one.sh', text='', whole='../whole/history'):
    """A history that is stopped in the middle goes back to the queue and on, to the same bits"""
    write(place.folder, 'history.dat', text or place.history.text())
    job = place.submit(script, 'history.dat', '-o', 'out', '--checkpoint', '0.01', before=before)
    place.cluster.wait_for(lambda: increment_of(place) >= 3, 'an increment')
    end(place, job)
    place.cluster.wait_for(lambda: 'stopped by' in place.output(job), 'the stop')
    faults = ['the history was over before it was stopped'] if os.path.exists(place.path('out', 'history.h5')) else []
    faults += expected('exit code', [{0: 0}], place.cluster.finish(job))
    text = place.output(job)
    faults += [f'{words!r} is not said' for words in ('goes on from out/history.state', again) if words not in text]
    stopped, went_on = (re.findall(pattern, text) for pattern in (
        r'stopped by \w+ after increment (\d+)', r'goes on from \S+ increment (\d+)'))
    if stopped != went_on or not 0 < int(stopped[0]):
        faults.append(f'stopped after increments {stopped}, went on from {went_on}')
    return faults + same(place, 'out/history', whole)


def increment_of(place):
    """Increments that the state tells of; 0 without one"""
    try:
        found = re.search(rb'increment (\d+) of', pathlib.Path(place.path('out', 'history.state')).read_bytes()[:2000])
    except FileNotFoundError:
        return 0
    return int(found[1]) if found else 0


def warned(place):
    """The signal of --signal=B:USR1, as Slurm sends it before the time is over"""
    return interrupted(place, lambda place, job: place.cluster.command('scancel', '--signal=USR1', '--batch', job),
                       again='The job goes back to the queue')


def mpi_warned(place):
    """The same in two processes by MPI"""
    if not place.has_mpi:
        return NO_MPI
    return interrupted(place, lambda place, job: place.cluster.command('scancel', '--signal=USR1', '--batch', job),
                       again='The job goes back to the queue', script='mpi.sh')


def pre_empted(place):
    """Slurm puts the job back itself, as for one that is more urgent"""
    return interrupted(place, lambda place, job: place.cluster.command('scontrol', 'requeue', job))


def out_of_time(place):
    """The time limit is near: nobody but Slurm does anything, and that twice a minute, which takes a longer history"""
    text = place.history.text(harmonics=32)
    write(place.folder, 'longer.dat', text)
    place.program.run('run', 'longer.dat', '-o', 'whole', '--threads', '1', folder=place.folder, time_limit=300)
    return interrupted(place, lambda place, job: None, before=['--time=1', '--signal=B:USR1@55'],
                       again='The job goes back to the queue', text=text, whole='whole/longer')


def in_vain(place):
    """A job in whose time nothing was kept would begin the same again and again: it ends, and says so"""
    write(place.folder, 'history.dat', 'TITLE\nTube\nCONTROL\n12\nMATERIALS\n1,2E5,0.3\nBLOCKS\n1,1,8,160,160\n1,0,2,1\nFACES\n'
          '1,1,1,0,2,0\n2,1,2,0,2,1\nFIXEDFACES\n1,111\nSHAPES\n1,PATCH,-20,20\nPRESSURES\n2,,1,1,,1\nEND\n')
    job = place.submit('one.sh', 'history.dat', '-o', 'out')
    place.cluster.wait_for(lambda: os.path.exists(place.path('out', 'history.lock')), 'the run')
    place.cluster.command('scancel', '--signal=USR1', '--batch', job)
    faults = expected('exit code', [{0: 75}], place.cluster.finish(job))
    text = place.output(job)
    faults += [f'{words!r} is not said' for words in ('stopped by SIGUSR1 before anything was kept', 'nothing was kept that it could go on from')
               if words not in text]
    return faults + expected('files', [], os.listdir(place.path('out')))


def cancelled(place):
    """A job that is cancelled is stopped, and stays cancelled; submitted again it goes on"""
    write(place.folder, 'history.dat', place.history.text())
    job = place.submit('one.sh', 'history.dat', '-o', 'out', '--checkpoint', '0.01')
    place.cluster.wait_for(lambda: increment_of(place) >= 3, 'an increment')
    place.cluster.command('scancel', job)
    place.cluster.finish(job)
    faults = expected('state', ['CANCELLED'], [one['JobState'] for one in place.cluster.states(job)])
    if 'stopped by' not in place.output(job) or 'back to the queue' in place.output(job):
        faults.append('the job was not stopped, or put back')
    job = place.submit('one.sh', 'history.dat', '-o', 'out')
    faults += expected('exit code', [{0: 0}], place.cluster.finish(job))
    if 'goes on from' not in place.output(job):
        faults.append('the second job begins anew')
    return faults + same(place, 'out/history', '../whole/history')


def study_warned(place):
    """A part of a study that is stopped goes back to the queue; the job that gathers waits for it"""
    deck, journal = os.path.join(INPUTS, 'case3_balanced.dat'), place.path('out', 'states.study.1of2.rows')
    write(place.folder, 'states.csv', TABLE)
    array = place.submit('study.sh', '2', 'states.csv', deck, '-o', 'out', before=['--array=1-2'])
    gather = place.submit('study.sh', '2', 'states.csv', deck, '-o', 'out',
                          before=[f'--dependency=afterany:{array}'])
    place.cluster.wait_for(lambda: lines_of(journal) > 10, 'a row')
    place.cluster.command('scancel', '--signal=USR1', '--batch', f'{array}_1')
    place.cluster.finish(array, gather)
    text = place.output(array)
    faults = [f'{words!r} is not said' for words in ('stopped by SIGUSR1', 'The job goes back to the queue',
                                                     'rows of 400 were done before') if words not in text]
    if '400 rows, 0 solved now' not in place.output(gather):
        faults.append('the last job has not waited')
    place.program.run('study', 'states.csv', deck, '-o', 'whole', folder=place.folder, time_limit=300)
    return faults + expected('rows', rows_of(place.path('whole/states.study.csv')),
                             rows_of(place.path('out/states.study.csv')))


def lines_of(path):
    """Lines of a file; none if it is not there"""
    return pathlib.Path(path).read_text(encoding='utf-8').count('\n') if os.path.exists(path) else 0


CHECKS = (warned, mpi_warned, pre_empted, out_of_time, in_vain, cancelled, study_warned)
