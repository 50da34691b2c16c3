"""Steady running: tensions strand by strand, power, and what tension the belt asks for."""

import math
from collections.abc import Iterable

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.result import Found, History, Result, family, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import belt_resistance, sag, strand_tension
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine import tension_loads
from ptmcalc.machines.conveyor.machine.drives import running
from ptmcalc.machines.conveyor.machine.load_sharing import sharing_is_known, steady_forces
from ptmcalc.machines.conveyor.machine.loading import pieces
from ptmcalc.machines.conveyor.machine.loads import GRIP, OF_BELT, PER_DRIVE, SLIPS
from ptmcalc.machines.conveyor.machine.model import BeltLine, FloatArray
from ptmcalc.machines.conveyor.machine.resistances import filled
from ptmcalc.machines.conveyor.machine.scenes import Run
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.running.fillings import pulls_of
from ptmcalc.machines.conveyor.running.loads import OF_STATICS, OF_TENSION, static_loads
from ptmcalc.numerics.lanes import exp, expm1, number, value

_OF_RUNNING = frozenset(
    {
        "static_resistance",
        "effective_tension",
        "effective_tension_worst",
        "power_drive_running",
        "power_drive_empty",
        "power_motor_running",
        "sag_tension_required",
        "slack_side_tension_required",
        "takeup_travel",
        "takeup_mass",
        "belt_cycle_time",
    }
)


def run(spec: Conveyor, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Tensions of a steadily running belt, from the leaving side of the head pulley around the loop.

        S(s) = S_off + integral of (resistance + gradient) ds;   S_on = S_off + W

    S_off is the take-up tension (gravity take-up at the head), the one for which the mean of both sides of the tail
    pulley is the take-up tension (gravity take-up at the tail), or the value for which the mean tension of the loop is
    the mounting tension (fixed take-up: the total elongation of the belt is constant). Several drives share W by the
    curves of their motors (`load_sharing.steady_forces`); without curves, in proportion to their mean starting torques.

    **Range** the take-up after the head pulleys or at the tail; friction independent of speed.
    **Error** exact for that model: a sum of the given resistances.
    **Source** ISO 5048:1989; DIN 22101; mean tension of a fixed loop derived from constant elongation.
    """
    line = running(spec, scene)
    places, tensions = _round_the_loop(line)
    high, low = int(np.argmax(tensions)), int(np.argmin(tensions))
    loads = {
        "static_resistance": line.static_resistance,
        "tension_run_on_max": line.run_on,
        "tension_run_off_min": line.run_off,
        "tension_max": number(tensions[high]),
        "tension_min": number(tensions[low]),
    }
    back = len(line.back.marks)
    lows = number(tensions[:back].min()), number(tensions[back:].min())
    loads |= tension_loads.derived_loads(line, number(tensions[high]), lows, _lengths(line, tensions))
    loads |= _of_drives(spec, line)
    loads |= _between_drives(spec, line, loads)
    loads |= _of_running(spec, scene, line, places, tensions)
    loads |= static_loads(spec, scene, line, number(tensions[high]))
    at = {"tension_max": {"position": number(places[high])}, "tension_min": {"position": number(places[low])}}
    found = {name: Found(Estimate.exact(value), at.get(name, {})) for name, value in loads.items()}

    def histories() -> dict[str, History]:
        course = History(units.FORCE, places.tolist(), tensions.tolist(), units.SPAN)
        return {"tension_max": course, "tension_min": course}

    beyond = _unshared(spec, found)
    state = "the `curve` of each motor determines the load sharing of unequal drives" if beyond else ""
    return Result(found, work=1, histories=histories, beyond=beyond, open_end=state)


def _lengths(line: BeltLine, tensions: FloatArray) -> tension_loads.Spans | None:
    """Lengths with loads of their own, and their lowest tensions."""
    back = len(line.back.marks)
    if not line.by_length or not (line.back.span_weights and line.carry.span_weights):
        return None
    ends = (tensions[:back], line.back), (tensions[back:], line.carry)
    lows = [(strand.span_weights[k], min(one[k], one[k + 1])) for one, strand in ends for k in range(len(one) - 1)]
    return [(span, number(low)) for span, low in lows]


def _unshared(spec: Conveyor, found: Iterable[str]) -> dict[str, Interval]:
    """Loads that depend on how different drives share the pull, without a bound where the file does not say it."""
    if sharing_is_known(spec):
        return {}
    drives = spec.all_drives.values()
    several = {one.at for one in drives} == {"head", "tail"}
    names = [name for name in found if family(name) in PER_DRIVE and ("[" in name or family(name) in GRIP)] + [
        name for name in found if several and family(name) in (OF_BELT | OF_TENSION) - set(GRIP)
    ]
    return {name: Interval(-math.inf, math.inf) for name in names}


def _round_the_loop(line: BeltLine) -> tuple[FloatArray, FloatArray]:
    """Places from the head's run-off on [m] and the tensions there [N]; the tail is there twice."""
    back, carry = line.static_ends(RETURN)[0] + line.back.rises, line.static_ends(CARRY)[0] + line.carry.rises
    places = np.concatenate([line.back.marks, np.add(line.back.length, line.carry.marks)])
    return places, np.concatenate([back, carry])


def _of_drives(spec: Conveyor, line: BeltLine) -> dict[str, float]:
    """Tensions and grip of every drive, and the worst of them."""
    forces = steady_forces(spec, line)
    loads: dict[str, float] = {}
    worst: list[dict[str, float]] = []
    for at, behind in (("head", line.run_off), ("tail", line.static_ends(CARRY)[0])):
        drives = [(name, drive) for name, drive in spec.all_drives.items() if drive.at == at]
        for name, drive in reversed(drives):
            above = behind + forces[name]
            loads[of("tension_run_on_max", name)], loads[of("tension_run_off_min", name)] = above, behind
            if drive.drum.friction is not None:
                sides = [tension_loads.Sides(above, behind, line.centrifugal_at_speed)]
                worst.append(tension_loads.slip_loads(drive.drum.friction * drive.drum.wrap, sides))
                loads |= {of(load, name): value for load, value in worst[-1].items()}
            behind = above
    if len(worst) == len(spec.all_drives):
        loads["slip_utilisation_max"] = max(one["slip_utilisation_max"] for one in worst)
        loads["slip_reserve_min"] = min(one["slip_reserve_min"] for one in worst)
    return loads


def _between_drives(spec: Conveyor, line: BeltLine, loads: dict[str, float]) -> dict[str, float]:
    """Extreme tensions between the pulleys of one place, where a drive brakes against another one."""
    forces = steady_forces(spec, line)
    if len(forces) == 1 or all(force >= 0 for force in forces.values()):
        return {}
    sides = [loads[of(side, name)] for side in ("tension_run_on_max", "tension_run_off_min") for name in forces]
    high, low = max(loads["tension_max"], *sides), min(loads["tension_min"], *sides)
    found = {"tension_max": high, "tension_min": low, "slack_margin_min": min(loads["slack_margin_min"], low)}
    return found | ({"belt_safety_min": line.breaking_force / high} if line.breaking_force and high > 0 else {})


def _of_running(
    spec: Conveyor, scene: Run, line: BeltLine, places: FloatArray, tensions: FloatArray
) -> dict[str, float]:
    """Power, worst part loaded, tensions asked for, take-up.

    The way the take-up needs goes from the new belt, closed at standstill with the take-up's tension S_0 all round, to
    the old belt in steady running: s = L_loop ((S_mean - S_0)/EA + eps_p)/2, positive as the belt grows longer.

    * Gravity: the weight keeps S_0 at the run-off, so S_mean is above it, and the weight sinks by the elastic part at
      every start. What waves add for a moment is `takeup_movement`.
    * Rigid: the screw was set to the mean S_0, which running does not change: nothing moves, and the way is what the
      screw must be turned over the life of the belt to bring S_0 back.

    Pulling a slack belt up to S_0 at mounting takes S_0 L_loop/(2 EA) more, which is not in it.
    """
    pull = line.static_resistance + line.tail_pull
    empty = running(spec, scene.model_copy(update={"load": "empty"}))
    nothing = empty.static_resistance + empty.tail_pull
    fixed = line.fixed_length  # its mean is the mounting tension, without rounding
    mean = line.takeup_tension if fixed else belt_resistance.mean_tension(np.diff(places), tensions)
    mounting = spec.takeup.tension
    loads = {
        "effective_tension": pull,
        "effective_tension_worst": nothing + _worst_load(spec, scene, empty),
        "power_drive_running": value(belt_resistance.shaft_power, pull, line.speed),
        "power_drive_empty": value(belt_resistance.shaft_power, nothing, line.speed),
        "power_motor_running": _motor_power(spec, line),
        "power_motor_empty": _motor_power(spec, empty),
        "belt_cycle_time": belt_resistance.cycle_time(line.back.length + line.carry.length, line.speed),
        "takeup_travel": value(
            belt_resistance.takeup_travel,
            line.back.length + line.carry.length,
            mean,
            mounting,
            line.stiffness,
            spec.takeup.permanent_elongation or 0.0,
            2,
        ),
    }
    if spec.takeup.type == "gravity":
        loads["takeup_mass"] = value(belt_resistance.takeup_mass, mounting, 2, spec.gravity)
    spans = [span for span in (line.back.span_weight, line.carry.span_weight) if span is not None]
    if len(spans) == 2:
        loads["sag_tension_required"] = max(number(sag.tension_at_sag(span, spec.checks.sag)) for span in spans)
    at_head = [drive.drum for drive in spec.all_drives.values() if drive.at == "head"]
    grips = [drum.friction * drum.wrap for drum in at_head if drum.friction is not None]
    if len(grips) == len(at_head):
        needed, grip = max(line.static_resistance, 0.0) * spec.checks.slip.reserve, sum(grips)
        loads["slack_side_tension_required"] = needed * exp(-grip) / -expm1(-grip)  # any grip, however large
    return loads


def _motor_power(spec: Conveyor, line: BeltLine) -> float:
    """Power of all motors [W], each through its own gear."""
    forces = steady_forces(spec, line)
    return sum(
        value(belt_resistance.motor_power, forces[name] * line.speed, filled(drive.gear.efficiency))
        for name, drive in spec.all_drives.items()
    )


def _worst_load(spec: Conveyor, scene: Run, empty: BeltLine) -> float:
    """Pull of the load when only those lengths are full where it pulls back [N]."""
    pulls = np.array(pulls_of(spec, scene, pieces(spec))[-1])
    full = running(spec, scene.model_copy(update={"load": "full"}))
    pulls[0] += full.tail_force - empty.tail_force
    return number(pulls @ strand_tension.worst_loading(pulls, strand_tension.MOST))


STATICS: Solver[Conveyor, Run] = Solver(
    name="statics",
    title="steady-running belt tensions",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=(OF_BELT - {"tension_dynamic_run_on_max"}).union(_OF_RUNNING, OF_STATICS, PER_DRIVE - SLIPS),
    run=run,
    cost=lambda spec, scene, carried, level: 5e-4,
    source="ISO 5048:1989; DIN 22101",
    by_lanes=True,
)
