"""Dynamic factors of the crane standards that no event of the machine stands behind: phi_1, phi_5, phi_6.

The others: phi_2 `lift_off_standard`, phi_3 `lift_off.release_factor`, phi_4 `rail`, phi_7 `buffer.buffer_factor`.
"""

from collections.abc import Mapping
from types import MappingProxyType

BY_CHANGE, BY_CONTROL = "by_change", "by_control"
"""Editions of phi_5: how fast the drive force changes (older EN 13001-2, ISO 8686-1:1989; recommended, since it can be
compared with a simulation), or how the drive is controlled (newer ones)."""
DRIVE_CHANGES: Mapping[str, tuple[float, float]] = MappingProxyType(
    {"centrifugal": (1.0, 1.0), "smooth": (1.0, 1.5), "sudden": (1.5, 2.0), "backlash": (3.0, 3.0)}
)
"""Range of phi_5 by the change of the drive force: none, smooth, sudden, sudden with a large backlash."""
DRIVE_CONTROLS: Mapping[str, tuple[float, float]] = MappingProxyType(
    {"stepless": (1.2, 1.5), "multi_step": (1.6, 2.0), "two_step": (1.8, 2.2), "single_step": (2.0, 2.4)}
)
"""phi_5 by the control of the drive, with usual and with large backlash (open gears); quoted from memory, to be
confirmed."""
TEST_LOADS: Mapping[str, tuple[float, float]] = MappingProxyType({"en_13001_2": (1.1, 1.25), "fem_1_001": (1.2, 1.4)})
"""Test loads over the rated load, dynamic and static; those of FEM quoted from memory, to be confirmed."""


def hoisting_factors(spread: float) -> tuple[float, float]:
    """Dynamic factors phi_1 of the crane's own mass while it lifts a load off the ground.

        phi_1 = 1 - a, 1 + a

    Args:
        spread: a, 0 to 0.1; 0.1 unless it is known better [1].

    Returns:
        (least, most): the worse of both counts for every part [1].

    Raises:
        ValueError: for a spread outside 0 to 0.1.

    **Range** 0 <= a <= 0.1.
    **Error** none: a convention of the standard.
    **Source** EN 13001-2, ISO 8686-1.
    """
    if not 0 <= spread <= 0.1:
        raise ValueError("the own mass of a crane is shaken by 0 to 0.1 of its weight")
    return 1 - spread, 1 + spread


def drive_factor(change: str, large_backlash: bool, edition: str = BY_CHANGE) -> tuple[float, float]:
    """Dynamic factor phi_5 of a change of drive forces.

        F = F_i + phi_5 (F_f - F_i);   phi_5 from `DRIVE_CHANGES` or `DRIVE_CONTROLS`

    Args:
        change: of `DRIVE_CHANGES` (`by_change`) or `DRIVE_CONTROLS` (`by_control`).
        large_backlash: whether the gear has much of it, as open gears have.
        edition: `by_change` or `by_control`.

    Returns:
        (least, most) of its range; equal where the standard knows one number [1].

    Raises:
        ValueError: for another edition, or a change it does not know.

    **Range** drives that start and stop; not those that are simulated: a step gives 2, `shock.step_factor`.
    **Error** none bound: a convention of the standard.
    **Source** EN 13001-2, ISO 8686-1, tables of phi_5.
    """
    table = {BY_CHANGE: DRIVE_CHANGES, BY_CONTROL: DRIVE_CONTROLS}.get(edition)
    if table is None or change not in table:
        raise ValueError(f"no phi_5 for {change} in the edition {edition}")
    if edition == BY_CONTROL:
        factor = table[change][int(large_backlash)]
        return factor, factor
    return table["backlash" if large_backlash and change != "centrifugal" else change]


def load_test_factors(lift_off_factor: float) -> tuple[float, float]:
    """Dynamic factors phi_6 of the test loads.

        dynamic: phi_6 = 0.5 (1 + phi_2)      static: phi_6 = 1

    Args:
        lift_off_factor: phi_2, of the rated load [1].

    Returns:
        (dynamic, static), on `TEST_LOADS` times the rated load [1].

    **Range** test loads hoisted with care.
    **Error** none: a convention of the standard.
    **Source** EN 13001-2, ISO 8686-1; FEM 1.001 with its own test loads.
    """
    return (1 + lift_off_factor) / 2, 1.0
