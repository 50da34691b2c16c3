"""A torque step on a uniform loop with gravity take-up over its first two contour times: closed form, exact."""

import math

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import capstan, wave
from ptmcalc.laws.loop_bounds import CARRY
from ptmcalc.machines.conveyor.machine.loads import AT_DRUM
from ptmcalc.machines.conveyor.machine.plain_start import plainness
from ptmcalc.machines.conveyor.machine.scenes import Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import StartCase, start_case
from ptmcalc.machines.conveyor.waves import start_enclosure, start_intervals
from ptmcalc.machines.conveyor.waves.effects import tail


def run(spec: Conveyor, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Entering tension of a uniform loop, from `laws.wave.two_interval_force`.

        S_on = S_static + S(t),  0 <= t <= window <= 2 T

    The slip values use the maximum entering tension and a centrifugal tension between 0 and that of the highest
    possible pulley speed, F_d t/m or the rated speed.

    **Range** gravity take-up, torque step, window at most two wave circuits; equal strands (a jump of impedance or a
    tail mass adds the bound of its effect).
    **Error** exact for the tension; for slip the stated interval of the centrifugal tension.
    **Source** derived by the method of steps (`laws.wave`).
    """
    case = start_case(spec, scene)
    line = case.line
    rise, when = wave.two_interval_peak(case.excess, _contour(case), _tau(case), case.window)
    at = {"time": when}
    on = line.run_on + rise
    loads = {
        "tension_dynamic_run_on_max": Found(Estimate.exact(rise), at),
        "tension_run_on_max": Found(Estimate.exact(on), at),
        "tension_run_off_min": Found(Estimate.exact(line.run_off), {"time": 0.0}),
    }
    if line.grip_exponent is not None and line.run_on >= line.run_off:
        fastest = case.excess * case.window / line.drive_mass
        lift = line.belt_line_mass * fastest**2
        slow, fast = (
            float(capstan.slip_utilisation(on, line.run_off, part, line.grip_exponent)) for part in (0.0, lift)
        )
        used = Estimate(slow, min(slow, fast), max(slow, fast), model=abs(fast - slow))
        left = float(capstan.slip_reserve_force(on, line.run_off, line.grip_exponent))
        loads |= {
            "slip_utilisation_max": Found(used, at),
            "slip_reserve_min": Found(Estimate.exact(left), at),
        }
    return Result(loads, work=1, window=(0.0, case.window), beyond=_once_held(case, loads))


def _once_held(case: StartCase, loads: dict[str, Found]) -> dict[str, Interval]:
    """Offsets of a drum that has its speed before the rigid body has, and of the waves that the fall of the torque then
    leaves: the loads stay within the enclosure of the whole start."""
    enclosed = start_intervals.enclosed_loads(case, start_enclosure.enclose(case, 0.0))
    return {
        name: Interval(
            min(enclosed[name].low - found.estimate.low, 0.0), max(enclosed[name].high - found.estimate.high, 0.0)
        )
        for name, found in loads.items()
    }


def valid(spec: Conveyor, scene: Start) -> Criterion:
    """Whether the loop is near enough to uniform and the window short enough for the closed form.

        largest of t_window/(2 T), r/0.02 and (m_t/m_belt)/0.01; infinite for a rigid take-up, an imposed speed or a
        torque that takes time to rise; a jump or tail mass that the file excludes does not count

    **Range** any start.
    **Error** none: the range of a closed form.
    **Source** `laws.wave.two_interval_force`; thresholds of the effects `tail_jump` and `tail_mass`.
    """
    plain = plainness(spec, scene)
    if plain.exceeded:
        return plain
    case = start_case(spec, scene)
    ratio = math.inf
    if case.shape == "step" and not case.line.fixed_length and case.moves:
        ratio = case.window / (2 * _contour(case))
        for name, criterion in (
            ("tail_jump", tail.jump_criterion),
            ("tail_mass", tail.tail_mass_criterion),
        ):
            if spec.effects.get(name) != "off":
                number = criterion(spec, scene)
                ratio = max(ratio, number.value / number.threshold)
    return Criterion(
        "u",
        ratio,
        1.0 + 1e-12,
        "window, impedance jump and tail mass relative to the limits of the closed form",
        "laws.wave",
    )


def _contour(case: StartCase) -> float:
    return 2 * case.line.contour_time


def _tau(case: StartCase) -> float:
    return case.line.drive_mass / case.line.impedance(CARRY)


TWO_INTERVAL: Solver[Conveyor, Start] = Solver(
    name="two_interval",
    title="closed-form waves of a uniform loop, two transit times",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Start}),
    represents=frozenset({"belt_wave"}),
    gives=AT_DRUM,
    run=run,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="derived in ptmcalc.laws.wave",
    valid=valid,
)
