"""Sums of harmonics round the circle, and components in Cartesian directions. Angles are in degrees."""
import numpy as np

SYMMETRIC, ANTISYMMETRIC = 1, 2


def cosine(degrees):
    """Cosine of an angle in degrees, without rounding errors at multiples of 90."""
    turn = np.mod(np.asarray(degrees, float), 360)
    value = np.cos(np.radians(turn))
    return np.where(turn % 180 == 90, 0., np.where(turn == 0, 1., np.where(turn == 180, -1., value)))


def sine(degrees):
    """Sine of an angle in degrees, without rounding errors at multiples of 90."""
    return cosine(np.asarray(degrees, float) - 90)


def mode_factors(harmonic, family, theta):
    """What amplitudes are multiplied by at angles theta.

    Returns two arrays of the shape of theta and one more axis for the modes: for u, v and the stresses
    r, z, theta, rz; and for w and the stresses r-theta, z-theta.
    """
    turn = np.multiply.outer(np.asarray(theta, float), harmonic)
    symmetric = np.asarray(family) == SYMMETRIC
    return (np.where(symmetric, cosine(turn), sine(turn)),
            np.where(symmetric, sine(turn), -cosine(turn)))


def totals(amplitude, harmonic, family, theta):
    """Sum of the modes.

    amplitude: (modes, ..., 3) displacements or (modes, ..., 6) stresses; theta: a number, or an array
    of the shape that `...` stands for. Returns (..., 3) or (..., 6).
    """
    meridional, around = mode_factors(harmonic, family, theta)
    split = 2 if amplitude.shape[-1] == 3 else 4
    return np.concatenate([np.einsum("m...c,...m->...c", amplitude[..., :split], meridional),
                           np.einsum("m...c,...m->...c", amplitude[..., split:], around)], -1)


def on_planes(amplitude, harmonic, family, theta):
    """Sums of the modes, (modes, points, components), at each of some angles: (angles, points, components)."""
    return np.stack([totals(amplitude, harmonic, family, np.full(amplitude.shape[1], angle))
                     for angle in theta])


def cartesian_displacement(total, theta):
    """u, v, w (along r, z, theta) to x, y, z; x is along theta = 0, y along theta = 90 degrees."""
    u, v, w = np.moveaxis(total, -1, 0)
    c, s = cosine(theta), sine(theta)
    return np.stack([c*u - s*w, s*u + c*w, v + 0*c], -1)


def cartesian_stress(total, theta):
    """Stresses r, z, theta, rz, r-theta, z-theta to xx, yy, zz, xy, yz, xz."""
    rr, zz, tt, rz, rt, zt = np.moveaxis(total, -1, 0)
    c, s = cosine(theta), sine(theta)
    return np.stack([c*c*rr + s*s*tt - 2*c*s*rt, s*s*rr + c*c*tt + 2*c*s*rt, zz + 0*c,
                     c*s*(rr - tt) + (c*c - s*s)*rt, s*rz + c*zt, c*rz - s*zt], -1)


def principal_stresses(total, *, cartesian=False):
    """Principal stresses of six components (..., 6), greatest first: (..., 3).

    cartesian: whether these are xx, yy, zz, xy, yz, xz, as `stress(..., cartesian=True)` gives them, in place of r, z, theta, rz,
        r-theta, z-theta.
    """
    rr, zz, tt, rz, rt, zt = np.moveaxis(np.asarray(total, float), -1, 0)
    if cartesian:  # x, y, z stand for r, z, theta: of these xz comes last
        rt, zt = zt, rt
    tensor = np.stack([np.stack(row, -1) for row in ((rr, rz, rt), (rz, zz, zt), (rt, zt, tt))], -2)
    return np.linalg.eigvalsh(tensor)[..., ::-1]
