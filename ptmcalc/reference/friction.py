"""What sticks and what slips: states of friction for which forces within their limits exist."""

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.reference.mechanism import Equations, Mechanism, shares_at_rest
from ptmcalc.reference.mechanism_coordinates import OPEN, Branch, FloatArray, State
from ptmcalc.reference.rest_programme import RestProgramme

_SMALL = 1e-9


@dataclass(frozen=True, slots=True)
class Rest:
    """Which groups stand still and which clutches turn alike."""

    groups: tuple[bool, ...]
    clutches: tuple[bool, ...]


class Friction:
    """Decides the state of friction of a mechanism at an instant."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.of = mechanism
        self.largest = 0.0
        """largest force on a body so far: what a torque that crosses 0 is next to nothing beside"""

    def decide(self, state: State, w: FloatArray, rest: Rest, inside: float) -> State:
        """The state with forces that fit it, what sticks tried first."""
        one = self.of
        turning: list[tuple[int | None, ...]] = []
        for g, turn in enumerate(state.turning):
            if turn is None:
                turning.append((None,))
            else:
                turning.append((0, 1, -1) if rest.groups[g] else (turn,))
        slips: list[tuple[int, ...]] = []
        for slip, still in zip(state.slips, rest.clutches, strict=True):
            slips.append((0, 1, -1) if still else (slip,))
        signs = [
            state.meshes,
            *(found for found in itertools.product((1, -1), repeat=len(one.lossy)) if found != state.meshes),
        ]
        for turns, slipping in itertools.product(itertools.product(*turning), itertools.product(*slips)):
            for meshes in signs:
                tried = state._replace(turning=turns, slips=slipping, meshes=meshes)
                if self._fits(tried, w, rest, inside):
                    return tried
        raise NumericsError("NUM101", "the second method finds no state of friction that fits")

    def _fits(self, state: State, w: FloatArray, rest: Rest, inside: float) -> bool:
        one = self.of
        try:
            now = one.equations(state, inside)
        except NumericsError:
            return False
        acceleration = now.acceleration @ w
        loads = np.abs(now.force) @ np.abs(w)
        self.largest = size = max(self.largest, float(loads.max(initial=0.0)), 1e-30)
        quick = size / one.weights
        for g, turn in enumerate(state.turning):
            guide = one.guided.get(g)
            if turn == 0 and guide is not None:
                wanted = float(one.signal_row(one.train.guides[guide].acceleration) @ w)
                if abs(wanted) > _SMALL * quick[g]:
                    return False
            elif turn and rest.groups[g] and turn * acceleration[g] < -_SMALL * quick[g]:
                return False
        anchored = one.anchored(state)
        for k, slip in zip(one.clutches, state.slips, strict=True):
            grip = one.train.grips[k]
            row = one.group_row(grip.first, grip.second)
            if slip and rest.clutches[one.clutches.index(k)]:
                apart = float(row @ acceleration)
                if slip * apart < -_SMALL * float(np.abs(row) @ quick):
                    return False
        for (what, which), row in zip(now.holds, now.holding, strict=True):
            if what == "clutch" and not anchored[one.of[one.train.grips[which].first]]:
                most = one.train.grips[which].static * float(one.capacity(which, state, inside) @ w)
                if abs(float(row @ w)) > most + _SMALL * size:
                    return False
        for i, k in enumerate(one.lossy):
            turn = state.turning[one.of[one.train.meshes[k].inner]]
            if turn and state.meshes[i] * float(now.mesh[k] @ w) < -_SMALL * size:
                return False
        return self.spare(state, w, inside) >= -_SMALL

    # -- at rest ----------------------------------------------------------------------------------------------------

    def spare(self, state: State, w: FloatArray, inside: float) -> float:
        """By how much what is held at rest by brakes and bearings is held; below 0 it is not."""
        one = self.of
        stuck = [g for g, turn in enumerate(state.turning) if turn == 0 and g not in one.guided]
        if not stuck:
            return 1.0
        force = self._with_slipping(state, w, inside)
        anchored = one.anchored(state)
        left = min((self._held(g, state, force, w, inside) for g in stuck if not anchored[g]), default=1.0)
        if any(anchored):
            left = min(left, self._tied(state, force, w, inside))
        return left

    def _with_slipping(self, state: State, w: FloatArray, inside: float) -> FloatArray:
        """Forces on the bodies, those of slipping grips among them."""
        one = self.of
        force = one.equations(state, inside).force @ w
        for k, grip in enumerate(one.train.grips):
            slip = one.slip(k, state)
            if slip:
                size = slip * float(one.capacity(k, state, inside) @ w)
                force[grip.first] -= size
                if grip.second is not None:
                    force[grip.second] += size
        return np.asarray(force, float)

    def _held(self, group: int, state: State, force: FloatArray, w: FloatArray, inside: float) -> float:
        """A group held by its brakes alone: what can act on one of its bodies, meshes at rest between both of their
        efficiencies, must hold the balance."""
        one = self.of
        low, high = force.copy(), force.copy()
        for k, grip in enumerate(one.train.grips):
            if k in one.clutches or one.of[grip.first] != group:
                continue
            most = grip.static * float(one.capacity(k, state, inside) @ w)
            for body in (grip.first, grip.second):
                if body is not None:
                    low[body] -= most
                    high[body] += most
        root = one.of.index(group)
        down, up = self._reduced(root, None, low, high)
        size = max(abs(down), abs(up))
        if not np.isfinite(size) or size == 0:
            return 1.0 if down <= 0 <= up else -1.0
        return float(min(-down, up) / size)

    def _reduced(self, body: int, came: int | None, low: FloatArray, high: FloatArray) -> tuple[float, float]:
        """Least and most torque at a body, with all behind it."""
        down, up = float(low[body]), float(high[body])
        for k, mesh in enumerate(self.of.train.meshes):
            if k == came or body not in (mesh.inner, mesh.outer):
                continue
            other = mesh.outer if body == mesh.inner else mesh.inner
            behind = self._reduced(other, k, low, high)
            least, most = shares_at_rest(mesh)
            if body == mesh.inner:
                found = [share * torque for share in (least, most) for torque in behind]
            elif least * most <= 0:
                found = [-np.inf, np.inf]
            else:
                found = [torque / share for share in (least, most) for torque in behind]
            down, up = down + min(found), up + max(found)
        return down, up

    def _tied(self, state: State, applied: FloatArray, w: FloatArray, inside: float) -> float:
        """The best over all signs that the torques of meshes at rest can have."""
        one = self.of
        resting = [i for i, k in enumerate(one.lossy) if state.turning[one.of[one.train.meshes[k].inner]] == 0]
        best = -1.0
        for signs in itertools.product((1, -1), repeat=len(resting)):
            meshes = list(state.meshes)
            for i, sign in zip(resting, signs, strict=True):
                meshes[i] = sign
            tried = RestProgramme(one, state._replace(meshes=tuple(meshes)), applied, w, inside)
            best = max(best, tried.share())
        return best

    # -- links -----------------------------------------------------------------------------------------------------

    def settle(self, state: State, w: FloatArray, inside: float) -> State:
        """Branches of links that hold just after an instant."""
        one = self.of
        count = one.count
        for _ in range(20):
            now = one.equations(state, inside)
            rate = np.zeros(one.width)
            rate[:count], rate[count : 2 * count] = w[count : 2 * count], now.acceleration @ w
            changed = False
            for k, branch in enumerate(state.branches):
                for row, to in self._link_exits(k, branch, now):
                    value, slope = float(row @ w), float(row @ rate)
                    small = 1e-11 * float(np.abs(row) @ np.abs(w)) + 1e-15 * float(np.abs(row[: 2 * count]).sum())
                    if value < -small or (value <= small and slope < -small):
                        branches = list(state.branches)
                        branches[k] = to
                        state, changed = state._replace(branches=tuple(branches)), True
                        break
                if changed:
                    break
            if not changed:
                return state
        raise NumericsError("NUM101", "the second method finds links that chatter")

    def _link_exits(self, k: int, branch: Branch, now: Equations) -> Iterator[tuple[FloatArray, Branch]]:
        yield from self.of.link_exits(k, branch)
        if branch[0] == "shut":
            for (what, which), row in zip(now.holds, now.holding, strict=True):
                if what == "contact" and which == k:
                    yield -branch[1] * row, OPEN
