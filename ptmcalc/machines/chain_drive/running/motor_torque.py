"""Steady running on the torque curve of the motors: their reserve, and their torque over the rated one."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.components.steady_drive import Motors, motor_torques, steady_reserve
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.chain_drive.model import chain_line, filled, mean_arm
from ptmcalc.machines.chain_drive.spec import ChainDrive, ChainScene, Run, Start


def motors_of(spec: ChainDrive) -> Motors | None:
    """The motors of the drive, where the file gives their curve."""
    drive = spec.drive
    if drive is None or drive.motor.curve is None:
        return None
    turns = drive.gear.ratio / mean_arm(spec)
    return Motors(drive.motor.curve, drive.motor.count, turns, filled(drive.gear.efficiency))


def run(spec: ChainDrive, scene: ChainScene, carried: frozenset[str], level: int) -> Result:
    """Torque reserve of the motors in steady running, and the driving or braking torque of each motor relative to its
    rated torque.

        steady_reserve = max of F(v) / W,   motor_utilisation = |M|/M_n

    A start is assessed for the steady running that follows it.

    **Range** motors with a curve.
    **Error** exact.
    **Source** derived: equilibrium on the torque curve (`components.steady_drive`).
    """
    motors = motors_of(spec)
    assert motors is not None, "`has_curve` is true"
    resistance = chain_line(spec, Run(load=scene.load)).static_resistance
    loads = {"steady_reserve": steady_reserve([motors], resistance, spec.speed)}
    if motors.curve.rated is not None:
        (torque,) = motor_torques([motors], resistance, spec.speed)
        loads["motor_utilisation"] = abs(torque) / motors.curve.rated
    return Result({name: Found(Estimate.exact(value)) for name, value in loads.items()}, work=1)


def has_curve(spec: ChainDrive, scene: ChainScene) -> Criterion:
    """Whether the motor has a curve: 0 where it has, else 1.

    **Range** any machine.
    **Error** exact.
    **Source** the file.
    """
    lacks = motors_of(spec) is None
    return Criterion("curve", float(lacks), 1.0, "0 if the file gives the motor a curve, otherwise 1", "the file")


STEADY_DRIVE: Solver[ChainDrive, ChainScene] = Solver(
    name="chain_steady_drive",
    title="steady running on the motor curve",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run, Start}),
    represents=frozenset(),
    gives=frozenset({"steady_reserve", "motor_utilisation"}),
    run=run,
    cost=lambda spec, scene, carried, level: 5e-3,
    valid=has_curve,
    source="equilibrium on the torque curve",
)
