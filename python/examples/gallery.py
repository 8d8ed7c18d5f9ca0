"""A gallery: what the package reads and draws, on one result file.

    scripts/run inputs/case3.dat -o out
    python gallery.py out/case3.h5 pictures

Each function is an example of its own; the pictures are written into the second argument.
"""
import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np

import axijoint
from axijoint import plot


def tables(result):
    """Numbers: one point, the largest stresses, the joints that are open."""
    r, z = result.mesh.coordinates.mean(axis=0)
    print("u, v, w at theta = 45:", result.displacement(r, z, theta=45, outside="nan"))
    stresses = result.nodal_stresses(theta=0)
    for name in axijoint.STRESSES:
        k = np.argmax(abs(stresses[name]))
        print(f"largest {name:12} {stresses[name][k]:12.4g} at r = {stresses['r'][k]:g}, z = {stresses['z'][k]:g}")
    joints = result.joints()
    for state in axijoint.STATES:
        print(f"{state}: {joints.where(joints['state'] == state).rows} of {joints.rows}")


def profile(result, folder):
    """A curve of one's own: sigma_z across the body at half its height, on four planes."""
    low, high = result.mesh.coordinates.min(axis=0), result.mesh.coordinates.max(axis=0)
    line = result.line((low[0], low[1]/2 + high[1]/2), (high[0], low[1]/2 + high[1]/2),
                       theta=[0, 45, 90, 180])
    figure, axes = plt.subplots(figsize=(5, 3))
    for theta, stress, style in zip(line.theta, line.stress, ("-", "--", "-.", ":")):
        for piece in line.pieces():
            label = f"theta = {theta:g}" if piece[0] == 0 else None
            axes.plot(line.distance[piece], stress[piece, 1], style, color="black", label=label)
    axes.set(xlabel="distance", ylabel="sigma_z")
    axes.legend()
    figure.savefig(folder/"profile.png", dpi=200, bbox_inches="tight")


def from_above(result, folder):
    """A horizontal slice in Cartesian components: the displacement along x, at half the height."""
    low, high = result.mesh.coordinates.min(axis=0), result.mesh.coordinates.max(axis=0)
    r, theta = np.meshgrid(np.linspace(low[0], high[0], 60), np.linspace(0, 360, 121))
    moved = result.displacement(r, (low[1] + high[1])/2, theta, outside="nan", cartesian=True)
    figure, axes = plt.subplots(figsize=(4.6, 4), subplot_kw={"projection": "polar"})
    shown = axes.pcolormesh(np.radians(theta), r, moved[..., 0], cmap="cividis", shading="gouraud")
    axes.set_yticks([])
    axes.grid(False)
    figure.colorbar(shown, pad=0.1, label="displacement along theta = 0")
    figure.savefig(folder/"from_above.png", dpi=200, bbox_inches="tight")


def ready_made(result, folder):
    """All the figures of axijoint.plot."""
    for name, figure in plot.figures(result):
        plot.save(figure, folder/name)


def main():
    """The gallery."""
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    result, folder = axijoint.open(sys.argv[1]), pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    tables(result)
    profile(result, folder)
    from_above(result, folder)
    ready_made(result, folder)


if __name__ == "__main__":
    main()
