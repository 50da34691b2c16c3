"""The textbook reduction to one shaft: every term with its own efficiency, a mean motor torque, one formula."""

import math

import numpy as np

from ptmcalc.machines.drivetrain.machine.model import Case, case_of, rigid
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, TrainScene
from ptmcalc.numerics.train.parts import Governed, Smooth, Straight
from ptmcalc.numerics.train.signals import FloatArray, Signal

_POINTS = 24
"""Speeds at which the mean torque of a curve is taken; a numerical choice. The midpoint rule has an error of second
order: twice the number leaves a quarter. Only the textbook value depends on it."""


def time_by_terms(spec: Drivetrain, scene: TrainScene) -> float | None:
    """Start or stop time of the train reduced to the shaft the scene is about, efficiency term by term.

        start  t = J w/(M - M_st),    J = sum J_i/(u_i^2 eta_i),   M_st = sum T_i/(u_i eta_i)
        stop   t = t_0 + J w/(M_b + M_st),   J = sum J_i eta_i/u_i^2,   M_st = sum T_i eta_i/u_i

    M is the mean motor torque over the speeds of the start, t_0 the delay and half the rise of the brake.

    Exact for constant loads where static and inertial torque of every part have one sign, or without losses; the
    textbook's rule (lecture notes Kramatorsk 2007), shown beside the exact one, never judged.
    """
    case = rigid(case_of(spec, scene, backlash=False))
    ratio, loss = _paths(case, power=not case.stopping)
    if np.isnan(ratio).any():
        return None
    inertia = sum(body.inertia * ratio[i] ** 2 * loss[i] for i, body in enumerate(case.train.bodies))
    speed = case.until if case.until is not None else case.train.bodies[case.main].speed
    resisting, driving, delay = _torques(case, ratio, loss, speed)
    left = resisting if case.stopping else driving - resisting
    return max(delay + float(inertia) * abs(speed) / left, _ramp(case)) if left > 0 else math.inf


def _ramp(case: Case) -> float:
    """How long a controlled drive takes by its reference alone."""
    laws = [stage.law for drive in case.train.drives for stage in drive.stages]
    return max([law.reference.times[-1] for law in laws if isinstance(law, Governed)], default=0.0)


def _paths(case: Case, *, power: bool) -> tuple[FloatArray, FloatArray]:
    """Speed of every body over that of the main one, and the factor of its efficiency on the way there."""
    ratio, loss = np.full(len(case.bodies), math.nan), np.ones(len(case.bodies))
    ratio[case.main] = 1.0
    for _ in case.bodies:
        for mesh in case.train.meshes:
            factor = 1 / mesh.forward if power else mesh.forward
            if math.isnan(ratio[mesh.outer]) and not math.isnan(ratio[mesh.inner]):
                ratio[mesh.outer], loss[mesh.outer] = ratio[mesh.inner] / mesh.ratio, loss[mesh.inner] * factor
            elif math.isnan(ratio[mesh.inner]) and not math.isnan(ratio[mesh.outer]):
                ratio[mesh.inner], loss[mesh.inner] = ratio[mesh.outer] * mesh.ratio, loss[mesh.outer] / factor
    return ratio, loss


def _torques(case: Case, ratio: FloatArray, loss: FloatArray, speed: float) -> tuple[float, float, float]:
    """Resisting torque on the main shaft, mean driving torque there, and how late a brake is."""
    way = math.copysign(1.0, speed) if speed else 1.0
    resisting = driving = delay = 0.0
    speeds = np.linspace(0, abs(speed), 2 * _POINTS + 1)[1::2] * way
    for drive in case.train.drives:
        mean = float(np.mean([_mean(drive.stages[0].law, ratio[drive.body] * at) for at in speeds]))
        mean *= way * np.sign(ratio[drive.body]) * abs(ratio[drive.body])
        if drive.gate.values != (1.0,):
            continue
        if mean > 0:
            driving += mean
        else:
            resisting -= mean * loss[drive.body]
    for grip in case.train.grips:
        if grip.second is None:
            full = grip.capacity.values[-1]
            resisting += full * abs(ratio[grip.first]) * loss[grip.first]
            times = grip.capacity.times
            delay = max(delay, (times[0] if len(times) == 1 else times[1] + (times[-1] - times[1]) / 2))
    if case.stopping:
        resisting -= driving
    return float(resisting), float(driving), float(delay)


def _mean(law: object, speed: float) -> float:
    """Torque of a law at a speed; of one over time its last value."""
    if isinstance(law, Signal):
        return law.values[-1]
    if isinstance(law, Smooth):
        return float(law.value(np.array([speed]))[0])
    if isinstance(law, Straight):
        return float(np.interp(speed, law.knots, law.values)) if law.on == "speed" else float(np.mean(law.values))
    assert isinstance(law, Governed)
    return law.limit
