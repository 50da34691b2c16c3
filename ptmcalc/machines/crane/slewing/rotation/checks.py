"""Checks of start and stop: times and angles."""

from ptmcalc.contract.check import Check, LimitState, Sense, at, blames, needs, no_needs, only
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.crane.slewing.machine.judging import (
    SLEWING,
    OneCheck,
    reaches,
    starts,
    torque_key,
    torque_repair,
    turns,
)

SLOW: OneCheck = only(reaches)(
    Check(
        code="CRN102",
        title="maximum slewing start time",
        question="Does the crane reach its slewing speed within the limit?",
        failure="slewing start takes too long",
        limit_state=LimitState("slewing drive stalls"),
        scenes=SLEWING,
        loads=("start_time",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.start_time",
            meaning="Maximum starting time, 10 s by default",
            valid="slewing cranes in service",
            error="none: an engineering rule; 4 to 10 s are usual",
            source="handbooks of lifting machines",
        ),
        needs=no_needs,
        blame=lambda spec, scene, loads: torque_key(spec, scene),
        repair=torque_repair,
        what="The crane reaches its slewing speed within the maximum start time.",
        why="A slow start delays the work and heats the motor.",
        formula="t_s = J w/(M_start - M_steady) <= 10 s",
        source="change of angular momentum; handbooks of lifting machines",
    )
)


HARSH: OneCheck = only(turns)(
    Check(
        code="CRN103",
        title="minimum slewing start time",
        question="Is the starting time long enough for a smooth start?",
        failure="slewing start is too abrupt",
        scenes=SLEWING,
        loads=("start_time",),
        sense=Sense.AT_LEAST,
        limit=key(
            "checks.least_start_time",
            meaning="Minimum starting time, 1 s by default",
            valid="slewing cranes in service",
            error="none: an engineering rule",
            source="handbooks of lifting machines",
        ),
        needs=no_needs,
        blame=lambda spec, scene, loads: torque_key(spec, scene),
        repair=torque_repair,
        what="The start of the crane to its slewing speed takes at least the minimum start time.",
        why="An oversized motor causes load sway and impacts in gear and jib.",
        formula="t_s >= 1 s",
        source="handbooks of lifting machines",
    )
)


SHORT: OneCheck = only(turns)(
    Check(
        code="CRN106",
        title="rotation share of start and stop",
        question="Do start and stop fit into the slewing angle of the cycle?",
        failure="slewing angle is too short to reach full speed",
        scenes=SLEWING,
        loads=("rotation_used",),
        sense=Sense.AT_MOST,
        limit=fixed(
            1.0,
            meaning="The whole slewing angle",
            valid="any rotation",
            error="none: a definition",
            source="start and stop are parts of one slewing motion",
        ),
        needs=no_needs,
        blame=blames("cycle", "rotation"),
        repair=at("cycle", "rotation"),
        what="The slewing angle of start and stop together is at most the angle of the rotation.",
        why="A crane that does not reach its slewing speed has a different cycle from the computed one.",
        formula="(beta_s + beta_b)/beta <= 1",
        source="course notes on the slewing crane on a fixed column (3.5.2.3)",
    )
)


BRAKE_ANGLE: OneCheck = only(starts)(
    Check(
        code="CRN104",
        hazard=True,
        title="slewing stopping angle",
        question="Does the brake stop the crane within the permissible angle against in-service wind?",
        failure="crane slews too far before it stops",
        scenes=SLEWING,
        loads=("brake_angle",),
        sense=Sense.AT_MOST,
        limit=key(
            "cycle.brake_angle",
            meaning="Permissible stopping angle, given in the file",
            valid="15 deg in light duty",
            error="none: a given value",
            source="course notes on the slewing crane on a fixed column (3.5.2.2)",
        ),
        needs=needs(("brake",)),
        blame=blames("brake", "torque"),
        repair=at("brake", "torque"),
        what="The brake stops the crane within the permissible angle against the maximum in-service wind. The brake"
        " delay is included.",
        why="A jib that slews too far hits objects in its path. The operator cannot place the load.",
        formula="beta_b <= beta",
        source="power balance of the gear (laws.slewing.geared_stop); course notes on the slewing crane",
    )
)


BRAKE_TIME: OneCheck = only(starts)(
    Check(
        code="CRN105",
        title="maximum slewing stop time",
        question="Does the brake stop the crane within the limit against in-service wind?",
        failure="slewing stop takes too long",
        limit_state=LimitState("brake does not stop the crane"),
        scenes=SLEWING,
        loads=("brake_time",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.brake_time",
            meaning="Maximum stopping time, 10 s by default",
            valid="slewing cranes in service",
            error="none: an engineering rule",
            source="handbooks of lifting machines",
        ),
        needs=needs(("brake",)),
        blame=blames("brake", "torque"),
        repair=at("brake", "torque"),
        what="The brake stops the crane within the maximum stop time against the maximum in-service wind. The brake"
        " delay is included.",
        why="A crane with a long stopping time does not stop before an obstacle. A brake torque below the wind torque"
        " does not stop it at all.",
        formula="t_b <= 10 s",
        source="power balance of the gear (laws.slewing.geared_stop)",
    )
)


HARSH_STOP: OneCheck = only(turns)(
    Check(
        code="CRN119",
        title="minimum slewing stop time",
        question="Is the stopping time long enough for a smooth stop?",
        failure="slewing stop is too abrupt",
        scenes=SLEWING,
        loads=("brake_time",),
        sense=Sense.AT_LEAST,
        limit=key(
            "checks.least_brake_time",
            meaning="Minimum stopping time, 1 s by default",
            valid="slewing cranes in service; an emergency stop may be shorter",
            error="none: an engineering rule",
            source="handbooks of lifting machines",
        ),
        needs=needs(("brake",)),
        blame=blames("brake", "torque"),
        repair=at("brake", "torque"),
        what="The stop of the crane to standstill takes at least the minimum stop time.",
        why="An oversized brake causes load sway and impacts in gear and jib.",
        formula="t_b >= 1 s",
        source="handbooks of lifting machines",
    )
)

CHECKS_OF_ROTATION = (SLOW, HARSH, SHORT, BRAKE_ANGLE, BRAKE_TIME, HARSH_STOP)
