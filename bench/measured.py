"""Usage: measured.py OUTPUT COMMAND ...   Runs a command and prints its cost as JSON: wall [s], processor [s],
memory [MB, largest resident] and its exit code. What it says goes to OUTPUT.

A process of its own, without further modules: the memory of a program is never less than what started it held.
"""
import json
import os
import sys
import time

said = os.open(sys.argv[1], os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644)
started = time.monotonic()
process = os.posix_spawnp(sys.argv[2], sys.argv[2:], os.environ,
                          file_actions=[(os.POSIX_SPAWN_DUP2, said, 1), (os.POSIX_SPAWN_DUP2, said, 2)])
_, status, used = os.wait4(process, 0)
print(json.dumps({"wall": time.monotonic() - started, "processor": used.ru_utime + used.ru_stime,
                  "memory": used.ru_maxrss/1024, "exit_code": os.waitstatus_to_exitcode(status)}))
