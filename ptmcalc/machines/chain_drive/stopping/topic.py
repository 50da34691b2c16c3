"""Stopping and holding: stopping distance, brake torque, rollback torque."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.topic import Topic
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from ptmcalc.machines.chain_drive.stopping.checks import CHECKS_OF_STOPS
from ptmcalc.machines.chain_drive.stopping.formulas import SOLVERS_OF_STOPS

STOPPING: Topic[ChainDrive] = Topic(
    loads=(
        LoadInfo("stop_time", "stopping time", units.TIME, governing=True),
        LoadInfo("stop_distance", "stopping distance", units.SPAN, governing=True),
        LoadInfo("coast_distance", "coasting distance, no brake", units.SPAN, governing=True),
        LoadInfo("brake_torque_required", "required brake torque, motor shaft", units.TORQUE, governing=True),
        LoadInfo("tension_overload_braking", "chain tension added by braking", units.FORCE, governing=True),
        LoadInfo("backstop_torque", "rollback torque, sprocket shaft", units.TORQUE, governing=True),
        LoadInfo(
            "resistance_coefficient_identified", "resistance coefficient from coasting", units.RATIO, governing=True
        ),
    ),
    solvers=SOLVERS_OF_STOPS,
    checks=CHECKS_OF_STOPS,
)
