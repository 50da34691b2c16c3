"""Numbers that laws quote from standards and handbooks, cell by cell as they are printed there, typed a second time."""

import itertools
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from ptmcalc.laws import (
    backlash,
    belt_resistance,
    belt_section,
    bodies,
    buffer,
    chain_selection,
    classification,
    duty,
    hoist_class,
    lift_off_standard,
    mast,
    polygon,
    skew,
    standard_factors,
    travel,
    wheel_loads,
    winding,
)

LBF = 0.45359237 * 9.80665
"""Pound times standard gravity, both of them definitions [N]."""
PRINTED: list[tuple[Any, Any]] = [
    # ISO 4301-1: U0 to U8 as powers of ten, T0 to T8, Q1 to Q4; EN 13001-1
    (classification.USE_CYCLES, (1.6e4, 3.2e4, 6.3e4, 1.25e5, 2.5e5, 5e5, 1e6, 2e6, 4e6)),
    (classification.USE_HOURS, (200, 400, 800, 1600, 3200, 6300, 12500, 25000, 50000)),
    (classification.SPECTRA, (0.125, 0.250, 0.500, 1.000)),
    (classification.SPECTRA_EN_13001, (0.0313, 0.0625, 0.1250, 0.2500, 0.5000, 1.0000)),
    # ISO 4308-1 and the reserve of brakes, M1 to M8
    (hoist_class.ROPE_SAFETY, (3.15, 3.35, 3.55, 4.0, 4.5, 5.6, 7.1, 9.0)),
    (hoist_class.ROPE_SAFETY_LAYERS, (3.55, 3.55, 3.55, 4.0, 4.5, 5.6)),
    (hoist_class.DRUM_RATIO, (11.2, 12.5, 14.0, 16.0, 18.0, 20.0, 22.4, 25.0)),
    (hoist_class.SHEAVE_RATIO, (12.5, 14.0, 16.0, 18.0, 20.0, 22.4, 25.0, 28.0)),
    (hoist_class.EQUALISER_RATIO, (11.2, 12.5, 12.5, 14.0, 14.0, 16.0, 16.0, 18.0)),
    (hoist_class.BRAKE_RESERVE, (1.5, 1.5, 1.5, 1.5, 1.75, 2.0, 2.5, 2.5)),
    # EN 13001-2, ISO 8686-1, FEM 1.001
    (lift_off_standard.BETA, (0.17, 0.34, 0.51, 0.68)),
    (lift_off_standard.LEAST, (1.05, 1.10, 1.15, 1.20)),
    (lift_off_standard.LEAST_HARD, (1.10, 1.20, 1.30, 1.40)),
    (lift_off_standard.FEM_SLOPE, (0.6, 0.3)),
    (standard_factors.DRIVE_CHANGES, ((1.0, 1.0), (1.0, 1.5), (1.5, 2.0), (3.0, 3.0))),
    (standard_factors.DRIVE_CONTROLS, ((1.2, 1.5), (1.6, 2.0), (1.8, 2.2), (2.0, 2.4))),
    (standard_factors.TEST_LOADS, ((1.1, 1.25), (1.2, 1.4))),
    (skew.LEAST_PLAY, (0.005, 0.010)),
    (skew.WEAR_SHARE, (0.03, 0.10)),
    (skew.ADHESION, (0.3, 0.2)),
    ((skew.LARGEST_ANGLE, skew.TOLERANCE_ANGLE), (15e-3, 1e-3)),
    (buffer.COLLISION_SPEED, (1.0, 0.7, 0.5)),
    (wheel_loads.ROLLING_CONTACT_SLOPE, 10 / 3),
    # DIN 22101, ISO 5048, CEMA
    (belt_section.PULLEY_FACTORS, (80, 90, 108, 138, 145)),
    (belt_resistance.WRAP_COEFFICIENTS, ((9 * 140, 9 * 0.01), (12 * 200, 12 * 0.01))),
    (belt_resistance.TILT_CONTACT, (0.4, 0.5)),
    (belt_resistance.CEMA_IDLER_DRAG, (1.5 * LBF, 1.8 * LBF, 2.3 * LBF, 2.4 * LBF)),
    # the lecture notes, handbooks of motors, gears and wheels
    (polygon.LAMBDA_TABLE, ((25.0, 2.0), (60.0, 1.5), (np.inf, 1.0))),
    ((mast.NOTES_RIGID, mast.NOTES_ELASTIC), (0.236, 0.305)),
    (duty.REST_COOLING, (0.33, 0.5, 0.95, 1.0)),
    (backlash.CLASS_FACTORS, (50, 80, 130)),
    ((bodies.DRUM_SHAPE, bodies.SHEAVE_SHAPE, bodies.COUPLING_SHAPE), ((0.65, 0.80), (0.55, 0.70), (0.40, 0.60))),
    (travel.BEARING_FRICTION, (0.015, 0.08)),
    (travel.AIR_DENSITY, 1.25),
    # the paper on winding: 12 turns a minute
    ((winding.PAPER_SLOW, winding.PAPER_FAST), (3.0, 96.0)),
    (winding.PAPER_SPEED, 12 * 2 * np.pi / 60),
]


@pytest.mark.parametrize("k", range(len(PRINTED)))
def test_as_printed(k: int) -> None:
    table, printed = PRINTED[k]
    values = list(table.values()) if isinstance(table, Mapping) else table
    assert np.asarray(values, float) == pytest.approx(np.asarray(printed, float), rel=1e-12)


def test_lubrication_of_chains() -> None:
    """ACA types A and B in feet a minute, from no. 40 to no. 160: at each limit, a little above it, and between."""
    printed = [
        (0.500, 300, 2300), (0.625, 250, 2000), (0.750, 220, 1800), (1.000, 170, 1500), (1.250, 150, 1300),
        (1.500, 130, 1200), (1.750, 115, 1100), (2.000, 100, 1000),
    ]  # fmt: skip
    foot = 0.3048 / 60
    between = [tuple((a + b) / 2 for a, b in zip(one, two, strict=True)) for one, two in itertools.pairwise(printed)]
    for inches, by_hand, bath in [*printed, *between]:
        kinds = [
            chain_selection.lubrication(0.0254 * inches, feet * foot)[5]
            for feet in (by_hand * 0.9999, by_hand * 1.0001, bath * 0.9999, bath * 1.0001)
        ]
        assert kinds == ["A", "B", "B", "C"], inches
