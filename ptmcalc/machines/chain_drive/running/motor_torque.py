"""Steady running on the torque curve of the motors: their reserve, and their torque over the rated one."""

from ptmcalc.components.steady_drive import Motors
from ptmcalc.components.steady_drive_checks import SteadyMotors, steady_loads, steady_solver
from ptmcalc.contract.result import Result
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout
from ptmcalc.machines.chain_drive.machine.model import chain_line, drive_of, filled, mean_arm
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, ChainScene, Run, Start


def motors_of(spec: ChainDrive) -> dict[str, Motors]:
    """The motors of the drive, where the file gives their curve."""
    drive = spec.drive
    curve = drive.running_curve if drive is not None else None
    if drive is None or curve is None:
        return {}
    turns = drive.gear.ratio / mean_arm(spec)
    return {"": Motors(curve, drive.motor.count, turns, filled(drive.gear.efficiency))}


def _resistance(spec: ChainDrive, scene: ChainScene) -> float:
    """What all motors would pull if each pulled as the most loaded one [N]."""
    return most_loaded(spec) * chain_line(spec, Run(load=scene.load)).static_resistance


def most_loaded(spec: ChainDrive) -> float:
    """Load of the most loaded motor over the mean of all, where the share of a driven tail makes them unequal.

        u = min over k of max(s N/k, (1 - s) N/(N - k)),   k = 1 ... N - 1

    **Range** N equal motors, of which the tail has as many as its share s calls for; 1 where one motor stands for both
    drives, or without a driven tail.
    **Error** exact.
    **Source** equilibrium of both sprockets.
    """
    count = spec.drive.motor.count if spec.drive is not None else 1
    if not isinstance(spec.layout, ConveyorLayout) or spec.layout.tail.driven == "off" or count == 1:
        return 1.0
    share = filled(spec.layout.tail.share)
    return count * min(max(share / k, (1 - share) / (count - k)) for k in range(1, count))


def run(spec: ChainDrive, scene: ChainScene, carried: frozenset[str], level: int) -> Result:
    """Torque reserve of the motors in steady running, and the driving or braking torque of each motor relative to its
    rated torque.

        steady_reserve = max of F(v) / (u W),   motor_utilisation = |M|/M_n,   M of the most loaded motor

    A start is assessed for the steady running that follows it. u is 1 without a driven tail (`most_loaded`).

    **Range** motors with a curve; with a driven tail all motors are equal.
    **Error** exact.
    **Source** derived: equilibrium on the torque curve (`components.steady_drive`).
    """
    return steady_loads(motors_of(spec), _resistance(spec, scene), spec.speed)


MOTORS: SteadyMotors[ChainDrive, ChainScene] = SteadyMotors(
    pulled="chain",
    several=False,
    motors=motors_of,
    curve_key=lambda spec, name: ("drive", "motor", drive_of(spec).motor.curve_key),
    resistance=_resistance,
    run=Run,
    start=Start,
)
STEADY_DRIVE = steady_solver("chain_steady_drive", MOTORS, run)
