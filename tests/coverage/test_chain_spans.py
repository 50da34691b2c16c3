"""Error bars of the transverse frequencies of free spans: the sag in service takes any value between its ends."""

import math
from typing import Any

import numpy as np
import pytest
from support.bars import (
    MACHINES,
    THIRD,
    Limit,
    Trial,
    claim,
    known_to,
    misses,
    near,
    numbers,
    opposites,
    tried,
    verdicts,
    wide,
    widest,
)
from support.chains import ROLLER
from support.machines import changed, loaded

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.chain_drive.spans.frequencies import SPAN_FREQUENCIES

ON_TRIAL = {"chain_drive": ("span_frequencies",)}
KIND = load_kind("chain_drive")
WAY = SPAN_FREQUENCIES.name
SEED, REFERENCE = 606, 1e-6
BAND = ("checks", "span_resonance", "band")
LIMITS = tuple(Limit(f"span_separation_{name}", BAND, 0.01, 0.9) for name in ("slack", "tight"))


def drive(rng: np.random.Generator) -> dict[str, Any]:
    sag = float(rng.uniform(0.012, 0.025))
    return changed(
        ROLLER,
        layout__slack_sag=sag,
        layout__slack_sag_least=sag * float(rng.uniform(0.5, 1.0)),
        layout__slack_sag_most=sag * float(rng.uniform(1.0, 1.6)),
        layout__centre_distance=f"{rng.uniform(0.8, 2.0)} m",
        layout__power=f"{rng.uniform(1.0, 12.0)} kW",
        speed=f"{rng.uniform(0.5, 6.0)} m/s",
        sprocket__teeth=int(rng.integers(17, 30)),
        checks={"span_resonance": {"modes": int(rng.integers(1, 5))}},
    )


def loads(data: dict[str, Any], sag: float) -> dict[str, float]:
    """First frequency and separation of both spans at a sag, from the travel of a wave there and back."""
    teeth, driven = data["sprocket"]["teeth"], data["layout"]["driven"]["teeth"]
    pitch, mass, speed = 25.4e-3, 5.4, float(data["speed"].split()[0])
    radii = [pitch / 2 / math.sin(math.pi / z) for z in (teeth, driven)]
    distance = float(data["layout"]["centre_distance"].split()[0])
    length = math.sqrt(distance**2 - (radii[1] - radii[0]) ** 2)
    pull = float(data["layout"]["power"].split()[0]) * 1e3 / speed
    rates = [speed / pitch, speed / pitch / teeth, speed / pitch / driven]
    found = {}
    for name, more in (("slack", 0.0), ("tight", pull)):
        force = mass * 9.81 * length / (8 * sag) + more + mass * speed**2
        wave = math.sqrt(force / mass)
        first = 1 / (length / (wave + speed) + length / (wave - speed))
        found[f"span_frequency_{name}"] = first
        modes = range(1, data["checks"]["span_resonance"]["modes"] + 1)
        found[f"span_separation_{name}"] = min(abs(rate / (k * first) - 1) for rate in rates for k in modes)
    return found


def trial_of(index: int) -> Trial:
    """A drive that runs with a sag of its own between the ends of the file."""
    rng = np.random.default_rng((SEED, index))
    data = drive(rng)
    layout = data["layout"]
    sag = float(rng.uniform(layout["slack_sag_least"], layout["slack_sag_most"]))
    spec = loaded(data).spec
    assert spec is not None
    (scene,) = spec.all_scenes
    truth = {name: known_to(REFERENCE, value) for name, value in loads(data, sag).items()}
    claims = {WAY: claim(KIND, spec, scene, SPAN_FREQUENCIES)}
    return tried(index, rng, KIND, spec, scene, claims, truth, LIMITS, climbs=False)


@pytest.fixture(scope="module", params=numbers(MACHINES))
def trials(request: pytest.FixtureRequest) -> list[Trial]:
    return [trial_of(index) for index in request.param]


def test_the_bars_hold_the_sag_in_service(trials: list[Trial]) -> None:
    assert misses(trials, WAY) == []
    assert misses(trials, WAY, THIRD) != [], "a third of the bars does not suffice"
    assert wide(trials, WAY) <= widest(WAY)


def test_no_verdict_is_another(trials: list[Trial]) -> None:
    assert opposites(trials) == []
    assert near(trials) >= 0.4
    said = verdicts(trials, "CHN132", "CHN133")
    assert min(said.count(Verdict.PASS), said.count(Verdict.UNDECIDED)) > 0.05 * len(said)


def test_the_values_are_those_of_the_given_sag() -> None:
    for index in range(60):
        data = drive(np.random.default_rng((SEED, index)))
        spec = loaded(data).spec
        assert spec is not None
        claimed = claim(KIND, spec, spec.all_scenes[0], SPAN_FREQUENCIES)
        exact = loads(data, data["layout"]["slack_sag"])
        assert exact == {name: pytest.approx(bar.value, rel=REFERENCE) for name, bar in claimed.items()}
