"""A lift with taut ropes by a gear with play, from a motor that runs free: drum and motor turn alike, the flank touches
and closes as the rope slows the drum down. Reference: DOP853 on both, the load on the ground."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.hoist_gear import Geared, random_geared
from support.machines import report_of

WITH_PLAY = [seed for seed in range(40) if random_geared(np.random.default_rng(seed))[0].play][:8]


def lifted(one: Geared, free_speed: float) -> tuple[float, float]:
    """When the rope carries the weight, and how fast it is hauled then."""

    def rates(_: float, y: np.ndarray) -> list[float]:
        twist, rate = y[0] - y[1], y[2] - y[3]
        deep = one.torsion * max(twist, 0.0)
        gear = deep + min(max(one.dashpot * rate, -deep), deep)
        torque = one.starting * one.ratio * (1 - y[2] * one.ratio / free_speed)
        return [y[2], y[3], (torque - gear) / one.motor, (gear - one.stiffness * one.arm**2 * y[1]) / one.drum]

    def carried(_: float, y: np.ndarray) -> float:
        return float(one.stiffness * one.arm * y[1] - one.weight)

    carried.terminal = True  # type: ignore[attr-defined]
    start = [0.0, 0.0, free_speed / one.ratio, free_speed / one.ratio]
    run: Any = solve_ivp(rates, (0, 60), start, "DOP853", rtol=1e-11, atol=1e-13, events=carried)
    assert len(run.t_events[0]) == 1
    return float(run.t[-1]), float(one.arm * run.y[3, -1])


@pytest.mark.parametrize("seed", WITH_PLAY)
def test_the_flank_that_touches_stays_closed(seed: int) -> None:
    one, data = random_geared(np.random.default_rng(seed))
    data["gearbox"]["efficiency"] = 1
    data["scenes"] = [{"type": "lift", "profile": {"shape": "curve"}}]
    (scene,) = report_of(data).scenes
    time, speed = lifted(one, 100.0)
    loads = {load.info.name: load.estimate for load in scene.loads}
    assert loads["lift_off_time"].value == pytest.approx(time, rel=1e-7)
    assert loads["lift_off_speed"].value == pytest.approx(speed, rel=1e-7)
    assert not [event for event in scene.events if event.time < time * (1 - 1e-9) and "gear" in event.element]
    assert math.isfinite(loads["lift_off_speed"].bar)
