"""Stops in which the belt slips on its braked pulley: error bars hold the same scene in 16 times the cells.

Such a stop is sensitive: the mean speed falls slowly and swings, so that a small change makes the first standstill one
swing earlier or later. Grids that agree say nothing of that.
"""

import math
from functools import cache
from random import Random
from typing import Any

import pytest
import yaml
from support.command import ROOT
from support.machines import report_of, spec_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import Estimate
from ptmcalc.machines.conveyor.machine.loads import OF_STOP
from ptmcalc.machines.conveyor.machine.motion import moving
from ptmcalc.machines.conveyor.waves import cell_runs, network

EFFECTS = frozenset({"belt_wave", "tail_jump", "tail_mass", "slip", "coulomb_idlers"})
FILES = ("decline-slips", "emergency-way")
FINER = 16


def decline(seed: int) -> dict[str, Any]:
    """A random decline conveyor under its brakes."""
    random = Random(seed)
    data: dict[str, Any] = yaml.safe_load(
        (ROOT / f"tests/edges/conveyor/{random.choice(FILES)}.yaml").read_text(encoding="utf-8")
    )
    data["resistance"] |= {"coefficient": random.uniform(0.016, 0.032), "secondary": random.uniform(1.1, 1.4)}
    length, tension = random.uniform(150, 700), random.uniform(30, 150)
    data["route"] = {"length": f"{length} m", "lift": f"{-length * random.uniform(0.03, 0.11)} m"}
    data["drive"]["drum"]["friction"] = random.uniform(0.15, 0.4)
    data["takeup"] = {"type": random.choice(("gravity", "rigid")), "tension": f"{tension} kN"}
    if data["takeup"]["type"] == "gravity":
        data["takeup"]["mass"] = f"{2000 * tension / 9.81} kg"
    data["scenes"] = data["scenes"][1:]
    return data


@cache
def stopped(seed: int) -> tuple[dict[str, Estimate], dict[str, float]] | None:
    """Loads of a stop with their error bars, and from the finer grid; None where no pulley slips or none comes to rest
    in the computed window."""
    data = decline(seed)
    carried = EFFECTS | ({"takeup_mass"} if "mass" in data["takeup"] else set())
    spec = spec_of(data)
    (scene,) = spec.all_scenes
    case, cells = moving(spec, scene), FINER * cell_runs.grids_of(scene, 0)[0]
    try:
        loads = {name: one.estimate for name, one in network.run(spec, scene, carried, 0).loads.items()}
        if loads["slip_utilisation_max"].value < 1 or not math.isfinite(loads["stop_time"].high):
            return None
        fine = cell_runs.marched(case, carried, cells, True, cells).values
    except (NumericsError, cell_runs.GripLostError):
        return None
    finer = {name: fine[name][0] for name in OF_STOP & fine.keys()}
    return (loads, finer) if all(map(math.isfinite, finer.values())) else None


def outside(seed: int) -> list[str]:
    """Loads of a stop that the finer grid has outside of their error bars."""
    if (found := stopped(seed)) is None:
        return []
    loads, fine = found
    return [
        f"{seed}: {name} {value}, {loads[name]}"
        for name, value in fine.items()
        if not loads[name].low <= value <= loads[name].high
    ]


@pytest.mark.parametrize("seed", [1568])
def test_stops_whose_grids_agree_by_chance(seed: int) -> None:
    """Without the swing at rest in the bar, these were outside."""
    assert outside(seed) == []


def test_random_stops() -> None:
    found = [stopped(seed) for seed in range(40)]
    assert sum(one is not None for one in found) >= 10
    assert [one for seed in range(40) for one in outside(seed)] == []


@pytest.mark.parametrize("seed", [16, 43])
def test_a_belt_that_surely_slips_fails_whatever_its_gear_losses(seed: int) -> None:
    """15 m and 550 m of slip: a bar of rounding left the traction reserve of the first as 0.78 to 1.27."""
    for one in report_of(decline(seed)).judgements:
        if one[1].code == "CNV101":
            assert one[1].verdict is Verdict.FAIL


def test_a_stop_has_no_negative_time_or_distance() -> None:
    for seed in range(40):
        loads, _ = stopped(seed) or ({}, {})
        assert all(loads[name].low >= 0 for name in OF_STOP & loads.keys())


@pytest.mark.study
def test_a_thousand_random_stops() -> None:
    assert [one for seed in range(2000, 3000) for one in outside(seed)] == []
