"""Small systems of several modes for the marcher: matrices, guards with what follows, breaks of time."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from ptmcalc.numerics.motion import Curve, Motion, Reaction
from ptmcalc.numerics.record import Event

Jump = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Part:
    """One mode: z' = A z (+ curves), guards with the modes they lead to."""

    rate: np.ndarray
    guards: tuple[tuple[np.ndarray, str], ...] = ()
    gain: np.ndarray | None = None
    curves: tuple[Curve, ...] = ()


@dataclass
class Modes:
    """A system given by its modes; `jumps` change the state on entering a mode, `breaks` are times at which the mode
    goes over to another."""

    parts: Mapping[str, Part]
    watch: np.ndarray
    own: int
    breaks: tuple[tuple[float, str, str], ...] = ()
    jumps: Mapping[str, Jump] = field(default_factory=dict)
    products: tuple[tuple[int, int], ...] = ()
    input_speed: float = 0.0
    ends: str = ""
    sizes: tuple[float, ...] = ()

    @property
    def scale(self) -> np.ndarray:
        return np.array(self.sizes) if self.sizes else np.ones(self.watch.shape[1])

    def motion(self, mode: str) -> Motion:
        part, n = self.parts[mode], self.watch.shape[1]
        gain = np.zeros((n, len(part.curves))) if part.gain is None else part.gain
        guards = np.array([row for row, _ in part.guards]).reshape(-1, n)
        wide = [np.hstack([rows, np.zeros((len(rows), len(part.curves)))]) for rows in (guards, self.watch)]
        return Motion(part.rate, gain, wide[0], wide[1], part.curves)

    def next_break(self, mode: str, time: float) -> float:
        return min((at for at, before, _ in self.breaks if before == mode and at > time), default=np.inf)

    def react(self, mode: str, time: float, state: np.ndarray, fired: int | None) -> Reaction:
        after = mode
        if fired is not None:
            after = self.parts[mode].guards[fired][1]
        else:
            after = next((new for at, before, new in self.breaks if before == mode and at == time), mode)
        if after in self.jumps and (fired is not None or after != mode):
            state = self.jumps[after](state)
        happened = (Event(time, "mode", mode, after),) if fired is not None or after != mode else ()
        return replace(Reaction(after, state, happened), finished=bool(self.ends) and after == self.ends)


def turning(frequency: float) -> np.ndarray:
    """x'' = -w^2 x as (x, v)."""
    return np.array([[0.0, 1.0], [-(frequency**2), 0.0]])


def with_one(rate: np.ndarray, constant: np.ndarray) -> np.ndarray:
    """z' = A z + b with a last state that is 1."""
    n = len(rate)
    whole = np.zeros((n + 1, n + 1))
    whole[:n, :n], whole[:n, n] = rate, constant
    return whole
