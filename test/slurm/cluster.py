"""A real Slurm of one node on the loopback address, with all its files in a folder of its own"""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ('munged', 'slurmctld', 'slurmd', 'sbatch', 'scontrol')
CONFIGURATION = """ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_min_interval=100000,sched_interval=2
ReturnToService=2
KillWait=10
MpiDefault=none
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
NodeName={host} NodeAddr=127.0.0.1 CPUs={processors} RealMemory={memory} State=UNKNOWN
PartitionName=main Nodes={host} Default=YES State=UP
"""


def why_not():
    """In words, why there can be no cluster here; empty if there can"""
    if os.geteuid() != 0:
        return 'only root can start one'
    missing = [name for name in PROGRAMS if not shutil.which(name, path=search_path())]
    return f"there is no {', '.join(missing)} (scripts/setup slurm)" if missing else ''


def search_path():
    """Where programs are; daemons are not on everybody's path"""
    return os.environ.get('PATH', '') + ':/usr/sbin:/sbin'


class Cluster:
    """The cluster, as long as the `with` block lasts. environment: what its commands and jobs need"""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)/'slurm'
        self.daemons = []
        self.environment = dict(os.environ, PATH=search_path(), SLURM_CONF=str(self.folder/'slurm.conf'))

    def __enter__(self):
        for name in ('state', 'spool'):
            (self.folder/name).mkdir(parents=True)
        self.folder.chmod(0o755)
        key = self.folder/'munge.key'
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        memory = os.sysconf('SC_PAGE_SIZE')*os.sysconf('SC_PHYS_PAGES')//2**20
        (self.folder/'slurm.conf').write_text(CONFIGURATION.format(
            host=socket.gethostname().split('.')[0], ports=free_ports(2), folder=self.folder,
            processors=os.cpu_count(), memory=memory//2))
        try:
            self.start('munged', '--foreground', '--force', f'--socket={self.folder}/munge.socket', f'--key-file={key}',
                       f'--pid-file={self.folder}/munged.pid', f'--seed-file={self.folder}/munged.seed')
            self.wait_for((self.folder/'munge.socket').exists, 'munged')
            self.start('slurmctld', '-D', '-i')
            self.start('slurmd', '-D')
            self.wait_for(lambda: self.command('sinfo', '-h', '-o', '%T', check=False).strip() == 'idle', 'Slurm')
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *_):
        self.stop()

    def start(self, program, *arguments):
        """Start a daemon, which stays a child of this process"""
        with open(self.folder/f'{program}.log', 'ab') as log:
            self.daemons.append(subprocess.Popen(
                [shutil.which(program, path=search_path()), *arguments], stdin=subprocess.DEVNULL, stdout=log,
                stderr=log, env=self.environment, start_new_session=True))

    def stop(self):
        """End jobs and daemons"""
        if len(self.daemons) > 1:
            self.command('scancel', '--user=root', check=False)
            end = time.time() + 15
            while self.command('squeue', '--noheader', check=False).strip() and time.time() < end:
                time.sleep(0.2)
        for daemon in reversed(self.daemons):
            if daemon.poll() is None:
                daemon.send_signal(signal.SIGTERM)
                try:
                    daemon.wait(15)
                except subprocess.TimeoutExpired:
                    daemon.kill()
                    daemon.wait()

    def wait_for(self, condition, what, seconds=60):
        """Wait until something holds"""
        end = time.time() + seconds
        while not condition():
            if time.time() > end or any(daemon.poll() is not None for daemon in self.daemons):
                logs = ''.join(f'{log.name}:\n{log.read_text()[-2000:]}' for log in self.folder.glob('*.log'))
                raise RuntimeError(f'{what} does not come\n{logs}')
            time.sleep(0.2)

    def command(self, *words, check=True, **options):
        """What a command of Slurm prints"""
        done = subprocess.run(words, env=self.environment, capture_output=True, text=True, check=False, timeout=60,
                              **options)
        if check and done.returncode:
            raise RuntimeError(f"{' '.join(map(str, words))}: {done.stdout}{done.stderr}")
        return done.stdout

    def submit(self, folder, *words, **variables):
        """Submit a job from a folder: its number"""
        exports = ','.join(['ALL', *(f'{name}={value}' for name, value in variables.items())])
        return self.command('sbatch', '--parsable', f'--export={exports}', *words, cwd=folder).strip()

    def states(self, job):
        """Records of a job, or of the tasks of an array: dictionaries of what scontrol tells"""
        text = self.command('scontrol', '-o', 'show', 'job', job, check=False)
        return [dict(word.split('=', 1) for word in line.split() if '=' in word) for line in text.splitlines() if line]

    def finish(self, *jobs, seconds=300):
        """Wait until jobs have ended: exit codes of each job's tasks, by their numbers (0 of no array)"""
        left = ('PENDING', 'CONFIGURING', 'RUNNING', 'COMPLETING', 'SUSPENDED', 'REQUEUED')
        self.wait_for(lambda: all(one['JobState'] not in left for job in jobs for one in self.states(job)), 'a job',
                      seconds)
        return [{int(one.get('ArrayTaskId', 0)): int(one['ExitCode'].split(':')[0]) for one in self.states(job)}
                for job in jobs]


def free_ports(count):
    """Ports that nobody uses"""
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(('127.0.0.1', 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports
