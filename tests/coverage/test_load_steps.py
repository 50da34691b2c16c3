"""Starts and stops of random conveyors with several loading points: no run with fewer effects contradicts the run with
all of them."""

import numpy as np
import pytest
from support.belt_scenes import Brake, Drive
from support.loading_points import Point, PointedRig
from support.machines import spec_of

from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.registry import load_kind
from ptmcalc.engine.run import settle
from ptmcalc.machines.conveyor.machine.spec import Conveyor

KIND = load_kind("conveyor")
SEED, MACHINES = 77, 18
ABSENT = ("belt_damping", "gear_losses")


def machine(index: int) -> Conveyor:
    rng = np.random.default_rng((SEED, index))
    lengths = rng.uniform(100, 500, int(rng.integers(1, 4))).tolist()
    speed = float(rng.uniform(1.5, 4))
    points = []
    for number in range(int(rng.integers(2, 5))):
        at = 0.0 if number == 0 and rng.random() < 0.5 else float(rng.uniform(0, 0.95)) * sum(lengths)
        points.append(Point(at, float(rng.uniform(20, 120)), float(rng.uniform(0, speed))))
    rig = PointedRig(
        sections=tuple((length, length * float(rng.uniform(-0.04, 0.1))) for length in lengths),
        points=tuple(points),
        speed=speed,
        belt=float(rng.uniform(12, 30)),
        stiffness=float(10 ** rng.uniform(6.8, 8.3)),
        tension=float(rng.uniform(60e3, 160e3)),
        rigid=bool(rng.integers(2)),
        start_factor=1.2,
    )
    force = max(abs(rig.resistance("full", 1.2)), 2e4) * float(rng.uniform(1.3, 1.8))
    drive = Drive(torque=force * 0.5 / 20 / 0.94)
    brake = Brake(float(rng.uniform(5e3, 2e4)), 0.3, 1.0)
    rig = PointedRig(**{**vars(rig), "drives": {"head": drive}, "brakes": (brake,)})
    shape, time = ("ramp", "cosine")[index % 2], f"{rng.uniform(2, 20)!r} s"
    started = {
        "type": "start",
        "profile": {"shape": shape, "control": ("speed", "torque")[index % 4 // 2], "time": time},
    }
    scene = {"type": "stop"} if index % 3 == 1 else started
    data = rig.data(scene)
    data["idlers"]["carry"]["pitch"], data["idlers"]["return"]["pitch"] = "1.2 m", "3 m"
    del data["effects"]
    return spec_of(data)


@pytest.mark.parametrize("index", range(MACHINES))
def test_every_interval_meets_that_of_the_run_with_all_effects(index: int) -> None:
    spec = machine(index)
    always = spec.model_copy(update={"effects": {one.name: "on" for one in KIND.effects if one.name not in ABSENT}})
    (scene,) = spec.all_scenes
    planned = settle(KIND, spec, plan_scene(KIND, spec, scene)).estimates
    exact = settle(KIND, always, plan_scene(KIND, always, scene)).estimates
    assert "tension_max" in planned.keys() & exact.keys()
    for name in planned.keys() & exact.keys():
        one, other = planned[name], exact[name]
        slack = 1e-9 * abs(one.value)
        assert one.low - slack <= other.high, name
        assert other.low <= one.high + slack, name
