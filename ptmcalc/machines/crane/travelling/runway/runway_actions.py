"""Actions of a travelling crane on its runway by EN 1991-3:2006."""

from collections.abc import Iterator

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.components.buffer import stopped
from ptmcalc.contract.result import Found, Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import buffer, skew
from ptmcalc.laws import runway_actions as laws
from ptmcalc.machines.crane.travelling.machine import guides, model
from ptmcalc.machines.crane.travelling.machine.keys.actions import Actions
from ptmcalc.machines.crane.travelling.machine.loads import names
from ptmcalc.machines.crane.travelling.machine.model import filled
from ptmcalc.machines.crane.travelling.machine.scenes import Runway
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.runway import loads as told
from ptmcalc.machines.crane.travelling.runway import phis
from ptmcalc.machines.crane.travelling.runway.groups import GROUPS, LIGHT, LOADED, OUT_OF_SERVICE, TO_COMPARE, Group
from ptmcalc.machines.crane.travelling.runway.loads import OF_THE_RUNWAY
from ptmcalc.machines.crane.travelling.runway.rails import Rails, drive_force, transverse

Numbers = dict[str, float]
_COMPARE = "to be compared with EN 1991-3:2006"


def run(spec: Travelling, scene: Runway, carried: frozenset[str], level: int) -> Result:
    """Actions of the crane on its runway, group of loads by group of loads, as EN 1991-3:2006 has them.

        Q = (phi_c Q_c + phi_h Q_h)/n by levers over the span,   K = mu sum Q_min,   H_L = phi_5 K/2
        M = K (xi_1 - 1/2) l,   H_T,1 = phi_5 xi_2 M/a,   H_T,2 = phi_5 xi_1 M/a
        S = f sum Q_r (1 - sum e/(n h)),   f = 0.3 (1 - exp(-250 alpha)),   H_B,1 = phi_7 v_1 (m_c S_B)^(1/2)

    An action without its data in the file has no value, and the table states what is missing. The wheels of a corner
    share its load. Skewing forces of a wheel pair are those of the corners at one end of the crane. S is xi_2 of its
    value where the wheels of the other rail are movable.

    **Range** two rails; trolley and hook midway between the wheels; equal driven wheels on both rails; the hook block
    is part of the hoist load, which is absent from the unloaded crane.
    **Error** exact for these formulas; the values of groups 6 to 10 are to be compared with the standard.
    **Source** EN 1991-3:2006, section 2 and table 2.2, as an open program has it (github.com/pmav99/crane_loads), with
    the equilibrium of every row derived.
    """
    given = spec.runway
    assert given is not None
    rails, known = Rails.of(spec, scene), phis.of_actions(spec, given)
    found: dict[str, Found] = {}
    for group in GROUPS:
        note = _COMPARE if group.name in TO_COMPARE else ""
        for name, value in _of_group(spec, scene, given, rails, known, group):
            found[of(name, group.name)] = Found(Estimate.exact(value), note=note)
    least = min((one.estimate.value, name) for name, one in found.items() if name.startswith("runway_wheel_m"))
    found["runway_wheel_least"] = Found(Estimate.exact(least[0]), note=f"group {least[1].partition('[')[2][:-1]}")
    singles = dict(_of_skewing(spec, scene, rails)) | dict(_of_fatigue(given, rails, known))
    return Result(found | {name: Found(Estimate.exact(value)) for name, value in singles.items()}, work=1)


def _of_group(
    spec: Travelling, scene: Runway, given: Actions, rails: Rails, known: Numbers, group: Group
) -> Iterator[tuple[str, float]]:
    """The actions of a group of which the file has the data: load and value."""
    on_crane = phis.of_group(spec, group.crane, known)
    assert on_crane is not None, "phi1 and phi4 need no data"
    on_hoist = phis.of_group(spec, group.hoist, known) if group.hoist is not None else None
    largest, other = (info.name for info in told.WHEELS[:2])
    if on_hoist is not None:
        yield from zip((largest, other), rails.loaded(on_crane, on_hoist), strict=True)
    near, least = (info.name for info in told.WHEELS[2:])
    yield from zip((least, near), rails.unloaded(on_crane), strict=True)
    if group.drives:
        yield from _of_drives(spec, given, rails, known, on_crane, group.drives)
    swings = given.suspension == "swinging"
    if group.trolley and swings:
        yield told.TROLLEY.name, _trolley_force(spec, scene)
    if group.wind and spec.wind is not None:
        yield from _of_wind(spec, scene, group)
    if group.buffers:
        if swings:
            yield told.TROLLEY_BUFFER.name, _trolley_force(spec, scene)
        yield from _of_buffers(spec, given, rails, known)


def _of_drives(
    spec: Travelling, given: Actions, rails: Rails, known: Numbers, on_crane: float, shared: str
) -> Iterator[tuple[str, float]]:
    """K and H_L; H_T where the factor of its load shares is known."""
    force = drive_force(spec, given, rails, on_crane)
    if force is None:
        return
    whole, along, light, loaded = (info.name for info in told.DRIVES)
    yield from ((whole, force), (along, known["phi5"] * force / 2))
    on_hoist = phis.of_group(spec, shared, known)
    if on_hoist is not None:
        both = transverse(spec, force, *rails.loaded(on_crane, on_hoist))
        yield from ((light, known["phi5"] * both[0]), (loaded, known["phi5"] * both[1]))


def _trolley_force(spec: Travelling, scene: Runway) -> float:
    """Of a trolley that accelerates or hits its buffers with a swinging load [N]."""
    return laws.TROLLEY_SHARE * (spec.trolley.mass + model.hanging(spec, scene)) * spec.gravity


def _of_wind(spec: Travelling, scene: Runway, group: Group) -> Iterator[tuple[str, float]]:
    wind = spec.wind
    assert wind is not None
    storm = group.wind == OUT_OF_SERVICE
    pressure = wind.pressure_storm if storm else model.largest_pressure(spec)
    if pressure is not None:
        hangs = not storm and group.hoist is not None
        on_load = model.wind_on_load(spec, scene, pressure) if hangs else 0.0
        yield told.WIND.name, model.wind_force(spec, pressure) + on_load


def _of_buffers(spec: Travelling, given: Actions, rails: Rails, known: Numbers) -> Iterator[tuple[str, float]]:
    """Of the buffers on the rail with the larger share of the mass, by the energy of that share, or of a single buffer;
    none where they bottom out."""
    buffers = spec.buffers
    if buffers is None:
        return
    larger, other = rails.worst.loads(1.0, 1.0 if given.suspension == "guided" else 0.0)
    single = buffers.count == 1
    mass = rails.per_rail * (larger + other if single else 2 * larger) / spec.gravity
    hit = stopped(buffers, mass, given.speed_share * spec.speed, 0.0)
    if hit.left == 0.0:
        factor = known.get("phi7", buffer.buffer_factor(hit.energy_share))
        yield told.BUFFER.name, factor * hit.force / (1 if single else 2)


def _of_skewing(spec: Travelling, scene: Runway, rails: Rails) -> Iterator[tuple[str, float]]:
    """Angle, friction and forces of skewing, with the front guide on either rail."""
    angle = skewing_angle(spec)
    if angle is None:
        return
    friction = float(skew.skew_friction(min(angle, skew.LARGEST_ANGLE), skew.ADHESION["cleaned"]))
    yield from (("runway_skew_angle", angle), ("runway_skew_share", friction))
    flanges = spec.guide is None or spec.guide.type == "flanges"
    two = spec.guide.rail_two if spec.guide is not None else skew.FIXED
    larger, smaller = rails.worst.loads(1.0, 1.0)
    if smaller <= 0:
        return
    share = larger / (larger + smaller)
    whole = model.weight(spec, scene)
    for rail, centre in ((LIGHT, share), (LOADED, 1 - share)):
        forces = skew.skew_forces(
            friction, guides.distances(spec), guides.coupled(spec), np.full(2, whole / 2), centre, spec.gauge, two
        )
        guide = float(forces[:2].sum())
        yield of(told.GUIDE.name, rail), guide
        for pair in (0, 1):
            values = [forces[2, pair], forces[0, pair], forces[1, pair]]
            if flanges and pair == 0:
                values.append(guide - forces[0, pair])
            for info, value in zip(told.BY_PAIR, values, strict=False):
                yield of(info.name, f"{rail}, {pair + 1}"), float(value)


def skewing_angle(spec: Travelling) -> float | None:
    """By the file, or by EN 1991-3 from the guide; None without either [rad]."""
    given, guide = spec.runway, spec.guide
    if given is not None and given.skew_angle is not None:
        return given.skew_angle
    if guide is None:
        return None
    least = skew.LEAST_PLAY[guide.type]
    apart = guides.guides_apart(spec)
    return skew.skew_angle(guide.clearance, filled(guide.wear), apart, least, guide.tolerance, skew.EN_1991_3)


def _of_fatigue(given: Actions, rails: Rails, known: Numbers) -> Iterator[tuple[str, float]]:
    if given.fatigue_class is None or "phi2" not in known:
        return
    crane, hoist = known["phi1"], known["phi2"]
    if given.fatigue_factor == "larger":
        crane = hoist = max(crane, hoist)
    place = rails.worst
    pair = zip(("runway_fatigue_normal", "runway_fatigue_shear"), laws.DAMAGE_FACTORS[given.fatigue_class], strict=True)
    for name, damage in pair:
        value = laws.fatigue_wheel_load(place.crane[0], place.hoist[0], crane, hoist, damage)
        yield name, value


RUNWAY_ACTIONS: Solver[Travelling, Runway] = Solver(
    name="runway_actions",
    title="actions on the runway, EN 1991-3",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Runway}),
    represents=frozenset(),
    gives=names(OF_THE_RUNWAY),
    run=run,
    cost=lambda spec, scene, carried, level: 2e-3,
    source="EN 1991-3:2006, section 2",
)
