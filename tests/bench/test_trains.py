"""Two trains of the performance study, on the numerics themselves: counts are gates, seconds only a table.

P4: a trolley with a hanging load brakes and strikes a buffer. P5: a hoist train with play in a stiff gear, a slack
rope, an induction motor, a load that lifts off the ground, and a brake. `python -m pytest tests/bench/test_trains.py
--benchmark-enable -s -n 0` prints the table of times against scipy's solvers with events on the same work.
"""

import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from scipy.optimize import brentq
from support import hybrid
from support.problem_trains import (
    BRAKE,
    BREAKDOWN,
    BUFFER,
    DAMPING,
    DRUM,
    END,
    HOISTED,
    LOAD,
    MOTOR,
    OFF,
    P4,
    P5_END,
    PLACE,
    PLAY,
    ROPE,
    SLACK,
    SLIP,
    SPEED,
    STIFFNESSES,
    SYNCHRONOUS,
    TROLLEY,
    WEIGHT,
    Counted,
    hoist,
    played,
)

from ptmcalc.numerics.record import Record
from ptmcalc.numerics.train.ledger import ledger
from ptmcalc.numerics.train.parts import Spring
from ptmcalc.numerics.train.system import TrainSystem

REPEATS = 12
BOUNCED = 0.1
"""From then on the gear stays closed, whatever its stiffness."""


# -- P4 -------------------------------------------------------------------------------------------------------------


class Exact:
    """P4 by matrix exponentials of scipy from event to event: sliding to either side or held, in the buffer or not."""

    def __init__(self) -> None:
        self.state = np.array([0.0, 0.0, SPEED, SPEED, 1.0])
        self.time, self.sliding, self.pressed = 0.0, 1, False
        self.events: list[float] = []

    def rate(self) -> np.ndarray:
        spring, damper = np.array([1.0, -1.0]) * ROPE, np.array([1.0, -1.0]) * DAMPING
        rate = np.zeros((5, 5))
        rate[0, 2] = rate[1, 3] = 1.0
        rate[2, :2], rate[2, 2:4], rate[2, 4] = -spring / TROLLEY, -damper / TROLLEY, -self.sliding * BRAKE / TROLLEY
        rate[3, :2], rate[3, 2:4] = spring / LOAD, damper / LOAD
        if self.pressed:
            rate[2, 0] -= BUFFER / TROLLEY
            rate[2, 4] += BUFFER * PLACE / TROLLEY
        if not self.sliding:
            rate[0], rate[2] = 0.0, 0.0
        return rate

    def pull(self, state: np.ndarray) -> float:
        """What would move the trolley."""
        rope = ROPE * (state[1] - state[0]) + DAMPING * (state[3] - state[2])
        return float(rope - (BUFFER * (state[0] - PLACE) if self.pressed else 0.0))

    def guards(self) -> list[tuple[str, Callable[[np.ndarray], float]]]:
        side = 1.0 if self.pressed else -1.0
        found: list[tuple[str, Callable[[np.ndarray], float]]] = [("buffer", lambda s: side * (s[0] - PLACE))]
        if self.sliding:
            sliding = self.sliding
            return [*found, ("stop", lambda s: sliding * s[2])]
        return [*found, ("slip", lambda s: BRAKE - abs(self.pull(s)))]

    def go(self, end: float) -> "Exact":
        grid = 2e-3
        while self.time < end:
            rate, guards = self.rate(), self.guards()
            step, passed, state = expm(rate * grid), 0.0, self.state
            while True:
                following = step @ state
                crossed = [(kind, g) for kind, g in guards if g(following) < 0]
                if crossed or self.time + passed + grid >= end:
                    break
                state, passed = following, passed + grid
            if not crossed:
                self.state, self.time = expm(rate * (end - self.time - passed)) @ state, end
                return self
            root, kind = min((self._root(rate, state, g, grid), kind) for kind, g in crossed)
            self.time, self.state = self.time + passed + root, expm(rate * root) @ state
            self._change(kind)
        return self

    @staticmethod
    def _root(rate: np.ndarray, state: np.ndarray, guard: Callable[[np.ndarray], float], grid: float) -> float:
        def value(t: float) -> float:
            return guard(expm(rate * t) @ state)

        left = 0.0 if value(0.0) > 0 else next(t for t in np.linspace(0, grid, 33)[1:] if value(t) > 0)
        return float(brentq(value, left, grid, xtol=1e-17, rtol=1e-15))

    def _change(self, kind: str) -> None:
        self.events.append(self.time)
        if kind == "buffer":
            self.pressed = not self.pressed
            return
        self.state[2] = 0.0
        pull = self.pull(self.state)
        self.sliding = 0 if kind == "stop" and abs(pull) <= BRAKE else int(np.sign(pull))


def test_p4_agrees_with_matrix_exponentials_to_1e_10() -> None:
    exact = Exact().go(END)
    system, record = played(P4, END, 1e-10)
    assert len(record.events) == len(exact.events) > 25
    assert [event.time for event in record.events] == pytest.approx(exact.events, abs=1e-10)
    at = [system.watched[what, body] for what in ("position", "speed") for body in (0, 1)]
    assert record.last[at].tolist() == pytest.approx(exact.state[:4].tolist(), abs=1e-10)
    assert record.last[at[2]] == 0.0
    assert ledger(system, system.start(), record).residual < 1e-12


def test_p4_agrees_with_runge_kutta_steps_too() -> None:
    machine = hybrid.Machine(
        (TROLLEY, LOAD),
        (0.0, 0.0),
        (SPEED, SPEED),
        (
            hybrid.Link(0, 1, ROPE, DAMPING),
            hybrid.Link(0, None, BUFFER, play=2 * PLACE, law="clamped", side=1),
        ),
        (),
        (hybrid.Brake(0, None, hybrid.Course.constant(BRAKE)),),
    )
    history = hybrid.simulate(machine, 6.0)
    system, record = played(P4, 6.0, 1e-10)
    assert float(record.top.values[system.watched["link", 0]]) == pytest.approx(history.highest["link", 0], rel=1e-9)
    assert float(record.top.values[system.watched["link", 1]]) == pytest.approx(history.highest["link", 1], rel=1e-9)
    assert float(record.last[system.watched["position", 1]]) == pytest.approx(history.positions[1], abs=1e-9)


def test_p4_stays_within_its_work(benchmark: Any) -> None:
    _, record = benchmark.pedantic(played, (P4, END, 1e-10), rounds=1)
    assert len(record.events) == 29
    assert record.steps <= 200


# -- P5 -------------------------------------------------------------------------------------------------------------


def counted(stiffness: float, end: float) -> tuple[TrainSystem, Record, int]:
    curve = Counted()
    system, record = played(hoist(stiffness, curve), end, 1e-6)
    return system, record, curve.count


def test_p5_costs_the_same_whatever_the_stiffness_of_the_gear() -> None:
    """Apart from events: how often the gear bounces before it stays closed depends on its stiffness, so evaluations
    of the motor's curve are counted from 0.1 s on, where every gear is closed and lift-off and brake are to come."""
    rest, events = [], []
    for stiffness in STIFFNESSES:
        _, early, before = counted(stiffness, BOUNCED)
        _, late, whole = counted(stiffness, P5_END)
        later = [event.element for event in late.events if event.time > BOUNCED]
        assert later == ["ground", "brake"]
        rest.append(whole - before)
        events.append(len(late.events))
        assert len(late.events) - len(early.events) == 2
    assert max(rest) < 1.3 * min(rest), rest
    assert max(events) <= 40, events


@pytest.mark.parametrize("stiffness", STIFFNESSES)
def test_p5_stays_within_its_work_and_finds_the_same_rope_force(stiffness: float, benchmark: Any) -> None:
    system, record, evaluations = benchmark.pedantic(counted, (stiffness, P5_END), rounds=1)
    assert evaluations <= 6_000
    assert record.steps <= 2_200
    assert float(record.top.values[system.watched["link", 1]]) == pytest.approx(177_462, rel=1e-3)
    assert float(record.last[system.watched["speed", 0]]) == 0.0
    assert ledger(system, system.start(), record).residual < 1e-6


def test_p5_agrees_with_runge_kutta_steps() -> None:
    """Up to the brake, with the softest gear."""
    course = hybrid.Course.constant(-WEIGHT)

    def motor(position: float, speed: float) -> float:
        slip = 1 - speed / SYNCHRONOUS
        return 2 * BREAKDOWN * slip * SLIP / (slip**2 + SLIP**2)

    train = hoist(STIFFNESSES[0], Counted())
    gear, rope = (
        hybrid.Link(one.first, one.second, one.stiffness, one.damping, one.play, one.law, one.side)
        for one in train.springs[:2]
    )
    machine = hybrid.Machine(
        (MOTOR, DRUM, HOISTED),
        (0.0,) * 3,
        (0.0,) * 3,
        (gear, rope),
        (),
        (),
        (hybrid.Torque(0, over=motor), hybrid.Torque(2, course)),
    )
    lift = next(event.time for event in played(train, 1.0, 1e-10)[1].events if event.element == "ground")
    held = replace(machine, torques=machine.torques[:1], inertias=(MOTOR, DRUM, 1e18))  # the ground, until it lifts off
    history = hybrid.simulate(held, lift)
    assert history.highest["link", 1] == pytest.approx(WEIGHT, rel=1e-6)
    system, record = played(train, lift, 1e-10)
    peak = float(record.top.values[system.watched["link", 0]])
    assert peak == pytest.approx(history.highest["link", 0], rel=1e-6)


# -- against general solvers, in one run -----------------------------------------------------------------------------


def general(stiffness: float, method: str, rtol: float) -> float:
    """P5 to the brake by one of scipy's solvers, which starts again at every event; the rope's largest force."""
    train = hoist(stiffness, Counted())
    curve = Counted()
    gear, rope = train.springs[0], train.springs[1]

    def contact(spring: Spring, x: float, v: float) -> float:
        side = np.sign(x) if spring.side == 0 else 1.0
        depth, closing = side * x - spring.play / 2, side * v
        if depth <= 0:
            return 0.0
        pull = spring.stiffness * depth
        return float(side * (pull + min(max(spring.damping * closing, -pull), pull)))

    def forces(y: np.ndarray) -> tuple[float, float]:
        return contact(gear, y[0] - y[1], y[3] - y[4]), contact(rope, y[1] - y[2], y[4] - y[5])

    lifted = False

    def rates(t: float, y: np.ndarray) -> list[float]:
        g, r = forces(y)
        load = (r - WEIGHT) / HOISTED if lifted else 0.0
        motor = float(curve.value(np.array([y[3]]))[0])
        return [y[3], y[4], y[5], (motor - g) / MOTOR, (g - r) / DRUM, load]

    events = [
        lambda t, y: abs(y[0] - y[1]) - PLAY / 2,
        lambda t, y: y[1] - y[2] - SLACK,
        lambda t, y: 1.0 if lifted else forces(y)[1] - WEIGHT,
    ]
    for event in events:
        event.terminal = True  # type: ignore[attr-defined]
    now, y, peak = 0.0, np.zeros(6), 0.0
    while now < OFF:
        run = solve_ivp(rates, (now, OFF), y, method=method, rtol=rtol, atol=1e-3 * rtol, events=events)
        peak = max([peak, *(forces(state)[1] for state in run.y.T)])
        lifted = lifted or (run.status == 1 and len(run.t_events[2]) > 0)
        moved = 1e-9 if run.status == 1 else 0.0
        now, y = float(run.t[-1]) + moved, run.y[:, -1] + moved * np.array(rates(run.t[-1], run.y[:, -1]))
    return peak


def test_p5_beside_general_solvers(request: pytest.FixtureRequest) -> None:
    """The peak agrees; the table of seconds is printed only where benchmarks are asked for.

    A solver whose own search for an event breaks down (LSODA with a stiff gear) is shown so, not judged.
    """
    timed = bool(request.config.getoption("--benchmark-enable", default=False))
    clock: Callable[[], float] = time.process_time if timed else lambda: 0.0
    rows, agreed = [], 0

    def least(name: str, work: Callable[[], object]) -> None:
        """A row with the shortest of many repeats."""
        spans = []
        for _ in range(REPEATS if timed else 1):
            start = clock()
            work()
            spans.append(clock() - start)
        rows.append(f"{name:<32} {1e3 * min(spans):9.1f} ms")

    least("unit: RK45, x'' = -x, 100 rad", lambda: solve_ivp(lambda t, y: [y[1], -y[0]], (0, 100), [1, 0], rtol=1e-6))
    least("P4, 29 events        exact", lambda: played(P4, END, 1e-10))
    for stiffness in STIFFNESSES if timed else STIFFNESSES[:1]:
        whole = partial(counted, stiffness, P5_END)
        least(f"P5 gear {stiffness:.0e} N/m, whole  exact", whole)
        system, record = played(hoist(stiffness, Counted()), OFF, 1e-6)
        least(f"P5 gear {stiffness:.0e} N/m    exact", partial(played, hoist(stiffness, Counted()), OFF, 1e-6))
        peak = float(record.top.values[system.watched["link", 1]])
        for method in ("RK45", "DOP853", "LSODA", "Radau") if timed else ("DOP853",):
            start = clock()
            try:
                found = general(stiffness, method, 1e-6)
            except ValueError:
                rows.append(f"P5 gear {stiffness:.0e} N/m  {method:>7}  finds no root of an event")
                continue
            rows.append(f"{f'P5 gear {stiffness:.0e} N/m  {method:>7}':<32} {1e3 * (clock() - start):9.1f} ms")
            assert found == pytest.approx(peak, rel=1e-3), method
            agreed += 1
    assert agreed > 0
    if timed:
        print("", *rows, sep="\n")
