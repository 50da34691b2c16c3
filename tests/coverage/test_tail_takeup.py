"""A take-up weight at the tail: bars of the belt in cells hold masses and springs with a moving tail pulley."""

import math
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from support.belt_scenes import Drive, Rig
from support.machines import spec_of
from support.tail_takeup import Course, simulate

from ptmcalc.base.estimate import Estimate
from ptmcalc.machines.conveyor.running import statics
from ptmcalc.machines.conveyor.waves import network

EFFECTS = frozenset({"belt_wave", "tail_jump", "tail_mass", "slip", "coulomb_idlers", "takeup_mass"})
STARTS, STOPS, SEED, RISE = 8, 4, 20261127, 4.0
LOADS = ("tension_run_on_max", "tension_run_off_min", "tension_max", "tension_min", "takeup_movement")
MESH = 3e-4
"""So far 160 elements know tensions, relative to the largest [1]; the difference to 400 elements is at most 0.0003."""


@dataclass(frozen=True)
class Case:
    """A machine: what is claimed of each load, and what masses and springs find."""

    claims: dict[str, Estimate]
    found: dict[str, float]

    def ratio(self, name: str) -> float:
        """Distance from the claim as a part of its bar."""
        claim, size = self.claims[name], self.claims["tension_max"].value
        apart = abs(self.found[name] - claim.value)
        rounding = MESH * (size if name.startswith("tension") else claim.value)
        return max(apart - rounding, 0.0) / claim.bar


def drawn(seed: int) -> tuple[Rig, float]:
    """A conveyor on two slopes whose drive does not slip, and a force at its tail."""
    rng = np.random.default_rng([SEED, seed])
    length = float(rng.uniform(150, 600))
    lift = length * float(rng.uniform(-0.02, 0.08))
    drive = Drive(friction=0.45, wrap=3.9)
    rig = Rig(
        sections=((0.4 * length, 0.1 * lift), (0.6 * length, 0.9 * lift)),
        start_factor=1.2,
        tail_inertia=float(rng.uniform(0, 150)),
    )
    force = 1.7 * max(rig.resistance(factor=1.2), 20e3)
    drive = replace(drive, torque=drive.torque * force / drive.force)
    tension = 1.5 * force + 40e3
    return replace(rig, drives={"head": drive}, tension=tension, weight=2 * tension / rig.gravity), 3e3


def data_of(rig: Rig, at_tail: float, scene: dict[str, Any], **more: Any) -> dict[str, Any]:
    data = rig.data(scene, **more)
    data["takeup"]["at"] = "tail"
    data["resistance"] |= {"forces": {"chute": {"force": f"{at_tail} N", "at": "tail"}}, "stop_factor": 1}
    return data


def claims_of(data: dict[str, Any]) -> tuple[dict[str, Estimate], float]:
    spec = spec_of(data)
    found = network.run(spec, spec.all_scenes[0], EFFECTS, 0)
    assert found.window is not None
    return {name: found.loads[name].estimate for name in LOADS}, found.window[1]


def read(course: Course, upto: int | None = None) -> dict[str, float]:
    on, off, way = (part[:upto] for part in (course.on, course.off, course.carriage))
    found = float(on.max()), float(off.min()), course.highest, course.lowest, float(way.max() - way.min())
    return dict(zip(LOADS, found, strict=True))


@cache
def starts() -> tuple[Case, ...]:
    found = []
    for seed in range(STARTS):
        rig, at_tail = drawn(seed)
        profile = {"shape": "ramp", "control": "torque", "time": f"{RISE} s"}
        claims, window = claims_of(data_of(rig, at_tail, {"type": "start", "profile": profile}))
        force = rig.drives["head"].force

        def pull(time: float, force: float = force) -> float:
            return force * min(time / RISE, 1.0)

        course = simulate(rig, window, pull, rig.weight or 0.0, at_tail, factor=rig.start_factor)
        found.append(Case(claims, read(course)))
    return tuple(found)


@pytest.mark.parametrize("name", LOADS)
def test_the_bars_of_starts_hold_a_tail_pulley_that_moves(name: str) -> None:
    assert max(case.ratio(name) for case in starts()) < 1


def test_a_third_of_the_bars_does_not() -> None:
    assert max(case.ratio(name) for case in starts() for name in LOADS) > 1 / 3


@pytest.mark.parametrize("seed", range(STOPS))
def test_the_bars_of_braked_stops_hold_it(seed: int) -> None:
    """Until the head stands: friction that holds a belt at rest is not followed by the masses."""
    rig, at_tail = drawn(100 + seed)
    brake = {"b": {"torque": "8 kN*m", "delay": "0 s", "rise_time": "1 s"}}
    claims, window = claims_of(data_of(rig, at_tail, {"type": "stop"}, brakes=brake))

    def braked(time: float) -> float:
        return -8e3 * 2 / rig.drives["head"].diameter * min(time, 1.0)

    course = simulate(rig, window, braked, rig.weight or 0.0, at_tail, begins=rig.speed)
    still = int(np.argmax(course.speed <= 0)) or None
    case = Case(claims, read(course, still))
    assert all(case.ratio(name) < 1 for name in LOADS[:3])
    assert case.found["tension_run_off_min"] > claims["tension_run_off_min"].low
    assert math.isfinite(claims["tension_min"].bar)


def test_static_tensions_at_the_tail() -> None:
    """Both sides of the tail pulley pull at the carriage; T2 at the head is less by the return strand."""
    rig, at_tail = drawn(0)
    spec = spec_of(data_of(rig, at_tail, {"type": "run"}))
    loads = statics.run(spec, spec.all_scenes[0], frozenset(), 0).loads
    found = {name: one.estimate.value for name, one in loads.items()}
    lengths = rig.lengths()
    back = sum(one.length * (one.friction + one.climb) for one in lengths[:2])
    off = rig.tension - at_tail / 2 - back
    assert found["tension_run_off_min"] == pytest.approx(off, rel=1e-12)
    assert found["tension_run_on_max"] == pytest.approx(off + rig.resistance() + at_tail, rel=1e-12)
    grip = math.exp(0.45 * 3.9)
    pull = rig.resistance() + at_tail
    assert found["slip_reserve_min"] == pytest.approx(off * (grip - 1) / pull, rel=1e-9)
