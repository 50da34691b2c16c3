"""The checks of a hoist's drum: room, layers, flanges, fleet angle, shell."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, at, blames, no_needs, only
from ptmcalc.contract.limits import key
from ptmcalc.laws import hoist_class
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.model import loaded
from ptmcalc.machines.hoist.machine.spec import Hoist, HoistScene, Run
from ptmcalc.machines.hoist.statics.checks_rope import RUNNING, OneCheck

_FLEET, _FLEET_RESISTANT = math.radians(4), math.radians(2)
"""Largest fleet angle by default [rad]: 4 deg (`_FLEET`), and 2 deg of rotation-resistant ropes (`_FLEET_RESISTANT`);
makers' manuals, ISO 16625:2013 as they quote it. A larger angle accepts more wear of rope and grooves."""


CAPACITY: OneCheck = only(loaded)(
    Check(
        code="HST106",
        hazard=True,
        title="required drum length",
        question="Does the drum take the whole rope in the specified layers?",
        failure="drum is too short for the rope",
        scenes=RUNNING,
        loads=("drum_length_required",),
        sense=Sense.AT_MOST,
        limit=key(
            "drum.length", meaning="Length of the wound part of the drum", valid="any drum", error="none: a given value"
        ),
        needs=no_needs,
        blame=blames("drum", "length"),
        repair=at("drum", "length"),
        what="The required drum length is at most the length of the wound part. The rope of the whole lifting height"
        " and the dead wraps fit in the layers of the file.",
        why="Excess rope passes over the flange, or piles up and is crushed.",
        formula="p (l/(2 pi) + lost)/sum R_k <= L",
        source="geometry of the drum",
    )
)


def _layers_limit(spec: Hoist, scene: Run) -> Estimate:
    """Permissible layers of the file, otherwise those of the drum; one in the groups M7 and M8.

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
        title="number of rope layers",
        question="Is the number of rope layers within its limit?",
        failure="drum carries too many rope layers",
        scenes=RUNNING,
        loads=("drum_layers",),
        sense=Sense.AT_MOST,
        limit=_layers_limit,
        needs=no_needs,
        blame=blames("drum", "layers"),
        repair=at("drum", "length"),
        what="With the hook at its highest position, the number of rope layers is at most the limit of the file or of"
        " the group.",
        why="Each layer crushes the layer below it. At every crossover an impact loads the rope.",
        formula="layers(l) <= n",
        source="geometry of the drum; ISO 4308-1:2003 for the groups M7 and M8",
    )
)


FLANGE: OneCheck = only(lambda spec, scene: loaded(spec, scene) and spec.drum.flange_height is not None)(
    Check(
        code="HST108",
        hazard=True,
        title="flange height above the top layer",
        question="Is the flange height above the top rope layer sufficient?",
        failure="drum flanges are too low",
        scenes=RUNNING,
        loads=("flange_margin",),
        sense=Sense.AT_LEAST,
        limit=key(
            "checks.flange_margin",
            meaning="Minimum height of the flanges above the top layer, 1.5 rope diameters by default",
            valid="drums with flanges",
            source="manufacturers' manuals; EN 14492-2:2006 requires the same",
        ),
        needs=no_needs,
        blame=blames("drum", "flange_height"),
        repair=at("drum", "flange_height"),
        what="The height of the flanges above the top layer is at least the limit, 1.5 rope diameters by default.",
        why="A flange cuts a rope that passes over it.",
        formula="(h - (d + (n - 1) step))/d >= 1.5",
        source="manufacturers' manuals; EN 14492-2:2006",
    )
)


SLENDER: OneCheck = only(loaded)(
    Check(
        code="HST109",
        title="drum slenderness L/D",
        question="Is the drum short enough for its diameter?",
        failure="drum is too slender",
        scenes=RUNNING,
        loads=("drum_slenderness",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.drum_slenderness",
            meaning="Maximum ratio of wound length to drum diameter, 5 by default",
            valid="drums on two bearings",
            error="none: an engineering rule; above 3 the shell is also verified for bending",
            source="handbooks of lifting machines",
        ),
        needs=no_needs,
        blame=blames("drum", "length"),
        repair=at("drum", "diameter"),
        what="The total length of all wound parts is at most the limit, 5 drum diameters by default. A larger drum"
        " takes the rope in fewer wraps. Fewer falls, more layers or a second rope also reduce the number of"
        " wraps.",
        why="A slender drum bends, and its rope leaves it at a large angle.",
        formula="n L/D <= 5",
        source="handbooks of lifting machines",
    )
)


DEAD_WRAPS: OneCheck = only(loaded)(
    Check(
        code="HST110",
        hazard=True,
        title="dead wraps on the drum",
        question="Do enough wraps stay on the drum at the lowest hook position?",
        failure="too few dead wraps stay on the drum",
        scenes=RUNNING,
        loads=("dead_wraps",),
        sense=Sense.AT_LEAST,
        limit=key(
            "checks.dead_wraps",
            meaning="Minimum number of dead wraps, 2 by default",
            valid="ropes clamped to the drum",
            source="manufacturers' manuals: 2, some rules 3; rope friction (Euler-Eytelwein) carries most of the rope"
            " force",
        ),
        needs=no_needs,
        blame=blames("drum", "dead_wraps"),
        repair=at("drum", "dead_wraps"),
        what="With the hook at its lowest position, the number of dead wraps on the drum is at least the limit, 2 by"
        " default.",
        why="The friction of the dead wraps holds the rope. The clamps alone do not hold it.",
        formula="z >= 2",
        source="manufacturers' manuals; ISO 4308-1",
    )
)


def _fleet_limit(spec: Hoist, scene: Run) -> Estimate:
    """Largest fleet angle: 4 deg, 2 deg for rotation-resistant ropes, or the value of the file.

    **Range** drums and sheaves with grooves of the usual depth.
    **Error** none: a chosen limit.
    **Source** manufacturers' manuals, which quote ISO 16625:2013.
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
        title="fleet angle at the drum",
        question="Is the fleet angle within its limit?",
        failure="fleet angle is too large",
        scenes=RUNNING,
        loads=("fleet_angle",),
        sense=Sense.AT_MOST,
        limit=_fleet_limit,
        needs=lambda spec, scene: () if spec.least_fall > 0 else (("reeving", "lead_length"),),
        blame=lambda spec, scene, loads: _fleet_key(spec, scene),
        repair=_fleet_key,
        what="The fleet angle is at most the limit: 4 deg by default, 2 deg for rotation-resistant ropes. It is the"
        " angle between the rope and the plane of its wrap. The rope leads to the first sheave, or to the hook"
        " block at its highest position.",
        why="A rope that leaves the drum at an angle rubs on the groove, untwists and finally jumps the groove.",
        formula="tan a = (b/2 + e)/l <= tan 4 deg",
        source="geometry; manufacturers' manuals after ISO 16625:2013",
    )
)


def _hoop_needs(spec: Hoist, scene: Run) -> tuple[KeyPath, ...]:
    needs: tuple[KeyPath, ...] = (("drum", "shell_thickness"), ("checks", "hoop_stress"))
    unknown = model.layer_factor(spec) is None
    return (*needs, ("checks", "layer_factor")) if unknown else needs


def _hoop_wanted(spec: Hoist, scene: HoistScene) -> bool:
    thickness_alone = spec.drum.shell_thickness is not None and spec.drum.shell is None
    return loaded(spec, scene) and (thickness_alone or spec.checks.hoop_stress is not None)


HOOP: OneCheck = only(_hoop_wanted)(
    Check(
        code="HST112",
        hazard=True,
        title="drum shell hoop stress",
        question="Is the hoop stress of the drum shell within its limit?",
        failure="drum shell is overstressed",
        scenes=RUNNING,
        loads=("hoop_stress",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.hoop_stress",
            meaning="Permissible hoop stress of the file",
            valid="the shell of the drum; half of the yield strength is usual",
            error="none: a given value",
            source="the designer's choice of material",
        ),
        needs=_hoop_needs,
        blame=blames("drum", "shell_thickness"),
        repair=at("drum", "shell_thickness"),
        what="The hoop stress of the shell under the wound rope is at most the limit of its material. DNV 2.22:2011"
        " applies 1.75 times as much stress for two layers as for one. More layers require `checks.layer_factor`.",
        why="The wound rope buckles a shell that is too thin.",
        formula="C S/(p t) <= s",
        source="balance of a ring; DNV 2.22:2011 for C, quoted from secondary sources, to be confirmed",
    )
)

CHECKS_OF_DRUM: tuple[AnyCheck, ...] = (
    CAPACITY,
    LAYERS,
    FLANGE,
    SLENDER,
    DEAD_WRAPS,
    FLEET,
    HOOP,
)
