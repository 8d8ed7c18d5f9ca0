"""What is kept of every increment, against runs that stop there, balance, and exact work"""
import math
import tempfile
import unittest

import h5py
import jobs
import numpy as np

from axijoint import circle

TWIST = """TITLE
A plug that is turned in its hole until it slides
CONTROL
    0    2
MATERIALS
    1     1.0E4       0.0
LAWS
    1     1.0E3     1.0E3     1.0E3       0.0      30.0
LAWDETAILS
    1 RESULTANT                                                       -2.0
BLOCKS
    1    1    8    2    4
       0.0       0.0       0.5       2.0
    2    1    8    2    4
       0.5       0.0       1.5       2.0
FACES
    1    1       0.5       0.0       0.5       2.0
    2    2       0.5       0.0       0.5       2.0
    3    1       0.0       0.0       0.5       0.0
    4    1       0.0       2.0       0.5       2.0
    5    2       1.5       0.0       1.5       2.0
INTERFACES
    1    1    2
FIXEDFACES
    5  111
MOVEDFACES
    3    0                           0.0                        -0.005    A
    4    0                           0.0                        -0.005    A
INCREMENTS
       1.0
       0.5
       0.5
      -0.1
CUTS
    1       0.5    1       1.5    3
END
"""
LINEAR = """TITLE
A ring, pulled, twisted and bent in three increments
CONTROL
    1    5
MATERIALS
    1     2.0E4       0.3
BLOCKS
    1    1    8    2    6
       0.5       0.0       1.0       3.0
FACES
    1    1       0.5       0.0       1.0       0.0
    2    1       0.5       3.0       1.0       3.0
    3    1       1.0       0.0       1.0       3.0
SPRINGS
    3     100.0      50.0      20.0
FIXEDFACES
    1  111
RESULTANTS
    2     AXIAL       3.0
    2   LATERAL       2.0      30.0
    2    TORQUE       1.0
INCREMENTS
       0.5
       1.0
      -0.3
END
"""


def without_increments(text, n):
    """A deck that stops after n increments"""
    lines = text.splitlines()
    first = next(k for k, line in enumerate(lines) if line.startswith("INCREMENTS")) + 1
    last = first
    while lines[last][0] in " 0123456789-":
        last += 1
    return "\n".join(lines[:first + n] + lines[last:]) + "\n"


class History(unittest.TestCase):
    """One test for each thing that is kept"""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def run_deck(self, name, text):
        """The results file of a deck, all of it in memory"""
        path = jobs.run(self.folder.name, name, text)
        found = {}
        with h5py.File(f"{path}.h5") as file:
            file.visititems(lambda key, item: found.update({key: item[()]})
                            if isinstance(item, h5py.Dataset) else None)
        return found

    def equal(self, found, wanted, tolerance, what):
        """Two arrays are equal, over the largest value of the second"""
        largest = max(np.abs(wanted).max(initial=0.0), 1e-300)
        self.assertLessEqual(np.abs(found - wanted).max(initial=0.0)/largest, tolerance, what)

    def test_stopped(self):
        """Each increment of a monopile is what a run gives that stops there"""
        # The iteration claims ten times its tolerance of 1e-8; a tenth of the tolerance is asked for
        text = jobs.input_deck("monopile", "KEEP", "  STRESSES       ALL")
        whole = self.run_deck("whole", text)
        history = {key[8:]: value for key, value in whole.items() if key.startswith("history/")}
        n = len(history["increment"])
        for k in (1, 2, 5, 7, n):
            one = self.run_deck(f"stop{k}", without_increments(text, k))
            for name, last in (("displacement", "displacement"), ("joint_stress", "joints/stress"),
                               ("stress", "stress/amplitude"),
                               ("nodal_stress", "stress/nodal"), ("cuts", "cuts/resultants"),
                               ("cut_motion", "cuts/motion"), ("supports", "supports/reacted"),
                               ("sections/1/displacement", "sections/1/displacement"),
                               ("sections/1/stress", "sections/1/stress")):
                self.equal(history[name][k - 1], one[last], 1e-9, f"{name} of increment {k}")
            for name in ("work", "energy", "dissipated", "joint_resultants", "points/displacement"):
                self.equal(history[name][:k], one[f"history/{name}"], 1e-9, f"{name} up to {k}")
            jump = circle.on_planes(history["joint_amplitude"][k - 1], one["modes/harmonic"], one["modes/family"],
                                    np.degrees(one["joints/planes"]))
            self.equal(jump, one["joints/jump"], 1e-9, f"jumps of increment {k}")
            self.assertTrue((history["joint_state"][k - 1] == one["joints/state"]).all())

    def test_balance(self):
        """Forces and moments of the joints balance the loads on the pile, cuts end at these"""
        whole = self.run_deck("balance", jobs.input_deck("monopile"))
        z = whole["mesh/coordinates"][whole["mesh/joint_nodes"][:, :2] - 1, 1].mean(1)
        forces = whole["history/joint_resultants"]
        lateral = forces[:, :, 1].sum(1)
        moment = (forces[:, :, 2] - z*forces[:, :, 1]).sum(1)
        applied = whole["history/applied"]
        self.equal(-lateral, applied[:, 1], 1e-6, "lateral force")
        self.equal(-moment, applied[:, 2], 1e-6, "moment about the origin")
        head = whole["history/cuts"][:, -1]
        self.equal(head[:, 1], applied[:, 1], 1e-9, "shear at the head")
        self.equal(head[:, 2], applied[:, 2] + 5.0*applied[:, 1], 1e-9, "moment at the head")

    def test_linear_work(self):
        """Work of loads is the energy of solids and springs where nothing slides"""
        found = self.run_deck("linear", LINEAR)
        self.equal(found["history/energy"], found["history/work"], 1e-11, "energy")
        factor = found["history/load_factor"]
        self.equal(found["history/work"], found["history/work"][0]*(factor/factor[0])**2, 1e-11,
                   "work by the square of the load")
        self.assertFalse(found["history/dissipated"].any())

    def test_sliding(self):
        """A plug that slides all round: torque 2 pi a^2 L p tan(phi), work on its rotation"""
        found = self.run_deck("twist", TWIST)
        torque = 2.0*math.pi*0.5**2*2.0*2.0*math.tan(math.radians(30.0))
        turn = 0.01*np.diff(found["history/load_factor"])
        self.equal(np.abs(found["history/joint_resultants"][1:3, :, 3].sum(1)), torque, 1e-6, "torque")
        self.equal(np.diff(found["history/dissipated"])[:2], torque*turn[:2], 1e-6, "dissipated")
        closure = found["history/work"] - found["history/energy"] - found["history/dissipated"]
        self.assertLessEqual(np.abs(np.diff(closure)[:2]).max(), 1e-6*torque*turn[0], "closure")
        # of a bar under constant torque per length; four elements and springs in the joint leave 1e-4
        lag = torque/2.0*2.0**2/8.0/(5.0e3*math.pi*0.5**4/2.0)  # q L^2/8 G J, at half length
        self.equal(found["history/cut_motion"][1:3, 1, 3],
                   0.01*found["history/load_factor"][1:3] - lag, 1e-3, "rotation of the plug")

    def test_keep(self):
        """KEEP chooses the increments"""
        found = self.run_deck("keep", jobs.input_deck("monopile", "KEEP", "    SERIES     EVERY    3",
                                                      "  DISPLACE      ONLY    2    4", "    JOINTS      LAST"))
        self.assertEqual(list(found["history/increment"]), [3, 6, 8])
        self.assertEqual(list(found["history/displacement_increment"]), [2, 4, 8])
        self.assertEqual(list(found["history/joint_increment"]), [8])
        self.assertEqual(found["history/displacement"].shape[0], 3)
        self.equal(found["history/displacement"][-1], found["displacement"], 0.0, "the last")
        self.assertNotIn("history/stress", found)


if __name__ == "__main__":
    unittest.main()
