"""The checks of a hoist that moves evenly: its rope and sheaves, its class."""

import math
from collections.abc import Callable, Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, at, blames, no_needs, no_repair, only
from ptmcalc.contract.limits import fixed
from ptmcalc.laws import hoist_class
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.model import loaded
from ptmcalc.machines.hoist.machine.spec import Hoist, HoistScene, Run

Loads = Mapping[str, Estimate]
OneCheck = Check[Hoist, Run]
RUNNING = frozenset({Run})

_GROUP: KeyPath = ("class", "mechanism")


def _of_group(asked: float | None, table: Mapping[str, float], spec: Hoist) -> Estimate:
    """A limit of the file, else that of the group."""
    if asked is not None:
        return Estimate.exact(asked)
    group = spec.classes.mechanism
    return Estimate.exact(math.inf if group is None else table[group])


def _group_needs(key: str) -> Callable[[Hoist, Run], tuple[KeyPath, ...]]:
    """The group, where the file sets no limit of its own."""

    def needs(spec: Hoist, scene: Run) -> tuple[KeyPath, ...]:
        return () if getattr(spec.checks, key) is not None else (_GROUP,)

    return needs


# -- rope -----------------------------------------------------------------------------------------------------------


def _safety_limit(spec: Hoist, scene: Run) -> Estimate:
    """Z_p of the mechanism group, or of the file.

    **Range** groups M1 to M8, at most M6 for several layers; 25 % more for dangerous loads, at most 9.
    **Error** none: a table.
    **Source** ISO 4308-1:2003, GOST 33710-2015; quoted from secondary sources.
    """
    asked, group = spec.checks.rope_safety, spec.classes.mechanism
    if asked is not None or group is None:
        return Estimate.exact(math.inf if asked is None else asked)
    dangerous = spec.classes.dangerous_load == "yes"
    several = model.wound(spec, spec.height).layers > 1 and group in hoist_class.ROPE_SAFETY_LAYERS
    return Estimate.exact(hoist_class.rope_safety_of_group(group, 2 if several else 1, dangerous))


def _safety_needs(spec: Hoist, scene: Run) -> tuple[KeyPath, ...]:
    return (("rope", "breaking_force"), *_group_needs("rope_safety")(spec, scene))


ROPE: OneCheck = only(loaded)(
    Check(
        code="HST101",
        hazard=True,
        title="rope safety factor Z_p",
        question="Is the rope breaking force high enough for the largest steady rope pull?",
        failure="rope safety factor is too low",
        scenes=RUNNING,
        loads=("rope_safety",),
        sense=Sense.AT_LEAST,
        limit=_safety_limit,
        needs=_safety_needs,
        blame=blames("rope", "breaking_force"),
        repair=at("rope", "breaking_force"),
        what="The breaking force of the rope is at least Zp times its maximum force in steady hoisting. Zp is the"
        " coefficient of the mechanism group (ISO 4308-1:2003).",
        why="A rope bends and wears at every lift. The apparent reserve determines the rope life.",
        formula="F_min/S >= Z_p,   S = ((Q + G) g/(m eta_r) + rope)/eta_deflection",
        source="ISO 4308-1:2003, GOST 33710-2015; quoted from secondary sources",
    )
)


def _drum_limit(spec: Hoist, scene: Run) -> Estimate:
    """h_1 of the mechanism group, or of the file.

    **Range** groups M1 to M8.
    **Error** none: a table, to be confirmed against the text.
    **Source** ISO 4308-1:2003; quoted from secondary sources.
    """
    return _of_group(spec.checks.drum_ratio, hoist_class.DRUM_RATIO, spec)


DRUM_BEND: OneCheck = only(loaded)(
    Check(
        code="HST102",
        title="drum ratio D/d (h1)",
        question="Is the drum large enough for the rope?",
        failure="drum is too small for the rope",
        scenes=RUNNING,
        loads=("drum_ratio",),
        sense=Sense.AT_LEAST,
        limit=_drum_limit,
        needs=_group_needs("drum_ratio"),
        blame=blames("drum", "diameter"),
        repair=at("drum", "diameter"),
        what="The drum diameter, measured to the centre of the rope, is at least h1 rope diameters.",
        why="A sharply bent rope breaks wire by wire.",
        formula="(D + d)/d >= h_1",
        source="ISO 4308-1:2003; quoted from secondary sources, to be confirmed",
    )
)


def _sheave_limit(spec: Hoist, scene: Run) -> Estimate:
    """h_2 of the mechanism group, or of the file.

    **Range** groups M1 to M8.
    **Error** none: a table, to be confirmed against the text.
    **Source** ISO 4308-1:2003; quoted from secondary sources.
    """
    return _of_group(spec.checks.sheave_ratio, hoist_class.SHEAVE_RATIO, spec)


def _has_sheaves(spec: Hoist, scene: HoistScene) -> bool:
    return loaded(spec, scene) and (model.falls_of_a_rope(spec) > 1 or spec.reeving.deflection_sheaves > 0)


SHEAVE_BEND: OneCheck = only(_has_sheaves)(
    Check(
        code="HST103",
        title="sheave ratio D/d (h2)",
        question="Are the sheaves large enough for the rope?",
        failure="sheaves are too small for the rope",
        scenes=RUNNING,
        loads=("sheave_ratio",),
        sense=Sense.AT_LEAST,
        limit=_sheave_limit,
        needs=lambda spec, scene: (("reeving", "sheave_diameter"), *_group_needs("sheave_ratio")(spec, scene)),
        blame=blames("reeving", "sheave_diameter"),
        repair=at("reeving", "sheave_diameter"),
        what="The sheave diameter, measured to the centre of the rope, is at least h2 rope diameters.",
        why="On a sheave, the rope is bent and straightened again at every pass. This occurs twice as often as on the"
        " drum.",
        formula="(D + d)/d >= h_2",
        source="ISO 4308-1:2003; quoted from secondary sources, to be confirmed",
    )
)


def _equaliser_limit(spec: Hoist, scene: Run) -> Estimate:
    """h_3 of the mechanism group, or of the file.

    **Range** groups M1 to M8.
    **Error** none: a table, to be confirmed against the text.
    **Source** ISO 4308-1:2003; quoted from secondary sources.
    """
    return _of_group(spec.checks.equaliser_ratio, hoist_class.EQUALISER_RATIO, spec)


def _has_equaliser(spec: Hoist, scene: HoistScene) -> bool:
    return loaded(spec, scene) and spec.reeving.equaliser_diameter is not None


EQUALISER_BEND: OneCheck = only(_has_equaliser)(
    Check(
        code="HST104",
        title="equalising sheave ratio D/d (h3)",
        question="Is the equalising sheave large enough for the rope?",
        failure="equalising sheave is too small for the rope",
        scenes=RUNNING,
        loads=("equaliser_ratio",),
        sense=Sense.AT_LEAST,
        limit=_equaliser_limit,
        needs=_group_needs("equaliser_ratio"),
        blame=blames("reeving", "equaliser_diameter"),
        repair=at("reeving", "equaliser_diameter"),
        what="The diameter of the equalising sheave, measured to the centre of the rope, is at least h3 rope"
        " diameters.",
        why="The equalising sheave turns little. It bends the same piece of rope during the whole rope life.",
        formula="(D + d)/d >= h_3",
        source="ISO 4308-1:2003; quoted from secondary sources, to be confirmed",
    )
)


SLACK: OneCheck = only(lambda spec, scene: spec.hook_block > 0)(
    Check(
        code="HST105",
        title="minimum fall tension, empty hook",
        question="Does the empty hook block keep every fall taut while lowering?",
        failure="empty hook block leaves a fall without tension",
        limit_state=LimitState("rope goes slack", 0),
        scenes=RUNNING,
        loads=("rope_pull_empty",),
        sense=Sense.AT_LEAST,
        limit=fixed(
            0.0,
            meaning="0: the rope stays taut",
            valid="any reeving",
            error="none: a rope carries no compression",
            source="equilibrium of every sheave",
        ),
        needs=no_needs,
        blame=blames("hook_block"),
        repair=at("hook_block"),
        what="While lowering, the empty hook block keeps every fall of its reeving in tension against the friction of"
        " the sheaves.",
        why="Otherwise the rope runs slack off the drum and jumps its grooves. An impact loads it when it becomes taut"
        " again.",
        formula="min L_k >= 0 while lowering,   L_(k+1) = L_k/eta below, U_(k+1) = U_k/eta above,   L = U - w",
        source="balance of every sheave",
    )
)

# -- class ----------------------------------------------------------------------------------------------------------


def _use_limit(spec: Hoist, scene: Run) -> Estimate:
    """Mechanism group declared in the file.

    **Range** M1 to M8.
    **Error** none: a class.
    **Source** the file.
    """
    group = spec.classes.mechanism
    return Estimate.exact(math.inf if group is None else float(group[1:]))


def _use_wanted(spec: Hoist, scene: HoistScene) -> bool:
    return loaded(spec, scene) and spec.duty is not None and spec.duty.hours is not None


USE: OneCheck = only(_use_wanted)(
    Check(
        code="HST113",
        title="required mechanism group",
        question="Is the group required by hours and load spectrum covered by the declared group?",
        failure="duty requires a higher mechanism group than declared",
        scenes=RUNNING,
        loads=("mechanism_group",),
        sense=Sense.AT_MOST,
        limit=_use_limit,
        needs=lambda spec, scene: (_GROUP,),
        blame=blames("class", "mechanism"),
        repair=no_repair,
        what="The required mechanism group is at most the group declared in the file. Hours in motion and load"
        " spectrum determine the required group (ISO 4301-1:1986).",
        why="All limits of rope, drum and sheaves are those of the declared group. They do not cover a more severe"
        " duty.",
        formula="M(T, L) = T + L - 2 <= M,   L by k_m = sum share (P/P_max)^3",
        source="ISO 4301-1:1986",
    )
)

CHECKS_OF_ROPE: tuple[AnyCheck, ...] = (
    ROPE,
    DRUM_BEND,
    SHEAVE_BEND,
    EQUALISER_BEND,
    SLACK,
    USE,
)
