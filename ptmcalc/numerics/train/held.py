"""What is held at rest together: groups that locked clutches and closed rigid contacts tie to one another."""

import itertools
from dataclasses import dataclass

import numpy as np

from ptmcalc.numerics.train.signals import FloatArray


@dataclass(frozen=True, slots=True)
class Part:
    """Groups that locks tie together, those of them at rest, and the rows of the locks over the groups."""

    members: tuple[int, ...]
    held: tuple[int, ...]
    locks: dict[tuple[str, int], FloatArray]
    anchors: int
    """in how many places it is held; with more than one no balance tells how they share the load"""

    def pieces(self) -> list[tuple[int, ...]]:
        """All connected sets of its groups."""
        return [
            piece
            for size in range(1, len(self.members) + 1)
            for piece in itertools.combinations(self.members, size)
            if self._order(piece) is not None
        ]

    def _order(self, piece: tuple[int, ...]) -> list[tuple[int, int, float]] | None:
        """(group, the one before it, its speed over that one's), from the first on; None if it is not connected."""
        reached, order = {piece[0]}, []
        for _ in piece:
            for row in self.locks.values():
                ends = [int(group) for group in np.flatnonzero(row)]
                for here, there in (ends, ends[::-1]) if len(ends) == 2 else ():
                    if here in reached and there in piece and there not in reached:
                        reached.add(there)
                        order.append((there, here, -float(row[here] / row[there])))
        return order if len(reached) == len(piece) else None

    def motion(self, piece: tuple[int, ...], way: int, count: int) -> FloatArray:
        """Speeds of the groups when a piece moves as one."""
        motion = np.zeros(count)
        motion[piece[0]] = way
        for there, here, factor in self._order(piece) or ():
            motion[there] = factor * motion[here]
        return motion
