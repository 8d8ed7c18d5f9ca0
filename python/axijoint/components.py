"""Names of the components of displacements and stresses, in their order."""

DISPLACEMENTS = ("u", "v", "w")
STRESSES = ("sigma_r", "sigma_z", "sigma_theta", "tau_rz", "tau_rtheta", "tau_ztheta")
