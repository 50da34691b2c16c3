"""How long mechanisms start and stop, and how often they may."""

import math

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.laws import mast as law
from ptmcalc.machines.crane.stacking.machine import columns, model
from ptmcalc.machines.crane.stacking.machine.keys.drives import Rotation, Travel
from ptmcalc.machines.crane.stacking.machine.scenes import Brake, Braked, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker


def of_the_hoist(spec: Stacker) -> float | None:
    """Starts of the hoist over what they may be; None where the file does not say [1]."""
    asked, allowed = spec.hoisting.starts_per_hour, spec.hoisting.permitted_starts_per_hour
    return None if asked is None or allowed is None else asked / allowed


def permitted(block: Travel | Rotation) -> float | None:
    """Starts per hour that motor and brake of a mechanism allow."""
    if block.permitted_starts_per_hour is not None:
        return block.permitted_starts_per_hour
    if isinstance(block, Travel) and block.drive is not None:
        return block.drive.motor.starts_per_hour
    return None


def of_the_mechanism(spec: Stacker, scene: Braked) -> float | None:
    """Starts of a mechanism over what they may be; None where the file does not say [1]."""
    block = model.moving(spec, scene)
    allowed = permitted(block)
    if block.starts_per_hour is None or allowed is None:
        return None
    return block.starts_per_hour / allowed


def time(spec: Stacker, scene: Braked) -> Estimate:
    """Of a start or a stop of the mechanism of a scene, until it first has its speed or first stands [s].

    Where the column may pull what it stands on through its brake again (`slips_again`), it stands for good later.

        ramp:  t = v/a + t_r          force:  M v = integral of P          curve:  t = integral of M dv/P(v)

    A force moves the centre of mass of all that travels as if it were rigid; the speed of what holds the column differs
    from that of the centre by its swing, at most

        beta = P ((1/m1 - 1/M) A)^(1/2),   A <= ((m_c + m_2)/M)^2/c

    by Cauchy from sum phi_i^2/omega_i over the modes of the free crane: sum phi_i^2 = 1/m1 - 1/M (completeness) and
    sum phi_i^2/omega_i^2 = A, twice the strain energy of the column under its own inertia, which is at most that of a
    column that has it all at its end. So the time is between those to lose v - beta and v + beta.

    **Range** a column that swings little; a resistance that begins with the brake; a guide at the head holds from
    outside: no bound then, and none along a motor's curve. A drive that is weaker than the resistance at any speed of
    the start stalls.
    **Error** as derived above.
    **Source** momentum; derived.
    """
    block = model.moving(spec, scene)
    if isinstance(block, Rotation):
        return Estimate.exact(_of_a_rotation(block, scene))
    push = model.stopping(spec, scene) if isinstance(scene, Brake) else model.driving(spec, scene)
    speed = model.speed(spec, scene)
    if push.kind == "ramp":
        return Estimate.exact(ramp_time(speed, push.size, push.rise))
    if push.size <= 0 or _stalls(spec, scene):
        return Estimate.exact(math.inf)
    if model.uneven(spec, scene):
        return _along_a_curve(spec, scene, push, speed)
    whole = moving_mass(spec, scene) + push.rotors
    value, low, high = (
        push.delay + force_time(whole, max(v, 0.0), push.size, push.rise)
        for v in (speed, *_ends_of_speed(spec, scene, push, speed, whole))
    )
    return Estimate(value, low, high, model=max(value - low, high - value))


def _stalls(spec: Stacker, scene: Braked) -> bool:
    """Whether the drive of a start does not overcome the resistance at every speed up to full speed."""
    if not isinstance(scene, Start):
        return False
    block = model.moving(spec, scene)
    if not isinstance(block, Travel) or block.drive is None:
        return False
    return float(np.min(model.surplus(spec, scene))) <= 0


def _along_a_curve(spec: Stacker, scene: Braked, push: model.Push, speed: float) -> Estimate:
    """Of a rigid crane along the motor's curve: nothing bounds what the swing of its column makes of it."""
    slowness = (moving_mass(spec, scene) + push.rotors) / model.surplus(spec, scene)
    return Estimate.unknown(float(np.trapezoid(slowness, dx=speed / (len(slowness) - 1))))


def _ends_of_speed(spec: Stacker, scene: Braked, push: model.Push, speed: float, whole: float) -> tuple[float, float]:
    guide = spec.column.top_guide
    if guide is not None and guide.stiffness is not None:
        return 0.0, math.inf
    given = columns.swinging(spec, scene, push.rotors)
    stiffness = given.stiffness + min(given.weight, 0.0)
    if stiffness <= 0:
        return 0.0, math.inf
    swing = push.size * math.sqrt((1 / given.base - 1 / whole) / stiffness) * (whole - given.base) / whole
    return speed - swing, speed + swing


def slips_again(given: columns.Swinging) -> float:
    """What the column asks of the brake after the first standstill, over what that has [1].

        max( 2 (M - m1)/M,  2 (m12 + m22)/M max(1, (1 + r)/(2 r^(1/2))) ),   1 + r = m22 M/(m11 m22 - m12^2)

    m1 is what is braked, M all that travels, m11, m12, m22 the masses of two masses. The second is exact at worst for
    two masses and a force that comes at once, without damping. Modes above the first pull too, the more so the more
    of the column there is: the first takes all that swings. It is at most 1 where what swings is no heavier than what
    is braked, M - m1 <= m1: a blow on the base then moves it forward at all times, h(t) >= 2/M - 1/m1 >= 0.

    **Range** a stop by a force; above 1 the base may slip again, at 1 and below it stands for good.
    **Error** of all modes calibrated: of 240 seeded columns without damping, stopped at once, none with less than 1.06
    slipped again.
    **Source** `laws.mast.after_stop_ratio`; momentum.
    """
    m11, m12, m22 = given.masses
    whole = m11 + 2 * m12 + m22
    r = m22 * whole / (m11 * m22 - m12 * m12) - 1
    lag = law.static_lag(2.0, 1.0, m11, m12, m22)
    two = lag * ((1 + r) / (2 * math.sqrt(r)) if r > 1 else 1.0)
    return max(two, 2 * (given.total - given.base) / given.total)


def stands_at_once(spec: Stacker, scene: Braked) -> bool:
    """Whether the first standstill of a stop is its last: along a ramp, and where the column cannot pull what it stands
    on through its brake. A start ends as the speed is there."""
    if not isinstance(scene, Brake) or isinstance(model.moving(spec, scene), Rotation):
        return True
    push = model.stopping(spec, scene)
    return push.kind == "ramp" or push.size <= 0 or slips_again(columns.swinging(spec, scene, push.rotors)) <= 1


def ramp_time(speed: float, acceleration: float, rise: float) -> float:
    """Of a ramp of speed whose acceleration comes up and goes down in straight lines; without a flat part where the
    speed is too small for it [s]."""
    flat = speed / acceleration - rise
    return flat + 2 * rise if flat >= 0 else 2 * math.sqrt(speed * rise / acceleration)


def force_time(mass: float, speed: float, force: float, rise: float) -> float:
    """In which a force that comes up in a straight line changes the speed of a mass [s]."""
    momentum = mass * speed
    if momentum <= force * rise / 2:
        return math.sqrt(2 * momentum * rise / force)
    return momentum / force + rise / 2


def _of_a_rotation(block: Rotation, scene: Braked) -> float:
    """Of the column about its own axis, rigid [s]."""
    if isinstance(scene, Brake):
        return block.inertia * scene.speed_share * block.speed / (block.braking_torque + (block.resistance or 0.0))
    left = block.driving_torque - (block.resistance or 0.0)
    return block.inertia * block.speed / left if left > 0 else math.inf


def moving_mass(spec: Stacker, scene: Braked) -> float:
    """All that a mechanism moves, without rotors [kg]."""
    return model.carrying_mass(spec, scene) + spec.column.mass + model.climbing_mass(spec, scene)
