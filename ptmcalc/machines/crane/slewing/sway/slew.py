"""The rotation simulated: a load that swings under a jib that motor, brake, friction and wind turn."""

import math
from dataclasses import replace

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Finding, Found, History, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.crane.slewing.drive import reserves
from ptmcalc.machines.crane.slewing.drive.loads import OF_THE_DRIVE
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import Slew, SlewingCrane, SlewingScene
from ptmcalc.machines.crane.slewing.ring import forces
from ptmcalc.machines.crane.slewing.ring.loads import OF_THE_RING
from ptmcalc.machines.crane.slewing.rotation import chain
from ptmcalc.machines.crane.slewing.sway.loads import OF_THE_SWING
from ptmcalc.machines.crane.slewing.sway.simulated_rotation import Rotation, rotation

ALWAYS = frozenset({"efficiency_direction", "load_swing", "centrifugal_offset"})
_STEP, _EVENT = 2.5e-3, 1.5e-2
"""Seconds of a step and of an event: a load that drags the crane through its brake stops it dozens of times."""
_SIGNALS = {"sway_radial_max": "across", "sway_tangential_max": "along", "sway_max": "sway"}


def run(spec: SlewingCrane, scene: SlewingScene, carried: frozenset[str], level: int) -> Result:
    """A complete slewing motion with the load as a spherical pendulum on the jib.

        d = a_S + lambda r for the load, |r| = L;   (J + J_r k) phi\'\' = M(phi\') k - M_fr sgn - M_w + R lambda m r_t

    From standstill the motor turns the crane against friction, steady wind and a gust. The crane keeps its slewing
    speed until the remaining angle equals the stopping angle of the rigid crane. Then the motor is off, the maximum
    wind drives, and the brake closes after its delay. A given starting time, or a self-locking gear, imposes the motion
    instead. The simulation ends three sway periods after the stop; the error includes slow later motion.

    **Range** a rigid jib, a point load on a taut rope.
    **Error** numerical: the difference of two runs, carried along with the state. Two effects can be neglected: the
    motor\'s curve (its mean torque instead) and the gust.
    **Source** equations of motion (`numerics.pendulum`).
    """
    moved = rotation(spec, scene, curve="slewing_motor_curve" in carried, gust="wind_gust" in carried)
    at = model.phase_torques(spec, scene, model.start_of(spec, scene)[1], by_direction=True)
    loads = dict(chain.loads(spec, scene, moved.phases, at, rounded=False))
    loads |= reserves.of_drive(spec, scene, moved.phases, at, chain.worth(spec, scene, 2.0))
    bar = 10 * moved.bar
    found = {name: Found(_told(value, bar)) for name, value in loads.items()}
    if moved.phases.start[0] == model.ramp(spec):
        found["start_time"] = Found(Estimate.exact(moved.phases.start[0]))
    for name, signal in _SIGNALS.items():
        peak = moved.farthest(signal)
        found[name] = Found(Estimate.within(peak.value, peak.bar), at={"time": peak.time})
    last = moved.pieces[-1]
    rest = last.motion.known("amplitude", last.lasts)
    for name, share in (("brake_angle", 1.0), ("rotation_used", 1 / spec.cycle.rotation)):
        found[name] = Found(_dragged(found[name].estimate, share * moved.creep))
    residual = Estimate.within(rest.value, rest.bar + last.inherited)
    found["sway_residual"] = Found(replace(residual, low=0.0, model=residual.value) if moved.creep else residual)
    for name in _SIGNALS:
        found[name] = replace(found[name], estimate=_turning(found[name].estimate, residual.high))
    found |= _ring(spec, scene, moved)
    steps = sum(piece.motion.steps for piece in moved.pieces)
    events = tuple(event for piece in moved.pieces for event in piece.events())
    return Result(
        found,
        work=steps,
        spent=_STEP * steps + _EVENT * len(events),
        window=(0.0, last.begins + last.lasts),
        health={"energy_residual": max(piece.motion.works().residual for piece in moved.pieces)},
        findings=tuple(_doubts(moved)),
        events=events,
        histories=lambda: _histories(moved),
    )


def _dragged(seen: Estimate, creep: float) -> Estimate:
    """A way that can still grow."""
    return replace(seen, high=seen.high + creep, model=creep) if creep else seen


def _turning(seen: Estimate, residual: float) -> Estimate:
    """A swing that was looked at for a while: its plane goes on turning slowly, so that in the end all of it may be
    on either axis; where it is damped, less."""
    return seen if residual <= seen.high else replace(seen, high=residual, model=max(residual - seen.value, 0.0))


def _told(value: float, share: float) -> Estimate:
    """A number that may be off by a share of itself; a reserve over nothing is infinite whatever the share."""
    return Estimate.within(value, share * abs(value)) if math.isfinite(value) else Estimate.exact(value)


def _doubts(moved: Rotation) -> list[Finding]:
    """Pieces whose two computations met other events."""
    if all(piece.motion.settled for piece in moved.pieces):
        return []
    return [Finding("NUM101", "two computations of the rotation have different events: their order is unknown")]


def _histories(moved: Rotation) -> dict[str, History]:
    return {name: History(units.ANGLE, *moved.history(signal)) for name, signal in _SIGNALS.items()}


def _ring(spec: SlewingCrane, scene: SlewingScene, moved: Rotation) -> dict[str, Found]:
    """Forces of the ring: the largest lie between those at the largest pull of the rope, and all at their largest."""
    steady = forces.of_ring(spec, scene)
    load = spec.load
    if not steady or load is None:
        return {}
    hanging = model.hanging_mass(spec, scene) * spec.gravity
    tension, across, along = (moved.farthest(name) for name in ("tension", "pull_across", "pull_along"))
    sideways = math.hypot(across.value + across.bar, along.value + along.bar)
    wind, head = spec.ring.wind_force or 0.0, (spec.ring.head_height or 0.0)
    own = forces.moment_above(spec)
    behind = abs(own) / spec.gravity * spec.speed**2
    jerk = moved.farthest("acceleration")
    dragged = abs(own) / spec.gravity * math.hypot(spec.speed**2, jerk.value + jerk.bar)
    upright = tension.value + tension.bar
    down = math.sqrt(max(tension.value**2 - sideways**2, 0.0))
    blown = wind * (spec.ring.wind_height or 0.0)
    tilting = (own + load.radius * down, own + load.radius * upright)
    still = own + load.radius * hanging
    found = {
        "ring_force_axial": (forces.weight_above(spec) + max(hanging, down), forces.weight_above(spec) + upright),
        "ring_force_radial": (max(across.value - across.bar - behind, 0.0), sideways + dragged + wind),
        "ring_moment": (
            max(abs(still), abs(own) - load.radius * upright, tilting[0]),
            max(abs(still), abs(own), abs(tilting[1])) + sideways * head + blown,
        ),
    }
    return {
        name: Found(Estimate(high, low, high, numerical=0.0, model=high - low)) for name, (low, high) in found.items()
    }


def hangs(spec: SlewingCrane, scene: SlewingScene) -> Criterion | None:
    """Whether nothing hangs on the rope.

        1 without a load or the length of its rope

    **Range** any crane.
    **Error** none.
    **Source** the file.
    """
    load = spec.load
    hangs = load is not None and load.rope_length is not None and model.hanging_mass(spec, scene) > 0
    return Criterion("no load", 0.0 if hangs else 1.0, 0.5, "nothing swings", "the file")


def _cost(spec: SlewingCrane, scene: SlewingScene, carried: frozenset[str], level: int) -> float:
    """Seconds by the swings of the load in the time that is looked at; a load that is whirled round takes more."""
    load = spec.load
    if load is None or load.rope_length is None:
        return 0.0
    omega = math.sqrt((spec.gravity + spec.speed**2 * load.radius) / load.rope_length)
    stop = model.stop(spec, scene) or model.allowed_stop(spec)
    whole = 3 * model.start_of(spec, scene)[0] + spec.cycle.rotation / spec.speed + 2 * stop[0]
    whole *= scene.window_factor
    if not math.isfinite(whole):
        return 0.01
    return (0.15 + 1.5e-3 * (whole * omega + 40)) * (1 + spec.speed / omega) + 0.01 * len(carried)


SLEW: Solver[SlewingCrane, SlewingScene] = Solver(
    name="slew",
    title="slewing motion with spherical pendulum, event-driven",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Slew}),
    represents=ALWAYS | {"slewing_motor_curve", "wind_gust"},
    gives=chain.GIVEN | {info.name for info in (*OF_THE_DRIVE, *OF_THE_SWING, *OF_THE_RING)} - {"ring_utilisation"},
    run=run,
    cost=_cost,
    source="equations of motion of a spherical pendulum on a slewing jib",
    valid=hangs,
    always=ALWAYS,
)
