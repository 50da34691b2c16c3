"""Random trains: the energy ledger closes in every one, and an independent state machine moves them alike."""

import pytest
from support.hybrid import simulate
from support.random_trains import machine
from support.trains import run, train_of


@pytest.mark.parametrize("seed", range(60))
def test_the_ledger_of_linear_laws_closes(seed: int) -> None:
    """Springs with gaps, lossy gears, brakes with static friction, clutches: to 1e-9, without a warning."""
    found = run(train_of(machine(seed)), 2.0, closes=1e-9)
    assert found.record.time == 2.0


@pytest.mark.parametrize("seed", range(1000, 1016))
def test_the_ledger_of_curved_laws_closes(seed: int) -> None:
    """With the contact law of Hunt and Crossley among them: to ten times the tolerance."""
    found = run(train_of(machine(seed, curves=True)), 2.0, closes=1e-7, tolerance=1e-8)
    assert found.record.time == 2.0


def agrees(seed: int, curves: bool, digits: float) -> None:
    chosen = machine(seed, curves)
    other, found = simulate(chosen, 1.0), run(train_of(chosen), 1.0)
    bodies = range(len(chosen.inertias))
    path = max(1e-3, *(abs(x) for x in other.positions))
    fast = max(1e-3, *(max(abs(other.highest["speed", b]), abs(other.lowest["speed", b])) for b in bodies))
    pull = max(
        [1.0, *(max(abs(other.highest["link", k]), abs(other.lowest["link", k])) for k in range(len(chosen.links)))]
    )
    sizes = {"position": path, "speed": fast, "link": pull}
    for body in bodies:
        assert found.last("position", body) == pytest.approx(other.positions[body], abs=digits * path)
        assert found.last("speed", body) == pytest.approx(other.speeds[body], abs=digits * fast)
    for (what, index), highest in other.highest.items():
        assert found.top(what, index) == pytest.approx(highest, abs=digits * sizes[what])
        assert found.bottom(what, index) == pytest.approx(other.lowest[what, index], abs=digits * sizes[what])


@pytest.mark.parametrize("seed", range(16))
def test_against_the_state_machine(seed: int) -> None:
    agrees(seed, False, 1e-8)


@pytest.mark.parametrize("seed", range(1000, 1006))
def test_curves_against_the_state_machine(seed: int) -> None:
    agrees(seed, True, 1e-8)
