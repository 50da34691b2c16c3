"""Even travel: resistance, power, wheel loads, heat, class, and the factors of the standards."""

import math

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result, of
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import classification, wheel_loads
from ptmcalc.machines.crane.travelling.machine import model, stability, wheels
from ptmcalc.machines.crane.travelling.machine.keys.duty import Duty
from ptmcalc.machines.crane.travelling.machine.loads import EVEN, OF_THE_WHEELS, names
from ptmcalc.machines.crane.travelling.machine.model import CORNERS
from ptmcalc.machines.crane.travelling.machine.scenes import HoistWhileTravelling, Run, Start, TravelScene
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.statics import drive, factors, resisting

Numbers = dict[str, float]


def run(spec: Travelling, scene: TravelScene, carried: frozenset[str], level: int) -> Result:
    """Loads of a crane in steady travel with its load at rest relative to the crane.

        W = (w cos(alpha) + sin(alpha)) G + F_wind,   M = W r/(u eta),   N by levers over span and wheel base

    **Range** equal rail compliance under every corner; a load without sway.
    **Error** exact for that model; the report lists the assumptions.
    **Source** equilibrium (`laws.travel`, `laws.wheel_loads`), power balance of the gear (`laws.gearing`),
    IEC 60034-1 and ISO 4301-1 (`laws.duty`, `laws.classification`), EN 13001-2 and ISO 8686-1 for the factors.
    """
    loads = _of_travel(spec, scene) | _of_the_duty(spec) | factors.of_the_structure(spec)
    found = {name: Found(Estimate.exact(value)) for name, value in loads.items()} | _braking(spec, scene)
    found |= _of_the_wheels(spec, scene)
    tips = stability.of_rest(spec, scene, model.largest_pressure(spec))
    return Result(found | {"stability_reserve": Found(Estimate.exact(tips))}, work=1)


def _of_travel(spec: Travelling, scene: TravelScene) -> Numbers:
    resistance = resisting.even(spec, scene, model.working_pressure(spec))
    torque = model.even_motor_torque(spec, resistance)
    return {
        "travel_resistance": resistance,
        "travel_coefficient": resisting.coefficient(spec),
        "motor_speed": model.motor_speed(spec),
        "torque_motor_travel": torque,
        "power_travel": torque * model.motor_speed(spec),
        "starting_reserve": drive.starting_reserve(spec, scene),
        "wind_reserve": drive.wind_reserve(spec, scene),
    }


def _braking(spec: Travelling, scene: TravelScene) -> dict[str, Found]:
    """What the curve of the motors has over wind and slope that drive them."""
    braking = drive.braking_reserve(spec, scene)
    return {} if braking is None else {"overhauling_reserve": Found(Estimate.exact(braking))}


def _of_the_wheels(spec: Travelling, scene: TravelScene) -> dict[str, Found]:
    rest, rolling = wheels.at_rest(spec, scene), wheels.Wheels.of(spec, scene)
    each, found = rolling.loads(rest)[:, :, 0], rolling.extreme
    least, most = float(found(rest, largest=False)[0]), float(found(rest, largest=True)[0])
    loads: Numbers = {"wheel_load_mean": float(wheel_loads.mean_wheel_load(max(least, 0.0), most))}
    for index, corner in enumerate(CORNERS):
        loads[of("corner_load_max", corner)] = float(each[:, index].max()) * spec.wheels.per_corner
        loads[of("corner_load_min", corner)] = float(each[:, index].min()) * spec.wheels.per_corner
    worst = each[:, int(each.max(axis=0).argmax())]
    ratio = min(max(float(worst.min() / worst.max()), 0.0), 1.0)
    loads["wheel_spectrum_factor"] = wheel_loads.even_travel_factor(ratio)
    known = factors.of_the_structure(spec)
    if "phi2" in known:
        dead = rolling.loads(rest._replace(weight=0.0))[:, :, 0]
        loads["wheel_load_factored"] = float(np.max(known["phi1"] * dead + known["phi2"] * (each - dead)))
    told = {name: Found(Estimate.exact(value)) for name, value in loads.items()}
    for name, value, largest in (("wheel_load_max", most, True), ("wheel_load_min", least, False)):
        told[name] = Found(Estimate.exact(value), note=rolling.where(rest, largest))
    return told


def _of_the_duty(spec: Travelling) -> Numbers:
    given = spec.duty
    if given is None:
        return {}
    loads = {"torque_motor_rms": drive.rms_torque(spec)} | _of_the_use(given, drive.spectrum(spec))
    allowed = drive.permissible_torque(spec)
    if allowed is not None:
        loads["heating_utilisation"] = loads["torque_motor_rms"] / allowed
    if given.starts_per_hour is not None:
        loads["starts_per_hour"] = given.starts_per_hour
    return loads


def _of_the_use(given: Duty, spectrum: list[tuple[float, float]]) -> Numbers:
    factor = classification.spectrum_factor([share for share, _ in spectrum], [load for _, load in spectrum])
    loads = {"spectrum_factor": factor}
    load = classification.load_class(factor)
    if given.cycles is not None:
        loads["crane_group"] = float(classification.group(classification.use_of_cycles(given.cycles), load))
    if given.hours is not None:
        loads["mechanism_group"] = float(classification.group(classification.use_of_hours(given.hours / 3600), load))
    return loads


TRAVEL_STATICS: Solver[Travelling, TravelScene] = Solver(
    name="travel_statics",
    title="steady travel: resistance, power, wheel loads, heating",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=names(EVEN, OF_THE_WHEELS) | {"phi1", "phi2", "phi3", "phi5", "phi6"},
    run=run,
    cost=lambda spec, scene, carried, level: 1e-3,
    source="equilibrium; power balance of the gear; IEC 60034-1; ISO 4301-1; EN 13001-2, ISO 8686-1",
)


def reserve(spec: Travelling, scene: TravelScene, carried: frozenset[str], level: int) -> Result:
    """Reserve of the motor torque over the resistance in a scene that starts with the motors.

        reserve = min M(n)/(W r/(u eta));   of braking: n M_b/(-W r eta_r/u) where W < 0

    **Range** as `travel_statics`.
    **Error** exact for that model.
    **Source** power balance of the gear.
    """
    braking = _braking(spec, scene)
    if isinstance(scene, HoistWhileTravelling):
        return Result(braking, work=1)
    value = drive.starting_reserve(spec, scene)
    note = "" if value > 1 or math.isinf(value) else "stall: the motors do not overcome friction, wind and slope"
    return Result({"starting_reserve": Found(Estimate.exact(value), note=note)} | braking, work=1)


STARTING: Solver[Travelling, TravelScene] = Solver(
    name="travel_starting_reserve",
    title="starting torque reserve over the travel resistance",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Start, HoistWhileTravelling}),
    represents=frozenset(),
    gives=frozenset({"starting_reserve", "overhauling_reserve"}),
    run=reserve,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="power balance of the gear",
)
