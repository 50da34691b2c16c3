"""Checks of the column's motion: how far it swings, how long, and what it and an obstacle do to each other."""

from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, blames, needs, no_needs, no_repair, only
from ptmcalc.contract.limits import key
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.judging import Loads, OneCheck, block, of_the_mechanism
from ptmcalc.machines.crane.stacking.machine.scenes import Brake, ObstacleScene, StackerScene, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.machine.travelling import turns
from ptmcalc.spec.scene import Scene

DRIVEN: frozenset[type[Scene]] = frozenset({Start, Brake})
HITS: frozenset[type[Scene]] = frozenset({ObstacleScene})


def _rate_key(spec: Stacker, scene: StackerScene) -> KeyPath:
    """What says how hard a mechanism starts or stops."""
    key = block(spec, scene)
    travel = model.travel(spec, scene)
    starts = isinstance(scene, Start)
    if travel.drive is not None:
        if starts:
            return (key, "drive")
        return (key, "drive", "deceleration") if travel.drive.deceleration is not None else (key, "drive", "brake")
    if starts:
        return (key, "acceleration" if travel.acceleration is not None else "driving_force")
    return (key, "deceleration" if travel.deceleration is not None else "braking_force")


def _rate_blame(spec: Stacker, scene: StackerScene, loads: Loads) -> KeyPath:
    return _rate_key(spec, scene)


def _rate_repair(spec: Stacker, scene: StackerScene) -> KeyPath:
    key = _rate_key(spec, scene)
    return key if key[-1] in ("acceleration", "driving_force", "deceleration", "braking_force") else ()


# -- the swing ------------------------------------------------------------------------------------------------------


def _asks_deflection(spec: Stacker, scene: StackerScene) -> bool:
    return spec.checks.mast_deflection is not None and not turns(spec, scene)


DEFLECTION: OneCheck = only(_asks_deflection)(
    Check(
        code="CRN251",
        title="dynamic mast tip deflection",
        question="Is the dynamic deflection of the mast tip within its limit?",
        failure="mast deflects too far",
        scenes=DRIVEN,
        loads=("mast_deflection_max",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.mast_deflection",
            meaning="Permissible dynamic deflection of the mast tip, given in the file",
            valid="any stacker crane",
            error="none: a limit of the file",
            source="the file: the lecture notes do not contain the formula, and no other source is known",
        ),
        needs=no_needs,
        blame=_rate_blame,
        repair=_rate_repair,
        what="The dynamic deflection of the mast tip relative to its support is at most the limit.",
        why="A mast with large deflections hits the racks and shakes off the load. It fatigues at its root.",
        formula="x = 2 P m_2/(c (m_1 + m_2)) for a sudden force; with the mast mass and its modes",
        source="N. Yu. Dorokhov, lecture notes, Kramatorsk 2007; limit of the file",
    )
)


_FORCE_LIMIT = key(
    "checks.column_force",
    meaning="Permissible mast force on its support, given in the file",
    valid="any stacker crane",
    error="none: a limit of the file",
)


def _asks_force(spec: Stacker, scene: StackerScene) -> bool:
    return spec.checks.column_force is not None and not turns(spec, scene)


PULL: OneCheck = only(_asks_force)(
    Check(
        code="CRN252",
        hazard=True,
        title="dynamic mast force",
        question="Is the dynamic force of the mast in a start or stop within its limit?",
        failure="mast is overloaded in a start or stop",
        scenes=DRIVEN,
        loads=("mast_force_max",),
        sense=Sense.AT_MOST,
        limit=_FORCE_LIMIT,
        needs=no_needs,
        blame=_rate_blame,
        repair=_rate_repair,
        what="The dynamic mast force, the product of mast stiffness and tip deflection, is at most the limit of the"
        " mast root.",
        why="A larger force overloads the mast. This force is the dynamic load of starting and braking in the tables"
        " of combinations.",
        formula="F = c x_max",
        source="N. Yu. Dorokhov, lecture notes, Kramatorsk 2007, tables 11.1 and 11.2",
    )
)

# -- settling -------------------------------------------------------------------------------------------------------


def _asks_wait(spec: Stacker, scene: StackerScene) -> bool:
    return spec.settling.wait is not None and not turns(spec, scene)


def _settling_key(spec: Stacker, scene: StackerScene) -> KeyPath:
    """What lets the column swing less after a stop: a ramp whose deceleration comes up and goes down slowly, or a
    softer brake."""
    key = _rate_key(spec, scene)
    if key[-1] == "deceleration" and len(key) == 2:
        return (key[0], "ramp_rise")
    return _rate_repair(spec, scene)


def _settling_blame(spec: Stacker, scene: StackerScene, loads: Loads) -> KeyPath:
    return _settling_key(spec, scene) or _rate_key(spec, scene)


SETTLES: OneCheck = only(_asks_wait)(
    Check(
        code="CRN253",
        title="mast settling time",
        question="Does the mast tip settle into the positioning tolerance within the permissible time?",
        failure="mast takes too long to settle",
        scenes=frozenset({Brake}),
        loads=("settling_time",),
        sense=Sense.AT_MOST,
        limit=key(
            "settling.wait",
            meaning="Permissible settling time of the mast into the positioning tolerance, from standstill",
            valid="any stacker crane",
            error="none: a limit of the file",
            source="the file: no standard specifies it",
        ),
        needs=needs(("column", "log_decrement")),
        blame=_settling_blame,
        repair=_settling_key,
        what="From the standstill, the mast tip settles permanently into the fork window within the permitted wait.",
        why="A fork that extends earlier hits the rack or an adjacent pallet.",
        formula="|x(t)| <= window for all t >= t_s,   t_s <= wait",
        source="free vibration of the mast; tolerance and settling time of the file",
    )
)


def _asks_window(spec: Stacker, scene: StackerScene) -> bool:
    return spec.settling.window is not None and not turns(spec, scene)


LEANS: OneCheck = only(_asks_window)(
    Check(
        code="CRN254",
        title="static mast tip deflection",
        question="Is the static mast tip deflection smaller than the positioning tolerance?",
        failure="static mast deflection exceeds the positioning tolerance",
        scenes=frozenset({Brake}),
        loads=("rest_deflection",),
        sense=Sense.AT_MOST,
        limit=key(
            "settling.window",
            meaning="The positioning tolerance of the fork to either side",
            valid="any stacker crane",
            error="none: a limit of the file",
        ),
        needs=no_needs,
        blame=blames("settling", "window"),
        repair=no_repair,
        what="The static deflection of the mast tip under eccentric weights is at most the window of the fork to"
        " either side.",
        why="A mast with a larger static deflection never enters the window, for any wait. The window is narrower than"
        " the static deflection.",
        formula="x = M ((s l)^2/2 + s l (l - s l))/(E J) + M l/k,   M = |Q e + G b|;   x <= window",
        source="bending of beams; `laws.mast.leaning`",
    )
)

# -- collision ------------------------------------------------------------------------------------------------------


def _speed_blame(spec: Stacker, scene: StackerScene, loads: Loads) -> KeyPath:
    return (block(spec, scene), "speed")


BLOW: OneCheck = only(_asks_force)(
    Check(
        code="CRN255",
        hazard=True,
        title="mast force in a collision",
        question="Is the force of the mast in a collision within its limit?",
        failure="mast is overloaded by the collision",
        scenes=HITS,
        loads=("collision_force",),
        sense=Sense.AT_MOST,
        limit=_FORCE_LIMIT,
        needs=no_needs,
        blame=_speed_blame,
        repair=of_the_mechanism("speed"),
        what="The mast force during the collision of the mast tip with an obstacle is at most the limit of the mast"
        " root.",
        why="The mast stops all travelling masses. A collision with an obstacle is combination 4 of table 11.1.",
        formula="F <= v (c (m_1 + m_2))^(1/2); simulated with the contact of the file",
        source="energy; N. Yu. Dorokhov, lecture notes, Kramatorsk 2007, table 11.1",
    )
)


def _asks_contact(spec: Stacker, scene: StackerScene) -> bool:
    return spec.checks.contact_force is not None


STRUCK: OneCheck = only(_asks_contact)(
    Check(
        code="CRN256",
        hazard=True,
        title="obstacle contact force",
        question="Is the contact force with the obstacle within its limit?",
        failure="obstacle contact force is too high",
        scenes=HITS,
        loads=("contact_force",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.contact_force",
            meaning="Permissible contact force between mast and obstacle, given in the file",
            valid="any stacker crane",
            error="none: a limit of the file",
        ),
        needs=no_needs,
        blame=_speed_blame,
        repair=of_the_mechanism("speed"),
        what="The contact force between the mast tip and the obstacle is at most the limit of both.",
        why="The contact force is short and many times the mast force. It stops the load and the mast end on its own.",
        formula="F = v (k m_2)^(1/2), with the modes of the mast",
        source="contact of the file; `laws.obstacle`",
    )
)


def _asks_speed(spec: Stacker, scene: StackerScene) -> bool:
    return spec.checks.collision_speed is not None


FAST: OneCheck = only(_asks_speed)(
    Check(
        code="CRN257",
        hazard=True,
        title="obstacle collision speed",
        question="Is the collision speed within its limit?",
        failure="collision speed is too high",
        scenes=HITS,
        loads=("collision_speed",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.collision_speed",
            meaning="Permissible collision speed",
            valid="any stacker crane",
            error="none: a limit of the file",
        ),
        needs=no_needs,
        blame=_speed_blame,
        repair=of_the_mechanism("speed"),
        what="The speed of the mast at the collision with an obstacle is at most the limit of the plant rules.",
        why="The mast force is proportional to the speed. The impact energy is proportional to the square of the"
        " speed.",
        formula="share of v <= v_max",
        source="limit of the file",
    )
)

CHECKS_OF_MAST: tuple[AnyCheck, ...] = (DEFLECTION, PULL, SETTLES, LEANS, BLOW, STRUCK, FAST)
