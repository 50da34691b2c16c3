"""Effects of the load below the jib: sway and centrifugal offset.

The bound of the sway starts from the bars that the effects of the rotation have left.
"""

import math

from ptmcalc.base.estimate import Interval
from ptmcalc.contract.effect import AnyEffect, Criterion, Effect
from ptmcalc.laws import pendulum
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import Slew, SlewingCrane, SlewingScene
from ptmcalc.machines.crane.slewing.rotation.bounds import Loads, Offsets
from ptmcalc.machines.crane.slewing.sway import bounds
from ptmcalc.spec.scene import Scene

_SCENES: frozenset[type[Scene]] = frozenset({Slew})
SWING_THRESHOLD = 0.02
"""Sway angle 2 a/g [rad]. An engineering choice: below 0.02 rad the horizontal rope force stays below 2 % of the weight
of the load. `swing_bound` covers the neglected sway where it exists; elsewhere the error is unbounded. A smaller value
requests the sway in more scenes."""
CENTRIFUGAL_THRESHOLD = 0.01
"""Outward angle w^2 R/g of the load in steady slewing [rad]. An engineering choice: below 0.01 rad the radial rope
force stays at about 1 % of the weight of the load or less. `centrifugal_bound` adds it to the error bar. A smaller
value requests the effect in more scenes."""


def _hangs(spec: SlewingCrane, scene: SlewingScene) -> bool:
    return spec.load is not None and spec.load.rope_length is not None and model.hanging_mass(spec, scene) > 0


def swing_criterion(spec: SlewingCrane, scene: SlewingScene) -> Criterion | None:
    """Sway angle of the load behind the jib.

        2 a/g,   a = R w/t of the start or of the stop, whichever is the shorter

    **Range** loads on a rope of known length.
    **Error** an engineering measure: below 0.02 the load moves with the jib.
    **Source** pendulum under a constant acceleration, 2 atan(a/g).
    """
    if not _hangs(spec, scene):
        return None
    assert spec.load is not None
    stop = model.stop(spec, scene) or model.allowed_stop(spec)
    shortest = min(model.start_of(spec, scene)[0], stop[0])
    value = 2 * spec.load.radius * spec.speed / (shortest * spec.gravity) if shortest > 0 else math.inf
    return Criterion("2a/g", min(value, 1e9), SWING_THRESHOLD, "tangential sway angle of the load [rad]", "pendulum")


def swing_bound(spec: SlewingCrane, scene: SlewingScene, loads: Loads) -> Offsets:
    """Bounds of start, stop and slewing ring loads for any sway of the load.

        start:  t_s = (J' w + h)/N,   h = m rho w (rho -+ (rho^2 + J'/m)^(1/2))       (`laws.slewing.momentum_range`)
        stop:   beta_b <= beta_c + E/(M_B u + M_r),   t_b <= t_c + (J' w + h - h_end)/(M_B u eta + M_r)
        ring:   V <= m (g + w_rel^2/L + w^2 R + a R)

    E is the maximum energy of crane and load at the start of the stop, t_c the delay and rise time of the brake.

    **Range** a start in which the motor drives throughout, proved by the maximum rope force; a stop with a brake torque
    above the wind torque; otherwise unbounded.
    **Error** a derived bound. The bound of the ring is wide: more than three times the axial force and moment of any
    crane of the seeded sample.
    **Source** derived: Jacobi's integral of the load, energy and angular momentum of the crane.
    """
    if not _hangs(spec, scene):
        return {}
    return bounds.of_swing(spec, scene, loads)


def centrifugal_criterion(spec: SlewingCrane, scene: SlewingScene) -> Criterion | None:
    """Radial sway angle of the load in steady slewing.

        w^2 R/g

    **Range** loads on a rope of known length.
    **Error** an engineering measure.
    **Source** `laws.pendulum.slewing_lean`.
    """
    if not _hangs(spec, scene):
        return None
    assert spec.load is not None
    value = spec.speed**2 * spec.load.radius / spec.gravity
    return Criterion("ω²R/g", value, CENTRIFUGAL_THRESHOLD, "radial sway angle of the load [rad]", "conical pendulum")


def centrifugal_bound(spec: SlewingCrane, scene: SlewingScene, loads: Loads) -> Offsets:
    """Radial ring force, and ring moment at the jib head, added by the radial sway of the load.

        dH = m w^2 L sin(theta),   tan(theta) = w^2 (R + L sin(theta))/g;   dM = dH h

    **Range** steady slewing; the bound of the load sway covers start and stop.
    **Error** exact for the steady angle.
    **Source** `laws.pendulum.slewing_lean`.
    """
    load = spec.load
    if not _hangs(spec, scene) or load is None or load.rope_length is None:
        return {}
    lean = pendulum.slewing_lean(spec.speed, load.radius, load.rope_length, spec.gravity)
    pull = model.hanging_mass(spec, scene) * spec.speed**2 * load.rope_length * math.sin(lean)
    added = {"ring_force_radial": pull, "ring_moment": pull * (spec.ring.head_height or 0.0)}
    return {name: Interval(0.0, value) for name, value in added.items() if name in loads}


EFFECTS_OF_SWAY: tuple[AnyEffect, ...] = (
    Effect("load_swing", "load sway below the jib", _SCENES, swing_criterion, swing_bound),
    Effect("centrifugal_offset", "centrifugal offset of the load", _SCENES, centrifugal_criterion, centrifugal_bound),
)
