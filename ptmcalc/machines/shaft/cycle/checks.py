"""Checks of the steady cycle: loss factor, speed fluctuation, motor torque."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor import InductionBase
from ptmcalc.contract.check import Check, Sense, needs, no_needs
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.shaft.machine.motor_keys import blame_motor, motor_that_can_vary
from ptmcalc.machines.shaft.machine.spec import Shaft, ShaftScene, Steady

Loads = Mapping[str, Estimate]
_BELOW_ONE = math.nextafter(1.0, 0.0)


def _motion_value(spec: Shaft, scene: Steady, loads: Loads) -> Estimate:
    """Loss factor of the cycle; a cycle with guaranteed motion has a loss factor below 1.

    An idling machine also has a loss factor of 1, and a machine driven by its load has none: both move.

    **Range** any machine.
    **Error** that of the load; none if the minimum speed of the cycle is above 0 for certain, or the motor stalls.
    **Source** the Poincare map of the cycle.
    """
    factor = loads["loss_factor"]
    if loads["speed_min"].low > 0:
        return Estimate.exact(min(factor.value, _BELOW_ONE))
    return factor


MOTION: Check[Shaft, Steady] = Check(
    code="SHF101",
    title="cycle loss factor",
    question="Can the motor drive the shaft through the whole cycle?",
    failure="motor stalls within the cycle",
    scenes=frozenset({Steady}),
    loads=("loss_factor", "speed_min"),
    value=_motion_value,
    sense=Sense.AT_MOST,
    limit=fixed(
        _BELOW_ONE,
        meaning="1: the loss factor stays below it",
        valid="any machine",
        source="lecture notes Kramatorsk, chapter 6: at 1 motion is impossible",
    ),
    needs=no_needs,
    blame=blame_motor,
    repair=motor_that_can_vary,
    what="The loss factor of the cycle is below 1. The motor drives the shaft through every angle of the cycle, and a"
    " periodic motion exists.",
    why="A machine whose motor stalls in the working stroke stops under load. The motor overheats in seconds.",
    formula="psi = A_loss/A_drive < 1;   a machine that stalls has psi = 1: nothing is useful",
    source="lecture notes Kramatorsk, chapter 6",
)


EVEN: Check[Shaft, Steady] = Check(
    code="SHF102",
    title="coefficient of speed fluctuation",
    question="Is the speed fluctuation of the steady cycle within its limit?",
    failure="shaft speed fluctuates too much",
    scenes=frozenset({Steady}),
    loads=("irregularity",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.irregularity",
        meaning="Permissible coefficient of speed fluctuation of the file",
        valid="1/5 to 1/30 for presses and pumps, 1/40 to 1/100 for machine tools and looms, 1/100 to 1/300 for"
        " generators",
        source="usual values of textbooks of the theory of machines",
    ),
    needs=needs(("checks", "irregularity")),
    blame=lambda spec, scene, loads: _inertia_key(spec),
    repair=lambda spec, scene: _inertia_key(spec) if spec.inertia.type != "table" else (),
    what="The coefficient of speed fluctuation of the main shaft over the steady cycle is at most the limit.",
    why="Speed fluctuation loads gear and motor. It impairs the work result and causes audible noise.",
    formula="(w_max - w_min)/w_mean <= delta",
    source="definition; limit by the machine manufacturer",
)


def _inertia_key(spec: Shaft) -> KeyPath:
    """The key that a flywheel would raise."""
    keys = {"constant": "value", "harmonics": "mean", "table": "points", "slider_crank": "crank_inertia"}
    return ("inertia", keys[spec.inertia.type])


def _heat_limit(spec: Shaft, scene: Steady) -> Estimate:
    """Rated torque of the motor.

    **Range** continuous-operation periodic duty S6 of IEC 60034-1: identical cycles without standstill.
    **Error** none: the rating.
    **Source** IEC 60034-1; `laws.duty.rms_torque`.
    """
    return Estimate.exact(spec.drive.motor.rated or math.inf)


def _rated_needs(spec: Shaft, scene: ShaftScene) -> tuple[KeyPath, ...]:
    return () if spec.drive.motor.rated is not None else (("drive", "motor", "rated_torque"),)


HEAT: Check[Shaft, Steady] = Check(
    code="SHF104",
    title="motor rms torque over the cycle",
    question="Is the rms motor torque within the rated torque?",
    failure="motor is thermally overloaded",
    scenes=frozenset({Steady}),
    loads=("torque_motor_rms",),
    sense=Sense.AT_MOST,
    limit=_heat_limit,
    needs=_rated_needs,
    blame=blame_motor,
    repair=motor_that_can_vary,
    what="The rms motor torque over the cycle is at most the rated torque.",
    why="The losses of a motor are proportional to the square of its torque. Above the rated torque, the insulation"
    " ages fast.",
    formula="sqrt(1/t integral of M^2 dt) <= M_rated",
    source="IEC 60034-1, duty S6",
)


def _overload_limit(spec: Shaft, scene: Steady) -> Estimate:
    """Permissible motor torque: the limit of the file, that of the converter, or a share of the breakdown torque.

        0.81 M_k:  the torque is proportional to the square of the voltage, and the voltage may be 10 % low

    **Range** induction motors by their breakdown torque; others by `largest_torque`.
    **Error** none: a chosen limit.
    **Source** IEC 60038: supply voltage within 10 %.
    """
    motor = spec.drive.motor
    limits = [motor.largest_torque or math.inf]
    if isinstance(motor, InductionBase):
        limits.append(spec.checks.breakdown_share * motor.breakdown_torque)
    return Estimate.exact(min(limits))


def _overload_needs(spec: Shaft, scene: ShaftScene) -> tuple[KeyPath, ...]:
    return () if isinstance(spec.drive.motor, InductionBase) else (("drive", "motor", "largest_torque"),)


OVERLOAD: Check[Shaft, Steady] = Check(
    code="SHF107",
    title="peak motor torque",
    question="Is the peak motor torque far enough below breakdown torque or overload limit?",
    failure="motor torque is too close to the breakdown torque",
    scenes=frozenset({Steady}),
    loads=("torque_motor_max",),
    sense=Sense.AT_MOST,
    limit=_overload_limit,
    needs=_overload_needs,
    blame=blame_motor,
    repair=motor_that_can_vary,
    what="The maximum motor torque over the cycle is at most the permissible share of the breakdown torque, or the"
    " overload limit.",
    why="A motor stalls beyond its breakdown torque. Close to the breakdown torque, a voltage dip of the mains also"
    " stalls it.",
    formula="max |M| <= 0.81 M_breakdown   or the overload limit of the file",
    source="IEC 60034-1 (overload); IEC 60038 (voltage)",
)

CHECKS_OF_CYCLE = (MOTION, EVEN, HEAT, OVERLOAD)
