"""A belt that slips on its drum: both methods of strands against each other, on a belt that does not sag.

They share no step, no event and no line about the drum: characteristics find where slip begins and ends inside a
step, elements at whole steps. What they differ by falls with the step. The friction law itself is asked of both.
"""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from ptmcalc.numerics import sagging, strand
from ptmcalc.numerics.loop import Drive, Grip, Loop, Motion, Strand, match

EXPONENT, LINE_MASS = 0.3, 14.0


def line(rigid: bool, back: bool, drum: float = 2.3e3, jump: bool = True) -> Loop:
    """Tensions near the grip in the sense in which it will slip, unlike strands, masses at drum and tail."""
    on = 31e3 if back else 36e3
    return Loop(
        Strand(500.0, 40.0, 4e7, 30e3, on),
        Strand(500.0, 10.0, 4e7, 29e3, 30e3),
        drum,
        1.1e3,
        fixed_length=rigid,
        grip=Grip(EXPONENT, LINE_MASS),
        impedance_jump=jump,
    )


def force(back: bool) -> Drive:
    """A start, and in half of the cases a brake that is stronger than the belt's grip."""
    return Drive(force=lambda t: np.where(t < 0.9, 2e3 * np.minimum(t / 0.2, 1.0), -26e3 if back else 23e3))


def speed(back: bool) -> Drive:
    """The same by speeds: too fast a rise, or too fast a stop."""
    if back:
        return Drive(speed=lambda t: np.clip(np.minimum(0.35 * t, 0.5 - 4.0 * (t - 1.4)), 0.0, None))
    return Drive(speed=lambda t: np.minimum(0.3 * t, 0.3) + np.clip(3.0 * (t - 1.0), 0.0, 1.4))


def slip(motion: Motion) -> float:
    return float(np.trapezoid(motion.drum_speed - motion.belt_speed, motion.times))


@pytest.mark.parametrize("jump", [True, False])
@pytest.mark.parametrize("imposed", [False, True], ids=["force", "speed"])
@pytest.mark.parametrize("back", [False, True], ids=["drives", "brakes"])
@pytest.mark.parametrize("rigid", [False, True], ids=["takeup", "fixed"])
def test_both_methods_slip_alike(rigid: bool, back: bool, imposed: bool, jump: bool) -> None:
    drive, window = (speed if imposed else force)(back), 2.6
    loop = line(rigid, back, jump=jump)
    away = []
    for cells in (40, 80):
        cut = match(loop.carry.transit, loop.back.transit, cells, 1e-9)
        one, other = strand.march(loop, drive, window, cut), sagging.march(loop, drive, window, cut)
        assert one.slipped
        assert other.slipped
        assert ((one.drum_speed - one.belt_speed) * (-1 if back else 1)).max() > 0.02
        off = [abs(slip(one) / slip(other) - 1)]
        for here, there in (
            (one.drum_speed, other.drum_speed),
            (one.belt_speed, other.belt_speed),
            (one.run_on, other.run_on),
            (one.run_off, other.run_off),
        ):
            off.append(float(np.abs(here - there).mean() / np.ptp(here)) if np.ptp(here) else 0.0)
        away.append(off)
        slides = (one.drum_speed - one.belt_speed) * (-1 if back else 1) > 1e-6
        lift = LINE_MASS * one.belt_speed**2
        tight, slack = (one.run_off, one.run_on) if back else (one.run_on, one.run_off)
        held = one.belt_speed <= 1e-9  # a belt that would run back is held by its idlers
        ratio = (tight - lift) / (slack - lift)
        assert ratio[slides & ~held] == pytest.approx(math.exp(EXPONENT), rel=1e-9)
        assert ratio.max() <= math.exp(EXPONENT) * (1 + 1e-9)
    assert max(away[1]) < 0.03, away
    assert sum(away[1]) < 0.75 * sum(away[0])


METHODS = pytest.mark.parametrize("method", [strand.march, sagging.march], ids=["straight", "sagging"])


def in_units(loop: Loop, mass: float, length: float) -> Loop:
    """The same loop told in other units, so many of which are a kilogram and a metre."""
    force, line_mass = mass * length, mass / length
    strands = (
        Strand(
            one.length * length,
            one.line_mass * line_mass,
            one.stiffness * force,
            one.static_start * force,
            one.static_end * force,
            one.span_weight * force,
        )
        for one in (loop.carry, loop.back)
    )
    assert loop.grip is not None
    grip = Grip(loop.grip.exponent, loop.grip.belt_line_mass * line_mass)
    ends = loop.drum_mass * mass, loop.tail_mass * mass
    return Loop(*strands, *ends, loop.fixed_length, grip, loop.impedance_jump)


@METHODS
@pytest.mark.parametrize("imposed", [False, True], ids=["force", "speed"])
@pytest.mark.parametrize("back", [False, True], ids=["drives", "brakes"])
@pytest.mark.parametrize("rigid", [False, True], ids=["takeup", "fixed"])
def test_units_of_mass_and_length_do_not_matter(
    method: Callable[..., Motion], rigid: bool, back: bool, imposed: bool
) -> None:
    """Powers of two change no digit, whatever slips, sticks again or sags."""
    weight = 300.0 if method is sagging.march else 0.0
    loop = line(rigid, back)
    loop = replace(loop, carry=replace(loop.carry, span_weight=weight), back=replace(loop.back, span_weight=weight / 2))
    drive = (speed if imposed else force)(back)
    cut = match(loop.carry.transit, loop.back.transit, 20, 1e-9)
    found = method(loop, drive, 2.6, cut)
    assert found.slipped
    for mass, length in ((2.0**-24, 1.0), (2.0**20, 2.0**-9)):
        one = Drive(
            force=None if imposed else lambda t, unit=mass * length: unit * drive.force(t),
            speed=(lambda t, unit=length: unit * drive.speed(t)) if imposed else None,
        )
        other = method(in_units(loop, mass, length), one, 2.6, cut)
        for name, unit in (
            ("waves", mass * length), ("run_on", mass * length), ("run_off", mass * length),
            ("belt_speed", length), ("drum_speed", length), ("energy_residual", 1.0),
            ("slipped", 1), ("reversed", 1), ("cell_updates", 1),
        ):  # fmt: skip
            assert np.array_equal(getattr(found, name) * unit, getattr(other, name)), name
        for name in ("carry_max", "carry_min", "back_max", "back_min"):
            here, there = getattr(found, name), getattr(other, name)
            assert there == replace(
                here,
                value=here.value * mass * length,
                position=here.position * length,
                missed=here.missed * mass * length,
            )


@METHODS
def test_a_belt_that_slips_at_rest_stays_there(method: Callable[..., Motion]) -> None:
    """Its static tensions are beyond its grip and the drum is held: the idlers hold it, nothing moves."""
    loop = line(False, False)
    loop = replace(loop, carry=replace(loop.carry, static_end=90e3))
    motion = method(
        loop,
        Drive(speed=lambda t: 0.0 * t),
        1.0,
        match(loop.carry.transit, loop.back.transit, 20, 1e-9),
    )
    assert motion.slipped
    assert not motion.belt_speed.any()
    assert motion.run_on == pytest.approx(np.full(len(motion.times), 90e3), rel=1e-12)
    assert motion.energy_residual == 0.0
