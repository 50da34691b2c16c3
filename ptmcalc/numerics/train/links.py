"""Elastic links in their contact states: force, what is lost, what keeps the state, what comes next.

A state is a phase and a side: `whole` (no play), `open`, and with the side on which contact is made `firm` (spring and
damper act), `over` (clamped: the damper would exceed the spring, the force is twice the spring's), `lift` (bodies
still overlap but nothing pushes), `shut` (rigid contact).
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ptmcalc.numerics.motion import Curve
from ptmcalc.numerics.train.parts import CLAMPED, HUNT_CROSSLEY, KELVIN, LINEAR, RIGID, Spring
from ptmcalc.numerics.train.signals import FloatArray

Contact = tuple[str, int]
WHOLE, OPEN = ("whole", 0), ("open", 0)


@dataclass(frozen=True, slots=True)
class Stretch:
    """A link's extension x and its rate as functionals of the state, and the functional 1."""

    x: FloatArray
    rate: FloatArray
    one: FloatArray

    def overlap(self, spring: Spring, side: int) -> FloatArray:
        """How far the bodies overlap beyond the play on a side."""
        return side * self.x - spring.play / 2 * self.one


def rest_state(spring: Spring) -> Contact:
    """The state before anything is known of the extension."""
    return WHOLE if spring.law == LINEAR else OPEN


def force(spring: Spring, contact: Contact, of: Stretch) -> FloatArray:
    """Force that shortens the link, without what a curve adds."""
    phase, side = contact
    if phase == "whole":
        return spring.stiffness * of.x + spring.damping * of.rate
    if phase in ("open", "lift", "shut"):
        return np.zeros_like(of.x)
    elastic = spring.stiffness * of.overlap(spring, side)
    if phase == "over":
        return 2 * side * elastic
    if spring.law == HUNT_CROSSLEY:
        return side * elastic if spring.exponent == 1 else np.zeros_like(of.x)
    return side * elastic + spring.damping * of.rate


def elastic(spring: Spring, contact: Contact, of: Stretch) -> FloatArray:
    """The part of the force that stores energy; for a link without overlap nothing."""
    phase, side = contact
    if phase == "whole":
        return spring.stiffness * of.x
    if phase in ("open", "shut") or spring.exponent != 1:
        return np.zeros_like(of.x)
    return spring.stiffness * side * of.overlap(spring, side)


def curve(spring: Spring, contact: Contact, of: Stretch) -> Curve | None:
    """The nonlinear part of the force on the side of contact (Hunt and Crossley).

    C d^n (1 + 1.5 c d') - C d [n = 1]
    """
    phase, side = contact
    if phase != "firm" or spring.law != HUNT_CROSSLEY:
        return None
    stiffness, n, c = spring.stiffness, spring.exponent, 1.5 * spring.dissipation

    def value(y: FloatArray) -> FloatArray:
        depth = np.maximum(y[0], 0.0)
        rest: FloatArray = depth * c * y[1] if n == 1 else depth**n * (1 + c * y[1])
        return side * stiffness * rest

    def slope(y: FloatArray) -> float:
        depth = max(float(y[0]), 0.0)
        if n == 1:
            return side * stiffness * c * float(y[1])
        return float(side * stiffness * n * depth ** (n - 1) * (1 + c * float(y[1])))

    rows = np.array([of.overlap(spring, side), side * of.rate])
    return Curve(rows, value, slope, size=spring.stiffness * 1e-3, grain=spring.stiffness / 50)


def guards(spring: Spring, contact: Contact, of: Stretch) -> Iterator[tuple[FloatArray, Contact]]:
    """What keeps a contact state at 0 or above, and the state that follows where it does not."""
    phase, side = contact
    if phase == "open":
        first = "shut" if spring.law == RIGID else "firm"
        for one in (spring.side,) if spring.side else (1, -1):
            yield -of.overlap(spring, one), (first, one)
        return
    if phase in ("whole", "shut"):
        return
    depth, rate = of.overlap(spring, side), side * of.rate
    pull, push = spring.stiffness * depth, spring.damping * rate
    if spring.law == HUNT_CROSSLEY:
        bound = of.one + 1.5 * spring.dissipation * rate
        if phase == "firm":
            yield depth, OPEN
            if spring.dissipation:
                yield bound, ("lift", side)
        else:
            yield -bound, ("firm", side)
            yield depth, OPEN
    elif spring.law == KELVIN or not spring.damping:
        yield depth, OPEN
    elif phase == "firm":
        yield pull + push, ("lift", side)
        if spring.law == CLAMPED:
            yield pull - push, ("over", side)
    elif phase == "over":
        yield push - pull, ("firm", side)
    else:
        yield -pull - push, ("firm", side)
        yield depth, OPEN


def stored(spring: Spring, contact: Contact, x: float) -> float:
    """Elastic energy at an extension; nothing for a force that is not linear in it (`elastic` gives none either)."""
    phase, side = contact
    if phase == "whole":
        return spring.stiffness * x**2 / 2
    if phase in ("open", "shut") or spring.exponent != 1:
        return 0.0
    return spring.stiffness * (side * x - spring.play / 2) ** 2 / 2
