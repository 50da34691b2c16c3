"""Stops of the rigid conveyor: what the brakes have to hold, what a run-out tells."""

from collections.abc import Callable, Iterable
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.components.run_out import too_long_a_way
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import AnySolver, Fidelity, Solver
from ptmcalc.laws import stopping
from ptmcalc.machines.conveyor.machine.brakes import brakes_of, braking
from ptmcalc.machines.conveyor.machine.drives import moving_mass, running
from ptmcalc.machines.conveyor.machine.loads import OF_STOP, ways_of
from ptmcalc.machines.conveyor.machine.model import (
    BeltLine,
    belt_line,
    special_resistance,
    stop_factor,
)
from ptmcalc.machines.conveyor.machine.motion import moving
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import Coast, ControlledStop, ConveyorScene, EmergencyStop, Stop
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.spec.scene import Scene


def _exactly(loads: dict[str, float]) -> Result:
    return Result({name: Found(Estimate.exact(value)) for name, value in loads.items()}, work=1)


def brake(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> Result:
    """Torque on the pulley shaft that stops the rigid conveyor within the distance of the file, and the belt tension it
    adds.

        M = (m v^2/(2 s) - W) R,  not below 0;   S_ov = m_belt v^2/(2 s)

    W > 0 opposes the motion and helps; downhill W may be negative. m includes all moving masses and rotors. Without a
    distance in the file the added tension is that of the given brakes, S_ov = m_belt (W + B)/m.

    **Range** uniform deceleration, the brake at full torque from the beginning.
    **Error** exact for the rigid conveyor; the simulated stopping distance includes delay, rise and waves.
    **Source** lecture notes Kramatorsk 2007, signed form.
    """
    way, line = spec.stop_distance_limit(scene), running(spec, scene)
    resistance, belt = line.static_resistance + line.tail_pull, moving_mass(line) - line.drive_mass
    if way is None:
        held = sum(braking(spec, one).force for one in brakes_of(spec, scene).values())
        return _exactly({"tension_overload_braking": belt * max(resistance + held, 0.0) / moving_mass(line)})
    force = float(stopping.braking_force(moving_mass(line), line.speed, way)) - resistance
    return _exactly(
        {
            "brake_torque_required": max(force, 0.0) * spec.main_drive.drum.diameter / 2,
            "tension_overload_braking": float(stopping.braking_force(belt, line.speed, way)),
        }
    )


def brake_notes(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> Result:
    """Textbook brake torque on the pulley shaft.

        M = (|W| + m v^2/(2 s)) R

    **Range** as `brake`; equal to the signed form if the load drives the conveyor.
    **Error** no bound: uphill the formula adds the resistance to the brake force instead of subtracting it.
    **Source** lecture notes Kramatorsk 2007, M, M_st and M_T in turn.
    """
    way = spec.stop_distance_limit(scene)
    if way is None:
        return Result({}, work=1)
    line = running(spec, scene)
    torque = stopping.brake_torque_for_distance(
        moving_mass(line), line.static_resistance + line.tail_pull, line.speed, way, spec.main_drive.drum.diameter,
        ratio=1.0, efficiency=1.0, rotor_inertia=0.0, form=stopping.NOTES,
    )  # fmt: skip
    return _exactly({"brake_torque_required": torque})


def identify(spec: Conveyor, scene: Coast, carried: frozenset[str], level: int) -> Result:
    """Friction factor f from a measured coasting distance.

        m v^2/2 = s (f N + H),   f = (m v^2/(2 s) - H)/N

    N s f is the work of the idlers with the coefficient C of the file, H the slope resistance. This f acts while the
    belt coasts: written as `resistance.coefficient`, it needs `stop_factor: 1`.

    **Range** coasting from rated speed without brakes, gears engaged; secondary forces subtracted from H; not for the
    CEMA method.
    **Error** twice the relative error of the speed plus that of the distance.
    **Source** lecture notes Kramatorsk 2007: energy balance of coasting.
    """
    way = scene.measured_distance
    if way is None or spec.resistance.cema is not None:
        return Result({}, work=1)
    line = belt_line(spec, scene)
    friction, lift = _friction_per_coefficient(spec, scene, line)
    found, _ = stopping.coast_down_coefficient(moving_mass(line), lift, friction, 1.0, line.speed, way, 0.0, 0.0)
    told = _exactly({"resistance_coefficient_identified": float(found)})
    return replace(told, findings=too_long_a_way(spec.all_scenes, scene, way, float(found)))


def _friction_per_coefficient(spec: Conveyor, scene: Coast, line: BeltLine) -> tuple[float, float]:
    """Idler friction for a coefficient of 1, and what gravity and secondary forces take [N]."""
    used = filled(spec.resistance.coefficient) * stop_factor(spec)
    along = special_resistance(spec, scene)
    friction = line.back.friction[-1] + line.carry.friction[-1] - along
    return friction / used, line.back.climb[-1] + line.carry.climb[-1] + line.tail_force + along


def rigid_stop(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> Result:
    """Stopping time and stopping distance of the rigid conveyor, brakes with delay and rise.

        M v' = -(W + B(t))            v = V (1 - p(t))   of a controlled stop

    **Range** any stop; infinite if nothing stops the motion.
    **Error** none of its own; the belt at the head of a long conveyor stops earlier or later than its mean.
    **Source** Newton's law.
    """
    case = moving(spec, scene)
    ways = dict.fromkeys(ways_of(scene), case.rigid_way)
    return _exactly({"stop_time": case.rigid_time} | ways)


def _formula(
    name: str,
    title: str,
    run: Callable[..., Result],
    scenes: set[type[Scene]],
    gives: Iterable[str],
    source: str,
    *,
    decides: bool = True,
) -> AnySolver:
    """A closed form of the rigid conveyor, which represents no effect."""
    return Solver(
        name=name,
        title=title,
        fidelity=Fidelity.FORMULA,
        scenes=frozenset(scenes),
        represents=frozenset(),
        gives=frozenset(gives),
        run=run,
        cost=lambda spec, scene, carried, level: 2e-4,
        source=source,
        decides=decides,
    )


_NOTES = "lecture notes Kramatorsk 2007"
BRAKING = _formula(
    "brake_statics",
    "required brake torque for the stopping distance",
    brake,
    {Stop, EmergencyStop},
    {"brake_torque_required", "tension_overload_braking"},
    f"{_NOTES}, signed form",
)
BRAKING_NOTES = _formula(
    "brake_notes",
    "textbook brake torque for the stopping distance",
    brake_notes,
    {Stop, EmergencyStop},
    {"brake_torque_required"},
    _NOTES,
    decides=False,
)
IDENTIFY = _formula(
    "run_out",
    "friction coefficient from the measured coasting distance",
    identify,
    {Coast},
    {"resistance_coefficient_identified"},
    _NOTES,
)
RIGID_STOP = _formula(
    "rigid_stop",
    "textbook stop, rigid conveyor",
    rigid_stop,
    {Stop, EmergencyStop, ControlledStop, Coast},
    OF_STOP,
    "Newton's law",
    decides=False,
)
