"""Design files for tests: the template of the conveyor, changed here and there."""

import copy
from dataclasses import replace
from typing import Any

import yaml

from ptmcalc.contract.report import FileReport, Judgement, LoadReport, SceneReport
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import Loaded, load_text
from ptmcalc.engine.registry import load_kind
from ptmcalc.machines.conveyor.machine.spec import Conveyor

BW_02: dict[str, Any] = {
    "kind": "conveyor",
    "route": {"length": "1000 m", "lift": "60 m", "inclination": "small_angle"},
    "belt": {"mass": "20 kg/m", "stiffness": "138 MN"},
    "idlers": {"carry": {"line_mass": "25 kg/m"}, "return": {"line_mass": "18 kg/m"}},
    "load": {"mass": "200 kg/m"},
    "resistance": {"coefficient": 0.025, "secondary": 1, "start_factor": 1},
    "speed": "4 m/s",
    "drive": {
        "motor": {"count": 3, "inertia": "6 kg*m^2", "mean_starting_torque": "3038.6666666667 N*m"},
        "coupling_inertia": "4 kg*m^2",
        "gear": {"ratio": 20, "efficiency": 0.94},
        "drum": {"diameter": "1 m", "wrap": "210 deg", "inertia": "0 kg*m^2"},
    },
    "takeup": {"type": "gravity", "tension": "240 kN"},
    "effects": {"takeup_mass": "off"},
    "tail_drum": {"inertia": "0 kg*m^2"},
    "scenes": [{"type": "start"}],
}


def template() -> dict[str, Any]:
    """The data of the conveyor's own template, with a take-up that keeps a tension of 30 kN: most tests compare with
    belts whose weight has no inertia."""
    data = yaml.safe_load(load_kind("conveyor").template)
    assert isinstance(data, dict)
    data["takeup"] |= {"tension": "30 kN", "mass": "6 t"}
    data["drive"]["motor"]["mean_starting_torque"] = "900 N*m"
    return data | {"effects": {"takeup_mass": "off"}}


def changed(data: dict[str, Any], **changes: Any) -> dict[str, Any]:
    """A deep copy with values set by paths whose steps are joined by `__`; None deletes a key."""
    data = copy.deepcopy(data)
    for path, value in changes.items():
        *parents, key = (int(step) if step.isdigit() else step for step in path.split("__"))
        node: Any = data
        for step in parents:
            node = node[step] if isinstance(node, list) else node.setdefault(step, {})
        if value is None:
            node.pop(key, None)
        else:
            node[key] = copy.deepcopy(value)
    return data


def loaded(data: dict[str, Any]) -> Loaded:
    """A machine through the loader; fails the test when the file is faulty."""
    result = load_text(yaml.safe_dump(data, sort_keys=False).encode(), "case.yaml")
    assert result.spec is not None, [(d.code, d.message) for d in result.diagnostics]
    return result


def spec_of(data: dict[str, Any]) -> Conveyor:
    """The filled-in spec of a conveyor."""
    spec = loaded(data).spec
    assert isinstance(spec, Conveyor)
    return spec


_KEPT = 16
_REPORTS: dict[tuple[str, bool, bool, str], FileReport] = {}
"""The last ones: a report is immutable, and a test often asks for one twice."""


def report_of(data: dict[str, Any], *, repairs: bool = False, ends: bool = True, **options: Any) -> FileReport:
    """The whole report of a machine; repairs are looked for where a test asks for them, for they cost the most.

    Without `ends`, no assumed value is tried at the ends of its interval: for tests of loads, which stay the same.
    """
    key = yaml.safe_dump(data, sort_keys=False), repairs, ends, repr(sorted(options.items()))
    if key not in _REPORTS:
        if len(_REPORTS) >= _KEPT:
            del _REPORTS[next(iter(_REPORTS))]
        file = loaded(data)
        known = file if ends else replace(file, assumed=())
        _REPORTS[key] = check(known, Options(**options, repairs=repairs))
    return _REPORTS[key]


def scene_of(report: FileReport, name: str = "") -> SceneReport:
    """A scene by name, or the only one."""
    scenes = [scene for scene in report.scenes if name in ("", scene.name)]
    assert len(scenes) == 1, [scene.name for scene in report.scenes]
    return scenes[0]


def load_of(scene: SceneReport, name: str) -> LoadReport:
    """A load by name."""
    return next(load for load in scene.loads if load.info.name == name)


def check_of(scene: SceneReport, code: str) -> Judgement:
    """A judgement by code."""
    return next(judgement for judgement in scene.checks if judgement.code == code)
