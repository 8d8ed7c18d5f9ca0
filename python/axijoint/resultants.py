"""Resultants: axial force, lateral force, moment, torque, lateral force and moment at 90 degrees, (..., 6); motions likewise."""
import numpy as np

from . import circle

AXIAL, TORQUE = 0, 3
# Columns along theta = 0 and 90 degrees
FORCE, MOMENT = (1, 4), (2, 5)
# Lateral resultants below this share of the largest of all are rounding, as the sum of reactions that balance one another is
ROUNDING = 1e-9


def along(values, kind, theta):
    """What resultants (..., 6) have of a kind, FORCE or MOMENT, along theta [degree]."""
    return circle.cosine(theta)*values[..., kind[0]] + circle.sine(theta)*values[..., kind[1]]


def direction(history):
    """Direction of the largest lateral load of a History, 0 <= theta < 180 [degree].

    Of loads without lateral forces that of their largest moment; where loads have neither, as where displacements are
    given, that of all reactions, of what cuts carry or of the reactions of a face. 0 if nothing is lateral.
    """
    known = [history[name].reshape(-1, 6) for name in ("applied", "reacted", "cuts", "supports") if name in history]
    rounding = ROUNDING*max((abs(values).max(initial=0) for values in known), default=0)
    for values in known:
        for kind in (FORCE, MOMENT):
            size = np.hypot(*values[:, kind].T)
            if size.max(initial=0) > rounding:
                theta = np.degrees(np.arctan2(*values[size.argmax(), kind[::-1]]))
                return float(np.round(theta, 6) % 180)
    return 0.0


def load_of(history, theta):
    """The load that varies from increment to increment: name, columns, values by increment.

    The first of lateral force and moment along theta, axial force, torque, lateral force and moment across theta; the load
    factor, without columns, if none of them varies.
    """
    applied = history["applied"]
    across = (theta + 90) % 360
    loads = (("lateral force", FORCE, along(applied, FORCE, theta)), ("moment", MOMENT, along(applied, MOMENT, theta)),
             ("axial force", AXIAL, applied[:, AXIAL]), ("torque", TORQUE, applied[:, TORQUE]),
             (f"lateral force at {across:g}°", FORCE, along(applied, FORCE, across)),
             (f"moment at {across:g}°", MOMENT, along(applied, MOMENT, across)))
    for begin in (np.empty(0), np.zeros(1)):  # from rest on where all increments have the same load
        for name, columns, load in loads:
            if np.ptp(np.append(begin, load)) > 1e-6*max(abs(load).max(), 1e-6*abs(applied).max()) > 0:
                return name, columns, load
    return "load factor", None, history["load_factor"]
