"""A rope with mass and a rope that gets shorter: against finite elements, scipy's Bessel functions and DOP853."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh
from scipy.optimize import brentq

from ptmcalc.laws import rope_rod

C17 = {"EA": 1.05e11 * 1.6e-4, "mu": 1.5, "l": 120.0, "M": 3000.0, "V": 1.5, "end": 15.0}
PRINTED = 1e-5


class TestFrequencies:
    @pytest.mark.parametrize("ratio", [1e-14, 1e-6, 0.06, 0.3, 1.0, 40.0, 1e9])
    @pytest.mark.parametrize("mode", [1, 2, 7])
    def test_root(self, ratio: float, mode: int) -> None:
        base, found = (mode - 1) * math.pi, rope_rod.rod_root(ratio, mode)

        def off(x: float) -> float:  # from the other function: cot(B) = B/r, kept free of poles
            return (base + x) / math.hypot(1, ratio) * math.sin(x) - ratio / math.hypot(1, ratio) * math.cos(x)

        assert found == pytest.approx(base + brentq(off, 0, math.pi / 2, xtol=1e-300, rtol=1e-14), rel=2e-13)

    @pytest.mark.parametrize("ratio", [0.06, 0.3, 3.0])
    def test_against_elements(self, ratio: float) -> None:
        """Quadratic elements, lowest three frequencies."""
        count, load, stiffness = 60, 3e3, 1.4e5
        mass, stiff = np.zeros((2 * count + 1,) * 2), np.zeros((2 * count + 1,) * 2)
        for k in range(count):
            place = slice(2 * k, 2 * k + 3)
            mass[place, place] += ratio * load / count / 30 * np.array([[4, 2, -1], [2, 16, 2], [-1, 2, 4]])
            stiff[place, place] += stiffness * count / 3 * np.array([[7, -8, 1], [-8, 16, -8], [1, -8, 7]])
        mass[-1, -1] += load
        found = np.sqrt(eigh(stiff[1:, 1:], mass[1:, 1:], eigvals_only=True)[:3])
        ours = [rope_rod.rod_frequency(stiffness, ratio * load, load, mode) for mode in (1, 2, 3)]
        assert ours == pytest.approx(found.tolist(), rel=1e-6)

    @pytest.mark.parametrize("rope", [1.0, 180.0, 2e4])
    @pytest.mark.parametrize("drive", [50.0, 1.8e4, 1e15])
    def test_two_masses_against_elements(self, rope: float, drive: float) -> None:
        count, load, stiffness = 60, 3e3, 1.4e5
        mass, stiff = np.zeros((2 * count + 1,) * 2), np.zeros((2 * count + 1,) * 2)
        for k in range(count):
            place = slice(2 * k, 2 * k + 3)
            mass[place, place] += rope / count / 30 * np.array([[4, 2, -1], [2, 16, 2], [-1, 2, 4]])
            stiff[place, place] += stiffness * count / 3 * np.array([[7, -8, 1], [-8, 16, -8], [1, -8, 7]])
        mass[-1, -1] += load
        mass[0, 0] += drive
        shift = 1.0  # keeps the travel off 0, where the stiffness is singular
        found = eigh(mass, stiff + shift * mass, eigvals_only=True)  # the reciprocals, so that small ones keep digits
        squares = np.sort(1 / found - shift)
        ours = rope_rod.free_rod_frequency(stiffness, rope, drive, load)
        assert ours**2 == pytest.approx(squares[1], rel=1e-6)

    def test_a_drive_that_stands_is_the_end_of_a_rod(self) -> None:
        for ratio in (1e-6, 0.06, 3.0):
            held = rope_rod.rod_frequency(1.4e5, ratio * 3e3, 3e3, 1)
            assert rope_rod.free_rod_frequency(1.4e5, ratio * 3e3, 1e30, 3e3) == pytest.approx(held, rel=1e-12)

    @pytest.mark.parametrize("ratio", [1e-6, 1e-3, 0.06, 0.3, 1.0, 5.0, 1e3])
    def test_the_third_of_the_rope_errs_as_it_says(self, ratio: float) -> None:
        above = rope_rod.third_mass_frequency(1e5, ratio, 1.0) / rope_rod.rod_frequency(1e5, ratio, 1.0, 1) - 1
        assert -1e-14 <= above <= min(ratio**2 / 90, 2 * math.sqrt(3) / math.pi - 1) + 1e-14

    def test_without_mass(self) -> None:
        assert rope_rod.rod_frequency(8e4, 0.0, 2e3, 1) == math.sqrt(40.0)
        assert rope_rod.rod_frequency(8e4, 0.0, 2e3, 2) == math.inf
        assert rope_rod.rod_frequency(8e4, 1e-12, 2e3, 1) == pytest.approx(math.sqrt(40.0), rel=1e-14)


def strain_by_steps(EA: float, M: float, V: float, l0: float, l1: float, e: float, r: float) -> tuple[float, float]:
    def rate(t: float, y: np.ndarray) -> list[float]:
        length = l0 - V * t
        return [y[1], V / length * y[1] - EA / (M * length) * y[0]]

    found = solve_ivp(rate, (0, (l0 - l1) / V), [e, r], "DOP853", rtol=1e-12, atol=1e-14 * (abs(e) + abs(r)))
    return float(found.y[0, -1]), float(found.y[1, -1])


class TestHauling:
    @pytest.mark.parametrize(
        "machine",
        [
            (1.68e7, 3e3, 1.5, 120.0, 15.0),
            (1e3, 3e3, 1.5, 120.0, 0.01),
            (1e2, 3e3, 1.5, 12.0, 0.1),
            (1e7, 30.0, 20.0, 12.0, 1.0),
            (1e5, 3e3, 1.5, 120.0, 1.0),
            (5e3, 3e3, 0.9, 12.0, 11.9),
        ],
    )
    @pytest.mark.parametrize("start", [(1.0, 0.0), (0.2, -3.0)])
    def test_against_steps(self, machine: tuple[float, ...], start: tuple[float, float]) -> None:
        found, other = rope_rod.hauled_strain(*machine, *start), strain_by_steps(*machine, *start)
        EA, M, _, _, l1 = machine
        w = math.sqrt(EA / (M * l1))
        size = math.hypot(other[0], other[1] / w)
        assert abs(found[0] - other[0]) <= 1e-8 * size
        assert abs(found[1] - other[1]) <= 1e-8 * size * w

    def test_c17(self) -> None:
        EA, mu, l0, M, V, l1 = C17.values()
        stiffness, rope = EA / l0, mu * l0
        assert math.sqrt(stiffness / rope) * l0 == pytest.approx(3346.64, rel=PRINTED)
        assert rope_rod.rod_root(rope / M, 1) == pytest.approx(0.242526, rel=PRINTED)
        exact = rope_rod.rod_frequency(stiffness, rope, M, 1)
        assert exact == pytest.approx(6.76373, rel=PRINTED)
        assert rope_rod.third_mass_frequency(stiffness, rope, M) == pytest.approx(6.764, rel=PRINTED)
        assert rope_rod.rod_frequency(stiffness, 0.0, M, 1) / exact - 1 == pytest.approx(0.00998954, rel=PRINTED)
        strain, rate = rope_rod.hauled_strain(EA, M, V, l0, l1, 0.02 / l0, 0.0)
        assert strain == pytest.approx(-0.000268888, rel=PRINTED)
        amplitude = math.hypot(strain, rate / math.sqrt(EA / (M * l1)))
        assert amplitude == pytest.approx(0.000280397, rel=PRINTED)
        assert amplitude / (0.02 / l0) == pytest.approx(1.68238, rel=PRINTED)
        gain = float(rope_rod.hauling_gain(l0, l1))
        assert gain == pytest.approx(1.68179, rel=PRINTED)
        assert abs(amplitude / (0.02 / l0) / gain - 1) <= V / (4 * math.sqrt(EA * l1 / M))

    def test_paying_out(self) -> None:
        """Stretch of a rope fed with a frozen strain: its force falls with the power 3/4."""
        EA, M, V, l0, l1 = 1.68e7, 3e3, 1.5, 15.0, 120.0

        def rate(t: float, y: np.ndarray) -> list[float]:
            return [y[1], -EA / (M * (l0 + V * t)) * y[0]]

        end = solve_ivp(rate, (0, (l1 - l0) / V), [0.02, 0.0], "DOP853", rtol=1e-11, atol=1e-14).y[:, -1]
        amplitude = math.hypot(end[0], end[1] / math.sqrt(EA / (M * l1)))
        gain = (amplitude / l1) / (0.02 / l0)
        assert gain == pytest.approx(float(rope_rod.paying_out_gain(l0, l1)), rel=V / (4 * math.sqrt(EA * l0 / M)))


def test_first_wave_of_a_snatch() -> None:
    """A long chain of small masses, its end pulled at 0.4 m/s: the force behind the front, before it arrives."""
    count, stiffness, rope, speed = 400, 1.4e5, 180.0, 0.4
    each, k = rope / count, stiffness * count
    x, v, step = np.zeros(count), np.zeros(count), 0.2 * math.sqrt(rope / stiffness) / count
    forces = []
    for i in range(int(0.7 * math.sqrt(rope / stiffness) / step)):
        ends = np.concatenate([[speed * (i + 0.5) * step], x])
        pull = k * (ends[:-1] - ends[1:])
        forces.append(pull[0])
        v += step / each * (pull - np.append(pull[1:], 0.0))
        x += step * v
    behind = np.mean(forces[len(forces) // 2 :])
    assert behind == pytest.approx(float(rope_rod.snatch_wave_force(speed, stiffness, rope)), rel=2e-3)
