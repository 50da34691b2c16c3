"""Steady running on the torque curves of the motors: reserve of all drives, torque of each motor over its rated one."""

from ptmcalc.base.memory import kept_for
from ptmcalc.base.span import KeyPath
from ptmcalc.components.steady_drive import Motors
from ptmcalc.components.steady_drive_checks import SteadyMotors, steady_loads, steady_solver
from ptmcalc.contract.result import Result
from ptmcalc.machines.conveyor.drives import running
from ptmcalc.machines.conveyor.resistances import filled
from ptmcalc.machines.conveyor.spec import Conveyor, ConveyorScene, Run, Start


@kept_for(64)
def motors_of(spec: Conveyor) -> dict[str, Motors]:
    """The motors of each drive; empty where one of them has no curve."""
    drives = spec.all_drives
    found = {
        name: Motors(
            curve=drive.motor.curve,
            count=drive.motor.count,
            turns=drive.gear.ratio / (drive.drum.diameter / 2),
            efficiency=filled(drive.gear.efficiency),
        )
        for name, drive in drives.items()
        if drive.motor.curve is not None
    }
    return found if len(found) == len(drives) else {}


def _resistance(spec: Conveyor, scene: ConveyorScene) -> float:
    line = running(spec, Run(load=scene.load))
    return line.static_resistance + line.tail_pull


def run(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> Result:
    """Torque reserve of all drives in steady running, and the driving or braking torque of each motor relative to its
    rated torque.

        steady_reserve = max of sum F(v) / W,   motor_utilisation = |M|/M_n

    A start is assessed for the steady running that follows it.

    **Range** motors with a curve; all drives at one belt speed.
    **Error** exact; with different curves one part in a million.
    **Source** derived: equilibrium on the torque curves (`components.steady_drive`).
    """
    return steady_loads(motors_of(spec), _resistance(spec, scene), spec.speed)


def _curve_key(spec: Conveyor, name: str) -> KeyPath:
    path = spec.drive_path(name) if name else spec.main_path
    return (*path, "motor", "curve")


MOTORS: SteadyMotors[Conveyor, ConveyorScene] = SteadyMotors(
    pulled="belt",
    several=True,
    motors=motors_of,
    curve_key=_curve_key,
    resistance=_resistance,
    run=Run,
    start=Start,
)
STEADY_DRIVE = steady_solver("steady_drive", MOTORS, run)
