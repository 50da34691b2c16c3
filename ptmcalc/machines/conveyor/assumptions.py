"""What is filled in where a design file leaves it out, and how wrong that may be."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor_starts import constant_losses
from ptmcalc.components.plate_motor import of_the_plate
from ptmcalc.contract.machine import Assumption, Use
from ptmcalc.laws import resistance
from ptmcalc.machines.conveyor.curves.loads import LEAST, MOST
from ptmcalc.machines.conveyor.holding.scenes import AT_REST, asks_for_hold
from ptmcalc.machines.conveyor.machine.keys.drives import Drive
from ptmcalc.machines.conveyor.machine.loading import load_line_mass
from ptmcalc.machines.conveyor.machine.loads import BRAKING_POWER, TAKEUP_CLEARANCES, TAKEUP_TOTAL
from ptmcalc.machines.conveyor.machine.model import braking_force
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import (
    IN_MOTION,
    Coast,
    ControlledStop,
    EmergencyStop,
    Run,
    Start,
    Stop,
    Stopping,
)
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.running.idlers import rolls, rolls_of_a_set
from ptmcalc.machines.conveyor.starting.permitted_starts import PERMITTED
from ptmcalc.numerics.lanes import value

_ROUGH_DRUM_SHARE = 0.05
"""Upper limit of the inertia of a drive pulley that the file omits, relative to that of the motors on the same shaft
[1]. An engineering choice for shell pulleys. A larger value widens the error bars; a smaller one excludes heavy
pulleys."""
_ROUGH_TAIL_SHARE = 0.01
"""Upper limit of the mass of a tail pulley that the file omits, relative to belt and load [1]. An engineering choice. A
larger value widens the error bars; a smaller one excludes heavy pulleys."""


_OF_BUDGET = frozenset({TAKEUP_TOTAL, "takeup_travel_thermal", "takeup_travel_installation"})
"""Loads of the take-up travel that depend on its assumed shares."""
_TABLE_ENDS = 2000.0
"""Length at which the table of the length factor C(L) ends [m]. Beyond it the lower limit of C - 1 falls as 1/L. A
larger value narrows the interval of long conveyors."""


_BY_CONDITIONS = {"good": (0.017, 0.017, 0.019), "normal": (0.020, 0.018, 0.023), "poor": (0.027, 0.023, 0.030)}
"""Coefficient f [1] by operating conditions with its lower and upper limit. The values are those of DIN 22101 (basic,
normal, unfavourable), the limits an engineering choice between them: wider ones widen the error bars of files that give
no f."""
_ANY_CONDITIONS = (0.020, 0.017, 0.030)
"""The same where the file does not describe the conditions: range of ISO 5048."""
_LEAST_DOWNHILL = 0.012
"""Minimum of f of a conveyor that lowers its load [1]; DIN 22101 calculates brakes of declines with 0.012 to 0.016. A
larger value leaves light-running declines outside the error bar."""


def _coefficient(spec: Conveyor) -> float | None:
    return _by_conditions(spec)[0] if spec.resistance.cema is None else None


def _coefficient_interval(spec: Conveyor) -> Interval:
    _, low, high = _by_conditions(spec)
    least = value(lambda climb: min(low, _LEAST_DOWNHILL) if climb < 0 else low, spec.route.climb)
    return Interval(least, high)


def _by_conditions(spec: Conveyor) -> tuple[float, float, float]:
    given = spec.resistance.conditions
    return _ANY_CONDITIONS if given is None else _BY_CONDITIONS[given]


def _secondary(spec: Conveyor) -> float | None:
    if spec.resistance.secondary_force is not None or spec.resistance.cema is not None:
        return None
    return value(resistance.length_factor, spec.route.span)


def _secondary_interval(spec: Conveyor) -> Interval:
    """Beyond the table C - 1 falls as 1/L when the secondary resistances stay what they are."""
    extra = value(resistance.length_factor, spec.route.span) - 1
    return Interval(1 + 0.75 * extra * min(_TABLE_ENDS / spec.route.span, 1.0), 1 + 1.25 * extra)


def _moving_mass(spec: Conveyor) -> float:
    per_length = (
        2 * spec.belt.mass
        + spec.idlers.carry.rotating_line_mass
        + spec.idlers.back.rotating_line_mass
        + load_line_mass(spec)
    )
    return per_length * spec.route.span


_OF_THE_BELT: tuple[Assumption[Conveyor], ...] = (
    Assumption(
        ("resistance", "coefficient"),
        units.RATIO,
        _coefficient,
        _coefficient_interval,
        "ISO 5048 and DIN 22101: 0.020 in normal conditions, 0.017 to 0.030; from 0.012 downhill; see `conditions`",
    ),
    Assumption(
        ("resistance", "secondary"),
        units.RATIO,
        _secondary,
        _secondary_interval,
        "length factor C(L) of DIN 22101 and ISO 5048; a quarter of C - 1 to either side",
    ),
    Assumption(
        ("resistance", "start_factor"),
        units.RATIO,
        lambda spec: 1.2,
        lambda spec: Interval(1.0, 1.5),
        "common practice: 1.2 to 1.5 times the running resistance",
        Use(scenes=frozenset({Start})),
    ),
)

_DEAD_BAND = 0.1
"""Dead band of a winch relative to its tension [1]: the upper end of 5 to 10 % of manufacturers. A larger value widens
the error bars."""
_LOST = 0.03
"""Power that motors and converters without brake resistor lose, relative to that of the braking motors [1]. An
engineering choice on the safe side: manufacturers state 5 to 20 %. A larger value passes faster stops."""
_LIGHT_RUNNING = 0.6
"""Minimum of the stop factor by default [1]: f = 0.016 of a light-running belt relative to f = 0.027 of the design (DIN
22101). A smaller value lengthens the upper limit of stopping time and distance."""
_LEAST_AT_REST, _MOST_AT_REST = 0.3, 0.6
"""Share of the idler resistance that acts at standstill [1]; practice takes one half. `_LEAST_AT_REST`: 0.4 of the main
resistance, which is about 0.8 of the total. `_MOST_AT_REST`: an engineering choice above practice. A wider interval
widens the error bar of the backstop torque."""
_OTHER_WEIGHT = 0.05
"""Mass of carriage and sheaves and their friction, relative to the take-up weight [1]. An engineering choice: 2 to 5 %
a sheave. A larger value widens the error bars of loads that depend on the weight."""
_ELONGATION = {"steel_cord": 0.002, "textile": 0.015}
"""Upper limit of the permanent elongation of a belt over its life [1]; makers state 0.1 to 0.2 % of steel cord and 0.5
to 1.5 % of textile. A larger value widens the error bar of the required take-up travel."""
_SMALLER_TAIL = 0.6
"""Minimum diameter of the tail pulley relative to the drive pulley [1]. An engineering choice: the belt has less
tension there. A smaller value widens the error bars."""


def _stops(spec: Conveyor) -> bool:
    return any(isinstance(scene, Stopping) for scene in spec.all_scenes)


def _dead_band(spec: Conveyor) -> float:
    return _DEAD_BAND if spec.takeup.dead_band is None else spec.takeup.dead_band


def _lowers(spec: Conveyor) -> bool:
    return any(isinstance(scene, ControlledStop) for scene in spec.all_scenes)


def _braking_power(spec: Conveyor) -> float:
    """Power with which the motors brake at their mean starting torque [W]."""
    return braking_force(spec) * spec.speed


def _elongation(spec: Conveyor) -> float:
    return _ELONGATION[_carcass(spec)]


def _weight(spec: Conveyor) -> float | None:
    """Mass of a take-up weight on two falls [kg], T = m g/2."""
    moves = any(type(scene) in IN_MOTION for scene in spec.all_scenes)
    return 2 * spec.takeup.tension / spec.gravity if moves and spec.takeup.type == "gravity" else None


def _tail_diameter(spec: Conveyor) -> float | None:
    """Diameter of the tail pulley where something depends on it [m]."""
    braked = any(brake.at == "tail" for brake in spec.brakes.values())
    return spec.main_drive.drum.diameter if spec.tail_drum.inertia or braked else None


def _is_steel(spec: Conveyor) -> bool:
    return "steel_cord" in (spec.belt.carcass, spec.belt.warp)


def _budgeted(value: Callable[[Conveyor], float]) -> Callable[[Conveyor], float | None]:
    """A value for a file that gives a share of the take-up travel."""
    return lambda spec: value(spec) if spec.takeup.budgeted else None


_OF_TRAVEL: tuple[Assumption[Conveyor], ...] = (
    Assumption(
        ("takeup", "temperature_range"),
        units.TEMPERATURE_DIFFERENCE,
        _budgeted(lambda spec: 40.0),
        lambda spec: Interval(20.0, 60.0),
        "outdoor plant in temperate climate: 40 K between winter and summer; 20 K in a building, 60 K in the sun",
        Use(loads=_OF_BUDGET),
    ),
    Assumption(
        ("takeup", "thermal_expansion"),
        units.THERMAL_EXPANSION,
        _budgeted(lambda spec: 1.2e-5 if _is_steel(spec) else 4e-5),
        lambda spec: Interval(1.1e-5, 1.3e-5) if _is_steel(spec) else Interval(1e-5, 8e-5),
        "steel wire 1.1e-5 to 1.3e-5 1/K; textile carcass between drawn yarn (1e-5 1/K or less) and the bulk polymer"
        " (polyester 6e-5 to 8e-5 1/K), tables of materials",
        Use(loads=_OF_BUDGET),
    ),
    Assumption(
        ("takeup", "installation"),
        units.LENGTH,
        _budgeted(lambda spec: 1.5),
        lambda spec: Interval(0.5, 3.0),
        "one splice length: 0.5 m (one step) to 3 m (several steps, wide belt), DIN 22101 and belt manufacturers",
        Use(loads=_OF_BUDGET),
    ),
    Assumption(
        ("takeup", "position"),
        units.LENGTH,
        lambda spec: filled(spec.takeup.stroke) / 2 if spec.takeup.budgeted and spec.takeup.type == "gravity" else None,
        lambda spec: Interval(*(part * filled(spec.takeup.stroke) for part in (0.25, 0.75))),
        "the weight is set within the middle half of its travel",
        Use(loads=frozenset({*TAKEUP_CLEARANCES})),
    ),
)

_OF_STANDSTILL: tuple[Assumption[Conveyor], ...] = (
    Assumption(
        ("resistance", "stop_factor"),
        units.RATIO,
        lambda spec: 1.0 if _stops(spec) else None,
        lambda spec: Interval(_LIGHT_RUNNING, 1.0),
        "DIN 22101: f from 0.016 in good to 0.027 in poor conditions; a lightly running belt stops later",
        Use(scenes=frozenset({Stop, EmergencyStop, ControlledStop, Coast})),
    ),
    Assumption(
        ("resistance", "rest_factor"),
        units.RATIO,
        lambda spec: AT_REST if any(asks_for_hold(spec, one) for one in spec.all_scenes) else None,
        lambda spec: Interval(_LEAST_AT_REST, _MOST_AT_REST),
        "practice for backstops: half of the running resistance of the idlers, none of loading points and cleaners",
        Use(loads=frozenset({"backstop_torque", "forward_torque"})),
    ),
    Assumption(
        ("takeup", "mass"),
        units.MASS,
        _weight,
        lambda spec: Interval(*((1 + part) * (_weight(spec) or 0.0) for part in (-_OTHER_WEIGHT, _OTHER_WEIGHT))),
        "weight on two falls, m = 2 T/g; friction of the sheaves and the carriage 5 %",
    ),
    Assumption(
        ("takeup", "deviation"),
        units.RATIO,
        lambda spec: 0.0 if spec.takeup.type == "winch" else None,
        lambda spec: Interval(-_dead_band(spec), _dead_band(spec)),
        "automatic winches do not act within 5 to 10 % of their tension; `dead_band`, 10 % where the file gives none",
    ),
    Assumption(
        ("takeup", "permanent_elongation"),
        units.SHARE,
        lambda spec: 0.0 if spec.takeup.stroke is not None else None,
        lambda spec: Interval(0.0, _elongation(spec)),
        "belt manufacturers: 0.1 to 0.2 % of steel cord belts, 0.5 to 1.5 % of textile belts over their life",
    ),
    *_OF_TRAVEL,
    Assumption(
        ("tail_drum", "diameter"),
        units.LENGTH,
        _tail_diameter,
        lambda spec: Interval(_SMALLER_TAIL * spec.main_drive.drum.diameter, spec.main_drive.drum.diameter),
        "equal to the drive pulley, or the next smaller pulley of the series",
    ),
)

_OF_THE_CONVERTERS: Assumption[Conveyor] = Assumption(
    ("checks", "braking_power"),
    units.POWER,
    lambda spec: _LOST * _braking_power(spec) if _lowers(spec) else None,
    lambda spec: Interval(_LOST * _braking_power(spec), _braking_power(spec)),
    "without brake resistor or feedback 3 % of the motors' power, lost in motor and converter; with them all of it",
    Use(loads=frozenset({BRAKING_POWER}), limits_only=True),
)

_OF_THE_TAIL: tuple[Assumption[Conveyor], ...] = (
    Assumption(
        ("tail_drum", "inertia"),
        units.INERTIA,
        lambda spec: 0.0,
        lambda spec: Interval(
            0.0,
            _ROUGH_TAIL_SHARE
            * _moving_mass(spec)
            * (spec.tail_drum.diameter or spec.main_drive.drum.diameter) ** 2
            / 4,
        ),
        "not given; seldom above 1 % of the mass of belt and load",
    ),
)


_FATIGUE = {"steel_cord": (0.45, 0.40, 0.50), "textile": (0.325, 0.30, 0.35)}
"""Reference fatigue strength of the splice relative to the strength of the belt, and its interval [1]. Steel cord: 0.45
is usual, 0.05 to either side an engineering choice; textile, stepped splices: 0.30 to 0.35. A larger value passes
weaker belts; a wider interval leaves more verdicts undecided."""


def _carcass(spec: Conveyor) -> str:
    return "steel_cord" if "steel_cord" in (spec.belt.carcass, spec.belt.warp) else "textile"


_OF_THE_SPLICE: Assumption[Conveyor] = Assumption(
    ("belt", "splice", "reference_strength"),
    units.RATIO,
    lambda spec: _FATIGUE[_carcass(spec)][0] if spec.belt.splice is not None else None,
    lambda spec: Interval(*_FATIGUE[_carcass(spec)][1:]),
    "DIN 22101:2011 as quoted by belt manufacturers: 0.45 steel cord, 0.30 to 0.35 stepped textile splices",
    Use(loads=frozenset({"belt_tension_width_max", "tension_max"}), limits_only=True),
)

_SHARES = {3: (0.675, 0.65, 0.70), 2: (0.5, 0.5, 0.55)}
"""Share of the load of an idler set on its most loaded roll by the number of rolls, and its interval [1]. Three rolls:
0.65 to 0.7 on the centre roll; two: half, up to 10 % more of an eccentric load, an engineering choice. A larger value
shortens the bearing life."""


_OF_THE_ROLLS = Use(frozenset({Run}), frozenset({"roll_load_max", "bearing_life"}))
"""Loads that depend on the load of a roll."""


def _of_the_rolls(spec: Conveyor) -> Iterator[Assumption[Conveyor]]:
    """Load of the most loaded roll of each strand."""
    for strand in rolls(spec):
        if (count := rolls_of_a_set(spec, strand)) in _SHARES:
            yield _load_share(strand, *_SHARES[count])
        yield Assumption(
            ("idlers", strand, "roll", "dynamic_factor"),
            units.RATIO,
            lambda spec: 1.2,
            lambda spec: Interval(1.1, 1.3),
            "handbooks of idler manufacturers: 1.1 to 1.3 by belt speed and lump size",
            _OF_THE_ROLLS,
        )


def _load_share(strand: str, usual: float, least: float, most: float) -> Assumption[Conveyor]:
    return Assumption(
        ("idlers", strand, "roll", "load_share"),
        units.RATIO,
        lambda spec: usual,
        lambda spec: Interval(least, most),
        "handbooks of idler manufacturers: 0.65 to 0.7 on the centre roll of three, half on each of two",
        _OF_THE_ROLLS,
    )


_OF_THE_LOAD: tuple[Assumption[Conveyor], ...] = (
    Assumption(
        ("resistance", "cema", "flexure"),
        units.RATIO,
        lambda spec: 0.03 if spec.resistance.cema is not None else None,
        lambda spec: Interval(0.016, 0.035),
        "CEMA: K_y of its table is between 0.016 and 0.035; 0.03 for a first estimate",
    ),
    Assumption(
        ("load", "surcharge_angle"),
        units.ANGLE,
        lambda spec: math.radians(15) if spec.load.density is not None else None,
        lambda spec: Interval(math.radians(10), math.radians(20)),
        "ISO 5048 and CEMA: 10 to 20 deg for most materials in motion, 5 deg for free-flowing ones",
        Use(loads=frozenset({"section_fill", LEAST, MOST})),  # and limits of the drift in curves
    ),
)


_EDGE_SHARE, _EDGE = 0.05, 0.025
"""Free edge of a belt beside its load: share of the width [1] and length [m], half of B - (0.9 B - 50 mm) of ISO
5048:1989. The wing rolls of ISO 1537 are longer than the belt on them by as much. A larger value passes narrower
curves."""
_EDGE_TOLERANCE = 0.2
"""Deviation of the standard roll lengths from that edge [1]: 15 % for belts of 650 to 2000 mm, and 5 % for the gap
between the rolls; an engineering choice. A larger value leaves more verdicts undecided."""


def _edge(spec: Conveyor, factor: float = 1.0) -> float | None:
    """Distance from the edge of the belt to the end of the wing roll, where a route has horizontal curves [m]."""
    if not spec.route.bends or spec.belt.width is None:
        return None
    return factor * (_EDGE_SHARE * spec.belt.width + _EDGE)


_OF_CURVES: Assumption[Conveyor] = Assumption(
    ("checks", "belt_drift"),
    units.LENGTH,
    _edge,
    lambda spec: Interval(*(filled(_edge(spec, 1 + part)) for part in (-_EDGE_TOLERANCE, _EDGE_TOLERANCE))),
    "ISO 5048: usable width 0.9 B - 50 mm; ISO 1537: wing rolls longer than the belt on them by 0.05 B + 25 mm",
    Use(loads=frozenset({LEAST, MOST}), limits_only=True),
)


def _rubbing(spec: Conveyor) -> Iterator[Assumption[Conveyor]]:
    """Friction at skirt plates and scrapers."""
    paths: list[KeyPath] = []
    for name, force in spec.resistance.forces.items():
        if force.skirt is not None or force.scraper is not None:
            paths.append(("resistance", "forces", name, "skirt" if force.skirt is not None else "scraper"))
    points = (spec.load.loading_points or {}).items()
    paths += [("load", "loading_points", name, "skirt") for name, point in points if point.skirt is not None]
    for path in paths:
        yield Assumption(
            (*path, "friction"),
            units.RATIO,
            lambda spec: 0.6,
            lambda spec: Interval(0.5, 0.7),
            "ISO 5048: 0.5 to 0.7 at skirt plates and belt cleaners",
        )


def assumptions(spec: Conveyor) -> Iterator[Assumption[Conveyor]]:
    """What is assumed of the belt, of what it carries, of every drive, and of the tail drum."""
    for assumed in _OF_THE_BELT:
        beyond = assumed.path[-1] == "secondary" and spec.route.span > _TABLE_ENDS
        yield replace(assumed, source=f"{assumed.source}; the table ends at 2000 m") if beyond else assumed
    yield from _OF_STANDSTILL
    yield from _OF_THE_LOAD
    yield _OF_THE_SPLICE
    yield _OF_CURVES
    yield from _of_the_rolls(spec)
    yield from _rubbing(spec)
    for name, drive in spec.all_drives.items():
        yield from _of_a_drive(spec.drive_path(name), drive)
    yield _OF_THE_CONVERTERS  # by the motors of the drives
    yield from _OF_THE_TAIL


def _of_a_drive(path: KeyPath, drive: Drive) -> Iterator[Assumption[Conveyor]]:
    def rotor(spec: Conveyor) -> float:
        return filled(spec.value_at((*path, "motor", "inertia")))

    yield from of_the_plate((*path, "motor"), drive.motor, Use(scenes=frozenset({Start})))
    yield Assumption(
        (*path, "gear", "efficiency"),
        units.RATIO,
        lambda spec: 0.94,
        lambda spec: Interval(0.90, 0.97),
        "two to three stages of helical or bevel gears, 0.98 to 0.99 each",
    )
    yield Assumption(
        (*path, "coupling_inertia"),
        units.INERTIA,
        lambda spec: 0.15 * rotor(spec),
        lambda spec: Interval(0.10 * rotor(spec), 0.25 * rotor(spec)),
        "couplings and gear increase the rotor inertia by a factor of 1.1 to 1.25 (lecture notes, Kramatorsk 2007)",
    )
    if drive.motor.no_load_starts is not None:
        yield constant_losses((*path, "motor"), Use(frozenset({Start}), frozenset({PERMITTED.name})))
    if drive.converter is not None and drive.converter.follows is not None:
        yield Assumption(
            (*path, "converter", "deviation"),
            units.SHARE,
            lambda spec: 0.0,
            lambda spec: Interval(-0.05, 0.05),
            "torque control of converters without speed encoder: 2 to 5 %; an engineering choice",
        )
    if drive.drum.tolerance is not None:
        most = drive.drum.tolerance
        yield Assumption(
            (*path, "drum", "deviation"),
            units.LENGTH,
            lambda spec: 0.0,
            lambda spec: Interval(-most, most),
            "`tolerance` of the file: manufacture and wear of the lagging",
        )
    yield Assumption(
        (*path, "drum", "inertia"),
        units.INERTIA,
        lambda spec: 0.0,
        lambda spec: Interval(0.0, _ROUGH_DRUM_SHARE * drive.motor.count * rotor(spec) * drive.gear.ratio**2),
        "neglected; a shell pulley seldom has more than 5 % of the motor inertia at the same shaft",
    )
