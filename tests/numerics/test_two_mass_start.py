"""Two masses, a spring that never pushes and a load that sticks, against DOP853 from event to event."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ptmcalc.numerics.two_mass_start import two_mass_start

M1, M2, K = 900.0, 5000.0, 4e5


def by_dop853(
    m1: float, m2: float, b: float, w: float, times: np.ndarray, forces: np.ndarray, window: float
) -> tuple[float, float | None]:
    """Largest force and when the load first moves: a spring of steps so short that contact hardly matters."""
    state, now, sliding, loose, most = np.zeros(4), 0.0, False, None, 0.0

    def spring(y: np.ndarray) -> float:
        x = y[0] - y[1]
        return max(0.0, K * x + b * (y[2] - y[3])) if x > 0 else 0.0

    while now < window - 1e-12:

        def rate(t: float, y: np.ndarray, sliding: bool = sliding) -> list[float]:
            s = spring(y)
            return [y[2], y[3], (np.interp(t, times, forces) - s) / m1, (s - w) / m2 if sliding else 0.0]

        def event(t: float, y: np.ndarray, sliding: bool = sliding) -> float:
            return float(y[3]) if sliding else spring(y) - w

        event.terminal = True  # type: ignore[attr-defined]
        event.direction = -1 if sliding else 1  # type: ignore[attr-defined]
        run = solve_ivp(rate, (now, window), state, "DOP853", events=event, rtol=1e-9, atol=1e-12, max_step=2e-3)
        most = max(most, max(spring(y) for y in run.y.T))
        state, now = run.y[:, -1], float(run.t[-1])
        if now >= window - 1e-12:
            break
        if not sliding and loose is None:
            loose = now
        sliding = not sliding
        if not sliding:
            state[3] = 0.0
    return most, loose


CASES = {
    "step": (M1, M2, 0.0, 6e3, [0.0], [1e4], 0.9),
    "a load nearly too heavy": (M1, M2, 0.0, 9e3, [0.0], [1e4], 0.9),
    "damped ramp": (M1, M2, 3e3, 6e3, [0.0, 0.4], [0.0, 1.2e4], 1.4),
    "a heavy drive let go": (9e3, 500.0, 200.0, 6e3, [0.0, 0.2, 0.3], [3e4, 3e4, 0.0], 1.2),
    "too weak": (M1, M2, 0.0, 3e4, [0.0], [1e4], 0.9),
}


@pytest.mark.parametrize("name", CASES)
def test_peak_and_breakaway(name: str) -> None:
    m1, m2, b, w, times, forces, window = CASES[name]
    found = two_mass_start(m1, m2, K, b, w, np.array(times), np.array(forces), window)
    most, loose = by_dop853(m1, m2, b, w, np.array(times), np.array(forces), window)
    assert found.largest == pytest.approx(most, rel=2e-4)
    assert (found.breaks_loose is None) == (loose is None)
    if loose is not None:
        assert found.breaks_loose == pytest.approx(loose, abs=1e-6)


def test_a_chain_never_pushes() -> None:
    """A drive that is let go runs into slack chain and is caught again."""
    m1, m2, b, w, times, forces, window = CASES["a heavy drive let go"]
    assert two_mass_start(m1, m2, K, b, w, np.array(times), np.array(forces), window).slack == 0
    found = two_mass_start(m1, m2, K, 0.0, w, np.array(times), np.array(forces), 2.0)
    assert found.slack >= 1


def test_without_resistance_it_moves_at_once() -> None:
    found = two_mass_start(M1, M2, K, 0.0, 0.0, np.zeros(1), np.array([1e4]), 0.5)
    assert found.breaks_loose == 0.0
    assert found.largest == pytest.approx(2e4 * M2 / (M1 + M2), rel=1e-9)
