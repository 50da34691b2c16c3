"""A cycle that is impossible fails with the work that is missing or left over, and with what would do."""

import math
from pathlib import Path

import pytest
from support.command import ptmcalc

HERE = Path(__file__).parent


def failure(name: str) -> str:
    done = ptmcalc("check", HERE / name, "--no-repairs")
    return next(line for line in done.out.splitlines() if "SHF101" in line)


def test_losses_above_the_torque_of_the_motor() -> None:
    """100 N*m do 628.3 J in a turn, 120 N*m of friction take 754.0 J."""
    line = failure("shaft-impossible.yaml")
    assert ": fail SHF101" in line
    assert "120 %" in line
    assert "125.7 J are missing" in line
    assert "more than 120 N*m would be sufficient" in line


def test_a_motor_that_the_load_never_holds() -> None:
    """216*2 pi = 1357.17 J in a turn against 500*1.2 + 120*2 pi = 1353.98 J: 3.186 J too much."""
    line = failure("constant_motor_216.yaml")
    assert (216 - 120) * 2 * math.pi - 600 == pytest.approx(3.186, abs=1e-3)
    assert ": fail SHF101" in line
    assert "3.186 J more in each cycle" in line
    assert "accelerates without limit" in line
