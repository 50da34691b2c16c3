"""Steady running on the torque curves of the motors: reserve of all drives, torque of each motor over its rated one."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.memory import kept_for
from ptmcalc.components.steady_drive import Motors, motor_torques, steady_reserve
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result, of
from ptmcalc.contract.solver import Fidelity, Solver
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


def run(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> Result:
    """Torque reserve of all drives in steady running, and the driving or braking torque of each motor relative to its
    rated torque.

        steady_reserve = max of sum F(v) / W,   motor_utilisation = |M|/M_n

    A start is assessed for the steady running that follows it.

    **Range** motors with a curve; all drives at one belt speed.
    **Error** exact; with different curves one part in a million.
    **Source** derived: equilibrium on the torque curves (`components.steady_drive`).
    """
    motors = motors_of(spec)
    line = running(spec, Run(load=scene.load))
    resistance = line.static_resistance + line.tail_pull
    loads = {"steady_reserve": steady_reserve(list(motors.values()), resistance, spec.speed)}
    torques = motor_torques(list(motors.values()), resistance, spec.speed)
    for (name, one), torque in zip(motors.items(), torques, strict=True):
        if one.curve.rated is not None:
            loads[of("motor_utilisation", name)] = abs(torque) / one.curve.rated
    return Result({name: Found(Estimate.exact(value)) for name, value in loads.items()}, work=1)


def has_curve(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Whether each motor has a curve: 0 where it has, else 1.

    **Range** any machine.
    **Error** exact.
    **Source** the file.
    """
    lacks = not motors_of(spec)
    return Criterion("curve", float(lacks), 1.0, "0 if the file gives each motor a curve, otherwise 1", "the file")


STEADY_DRIVE: Solver[Conveyor, ConveyorScene] = Solver(
    name="steady_drive",
    title="steady running on the motor curves",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run, Start}),
    represents=frozenset(),
    gives=frozenset({"steady_reserve", "motor_utilisation"}),
    run=run,
    cost=lambda spec, scene, carried, level: 5e-3,
    valid=has_curve,
    source="equilibrium on the torque curves",
)
