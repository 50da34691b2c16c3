"""A rack stacker on an uneven rail: the factor of the standards, the whole answer, and wheels that jump."""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Finding, Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import rail
from ptmcalc.machines.crane.stacking.machine.loads import OF_THE_RAIL, names
from ptmcalc.machines.crane.stacking.machine.marching import Course, compared
from ptmcalc.machines.crane.stacking.machine.rack import RackStacker
from ptmcalc.machines.crane.stacking.machine.scenes import RailScene
from ptmcalc.machines.crane.stacking.rail.base import Roll, Swinger, roll_of, wheel_load
from ptmcalc.machines.crane.stacking.rail.effects import JUMPING, UNEVEN
from ptmcalc.machines.crane.stacking.rail.rolling import (
    DOWN,
    column_stages,
    detuning,
    machine_stages,
    pulses,
    swing_loads,
    wave_share,
    wave_swing,
)
from ptmcalc.machines.crane.stacking.strength.derived import with_derived
from ptmcalc.numerics.train.parts import LINEAR, NO_PULL

_SCENES = frozenset({RailScene})
STILL = Estimate.exact(0.0)
MOST_RADIANS = 2e4
"""Of a vibration on a step or gap that is played."""
_GIVES = names(OF_THE_RAIL) | {
    "mast_deflection_max",
    "mast_force_max",
    "mast_moment_max",
    "column_stress",
    "combination_force",
}


def standard(spec: RackStacker, scene: RailScene, carried: frozenset[str], level: int) -> Result:
    """Factor of the standards from the residual oscillation after the step or gap.

        phi_4 = 1 + (pi/2)^2 v^2/(g r) xi(alpha)

    **Range** one vertical mode.
    **Error** no bound: the acceleration may be larger while a wheel still climbs; waves are not included.
    **Source** EN 13001-2, ISO 8686-1.
    """
    roll = roll_of(spec, scene)
    answers = [0.0]
    if roll.step:
        number = rail.step_number(roll.frequency, roll.speed, roll.radius, roll.step)
        answers.append(float(rail.residual_step(number)))
    if roll.gap:
        answers.append(float(rail.residual_gap(rail.gap_number(roll.frequency, roll.speed, roll.gap))))
    factor = rail.rail_factor(roll.speed, roll.radius, roll.gravity, max(answers))
    return Result({"phi4": Found(Estimate.unknown(factor))}, work=1)


def response(spec: RackStacker, scene: RailScene, carried: frozenset[str], level: int) -> Result:
    """Wheel loads from the complete response of the machine, and the mast oscillation on its tilting base.

        phi_4 = 1 + a_w/g max u on step, gap and after them, or 1 + T a_w/g on waves;   x = q f(l),
        q'' + w^2 q = -s (h_1'' - h_2'')/B, h_1 and h_2 the lifts of both wheels, one after the other

    **Range** one vertical mode without damping at steps and gaps; one mast mode without damping and without a top guide
    along the aisle; wheels that stay on the rail.
    **Error** exact for those modes.
    **Source** `laws.rail`; mast oscillation exact between events, `numerics.train`.
    """
    roll = roll_of(spec, scene)
    more, less = _waves(roll)
    for up, down in roll.pulses(roll.frequency):
        more, less = (
            max(more, roll.acceleration / roll.gravity * up),
            max(less, roll.acceleration / roll.gravity * down),
        )
    loads = {"phi4": Found(Estimate.exact(1 + more)), "rail_contact": Found(Estimate.exact(1 - less))}
    return _result(spec, scene, roll, loads, [])


def jump(spec: RackStacker, scene: RailScene, carried: frozenset[str], level: int) -> Result:
    """The same with wheels that leave the rail and land again, exact between events.

        F = max(0, Q - k u - b u'),   u'' = F/M - g - h''

    The minimum wheel load is that of wheels held to the rail: a value below 0 is the required holding force.

    **Range** a massless wheel that follows the spring; three periods after step or gap.
    **Error** exact between events; error bars from runs with other time steps, accepted only if the energy balance
    closes.
    **Source** `numerics.train`.
    """
    roll = roll_of(spec, scene)
    waves, _ = _waves(roll)
    free, held = (
        [compared(scene.label, machine_stages(roll, pulse, law, scene.window_factor)) for pulse in pulses(roll)]
        for law in (NO_PULL, LINEAR)
    )
    runs = [*free, *held]
    tops = [one.found["phi4"] for one in free] + [Found(Estimate.exact(1 + waves))]
    lows = [one.found["rail_contact"] for one in held] + [Found(Estimate.exact(1 - waves))]
    loads = {
        "phi4": max(tops, key=lambda one: one.estimate.value),
        "rail_contact": min(lows, key=lambda one: one.estimate.value),
    }
    if waves > 1:  # a wheel that jumps on waves has no steady state that is known here
        loads["phi4"] = Found(Estimate.unknown(1 + waves))
    return _result(spec, scene, roll, loads, runs)


def _waves(roll: Roll) -> tuple[float, float]:
    share = wave_share(roll)
    return share, share


def _result(spec: RackStacker, scene: RailScene, roll: Roll, loads: Mapping[str, Found], runs: list[Course]) -> Result:
    """All loads of a rail, the column's swing among them."""
    found = dict(loads)
    top, load = found["phi4"], wheel_load(spec, scene)
    one = top.estimate
    force = Estimate(one.value * load, one.low * load, one.high * load, one.numerical * load, one.model * load)
    found["wheel_force"] = Found(force, top.at)
    apart = detuning(roll)
    if math.isfinite(apart):
        found["rail_detuning"] = Found(Estimate.exact(apart))
    if roll.column is not None:
        column = roll.column
        swings, swung = _swings(scene, roll, column)
        steady = swing_loads(wave_swing(roll, column), column)
        for name, value in steady.items():
            found[name] = max([swung[name], Found(Estimate.exact(value))], key=lambda one: one.estimate.value)
        runs = [*runs, *swings]
    findings: tuple[Finding, ...] = tuple(finding for one in runs for finding in one.findings)
    residual = max((one.residual for one in runs), default=0.0)
    work = sum(one.work for one in runs) + 1
    health = {"energy_residual": residual} if runs else {}
    return Result(with_derived(spec, scene, found), work=work, health=health, findings=findings)


def _swings(scene: RailScene, roll: Roll, column: Swinger) -> tuple[list[Course], dict[str, Found]]:
    """The column's runs over step and gap, and the largest of its loads.

    Where it swings thousands of times on one of them it hardly notices: then twice the answer to one wheel bounds it.
    """
    passed = [pulse for pulse in pulses(roll) if pulse.name != DOWN]
    if any(pulse.lasts * column.frequency > MOST_RADIANS for pulse in passed):
        answer = max(max(pair) for pair in roll.pulses(column.frequency))
        most = swing_loads(2 * column.driven * roll.acceleration / roll.base / column.frequency**2 * answer, column)
        return [], {name: Found(Estimate(high / 2, 0.0, high, model=high / 2)) for name, high in most.items()}
    runs = [compared(scene.label, column_stages(roll, column, pulse)) for pulse in passed]
    largest = {
        name: max([one.found[name] for one in runs], key=lambda one: one.estimate.value, default=Found(STILL))
        for name in swing_loads(0.0, column)
    }
    return runs, largest


def not_too_long(spec: RackStacker, scene: RailScene) -> Criterion:
    """Swings of the machine while a wheel passes a step or gap, in radians.

    **Range** every rail.
    **Error** a limit of the work.
    **Source** a machine that swings thousands of times on a step does not notice it.
    """
    roll = roll_of(spec, scene)
    value = max((pulse.lasts * roll.frequency for pulse in pulses(roll)), default=0.0)
    return Criterion("w t", value, MOST_RADIANS, "radians of the oscillation on a step or gap", "limit of the run")


def undamped(spec: RackStacker, scene: RailScene) -> Criterion | None:
    """The closed answer knows no damping.

    **Range** every rail.
    **Error** none: it is used without damping alone.
    **Source** `laws.rail.step_extremes`.
    """
    return Criterion("ζ", spec.rail.damping, 1e-300, "damping of the machine on its wheels", "the file")


RAIL_STANDARD: Solver[RackStacker, RailScene] = Solver(
    name="aisle_rail_standard",
    title="phi4 of the standards",
    fidelity=Fidelity.FORMULA,
    scenes=_SCENES,
    represents=frozenset(),
    gives=frozenset({"phi4"}),
    run=standard,
    cost=lambda spec, scene, carried, level: 5e-5,
    source="EN 13001-2, ISO 8686-1",
    decides=False,
)
RAIL_RESPONSE: Solver[RackStacker, RailScene] = Solver(
    name="aisle_rail_answer",
    title="rail unevenness response, wheels in contact",
    fidelity=Fidelity.FORMULA,
    scenes=_SCENES,
    represents=frozenset({UNEVEN}),
    gives=_GIVES,
    run=response,
    cost=lambda spec, scene, carried, level: 2e-2,
    source="one vertical mode over a cosine step; derived in ptmcalc.laws.rail",
    valid=undamped,
    always=frozenset({UNEVEN}),
)
RAIL_JUMP: Solver[RackStacker, RailScene] = Solver(
    name="aisle_rail_jump",
    title="rail unevenness response with wheel lift-off",
    fidelity=Fidelity.TRANSIENT,
    scenes=_SCENES,
    represents=frozenset({UNEVEN, JUMPING}),
    gives=_GIVES,
    run=jump,
    cost=lambda spec, scene, carried, level: 6e-2,
    source="exact propagation of piecewise-linear systems; derived in ptmcalc.numerics.piecewise",
    valid=not_too_long,
    always=frozenset({UNEVEN, JUMPING}),
)
