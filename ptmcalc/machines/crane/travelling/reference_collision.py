"""Second method of a collision with the buffers of both rails, followed over time."""

import math
from typing import Any

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.components.buffer import Buffer
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import buffer
from ptmcalc.machines.crane.travelling.buffers import yawing
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.model import filled
from ptmcalc.machines.crane.travelling.machine.scenes import Collision
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.reference import lumped, two_runs

SOURCE = "Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I"
_STROKE_LOOKS = 400
"""Samples of a buffer collision over time [1]. A numerical choice: more samples reduce the error of the largest force
and cost time in proportion."""
_SLOW = 0.01
"""Share of the speed at which an orifice has stopped the crane, as the solver has it."""


def collide(spec: Travelling, scene: Collision, carried: frozenset[str], level: int) -> Result:
    """Motion of the crane on the buffers of both rails, with rotation and load sway, over time.

        M y'' + F(y) = P + H,   F = c u, F_e (u/s)^p, F_0 or k u'^2;   for two cranes u is half of their approach

    **Range** as `buffer_collision`.
    **Error** three times the difference of two runs, the second with a hundredth of the tolerance of the first.
    **Source** Newton's law; Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed.
    """
    given = spec.buffers
    assert given is not None
    drive, ratio = spec.drive, model.rim_ratio(spec)
    wheels = model.wheel_count(spec) * filled(spec.wheels.inertia) / model.radius(spec) ** 2
    mass = sum(body.mass for body in model.bodies(spec, 0.0)) + wheels + drive.efficiency * drive.inertia * ratio**2
    mass += model.hanging(spec, scene) if scene.suspension == "guided" else 0.0
    push = drive.torque * ratio * drive.efficiency if scene.drive == "on" else 0.0
    start, struck = scene.speed_share * spec.speed, mass
    if scene.other_mass is not None:
        start = (start + scene.other_speed) / 2
        struck = 2 * mass * scene.other_mass / (mass + scene.other_mass)
    ever = _ever(given, push, start)
    loads = {
        "collision_speed": Found(Estimate.exact(start)),
        "collision_energy": Found(Estimate.within(struck * start**2 / 2, 1e-9 * struck * start**2)),
    }
    if not ever:
        loads |= _pushed_on(given, struck, push, start, mass)
    else:
        runs = [_pressed(yawing.places(spec, scene, struck / mass, start), one) for one in lumped.TOLERANCES[-2:]]
        for run in runs:
            run["buffer_deceleration"] *= struck / mass
        left = runs[-1].pop("left")
        before = runs[0].pop("left")
        loads |= two_runs.compared(*runs)
        for name in ("buffer_force", "buffer_stroke", "buffer_deceleration"):
            loads[name] = _loosened(loads[name].estimate, given.type == "constant" and name != "buffer_force")
        if left > 0:  # whatever stands behind the buffers has the rest
            for name in ("buffer_force", "buffer_deceleration"):
                one = loads[name].estimate
                loads[name] = Found(Estimate(one.value, one.low, math.inf, one.numerical, math.inf))
        loads["buffer_speed_left"] = Found(_wide(two_runs.estimate(before, left), 1e-4 * start))
    share = given.shape if given.shape is not None else _share(given, struck)
    factor = buffer.buffer_factor(min(share, 1.0), spec.classes.buffer_edition)
    loads["phi7"] = Found(Estimate.within(factor, 1e-8))
    return Result(loads, work=2)


def _loosened(one: Estimate, much: bool) -> Found:
    """With the error of looks at a course that has corners."""
    return Found(_wide(one, (1e-2 if much else 1e-5) * abs(one.value)))


def _wide(one: Estimate, more: float) -> Estimate:
    bar = one.bar + more
    return Estimate.within(one.value, bar)


def _ever(given: Buffer, push: float, start: float) -> bool:
    """Whether the buffers ever stop what is pushed onto them."""
    if given.type == "constant":
        return push < given.hardness
    return given.type != "hydraulic" or push == 0 or push / given.hardness < (_SLOW * start) ** 2


def _pushed_on(given: Buffer, struck: float, push: float, start: float, mass: float) -> dict[str, Found]:
    """A straight stop that never ends, at the end of the stroke: by quadrature of its energy."""
    from scipy.integrate import solve_ivp

    hard = given.hardness
    force = (lambda square: hard) if given.type == "constant" else (lambda square: hard * square)
    run: Any = solve_ivp(
        lambda u, square: [2 * (push - force(square[0])) / struck], (0.0, given.stroke), [start**2], rtol=1e-11,
        atol=1e-12 * start**2, method="DOP853",
    )  # fmt: skip
    left = math.sqrt(max(float(run.y[0, -1]), 0.0))
    most = max(force(start**2), force(left**2))
    numbers = {"buffer_force": most / given.count, "buffer_deceleration": (most - push) / mass}
    found = {name: Found(Estimate(value, value, math.inf, 0.0, math.inf)) for name, value in numbers.items()}
    found["buffer_stroke"] = Found(Estimate.exact(math.inf))
    found["buffer_speed_left"] = Found(Estimate.within(left, 1e-7 * start))
    return found


def _pressed(several: list[yawing.Yawing], tolerance: float) -> dict[str, float]:
    """The hardest pressed buffer over all places of the hook."""
    found = [_followed(one, tolerance) for one in several]
    return {name: max(one[name] for one in found) for name in found[0]}


def _followed(one: yawing.Yawing, tolerance: float) -> dict[str, float]:
    """Force, stroke and deceleration until the buffers of both rails are pressed no more."""
    from scipy.integrate import solve_ivp

    given, start = one.given, one.speed
    slow = _SLOW * start if given.type == "hydraulic" else 0.0
    slow = 1e-3 * start if given.type == "constant" else slow

    def slows(t: float, y: Any) -> float:
        return max(float(y[3]), float(y[4])) - slow

    slows.terminal = True  # type: ignore[attr-defined]
    slows.direction = -1  # type: ignore[attr-defined]
    length = given.stroke
    run: Any = solve_ivp(
        lambda t, y: one.rates(tuple(y)), (0.0, 1e9), [0.0, 0.0, 0.0, start, start, start], events=(slows,),
        rtol=tolerance, atol=[1e-3 * tolerance * length] * 3 + [1e-3 * tolerance * start] * 3, dense_output=True,
        method="DOP853" if given.type != "constant" else "Radau",
    )  # fmt: skip
    times = np.linspace(0.0, float(run.t[-1]), _STROKE_LOOKS)
    looks = run.sol(times)
    tops = [_deepest(looks[side], looks[side + 3], times) for side in (0, 1)]
    side = int(tops[1] > tops[0])
    forces = [one.force(min(float(u), given.stroke), float(v)) for u, v in looks[[side, side + 3]].T]
    most = max(forces) if given.type == "hydraulic" else one.force(min(tops[side], given.stroke), start)
    left, past = 0.0, np.flatnonzero(looks[side] > given.stroke)
    if len(past):
        left = _speed_at(run, side, given.stroke, float(times[past[0] - 1]), float(times[past[0]]))
        left = left if left > slow or given.type != "hydraulic" else 0.0
    rates = np.array([one.rates(tuple(look))[3:5] for look in looks.T])
    single = 1.0 if given.count > 1 else 2.0
    return {
        "buffer_force": single * most / max(given.count / 2, 1.0),
        "buffer_stroke": tops[side],
        "buffer_deceleration": float(-rates.min()),
        "left": left,
    }


def _deepest(strokes: Any, rates: Any, times: Any) -> float:
    """Largest stroke, where its rate vanishes between two looks too."""
    best = int(strokes.argmax())
    top = float(strokes[best])
    for one in (best - 1, best):
        if 0 <= one < len(times) - 1 and rates[one] > 0 >= rates[one + 1]:
            step, share = times[one + 1] - times[one], rates[one] / (rates[one] - rates[one + 1])
            top = max(top, float(strokes[one] + rates[one] * step * share / 2))
    return top


def _speed_at(run: Any, side: int, stroke: float, low: float, high: float) -> float:
    """Rate with which a stroke is passed between two times."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if run.sol(middle)[side] < stroke else (low, middle)
    return float(run.sol(high)[side + 3])


def _share(given: Buffer, struck: float) -> float:
    """Energy of the buffers over largest force times stroke, by quadrature of the force of a crane on its way."""
    from scipy.integrate import quad

    if given.type == "hydraulic":
        whole = quad(lambda u: math.exp(-2 * given.hardness * u / struck), 0.0, given.stroke, epsabs=0.0)[0]
        return float(whole / given.stroke)
    power = {"linear": 1.0, "progressive": given.power, "constant": 0.0}[given.type]
    return float(quad(lambda u: (u / given.stroke) ** power, 0.0, given.stroke)[0] / given.stroke)


def priced(seconds: float) -> Any:
    return lambda spec, scene, carried, level: seconds


COLLISION_IN_TIME: Solver[Travelling, Collision] = Solver(
    name="collision_runge_kutta",
    title="buffer impact, Runge-Kutta (reference)",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Collision}),
    represents=frozenset(),
    gives=frozenset(
        {
            "collision_speed", "collision_energy", "buffer_force", "buffer_stroke", "buffer_deceleration",
            "buffer_speed_left", "phi7",
        }
    ),
    run=collide,
    cost=priced(4e-3),
    source=SOURCE,
)  # fmt: skip
