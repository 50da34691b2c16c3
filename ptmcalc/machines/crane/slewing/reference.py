"""The second method for a rotation: the load in Cartesian coordinates, by Runge-Kutta steps; no plan offers it.

    d'' = g - a_S + lambda d,   lambda = -(d.(g - a_S) + |d'|^2)/L^2,   d the load's offset from the head of the jib

and the jib turns under what acts on it and the pull -m lambda d of the rope at its head. Shared with the solvers: what
the file comes to (`model`), and the chain of torques that follows from times and angles.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.components.motor import ConverterMotor
from ptmcalc.components.motor_stage import Stage
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import Slew, SlewingCrane, SlewingScene
from ptmcalc.machines.crane.slewing.rotation import chain
from ptmcalc.machines.crane.slewing.rotation.loads import OF_THE_CHAIN
from ptmcalc.machines.crane.slewing.sway.loads import OF_THE_SWING
from ptmcalc.machines.crane.slewing.sway.slew import ALWAYS, hangs
from ptmcalc.reference import lumped, lumped_history, two_runs

FloatArray = NDArray[np.float64]
Torque = Callable[[float, float], float]
_PERIODS_AFTER = 3.0
"""Sway periods [1] after the stop in which extremes are searched, times 2 + `_DRAGGED`. A numerical choice, equal to
that of the solver: fewer miss later extremes, more cost time."""
_DRAGGED = 8
"""So many times longer, since a load that swings may drag a braked crane on."""
_LONGEST = 2000.0
"""Time [s] after which a start or stop is refused with NUM102. An engineering choice: a smaller value refuses slow
cranes, a larger one allows longer runs."""
_SAMPLES = 40
"""Samples of the angles in a step [1]; a parabola through three of them refines the extremes. A numerical choice: more
samples reduce the error of the extremes and cost time in proportion."""
_OUTWARDS, _AHEAD, _ROPE = range(3)


@dataclass
class _Crane:
    """Plain numbers in SI, the state (phi, omega, d, d'), and what has been seen."""

    jib: float
    rotor: float
    mass: float
    radius: float
    rope: float
    forward: float
    back: float
    gravity: float
    tolerance: float
    time: float = 0.0
    state: FloatArray = field(default_factory=lambda: np.zeros(8))
    largest: FloatArray = field(default_factory=lambda: np.zeros(3))
    farthest: float = 0.0
    steps: int = 0

    def parts(self, y: FloatArray) -> tuple[FloatArray, FloatArray, float, float, float]:
        """Unit vectors outwards and ahead; lambda = a + b phi''; m R times what is ahead of d."""
        out = np.array([math.cos(y[0]), math.sin(y[0]), 0.0])
        ahead = np.array([-out[1], out[0], 0.0])
        d, rate = y[2:5], y[5:8]
        fixed = -(-self.gravity * d[2] + y[1] ** 2 * self.radius * (d @ out) + rate @ rate) / self.rope**2
        along = self.radius * float(d @ ahead)
        return out, ahead, float(fixed), along / self.rope**2, self.mass * along

    def derivative(self, y: FloatArray, turning: float) -> FloatArray:
        """Rate of the state at an angular acceleration."""
        out, ahead, fixed, grows, _ = self.parts(y)
        head = self.radius * (turning * ahead - y[1] ** 2 * out)
        rate = (fixed + grows * turning) * y[2:5] - head
        rate[2] -= self.gravity
        return np.concatenate([[y[1], turning], y[5:8], rate])

    def turned(self, y: FloatArray, motor: float, outer: float, way: int = 1) -> float:
        """Angular acceleration under a torque on the motor's side, by the ratio alone, and one on the jib, which turns
        this way: losses go by the direction of the power through the gear."""
        _, _, fixed, grows, lever = self.parts(y)
        found = 0.0
        for factor, side in ((self.forward, 1), (1 / self.back, -1)):
            inertia = self.jib + factor * self.rotor + grows * lever
            found = (factor * motor + outer - fixed * lever) / inertia
            if side * way * (motor - self.rotor * found) >= 0:
                break
        return found

    def lever(self, y: FloatArray) -> float:
        """Torque of the rope on a jib that stands."""
        *_, fixed, _, lever = self.parts(y)
        return -fixed * lever

    def go(
        self,
        turning: Callable[[float, FloatArray], float],
        until: float,
        ends: Callable[[float, FloatArray], float] | None = None,
    ) -> bool:
        """On to a time, or to where `ends` rises through 0; whether it did."""
        from scipy.integrate import solve_ivp

        def event(t: float, y: FloatArray) -> float:
            return ends(t, y) if ends is not None else 1.0

        event.terminal = True  # type: ignore[attr-defined]
        event.direction = 1  # type: ignore[attr-defined]
        run: Any = solve_ivp(
            lambda t, y: self.derivative(y, turning(t, y)),
            (self.time, until),
            self.state,
            method="DOP853",
            rtol=self.tolerance,
            atol=self.tolerance * np.array([1.0, 1.0, *([self.rope] * 6)]) * 1e-2,
            events=event,
            dense_output=True,
        )
        self.steps += len(run.t)
        for start, stop in zip(run.t[:-1], run.t[1:], strict=True):
            self._see(run.sol(np.linspace(start, stop, _SAMPLES)))
        self.time, self.state = float(run.t[-1]), np.asarray(run.y[:, -1], float)
        return len(run.t_events[0]) > 0

    def _see(self, y: FloatArray) -> None:
        cosine, sine, d = np.cos(y[0]), np.sin(y[0]), y[2:5]
        out, ahead = d[0] * cosine + d[1] * sine, d[1] * cosine - d[0] * sine
        angles = np.arctan2(out, -d[2]), np.arctan2(ahead, -d[2]), np.arctan2(np.hypot(out, ahead), -d[2])
        self.farthest = max(self.farthest, float(y[0].max()))
        for k, angle in enumerate(angles):
            size = np.abs(angle)
            top = min(max(int(size.argmax()), 1), len(size) - 2)
            self.largest[k] = max(self.largest[k], float(size.max()), lumped_history.summit(size[top - 1 : top + 2]))


def run(spec: SlewingCrane, scene: SlewingScene, carried: frozenset[str], level: int) -> Result:
    """A complete slewing motion, computed twice.

    **Range** as `slew`; a brake that holds the stopped crane.
    **Error** three times the difference of two runs, the second with a hundredth of the tolerance of the first;
    extremes by a parabola through the maximum of 40 samples per step.
    **Source** the load's equation with the rope as a constraint; Hairer, Nørsett and Wanner, Solving Ordinary
    Differential Equations I, 2nd ed.
    """
    at = model.phase_torques(spec, scene, model.start_of(spec, scene)[1], by_direction=True)
    found, steps, end = [], 0, 0.0
    for tolerance in lumped.TOLERANCES[level : level + 2]:
        crane, phases = _rotated(spec, scene, carried, tolerance)
        loads = dict(chain.loads(spec, scene, phases, at, rounded=False))
        names = ("sway_radial_max", "sway_tangential_max", "sway_max")
        loads |= dict(zip(names, crane.largest.tolist(), strict=True))
        found.append(loads)
        steps, end = steps + crane.steps, crane.time
    return Result(two_runs.compared(*found), work=steps, window=(0.0, end))


def _rotated(
    spec: SlewingCrane, scene: SlewingScene, carried: frozenset[str], tolerance: float
) -> tuple[_Crane, model.Phases]:
    load = spec.load
    assert load is not None
    assert load.rope_length is not None
    crane = _Crane(
        model.structure_inertia(spec), model.rotor_at_axis(spec), model.hanging_mass(spec, scene), load.radius,
        load.rope_length, spec.gear.efficiency, spec.gear.back, spec.gravity, tolerance,
    )  # fmt: skip
    crane.state[2:5] = 0.0, 0.0, -load.rope_length
    planned = model.stop(spec, scene) or model.allowed_stop(spec)
    start = _started(spec, scene, crane, carried)
    steady = max(spec.cycle.rotation - start[1] - planned[1], 0.0)
    crane.go(lambda t, y: 0.0, crane.time + steady / spec.speed)
    since, before = crane.time, float(crane.state[0])
    _stopped(spec, scene, crane, planned[0])
    stands = crane.time - since
    after = (2 + _DRAGGED) * _PERIODS_AFTER * _period(crane)
    _after(spec, scene, crane, since + max(2 * planned[0], stands) + after)
    return crane, model.Phases(start, (steady / spec.speed, steady), (stands, crane.farthest - before))


def _period(crane: _Crane) -> float:
    return 2 * math.pi * math.sqrt(crane.rope / crane.gravity)


def _started(spec: SlewingCrane, scene: SlewingScene, crane: _Crane, carried: frozenset[str]) -> tuple[float, float]:
    """The start; its time and angle."""
    given = model.motor_torque(spec, scene)
    if given is None or spec.gear.back <= 0:
        time = model.start_of(spec, scene)[0]
        crane.go(lambda t, y: spec.speed / time, time)
        crane.state[1] = spec.speed
        return time, float(crane.state[0])
    steady, wind = model.steady_torque(spec, scene), spec.wind
    rise, lasts = wind.gust_rise or 2.0, wind.gust_time or 5.0
    whole = 2 * rise + lasts

    def against(t: float) -> float:
        gust = float(np.interp(t, (0.0, rise, rise + lasts, whole), (0.0, 1.0, 1.0, 0.0)))
        return -steady - (gust * wind.gust_torque if "wind_gust" in carried else 0.0)

    breaks = [rise, rise + lasts, whole] if "wind_gust" in carried and wind.gust_torque else []
    for torque, until, speed in _drives(spec, given, "slewing_motor_curve" in carried):
        while True:
            stop = min([until, *(time for time in breaks if time > crane.time)])
            met = crane.go(
                lambda t, y, m=torque: crane.turned(y, m(y[1]), against(t)),  # type: ignore[misc]
                stop,
                lambda t, y, most=speed: float(y[1] - most),  # type: ignore[misc]
            )
            if met or crane.time >= until:
                break
        if crane.time >= _LONGEST:
            raise NumericsError("NUM102", "the crane does not reach its speed")
    crane.state[1] = spec.speed
    return crane.time, float(crane.state[0])


def _drives(spec: SlewingCrane, mean: float, curve: bool) -> Iterator[tuple[Callable[[float], float], float, float]]:
    """Torque of all motors at the axis by the ratio alone over the speed there, and the time or speed of its end."""
    given, ratio, count = spec.motor.curve, spec.gear.ratio, spec.motor.count
    if given is None or not curve:
        yield lambda speed: mean * ratio, _LONGEST, spec.speed
        return
    for stage in given.stages:
        over = spec.speed if stage.until_speed is None else min(stage.until_speed / ratio, spec.speed)
        until = _LONGEST if stage.until_time is None else stage.until_time
        yield _law(stage, count * ratio, ratio), until, over if stage.until_time is None else spec.speed
        if over >= spec.speed and stage.until_time is None:
            return


def _law(stage: Stage, many: float, ratio: float) -> Callable[[float], float]:
    return lambda speed: many * float(stage.torque(np.array([speed * ratio]))[0])


def _stopped(spec: SlewingCrane, scene: SlewingScene, crane: _Crane, rigid: float) -> None:
    """The stop, until the crane stands for the first time."""
    brake, blown, begun = spec.brake, model.driving_wind(spec, scene), crane.time
    if brake is None or spec.gear.back <= 0:
        ramp = max(rigid, 1e-3 * _period(crane))
        crane.go(lambda t, y: -spec.speed / ramp, begun + ramp)
        return
    on_motor = brake.shaft == "motor"
    full = brake.torque * (spec.gear.ratio if on_motor else 1.0)
    for until in (brake.delay, brake.delay + brake.rise_time, _LONGEST):
        if begun + until <= crane.time:
            continue
        first, last = crane.time - begun, until

        def held(t: float, first: float = first, last: float = last) -> float:
            if last <= brake.delay:
                return 0.0
            return full * min((t - begun - brake.delay) / brake.rise_time, 1.0) if last < _LONGEST else full

        def turning(t: float, y: FloatArray, held: Callable[[float], float] = held) -> float:
            size = held(t)
            motor, outer = (-size, 0.0) if on_motor else (0.0, -size)
            return crane.turned(y, motor, blown - spec.friction + outer)

        if crane.go(turning, begun + until, lambda t, y: -float(y[1])):
            return
    raise NumericsError("NUM102", "the crane does not stop")


def _after(spec: SlewingCrane, scene: SlewingScene, crane: _Crane, end: float) -> None:
    """What follows the first stop: the closed brake holds, or the swinging load pulls the crane on or back."""
    brake, blown = spec.brake, model.driving_wind(spec, scene)
    crane.state[1], way = 0.0, 0
    if brake is None or spec.gear.back <= 0:
        crane.go(lambda t, y: 0.0, end)
        return
    full = brake.torque * (spec.gear.ratio if brake.shaft == "motor" else 1.0)
    motor, outer = (full, spec.friction) if brake.shaft == "motor" else (0.0, spec.friction + full)
    capacity = outer + motor / spec.gear.back
    while crane.time < end:
        if way == 0:
            if not crane.go(lambda t, y: 0.0, end, lambda t, y: abs(blown + crane.lever(y)) - capacity):
                return
            way = 1 if blown + crane.lever(crane.state) > 0 else -1
        else:
            crane.go(
                lambda t, y, way=way: crane.turned(y, -way * motor, blown - way * outer, way),  # type: ignore[misc]
                end,
                lambda t, y, way=way: -way * float(y[1]),  # type: ignore[misc]
            )
            crane.state[1] = 0.0
            pull = blown + crane.lever(crane.state)
            way = 0 if abs(pull) <= capacity else 1 if pull > 0 else -1


def cost(spec: SlewingCrane, scene: SlewingScene, carried: frozenset[str], level: int) -> float:
    """Seconds predicted from the swings of the load in the time that is looked at."""
    load = spec.load
    if load is None or load.rope_length is None:
        return 0.0
    omega = math.sqrt((spec.gravity + spec.speed**2 * load.radius) / load.rope_length)
    planned = model.stop(spec, scene) or model.allowed_stop(spec)
    whole = model.start_of(spec, scene)[0] + spec.cycle.rotation / spec.speed + planned[0]
    if not math.isfinite(whole):
        return 1e3
    return 0.1 + 2.5e-3 * (1 + level) * (whole * omega + 2 * math.pi * _PERIODS_AFTER)


def valid(spec: SlewingCrane, scene: SlewingScene) -> Criterion | None:
    """Whether something hangs, and the drive does not follow a ramp with a limit of torque.

        1 for a converter with a ramp

    **Range** any crane.
    **Error** none.
    **Source** the file.
    """
    curve = spec.motor.curve
    if isinstance(curve, ConverterMotor) and curve.ramp_time > 0:
        return Criterion("ramp", 1.0, 1.0, "a drive that follows a ramp up to a limit of torque", "the file")
    return hangs(spec, scene)


CARTESIAN: Solver[SlewingCrane, SlewingScene] = Solver(
    name="cartesian",
    title="slewing motion, Cartesian load, Runge-Kutta (reference)",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Slew}),
    represents=ALWAYS | {"slewing_motor_curve", "wind_gust"},
    gives=frozenset(info.name for info in (*OF_THE_CHAIN, *OF_THE_SWING)) - {"sway_residual"},
    run=run,
    cost=cost,
    source="rope as a constraint force; Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I",
    valid=valid,
    always=ALWAYS,
    levels=2,
)

REFERENCE_METHODS = (CARTESIAN,)
