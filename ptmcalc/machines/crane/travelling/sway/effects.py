"""The effects a travelling crane that starts or stops may call for."""

import math
from collections.abc import Mapping

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import AnyEffect, Criterion, Effect
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.loads import MOVING
from ptmcalc.machines.crane.travelling.machine.model import State
from ptmcalc.machines.crane.travelling.machine.scenes import Brake, HoistWhileTravelling, Moving, Start
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.machine.wheels import Wheels
from ptmcalc.machines.crane.travelling.sway.finite import far, regular, widened
from ptmcalc.machines.crane.travelling.sway.linear import linear_course
from ptmcalc.machines.crane.travelling.sway.moving import Motion, motion_of
from ptmcalc.machines.crane.travelling.sway.reading import loads_of
from ptmcalc.spec.scene import Scene

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]

MOVING_SCENES: frozenset[type[Scene]] = frozenset({Start, Brake, HoistWhileTravelling})
SWAY, REACTION, HOISTING, WIND = "travel_sway", "drive_reaction", "hoisting_sway", "travel_wind"
LARGE, CURVE, SLIP = "large_sway", "torque_curve", "wheel_slip"
IN_PLANE = frozenset({SWAY, REACTION, HOISTING, WIND})
"""What every run carries."""

SWAY_THRESHOLD = 0.02
"""Sway angle 2 a/g by a sudden start [rad]. An engineering choice: below 0.02 rad the horizontal rope force stays below
2 % of the weight of the load. Every run simulates the sway, so no error depends on the value. It affects the list of
sensitive effects."""
REACTION_THRESHOLD = 0.1
"""Mass of the load relative to the other mass moved by the drive [1]. An engineering choice: below 10 % the reaction
raises the sway frequency by less than 5 %, half of the ratio. Its neglect has no bound where the load reacts, so
verdicts come from runs with it. The value affects the first runs and the reported state of the effect."""
HOISTING_THRESHOLD = 0.02
"""Change of the rope length in one sway period, relative to the length [1]. An engineering choice: below 2 % the
frequency changes by less than 1.1 % in a period. Its neglect has no bound while the length changes, so verdicts come
from runs with it. The value affects the first runs and the reported state of the effect."""
WIND_THRESHOLD = 0.05
"""Force of wind and slope relative to that of drive or brakes [1]. An engineering choice: below 5 % they change the
force on the crane by less than 5 % of the drive force. Their neglect has no bound, so verdicts come from runs with
them. The value affects the first runs and the reported state of the effect."""
LARGE_THRESHOLD = 0.01
"""Change of the sway angle by finite angles, relative to the largest angle [1]. An engineering choice: below 1 % small
angles change the sway by less than 1 % for a ramp with ropes of constant length. `large_bound` adds the change to the
error bar. A smaller value requests finite angles in more scenes."""
CURVE_THRESHOLD = 0.1
"""Spread of the motor torque relative to its mean [1]. An engineering choice: below 10 % the torque differs from its
mean by less than 10 %. The neglect of a given curve has no bound, so verdicts come from runs with it. The value affects
the first runs and the reported state of the effect."""
SLIP_THRESHOLD = 1 / 1.5
"""Force of a driven wheel relative to its adhesion [1]. An engineering choice: 1/1.5 is an adhesion reserve of 1.5.
Slip is never simulated. Its neglect has no error while the computed reserve is at least 1 and no bound below. The value
affects the reported state of the effect."""


def _anything(loads: Loads) -> Offsets:
    return {name: ANYTHING for name in loads if name.partition("[")[0] in MOVING}


def mean_acceleration(spec: Travelling, scene: Moving) -> float:
    """Of a ramp, or of a rigid crane with its load under the mean force [m/s^2]."""
    motion = motion_of(spec, scene)
    if motion.ramp is not None:
        return motion.ramp
    drag = motion.rolling + motion.outside
    rotor = motion.rotor if motion.starts else motion.rotor_braked
    net = motion.force - drag if motion.starts else motion.force + drag
    return abs(net) / (motion.body + rotor + motion.load)


def _period(motion: Motion) -> float:
    return 2 * math.pi * math.sqrt(motion.length / motion.gravity)


# -- in every run ---------------------------------------------------------------------------------------------------


def sway_criterion(spec: Travelling, scene: Moving) -> Criterion:
    """Maximum sway angle of the load under a sudden acceleration.

        2 a/g

    a is that of the ramp, or of the rigid crane under its mean force; 0 without a suspended load.

    **Range** every start and stop; every run includes this effect.
    **Error** an engineering measure: exact for small angles and a start of half a period or more.
    **Source** pendulum under a sudden acceleration.
    """
    value = 2 * mean_acceleration(spec, scene) / spec.gravity if model.hanging(spec, scene) else 0.0
    return Criterion("2a/g", value, SWAY_THRESHOLD, "sway angle of the load at a sudden start", "pendulum")


def anything_bound(spec: Travelling, scene: Moving, loads: Loads) -> Offsets:
    """No bound: a start or stop cannot be computed without this effect.

    **Range** every load of a start or a stop.
    **Error** unbounded.
    **Source** no run neglects this effect.
    """
    return _anything(loads)


def reaction_bound(spec: Travelling, scene: Moving, loads: Loads) -> Offsets:
    """Zero if the drive follows a ramp or no load is suspended; otherwise unbounded.

    **Range** every load of a start or a stop.
    **Error** exact if the load cannot change the motion; otherwise unbounded.
    **Source** no run neglects this effect.
    """
    motion = motion_of(spec, scene)
    return {} if motion.ramp is not None or not motion.load else _anything(loads)


def hoisting_bound(spec: Travelling, scene: Moving, loads: Loads) -> Offsets:
    """Zero if the rope length is constant; otherwise unbounded.

    **Range** every load of a start or a stop.
    **Error** exact for ropes of constant length; otherwise unbounded.
    **Source** no run neglects this effect.
    """
    return _anything(loads) if motion_of(spec, scene).hoisting else {}


def wind_bound(spec: Travelling, scene: Moving, loads: Loads) -> Offsets:
    """Zero without wind and slope; otherwise unbounded.

    **Range** every load of a start or a stop.
    **Error** exact without them; otherwise unbounded.
    **Source** no run neglects this effect.
    """
    motion = motion_of(spec, scene)
    return _anything(loads) if motion.outside or motion.on_load or motion.wind else {}


def reaction_criterion(spec: Travelling, scene: Moving) -> Criterion:
    """Ratio of the load mass to the other masses moved by the torque; 0 for a drive on a speed ramp.

        M/m_t

    **Range** every start and stop; every run includes this effect.
    **Error** an engineering measure: the square of the frequency increases by this ratio.
    **Source** two masses, one of them a pendulum.
    """
    motion = motion_of(spec, scene)
    rotor = motion.rotor if motion.starts else motion.rotor_braked
    value = 0.0 if motion.ramp is not None else motion.load / (motion.body + rotor)
    return Criterion(
        "M/m_t", value, REACTION_THRESHOLD, "load mass relative to the other mass moved by the drive", "two masses"
    )


def hoisting_criterion(spec: Travelling, scene: Moving) -> Criterion:
    """Relative change of the rope length in one sway period.

        |V| T/L

    **Range** a load that is hoisted during the start of the crane; otherwise 0. Every run includes this effect.
    **Error** an engineering measure.
    **Source** pendulum of changing length.
    """
    motion = motion_of(spec, scene)
    value = abs(motion.hoisting) * _period(motion) / motion.length
    return Criterion(
        "|V| T/L", value, HOISTING_THRESHOLD, "change of rope length per sway period / rope length", "pendulum"
    )


def wind_criterion(spec: Travelling, scene: Moving) -> Criterion:
    """Ratio of wind and slope force to the force of the drive or the brakes.

        |F_w + F_s|/F

    **Range** every start and stop; every run includes this effect.
    **Error** an engineering measure.
    **Source** balance along the rails.
    """
    motion = motion_of(spec, scene)
    mass = motion.body + motion.load
    force = motion.force if motion.ramp is None else mass * motion.ramp + motion.rolling
    value = abs(motion.outside) / force if force else math.inf
    return Criterion(
        "F_w/F", value, WIND_THRESHOLD, "wind and slope force / driving or braking force", "balance of forces"
    )


# -- finite angles --------------------------------------------------------------------------------------------------


def large_criterion(spec: Travelling, scene: Moving) -> Criterion:
    """Change of the sway due to finite angles, relative to the maximum angle.

        (x - atan x) (2 + omega t)/(2 x),   x = a/g,   t of the ramp or the rigid start

    **Range** every start and stop.
    **Error** a bound for a ramp and ropes of constant length, otherwise an engineering measure.
    **Source** derived at `large_bound`.
    """
    if not model.hanging(spec, scene):
        return Criterion("Δθ/θ", 0.0, LARGE_THRESHOLD, "change of the sway by finite angles", "derived")
    motion = motion_of(spec, scene)
    a = mean_acceleration(spec, scene)
    x = a / motion.gravity
    turned = 2 * math.pi / _period(motion) * motion.speed / a if a else math.inf
    value = far(x) * (2 + turned) / (2 * x) if x else 0.0
    return Criterion("Δθ/θ", value, LARGE_THRESHOLD, "change of the sway by finite angles", "derived")


def large_bound(spec: Travelling, scene: Moving, loads: Loads) -> Offsets:
    """Difference e between the finite-angle sway psi and the linear sway, under a sudden acceleration a = x g.

        e'' + omega^2 e = omega^2 R,   R = psi - sin psi - x (1 - cos psi)

    From rest 0 <= psi <= 2 atan x, where R falls from 0 to -2 h, h = x - atan x. The mean -h alone contributes 2 h
    |sin(omega t/2)| to (e, e'/omega); the deviation from the mean contributes at most h omega t:

        |(e, e'/omega)| <= h (2 |sin(omega t/2)| + omega t)

    For a free sway that begins with rho = |(psi, psi'/omega)|, the maximum angle is between rho and 2 asin(rho/2). The
    rope force is T = M (3 g cos psi + 3 a sin psi - 2 g), and M g (3 cos psi - 2 cos A) in a free sway of amplitude A.

    **Range** a ramp from rest or to rest, ropes of constant length, no wind or slope on the load, a below g; zero for a
    crane without a suspended load; otherwise unbounded.
    **Error** a bound; on the seeded sample of the test, a third of this bound is exceeded.
    **Source** derived: Duhamel's integral; energy of the pendulum.
    """
    motion = motion_of(spec, scene)
    if not motion.load:
        return {}
    if not regular(motion):
        return _anything(loads)
    try:
        course = linear_course(motion)
    except NumericsError:
        return _anything(loads)
    wide = loads_of(spec, scene, widened(motion, course))
    narrow = loads_of(spec, scene, course)
    return {
        name: Interval(
            min(wide[name].estimate.low - narrow[name].estimate.low, 0.0),
            max(wide[name].estimate.high - narrow[name].estimate.high, 0.0),
        )
        if name != "sway_angle_max"
        else Interval(
            wide[name].estimate.low - narrow[name].estimate.low, wide[name].estimate.high - narrow[name].estimate.high
        )
        for name in loads
        if name in wide and name in narrow and wide[name].estimate != narrow[name].estimate
    }


# -- motor ----------------------------------------------------------------------------------------------------------


def curve_criterion(spec: Travelling, scene: Moving) -> Criterion:
    """Relative range of the motor torque up to full speed.

        (M_max - M_min)/M_mean

    **Range** a torque-controlled start with a motor curve; otherwise 0.
    **Error** an engineering measure.
    **Source** the curve of the file.
    """
    value = 0.0
    if follows_curve(spec, scene):
        curve = spec.drive.motor.curve
        assert curve is not None
        torques = curve.torque(np.linspace(0.0, model.motor_speed(spec), 65), np.inf)
        value = float(np.ptp(torques)) / spec.drive.motor.mean_torque
    return Criterion("ΔM/M", value, CURVE_THRESHOLD, "range of the motor torque / mean motor torque", "motor curve")


def follows_curve(spec: Travelling, scene: Moving) -> bool:
    """Whether a start is by the torque of a motor whose curve is given."""
    by_torque = model.starts(scene) and model.commanded(spec, scene) is None
    return by_torque and spec.drive.motor.curve is not None


def curve_bound(spec: Travelling, scene: Moving, loads: Loads) -> Offsets:
    """Zero if the start follows no motor curve; otherwise unbounded.

    **Range** every load of a start or a stop.
    **Error** exact without a curve; otherwise unbounded: the maximum torque of a motor is several times its mean.
    **Source** the curve of the file.
    """
    return _anything(loads) if follows_curve(spec, scene) else {}


# -- wheels ---------------------------------------------------------------------------------------------------------


def slip_criterion(spec: Travelling, scene: Moving) -> Criterion:
    """Ratio of required force to adhesion of the driven wheel with the lowest adhesion; the load force counts twice
    that of uniform acceleration.

        F/(mu N)

    **Range** every start and stop.
    **Error** an engineering measure: exact for a sudden ramp of half a period or more and small angles.
    **Source** Coulomb's friction, `laws.skid`.
    """
    motion = motion_of(spec, scene)
    a = mean_acceleration(spec, scene) * (1 if motion.starts else -1)
    pull = motion.on_load + 2 * motion.load * a
    traction = motion.body * a + motion.rolling + motion.wind + pull
    state = State(a, pull, motion.load * motion.gravity, traction, motion.wind)
    least = float(Wheels.of(spec, scene).least_grip(state)[0])
    value = 1 / least if least else math.inf
    return Criterion("F/μN", value, SLIP_THRESHOLD, "required force of a driven wheel / adhesion", "laws.skid")


def slip_bound(spec: Travelling, scene: Moving, loads: Loads) -> Offsets:
    """Zero if no driven wheel requires more than its adhesion; otherwise unbounded.

    **Range** every load of a start or a stop.
    **Error** exact if all wheels roll; otherwise unbounded: a crane with slipping wheels starts and stops differently.
    **Source** Coulomb's friction.
    """
    least = loads.get("skid_reserve_min")
    return (
        {}
        if least is not None and least.low >= 1
        else {name: offset for name, offset in _anything(loads).items() if not name.startswith("skid_reserve")}
    )


EFFECTS_OF_TRAVEL: tuple[AnyEffect, ...] = (
    Effect(SWAY, "load sway", MOVING_SCENES, sway_criterion, anything_bound),
    Effect(
        REACTION,
        "reaction of the swinging load on a torque-controlled drive",
        MOVING_SCENES,
        reaction_criterion,
        reaction_bound,
    ),
    Effect(HOISTING, "rope length change during sway", MOVING_SCENES, hoisting_criterion, hoisting_bound),
    Effect(WIND, "wind and rail slope", MOVING_SCENES, wind_criterion, wind_bound),
    Effect(LARGE, "finite sway angles (nonlinear pendulum)", MOVING_SCENES, large_criterion, large_bound),
    Effect(CURVE, "motor torque-speed curve", MOVING_SCENES, curve_criterion, curve_bound),
    Effect(SLIP, "slip of driven wheels", MOVING_SCENES, slip_criterion, slip_bound),
)
