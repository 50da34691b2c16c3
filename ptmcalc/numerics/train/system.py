"""A train as a piecewise-linear system.

Every torque is a functional of the state (`balance`), so a contact state is one linear system, and what keeps it are
functionals too, its guards (`assembly`); what follows when one of them is crossed is found in `react`.
"""

from collections.abc import Iterator
from functools import cached_property

import numpy as np

from ptmcalc.numerics import expm
from ptmcalc.numerics.motion import NOISE, Motion, Reaction
from ptmcalc.numerics.train import drives, links
from ptmcalc.numerics.train.assembly import Assembly
from ptmcalc.numerics.train.balance import CANCELS
from ptmcalc.numerics.train.drives import Place, SignalRows
from ptmcalc.numerics.train.links import Stretch
from ptmcalc.numerics.train.parts import Grip, Spring, Train
from ptmcalc.numerics.train.react import Candidates, Reactor, Ties
from ptmcalc.numerics.train.signals import FloatArray, Inputs, Now, Signal
from ptmcalc.numerics.train.state import NO_FRICTION, Change, State
from ptmcalc.numerics.train.tree import Coordinates, Groups


class TrainSystem:
    """The system of a train; see `piecewise.System`."""

    def __init__(self, train: Train) -> None:
        self.train = train
        self.groups = Groups.among(train)
        self.coordinates = Coordinates.of(train, self.groups)
        self.signals = tuple(dict.fromkeys(self._all_signals()))
        self.inputs = Inputs.of(self.signals)
        self.own = 2 * self.groups.count
        self.size = self.own + self.inputs.size
        self.input_speed = max((signal.largest_frequency for signal in self.signals), default=0.0)
        self.lossy = tuple(index for index, mesh in enumerate(train.meshes) if mesh.lossy)
        self.clutches = tuple(index for index, grip in enumerate(train.grips) if self._joins(grip))
        self.clutch_rows = {
            index: self.groups.row(train.grips[index].first, train.grips[index].second) for index in self.clutches
        }
        self.locking = any(train.meshes[index].reverse < 0 for index in self.lossy)
        self._motions: dict[State, tuple[Motion, tuple[Change, ...]]] = {}
        self._signals: dict[tuple[Now, ...], tuple[SignalRows, list[Place]]] = {}
        self._breaks: dict[tuple[object, ...], tuple[float, tuple[float, ...]]] = {}
        self.ties: dict[tuple[object, ...], Ties] = {}
        self.candidates: dict[tuple[object, ...], Candidates] = {}
        self.words: dict[tuple[State, State], list[tuple[str, str, str]]] = {}
        self.first_impacts: dict[int, float] = {}
        self.fastest = 0.0
        self._rows()

    def _all_signals(self) -> Iterator[Signal]:
        for drive in self.train.drives:
            yield from drives.signals_of(drive)
        for grip in self.train.grips:
            yield from (grip.capacity, grip.gate)
        for guide in self.train.guides:
            yield guide.acceleration

    def _joins(self, grip: Grip) -> bool:
        """Whether a grip acts between two groups, not against the ground."""
        return grip.second is not None and self.groups.of[grip.first] != self.groups.of[grip.second]

    def _rows(self) -> None:
        """Positions and speeds of groups and bodies, extensions of links, as functionals of the state."""
        count, size = self.groups.count, self.size
        self.one = np.zeros(size)
        self.one[self.own] = 1.0
        self.turn, self.speed = np.zeros((count, size)), np.zeros((count, size))
        self.turn[:, :count] = self.coordinates.basis
        self.speed[:, count : self.own] = self.coordinates.basis
        of, ratio = np.array(self.groups.of, dtype=int), self.groups.ratio
        start = np.array([body.position for body in self.train.bodies])
        self.extended = np.zeros(count)
        for spring, place in zip(self.train.springs, self.coordinates.places, strict=True):
            if place is not None:
                self.extended[place] = self._at_start(spring)
        moved = start - ratio * (self.coordinates.basis @ self.extended)[of]
        self.body_speed = ratio[:, None] * self.speed[of]
        self.body_position = ratio[:, None] * self.turn[of] + np.outer(moved, self.one)
        self.stretches = tuple(self._stretch(index) for index in range(len(self.train.springs)))

    def _at_start(self, spring: Spring) -> float:
        """Extension of a link at the start. It is a state itself, so that contact without play is at 0 exactly."""
        bodies = self.train.bodies
        second = bodies[spring.second].position if spring.second is not None else 0.0
        over = bodies[spring.over].position if spring.over is not None else 0.0
        return bodies[spring.first].position - second - over - spring.rest

    def _stretch(self, index: int) -> Stretch:
        spring, place, count = self.train.springs[index], self.coordinates.places[index], self.groups.count
        x, rate = np.zeros(self.size), np.zeros(self.size)
        if place is None:
            row = self.groups.link(spring)
            x[:count] = self.apart(row)[count : self.own]
            rate[count : self.own] = x[:count]
            x += (self._at_start(spring) - float(x[:count] @ self.extended)) * self.one
        else:
            x[place] = rate[count + place] = 1.0
        return Stretch(x, rate, self.one)

    def apart(self, row: FloatArray) -> FloatArray:
        """A sum of group speeds as a functional; what cancels in it is 0, not rounding."""
        speed = row @ self.speed
        speed[np.abs(speed) <= CANCELS * (np.abs(row) @ np.abs(self.speed))] = 0.0
        return speed

    # -- the start ----------------------------------------------------------------------------------------------

    def start(self) -> tuple[State, FloatArray]:
        """State and z at time 0; which contacts hold is left to the first reaction."""
        self.first_impacts.clear()
        self.fastest = 0.0
        z = np.zeros(self.size)
        z[: self.groups.count] = self.extended
        speeds = np.zeros(self.groups.count)
        for body, group, ratio in zip(self.train.bodies, self.groups.of, self.groups.ratio, strict=True):
            if body.speed:
                speeds[group] = body.speed / ratio
        apart, largest = self.coordinates.inverse @ speeds, np.abs(self.coordinates.inverse) @ np.abs(speeds)
        apart[np.abs(apart) <= NOISE * largest] = 0.0  # two that turn alike: rounding must not open a flank that closes
        z[self.groups.count : self.own] = apart
        z[self.own :] = self.inputs.start()
        state = State(
            contacts=tuple(links.rest_state(spring) for spring in self.train.springs),
            signals=tuple(Now(-1) if signal.trigger else Now() for signal in self.signals),
            drives=tuple(
                (0, drives.law_now(drive.stages[0].law, *self.seen(z, drive.body))) for drive in self.train.drives
            ),
            turning=tuple(
                int(np.sign(speeds[group])) if self.has_friction(group) else NO_FRICTION
                for group in range(self.groups.count)
            ),
            clutches=tuple(
                int(np.sign(float(self.groups.row(grip.first, grip.second) @ speeds)))
                for grip in (self.train.grips[index] for index in self.clutches)
            ),
            meshes=(1,) * len(self.lossy),
        )
        return state, z

    def seen(self, z: FloatArray, body: int) -> tuple[float, float]:
        """Speed and position of a body."""
        return float(self.body_speed[body] @ z), float(self.body_position[body] @ z)

    def has_friction(self, group: int) -> bool:
        """Whether something can hold a group at rest: a brake, a bearing, a mesh with losses."""
        grips = (grip for grip in self.train.grips if not self._joins(grip))
        return any(self.groups.of[grip.first] == group for grip in grips) or any(
            self.groups.of[self.train.meshes[index].inner] == group for index in self.lossy
        )

    @cached_property
    def guided(self) -> frozenset[int]:
        """Groups whose motion is prescribed."""
        return frozenset(self.groups.of[guide.body] for guide in self.train.guides)

    @cached_property
    def scale(self) -> FloatArray:
        """Sizes of the states that make the equations of the closed train alike in size."""
        state, _ = self.start()
        closed = tuple(
            ("firm", 1) if phase == "open" and spring.law not in ("rigid",) else (phase, side)
            for (phase, side), spring in zip(state.contacts, self.train.springs, strict=True)
        )
        turning = tuple(1 if one == 0 else one for one in state.turning)
        clutches = (1,) * len(state.clutches)
        return expm.balance(Assembly(self, state._replace(contacts=closed, turning=turning, clutches=clutches)).rate())

    # -- one contact state --------------------------------------------------------------------------------------

    def motion(self, state: State) -> Motion:
        """The equations of a contact state."""
        return self.described(state)[0]

    def changes(self, state: State) -> tuple[Change, ...]:
        """What the guards of a contact state stand for."""
        return self.described(state)[1]

    def described(self, state: State) -> tuple[Motion, tuple[Change, ...]]:
        known = self._motions.get(state)
        if known is None:
            known = self._motions[state] = Assembly(self, state).motion()
        return known

    def next_break(self, state: State, time: float) -> float:
        """The next time at which a signal changes its piece, a stage ends by time, or an impulse strikes."""
        key = (state.signals, state.drives)
        known = self._breaks.get(key)
        if known is None:
            known = self._breaks[key] = min(self._pieces_end(state), default=float("inf")), tuple(self._strikes(state))
        first, strikes = known
        return min((one for one in strikes if first > one > time), default=first)

    def _pieces_end(self, state: State) -> Iterator[float]:
        for signal, now in zip(self.signals, state.signals, strict=True):
            if 0 <= now.piece < len(signal.times) - 1:
                yield now.start + signal.times[now.piece + 1]
        for drive, one in zip(self.train.drives, state.drives, strict=True):
            yield drives.stage_breaks(drive, one)

    def _strikes(self, state: State) -> Iterator[float]:
        """Times that leave no trace in the contact state: impulses, and decays that begin."""
        for impulse in self.train.impulses:
            yield impulse.time
        for signal, now in zip(self.signals, state.signals, strict=True):
            if signal.decay and now.piece >= 0:
                yield now.start + signal.decay_start

    def signals_now(self, state: tuple[Now, ...]) -> tuple[SignalRows, list[Place]]:
        """Functionals of the signals, and where the drives act."""
        known = self._signals.get(state)
        if known is None:
            pieces = dict(zip(self.signals, state, strict=True))
            rows = {signal: np.zeros(self.size) for signal in pieces}
            for signal, now in pieces.items():
                rows[signal][self.own :] = self.inputs.row(signal, now)
            now_rows, bodies = SignalRows(rows, pieces), [drive.body for drive in self.train.drives]
            places = [Place(self.body_speed[one], self.body_position[one], self.one, now_rows) for one in bodies]
            known = self._signals[state] = now_rows, places
        return known

    def react(self, mode: State, time: float, state: FloatArray, fired: int | None) -> Reaction:
        """What follows an event; see `train.react`."""
        return Reactor(self, mode, time, state).go(fired)

    def friction_name(self, group: int) -> str:
        """What holds a group: its first brake or bearing, else its first mesh with losses."""
        for index, grip in enumerate(self.train.grips):
            if index not in self.clutches and self.groups.of[grip.first] == group:
                return grip.name
        inner = (self.train.meshes[index] for index in self.lossy)
        return next((mesh.name for mesh in inner if self.groups.of[mesh.inner] == group), "")

    def signal_name(self, signal: Signal) -> str:
        """The element a signal belongs to."""
        for drive in self.train.drives:
            if signal in drives.signals_of(drive):
                return drive.name
        return next((grip.name for grip in self.train.grips if signal in (grip.capacity, grip.gate)), "")

    # -- what is watched -----------------------------------------------------------------------------------------

    @cached_property
    def watched(self) -> dict[tuple[str, int], int]:
        """Index of every watched signal by what it is and whose it is."""
        train = self.train
        names = [("speed", i) for i in range(len(train.bodies))]
        names += [("position", i) for i in range(len(train.bodies))]
        for what in ("link", "link_rate", "link_loss"):
            names += [(what, i) for i in range(len(train.springs))]
        for what in ("mesh", "mesh_inner", "mesh_inner_speed", "mesh_outer_speed"):
            names += [(what, i) for i in range(len(train.meshes))]
        for what in ("grip", "grip_speed"):
            names += [(what, i) for i in range(len(train.grips))]
        names += [("drive", i) for i in range(len(train.drives))]
        names += [("guide", i) for i in range(len(train.guides))]
        return {name: index for index, name in enumerate(names)}

    @cached_property
    def unsought(self) -> list[int]:
        """Signals that are watched for their works alone."""
        factors = ("link_rate", "link_loss", "mesh_inner", "mesh_inner_speed", "mesh_outer_speed", "grip_speed")
        return [index for (what, _), index in self.watched.items() if what in factors]

    @cached_property
    def works(self) -> dict[tuple[str, int], tuple[int, int]]:
        """Pairs of watched signals whose product is a power, and the square of every drive's torque."""
        at, train = self.watched, self.train
        pairs = {("drive", i): (at["drive", i], at["speed", one.body]) for i, one in enumerate(train.drives)}
        pairs |= {("guide", i): (at["guide", i], at["speed", one.body]) for i, one in enumerate(train.guides)}
        pairs |= {("link", i): (at["link_loss", i], at["link_rate", i]) for i in range(len(train.springs))}
        pairs |= {("grip", i): (at["grip", i], at["grip_speed", i]) for i in range(len(train.grips))}
        for i in range(len(train.meshes)):
            pairs["mesh_in", i] = (at["mesh_inner", i], at["mesh_inner_speed", i])
            pairs["mesh_out", i] = (at["mesh", i], at["mesh_outer_speed", i])
        pairs |= {("square", i): (at["drive", i], at["drive", i]) for i in range(len(train.drives))}
        return pairs

    @property
    def products(self) -> list[tuple[int, int]]:
        """The pairs alone."""
        return list(self.works.values())

    def energy(self, state: State, z: FloatArray) -> float:
        """Kinetic and elastic energy."""
        speeds = self.body_speed @ z
        kinetic = sum(body.inertia * v**2 / 2 for body, v in zip(self.train.bodies, speeds, strict=True))
        elastic = sum(
            links.stored(spring, contact, float(of.x @ z))
            for spring, contact, of in zip(self.train.springs, state.contacts, self.stretches, strict=True)
        )
        return float(kinetic) + elastic
