"""A load hauled on a rope, played from event to event.

Between events the equations are smooth. A panel of Chebyshev nodes is solved by successive approximation, its length
such that they converge and that the tail of the series has faded; what keeps the present state are guards, and the
first root of one ends the panel.

A rope with mass is a rod: its force is F = f(t - x/c) + g(t + x/c), its speed (f - g)/Z, x from the drum down. At both
ends it is a dashpot Z beside what comes in, which left the other end one transit before:

    F_top = Z (w - z') + 2 g(t),   f = F_top - g;      F_load = 2 f(t) - Z v,   g = F_load - f

so that both ends are ordinary equations over panels no longer than a transit (d'Alembert). A corner goes to and fro
along the rope for ever: every end of a panel is an end of one again a transit later.

A rope that is hauled in has the strain e = (D - s)/s over its unstrained length s, D the distance of drum and load:

    F = C e + b (stretch rate),   s' = -w/(1 + e) hauling,   s' = -w/(1 + e_0) paying out what was wound with e_0

whose state is l - s, so that nothing is lost where a stretch of millimetres stands beside hundreds of metres.
"""

import math
from collections import deque
from dataclasses import dataclass, field

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.rope import rule
from ptmcalc.numerics.rope.equations import ZD, Equations, FloatArray, Hauled, Mode, Rod, S, U, V, W, X, Z
from ptmcalc.numerics.rope.parts import Governed, Haul, Lines

_ROUNDS = 60
_SPEEDS, _WAYS = [W, ZD, V], [X, Z, U, S]
_SETTLED, _NEARLY, _FADED = 2e-15, 1e-13, 1e-12
"""Change of a round beside the size of a state at which approximation ends, or may; tail of the series."""
_COARSE = 1e-3
"""Share of the longest panel below which the tail is rounding."""
_LEFT = 1e-2
"""Share of its length below which a rope is hauled in: its stiffness, which goes with what is left, is a hundred times
what the panels were made for."""
_MOST_PANELS = 40_000
_MOST_AT_ONCE = 40
_VAIN = 4
"""Panels whose time one that does not converge takes beside its own."""
_NOISE = 1e-11
_SHORTEST = 1e-5


@dataclass(slots=True)
class Panel:
    """One panel as it was: its start and length, states, forces at both ends of the rope and waves that leave them,
    shape (nodes, ...)."""

    start: float
    length: float
    states: FloatArray
    top: FloatArray
    bottom: FloatArray
    down: FloatArray
    up: FloatArray
    gear: FloatArray
    """force through the gear, on the drum's side"""
    power: FloatArray
    """work per time put in, and lost [W], shape (nodes, 2)"""


@dataclass(slots=True)
class Played:
    """A motion as it went."""

    panels: list[Panel]
    events: list[tuple[float, str]]
    mode: Mode
    time: float
    state: FloatArray
    lost: float
    """in impacts [J]"""
    slack_at: float = math.inf
    """when a rope with mass went slack, which ends the march"""
    rests: list[float] = field(default_factory=list)
    """when the drive came to rest"""

    def stack(self, what: str) -> FloatArray:
        """One signal of all panels, shape (panels, nodes)."""
        return np.array([getattr(panel, what) for panel in self.panels])


class March(Equations):
    """One march; `finer` divides time further."""

    def __init__(self, haul: Haul, rope: Rod | Hauled, finer: float = 1.0) -> None:
        super().__init__(haul, rope)
        self.finer = finer
        self.history: deque[tuple[float, float, FloatArray]] = deque()
        self.ends: deque[float] = deque()
        self._before: tuple[float, float, FloatArray]
        self.longest = self._longest()
        self.sizes = np.zeros(7)

    def _longest(self) -> float:
        """Longest panel that successive approximation takes [s]."""
        haul = self.haul
        load, drive = haul.load_mass, haul.drum_mass + haul.motor_mass
        if self.rod is not None:
            z = self.rod.impedance
            rates = [z / load, z / drive if drive else 0.0]
            rates += [z / self.heavy.mass] if self.heavy is not None else []
            rates += [self.soft.stiffness / z] if self.soft is not None else []
            spring = 0.0
        else:
            assert self.hauled is not None
            spring = self.hauled.extensional / self.hauled.length
            light = min(load, drive, self.heavy.mass if self.heavy is not None else math.inf)
            rates = [math.sqrt(3 * spring / light), 3 * self.hauled.damping / light]
        if self.heavy is not None:
            rates += [math.sqrt((self.heavy.stiffness + spring) / self.heavy.mass)]
            rates += [self.heavy.damping / self.heavy.mass]
        rates += [self._pull_slope() / drive if drive else 0.0]
        longest = 1.5 / max(rates)
        return min(longest, self.rod.transit if self.rod is not None else math.inf) / self.finer

    def _pull_slope(self) -> float:
        """Steepest fall of the drive's force over its speed; a smooth curve finds out by itself."""
        steepest = 0.0
        for stage in self.haul.stages:
            law = stage.law
            if isinstance(law, Lines) and len(law.knots) > 1:
                steepest = max(steepest, float(np.abs(np.diff(law.values) / np.diff(law.knots)).max()))
            elif isinstance(law, Governed):
                steepest = max(steepest, law.stiffness)
        return steepest

    # -- marching -----------------------------------------------------------------------------------------------

    def begin(self) -> tuple[Mode, FloatArray]:
        """Mode and state at time 0."""
        haul, y = self.haul, np.zeros(7)
        y[W] = haul.speed
        pulls = 0.0 if haul.lifts else haul.weight
        if not haul.lifts:
            y[V] = haul.speed
        if haul.structure is not None and not haul.lifts:
            y[Z] = haul.weight / haul.structure.stiffness
        if self.hauled is not None:
            strain = pulls / self.hauled.extensional
            y[S] = -haul.slack if haul.lifts else (self.hauled.length * strain + y[Z]) / (1 + strain)
        if self.rod is not None:
            z, n = self.rod.impedance, rule.COUNT
            down, up = (pulls + z * y[V]) / 2, (pulls - z * y[V]) / 2
            tau = self.rod.transit
            self._before = (-tau, tau, np.tile([down, up], (n, 1)))
            self.history, self.ends = deque([self._before]), deque([tau])
        taut = not haul.lifts or haul.slack == 0
        mode = Mode(
            int(np.sign(haul.speed)), 1 if haul.way > 0 else -1, False, haul.way or 1, haul.lifts, taut, 0, 0, math.inf
        )
        if haul.stages:
            mode = mode._replace(piece=haul.stages[0].law.piece(haul.speed))
        return mode, y

    def play(self, end: float, most_panels: float = _MOST_PANELS) -> Played:
        """The motion until a time; it is given up after so many panels, those that did not converge among them.

        Raises:
            NumericsError: NUM102, too many panels, or one that converges at no length.
        """
        mode, y = self.begin()
        done = Played([], [], mode, 0.0, y, 0.0)
        breaks = [time for time in self.haul.breaks if time < end]
        done.mode, done.state = self._settled(done, mode, y, 0.0, "start")
        at_once, length, tried = 0, self.longest, 0
        while done.time < end * (1 - 1e-14):
            stop = min([end, *(time for time in breaks if time > done.time * (1 + 1e-14) + 1e-15)])
            stop = min(stop, self._next_end(done.time))
            h = min(length, stop - done.time)
            full = h >= stop - done.time
            tried += 1
            if tried > most_panels:
                raise NumericsError(
                    "NUM102",
                    f"drive and rope take more than {most_panels:.2g} steps by {done.time:.3g} s: given up",
                )
            panel, fired = self._panel(done, h)
            if panel is None:
                length = h / 2
                tried += _VAIN
                self._runs_out(done)
                if length < _SHORTEST * self.longest:
                    raise NumericsError("NUM102", "the motion of drive and rope does not converge")
                continue
            if panel.length > 0:
                self._take(done, panel)
                self._runs_out(done)
                if full and fired is None:
                    done.time = stop
                length, at_once = min(self.longest, 2 * length), 0
            else:
                at_once += 1
                if at_once > _MOST_AT_ONCE:
                    raise NumericsError("NUM102", f"the drive chatters at {done.time:.6g} s: {fired}")
            if fired is not None:
                if fired == "slack" and self.rod is not None:
                    done.slack_at = done.time
                    return done
                trip = done.mode.trip
                done.mode, done.state = self._settled(done, done.mode, done.state, done.time, fired)
                if done.mode.trip != trip:
                    breaks += [done.time + one for one in self.haul.breaks_after_the_trip]
        return done

    def _runs_out(self, done: Played) -> None:
        """With next to nothing left of the rope the load hangs on the drum: nothing elastic can be followed."""
        if self.hauled is not None and self.hauled.length - done.state[S] < _LEFT * self.hauled.length:
            raise NumericsError("NUM104", f"the drum has hauled in all of the rope by {done.time:.3g} s")

    def _next_end(self, time: float) -> float:
        """The next time at which a corner arrives, a transit after it left."""
        while self.ends and self.ends[0] <= time + 1e-9 * (self.rod.transit if self.rod is not None else 0.0):
            self.ends.popleft()
        return self.ends[0] if self.ends else math.inf

    def _incoming(self, t: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Waves that arrive at the load and at the drum at these times."""
        if self.rod is None:
            return np.zeros(len(t)), np.zeros(len(t))
        since = t - self.rod.transit
        middle = (since[0] + since[-1]) / 2
        while len(self.history) > 1 and self.history[1][0] <= since[0] - self.rod.transit:
            self.history.popleft()
        found = next((one for one in self.history if one[0] <= middle <= one[0] + one[1]), self.history[-1])
        start, length, values = found
        inside = np.clip((since - start) / length, 0.0, 1.0)
        both = rule.to(inside) @ values
        return both[:, 0], both[:, 1]

    def _panel(self, done: Played, h: float) -> tuple[Panel | None, str | None]:
        """A panel, cut where the first guard ends it, and that guard's name; None where it does not converge."""
        begin, mode, t = done.time, done.mode, done.time + h * rule.NODES
        down, up = self._incoming(t)
        y = np.tile(done.state, (rule.COUNT, 1))
        for _ in range(_ROUNDS):
            slope = self.rate(y, t, begin, mode, down, up)
            following = done.state + h * (rule.INTEGRAL @ slope)
            change = np.abs(following - y).max(axis=0)
            y = following
            sizes = self._sizes(y, h)
            if np.all(change <= _SETTLED * sizes):
                break
        else:
            if not np.all(change <= _NEARLY * sizes):
                return None, None
        if np.any(h * rule.tail(slope) > _FADED * sizes) and h > _COARSE * self.longest:
            return None, None
        self.sizes = sizes
        place, fired = 2.0, None
        for name, values, size in self.guards(y, t, begin, mode, down, up):
            dense = rule.DENSE @ values
            low = np.flatnonzero(dense < -_NOISE * size)
            if not len(low):
                continue
            first = int(low[0])
            at = rule.root(values, float(rule.PLACES[first - 1]), float(rule.PLACES[first])) if first else 0.0
            if at < place:
                place, fired = at, name
        if fired is not None and place * h <= 1e-15 * max(begin, h):
            return Panel(begin, 0.0, y[:1], *(np.zeros(1),) * 5, np.zeros((1, 2))), fired
        if place < 1:
            cut = rule.to(place * rule.NODES)
            y, t, h = cut @ y, begin + place * h * rule.NODES, place * h
            down, up = cut @ down, cut @ up
        top, bottom = self.ends_of(y, down, up, mode)
        through, power = self._through(y, t, begin, mode, top)
        return Panel(begin, h, y, top, bottom, top - up, bottom - down, through, power), fired

    def _sizes(self, y: FloatArray, h: float) -> FloatArray:
        """Sizes of the states so far, those of all speeds and of all ways alike: beside them rounding is nothing."""
        found = np.maximum(self.sizes, np.abs(y).max(axis=0))
        fall = self.haul.weight / self.haul.load_mass * h
        found[_SPEEDS] = max(float(found[_SPEEDS].max()), fall)
        found[_WAYS] = max(float(found[_WAYS].max()), fall * h)
        return np.asarray(found)

    def _take(self, done: Played, panel: Panel) -> None:
        done.panels.append(panel)
        done.time = panel.start + panel.length
        done.state = panel.states[-1].copy()
        if self.rod is not None:
            self.history.append((panel.start, panel.length, np.stack([panel.down, panel.up], axis=1)))
            arrives = done.time + self.rod.transit
            if not self.ends or arrives > self.ends[-1] + 1e-9 * self.rod.transit:
                self.ends.append(arrives)

    def stored(self, mode: Mode, y: FloatArray, panels: list[Panel]) -> float:
        """Kinetic and elastic energy in the end [J]."""
        haul, weights = self.haul, rule.INTEGRAL[-1]
        found = (haul.motor_mass + haul.drum_mass) * y[W] ** 2 / 2 + haul.load_mass * y[V] ** 2 / 2
        sag = y[Z]
        if self.hauled is not None:
            strain = float(self._pulling(y[None], mode)[0])
            force = self.hauled.extensional * strain
            found += force * strain * (self.hauled.length - y[S]) / 2
            sag = force / self.soft.stiffness if self.soft is not None else sag
        if self.heavy is not None:
            found += self.heavy.mass * y[ZD] ** 2 / 2 + self.heavy.stiffness * sag**2 / 2
        elif self.soft is not None:
            found += self.soft.stiffness * sag**2 / 2
        if self.rod is None:
            return float(found)
        since = (panels[-1].start + panels[-1].length if panels else 0.0) - self.rod.transit
        waves = [(one.start, one.length, np.stack([one.down, one.up], axis=1)) for one in panels]
        for start, length, values in [self._before, *waves]:
            if start + length <= since:
                continue
            share = min(max((since - start) / length, 0.0), 1.0)
            cut = rule.to(share + (1 - share) * rule.NODES) @ values
            found += length * (1 - share) * float((weights @ cut**2).sum()) / self.rod.impedance
        return float(found)

    # -- events -------------------------------------------------------------------------------------------------

    def _settled(self, done: Played, mode: Mode, y: FloatArray, time: float, fired: str) -> tuple[Mode, FloatArray]:
        """Mode and state after an event."""
        y = y.copy()
        if fired != "start" and fired != "power":
            done.events.append((time, fired))
        if fired == "power":
            return mode._replace(power=-mode.power), y
        if fired == "lift":
            return mode._replace(ground=False), y
        if fired == "land":
            done.lost += self.haul.load_mass * y[V] ** 2 / 2
            y[U] = y[V] = 0.0
            return mode._replace(ground=True), y
        if fired in ("taut", "slack"):
            return mode._replace(taut=fired == "taut"), y
        if fired == "trip":
            mode = mode._replace(trip=time)
        elif fired == "stage":
            mode = mode._replace(stage=mode.stage + 1)
            mode = mode._replace(piece=self.haul.stages[mode.stage].law.piece(float(y[W])))
        elif fired.startswith("knot"):
            mode = mode._replace(piece=int(fired.split()[1]))
        elif fired == "up to its limit":
            mode = mode._replace(follows=False, pushing=1)
        elif fired == "down to its limit":
            mode = mode._replace(follows=False, pushing=-1)
        elif fired == "rest":
            y[W] = 0.0
            mode = mode._replace(turn=0)
            done.rests.append(time)
        elif fired in ("up", "down"):
            mode = mode._replace(turn=1 if fired == "up" else -1)
        if fired in ("catches up", "start", "rest") and self.haul.set_speed is not None:
            mode, y = self._caught(mode, y, time, fired)
        return self._powered(mode, y, time), y

    def _caught(self, mode: Mode, y: FloatArray, time: float, fired: str) -> tuple[Mode, FloatArray]:
        """A drive at its set speed keeps it where it can, else goes on pushing, to the other side."""
        course = self.haul.set_speed
        assert course is not None
        wanted = float(course.at(time, np.array([time]))[0])
        if fired == "rest" or abs(wanted - y[W]) > 1e-9 * max(abs(wanted), 1e-9):
            pushing = int(np.sign(wanted - y[W])) or mode.pushing
            return mode._replace(pushing=pushing), y
        y[W] = wanted
        held = mode._replace(follows=True, turn=mode.turn or self.haul.way)
        held = self._powered(held, y, time)
        t = np.array([time])
        down, up = self._incoming_at(time)
        top, _ = self.ends_of(y[None], down, up, held)
        need, cap = self.needed(y[None], t, time, held, top)[0], self._limit(mode, time, t)[0]
        if abs(need) <= cap * (1 + 1e-9):
            return held, y
        return mode._replace(pushing=int(np.sign(need))), y

    def _incoming_at(self, time: float) -> tuple[FloatArray, FloatArray]:
        """The waves that arrive just after a time."""
        if self.rod is None:
            return np.zeros(1), np.zeros(1)
        tau = self.rod.transit
        down, up = self._incoming(time + 1e-7 * tau * rule.NODES)
        return down[:1], up[:1]

    def _powered(self, mode: Mode, y: FloatArray, time: float) -> Mode:
        """The mode with the direction in which power flows through the gear."""
        if not mode.turn:
            return mode
        haul, t = self.haul, np.array([time])
        down, up = self._incoming_at(time)
        top, _ = self.ends_of(y[None], down, up, mode)
        on_motor, on_drum = self._brakes(mode, time, t)
        behind = self._behind(top, on_drum, mode.turn)
        if mode.follows:
            through = haul.drum_mass * self._set_rate(time) + behind
        else:
            push = self._pull(mode, time, t, y[None]) - on_motor * mode.turn
            through = haul.drum_mass * push + haul.motor_mass * behind
        side = float(through[0]) * mode.turn
        return mode._replace(power=1 if side > 0 else -1 if side < 0 else mode.power)


def energy(march: March, played: Played) -> tuple[float, float]:
    """(what the ledger of a march leaves over [J], the scale of what was turned over [J]).

    Works are integrals of forces times speeds over the panels; what is stored is read from the state and, in a rod,
    from the waves that are on their way, (f^2 + g^2)/Z over a transit. So the rest verifies propagation and events.
    """
    weights = rule.INTEGRAL[-1]
    works = sum((panel.length * (weights @ panel.power) for panel in played.panels), np.zeros(2))
    turned = sum(panel.length * float(weights @ np.abs(panel.power).sum(axis=1)) for panel in played.panels)
    mode, y = march.begin()
    before, after = march.stored(mode, y, []), march.stored(played.mode, played.state, played.panels)
    left = float(works[0] - works[1]) - played.lost - (after - before)
    return abs(left), max(turned, abs(before), abs(after), played.lost, 1e-300)
