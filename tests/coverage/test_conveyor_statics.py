"""Closed forms of a conveyor that runs, stands, or comes to rest as one body, against sums of forces of their own.

They claim no bar but rounding: what they say is what the reference finds, and no verdict of the ladder is another. The
coefficient that a run-out tells is the one its way was made with.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from support.bars import Limit, Trial, claim, known_to, misses, near, numbers, opposites, tried, verdicts
from support.conveyor_statics import Statics, drawn
from support.machines import loaded

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.solver import AnySolver
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.conveyor.holding.solver import HOLDING
from ptmcalc.machines.conveyor.running.statics import STATICS
from ptmcalc.machines.conveyor.stopping.formulas import BRAKING, IDENTIFY
from ptmcalc.spec.machine import MachineSpec

WITHOUT_BARS = {"conveyor": ("statics", "brake_statics", "holding", "run_out", "gear_losses")}
KIND = load_kind("conveyor")
SEED, ALWAYS = 1913, 60
REFERENCE = 1e-9
CLIMBED = 40
"""Every so many a stop is simulated with its belt, whose loads are not on trial here."""
WAYS: dict[str, AnySolver] = {
    "run": STATICS,
    "stop": BRAKING,
    "emergency_stop": BRAKING,
    "backstop": HOLDING,
    "coast": IDENTIFY,
}
"""By scene."""


def _brake(spec: Any, value: float) -> MachineSpec:
    """The drum brake whose torque is asked for: that of the drum it acts on."""
    last = [drive for drive in spec.all_drives.values() if drive.at == "head"][-1]
    share = last.drum.diameter / spec.main_drive.drum.diameter
    changed: MachineSpec = spec.with_value(("brakes", "b0", "torque"), value * share)
    return changed


LIMITS = {
    "run": (
        Limit("slip_reserve_min", ("checks", "slip", "reserve"), 0.01),
        Limit("sag_relative_max", ("checks", "sag"), 1e-4, 0.2),
        Limit("takeup_travel", ("takeup", "stroke"), 1e-3),
    ),
    "stop": (Limit("brake_torque_required", _brake, 1.0),),
    "emergency_stop": (Limit("brake_torque_required", _brake, 1.0),),
    "backstop": (Limit("backstop_torque", ("backstop", "torque"), 1.0),),
    "coast": (),
}
JUDGED = {
    "run": ("CNV101", "CNV102", "CNV103", "CNV105", "CNV110"),
    "stop": ("CNV108",),
    "emergency_stop": ("CNV108",),
    "backstop": ("CNV109",),
}


def _truth(machine: Statics) -> dict[str, Callable[[], dict[str, float]]]:
    return {
        "run": machine.run,
        "stop": lambda: machine.stop(machine.way),
        "emergency_stop": lambda: machine.stop(0.7 * machine.way),
        "backstop": machine.hold,
        "coast": lambda: {"resistance_coefficient_identified": machine.coefficient},
    }


def trials_of(index: int) -> dict[str, Trial]:
    rng = np.random.default_rng((SEED, index))
    machine, found = drawn(rng), {}
    for data in (machine.running(), machine.standing()):
        spec = loaded(data).spec
        assert spec is not None
        for scene in spec.all_scenes:
            truth = {name: known_to(REFERENCE, value) for name, value in _truth(machine)[scene.type]().items()}
            claims = {scene.type: claim(KIND, spec, scene, WAYS[scene.type])}
            climbs = scene.type in ("run", "backstop") or index % CLIMBED == 0
            limits = LIMITS[scene.type]
            found[scene.type] = tried(index, rng, KIND, spec, scene, claims, truth, limits, climbs=climbs)
    return found


@pytest.fixture(scope="module", params=numbers(ALWAYS))
def machines(request: pytest.FixtureRequest) -> list[dict[str, Trial]]:
    return [trials_of(index) for index in request.param]


@pytest.mark.parametrize("scene", WAYS)
def test_what_is_claimed_is_what_the_reference_finds(machines: list[dict[str, Trial]], scene: str) -> None:
    trials = [machine[scene] for machine in machines]
    assert misses(trials, scene) == []
    for trial in trials:
        assert trial.claims[scene].keys() >= trial.truth.keys()


@pytest.mark.parametrize("scene", JUDGED)
def test_no_verdict_is_another(machines: list[dict[str, Trial]], scene: str) -> None:
    trials = [machine[scene] for machine in machines]
    assert opposites(trials) == []
    assert near(trials) >= (0.3 if scene == "backstop" else 0.4), "belts that do not run back ask for no torque"
    said = verdicts(trials, *JUDGED[scene])
    assert min(said.count(Verdict.PASS), said.count(Verdict.FAIL)) > 0.05 * len(said)
