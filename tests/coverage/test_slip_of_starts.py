"""Loads of the drive in a plain start, slip and its heat among them: their bars hold finer grids and finite elements.

Seeded random machines that all come near the limit of their drum's grip. The finite elements know neither waves nor
grids of this tool (`support.belt_fem`); their own error is what halving their elements changes.
"""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from support.belt_fem import Motion, simulate
from support.belt_scenes import Drive, Rig, loads_of
from support.machines import changed, spec_of

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Result, of
from ptmcalc.machines.conveyor.machine.loads import PER_DRIVE, SLIPS
from ptmcalc.machines.conveyor.machine.scenes import Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.waves import characteristics

TWINS = tuple(sorted(PER_DRIVE - SLIPS))
STRAIGHT = frozenset({"belt_wave", "tail_jump", "tail_mass", "slip"})
MACHINES, SAGGING, SEED = 20, 4, 20261122
ELEMENTS = 160
HEAVY = 1e10  # kg
MOST_CONTOURS = 14  # longer starts cost more and say no more
SHAPES = ("step", "ramp", "torque_ramp", "torque_cosine")
TOLD = sorted(of(name, "head") for name in PER_DRIVE - {"slip_reserve_min"})


@dataclass(frozen=True)
class Machine:
    """A machine near the limit of its grip, and the scene it starts in."""

    rig: Rig
    shape: str
    time: float

    def spec(self, **more: Any) -> Conveyor:
        profile = {"shape": self.shape.removeprefix("torque_")}
        if self.shape != "step":
            profile["time"] = f"{self.time!r} s"
        if self.shape.startswith("torque_"):
            profile["control"] = "torque"
        return spec_of(changed(self.rig.data({"type": "start", "profile": profile}), **more))

    def rise(self, time: float) -> float:
        x = min(time / self.time, 1.0) if self.shape != "step" else 1.0
        return (1 - math.cos(math.pi * x)) / 2 if self.shape.endswith("cosine") else x

    def elements(self, count: int, window: float) -> dict[str, float]:
        """Loads by finite elements."""
        return loads_of(self.rig, self._moved(count, window)).loads

    def _moved(self, count: int, window: float) -> Motion:
        if self.shape != "ramp":
            return self.rig.started(self.rise, window, count)
        lengths = self.rig.lengths(factor=self.rig.start_factor)
        plan = self.rig.plan(lengths)  # an imposed speed is that of a drum too heavy for any belt
        rate = self.rig.speed / self.time
        drum = replace(plan.head[0], mass=HEAVY, pull=lambda time, speed: HEAVY * rate * (time < self.time))
        return simulate(replace(plan, head=(drum,)), count, window, self.rig.running(lengths, count), 0.0)


def _drawn(rng: np.random.Generator) -> Machine:
    length, slope = float(rng.uniform(200, 1500)), float(rng.uniform(0.0, 0.08))
    friction, wrap = float(rng.uniform(0.15, 0.4)), float(rng.uniform(3.0, 4.0))
    rig = Rig(
        sections=((length, slope * length),),
        belt=float(rng.uniform(10, 30)),
        stiffness=float(rng.uniform(10e6, 100e6)),
        load=float(rng.uniform(20, 200)),
        friction=float(rng.uniform(0.015, 0.03)),
        speed=float(rng.uniform(1.5, 5.0)),
        rigid=bool(rng.random() < 0.4),
        tail_inertia=float(rng.choice([0.0, 50.0, 400.0])),
    )
    static = rig.resistance()
    drive = Drive(friction=friction, wrap=wrap, rotor=float(rng.uniform(2, 10)), drum=float(rng.uniform(50, 500)))
    force = static * float(rng.uniform(1.3, 2.2))
    drive = replace(drive, torque=drive.torque * force / drive.force)
    least = static / math.expm1(friction * wrap) * float(rng.uniform(1.1, 2.2))
    if rig.rigid:
        least += static * float(rng.uniform(0.45, 0.7))
    rig = replace(rig, drives={"head": drive}, tension=least)
    return Machine(rig, str(rng.choice(SHAPES)), rig.contour() * float(rng.uniform(0.5, 3.0)))


@dataclass(frozen=True)
class Case:
    """A machine, the coarsest run of the tool, and two references."""

    machine: Machine
    claimed: Result
    finer: Result
    coarse: dict[str, float]
    elements: dict[str, float]

    def claims(self) -> dict[str, Estimate]:
        return {name: self.claimed.loads[name].estimate for name in TOLD}


def drawn_cases(count: int, seed: int) -> list[Case]:
    rng = np.random.default_rng(seed)
    found: list[Case] = []
    while len(found) < count:
        machine = _drawn(rng)
        spec = machine.spec()
        (scene,) = spec.all_scenes
        assert isinstance(scene, Start)
        case = characteristics.start_case(spec, scene)
        static = case.line.run_on * math.exp(-(case.line.grip_exponent or 0.0))
        if case.window > MOST_CONTOURS * case.line.contour_time or static > 0.97 * case.line.run_off:
            continue
        claimed = characteristics.run(spec, scene, STRAIGHT, 0)
        if claimed.findings:
            continue  # slack, or backward: out of the range of the tool's strands
        assert claimed.window is not None
        coarse, fine = (machine.elements(n * ELEMENTS, claimed.window[1]) for n in (1, 2))
        found.append(Case(machine, claimed, characteristics.run(spec, scene, STRAIGHT, 3), coarse, fine))
    return found


@pytest.fixture(scope="module")
def cases() -> list[Case]:
    return drawn_cases(MACHINES, SEED)


def outside(claimed: Result, finer: Result) -> list[str]:
    """Loads of the drive that the finer grid has outside the claimed bars."""
    return [
        name
        for name in TOLD
        if not (claim := claimed.loads[name].estimate).low - 1e-9
        <= finer.loads[name].estimate.value
        <= claim.high + 1e-9
    ]


def test_the_sample_slips_and_sticks_under_both_takeups_and_all_shapes(cases: list[Case]) -> None:
    slips = [case.claims()["slip_distance[head]"].value > 0 for case in cases]
    assert 0.3 * MACHINES < sum(slips) < 0.8 * MACHINES
    assert {case.machine.shape for case in cases} == set(SHAPES)
    assert {case.machine.rig.rigid for case in cases} == {True, False}


def test_every_bar_holds_the_finer_grid(cases: list[Case]) -> None:
    assert {n: missed for n, case in enumerate(cases) if (missed := outside(case.claimed, case.finer))} == {}


def test_the_bars_of_slip_are_no_empty_claims(cases: list[Case]) -> None:
    """Where a drum slips for good, its bar is a few percent; where it surely sticks, slip is exactly 0."""
    for case in cases:
        way, used = (case.claims()[of(name, "head")] for name in ("slip_distance", "slip_utilisation_max"))
        if used.high < 1:
            assert (way.low, way.high) == (0.0, 0.0)
        elif way.value > 0.1:
            assert way.bar < 0.05 * way.value, way


def test_the_loads_of_the_only_drive_are_those_of_the_belt(cases: list[Case]) -> None:
    for case in cases:
        for name in TWINS:
            assert case.claimed.loads[of(name, "head")] == case.claimed.loads[name], name


def test_every_bar_of_a_sagging_belt_holds_the_finer_grid(cases: list[Case]) -> None:
    slipping = [case for case in cases if case.claims()["slip_distance[head]"].value > 0.1]
    slipped = 0
    for case in slipping[:SAGGING]:
        spec = case.machine.spec(idlers__carry__pitch="1.2 m", idlers__return__pitch="3 m")
        coarse, fine = (characteristics.run(spec, spec.all_scenes[0], STRAIGHT | {"sag"}, level) for level in (0, 2))
        assert outside(coarse, fine) == []
        slipped += fine.loads["slip_distance[head]"].estimate.low > 0
    assert slipped >= SAGGING / 2


def test_every_bar_holds_finite_elements(cases: list[Case]) -> None:
    """Up to the error of the elements: twice what halving them changes, and a hundredth for the corners they round."""
    missed = []
    for number, case in enumerate(cases):
        for name, claim in case.claims().items():
            exact, before = case.elements[name], case.coarse[name]
            own = 2 * abs(exact - before) + 0.01 * abs(exact)
            if name.startswith("slip_utilisation") and min(claim.value, exact) > 0.99:
                continue  # a slipping drum of elements is at its limit up to their own rounding
            if not claim.low - own <= exact <= claim.high + own:
                missed.append((number, name, claim, exact, before))
    assert missed == []
