"""Checks of run-up and run-out: times and angles."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, LimitState, Sense, needs
from ptmcalc.contract.limits import key
from ptmcalc.machines.shaft.machine.motor_keys import blame_motor, motor_that_can_vary
from ptmcalc.machines.shaft.machine.spec import RunOut, RunUp, Shaft
from ptmcalc.machines.shaft.speed_changes.cases import is_braked
from ptmcalc.spec.scene import Scene

Loads = Mapping[str, Estimate]


RUN_UP: Check[Shaft, RunUp] = Check(
    code="SHF103",
    title="run-up time",
    question="Does the motor bring the shaft to speed within the limit?",
    failure="run-up takes too long",
    limit_state=LimitState("motor stalls in the run-up"),
    scenes=frozenset({RunUp}),
    loads=("run_up_time",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.run_up_time",
        meaning="Maximum run-up time of the file",
        valid="cage motors withstand 5 to 10 s of direct-on-line starting, see the manufacturer's catalogue",
        source="the design's own requirement",
    ),
    needs=needs(("checks", "run_up_time")),
    blame=blame_motor,
    repair=motor_that_can_vary,
    what="The motor accelerates the shaft from standstill to its speed within the maximum run-up time. A motor that"
    " stalls never reaches the speed.",
    why="A motor with a long run-up overheats. Its protection trips.",
    formula="t = integral of J dw/M <= limit",
    source="lecture notes Kramatorsk, chapter 6",
)


class _WhenBraked(Check[Shaft, RunOut]):
    """A check of a stop: a shaft that is left to coast keeps no limit."""

    def applies_to(self, scene: Scene) -> bool:
        return Check.applies_to(self, scene) and isinstance(scene, RunOut) and scene.brake != "off"


def _brake_key(spec: Shaft, scene: RunOut) -> KeyPath:
    return ("brake", "torque") if is_braked(spec, scene) else ("brake",)


def _blame_brake(spec: Shaft, scene: RunOut, loads: Loads) -> KeyPath:
    """The delay, where no brake would do; else the torque."""
    needed = loads.get("brake_torque_needed")
    if spec.brake is not None and needed is not None and math.isinf(needed.value):
        return ("brake", "delay")
    return _brake_key(spec, scene)


def _stop_repair(spec: Shaft, scene: RunOut) -> KeyPath:
    return ("brake", "torque") if spec.brake is not None else ()


STOP_ANGLE: Check[Shaft, RunOut] = _WhenBraked(
    code="SHF105",
    title="shaft stopping angle",
    question="Does the shaft stop within the permissible angle?",
    failure="shaft turns too far before it stops",
    scenes=frozenset({RunOut}),
    loads=("run_out_angle",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.stop_angle",
        meaning="Permissible stopping angle of the file",
        valid="for presses the angle permitted by safeguarding between the signal and the closing of the tool",
        source="the design's own requirement",
    ),
    needs=needs(("brake", "torque"), ("checks", "stop_angle")),
    blame=_blame_brake,
    repair=_stop_repair,
    what="With the drive off and the brake on, the stopping angle of the shaft is at most the limit. The stop begins"
    " at the stated angle, otherwise at the worst angle.",
    why="The shaft turns by this angle after the stop command. A larger angle endangers a hand in the machine.",
    formula="phi = integral of w dt from the command until w = 0;   T_0 = A_loss + A_brake",
    source="lecture notes Kramatorsk, chapter 6",
)
STOP_TIME: Check[Shaft, RunOut] = _WhenBraked(
    code="SHF106",
    title="shaft stopping time",
    question="Does the shaft stop within the limit?",
    failure="shaft takes too long to stop",
    scenes=frozenset({RunOut}),
    loads=("run_out_time",),
    sense=Sense.AT_MOST,
    limit=key(
        "checks.stop_time",
        meaning="Permissible stopping time of the file",
        valid="for a safeguard at a distance S from the tool at most S/(1.6 m/s) less its own response time",
        source="the design's own requirement; walking speed of 1.6 m/s from ISO 13855",
    ),
    needs=needs(("brake", "torque"), ("checks", "stop_time")),
    blame=_blame_brake,
    repair=_stop_repair,
    what="With the drive off and the brake on, the stopping time of the shaft is at most the limit. The stop begins at"
    " the stated angle, otherwise at the worst angle.",
    why="The stopping time determines the required distance of a safeguard.",
    formula="t from the command until w = 0",
    source="lecture notes Kramatorsk, chapter 6; ISO 13855 for what follows from the time",
)

CHECKS_OF_SPEED_CHANGES = (RUN_UP, STOP_ANGLE, STOP_TIME)
