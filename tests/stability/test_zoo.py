"""Every hard machine through the pipeline of `ptmcalc check`: a right outcome, or a clear word that there is none.

What is right stands on top of each file of `specs/`; `support.zoo` reads it, and holds every run against what is never
right: a number that is none or lies outside its interval, a verdict that no number bears, energy that is left over,
more work than the file allows, two runs of a scene without a common value, be it of the next finer setting or of
another method. Warnings are errors.
"""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest import mock

import pytest
from support.zoo import checked, contradictions, expected, faulty, hard_machines, is_wrong, never_right

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.estimate import Estimate
from ptmcalc.engine import purse as engine_purse
from ptmcalc.engine.settled import Run, Settled

SPECS = Path(__file__).parent / "specs"
STUDY_SECONDS = 20.0


@pytest.mark.parametrize("path", hard_machines(SPECS), ids=lambda path: path.stem)
def test_hard_machine(path: Path) -> None:
    assert is_wrong(path.read_text("utf-8"), path.name) == []


@pytest.mark.study
@pytest.mark.parametrize("path", hard_machines(SPECS), ids=lambda path: path.stem)
def test_hard_machine_by_every_run_there_is(path: Path) -> None:
    assert is_wrong(path.read_text("utf-8"), path.name, tried=STUDY_SECONDS) == []


class TestTheCollectorItself:
    """It sees what it is there for: faults planted in a sound machine."""

    SOUND = (SPECS / "drivetrain_free_two_mass.yaml").read_text("utf-8")

    @pytest.mark.parametrize(
        ("line", "instead", "told"),
        [
            ("# expect: pass\n", "# expect: fail\n", "the file is `pass`"),
            ("# expect: pass\n", "# expect: pass\n# expect: NUM102\n", "findings"),
            ("pass DRV101", "fail DRV101", "DRV101"),
            ("450 within 1e-9", "451 within 1e-9", "torque_peak[shaft]"),
            ("450 within 1e-9", "inf", "torque_peak[shaft]"),
            ("= 450 within 1e-9", "unbounded", "not unbounded"),
            ("torque_peak[shaft]", "torque_peak[rope]", "there is no"),
            ("1200 evaluations", "1 evaluations", "evaluations"),
            ("400 steps", "1 steps", "steps"),
            ("3 kg*m^2", "3 kg", "refused for"),
        ],
    )
    def test_another_outcome_than_the_file_says(self, line: str, instead: str, told: str) -> None:
        assert line in self.SOUND
        assert any(told in one for one in is_wrong(self.SOUND.replace(line, instead, 1)))

    def test_comments_that_say_nothing(self) -> None:
        for text in ("# expect: peace\n", "# expect: pass\n# at most: 3 apples\n", "# expect: pass\n", "kind: shaft\n"):
            with pytest.raises(AssertionError):
                expected(text)

    @pytest.mark.parametrize(
        "wrong",
        [
            Estimate(math.nan, math.nan, math.nan),
            Estimate(3.0, 1.0, 2.0),
            Estimate(1.0, 0.0, math.nan),
            Estimate(1.0, 0.0, 2.0, numerical=-1.0),
        ],
    )
    def test_a_number_that_is_none_or_lies_outside_its_interval(self, wrong: Estimate) -> None:
        run = self._run()
        assert not list(faulty(run))
        assert list(faulty(self._with(run, wrong)))

    def test_two_runs_that_contradict_each_other(self) -> None:
        run = self._run()
        known = run.estimates["torque_peak[shaft]"]
        assert not contradictions([run, run])
        assert contradictions([run, self._with(run, Estimate.exact(known.high * (1 + 1e-6) + 1e-6))])

    def test_a_verdict_that_no_number_bears(self) -> None:
        report = checked(self.SOUND).report
        assert not never_right(report)
        scene = report.scenes[0]
        for value in (None, Estimate.unknown(), Estimate.unknown(1.0), Estimate.exact(1.0)):
            judged = replace(scene.checks[0], value=value, verdict=Verdict.FAIL)
            assert never_right(replace(report, scenes=(replace(scene, checks=(judged,)),)))

    def test_energy_that_is_left_over_or_not_told(self) -> None:
        for health in ({"energy_residual": 1e-4}, {"energy_residual": math.nan}, {}):
            assert any("energy" in one for one in self._wrong_with(health=health))

    def test_too_many_steps(self) -> None:
        assert any("steps" in one for one in self._wrong_with(health={"steps": 1e6, "energy_residual": 0.0}))

    def _run(self) -> Run:
        (settled,) = (settled for _, _, settled in checked(self.SOUND).settled)
        return next(run for run in settled.runs if "torque_peak[shaft]" in run.estimates)

    def _with(self, run: Run, one: Estimate) -> Run:
        return replace(run, estimates={**run.estimates, "torque_peak[shaft]": one})

    def _wrong_with(self, health: dict[str, float]) -> list[str]:
        """What is wrong with the sound machine, were this the health of its runs."""
        before = engine_purse.settle

        def planted(*given: Any, **options: Any) -> Settled:
            settled = before(*given, **options)
            settled.runs = [replace(run, result=replace(run.result, health=health)) for run in settled.runs]
            return settled

        with mock.patch("support.zoo.settle", planted):
            return is_wrong(self.SOUND)
