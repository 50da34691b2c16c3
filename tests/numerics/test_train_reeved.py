"""A rope that runs over a body which gives way, and signals that a force sets off: against DOP853 with events."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh
from support.trains import run

from ptmcalc.numerics.train.modes import frequencies
from ptmcalc.numerics.train.parts import NO_PULL, RIGID, Body, Drive, Grip, Spring, Train
from ptmcalc.numerics.train.signals import Signal, Trigger
from ptmcalc.numerics.train.system import TrainSystem

G = 9.81
M, M1, MB, K, KB, V0 = 5e3, 18e3, 9e3, 1.2e6, 9e6, 0.25
Q = M * G
STRUCTURE = Spring("structure", 2, None, KB)
ROPE = Spring("rope", 0, 1, K, law=NO_PULL, side=1, over=2)
GROUND = Spring("ground", 1, None, 0.0, law=RIGID, side=-1)


def hoist(pull: float, *springs: Spring, grips: tuple[Grip, ...] = ()) -> Train:
    return Train(
        (Body("drive", M1, 0.0, V0), Body("load", M), Body("bridge", MB)),
        springs=springs,
        grips=grips,
        drives=(Drive.of("motor", 0, Signal.constant(pull)), Drive.of("weight", 1, Signal.constant(-Q))),
    )


def by_steps(pull: float, end: float) -> tuple[float, float, float]:
    """Largest forces in rope and structure and the time of lift-off; the load is on the ground until F = Q."""

    def rate(t: float, y: np.ndarray, lifted: bool) -> list[float]:
        force = K * max(y[0] - y[2] - y[4], 0.0)
        up = force / M - G if lifted else 0.0
        return [y[1], (pull - force) / M1, y[3], up, y[5], (force - KB * y[4]) / MB]

    def off(t: float, y: np.ndarray, lifted: bool) -> float:
        return K * (y[0] - y[2] - y[4]) - Q

    off.terminal, off.direction = True, 1  # type: ignore[attr-defined]
    options = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13}
    first = solve_ivp(rate, (0, end), [0.0, V0, 0.0, 0.0, 0.0, 0.0], events=off, args=(False,), **options)
    second = solve_ivp(rate, (first.t[-1], end), first.y[:, -1], args=(True,), dense_output=True, **options)
    times = np.linspace(first.t[-1], end, 200_001)
    y = second.sol(times)
    assert y[2].min() >= 0
    return K * float((y[0] - y[2] - y[4]).max()), KB * float(y[4].max()), float(first.t[-1])


@pytest.mark.parametrize("order", [(STRUCTURE, ROPE, GROUND), (STRUCTURE, GROUND, ROPE)])
def test_lift_off_under_a_bridge_with_mass(order: tuple[Spring, ...]) -> None:
    rope, bridge, time = by_steps(1.3 * Q, 0.6)
    found = run(hoist(1.3 * Q, *order), 0.6)
    at = {spring.name: index for index, spring in enumerate(order)}
    assert found.top("link", at["rope"]) == pytest.approx(rope, rel=1e-8)
    assert found.top("link", at["structure"]) == pytest.approx(bridge, rel=1e-8)
    assert found.times("ground")[-1] == pytest.approx(time, rel=1e-9)


def test_frequencies_of_three_masses() -> None:
    rows = np.array([[1.0, -1.0, -1.0], [0.0, 0.0, 1.0]])
    values = eigh(rows.T @ np.diag([K, KB]) @ rows, np.diag([M1, M, MB]), eigvals_only=True)
    found = frequencies(hoist(Q, STRUCTURE, ROPE))
    assert found.tolist() == pytest.approx(np.sqrt(values[1:]).tolist(), rel=1e-12)


def test_what_a_rope_runs_over_is_held() -> None:
    with pytest.raises(ValueError, match="not held by a link before it"):
        TrainSystem(hoist(Q, ROPE, STRUCTURE, GROUND))


def test_a_limiter_swaps_the_motor_for_the_brake() -> None:
    """Some time after the rope force rises through a level: against an integration with the same three phases."""
    level, react, brake = 1.2 * Q, 0.05, 3 * Q
    tripped = Trigger(0, "force", level, rising=True)
    gate = Signal((0.0, react), (1.0, 0.0), (0.0, 0.0), trigger=tripped, before=1.0)
    closing = Signal((0.0, react), (0.0, brake), (0.0, 0.0), trigger=tripped)
    train = Train(
        (Body("drive", M1, 0.0, V0), Body("load", M)),
        springs=(Spring("rope", 0, 1, K, law=NO_PULL, side=1), Spring("ground", 1, None, 0.0, law=RIGID, side=-1)),
        grips=(Grip("brake", 0, None, closing),),
        drives=(Drive.of("motor", 0, Signal.constant(1.6 * Q), gate), Drive.of("weight", 1, Signal.constant(-Q))),
    )
    found = run(train, 1.5)

    def rate(t: float, y: np.ndarray, lifted: bool, push: float) -> list[float]:
        force = K * (y[0] - y[2])
        return [y[1], (push - force) / M1, y[3], force / M - G if lifted else 0.0]

    def phase(y: np.ndarray, start: float, end: float, lifted: bool, push: float, stop: str = "") -> tuple[float, ...]:
        def event(t: float, y: np.ndarray, lifted: bool, push: float) -> float:
            force = K * (y[0] - y[2])
            return {"off": force - Q, "level": force - level, "stands": y[1], "": 1.0}[stop]

        event.terminal = True  # type: ignore[attr-defined]
        done = solve_ivp(
            rate, (start, end), y, "DOP853", rtol=1e-12, atol=1e-13, events=event, args=(lifted, push),
            dense_output=True,
        )  # fmt: skip
        y = done.sol(np.linspace(start, done.t[-1], 20_001))
        peaks.append(K * float((y[0] - y[2]).max()))
        return done.t[-1], done.y[:, -1]

    peaks: list[float] = []
    time, y = phase(np.array([0.0, V0, 0.0, 0.0]), 0.0, 1.0, False, 1.6 * Q, "off")
    trip, y = phase(y, time, 1.0, True, 1.6 * Q, "level")
    time, y = phase(y, trip, trip + react, True, 1.6 * Q)
    stands, y = phase(y, time, 1.0, True, -brake, "stands")
    started = [time for time, _, after in found.events("motor") if after == "started"]
    assert started == [pytest.approx(trip, rel=1e-9)]
    assert [time for time, _, after in found.events("brake") if after == "at rest"] == [pytest.approx(stands, rel=1e-9)]
    held = Q + math.hypot(K * (y[0] - y[2]) - Q, y[3] * math.sqrt(K * M))
    assert found.top("link", 0) == pytest.approx(max(*peaks, held), rel=1e-8)
