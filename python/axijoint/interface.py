"""Interfaces: the cards of INTERFACES, with the joints of each."""
from dataclasses import dataclass

import numpy as np


@dataclass
class Interface:
    """A card of INTERFACES.

    number           of the card, from 1
    name             of the card; "interface n" without one
    law              number of the joint law; None if the bodies are bonded
    body_a, body_b   numbers of the bodies at side 1-2 and at side 4-3; the joints' normal leads from a to b
    face_a, face_b   numbers of their faces; 0 if they come from GROUPS
    joints           its joints, counted from 0 as in `result.mesh`
    """
    number: int
    name: str
    law: int
    body_a: int
    body_b: int
    face_a: int
    face_b: int
    joints: np.ndarray


def read_interfaces(result):
    """All Interfaces of a file, in the order of the cards."""
    if not result.has("interfaces"):
        return []
    names = result.read("interfaces/name").splitlines()
    laws = result.read("interfaces/law")
    of_joint = result.read("mesh/joint_interface")
    bodies = [result.read(f"interfaces/{name}") for name in ("body_a", "body_b", "face_a", "face_b")]
    return [Interface(k, name, int(result.mesh.law_label[law - 1]) if law else None,
                      *(int(one[k - 1]) for one in bodies), np.flatnonzero(of_joint == k))
            for k, (name, law) in enumerate(zip(names, laws), 1)]
