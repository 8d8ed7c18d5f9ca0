"""Errors of a run against exact solutions"""
import numpy as np

from mesh import points_of, shape_functions


def displacement_error(mesh, solutions, amplitudes):
    """Relative L2 error over the body of all modes together: the finite element field, interpolated
    by the elements, against the exact one; amplitudes: mode -> shape (nodes, 3)"""
    xi, eta, weight = points_of(mesh.kind)
    value, slope = shape_functions(mesh.kind.nodes, xi, eta)
    corners = mesh.coordinates[mesh.elements]
    x = np.einsum("pn,enc->epc", value, corners)
    jacobian = np.linalg.det(np.einsum("pnd,enc->epdc", slope, corners))
    r, z = x[..., 0].ravel(), x[..., 1].ravel()
    volume = (weight*jacobian).ravel()*r
    error = size = 0.0
    for solution in solutions:
        exact = solution.displacement(r, z)
        found = np.einsum("pn,enc->cep", value, amplitudes[solution.mode][mesh.elements])
        error += np.sum(volume*(found.reshape(3, -1) - exact)**2)
        size += np.sum(volume*exact**2)
    return np.sqrt(error/size)


def stress_error(solutions, position, amplitudes, scale=None):
    """Relative root mean square error at the Gauss points of all components and modes together;
    amplitudes: mode -> shape (points, 6). `scale` stands for the size of the exact stress if that
    is zero"""
    r, z = position.T
    error = size = 0.0
    for solution in solutions:
        exact = solution.stress(r, z)
        error += np.mean(np.sum((amplitudes[solution.mode].T - exact)**2, axis=0))
        size += np.mean(np.sum(exact**2, axis=0))
    return np.sqrt(error)/(scale or np.sqrt(size))
