"""A drive whose teeth let a spring and a mass run ahead, against scipy in the coordinates of both masses."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics import driven_modes
from ptmcalc.numerics.driven_body import Body, Followed, Gear, Places, Plan
from ptmcalc.numerics.toothed_modes import Teeth, follow

DRIVE, LOAD, STIFFNESS, ZETA = 120.0, 250.0, 4e4, 0.06
MASS = DRIVE + LOAD
W = math.sqrt(STIFFNESS * MASS / DRIVE / LOAD)
DAMPING = 2 * ZETA * STIFFNESS / W
PITCH, COUNT = 0.1, 7
HALF, RADIUS = math.pi / COUNT, PITCH / (2 * math.sin(math.pi / COUNT))
BODY = Body(MASS, np.array([W]), np.array([ZETA]), np.array([1 / DRIVE - 1 / MASS]), 0.0)
PLACES = Places(np.array([[LOAD / MASS]]), np.array([LOAD / MASS]), np.zeros(1), np.full(1, MASS))
PLAN = Plan(0.0, 1e-3, 1.0, 1e-2, 1, latest=3.0)


@dataclass(frozen=True)
class Pull:
    """A force that falls in a straight line with the speed; a second line from a speed on."""

    lines: tuple[tuple[float, float], ...] = ((900.0, 1100.0),)
    switch: float = math.inf
    kinks: tuple[float, ...] = ()

    def force(self, stage: int, time: float, speed: float) -> tuple[float, float]:
        first, slope = self.lines[stage]
        return first - slope * speed + sum(400.0 * min(time, kink) for kink in self.kinks), -slope

    def until(self, stage: int) -> tuple[float, float]:
        return (self.switch if stage == 0 else math.inf), math.inf

    def steepest(self, stage: int) -> float:
        return abs(self.lines[stage][1])

    def to_come(self, time: float) -> float:
        return 0.0


def ahead(place: float) -> tuple[float, float, float]:
    angle, turn = 2 * HALF * place, 2 * HALF / PITCH
    return (
        RADIUS * math.sin(angle) - PITCH * place,
        RADIUS * turn * math.cos(angle) - 1,
        -RADIUS * turn**2 * math.sin(angle),
    )


def level(place: float) -> tuple[float, float, float]:
    return 0.0, 0.0, 0.0


def teeth(lead: float, way: Callable[[float], tuple[float, float, float]] = ahead) -> Teeth:
    return Teeth(DRIVE, PITCH, lead, way)


def by_scipy(pull: Pull, gear: Gear, lead: float, end: float) -> tuple[float, float, float]:
    """Largest and smallest force of the spring, and the last speed of the drive: the drive turns, the point on it runs
    ahead, the spring pulls the load. Each tooth and each stage is a piece of its own."""
    first = ahead(lead - 0.5)[0]

    def parts(t: float, y: np.ndarray, stage: int, tooth: int) -> tuple[float, float]:
        travel, load, speed, load_speed = y
        by, slope, _ = ahead(travel / PITCH + lead - tooth - 0.5)
        spring = STIFFNESS * (travel + by - first - load) + DAMPING * (speed * (1 + slope) - load_speed)
        net = pull.force(stage, t, speed)[0]
        through = gear.static + net - gear.mass * (net - spring) / DRIVE
        if gear.more(through):  # net = F + c (G_0 + net - m_g (net - spring)/m_d)
            rest = gear.extra * (gear.static + gear.mass * spring / DRIVE)
            net = (net + rest) / (1 - gear.extra * (1 - gear.mass / DRIVE))
        return net, spring

    def rates(t: float, y: np.ndarray, stage: int, tooth: int) -> list[float]:
        net, spring = parts(t, y, stage, tooth)
        return [y[2], y[3], (net - spring) / DRIVE, spring / LOAD]

    def engaged(t: float, y: np.ndarray, stage: int, tooth: int) -> float:
        return float(y[0] / PITCH + lead - tooth - 1)

    def switched(t: float, y: np.ndarray, stage: int, tooth: int) -> float:
        return float(y[2] - pull.switch) if stage == 0 and math.isfinite(pull.switch) else -1.0

    for one in (engaged, switched):
        one.terminal, one.direction = True, 1  # type: ignore[attr-defined]
    now, state, stage, tooth = 0.0, np.zeros(4), 0, 0
    most, least = 0.0, 0.0
    while now < end - 1e-9:
        goal = min(one for one in (*pull.kinks, end) if one > now + 1e-9)
        run = solve_ivp(
            rates,
            (now, goal),
            state,
            args=(stage, tooth),
            events=(engaged, switched),
            rtol=1e-9,
            atol=1e-11,
            max_step=2e-3,
        )
        forces = [parts(t, y, stage, tooth)[1] for t, y in zip(run.t, run.y.T, strict=True)]
        most, least = max(most, *forces), min(least, *forces)
        now, state = float(run.t[-1]), run.y[:, -1]
        if run.status == 1:
            tooth, stage = tooth + bool(len(run.t_events[0])), stage + bool(len(run.t_events[1]))
    return most, least, float(state[2])


CASES = {
    "line": (Pull(), Gear()),
    "constant": (Pull(((150.0, 0.0),)), Gear()),
    "steep": (Pull(((3000.0, 9000.0),)), Gear()),
    "switch": (Pull(((500.0, 300.0), (1500.0, 2000.0)), 0.25), Gear()),
    "kink": (Pull(kinks=(0.4,)), Gear()),
    "losses": (Pull(), Gear(60.0, 20.0, 0.2)),
    "losses back": (Pull(), Gear(60.0, -20.0, -0.3)),
}


def march(name: str, lead: float, **changes: float) -> Followed:
    pull, gear = CASES[name]
    return follow(BODY, gear, pull, PLACES, replace(PLAN, **changes), teeth(lead))


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("lead", [0.0, 0.37])
def test_extremes_are_those_of_an_integration(name: str, lead: float) -> None:
    found = march(name, lead)
    most, least, speed = by_scipy(*CASES[name], lead, PLAN.latest)
    slack = 3e-4 * (most - least)
    assert found.end == PLAN.latest
    assert found.largest[0] == pytest.approx(most, abs=slack)
    assert found.smallest[0] == pytest.approx(least, abs=slack)
    assert found.speeds[-1] == pytest.approx(speed, rel=1e-4)


def test_the_error_falls_with_the_square_of_the_step() -> None:
    _, _, speed = by_scipy(*CASES["steep"], 0.37, 0.5)
    errors = [abs(march("steep", 0.37, latest=0.5, step=step, response=9.0).speeds[-1] - speed) for step in STEPS]
    assert errors[0] > 2.5 * errors[1]
    assert errors[1] > 2.5 * errors[2]


STEPS = 8e-3, 4e-3, 2e-3


def test_teeth_excite_what_is_smooth_without_them() -> None:
    assert march("line", 0.0).largest[0] > 1.005 * smooth().largest[0]


def test_without_a_polygon_the_march_is_that_of_the_plain_modes() -> None:
    pull, gear = CASES["line"]
    found, plain = follow(BODY, gear, pull, PLACES, PLAN, teeth(0.3, level)), smooth()
    assert found.largest[0] == pytest.approx(plain.largest[0], rel=1e-5)
    assert found.smallest[0] == pytest.approx(plain.smallest[0], abs=1e-5 * plain.largest[0])


def smooth() -> Followed:
    pull, gear = CASES["line"]
    return driven_modes.follow(BODY, gear, pull, PLACES, replace(PLAN, longer=1.0))


def test_nothing_bounds_what_teeth_do_after_the_end() -> None:
    found = march("line", 0.0)
    assert math.isinf(found.after[0])
    assert not found.steady


def test_too_many_steps_are_reported() -> None:
    with pytest.raises(NumericsError, match="steps up to"):
        march("line", 0.0, most=50)
