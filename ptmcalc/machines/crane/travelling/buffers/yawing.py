"""A crane that runs onto its buffers on both rails and turns as it does so: the trolley beside one rail presses on its
buffer more, and a load that hangs pulls as its ropes lean."""

import math
from dataclasses import dataclass, replace

from ptmcalc.components.buffer import Buffer
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.model import filled
from ptmcalc.machines.crane.travelling.machine.scenes import Collision
from ptmcalc.machines.crane.travelling.machine.spec import Travelling

_STEPS = (150, 300)
"""Steps in the stroke of two runs, whose difference is the error: of the fourth order, so that some 1e-8 is left."""
_STANDS = 1e-3
"""Share of the speed below which a buffer of constant force gives less than that: what it adds goes by its square."""
_SLOW = 0.01
"""Share of the speed from which on something in an orifice buffer stands."""
_MOST = 50
"""Strokes' worth of steps after which a stop is given up: one that creeps on is told by the straight stop already."""

State = tuple[float, float, float, float, float, float]
"""Strokes on rail A and B, way of the load, and their rates."""


@dataclass(frozen=True, slots=True)
class Yawing:
    """A crane on the buffers of both rails, with the hook in one place; each rail has half of the buffers."""

    given: Buffer
    masses: tuple[float, float, float]
    """M_AA, M_AB, M_BB of what moves with the crane [kg]"""
    pushes: tuple[float, float]
    """of the drive, on rail A and B [N]"""
    hanging: float
    """mass that swings as the crane stops [kg]"""
    place: float
    """of the hook from rail A, over the span [1]"""
    omega: float
    """circular frequency of the load [rad/s]"""
    speed: float

    def force(self, stroke: float, rate: float) -> float:
        """Of the buffers on one rail, their curve continued beyond its end [N]."""
        if stroke < 0:
            return 0.0
        given, hard = self.given, self.given.hardness / 2
        if given.type == "linear":
            return hard * stroke
        if given.type == "progressive":
            return float(hard * (stroke / given.stroke) ** given.power)
        if given.type == "hydraulic":
            return hard * rate * rate if rate > 0 else 0.0
        return hard * min(max(rate / (_STANDS * self.speed), 0.0), 1.0)

    def rates(self, state: State) -> State:
        """Rate of the state."""
        near, far, load, near_rate, far_rate, load_rate = state
        aa, ab, bb = self.masses
        at = self.place
        lean = self.omega**2 * (load - (1 - at) * near - at * far)
        pull = self.hanging * lean
        one = self.pushes[0] + (1 - at) * pull - self.force(near, near_rate)
        two = self.pushes[1] + at * pull - self.force(far, far_rate)
        whole = aa * bb - ab * ab
        return (
            near_rate, far_rate, load_rate, (bb * one - ab * two) / whole, (aa * two - ab * one) / whole, -lean,
        )  # fmt: skip


@dataclass(frozen=True, slots=True)
class Pressed:
    """What the buffers of the harder pressed rail come to."""

    force: float
    """largest, of one buffer [N]"""
    stroke: float
    """that it would need [m]"""
    left: float
    """speed at which it bottoms out, 0 where it does not [m/s]"""
    deceleration: float
    """largest, at a rail [m/s^2]"""
    rail: str
    hook: float
    """from rail A [m]"""
    ended: bool = True
    """whether it was followed until it stands"""


def places(spec: Travelling, scene: Collision, share: float, closing: float) -> list[Yawing]:
    """The crane in a collision, the hook in each of its places.

    `share` is the mass of a straight stop over that of the crane: not 1 where two cranes meet, of which the other one
    is taken to have its mass where this one has it, and a load that swings as this one does.
    """
    given = spec.buffers
    assert given is not None
    hanging = model.hanging(spec, scene)
    guided = scene.suspension == "guided"
    swings = 0.0 if guided else share**2 * hanging
    push = model.driving_force(spec, spec.drive.torque) if scene.drive == "on" else 0.0
    driven = (_driven_share(spec, "A"), _driven_share(spec, "B"))
    omega = math.sqrt(spec.gravity / spec.suspension.length)
    if given.count == 1:  # one buffer in the middle: the guides keep the crane straight
        half = share * (model.travelling_mass(spec) + model.rotor_mass(spec, braking=False) + guided * hanging) / 2
        return [Yawing(given, (half, 0.0, half), (push / 2, push / 2), swings, 0.5, omega, closing)]
    found = []
    for hook in model.hook_places(spec, scene):
        aa, ab, bb = _masses(spec, hook, guided * hanging)
        found.append(
            Yawing(
                given,
                (share * aa, share * ab, share * bb),
                (push * driven[0], push * driven[1]),
                swings,
                hook / spec.gauge,
                omega,
                closing,
            )
        )
    return found


def _driven_share(spec: Travelling, rail: str) -> float:
    on_rail = sum(model.driven_at(spec, corner) for corner in model.CORNERS if corner.startswith(rail))
    return on_rail / model.driven_wheels(spec)


def _masses(spec: Travelling, hook: float, guided: float) -> tuple[float, float, float]:
    """M_AA, M_AB, M_BB: a bridge is an even rod about its centre, the trolley on it and a guided load are points."""
    gauge = spec.gauge
    bridge = spec.bridge
    length = gauge if bridge is None else gauge + bridge.cantilever_a + bridge.cantilever_b
    rod, *others = model.bodies(spec, hook)
    parts = [(rod.mass, rod.across, length**2 / 12), *((one.mass, one.across, 0.0) for one in others)]
    parts.append((guided, hook, 0.0))
    rim = filled(spec.wheels.inertia) / model.radius(spec) ** 2
    turning = model.rotor_mass(spec, braking=False)
    for rail, across in (("A", 0.0), ("B", gauge)):
        corners = [corner for corner in model.CORNERS if corner.startswith(rail)]
        free = sum(spec.wheels.per_corner - model.driven_at(spec, corner) for corner in corners)
        parts.append((free * rim + turning * _driven_share(spec, rail), across, 0.0))
    aa = sum(mass * ((1 - at / gauge) ** 2 + spread / gauge**2) for mass, at, spread in parts)
    ab = sum(mass * (at / gauge * (1 - at / gauge) - spread / gauge**2) for mass, at, spread in parts)
    bb = sum(mass * ((at / gauge) ** 2 + spread / gauge**2) for mass, at, spread in parts)
    return aa, ab, bb


def pressed(spec: Travelling, one: Yawing, reach: float) -> tuple[Pressed, float]:
    """What the buffers come to, and its error as a share of it; `reach` is about their stroke [m]."""
    coarse, fine = (_run(one, reach, steps) for steps in _STEPS)
    apart = max(abs(coarse.force / fine.force - 1), abs(coarse.stroke / fine.stroke - 1)) if fine.force else 0.0
    own = 1e-5 if one.given.type == "constant" else 1e-9  # of a constant force that fades out, and of rounding
    if one.given.count == 1:
        fine = replace(fine, force=2 * fine.force)
    return replace(fine, hook=one.place * spec.gauge), apart + own


def _run(one: Yawing, reach: float, steps: int) -> Pressed:
    """The stop by steps of the fourth order."""
    speed, given = one.speed, one.given
    state: State = (0.0, 0.0, 0.0, speed, speed, speed)
    hydraulic = given.type == "hydraulic"
    ends = _SLOW * speed if hydraulic else 0.0
    tops, passed, ended = [0.0, 0.0], [0.0, 0.0], True
    hardest = [one.force(1e-300, speed)] * 2 if hydraulic else [0.0, 0.0]
    begun = one.rates((1e-300, 1e-300, 0.0, speed, speed, speed))
    deceleration = max(-begun[3], -begun[4], 0.0)
    quickest = math.inf
    if given.type == "constant":  # the time in which a constant force fades out
        aa, ab, bb = one.masses
        lightest = (aa * bb - ab * ab) / (aa + bb)  # below the smaller of both masses that move by themselves
        quickest = _STANDS * speed * lightest / given.hardness
    held = sum(one.pushes) + one.hanging * one.omega * speed < given.hardness  # whatever the load pulls later on
    if given.type == "constant" and held:
        ends = _STANDS * speed
    for _ in range(_MOST * steps):
        fastest = max(state[3], state[4], 0.05 * speed if not hydraulic else ends)
        step = reach / (steps * fastest)
        if given.type == "constant":  # into the speed at which it fades out by no large step
            slowing = one.rates(state)
            for rate, change in zip(state[3:5], slowing[3:5], strict=True):
                if rate > 0 > change:
                    step = min(step, max(quickest, -rate / change / 4))
            if min(state[3], state[4]) < 4 * _STANDS * speed:
                step = min(step, quickest)
        after = _stepped(one, state, step)
        last = max(after[3], after[4]) <= ends
        if last:  # it stands within this step: what follows is another motion
            step, after = _until(one, state, step, ends)
        for side in (0, 1):
            top = _between(state[side], after[side], state[side + 3], after[side + 3], step)
            tops[side] = max(tops[side], top)
            if hydraulic:
                hardest[side] = max(hardest[side], one.force(after[side], after[side + 3]))
            if not passed[side] and state[side] <= given.stroke < after[side]:
                passed[side] = max(_passing(state, after, side, step, given.stroke), 0.0)
        rates = one.rates(after)
        deceleration = max(deceleration, -rates[3], -rates[4])
        state = after
        if last:
            break
        if given.type == "constant" and max(state[3], state[4]) <= _STANDS * speed and (held or state[5] <= 0):
            break
    else:
        ended = False
    if given.type in ("linear", "progressive"):
        hardest = [one.force(min(top, given.stroke), 0.0) for top in tops]
    elif given.type == "constant":
        hardest = [given.hardness / 2] * 2
    side = 0 if tops[0] >= tops[1] else 1
    left = passed[side]  # as the stroke: the other rail may bottom out sooner, but is pressed less
    if hydraulic and left <= ends:
        left = 0.0
    return Pressed(max(hardest) / max(given.count / 2, 1.0), tops[side], left, deceleration, "AB"[side], 0.0, ended)


def _stepped(one: Yawing, state: State, step: float) -> State:
    """A step of Runge and Kutta."""
    first = one.rates(state)
    second = one.rates(_moved(state, first, step / 2))
    third = one.rates(_moved(state, second, step / 2))
    fourth = one.rates(_moved(state, third, step))
    a, b, c, d, e, f = (
        x + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        for x, k1, k2, k3, k4 in zip(state, first, second, third, fourth, strict=True)
    )
    return a, b, c, d, e, f


def _until(one: Yawing, state: State, step: float, rate: float) -> tuple[float, State]:
    """The part of a step after which neither rail moves faster than so."""
    low, high = 0.0, step
    for _ in range(40):
        middle = (low + high) / 2
        tried = _stepped(one, state, middle)
        low, high = (middle, high) if max(tried[3], tried[4]) > rate else (low, middle)
    return high, _stepped(one, state, high)


def _moved(state: State, rates: State, step: float) -> State:
    a, b, c, d, e, f = (x + step * rate for x, rate in zip(state, rates, strict=True))
    return a, b, c, d, e, f


def _between(here: float, there: float, rate: float, later: float, step: float) -> float:
    """Largest stroke of a step, by the cubic through both ends."""
    if not rate > 0 >= later:
        return max(here, there)
    share = rate / (rate - later)
    for _ in range(4):
        slope, bend = _cubic(here, there, rate, later, step, share)[1:]
        share = min(max(share - slope / bend, 0.0), 1.0) if bend else share
    return _cubic(here, there, rate, later, step, share)[0]


def _passing(state: State, after: State, side: int, step: float, stroke: float) -> float:
    """Speed at which a stroke is passed."""
    low, high = 0.0, 1.0
    ends = (state[side], after[side], state[side + 3], after[side + 3], step)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if _cubic(*ends, middle)[0] < stroke else (low, middle)
    return _cubic(*ends, high)[1] / step


def _cubic(here: float, there: float, rate: float, later: float, step: float, s: float) -> tuple[float, float, float]:
    """Value, slope and second slope over the share of a step of the cubic through its ends."""
    p, q = rate * step, later * step
    c = 3 * (there - here) - 2 * p - q
    d = p + q - 2 * (there - here)
    return here + s * (p + s * (c + s * d)), p + s * (2 * c + 3 * d * s), 2 * c + 6 * d * s
