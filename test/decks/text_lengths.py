"""Threads run no procedure at the same time that calls a function which gives a text of any length: gfortran keeps that length in a
static variable (`slen`), so that one thread may take the length of the other's text. Seen in the machine code of the program, but for
procedures that are called by the type of an object"""
import collections
import re
import shutil
import subprocess

from support import Test, expected

# Parts of parallel regions that run at once, as parts of names; what both of two may reach
AT_ONCE = [
    (('output_hdf5_results_MOD_write_results', 'output_file_hdf5'),
     ('output_listing_contents_MOD_write_listing', 'output_file_text_MOD_put', 'output_file_row', 'base_stream', 'base_digits'),
     ('yield_errors_MOD',)),  # one thread where bodies yield
    (('plan_levels._omp_fn.0',), ('plan_levels._omp_fn.1',), ()), (('plan_levels._omp_fn.0',), ('plan_levels._omp_fn.2',), ()),
    (('plan_levels._omp_fn.1',), ('plan_levels._omp_fn.2',), ()),
    (('run_and_find._omp_fn.0', 'newton_method_MOD_balance', 'joints_total_MOD_balance', 'joints_transfer_MOD_balance',
      'joints_increments_MOD', 'job_checkpoint_MOD'),
     ('fields_beside_MOD_keep._omp_fn.0', 'fields_beside_MOD_find_states', 'increment_fields_MOD_recover_state', 'solver_sparse_MOD_solve', 'solver_type_MOD_solve_apart'),
     ('report_failure',)),  # all factors are there
    (('job_read_MOD_read_job',), ('file_hdf5_MOD_start_library',), ())]
# Regions that reach such procedures in one thread at a time: as above, and in an ordered part
ALONE = ('write_arrays_and_listing', 'structure_MOD_plan_levels', 'output_increments_MOD_write_increments',
         'fields_beside_MOD_run_and_find', 'fields_beside_MOD_keep', 'command_run_MOD_begin')


def code_of(path):
    """What each procedure calls, and those with such a variable"""
    calls, static, name = collections.defaultdict(set), set(), None
    with subprocess.Popen(['objdump', '-d', '--no-show-raw-insn', path], stdout=subprocess.PIPE, text=True) as code:
        for line in code.stdout:
            if line.endswith('>:\n'):
                name = line[line.index('<') + 1:-3]
            elif name and '<' in line:
                other = re.search(r'<([^>+]+)', line)[1]
                if other.startswith('slen.'):
                    static.add(name)
                elif other != name:
                    calls[name].add(other)
    return calls, static


def reached(calls, begin):
    """All procedures that some begin with, other parallel regions left out"""
    found, left = set(begin), list(begin)
    while left:
        for other in calls.get(left.pop(), ()):
            if other not in found and '_omp_fn' not in other:
                found.add(other)
                left.append(other)
    return found


def tests(program):
    """One test"""

    def check(_):
        if shutil.which('objdump') is None:
            return []
        calls, static = code_of(program.path)
        named = lambda parts: [name for name in calls if any(part in name for part in parts)]
        faults = [] if static else ['no such variable is seen']
        faults += [f'no procedure is named {part}' for one, other, _ in AT_ONCE for part in (*one, *other) if not named([part])]
        faults += [f'no region is named {part}' for part in ALONE if not any(part in region for region in named(['_omp_fn']))]
        for one, other, allowed in AT_ONCE:
            both = reached(calls, named(one)) & reached(calls, named(other)) & static
            faults += expected(f'{one[0]} and {other[0]}', [], sorted(name for name in both if not any(part in name for part in allowed)))
        for region in named(['_omp_fn']):
            if not any(part in region for part in ALONE):
                faults += expected(region, [], sorted(reached(calls, [region]) & static))
        return faults

    return [Test('texts: lengths in threads', check)]
