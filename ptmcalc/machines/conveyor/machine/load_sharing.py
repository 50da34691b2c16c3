"""How the drives of a belt share its resistance in steady running: on the slip lines of their motors, with the creep of
the belt over the pulleys."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from ptmcalc.base.memory import kept_for
from ptmcalc.components.steady_drive import FloatArray, Motors, shared_forces, steady_speed
from ptmcalc.machines.conveyor.machine.keys.converter import leaders
from ptmcalc.machines.conveyor.machine.keys.drives import PlacedDrive
from ptmcalc.machines.conveyor.machine.model import BeltLine, drive_force, turns
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.spec import Conveyor

_FOLLOWED = 12
"""Rounds in which drives that follow the torque of a drive after them find its speed [1]; a numerical choice. Each
leaves S/EA over the rated slip of the error of the round before, below a tenth; more take longer."""
BySpeed = Callable[[FloatArray], Sequence[tuple[FloatArray, FloatArray]]]

_SAME_SPEED = 1e-3
"""Relative difference of the pulley speeds of several drives up to which motors without a curve count as equal [1]. An
engineering choice: a tenth of a rated slip of 1 %. A larger value accepts drives that share unequally."""
_SETTLED = 3
"""Rounds in which the tension of a fixed loop follows the pull at its tail [1]; a numerical choice. Each leaves S/EA of
the error of the round before; more take longer."""


@kept_for(64)
def motors_of(spec: Conveyor) -> dict[str, Motors]:
    """The motors of each drive; empty where one of them has no curve."""
    drives = spec.all_drives
    found = {
        name: Motors(
            curve=curve,
            count=drive.motor.count,
            turns=turns(drive),
            efficiency=filled(drive.gear.efficiency),
        )
        for name, drive in drives.items()
        if (curve := drive.running_curve) is not None
    }
    return found if len(found) == len(drives) else {}


@kept_for(64)
def starting_shares(spec: Conveyor) -> Mapping[str, float]:
    """Part of the whole mean starting force that each drive has."""
    forces = {name: drive_force(drive) for name, drive in spec.all_drives.items()}
    whole = sum(forces.values())
    return {name: force / whole for name, force in forces.items()}


def sharing_is_known(spec: Conveyor) -> bool:
    """Whether the file says how the drives share the resistance: by the curves of all motors, or by equal drives.

    Drives without curves count as equal where their pulleys have one speed at one speed of the motors.
    """
    drives = list(spec.all_drives.values())
    if len(drives) == 1 or motors_of(spec):
        return True
    if any(drive.running_curve is not None for drive in drives):
        return False
    speeds = [_pulley_speed(drive, all(one.motor.speed is not None for one in drives)) for drive in drives]
    return max(speeds) <= (1 + _SAME_SPEED) * min(speeds)


def _pulley_speed(drive: PlacedDrive, rated: bool) -> float:
    """Speed of a pulley at the rated speed of its motor, or at one turn of it."""
    speed = drive.motor.speed if rated else None
    return (1.0 if speed is None else speed) * drive.drum.diameter / drive.gear.ratio


def steady_forces(spec: Conveyor, line: BeltLine) -> Mapping[str, float]:
    """Force of each drive at its pulley in steady running [N].

        sum F_i = W,   F_i = n M_i(w_i) i eta/R (driving),   w_i = v_i i/R,   v_i = v_0 (1 + S_i/EA)

    A belt under tension is faster than without, since the same mass passes every section. A pulley has the speed of
    the belt that enters it, with the tension S_i: the belt creeps on the leaving side. So the second of two equal
    drives turns slower by F_1/EA and pulls more. A drive on a converter that follows the torque of another drive has
    that torque, M_i/M_ni = r (1 + d) M_1/M_n1, whatever its own speed.

    Where a motor has no curve, the drives share W as their mean starting torques.

    Args:
        spec: the conveyor.
        line: the belt in the load state of a scene.

    Returns:
        The forces by the name of the drive; negative where the motors brake.

    **Range** motors with a curve on the branch on which the torque falls with the speed.
    **Error** of first order in S/EA; pulleys of the given diameters.
    **Source** derived: continuity of the belt mass, rho_0 v/(1 + S/EA) constant, and equilibrium on the torque curves.
    """
    whole = line.static_resistance + line.tail_pull
    if len(spec.all_drives) == 1:
        return dict.fromkeys(spec.all_drives, whole)
    if motors_of(spec):
        return _on_curves(spec, line)
    return {name: part * whole for name, part in starting_shares(spec).items()}


@kept_for(64)
def _on_curves(spec: Conveyor, line: BeltLine) -> Mapping[str, float]:
    motors, at = motors_of(spec), {name: drive.at for name, drive in spec.all_drives.items()}
    resistance = line.static_resistance + line.tail_pull
    found: dict[str, float] = {}
    for _ in range(_SETTLED):
        loop = replace(line, tail_pull=sum(force for name, force in found.items() if at[name] == "tail"))
        at_drives = _by_speed(spec, loop)
        drives = [motors[name] for name in _in_order(spec)]

        def forces(speeds: FloatArray, known: BySpeed = at_drives) -> list[FloatArray]:
            return [force for _, force in known(speeds)]

        found = dict(zip(_in_order(spec), shared_forces(drives, resistance, line.speed, forces), strict=True))
        if not line.fixed_length:
            break
    return found


def _in_order(spec: Conveyor) -> list[str]:
    """The drives in the order in which the belt meets them, the tail first."""
    return sorted(spec.all_drives, key=lambda name: spec.all_drives[name].at == "head")


def _by_speed(spec: Conveyor, line: BeltLine) -> BySpeed:
    """Speed of the belt that enters each drive [m/s] and force of the drive [N] over the speed of the unloaded belt."""
    motors, resistance = motors_of(spec), line.static_resistance + line.tail_pull
    tail, head = line.run_off + line.back.rise + line.tail_force, line.run_off + resistance

    followed, drives = leaders(spec.all_drives), spec.all_drives

    def found(speeds: FloatArray) -> list[tuple[FloatArray, FloatArray]]:
        pulled: dict[str, tuple[FloatArray, FloatArray]] = {}
        for _ in range(_FOLLOWED if followed else 1):
            tensions, before = {"tail": np.full_like(speeds, tail), "head": np.full_like(speeds, head)}, pulled
            pulled = {}
            for name in _in_order(spec):
                at, leader = drives[name].at, followed.get(name, name)
                entering = speeds * (1 + tensions[at] / line.stiffness)
                known = pulled.get(leader) or before.get(leader)
                force = motors[name].force(entering if known is None or leader == name else known[0])
                for place in ("tail", "head") if at == "tail" else ("head",):
                    tensions[place] = tensions[place] - force
                pulled[name] = entering, force
        return list(pulled.values())

    return found


def steady_motor_speeds(spec: Conveyor, line: BeltLine) -> Mapping[str, float]:
    """Speed of the motors of each drive in steady running at rated frequency [rad/s].

    Equation, range, error and source as of `steady_forces`; every motor has a curve.
    """
    motors, resistance = motors_of(spec), line.static_resistance + line.tail_pull
    at_drives = _by_speed(spec, line)
    drives = [motors[name] for name in _in_order(spec)]
    speed = steady_speed(drives, resistance, line.speed, lambda speeds: [force for _, force in at_drives(speeds)])
    entering = [float(one) for one, _ in at_drives(np.array(speed))]
    return {name: one * motors[name].turns for name, one in zip(_in_order(spec), entering, strict=True)}


def creep_of(spec: Conveyor, line: BeltLine) -> Mapping[str, float]:
    """Part by which each pulley is slower in steady running than the belt that comes to the drives of its place [1].

    sum of F_j/EA over the drives before it
    """
    found, before = {}, {"head": 0.0, "tail": 0.0}
    for name, force in steady_forces(spec, line).items():
        place = spec.all_drives[name].at
        found[name] = before[place] / line.stiffness
        before[place] += force
    return found


def pull_together(spec: Conveyor, line: BeltLine, place: str) -> bool:
    """Whether the drives at a place, `head` or `tail`, all drive or all brake in steady running."""
    forces = [force for name, force in steady_forces(spec, line).items() if spec.all_drives[name].at == place]
    return min(forces, default=0.0) >= 0 or max(forces) <= 0


def shares_at(spec: Conveyor, line: BeltLine, place: str) -> list[float]:
    """Part of the force of all drives at a place, `head` or `tail`, that each of them has in steady running [1]; by
    their mean starting torques where they neither drive nor brake together."""
    names = [name for name, drive in spec.all_drives.items() if drive.at == place]
    for forces in (steady_forces(spec, line), starting_shares(spec)):
        whole = sum(forces[name] for name in names)
        if whole and all(forces[name] / whole >= 0 for name in names):
            return [forces[name] / whole for name in names]
    return []
