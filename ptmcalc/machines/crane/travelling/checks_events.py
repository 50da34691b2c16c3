"""The checks of buffers, rails, storms, and of the factors with which the structure has been calculated."""

import math
from collections.abc import Callable

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, at, blames, no_needs, no_repair, only
from ptmcalc.machines.crane.travelling.checks import RUNNING, OneCheck
from ptmcalc.machines.crane.travelling.scenes import Collision, RailStep, Skew, Storm, TravelScene
from ptmcalc.machines.crane.travelling.spec import Travelling
from ptmcalc.spec.scene import Scene

HITS: frozenset[type[Scene]] = frozenset({Collision})
STEPS: frozenset[type[Scene]] = frozenset({RailStep})


def _rating(value: float | None) -> Estimate:
    return Estimate.exact(math.inf if value is None else value)


# -- buffers --------------------------------------------------------------------------------------------------------


def _stroke_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Way the buffer can be pressed in.

    **Range** any buffer.
    **Error** none: a limit of the file.
    **Source** the maker of the buffer.
    """
    return _rating(spec.buffers.stroke if spec.buffers is not None else None)


STROKE: OneCheck = Check(
    code="CRN170",
    title="buffer stroke",
    question="Do the buffers stop the crane within their stroke?",
    failure="buffer bottoms out",
    scenes=HITS,
    loads=("buffer_stroke",),
    sense=Sense.AT_MOST,
    limit=_stroke_limit,
    needs=no_needs,
    blame=blames("buffers", "stroke"),
    repair=at("buffers", "stroke"),
    what="The buffers stop the crane within their stroke. Otherwise, the report states the remaining speed at the end"
    " of the stroke.",
    why="The end stop, the crane and the load absorb the remaining energy within a few millimetres.",
    formula="E(u) = m v^2/2 + P u,   u <= s;   left: v_1 = (v^2 + 2 (P s - E(s))/m)^(1/2)",
    source="energy; EN 13001-2, FEM 1.001",
)


def _force_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Largest force of a buffer, or of what it stands on.

    **Range** any buffer.
    **Error** none: a limit of the file.
    **Source** the maker of the buffer, the end stop's calculation.
    """
    return _rating(spec.buffers.rating if spec.buffers is not None else None)


FORCE: OneCheck = Check(
    code="CRN171",
    title="buffer force",
    question="Is the buffer force within the rating of buffer and end stop?",
    failure="buffer force exceeds its rating",
    scenes=HITS,
    loads=("buffer_force",),
    sense=Sense.AT_MOST,
    limit=_force_limit,
    needs=lambda spec, scene: (("buffers", "rating"),),
    blame=blames("buffers", "rating"),
    repair=at("buffers", "rating"),
    what="The force of each buffer is at most its rating or the rating of the end stop.",
    why="A buffer that is too stiff breaks the parts it protects.",
    formula="F = (P + (P^2 + c m v^2)^(1/2))/n <= F_max, by the type of buffer",
    source="energy; EN 13001-2, FEM 1.001",
)


def _speed_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Largest speed at which a buffer may be hit.

    **Range** any buffer.
    **Error** none: a limit of the file or of the buffer's maker.
    **Source** the file.
    """
    own = spec.buffers.largest_speed if spec.buffers is not None else None
    return _rating(spec.checks.collision_speed if spec.checks.collision_speed is not None else own)


def _speed_key(spec: Travelling, scene: TravelScene) -> KeyPath:
    return ("checks", "collision_speed") if spec.checks.collision_speed is not None else ("buffers", "largest_speed")


def _has_speed(spec: Travelling, scene: TravelScene) -> bool:
    own = spec.buffers.largest_speed if spec.buffers is not None else None
    return spec.checks.collision_speed is not None or own is not None


HIT: OneCheck = only(_has_speed)(
    Check(
        code="CRN172",
        title="buffer impact speed",
        question="Is the impact speed within the limit of buffer and plant rules?",
        failure="buffer impact speed is too high",
        scenes=HITS,
        loads=("collision_speed",),
        sense=Sense.AT_MOST,
        limit=_speed_limit,
        needs=no_needs,
        blame=lambda spec, scene, loads: _speed_key(spec, scene),
        repair=at("speed"),
        what="The impact speed of the crane is at most the limit of the buffers or of the plant rules.",
        why="The stiffness of rubber and cellular buffers increases with the compression speed. Load and driver are"
        " not restrained.",
        formula="share of v <= v_max",
        source="the maker of the buffer",
    )
)

# -- rail -----------------------------------------------------------------------------------------------------------


def _contact_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """A wheel stays on its rail.

    **Range** any wheel.
    **Error** none: a wheel does not pull.
    **Source** equilibrium.
    """
    return Estimate.exact(0.0)


CONTACT: OneCheck = Check(
    code="CRN173",
    title="wheel load ratio at rail steps and gaps",
    question="Do the wheels keep contact on the largest step and gap of the rail?",
    failure="wheel leaves the rail at a step or gap",
    scenes=STEPS,
    loads=("rail_contact",),
    sense=Sense.AT_LEAST,
    limit=_contact_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: ("rail", "step" if spec.rail.step else "gap"),
    repair=at("speed"),
    what="The wheel load stays at or above zero at the largest step and gap of the rail, so that the wheels keep"
    " contact.",
    why="The impact of a wheel that lands on the rail is not covered by any factor.",
    formula="1 - (pi/2)^2 v^2/(g r) u_min >= 0",
    source="one vertical mode over a cosine step; `laws.rail`",
)


def _guide_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Largest force of a guide.

    **Range** flanges and guide rollers.
    **Error** none: a limit of the file.
    **Source** the file.
    """
    return _rating(spec.guide.rating if spec.guide is not None else None)


GUIDE: OneCheck = Check(
    code="CRN174",
    title="skewing guide force",
    question="Is the skewing force on the front guide within its rating?",
    failure="skewing force overloads the guide",
    scenes=frozenset({Skew}),
    loads=("skew_force",),
    sense=Sense.AT_MOST,
    limit=_guide_limit,
    needs=lambda spec, scene: (("guide", "rating"),),
    blame=blames("guide", "rating"),
    repair=at("guide", "rating"),
    what="The force of the rail on the foremost guide is at most the rating of flange, roller and rail.",
    why="Skewing is the main cause of wear of flanges and rails. It bends end carriages and runway sideways.",
    formula="S = sum f xi G_i (1 - d_i/h),   f = 0.3 (1 - exp(-250 alpha))",
    source="EN 13001-2, ISO 8686-1, EN 1991-3",
)

# -- storm ----------------------------------------------------------------------------------------------------------


def _storm_limit(spec: Travelling, scene: TravelScene) -> Estimate:
    """Least reserve against the wind out of service, 1.1 by default.

    **Range** cranes in the open.
    **Error** none: an engineering rule.
    **Source** handbooks of lifting machines; the standards' partial factors instead, where they are used.
    """
    return Estimate.exact(spec.checks.wind_reserve)


def _storm_key(spec: Travelling, scene: TravelScene) -> KeyPath:
    return ("parking", "force") if spec.parking is not None else ("wind", "pressure_storm")


STORM: OneCheck = Check(
    code="CRN175",
    title="holding reserve, out-of-service wind",
    question="Do brakes and rail clamps hold the parked crane in out-of-service wind?",
    failure="holding reserve in out-of-service wind is too small",
    limit_state=LimitState("parked crane drifts away", 1),
    scenes=frozenset({Storm}),
    loads=("storm_reserve",),
    sense=Sense.AT_LEAST,
    limit=_storm_limit,
    needs=no_needs,
    blame=lambda spec, scene, loads: _storm_key(spec, scene),
    repair=lambda spec, scene: _storm_key(spec, scene) if spec.parking is not None else (),
    what="Brakes and rail clamps hold the crane in the out-of-service wind with the required reserve. The brake forces"
    " are limited by the adhesion of their wheels.",
    why="Only the end stops stop a crane that moves in a storm.",
    formula="(sum of min(M_b u/(r eta_r)/n, mu N_k) + clamps)/(q c A + G sin(alpha)) >= 1.1",
    source="balance along the rails; winds of EN 13001-2, ISO 4302",
)

# -- factors --------------------------------------------------------------------------------------------------------


def _declared(name: str) -> Callable[[Travelling, TravelScene], bool]:
    return lambda spec, scene: getattr(spec.declared, name) is not None


def _factor_limit(name: str) -> Callable[[Travelling, TravelScene], Estimate]:
    def limit(spec: Travelling, scene: TravelScene) -> Estimate:
        return _rating(getattr(spec.declared, name))

    limit.__doc__ = f"""The {name} with which the structure has been calculated.

    **Range** any crane.
    **Error** none: a number of the file.
    **Source** the file.
    """
    return limit


def _factor(
    code: str,
    name: str,
    what: str,
    formula: str,
    scenes: frozenset[type[Scene]] = RUNNING,
    sense: Sense = Sense.AT_MOST,
    needs: Callable[[Travelling, TravelScene], tuple[KeyPath, ...]] = no_needs,
) -> OneCheck:
    """The check of one declared factor."""
    falls = sense is Sense.AT_LEAST
    repair: Callable[[Travelling, TravelScene], KeyPath] = at("declared", name) if name != "phi3" else no_repair
    return only(_declared(name))(
        Check(
            code=code,
            title=f"dynamic factor {name}",
            question=f"Is {name} covered by the declared value{', i.e. not below it' if falls else ''}?",
            failure=f"{name} {'falls below' if falls else 'exceeds'} the declared value",
            scenes=scenes,
            loads=(name,),
            sense=sense,
            limit=_factor_limit(name),
            needs=needs,
            blame=blames("declared", name),
            repair=repair,
            what=what,
            why="The proof of the structure is valid only for the factors it is based on.",
            formula=formula,
            source="EN 13001-2, ISO 8686-1; numbers as open design codes quote them",
        )
    )


def _hoisting_needs(spec: Travelling, scene: TravelScene) -> tuple[KeyPath, ...]:
    return (("class", "hoisting"), ("suspension", "hoist_speed"))


FACTORS: tuple[OneCheck, ...] = (
    _factor(
        "CRN180",
        "phi1",
        "phi1, the factor of the standard on the crane weight while a load is lifted, is at most the declared value.",
        "phi_1 = 1 + a,   a <= 0.1",
    ),
    _factor(
        "CRN181",
        "phi2",
        "phi2, the factor of lifting a load off the ground, is at most the declared value. It depends on hoisting"
        " class, drive class and hoisting speed.",
        "phi_2 = phi_2,min + beta_2 v_h",
        needs=_hoisting_needs,
    ),
    _factor(
        "CRN182",
        "phi3",
        "phi3, the factor of the sudden release of a part of the load, is at least the declared value. The factor"
        " describes a relief or an upward force.",
        "phi_3 = 1 - dm/m (1 + beta_3)",
        sense=Sense.AT_LEAST,
    ),
    _factor(
        "CRN183",
        "phi4",
        "phi4, the factor of travelling over the largest step and gap of the rail, is at most the declared value. It is"
        " computed from the complete response of the crane.",
        "phi_4 = 1 + (pi/2)^2 v^2/(g r) max u",
        scenes=STEPS,
    ),
    _factor(
        "CRN184",
        "phi5",
        "phi5, the factor on changes of the drive forces, is at most the declared value. It depends on the control and"
        " the backlash of the drive.",
        "phi_5 = 1 to 1.5 smooth, 1.5 to 2 sudden, 3 with considerable backlash",
    ),
    _factor(
        "CRN185",
        "phi6",
        "phi6, the factor on the load of the dynamic test, is at most the declared value.",
        "phi_6 = (1 + phi_2)/2",
        needs=_hoisting_needs,
    ),
    _factor(
        "CRN186",
        "phi7",
        "phi7, the factor on buffer forces, is at most the declared value. It depends on the buffer curve shape.",
        "phi_7 = 1.25 + 0.7 (xi - 0.5), at least 1.25",
        scenes=HITS,
    ),
)

CHECKS_OF_EVENTS: tuple[AnyCheck, ...] = (STROKE, FORCE, HIT, CONTACT, GUIDE, STORM, *FACTORS)
