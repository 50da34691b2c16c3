"""Checks of the motors: heating, overload, braking torque."""

import math
from collections.abc import Iterator

from ptmcalc.contract.check import Check, Sense, blames, no_needs, no_repair
from ptmcalc.contract.limits import fixed
from ptmcalc.machines.drivetrain.machine.judging import DRIVEN, NO_LIMIT, RUNNING, AnyCheck, exactly
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, TrainScene
from ptmcalc.machines.drivetrain.motors.overhauling import overhauled, path_of


def _heating_checks(spec: Drivetrain, scene: TrainScene) -> Iterator[AnyCheck]:
    for name, one in spec.motors.items():
        path = ("motors", name, "motor", "rated_torque")
        if one.motor.rated is None:
            yield HEATING.of(name, NO_LIMIT, ("motors", name, "motor"), needs=(path,))
        else:
            rated = one.count * one.motor.rated
            yield HEATING.of(name, exactly(rated), ("motors", name, "motor"))


HEATING: AnyCheck = Check(
    code="DRV105",
    title="motor rms torque",
    question="Is the rms torque of the cycle within the rated torque?",
    failure="motor is thermally overloaded",
    scenes=RUNNING,
    loads=("motor_torque_rms",),
    sense=Sense.AT_MOST,
    limit=fixed(
        math.inf,
        meaning="Rated torque of all motors of one name",
        valid="motors whose rated torque is given or follows from power and speed",
        source="IEC 60034-1: the rms torque of a cycle against the rated one, for motors with losses proportional to"
        " the square of the torque",
    ),
    needs=no_needs,
    blame=blames("motors"),
    repair=no_repair,
    each=_heating_checks,
    what="The rms motor torque over the cycle, which determines the heating, is at most the rated torque.",
    why="The losses are proportional to the square of the torque. The winding insulation ages with its temperature.",
    formula="sqrt(int M^2 dt/T) <= M_N,   T = checks.cycle_time, else the scene",
    source="IEC 60034-1; lecture notes Kramatorsk 2007",
)


def _overload_checks(spec: Drivetrain, scene: TrainScene) -> Iterator[AnyCheck]:
    for name, one in spec.motors.items():
        if one.motor.largest_torque is not None:
            most = one.count * one.motor.largest_torque
            path = ("motors", name, "motor", "largest_torque")
            yield OVERLOAD.of(name, exactly(most), path)


OVERLOAD: AnyCheck = Check(
    code="DRV106",
    title="motor peak torque",
    question="Is the peak motor torque within its overload limit?",
    failure="motor exceeds its overload limit",
    scenes=DRIVEN,
    loads=("motor_torque_peak",),
    sense=Sense.AT_MOST,
    limit=fixed(
        math.inf,
        meaning="Permissible short-time motor torque, given in the file",
        valid="motors with `largest_torque`",
        source="the manufacturer's overload limit",
    ),
    needs=no_needs,
    blame=blames("motors"),
    repair=no_repair,
    each=_overload_checks,
    what="The peak torque of every motor with `largest_torque` is at most this limit.",
    why="Above this limit, a motor stalls or its inverter trips.",
    formula="max |M(t)| <= M_max",
    source="the manufacturer's data",
)


_AT_LEAST_ALL = fixed(
    1.0,
    meaning="1: the braking torque of all motors is at least the overhauling torque",
    valid="motors driven by the load at their no-load speed",
    source="torque balance at steady speed",
)


def _braking_checks(spec: Drivetrain, scene: TrainScene) -> Iterator[AnyCheck]:
    """One for each part of the train whose motors a load drives."""
    for one in overhauled(spec, scene):
        path = path_of(spec, one.motor)
        yield BRAKES.of(one.motor, _AT_LEAST_ALL, path, repair=path if len(path) > _MOTOR_PATH else ())


_MOTOR_PATH = 2
"""Keys of the path to a motor, without the one that its torques are proportional to. A property of the file format: a
longer path can be changed by one factor."""
BRAKES: AnyCheck = Check(
    code="DRV111",
    hazard=True,
    title="motor braking torque reserve",
    question="Does the motor hold the overhauling load at its speed?",
    failure="load overcomes the braking torque of the motor",
    scenes=DRIVEN,
    loads=("braking_reserve",),
    sense=Sense.AT_LEAST,
    limit=_AT_LEAST_ALL,
    needs=no_needs,
    blame=blames("motors"),
    repair=no_repair,
    each=_braking_checks,
    what="The largest torque with which the motors brake above their no-load speed is at least the overhauling torque.",
    why="Beyond its largest braking torque the motor brakes less and less. The load runs away.",
    formula="M_brake/M_load >= 1",
    source="torque balance at steady speed; curve of the motor",
)

CHECKS_OF_MOTORS = (HEATING, OVERLOAD, BRAKES)
