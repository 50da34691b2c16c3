"""P1 to P6 of the performance study: what our kinds call for each, and the same work for scipy's solvers."""

import math
from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from ptmcalc.numerics.decay_pulse import DecayPulse
from ptmcalc.numerics.mast.base import Base, Grip, Obstacle, Signal
from ptmcalc.numerics.mast.case import Case
from ptmcalc.numerics.mast.modes import Mast
from ptmcalc.numerics.mast.parts import Column, Lump, Segment
from ptmcalc.numerics.mast.run import play
from ptmcalc.numerics.mast.system import MastSystem
from ptmcalc.numerics.passes import Passes, Wave
from ptmcalc.numerics.piecewise import march
from ptmcalc.numerics.train.system import TrainSystem
from support import problem_belts as belts
from support import problem_trains as trains
from support.meshes import LUMPED, MEAN
from support.peers import Played, Problem

# -- P1, P2: waves along a belt ----------------------------------------------------------------------------------------

CELLS = {"P1": (5, 10, 20, 40), "P2": (26, 52, 105, 210)}
ELEMENTS = {"P1": 1600, "P2": 300}
EXPLICIT = ("RK45", "DOP853")


def belt(problem: belts.Problem, title: str, target: float) -> Problem:
    """Peers on finite elements: explicit ones with the masses that pass waves best, which fill the Jacobian of the
    others; these get lumped masses."""
    count, soft = ELEMENTS[problem.name], problem.soft[0]

    def peer(method: str, rtol: float) -> Played:
        masses = MEAN if method in EXPLICIT else LUMPED
        played = problem.mesh(count, masses, soft).run_on(method, problem.when, rtol)
        answer = min(played.readings, key=lambda one: float(np.abs(one - problem.truth()).max()))
        return Played(answer, played.evaluations)

    of = "panels of 12 steps" if problem is belts.P1 else "cells"
    settings = tuple((f"{cells} {of}", partial(_run_on, problem, cells)) for cells in CELLS[problem.name])
    return Problem(problem.name, title, target, settings, problem.truth, peer, (1e-3,), math.inf)


def _run_on(problem: belts.Problem, cells: int) -> np.ndarray:
    return problem.ours(cells).run_on


P1 = belt(belts.P1, "belt, 60 s of waves", 0.3)
P2 = belt(belts.P2, "belt with friction, motor, 30 s", 1000.0)

# -- P3: a thousand teeth ----------------------------------------------------------------------------------------------

TEETH, PITCH, OMEGA, ZETA, PASSES = 12, 0.1, 2.0, 1e-3, 1000
HALF = math.pi / TEETH
FORCE = OMEGA**2 * PITCH / 2 / math.sin(HALF)
WAVE = Wave(OMEGA, -HALF, 2 * HALF / OMEGA)
PLACES = np.arange(20) / 20
BESIDE = 24 * (1 + 1e-6)
DEFLECTION = np.array([[1.0, 0.0]])


def teeth(w: float = BESIDE, passes: int = PASSES) -> np.ndarray:
    """Deflection at all places of all passes."""
    rate = np.array([[0.0, 1.0], [-w * w, -2 * ZETA * w]])
    return Passes(rate, np.array([0.0, FORCE]), WAVE, passes).at(PLACES, DEFLECTION)[:, :, 0]


def teeth_of_peer(method: str, rtol: float, w: float = BESIDE, passes: int = PASSES) -> Played:
    """The same by a solver that begins again at every tooth."""
    state, seen, evaluations = np.zeros(2), np.empty((passes, len(PLACES))), 0
    times = [*(PLACES * WAVE.period), WAVE.period]

    def rate(t: float, y: np.ndarray) -> tuple[float, float]:
        return y[1], FORCE * math.sin(OMEGA * t - HALF) - 2 * ZETA * w * y[1] - w * w * y[0]

    for k in range(passes):
        run = solve_ivp(rate, (0, WAVE.period), state, method, times, rtol=rtol, atol=1e-2 * rtol)
        seen[k], state, evaluations = run.y[0, :-1], run.y[:, -1], evaluations + run.nfev
    return Played(seen, evaluations)


@cache
def teeth_exactly(w: float = BESIDE, passes: int = PASSES) -> np.ndarray:
    """The iterated exponential in extended precision: complex amplitude times the same factor, pass by pass."""
    pole = np.clongdouble(complex(-ZETA * w, 0)) + np.clongdouble(1j) * np.longdouble(w) * np.sqrt(
        np.longdouble(1) - np.longdouble(ZETA) ** 2
    )
    turn = np.clongdouble(1j) * OMEGA
    late = np.exp(-np.clongdouble(1j) * HALF) / (turn - pole)
    back = np.conj(np.exp(-np.clongdouble(1j) * HALF)) / (np.conj(turn) - pole)
    times = PLACES.astype(np.longdouble) * WAVE.period

    def gained(t: np.ndarray) -> np.ndarray:
        """Integral of exp(pole (t - s)) sin(OMEGA s - HALF) over a pass up to t."""
        both = late * (np.exp(turn * t) - np.exp(pole * t)) - back * (np.exp(-turn * t) - np.exp(pole * t))
        return FORCE * both / np.clongdouble(2j)

    factor, kick = np.exp(pole * WAVE.period), gained(np.array([np.longdouble(WAVE.period)]))[0]
    amplitude, expected = np.clongdouble(0), np.empty((passes, len(PLACES)))
    decay, inside = np.exp(pole * times), gained(times)
    for k in range(passes):
        expected[k] = ((decay * amplitude + inside).imag / pole.imag).astype(float)
        amplitude = factor * amplitude + kick
    return expected


P3 = Problem(
    "P3", "1000 tooth passes", 0.1, (("affine map", teeth),), teeth_exactly, teeth_of_peer, (1e-4, 1e-7, 1e-10), 1e-6
)

# -- P4, P5: contacts from event to event ------------------------------------------------------------------------------

System = TrainSystem | MastSystem


def told(system: System, z: np.ndarray) -> np.ndarray:
    """A state as an answer: places [m] and speeds [m/s] of the bodies; way, speed and modes over their sizes."""
    if isinstance(system, TrainSystem):
        return np.concatenate([system.body_position @ z, system.body_speed @ z])
    return z[: system.own] / system.scale[: system.own]


def by_solver(system: System, end: float, method: str, rtol: float, most_events: int = 5_000) -> Played:
    """The state at the end by a solver that stops at every guard: the equations and what follows an event are those of
    the system, which knows neither our propagation nor our roots."""
    scale, own = system.scale, system.own
    mode, z = system.start()
    reaction = system.react(mode, 0.0, z, None)
    time, last, evaluations = 0.0, -1.0, 0
    for _ in range(most_events):
        mode, z = reaction.mode, reaction.state
        if time >= end or reaction.finished:
            return Played(told(system, z), evaluations)
        motion, stop = system.motion(mode), min(end, system.next_break(mode, time))
        guards = [_guard(motion, index, scale) for index in range(len(motion.guards))]
        run = solve_ivp(
            _rates(motion, scale), (time, stop), z / scale, method, rtol=rtol, atol=1e-3 * rtol, events=guards
        )
        if not run.success:
            raise RuntimeError(run.message)
        evaluations += run.nfev
        fired = next((index for index, times in enumerate(run.t_events) if len(times)), None)
        time, y = float(run.t[-1]), run.y[:, -1]
        if fired is not None and not motion.curves:  # onto the guard, as any restart needs
            row = motion.guards[fired, :own] * scale[:own]
            y[:own] -= row * (float(motion.guards[fired] @ (y * scale)) / float(row @ row))
        reaction = system.react(mode, time, y * scale, fired)
        if fired is not None and time - last < 1e-9:  # off the guard, or the solver would stop at it again and again
            motion = system.motion(reaction.mode)
            reaction.state = reaction.state + 1e-9 * scale * _rates(motion, scale)(time, reaction.state / scale)
            time += 1e-9
        last = time
    raise RuntimeError(f"more than {most_events} events by {time:.4g} s")


def _rates(motion: Any, scale: np.ndarray) -> Callable[[float, np.ndarray], np.ndarray]:
    rate, gain = motion.rate * scale / scale[:, None], motion.gain / scale[:, None]
    if not motion.curves:
        return lambda t, y: rate @ y
    return lambda t, y: rate @ y + gain @ _values(motion, y * scale)


def _values(motion: Any, z: np.ndarray) -> np.ndarray:
    return np.array([float(curve.value((curve.rows @ z)[:, None])[0]) for curve in motion.curves])


def _guard(motion: Any, index: int, scale: np.ndarray) -> Callable[[float, np.ndarray], float]:
    row = motion.guards[index]

    def guard(t: float, y: np.ndarray) -> float:
        z = y * scale
        return float(row @ (np.concatenate([z, _values(motion, z)]) if motion.curves else z))

    guard.terminal, guard.direction = True, -1.0  # type: ignore[attr-defined]
    return guard


def trolley() -> np.ndarray:
    system, record = trains.played(trains.P4, trains.END, 1e-10)
    return told(system, record.state)


def trolley_of_peer(method: str, rtol: float) -> Played:
    return by_solver(TrainSystem(trains.P4), trains.END, method, rtol)


def tight(system: Callable[[], System], end: float, **options: float) -> np.ndarray:
    """Ours with other panels, and a curve followed a thousand times as closely."""
    made = system()
    record = march(made, *made.start(), end, **options)  # type: ignore[arg-type]
    return told(made, record.state)


P4A = Problem(
    "P4",
    "trolley with a load, buffer",
    3.0,
    (("exact", trolley),),
    cache(partial(tight, partial(TrainSystem, trains.P4), trains.END, refined=0.7)),
    trolley_of_peer,
    (1e-4, 1e-7, 1e-10),
    1e-4,
)

MODES, BEAM_END = 20, 20.0


@cache
def beam() -> Case:
    """A mast of 20 m on the trolley, in 20 modes up to 12 000 rad/s, 1 % of damping in each."""
    mast = Mast.of(Column((Segment(20.0, 2.52e8, 150.0),), (Lump(20.0, 1500.0),)), MODES)
    base = Base(trains.TROLLEY, trains.SPEED, grips=(Grip("brake", Signal.constant(trains.BRAKE)),))
    return Case(mast, np.full(MODES, 0.01), base, (20.0,), Obstacle(0.0, trains.BUFFER, trains.PLACE))


def mast() -> np.ndarray:
    course = play(beam(), BEAM_END)
    return told(course.system, course.record.state)


def mast_of_peer(method: str, rtol: float) -> Played:
    return by_solver(MastSystem(beam()), BEAM_END, method, rtol)


P4B = Problem(
    "P4",
    "trolley with a beam of 20 modes, buffer",
    25.0,
    (("exact", mast),),
    cache(partial(tight, lambda: MastSystem(beam()), BEAM_END, refined=0.7)),
    mast_of_peer,
    (1e-4, 1e-7),
    1e-4,
)
GEAR = 1e10
TOLERANCE = 1e-6


def hoist(stiffness: float = GEAR, tolerance: float = TOLERANCE) -> np.ndarray:
    system, record = trains.played(trains.hoist(stiffness, trains.Counted()), trains.P5_END, tolerance)
    return told(system, record.state)


def hoist_of_peer(method: str, rtol: float) -> Played:
    return by_solver(TrainSystem(trains.hoist(GEAR, trains.Counted())), trains.P5_END, method, rtol)


P5 = Problem(
    "P5",
    "hoist, start and brake, gear 1e10 N/m",
    40.0,
    tuple((f"tolerance {one:.0e}", partial(hoist, GEAR, one)) for one in (1e-4, TOLERANCE, 1e-8)),
    cache(partial(tight, lambda: TrainSystem(trains.hoist(GEAR, trains.Counted())), trains.P5_END, tolerance=1e-11)),
    hoist_of_peer,
    (1e-4, 1e-7),
    1e-5,
)

# -- P6: Duhamel's integral --------------------------------------------------------------------------------------------

K, SLOW, FAST, TAU, UNTIL, SAMPLES = 5.47, 3.0, 96.0, 5.0, 20.0, 10_001
TIMES = np.linspace(0, UNTIL, SAMPLES)


def pulse() -> np.ndarray:
    """Deflection at all samples."""
    return DecayPulse(K, 0.0, SLOW, FAST, 1.0, TAU).at(TIMES)[0]


def pulse_of_peer(method: str, rtol: float) -> Played:
    """The same by a solver that begins again where the pulse ends."""
    during, after = TIMES[TIMES <= TAU], TIMES[TIMES > TAU]

    def force(t: float) -> float:
        return math.exp(-SLOW * t) - math.exp(-FAST * t)

    options = {"rtol": rtol, "atol": 1e-2 * rtol}
    run = solve_ivp(
        lambda t, y: (y[1], force(t) - K * K * y[0]), (0, TAU), (0.0, 0.0), method,
        np.append(during[during < TAU], TAU), **options,
    )  # fmt: skip
    free = solve_ivp(lambda _, y: (y[1], -K * K * y[0]), (TAU, UNTIL), run.y[:, -1], method, after, **options)
    return Played(np.concatenate([run.y[0][: len(during)], free.y[0]]), run.nfev + free.nfev)


@cache
def pulse_exactly() -> np.ndarray:
    """Partial fractions in extended precision, where t is not small: the free part from the end of the pulse."""
    k, tau = np.longdouble(K), np.longdouble(TAU)
    t = TIMES.astype(np.longdouble)
    late = np.maximum(t - tau, 0)
    total = np.zeros_like(t)
    for a, sign in ((np.longdouble(SLOW), 1), (np.longdouble(FAST), -1)):
        swing = a * np.sin(k * t) - k * np.cos(k * t)
        since = a * np.sin(k * late) - k * np.cos(k * late)
        total += sign * (swing - np.exp(-a * np.minimum(t, tau)) * since) / (a * a + k * k)
    return np.asarray(total / k)


OF_PULSE = (("closed form", pulse),)
P6 = Problem("P6", "Duhamel, 10 001 samples", 0.3, OF_PULSE, pulse_exactly, pulse_of_peer, (1e-4, 1e-7, 1e-10), 1e-6)

PROBLEMS: dict[str, Problem] = {"P1": P1, "P2": P2, "P3": P3, "P4 two masses": P4A, "P4 beam": P4B, "P5": P5, "P6": P6}
