"""The values that failed checks are said to pass with: put into the file they pass, a step the wrong way they do not.

The failing machines are made of the specs: a check that passes is brought to fail by the very key its repair names,
well beyond the boundary. Files are changed as text here, by PyYAML's own loader, and read again from nothing.
"""

import math
from dataclasses import dataclass
from typing import Any

import pytest
import yaml
from support.command import ROOT

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import UsageError
from ptmcalc.base.span import KeyPath, dotted
from ptmcalc.base.units import RATIO
from ptmcalc.contract.check import AnyCheck
from ptmcalc.contract.report import Judgement
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import Loaded, load_text, measure_at
from ptmcalc.engine.policy import Choice
from ptmcalc.engine.repair import states_a_limit
from ptmcalc.engine.solve import SearchPurse, solve

SPECS = sorted(
    path.relative_to(ROOT).as_posix() for path in (ROOT / "specs").rglob("*.yaml") if "winding_paper" not in path.parts
)
BEYOND = (1.12, 1.03, 1.4, 2.0, 5.0)
"""How far beyond the boundary the failing machines lie, the first that fails with a repair: the key is that much larger
or smaller. One may be open so near the limit, a forbidden band be passed by so far."""
LEAST_STEP = 0.01
EVERY_RUN = {
    "specs/conveyor.yaml": "CNV103",
    "specs/short_conveyor.yaml": "CNV103",
    "specs/chain_drive/roller_drive.yaml": "CHN104",
    "specs/hoist.yaml": "HST117",
    "specs/crane_slewing.yaml": "CRN113",
    "specs/crane_travelling.yaml": "CRN150",
    "specs/crane_rack_stacker.yaml": "CRN204",
    "specs/crane_overhead_stacker.yaml": "CRN281",
    "specs/crusher_shaft.yaml": "SHF104",
    "specs/drivetrain.yaml": "DRV108",
}
"""A check of a machine of each sort; a study looks at all checks of all files."""


@dataclass(frozen=True)
class Case:
    """A check of a scene, the key that its repair may move, and the machine."""

    loaded: Loaded
    scene: str
    check: AnyCheck
    path: KeyPath

    @property
    def present(self) -> float:
        """What the file says (SI)."""
        assert self.loaded.spec is not None
        return float(self.loaded.spec.value_at(self.path))

    @property
    def counts(self) -> bool:
        """Whether the key is a whole number."""
        assert self.loaded.spec is not None
        return measure_at(self.loaded.spec, self.path) is None

    def beyond(self, edge: float, towards: float, factor: float) -> float:
        """A value so much farther on the side of `towards`, of a count the next whole number at least."""
        value = edge * factor if towards > edge else edge / factor
        if not self.counts:
            return value
        return float(max(math.floor(value), edge + 1) if towards > edge else min(math.ceil(value), edge - 1))

    def back(self, value: float, towards: float, bar: float) -> float:
        """A step the wrong way: the largest of 1 %, the relative bar, and 1 of a count, which takes whole steps."""
        step = max(LEAST_STEP, bar) * abs(value)
        return value + math.copysign(max(math.floor(step), 1) if self.counts else step, towards - value)

    def judged(self, value: float, *, repairs: bool = False) -> Judgement | None:
        """The verdict where the file says another value; None where that is no valid file."""
        again = load_text(written(self.loaded, self.path, value), self.loaded.document.name)
        if again.spec is None:
            return None
        own = Choice(select=(self.check.code,))
        report = check(again, Options(scenes=(self.scene,), repairs=repairs, counting=own))
        return next(
            one for _, one in report.judgements if (one.code, one.element) == (self.check.code, self.check.element)
        )


class Core(yaml.SafeLoader):
    """PyYAML's loader, for which `off` is no truth value, as YAML 1.2 has it."""

    yaml_implicit_resolvers = {
        first: [one for one in known if first in "tTfF" or one[0] != "tag:yaml.org,2002:bool"]
        for first, known in yaml.SafeLoader.yaml_implicit_resolvers.items()
    }


def written(loaded: Loaded, path: KeyPath, value: float) -> bytes:
    """The file with another value (SI) at a key."""
    data = yaml.load((ROOT / loaded.document.name).read_text(encoding="utf-8"), Core)
    node: Any = data
    for step in path[:-1]:
        node = node[step]
    assert loaded.spec is not None
    measure = measure_at(loaded.spec, path)
    if measure is None:
        assert value == int(value), "a count is a whole number"
        node[path[-1]] = int(value)
    else:
        bare = measure.quantity.dimension == RATIO.dimension
        node[path[-1]] = value if bare else f"{value!r} {measure.quantity.si}"
    return yaml.safe_dump(data, sort_keys=False).encode()


def cases(name: str) -> list[Case]:
    """The checks of a file that pass and whose repair names a key that the file writes and that may be offered."""
    loaded = load_text((ROOT / name).read_bytes(), name)
    assert loaded.kind is not None
    assert loaded.spec is not None
    found = []
    scenes = {scene.label: scene for scene in loaded.spec.all_scenes}
    for scene, judgement in check(loaded, Options(repairs=False)).judgements:
        own = next(one for one in loaded.kind.checks if one.code == judgement.code)
        one = next(one for one in own.on(loaded.spec, scenes[scene.name]) if one.element == judgement.element)
        path = judgement.blame.path if one.repairs_blame else one.repair(loaded.spec, scenes[scene.name])
        offered = path and loaded.document.holds(path) and not states_a_limit(loaded.spec, path)
        if judgement.verdict is Verdict.PASS and offered:
            found.append(Case(loaded, scene.name, one, path))
    return found


def broken(case: Case, seconds: float) -> tuple[float, Judgement] | None:
    """A value that fails and has a repair, and what is said of it: beyond the boundary, which is looked for so many
    predicted seconds, or else beyond the present value."""
    try:
        edge = solve(case.loaded, case.check, case.path, case.scene, purse=SearchPurse(seconds))
    except UsageError:
        return None
    starts = [(case.present, 2 * case.present), (case.present, 0.0)]
    if edge is not None:
        starts = [(edge.value, math.inf if edge.value >= case.present else 0.0)]
    for factor in BEYOND:
        for start, towards in starts:
            failing = case.beyond(start, towards, factor)
            found = case.judged(failing, repairs=True)
            if found is not None and found.verdict is Verdict.FAIL and found.repair is not None:
                return failing, found
    return None


def holds(case: Case, seconds: float) -> bool:
    """Whether a failing variant could be made within so many predicted seconds; asserts what is said of its repair."""
    variant = broken(case, seconds)
    if variant is None:
        return False
    failing, found = variant
    assert found.repair is not None
    assert found.repair.path == case.path
    for value in filter(None, (found.repair.value, found.repair.other)):
        mended = case.judged(value)
        assert mended is not None
        assert mended.verdict is Verdict.PASS, (case.loaded.document.name, case.scene, case.check.code, value)
        assert mended.value is not None
        bar = mended.value.bar / abs(mended.value.value) if mended.value.value else 0.0
        wrong = case.back(value, failing, bar)
        back = case.judged(wrong)
        assert back is None or back.verdict is not Verdict.PASS, (case.scene, case.check.code, value, wrong)
    return True


@pytest.mark.parametrize(("name", "code"), EVERY_RUN.items())
def test_a_repair_passes_and_a_step_the_wrong_way_does_not(name: str, code: str) -> None:
    assert holds(next(case for case in cases(name) if case.check.code == code), seconds=1.0)


RESONANT = b"""
kind: chain_drive
layout:
  type: conveyor
  length: 40 m
  load: 120 kg/m
  resistance: {coefficient: 0.1, turn_factor: 1}
  takeup: {type: gravity, tension: 20 kN}
chain: {pitch: 320 mm, mass: 80 kg/m, breaking_load: 1300 kN, stiffness: 329.6 MN, damping: {ratio: 0.05}}
sprocket: {teeth: 8}
speed: 1.532 m/s
scenes: [{type: run}]
"""


def test_of_a_forbidden_band_both_edges_are_given() -> None:
    """The first harmonic meets the first frequency at 1.782 m/s (c/4L of the carry strand), with 15 % either way."""
    found = check(load_text(RESONANT, "resonant.yaml"), Options())
    (judgement,) = [one for _, one in found.judgements if one.code == "CHN101"]
    assert judgement.verdict is Verdict.FAIL
    assert judgement.repair is not None
    assert judgement.repair.value == pytest.approx(0.85 * 1.782, rel=1e-3)
    assert judgement.repair.other == pytest.approx(1.15 * 1.782, rel=1e-3)
    for speed, verdict in (
        (judgement.repair.value, Verdict.PASS),
        (1.01 * judgement.repair.value, Verdict.FAIL),
        (0.99 * judgement.repair.other, Verdict.FAIL),
        (judgement.repair.other, Verdict.PASS),
    ):
        again = check(load_text(RESONANT.replace(b"1.532", str(speed).encode()), "resonant.yaml"), Options())
        assert [one.verdict for _, one in again.judgements if one.code == "CHN101"] == [verdict], speed


@pytest.mark.study
@pytest.mark.parametrize("name", SPECS)
def test_every_repair_of_a_file_passes_and_a_step_the_wrong_way_does_not(name: str) -> None:
    """Prints of each file how many of its checks were made to fail with a repair, and which were not."""
    found = cases(name)
    held = [holds(case, seconds=6.0) for case in found]
    print(f"{name}: {sum(held)} of {len(found)}")
    for case in (case for case, tested in zip(found, held, strict=True) if not tested):
        print(f"  no failing variant with a repair: {case.scene} {case.check.code} {dotted(case.path)}")
    assert sum(held) >= len(found) // 3
