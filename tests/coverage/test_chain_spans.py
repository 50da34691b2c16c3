"""Error bars of the transverse frequencies of free spans: the sag in service takes any value between its ends."""

import math
from typing import Any

import numpy as np
import pytest
import yaml
from support.chains import ROLLER
from support.machines import changed

from ptmcalc.engine.load import load_text
from ptmcalc.machines.chain_drive.spans.frequencies import run

SEED, DRIVES, SAGS = 606, 60, 25
ROUNDING = 1e-9


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


def test_every_sag_in_service_is_within_the_bars() -> None:
    rng, used = np.random.default_rng(SEED), []
    for _ in range(DRIVES):
        data = drive(rng)
        spec = load_text(yaml.safe_dump(data).encode(), "drive.yaml").spec
        assert spec is not None
        bars = {name: found.estimate for name, found in run(spec, spec.all_scenes[0], frozenset(), 0).loads.items()}  # type: ignore[arg-type]
        layout = data["layout"]
        assert loads(data, layout["slack_sag"]) == {
            name: pytest.approx(bar.value, rel=1e-6) for name, bar in bars.items()
        }
        for sag in np.linspace(layout["slack_sag_least"], layout["slack_sag_most"], SAGS):
            for name, value in loads(data, float(sag)).items():
                bar = bars[name]
                assert bar.low - ROUNDING <= value <= bar.high + ROUNDING + 1e-6 * value, (name, data)
                width = bar.high - bar.value if value > bar.value else bar.value - bar.low
                used.append(abs(value - bar.value) / width if width > ROUNDING else 0.0)
    assert max(used) > 0.9, "a third of the bars does not suffice"
