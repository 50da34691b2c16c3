"""The checks of a travel drive: what starts, what holds in the wind, what heats; and the class of the crane."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor_rating import braking_number_at
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, at, blames, needs, no_needs, no_repair, only
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.crane.travelling.machine.judging import (
    RUNNING,
    STARTS,
    Loads,
    OneCheck,
    torque_key,
    torque_repair,
)
from ptmcalc.machines.crane.travelling.machine.scenes import Run, Start, TravelScene
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.statics import drive


def _loaded(spec: Travelling, scene: TravelScene) -> bool:
    return scene.load == "full"


def _torque(spec: Travelling, scene: TravelScene, loads: Loads) -> KeyPath:
    return torque_key(spec)


STALL: OneCheck = Check(
    code="CRN160",
    title="travel starting torque reserve",
    question="Does the starting torque exceed the steady travel torque with reserve?",
    failure="starting torque reserve is too small",
    limit_state=LimitState("travel motors stall", 1),
    scenes=frozenset({Run, Start}),
    loads=("starting_reserve",),
    sense=Sense.AT_LEAST,
    limit=key(
        "checks.motor_reserve",
        meaning="Minimum ratio of the lowest starting torque up to full speed to the steady travel torque, 1.1 by"
        " default",
        valid="any drive that starts against wind and slope",
        error="none: an engineering rule",
        source="handbooks of lifting machines",
    ),
    needs=no_needs,
    blame=_torque,
    repair=torque_repair,
    what="The starting torque is at least the required multiple of the steady travel torque against friction, slope and"
    " the wind in which the crane works. It is the minimum torque of the motor curve up to full speed, or the mean"
    " starting torque where no curve is given. The smallest torque of a rheostat start counts where the file gives it.",
    why="A motor torque below the resistance does not move the crane. The motor stalls and overheats.",
    formula="min M(n)/(W r/(u eta)) >= 1.1",
    source="power balance of the gear; handbooks of lifting machines",
)


AGAINST_WIND: OneCheck = only(lambda spec, scene: spec.wind is not None)(
    Check(
        code="CRN161",
        title="travel drive reserve against wind",
        question="Can the starting torque drive the crane against the maximum in-service wind?",
        failure="drive reserve against in-service wind is too small",
        limit_state=LimitState("travel motors cannot drive against the in-service wind", 1),
        scenes=RUNNING,
        loads=("wind_reserve",),
        sense=Sense.AT_LEAST,
        limit=fixed(
            1.0,
            meaning="1: the motors hold the crane against the wind",
            valid="cranes in the wind",
            error="none: an equilibrium",
            source="EN 13001-2, ISO 4302: maximum in-service wind",
        ),
        needs=no_needs,
        blame=_torque,
        repair=torque_repair,
        what="The motor force at the driven wheels is at least the resistance up the slope against the maximum"
        " in-service wind. It is that of the minimum torque of the motor curve up to full speed, or of the mean"
        " starting torque where no curve is given.",
        why="A crane that the wind holds or drives does not reach its parking position.",
        formula="M u eta/r >= w G + G sin(alpha) + q_max c A",
        source="balance of forces; winds of EN 13001-2 and ISO 4302",
    )
)


def _driven(spec: Travelling, scene: TravelScene) -> bool:
    """Whether wind or slope, stronger than the resistance of the wheels, drive motors with a curve."""
    reserve = drive.braking_reserve(spec, scene)
    return reserve is not None and math.isfinite(reserve)


def _braking_repair(spec: Travelling, scene: TravelScene) -> KeyPath:
    motor = spec.drive.motor
    return braking_number_at(("drive", "motor", "curve"), motor.curve, rated=motor.power is not None)


OVERHAULED: OneCheck = only(_driven)(
    Check(
        code="CRN165",
        hazard=True,
        title="motor braking torque reserve",
        question="Do the motors hold the overhauling crane at its speed?",
        failure="wind or slope overcomes the braking torque of the motors",
        scenes=RUNNING | STARTS,
        loads=("overhauling_reserve",),
        sense=Sense.AT_LEAST,
        limit=fixed(
            1.0,
            meaning="1: the braking torque of the motors is at least the overhauling torque of wind and slope",
            valid="motors with a curve in the file",
            error="none: an equilibrium",
            source="balance of torques on the motor shaft",
        ),
        needs=no_needs,
        blame=blames("drive", "motor", "curve"),
        repair=_braking_repair,
        what="The maximum braking torque of the motor curves above the no-load speed is at least the overhauling torque"
        " of wind and slope on the motor shaft. Wheel resistance and gear losses reduce the overhauling torque. Steady"
        " travel takes the maximum in-service wind from behind and the slope down.",
        why="A crane that exceeds the braking torque of its motors accelerates without limit. The rotors overspeed, and"
        " the stopping distance grows with the square of the speed.",
        formula="n M_b/((q c A + G sin(alpha) - w G) r eta_r/u) >= 1",
        source="balance of forces; power balance of the gear",
    )
)


def _on_duty(spec: Travelling, scene: TravelScene) -> bool:
    return _loaded(spec, scene) and spec.duty is not None


def _rating(spec: Travelling) -> KeyPath:
    return ("drive", "motor", *spec.drive.motor.rating_key)


def _heat_needs(spec: Travelling, scene: TravelScene) -> tuple[KeyPath, ...]:
    return () if spec.drive.motor.rated is not None else (("drive", "motor", "rated_torque"),)


HEAT: OneCheck = only(_on_duty)(
    Check(
        code="CRN162",
        title="travel motor thermal utilisation",
        question="Is the rms torque within the permissible torque at this duty factor?",
        failure="travel motors are thermally overloaded",
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
        needs=_heat_needs,
        blame=lambda spec, scene, loads: _rating(spec),
        repair=lambda spec, scene: _rating(spec),
        what="The equivalent torque of the motor cycle, with the same heating, is at most the permissible torque at"
        " this duty factor.",
        why="Every 10 K of excess temperature halves the life of the insulation.",
        formula="M_rms = sqrt(sum M_i^2 t_i/sum t_i) <= M_n sqrt(B(ED_n)/B(ED))",
        source="IEC 60034-1",
    )
)


def _counts_starts(spec: Travelling, scene: TravelScene) -> bool:
    return _on_duty(spec, scene) and spec.duty is not None and spec.duty.starts_per_hour is not None


STARTS_PER_HOUR: OneCheck = only(_counts_starts)(
    Check(
        code="CRN163",
        title="travel motor starts per hour",
        question="Is the number of starts per hour within the motor rating?",
        failure="travel motors start too often",
        scenes=RUNNING,
        loads=("starts_per_hour",),
        sense=Sense.AT_MOST,
        limit=key(
            "drive.motor.starts_per_hour",
            meaning="Permitted starts per hour of the manufacturer",
            valid="any motor",
            error="none: a limit of the file",
            source="the manufacturer of the motor",
        ),
        needs=needs(("drive", "motor", "starts_per_hour")),
        blame=blames("duty", "starts_per_hour"),
        repair=at("duty", "starts_per_hour"),
        what="The number of motor starts per hour is at most the rating of the manufacturer.",
        why="Each start dissipates in the rotor an energy equal to the kinetic energy of all moving masses.",
        formula="z <= z_0",
        source="the manufacturer of the motor; IEC 60034-1",
    )
)


def _group_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Crane group declared in the file.

    **Range** A1 to A8.
    **Error** none: a class.
    **Source** the file.
    """
    group = spec.classes.crane
    return Estimate.exact(math.inf if group is None else float(group[1:]))


def _classed(spec: Travelling, scene: TravelScene) -> bool:
    return _on_duty(spec, scene) and spec.duty is not None and spec.duty.cycles is not None


CLASS: OneCheck = only(_classed)(
    Check(
        code="CRN164",
        title="required crane group",
        question="Is the group required by cycles and load spectrum covered by the declared group?",
        failure="duty requires a higher crane group than declared",
        scenes=RUNNING,
        loads=("crane_group",),
        sense=Sense.AT_MOST,
        limit=_group_limit,
        needs=needs(("class", "crane")),
        blame=blames("class", "crane"),
        repair=no_repair,
        what="The crane group required by cycles and load spectrum (ISO 4301-1) is at most the declared group.",
        why="Structure and mechanisms are verified for the life of the declared group.",
        formula="A = U + Q - 2,   Q by k_p = sum (C_i/C_T) (P_i/P_max)^3",
        source="ISO 4301-1",
    )
)

CHECKS_OF_DRIVE: tuple[AnyCheck, ...] = (STALL, AGAINST_WIND, OVERHAULED, HEAT, STARTS_PER_HOUR, CLASS)
