"""Linear programme over the torques between bodies at rest: by how much friction can be undercut."""

import numpy as np

from ptmcalc.reference.mechanism import Mechanism, shares_at_rest
from ptmcalc.reference.mechanism_coordinates import FloatArray, State


class RestProgramme:
    """Groups at rest and what locked clutches and shut contacts tie to them.

    Unknowns: balances of the groups, torques of the meshes outside and inside, of grips, shut contacts and guides, and
    the share by which every limit of friction is undercut.
    """

    def __init__(self, mechanism: Mechanism, state: State, applied: FloatArray, w: FloatArray, inside: float) -> None:
        self.of, self.state, self.w = mechanism, state, w
        one, train = mechanism, mechanism.train
        self.shut = [k for k, (name, _) in enumerate(state.branches) if name == "shut"]
        meshes, grips = len(train.meshes), len(train.grips)
        self.outer, self.inner, self.grips = one.count, one.count + meshes, one.count + 2 * meshes
        self.contacts = self.grips + grips
        self.guides = self.contacts + len(self.shut)
        self.width = self.guides + len(train.guides) + 1
        self.caps = [float(one.capacity(k, state, inside) @ w) for k in range(grips)]
        self.size = max(float(np.abs(applied).max(initial=0.0)), 1e-30, *self.caps)
        self.balance = np.zeros((one.count_bodies, self.width))
        for b in range(one.count_bodies):
            self.balance[b, one.of[b]] = one.inertia[b] * one.ratio[b] / one.weights[one.of[b]]
        self.bounds: list[tuple[float | None, float | None]] = [(None, None)] * self.width
        self.equal, self.even = [self.balance], [applied / self.size]
        self.above: list[FloatArray] = []
        self.limit: list[float] = []

    def share(self) -> float:
        """The largest share by which every limit of friction can be undercut at once."""
        from scipy.optimize import linprog

        self._add_meshes()
        self._add_grips()
        self._add_contacts()
        self._add_guides()
        self._add_clutches()
        for g, turn in enumerate(self.state.turning):
            if turn == 0:
                self.bounds[g] = (0, 0)
        self.bounds[-1] = (None, 10.0)
        cost = np.zeros(self.width)
        cost[-1] = -1.0
        found = linprog(
            cost,
            A_ub=np.array(self.above) if self.above else None,
            b_ub=np.array(self.limit) if self.above else None,
            A_eq=np.vstack(self.equal),
            b_eq=np.concatenate(self.even),
            bounds=self.bounds,
            method="highs",
        )
        return min(float(found.x[-1]), 1.0) if found.status == 0 else -1.0

    def _add_meshes(self) -> None:
        one, state = self.of, self.state
        for k, mesh in enumerate(one.train.meshes):
            self.balance[mesh.inner, self.inner + k] += 1
            self.balance[mesh.outer, self.outer + k] -= 1
            if k in one.lossy and state.turning[one.of[mesh.inner]] == 0:
                sign = state.meshes[one.lossy.index(k)]
                self.bounds[self.outer + k] = (0, None) if sign > 0 else (None, 0)
                for share, way in zip(shares_at_rest(mesh), (-1, 1), strict=True):
                    row = np.zeros(self.width)
                    row[self.inner + k], row[self.outer + k] = way * sign, -way * share * sign
                    self.above.append(row)
                    self.limit.append(0.0)
                continue
            row = np.zeros(self.width)
            row[self.inner + k], row[self.outer + k] = 1, -one.share(k, state)
            self.equal.append(row[None])
            self.even.append(np.zeros(1))

    def _add_grips(self) -> None:
        one = self.of
        for k, grip in enumerate(one.train.grips):
            column, slip = self.grips + k, one.slip(k, self.state)
            self.balance[grip.first, column] -= 1
            if grip.second is not None:
                self.balance[grip.second, column] += 1
            if slip != 0:
                self.bounds[column] = (0, 0)  # it is among the applied forces
                continue
            for way in (1, -1):
                row = np.zeros(self.width)
                row[column], row[-1] = way, self.caps[k] / self.size
                self.above.append(row)
                self.limit.append(grip.static * self.caps[k] / self.size)

    def _add_contacts(self) -> None:
        one = self.of
        for i, k in enumerate(self.shut):
            column, spring = self.contacts + i, one.train.springs[k]
            for body, sign in ((spring.first, 1), (spring.second, -1), (spring.over, -1)):
                if body is not None:
                    self.balance[body, column] -= sign
            self.bounds[column] = (None, 0) if self.state.branches[k][1] > 0 else (0, None)
            self._tie(one.rows[k])

    def _add_guides(self) -> None:
        one = self.of
        for k, guide in enumerate(one.train.guides):
            group = one.of[guide.body]
            self.balance[guide.body, self.guides + k] -= 1
            wanted = float(one.signal_row(guide.acceleration) @ self.w)
            self.bounds[group] = (wanted * one.weights[group] / self.size / one.ratio[guide.body],) * 2

    def _add_clutches(self) -> None:
        one = self.of
        for k, slip in zip(one.clutches, self.state.slips, strict=True):
            if slip == 0:
                grip = one.train.grips[k]
                self._tie(one.group_row(grip.first, grip.second))

    def _tie(self, row: FloatArray) -> None:
        """Equal accelerations, in the unit the programme counts them in."""
        found = np.zeros((1, self.width))
        found[0, : self.of.count] = row / self.of.weights
        self.equal.append(found)
        self.even.append(np.zeros(1))
