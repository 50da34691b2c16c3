"""Steady running on the torque curves of the motors: reserve of all drives, torque of each motor over its rated one."""

from ptmcalc.base.span import KeyPath
from ptmcalc.components.steady_drive_checks import SteadyMotors, steady_loads, steady_solver
from ptmcalc.contract.result import Result
from ptmcalc.machines.conveyor.machine.load_sharing import motors_of, steady_forces
from ptmcalc.machines.conveyor.machine.model import belt_line
from ptmcalc.machines.conveyor.machine.scenes import ConveyorScene, Run, Start, steady
from ptmcalc.machines.conveyor.machine.spec import Conveyor


def _resistance(spec: Conveyor, scene: ConveyorScene) -> float:
    return belt_line(spec, steady(scene)).static_resistance


def run(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> Result:
    """Torque reserve of all drives in steady running, and the driving or braking torque of each motor relative to its
    rated torque.

        steady_reserve = max of sum F(v) / W,   motor_utilisation = |M|/M_n

    A start is assessed for the steady running that follows it.

    **Range** motors with a curve; the reserve is that of all drives at one belt speed.
    **Error** exact; with different curves one part in a million.
    **Source** derived: equilibrium on the torque curves (`components.steady_drive`, `load_sharing.steady_forces`).
    """
    line = belt_line(spec, steady(scene))
    return steady_loads(motors_of(spec), line.static_resistance, spec.speed, steady_forces(spec, line))


def _curve_key(spec: Conveyor, name: str) -> KeyPath:
    path = spec.drive_path(name) if name else spec.main_path
    return (*path, "motor", spec.value_at(path).motor.curve_key)


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
