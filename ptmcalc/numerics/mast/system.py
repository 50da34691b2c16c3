"""A mast over a base as a piecewise-linear system for `numerics.piecewise`.

    q_k'' + 2 zeta_k w_k q_k' + w_k^2 q_k = -L_k a + p_k(contact) f + p_k(guide) g
    m a + sum_k L_k q_k'' = push + grips + f

q are the modes over a base that is held, a the acceleration of the base, m the mass of all. The base slips past each
grip or is held by one; the modes left out follow forces at once (their flexibility is in series with a contact) and
move with the base.
"""

import itertools
import math
from collections.abc import Iterator
from functools import cached_property

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.mast.case import FREE, LOOSE, MOVED, TOUCH, Case, State
from ptmcalc.numerics.mast.parts import FloatArray
from ptmcalc.numerics.mast.rows import Rows
from ptmcalc.numerics.motion import Look, Motion, Reaction
from ptmcalc.numerics.piecewise import JAMMED
from ptmcalc.numerics.record import Event

_AT = 1e-12
"""Share of the speeds in a case below which a base has the speed of a grip."""
_LATE = 4 * float(np.finfo(float).eps)


class MastSystem:
    """The equations of every state, and what follows each event."""

    input_speed = 0.0

    def __init__(self, case: Case) -> None:
        self.case = case
        mast, base = case.mast, case.base
        self.count = len(case.ratios)
        self.own = 2 + 2 * self.count
        self.size = self.own + 2
        self.one, self.clock = self.own, self.own + 1
        self.w = mast.frequencies[: self.count]
        self.shares = mast.participation[: self.count]
        self.shapes = mast.shapes[:, : self.count]
        total, followed = mast.elements.total, float(self.shares @ self.shares)
        self.total = base.mass + total
        self.rest = base.mass + max(total - followed, 0.0)
        """mass that moves with the base"""
        self.breaks = base.breaks
        self._motions: dict[State, Motion] = {}
        self._rows: dict[State, Rows] = {}

    # -- signals and their works -------------------------------------------------------------------------------------

    @cached_property
    def watched(self) -> dict[tuple[str, int], int]:
        """Index of every watched signal by what it is and its number."""
        case = self.case
        names = [("way", 0), ("speed", 0), ("acceleration", 0), ("moment", 0), ("contact", 0), ("guide", 0)]
        names += [("drive", 0), ("push", 0), ("dash", 0), ("dash_rate", 0)]
        names += [("deflection", i) for i in range(len(case.places))]
        names += [("grip", j) for j in range(len(case.base.grips))]
        names += [("rate", k) for k in range(self.count)]
        return {name: index for index, name in enumerate(names)}

    @cached_property
    def unsought(self) -> list[int]:
        """Signals that are watched for their works alone."""
        return [index for (what, _), index in self.watched.items() if what in ("dash", "dash_rate", "rate")]

    @cached_property
    def products(self) -> list[tuple[int, int]]:
        """Pairs whose product is a power, or over 2 zeta w one."""
        at = self.watched
        pairs = [(at[what, j], at["speed", 0]) for what, j in at if what in ("drive", "push", "grip")]
        pairs.append((at["dash", 0], at["dash_rate", 0]))
        return pairs + [(at["rate", k], at["rate", k]) for k in range(self.count)]

    def works(self, integrals: FloatArray) -> tuple[dict[str, float], float]:
        """Work put in by each force on the base, and what damping took, that of a contact too [J]."""
        names = [what if what != "grip" else self.case.base.grips[j].name for what, j in self.watched
                 if what in ("drive", "push", "grip")]  # fmt: skip
        put = dict(zip(names, integrals[: len(names)].tolist(), strict=True))
        dash, rates = integrals[len(names)], integrals[len(names) + 1 :]
        return put, float(dash + 2 * self.case.ratios * self.w @ rates)

    def energy(self, state: State, z: FloatArray) -> float:
        """Kinetic and elastic energy [J]."""
        v, q, rates = float(z[1]), z[2 : 2 + self.count], z[2 + self.count : self.own]
        kinetic = self.total * v**2 / 2 + v * float(self.shares @ rates) + float(rates @ rates) / 2
        return kinetic + float((self.w * q) @ (self.w * q)) / 2 + self._rows_of(state).sprung(z)

    # -- the System --------------------------------------------------------------------------------------------------

    @cached_property
    def scale(self) -> FloatArray:
        """Sizes of the states: those of the motions that the speed of the base and the forces on it excite."""
        base = self.case.base
        forces = [
            abs(value) for signal in (base.push, *(grip.capacity for grip in base.grips)) for value in signal.values
        ]
        forces += [
            abs(signal.slopes[k]) * (signal.times[k + 1] - signal.times[k])
            for signal in base.signals
            for k in range(len(signal.times) - 1)
        ]
        speed = max(abs(one) for one in (base.speed, *(grip.speed for grip in base.grips)))
        pace = max(forces) / self.total
        if base.path is not None:
            pace = max(pace, *(abs(value) for value in base.path.values))
        slowest = float(self.w[0])
        speed = max(speed, pace / slowest) or 1.0
        found = np.ones(self.size)
        found[0], found[1] = speed / slowest, speed
        sizes = np.maximum(np.abs(self.shares), 1e-3 * np.abs(self.shares).max(initial=1e-300)) * speed
        found[2 : 2 + self.count], found[2 + self.count : self.own] = sizes / self.w, sizes
        found[self.clock] = 1 / slowest
        return found

    def start(self) -> tuple[State, FloatArray]:
        """State and z at the beginning: the mast is straight beside its base."""
        z = np.zeros(self.size)
        z[1], z[self.one] = self.case.base.speed, 1.0
        return State(self._slipping(float(z[1]))), z

    def motion(self, mode: State) -> Motion:
        """The equations of a state."""
        found = self._motions.get(mode)
        if found is None:
            rows = self._rows_of(mode)
            found = Motion(rows.rate(), np.zeros((self.size, 0)), rows.guards(), rows.watch())
            self._motions[mode] = found
        return found

    def next_break(self, mode: State, time: float) -> float:
        """The end of a stretch of time."""
        return self.breaks[mode.stretch + 1] if mode.stretch + 1 < len(self.breaks) else math.inf

    def react(self, mode: State, time: float, state: FloatArray, fired: int | None) -> Reaction:
        """The state that holds from now on: the first whose guards all stay at 0 or above."""
        z, lost = state.copy(), 0.0
        now = mode
        while now.stretch + 1 < len(self.breaks) and time >= self.breaks[now.stretch + 1] * (1 - _LATE):
            now = now._replace(stretch=now.stretch + 1)
            z[self.clock] = 0.0
        if mode.contact == JAMMED:
            self._stand_still(z)
        self._calm(z)
        found = next(self._holding(now, z), None)
        rigid = self.case.obstacle is not None and math.isinf(self.case.obstacle.stiffness)
        if rigid and mode.contact == FREE and (found is None or self._meets(z)):
            lost = self._strike(now, z)
            found = next(self._holding(now._replace(contact=JAMMED), z), None)
        if found is None:
            raise NumericsError("NUM101", f"no state of the mast holds at {time:.9g} s")
        if self.damped:  # what a contact that lets go keeps in its spring comes to nothing
            lost += self.energy(mode, z) - self.energy(found, z)
        return Reaction(found, z, tuple(self._events(mode, found, time)), lost)

    def apart(self, place: FloatArray) -> float:
        """Share of a force at a point that the base feels at once; none where a lump there is all that vibrates."""
        found = 1 - float(self.shares @ place)
        return found if abs(found) > 1e-12 else 0.0

    @property
    def bare(self) -> bool:
        """Whether the point of contact has to be one of the modes alone: where its speed counts."""
        return self.damped or (self.case.obstacle is not None and math.isinf(self.case.obstacle.stiffness))

    @property
    def damped(self) -> bool:
        """Whether the contact has damping of its own."""
        return self.case.obstacle is not None and self.case.obstacle.damping > 0

    # -- what follows an event ---------------------------------------------------------------------------------------

    def _calm(self, z: FloatArray) -> None:
        """A base beside the speed of a grip has it exactly."""
        for grip in self.case.base.grips:
            if abs(z[1] - grip.speed) <= _AT * self.scale[1]:
                z[1] = grip.speed

    def _slipping(self, speed: float) -> int:
        if self.case.base.path is not None:
            return MOVED
        return 2 * sum(grip.speed < speed for grip in self.case.base.grips)

    def _codes(self, speed: float) -> list[int]:
        """How the base may move at a speed: held first."""
        if self.case.base.path is not None:
            return [MOVED]
        at = [j for j, grip in enumerate(self.case.base.grips) if grip.speed == speed]
        return [2 * at[0] + 1, 2 * at[0], 2 * at[0] + 2] if at else [self._slipping(speed)]

    def _holding(self, now: State, z: FloatArray) -> Iterator[State]:
        look = Look(self, z)
        contacts = [now.contact]
        if self.case.obstacle is not None:
            known = [FREE, TOUCH, *([LOOSE] if self.damped else [])]
            known = known if math.isfinite(self.case.obstacle.stiffness) else [FREE]
            contacts += [contact for contact in known if contact != now.contact]
        sides = [now.guide, *(side for side in (0, 1, -1) if side != now.guide)] if self.case.guide is not None else [0]
        for base, contact, guide in itertools.product(self._codes(float(z[1])), contacts, sides):
            candidate = State(base, contact, guide, now.stretch)
            if min(look.told(self.motion(candidate)), default=0) >= 0:
                yield candidate

    def _meets(self, z: FloatArray) -> bool:
        """Whether the point of contact is at the obstacle and moves into it."""
        assert self.case.obstacle is not None
        place = self.case.mast.at(self.case.obstacle.place)[: self.count]
        way = float(z[0] + place @ z[2 : 2 + self.count]) - self.case.obstacle.gap
        rate = float(z[1] + place @ z[2 + self.count : self.own])
        return way >= -1e-12 * float(self.scale[0]) and rate > 1e-12 * float(self.scale[1])

    def _stand_still(self, z: FloatArray) -> None:
        """A point that has stood still is where it was, to the last digit."""
        assert self.case.obstacle is not None
        place = self.case.mast.at(self.case.obstacle.place)[: self.count]
        size = float(place @ place)
        off = float(z[0] + place @ z[2 : 2 + self.count]) - self.case.obstacle.gap
        z[2 : 2 + self.count] -= place * (off / size)
        rate = float(z[1] + place @ z[2 + self.count : self.own])
        z[2 + self.count : self.own] -= place * (rate / size)

    def _strike(self, now: State, z: FloatArray) -> float:
        """The struck point stops dead; the energy that is lost. A base that is moved keeps its speed."""
        assert self.case.obstacle is not None
        place = self.case.mast.at(self.case.obstacle.place)[: self.count]
        before = self.energy(now, z)
        apart, rate = self.apart(place), float(z[1] + place @ z[2 + self.count : self.own])
        per_base = 0.0 if self.case.base.path is not None else apart / self.rest
        impulse = -rate / (per_base * apart + float(place @ place))
        change = per_base * impulse
        z[1] += change
        z[2 + self.count : self.own] += place * impulse - self.shares * change
        self._calm(z)
        return before - self.energy(now, z)

    def _events(self, before: State, after: State, time: float) -> Iterator[Event]:
        if before.base != after.base and after.base != MOVED:
            yield Event(time, "base", self._word(before.base), self._word(after.base))
        if before.contact != after.contact:
            yield Event(time, "contact", before.contact, after.contact)
        if before.guide != after.guide:
            yield Event(time, "guide", str(before.guide), str(after.guide))

    def _word(self, code: int) -> str:
        if code % 2 == 0:
            return "slips"
        return "at rest" if self.case.base.grips[code // 2].speed == 0 else "at speed"

    def _rows_of(self, state: State) -> "Rows":
        found = self._rows.get(state)
        if found is None:
            found = self._rows[state] = Rows(self, state)
        return found
