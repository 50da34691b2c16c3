"""Numerically hard lumped cases, marched from event to event; expected values are exact algebra or 80 digits."""

import math

import numpy as np
import pytest
from support.trains import run

from ptmcalc.numerics import expm
from ptmcalc.numerics.train.modes import frequencies
from ptmcalc.numerics.train.parts import CLAMPED, NO_PULL, RIGID, Body, Drive, Grip, Guide, Spring, Train
from ptmcalc.numerics.train.signals import Signal
from ptmcalc.numerics.train.system import TrainSystem

G = 9.81


def constant(name: str, body: int, value: float) -> Drive:
    return Drive.of(name, body, Signal.constant(value))


class TestHardCases:
    def test_expm_overscaling(self) -> None:
        found = expm.expm(np.array([[0.0, 1e8], [0.0, -1.0]]))[0, 1]
        assert found == pytest.approx(63212055.882855766, rel=1e-13)

    def test_rigid_mode_is_exactly_zero(self) -> None:
        """A free chain travels with t^2/2 times the force over its mass."""
        bodies = tuple(Body(f"b{i}", m) for i, m in enumerate((1.0, 3.0, 7.0)))
        train = Train(
            bodies, springs=(Spring("a", 0, 1, 1e12), Spring("b", 1, 2, 3e11)), drives=(constant("f", 0, 11.0),)
        )
        assert len(frequencies(train)) == 2
        system = TrainSystem(train)
        assert system.coordinates.travels == 1
        state, _ = system.start()
        rate = system.motion(state).rate
        assert not rate[5, :5].any()  # nothing but the input moves the mean
        found = run(train, 1e-4)
        mean = sum(body.inertia * found.last("position", i) for i, body in enumerate(bodies)) / 11
        assert mean == pytest.approx(1e-8 / 2, rel=1e-9)

    def test_lift_off_from_rest(self) -> None:
        """m g + v sqrt(k m), the drum a prescribed motion."""
        train = Train(
            (Body("drum", 1.0, 0.0, 0.25), Body("load", 1e4)),
            springs=(
                Spring("rope", 0, 1, 2e6, law=NO_PULL, side=1),
                Spring("ground", 1, None, 0.0, law=RIGID, side=-1),
            ),
            drives=(constant("weight", 1, -1e4 * G),),
            guides=(Guide("drum", 0),),
        )
        assert run(train, 1.0).top("link", 0) == pytest.approx(133455.33905932738, rel=1e-11)


class TestExtremes:
    @pytest.mark.parametrize("ratio", [1e-12, 1e-6, 1e6, 1e12])
    def test_inertia_ratios(self, ratio: float) -> None:
        """Two bodies struck by a constant force: x = (F/(m1 + m2)) t^2/2 for the whole, and the link's peak."""
        m1, m2 = 1.0, ratio
        stiffness = m1 * m2 / (m1 + m2) * 100.0
        train = Train(
            (Body("a", m1), Body("b", m2)), springs=(Spring("s", 0, 1, stiffness),), drives=(constant("f", 0, 1.0),)
        )
        found = run(train, 1.0)
        assert found.top("link", 0) == pytest.approx(2 * m2 / (m1 + m2), rel=1e-10)
        mean = (m1 * found.last("position", 0) + m2 * found.last("position", 1)) / (m1 + m2)
        assert mean == pytest.approx(0.5 / (m1 + m2), rel=1e-12)

    @pytest.mark.parametrize("scale", [1e-6, 1e-3, 1e3, 1e9])
    def test_time_scales(self, scale: float) -> None:
        """The same train in another unit of time: gap, damper and brake."""

        def at(unit: float) -> tuple[float, float]:
            train = Train(
                (Body("a", 1.0), Body("b", 3.0)),
                springs=(Spring("gear", 0, 1, 1e4 / unit**2, 20.0 / unit, 0.01, CLAMPED),),
                grips=(Grip("brake", 1, None, Signal.constant(4.0 / unit**2)),),
                drives=(constant("f", 0, 10.0 / unit**2),),
            )
            found = run(train, unit)
            return found.top("link", 0) * unit**2, found.last("position", 1)

        assert at(scale) == pytest.approx(at(1.0), rel=1e-8)

    @pytest.mark.parametrize("stiffness", [1e6, 1e9, 1e12])
    def test_a_stiff_damped_gear_changes_nothing_slow(self, stiffness: float) -> None:
        """Motor, gear, load on a soft rope to the ground: the slow vibration is that of the sum of the inertias."""
        damping = math.sqrt(stiffness)
        train = Train(
            (Body("motor", 1.0), Body("load", 3.0)),
            springs=(Spring("gear", 0, 1, stiffness, damping), Spring("rope", 1, None, 4.0)),
            drives=(constant("f", 0, 8.0),),
        )
        found = run(train, 20.0, closes=1e-6)
        assert found.last("position", 1) == pytest.approx(2 * (1 - math.cos(20.0)), abs=20 / stiffness + 1e-6)
        assert found.record.steps < 4000
