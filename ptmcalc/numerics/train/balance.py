"""The balances of the bodies in one contact state, solved for accelerations, mesh torques and forces of holds.

    J_i r_i a_g + sum T_inner - sum T_outer - sum J_c mu_c = F_i,   T_inner = e T_outer

with a constraint and its force mu for whatever is held: a body at rest under friction, a locked clutch, a closed
rigid contact, a prescribed motion.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ptmcalc.numerics.motion import Curve
from ptmcalc.numerics.train import drives, links
from ptmcalc.numerics.train.drives import DriveState, Place
from ptmcalc.numerics.train.links import Contact, Stretch
from ptmcalc.numerics.train.parts import Grip, Mesh
from ptmcalc.numerics.train.signals import FloatArray
from ptmcalc.numerics.train.state import NO_FRICTION, State

if TYPE_CHECKING:
    from ptmcalc.numerics.train.system import TrainSystem

CANCELS = 8 * float(np.finfo(float).eps)
"""Share of what it adds up below which a sum is 0."""


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


class Balances:
    """Torques of one contact state as functionals, and the balances with them."""

    def __init__(self, system: "TrainSystem", state: State) -> None:
        self.system, self.state, self.train = system, state, system.train
        self.now, self.places = system.signals_now(state.signals)
        self.link_curves = self._curves(links.curve(*one) for one in self.links_now())
        self.drive_curves = self._curves(drives.drive_curve(*one) for one in self.drives_now())
        self.curves = [curve for _, curve in self.link_curves + self.drive_curves]
        self.width = system.size + len(self.curves)
        self.link_force = [self.wide(links.force(*one)) for one in self.links_now()]
        self.drive_torque = [self.wide(drives.drive_row(*one)) for one in self.drives_now()]
        for column, (index, _) in enumerate(self.link_curves):
            self.link_force[index][system.size + column] = 1.0
        for column, (index, _) in enumerate(self.drive_curves, len(self.link_curves)):
            self.drive_torque[index][system.size + column] = 1.0

    def links_now(self) -> Iterator[tuple[Any, Contact, Stretch]]:
        return zip(self.train.springs, self.state.contacts, self.system.stretches, strict=True)

    def drives_now(self) -> Iterator[tuple[Any, DriveState, Place]]:
        return zip(self.train.drives, self.state.drives, self.places, strict=True)

    @staticmethod
    def _curves(found: Iterator[Curve | None]) -> list[tuple[int, Curve]]:
        return [(index, curve) for index, curve in enumerate(found) if curve is not None]

    def wide(self, row: FloatArray) -> FloatArray:
        if len(row) == self.width:
            return row
        found = np.zeros(self.width)
        found[: len(row)] = row
        return found

    def _forces(self, state: State, static: bool) -> FloatArray:
        """Forces on the bodies as functionals; `static` takes the friction of what is at rest as it is overcome."""
        force = np.zeros((len(self.train.bodies), self.width))
        for spring, link in zip(self.train.springs, self.link_force, strict=True):
            force[spring.first] -= link
            if spring.second is not None:
                force[spring.second] += link
            if spring.over is not None:
                force[spring.over] += link
        for drive, torque in zip(self.train.drives, self.drive_torque, strict=True):
            force[drive.body] += torque
        for index, grip in enumerate(self.train.grips):
            direction = self.slip(index, state)
            if direction:
                at_rest = static and self.slip(index, self.state) == 0
                capacity = self.wide(self.capacity(grip)) * (grip.static if at_rest else 1.0)
                force[grip.first] -= direction * capacity
                if grip.second is not None:
                    force[grip.second] += direction * capacity
        return force

    def capacity(self, grip: Grip) -> FloatArray:
        """What a grip bears as it slips, as a functional."""
        gate = self.now.level(grip.gate)
        return self.now[grip.capacity] if gate == 1 else np.asarray(gate * self.now[grip.capacity])

    def slip(self, index: int, state: State) -> int:
        """Direction in which a grip slips; 0 where it holds."""
        groups, grip = self.system.groups, self.train.grips[index]
        if index in self.system.clutches:
            return state.clutches[self.system.clutches.index(index)]
        group = groups.of[grip.first]
        return int(np.sign(state.turning[group] * groups.row(grip.first, grip.second)[group]))

    def _holds(self, state: State, stays: int | None) -> list[Hold]:
        """What is held: prescribed motions, groups at rest (and the one that `stays`), clutches, rigid contacts."""
        system, groups = self.system, self.system.groups
        zero = np.zeros(self.width)
        held: list[Hold] = []
        for index, guide in enumerate(self.train.guides):
            held.append(Hold("guide", index, groups.row(guide.body, None), self.wide(self.now[guide.acceleration])))
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

    def solve(self, state: State, static: bool = False, stays: int | None = None) -> tuple[Solved, list[Hold]]:
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
            matrix[mesh.inner, count + index] += self.share(index, mesh, state)
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
            return self.holder(which)[0], None
        if what == "verge":
            return self.root(which), None
        part = self.train.grips[which] if what == "clutch" else self.train.springs[which]
        return part.first, part.second

    def holder(self, group: int) -> tuple[int, int | None]:
        """The body on which a group at rest is held, and the grip that does it: the first brake that acts, else the
        motor's side of the first mesh with losses. Gears between it and the load carry the load."""
        groups = self.system.groups
        for index, grip in enumerate(self.train.grips):
            acts = np.any(self.capacity(grip))
            if index not in self.system.clutches and groups.of[grip.first] == group and acts:
                return grip.first, index
        inner = (self.train.meshes[index].inner for index in self.system.lossy)
        return next((body for body in inner if groups.of[body] == group), groups.of.index(group)), None

    def root(self, group: int) -> int:
        """The body of a group from which power flows outward through all its meshes."""
        bodies = [body for body, one in enumerate(self.system.groups.of) if one == group]
        outer = {mesh.outer for mesh in self.train.meshes}
        return next((body for body in bodies if body not in outer), bodies[0])

    def share(self, index: int, mesh: Mesh, state: State) -> float:
        """e = T_inner/T_outer of a mesh, by the direction of the power through it."""
        if not mesh.lossy:
            return 1 / mesh.ratio
        turn = state.turning[self.system.groups.of[mesh.inner]]
        sign = state.meshes[self.system.lossy.index(index)]
        direction = sign * turn * np.sign(self.system.groups.ratio[mesh.outer])
        if turn in (0, NO_FRICTION):
            return 1 / mesh.ratio
        return 1 / (mesh.ratio * mesh.forward) if direction > 0 else mesh.reverse / mesh.ratio


def _solution(matrix: FloatArray, right: FloatArray) -> tuple[FloatArray, bool]:
    """Solution of the balances, the smallest one where holds share a load that no balance tells apart; whether it is
    one. Entries below their rounding are 0: the sign of a torque that is not there must not mean anything.

        |dX| <= 8 eps |A^-1| (|A| |X| + |B|)

    **Source** Skeel, Scaling for numerical stability in Gaussian elimination, 1979.
    """
    largest = max(1.0, float(np.abs(right).max()))
    try:
        inverse = np.linalg.inv(matrix)
        found: FloatArray = inverse @ right
        found += inverse @ (right - matrix @ found)
        fits = bool(np.isfinite(found).all() and np.abs(matrix @ found - right).max() <= 1e-9 * largest)
    except np.linalg.LinAlgError:
        fits = False
    if not fits:
        inverse = np.linalg.pinv(matrix, rcond=1e-13)
        found = inverse @ right
        found += inverse @ (right - matrix @ found)
        beyond = np.abs(matrix @ found - right) - 1e-6 * (np.abs(matrix) @ np.abs(found) + np.abs(right))
        beside = np.abs(right).max(axis=0)  # each by itself: accelerations are small beside stiffnesses
        fits = bool((beyond <= 1e-12 * beside).all())
    noise = CANCELS * (np.abs(inverse) @ (np.abs(matrix) @ np.abs(found) + np.abs(right)))
    found[np.abs(found) <= noise] = 0.0
    return found, fits
