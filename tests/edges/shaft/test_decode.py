"""Records of a shaft that slows down are decoded from the whole record, and what shows no such motion is refused."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from support.command import ptmcalc
from support.turns import in_turn

HERE = Path(__file__).parent
SPEC = HERE / "decode-shaft.yaml"
INERTIA, FRICTION, VISCOUS, BEGIN = 26.0, 48.0, 1.9, 14.2
"""The machine of the records, SI: kg*m^2, N*m, N*m*s/rad, rad/s."""


def decoded(record: Path, phase: str, *more: str) -> dict:  # type: ignore[type-arg]
    done = ptmcalc("decode", SPEC, record, "--phase", phase, *more, "--format", "json")
    assert (done.status, done.err) == (0, "")
    found: dict = json.loads(done.out)  # type: ignore[type-arg]
    return found


def at_speed(found: dict, speed: float) -> tuple[float, float]:  # type: ignore[type-arg]
    rows = sorted((row["speed"], row["torque"], row["uncertainty"]) for row in found["rows"])
    speeds, torques, bars = (np.array([row[k] for row in rows]) for k in range(3))
    return float(np.interp(speed, speeds, torques)), float(np.interp(speed, speeds, bars))


def test_a_run_out_of_four_seconds() -> None:
    """70.8 N*m at 12 rad/s: 48 + 1.9*12."""
    torque, bar = at_speed(decoded(HERE / "decode-coast.csv", "run_out"), 12.0)
    assert abs(torque - 70.8) <= bar < 0.5


def test_the_brake_that_ends_it() -> None:
    found = decoded(HERE / "decode-braked.csv", "brake")
    (value,) = found["values"]
    assert abs(value["value"] - 210.0) <= value["uncertainty"] < 5.0
    assert all(abs(row["torque"] - 210.0) <= row["uncertainty"] for row in found["rows"])


@pytest.mark.parametrize(
    ("record", "phase", "said"),
    [
        ("decode-tiny.csv", "run_out", "the record lasts 9.9e-299 s"),
        ("decode-tiny.csv", "run_up", "the record lasts 9.9e-299 s"),
        ("decode-tiny.csv", "brake", "the record lasts 9.9e-299 s"),
        ("decode-rising.csv", "run_out", "shows no run-out"),
        ("decode-rising.csv", "brake", "shows no braking"),
        ("decode-coast.csv", "run_up", "shows no run-up"),
    ],
)
def test_a_record_of_something_else_is_refused(record: str, phase: str, said: str) -> None:
    done = ptmcalc("decode", SPEC, HERE / record, "--phase", phase)
    assert (done.status, done.out) == (2, "")
    assert said in done.err


@pytest.mark.parametrize("end", in_turn((4.0, 6.0)))
def test_clean_records_are_read_with_the_truth_inside_the_bar(end: float, tmp_path: Path) -> None:
    """27 records of 4 s and 27 of 6 s, w = (w_0 + a/b) exp(-b t/J) - a/b, 0 at rest."""
    rng, inside, read = np.random.default_rng((54, int(end))), [], 0
    for count in (40, 80, 160, 300, 600, 1200):
        for noise in (0.002, 0.006, 0.02, 0.05, 0.1)[: 5 if count <= 160 else 4]:
            times = np.linspace(0.0, end, count)
            exact = (BEGIN + FRICTION / VISCOUS) * np.exp(-VISCOUS * times / INERTIA) - FRICTION / VISCOUS
            record = tmp_path / "record.csv"
            speeds = np.maximum(exact, 0.0) + noise * rng.normal(size=count)
            record.write_text(
                "time,speed\n" + "".join(f"{t:.6f},{w:.6f}\n" for t, w in zip(times, speeds, strict=True)), "utf-8"
            )
            found = decoded(record, "run_out")
            read += 1
            torque, bar = at_speed(found, 12.0)
            values = {one["name"]: (one["value"], one["uncertainty"]) for one in found["values"]}
            inside += [
                abs(torque - (FRICTION + 12 * VISCOUS)) <= bar,
                abs(values["friction"][0] - FRICTION) <= values["friction"][1],
                abs(values["viscous"][0] - VISCOUS) <= values["viscous"][1],
            ]
            assert all(map(math.isfinite, (torque, bar)))
    assert read == 27
    assert np.mean(inside) >= 0.95
