"""The equations of one contact state: its motion, the guards that keep it, the signals that are watched."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ptmcalc.numerics.motion import Motion
from ptmcalc.numerics.train import drives, links
from ptmcalc.numerics.train.balance import Balances, Hold, Solved
from ptmcalc.numerics.train.held import Part
from ptmcalc.numerics.train.signals import FloatArray, Trigger
from ptmcalc.numerics.train.state import NO_FRICTION, Change, State

if TYPE_CHECKING:
    from ptmcalc.numerics.train.system import TrainSystem


class Assembly:
    """Builds the equations of one contact state."""

    def __init__(self, system: "TrainSystem", state: State) -> None:
        self.system, self.state, self.train = system, state, system.train
        self.balances = Balances(system, state)

    # -- the motion ---------------------------------------------------------------------------------------------

    def motion(self) -> tuple[Motion, tuple[Change, ...]]:
        solved, held = self.balances.solve(self.state)
        rate, gain = self._rate(solved)
        pairs = list(self._guards(solved, held))
        guards = np.array([row for row, _ in pairs]).reshape(-1, self.balances.width)
        motion = Motion(rate, gain, guards, self._watch(solved, held), tuple(self.balances.curves))
        return motion, tuple(change for _, change in pairs)

    def rate(self) -> FloatArray:
        """A alone."""
        return self._rate(self.balances.solve(self.state)[0])[0]

    def _rate(self, solved: Solved) -> tuple[FloatArray, FloatArray]:
        system, n, count = self.system, self.system.size, self.system.groups.count
        inverse = system.coordinates.inverse
        whole = inverse @ solved.acceleration
        whole[np.abs(whole) <= 1e-14 * (np.abs(inverse) @ np.abs(solved.acceleration))] = 0.0
        for index, (phase, _) in enumerate(self.state.contacts):
            place = system.coordinates.places[index]
            if phase == "shut" and place is not None:
                whole[place] = 0.0  # exactly: a closed contact does not creep
        rate, gain = np.zeros((n, n)), np.zeros((n, len(self.balances.curves)))
        rate[:count, count : 2 * count] = np.eye(count)
        rate[count : 2 * count], gain[count : 2 * count] = whole[:, :n], whole[:, n:]
        rate[system.own :, system.own :] = system.inputs.rate()
        return rate, gain

    def _guards(self, solved: Solved, held: list[Hold]) -> Iterator[tuple[FloatArray, Change]]:
        for index, one in enumerate(self.balances.links_now()):
            for row, contact in links.guards(*one):
                yield self.balances.wide(row), Change("contact", index, contact)
        for index, drive in enumerate(self.balances.drives_now()):
            for row, to in drives.drive_guards(*drive):
                yield self.balances.wide(row), Change("drive", index, to)
        yield from self._triggers()
        yield from self._turning(solved)
        parts = self._parts()
        for part in parts:
            yield from self._releases(part)
        several = {lock for part in parts if part.anchors > 1 for lock in part.locks}
        for (what, which, _, _), force in zip(held, solved.holds, strict=True):
            if what == "clutch" and (what, which) not in several:
                grip = self.train.grips[which]
                capacity = self.balances.wide(self.balances.capacity(grip)) * grip.static
                for side in (1, -1):  # mu pushes the first body: it slips back where too much of it is needed
                    yield capacity - side * force, Change("hold", which, None)
            elif what == "contact":
                side = self.state.contacts[which][1]
                yield -side * force, Change("contact", which, links.OPEN)
        if not solved.fits:
            yield -self.balances.wide(self.system.one), Change("hold", -1, None)

    def _triggers(self) -> Iterator[tuple[FloatArray, Change]]:
        for index, (signal, now) in enumerate(zip(self.system.signals, self.state.signals, strict=True)):
            trigger = signal.trigger
            if trigger is not None and now.piece < 0:
                gap = self.balances.wide(trigger.level * self.system.one) - self._seen(trigger)
                yield gap if trigger.rising else -gap, Change("signal", index, None)

    def _seen(self, trigger: Trigger) -> FloatArray:
        """What a trigger watches."""
        if trigger.on == "force":
            return self.balances.link_force[trigger.body]
        of = self.system.body_speed if trigger.on == "speed" else self.system.body_position
        return self.balances.wide(of[trigger.body])

    def _turning(self, solved: Solved) -> Iterator[tuple[FloatArray, Change]]:
        """Friction: what moves or slips keeps its direction, torques of its meshes their sign."""
        system, state = self.system, self.state
        for group, turn in enumerate(state.turning):
            if turn in (1, -1):
                yield self.balances.wide(turn * system.speed[group]), Change("turning", group, None)
                for i in self._meshes_in((group,)):
                    yield state.meshes[i] * solved.mesh[system.lossy[i]], Change("mesh", i, None)
            elif turn == 0 and group in system.guided:
                for held in (-solved.acceleration[group], solved.acceleration[group]):
                    yield held, Change("hold", group, None)
        for index, slip in zip(system.clutches, state.clutches, strict=True):
            if slip:
                grip = self.train.grips[index]
                apart = system.apart(system.groups.row(grip.first, grip.second))
                yield self.balances.wide(slip * apart), Change("slip", index, None)

    def _meshes_in(self, groups: tuple[int, ...]) -> list[int]:
        """Lossy meshes inside groups."""
        system = self.system
        return [i for i, index in enumerate(system.lossy) if system.groups.of[self.train.meshes[index].inner] in groups]

    # -- what is at rest ----------------------------------------------------------------------------------------

    def _parts(self) -> list[Part]:
        """Groups at rest, with all that locked clutches and closed rigid contacts tie to them."""
        if 0 not in self.state.turning:
            return []
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
                solved, held = self.balances.solve(freed, static=True, stays=piece[0])
                place = next(i for i, hold in enumerate(held) if hold.what == "verge")
                side = way * np.sign(system.groups.ratio[self.balances.root(piece[0])])
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
                turning[group] = int(np.sign(motion[group])) if system.has_friction(group) else NO_FRICTION
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
        for i, one in enumerate(self.balances.links_now()):
            rows["link", i] = self.balances.link_force[i]
            rows["link_rate", i] = one[2].rate
            rows["link_loss", i] = self.balances.link_force[i] - self.balances.wide(links.elastic(*one))
        for i, mesh in enumerate(train.meshes):
            rows["mesh", i] = solved.mesh[i]
            rows["mesh_inner", i] = self.balances.share(i, mesh, self.state) * solved.mesh[i]
            rows["mesh_inner_speed", i] = rows["speed", mesh.inner]
            rows["mesh_outer_speed", i] = rows["speed", mesh.outer]
        for i, grip in enumerate(train.grips):
            rows["grip", i] = self.balances.wide(self.balances.slip(i, self.state) * self.balances.capacity(grip))
            second = 0.0 if grip.second is None else rows["speed", grip.second]
            rows["grip_speed", i] = rows["speed", grip.first] - second
        for i in range(len(train.drives)):
            rows["drive", i] = self.balances.drive_torque[i]
        for (what, which, _, _), force in zip(held, solved.holds, strict=True):
            if what == "guide":
                rows["guide", which] = force
            elif what == "clutch":
                rows["grip", which] = -force
            elif what == "contact":
                rows["link", which] = -force
            elif what == "rest":
                self._share_of_brakes(which, force, rows)
        found = np.zeros((len(system.watched), self.balances.width))
        for name, place in system.watched.items():
            row = rows[name]
            found[place, : len(row)] = row
        return found

    def _share_of_brakes(self, group: int, force: FloatArray, rows: dict[tuple[str, int], FloatArray]) -> None:
        """What holds a group at rest, told as the torque of the brake that acts."""
        _, grip = self.balances.holder(group)
        if grip is not None:
            rows["grip", grip] = -force
