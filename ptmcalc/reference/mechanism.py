"""A train of inertias in one state of contact and friction: its equations, and what ends the state.

Shared with the solvers it is a reference of: the list of parts (`numerics.train.parts`), and the value of a smooth
torque curve. Equations, contact, friction at rest, events and extremes are its own.

Every force is a row over w = (q, v, u): travels and speeds of the groups that gears tie together, and the inputs u:
1, the signals over time, the smooth torques.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.train.parts import (
    CLAMPED,
    HUNT_CROSSLEY,
    KELVIN,
    LINEAR,
    RIGID,
    Governed,
    Mesh,
    Smooth,
    Straight,
    Train,
)
from ptmcalc.numerics.train.signals import Signal
from ptmcalc.reference.law_pieces import ends, line
from ptmcalc.reference.mechanism_coordinates import OPEN, Branch, Coordinates, FloatArray, State
from ptmcalc.reference.mechanism_inputs import Inputs


@dataclass(frozen=True, slots=True)
class Exit:
    """A row that stays at or above 0 in a state, and what happens where it does not."""

    row: FloatArray
    kind: str
    index: int
    to: tuple[object, int] | None = None


@dataclass
class Equations:
    """A state compiled: accelerations of groups, outer mesh torques, holding forces, forces on bodies, as rows."""

    acceleration: FloatArray
    mesh: FloatArray
    holding: FloatArray
    holds: list[tuple[str, int]]
    force: FloatArray
    links: FloatArray
    torques: FloatArray
    exits: list[Exit] = field(default_factory=list)


class Mechanism(Coordinates):
    """The equations of a train."""

    def __init__(self, train: Train) -> None:
        super().__init__(train)
        self._known: dict[State, Equations] = {}
        self._known_at: float = -1.0

    def inputs(self, state: State, inside: float) -> Inputs:
        """The inputs in an interval without breaks."""
        lines = np.array([self.straight(signal, state, inside) for signal in self.signals]).reshape(-1, 2)
        waves, decays = [], []
        for k, (signal, start) in enumerate(zip(self.signals, state.started, strict=True)):
            if start is None:
                continue
            waves += [(k, sine.size, sine.frequency, sine.phase) for sine in signal.sines]
            if signal.decay and inside > start + signal.decay_start:
                decays.append((k, signal.decay, start + signal.decay_start, signal.decay_time))
        return Inputs(self, state, lines[:, 0], lines[:, 1], waves, decays)

    # -- the equations ---------------------------------------------------------------------------------------------

    def equations(self, state: State, inside: float) -> Equations:
        """The equations of a state in the interval around a time."""
        if inside != self._known_at:
            self._known, self._known_at = {}, inside
        if state not in self._known:
            self._known[state] = self._compile(state, inside)
        return self._known[state]

    def capacity(self, k: int, state: State, inside: float) -> FloatArray:
        """Sliding friction of a grip."""
        grip = self.train.grips[k]
        return self.level(grip.gate, state, inside) * self.signal_row(grip.capacity)

    def slip(self, k: int, state: State) -> int | None:
        """Direction in which a grip slips, 0 where it holds, None where its group is free."""
        if k in self.clutches:
            return state.slips[self.clutches.index(k)]
        grip = self.train.grips[k]
        turn = state.turning[self.of[grip.first]]
        row = self.group_row(grip.first, grip.second)[self.of[grip.first]]
        return None if turn is None else int(np.sign(turn * row))

    def share(self, k: int, state: State) -> float:
        """Inner over outer torque of a mesh that moves."""
        mesh = self.train.meshes[k]
        if k not in self.lossy:
            return 1 / mesh.ratio
        turn = state.turning[self.of[mesh.inner]] or 0
        outward = state.meshes[self.lossy.index(k)] * turn * np.sign(self.ratio[mesh.outer])
        return 1 / (mesh.ratio * mesh.forward) if outward > 0 else mesh.reverse / mesh.ratio

    def link_force(self, k: int, branch: Branch) -> FloatArray:
        """Force that shortens a link."""
        spring, (name, side) = self.train.springs[k], branch
        x, rate = self.extension(k), self.speed_of(self.rows[k])
        if name in ("open", "none", "shut"):
            return np.zeros(self.width)
        if spring.law == LINEAR:
            return spring.stiffness * x + spring.damping * rate
        if spring.law == HUNT_CROSSLEY:
            return self._unit(self.width - len(self.hertz) + self.hertz.index(k))
        depth = x - side * spring.play / 2 * self.one
        if name == "twice":
            return 2 * spring.stiffness * depth
        return spring.stiffness * depth + spring.damping * rate

    def torque(self, k: int, state: State, inside: float) -> FloatArray:
        """Torque of a drive."""
        drive, (stage, piece) = self.train.drives[k], state.drives[k]
        law, gate = drive.stages[stage].law, self.level(drive.gate, state, inside)
        if gate == 0:
            return np.zeros(self.width)
        if isinstance(law, Signal):
            return gate * self.signal_row(law)
        if isinstance(law, Smooth):
            return self._unit(self.first_input + 1 + len(self.signals) + self.smooth.index(k))
        if isinstance(law, Governed):
            if piece:
                return gate * piece * law.limit * self.one
            return gate * law.stiffness * (self.signal_row(law.reference) - self.body_speed(drive.body))
        (at, value), slope = line(law, piece)
        x = self.body_speed(drive.body) if law.on == "speed" else self.body_position(drive.body)
        return gate * (value * self.one + slope * (x - at * self.one))

    def _compile(self, state: State, inside: float) -> Equations:
        train = self.train
        links = np.array([self.link_force(k, branch) for k, branch in enumerate(state.branches)])
        torques = np.array([self.torque(k, state, inside) for k in range(len(train.drives))])
        force = np.zeros((self.count_bodies, self.width))
        for spring, pull in zip(train.springs, links, strict=True):
            force[spring.first] -= pull
            for other in (spring.second, spring.over):
                if other is not None:
                    force[other] += pull
        for drive, torque in zip(train.drives, torques, strict=True):
            force[drive.body] += torque
        slid = force.copy()
        for k, grip in enumerate(train.grips):
            slip = self.slip(k, state)
            if slip:
                size = slip * self.capacity(k, state, inside)
                slid[grip.first] -= size
                if grip.second is not None:
                    slid[grip.second] += size
        solution, holds = self._solved(state, slid)
        n, m = self.count, len(train.meshes)
        found = Equations(solution[:n], solution[n : n + m], solution[n + m :], holds, force, links, torques)
        for group, turn in enumerate(state.turning):
            if turn == 0:
                found.acceleration[group] = 0.0
        found.exits = list(self._exits(state, found, inside))
        return found

    def _solved(self, state: State, force: FloatArray) -> tuple[FloatArray, list[tuple[str, int]]]:
        """Accelerations, outer mesh torques and forces that hold, as rows."""
        train, n, m = self.train, self.count, len(self.train.meshes)
        wanted: list[tuple[str, int, FloatArray, FloatArray]] = []
        nothing = np.zeros(self.width)
        for k, guide in enumerate(train.guides):
            wanted.append(("guide", k, self.group_row(guide.body, None), self.signal_row(guide.acceleration)))
        wanted += [("group", g, np.eye(n)[g], nothing) for g, turn in enumerate(state.turning) if turn == 0]
        wanted += [
            ("contact", k, self.rows[k], nothing) for k, (name, _) in enumerate(state.branches) if name == "shut"
        ]
        for k, slip in zip(self.clutches, state.slips, strict=True):
            if slip == 0:
                wanted.append(("clutch", k, self.group_row(train.grips[k].first, train.grips[k].second), nothing))
        rows: list[FloatArray] = []
        right: list[FloatArray] = []
        holds: list[tuple[str, int]] = []
        for what, which, row, value in wanted:
            if np.linalg.matrix_rank(np.array([*rows, row])) > len(rows):
                rows.append(row)
                right.append(value)
                holds.append((what, which))
        size = self.count_bodies + len(rows)
        matrix = np.zeros((size, n + m + len(rows)))
        for b in range(self.count_bodies):
            matrix[b, self.of[b]] = self.inertia[b] * self.ratio[b]
        for k, mesh in enumerate(train.meshes):
            matrix[mesh.inner, n + k] += self.share(k, state)
            matrix[mesh.outer, n + k] -= 1
        for j, ((what, which), row) in enumerate(zip(holds, rows, strict=True)):
            matrix[self.count_bodies + j, :n] = row
            for body, sign in self._ends(what, which):
                matrix[body, n + m + j] -= sign
        try:
            solution = np.linalg.solve(matrix, np.vstack([force, *right]) if right else force)
        except np.linalg.LinAlgError:
            raise NumericsError("NUM101", "the second method finds no balance of forces") from None
        return np.asarray(solution, float), holds

    def _ends(self, what: str, which: int) -> Iterator[tuple[int, int]]:
        """Bodies a holding force acts on, and which way."""
        train = self.train
        if what == "guide":
            yield train.guides[which].body, 1
        elif what == "group":
            yield self.of.index(which), 1
        elif what == "clutch":
            grip = train.grips[which]
            yield grip.first, 1
            if grip.second is not None:
                yield grip.second, -1
        else:
            spring = train.springs[which]
            yield spring.first, 1
            for other in (spring.second, spring.over):
                if other is not None:
                    yield other, -1

    # -- what ends a state -----------------------------------------------------------------------------------------

    def _exits(self, state: State, found: Equations, inside: float) -> Iterator[Exit]:
        for k, branch in enumerate(state.branches):
            for row, to in self.link_exits(k, branch):
                yield Exit(row, "link", k, to)
        for k in range(len(self.train.drives)):
            yield from self._drive_exits(k, state)
        for k, (signal, start) in enumerate(zip(self.signals, state.started, strict=True)):
            trigger = signal.trigger
            if trigger is not None and start is None:
                seen = {"speed": self.body_speed, "position": self.body_position}.get(trigger.on)
                value = seen(trigger.body) if seen else found.links[trigger.body]
                gap = trigger.level * self.one - value
                yield Exit(gap if trigger.rising else -gap, "signal", k)
        for g, turn in enumerate(state.turning):
            if turn:
                yield Exit(turn * self.speed_of(np.eye(self.count)[g]), "turning", g)
        for k, slip in zip(self.clutches, state.slips, strict=True):
            grip = self.train.grips[k]
            if slip:
                yield Exit(slip * self.speed_of(self.group_row(grip.first, grip.second)), "slip", k)
        for i, k in enumerate(self.lossy):
            if state.turning[self.of[self.train.meshes[k].inner]]:
                yield Exit(state.meshes[i] * found.mesh[k], "mesh", i)
        anchored = self.anchored(state)
        for (what, which), row in zip(found.holds, found.holding, strict=True):
            if what == "clutch" and not anchored[self.of[self.train.grips[which].first]]:
                most = self.train.grips[which].static * self.capacity(which, state, inside)
                for way in (1, -1):
                    yield Exit(most - way * row, "hold", which)
            elif what == "contact" and not anchored[self.of[self.train.springs[which].first]]:
                yield Exit(-state.branches[which][1] * row, "link", which, OPEN)

    def anchored(self, state: State) -> list[bool]:
        """Groups tied by locked clutches or shut contacts to one that friction holds at rest."""
        part = list(range(self.count))
        ties = [self.rows[k] for k, (name, _) in enumerate(state.branches) if name == "shut"]
        for k, slip in zip(self.clutches, state.slips, strict=True):
            if slip == 0:
                ties.append(self.group_row(self.train.grips[k].first, self.train.grips[k].second))
        for row in ties:
            ends = [int(end) for end in np.flatnonzero(row)]
            part = [part[ends[0]] if part[g] in [part[end] for end in ends] else part[g] for g in range(self.count)]
        still = {part[g] for g, turn in enumerate(state.turning) if turn == 0 and g not in self.guided}
        tied = {part[int(end)] for row in ties for end in np.flatnonzero(row)}
        return [part[g] in still and part[g] in tied for g in range(self.count)]

    def link_exits(self, k: int, branch: Branch) -> Iterator[tuple[FloatArray, Branch]]:
        """What keeps a link on its branch, and the branch that follows."""
        spring, (name, side) = self.train.springs[k], branch
        half = spring.play / 2 * self.one
        x, rate = self.extension(k), self.speed_of(self.rows[k])
        if spring.law == LINEAR or name == "shut":
            return
        if name == "open":
            for one in (spring.side,) if spring.side else (1, -1):
                yield half - one * x, ("shut" if spring.law == RIGID else "full", one)
            return
        depth = side * x - half
        spring_force, damper = spring.stiffness * depth, spring.damping * side * rate
        if spring.law == HUNT_CROSSLEY:
            pull = self.one + 1.5 * spring.dissipation * side * rate
        else:
            pull = spring_force + damper
        if spring.law == KELVIN or (spring.damping == 0 and spring.law != HUNT_CROSSLEY):
            yield depth, OPEN
        elif name == "full":
            if spring.law == HUNT_CROSSLEY:
                yield depth, OPEN
            if spring.law != HUNT_CROSSLEY or spring.dissipation:
                yield pull, ("none", side)
            if spring.law == CLAMPED:
                yield spring_force - damper, ("twice", side)
        elif name == "twice":
            yield damper - spring_force, ("full", side)
        else:
            yield -pull, ("full", side)
            yield depth, OPEN

    def _drive_exits(self, k: int, state: State) -> Iterator[Exit]:
        drive, (number, piece) = self.train.drives[k], state.drives[k]
        stage = drive.stages[number]
        speed = self.body_speed(drive.body)
        if stage.until is not None and number + 1 < len(drive.stages):
            yield Exit(stage.until * self.one - speed, "drive", k, (number + 1, 0))
        law = stage.law
        if isinstance(law, Governed):
            free = law.stiffness * (self.signal_row(law.reference) - speed)
            if piece == 0:
                for way in (1, -1):
                    yield Exit(law.limit * self.one - way * free, "drive", k, (number, way))
            else:
                yield Exit(piece * free - law.limit * self.one, "drive", k, (number, 0))
        elif isinstance(law, Straight):
            x = speed if law.on == "speed" else self.body_position(drive.body)
            low, high = ends(law, piece)
            if low is not None:
                yield Exit(x - low * self.one, "drive", k, (number, piece - 1))
            if high is not None:
                yield Exit(high * self.one - x, "drive", k, (number, piece + 1))


def shares_at_rest(mesh: Mesh) -> tuple[float, float]:
    """Least and most of inner over outer torque of a mesh at rest."""
    one, other = 1 / (mesh.ratio * mesh.forward), mesh.reverse / mesh.ratio
    return min(one, other), max(one, other)
