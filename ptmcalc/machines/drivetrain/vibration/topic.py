"""Vibration: natural frequencies, distance of excitations from resonance."""

from ptmcalc.contract.topic import Topic
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain
from ptmcalc.machines.drivetrain.vibration.checks import RESONANCE
from ptmcalc.machines.drivetrain.vibration.loads import LOADS_OF_VIBRATION, parts
from ptmcalc.machines.drivetrain.vibration.modal import MODAL

VIBRATION: Topic[Drivetrain] = Topic(
    loads=LOADS_OF_VIBRATION,
    parts=parts,
    solvers=(MODAL,),
    checks=(RESONANCE,),
)
