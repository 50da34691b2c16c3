"""Left for right: a machine seen in a mirror moves as its picture does, whatever sticks, slips, drives or stops it."""

from dataclasses import replace

import numpy as np
import pytest

from ptmcalc.numerics.pendulum.parts import Axis, Buffer, Case, Follow, Gear, Jib, Load, Push, Rail, Smooth, Straight
from ptmcalc.numerics.pendulum.pieces import Pieces
from ptmcalc.numerics.pendulum.swing import swing

TURNED = ("position", "speed", "acceleration", "along", "along_rate", "pull_along", "drive", "motor", "grip", "buffer")
SAME = ("across", "across_rate", "sway", "tension", "pull_across", "amplitude")
PEAKS = ("along", "sway", "speed", "motor", "buffer")
HANGING = Load(700.0, Pieces((0.0, 2.0), ((5.0, -0.3), (4.4,))), 0.06, 0.03, -0.02, 0.05)
SLEWED = replace(HANGING, wind_along=Pieces.steps(((0.5, 60.0),)), wind_across=Pieces.constant(20.0))
LOSSY = Gear(400.0, 0.9, 0.8, Pieces.through(((2.0, 0.0), (2.5, 300.0))))
KLOSS = Smooth(lambda v: 900.0 * (1 - v) / ((1 - v) ** 2 + 0.2), 900.0)
CASES = {
    "pushed from rest": Case(
        9.81, Rail(0.01), Axis(900.0, Push(800.0, until=3.0), 120.0, Pieces.steps(((4.0, 900.0),))), HANGING
    ),
    "the swing starts it": Case(9.81, Rail(), Axis(300.0, friction=150.0), replace(HANGING, along=0.3)),
    "a slope starts it": Case(9.81, Rail(-0.03), Axis(900.0, None, 100.0, gear=LOSSY), HANGING),
    "an outer force against a gear": Case(
        9.81,
        Rail(),
        Axis(900.0, Push(0.0), 50.0, outer=Pieces.through(((0.0, 0.0), (1.0, 700.0), (3.0, -500.0))), gear=LOSSY),
        HANGING,
    ),
    "kept speed with a limit": Case(
        9.81,
        Rail(0.005),
        Axis(900.0, Follow(Pieces.through(((0.0, 0.0), (1.0, 1.2), (3.0, 1.2), (3.6, 0.0))), 900.0), 40.0, gear=LOSSY),
        HANGING,
    ),
    "straight pieces up to a speed": Case(
        9.81,
        Rail(),
        Axis(
            900.0, Push(Straight((-0.2, 0.4, 1.0), (1200.0, 900.0, 300.0)), reaches=0.8, limit=700.0), 30.0, gear=LOSSY
        ),
        HANGING,
    ),
    "a motor": Case(9.81, Rail(), Axis(900.0, Push(KLOSS), 30.0), HANGING),
    "a spring": Case(
        9.81,
        Rail(),
        Axis(900.0, buffers=(Buffer(0.5, "linear", 3e4), Buffer(-0.2, "linear", 9e3, side=-1)), speed=1.1),
        HANGING,
    ),
    "a constant buffer": Case(
        9.81,
        Rail(),
        Axis(900.0, Push(500.0), 10.0, buffers=(Buffer(0.6, "constant", 2500.0, 0.9),), speed=0.9),
        HANGING,
    ),
    "an orifice": Case(9.81, Rail(), Axis(900.0, buffers=(Buffer(0.6, "orifice", 9e3),), speed=1.5), HANGING),
    "a jib on a slope": Case(
        9.81,
        Jib(Pieces((0.0,), ((9.0, 0.2),)), 0.01, 0.4, 5e4),
        Axis(8e4, Push(9e3, until=2.5), 2e3, Pieces.steps(((3.0, 3e4),)), position=0.2, gear=Gear(9e3, 0.9, 0.85)),
        SLEWED,
    ),
}


def turned(pieces: Pieces) -> Pieces:
    return Pieces(pieces.starts, tuple(tuple(-c for c in piece) for piece in pieces.coefficients))


def mirrored(case: Case) -> Case:
    axis, load = case.axis, case.load
    drive = axis.drive
    if isinstance(drive, Follow):
        drive = replace(drive, speed=turned(drive.speed))
    elif isinstance(drive, Push):
        law = drive.law
        if isinstance(law, Straight):
            law = Straight(tuple(-v for v in law.knots[::-1]), tuple(-f for f in law.values[::-1]))
        elif isinstance(law, Smooth):
            law = Smooth(lambda v, of=law.value: -of(-v), law.size)
        else:
            law = -law
        drive = replace(drive, law=law, reaches=None if drive.reaches is None else -drive.reaches)
    pivot = case.pivot
    pivot = Rail(-pivot.slope) if isinstance(pivot, Rail) else replace(pivot, downhill=-pivot.downhill)
    return Case(
        case.gravity,
        pivot,
        replace(
            axis,
            drive=drive,
            outer=turned(axis.outer),
            buffers=tuple(replace(one, place=-one.place, side=-one.side) for one in axis.buffers),
            position=-axis.position,
            speed=-axis.speed,
        ),
        replace(load, along=-load.along, along_rate=-load.along_rate, wind_along=turned(load.wind_along)),
    )


@pytest.mark.parametrize("name", CASES)
def test_a_mirror_changes_nothing_but_signs(name: str) -> None:
    one, other = (swing(case, 5.0) for case in (CASES[name], mirrored(CASES[name])))
    assert one.end == pytest.approx(other.end, rel=1e-9)
    times = np.linspace(0.0, min(one.end, other.end) * (1 - 1e-9), 137) + 1e-7
    times = times[times < min(one.end, other.end)]
    for signal in (*TURNED, *SAME):
        sign = -1.0 if signal in TURNED else 1.0
        here, there = one.at(signal, times), sign * other.at(signal, times)
        size = max(float(np.abs(here).max()), 1e-9)
        assert float(np.median(np.abs(here - there))) <= 1e-9 * size, signal
        if signal not in PEAKS:
            continue
        low, high = (other.smallest(signal), other.largest(signal)) if sign > 0 else (
            other.largest(signal), other.smallest(signal))  # fmt: skip
        assert one.largest(signal).value == pytest.approx(sign * high.value, abs=1e-7 * size), signal
        assert one.smallest(signal).value == pytest.approx(sign * low.value, abs=1e-7 * size), signal
    assert np.ptp(one.at("position", times)) > 1e-3, "it moves"
    assert one.works().residual < 1e-9
    assert other.works().residual < 1e-9
