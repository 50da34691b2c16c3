"""A crane that stands in the wind out of service."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import travel
from ptmcalc.machines.crane.travelling.machine import model, stability, wheels
from ptmcalc.machines.crane.travelling.machine.loads import OF_THE_STORM, names
from ptmcalc.machines.crane.travelling.machine.model import State, filled
from ptmcalc.machines.crane.travelling.machine.scenes import Storm
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.statics import resisting


def run(spec: Travelling, scene: Storm, carried: frozenset[str], level: int) -> Result:
    """Out-of-service wind force, and holding force of brakes and rail clamps.

        F = q c A + G sin(alpha);   held: sum of min(M_b u/(r eta_r)/n, mu N_k) + clamps

    A braked wheel holds its share of the brake force, or its adhesion if that is smaller; the other wheels roll freely.

    **Range** wind along the rails; brakes closed.
    **Error** exact for that model; the rolling resistance of the other wheels is neglected, on the safe side.
    **Source** balance along the rails; winds of EN 13001-2, ISO 4302.
    """
    assert spec.wind is not None
    pressure = filled(spec.wind.pressure_storm)
    wind = model.wind_force(spec, pressure)
    weight = model.weight(spec, scene)
    force = float(travel.travel_resistance(0.0, weight, 0.0, resisting.slope_angle(spec), wind))
    state = State(0.0, 0.0, model.hanging(spec, scene) * spec.gravity, 0.0, wind)
    brake = spec.drive.brake
    by_brakes = model.braking_force(spec, brake.torque) if brake is not None else 0.0
    by_wheels = min(_held_by_wheels(spec, by_brakes, hook, state) for hook in model.hook_places(spec, scene))
    held = by_wheels + (spec.parking.force if spec.parking is not None else 0.0)
    loads = {"storm_force": force, "holding_force": held, "storm_reserve": held / force}
    found = {name: Found(Estimate.exact(value)) for name, value in loads.items()}
    found["stability_reserve"] = Found(Estimate.exact(stability.of_rest(spec, scene, pressure)))
    rolling = wheels.Wheels.of(spec, scene)
    for name, largest in (("wheel_load_max", True), ("wheel_load_min", False)):
        value = float(rolling.extreme(state, largest)[0])
        found[name] = Found(Estimate.exact(value), note=rolling.where(state, largest))
    if by_brakes > by_wheels:
        found["holding_force"] = Found(Estimate.exact(held), note="the braked wheels slip before the brakes")
    return Result(found, work=1)


def _held_by_wheels(spec: Travelling, brakes: float, hook: float, state: State) -> float:
    """What the braked wheels hold on the rails, each up to its adhesion; on one shaft all together [N]."""
    loads = wheels.corner_loads(spec, hook, state)
    each = filled(spec.rail.adhesion) / spec.wheels.per_corner
    grips = [(each * max(loads[corner], 0.0), model.driven_at(spec, corner)) for corner in wheels.driven_corners(spec)]
    if spec.drive.wheels == "coupled":
        return min(brakes, sum(grip * count for grip, count in grips))
    one = brakes / model.driven_wheels(spec)
    return sum(min(one, grip) * count for grip, count in grips)


STORM_PARKING: Solver[Travelling, Storm] = Solver(
    name="storm_parking",
    title="parked crane in out-of-service wind",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Storm}),
    represents=frozenset(),
    gives=names(OF_THE_STORM) | {"wheel_load_max", "wheel_load_min", "stability_reserve"},
    run=run,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="balance along the rails; EN 13001-2, ISO 4302",
)
