"""Compares results of one scene in several units, all digits of them: hard_units.py FOLDER

Needs NumPy and h5py. Ends with exit code 1 if they differ by more than 1E-9 of the largest."""
import os
import sys

import h5py

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from hard_scenes import UNITS

POWERS = {'displacement': (0, 1), 'joints/jump': (0, 1), 'joints/stress': (1, -2)}


def main(folder):
    """Print what differs"""
    bad = False
    first = {}
    for units in UNITS:
        with h5py.File(os.path.join(folder, f'{units.name}.h5')) as file:
            for name, powers in POWERS.items():
                values = file[name][()] / units.of(1.0, *powers)
                wanted = first.setdefault(name, values)
                error = abs(values - wanted).max() / abs(wanted).max()
                if not error <= 1e-9:
                    bad = True
                    print(f'{units.name}: {name} differs by {error:.1E}')
    return bad


if __name__ == '__main__':
    sys.exit(main(sys.argv[1]))
