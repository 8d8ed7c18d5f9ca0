"""What all deck tests need: to run the program, and to say what is wrong"""
import atexit
import functools
import os
import re
import resource
import subprocess
import tempfile

HERE = os.path.dirname(os.path.realpath(__file__))
INPUTS = os.path.join(HERE, '..', '..', 'inputs')

# That of scripts/setup: with VTK after `scripts/setup vtk`, with matplotlib after `scripts/setup plot`, with pandas,
# xarray and PyVista after `scripts/setup python`; and that of the system
PYTHONS = (os.path.join(HERE, '..', '..', '.tools', 'venv', 'bin', 'python3'), '/usr/bin/python3')

# Seconds after which a program counts as hanging, and after which one of a long test does
TIME_LIMIT, LONG_LIMIT = 60, 1200
# What the run-time library prints where the program has lost control
CRASH = re.compile(r'Fortran runtime|Backtrace|rror termination|SIG[A-Z]{3,}|\nAt line|AddressSanitizer|: runtime error:')
# User that may neither read nor write what the test keeps from it
NOBODY = 65534


class Test:
    """A name, a function of an empty folder that returns a list of faults, and whether it takes minutes"""

    def __init__(self, name, check, long=False):
        self.name = name
        self.check = check
        self.long = long


class Outcome:
    """What a run of the program left"""

    def __init__(self, code, out, err):
        self.code = code
        self.out = out
        self.err = err

    def crash(self):
        """Faults: a signal, a backtrace"""
        if self.code < 0:
            return [f'expected an exit code, found signal {-self.code}\n{self.err}']
        if CRASH.search(self.err) or CRASH.search(self.out):
            return [f'found a crash: {self.out}{self.err}']
        return []

    def ended_with(self, code):
        """Faults: a crash, another exit code"""
        faults = self.crash()
        if self.code != code:
            faults.append(f'expected exit code {code}, found {self.code}\n{self.err}')
        return faults


class Program:
    """The program under test"""

    def __init__(self, path):
        self.path = os.path.realpath(path)
        if not os.access(self.path, os.X_OK):
            raise SystemExit(f'{path} is no program')
        # Of `scripts/build sanitized`: what the compiler forgets to give back is no fault of the program
        self.sanitized = b'__asan_init' in read_bytes(self.path)
        if self.sanitized:  # whoever calls it, the verification and the benchmarks, too
            os.environ.update(ASAN_OPTIONS='detect_leaks=0:verify_asan_link_order=0', UBSAN_OPTIONS='halt_on_error=1:print_stacktrace=1')
        self.environment = dict(os.environ, OPENBLAS_NUM_THREADS='1', LC_ALL='C')

    def run(self, *arguments, folder='.', limits=(), path=None, time_limit=None, **options):
        """Run it in a folder. limits: pairs of a limit of `resource` and its value"""

        def set_limits():
            for limit, value in limits:
                resource.setrlimit(limit, (value, resource.getrlimit(limit)[1]))

        options.setdefault('stdout', subprocess.PIPE)
        time_limit = (time_limit or TIME_LIMIT)*(5 if self.sanitized else 1)
        done = subprocess.run([path or self.path, *arguments], cwd=folder, env=self.environment,
                              stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, timeout=time_limit,
                              preexec_fn=set_limits if limits else None, **options)
        return Outcome(done.returncode, (done.stdout or b'').decode('utf-8', 'replace'),
                       done.stderr.decode('utf-8', 'replace'))

    def run_as_nobody(self, *arguments, folder):
        """Run it as a user whom file modes stop; root is stopped by none"""
        if os.geteuid() != 0:
            return self.run(*arguments, folder=folder)
        with tempfile.TemporaryDirectory(prefix='axijoint-decks-') as place:
            os.chmod(place, 0o755)
            # By a process of its own: a copy that is open for writing in this one, which other tests
            # fork meanwhile, would be busy
            path = os.path.join(place, 'axijoint')
            subprocess.run(['cp', self.path, path], check=True)
            return self.run(*arguments, folder=folder, path=path, user=NOBODY, group=NOBODY,
                            extra_groups=[])


@functools.cache
def python_with(modules):
    """A Python that has some modules, 'numpy, h5py'; None if there is none, which is said once, as tests that need it are then
    left out, or pass in part"""
    for python in PYTHONS:
        if os.access(python, os.X_OK) and not subprocess.run([python, '-c', f'import {modules}'],
                                                             capture_output=True, check=False).returncode:
            return python
    print(f'deck tests: what needs a Python with {modules} is left out (scripts/setup verify, plot, python or vtk)')
    return None


@functools.cache
def preload(name):
    """A library of scripts/preload, built once, that is loaded before others"""
    folder = tempfile.TemporaryDirectory(prefix='axijoint-preload-')
    atexit.register(folder.cleanup)
    library = os.path.join(folder.name, f'{name}.so')
    subprocess.run(['gcc', '-O2', '-fno-builtin', '-shared', '-fPIC', '-o', library,
                    os.path.join(HERE, '..', '..', 'scripts', 'preload', f'{name}.c'), '-ldl'], check=True)
    return library


def write(folder, name, content):
    """Write a file of a text or of bytes, and return its path"""
    path = os.path.join(folder, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, 'wb') as file:
        file.write(content.encode() if isinstance(content, str) else content)
    return path


def read_bytes(path):
    """All bytes of a file"""
    with open(path, 'rb') as file:
        return file.read()


def read_text(path):
    """A file as text"""
    return read_bytes(path).decode('utf-8', 'replace')


def input_deck(name):
    """Text of a deck of `inputs`"""
    return read_text(os.path.join(INPUTS, name))


def expected(what, wanted, found):
    """A fault, unless what was found is what was wanted"""
    return [] if wanted == found else [f'{what}: expected {wanted}, found {found}']


class EarlierResults:
    """Result files of an earlier run, which a failing run must leave as they are"""

    def __init__(self, folder, name):
        self.folder = folder
        self.contents = {f'{name}.{ending}': f'an earlier {ending} file\n'.encode()
                         for ending in ('lis', 'json', 'h5')}
        for file, content in self.contents.items():
            write(folder, file, content)

    def faults(self):
        """Files that changed, vanished or appeared"""
        faults = []
        for file, content in self.contents.items():
            path = os.path.join(self.folder, file)
            if not os.path.isfile(path) or read_bytes(path) != content:
                faults.append(f'the earlier {file} was changed')
        for file in sorted(set(os.listdir(self.folder)) - set(self.contents)):
            faults.append(f'found a file {file}')
        return faults
