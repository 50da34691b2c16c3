"""Motors: peak torque, heating, loads that overhaul them."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain
from ptmcalc.machines.drivetrain.motors.checks import CHECKS_OF_MOTORS
from ptmcalc.machines.drivetrain.motors.loads import LOADS_OF_MOTORS, parts

MOTORS: Topic[Drivetrain] = Topic(
    loads=LOADS_OF_MOTORS,
    parts=parts,
    checks=CHECKS_OF_MOTORS,
)
