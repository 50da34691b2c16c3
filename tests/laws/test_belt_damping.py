"""Damping of a wave by its complex frequency: roots of the modes' polynomials, which the laws do not know of."""

import numpy as np
import pytest

from ptmcalc.laws import belt_damping


@pytest.mark.parametrize("retardation", [1e-4, 0.01, 0.3])
def test_a_kelvin_voigt_mode_decays_at_this_share_of_critical(retardation: float) -> None:
    w = 1.7
    root = np.roots([1.0, w * w * retardation, w * w])[0]
    assert belt_damping.kelvin_voigt_change(w, retardation) == pytest.approx(-root.real / abs(root), rel=1e-12)


@pytest.mark.parametrize("loss_factor", [0.0, 1e-3, 0.05])
def test_a_hysteretic_mode_decays_at_half_its_loss_factor(loss_factor: float) -> None:
    root = np.sqrt(complex(1.0, loss_factor))
    assert belt_damping.hysteretic_change(loss_factor) == pytest.approx(root.imag / abs(root), rel=loss_factor**2)


@pytest.mark.parametrize("relaxation", [1e-3, 0.05, 0.6, 40.0])
def test_a_zener_mode_moves_so_far_in_the_complex_plane(relaxation: float) -> None:
    w, stiffening = 1.7, 1e-3
    roots = np.roots([relaxation, 1.0, w * w * (1 + stiffening) * relaxation, w * w])
    root = roots[np.argmax(roots.imag)]
    found = belt_damping.zener_change(w, relaxation, stiffening)
    assert found == pytest.approx(abs(root - 1j * w) / w, rel=2 * stiffening)


def test_a_slow_wave_hardly_notices_and_a_quick_one_finds_the_belt_stiffer() -> None:
    assert belt_damping.zener_change(1e-9, 0.1, 0.4) < 1e-10
    assert belt_damping.zener_change(1e9, 0.1, 0.4) == pytest.approx(0.2)
