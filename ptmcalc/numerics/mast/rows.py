"""Equations of one state of a mast as functionals over its coordinates."""

from typing import TYPE_CHECKING

import numpy as np

from ptmcalc.numerics.mast.base import Obstacle
from ptmcalc.numerics.mast.case import FREE, MOVED, TOUCH, State
from ptmcalc.numerics.mast.parts import FloatArray
from ptmcalc.numerics.piecewise import JAMMED

if TYPE_CHECKING:
    from ptmcalc.numerics.mast.system import MastSystem


class Rows:
    """The equations of one state as functionals over z."""

    def __init__(self, system: "MastSystem", state: State) -> None:
        self.system, self.state, self.case = system, state, system.case
        self.n, self.size = system.count, system.size
        self.zero = np.zeros(self.size)
        self.one, self.speed, self.way = (self._unit(k) for k in (system.one, 1, 0))
        self.q, self.rates = (np.eye(self.size)[start : start + self.n] for start in (2, 2 + self.n))
        self.time = system.breaks[state.stretch]
        self._points()
        self._accelerate()

    def _unit(self, index: int) -> FloatArray:
        row = np.zeros(self.size)
        row[index] = 1.0
        return row

    def _signal(self, index: int) -> FloatArray:
        """A signal of the base in this stretch of time."""
        value, slope = self.case.base.signals[index].now(self.time)
        row = np.zeros(self.size)
        row[self.system.one], row[self.system.clock] = value, slope
        return row

    # -- contacts ------------------------------------------------------------------------------------------------------

    def _points(self) -> None:
        """The points forces may act on, how far each is beyond what it meets, and the forces of springs that touch."""
        case, mast = self.case, self.case.mast
        self.places: list[float] = []
        self.beyond: list[FloatArray] = []
        touching: list[float] = []
        sides: list[float] = []
        if case.obstacle is not None:
            self.places.append(case.obstacle.place)
            self.beyond.append(self.way - case.obstacle.gap * self.one)
            touching.append(case.obstacle.stiffness if self.state.contact == TOUCH else 0.0)
            sides.append(1.0)
        if case.guide is not None:
            self.places.append(case.guide.place)
            self.beyond.append(-self.state.guide * case.guide.gap * self.one)
            touching.append(case.guide.stiffness if self.state.guide else 0.0)
            sides.append(0.0)
        count = len(self.places)
        self.rows = [mast.elements.row(place) for place in self.places]
        self.p = np.array([row @ self.system.shapes for row in self.rows]).reshape(count, self.n)
        self.on_base = np.array(sides)
        self.stiffness = np.array(touching)
        self.left = np.array([[self._left(row, other) for other in self.rows] for row in self.rows]).reshape(
            count, count
        )
        self.jammed = self.state.contact == JAMMED
        if self.system.bare:
            self.left[0, :] = self.left[:, 0] = 0.0
        straight = np.array(self.beyond).reshape(count, self.size) + self.p @ self.q
        inner = np.eye(count) + self.stiffness[:, None] * self.left
        self.force = np.linalg.solve(inner, -self.stiffness[:, None] * straight) if count else straight
        self.apart = straight + self.left @ self.force
        self.dash, self.dash_rate = self.zero, self.zero
        if self.system.damped and case.obstacle is not None:
            self.dash_rate = self.speed + self.p[0] @ self.rates
            if self.state.contact == TOUCH:
                self.dash = case.obstacle.damping * self.dash_rate
                self.force[0] -= self.dash

    def _left(self, row: FloatArray, other: FloatArray) -> float:
        """Flexibility of the modes left out between two functionals over the unknowns."""
        mast, system = self.case.mast, self.system
        whole = float(row @ mast.flexibility @ other)
        left = whole - float((row @ system.shapes / system.w**2) @ (other @ system.shapes))
        return left if abs(left) > 1e-13 * abs(whole) else 0.0

    def sprung(self, z: FloatArray) -> float:
        """Energy of the springs that touch, and of the modes left out under their forces."""
        forces = self.force @ z
        pressed = self.stiffness > 0
        if self.system.damped:
            forces[0] += self.dash @ z
        own = float((forces[pressed] ** 2 / self.stiffness[pressed]).sum())
        return (own + float(forces @ self.left @ forces)) / 2

    # -- accelerations -------------------------------------------------------------------------------------------------

    def _accelerate(self) -> None:
        system = self.system
        w, ratios = system.w, self.case.ratios
        inner = w[:, None] ** 2 * self.q + 2 * (ratios * w)[:, None] * self.rates
        free = self.p.T @ self.force - inner if len(self.places) else -inner
        self._grips()
        outer = self.pushed + (self.on_base @ self.force if len(self.places) else self.zero)
        pulled = outer - system.shares @ free
        code = self.state.base
        if self.jammed:
            point = self.p[0]
            apart = system.apart(point)
            if code % 2:
                self.base = self._signal(-1) if code == MOVED else self.zero
                contact = -(apart * self.base + point @ free) / float(point @ point)
            else:
                contact = -(apart / system.rest * pulled + point @ free) / (
                    apart**2 / system.rest + float(point @ point)
                )
                self.base = (pulled + apart * contact) / system.rest
            self.force = self.force.copy()
            self.force[0] = contact
            free = free + np.outer(point, contact)
            pulled = pulled + apart * contact
        elif code % 2:
            self.base = self._signal(-1) if code == MOVED else self.zero
        else:
            self.base = pulled / system.rest
        self.modes = free - np.outer(system.shares, self.base)
        self.needed = system.rest * self.base - pulled
        """force that keeps the base as it moves, beyond those that are known"""

    def _grips(self) -> None:
        """Forces of the grips that slip, and of all that pushes."""
        grips, code = self.case.base.grips, self.state.base
        self.grip = [self.zero] * len(grips)
        self.held = code // 2 if code % 2 and code != MOVED else None
        self.push = self._signal(0) if code != MOVED else self.zero
        self.pushed = self.push
        if code == MOVED:
            return
        for j in range(len(grips)):
            if j != self.held:
                capacity = self._signal(1 + j)
                self.grip[j] = capacity if j >= (code + 1) // 2 else -capacity
                self.pushed = self.pushed + self.grip[j]

    def rate(self) -> FloatArray:
        """A of z' = A z."""
        found = np.zeros((self.size, self.size))
        found[0], found[1] = self.speed, self.base
        found[2 : 2 + self.n] = self.rates
        found[2 + self.n : self.system.own] = self.modes
        found[self.system.clock, self.system.one] = 1.0
        return found

    def guards(self) -> FloatArray:
        """What stays at 0 or above as long as the state holds."""
        rows: list[FloatArray] = []
        grips, code = self.case.base.grips, self.state.base
        if self.held is not None:
            capacity = self._signal(1 + self.held)
            rows += [capacity - self.needed, capacity + self.needed]
        elif code != MOVED:
            below, above = code // 2 - 1, code // 2
            rows += [self.speed - grips[below].speed * self.one] if below >= 0 else []
            rows += [grips[above].speed * self.one - self.speed] if above < len(grips) else []
        if self.case.obstacle is not None:
            rows += self._contact_guards(self.case.obstacle)
        if self.case.guide is not None:
            side, way = self.state.guide, self.apart[-1]
            gap = self.case.guide.gap * self.one
            rows += [-side * self.force[-1] / self.case.guide.stiffness] if side else [gap - way, gap + way]
        return np.array(rows).reshape(len(rows), self.size)

    def _contact_guards(self, obstacle: Obstacle) -> list[FloatArray]:
        contact, apart = self.state.contact, self.apart[0]
        if contact == JAMMED:
            return [-self.force[0]]
        if contact == FREE:
            return [-apart]
        if not self.system.damped:  # by the force: of a hard contact nothing is left of how far it gives but rounding
            return [-self.force[0] / obstacle.stiffness]
        pushes = obstacle.stiffness * apart + obstacle.damping * self.dash_rate
        return [apart, pushes if contact == TOUCH else -pushes]

    # -- what is read --------------------------------------------------------------------------------------------------

    def watch(self) -> FloatArray:
        """The watched signals."""
        case, mast = self.case, self.case.mast
        rows: dict[tuple[str, int], FloatArray] = {
            ("way", 0): self.way,
            ("speed", 0): self.speed,
            ("acceleration", 0): self.base,
            ("moment", 0): self._moment(),
            ("contact", 0): -self.force[0] if case.obstacle is not None else self.zero,
            ("guide", 0): self.force[-1] if case.guide is not None else self.zero,
            ("drive", 0): self.needed if self.state.base == MOVED else self.zero,
            ("push", 0): self.push,
            ("dash", 0): self.dash,
            ("dash_rate", 0): self.dash_rate,
        }
        for j, grip in enumerate(self.grip):
            rows["grip", j] = self.needed if j == self.held else grip
        for i, place in enumerate(case.places):
            rows["deflection", i] = self._field(mast.elements.row(place))
        for k in range(self.n):
            rows["rate", k] = self.rates[k]
        return np.array([rows[name] for name in self.system.watched])

    def _field(self, row: FloatArray) -> FloatArray:
        """A functional over the deflections, with what the modes left out do at once."""
        built = self.case.mast.elements
        found = row @ self.system.shapes @ self.q - self._left(row, built.carried) * self.base
        for index, other in enumerate(self.rows):
            if not (index == 0 and self.system.bare):
                found = found + self._left(row, other) * self.force[index]
        return np.asarray(found)

    def _moment(self) -> FloatArray:
        """The moment in the root: that of all that acts on the column."""
        built = self.case.mast.elements
        found = built.moment * self.base + (built.turned @ self.system.shapes) @ self.modes + self._field(built.righted)
        for index, place in enumerate(self.places):
            found = found - place * self.force[index]
        return np.asarray(-found)
