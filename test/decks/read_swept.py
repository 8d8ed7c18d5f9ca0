"""Reads the files of swept bodies with VTK and checks them against the results file.

Usage: read_swept.py CHECK NAME    CHECK: a function below; NAME: result files without ending

Everything is found a second way: sums of harmonics by NumPy from the arrays of NAME.h5, volumes
from the polygons of its mesh. Faults are printed; the exit code is 1 if there are any.
"""
import os
import re
import sys

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOHDF import vtkHDFReader
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..', '..', 'python'))
import axijoint  # the Python package of this project

TOLERANCE = 1e-10
STRESSES = ('sigma_r', 'sigma_z', 'sigma_theta', 'tau_rz', 'tau_rtheta', 'tau_ztheta')


class Swept:
    """One step of a file"""

    def __init__(self, path, step=None):
        reader = vtkHDFReader()
        if not reader.CanReadFile(path):
            raise SystemExit(f'VTK cannot read {path}')
        reader.SetFileName(path)
        reader.UpdateInformation()
        times = reader.GetOutputInformation(0).Get(Pipeline.TIME_STEPS())
        self.times = list(times or [])
        if step is None:
            reader.Update()
        else:
            reader.UpdateTimeStep(self.times[step])
        self.grid = reader.GetOutput()
        self.x = vtk_to_numpy(self.grid.GetPoints().GetData())
        self.theta = np.arctan2(self.x[:, 1], self.x[:, 0])
        self.points = arrays(self.grid.GetPointData())
        self.cells = arrays(self.grid.GetCellData())
        self.fields = arrays(self.grid.GetFieldData())

    def sizes(self, name):
        """Volume or area of each cell"""
        size = vtkCellSizeFilter()
        size.SetInputData(self.grid)
        size.Update()
        return vtk_to_numpy(size.GetOutput().GetCellData().GetArray(name))

    def of_points(self, name):
        """A number of the cells, for each point that they use"""
        cells = self.grid.GetCells()
        last = vtk_to_numpy(cells.GetOffsetsArray())
        found = np.zeros(len(self.x), int)
        found[vtk_to_numpy(cells.GetConnectivityArray())] = np.repeat(self.cells[name], np.diff(last))
        return found


def arrays(data):
    """Arrays of VTK by their names"""
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


def same(what, wanted, found, scale=None):
    """Faults: arrays that differ by more than rounding"""
    wanted, found = np.asarray(wanted, float), np.asarray(found, float)
    if wanted.shape != found.shape:
        return [f'{what}: expected the shape {wanted.shape}, found {found.shape}']
    size = scale or max(np.abs(wanted).max(initial=0), 1e-30)
    worst = np.abs(wanted - found).max(initial=0)/size
    return [] if worst <= TOLERANCE else [f'{what}: off by {worst} of {size}']


def factors(results, theta):
    """What r, z components and theta components are multiplied by, shape (modes, theta)"""
    m = results['modes/harmonic'][:][:, None]
    symmetric = results['modes/family'][:][:, None] == 1
    return (np.where(symmetric, np.cos(m*theta), np.sin(m*theta)),
            np.where(symmetric, np.sin(m*theta), -np.cos(m*theta)))


def total(results, amplitude, theta):
    """Sums of amplitudes (modes, points, 3 or 6) at an angle for each point"""
    along, around = factors(results, theta)
    n = 2*amplitude.shape[2]//3
    return np.concatenate([np.einsum('mpc,mp->pc', amplitude[:, :, :n], along),
                           np.einsum('mpc,mp->pc', amplitude[:, :, n:], around)], axis=1)


def turned(theta):
    """Rotations from r, theta, z to x, y, z, shape (theta, 3, 3)"""
    rotation = np.zeros((len(theta), 3, 3))
    rotation[:, 0, 0] = rotation[:, 1, 1] = np.cos(theta)
    rotation[:, 1, 0] = np.sin(theta)
    rotation[:, 0, 1] = -np.sin(theta)
    rotation[:, 2, 2] = 1
    return rotation


def cartesian(u, theta):
    """Displacements u, v, w in x, y, z"""
    return np.einsum('pij,pj->pi', turned(theta), u[:, [0, 2, 1]])


def tensor(stress, theta):
    """Stresses r, z, theta, rz, r-theta, z-theta as matrices in x, y, z"""
    matrix = stress[:, [0, 4, 3, 4, 2, 5, 3, 5, 1]].reshape(-1, 3, 3)
    rotation = turned(theta)
    return np.einsum('pij,pjk,plk->pil', rotation, matrix, rotation)


def amplitudes(results, swept):
    """Amplitudes of displacement and stress at all points, found by node, element and material"""
    nodes = {label: i for i, label in enumerate(results['mesh/node_label'][:])}
    materials = list(results['materials/label'][:])
    elements = {label: i for i, label in enumerate(results['mesh/element_label'][:])}
    values = {pair: i for i, pair in enumerate(zip(results['stress/nodal_node'][:] - 1,
                                                   results['stress/nodal_material'][:] - 1))}
    displacement, nodal = results['displacement'][:], results['stress/nodal'][:]
    element_nodes = results['mesh/element_nodes'][:] - 1
    u = np.zeros((len(displacement), len(swept.x), 3))
    s = np.zeros((len(displacement), len(swept.x), 6))
    centre = np.array([-0.25]*4 + [0.5]*4)
    for point, (label, material, element) in enumerate(zip(
            swept.points['node'], swept.of_points('material'), swept.of_points('element'))):
        material = materials.index(material)
        if label:
            u[:, point] = displacement[:, nodes[label]]
            s[:, point] = nodal[:, values[nodes[label], material]]
        else:
            around = element_nodes[elements[element], :8]
            u[:, point] = np.einsum('i,mij->mj', centre, displacement[:, around])
            s[:, point] = np.einsum('i,mij->mj', centre, nodal[:, [values[n, material] for n in around]])
    return u, s


def section_moment(results):
    """Integral of r over the meridional plane, elements between straight lines from node to node"""
    moment = 0.0
    x = results['mesh/coordinates'][:]
    round_perimeter = {3: [0, 1, 2], 4: [0, 1, 2, 3], 6: [0, 3, 1, 4, 2, 5],
                       8: [0, 4, 1, 5, 2, 6, 3, 7], 9: [0, 4, 1, 5, 2, 6, 3, 7]}
    for size, nodes in zip(results['mesh/element_size'][:], results['mesh/element_nodes'][:] - 1):
        a = x[nodes[round_perimeter[size]]]
        b = np.roll(a, -1, axis=0)
        moment += ((a[:, 0] + b[:, 0])*(a[:, 0]*b[:, 1] - b[:, 0]*a[:, 1])).sum()/6
    return moment


def body_faults(swept, results, sectors=None, width=2*np.pi):
    """Faults of mesh and fields of the bodies at the end of a run"""
    faults = []
    highest = results['modes/harmonic'][:].max()
    sectors = sectors or max(36, 16*highest)
    angle = width/sectors
    volumes = swept.sizes('Volume')
    faults += same('volume', section_moment(results)*sectors*np.sin(angle), volumes.sum())
    if volumes.min() <= 0:
        faults.append(f'a cell has the volume {volumes.min()}')
    places = np.column_stack([np.round(swept.x/np.abs(swept.x).max(), 9), swept.of_points('body'),
                              swept.of_points('material')])
    if len(np.unique(places + 0.0, axis=0)) != len(swept.x):
        faults.append('points are there twice')
    known = swept.points['node'] > 0
    nodes = np.argsort(results['mesh/node_label'][:])
    nodes = nodes[np.searchsorted(results['mesh/node_label'][:][nodes], swept.points['node'][known])]
    faults += same('r and z', results['mesh/coordinates'][:][nodes],
                   np.column_stack([np.hypot(*swept.x[known, :2].T), swept.x[known, 2]]))
    u, s = amplitudes(results, swept)
    axis = swept.x[:, 0]**2 + swept.x[:, 1]**2 == 0
    theta = np.where(axis, 0.0, swept.theta) if width > 6.28 else swept.theta
    faults += same('displacement', cartesian(total(results, u, theta), theta), swept.points['displacement'])
    stress = tensor(total(results, s, theta), theta)
    scale = np.abs(stress).max()
    faults += same('stress', stress[:, [0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]], swept.points['stress'])
    faults += same('principal stress', np.linalg.eigvalsh(stress)[:, ::-1],
                   np.column_stack([swept.points[f'sigma_{i}'] for i in (1, 2, 3)]), scale)
    off = ~axis
    faults += same('u, v, w', total(results, u, theta)[off],
                   np.column_stack([swept.points[name] for name in 'uvw'])[off])
    faults += same('stress along r, z, theta', total(results, s, theta)[off],
                   np.column_stack([swept.points[name] for name in STRESSES])[off])
    return faults


def joint_faults(swept, results):
    """Faults of the joint surfaces at the end of a run: cell by cell, and all places of the law"""
    faults = []
    point, plane = swept.cells['joint_point'] - 1, swept.cells['plane'] - 1
    sign = np.where(swept.cells['mirrored'] == 1, -1.0, 1.0)
    state = results['joints/state'][:]
    faults += same('state', state[plane, point], swept.cells['state'], 1)
    pairs = np.unique(np.column_stack([plane, point, swept.cells['state']]), axis=0)
    for value in range(3):
        if (pairs[:, 2] == value).sum() != (state == value).sum():
            faults.append(f'state {value}: expected {(state == value).sum()} places, '
                          f'found {(pairs[:, 2] == value).sum()}')
    stress, jump = results['joints/stress'][:][plane, point], results['joints/jump'][:][plane, point]
    for i, (name, part) in enumerate((('tau_xi', 'd_xi'), ('sigma', 'd_eta'), ('tau_theta', 'd_theta'))):
        turn = sign if i == 2 else 1
        faults += same(name, turn*stress[:, i], swept.cells[name], np.abs(stress).max())
        faults += same(part, turn*jump[:, i], swept.cells[part], np.abs(jump).max())
    faults += same('slip', np.hypot(jump[:, 0], jump[:, 2]), swept.cells['slip'])
    return faults


def listing_faults(swept, path):
    """Faults: ten displacements at 0, 90 and 180 degrees against those that the listing prints"""
    faults = []
    text = open(path, encoding='utf-8').read()
    for degrees, turn in ((0, 1), (90, 0), (180, -1)):
        table = re.search(rf'TOTAL DISPLACEMENTS, theta = {degrees} degrees\n-+\n.*\n((?: .*\n)+)', text).group(1)
        rows = [line.split() for line in table.splitlines()][4:74:7]
        for row in rows:
            r, z, *u = map(float, row[1:])
            if r == 0:
                continue
            at = np.flatnonzero((swept.points['node'] == int(row[0]))
                                & (np.abs(np.cos(swept.theta) - turn) < 1e-9) & (swept.x[:, 1] >= -1e-9))
            if len(at) != 1:
                faults.append(f'node {row[0]} is there {len(at)} times')
                continue
            found = [swept.points[name][at[0]] for name in 'uvw']
            if np.abs(np.array(u) - found).max() > 1e-10:
                faults.append(f'node {row[0]} at {degrees} degrees: listed {u}, found {found}')
        if len(rows) != 10:
            faults.append(f'{len(rows)} rows of the listing were looked at')
    return faults


def package_faults(swept, path):
    """Faults: ten points off the axis against the Python package"""
    result = axijoint.open(path)
    at = np.flatnonzero(swept.points['node'])[500::900][:10]
    body, material = swept.of_points('body')[at], swept.of_points('material')[at]
    places = list(zip(np.hypot(*swept.x[at, :2].T), swept.x[at, 2], np.degrees(swept.theta[at]), body, material))
    found = [(result.displacement(r, z, theta, body=b, cartesian=True),
              result.stress(r, z, theta, body=b, material=m, cartesian=True)) for r, z, theta, b, m in places]
    wanted = np.array([pair[0] for pair in found]), np.array([pair[1] for pair in found])
    return (same('displacement of the Python package', wanted[0], swept.points['displacement'][at])
            + same('stress of the Python package', wanted[1], swept.points['stress'][at])
            + ([] if len(at) == 10 else [f'{len(at)} points were looked at']))


def whole(name):
    """A whole circle"""
    swept = Swept(name + '.vtkhdf')
    with h5py.File(name + '.h5') as results:
        return body_faults(swept, results)


def case_3(name):
    """The paper's case 3: bodies, listing, joints"""
    swept, joints = Swept(name + '.vtkhdf'), Swept(name + '.joints.vtkhdf')
    with h5py.File(name + '.h5') as results:
        return (body_faults(swept, results) + joint_faults(joints, results)
                + listing_faults(swept, name + '.lis') + package_faults(swept, name + '.h5'))


def part(name):
    """From -30 to 100 degrees in 13 sectors"""
    swept = Swept(name + '.vtkhdf')
    faults = same('first and last angle', np.radians([-30, 100]),
                  [swept.theta[swept.x[:, 0] != 0].min(), swept.theta.max()], 1)
    with h5py.File(name + '.h5') as results:
        axis = (swept.x[:, :2] == 0).all(axis=1)
        swept.theta[axis] = np.radians(-30)
        return faults + body_faults(swept, results, 13, np.radians(130))


def steps(name):
    """Increments as time steps; NAME-1, NAME-2 ... are runs that end with increment 1, 2 ..."""
    faults = []
    first, joints = Swept(name + '.vtkhdf'), Swept(name + '.joints.vtkhdf')
    with h5py.File(name + '.h5') as results:
        n = len(results['increments/factor'])
        factor = np.cumsum(results['increments/factor'][:])
    for swept in (first, joints):
        if swept.times != list(range(1, n + 1)):
            faults.append(f'expected {n} time steps, found {swept.times}')
    for step in range(n):
        swept = Swept(name + '.vtkhdf', step)
        faults += same('load factor', factor[step:step + 1], swept.fields['load_factor'])
        with h5py.File(f'{name}-{step + 1}.h5') as results:
            more = body_faults(swept, results) + joint_faults(Swept(name + '.joints.vtkhdf', step), results)
        faults += [f'step {step + 1}: {fault}' for fault in more]
    return faults


def elastic_joints(name):
    """Joints of a linear job: stresses from both sides' displacements in the middle of each cell"""
    swept = Swept(name + '.joints.vtkhdf')
    faults = []
    with h5py.File(name + '.h5') as results:
        stiffness = results['joint_materials/stiffness'][:]
        laws = list(results['joint_materials/label'][:])
        k = stiffness[[laws.index(law) for law in swept.cells['law']]]
    for i, (stress, jump) in enumerate((('tau_xi', 'd_xi'), ('sigma', 'd_eta'), ('tau_theta', 'd_theta'))):
        faults += same(stress, k[:, i]*swept.cells[jump], swept.cells[stress], np.abs(swept.cells['sigma']).max())
    if swept.cells['state'].any() or swept.cells['plane'].any():
        faults.append('a joint that cannot yield is not stuck')
    return faults


if __name__ == '__main__':
    found = globals()[sys.argv[1]](sys.argv[2])
    print('\n'.join(found))
    sys.exit(1 if found else 0)
