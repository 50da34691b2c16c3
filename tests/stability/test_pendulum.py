"""Random trolleys and jibs with all that can act on them: what must hold of any motion, read from its signals alone."""

import math

import numpy as np
import pytest

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.pendulum.parts import (
    Axis,
    Buffer,
    Case,
    Follow,
    Gear,
    Jib,
    Load,
    Push,
    Rail,
    Smooth,
    Straight,
)
from ptmcalc.numerics.pendulum.pieces import Pieces, braking
from ptmcalc.numerics.pendulum.swing import Swing, swing

G, END = 9.81, 12.0


def drawn(rng: np.random.Generator) -> Case:
    """A crane: masses over three decades, motors of every kind, brakes, gusts, slopes, stops."""
    jib, length = rng.random() < 0.5, 10 ** rng.uniform(0, 1.5)
    radius = rng.uniform(4, 40)
    arm = radius if jib else 1.0
    mass, inertia = 10 ** rng.uniform(1, 4.3), 10 ** rng.uniform(2.5, 4.5) * arm**2
    force, top = (inertia + mass * arm**2) * 10 ** rng.uniform(-2, 0.2) / arm, rng.uniform(0.3, 3) / arm

    def kloss(v: np.ndarray) -> np.ndarray:
        slip = 1 - np.asarray(v) / top
        return np.asarray(2 * force * 2.2 * slip * 0.15 / (slip**2 + 0.0225))

    until = float(rng.choice([math.inf, rng.uniform(2, 9)]))
    gate = Pieces.through(((0.0, 0.1), (rng.uniform(0.2, 3), 1.0)))
    up = Pieces.through(((0.0, 0.0), (rng.uniform(0.5, 4), top), (8.0, top), (10.0, 0.0)))
    limit = float(rng.choice([force, 0.6 * force, math.inf]))
    drive = [
        None,
        Push(force, gate, until=until),
        Push(Smooth(kloss, 2 * force), gate, until=until),
        Push(Straight((0.0, 0.5 * top, top, 1.1 * top), (1.5 * force, 1.8 * force, 0.7 * force, -force)), until=until),
        Push(1.5 * force, gate, reaches=top, limit=float(rng.choice([0.0, 2 * force])), until=until),
        Follow(up, limit, until),
    ][rng.integers(6)]

    def brake() -> Pieces:
        return braking(force * rng.uniform(0.5, 4), rng.uniform(2, 9), 0.2, float(rng.choice([0.0, 0.4])))

    gear = Gear()
    if rng.random() < 0.5:
        gear = Gear(inertia * rng.choice([0.0, 0.3, 5.0]), rng.uniform(0.5, 1), rng.uniform(0.3, 1), brake())
    gust = Pieces.through(
        ((1.0, 0.0), (2.0, force * rng.uniform(-1, 1)), (5.0, force * rng.uniform(-1, 1)), (5.0, 0.0))
    )
    law = str(rng.choice(["linear", "constant", "orifice"]))
    return Case(
        G,
        Jib(Pieces.constant(radius), float(rng.choice([0.0, 0.02]))) if jib else Rail(float(rng.choice([0.0, 0.01]))),
        Axis(
            inertia,
            drive,
            force * float(rng.choice([0.0, 0.05, 0.3, 1.2])),
            brake() if rng.random() < 0.5 else Pieces.constant(0.0),
            gust if rng.random() < 0.5 else Pieces.constant(0.0),
            gear=gear,
            buffers=(Buffer(rng.uniform(1, 4) / arm, law, 30 * force),) if rng.random() < 0.4 else (),
            speed=0.0 if isinstance(drive, Follow) else top * float(rng.choice([0.0, -0.5, 0.7])),
        ),
        Load(mass, Pieces.through(((2.0, length), (8.0, length * rng.uniform(0.7, 1.5)))), *rng.normal(0, 0.08, 4)),
    )


def moved(case: Case) -> Swing | None:
    """The motion, or None where a rope goes slack."""
    try:
        return swing(case, END)
    except NumericsError as told:
        if "slack" in told.message:
            return None
        raise


@pytest.mark.parametrize("block", range(4))
def test_what_holds_of_any_motion(block: int) -> None:
    seen = 0
    for seed in range(25 * block, 25 * block + 25):
        case = drawn(np.random.default_rng(seed))
        found = moved(case)
        if found is None:
            continue
        seen += 1
        axis, events = case.axis, {e.time for e in found.events}
        assert found.works().residual < 1e-11, seed
        assert found.steps < 1500, seed
        t = np.linspace(0, END, 4001)
        t = t[[all(abs(one - e) > 1e-6 for e in events) for one in t]]
        at = {name: found.at(name, t) for name in ("speed", "grip", "motor", "drive", "buffer", "tension", "sway")}
        most = axis.friction + axis.brake.at(t)
        size = most.max() + np.abs(at["motor"]).max() + np.abs(at["buffer"]).max() + case.load.mass * 1e-3
        going = np.abs(at["speed"]) > 1e-7 * max(np.abs(at["speed"]).max(), 1e-9)
        assert at["grip"][going] == pytest.approx(-np.sign(at["speed"][going]) * most[going], abs=1e-9 * size), seed
        if axis.drive is not None and math.isfinite(axis.drive.limit) and isinstance(axis.drive, Follow):
            assert np.abs(at["motor"]).max() <= axis.drive.limit * (1 + 1e-7), seed
        assert at["buffer"].max(initial=0.0) <= 1e-9 * size, seed
        assert at["tension"].min() >= 0, seed
        for name in ("sway", "tension"):
            top = found.largest(name)
            assert top.value >= at[name].max() - 1e-8 * np.abs(at[name]).max(), (seed, name)
            assert top.bar <= 1e-6 * max(abs(top.value), 1.0), (seed, name)
    assert seen > 18


def test_time_and_size_are_only_units() -> None:
    """A thousandth of the size at a thousandth of the gravity's time squared: the same motion, step by step."""
    for seed in (3, 11):
        rng = np.random.default_rng(seed)
        along, across, ahead, beside = rng.normal(0, 0.2, 4).tolist()
        ends = []
        for scale in (1e-3, 1.0, 1e3):
            unit = math.sqrt(scale)
            load = Load(50.0, Pieces.constant(4.0 * scale), along, across, ahead / unit, beside / unit)
            axis = Axis(200.0 * scale**2, Push(150.0 * scale), friction=40.0 * scale)
            found = swing(Case(G, Jib(Pieces.constant(2.0 * scale)), axis, load), 9.0 * unit)
            ends.append([float(found.at(name, 9.0 * unit)) for name in ("along", "across", "position", "tension")])
        assert ends[0] == pytest.approx(ends[1], rel=1e-8, abs=1e-9)
        assert ends[2] == pytest.approx(ends[1], rel=1e-8, abs=1e-9)
