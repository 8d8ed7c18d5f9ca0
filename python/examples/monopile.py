"""A monopile from Python alone: the deck built, solved and looked at, step by step.

    AXIJOINT=$(scripts/build release) python python/examples/monopile.py FOLDER

A steel tube of 6 m in two layers of ground, with a gap behind it where the ground lets go: weight first,
then wind and waves in five increments, then unloading. It is the job of inputs/monopile.dat. Numbers are
printed, and figures written into FOLDER if matplotlib is installed. Units: MN, m, MPa.
"""
import pathlib
import sys

import numpy as np

import axijoint

# %% The pile and the ground: what one would change first
RADIUS, WALL, TOE, HEAD = 3.0, 0.08, -20.0, 5.0
LAYER, BOTTOM, EDGE = -8.0, -36.0, 30.0
INSIDE = round(RADIUS - WALL, 6)
LATERAL, MOMENT = 5.0, -100.0
STEPS = [0.2]*5 + [-0.5]*2


def pile_and_ground():
    """The deck without loads."""
    deck = axijoint.Deck("A monopile in layered ground: weight, lateral load, unloading (MN, m, MPa)")
    deck.control(4, planes=17)
    deck.materials(1, young=2.1e5, poisson=0.3, density=6.85e-3)  # steel in the ground, under water
    deck.materials(2, young=2.1e5, poisson=0.3, density=6.85e-3)  # steel above it
    deck.materials(3, young=25.0, poisson=0.3, density=1.0e-3)  # upper layer
    deck.materials(4, young=60.0, poisson=0.25, density=1.0e-3)  # lower layer
    deck.laws(1, k_xi=100.0, k_eta=200.0, k_theta=100.0, cohesion=0.0, friction=26.0)
    deck.lawdetails(1, slip="RESULTANT")

    # %% Blocks of elements, the ratios letting them grow away from the pile
    def block(body, material, n1, n2, low, high, ratio1=None, ratio2=None):
        deck.blocks(body=body, material=material, nodes=8, n1=n1, n2=n2, ratio1=ratio1, ratio2=ratio2,
                    corners=[low, high])
    block(1, 1, 1, 6, (INSIDE, TOE), (RADIUS, LAYER), ratio2=1.0)
    block(1, 1, 1, 6, (INSIDE, LAYER), (RADIUS, 0.0), ratio2=1.0)
    block(1, 2, 1, 3, (INSIDE, 0.0), (RADIUS, HEAD))
    block(2, 3, 7, 6, (RADIUS, LAYER), (EDGE, 0.0), ratio1=8.0)
    block(2, 4, 7, 6, (RADIUS, TOE), (EDGE, LAYER), ratio1=8.0)
    block(2, 4, 7, 4, (RADIUS, BOTTOM), (EDGE, TOE), ratio1=8.0, ratio2=0.3)
    block(2, 4, 1, 4, (INSIDE, BOTTOM), (RADIUS, TOE), ratio2=0.3)
    block(2, 4, 3, 4, (0.0, BOTTOM), (INSIDE, TOE), ratio2=0.3)
    block(2, 4, 3, 6, (0.0, TOE), (INSIDE, LAYER))
    block(2, 3, 3, 6, (0.0, LAYER), (INSIDE, 0.0))

    # %% Faces: of the pile's head, and of pile and ground where they meet
    deck.faces(1, body=1, first=(INSIDE, HEAD), last=(RADIUS, HEAD))
    for number, (r1, r2, top) in {2: (RADIUS, RADIUS, 0.0), 4: (INSIDE, INSIDE, 0.0), 6: (INSIDE, RADIUS, TOE)}.items():
        deck.faces(number, body=1, first=(r1, TOE), last=(r2, top))
        deck.faces(number + 1, body=2, first=(r1, TOE), last=(r2, top))
    deck.faces(8, body=2, first=(0.0, BOTTOM), last=(EDGE, BOTTOM))
    deck.faces(9, body=2, first=(EDGE, BOTTOM), last=(EDGE, 0.0))
    for number, name in ((2, "shaft"), (4, "plug"), (6, "toe")):
        deck.interfaces(law=1, face_a=number, face_b=number + 1, name=name)
    deck.fixedfaces(8, "111")
    deck.fixedfaces(9, "101")
    return deck


def load(deck):
    """Weight, then the lateral load in steps, and what is looked at."""
    deck.case(1, name="Weight and the stress of the ground before it")
    deck.gravity(vertical=-9.81)
    deck.insitu(body=2, z=0.0, gamma=9.81e-3, k0=0.5)
    deck.insitu(body=1, z=0.0, gamma=9.81e-3, k0=0.5, stress=0.0, material=1, balance="MEANT")
    deck.case(2, name="Wind and waves")
    deck.resultants(1, "LATERAL", LATERAL)
    deck.resultants(1, "MOMENT", MOMENT)
    deck.combine(1, factors={1: 1.0, 2: 1.0})
    deck.increments(1.0, tolerance=1e-8, case=1)
    for step in STEPS:
        deck.increments(step, tolerance=1e-8, case=2)
    for number, (name, z) in enumerate({"mudline": 0.0, "head": HEAD, "toe": TOE}.items(), 1):
        deck.points(number, (RADIUS, z), body=1, name=name)
    deck.cuts(1, TOE, body=1, last=HEAD, number=26)
    deck.sections(1, first=(RADIUS, 0.0), last=(EDGE, 0.0), points=28, angles=[0.0, 180.0])


def report(result):
    """What an engineer asks first, as numbers."""
    history = result.history
    head, force = history.point("head")[:, 0], history["applied"][:, 1]
    print("increment   lateral load [MN]   head [mm]   slip   open   dissipated [MNm]")
    for k, number in enumerate(history.increment):
        print(f"{number:9} {force[k]:19.3f} {1e3*head[k]:11.2f} {history['n_slip'][k]:6} {history['n_open'][k]:6}"
              f" {history['dissipated'][k]:18.5f}")
    top = int(force.argmax())
    moment = history["cuts"][top, :, 2]
    deepest = int(abs(moment).argmax())
    print(f"largest moment in the pile: {moment[deepest]:.2f} MNm at z = {result.read('cuts/z')[deepest]:g} m")
    ground = sum(history.interface(name)[top, 1] for name in ("shaft", "plug", "toe"))
    print(f"the ground holds {-ground:.6f} MN of {force[top]:.6f} MN")


def draw(result, folder):
    """Load against displacement; moment, deflection and p along the pile at the largest load."""
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        print("no figures: matplotlib is not installed")
        return
    history, mesh = result.history, result.mesh
    top = int(history["applied"][:, 1].argmax())
    figure, (curve, bending, line, pressed) = plt.subplots(1, 4, figsize=(13, 4.5), layout="constrained")
    curve.plot(1e3*history.point("head")[:, 0], history["applied"][:, 1], "o-", color="black")
    curve.set(xlabel="head u [mm]", ylabel="lateral load [MN]")
    z = result.read("cuts/z")
    bending.plot(history["cuts"][top, :, 2], z, color="black")
    bending.set(xlabel="moment [MNm]", ylabel="z [m]")
    line.plot(1e3*history["cut_motion"][top, :, 1], z, color="black")
    line.set(xlabel="deflection [mm]", ylabel="z [m]")
    joints = result.interfaces_of("shaft")[0].joints
    ends = mesh.coordinates[mesh.joint_nodes[joints, :2], 1]
    p = history.joint_resultants[top, joints, 1]/np.ptp(ends, axis=1)
    pressed.plot(p, ends.mean(axis=1), "o", color="black")
    pressed.set(xlabel="p of the outer shaft [MN/m]", ylabel="z [m]")
    figure.savefig(folder/"monopile.png", dpi=150)
    print(folder/"monopile.png")


def main():
    """The job from its cards to its figures."""
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    deck = pile_and_ground()
    load(deck)
    result = axijoint.run(deck, folder, name="monopile")
    print(result.title, "-", result.status)
    report(result)
    draw(result, folder)


if __name__ == "__main__":
    main()
