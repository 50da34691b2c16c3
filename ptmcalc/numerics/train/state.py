"""The contact state of a train, and what a guard of it stands for."""

from dataclasses import dataclass
from typing import Any, NamedTuple

from ptmcalc.numerics.train.drives import DriveState
from ptmcalc.numerics.train.links import Contact
from ptmcalc.numerics.train.signals import Now

NO_FRICTION = 2
"""Turning of a group that nothing can hold at rest."""


class State(NamedTuple):
    """The contact state of a train: what decides which equations hold."""

    contacts: tuple[Contact, ...]
    signals: tuple[Now, ...]
    drives: tuple[DriveState, ...]
    turning: tuple[int, ...]
    """of each group: 1 forward, -1 backward, 0 held at rest, 2 without friction of its own"""
    clutches: tuple[int, ...]
    """of each grip between two bodies: the direction of its slip, 0 locked"""
    meshes: tuple[int, ...]
    """of each lossy mesh: the sign of the torque on its outer body"""
    released: "frozenset[tuple[Release, int]]" = frozenset()
    """lossy meshes whose torque on the outer body would be negative in a release of what is at rest"""


Release = tuple[tuple[int, ...], int]
"""Groups at rest that would begin to move together, and the way of the first of them, 1 or -1."""


@dataclass(frozen=True, slots=True)
class Change:
    """What a guard stands for: the element, and the state it changes to."""

    kind: str
    index: int
    to: Any
