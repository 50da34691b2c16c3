"""Checks of the sway of the load."""

import math

from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, Sense, at, blames, needs, only
from ptmcalc.contract.limits import key
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.judging import SLEWING, OneCheck, curve_number, torque_key, turns
from ptmcalc.machines.crane.slewing.machine.spec import SlewingCrane, SlewingScene

_ALLOWED_SWAY = key(
    "checks.sway",
    meaning="Maximum angle of the hoist rope, 10 deg by default",
    valid="an agreement between manufacturer and user; grabs and containers require less",
    error="none: an engineering rule",
    source="practice of cranes: 3 to 10 deg in service",
)


_ROPE = (("load",), ("load", "rope_length"))


def _swings(spec: SlewingCrane, scene: SlewingScene) -> bool:
    """Whether something hangs on the rope of a crane that moves, and its swing is not left out by the file."""
    nothing = spec.load is not None and model.hanging_mass(spec, scene) == 0
    return turns(spec, scene) and not nothing and spec.effects.get("load_swing") != "off"


RADIAL: OneCheck = only(_swings)(
    Check(
        code="CRN110",
        title="radial load sway",
        question="Is the radial sway angle of the hoist rope within its limit?",
        failure="load sways too far radially",
        scenes=SLEWING,
        loads=("sway_radial_max",),
        sense=Sense.AT_MOST,
        limit=_ALLOWED_SWAY,
        needs=needs(*_ROPE),
        blame=blames("speed"),
        repair=at("speed"),
        what="In start, rotation and stop, the outward or inward angle of the rope from the vertical is at most the"
        " limit.",
        why="A load that sways outwards adds to the tilting moment. It hits objects next to its path.",
        formula="theta_r <= 10 deg",
        source="spherical pendulum on a slewing jib",
    )
)


def _thrown_by(spec: SlewingCrane, scene: SlewingScene) -> KeyPath:
    """What governs the swing along the way: the speed that is gained or lost within half a swing of the load, else the
    torque of the start or of the brake, whichever is quicker: their acceleration does not go by the speed."""
    assert spec.load is not None
    assert spec.load.rope_length is not None
    start, stop = model.start_of(spec, scene)[0], (model.stop(spec, scene) or model.allowed_stop(spec))[0]
    if min(start, stop) < math.pi * math.sqrt(spec.load.rope_length / spec.gravity):
        return ("speed",)
    if start <= stop:
        return torque_key(spec, scene)
    return ("brake", "torque") if spec.brake is not None else ("cycle", "brake_angle")


TANGENTIAL: OneCheck = only(_swings)(
    Check(
        code="CRN111",
        title="tangential load sway",
        question="Is the tangential sway angle of the hoist rope within its limit?",
        failure="load sways too far tangentially",
        scenes=SLEWING,
        loads=("sway_tangential_max",),
        sense=Sense.AT_MOST,
        limit=_ALLOWED_SWAY,
        needs=needs(*_ROPE),
        blame=lambda spec, scene, loads: _thrown_by(spec, scene),
        repair=lambda spec, scene: curve_number(spec, _thrown_by(spec, scene)),
        what="In start, rotation and stop, the angle of the rope behind or ahead of the jib is at most the limit.",
        why="The rope then pulls the jib sideways. The load cannot be set down.",
        formula="theta_t <= 10 deg",
        source="spherical pendulum on a slewing jib",
    )
)

CHECKS_OF_SWAY = (RADIAL, TANGENTIAL)
