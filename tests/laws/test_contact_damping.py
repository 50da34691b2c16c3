"""The damping that stands for a restitution, against the motion of a mass that hits a spring and a dashpot."""

import math

import pytest
from scipy.integrate import solve_ivp

from ptmcalc.laws.contact_damping import dashpot_ratio


def left(ratio: float) -> float:
    """Speed with which a unit mass leaves a unit spring and its dashpot as soon as they would pull."""

    def push(t: float, y: list[float]) -> float:
        return y[0] + 2 * ratio * y[1]

    push.terminal, push.direction = True, -1  # type: ignore[attr-defined]
    found = solve_ivp(
        lambda t, y: [y[1], -push(t, y)], (0, 1e3), [0.0, 1.0], "Radau", events=push, rtol=1e-10, atol=1e-13
    )
    return -float(found.y_events[0][0][1])


@pytest.mark.parametrize("restitution", [0.02, 0.1, math.exp(-2), 0.3, 0.6, 0.9, 0.999])
def test_a_mass_leaves_with_its_share(restitution: float) -> None:
    assert left(dashpot_ratio(restitution)) == pytest.approx(restitution, rel=1e-6)


def test_both_ends() -> None:
    assert dashpot_ratio(1.0) == 0.0
    assert dashpot_ratio(math.exp(-2)) == pytest.approx(1.0, rel=1e-6)
    assert dashpot_ratio(0.0) > 1e5


@pytest.mark.parametrize("restitution", [-0.1, 1.1, math.nan])
def test_what_is_no_restitution(restitution: float) -> None:
    with pytest.raises(ValueError, match="between 0 and 1"):
        dashpot_ratio(restitution)
