"""Loads of a steadily running belt that follow from what its file says of belt, trough and curves."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import cast

import numpy as np

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo, family, of
from ptmcalc.laws import belt_section, horizontal_curve, sag, vertical_curve
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.drives import running
from ptmcalc.machines.conveyor.keys.belt import Transition
from ptmcalc.machines.conveyor.keys.route import Bend, Curve
from ptmcalc.machines.conveyor.model import BeltLine, FloatArray, load_line_mass
from ptmcalc.machines.conveyor.resistances import filled
from ptmcalc.machines.conveyor.running.idlers import ROLL_LOADS, life_strands, roll_loads, rolls
from ptmcalc.machines.conveyor.spec import Conveyor, Run
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
    found = _fill(spec) | _drums(spec) | _sags(spec, line) | roll_loads(spec, line)
    if bent(spec):
        whatever = fillings(spec, scene)
        found |= _curves(spec, whatever) | _fibres(spec, whatever)
    if spec.belt.splice is not None and spec.belt.width is not None:
        fibres = [tension for name, tension in found.items() if family(name) == "fibre_tension_max"]
        found["belt_tension_width_max"] = max([highest / spec.belt.width, *fibres])
    return found


# -- the load on the belt, the belt on the drum ---------------------------------------------------------------------


def _fill(spec: Conveyor) -> dict[str, float]:
    """Stream over what the cross-section holds at its steepest place."""
    load, trough, width = spec.load, spec.idlers.carry.trough, spec.belt.width
    if load.density is None or trough is None or width is None:
        return {}
    loaded_width, surcharge_section = belt_section.EDITIONS[load.section_edition]
    bed = value(loaded_width, width), trough.middle_roll, trough.angle
    surcharge = filled(load.surcharge_angle)
    steepest = max(abs(part.slope) for part in spec.route.parts)
    heaped = value(surcharge_section, *bed, surcharge)
    section = value(belt_section.water_section, *bed)
    section += heaped * value(belt_section.slope_reduction, steepest, surcharge)
    most = value(belt_section.capacity, section, spec.speed, load.density)
    stream = load_line_mass(spec) * spec.speed
    return {"capacity_max": most, "section_fill": value(belt_section.fill_share, stream, most)}


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
            found |= {of(name, str(number)): ratio for number, ratio in enumerate(sags, 1)}
        if strand in limited_strands(spec):
            found[of("sag_strand_max", strand)] = number(ratios[-1].max())
    if len(ratios) == 2:
        found["sag_relative_max"] = number(max(part.max() for part in ratios))
    return found


# -- over all fillings of the belt ----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Fillings:
    """The belt over all choices of loaded sections: the empty belt, what the load of each section adds to the tension
    of the carry strand at its downstream end and at all places [N], to that of the return strand [N], marks between the
    sections [m]."""

    empty: BeltLine
    pulls: FloatArray
    everywhere: FloatArray
    back: FloatArray
    marks: FloatArray

    def at(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Least and most tension at places along the carry strand [m].

            S(x) = S(0) + sum_k x_k dS_k;   least: x_k = 1 where dS_k < 0,   most: where dS_k > 0

        **Source** `laws.strand_tension.worst_loading`: a linear function on a cube has its extreme at a corner.
        """
        passed = np.clip((places[:, None] - self.marks[:-1]) / np.diff(self.marks), 0, 1)
        gains = passed * self.pulls + self.everywhere
        base = self.empty.static(CARRY, places / self.empty.carry.length)
        return base + np.minimum(gains, 0).sum(axis=1), base + np.maximum(gains, 0).sum(axis=1)

    def within(self, section: int, loaded: bool) -> tuple[float, float]:
        """Least and most tension in a section, counted from 0, that is itself loaded or empty [N].

        In a section the tension is linear between its ends, whatever else is loaded.
        """
        places = self.marks[section : section + 2]
        passed = np.clip((places[:, None] - self.marks[:-1]) / np.diff(self.marks), 0, 1)
        gains = passed * self.pulls + self.everywhere
        own, others = gains[:, section], np.delete(gains, section, axis=1)
        base = self.empty.static(CARRY, places / self.empty.carry.length) + (own if loaded else 0.0)
        least, most = base + np.minimum(others, 0).sum(axis=1), base + np.maximum(others, 0).sum(axis=1)
        return number(least.min()), number(most.max())

    def on_return(self, section: int) -> tuple[float, float]:
        """Least and most tension of the return strand below a section, counted from 0 [N]."""
        places = self.empty.back.length - self.marks[section : section + 2]
        base = self.empty.static(RETURN, places / self.empty.back.length)
        return number(base.min() + np.minimum(self.back, 0).sum()), number(base.max() + np.maximum(self.back, 0).sum())


def fillings(spec: Conveyor, scene: Run) -> Fillings:
    """All fillings of a conveyor in steady running.

    A loaded section adds its pull to the tension downstream of it, less the share that drives at the tail take; in a
    fixed loop the mean of that is taken off everywhere. All is linear in the load of each section; on the curves of
    motors the share of the tail is the secant between the empty and the full belt.
    """
    count = len(spec.route.parts)
    empty, full = (running(spec, scene, [loaded] * count) for loaded in (False, True))
    pulls = np.diff(full.carry.rises) - np.diff(empty.carry.rises)
    everywhere = np.array([full.tail_force - empty.tail_force] + [0.0] * (count - 1))
    if full.tail_pull or empty.tail_pull:
        more = full.tail_pull - empty.tail_pull
        pulled = full.static_resistance - empty.static_resistance + more
        everywhere = everywhere - (more / pulled if pulled else 0.0) * (pulls + everywhere)
    step = everywhere
    if full.weight_at_tail:  # half of what the load adds at the tail pulley lowers the tension before it
        everywhere = everywhere / 2
    marks, whole = np.array(full.carry.marks), full.carry.length
    if full.fixed_length:
        rest = np.diff(marks) / 2 + whole - marks[1:]
        everywhere = everywhere - (pulls * rest + everywhere * whole) / (whole + full.back.length)
    return Fillings(empty, pulls, everywhere, everywhere - step, marks)


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
