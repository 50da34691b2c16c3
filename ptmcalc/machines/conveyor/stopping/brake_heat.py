"""Heat of the brakes: in one stop, and of all stops of an hour."""

import math
from collections.abc import Callable, Iterable, Iterator

import numpy as np

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.check import AnyCheck, Check, Sense, blames, no_needs, no_repair
from ptmcalc.contract.result import Found, LoadInfo, Result, family, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.machines.conveyor.machine.brakes import brakes_of, braking, braking_at_shaft
from ptmcalc.machines.conveyor.machine.drives import moving_mass, running
from ptmcalc.machines.conveyor.machine.loads import BRAKE_HEAT, BRAKE_POWER
from ptmcalc.machines.conveyor.machine.rigid_stop import rigid_stop
from ptmcalc.machines.conveyor.machine.scenes import ControlledStop, ConveyorScene, EmergencyStop, Stop
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.spec.scene import Scene

_STEPS = 20_000
"""Steps of the rigid stop; a numerical choice. The trapezium rule then has an error of 1e-7; more steps take longer."""
BRAKED: frozenset[type[Scene]] = frozenset({Stop, EmergencyStop, ControlledStop})
"""Scenes in which brakes act."""

LOADS = (
    LoadInfo(BRAKE_HEAT, "heat of the brake per stop", units.ENERGY, headline=False),
    LoadInfo(BRAKE_POWER, "mean heat power of the brake", units.POWER, headline=False),
)


def brake_parts(spec: Conveyor) -> Iterator[LoadInfo]:
    """The loads of each brake."""
    for info in LOADS:
        yield from (info.of(name) for name in spec.brakes)


def with_power(spec: Conveyor, heats: dict[str, float]) -> dict[str, float]:
    """Heat of each brake [J], by its load, with the mean power of those whose stops per hour are given [W]."""
    found = dict(heats)
    for name, brake in spec.brakes.items():
        if brake.stops_per_hour is not None and of(BRAKE_HEAT, name) in heats:
            found[of(BRAKE_POWER, name)] = heats[of(BRAKE_HEAT, name)] * brake.stop_rate
    return found


def rigid_heat(spec: Conveyor, scene: ConveyorScene) -> dict[str, float]:
    """Heat and mean power of each brake that stops the rigid conveyor [J, W].

    Q_i = integral of B_i v dt
    """
    line, acting = running(spec, scene), brakes_of(spec, scene)
    time = rigid_stop(spec, scene, line)[0]
    if math.isinf(time):
        return with_power(spec, dict.fromkeys((of(BRAKE_HEAT, name) for name in acting), math.inf))
    times = np.linspace(0.0, time, _STEPS + 1)
    if isinstance(scene, ControlledStop):
        speeds = np.zeros_like(times)  # the brakes close at standstill
    else:
        forces = [braking(spec, one).over(times) for one in acting.values()]
        whole = line.static_resistance + line.tail_pull + sum(forces, np.zeros_like(times))
        lost = np.concatenate([[0.0], np.cumsum(whole[1:] + whole[:-1])]) * times[1] / 2
        speeds = np.maximum(line.speed - lost / moving_mass(line), 0.0)
    heats = {}
    for name, brake in acting.items():
        force = braking_at_shaft(spec, brake).over(times)
        heats[of(BRAKE_HEAT, name)] = float(np.trapezoid(force * speeds, times))
    return with_power(spec, heats)


def run(spec: Conveyor, scene: ConveyorScene, carried: frozenset[str], level: int) -> Result:
    """Heat of each brake in a stop of the rigid conveyor.

        Q_i = integral of M_i w_i dt          P_i = Q_i n/3600

    M_i, w_i: torque and speed of the shaft on which the brake sits; n: stops per hour.

    **Range** any stop; infinite if nothing stops the motion.
    **Error** 1e-7 for the rigid conveyor; a pulley that slips stops earlier and takes less heat.
    **Source** work of friction.
    """
    found = rigid_heat(spec, scene)
    return Result({name: Found(Estimate.exact(value)) for name, value in found.items()}, work=1)


def moved_heat(spec: Conveyor, name: str, stretch: float) -> Interval:
    """Heat of a brake, or its mean power, whose pulley is off by a way at any time.

    |integral of B (v - v_0) dt| <= 2 B max |x - x_0|   for a force that does not fall
    """
    brake = spec.brakes[name.partition("[")[2][:-1]]
    heat = 2 * braking_at_shaft(spec, brake).force * stretch
    most = heat if family(name) == BRAKE_HEAT else heat * brake.stop_rate
    return Interval(-most, most)


RIGID_HEAT: Solver[Conveyor, ConveyorScene] = Solver(
    name="rigid_brake_heat",
    title="textbook heat of the brakes, rigid conveyor",
    fidelity=Fidelity.FORMULA,
    scenes=BRAKED,
    represents=frozenset(),
    gives=frozenset({BRAKE_HEAT, BRAKE_POWER}),
    run=run,
    cost=lambda spec, scene, carried, level: 2e-2,
    source="work of friction",
    decides=False,
)


def _heat_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Permissible heat of a brake in one stop, given in the file.

    **Range** a brake at the temperature for which the manufacturer states the value.
    **Error** that of the given value.
    **Source** the data sheet of the brake.
    """
    heats = [one.stop_heat for one in brakes_of(spec, scene).values() if one.stop_heat is not None]
    return Estimate.exact(min(heats, default=math.inf))


def _power_limit(spec: Conveyor, scene: ConveyorScene) -> Estimate:
    """Heat power that a brake dissipates on average, given in the file.

    **Range** stops at equal intervals.
    **Error** that of the given value.
    **Source** the data sheet of the brake.
    """
    powers = [one.heat_power for one in brakes_of(spec, scene).values() if one.heat_power is not None]
    return Estimate.exact(min(powers, default=math.inf))


def _heat_checks(spec: Conveyor, scene: ConveyorScene) -> Iterable[AnyCheck]:
    for name, brake in brakes_of(spec, scene).items():
        if brake.stop_heat is not None:
            yield HEAT.of(name, _exactly(brake.stop_heat), ("brakes", name, "stop_heat"))


def _power_checks(spec: Conveyor, scene: ConveyorScene) -> Iterable[AnyCheck]:
    for name, brake in brakes_of(spec, scene).items():
        if brake.heat_power is not None or brake.stops_per_hour is not None:
            limit = math.inf if brake.heat_power is None else brake.heat_power
            key = ("brakes", name)
            missing = tuple((*key, one) for one in ("heat_power", "stops_per_hour") if getattr(brake, one) is None)
            repair = () if missing else (*key, "stops_per_hour")
            yield POWER.of(name, _exactly(limit), (*key, "stops_per_hour"), missing, repair)


def _exactly(limit: float) -> Callable[[Conveyor, ConveyorScene], Estimate]:
    return lambda spec, scene: Estimate.exact(limit)


HEAT: Check[Conveyor, ConveyorScene] = Check(
    code="CNV127",
    title="brake heat per stop",
    question="Is the heat of a stop within the data-sheet value of the brake?",
    failure="heat of the stop exceeds the data-sheet value of the brake",
    scenes=BRAKED,
    loads=(BRAKE_HEAT,),
    sense=Sense.AT_MOST,
    limit=_heat_limit,
    needs=no_needs,
    blame=blames("brakes"),
    repair=no_repair,
    each=_heat_checks,
    what="The heat of each brake in a stop is at most the manufacturer's value.",
    why="A brake that takes too much heat in one stop loses its friction before the belt is at rest.",
    formula="integral of M w dt <= allowed",
    source="work of friction; the data sheet of the brake",
)

POWER: Check[Conveyor, ConveyorScene] = Check(
    code="CNV128",
    title="mean heat power of the brake",
    question="Does the brake dissipate the heat of all stops of an hour?",
    failure="stops of an hour heat the brake more than it dissipates",
    scenes=BRAKED,
    loads=(BRAKE_POWER,),
    sense=Sense.AT_MOST,
    limit=_power_limit,
    needs=no_needs,
    blame=blames("brakes"),
    repair=no_repair,
    each=_power_checks,
    what="The heat of a stop times the stops per hour is at most the mean heat power of the brake.",
    why="Heat that is not dissipated before the next stop adds up until the lining fails.",
    formula="Q n/3600 <= P",
    source="heat balance over an hour; the data sheet of the brake",
)
