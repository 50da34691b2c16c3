"""The effects a hoist in motion may call for."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import AnyEffect, Criterion, Effect
from ptmcalc.laws import backlash, lift_off, rope_rod, two_mass
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.spec import Hoist, Lift, LowerBrake, Release, Start, Stop
from ptmcalc.machines.hoist.motion.cases import case_of
from ptmcalc.machines.hoist.motion.loads import FORCES, MOVING
from ptmcalc.machines.hoist.motion.reduced import (
    hook_brake_force,
    hook_speed,
    motor_torque,
    moving_inertia,
    ratio,
    reduced,
    rope_mass,
    start_hook_speed,
    travel,
)
from ptmcalc.machines.hoist.motion.train import Case, Moving
from ptmcalc.spec.scene import Scene

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]
SCENES: frozenset[type[Scene]] = frozenset({Lift, Start, Stop, LowerBrake, Release})
ALWAYS = frozenset({"rope_elasticity", "drive_motion"})

ELASTIC_THRESHOLD = 0.05
"""Dynamic part of the rope force relative to the weight [1] that is reported as significant. An engineering choice:
below it the load is lifted as if by hand. Every run includes rope elasticity, so that no error depends on it."""
DRIVE_THRESHOLD = 0.05
"""Load relative to drive mass, or gain of the squared drive speed until lift-off, the larger [1], that is reported as
significant. An engineering choice: below it a drive of constant speed is equivalent. Every run includes the drive, so
that no error depends on it."""
STRUCTURE_THRESHOLD = 0.1
"""Rope stiffness relative to that of the structure, or mass of the structure relative to the load, the larger [1], from
which on the structure is simulated. An engineering choice of `laws.lift_off`. Below it the error is not bounded:
springs in series can give a force too low, and a run without the structure has no error bar."""
GEAR_THRESHOLD = 0.1
"""Rope stiffness relative to that of the gear at the hook [1] from which on gear elasticity is simulated. An
engineering choice. Below it the frequency of the load is at most 5 % too high; the gear's own vibration is not bounded,
and a run without it has no error bar."""
BACKLASH_THRESHOLD = 0.1
"""Energy gained in the backlash relative to that of the gear [1] from which on backlash is simulated. An engineering
choice. Below it backlash adds at most 2.4 % to the gear torque under a constant torque; a torque that changes its sign
is not bounded, and a run without backlash has no error bar."""
ROPE_MASS_THRESHOLD = 0.05
"""Mass of the hanging rope relative to the load [1] from which on it is simulated. An engineering choice. Below it the
frequency is at most 0.8 % too high. The error bar of a force is at most 0.67 of its dynamic part with a taut rope, and
1.8 with one that goes slack."""
SHORTENING_THRESHOLD = 0.02
"""Length that the drum takes up or releases in a scene relative to the rope length [1] from which on it is simulated.
An engineering choice. Below it the error bar is at most 2.1 % of the dynamic part of a force, and four times that at
the structure."""
_WAVE, _SNATCHED = 3.0, 8.0
"""Largest change of a force by the rope mass, relative to its dynamic part times (m_r/M)^(1/2) [1]: with a taut rope
(`_WAVE`), and with one that goes slack and tightens again (`_SNATCHED`). Calibrated: the largest values of the seeded
sample were 1.8 and 4.0. Smaller values lose the safety of the bound; larger ones widen it."""
_TRANSITS = 4.0
"""Largest change of a time by the rope mass, in transits of a wave [1]. Calibrated: the largest value of the seeded
sample was 2.5, as a front may lift a load for a moment. A smaller value loses the safety of the bound; a larger one
widens it."""


_ROUNDING = 1e-12
"""Rounding of a ratio of two frequencies [1], above the resolution 2e-16 of the floating point. It keeps the lower
frequency within its error bar. A larger value widens the bar without need; a smaller one loses it to rounding."""
_BEATS = 4.0
"""Change of a force on the structure by the beat of structure and rope, relative to the growth of the rope's
oscillation [1]. Calibrated: the largest value of the seeded sample was 2.0. A smaller value loses the safety of the
bound; a larger one widens it."""


def _anything(loads: Loads) -> Offsets:
    return {name: ANYTHING for name in loads if name in MOVING}


# -- rope and drive: in every run -----------------------------------------------------------------------------------


def rope_criterion(spec: Hoist, scene: Moving) -> Criterion:
    """Force added by the elastic rope, relative to the weight.

        max( v_1 (K M)^(1/2)/Q,  2 |P/Q - 1| M/(m_1 + M) )

    v_1 is the drive speed at lift-off (`two_mass.takeup`), in a stop or start the speed of the hook.

    **Range** every scene with motion; every run includes this effect.
    **Error** an engineering measure.
    **Source** `laws.lift_off.elasticity_number`.
    """
    one = reduced(spec, scene)
    if isinstance(scene, Lift):
        start = start_hook_speed(spec, scene)
        speed = two_mass.takeup(
            one.drive_mass, one.load_mass, one.stiffness, one.drive_force, one.weight, start
        ).lift_off_speed
    else:
        speed = one.speed
    if isinstance(scene, Release):
        value = 2 * scene.share
    else:
        value = lift_off.elasticity_number(
            speed, one.drive_force, one.weight, one.drive_mass, one.load_mass, one.stiffness
        )
    return Criterion("Π_e", value, ELASTIC_THRESHOLD, "dynamic rope force / weight", "laws.lift_off")


def anything_bound(spec: Hoist, scene: Moving, loads: Loads) -> Offsets:
    """No bound: a hoist motion cannot be computed without this effect.

    **Range** every load of motion.
    **Error** unbounded.
    **Source** no run neglects this effect.
    """
    return _anything(loads)


def drive_criterion(spec: Hoist, scene: Moving) -> Criterion:
    """Deviation of the drive from a constant-speed source.

        M/m_1 max(1, (2 P/Q - 1)/Pi^2),   Pi = v_0 (K M)^(1/2)/Q

    **Range** every scene with motion; every run includes this effect.
    **Error** an engineering measure.
    **Source** `laws.lift_off.drive_mass_number`.
    """
    one = reduced(spec, scene)
    force = one.drive_force or one.weight
    value = (
        lift_off.drive_mass_number(force, one.weight, one.drive_mass, one.load_mass, one.stiffness, one.speed)
        if one.drive_mass
        else 0.0
    )
    return Criterion("Π_m", value, DRIVE_THRESHOLD, "speed change of the drive", "laws.lift_off")


ROPE_ELASTICITY: Effect[Hoist, Moving] = Effect(
    "rope_elasticity", "rope elasticity", SCENES, rope_criterion, anything_bound
)
DRIVE_MOTION: Effect[Hoist, Moving] = Effect(
    "drive_motion", "inertia and torque limit of the drive", SCENES, drive_criterion, anything_bound
)

# -- structure ------------------------------------------------------------------------------------------------------


def structure_criterion(spec: Hoist, scene: Moving) -> Criterion:
    """Participation of the structure by compliance and mass.

        max( K/K_b, m_b/M )

    **Range** a structure of one mode; 0 for a rigid one.
    **Error** an engineering measure: K/K_b alone misses forces on the structure.
    **Source** `laws.lift_off.structure_number`.
    """
    given, value = spec.structure, 0.0
    if given is not None:
        one = reduced(spec, scene)
        value = max(lift_off.structure_number(one.stiffness, given.stiffness, given.mass, one.load_mass))
    return Criterion(
        "K/K_b, m_b/M", value, STRUCTURE_THRESHOLD, "rope stiffness and load relative to the structure", "laws.lift_off"
    )


def structure_bound(spec: Hoist, scene: Moving, loads: Loads) -> Offsets:
    """Zero if the structure is rigid; otherwise unbounded, with or without mass.

    **Range** every load of motion.
    **Error** exact for a rigid structure; otherwise unbounded, because springs in series may underestimate the force.
    **Source** case of a bridge with mass: 1.46 on the bridge, 1.33 in the rope, 1.29 by springs in series.
    """
    return _anything(loads) if spec.structure is not None else {}


STRUCTURE: Effect[Hoist, Moving] = Effect(
    "structure", "flexibility and mass of the supporting structure", SCENES, structure_criterion, structure_bound
)

# -- gear -----------------------------------------------------------------------------------------------------------


def gear_criterion(spec: Hoist, scene: Moving) -> Criterion:
    """Ratio of rope stiffness to gear stiffness, both at the drum shaft.

        K R^2/C

    **Range** 0 for a rigid gear.
    **Error** an engineering measure.
    **Source** springs in series; the threshold of 10 % changes the frequency by 5 %.
    """
    gear = spec.gearbox
    stiff = math.inf if gear is None or gear.stiffness is None else gear.stiffness
    value = reduced(spec, scene).stiffness * travel(spec, scene) ** 2 / stiff
    return Criterion("K R²/C", value, GEAR_THRESHOLD, "rope stiffness / gear stiffness", "springs in series")


def gear_bound(spec: Hoist, scene: Moving, loads: Loads) -> Offsets:
    """Zero if the file gives no gear stiffness; otherwise unbounded.

    **Range** every load of motion.
    **Error** exact for a rigid gear; otherwise unbounded: the gear oscillation is as large as the torque step.
    **Source** two-mass train under a torque step.
    """
    elastic = spec.gearbox is not None and spec.gearbox.stiffness is not None
    return _anything(loads) if elastic else {}


GEAR_ELASTICITY: Effect[Hoist, Moving] = Effect(
    "gear_elasticity", "gear elasticity", SCENES, gear_criterion, gear_bound
)


def backlash_criterion(spec: Hoist, scene: Moving) -> Criterion:
    """Torque added to the gear by the passage through its backlash.

        Pi_b = (2 C D/M) (J1 + J2)/J2,   all on the drum shaft

    **Range** a backlash that the drive closes with its mean torque; 0 without backlash.
    **Error** exact for two inertias under a constant torque.
    **Source** `laws.backlash.backlash_number`; the threshold of 0.1 adds 2.4 %.
    """
    gear, value = spec.gearbox, 0.0
    if gear is not None and gear.stiffness is not None and gear.backlash > 0:
        behind = (spec.drum.inertia or 0.0) + model.hook_mass(spec, scene) * travel(spec, scene) ** 2
        motor = model.motor_side_inertia(spec) * ratio(spec) ** 2
        torque = motor_torque(spec) * ratio(spec)
        value = backlash.backlash_number(torque, gear.backlash, gear.stiffness, motor, behind) if torque else math.inf
    return Criterion(
        "Π_b", value, BACKLASH_THRESHOLD, "energy gained in the backlash, relative to that of the gear", "laws.backlash"
    )


def backlash_bound(spec: Hoist, scene: Moving, loads: Loads) -> Offsets:
    """Zero without backlash; otherwise unbounded.

    **Range** every load of motion.
    **Error** exact without backlash; otherwise unbounded, because torques that change sign open it again.
    **Source** `laws.backlash`.
    """
    gear = spec.gearbox
    return _anything(loads) if gear is not None and gear.backlash > 0 else {}


BACKLASH: Effect[Hoist, Moving] = Effect(
    "gear_backlash", "gear backlash", SCENES, backlash_criterion, backlash_bound, part_of="gear_elasticity"
)

# -- rope mass ------------------------------------------------------------------------------------------------------


def rope_mass_criterion(spec: Hoist, scene: Moving) -> Criterion:
    """Ratio of the suspended rope mass to the load.

        m_r/M

    **Range** every scene with motion.
    **Error** an engineering measure.
    **Source** `laws.rope_rod`: the frequency of a massless rope is 0.8 % too high at 0.05.
    """
    value = rope_mass(spec, scene) / reduced(spec, scene).load_mass
    return Criterion("m_r/M", value, ROPE_MASS_THRESHOLD, "mass of the suspended rope / load", "laws.rope_rod")


def rope_mass_bound(spec: Hoist, scene: Moving, loads: Loads) -> Offsets:
    """Bound of the force added by waves along the rope.

        |dF| <= c D (m_r/M)^(1/2),   D dynamic part of the force;   c = 3, or 8 if the rope goes slack in between
        w lower by at most the reduction for a rod between its end masses

    The first wave of a sudden loading, v (K m_r)^(1/2), is the dynamic part of a speed source times (m_r/M)^(1/2).

    **Range** ropes up to the mass of their load.
    **Error** calibrated: on a seeded sample of chains of forty masses the ratio was at most 1.8 with a taut rope and
    4.0 with a slack rope; times shift by at most four wave transits, 2.5 in the sample; the frequency is exact for a
    rigid gear and structure.
    **Source** `laws.rope_rod.snatch_wave_force`; numbers of the sample.
    """
    one = reduced(spec, scene)
    share = rope_mass(spec, scene) / one.load_mass
    dynamic = _dynamic_share(loads, one.weight)
    rise = (_SNATCHED if dynamic >= 1 else _WAVE) * dynamic * math.sqrt(share)
    found = _around_forces(loads, one.weight, rise)
    frequency = loads.get("natural_frequency")
    if frequency is not None and math.isfinite(frequency.value):
        found["natural_frequency"] = Interval(frequency.value * (_slower(spec, scene) - 1), 0.0)
    way, wave = rise * one.weight / one.stiffness, _TRANSITS * math.sqrt(share * one.load_mass / one.stiffness)
    for name in ("stop_distance", "stop_distance_lowering"):
        found[name] = Interval(-way, way)
    for name in ("stop_time", "lift_off_time", "tension_time"):
        found[name] = Interval(-wave, wave)
    if "lift_off_speed" in loads:
        found["lift_off_speed"] = _relative(loads["lift_off_speed"], _WAVE * math.sqrt(share))
    return {name: offset for name, offset in found.items() if name in loads and math.isfinite(loads[name].value)}


def _slower(spec: Hoist, scene: Moving) -> float:
    """Lowest frequency with the mass of the rope over that without, the drive held or free, the lower of the two."""
    one, rope = reduced(spec, scene), rope_mass(spec, scene)
    held = rope_rod.rod_frequency(one.stiffness, rope, one.load_mass, 1) / math.sqrt(one.stiffness / one.load_mass)
    drive = moving_inertia(spec, scene) * (ratio(spec) / travel(spec, scene)) ** 2 - one.load_mass
    if drive <= 0:
        return held
    free = rope_rod.free_rod_frequency(one.stiffness, rope, drive, one.load_mass)
    return min(held, free / two_mass.two_mass_frequency(one.stiffness, drive, one.load_mass), 1.0) * (1 - _ROUNDING)


def _dynamic_share(loads: Loads, weight: float) -> float:
    """Dynamic part of the forces in rope and structure, over the weight."""
    parts = [0.0]
    for where in ("rope", "bridge"):
        if f"{where}_force_max" in loads:
            parts.append(loads[f"{where}_force_max"].value / weight - 1)
        if f"{where}_force_min" in loads:
            parts.append(1 - loads[f"{where}_force_min"].value / weight)
    return max(parts)


def _around_forces(loads: Loads, weight: float, rise: float) -> dict[str, Interval]:
    """Offsets of all forces for a change of the rope force by a share of the weight; a rope does not push."""
    found = {}
    for name, one in loads.items():
        if name not in FORCES:
            continue
        size = rise * weight if "_force_m" in name else rise
        if name in ("backlash_torque_peak", "gear_impact_factor"):
            most = loads["rope_force_max"].value / weight if "rope_force_max" in loads else 1.0
            size = abs(one.value) * rise / max(most, 1.0)
        least = -min(size, max(one.low, 0.0)) if name in _NEVER_PUSH else -size
        found[name] = Interval(least, size)
    return found


_NEVER_PUSH = FORCES - {"bridge_force_min"}


def _relative(one: Estimate, share: float) -> Interval:
    return Interval(-share * abs(one.value), share * abs(one.value))


ROPE_MASS: Effect[Hoist, Moving] = Effect(
    "rope_mass", "mass of the suspended rope", SCENES, rope_mass_criterion, rope_mass_bound, calibrated=True
)

# -- rope that gets shorter -----------------------------------------------------------------------------------------


_LIFTED = 1e-9
"""Difference of rope force and weight relative to the weight [1] that counts as rounding. A numerical choice: a larger
value takes a load that is barely not lifted as one that hangs still."""


def _shortening(spec: Hoist, scene: Moving) -> float:
    """Part of the rope's length that runs onto the drum or off it while the scene is looked at."""
    if isinstance(scene, Release):
        return 0.0
    case = case_of(spec, scene, ALWAYS)
    way = _fastest(spec, scene) * case.window
    return (min(way, case.drop) if _falls(case) else way) / _length(spec, scene)


def _falls(case: Case) -> bool:
    """Whether the load goes down through a brake that does not hold it."""
    return case.stops and not case.holds


def _fastest(spec: Hoist, scene: Moving) -> float:
    """Of the hook [m/s]; that of a load its brake does not hold grows as it falls with the drive: freely
    until the brake has its torque, then by what is left of the weight."""
    case, speed = case_of(spec, scene, ALWAYS), hook_speed(spec, scene)
    if not _falls(case) or spec.brake is None:
        return speed
    one = reduced(spec, scene)
    freely = one.weight / (one.load_mass + one.drive_mass)
    left = max(1 - hook_brake_force(spec, scene) / one.weight, 0.0)
    return speed + freely * (spec.brake.delay + spec.brake.rise_time + left * case.window)


def _length(spec: Hoist, scene: Moving) -> float:
    """Of a fall, from the drum or the sheaves above to the hook [m]."""
    return model.rope_length(spec, model.hook_height(scene)) / model.falls_of_a_rope(spec)


def shortening_criterion(spec: Hoist, scene: Moving) -> Criterion:
    """Relative change of the rope length during the simulated scene.

        v T/l

    **Range** every scene with motion.
    **Error** an upper bound: the drive exceeds its set speed only briefly.
    **Source** `laws.rope_rod.hauling_gain`.
    """
    return Criterion(
        "v T/l",
        _shortening(spec, scene),
        SHORTENING_THRESHOLD,
        "rope length change in the scene / rope length",
        "laws.rope_rod",
    )


def shortening_bound(spec: Hoist, scene: Moving, loads: Loads) -> Offsets:
    """Change of the dynamic rope force due to the change of rope length.

        (ln A^2)' = (V/l) sin^2 f = (V/2 l) (1 - cos 2 f),   so that A <= A_0 (l_0/l_1)^(1/4) exp(V/(2 l_1 w))

    A^2 = e^2 + (e'/w)^2 of the dynamic strain e of a rope hauled at the speed V, f its phase, which advances with w:
    the cosine term contributes at most one half-wave. During lowering, A decreases accordingly. Times change with the
    frequency, by (l_0/l_1)^(1/2); lift-off times by the length until lift-off.

    **Range** a drive of constant speed; the bound includes twice the change of length for a drive that oscillates. For
    a falling load that the brake does not hold, V and the change of length include the drop.
    **Error** an upper bound for a constant speed and one frequency. With a flexible structure the beat of two
    frequencies shifts with the rope frequency: the bound of its forces is four times as large, calibrated on a seeded
    sample (2.0).
    **Source** derived from the equation of `laws.rope_rod.hauling_gain`.
    """
    part = 2 * _shortening(spec, scene)
    gain = 1 / math.sqrt(1 - part) - 1 if part < 1 else math.inf
    one = reduced(spec, scene)
    if math.isinf(gain):  # a stall stays one: what never happens is not in doubt
        return {name: ANYTHING for name in _anything(loads) if math.isfinite(loads[name].value)}
    turn = math.sqrt(one.stiffness / one.load_mass)
    if "natural_frequency" in loads and math.isfinite(loads["natural_frequency"].value):
        turn = min(turn, loads["natural_frequency"].value)
    beside = _fastest(spec, scene) / (2 * _length(spec, scene) * (1 - part) * turn)
    growth = min(beside - math.log1p(-part) / 4, math.log1p(gain))
    rise = math.expm1(growth) * _dynamic_share(loads, one.weight)
    if rise == 0:
        return _unlifted(loads, one.weight, gain)
    found = _around_forces(loads, one.weight, rise)
    if spec.structure is not None:
        found |= {
            name: Interval(_BEATS * offset.low, _BEATS * offset.high)
            for name, offset in found.items()
            if name.startswith("bridge")
        }
    if "natural_frequency" in loads and math.isfinite(loads["natural_frequency"].value):
        found["natural_frequency"] = _relative(loads["natural_frequency"], gain)
    lifted = loads["lift_off_time"].high if "lift_off_time" in loads else math.inf
    until = 2 * hook_speed(spec, scene) * lifted / _length(spec, scene)
    soon = min(gain, 1 / math.sqrt(1 - until) - 1) if until < 1 else gain
    for name in ("lift_off_time", "tension_time", "lift_off_speed", "stop_time"):
        if name in loads and math.isfinite(loads[name].value):
            found[name] = _relative(loads[name], gain if name == "stop_time" else soon)
    for name in ("stop_distance", "stop_distance_lowering"):
        if name in loads and math.isfinite(loads[name].value):
            size = (rise + part) * one.weight / one.stiffness  # the static stretch goes with the length
            found[name] = Interval(-size, size)
    return found


def _unlifted(loads: Loads, weight: float, gain: float) -> Offsets:
    """Offsets of the forces of a load that the drive does not lift: the tension that a stalled drive builds up goes as
    the square root of the rope stiffness at most; none of a load that hangs still."""
    if "rope_force_max" not in loads or loads["rope_force_max"].value >= weight * (1 - _LIFTED):
        return {}
    return {name: _relative(one, gain) for name, one in loads.items() if name in FORCES}


ROPE_SHORTENING: Effect[Hoist, Moving] = Effect(
    "rope_shortening",
    "rope length change during the scene",
    SCENES,
    shortening_criterion,
    shortening_bound,
    calibrated=True,
)

EFFECTS_OF_MOTION: tuple[AnyEffect, ...] = (
    ROPE_ELASTICITY,
    DRIVE_MOTION,
    STRUCTURE,
    GEAR_ELASTICITY,
    BACKLASH,
    ROPE_MASS,
    ROPE_SHORTENING,
)
