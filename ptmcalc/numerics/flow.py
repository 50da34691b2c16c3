"""The exact motion between two events: a linear system, and what is read from it at the nodes of panels."""

import math
from collections.abc import Callable

import numpy as np

from ptmcalc.numerics import expm, panels
from ptmcalc.numerics.components import Components, components
from ptmcalc.numerics.motion import DUST, NOISE
from ptmcalc.numerics.panels import COUNT, NODES, FloatArray

RESOLVED = 0.8
"""Largest frequency times panel: the polynomial through the nodes is then exact to 3e-12 of the amplitude."""
FADED = 1e-11
"""Share of a signal below which a fast component no longer has to be resolved, unless a flow says otherwise."""
WORTH_A_LOOK = 400.0
"""Radians to come of the fastest component above which it is worth asking whether it has faded."""
MOST_PANELS = 32
_FEW = 4
_ROUNDING = 1e-12
_POWER_OF_TWO = 0.5
"""What `frexp` leaves of one."""


class Flow:
    """z' = A z with the guards G z that keep it and the signals R z that are watched, in variables of like size.

    `rate` is A, shape (n, n); `guards` is G, shape (guards, n); `watch` is R, shape (signals, n). The first `own`
    states are the system's own; those after them are inputs, which depend on none of them, the fastest with the
    frequency `input_speed` [rad/s]; the last `carried` of them are coefficients, of any size.
    """

    def __init__(
        self,
        rate: FloatArray,
        guards: FloatArray,
        watch: FloatArray,
        own: int,
        input_speed: float = 0.0,
        faded: float = FADED,
        resolved: float = RESOLVED,
        worth: float = WORTH_A_LOOK,
        carried: int = 0,
    ) -> None:
        self.rate, self.guards, self.watch, self.own = rate, guards, watch, own
        self.input_speed, self.faded, self.resolved, self.worth = input_speed, faded, resolved, worth
        self.plain = len(rate) - carried
        self.unit = resolved / RESOLVED  # a lattice of its own for every `refined`: two runs share no panel
        slopes = guards @ rate
        self._ladder = np.concatenate([guards, slopes, slopes @ rate])
        self._magnitudes = np.abs(guards)
        self._own_magnitudes = self._magnitudes[:, :own].sum(axis=1)
        self._powers = expm.Powers(rate)
        speeds = np.abs(np.linalg.eigvals(rate[:own, :own]))
        self._largest = max(float(speeds.max(initial=0.0)), input_speed)
        self._slowest = float(speeds[speeds > 0].min(initial=math.inf))
        self._components: Components | None = None
        self._chunks: dict[float, Chunk] = {}
        self._ends: dict[float, FloatArray] = {}

    def panel(self, state: FloatArray, longest: float, sizes: Callable[[], FloatArray]) -> float:
        """A panel that resolves every component still seen in a signal of these sizes: a power of two in units, or the
        longest one that is asked for."""
        fastest = self._largest
        if fastest * longest > self.worth:
            fastest = max(self.components.span(state, self.faded, sizes())[1], self.input_speed)
        if fastest * longest <= self.resolved:
            return longest
        return self.unit * 2.0 ** math.floor(math.log2(RESOLVED / fastest))

    @property
    def components(self) -> Components:
        """What moves in it, told apart."""
        if self._components is None:
            self._components = components(self.rate, np.concatenate([self.guards, self.watch]), self.own)
        return self._components

    def longest(self, state: FloatArray, sizes: Callable[[], FloatArray]) -> float:
        """The longest panel worth a look: one that resolves the slowest component still seen, a power of two in
        units. What swings alone tops itself again and again, and each summit would have to be looked at anyway."""
        slowest = self.components.span(state, self.faded, sizes())[0]
        return self.unit * 2.0 ** math.floor(math.log2(RESOLVED / slowest)) if slowest < math.inf else math.inf

    def glides(self, panel: float) -> bool:
        """Whether a panel is short enough for the slowest component of all, seen or not."""
        return panel * self._slowest <= self.resolved

    def resolves(self, panel: float) -> bool:
        """Whether a panel is short enough for the fastest component of all, seen or not."""
        return panel * self._largest <= self.resolved

    @property
    def finest(self) -> float:
        """A panel that resolves every component: a power of two in units."""
        return self.unit * 2.0 ** math.floor(math.log2(RESOLVED / self._largest))

    def lattice(self, panel: float) -> float:
        """The shortest panel not below this one of those that can come again."""
        return self.unit * 2.0 ** math.ceil(math.log2(panel / self.unit))

    def moved(self, state: FloatArray, time: float) -> FloatArray:
        """The state after some time, exact."""
        result: FloatArray = state + self._powers.change(time) @ state
        return result

    def changes(self, panels: FloatArray) -> FloatArray:
        """exp(A t) - I at the nodes of panels of some lengths, shape (panels * nodes, n, n)."""
        return self._powers.changes((panels[:, None] * NODES).ravel())

    def at_nodes(self, panels: FloatArray) -> FloatArray:
        """exp(A t) at the nodes of panels of some lengths, shape (panels, nodes, n, n)."""
        n = len(self.rate)
        return expm.whole(self.changes(panels)).reshape(len(panels), COUNT, n, n)

    def chunk(self, panel: float) -> "Chunk":
        """What panels of one length need; kept where the length can come again, and doubled where half of it did."""
        chunk = self._chunks.get(panel)
        if chunk is None:
            if math.frexp(panel / self.unit)[0] != _POWER_OF_TWO:
                return Chunk(self.changes(np.array([panel])), self.guards)
            half = self._chunks.get(panel / 2)
            changes = self.changes(np.array([panel])) if half is None else expm.twice(half.changes)
            chunk = self._chunks[panel] = Chunk(changes, self.guards)
        return chunk

    def end(self, panel: float) -> FloatArray:
        """exp(A h) - I of the panels that resolve everything, h, and of those 2, 4, 8 ... times as long; kept."""
        change: FloatArray | None = self._ends.get(panel)
        if change is None:
            if panel in self._chunks:
                change = self._chunks[panel].changes[-1]
            elif panel <= self.finest:
                change = self._powers.change(panel)
            else:
                change = expm.twice(self.end(panel / 2)[None])[0]
            self._ends[panel] = change
        return change

    def keeps(self, panel: float) -> bool:
        """Whether what panels of a length need is at hand."""
        return panel in self._chunks

    # -- guards -------------------------------------------------------------------------------------------------

    def guard(self, index: int, state: FloatArray) -> tuple[float, float]:
        """A guard and its slope."""
        count = len(self.guards)
        value, slope = (self._ladder[index : 2 * count : count] @ state).tolist()
        return value, slope

    def on(self, index: int, state: FloatArray) -> FloatArray:
        """A state at a guard's root, put onto the guard itself to the last digit: what follows starts from 0."""
        own = self.guards[index, : self.own]
        size = float(own @ own)
        if not size:
            return state
        move = own * (float(self.guards[index] @ state) / size)
        if np.abs(move).max() > _ROUNDING * np.abs(state[: self.plain]).max():
            return state
        result = state.copy()
        result[: self.own] -= move
        return result

    def noise(self, states: FloatArray) -> FloatArray:
        """Rounding of the guards along states, shape (guards,)."""
        largest = np.maximum.reduce(np.abs(states))
        dust = DUST * max(largest[: self.own].tolist(), default=0.0)
        result: FloatArray = NOISE * (self._magnitudes @ largest) + dust * self._own_magnitudes
        return result

    def soonest(self, state: FloatArray) -> float:
        """Time in which a guard that starts at 0 and rises could be back, g = g' t + g'' t^2/2."""
        count = len(self.guards)
        found = (self._ladder @ state).tolist()
        noise = (NOISE * (self._magnitudes @ np.abs(state))).tolist()
        back = (
            -4 * slope / bend
            for value, slope, bend, least in zip(
                found[:count], found[count : 2 * count], found[2 * count :], noise, strict=True
            )
            if slope > 0 > bend and abs(value) <= least
        )
        return min(back, default=math.inf)

    # -- what is watched ----------------------------------------------------------------------------------------

    def seen(self, panel: float, states: FloatArray) -> FloatArray:
        """Signals at the nodes of panels of one length from these states on, shape (nodes, panels, signals)."""
        chunk = self._chunks[panel]
        if chunk.seen is None:
            chunk.seen = np.matmul(self.watch, chunk.at_nodes).transpose(0, 2, 1).copy()
        result: FloatArray = np.matmul(states, chunk.seen)
        return result

    def seen_once(self, panels: FloatArray, states: FloatArray) -> FloatArray:
        """The same of panels that have each its own length."""
        nodes = np.matmul(self.at_nodes(panels), states[:, None, :, None])[..., 0]
        result: FloatArray = nodes.transpose(1, 0, 2) @ self.watch.T
        return result


class Chunk:
    """What panels of one length need: the exponentials at the nodes, and powers of the last one.

    `changes` is what these differ from I by, shape (nodes, n, n).
    """

    def __init__(self, changes: FloatArray, guards: FloatArray) -> None:
        self.changes, self.guards = changes, guards
        self.at_nodes = at_nodes = expm.whole(changes.copy())
        self._controls: FloatArray | None = None
        self._powers = at_nodes[[0, -1]]
        self.seen: FloatArray | None = None
        """what signals see of a state from the nodes on, once it was asked for, shape (nodes, n, signals)"""

    def controls(self, starts: FloatArray) -> FloatArray:
        """Bernstein coefficients of the guards in panels from these states on, shape (panels, nodes, guards)."""
        if self._controls is None:
            controls = panels.TO_BERNSTEIN @ np.matmul(self.guards, self.at_nodes).reshape(COUNT, -1)
            self._controls = controls.reshape(-1, starts.shape[1]).T
        result: FloatArray = (starts @ self._controls).reshape(len(starts), COUNT, len(self.guards))
        return result

    def readings(self, start: FloatArray) -> FloatArray:
        """Guards at the nodes of one panel, shape (nodes, guards)."""
        result: FloatArray = (self.at_nodes @ start) @ self.guards.T
        return result

    def starts(self, state: FloatArray, count: int) -> FloatArray:
        """States after 0 .. count panels, shape (count + 1, n)."""
        whole, n = self.at_nodes[-1], len(state)
        if count < _FEW:
            found = np.empty((count + 1, n))
            found[0] = state
            for k in range(count):
                found[k + 1] = whole @ found[k]
            return found
        while len(self._powers) <= count:  # doubling keeps rounding to a few units
            self._powers = np.concatenate([self._powers, self._powers[1:] @ self._powers[-1]])
        return (self._powers[: count + 1].reshape(-1, n) @ state).reshape(count + 1, n)
