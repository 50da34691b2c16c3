"""The checks of a slewing crane's load and ring: how far it swings, what the ring bears, what the crane is used for."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, at, blames, needs, no_repair, only
from ptmcalc.machines.crane.slewing import chain, model
from ptmcalc.machines.crane.slewing.checks import SLEWING, OneCheck, curve_number, torque_key, turns
from ptmcalc.machines.crane.slewing.solvers.consistent import start_of
from ptmcalc.machines.crane.slewing.spec import SlewingCrane, SlewingScene


def _allowed_sway(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Maximum angle of the hoist rope, 10 deg by default.

    **Range** an agreement between manufacturer and user; grabs and containers require less.
    **Error** none: an engineering rule.
    **Source** practice of cranes: 3 to 10 deg in service.
    """
    return Estimate.exact(spec.checks.sway)


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
        limit=_allowed_sway,
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
    start, stop = start_of(spec, scene)[0], (model.stop(spec, scene) or chain.allowed_stop(spec))[0]
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
        limit=_allowed_sway,
        needs=needs(*_ROPE),
        blame=lambda spec, scene, loads: _thrown_by(spec, scene),
        repair=lambda spec, scene: curve_number(spec, _thrown_by(spec, scene)),
        what="In start, rotation and stop, the angle of the rope behind or ahead of the jib is at most the limit.",
        why="The rope then pulls the jib sideways. The load cannot be set down.",
        formula="theta_t <= 10 deg",
        source="spherical pendulum on a slewing jib",
    )
)


def _curve(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Permissible moment of the limiting load curve of the catalogue at this axial force.

    **Range** linear between the points of the curve; zero beyond the last point.
    **Error** none: a given curve.
    **Source** the manufacturer's catalogue.
    """
    return Estimate.exact(1.0)


RING: OneCheck = only(lambda spec, scene: spec.ring.curve is not None)(
    Check(
        code="CRN115",
        title="slewing ring utilisation",
        question="Is the tilting moment within the slewing ring limit curve at this axial load?",
        failure="tilting moment exceeds the limit curve of the slewing ring",
        scenes=SLEWING,
        loads=("ring_utilisation",),
        sense=Sense.AT_MOST,
        limit=_curve,
        needs=lambda spec, scene: (
            (("load",),) if spec.inertia is None else (("load",), ("ring", "mass_above"), ("ring", "unbalance"))
        ),
        blame=blames("ring", "curve"),
        repair=no_repair,
        what="The tilting moment is within the limit curve of the slewing ring at the same axial force. It is verified"
        " with the load times its factor and with an empty hook.",
        why="Beyond the limit curve, the raceways of the ring are indented. The bolts fatigue.",
        formula="M(1.25 Q), M(0) <= M_ring(F_a)",
        source="catalogues of slewing rings: limiting load curves",
    )
)


def _group(spec: SlewingCrane, scene: SlewingScene) -> Estimate:
    """Declared crane group.

    **Range** A1 to A8.
    **Error** none: a given class.
    **Source** ISO 4301-1.
    """
    group = spec.classes.group
    return Estimate.exact(math.inf if group is None else float(group[1]))


GROUP: OneCheck = only(lambda spec, scene: spec.classes.cycles is not None)(
    Check(
        code="CRN117",
        title="required crane group",
        question="Is the group required by cycles and load spectrum covered by the declared group?",
        failure="duty requires a higher crane group than declared",
        scenes=SLEWING,
        loads=("crane_group",),
        sense=Sense.AT_MOST,
        limit=_group,
        needs=needs(("class", "group")),
        blame=blames("class", "cycles"),
        repair=no_repair,
        what="The crane group required by the cycles and the load spectrum of the service life is at most the declared"
        " group.",
        why="A crane used beyond its group wears out before the end of its service life.",
        formula="A = U + Q - 2 <= declared",
        source="ISO 4301-1",
    )
)

CHECKS_OF_SWING: tuple[AnyCheck, ...] = (RADIAL, TANGENTIAL, RING, GROUP)
