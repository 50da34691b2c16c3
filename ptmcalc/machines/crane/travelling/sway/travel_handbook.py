"""The handbook beside the swing: a load that is part of the crane, and the mean of the wheels."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import pendulum, skid
from ptmcalc.machines.crane.travelling.machine import model, wheels
from ptmcalc.machines.crane.travelling.machine.model import filled
from ptmcalc.machines.crane.travelling.machine.scenes import Moving
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.sway.effects import MOVING_SCENES, mean_acceleration
from ptmcalc.machines.crane.travelling.sway.moving import motion_of, stalls


def run(spec: Travelling, scene: Moving, carried: frozenset[str], level: int) -> Result:
    """Start, stop, sway and adhesion by handbook formulas.

        t = v m_red/(F - W),   theta = 2 a/g,   theta_r = (2 a/g) |sin(omega t/2)|,   H = 2 M a
        k = mu sum N_k/(m a + W)

    **Range** loads light relative to the crane, starts of half a period or more; equally loaded wheels.
    **Error** no bound: the mean adhesion may be sufficient although the wheel with the lowest load slips.
    **Source** handbooks of lifting machines.
    """
    motion = motion_of(spec, scene)
    if stalls(motion):
        return Result({}, work=1)
    a = mean_acceleration(spec, scene)
    time = motion.speed / a + (motion.delay + motion.rise / 2 if motion.ramp is None and not motion.starts else 0.0)
    omega = math.sqrt(motion.gravity / motion.length)
    loads = {
        "start_time" if motion.starts else "brake_time": time,
        "acceleration_max": a,
        "sway_angle_max": 2 * a / motion.gravity if motion.load else 0.0,
        "sway_residual": float(pendulum.ramp_residual(a, motion.gravity, omega, motion.speed / a))
        if motion.load
        else 0.0,
        "horizontal_force": 2 * motion.load * a,
        "skid_reserve_min": _mean_reserve(spec, scene, a),
    }
    return Result({name: Found(Estimate.unknown(value)) for name, value in loads.items()}, work=1)


def _mean_reserve(spec: Travelling, scene: Moving, acceleration: float) -> float:
    """Adhesion of all driven wheels with the hook in the middle of its places over all that is asked of them."""
    motion = motion_of(spec, scene)
    places = model.hook_places(spec, scene)
    loads = wheels.corner_loads(spec, sum(places) / len(places), wheels.at_rest(spec, scene))
    each = spec.wheels.per_corner
    carried = sum(loads[one] / each * model.driven_at(spec, one) for one in wheels.driven_corners(spec))
    sign = 1 if motion.starts else -1
    force = (motion.body + motion.load) * acceleration * sign + motion.rolling + motion.outside
    return float(skid.skid_reserve(filled(spec.rail.adhesion), carried, force))


TRAVEL_HANDBOOK: Solver[Travelling, Moving] = Solver(
    name="travel_handbook",
    title="handbook start, stop, sway and mean adhesion",
    fidelity=Fidelity.FORMULA,
    scenes=MOVING_SCENES,
    represents=frozenset(),
    gives=frozenset(
        {
            "start_time",
            "brake_time",
            "acceleration_max",
            "sway_angle_max",
            "sway_residual",
            "horizontal_force",
            "skid_reserve_min",
        }
    ),
    run=run,
    cost=lambda spec, scene, carried, level: 5e-5,
    source="handbooks of lifting machines",
    decides=False,
)
