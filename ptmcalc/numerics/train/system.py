"""A train as a piecewise-linear system: its equations in every contact state.

Accelerations and mesh torques are the solution of the bodies' balances

    J_i r_i a_g + sum T_inner - sum T_outer - sum J_c mu_c = F_i,   T_inner = e T_outer

with a constraint and its force mu for whatever is held: a body at rest under friction, a locked clutch, a closed
rigid contact, a prescribed motion. Every torque is a functional of the state, so a contact state is one linear
system, and what keeps it are functionals too: its guards.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ptmcalc.numerics import expm
from ptmcalc.numerics.motion import Curve, Motion, Reaction
from ptmcalc.numerics.train import drives, links
from ptmcalc.numerics.train.drives import DriveState, Place, SignalRows
from ptmcalc.numerics.train.held import Part
from ptmcalc.numerics.train.links import Contact, Stretch
from ptmcalc.numerics.train.parts import Grip, Mesh, Spring, Train
from ptmcalc.numerics.train.react import Reactor
from ptmcalc.numerics.train.signals import FloatArray, Inputs, Now, Signal
from ptmcalc.numerics.train.tree import Coordinates, Groups

_NO_FRICTION = 2
_CANCELS = 8 * float(np.finfo(float).eps)


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


class Solved(NamedTuple):
    """Solution of the balances as functionals: accelerations of groups, outer torques of meshes, forces of holds."""

    acceleration: FloatArray
    mesh: FloatArray
    holds: FloatArray
    fits: bool
    """whether there is a solution: held bodies cannot follow two prescribed motions"""


class Hold(NamedTuple):
    """A constraint on accelerations: what, whose, its row over the groups, the wanted value."""

    what: str
    which: int
    row: FloatArray
    wanted: FloatArray


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
        self._motions: dict[State, tuple[Motion, tuple[Change, ...]]] = {}
        self.first_impacts: dict[int, float] = {}
        self.fastest = 0.0
        self._rows()

    def _all_signals(self) -> Iterator[Signal]:
        for drive in self.train.drives:
            yield from drives.signals_of(drive)
        for grip in self.train.grips:
            yield grip.capacity
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
        return bodies[spring.first].position - second - spring.rest

    def _stretch(self, index: int) -> Stretch:
        spring, place, count = self.train.springs[index], self.coordinates.places[index], self.groups.count
        x, rate = np.zeros(self.size), np.zeros(self.size)
        if place is None:
            row = self.groups.row(spring.first, spring.second)
            x[:count] = self.apart(row)[count : self.own]
            rate[count : self.own] = x[:count]
            x += (self._at_start(spring) - float(x[:count] @ self.extended)) * self.one
        else:
            x[place] = rate[count + place] = 1.0
        return Stretch(x, rate, self.one)

    def apart(self, row: FloatArray) -> FloatArray:
        """A sum of group speeds as a functional; what cancels in it is 0, not rounding."""
        speed = row @ self.speed
        speed[np.abs(speed) <= _CANCELS * (np.abs(row) @ np.abs(self.speed))] = 0.0
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
        z[self.groups.count : self.own] = self.coordinates.inverse @ speeds
        z[self.own :] = self.inputs.start()
        state = State(
            contacts=tuple(links.rest_state(spring) for spring in self.train.springs),
            signals=tuple(Now(-1) if signal.trigger else Now() for signal in self.signals),
            drives=tuple(
                (0, drives.law_now(drive.stages[0].law, *self.seen(z, drive.body))) for drive in self.train.drives
            ),
            turning=tuple(
                int(np.sign(speeds[group])) if self.has_friction(group) else _NO_FRICTION
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
        motion = self.motion(state._replace(contacts=closed, turning=turning, clutches=clutches))
        return expm.balance(motion.rate)

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
            known = self._motions[state] = _Assembly(self, state).motion()
        return known

    def next_break(self, state: State, time: float) -> float:
        """The next time at which a signal changes its piece, a stage ends by time, or an impulse strikes."""
        times = [
            now.start + signal.times[now.piece + 1]
            for signal, now in zip(self.signals, state.signals, strict=True)
            if 0 <= now.piece < len(signal.times) - 1
        ]
        times += [
            now.start + signal.decay_start
            for signal, now in zip(self.signals, state.signals, strict=True)
            if signal.decay and now.piece >= 0 and now.start + signal.decay_start > time
        ]
        times += [drives.stage_breaks(drive, one) for drive, one in zip(self.train.drives, state.drives, strict=True)]
        times += [impulse.time for impulse in self.train.impulses if impulse.time > time]
        return min(times, default=float("inf"))

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
        return next((grip.name for grip in self.train.grips if grip.capacity is signal), "")

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


class _Assembly:
    """Builds the equations of one contact state."""

    def __init__(self, system: TrainSystem, state: State) -> None:
        self.system, self.state, self.train = system, state, system.train
        rows = {
            signal: np.concatenate([np.zeros(system.own), system.inputs.row(signal, now)])
            for signal, now in zip(system.signals, state.signals, strict=True)
        }
        self.now = SignalRows(rows, dict(zip(system.signals, state.signals, strict=True)))
        self.places = [
            Place(system.body_speed[drive.body], system.body_position[drive.body], system.one, self.now)
            for drive in self.train.drives
        ]
        self.link_curves = self._curves(links.curve(*one) for one in self._links())
        self.drive_curves = self._curves(drives.drive_curve(*one) for one in self._drives())
        self.curves = [curve for _, curve in self.link_curves + self.drive_curves]
        self.width = system.size + len(self.curves)
        self.link_force = [self._wide(links.force(*one)) for one in self._links()]
        self.drive_torque = [self._wide(drives.drive_row(*one)) for one in self._drives()]
        for column, (index, _) in enumerate(self.link_curves):
            self.link_force[index][system.size + column] = 1.0
        for column, (index, _) in enumerate(self.drive_curves, len(self.link_curves)):
            self.drive_torque[index][system.size + column] = 1.0

    def _links(self) -> Iterator[tuple[Any, Contact, Stretch]]:
        return zip(self.train.springs, self.state.contacts, self.system.stretches, strict=True)

    def _drives(self) -> Iterator[tuple[Any, DriveState, Place]]:
        return zip(self.train.drives, self.state.drives, self.places, strict=True)

    @staticmethod
    def _curves(found: Iterator[Curve | None]) -> list[tuple[int, Curve]]:
        return [(index, curve) for index, curve in enumerate(found) if curve is not None]

    def _wide(self, row: FloatArray) -> FloatArray:
        return np.concatenate([row, np.zeros(self.width - len(row))])

    # -- balances -----------------------------------------------------------------------------------------------

    def _forces(self, state: State, static: bool) -> FloatArray:
        """Forces on the bodies as functionals; `static` takes the friction of what is at rest as it is overcome."""
        force = np.zeros((len(self.train.bodies), self.width))
        for spring, link in zip(self.train.springs, self.link_force, strict=True):
            force[spring.first] -= link
            if spring.second is not None:
                force[spring.second] += link
        for drive, torque in zip(self.train.drives, self.drive_torque, strict=True):
            force[drive.body] += torque
        for index, grip in enumerate(self.train.grips):
            direction = self._slip(index, state)
            if direction:
                at_rest = static and self._slip(index, self.state) == 0
                capacity = self._wide(self.now[grip.capacity]) * (grip.static if at_rest else 1.0)
                force[grip.first] -= direction * capacity
                if grip.second is not None:
                    force[grip.second] += direction * capacity
        return force

    def _slip(self, index: int, state: State) -> int:
        """Direction in which a grip slips; 0 where it holds."""
        groups, grip = self.system.groups, self.train.grips[index]
        if index in self.system.clutches:
            return state.clutches[self.system.clutches.index(index)]
        turn = state.turning[groups.of[grip.first]]
        row = float(groups.row(grip.first, grip.second)[groups.of[grip.first]])
        return 0 if turn == _NO_FRICTION else int(np.sign(turn * row))

    def _holds(self, state: State, stays: int | None) -> list[Hold]:
        """What is held: prescribed motions, groups at rest (and the one that `stays`), clutches, rigid contacts."""
        system, groups = self.system, self.system.groups
        zero = np.zeros(self.width)
        held: list[Hold] = []
        for index, guide in enumerate(self.train.guides):
            held.append(Hold("guide", index, groups.row(guide.body, None), self._wide(self.now[guide.acceleration])))
        for group, turn in enumerate(state.turning):
            if group == stays:
                held.append(Hold("verge", group, np.eye(groups.count)[group], zero))
            elif turn == 0 and group not in system.guided:
                held.append(Hold("rest", group, np.eye(groups.count)[group], zero))
        for index, slip in zip(system.clutches, state.clutches, strict=True):
            if slip == 0:
                grip = self.train.grips[index]
                held.append(Hold("clutch", index, groups.row(grip.first, grip.second), zero))
        for index, (phase, _) in enumerate(state.contacts):
            if phase == "shut":
                spring = self.train.springs[index]
                held.append(Hold("contact", index, groups.row(spring.first, spring.second), zero))
        return held

    def _solve(self, state: State, static: bool = False, stays: int | None = None) -> tuple[Solved, list[Hold]]:
        groups, train = self.system.groups, self.train
        bodies, meshes = len(train.bodies), len(train.meshes)
        held = self._holds(state, stays)
        count = groups.count
        matrix = np.zeros((bodies + len(held), count + meshes + len(held)))
        right = np.zeros((len(matrix), self.width))
        right[:bodies] = self._forces(state, static)
        for index, body in enumerate(train.bodies):
            matrix[index, groups.of[index]] = body.inertia * groups.ratio[index]
        for index, mesh in enumerate(train.meshes):
            matrix[mesh.inner, count + index] += self._share(index, mesh, state)
            matrix[mesh.outer, count + index] -= 1.0
        for index, (what, which, row, wanted) in enumerate(held):
            line, column = bodies + index, count + meshes + index
            matrix[line, :count], right[line] = row, wanted
            first, second = self._ends(what, which)
            matrix[first, column] -= 1.0
            if second is not None:
                matrix[second, column] += 1.0
        size = np.abs(matrix).max(axis=1)
        found, fits = _solution(matrix / size[:, None], right / size[:, None])
        exact: set[int] = set()
        for _ in held:  # exactly, one after the other, so that nothing creeps
            for _, _, row, wanted in held:
                left = [group for group in np.flatnonzero(row).tolist() if group not in exact]
                if len(left) == 1:
                    others = [group for group in np.flatnonzero(row).tolist() if group in exact]
                    found[left[0]] = (wanted - row[others] @ found[others]) / row[left[0]]
                    exact.add(left[0])
        return Solved(found[:count], found[count : count + meshes], found[count + meshes :], fits), held

    def _ends(self, what: str, which: int) -> tuple[int, int | None]:
        """The bodies on which a hold acts."""
        if what == "guide":
            return self.train.guides[which].body, None
        if what == "rest":
            return self._holder(which)[0], None
        if what == "verge":
            return self._root(which), None
        part = self.train.grips[which] if what == "clutch" else self.train.springs[which]
        return part.first, part.second

    def _holder(self, group: int) -> tuple[int, int | None]:
        """The body on which a group at rest is held, and the grip that does it: the first brake that acts, else the
        motor's side of the first mesh with losses. Gears between it and the load carry the load."""
        groups = self.system.groups
        for index, grip in enumerate(self.train.grips):
            acts = np.any(self.now[grip.capacity])
            if index not in self.system.clutches and groups.of[grip.first] == group and acts:
                return grip.first, index
        inner = (self.train.meshes[index].inner for index in self.system.lossy)
        return next((body for body in inner if groups.of[body] == group), groups.of.index(group)), None

    def _root(self, group: int) -> int:
        """The body of a group from which power flows outward through all its meshes."""
        bodies = [body for body, one in enumerate(self.system.groups.of) if one == group]
        outer = {mesh.outer for mesh in self.train.meshes}
        return next((body for body in bodies if body not in outer), bodies[0])

    def _share(self, index: int, mesh: Mesh, state: State) -> float:
        """e = T_inner/T_outer of a mesh, by the direction of the power through it."""
        if not mesh.lossy:
            return 1 / mesh.ratio
        turn = state.turning[self.system.groups.of[mesh.inner]]
        sign = state.meshes[self.system.lossy.index(index)]
        direction = sign * turn * np.sign(self.system.groups.ratio[mesh.outer])
        if turn in (0, _NO_FRICTION):
            return 1 / mesh.ratio
        return 1 / (mesh.ratio * mesh.forward) if direction > 0 else mesh.reverse / mesh.ratio

    # -- the motion ---------------------------------------------------------------------------------------------

    def motion(self) -> tuple[Motion, tuple[Change, ...]]:
        system, n, count = self.system, self.system.size, self.system.groups.count
        solved, held = self._solve(self.state)
        inverse = system.coordinates.inverse
        whole = inverse @ solved.acceleration
        whole[np.abs(whole) <= 1e-14 * (np.abs(inverse) @ np.abs(solved.acceleration))] = 0.0
        for index, (phase, _) in enumerate(self.state.contacts):
            place = system.coordinates.places[index]
            if phase == "shut" and place is not None:
                whole[place] = 0.0  # exactly: a closed contact does not creep
        rate, gain = np.zeros((n, n)), np.zeros((n, len(self.curves)))
        rate[:count, count : 2 * count] = np.eye(count)
        rate[count : 2 * count], gain[count : 2 * count] = whole[:, :n], whole[:, n:]
        rate[system.own :, system.own :] = system.inputs.rate()
        pairs = list(self._guards(solved, held))
        guards = np.array([row for row, _ in pairs]).reshape(-1, self.width)
        motion = Motion(rate, gain, guards, self._watch(solved, held), tuple(self.curves))
        return motion, tuple(change for _, change in pairs)

    def _guards(self, solved: Solved, held: list[Hold]) -> Iterator[tuple[FloatArray, Change]]:
        for index, one in enumerate(self._links()):
            for row, contact in links.guards(*one):
                yield self._wide(row), Change("contact", index, contact)
        for index, drive in enumerate(self._drives()):
            for row, to in drives.drive_guards(*drive):
                yield self._wide(row), Change("drive", index, to)
        yield from self._triggers()
        yield from self._turning(solved)
        parts = self._parts()
        for part in parts:
            yield from self._releases(part)
        several = {lock for part in parts if part.anchors > 1 for lock in part.locks}
        for (what, which, _, _), force in zip(held, solved.holds, strict=True):
            if what == "clutch" and (what, which) not in several:
                grip = self.train.grips[which]
                capacity = self._wide(self.now[grip.capacity]) * grip.static
                for side in (1, -1):  # mu pushes the first body: it slips back where too much of it is needed
                    yield capacity - side * force, Change("hold", which, None)
            elif what == "contact":
                side = self.state.contacts[which][1]
                yield -side * force, Change("contact", which, links.OPEN)
        if not solved.fits:
            yield -self._wide(self.system.one), Change("hold", -1, None)

    def _triggers(self) -> Iterator[tuple[FloatArray, Change]]:
        for index, (signal, now) in enumerate(zip(self.system.signals, self.state.signals, strict=True)):
            trigger = signal.trigger
            if trigger is not None and now.piece < 0:
                of = self.system.body_speed if trigger.on == "speed" else self.system.body_position
                gap = trigger.level * self.system.one - of[trigger.body]
                yield self._wide(gap if trigger.rising else -gap), Change("signal", index, None)

    def _turning(self, solved: Solved) -> Iterator[tuple[FloatArray, Change]]:
        """Friction: what moves or slips keeps its direction, torques of its meshes their sign."""
        system, state = self.system, self.state
        for group, turn in enumerate(state.turning):
            if turn in (1, -1):
                yield self._wide(turn * system.speed[group]), Change("turning", group, None)
                for i in self._meshes_in((group,)):
                    yield state.meshes[i] * solved.mesh[system.lossy[i]], Change("mesh", i, None)
            elif turn == 0 and group in system.guided:
                for way in (1, -1):
                    yield -way * solved.acceleration[group], Change("hold", group, None)
        for index, slip in zip(system.clutches, state.clutches, strict=True):
            if slip:
                grip = self.train.grips[index]
                apart = system.apart(system.groups.row(grip.first, grip.second))
                yield self._wide(slip * apart), Change("slip", index, None)

    def _meshes_in(self, groups: tuple[int, ...]) -> list[int]:
        """Lossy meshes inside groups."""
        system = self.system
        return [i for i, index in enumerate(system.lossy) if system.groups.of[self.train.meshes[index].inner] in groups]

    # -- what is at rest ----------------------------------------------------------------------------------------

    def _parts(self) -> list[Part]:
        """Groups at rest, with all that locked clutches and closed rigid contacts tie to them."""
        system, groups = self.system, self.system.groups
        locks: dict[tuple[str, int], FloatArray] = {}
        for index, slip in zip(system.clutches, self.state.clutches, strict=True):
            if slip == 0:
                locks["clutch", index] = groups.row(self.train.grips[index].first, self.train.grips[index].second)
        for index, (spring, (phase, _)) in enumerate(zip(self.train.springs, self.state.contacts, strict=True)):
            if phase == "shut":
                locks["contact", index] = groups.row(spring.first, spring.second)
        part = list(range(groups.count))
        for row in locks.values():
            ends = np.flatnonzero(row)
            part = [part[ends[0]] if one == part[ends[-1]] else one for one in part]
        found = []
        for name in dict.fromkeys(part):
            members = tuple(group for group, one in enumerate(part) if one == name)
            inside = {lock: row for lock, row in locks.items() if part[int(np.flatnonzero(row)[0])] == name}
            held = [group for group in members if self.state.turning[group] == 0]
            grounded = sum(np.count_nonzero(row) == 1 for row in inside.values())
            guided = sum(group in system.guided and group not in held for group in members)
            if held:
                found.append(Part(members, tuple(held), inside, len(held) + grounded + guided))
        return found

    def _releases(self, part: Part) -> Iterator[tuple[FloatArray, Change]]:
        """What keeps a part at rest: no connected piece of it is pushed harder than all friction that holds it back.

        The pieces are released one at a time with their friction against them, at the verge of motion: no
        acceleration, and the power through their meshes by the way they would move.
        """
        system = self.system
        pieces = part.pieces() if part.anchors > 1 else [part.held]
        for piece in pieces:
            if any(group in system.guided for group in piece):
                continue
            for way in (1, -1):
                freed = self._freed(part, piece, way)
                if freed is None:
                    continue
                solved, held = self._solve(freed, static=True, stays=piece[0])
                place = next(i for i, hold in enumerate(held) if hold.what == "verge")
                side = way * np.sign(system.groups.ratio[self._root(piece[0])])
                yield side * solved.holds[place], Change("hold", piece[0], None)
                for i in self._meshes_in(piece):
                    yield freed.meshes[i] * solved.mesh[system.lossy[i]], Change("released", i, (piece, way))

    def _freed(self, part: Part, piece: tuple[int, ...], way: int) -> State | None:
        """The state in which a piece of a part just begins to move; None where a rigid contact is in its way."""
        system, state = self.system, self.state
        turning, clutches, contacts = list(state.turning), list(state.clutches), list(state.contacts)
        if part.anchors > 1:
            motion = part.motion(piece, way, system.groups.count)
            for group in part.members:
                turning[group] = int(np.sign(motion[group])) if system.has_friction(group) else _NO_FRICTION
                if group not in piece:
                    turning[group] = 0
            for (what, which), row in part.locks.items():
                apart = float(row @ motion)
                if abs(apart) <= 1e-9 * float(np.abs(row) @ np.abs(motion)):
                    continue
                if what == "clutch":
                    clutches[system.clutches.index(which)] = int(np.sign(apart))
                elif apart * state.contacts[which][1] > 0:
                    return None
                else:
                    contacts[which] = links.OPEN
        else:
            turning[piece[0]] = way
        release = (piece, way)
        meshes = tuple(
            (-1 if (release, i) in state.released else 1) if system.groups.of[self.train.meshes[index].inner] in piece
            else state.meshes[i]
            for i, index in enumerate(system.lossy)
        )  # fmt: skip
        return state._replace(turning=tuple(turning), clutches=tuple(clutches), contacts=tuple(contacts), meshes=meshes)

    # -- what is watched ----------------------------------------------------------------------------------------

    def _watch(self, solved: Solved, held: list[Hold]) -> FloatArray:
        system, train = self.system, self.train
        rows: dict[tuple[str, int], FloatArray] = {}
        for i in range(len(train.bodies)):
            at_rest = self.state.turning[system.groups.of[i]] == 0
            rows["speed", i] = np.zeros(system.size) if at_rest else system.body_speed[i]
            rows["position", i] = system.body_position[i]
        for i, one in enumerate(self._links()):
            rows["link", i] = self.link_force[i]
            rows["link_rate", i] = one[2].rate
            rows["link_loss", i] = self.link_force[i] - self._wide(links.elastic(*one))
        for i, mesh in enumerate(train.meshes):
            rows["mesh", i] = solved.mesh[i]
            rows["mesh_inner", i] = self._share(i, mesh, self.state) * solved.mesh[i]
            rows["mesh_inner_speed", i] = rows["speed", mesh.inner]
            rows["mesh_outer_speed", i] = rows["speed", mesh.outer]
        for i, grip in enumerate(train.grips):
            rows["grip", i] = self._wide(self._slip(i, self.state) * self.now[grip.capacity])
            second = 0.0 if grip.second is None else rows["speed", grip.second]
            rows["grip_speed", i] = rows["speed", grip.first] - second
        for i in range(len(train.drives)):
            rows["drive", i] = self.drive_torque[i]
        for (what, which, _, _), force in zip(held, solved.holds, strict=True):
            if what == "guide":
                rows["guide", which] = force
            elif what == "clutch":
                rows["grip", which] = -force
            elif what == "contact":
                rows["link", which] = -force
            elif what == "rest":
                self._share_of_brakes(which, force, rows)
        return np.array([self._wide(rows[name]) for name in system.watched]).reshape(-1, self.width)

    def _share_of_brakes(self, group: int, force: FloatArray, rows: dict[tuple[str, int], FloatArray]) -> None:
        """What holds a group at rest, told as the torque of the brake that acts."""
        _, grip = self._holder(group)
        if grip is not None:
            rows["grip", grip] = -force


def _solution(matrix: FloatArray, right: FloatArray) -> tuple[FloatArray, bool]:
    """Solution of the balances, the smallest one where holds share a load that no balance tells apart; whether it is
    one. Entries below their rounding are 0: the sign of a torque that is not there must not mean anything.

        |dX| <= 8 eps |A^-1| (|A| |X| + |B|)

    **Source** Skeel, Scaling for numerical stability in Gaussian elimination, 1979.
    """
    largest = max(1.0, float(np.abs(right).max()))
    try:
        inverse = np.linalg.inv(matrix) if matrix.shape[0] == matrix.shape[1] else np.linalg.pinv(matrix, rcond=1e-13)
        found: FloatArray = inverse @ right
        found += inverse @ (right - matrix @ found)
        fits = bool(np.isfinite(found).all() and np.abs(matrix @ found - right).max() <= 1e-9 * largest)
    except np.linalg.LinAlgError:
        fits = False
    if not fits:
        inverse = np.linalg.pinv(matrix, rcond=1e-13)
        found = inverse @ right
        found += inverse @ (right - matrix @ found)
        fits = bool(np.abs(matrix @ found - right).max() <= 1e-6 * largest)
    noise = _CANCELS * (np.abs(inverse) @ (np.abs(matrix) @ np.abs(found) + np.abs(right)))
    found[np.abs(found) <= noise] = 0.0
    return found, fits
