"""Results for xarray, pandas and PyVista; each is imported only when it is asked for."""
from __future__ import annotations

import importlib

import numpy as np

from . import circle
from .components import DISPLACEMENTS, STRESSES
from .sweep import Sweep

# Sectors of a swept circle for each wave of the highest harmonic, and the fewest of all, as the program takes them
SECTORS_OF_A_WAVE, LEAST_SECTORS = 16, 36
RESULTANTS = ("axial", "lateral", "moment", "torque", "lateral_90", "moment_90")


def needed(module, method):
    """A module that a method, such as Result.to_pandas, needs; without it the message says how to get it."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"{method} needs {module}: pip install {module}") from error


def to_pandas(result, theta=0.0):
    """All tables as pandas.DataFrames, by name; see `Result.to_pandas`."""
    needed("pandas", "Result.to_pandas")
    tables = {"nodes": result.nodes(theta), "nodal_stresses": result.nodal_stresses(theta),
              "gauss_stresses": result.gauss_stresses(theta), "joints": result.joints(),
              "increments": result.increments, "convergence": result.convergence(), "spectrum": result.spectrum()}
    return {name: table.to_pandas() for name, table in tables.items()}


def to_xarray(result):
    """What is kept of all increments as an xarray.Dataset; see `Result.to_xarray`."""
    xarray = needed("xarray", "Result.to_xarray")
    history = result.history
    coords = {"increment": history.known, "node": result.mesh.node_label, "component": list(DISPLACEMENTS),
              "stress": list(STRESSES), "harmonic": ("mode", result.harmonic), "family": ("mode", result.family),
              "r": ("node", result.mesh.coordinates[:, 0]), "z": ("node", result.mesh.coordinates[:, 1]),
              "value_node": ("value", result.mesh.node_label[result.read("stress/nodal_node") - 1])}
    coords["resultant"] = list(RESULTANTS)
    series = {name: () for name in result.increments.column_names[1:]} | {"applied": ("resultant",), "reacted": ("resultant",)}
    if result.has("cuts/label"):
        coords |= {"cut": result.read("cuts/label"), "cut_z": ("cut", result.read("cuts/z"))}
        series |= {"cuts": ("cut", "resultant"), "cut_motion": ("cut", "resultant")}
    found = {name: xarray.DataArray(history[name], dims=("increment", *dims), coords={"increment": history.increment})
             for name, dims in series.items()}
    for name, dims, read in _fields(result):
        found[name] = _by_increment(xarray, result, name, dims, read)
    if len(result.read("joints/joint")):
        coords["plane"] = np.degrees(result.read("joints/planes"))
        coords["joint"] = ("joint_point", result.mesh.joint_label[result.read("joints/joint") - 1])
    return xarray.Dataset(found, coords, {"title": result.title, "status": result.status})


def _fields(result):
    """Name, dimensions and dataset of each field."""
    yield "displacement", ("mode", "node", "component"), "displacement"
    yield "nodal_stress", ("mode", "value", "stress"), "stress/nodal"
    if len(result.read("joints/joint")):
        yield "joint_jump", ("plane", "joint_point", "jump"), "joints/jump"
        yield "joint_stress", ("plane", "joint_point", "traction"), "joints/stress"
        yield "joint_state", ("plane", "joint_point"), "joints/state"


def _by_increment(xarray, result, name, dims, read):
    """A field of all increments that it is kept of; nan where it is not."""
    what = {"displacement": "displacement", "nodal_stress": "stress"}.get(name, "joints")
    kept = result.history.increments_of(what)
    values = np.stack([result.at(int(k)).read(read) for k in kept])
    return xarray.DataArray(values, dims=("increment", *dims), coords={"increment": kept})


def to_pyvista(result, sectors=None):
    """The bodies swept round the axis as a pyvista.UnstructuredGrid; see `Result.to_pyvista`."""
    pyvista = needed("pyvista", "Result.to_pyvista")
    sweep, mesh = Sweep(result), result.mesh
    sectors = sectors or max(LEAST_SECTORS, SECTORS_OF_A_WAVE*int(result.harmonic.max()))
    angles = np.arange(sectors)*360/sectors
    count = len(sweep.position)
    r, z = sweep.position.T
    c, s = circle.cosine(angles)[:, None], circle.sine(angles)[:, None]
    points = np.stack([r*c, r*s, np.broadcast_to(z, (sectors, count))], -1).reshape(-1, 3)
    # On the axis a point is there once
    number = np.where(r == 0, np.arange(count), np.arange(count) + count*np.arange(sectors)[:, None])
    cells, kinds, owners = [], [], []
    for owner, corners in sweep.cells():
        for k in range(sectors):
            here, there = number[k][corners], number[(k + 1) % sectors][corners]
            size = 2*corners.shape[1]
            # The normal of the first side leads into a hexahedron, and out of a wedge
            first, last = (there, here) if size == 8 else (here, there)
            cells.append(np.column_stack([np.full(len(corners), size), first, last]).ravel())
            kinds.append(np.full(len(corners), pyvista.CellType.HEXAHEDRON if size == 8 else pyvista.CellType.WEDGE))
            owners.append(owner)
    grid = pyvista.UnstructuredGrid(np.concatenate(cells), np.concatenate(kinds), points)
    owner = np.concatenate(owners)
    grid.cell_data.update({"body": mesh.element_body[owner], "element": mesh.element_label[owner],
                           "material": mesh.material_label[mesh.element_material[owner]]})
    total = sweep.at(sweep.displacement, angles)
    grid.point_data.update({name: total[..., k].ravel() for k, name in enumerate(DISPLACEMENTS)})
    grid.point_data["displacement"] = _cartesian(circle.cartesian_displacement, total, angles)
    if has_stresses(result):
        total = sweep.at(sweep.stress, angles)
        grid.point_data.update({name: total[..., k].ravel() for k, name in enumerate(STRESSES)})
        grid.point_data["stress"] = _cartesian(circle.cartesian_stress, total, angles)
    return grid


def has_stresses(result):
    """Whether the stresses of the increment are kept."""
    return result.increment in result.history.increments_of("stress")


def _cartesian(turned, total, angles):
    """Components along x, y, z of all points on all planes."""
    return turned(total, np.broadcast_to(angles[:, None], total.shape[:2])).reshape(-1, total.shape[-1])
