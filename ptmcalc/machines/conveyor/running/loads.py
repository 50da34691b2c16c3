"""Loads of a steadily running belt that follow from what its file says of belt, trough and curves."""

from collections.abc import Iterator, Mapping
from typing import cast

import numpy as np

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo, family, of
from ptmcalc.laws import belt_section, horizontal_curve, sag, vertical_curve
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.keys.belt import Transition
from ptmcalc.machines.conveyor.machine.keys.route import Bend, Curve
from ptmcalc.machines.conveyor.machine.loading import Names, filling_of, load_line_mass, pieces
from ptmcalc.machines.conveyor.machine.model import BeltLine, FloatArray
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import Run
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.running.fillings import Fillings, fillings
from ptmcalc.machines.conveyor.running.idlers import ROLL_LOADS, life_strands, roll_loads, rolls
from ptmcalc.numerics.lanes import number, value

STATIC_LOADS = (
    LoadInfo("power_motor_empty", "power at motor shafts, empty belt", units.POWER, headline=False),
    LoadInfo("section_fill", "filling ratio (mass flow/capacity)", units.SHARE, headline=False),
    LoadInfo("capacity_max", "mass flow capacity of belt section", units.FLOW, headline=False),
    LoadInfo("drum_diameter_required", "minimum drive pulley diameter of the belt", units.LENGTH, headline=False),
    LoadInfo("sag_carry", "belt sag ratio h/a, carrying strand", units.SHARE, headline=False),
    LoadInfo("sag_return", "belt sag ratio h/a, return strand", units.SHARE, headline=False),
    LoadInfo("tension_curve_max", "belt tension in concave curve, maximum", units.FORCE, headline=False),
    LoadInfo("fibre_tension_max", "belt fibre tension per width, maximum", units.LINE_FORCE, headline=False),
    LoadInfo("fibre_tension_min", "belt fibre tension per width, minimum", units.LINE_FORCE, headline=False),
    LoadInfo("belt_tension_width_max", "belt tension per width with edges, maximum", units.LINE_FORCE, headline=False),
    LoadInfo("sag_strand_max", "belt sag ratio h/a, maximum", units.SHARE, headline=False),
    *ROLL_LOADS,
)
"""Loads besides those of `loads.LOADS`, the most of them once for each part of the machine."""

OF_STATICS = frozenset(info.name for info in STATIC_LOADS)

OF_TENSION = frozenset({"belt_tension_width_max", "sag_strand_max", "roll_load_max", "bearing_life"})
"""Those without a bound where the load sharing of drives at both ends is not known."""


def static_parts(spec: Conveyor) -> Iterator[LoadInfo]:
    """Those of them that a conveyor has."""
    sections = [str(number) for number, _ in enumerate(spec.route.sections or (), 1)]
    across = list(bent(spec))
    elements: Mapping[str, list[str]] = {
        "drum_diameter_required": list(spec.all_drives),
        "sag_carry": sections,
        "sag_return": sections,
        "tension_curve_max": [str(curve.number) for curve in spec.route.hollows],
        "fibre_tension_max": across,
        "fibre_tension_min": across,
        "sag_strand_max": limited_strands(spec),
        **{info.name: list(rolls(spec)) for info in ROLL_LOADS},
        "bearing_life": life_strands(spec),
    }
    for info in STATIC_LOADS:
        if info.name in elements:
            yield from (info.of(element) for element in elements[info.name])
        else:
            yield info


def static_loads(spec: Conveyor, scene: Run, line: BeltLine, highest: float) -> dict[str, float]:
    """What the file gives enough for; `highest` is the maximum tension of the belt [N]."""
    found = _fill(spec, scene) | _drums(spec) | _sags(spec, line) | roll_loads(spec, line)
    if bent(spec):
        whatever = fillings(spec, scene)
        found |= _curves(spec, whatever) | _fibres(spec, whatever)
    if spec.belt.splice is not None and spec.belt.width is not None:
        fibres = [tension for name, tension in found.items() if family(name) == "fibre_tension_max"]
        found["belt_tension_width_max"] = max([highest / spec.belt.width, *fibres])
    return found


# -- the load on the belt, the belt on the drum ---------------------------------------------------------------------


def _fill(spec: Conveyor, scene: Run) -> dict[str, float]:
    """Stream over what the cross-section holds at its fullest place."""
    load, trough, width = spec.load, spec.idlers.carry.trough, spec.belt.width
    if load.density is None or trough is None or width is None:
        return {}
    loaded_width, surcharge_section = belt_section.EDITIONS[load.section_edition]
    bed = value(loaded_width, width), trough.middle_roll, trough.angle
    surcharge = filled(load.surcharge_angle)
    heaped = value(surcharge_section, *bed, surcharge)
    water = value(belt_section.water_section, *bed)
    places = []
    for slope, names in _places_of_load(spec, scene):
        section = water + heaped * value(belt_section.slope_reduction, slope, surcharge)
        most = value(belt_section.capacity, section, spec.speed, load.density)
        stream = load_line_mass(spec, names) * spec.speed
        places.append((value(belt_section.fill_share, stream, most), most))
    fill, most = max(places, key=lambda place: place[0])
    return {"capacity_max": most, "section_fill": fill}


def _places_of_load(spec: Conveyor, scene: Run) -> list[tuple[float, Names | None]]:
    """Slopes, and the loading points in operation before them: of a belt that is loaded all over the steepest one."""
    if spec.load.loading_points is None:
        return [(max(abs(part.slope) for part in spec.route.parts), None)]
    full = scene.model_copy(update={"load": "full"})
    loaded = zip(pieces(spec), filling_of(spec, full), strict=True)
    return [(abs(piece.part.slope), names) for piece, names in loaded]


def has_drum_data(spec: Conveyor) -> bool:
    """Whether the file says how small a drum the belt bears."""
    return spec.belt.minimum_drum_diameter is not None or spec.belt.carcass_thickness is not None


def _drums(spec: Conveyor) -> dict[str, float]:
    belt = spec.belt
    if not has_drum_data(spec):
        return {}
    least = belt.minimum_drum_diameter
    if least is None:
        least = belt_section.minimum_pulley_diameter(belt.warp or "", filled(belt.carcass_thickness))
    return {of("drum_diameter_required", name): least for name in spec.all_drives}


# -- sag, section by section ----------------------------------------------------------------------------------------


def limited_strands(spec: Conveyor) -> list[str]:
    """Strands with a sag limit of their own."""
    limits = {"carry": spec.checks.sag_carry, "return": spec.checks.sag_return}
    return [strand for strand, limit in limits.items() if limit is not None]


def _sags(spec: Conveyor, line: BeltLine) -> dict[str, float]:
    """Sag of each section at the lower of its ends, where the sections are the file's own; and the largest of all."""
    found: dict[str, float] = {}
    ratios: list[FloatArray] = []
    for strand, which in (("carry", CARRY), ("return", RETURN)):
        name, part = f"sag_{strand}", line.strand(which)
        if not part.span_weights:
            continue
        ends = line.static_ends(which)[0] + part.rises
        lows = np.minimum(ends[1:], ends[:-1])
        sags = [value(sag.sag_ratio, span, low) for span, low in zip(part.span_weights, lows, strict=True)]
        if which == RETURN:
            sags.reverse()  # sections are counted from the tail
        ratios.append(np.array(sags))
        if spec.route.sections is not None:
            found |= _of_sections(spec, name, sags)
        if strand in limited_strands(spec):
            found[of("sag_strand_max", strand)] = number(ratios[-1].max())
    if len(ratios) == 2:
        found["sag_relative_max"] = number(max(part.max() for part in ratios))
    return found


def _of_sections(spec: Conveyor, name: str, sags: list[float]) -> dict[str, float]:
    """The largest sag of each section of the file, of those of its pieces or of one for each section."""
    if len(sags) == len(spec.route.parts):
        return {of(name, str(number)): ratio for number, ratio in enumerate(sags, 1)}
    found: dict[str, float] = {}
    for piece, ratio in zip(pieces(spec), sags, strict=True):
        load = of(name, str(piece.section + 1))
        found[load] = max(found.get(load, ratio), ratio)
    return found


# -- over all fillings of the belt ----------------------------------------------------------------------------------


def _places(spec: Conveyor, place: Curve | Transition, name: str) -> FloatArray:
    """Where the tension counts: at both ends and at the break of a curve, at the drum of a transition [m]."""
    whole = spec.route.span
    if isinstance(place, Curve):
        return np.clip([place.place - place.tangent, place.place, place.place + place.tangent], 0, whole)
    return np.array([whole if name == "head" else 0.0])


def _curves(spec: Conveyor, loads: Fillings) -> dict[str, float]:
    """Largest tension in each hollow, whatever is loaded."""
    found = {}
    for curve in spec.route.hollows:
        _, most = loads.at(_places(spec, curve, ""))
        found[of("tension_curve_max", str(curve.number))] = number(most.max())
    return found


# -- fibres across the belt -----------------------------------------------------------------------------------------


def bent(spec: Conveyor) -> dict[str, Curve | Transition | Bend]:
    """Places where fibres of the belt differ in length, by the name of their loads."""
    places: dict[str, Curve | Transition | Bend] = {
        at: place for at in ("head", "tail") if (place := getattr(spec.transitions, at)) is not None
    }
    places |= {f"curve_{curve.number}": curve for curve in spec.route.curves}
    strands = ("carry", "return")
    return places | {f"bend_{bend.number}_{strand}": bend for bend in spec.route.bends for strand in strands}


def _fibres(spec: Conveyor, loads: Fillings) -> dict[str, float]:
    """Largest and smallest tension per width of any fibre, whatever is loaded.

    k = S/W + (EA/W) eps,   eps of `belt_section.transition_strains`, z/R in a curve

    A return strand without a trough is flat.
    """
    found: dict[str, float] = {}
    width, stiffness = spec.belt.width, loads.empty.stiffness
    if spec.idlers.carry.trough is None or width is None:
        return {}
    for name, place in bent(spec).items():
        if isinstance(place, Bend):
            low, high = _in_bend(loads, place, name)
        else:
            least, most = loads.at(_places(spec, place, name))
            low, high = least.min(), most.max()
        more, less = strains(spec, place, name)
        found[of("fibre_tension_max", name)] = number(high + stiffness * more) / width
        found[of("fibre_tension_min", name)] = number(low - stiffness * less) / width
    return found


def _in_bend(loads: Fillings, bend: Bend, name: str) -> tuple[float, float]:
    """Least and most tension of a strand in a horizontal curve, whatever is loaded [N]."""
    section = bend.number - 1
    if name.endswith("return"):
        return loads.on_return(section)
    ends = [loads.within(section, loaded) for loaded in (False, True)]
    return min(low for low, _ in ends), max(high for _, high in ends)


def _edge_strain(spec: Conveyor, bend: Bend, name: str) -> float:
    """Strain of the outer edge of a strand in a horizontal curve over the mean; that of the inner edge below it."""
    row = spec.idlers.back if name.endswith("return") else spec.idlers.carry
    width, trough = filled(spec.belt.width), row.trough
    middle, angle = (width, 0.0) if trough is None else (min(trough.middle_roll, width), trough.angle)
    return value(horizontal_curve.edge_strain, middle, (width - middle) / 2, angle, bend.curve.radius)


def strains(spec: Conveyor, place: Curve | Transition | Bend, name: str) -> tuple[float, float]:
    """How far the tightest fibre is above the mean strain, and the slackest below it."""
    if isinstance(place, Bend):
        edge = _edge_strain(spec, place, name)
        return edge, edge
    trough, width = spec.idlers.carry.trough, filled(spec.belt.width)
    assert trough is not None
    middle = min(trough.middle_roll, width)
    side = (width - middle) / 2
    if isinstance(place, Curve):
        edge, centre = vertical_curve.trough_heights(middle, side, trough.angle)
        heights = (centre, edge) if place.hollow else (edge, centre)
        return cast(tuple[float, float], tuple(height / place.radius for height in heights))
    return belt_section.transition_strains(place.length, middle, side, trough.angle, place.pulley_lift)
