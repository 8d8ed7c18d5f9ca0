"""What the phases of a run cannot do without: bytes that are read and written, at the speed at which memory is copied, and
floating-point operations, at that of large products of matrices. `axijoint estimate --counts` counts them"""
import os
import subprocess
import tempfile

from estimate import counts

HERE = os.path.dirname(os.path.realpath(__file__))
REAL, INTEGER = 8, 4                    # bytes
BLOCK = 14                              # numbers of a block of the fine mesh, each of two nodes
PRODUCTS = 3                            # with the fine mesh's blocks, a mode, at least
MEGABYTE = 2.0**20


class Machine:
    """Bytes moved a second, bytes of fresh memory touched first a second, operations a second, of all threads together"""

    def __init__(self, program, threads):
        with tempfile.TemporaryDirectory() as folder:
            rates = os.path.join(folder, "rates")
            subprocess.run(["gcc", "-O2", "-fopenmp", os.path.join(HERE, "rates", "memory_rates.c"), "-o", rates], check=True)
            found = subprocess.run([rates], check=True, capture_output=True, text=True,
                                   env=os.environ | {"OMP_NUM_THREADS": threads}).stdout
            self.moved, self.fresh = (float(word) for word in found.split())
            deck = os.path.join(HERE, "..", "inputs", "first.dat")
            self.operations = int(threads)*counts(program, deck, [])["product_rate"][0]

    def __str__(self):
        return (f"{self.moved/1e9:.1f} GB/s read and written by copies, {self.fresh/1e9:.2f} GB/s of fresh memory touched, "
                f"{self.operations/1e9:.0f} GFlop/s by products of matrices")


def least_seconds(program, text, run, machine):
    """Seconds that each phase takes at least, by what it reads and writes or by its operations: the deck; matrices of the systems and
    blocks of the fine mesh, or their integrals; operations of the factors; factors twice a solution, blocks of the fine mesh three
    times a mode and flexibilities, or operations on the block of the joints; what is written of stresses; the files twice. And
    seconds that touching so much memory as the run has at its peak takes first"""
    with tempfile.TemporaryDirectory() as folder:
        deck = os.path.join(folder, "job.dat")
        with open(deck, "w", encoding="utf-8") as file:
            file.write(text)
        found = {name: count for name, (count, _) in counts(program, deck, []).items()}
    block = REAL*BLOCK + INTEGER
    moved = {"read": len(text),
             "assemble": (REAL + INTEGER)*found["formed_entries"] + block*found["fine_blocks"]/len(run.summary["modes"]),
             "joints": 2*REAL*found["solved_entries"] + PRODUCTS*block*found["fine_blocks"] + INTEGER*found["flexibility"],
             "recover": found["array_bytes"], "write": 2*run.written}
    operations = {"assemble": BLOCK*found["shape_products"], "factor": found["operations"], "joints": found["inverse"]}
    least = {phase: max(moved.get(phase, 0.0)/machine.moved, operations.get(phase, 0.0)/machine.operations)
             for phase in moved | operations}
    return least, MEGABYTE*run.summary["peak_memory_mb"]/machine.fresh
