"""Factors of lifting and letting go: worked case C14, energy, integration by DOP853, tables as printed."""

import math

import pytest
from scipy.integrate import solve_ivp

from ptmcalc.laws import lift_off, lift_off_standard, two_mass

M, M1, K, V0, G = 5000.0, 18000.0, 1.2e6, 0.25, 9.81
Q = M * G
PRINTED = 1e-5


class TestC14:
    def test_speed_source_and_its_number(self) -> None:
        factor = float(lift_off.speed_source_factor(V0, Q / K, G))
        assert factor == pytest.approx(1.3948, rel=PRINTED)
        assert factor == pytest.approx(two_mass.speed_step_force(V0, K, M, Q) / Q, rel=1e-14)

    @pytest.mark.parametrize(
        ("share", "factor", "speed", "time"), [(1.0, 1.58256, 0.416994, 0.113642), (1.6, 1.91609, 0.554568, 0.0963159)]
    )
    def test_take_up(self, share: float, factor: float, speed: float, time: float) -> None:
        found = two_mass.takeup(M1, M, K, share * Q, Q, V0)
        assert (found.peak_force / Q, found.lift_off_speed, found.time) == pytest.approx(
            (factor, speed, time), rel=PRINTED
        )
        assert lift_off.elasticity_number(1e-3, share * Q, Q, M1, M, K) == pytest.approx(
            max(1e-3 * math.sqrt(K / M) / G, 2 * (share - 1) * 5 / 23), rel=1e-12
        )
        number = lift_off.elasticity_number(found.lift_off_speed, share * Q, Q, M1, M, K)
        assert number == pytest.approx(max(speed / math.sqrt(G * Q / K), 2 * (share - 1) * M / (M1 + M)), rel=PRINTED)

    def test_standard(self) -> None:
        given = {"HC1": 1.0925, "HC2": 1.185, "HC3": 1.2775, "HC4": 1.37}
        for name, factor in given.items():
            found = lift_off_standard.standard_lift_off_factor(name, "HD1", V0, "by_class")
            assert found == pytest.approx(factor, rel=1e-12)


def test_drive_mass_number_is_what_the_drive_gains() -> None:
    for share, speed in ((1.6, 0.25), (2.2, 0.05), (0.8, 0.9), (0.5, 0.4)):
        number = lift_off.drive_mass_number(share * Q, Q, M1, M, K, speed)
        gained = (two_mass.takeup(M1, M, K, share * Q, Q, speed).lift_off_speed / speed) ** 2 - 1
        assert number == pytest.approx(max(M / M1, gained), rel=1e-12)
    assert lift_off.drive_mass_number(Q, Q, M1, M, K, 0.0) == math.inf


def test_motor_slope_number_is_a_damping_ratio() -> None:
    mu = M1 * M / (M1 + M)
    assert lift_off.motor_slope_number(3e4, K, M1, M) == pytest.approx(3e4 / (2 * math.sqrt(K * mu)), rel=1e-14)


def test_structure_number() -> None:
    assert lift_off.structure_number(2e6, 8e6, 3e3, 5e3) == (0.25, 0.6)


def test_swing_under_a_drum_that_stands() -> None:
    """C25 after the stop: the state when the drum stops comes from an integration, the peak after it from the law."""
    mass, drive, brake, v = 5000.0, 18000.0, 1.75 * Q, 0.4

    def rate(t: float, y: list[float]) -> list[float]:
        force = K * (y[0] - y[2])
        return [y[1], (brake - force) / drive, y[3], force / mass - G]

    def stands(t: float, y: list[float]) -> float:
        return y[1]

    stands.terminal = True  # type: ignore[attr-defined]
    run = solve_ivp(rate, (0, 1), [Q / K, -v, 0.0, -v], "DOP853", rtol=1e-12, atol=1e-12, events=stands)
    x, _, y, speed = run.y[:, -1]
    assert run.t[-1] == pytest.approx(0.265923, rel=PRINTED)
    assert lift_off.held_swing_force(K * (x - y), Q, speed, K, mass) / Q == pytest.approx(1.25195, rel=PRINTED)


def test_quick_release_of_a_part() -> None:
    """A spring under M g from which 40 % drops: its smallest force."""
    dropped = 0.4 * M
    low = Q - 2 * dropped * G  # energy about the new equilibrium
    assert float(lift_off.release_factor(0.4, 1.0)) == pytest.approx(low / Q, rel=1e-14)
    assert float(lift_off.release_factor(0.4, 0.5)) == pytest.approx(0.4, rel=1e-14)


class TestStandard:
    def test_classes_by_deflection(self) -> None:
        found = [lift_off_standard.stiffness_class(x) for x in (0.8, 0.79, 0.3, 0.29, 0.15, 0.149, 0.0)]
        assert found == ["HC1", "HC2", "HC2", "HC3", "HC3", "HC4", "HC4"]

    def test_speeds(self) -> None:
        for combination, speeds in (
            ("regular", (0.4, 0.1, 0.1, 0.2, 0.0)),
            ("exceptional", (0.4, 0.4, 0.2, 0.4, 0.2)),
        ):
            for drive, speed in zip(lift_off_standard.DRIVES, speeds, strict=True):
                assert lift_off_standard.class_lift_off_speed(drive, combination, 0.4, 0.1) == speed

    def test_what_is_printed_is_not_filled_in_otherwise(self) -> None:
        for combination in (lift_off_standard.REGULAR, lift_off_standard.EXCEPTIONAL):
            for drive in ("HD2", "HD4", "HD5"):
                both = {
                    lift_off_standard.class_lift_off_speed(drive, combination, 0.4, 0.1, edition)
                    for edition in (lift_off_standard.FILLED, lift_off_standard.PRINTED)
                }
                assert len(both) == 1

    def test_editions(self) -> None:
        assert lift_off_standard.standard_lift_off_factor("HC4", "HD5", 0.0, "by_drive") == 1.05
        assert lift_off_standard.standard_lift_off_factor("HC4", "HD5", 0.0, "by_class") == 1.20
        assert lift_off_standard.standard_lift_off_factor("HC4", "HD4", 0.0, "by_drive") == 1.20

    def test_an_edition_that_raises_the_hard_drive(self) -> None:
        for drive in lift_off_standard.DRIVES:
            for name, hard in (("HC1", 1.1), ("HC2", 1.2), ("HC3", 1.3), ("HC4", 1.4)):
                usual, raised = (
                    lift_off_standard.standard_lift_off_factor(name, drive, 0.3, edition)
                    for edition in (lift_off_standard.BY_CLASS, lift_off_standard.RAISED)
                )
                assert raised == pytest.approx(
                    hard + lift_off_standard.BETA[name] * 0.3 if drive == "HD1" else usual, rel=1e-14
                )

    @pytest.mark.parametrize(
        ("structure", "speed", "factor"),
        [("bridge", 0.1, 1.15), ("bridge", 0.5, 1.3), ("bridge", 1.5, 1.6), ("jib", 0.4, 1.15), ("jib", 1.0, 1.3)],
    )
    def test_fem(self, structure: str, speed: float, factor: float) -> None:
        assert lift_off_standard.fem_lift_off_factor(structure, speed) == pytest.approx(factor, rel=1e-14)
