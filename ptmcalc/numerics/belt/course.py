"""The course of a belt from the head's run-off round the tail back to its run-on, cut into cells of equal travel time.

A wave passes a cell in one step of time, whatever the strand, so transport is exact. Idler friction and damping of
half a cell to either side are lumped at the node between: real idlers are lumps too. Gravity is carried as a static
profile of tension of its own.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Reach:
    """A length of belt of uniform mass; what acts along it is given as sums from its start, straight between marks.

    `marks` [m] run from 0 to its length; `friction` [N], `drag` [N*s/m] and `climb` [N] (tension that gravity asks
    for) have their shape. `span` is the weight of belt and load on one idler pitch [N], 0 for a belt that does not sag;
    `goes` is the part of the mass that goes with the belt: idlers turn where they are.
    """

    line_mass: float
    stiffness: float
    marks: FloatArray
    friction: FloatArray
    drag: FloatArray
    climb: FloatArray
    span: float = 0.0
    goes: float = 1.0

    @classmethod
    def even(
        cls, length: float, line_mass: float, stiffness: float, friction: float = 0.0, climb: float = 0.0
    ) -> "Reach":
        """A reach with the same friction and climb [N/m] all along."""
        ends = np.array([0.0, length])
        return cls(line_mass, stiffness, ends, friction * ends, 0 * ends, climb * ends)

    @property
    def length(self) -> float:
        """[m]"""
        return float(self.marks[-1])

    @property
    def impedance(self) -> float:
        """[N*s/m]"""
        return math.sqrt(self.line_mass * self.stiffness)

    @property
    def transit(self) -> float:
        """Travel time of a wave [s]."""
        return self.length * math.sqrt(self.line_mass / self.stiffness)


@dataclass(frozen=True, slots=True)
class Course:
    """Reaches in cells: node j lies between the cells j - 1 and j, nodes 0 and -1 at the head.

    `before` and `after` are the impedances on either side of a node [N*s/m], `friction` [N] and `drag` [N*s/m] its
    lumps with `share` the part of them that belongs to the cell before it, `climb` gravity's tension at nodes and
    in the middle of cells [N], `places` and `middles` positions [m], `sag` what makes the spans of a cell give,
    (w l)^2 h/24 [N^2*m], `goes` the part of a cell's mass that goes with the belt, `tail` the node at the tail.
    """

    step: float
    before: FloatArray
    after: FloatArray
    friction: FloatArray
    drag: FloatArray
    climb: FloatArray
    climb_within: FloatArray
    places: FloatArray
    middles: FloatArray
    cell_impedance: FloatArray
    sag: FloatArray
    goes: FloatArray
    tail: int
    mismatch: float

    @property
    def cells(self) -> int:
        """Number of cells."""
        return len(self.middles)


def lay_out(reaches: tuple[Reach, ...], tail_after: int, cells: int) -> Course:
    """Cut reaches into about so many cells of equal travel time, the tail after so many reaches.

        n_i = round(T_i/dt),   dt such that sum n_i dt = sum T_i

    **Error** every reach's travel time is off by up to half a step; `mismatch` is the largest relative error.
    """
    whole = sum(reach.transit for reach in reaches)
    best: tuple[float, list[int]] | None = None
    for wanted in range(cells, cells + max(cells // 4, 1) + 1):  # the count that fits the travel times best
        counts = [max(round(reach.transit / whole * wanted), 1) for reach in reaches]
        step = whole / sum(counts)
        off = max(abs(n * step / reach.transit - 1) for n, reach in zip(counts, reaches, strict=True))
        if best is None or off < best[0]:
            best = off, counts
    assert best is not None
    mismatch, counts = best
    step = whole / sum(counts)
    ends = np.concatenate([[0], np.cumsum(counts)])
    nodes = int(ends[-1]) + 1
    friction, drag, climb, places = (np.zeros(nodes) for _ in range(4))
    within, middles, impedance, sag, goes = (np.zeros(nodes - 1) for _ in range(5))
    start = climbed = 0.0
    for reach, first, count in zip(reaches, ends, counts, strict=False):
        edges = np.linspace(0.0, reach.length, 2 * count + 1)  # nodes and middles in turn
        for lumps, given in ((friction, reach.friction), (drag, reach.drag)):
            parts = np.diff(np.interp(edges, reach.marks, given))
            lumps[first : first + count] += parts[0::2]
            lumps[first + 1 : first + count + 1] += parts[1::2]
        rise = climbed + np.interp(edges, reach.marks, reach.climb)
        climb[first : first + count + 1], within[first : first + count] = rise[0::2], rise[1::2]
        places[first : first + count + 1] = start + edges[0::2]
        middles[first : first + count] = start + edges[1::2]
        impedance[first : first + count] = reach.impedance
        sag[first : first + count] = reach.span**2 * reach.length / count / 24
        goes[first : first + count] = reach.goes
        start, climbed = start + reach.length, rise[-1]
    return Course(
        step=step,
        before=np.concatenate([impedance[:1], impedance]),
        after=np.concatenate([impedance, impedance[-1:]]),
        friction=friction,
        drag=drag,
        climb=climb,
        climb_within=within,
        places=places,
        middles=middles,
        cell_impedance=impedance,
        sag=sag,
        goes=goes,
        tail=int(ends[tail_after]),
        mismatch=mismatch,
    )
