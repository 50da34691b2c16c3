"""The checks of a hoist's drive in even motion: what lifts, what heats, what holds."""

from collections.abc import Iterable
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor_rating import braking_number_at, number_at
from ptmcalc.components.motor_torque import carrying_speed
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, at, blames, needs, no_needs, no_repair, only
from ptmcalc.contract.limits import fixed, key
from ptmcalc.laws import hoist_class
from ptmcalc.machines.hoist.drive import torques
from ptmcalc.machines.hoist.machine.model import loaded
from ptmcalc.machines.hoist.machine.spec import EmergencyStop, Hoist, HoistScene, LowerBrake, Run, Start, Stop

OneCheck = Check[Hoist, Run]
RUNNING = frozenset({Run})


def _driven(spec: Hoist, scene: HoistScene) -> bool:
    return loaded(spec, scene) and spec.motor is not None


def _on_duty(spec: Hoist, scene: HoistScene) -> bool:
    return _driven(spec, scene) and spec.duty is not None


def _torque_key(spec: Hoist, scene: Run) -> KeyPath:
    """What says how strongly the motor starts."""
    motor = spec.motor
    if motor is None or motor.mean_starting_torque is not None:
        return ("motor", "mean_starting_torque")
    return ("motor", "largest_starting_torque" if motor.largest_starting_torque is not None else "curve")


def _torque_repair(spec: Hoist, scene: Run) -> KeyPath:
    return curve_number(spec, _torque_key(spec, scene))


def curve_number(spec: Hoist, path: KeyPath) -> KeyPath:
    """The number that a key of the motor stands for: of its curve, the one that all its torques grow with."""
    motor = spec.motor
    return () if motor is None else number_at(path, motor.curve, rated=motor.power is not None)


def _raised(spec: Hoist, scene: HoistScene) -> bool:
    return _driven(spec, scene) and not (isinstance(scene, Start) and scene.direction == "down")


WEAK: OneCheck = only(_raised)(
    Check(
        code="HST114",
        hazard=True,
        title="starting torque reserve, lower limit",
        question="Does the starting torque exceed the load torque with reserve?",
        failure="starting torque reserve is too small",
        limit_state=LimitState("hoist motor stalls", 1),
        scenes=frozenset({Run, Start}),
        loads=("starting_reserve",),
        sense=Sense.AT_LEAST,
        limit=key(
            "checks.motor_reserve",
            meaning="Minimum ratio of mean starting torque to load torque, 1.4 by default",
            valid="motors that start with the suspended load",
            error="none: an engineering rule; FEM 9.683 requires 1.4 to 1.6, depending on the type of motor",
            source="handbooks of lifting machines",
        ),
        needs=needs(("gearbox",)),
        blame=lambda spec, scene, loads: _torque_key(spec, scene),
        repair=_torque_repair,
        what="The mean starting torque is at least the required reserve times the torque of the suspended load with"
        " losses. If the torque curve is below the load torque at any speed, its minimum counts instead.",
        why="A motor without reserve does not lift the suspended load. It stalls, overheats, or lets the load descend.",
        formula="M_mean/(M_d/(u eta)) >= 1.4",
        source="power balance of the gearbox; handbooks of lifting machines",
    )
)


EXCESS: OneCheck = only(_driven)(
    Check(
        code="HST115",
        title="starting torque reserve, upper limit",
        question="Is the mean starting torque within its upper limit?",
        failure="starting torque is too high for the load",
        scenes=RUNNING,
        loads=("starting_reserve",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.motor_excess",
            meaning="Maximum ratio of mean starting torque to load torque, 4 by default",
            valid="any motor",
            error="none: an engineering rule; 1.6 to 2.5 is usual",
            source="handbooks of lifting machines",
        ),
        needs=needs(("gearbox",)),
        blame=lambda spec, scene, loads: _torque_key(spec, scene),
        repair=_torque_repair,
        what="The mean starting torque is at most the limit times the load torque, 4 times by default.",
        why="The excess torque of the motor loads rope, gearbox and bridge at every start.",
        formula="M_mean/(M_d/(u eta)) <= 4",
        source="handbooks of lifting machines",
    )
)


def _heating_needs(spec: Hoist, scene: Run) -> tuple[KeyPath, ...]:
    known = spec.motor is not None and spec.motor.rated is not None
    return (("gearbox",),) if known else (("gearbox",), ("motor", "rated_torque"))


def _rating(spec: Hoist, scene: Run) -> KeyPath:
    return ("motor", *(spec.motor.rating_key if spec.motor is not None else ("rated_torque",)))


HEATING: OneCheck = only(_on_duty)(
    Check(
        code="HST116",
        title="hoist motor thermal utilisation",
        question="Is the rms torque within the permissible torque at this duty factor?",
        failure="hoist motor is thermally overloaded",
        scenes=RUNNING,
        loads=("heating_utilisation",),
        sense=Sense.AT_MOST,
        limit=fixed(
            1.0,
            meaning="The full rating at the duty factor of the file",
            valid="ratings at another duty factor are converted with the cooling of the motor at standstill",
            error="none: a definition",
            source="IEC 60034-1; `laws.duty.permissible_torque`",
        ),
        needs=_heating_needs,
        blame=lambda spec, scene, loads: _rating(spec, scene),
        repair=_rating,
        what="The rms torque of hoisting and lowering the load spectrum is at most the permissible torque at this duty"
        " factor. It includes the starts if the duty type counts them.",
        why="Every ten degrees of temperature rise halve the life of the winding insulation.",
        formula="sqrt(sum M^2 t/sum t) <= M_N sqrt(B(ED_N)/B(ED))",
        source="IEC 60034-1",
    )
)


def _starts_wanted(spec: Hoist, scene: HoistScene) -> bool:
    return _on_duty(spec, scene) and spec.duty is not None and spec.duty.starts_per_hour is not None


STARTS: OneCheck = only(_starts_wanted)(
    Check(
        code="HST117",
        title="hoist motor starts per hour",
        question="Is the number of starts per hour within the motor rating?",
        failure="hoist motor starts too often",
        scenes=RUNNING,
        loads=("starts_per_hour",),
        sense=Sense.AT_MOST,
        limit=key(
            "motor.starts_per_hour",
            meaning="Permitted starts per hour of the manufacturer",
            valid="motors that are switched on and off; 150, 300 and 600 per hour are usual",
            error="none: a given value",
            source="the manufacturer's data",
        ),
        needs=needs(("motor", "starts_per_hour")),
        blame=blames("duty", "starts_per_hour"),
        repair=at("duty", "starts_per_hour"),
        what="The number of motor starts per hour is at most the manufacturer's limit.",
        why="Each start heats the rotor and wears brake and contactor.",
        formula="Z <= Z_max",
        source="the manufacturer's data; IEC 60034-1, duty types S4 and S5",
    )
)


def _brake_limit(spec: Hoist, scene: Run) -> Estimate:
    """Minimum ratio of brake torque to load torque: by the group, or from the file; 1.5 without a group.

    **Range** holding brakes of hoists: 1.5 up to M4, 1.75 in M5, 2 in M6, 2.5 in M7 and M8.
    **Error** none: a table, to be confirmed; national rules differ.
    **Source** eastern European crane rules, quoted from handbooks.
    """
    asked, group = spec.checks.brake_reserve, spec.classes.mechanism
    return Estimate.exact(asked if asked is not None else hoist_class.BRAKE_RESERVE[group or "M1"])


def _brake_wanted(spec: Hoist, scene: HoistScene) -> bool:
    return loaded(spec, scene) and (spec.brake is not None or spec.motor is not None)


def _brake_needs(spec: Hoist, scene: Run) -> tuple[KeyPath, ...]:
    if spec.brake is None:
        return (("brake",),)
    return (("gearbox",),) if spec.brake.shaft == torques.MOTOR_SHAFT else ()


BRAKE: OneCheck = only(_brake_wanted)(
    Check(
        code="HST118",
        hazard=True,
        title="hoist brake holding torque reserve",
        question="Does the brake torque exceed the load torque with the required reserve?",
        failure="holding torque reserve of the brake is too small",
        limit_state=LimitState("load drops with the brake applied", 1),
        scenes=frozenset({Run, Stop, LowerBrake, EmergencyStop}),
        loads=("brake_reserve_static",),
        sense=Sense.AT_LEAST,
        limit=_brake_limit,
        needs=_brake_needs,
        blame=blames("brake", "torque"),
        repair=at("brake", "torque"),
        what="The torque of the closed brake is at least the group reserve times the torque of the lowering load on"
        " its shaft. The losses reduce this load torque. The load `drop_distance` states the distance that the"
        " load falls if the brake does not hold it.",
        why="Heat, wear and moisture reduce the brake torque. A brake without reserve then drops the load.",
        formula="M_B/(S R n eta_r/u) >= 1.5 to 2.5",
        source="power balance of the gearbox; rules for cranes, quoted from handbooks",
    )
)


def _heat_wanted(spec: Hoist, scene: HoistScene) -> bool:
    return _driven(spec, scene) and spec.motor is not None and spec.motor.start_heat is not None


START_HEAT: OneCheck = only(_heat_wanted)(
    Check(
        code="HST119",
        title="rotor heat per hoist start",
        question="Is the rotor heat of a start within the data-sheet value?",
        failure="rotor heat of the start exceeds the data-sheet value",
        scenes=RUNNING,
        loads=("start_heat",),
        sense=Sense.AT_MOST,
        limit=key(
            "motor.start_heat",
            meaning="Permissible rotor heat per start, from the data sheet",
            valid="motors with the slip losses inside the rotor",
            error="none: a given value",
            source="the manufacturer's data",
        ),
        needs=needs(("gearbox",), ("motor", "no_load_speed")),
        blame=blames("motor", "start_heat"),
        repair=at("motor", "start_heat"),
        what="The rotor heat of a start with the suspended load is at most the data-sheet value.",
        why="In a start, the rotor of a cage motor absorbs at least the energy that the moving masses receive. Excess"
        " heat damages the rotor.",
        formula="J w_0^2/2/(1 - M_load/M_mean) <= A",
        source="energy of the slip; the manufacturer's data",
    )
)


def _lowered(spec: Hoist, scene: HoistScene) -> bool:
    """Whether a motor with a curve lowers a load."""
    lowers = isinstance(scene, Run) or (isinstance(scene, Start) and scene.direction == "down")
    return lowers and spec.motor is not None and spec.motor.curve is not None


def _braking_repair(spec: Hoist, scene: Run) -> KeyPath:
    motor = spec.motor
    return () if motor is None else braking_number_at(("motor", "curve"), motor.curve, rated=motor.power is not None)


OVERHAULED: OneCheck = only(_lowered)(
    Check(
        code="HST127",
        hazard=True,
        title="motor braking torque reserve",
        question="Does the motor hold the overhauling load at its speed?",
        failure="load overcomes the braking torque of the motor",
        scenes=frozenset({Run, Start}),
        loads=("overhauling_reserve",),
        sense=Sense.AT_LEAST,
        limit=fixed(
            1.0,
            meaning="1: the braking torque of the motors is at least the torque of the lowered load",
            valid="motors with a curve in the file",
            error="none: an equilibrium",
            source="balance of torques on the motor shaft",
        ),
        needs=needs(("gearbox",)),
        blame=blames("motor", "curve"),
        repair=_braking_repair,
        what="The maximum braking torque of the motor curve above its no-load speed is at least the torque of the"
        " lowered load on the motor shaft. The losses reduce this load torque.",
        why="A load that exceeds the braking torque accelerates the motor without limit. The drum and the rotor"
        " overspeed, and the brake may not stop the load.",
        formula="M_b/(M_d eta_r/u) >= 1",
        source="balance of torques on the motor shaft; power balance of the gearbox",
    )
)


def _overspeed_limit(spec: Hoist, scene: HoistScene) -> Estimate:
    """Permissible motor speed: the ratio of the file, 1.2 by default, times the rated speed of the motor.

    **Range** motors of IEC 60034-1; the rated speed of the motor, of its curve, or that of the main speed.
    **Error** none: a chosen limit, to be compared with the standard and the data sheet.
    **Source** IEC 60034-1, overspeed of 1.2 times the highest rated speed for 2 min.
    """
    return Estimate.exact(spec.checks.overspeed * torques.rated_speed(spec))


def _where_fast(spec: Hoist, scene: HoistScene) -> Iterable[AnyCheck]:
    """In a run on the curve, which lowers."""
    curve = spec.motor.curve if spec.motor is not None and spec.gearbox is not None else None
    known = curve is not None and carrying_speed(curve, 0.0) is not None
    return (replace(OVERSPEED, each=None),) if known else ()


OVERSPEED: Check[Hoist, HoistScene] = Check(
    code="HST132",
    hazard=True,
    title="motor overspeed",
    question="Does the motor stay below its maximum speed while the load drives it?",
    failure="load drives the motor above its maximum speed",
    limit_state=LimitState("load drives the motor without limit"),
    scenes=frozenset({Run}),
    loads=("lowering_speed",),
    sense=Sense.AT_MOST,
    limit=_overspeed_limit,
    needs=no_needs,
    blame=blames("motor", "curve"),
    repair=no_repair,
    each=_where_fast,
    what="The motor speed of steady lowering on the motor curve is at most 1.2 times the rated speed, or the ratio of"
    " the file.",
    why="Centrifugal forces grow with the square of the speed. Rotor windings, fans and couplings fail.",
    formula="w_max <= 1.2 w_n",
    source="IEC 60034-1, to be compared with the standard; motion of the rigid drive",
)

EMERGENCY_OVERSPEED: Check[Hoist, HoistScene] = replace(
    OVERSPEED,
    code="HST136",
    title="motor overspeed, emergency stop",
    question="Does the brake act before the load drives the motor above its maximum speed?",
    scenes=frozenset({EmergencyStop}),
    loads=("emergency_speed_max",),
    blame=blames("brake", "delay"),
    each=None,
    what="The motor speed of an emergency stop, until the brake acts, is at most 1.2 times the rated speed, or the"
    " ratio of the file.",
)

CHECKS_OF_DRIVE: tuple[AnyCheck, ...] = (
    WEAK,
    EXCESS,
    HEATING,
    STARTS,
    BRAKE,
    START_HEAT,
    OVERHAULED,
    OVERSPEED,
    EMERGENCY_OVERSPEED,
)
