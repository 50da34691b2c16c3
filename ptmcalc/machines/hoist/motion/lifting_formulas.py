"""Textbook formulas of lifting, starting, stopping and letting go; shown beside what is computed."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import AnySolver, Fidelity, Solver
from ptmcalc.laws import lift_off, lift_off_standard, rope_rod, two_mass
from ptmcalc.machines.hoist.machine import model
from ptmcalc.machines.hoist.machine.spec import Hoist, HoistScene, Lift, LowerBrake, Release, Start, Stop
from ptmcalc.machines.hoist.motion.reduced import (
    braked_way,
    hook_brake_force,
    moving_inertia,
    ratio,
    reduced,
    rope_mass,
    start_hook_speed,
    travel,
)

_BETA = {"slow": 0.5, "quick": 1.0}
"""Factor beta_3 of a slow (grab) and a quick release (magnet) [1], EN 13001-2 and ISO 8686-1. The relief of the
structure is proportional to 1 + beta_3."""


def _shown(**values: float) -> Result:
    return Result({name: Found(Estimate.unknown(value)) for name, value in values.items()}, work=1)


def run_takeup(spec: Hoist, scene: Lift, carried: frozenset[str], level: int) -> Result:
    """Lift-off by a drive of finite mass with constant mean starting torque.

        v_1^2 = v_0^2 + Q (2 P - Q)/(K m_1),   F_max = F_eq + ((F_eq - Q)^2 + K mu v_1^2)^(1/2)

    **Range** rigid structure and gear, no damping; for a stall the formula returns the stall force.
    **Error** no bound: the formula does not limit the drive to its set speed.
    **Source** `laws.two_mass.takeup`.
    """
    one = reduced(spec, scene)
    speed = start_hook_speed(spec, scene)
    found = two_mass.takeup(one.drive_mass, one.load_mass, one.stiffness, one.drive_force, one.weight, speed)
    return _shown(
        lift_off_factor=found.peak_force / one.weight,
        rope_force_max=found.peak_force,
        lift_off_speed=found.lift_off_speed,
        tension_time=found.time,
    )


def run_speed_source(spec: Hoist, scene: Lift, carried: frozenset[str], level: int) -> Result:
    """Lift-off by a drive of constant speed.

        psi = 1 + v/(g delta)^(1/2)

    **Range** rigid or massless structure, no damping.
    **Error** no bound.
    **Source** `laws.lift_off.speed_source_factor`.
    """
    one = reduced(spec, scene)
    speed = start_hook_speed(spec, scene)
    factor = float(lift_off.speed_source_factor(speed, one.weight / one.stiffness, spec.gravity))
    return _shown(lift_off_factor=factor)


def run_standard(spec: Hoist, scene: Lift, carried: frozenset[str], level: int) -> Result:
    """Lift-off factor by the hoisting class.

        phi_2 = phi_2,min + beta_2 v_h

    **Range** a file that gives the hoisting class.
    **Error** no bound: the factor depends on neither mass nor stiffness.
    **Source** EN 13001-2 and ISO 8686-1, the edition and combination of the file.
    """
    factor = model.class_factor(spec)
    assert factor is not None
    return _shown(lift_off_factor=factor)


def has_class(spec: Hoist, scene: Lift) -> Criterion:
    """Whether the file gives the hoisting class.

    **Range** any file.
    **Error** none.
    **Source** the file.
    """
    return Criterion("-", 0.0 if spec.classes.hoisting else 1.0, 1.0, "no hoisting class is given", "")


def run_braking(spec: Hoist, scene: LowerBrake | Stop, carried: frozenset[str], level: int) -> Result:
    """Stop by the brake, two-mass formulas.

        lowering: F = Q + M/(m_1 + M) (P_b - Q + (Q^2 + P_b^2 - 2 Q P_b cos(w t_d))^(1/2)), at most Q + v (K M)^(1/2)
        hoisting: F = Q - min(v (K M)^(1/2), 2 (P_b + Q) M/(m_1 + M))

    **Range** the drive still moves at the peak; a taut rope; no rise time of the brake.
    **Error** no bound.
    **Source** `laws.two_mass`, `laws.brake.brake_stop`.
    """
    one, brake = reduced(spec, scene), spec.brake
    assert brake is not None
    force = hook_brake_force(spec, scene)
    if isinstance(scene, Stop) and scene.direction == "up":
        least = two_mass.hoisting_stop_force(one.speed, force, one.weight, one.drive_mass, one.load_mass, one.stiffness)
        return _shown(rope_force_min=max(least, 0.0))
    most = float(
        two_mass.lowering_brake_force(
            force, one.weight, brake.delay + brake.rise_time / 2, one.drive_mass, one.load_mass, one.stiffness
        )
    )
    faster = one.speed + spec.gravity * (brake.delay + brake.rise_time) * one.load_mass / (
        one.drive_mass + one.load_mass
    )
    peak = min(most, two_mass.speed_step_force(faster, one.stiffness, one.load_mass, one.weight))
    _, way = braked_way(spec, scene)
    return _shown(lowering_brake_factor=peak / one.weight, rope_force_max=peak, stop_distance_lowering=way)


def run_start(spec: Hoist, scene: Start, carried: frozenset[str], level: int) -> Result:
    """Start of a suspended load by a force step.

        F = Q + 2 (P - Q) M/(m_1 + M) upward;   downward the maximum force is that at the end of the start

    **Range** a step of torque, rope taut, no damping.
    **Error** no bound; a slowly rising force has no factor 2.
    **Source** `laws.two_mass.hanging_start_force`.
    """
    one = reduced(spec, scene)
    peak = two_mass.hanging_start_force(one.drive_force, one.weight, one.drive_mass, one.load_mass)
    return _shown(start_factor=peak / one.weight, rope_force_max=peak) if scene.direction == "up" else _shown()


def run_release(spec: Hoist, scene: Release, carried: frozenset[str], level: int) -> Result:
    """Release of a part of the load, by the standard.

        phi_3 = 1 - (dm/m) (1 + beta_3)

    **Range** any part.
    **Error** no bound for a slow release.
    **Source** EN 13001-2 and ISO 8686-1.
    """
    share = scene.share * spec.load / (spec.load + spec.hook_block) if scene.load == "full" else 0.0
    return _shown(release_factor=float(lift_off.release_factor(share, _BETA[scene.manner])))


def run_rod(spec: Hoist, scene: HoistScene, carried: frozenset[str], level: int) -> Result:
    """Lowest natural frequency of drive and load on a rope with distributed mass.

        w = B (K/m_r)^(1/2),   B = atan(m_r/(m_1 B)) + atan(m_r/(M B))

    **Range** rigid gear and structure.
    **Error** exact for that model; `two_mass` is the model with a massless rope.
    **Source** `laws.rope_rod.free_rod_frequency`.
    """
    one = reduced(spec, scene)
    drive = moving_inertia(spec, scene) * (ratio(spec) / travel(spec, scene)) ** 2 - one.load_mass
    rope = rope_mass(spec, scene)
    if drive <= 0:  # rounding of a drum whose load outweighs everything: nothing to show
        return _shown()
    return _shown(natural_frequency=rope_rod.free_rod_frequency(one.stiffness, rope, drive, one.load_mass))


def run_third_mass(spec: Hoist, scene: HoistScene, carried: frozenset[str], level: int) -> Result:
    """Natural frequency with one third of the rope mass added to the load and a fixed drum.

        w = (K/(M + m_r/3))^(1/2)

    **Range** a drive much heavier than the load, a rigid structure (`is_held`).
    **Error** no bound: the drive oscillates, too.
    **Source** `laws.rope_rod.third_mass_frequency`, Lord Rayleigh.
    """
    one = reduced(spec, scene)
    return _shown(natural_frequency=rope_rod.third_mass_frequency(one.stiffness, rope_mass(spec, scene), one.load_mass))


def run_by_deflection(spec: Hoist, scene: Lift, carried: frozenset[str], level: int) -> Result:
    """Lift-off factor by the standard, with the hoisting class from the deflection of rope and structure.

        delta = Q/K + Q/K_b,   HC1 from 0.8 m, HC2 from 0.3 m, HC3 from 0.15 m, HC4 below

    **Range** the rated load.
    **Error** no bound, as `run_standard`.
    **Source** EN 13001-2; `laws.lift_off_standard.stiffness_class`.
    """
    one, under = reduced(spec, scene), spec.structure
    deflection = one.weight / one.stiffness + (one.weight / under.stiffness if under is not None else 0.0)
    return _shown(lift_off_factor=model.standard_factor(spec, lift_off_standard.stiffness_class(deflection)))


def is_full(spec: Hoist, scene: Lift) -> Criterion:
    """Whether the rated load is lifted.

    **Range** any file.
    **Error** none.
    **Source** the file.
    """
    return Criterion("-", 0.0 if scene.load == "full" else 1.0, 1.0, "the hook is empty", "")


def is_held(spec: Hoist, scene: HoistScene) -> Criterion:
    """Whether the drive is so heavy, and all else so stiff, that the load swings as on a drum that stands.

    **Range** any file.
    **Error** an engineering measure: at a tenth of the drive's mass the frequency rises by 5 %.
    **Source** two masses on a spring.
    """
    one = reduced(spec, scene)
    share = one.load_mass / one.drive_mass if one.drive_mass else 1.0
    fits = not is_rigid(spec, scene).exceeded
    return Criterion("M/m_1", share if fits else 1.0, 0.1, "load relative to drive, or flexible gear and structure", "")


def is_rigid(spec: Hoist, scene: HoistScene) -> Criterion:
    """Whether rope, drive and load are all that swings.

    **Range** any file.
    **Error** none.
    **Source** the file.
    """
    gear = spec.gearbox
    rigid = spec.structure is None and (gear is None or gear.stiffness is None)
    return Criterion("-", 0.0 if rigid else 1.0, 1.0, "flexible gear or structure", "")


def _cost(spec: Hoist, scene: HoistScene, carried: frozenset[str], level: int) -> float:
    return 1e-4


TAKEUP: Solver[Hoist, Lift] = Solver(
    name="takeup",
    title="lift-off at constant drive force",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Lift}),
    represents=frozenset(),
    gives=frozenset({"lift_off_factor", "rope_force_max", "lift_off_speed", "tension_time"}),
    run=run_takeup,
    cost=_cost,
    source="energy and phase plane of two masses, ptmcalc.laws.two_mass",
    decides=False,
)
STANDARD: Solver[Hoist, Lift] = Solver(
    name="standard_phi2",
    title="phi2 of the crane standards",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Lift}),
    represents=frozenset(),
    gives=frozenset({"lift_off_factor"}),
    run=run_standard,
    cost=_cost,
    source="EN 13001-2, ISO 8686-1",
    valid=has_class,
    decides=False,
)
SPEED_SOURCE: Solver[Hoist, Lift] = Solver(
    name="speed_source",
    title="lift-off at constant speed",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Lift}),
    represents=frozenset(),
    gives=frozenset({"lift_off_factor"}),
    run=run_speed_source,
    cost=_cost,
    source="two-mass model with a drive of unlimited mass, ptmcalc.laws.lift_off",
    decides=False,
)
BRAKING: Solver[Hoist, LowerBrake | Stop] = Solver(
    name="braked_two_mass",
    title="stop, two-mass formulas: rope force and stopping distance",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({LowerBrake, Stop}),
    represents=frozenset(),
    gives=frozenset({"lowering_brake_factor", "rope_force_max", "rope_force_min", "stop_distance_lowering"}),
    run=run_braking,
    cost=_cost,
    source="phase plane of two masses, ptmcalc.laws.two_mass",
    decides=False,
)
HANGING: Solver[Hoist, Start] = Solver(
    name="hanging_start",
    title="start of a suspended load, two-mass formula",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Start}),
    represents=frozenset(),
    gives=frozenset({"start_factor", "rope_force_max"}),
    run=run_start,
    cost=_cost,
    source="step of force on two masses, ptmcalc.laws.two_mass",
    decides=False,
)
RELEASE: Solver[Hoist, Release] = Solver(
    name="standard_phi3",
    title="phi3 of the crane standards",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Release}),
    represents=frozenset(),
    gives=frozenset({"release_factor"}),
    run=run_release,
    cost=_cost,
    source="EN 13001-2, ISO 8686-1",
    decides=False,
)
ROD: Solver[Hoist, HoistScene] = Solver(
    name="rod",
    title="natural frequency, rope with distributed mass",
    fidelity=Fidelity.MODAL,
    scenes=frozenset({Lift, Start, Stop, LowerBrake}),
    represents=frozenset(),
    gives=frozenset({"natural_frequency"}),
    run=run_rod,
    cost=_cost,
    source="longitudinal vibration of a rod with end masses, ptmcalc.laws.rope_rod",
    valid=is_rigid,
    decides=False,
)
THIRD_MASS: Solver[Hoist, HoistScene] = Solver(
    name="third_mass",
    title="natural frequency with one third of the rope mass",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Lift, Start, Stop, LowerBrake}),
    represents=frozenset(),
    gives=frozenset({"natural_frequency"}),
    run=run_third_mass,
    cost=_cost,
    source="Rayleigh's quotient, ptmcalc.laws.rope_rod",
    valid=is_held,
    decides=False,
)
BY_DEFLECTION: Solver[Hoist, Lift] = Solver(
    name="phi2_by_deflection",
    title="phi2 with the hoisting class from the deflection",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Lift}),
    represents=frozenset(),
    gives=frozenset({"lift_off_factor"}),
    run=run_by_deflection,
    cost=_cost,
    source="EN 13001-2, ISO 8686-1",
    valid=is_full,
    decides=False,
)
FORMULAS: tuple[AnySolver, ...] = (
    ROD,
    THIRD_MASS,
    TAKEUP,
    STANDARD,
    SPEED_SOURCE,
    BY_DEFLECTION,
    BRAKING,
    HANGING,
    RELEASE,
)
