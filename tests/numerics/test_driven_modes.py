"""A body with modes under a force that depends on its speed, against scipy and by hand."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.driven_body import Body, Followed, Gear, Places, Plan
from ptmcalc.numerics.driven_modes import follow

MASS, W, ZETA, SHARES = 400.0, np.array([9.0, 31.0]), np.array([0.03, 0.2]), np.array([3e-3, 1e-3])


@dataclass(frozen=True)
class Pull:
    """Stages of a force that falls in a straight line with the speed, with a rise over time."""

    lines: tuple[tuple[float, float], ...] = ((300.0, 100.0),)
    switches: tuple[float, ...] = ()
    kinks: tuple[float, ...] = ()

    def force(self, stage: int, time: float, speed: float) -> tuple[float, float]:
        first, slope = self.lines[stage]
        return first - slope * speed + sum(160.0 * min(time, kink) for kink in self.kinks), -slope

    def until(self, stage: int) -> tuple[float, float]:
        return (self.switches[stage] if stage < len(self.switches) else math.inf), math.inf

    def steepest(self, stage: int) -> float:
        return abs(self.lines[stage][1])

    def to_come(self, time: float) -> float:
        return math.inf if self.kinks and time < self.kinks[-1] else 0.0


BODY = Body(MASS, W, ZETA, SHARES, 0.0)
PLACES = Places(np.array([[0.2, 0.1], [0.05, -0.1]]), np.array([0.3, 0.0]), np.zeros(2), np.full(2, MASS))
PLAN = Plan(0.0, 4e-3, 1.0, 1e-2, 2)


def by_scipy(pull: Pull, gear: Gear, end: float) -> tuple[np.ndarray, np.ndarray]:
    """Largest and smallest values of the places."""

    def net(t: float, y: np.ndarray, stage: int) -> float:
        speed = y[0] + SHARES @ y[3:5]
        f = pull.force(stage, t, speed)[0]
        held = float(SHARES @ (2 * ZETA * W * y[3:5] + W**2 * y[1:3]))
        light = 1 / MASS + SHARES.sum()
        through = gear.static + f - gear.mass * (light * f - held)
        if gear.more(through):  # f = F + c (G_0 + f (1 - m light) + m held)
            f = (f + gear.extra * (gear.static + gear.mass * held)) / (1 - gear.extra * (1 - gear.mass * light))
        return f

    def rates(t: float, y: np.ndarray, stage: int) -> np.ndarray:
        f = net(t, y, stage)
        return np.concatenate([[f / MASS], y[3:5], f - 2 * ZETA * W * y[3:5] - W**2 * y[1:3]])

    seen, now, state, stage = [np.zeros(2)], 0.0, np.zeros(5), 0
    stops = [*pull.kinks, end]
    while now < end - 1e-9:

        def switched(t: float, y: np.ndarray, stage: int) -> float:
            return float(y[0] + SHARES @ y[3:5] - pull.until(stage)[0]) if stage < len(pull.switches) else -1.0

        switched.terminal, switched.direction = True, 1  # type: ignore[attr-defined]
        goal = min(one for one in stops if one > now + 1e-9)
        run = solve_ivp(rates, (now, goal), state, args=(stage,), events=switched, rtol=1e-7, atol=1e-11, max_step=5e-3)
        for t, y in zip(run.t[:-1] if run.status == 1 else run.t, run.y.T, strict=False):
            f = net(t, y, stage)
            bent = f - 2 * ZETA * W * y[3:5] - W**2 * y[1:3]
            seen.append(PLACES.whole * f - bent @ PLACES.gains)
        now, state, stage = float(run.t[-1]), run.y[:, -1], stage + (run.status == 1)
    return np.max(seen, axis=0), np.min(seen, axis=0)


CASES = {
    "line": (Pull(), Gear()),
    "switch": (Pull(((150.0, 30.0), (500.0, 150.0)), (2.0,)), Gear()),
    "kink": (Pull(kinks=(0.25,)), Gear()),
    "losses": (Pull(), Gear(60.0, 20.0, 0.2)),
    "losses back": (Pull(((300.0, 100.0),)), Gear(60.0, -20.0, -0.3)),
}


def march(name: str, **changes: float) -> Followed:
    pull, gear = CASES[name]
    return follow(BODY, gear, pull, PLACES, replace(PLAN, **changes))


@pytest.mark.parametrize("name", CASES)
def test_extremes_are_those_of_an_integration(name: str) -> None:
    found = march(name)
    assert found.steady
    top, bottom = by_scipy(*CASES[name], 1.5 * found.end)
    slack = 2e-3 * np.max(top - bottom)
    for low, value, high in (
        (found.largest_low, top, found.largest_high),
        (found.smallest_low, bottom, found.smallest_high),
    ):
        bounds = np.maximum(found.after, 0.0)
        assert np.all(low - slack <= value)
        assert np.all(value <= np.maximum(high, bounds) + slack)
    assert found.largest == pytest.approx(top, abs=slack)
    assert found.smallest == pytest.approx(bottom, abs=slack)


@pytest.mark.parametrize("name", ["line", "kink"])
def test_the_error_of_the_step_is_of_second_order(name: str) -> None:
    ends = [march(name, step=0.5**k, response=math.inf, latest=1.0) for k in (6, 7, 8, 9)]
    speeds = [float(np.interp(0.5, one.times, one.speeds)) for one in ends]
    first, second, third = np.abs(np.diff(speeds))
    assert 3 <= first / second <= 5.5
    assert 3 <= second / third <= 5.5


def test_what_follows_the_end_is_bounded() -> None:
    early = march("line", latest=0.5)
    late = march("line")
    assert not early.steady
    assert np.all(late.largest <= np.maximum(early.largest_high, early.after))
    assert np.all(late.smallest >= np.minimum(early.smallest_low, -early.after))


def test_a_torque_that_rises_with_the_speed_has_no_bound_behind_the_end() -> None:
    found = follow(BODY, Gear(), Pull(((10.0, -5.0),)), PLACES, replace(PLAN, latest=0.2))
    assert np.all(np.isinf(found.after))


def test_too_many_steps_end_with_a_finding() -> None:
    with pytest.raises(NumericsError, match="steps"):
        follow(BODY, Gear(), Pull(((10.0, -5.0),)), PLACES, replace(PLAN, most=1000))
