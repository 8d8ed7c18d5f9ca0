"""Runs axijoint and reads its results"""
import json
import os
import pathlib
import resource
import subprocess

import h5py
import numpy as np


class ProgramError(Exception):
    """A run that did not end well"""


class Results:
    """What the tables need of NAME.h5; nodes and points count from 0"""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.coordinates = file["mesh/coordinates"][()]
            self.labels = file["mesh/node_label"][()]
            self.displacement = by_mode(file, file["displacement"][()])
            self.stress = by_mode(file, file["stress/amplitude"][()])
            self.position = file["stress/position"][()]
            self.element = file["stress/element"][()] - 1
            self.element_body = file["mesh/element_body"][()]
            self.element_nodes = file["mesh/element_nodes"][()]
            error = file["error/discretization"]
            self.discretization = {**error.attrs, "error_energy": error["error_energy"][()]}
            self.joints = {name: values[()] for name, values in file["joints"].items()}

    def nodal(self, mode, count, first=0):
        """Amplitudes of the nodes numbered first + 1, ..., first + count, shape (count, 3)"""
        row = np.empty(self.labels.max() + 1, dtype=int)
        row[self.labels] = np.arange(len(self.labels))
        return self.displacement[mode][row[first + 1:first + count + 1]]

    def points_of_body(self, body):
        """Which Gauss points lie in a body"""
        return self.element_body[self.element] == body


class History:
    """What the tables need of a job in increments of bodies that yield; arrays have one row an increment"""

    def __init__(self, path, summary, processor):
        self.processor = processor
        self.messages = summary["messages"]
        self.iterations = np.array([row["iterations"] for row in summary["yielding"]["increments"]])
        self.solutions = np.array([row["solutions"] for row in summary["yielding"]["increments"]])
        self.no_equilibrium_at = summary["yielding"]["no_equilibrium_at"]
        self.seconds = summary["seconds"]["total"]
        self.errors = summary["yielding"]["errors"]
        self.error_seconds = sum(summary["error_seconds"].values())
        with h5py.File(path) as file:
            history = file["history"]
            self.load_factor = history["load_factor"][()]
            self.work, self.energy = history["work"][()], history["energy"][()]
            self.largest = history["largest_displacement"][()]
            self.dissipated = file["yield/dissipated"][()]
            # Axial, lateral, moment, torque, lateral and moment at 90 degrees of each face, shape (increments, faces, 6)
            self.supports = history["supports"][()]
            self.face = file["supports/face"][()] if "supports/face" in file else None
            self.points = history["points/displacement"][()] if "points" in history else None
            self.stress = by_mode(file, file["stress/amplitude"][()])
            self.position = file["stress/position"][()]
            self.plastic_strain = file["yield/equivalent"][()]
            self.active = file["yield/active"][()] if "yield/active" in file else None


def by_mode(file, array):
    """(harmonic, family) -> amplitudes of that mode, shape (nodes or points, components)"""
    modes = zip(file["modes/harmonic"][()], file["modes/family"][()])
    return {(int(m), int(f)): array[i] for i, (m, f) in enumerate(modes)}


class Program:
    """The program, and a directory for decks and results"""

    def __init__(self, path, directory):
        self.path, self.directory = path, pathlib.Path(directory)
        self.processor = 0.0  # seconds that the last run took of it

    def _run(self, deck):
        """Runs a deck in a file by one thread"""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([self.path, "run", deck, "-o", self.directory, "--threads", "1"],
                              capture_output=True, text=True, env=os.environ, check=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return done

    def run(self, name, text):
        """Runs a deck; its results"""
        deck = self.directory/f"{name}.dat"
        deck.write_text(text)
        done = self._run(deck)
        if done.returncode:
            words = "\n".join((done.stderr or done.stdout).strip().splitlines()[:5])
            raise ProgramError(f"{deck}: exit code {done.returncode}\n{words}")
        return Results(self.directory/f"{name}.h5")

    def seconds(self, name, text):
        """Processor seconds that a deck takes"""
        self.run(name, text)
        return self.processor

    def history(self, name, text):
        """Runs a deck of bodies that yield, to its end or to its limit load"""
        deck = self.directory/f"{name}.dat"
        deck.write_text(text)
        done = self._run(deck)
        if done.returncode not in (0, 4):
            words = "\n".join((done.stderr or done.stdout).strip().splitlines()[:5])
            raise ProgramError(f"{deck}: exit code {done.returncode}\n{words}")
        return History(self.directory/f"{name}.h5", json.loads((self.directory/f"{name}.json").read_text()), self.processor)
