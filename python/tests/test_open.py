"""What is no result file is told, whatever the program has written into it."""
import pathlib
import sys
import tempfile

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import axijoint

with tempfile.TemporaryDirectory() as folder:
    for name, attributes in (("other.h5", {}), ("rows.study.h5", {"program": "axijoint", "quantities": "work"}),
                             ("job.vtkhdf", {"program": "axijoint", "title": "A job", "status": "converged", "combination": 0})):
        path = pathlib.Path(folder, name)
        with h5py.File(path, "w") as file:
            file.attrs.update(attributes)
        try:
            axijoint.open(path)
        except ValueError as error:
            assert "is no result file NAME.h5" in str(error), error
        else:
            raise AssertionError(f"{name} was opened")
