"""Checks the HDF5 file of a study against its table: read_study.py PATH-WITHOUT-ENDING"""
import csv
import sys

import h5py
import numpy as np

with open(sys.argv[1] + '.csv', encoding='utf-8') as table:
    rows = list(csv.DictReader(table))
with h5py.File(sys.argv[1] + '.h5') as file:
    names = file.attrs['quantities']
    names = (names.decode() if isinstance(names, bytes) else names).splitlines()
    values, count, code = file['values'][()], file['increments'][()], file['exit_code'][()]
    statistics = file['statistics/values'][()]
    kinds = file['statistics'].attrs['statistics']
    kinds = (kinds.decode() if isinstance(kinds, bytes) else kinds).splitlines()
assert values.shape == (len(rows), count.max(), len(names)), values.shape
last = np.array([values[k, n - 1] for k, n in enumerate(count)])
wanted = np.array([[float(row[name]) for name in names] for row in rows])
assert np.array_equal(last, wanted), 'the last increments are not those of the table'
assert (values[:, :, 0] == np.arange(1, count.max() + 1)).all(), 'increments are not numbered on'
good = last[code == 0]
for name, function in (('count', len), ('mean', lambda x: x.mean(0)), ('deviation', lambda x: x.std(0, ddof=1)),
                       ('least', lambda x: x.min(0)), ('greatest', lambda x: x.max(0)),
                       ('median', lambda x: np.median(x, 0)), ('percent 5', lambda x: np.quantile(x, 0.05, 0)),
                       ('percent 95', lambda x: np.quantile(x, 0.95, 0))):
    found, exact = statistics[:, kinds.index(name)], function(good)
    assert np.allclose(found, exact, rtol=1e-12, atol=1e-12*abs(good).max()), f'{name}: {found} {exact}'
low, high = (statistics[:, kinds.index(name)] for name in ('mean from', 'mean to'))
mean = good.mean(0)
assert (low <= mean + 1e-9*abs(mean)).all() and (high >= mean - 1e-9*abs(mean)).all(), 'the mean is outside its interval'
