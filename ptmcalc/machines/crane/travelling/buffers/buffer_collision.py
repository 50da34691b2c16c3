"""A crane that runs onto its buffers."""

import math
from dataclasses import replace

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate
from ptmcalc.components.buffer import Stopped, stopped
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import buffer
from ptmcalc.machines.crane.travelling.buffers import yawing
from ptmcalc.machines.crane.travelling.machine import model
from ptmcalc.machines.crane.travelling.machine.loads import OF_THE_BUFFERS, names
from ptmcalc.machines.crane.travelling.machine.scenes import Collision
from ptmcalc.machines.crane.travelling.machine.spec import Travelling

_FAR = 10.0
"""Strokes of the buffers beyond which their continued curve is looked at in no finer steps."""
_LEFT = 3.0
"""Error of the speed that is left over that of the stroke, of the whole speed: the more, the less of it is left."""


def run(spec: Travelling, scene: Collision, carried: frozenset[str], level: int) -> Result:
    """Buffer forces, strokes and residual speed for the trolley position: the rail near the trolley takes more than
    half.

        M y'' + F(y) = P + H,   H = m g (x - y_h)/L for a suspended load;   phi_7 by the energy share xi of the curve

    The crane may rotate within the clearance of its guides: in M the bridge is a uniform rod, trolley and guided load
    are points. A suspended load acts by the angle of its ropes. The buffers on both rails are equal; a single buffer is
    in the middle. Two colliding cranes with equal buffers are equivalent to one crane with twice the reduced mass and
    half the closing speed on one buffer set.

    **Range** a stiff bridge; buffers that push only; wheels that roll, without resistance; small angles of the load.
    **Error** that of the time steps, estimated from two runs; guides without clearance would share the force equally,
    which is less; the rolling resistance is neglected, on the safe side.
    **Source** Newton's law in the plane of the bridge; EN 13001-2, ISO 8686-1, SNiP 2.01.07-85 (`laws.buffer`).
    """
    given = spec.buffers
    assert given is not None
    guided = 1.0 if scene.suspension == "guided" else 0.0
    rotor = model.rotor_mass(spec, braking=False)
    mass = buffer.collision_mass(model.travelling_mass(spec) + rotor, model.hanging(spec, scene), guided)
    speed = scene.speed_share * spec.speed
    push = model.driving_force(spec, spec.drive.torque) if scene.drive == "on" else 0.0
    struck, closing, behind = mass, speed, push
    if scene.other_mass is not None:
        reduced, both, pushes = buffer.meeting(mass, scene.other_mass, speed, scene.other_speed, push, push)
        struck, closing, behind = 2 * reduced, both / 2, pushes  # each of two equal buffers in a row takes its half
    straight = stopped(given, struck, closing, behind)
    found = {
        "collision_speed": Found(Estimate.exact(closing)),
        "collision_energy": Found(Estimate.exact(struck * closing**2 / 2)),
        "phi7": Found(Estimate.exact(buffer.buffer_factor(straight.energy_share, spec.classes.buffer_edition))),
    }
    if not math.isfinite(straight.stroke):
        never = _never(straight, given.count, (straight.force - push) / mass)
        return Result(found | never, work=1, failures=straight.failures("CRN171", given, ("buffers",)))
    reach = min(straight.stroke, _FAR * given.stroke)
    runs = [yawing.pressed(spec, one, reach) for one in yawing.places(spec, scene, struck / mass, closing)]
    steady = given.type == "constant"
    force = _worst([(one.force, 0.0 if steady else share) for one, share in runs])
    decelerates = _worst([(one.deceleration * struck / mass, share) for one, share in runs])
    stroke = _worst([(one.stroke, share) for one, share in runs])
    hardest = max((one for one, _ in runs), key=lambda one: one.stroke)
    where = f"on rail {hardest.rail}, hook {hardest.hook:.3g} m from rail A"
    left, unsure = max(one.left for one, _ in runs), _LEFT * max(share for _, share in runs) * closing
    if left:
        force, decelerates = (replace(one, high=math.inf, model=math.inf) for one in (force, decelerates))
        if not all(one.ended for one, _ in runs):
            stroke = replace(stroke, high=math.inf, model=math.inf)
    found |= {
        "buffer_force": Found(force, note=where),
        "buffer_stroke": Found(stroke, note=_bottoms(left) or where),
        "buffer_speed_left": Found(Estimate.within(left, unsure)),
        "buffer_deceleration": Found(decelerates),
    }
    hit = replace(straight, left=left)
    return Result(
        found,
        work=len(runs),
        findings=hit.findings(("buffers",)),
        failures=hit.failures("CRN171", given, ("buffers",), unsure),
    )


def _worst(several: list[tuple[float, float]]) -> Estimate:
    """The largest of numbers with their errors as shares of them."""
    value, share = max(several)
    return Estimate.within(value, share * value)


def _never(straight: Stopped, count: int, deceleration: float) -> dict[str, Found]:
    """Buffers that do not stop what is pushed onto them."""
    return {
        "buffer_force": Found(straight.at_least(straight.force / count)),
        "buffer_stroke": Found(Estimate.exact(straight.stroke), note=_bottoms(straight.left)),
        "buffer_speed_left": Found(Estimate.exact(straight.left)),
        "buffer_deceleration": Found(straight.at_least(deceleration)),
    }


def _bottoms(left: float) -> str:
    return (
        f"the buffers bottom out: residual speed {units.show(left, units.SPEED)} at the end of their stroke"
        if left
        else ""
    )


BUFFER_COLLISION: Solver[Travelling, Collision] = Solver(
    name="buffer_collision",
    title="buffer impact on both rails, energy balance",
    fidelity=Fidelity.TRANSIENT,
    scenes=frozenset({Collision}),
    represents=frozenset(),
    gives=names(OF_THE_BUFFERS) | {"phi7"},
    run=run,
    cost=lambda spec, scene, carried, level: 0.02,
    source="Newton's law in the plane of the bridge; EN 13001-2, ISO 8686-1",
)
