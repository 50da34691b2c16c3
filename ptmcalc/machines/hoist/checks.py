"""The checks of a hoist that moves evenly: its rope, its drum, its class."""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, no_needs, no_repair
from ptmcalc.laws import hoist_class
from ptmcalc.machines.hoist import model
from ptmcalc.machines.hoist.spec import Hoist, HoistScene, Run

Loads = Mapping[str, Estimate]
OneCheck = Check[Hoist, Run]
RUNNING = frozenset({Run})

_GROUP: KeyPath = ("class", "mechanism")
_FLEET, _FLEET_RESISTANT = math.radians(4), math.radians(2)


def only(wanted: Callable[[Hoist, HoistScene], bool]) -> Callable[[OneCheck], OneCheck]:
    """A check that is made of some hoists, and with some loads, only."""

    def of(check: OneCheck) -> OneCheck:
        def each(spec: Hoist, scene: Run) -> Iterable[OneCheck]:
            return (check,) if wanted(spec, scene) else ()

        return replace(check, each=each)

    return of


def loaded(spec: Hoist, scene: HoistScene) -> bool:
    """Whether the rated load hangs on the hook: what an empty hook does not ask is not asked of it."""
    return scene.load == "full"


def at(*path: str) -> Callable[[Hoist, Run], KeyPath]:
    """Always the same key."""
    return lambda spec, scene: path


def blames(*path: str) -> Callable[[Hoist, Run, Loads], KeyPath]:
    """Always the same key."""
    return lambda spec, scene, loads: path


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
    """Z_p of the group of the mechanism, or of the file.

    **Range** groups M1 to M8, M6 at most for several layers; a quarter more for dangerous loads, 9 at most.
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
        title="too little rope strength",
        scenes=RUNNING,
        loads=("rope_safety",),
        sense=Sense.AT_LEAST,
        limit=_safety_limit,
        needs=_safety_needs,
        blame=blames("rope", "breaking_force"),
        repair=at("rope", "breaking_force"),
        what="The breaking force of the rope exceeds its largest pull in even hoisting by the coefficient Zp of the"
        " group of the mechanism (ISO 4308-1:2003).",
        why="A rope bends and wears at every lift: what looks like a reserve is its life.",
        formula="F_min/S >= Z_p,   S = ((Q + G) g/(m eta_r) + rope)/eta_deflection",
        source="ISO 4308-1:2003, GOST 33710-2015; quoted from secondary sources",
    )
)


def _drum_limit(spec: Hoist, scene: Run) -> Estimate:
    """h_1 of the group of the mechanism, or of the file.

    **Range** groups M1 to M8.
    **Error** none: a table, to be confirmed against the text.
    **Source** ISO 4308-1:2003; quoted from secondary sources.
    """
    return _of_group(spec.checks.drum_ratio, hoist_class.DRUM_RATIO, spec)


DRUM_BEND: OneCheck = only(loaded)(
    Check(
        code="HST102",
        title="a drum too small for its rope",
        scenes=RUNNING,
        loads=("drum_ratio",),
        sense=Sense.AT_LEAST,
        limit=_drum_limit,
        needs=_group_needs("drum_ratio"),
        blame=blames("drum", "diameter"),
        repair=at("drum", "diameter"),
        what="The drum, measured to the middle of the rope, is h1 rope diameters large at least.",
        why="A rope bent sharply breaks wire by wire.",
        formula="(D + d)/d >= h_1",
        source="ISO 4308-1:2003; quoted from secondary sources, to be confirmed",
    )
)


def _sheave_limit(spec: Hoist, scene: Run) -> Estimate:
    """h_2 of the group of the mechanism, or of the file.

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
        title="sheaves too small for the rope",
        scenes=RUNNING,
        loads=("sheave_ratio",),
        sense=Sense.AT_LEAST,
        limit=_sheave_limit,
        needs=lambda spec, scene: (("reeving", "sheave_diameter"), *_group_needs("sheave_ratio")(spec, scene)),
        blame=blames("reeving", "sheave_diameter"),
        repair=at("reeving", "sheave_diameter"),
        what="The sheaves, measured to the middle of the rope, are h2 rope diameters large at least.",
        why="On a sheave the rope is bent and straightened again at every pass: twice as often as on the drum.",
        formula="(D + d)/d >= h_2",
        source="ISO 4308-1:2003; quoted from secondary sources, to be confirmed",
    )
)


def _equaliser_limit(spec: Hoist, scene: Run) -> Estimate:
    """h_3 of the group of the mechanism, or of the file.

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
        title="an equalising sheave too small for the rope",
        scenes=RUNNING,
        loads=("equaliser_ratio",),
        sense=Sense.AT_LEAST,
        limit=_equaliser_limit,
        needs=_group_needs("equaliser_ratio"),
        blame=blames("reeving", "equaliser_diameter"),
        repair=at("reeving", "equaliser_diameter"),
        what="The equalising sheave, measured to the middle of the rope, is h3 rope diameters large at least.",
        why="It hardly turns, but it works the same piece of rope all its life.",
        formula="(D + d)/d >= h_3",
        source="ISO 4308-1:2003; quoted from secondary sources, to be confirmed",
    )
)


def _slack_limit(spec: Hoist, scene: Run) -> Estimate:
    """The rope stays taut.

    **Range** any tackle.
    **Error** none: a rope does not push.
    **Source** balance of every sheave.
    """
    return Estimate.exact(0.0)


SLACK: OneCheck = only(lambda spec, scene: spec.hook_block > 0)(
    Check(
        code="HST105",
        title="a hook block too light to come down empty",
        scenes=RUNNING,
        loads=("rope_pull_empty",),
        sense=Sense.AT_LEAST,
        limit=_slack_limit,
        needs=no_needs,
        blame=blames("hook_block"),
        repair=at("hook_block"),
        what="The empty hook block pulls every fall of its tackle down against the friction of the sheaves.",
        why="Else the rope runs slack off the drum, jumps its grooves, and is caught with a blow.",
        formula="min L_k >= 0 while lowering,   U_(k+1) = U_k/eta,   L = U - w",
        source="balance of every sheave",
    )
)

# -- drum -----------------------------------------------------------------------------------------------------------


def _room(spec: Hoist, scene: Run) -> Estimate:
    """Length of the wound part of the drum.

    **Range** any drum.
    **Error** none: a given value.
    **Source** the file.
    """
    return Estimate.exact(spec.drum.length)


CAPACITY: OneCheck = only(loaded)(
    Check(
        code="HST106",
        title="too little room for the rope on the drum",
        scenes=RUNNING,
        loads=("drum_length_required",),
        sense=Sense.AT_MOST,
        limit=_room,
        needs=no_needs,
        blame=blames("drum", "length"),
        repair=at("drum", "length"),
        what="The rope of the whole lifting height and the turns that stay lie on the drum in the layers of the file.",
        why="Rope that finds no room climbs over the flange, or piles up and is crushed.",
        formula="p (l/(2 pi) + lost)/sum R_k <= L",
        source="geometry of the drum",
    )
)


def _layers_limit(spec: Hoist, scene: Run) -> Estimate:
    """Layers of the file, or those of the drum, one in the groups M7 and M8.

    **Range** any drum.
    **Error** none: a chosen limit.
    **Source** ISO 4308-1:2003 has no Zp for several layers in M7 and M8; quoted from secondary sources.
    """
    if spec.checks.layers is not None:
        return Estimate.exact(spec.checks.layers)
    group = spec.classes.mechanism
    single = group is not None and group not in hoist_class.ROPE_SAFETY_LAYERS
    return Estimate.exact(1 if single else spec.drum.layers)


LAYERS: OneCheck = only(loaded)(
    Check(
        code="HST107",
        title="more layers of rope than allowed",
        scenes=RUNNING,
        loads=("drum_layers",),
        sense=Sense.AT_MOST,
        limit=_layers_limit,
        needs=no_needs,
        blame=blames("drum", "layers"),
        repair=no_repair,
        what="With the hook at its highest the rope lies in no more layers than the file, or its group, allows.",
        why="Each layer crushes the one below, and at every crossover the rope is jolted.",
        formula="layers(l) <= n",
        source="geometry of the drum; ISO 4308-1:2003 for the groups M7 and M8",
    )
)


def _flange_limit(spec: Hoist, scene: Run) -> Estimate:
    """Least height of the flanges over the last layer, 1.5 rope diameters by default.

    **Range** drums with flanges.
    **Error** none: a chosen limit.
    **Source** makers' manuals; EN 14492-2:2006 asks as much.
    """
    return Estimate.exact(spec.checks.flange_margin)


FLANGE: OneCheck = only(lambda spec, scene: loaded(spec, scene) and spec.drum.flange_height is not None)(
    Check(
        code="HST108",
        title="a flange too low for the rope",
        scenes=RUNNING,
        loads=("flange_margin",),
        sense=Sense.AT_LEAST,
        limit=_flange_limit,
        needs=no_needs,
        blame=blames("drum", "flange_height"),
        repair=at("drum", "flange_height"),
        what="The flanges stand 1.5 rope diameters above the last layer.",
        why="A rope that climbs over a flange is cut by it.",
        formula="(h - (d + (n - 1) step))/d >= 1.5",
        source="makers' manuals; EN 14492-2:2006",
    )
)


def _slender_limit(spec: Hoist, scene: Run) -> Estimate:
    """Largest length of the wound parts over the diameter, 5 by default.

    **Range** drums on two bearings.
    **Error** none: an engineering rule; above 3 the shell is checked for bending too.
    **Source** handbooks of lifting machines.
    """
    return Estimate.exact(spec.checks.drum_slenderness)


SLENDER: OneCheck = only(loaded)(
    Check(
        code="HST109",
        title="a drum too slender",
        scenes=RUNNING,
        loads=("drum_slenderness",),
        sense=Sense.AT_MOST,
        limit=_slender_limit,
        needs=no_needs,
        blame=blames("drum", "length"),
        repair=at("drum", "diameter"),
        what="All wound parts together are no longer than 5 diameters of the drum. A larger drum takes the rope in"
        " fewer turns; so do fewer falls, more layers, or a second rope.",
        why="A slender drum bends and its rope leaves it at a large angle.",
        formula="n L/D <= 5",
        source="handbooks of lifting machines",
    )
)


def _wraps_limit(spec: Hoist, scene: Run) -> Estimate:
    """Fewest turns that stay on the drum, 2 by default.

    **Range** ropes clamped to the drum.
    **Error** none: a chosen limit.
    **Source** makers' manuals: 2, some rules 3; Euler's rope friction takes most of the pull from the clamps.
    """
    return Estimate.exact(spec.checks.dead_wraps)


DEAD_WRAPS: OneCheck = only(loaded)(
    Check(
        code="HST110",
        title="too few turns that stay on the drum",
        scenes=RUNNING,
        loads=("dead_wraps",),
        sense=Sense.AT_LEAST,
        limit=_wraps_limit,
        needs=no_needs,
        blame=blames("drum", "dead_wraps"),
        repair=at("drum", "dead_wraps"),
        what="With the hook at its lowest two turns of rope stay on the drum.",
        why="Their friction holds the rope; the clamps alone do not.",
        formula="z >= 2",
        source="makers' manuals; ISO 4308-1",
    )
)


def _fleet_limit(spec: Hoist, scene: Run) -> Estimate:
    """Largest fleet angle: 4 deg, 2 deg for rotation-resistant ropes, or what the file says.

    **Range** drums and sheaves with grooves of the usual depth.
    **Error** none: a chosen limit.
    **Source** makers' manuals; ISO 16625:2013 as they quote it.
    """
    asked = spec.checks.fleet_angle
    resistant = spec.rope.rotation_resistant == "yes"
    return Estimate.exact(asked if asked is not None else _FLEET_RESISTANT if resistant else _FLEET)


def _fleet_key(spec: Hoist, scene: Run) -> KeyPath:
    return ("reeving", "lead_length") if spec.reeving.lead_length > 0 else ("least_fall",)


def _fleet_wanted(spec: Hoist, scene: HoistScene) -> bool:
    known = spec.reeving.lead_length > 0 or spec.least_fall > 0
    return loaded(spec, scene) and (known or spec.checks.fleet_angle is not None)


FLEET: OneCheck = only(_fleet_wanted)(
    Check(
        code="HST111",
        title="too large a fleet angle at the drum",
        scenes=RUNNING,
        loads=("fleet_angle",),
        sense=Sense.AT_MOST,
        limit=_fleet_limit,
        needs=lambda spec, scene: () if spec.least_fall > 0 else (("reeving", "lead_length"),),
        blame=lambda spec, scene, loads: _fleet_key(spec, scene),
        repair=_fleet_key,
        what="The rope leaves the plane of its turn by no more than 4 deg (2 deg for rotation-resistant ropes): towards"
        " the first sheave, or towards the hook block at its highest.",
        why="A rope that runs off at an angle rubs on the groove, untwists, and jumps the groove at last.",
        formula="tan a = (b/2 + e)/l <= tan 4 deg",
        source="geometry; makers' manuals after ISO 16625:2013",
    )
)


def _hoop_limit(spec: Hoist, scene: Run) -> Estimate:
    """Largest hoop stress of the file.

    **Range** the shell of the drum; half of the yield strength is usual.
    **Error** none: a given value.
    **Source** the designer's choice of material.
    """
    asked = spec.checks.hoop_stress
    return Estimate.exact(math.inf if asked is None else asked)


def _hoop_needs(spec: Hoist, scene: Run) -> tuple[KeyPath, ...]:
    needs: tuple[KeyPath, ...] = (("drum", "shell_thickness"), ("checks", "hoop_stress"))
    unknown = model.layer_factor(spec) is None
    return (*needs, ("checks", "layer_factor")) if unknown else needs


def _hoop_wanted(spec: Hoist, scene: HoistScene) -> bool:
    given = spec.drum.shell_thickness is not None or spec.checks.hoop_stress is not None
    return loaded(spec, scene) and given


HOOP: OneCheck = only(_hoop_wanted)(
    Check(
        code="HST112",
        title="too much hoop stress in the drum shell",
        scenes=RUNNING,
        loads=("hoop_stress",),
        sense=Sense.AT_MOST,
        limit=_hoop_limit,
        needs=_hoop_needs,
        blame=blames("drum", "shell_thickness"),
        repair=at("drum", "shell_thickness"),
        what="The rope wound on the shell presses it together no more than its material bears (DNV 2.22:2011: 1.75"
        " times as much in two layers as in one; more layers need `checks.layer_factor`).",
        why="A shell too thin is buckled by the rope that is wound on it.",
        formula="C S/(p t) <= s",
        source="balance of a ring; DNV 2.22:2011 for C, quoted from secondary sources, to be confirmed",
    )
)

# -- class ----------------------------------------------------------------------------------------------------------


def _use_limit(spec: Hoist, scene: Run) -> Estimate:
    """Group of the mechanism that the file claims.

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
        title="a mechanism classed too low for its use",
        scenes=RUNNING,
        loads=("mechanism_group",),
        sense=Sense.AT_MOST,
        limit=_use_limit,
        needs=lambda spec, scene: (_GROUP,),
        blame=blames("class", "mechanism"),
        repair=no_repair,
        what="The group that the hours in motion and the load spectrum ask (ISO 4301-1:1986) is not above the one the"
        " file claims.",
        why="All limits of rope, drum and sheaves are those of the group.",
        formula="M(T, L) = T + L - 2 <= M,   L by k_m = sum share (P/P_max)^3",
        source="ISO 4301-1:1986",
    )
)

CHECKS: tuple[AnyCheck, ...] = (
    ROPE,
    DRUM_BEND,
    SHEAVE_BEND,
    EQUALISER_BEND,
    SLACK,
    CAPACITY,
    LAYERS,
    FLANGE,
    SLENDER,
    DEAD_WRAPS,
    FLEET,
    HOOP,
    USE,
)
"""Rope, drum and class are judged here, the drive in `checks_drive`, motions beside their scenes."""
