"""Checks of motor and gear: starting torque, heating, gearbox, pinion."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, LimitState, Sense, at, blames, needs, no_needs, no_repair, only
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.judging import SLEWING, OneCheck, torque_key, torque_repair, turns
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane, SlewingScene

STALL: OneCheck = Check(
    code="CRN101",
    title="slewing starting torque reserve",
    question="Does the starting torque exceed friction, steady wind and slope with reserve?",
    failure="starting torque reserve is too small",
    limit_state=LimitState("slewing drive stalls", 1),
    scenes=SLEWING,
    loads=("starting_reserve",),
    sense=Sense.AT_LEAST,
    limit=key(
        "checks.starting_reserve",
        meaning="Minimum ratio of starting torque to steady slewing torque, 1.1 by default",
        valid="motors that start against friction, steady wind and slope",
        error="none: an engineering rule",
        source="handbooks of lifting machines",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: torque_key(spec, scene),
    repair=torque_repair,
    what="The starting torque at the slewing axis is at least the required multiple of the torque of friction, steady"
    " wind and slope. It is the minimum torque of the motor curve up to full speed, or the mean starting torque where"
    " no curve is given.",
    why="A motor torque below the resistance does not turn the crane. The motor stalls and overheats.",
    formula="M_m u eta/(M_fr + M_w) >= 1.1",
    source="balance of torques about the slewing axis; handbooks of lifting machines",
)


SPEED: OneCheck = only(lambda spec, scene: model.least_torque(spec, scene) is not None)(
    Check(
        code="CRN118",
        title="slewing torque reserve up to full speed",
        question="Does the motor curve stay above the steady slewing torque up to full speed?",
        failure="motor torque falls below the steady slewing torque",
        scenes=SLEWING,
        loads=("speed_reserve",),
        sense=Sense.AT_LEAST,
        limit=fixed(
            1.0,
            meaning="The steady slewing torque",
            valid="torque-speed curves, from standstill to the slewing speed",
            error="none: a balance of torques",
            source="balance of torques about the slewing axis",
        ),
        needs=no_needs,
        blame=blames("motor", "curve"),
        repair=no_repair,
        what="From standstill to the slewing speed, the torque of the motor curve is at least the torque of friction,"
        " steady wind and slope.",
        why="Where the curve falls below the resistance, the crane does not accelerate further. The mean of the curve"
        " does not show this.",
        formula="min M(w) u eta/(M_fr + M_w) >= 1",
        source="balance of torques about the slewing axis",
    )
)


def _rating(spec: SlewingCrane, scene: SlewingScene) -> KeyPath:
    return ("motor", *spec.motor.rating_key)


_ALL_OF_IT = fixed(
    1.0,
    meaning="The full rating",
    valid="ratings of the manufacturer",
    error="none: a definition",
    source="IEC 60034-1; catalogues",
)


HEATING: OneCheck = only(turns)(
    Check(
        code="CRN107",
        title="slewing motor thermal utilisation",
        question="Is the rms torque within the permissible torque at this duty factor?",
        failure="slewing motor is thermally overloaded",
        scenes=SLEWING,
        loads=("heating_utilisation",),
        sense=Sense.AT_MOST,
        limit=_ALL_OF_IT,
        needs=lambda spec, scene: () if spec.motor.rated is not None else (("motor", "rated_torque"),),
        blame=lambda spec, scene, loads: _rating(spec, scene),
        repair=_rating,
        what="Start and steady slewing heat the motor at most as much as its rated torque does at the duty factor of"
        " the cycle.",
        why="The life of the winding insulation halves with every 10 K of excess temperature.",
        formula="sqrt(sum M^2 t/sum t) <= M_N sqrt(B(ED_N)/B(ED))",
        source="IEC 60034-1",
    )
)


def _largest_torque(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Permissible short-time torque of all motors together.

    **Range** the manufacturer's overload limit.
    **Error** none: a given value.
    **Source** the manufacturer's data.
    """
    most = spec.motor.largest_torque
    return Estimate.exact(math.inf if most is None else spec.motor.count * most)


OVERLOAD: OneCheck = only(lambda spec, scene: spec.motor.largest_torque is not None)(
    Check(
        code="CRN108",
        title="slewing motor starting torque",
        question="Is the starting torque within the short-time overload limit of the motors?",
        failure="slewing motor is overloaded during the start",
        scenes=SLEWING,
        loads=("torque_motor_start",),
        sense=Sense.AT_MOST,
        limit=_largest_torque,
        needs=no_needs,
        blame=blames("motor", "largest_torque"),
        repair=at("motor", "largest_torque"),
        what="The motor torque in the start is at most the short-time overload torque of the motors.",
        why="A motor stalls beyond its breakdown torque.",
        formula="M_m <= M_max",
        source="the manufacturer's data",
    )
)


GEARBOX: OneCheck = only(lambda spec, scene: spec.gear.rated_torque is not None)(
    Check(
        code="CRN109",
        hazard=True,
        title="slewing gearbox equivalent torque",
        question="Is the equivalent input torque within the gearbox rating?",
        failure="slewing gearbox is overloaded",
        scenes=SLEWING,
        loads=("torque_worm",),
        sense=Sense.AT_MOST,
        limit=key(
            "gear.rated_torque",
            meaning="Rated torque of the gearbox at its input shaft, for its mechanism group",
            valid="the catalogue rating at the motor speed",
            error="none: a given value",
            source="the manufacturer's catalogue",
        ),
        needs=no_needs,
        blame=blames("gear", "rated_torque"),
        repair=at("gear", "rated_torque"),
        what="The equivalent torque of the gearbox is at most its rating. The equivalent torque causes the same"
        " fatigue as the cycle.",
        why="Pitting and wear of worm wheel teeth increase with the cube of their load.",
        formula="M_eq/(u eta) <= M_N",
        source="course notes on the slewing crane on a fixed column (3.5.2.13); Palmgren 1924, Miner 1945",
    )
)


PINION: OneCheck = only(lambda spec, scene: spec.gear.pinion_torque is not None)(
    Check(
        code="CRN116",
        hazard=True,
        title="slewing pinion equivalent torque",
        question="Is the equivalent torque of the open pinion within its rating?",
        failure="slewing pinion is overloaded",
        scenes=SLEWING,
        loads=("torque_pinion",),
        sense=Sense.AT_MOST,
        limit=key(
            "gear.pinion_torque",
            meaning="Permissible torque of the open pinion for its service life",
            valid="from the designer's calculation of the teeth",
            error="none: a given value",
        ),
        needs=needs(("gear", "open")),
        blame=blames("gear", "pinion_torque"),
        repair=at("gear", "pinion_torque"),
        what="The equivalent torque of the open pinion is at most its rating. The equivalent torque causes the same"
        " fatigue as the cycle.",
        why="The open stage carries the largest torque of the drive. It runs in dirt and without oil.",
        formula="M_eq/(u_o eta_o) <= M_p",
        source="course notes on the slewing crane on a fixed column (3.5.2.12)",
    )
)


def _driven_back(spec: SlewingCrane, scene: SlewingScene) -> bool:
    """Whether the crane drives a self-locking gear in the stop: against the brake on the motor, or blown by the wind
    before a brake on the crane has closed."""
    if spec.gear.back >= 0 or spec.brake is None:
        return False
    if spec.brake.shaft == "motor":
        return True
    return spec.brake.delay + spec.brake.rise_time > 0 and model.driving_wind(spec, scene) > spec.friction


LOCKS: OneCheck = only(_driven_back)(
    Check(
        code="CRN114",
        hazard=True,
        title="jam ratio of the self-locking gear",
        question="Is the rotor inertia large enough to prevent jamming of the self-locking gear during braking?",
        failure="self-locking gear jams during braking",
        scenes=SLEWING,
        loads=("gear_locks",),
        sense=Sense.AT_MOST,
        limit=_ALL_OF_IT,
        needs=no_needs,
        blame=blames("gear", "efficiency"),
        repair=no_repair,
        what="The rotor inertia of a self-locking drive is large enough for the rotor to decelerate together with the"
        " crane.",
        why="A crane that drives a self-locking worm gear stops at once. The impact loads gear, jib and load.",
        formula="-eta_r J/(J_1 u^2) <= 1",
        source="derived: laws.gearing.jams",
    )
)

CHECKS_OF_DRIVE = (STALL, SPEED, HEATING, OVERLOAD, GEARBOX, PINION, LOCKS)
