"""Which of many inputs a run takes: the first, or another part at every commit; the nightly run takes all of them."""

import os
import subprocess
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import PurePosixPath
from typing import Any

import pytest

from support.command import ROOT

BY_TEST = {
    # Random or extreme machines, each like the next.
    "tests/stability": 16,
    "tests/edges/drivetrain/test_overhauling.py::test_the_worst_moment_decides": 3,
    "tests/edges/test_assumption_uses.py::test_an_assumed_value_changes_nothing_elsewhere": 3,
    "tests/edges/test_error_bars_meet.py": 12,
    "tests/edges/test_forced_effects.py": 12,
    "tests/edges/test_found_is_said.py": 12,
    "tests/edges/test_longer_windows.py": 12,
    "tests/edges/test_motor_curves.py": 12,
    "tests/edges/test_relations.py": 12,
    "tests/machines/hoist/test_motion.py::test_absurd_sizes_end_in_a_report_of_numbers": 6,
    # One formula or one motion over a grid of its parameters; each value runs through the same lines.
    "tests/laws/test_belt_modes.py::TestTrace": 4,
    "tests/laws/test_rail.py::TestTwoMasses::test_no_load_at_the_wheels_is_beyond_the_sum_of_both": 3,
    "tests/machines/conveyor/test_loading_points.py::test_starts_and_stops_are_those_of_finite_elements": 5,
    "tests/machines/conveyor/test_scenes.py::test_every_load_is_that_of_finite_elements": 3,
    "tests/machines/conveyor/test_static_starts.py::test_a_start_at_the_margins_neither_slips_nor_goes_slack": 4,
    "tests/machines/conveyor/test_torque_following.py::test_one_drive_leads_and_the_torques_have_one_ratio": 3,
    "tests/numerics/test_belt_give.py::test_sag_damping_and_friction_agree_with_finite_elements": 4,
    "tests/numerics/test_belt_march.py": 6,
    "tests/numerics/test_belt_travel.py::test_finite_differences_come_to_the_same_tensions": 5,
    "tests/numerics/test_driven_modes.py::test_extremes_are_those_of_an_integration": 3,
    "tests/numerics/test_glide.py::TestSums::test_extremes_are_those_of_the_closed_form": 4,
    "tests/numerics/test_glide.py::TestSums::test_runs_that_resolve_every_period_find_the_same": 4,
    "tests/numerics/test_harmonic.py::TestErrorsAreBounds::test_of_random_chains": 4,
    "tests/numerics/test_harmonic.py::TestOneFrequency::test_forces_are_those_of_finite_elements": 4,
    "tests/numerics/test_mode_sum.py::test_samples_are_those_of_the_equations_of_motion": 5,
    "tests/numerics/test_rope.py": 6,
    "tests/numerics/test_train_random.py": 4,
    # The same statement of one machine or check after another; the statement is made by lines that all of them share.
    "tests/cli/test_decode_command.py::test_the_losses_of_a_run_out": 3,
    "tests/cli/test_decode_command.py::test_the_torque_of_a_brake": 3,
    "tests/cli/test_decode_command.py::test_the_curve_of_a_motor": 3,
    "tests/cli/test_decode_command.py::test_a_strange_record_ends_in_numbers_or_in_a_message": 6,
    "tests/cli/test_scale_command.py::test_every_kind_has_a_model_by_every_law": 3,
    "tests/engine/test_points.py::test_lanes_are_files_of_their_own": 4,
    "tests/engine/test_repairs.py::test_a_repair_passes_and_a_step_the_wrong_way_does_not": 4,
    "tests/engine/test_scale.py::test_the_model_is_the_machine_with_every_value_at_its_scale": 4,
    "tests/machines/crane/test_stacker_blame.py::test_what_governs_is_blamed_and_its_repair_passes": 3,
    "tests/machines/crane/test_stacker_combinations.py::test_a_change_of_an_event_changes_its_combinations": 3,
    "tests/report/test_html.py::test_a_page_is_sound": 4,
    # Machines and processes that cost much; each of them stands for the others.
    "tests/cli/test_batch.py": 3,
    "tests/cli/test_cluster.py": 3,
    "tests/house/test_imports.py": 2,
    "tests/report/test_absent_effects.py": 3,
    "tests/report/test_one_screen.py": 3,
    # Pages whose commands run, and stored examples: what they print has tests of its own.
    "tests/house/test_docs.py": 8,
    "tests/house/test_explain.py::test_an_example_with_a_file_of_its_own_says_what_is_said": 3,
}
"""One test in so many runs at each commit: of a room, of a file, or of what is named in it."""
BY_FILE = {"tests/coverage": 20}
"""The same of whole files, whose tests share one sample of random machines."""
MANY = 3
"""Cases of one test that run at each commit; those of a longer table take turns: they run through the same lines."""
ALWAYS = (
    "tests/edges",
    "tests/house/test_specs.py",
    "tests/questions",
    "tests/reference",
    "tests/report/test_golden.py",
)
"""Rooms whose tables run as a whole at each commit: each case is a machine or an answer of its own."""


@cache
def commit() -> int:
    """A number that changes with every commit: `PTMCALC_TURN`, else the commit's hash; 0 outside a repository."""
    if given := os.environ.get("PTMCALC_TURN"):
        return int(given)
    command = ["git", "-C", str(ROOT), "rev-parse", "HEAD"]
    try:
        return int(subprocess.run(command, capture_output=True, text=True, check=True).stdout, 16)
    except (OSError, subprocess.CalledProcessError):
        return 0


def in_turn(parts: Sequence[Any]) -> list[Any]:
    """Parameters of a test: the part whose turn it is, and the others as a study."""
    turn = commit() % len(parts)
    return [pytest.param(part, marks=() if k == turn else pytest.mark.study) for k, part in enumerate(parts)]


def first_of(count: int, inputs: Sequence[Any]) -> list[Any]:
    """Parameters of a test: the first inputs, and the others as a study."""
    return [*inputs[:count], *(pytest.param(one, marks=pytest.mark.study) for one in inputs[count:])]


def share_of(turns: int, inputs: Sequence[Any]) -> list[Any]:
    """Parameters of a fixture that costs much: one in so many, another one at every commit, and the others as a
    study."""
    return [
        pytest.param(one, marks=pytest.mark.study if (k + commit()) % turns else ()) for k, one in enumerate(inputs)
    ]


def later(tests: Iterable[str], seconds: Mapping[str, float]) -> set[str]:
    """Of the names of tests, those whose turn is at another commit: of `BY_TEST`, of `BY_FILE` and of long tables.

    Files take their turns in the order of their seconds: each turn takes about as long.
    """
    places: dict[str, list[str]] = {}
    for name in tests:
        places.setdefault(name.partition("::")[0], []).append(name)
    found: set[str] = set()
    for room, turns in BY_FILE.items():
        files = sorted((file for file in places if _within(file, room)), key=lambda file: (-seconds.get(file, 0), file))
        found.update(name for k, file in enumerate(files) if (k + commit()) % turns for name in places[file])
    for room, turns in BY_TEST.items():
        path, _, test = room.partition("::")
        files = sorted(file for file in places if _within(file, path))
        names = [name for file in files for name in places[file] if not test or _named(name, test)]
        found.update(name for k, name in enumerate(names) if (k + commit()) % turns)
    for cases in _tables(places).values():
        turns = -(-len(cases) // MANY)
        found.update(name for k, name in enumerate(cases) if (k + commit()) % turns)
    return found


def _tables(places: Mapping[str, Sequence[str]]) -> dict[str, list[str]]:
    """The cases of each test that has no turns of its own."""
    own = [room.partition("::") for room in BY_TEST]
    found: dict[str, list[str]] = {}
    for file, names in places.items():
        if any(_within(file, room) for room in (*ALWAYS, *BY_FILE)):
            continue
        tests = [test for path, _, test in own if _within(file, path)]
        for name in names:
            if "[" in name and not any(not test or _named(name, test) for test in tests):
                found.setdefault(name.partition("[")[0], []).append(name)
    return found


def _within(file: str, room: str) -> bool:
    return PurePosixPath(file).is_relative_to(room)


def _named(name: str, test: str) -> bool:
    """Whether a test is one of a function or of a class."""
    return name.partition("::")[2].partition("[")[0].split("::")[: test.count("::") + 1] == test.split("::")
