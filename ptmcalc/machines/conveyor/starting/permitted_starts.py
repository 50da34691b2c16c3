"""Permitted starts per hour of the motors: given by the manufacturer, or no-load starts of the catalogue reduced by
inertia, load torque and load."""

from collections.abc import Iterable, Iterator

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components import motor_starts
from ptmcalc.components.motor_starts import no_load_speed
from ptmcalc.contract.check import AnyCheck, Check, Sense, blames, no_needs, no_repair
from ptmcalc.contract.result import Found, LoadInfo, of
from ptmcalc.machines.conveyor.machine.keys.drives import PlacedDrive
from ptmcalc.machines.conveyor.machine.load_sharing import steady_forces
from ptmcalc.machines.conveyor.machine.model import belt_line, turns
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import Start, steady
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import StartCase
from ptmcalc.machines.conveyor.starting.loads import slip_heat_of

PERMITTED = LoadInfo("starts_permitted", "permitted starts per hour of the motor", units.RATIO, headline=False)


def permitted_parts(spec: Conveyor) -> Iterator[LoadInfo]:
    """The load of each drive, where the file gives the starts of the conveyor or those of its motors."""
    yield from (PERMITTED.of(name) for name, drive in spec.all_drives.items() if _counts(spec, drive))


def _counts(spec: Conveyor, drive: PlacedDrive) -> bool:
    """Whether the file gives the starts of the conveyor, or those that the motors of a drive permit."""
    given = (spec.starts_per_hour, drive.motor.starts_per_hour, drive.motor.no_load_starts)
    return drive.converter is None and any(one is not None for one in given)


def permitted_starts(spec: Conveyor, scene: Start, case: StartCase) -> dict[str, Found]:
    """Permitted starts per hour of one motor of each drive that starts on the mains, for starts of a scene.

        Z = Z_0 k_P (J w_0^2/2)/Q

    Q is the rotor heat of the start, J w_0^2/2 that of the rotor alone. For a constant torque M_H of the motor and
    M_L of the load this is the rule of manufacturers:

        Z = Z_0 k_J k_M k_P,   k_J = J/(J + J_X),   k_M = 1 - M_L/M_H

    J_X: inertia of all that the motor moves besides its rotor, at its shaft.

    **Range** cage motors on the mains; starts at equal intervals, many in the time constant of the motor; the conveyor
    runs on between them.
    **Error** the bar of the rotor heat; catalogues read k_P from a chart.
    **Source** SEW-EURODRIVE, Manual Gear Units and Gearmotors, chapter Starting frequency; Bonfiglioli, catalogue A,
    section 5.6; k_P by `laws.duty.load_factor`, the rotor heat by CNV117.
    """
    found: dict[str, Found] = {}
    for name, drive in spec.all_drives.items() if not scene.profile.imposes_speed else ():
        given = drive.motor.starts_per_hour
        if drive.converter is not None or (given is None and missing_keys(spec, name)):
            continue
        permitted = Estimate.exact(given) if given is not None else _reduced(spec, scene, case, name)
        found[of(PERMITTED.name, name)] = Found(permitted)
    return found


def missing_keys(spec: Conveyor, name: str) -> tuple[KeyPath, ...]:
    """Keys without which the permitted starts of a drive are unknown."""
    drive = spec.all_drives[name]
    return motor_starts.missing_keys(drive.motor, (*spec.drive_path(name), "motor"), drive.fluid_coupling is not None)


def _reduced(spec: Conveyor, scene: Start, case: StartCase, name: str) -> Estimate:
    """No-load starts of the motors of a drive, reduced to the starts and the running of this conveyor."""
    motor = spec.all_drives[name].motor
    heat = slip_heat_of(spec, scene, case, name, filled(no_load_speed(motor)))
    return motor_starts.reduced_starts(motor, running_load(spec, scene, name), heat)


def running_load(spec: Conveyor, scene: Start, name: str) -> float:
    """Torque of one motor of a drive in the running that follows a start, over its rated torque [1]."""
    drive = spec.all_drives[name]
    force = steady_forces(spec, belt_line(spec, steady(scene)))[name]
    efficiency = filled(drive.gear.efficiency)
    torque = force * (efficiency if force < 0 else 1 / efficiency) / (drive.motor.count * turns(drive))
    return abs(torque) / filled(drive.motor.rated_torque)


def _limit(spec: Conveyor, scene: Start) -> Estimate:
    """Starts per hour of the conveyor.

    **Range** any start on the mains.
    **Error** none: a given value.
    **Source** the file.
    """
    return Estimate.exact(spec.starts_per_hour or 0.0)


def _checks(spec: Conveyor, scene: Start) -> Iterable[AnyCheck]:
    """One for each drive on the mains, where the file gives the starts of the conveyor or those of the motors."""
    for name, drive in spec.all_drives.items() if not scene.profile.imposes_speed else ():
        if not _counts(spec, drive):
            continue
        key: KeyPath = ("starts_per_hour",)
        missing = (*(() if spec.starts_per_hour is not None else (key,)), *missing_keys(spec, name))
        yield STARTS.of(name, _limit, key, missing, () if missing else key)


STARTS: Check[Conveyor, Start] = Check(
    code="CNV129",
    title="motor starts per hour, permitted",
    question="Do the motors permit the number of starts per hour?",
    failure="motor starts too often",
    scenes=frozenset({Start}),
    loads=(PERMITTED.name,),
    sense=Sense.AT_LEAST,
    limit=_limit,
    needs=no_needs,
    blame=blames("starts_per_hour"),
    repair=no_repair,
    each=_checks,
    what="The permitted starts per hour of each mains-fed motor are at least those of the conveyor. No-load starts of"
    " the catalogue are reduced by inertia, load torque and load.",
    why="Each start heats rotor and winding. Starts that follow before the motor has cooled overheat its insulation.",
    formula="Z_0 k_P (J w_0^2/2)/Q >= n",
    source="SEW-EURODRIVE, Manual Gear Units and Gearmotors, Starting frequency; Bonfiglioli, catalogue A, 5.6",
)
