"""Prints a hash of all that results files hold but the stamps of the run: names, types, shapes and
bytes of all datasets and attributes

Usage: digest.py FILE...
"""
import hashlib
import sys

import h5py
import numpy as np

# Attributes that belong to a run: when, from which path, how long it took
STAMPS = ('date', 'run', 'deck', 'seconds')


def attributes(path, item):
    """Attributes of a group or dataset, without stamps"""
    return {f'{path}@{name}': value for name, value in item.attrs.items() if name not in STAMPS}


def contents(path):
    """All values of a file by their names"""
    with h5py.File(path, 'r') as file:
        found = attributes('/', file)

        def visit(name, item):
            found.update(attributes(name, item))
            if isinstance(item, h5py.Dataset):
                found[name] = item[()]

        file.visititems(visit)
    return found


def digest(path):
    """The hash of a file"""
    total = hashlib.sha256()
    for name, value in sorted(contents(path).items()):
        value = np.asarray(value)
        data = repr(value.tolist()).encode() if value.dtype == object else value.tobytes()
        total.update(f'{name} {value.dtype} {value.shape} '.encode() + data)
    return total.hexdigest()


if __name__ == '__main__':
    for argument in sys.argv[1:]:
        print(digest(argument))
