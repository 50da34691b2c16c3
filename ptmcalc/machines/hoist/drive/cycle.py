"""Heating of the motor by a cycle of given torques: three rms torques, mean loss, temperature in the periodic state."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, Sense, at, blames, only
from ptmcalc.contract.limits import fixed, key
from ptmcalc.contract.result import Found, LoadInfo, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.contract.topic import Topic
from ptmcalc.laws import duty
from ptmcalc.machines.hoist.machine.keys.drive import CyclePart, Losses
from ptmcalc.machines.hoist.machine.spec import Hoist, HoistScene, Run

WEIGHTED, WHOLE, RUNNING = "cycle_torque_weighted", "cycle_torque_whole", "cycle_torque_running"
FACTOR, UTILISATION = "cycle_duty_factor", "cycle_utilisation"
LOSS, LOSS_UTILISATION, PEAK = "cycle_loss_mean", "cycle_loss_utilisation", "cycle_temperature_max"

LOADS = (
    LoadInfo(WEIGHTED, "motor torque of the given cycle, rms over cooling time", units.TORQUE),
    LoadInfo(WHOLE, "motor torque of the given cycle, rms over the whole cycle", units.TORQUE, headline=False),
    LoadInfo(RUNNING, "motor torque of the given cycle, rms over running time", units.TORQUE, headline=False),
    LoadInfo(FACTOR, "duty factor of the given cycle", units.SHARE),
    LoadInfo(UTILISATION, "thermal utilisation of the given cycle (rms torque)", units.SHARE),
    LoadInfo(LOSS, "motor loss of the given cycle, mean over cooling time", units.POWER, headline=False),
    LoadInfo(LOSS_UTILISATION, "thermal utilisation of the given cycle (losses)", units.SHARE),
    LoadInfo(PEAK, "temperature rise of the motor in the given cycle, maximum", units.TEMPERATURE_DIFFERENCE),
)
_POINTS = 65
"""Points of a part with a changing torque at which its temperature is evaluated; a numerical choice. More points find a
peak inside the part more closely; with constant torques the peak is at an end."""


def cooling_of(parts: Sequence[CyclePart], at_rest: float) -> list[float]:
    """Cooling in each part relative to that at speed [1]."""
    shares = {"running": 1.0, "starting": (1 + at_rest) / 2, "rest": at_rest}
    return [shares[one.phase] for one in parts]


@dataclass(frozen=True, slots=True)
class Heating:
    """A motor of one temperature: loss as a parabola of time, cooling in proportion to the temperature."""

    losses: Losses
    rated: float
    """continuous rated torque [N*m]"""

    def loss(self, part: CyclePart) -> tuple[float, float, float]:
        """Coefficients of the loss over the time from the begin of a part [W, W/s, W/s^2]."""
        if part.phase == "rest":
            return 0.0, 0.0, 0.0
        rate, scale = (part.end - part.torque) / part.time, self.losses.copper / self.rated**2
        return self.losses.constant + scale * part.torque**2, 2 * scale * part.torque * rate, scale * rate**2

    def peak(self, parts: Sequence[CyclePart], cooling: Sequence[float], rise: float, constant: float) -> float:
        """Largest temperature rise of the periodic state [K].

        C dT/dt = P(t) - k G T,   G = (P_0 + P_Cu)/T_N,   C = tau G
        """
        loss = self.losses.constant + self.losses.copper
        solutions = [
            _solution([one / loss * rise / constant for one in self.loss(part)], share / constant)
            for part, share in zip(parts, cooling, strict=True)
        ]

        def after(start: float) -> tuple[float, float]:
            now, top = start, start
            for part, solution in zip(parts, solutions, strict=True):
                course = solution(now, np.linspace(0.0, part.time, _POINTS))
                now, top = float(course[-1]), max(top, float(course.max()))
            return now, top

        gained = after(0.0)[0]
        kept = -math.expm1(-sum(share * part.time for part, share in zip(parts, cooling, strict=True)) / constant)
        return after(gained / kept)[1]


def _solution(heating: Sequence[float], rate: float) -> Callable[[float, "np.ndarray"], "np.ndarray"]:
    """Temperature over time from a start, for T' = heating - rate T with a parabola of heating."""
    third = heating[2] / rate
    second = (heating[1] - 2 * third) / rate
    first = (heating[0] - second) / rate

    def course(start: float, times: "np.ndarray") -> "np.ndarray":
        return np.asarray((start - first) * np.exp(-rate * times) + first + times * (second + times * third))

    return course


def run(spec: Hoist, scene: HoistScene, carried: frozenset[str], level: int) -> Result:
    """Loads of a motor in a cycle of given torques.

        M = sqrt(sum M_i^2 t_i/sum k_i t_i),   k = 1 at speed, (1 + k_0)/2 in starts and stops, k_0 at rest
        P = sum (P_0 + P_Cu (M/M_N)^2)_i t_i/sum k_i t_i

    Of a straight part the mean square is (M_a^2 + M_a M_b + M_b^2)/3. The rms torque over the cooling time is compared
    with the continuous rating. A rating at a duty factor contains pauses of its own and is converted
    (`laws.duty.permissible_torque`). The rms torque over the running time belongs to a rating at the duty factor of the
    cycle, that over the whole cycle to forced cooling.

    **Range** rms and mean: cycles of at most 10 min or a third of the time constant; peak: any cycle. A motor at rest
    has no losses.
    **Error** exact for that model; the peak within a part of changing torque by 65 points.
    **Source** IEC 60034-1; heat balance of a body of one temperature. The cooling at rest is an engineering value, to
    be compared with the standard and the data sheet.
    """
    motor, given = spec.motor, spec.duty
    if motor is None or given is None or given.cycle is None:
        return Result({}, work=1)
    parts, at_rest = given.cycle, duty.REST_COOLING[motor.cooling]
    cooling, times = cooling_of(parts, at_rest), [one.time for one in parts]
    before, after = [one.torque for one in parts], [one.end for one in parts]
    on = [0.0 if one.phase == "rest" else 1.0 for one in parts]
    running = sum(time for time, share in zip(times, on, strict=True) if share)
    loads = {
        WEIGHTED: duty.equivalent_torque(before, after, times, cooling),
        WHOLE: duty.equivalent_torque(before, after, times),
        FACTOR: running / sum(times),
    }
    if running:
        loads[RUNNING] = duty.equivalent_torque(before, after, times, on)
    if motor.rated is not None:
        rated = duty.permissible_torque(motor.rated, motor.rated_duty, 1.0, rest_cooling=at_rest)
        loads[UTILISATION] = loads[WEIGHTED] / rated
        if given.losses is not None:
            loads |= _of_losses(Heating(given.losses, rated), parts, cooling)
    return Result({name: Found(Estimate.exact(value)) for name, value in loads.items()}, work=1)


def _of_losses(heating: Heating, parts: Sequence[CyclePart], cooling: Sequence[float]) -> dict[str, float]:
    """Loads that the losses of the motor add."""
    given, lost = heating.losses, 0.0
    for part in parts:
        first, second, third = heating.loss(part)
        lost += part.time * (first + part.time * (second / 2 + part.time * third / 3))
    mean = lost / sum(share * part.time for part, share in zip(parts, cooling, strict=True))
    loads = {LOSS: mean, LOSS_UTILISATION: mean / (given.constant + given.copper)}
    if given.temperature_rise is not None and given.time_constant is not None:
        loads[PEAK] = heating.peak(parts, cooling, given.temperature_rise, given.time_constant)
    return loads


SOLVER: Solver[Hoist, HoistScene] = Solver(
    name="motor_cycle",
    title="heating of the motor by a cycle of given torques",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=frozenset(info.name for info in LOADS),
    run=run,
    cost=lambda spec, scene, carried, level: 1e-3,
    source="IEC 60034-1; heat balance of a body of one temperature",
)


def _has_cycle(spec: Hoist, scene: HoistScene) -> bool:
    return spec.motor is not None and spec.duty is not None and spec.duty.cycle is not None


def _has_losses(spec: Hoist, scene: HoistScene) -> bool:
    return _has_cycle(spec, scene) and spec.duty is not None and spec.duty.losses is not None


def _has_rise(spec: Hoist, scene: HoistScene) -> bool:
    losses = spec.duty.losses if spec.duty is not None else None
    return _has_losses(spec, scene) and losses is not None and losses.temperature_rise is not None


def _needs_rating(spec: Hoist, scene: HoistScene) -> tuple[KeyPath, ...]:
    return () if spec.motor is not None and spec.motor.rated is not None else (("motor", "rated_torque"),)


def _needs_time(spec: Hoist, scene: HoistScene) -> tuple[KeyPath, ...]:
    losses = spec.duty.losses if spec.duty is not None else None
    missing = losses is not None and losses.time_constant is None
    return (*_needs_rating(spec, scene), *((("duty", "losses", "time_constant"),) if missing else ()))


def _rating(spec: Hoist, scene: HoistScene) -> KeyPath:
    return ("motor", *(spec.motor.rating_key if spec.motor is not None else ("rated_torque",)))


_FULL = fixed(
    1.0,
    meaning="The full continuous rating of the motor",
    valid="ratings at a duty factor are converted with the cooling of the motor at standstill",
    error="none: a definition",
    source="IEC 60034-1; `laws.duty.permissible_torque`",
)

TORQUE: Check[Hoist, Run] = only(_has_cycle)(
    Check(
        code="HST133",
        title="thermal utilisation of the given cycle, torque",
        question="Is the rms torque of the given cycle within the rated torque of the motor?",
        failure="given cycle overloads the motor thermally",
        scenes=frozenset({Run}),
        loads=(UTILISATION,),
        sense=Sense.AT_MOST,
        limit=_FULL,
        needs=_needs_rating,
        blame=lambda spec, scene, loads: _rating(spec, scene),
        repair=_rating,
        what="The rms torque of the given cycle over its cooling time is at most the continuous torque of the motor.",
        why="Every ten degrees of temperature rise halve the life of the winding insulation.",
        formula="sqrt(sum M_i^2 t_i/sum k_i t_i) <= M_N",
        source="IEC 60034-1, to be compared with the standard",
    )
)

LOSSES: Check[Hoist, Run] = only(_has_losses)(
    Check(
        code="HST134",
        title="thermal utilisation of the given cycle, losses",
        question="Are the mean losses of the given cycle within the rated losses of the motor?",
        failure="losses of the given cycle exceed the rated losses",
        scenes=frozenset({Run}),
        loads=(LOSS_UTILISATION,),
        sense=Sense.AT_MOST,
        limit=_FULL,
        needs=_needs_rating,
        blame=blames("duty", "losses"),
        repair=lambda spec, scene: (),
        what="The mean losses of the given cycle over its cooling time are at most the rated losses.",
        why="Constant losses heat the motor in addition to those of the torque, and only while it runs.",
        formula="sum P_i t_i/sum k_i t_i <= P_0 + P_Cu",
        source="heat balance of the cycle; IEC 60034-1, to be compared with the standard",
    )
)

TEMPERATURE: Check[Hoist, Run] = only(_has_rise)(
    Check(
        code="HST135",
        title="temperature rise of the motor in the given cycle",
        question="Does the winding stay below its rated temperature rise during the given cycle?",
        failure="winding exceeds its rated temperature rise",
        scenes=frozenset({Run}),
        loads=(PEAK,),
        sense=Sense.AT_MOST,
        limit=key(
            "duty.losses.temperature_rise",
            meaning="Rated temperature rise of the winding",
            valid="motors with the insulation class of their rating",
            error="none: a given value",
            source="the manufacturer's data",
        ),
        needs=_needs_time,
        blame=blames("duty", "losses", "temperature_rise"),
        repair=at("duty", "losses", "temperature_rise"),
        what="The largest temperature rise in the periodic state of the cycle is at most the rated rise.",
        why="In long cycles the peak exceeds the mean temperature, which alone the rms torque states.",
        formula="C dT/dt = P - k G T; max T <= T_N",
        source="heat balance of a body of one temperature",
    )
)

CYCLE: Topic[Hoist] = Topic(loads=LOADS, solvers=(SOLVER,), checks=(TORQUE, LOSSES, TEMPERATURE))
