"""Energy norms: stresses of the finite element field against the exact ones, by many points"""
import numpy as np

from mesh import points_of, shape_functions

POINTS = 6  # along each side of an element: stresses that go with 1/r are not polynomials


def energies(mesh, solutions, amplitudes):
    """Energies of the true error of stress and of the exact stress of a body, of all modes together:
    1/2 integral of s D^-1 s over the body; amplitudes: mode -> shape (nodes, 3)"""
    field = Field(mesh)
    error = energy = 0.0
    for solution in solutions:
        compliance = np.linalg.inv(solution.material.elasticity())
        exact = solution.stress(field.r, field.z)
        wrong = field.stress(solution, amplitudes[solution.mode]) - exact
        circle = np.pi if solution.harmonic == 0 else np.pi/2
        error += circle*np.einsum("p,ip,ij,jp->", field.volume, wrong, compliance, wrong)
        energy += circle*np.einsum("p,ip,ij,jp->", field.volume, exact, compliance, exact)
    return error, energy


class Field:
    """Points of all elements of a mesh, and the strains of nodal displacements there"""

    def __init__(self, mesh):
        self.mesh = mesh
        xi, eta, weight = points_of(mesh.kind, POINTS)
        self.value, slope = shape_functions(mesh.kind.nodes, xi, eta)
        corners = mesh.coordinates[mesh.elements]
        x = np.einsum("pn,enc->epc", self.value, corners)
        jacobian = np.einsum("pnd,enc->epdc", slope, corners)
        self.gradient = np.einsum("epcd,pnd->epnc", np.linalg.inv(jacobian), slope)
        self.shape = x.shape[:2]
        self.r, self.z = x[..., 0].ravel(), x[..., 1].ravel()
        self.volume = (weight*np.linalg.det(jacobian)).ravel()*self.r

    def strain(self, harmonic, nodal):
        """Amplitudes of strains, shape (6, elements, points)"""
        local, r, m = nodal[self.mesh.elements], self.r.reshape(self.shape), harmonic
        (u_r, v_r, w_r), (u_z, v_z, w_z) = np.einsum("epnd,enc->dcep", self.gradient, local)
        u, v, w = np.einsum("pn,enc->cep", self.value, local)
        strain = np.array([u_r, v_z, (u + m*w)/r, u_z + v_r, w_r - (m*u + w)/r, w_z - m*v/r])
        if self.mesh.kind.bbar:
            weight = self.volume.reshape(self.shape)
            change = strain[:3].sum(axis=0)
            mean = (weight*change).sum(axis=1)/weight.sum(axis=1)
            strain[:3] += (mean[:, None] - change)/3
        return strain

    def temperature(self, solution):
        """Temperature of the elements: interpolated from the nodes, the mean of a B-bar element"""
        at_nodes = solution.temperature(*self.mesh.coordinates.T)[self.mesh.elements]
        found = np.einsum("pn,en->ep", self.value, at_nodes)
        if self.mesh.kind.bbar:
            weight = self.volume.reshape(self.shape)
            found[:] = ((weight*found).sum(axis=1)/weight.sum(axis=1))[:, None]
        return found

    def stress(self, solution, nodal):
        """Amplitudes of stresses, shape (6, elements times points)"""
        material = solution.material
        free = np.multiply.outer(material.expansions(), self.temperature(solution))
        strain = self.strain(solution.harmonic, nodal) - free
        return np.einsum("ij,jep->iep", material.elasticity(), strain).reshape(6, -1)
