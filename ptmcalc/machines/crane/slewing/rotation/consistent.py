"""The chain of a rotation whose start has either its torque or its time, and the other follows."""

import math

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.effect import Criterion
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import classification
from ptmcalc.machines.crane.slewing.drive import reserves
from ptmcalc.machines.crane.slewing.drive.loads import OF_THE_DRIVE, OF_THE_USE
from ptmcalc.machines.crane.slewing.machine import model
from ptmcalc.machines.crane.slewing.machine.spec import Slew, SlewingCrane, SlewingScene
from ptmcalc.machines.crane.slewing.ring import forces
from ptmcalc.machines.crane.slewing.ring.loads import OF_THE_RING
from ptmcalc.machines.crane.slewing.rotation import chain, start_curve

_QUADRATURE = 1e-9
"""Error of a number that hangs on the time of a start along a curve, over it."""


def run(spec: SlewingCrane, scene: SlewingScene, carried: frozenset[str], level: int) -> Result:
    """Slewing cycle: the starting time follows from the motor torque, or the torque from the time.

        t_s = (J + gamma J_1 u^2 eta) w/(M_m u eta - M_steady), or M_m u eta = (J + ...) w/t_s + M_steady

    The stop is that of the brake through the gear (`laws.slewing.geared_stop`). Without a brake, the stop and its
    torques are those of a uniform stop over the permissible angle. The solver also computes the requirements of motor,
    brake, gear and slewing ring.

    **Range** a rigid crane under constant torques.
    **Error** exact for that model; the rotor and the gear losses in the stop are treated as in the handbook, see
    `geared`.
    **Source** change of angular momentum; course notes on the slewing crane on a fixed column; IEC 60034-1, ISO 4301-1.
    """
    return found_by(spec, scene, by_direction=False)


def run_geared(spec: SlewingCrane, scene: SlewingScene, carried: frozenset[str], level: int) -> Result:
    """Slewing cycle of `consistent` with gear losses by the direction of power.

        M_brake = J w/t_b + M_w,max - M_fr, the brake holds the rotor;   M_worm of the stop = M_brake eta_r/u

    **Range** a rigid crane under constant torques, the brake on the motor shaft.
    **Error** exact for that model.
    **Source** power balance of the mesh (`laws.gearing`); otherwise as `consistent`.
    """
    return found_by(spec, scene, by_direction=True)


def run_curve(spec: SlewingCrane, scene: SlewingScene, carried: frozenset[str], level: int) -> Result:
    """Slewing cycle of `geared` with a start along the motor curve instead of the mean torque.

        t_s = integral of J dw/(M(u w) u eta - M_steady),   beta_s = integral of w dt

    **Range** a rigid crane, motors with a curve over the speed.
    **Error** that of the quadrature, about 1e-9.
    **Source** change of angular momentum along the curve; otherwise as `geared`.
    """
    return found_by(spec, scene, by_direction=True, by_curve=True)


def has_curve(spec: SlewingCrane, scene: SlewingScene) -> Criterion:
    """Whether the motors have a curve over the speed.

    **Range** any crane.
    **Error** none.
    **Source** the file.
    """
    return Criterion("curve", 0.0 if start_curve.follows(spec) else 1.0, 0.5, "the motor has no curve", "the file")


def found_by(spec: SlewingCrane, scene: SlewingScene, *, by_direction: bool, by_curve: bool = False) -> Result:
    """All of it, rotor and losses of the stop by the handbook or `by_direction` of the power; the start by the mean of
    the motor's torque or `by_curve`."""
    start, at_column, derived = model.start_of(spec, scene)
    turned = spec.speed * start / 2
    rise = start_curve.rise_of(spec, scene) if by_curve else None
    if rise is not None:
        start, turned = rise.time, rise.angle
    stop = model.stop(spec, scene)
    times = model.phases(spec, (start, turned), stop or model.allowed_stop(spec))
    at = model.phase_torques(spec, scene, at_column, by_direction=by_direction)
    loads = found_of(spec, scene, times, at)
    loads |= (
        reserves.of_drive(spec, scene, times, at, chain.worth(spec, scene, 2.0))
        | forces.of_ring(spec, scene)
        | of_use(spec)
    )
    found = {name: Found(Estimate.exact(value)) for name, value in loads.items()}
    if rise is not None:
        found = {name: Found(_by_quadrature(value)) for name, value in loads.items()}
    known = "the start time" if derived == "torque_start" else "the motor's torque"
    found[derived] = Found(found[derived].estimate, note=f"derived from {known}")
    return Result(found, work=1)


def _by_quadrature(value: float) -> Estimate:
    """A number with the error of Gauss's rule over a motor's curve."""
    return Estimate.within(value, _QUADRATURE * abs(value)) if math.isfinite(value) else Estimate.exact(value)


def found_of(spec: SlewingCrane, scene: SlewingScene, times: model.Phases, at: model.PhaseTorques) -> dict[str, float]:
    """The loads of the chain, those of an endless rotation too."""
    if math.isfinite(times.whole):
        return dict(chain.loads(spec, scene, times, at, rounded=False))
    return _endless(spec, scene, times, at)


def _endless(spec: SlewingCrane, scene: SlewingScene, times: model.Phases, at: model.PhaseTorques) -> dict[str, float]:
    """What is left to say of a rotation whose start or stop never ends."""
    return {
        "slew_inertia": model.slew_inertia(spec, scene),
        "start_time": times.start[0],
        "brake_time": times.brake[0],
        "brake_angle": times.brake[1],
        "torque_start": at.start,
        "torque_steady": at.steady,
        "torque_inertia_brake": at.inertia_brake,
        "torque_brake": at.brake,
    }


def of_use(spec: SlewingCrane) -> dict[str, float]:
    """What the use of the crane asks of its group."""
    given = spec.classes
    if given.cycles is None:
        return {}
    points = given.load_spectrum
    factor = 1.0
    if points is not None:
        factor = classification.spectrum_factor([one.share for one in points], [one.load for one in points])
    group = classification.group(classification.use_of_cycles(given.cycles), classification.load_class(factor))
    return {"spectrum_factor": factor, "crane_group": float(group)}


_GIVEN = chain.GIVEN | {info.name for info in (*OF_THE_DRIVE, *OF_THE_RING, *OF_THE_USE)}

CONSISTENT: Solver[SlewingCrane, SlewingScene] = Solver(
    name="consistent",
    title="slewing cycle, start time consistent with motor torque",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Slew}),
    represents=frozenset(),
    gives=_GIVEN,
    run=run,
    cost=lambda spec, scene, carried, level: 1e-4,
    source="change of angular momentum",
)
GEARED: Solver[SlewingCrane, SlewingScene] = Solver(
    name="geared",
    title="slewing cycle, gear losses by direction of power flow",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Slew}),
    represents=frozenset({"efficiency_direction"}),
    gives=_GIVEN,
    run=run_geared,
    cost=lambda spec, scene, carried, level: 2e-4,
    source="power balance of the mesh",
)
CURVED: Solver[SlewingCrane, SlewingScene] = Solver(
    name="curved",
    title="slewing cycle, start along the motor torque-speed curve",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Slew}),
    represents=frozenset({"efficiency_direction", "slewing_motor_curve"}),
    gives=_GIVEN,
    run=run_curve,
    cost=lambda spec, scene, carried, level: 5e-3,
    source="change of angular momentum along the motor's curve",
    valid=has_curve,
    always=frozenset({"efficiency_direction", "slewing_motor_curve"}),
)
