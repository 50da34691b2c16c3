"""Damping and harmonic response against impedances of complex numbers and integrated decays."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

from ptmcalc.laws import vibration

steady = settings(derandomize=True, database=None, deadline=None, max_examples=150)
MASS, STIFFNESS = 2000.0, 8e5
RATIOS = st.floats(0.0, 50.0)
DAMPINGS = st.floats(1e-3, 3.0)


def maxima(damping: float) -> np.ndarray:
    """(time, height) of successive maxima of the free vibration, by integration."""

    def rate(t: float, y: np.ndarray) -> list[float]:
        return [y[1], -(damping * y[1] + STIFFNESS * y[0]) / MASS]

    def turns(t: float, y: np.ndarray) -> float:
        return float(y[1])

    turns.direction = -1.0  # type: ignore[attr-defined]
    run = solve_ivp(rate, (0, 2), [0.0, 1.0], events=turns, rtol=1e-12, atol=1e-14)
    return np.column_stack([run.t_events[0], run.y_events[0][:, 0]])


def impedance(r: float, zeta: float) -> complex:
    """Force over deflection, in parts of the stiffness, at frequency ratio r."""
    return (1j * r) ** 2 + 2 * zeta * (1j * r) + 1


class TestFreeVibration:
    @pytest.mark.parametrize("damping", [400.0, 3180.58, 20000.0])
    def test_decrement_period_and_damping_belong_together(self, damping: float) -> None:
        peaks = maxima(damping)
        decrement = float(np.log(peaks[0, 1] / peaks[1, 1]))
        period = float(peaks[1, 0] - peaks[0, 0])
        zeta = vibration.damping_ratio(damping, STIFFNESS, MASS)
        assert float(vibration.decrement_of_damping_ratio(zeta)) == pytest.approx(decrement, rel=1e-8)
        assert float(vibration.damping_ratio_of_decrement(decrement)) == pytest.approx(zeta, rel=1e-8)
        assert vibration.damping_of_decrement(decrement, MASS, period) == pytest.approx(damping, rel=1e-8)
        natural = vibration.natural_frequency(STIFFNESS, MASS)
        assert vibration.damped_frequency(natural, zeta) == pytest.approx(2 * np.pi / period, rel=1e-8)

    def test_natural_frequency_is_a_root(self) -> None:
        roots = np.roots([MASS, 0.0, STIFFNESS])
        assert vibration.natural_frequency(STIFFNESS, MASS) == pytest.approx(max(roots.imag), rel=1e-14)

    @given(st.floats(0.0, 0.999))
    @steady
    def test_decrement_and_back(self, zeta: float) -> None:
        back = vibration.damping_ratio_of_decrement(vibration.decrement_of_damping_ratio(zeta))
        assert float(back) == pytest.approx(zeta, rel=1e-12, abs=1e-300)

    def test_nothing_vibrates_from_critical_damping_on(self) -> None:
        critical = 2 * np.sqrt(STIFFNESS * MASS)
        assert np.isreal(np.roots([MASS, 1.001 * critical, STIFFNESS])).all()
        assert vibration.damping_ratio(critical, STIFFNESS, MASS) == pytest.approx(1.0, rel=1e-14)
        for zeta in (1.0, 1.5):
            assert vibration.damped_frequency(20.0, zeta) == 0.0
            assert np.isinf(vibration.decrement_of_damping_ratio(zeta))


class TestHarmonic:
    @given(RATIOS, DAMPINGS)
    @steady
    def test_force(self, r: float, zeta: float) -> None:
        answer = 1 / impedance(r, zeta)
        assert float(vibration.amplification(r, zeta)) == pytest.approx(abs(answer), rel=1e-10)
        assert float(vibration.phase_lag(r, zeta)) == pytest.approx(-np.angle(answer), rel=1e-9, abs=1e-12)

    @given(RATIOS, DAMPINGS)
    @steady
    def test_moving_base_and_unbalance(self, r: float, zeta: float) -> None:
        carried = (1 + 2j * zeta * r) / impedance(r, zeta)
        assert float(vibration.transmissibility(r, zeta)) == pytest.approx(abs(carried), rel=1e-10)
        thrown = abs(r**2 / impedance(r, zeta))
        assert float(vibration.unbalance_amplification(r, zeta)) == pytest.approx(thrown, rel=1e-10)

    @pytest.mark.parametrize("zeta", [0.01, 0.0397573, 0.3, 0.7])
    def test_peak_is_where_a_search_finds_it(self, zeta: float) -> None:
        found = minimize_scalar(
            lambda r: abs(impedance(r, zeta)), bounds=(0, 1.5), method="bounded", options={"xatol": 1e-9}
        )
        assert float(vibration.resonance_ratio(zeta)) == pytest.approx(found.x, abs=1e-6)
        assert float(vibration.peak_amplification(zeta)) == pytest.approx(1 / found.fun, rel=1e-10)

    @pytest.mark.parametrize("zeta", [0.7072, 1.0, 4.0])
    def test_no_peak_above_a_damping_of_0_707(self, zeta: float) -> None:
        assert float(vibration.resonance_ratio(zeta)) == pytest.approx(0.0, abs=1e-7)
        assert float(vibration.peak_amplification(zeta)) == pytest.approx(1.0, rel=1e-14)
        assert max(1 / abs(impedance(r, zeta)) for r in np.linspace(0, 3, 200)) == 1.0

    def test_a_long_run_settles_to_it(self) -> None:
        """The integrated answer to a force, after its free vibration has died out."""
        zeta, r, natural = 0.1, 0.8, 20.0

        def rate(t: float, y: np.ndarray) -> list[float]:
            return [y[1], natural**2 * (np.sin(r * natural * t) - y[0]) - 2 * zeta * natural * y[1]]

        times = np.linspace(12, 12 + 2 * np.pi / (r * natural), 4001)
        late = solve_ivp(rate, (0, 13), [0.0, 0.0], t_eval=times, rtol=1e-10, atol=1e-12).y[0]
        assert late.max() == pytest.approx(float(vibration.amplification(r, zeta)), rel=1e-5)
        shifted = float(vibration.amplification(r, zeta)) * np.sin(
            r * natural * times - float(vibration.phase_lag(r, zeta))
        )
        assert late == pytest.approx(shifted, abs=1e-5)

    def test_resonance_without_damping_is_infinite(self) -> None:
        for law in (vibration.amplification, vibration.transmissibility, vibration.unbalance_amplification):
            assert np.isinf(law(1.0, 0.0))
        assert np.isinf(vibration.peak_amplification(0.0))
        assert float(vibration.phase_lag(1.0, 0.0)) == 0.0
