"""Compares two results of one scene told in other words, in all increments: read_invariant.py ONE OTHER CHANGES

Needs NumPy and h5py. CHANGES is a JSON object that says how the second differs: `length` and `force` its units, `mirrored` in
z, `turn` [degree] about the axis, `bodies` numbers of bodies 1, 2, 3, `swapped` sides of joints, `numbered`: nodes are
compared by number. Prints the largest differences over the largest values as JSON.
"""
import json
import sys

import h5py
import numpy as np


class Side:
    """Results of one of both, told as the first"""

    def __init__(self, path, changes):
        with h5py.File(path) as file:
            self.read(file)
        self.changes, length = changes, changes.get('length', 1.0)
        self.up = -1.0 if changes.get('mirrored') else 1.0
        stress = changes.get('force', 1.0)/length**2
        self.displacement = self.displacement/length*np.array([1.0, self.up, 1.0])
        across = -1.0 if changes.get('swapped') else 1.0
        self.jump = self.jump/length*np.array([self.up, 1.0, across])
        self.stress = self.stress/stress*np.array([self.up, 1.0, across])
        self.places, self.points = self.places/length, self.points/length
        self.turn_back(np.radians(changes.get('turn', 0.0)))

    def read(self, file):
        """Take the arrays"""
        self.displacement = file['history/displacement'][()]  # increment, mode, node, component
        self.jump, self.stress = np.atleast_1d(file['joints/jump'][()]), file['history/joint_stress'][()]
        self.states = file['history/joint_state'][()]  # increment, plane, point
        self.planes, self.points = file['joints/planes'][()], file['joints/position'][()]
        self.harmonic, self.family = file['modes/harmonic'][()], file['modes/family'][()]
        self.places, self.labels = file['mesh/coordinates'][()], file['mesh/node_label'][()]
        self.body = np.zeros(len(self.places), int)
        for nodes, body in zip(file['mesh/element_nodes'][()], file['mesh/element_body'][()]):
            self.body[nodes[nodes > 0] - 1] = body

    def turn_back(self, angle):
        """Amplitudes and planes as if all were turned back by an angle"""
        turned = np.zeros_like(self.displacement)
        for k, (m, family) in enumerate(zip(self.harmonic, self.family)):
            turned[:, k] += np.cos(m*angle)*self.displacement[:, k]
            other = np.flatnonzero((self.harmonic == m) & (self.family != family))
            if len(other):
                turned[:, k] += (1.0 if family == 1 else -1.0)*np.sin(m*angle)*self.displacement[:, other[0]]
        self.displacement = turned
        self.planes = np.round((self.planes - angle) % (2*np.pi), 7) % round(2*np.pi, 7)

    def nodes(self):
        """Order of the nodes by body and place, or by number"""
        if self.changes.get('numbered'):
            return np.argsort(self.labels)
        bodies = {number: k for k, number in enumerate(self.changes.get('bodies', (1, 2, 3)))}
        return np.lexsort((np.round(self.up*self.places[:, 1], 7) + 0.0, np.round(self.places[:, 0], 7), [bodies[b] for b in self.body]))

    def values(self):
        """Arrays by name, in an order that words do not change"""
        points = np.lexsort((np.round(self.up*self.points[:, 1], 7) + 0.0, np.round(self.points[:, 0], 7)))
        planes = np.argsort(self.planes)
        modes = np.lexsort((self.family, self.harmonic))
        return {'displacement': self.displacement[:, modes][:, :, self.nodes()],
                'relative displacement': self.jump[planes][:, points],
                'joint stress': self.stress[:, planes][:, :, points],
                'joint state': self.states[:, planes][:, :, points]}


def main(one, other, changes):
    """Print the differences"""
    wanted, found = Side(one, {'numbered': changes.get('numbered', False)}).values(), Side(other, changes).values()
    print(json.dumps({name: float(abs(found[name].astype(float) - values).max()/max(abs(values).max(), 1e-300))
                      for name, values in wanted.items()}))


if __name__ == '__main__':
    main(sys.argv[1], sys.argv[2], json.loads(sys.argv[3]))
