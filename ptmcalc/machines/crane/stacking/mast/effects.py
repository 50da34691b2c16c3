"""Effects of the column's motion: what bends, what swings, what holds."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import AnyEffect, Criterion, Effect
from ptmcalc.laws import mast as law
from ptmcalc.laws import mast_modes
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.columns import Swinging, swinging
from ptmcalc.machines.crane.stacking.machine.model import Push
from ptmcalc.machines.crane.stacking.machine.scenes import Brake, DrivenScene, ObstacleScene, StackerScene, Stand, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.machine.travelling import push_of, turns
from ptmcalc.machines.crane.stacking.mast import bounds
from ptmcalc.machines.crane.stacking.mast.names import CONTACT, FLEXIBLE, GRAVITY, GUIDE, HOLDING, MASS, MODES
from ptmcalc.machines.crane.stacking.mechanisms import starts
from ptmcalc.spec.scene import Scene

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]

DRIVEN: frozenset[type[Scene]] = frozenset({Start, Brake})
BENT: frozenset[type[Scene]] = DRIVEN | {ObstacleScene}
MOVED_LOADS = frozenset(
    {
        *("mast_deflection_max", "mast_force_max", "mast_moment_max", "settling_time"),
        *("collision_force", "collision_deflection", "contact_force"),
        *("column_stress", "bridge_stress", "stability_reserve", "combination_force"),
    }
)
"""Loads, or families of them, that the motion of the column makes."""

FLEXIBLE_THRESHOLD = 0.15
"""Period of the mast relative to the rise time of its load [1]. An engineering choice: below 0.15 the dynamic part of
the deflection is less than 5 % of the static one, T/(pi t_r). Every run simulates the flexibility, so no error depends
on the value. It affects the list of sensitive effects."""
MASS_THRESHOLD = 0.05
"""Mass of the mast relative to the climbing mass [1]. An engineering choice: about a quarter of the mast moves with the
load. Below 5 % it changes the frequency by less than 1 %. Every run simulates the mass, so no error depends on the
value. It affects the list of sensitive effects."""
MODES_THRESHOLD = 1.0
"""Larger of two ratios, each relative to its own threshold `RISE_OF_MODES` or `MASS_OF_MODES` [1]. It is 1 by
definition. `modes_bound` adds the neglected modes to the error bar. A smaller value requests them in more scenes."""
RISE_OF_MODES, MASS_OF_MODES = 0.2, 2.0
"""Period of the second mode relative to the rise time, and mass of the mast relative to the climbing mass [1]. An
engineering choice: below 0.2 the dynamic part of the second mode is less than 7 % of its static part, T_2/(pi t_r).
Below 2 the load dominates the moving mass. Smaller values request higher modes in more scenes."""
GRAVITY_THRESHOLD = 0.03
"""Weight on the mast relative to its stiffness times length [1]. An engineering choice: below 3 % the weight changes
the stiffness by less than 4 % and the frequency by less than 2 %, with the factor 1.2 of `laws.mast.gravity_stiffness`.
`gravity_bound` covers the neglected weight. A smaller value requests it in more scenes."""
CONTACT_THRESHOLD = 0.1
"""Collision force relative to the force of the brake [1]. An engineering choice: below 10 % the collision force is less
than 10 % of the brake force. Every run simulates the contact, so no error depends on the value. It affects the list of
sensitive effects."""
HOLDING_THRESHOLD = 1.0
"""Force of the vibrating mast on the base after the stop, relative to the holding force [1]. Derived for two masses and
a sudden force: below 1 the base does not slip again. Every run simulates the holding, so no error depends on the value.
It affects the list of sensitive effects."""
GUIDE_THRESHOLD = 0.1
"""Stiffness of the top guide relative to that of the mast at its head [1]. An engineering choice: below 10 % the guide
changes the stiffness by less than 10 % and the frequency by less than 5 %. The neglect of a guide has a bound for
frequencies only. A smaller value requests the guide in more scenes."""


def _anything(loads: Loads) -> Offsets:
    return {name: ANYTHING for name in loads if name.partition("[")[0] in MOVED_LOADS}


def anything_bound(spec: Stacker, scene: StackerScene, loads: Loads) -> Offsets:
    """No bound: the mast motion cannot be computed without this effect. A mast that only rotates about its axis has no
    such motion.

    **Range** every load of the mast motion.
    **Error** unbounded.
    **Source** no run neglects this effect.
    """
    return {} if turns(spec, scene) else _anything(loads)


def _given(spec: Stacker, scene: DrivenScene) -> tuple[Swinging, Push]:
    push = push_of(spec, scene)
    return swinging(spec, scene, push.rotors), push


def _period(one: Swinging, push: Push, mode: int) -> float:
    return 2 * math.pi / mast_modes.mast_frequency(one.exact if push.kind == "force" else one.held, mode)


# -- a column that bends --------------------------------------------------------------------------------------------


def flexible_criterion(spec: Stacker, scene: DrivenScene | ObstacleScene) -> Criterion | None:
    """Ratio of the mast period to the rise time of its load.

        T/t_r

    **Range** starts and stops; infinite for a sudden force and for a collision. Every run includes this effect.
    **Error** an engineering measure: a rise time of several periods leaves little oscillation.
    **Source** `laws.mast.rise_factor`.
    """
    if turns(spec, scene):
        return None
    value = math.inf
    if not isinstance(scene, ObstacleScene):
        one, push = _given(spec, scene)
        value = _period(one, push, 1) / push.rise if push.rise > 0 else math.inf
    meaning = "mast period / rise time of its load"
    return Criterion("T/t_r", value, FLEXIBLE_THRESHOLD, meaning, "laws.mast")


def mass_criterion(spec: Stacker, scene: StackerScene) -> Criterion | None:
    """Ratio of the mast mass to the mass of carriage and load.

        m_c/m_2

    **Range** every motion of the mast; every run includes this effect.
    **Error** an engineering measure: about a quarter of the mast mass oscillates with the load.
    **Source** `laws.mast.mass_coefficient`.
    """
    if turns(spec, scene):
        return None
    value = spec.column.mass / model.climbing_mass(spec, scene)
    return Criterion("m_c/m_2", value, MASS_THRESHOLD, "mast mass / mass of carriage and load", "laws.mast")


def modes_criterion(spec: Stacker, scene: DrivenScene) -> Criterion | None:
    """Excitation of the second mode and its share of the mass.

        max( T_2/(0.2 t_r), m_c/(2 m_2) )

    **Range** starts and stops; infinite for a sudden force.
    **Error** an engineering measure.
    **Source** modal analysis; thresholds of the theory of this tool.
    """
    if turns(spec, scene):
        return None
    one, push = _given(spec, scene)
    rise = _period(one, push, 2) / push.rise / RISE_OF_MODES if push.rise > 0 else math.inf
    heavy = spec.column.mass / model.climbing_mass(spec, scene) / MASS_OF_MODES
    meaning = "second period / rise time and mast mass / load, each relative to its threshold"
    return Criterion("T₂/t_r, m_c/m_2", max(rise, heavy), MODES_THRESHOLD, meaning, "modal analysis")


def modes_bound(spec: Stacker, scene: DrivenScene, loads: Loads) -> Offsets:
    """Change due to all modes except the two-mass shape, from exact sums over the modes.

    **Range** starts and stops of a mast with a free head; unbounded with a top guide.
    **Error** derived, except one factor calibrated on a seeded sample: `bounds.modes_bound`.
    **Source** modal analysis.
    """
    if turns(spec, scene):
        return {}
    if guided(spec):
        return _anything(loads)
    return bounds.modes_bound(spec, scene, loads)


# -- weights --------------------------------------------------------------------------------------------------------


def gravity_criterion(spec: Stacker, scene: StackerScene) -> Criterion | None:
    """Weight on the mast relative to its stiffness.

        P/(c l)

    **Range** every mast; P is the weight of carriage, cab and load.
    **Error** an engineering measure: weights change the stiffness by about 1.2 times this ratio.
    **Source** `laws.mast.gravity_stiffness`.
    """
    if turns(spec, scene):
        return None
    weight = model.climbing_mass(spec, scene) * spec.gravity
    value = weight / swinging(spec, scene).stiffness / spec.column.length
    return Criterion("P/(c l)", value, GRAVITY_THRESHOLD, "weight on the mast / mast stiffness", "laws.mast")


def gravity_bound(spec: Stacker, scene: StackerScene, loads: Loads) -> Offsets:
    """Change of frequencies and oscillation due to gravity.

    **Range** every mast below its buckling load; unbounded for a motion with a top guide.
    **Error** derived for frequencies; for a motion twice the difference of two two-mass runs, calibrated on a seeded
    sample: `bounds.gravity_bound`.
    **Source** minimum and maximum principles of Rayleigh and Courant; `numerics.mast`.
    """
    if turns(spec, scene):
        return {}
    if guided(spec) and not isinstance(scene, Stand):
        times = bounds.time_bound(spec, scene, loads) if isinstance(scene, DrivenScene) else {}
        return {**_anything(loads), **times, **bounds.weighted_frequencies(spec, scene, loads)}
    return bounds.gravity_bound(spec, scene, loads)


# -- contact, brake, guide ------------------------------------------------------------------------------------------


def contact_criterion(spec: Stacker, scene: ObstacleScene) -> Criterion:
    """Ratio of the collision force to the brake force; infinite if the drive is still on.

        v (c m_1)^(1/2)/W

    **Range** every collision; every run includes this effect.
    **Error** an engineering measure.
    **Source** energy, `laws.buffer.collision_force`.
    """
    push = model.pushed(spec, scene)
    one = swinging(spec, scene)
    tension = model.speed(spec, scene) * math.sqrt(one.stiffness * one.base)
    value = math.inf if push >= 0 else tension / -push
    return Criterion("v√(c m_1)/W", value, CONTACT_THRESHOLD, "force of the collision over the brake's", "laws.buffer")


def holding_criterion(spec: Stacker, scene: DrivenScene) -> Criterion | None:
    """Ratio of the holding force required after the stop to the force of the brake, or of a speed-controlled drive.

        2 (m_12 + m_22)/m max(1, (1 + r)/(2 r^(1/2))),   1 + r = m_22 m/(m_11 m_22 - m_12^2)

    **Range** starts and stops by a force; 0 on a speed ramp. Every run includes this effect.
    **Error** exact in the worst case of two masses and a sudden force without damping: above 1 the base may slip again.
    **Source** `laws.mast.after_stop_ratio`.
    """
    if turns(spec, scene):
        return None
    meaning = "force of the oscillating mast after the stop / holding force of the base"
    one, push = _given(spec, scene)
    value = 0.0
    if push.kind == "force":
        m11, m12, m22 = one.masses
        whole = m11 + 2 * m12 + m22
        r = m22 * whole / (m11 * m22 - m12 * m12) - 1
        lag = law.static_lag(2.0, 1.0, m11, m12, m22)
        value = lag * ((1 + r) / (2 * math.sqrt(r)) if r > 1 else 1.0)
    return Criterion("F/P", value, HOLDING_THRESHOLD, meaning, "laws.mast")


def holding_bound(spec: Stacker, scene: DrivenScene, loads: Loads) -> Offsets:
    """No bound: the mast motion cannot be computed without this effect; nor can the stopping time of a base that may
    slip again.

        t_first <= t < infinity   if the mast may pull its base through the brake

    **Range** every load of the mast motion, and the time of a stop by a force.
    **Error** unbounded; zero for the time of a stop whose base stays at standstill.
    **Source** no run neglects this effect; `starts.slips_again`.
    """
    told = dict(anything_bound(spec, scene, loads))
    assert isinstance(scene, Start | Brake)
    if "brake_time" in loads and not starts.stands_at_once(spec, scene):
        told["brake_time"] = Interval(0.0, math.inf)
    return told


def guided(spec: Stacker) -> bool:
    """Whether something holds the head of the column."""
    guide = spec.column.top_guide
    return guide is not None and guide.stiffness is not None


def guide_criterion(spec: Stacker, scene: StackerScene) -> Criterion | None:
    """Ratio of the top guide stiffness to the mast stiffness at the head.

        k_g/c

    **Range** rack stackers; 0 for a free head.
    **Error** an engineering measure.
    **Source** springs in parallel.
    """
    guide = spec.column.top_guide
    stiff = guide.stiffness if guide is not None and guide.stiffness is not None else 0.0
    value = stiff / swinging(spec, scene).stiffness if stiff else 0.0
    return Criterion("k_g/c", value, GUIDE_THRESHOLD, "top guide stiffness / mast stiffness", "springs in parallel")


def guide_bound(spec: Stacker, scene: DrivenScene, loads: Loads) -> Offsets:
    """Zero if the head is free; otherwise only the frequencies have a bound.

    **Range** every load of the mast motion.
    **Error** exact for a free head; a bound for frequencies (`bounds.guided_frequencies`), otherwise unbounded: a guide
    changes the support of the beam.
    **Source** statics; Rayleigh's theorem on one constraint.
    """
    if not guided(spec) or turns(spec, scene):
        return {}
    return {**_anything(loads), **bounds.guided_frequencies(spec, scene, loads)}


EFFECTS_OF_MAST: tuple[AnyEffect, ...] = (
    Effect(FLEXIBLE, "mast flexibility", BENT, flexible_criterion, anything_bound),
    Effect(MASS, "mast mass", BENT, mass_criterion, anything_bound),
    Effect(MODES, "higher mast modes", DRIVEN, modes_criterion, modes_bound, calibrated=True),
    Effect(
        GRAVITY,
        "second-order effect of gravity on the mast",
        BENT | {Stand},
        gravity_criterion,
        gravity_bound,
        calibrated=True,
    ),
    Effect(CONTACT, "contact with the obstacle", frozenset({ObstacleScene}), contact_criterion, anything_bound),
    Effect(HOLDING, "base held after the stop", DRIVEN, holding_criterion, holding_bound),
    Effect(GUIDE, "top guide of the mast", DRIVEN, guide_criterion, guide_bound),
)
