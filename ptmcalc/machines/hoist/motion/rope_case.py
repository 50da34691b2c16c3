"""A scene of a hoist for a rope with a life of its own: the same drive, brake and load as `moving`, at the hook."""

import math

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.laws import rope_rod
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.keys import tackle
from ptmcalc.machines.hoist.machine.spec import Hoist, Lift
from ptmcalc.machines.hoist.motion.cases import case_of
from ptmcalc.machines.hoist.motion.reduced import hauling_efficiency, lowering_efficiency, ratio, rope_mass, travel
from ptmcalc.machines.hoist.motion.train import BRAKE, DRIVE, DRUM, MAINS, MOTOR, STRUCTURE, Case, Moving
from ptmcalc.numerics.rope.equations import Hauled, Rod
from ptmcalc.numerics.rope.parts import NONE, Course, Governed, Haul, Law, Lines, Smooth, Stage, Structure, Tripped
from ptmcalc.numerics.train import parts
from ptmcalc.numerics.train.signals import ONE, Signal

CARRIED = frozenset({STRUCTURE})


def case(spec: Hoist, scene: Moving) -> Case:
    """The scene with its structure, the gear rigid."""
    return case_of(spec, scene, CARRIED)


def rod(spec: Hoist, scene: Moving) -> Rod:
    """The rope with its mass."""
    return Rod(model.hook_stiffness(spec, model.hook_height(scene)), rope_mass(spec, scene))


def hauled(spec: Hoist, scene: Moving) -> Hauled:
    """The rope with its length."""
    height = model.hook_height(scene)
    length = model.rope_length(spec, height) / model.falls_of_a_rope(spec)
    stiffness = model.hook_stiffness(spec, height)
    one = case(spec, scene)
    damping = 2 * spec.rope.damping * math.sqrt(one.stiffness * one.weight / spec.gravity)
    return Hauled(stiffness * length, length, damping, one.weight / (stiffness * length))


def haul(spec: Hoist, scene: Moving, coarser: Case | None = None) -> Haul:
    """Drive, structure and load of a scene; `coarser` is its case with fewer chords of a smooth rise."""
    one = coarser or case(spec, scene)
    train = one.train
    arm, turns = travel(spec, scene), ratio(spec) / travel(spec, scene)
    motor = train.bodies[_index(one, "body", MOTOR)]
    drum = train.bodies[_index(one, "body", DRUM)]
    given = spec.structure
    brake = one.named("grip", BRAKE)
    on_motor = spec.brake is not None and spec.brake.shaft == "motor"
    stopping = Tripped()
    if brake is not None:
        stopping = _tripped(train.grips[brake].capacity, turns if on_motor else 1 / arm)
    grip, curve = one.named("grip", DRIVE), one.named("drive", DRIVE)
    stages: tuple[Stage, ...] = ()
    if curve is not None:
        stages = tuple(_stage(stage, turns) for stage in train.drives[curve].stages)
    return Haul(
        motor_mass=motor.inertia * turns**2,
        drum_mass=drum.inertia / arm**2,
        load_mass=one.weight / spec.gravity,
        weight=one.weight,
        gear=(model.efficiency(spec), model.reverse_efficiency(spec)),
        tackle=(hauling_efficiency(spec), lowering_efficiency(spec)),
        structure=Structure(given.stiffness, given.mass, _damping(given)) if given is not None else None,
        lifts=isinstance(scene, Lift),
        slack=(scene.slack or 0.0) if isinstance(scene, Lift) and scene.rope == "slack" else 0.0,
        speed=motor.speed / turns,
        way=-1 if one.lowers else 1,
        set_speed=_set_speed(one, turns) if grip is not None else None,
        capacity=_course(train.grips[grip].capacity, turns) if grip is not None else NONE,
        stages=stages,
        gate=_tripped(_gate(one), 1.0),
        motor_brake=stopping if on_motor else Tripped(),
        drum_brake=Tripped() if on_motor else stopping,
        level=_level(one),
    )


def _gate(one: Case) -> Signal:
    """What switches the motor off."""
    grip, curve = one.named("grip", DRIVE), one.named("drive", DRIVE)
    if grip is not None:
        return one.train.grips[grip].gate
    return one.train.drives[curve].gate if curve is not None else ONE


def _index(one: Case, what: str, name: str) -> int:
    found = one.named(what, name)
    assert found is not None
    return found


def _damping(given: tackle.Structure) -> float:
    return 2 * given.damping * math.sqrt(given.stiffness * given.mass)


def _level(one: Case) -> float:
    """Rope force at which the limiter trips [N]."""
    triggers = (grip.capacity.trigger for grip in one.train.grips)
    gates = [drive.gate.trigger for drive in one.train.drives] + [grip.gate.trigger for grip in one.train.grips]
    levels = [trigger.level for trigger in (*triggers, *gates) if trigger is not None]
    return min(levels, default=math.inf)


def _set_speed(one: Case, turns: float) -> Course:
    """The set speed over time, from the acceleration that guides it."""
    train, mains = one.train, _index(one, "body", MAINS)
    guide = next(guide for guide in train.guides if guide.body == mains)
    speeds, times, rates = [train.bodies[mains].speed], guide.acceleration.times, guide.acceleration.values
    for k in range(1, len(times)):
        speeds.append(speeds[-1] + rates[k - 1] * (times[k] - times[k - 1]))
    return Course(times, tuple(speed / turns for speed in speeds), tuple(rate / turns for rate in rates))


def _course(signal: Signal, scale: float) -> Course:
    return Course(
        signal.times,
        tuple(value * scale for value in signal.values),
        tuple(slope * scale for slope in signal.slopes),
        signal.decay * scale,
        signal.decay_time,
        signal.decay_start,
    )


def _tripped(signal: Signal, scale: float) -> Tripped:
    if signal.trigger is None:
        return Tripped(_course(signal, scale))
    return Tripped(Course(values=(signal.before * scale,)), _course(signal, scale))


def _stage(stage: parts.Stage, turns: float) -> Stage:
    """A stage of the motor's torque as one of force at the hook."""
    until = stage.until / turns if stage.until is not None else None
    return Stage(_law(stage.law, turns), until, stage.until_time)


def _law(law: parts.Law, turns: float) -> Law:
    if isinstance(law, Signal):
        return Lines(np.zeros(1), np.array([law.values[0] * turns]))
    if isinstance(law, parts.Straight):
        return Lines(np.array(law.knots) / turns, np.array(law.values) * turns, law.extends)
    if isinstance(law, parts.Governed):
        reference = _course(law.reference, 1 / turns)
        return Governed(reference, law.stiffness * turns**2, law.limit * turns)
    return Smooth(lambda speed: turns * law.value(turns * speed))


# -- range and frequency --------------------------------------------------------------------------------------------


def has_rigid_gear(spec: Hoist, scene: Moving) -> Criterion:
    """Whether the gear is rigid, does not lock itself, and something heavy turns behind it.

    **Range** any file.
    **Error** none.
    **Source** the file.
    """
    gear = spec.gearbox
    fits = gear is None or gear.stiffness is None
    fits = fits and model.reverse_efficiency(spec) > 0 and model.motor_side_inertia(spec) + (spec.drum.inertia or 0) > 0
    return Criterion("-", 0.0 if fits else 1.0, 1.0, "the gear is flexible, self-locking, or without a drum", "")


def has_rigid_gear_and_no_damping(spec: Hoist, scene: Moving) -> Criterion:
    """The same, and a rope without damping.

    **Range** any file.
    **Error** none.
    **Source** the file; waves of a damped rope keep no shape.
    """
    if spec.rope.damping > 0:
        return Criterion("-", 1.0, 1.0, "the rope has damping, which distorts waves", "")
    return has_rigid_gear(spec, scene)


def frequency(spec: Hoist, scene: Moving) -> Estimate:
    """Lowest natural frequency with the mass of the rope, the drive free [rad/s]."""
    one, rope = haul(spec, scene), rod(spec, scene)
    structure = one.structure
    return Estimate.exact(
        rope_rod.framed_rod_frequency(
            rope.stiffness,
            rope.mass,
            one.motor_mass + one.drum_mass,
            one.load_mass,
            structure.stiffness if structure is not None else math.inf,
            structure.mass if structure is not None else 0.0,
        )
    )
