"""What a failed check of a stacker crane blames is what governs, and the value it proposes makes it pass."""

from typing import Any

import pytest
import yaml
from support.command import ROOT
from support.machines import changed, report_of

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.contract.report import Judgement

OVERHEAD, RACK = "crane_overhead_stacker", "crane_rack_stacker"
POST = {"type": "obstacle", "mechanism": "bridge", "speed_share": 0.35}
BUFFER = {"type": "buffer", "mechanism": "bridge"}


def _judged(data: dict[str, Any], code: str, *, repairs: bool = False) -> Judgement:
    (scene,) = report_of(data, repairs=repairs).scenes
    (one,) = (check for check in scene.checks if check.code == code)
    return one


def _data(name: str, scene: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    data = yaml.safe_load((ROOT / "specs" / f"{name}.yaml").read_text("utf-8"))
    return changed(data, scenes=[scene], **changes)


PUSH, CAUGHT, RAIL = {"type": "fork_push"}, {"type": "fork_caught"}, {"type": "rail"}


@pytest.mark.parametrize(
    ("name", "scene", "changes", "code", "blamed", "repaired"),
    [
        (RACK, PUSH, {"column__section_modulus_across": "300 cm^3"}, "CRN209", "column__section_modulus_across", ""),
        (RACK, CAUGHT, {"column__area": "8 cm^2"}, "CRN209", "column__area", ""),
        (OVERHEAD, POST, {"column__section_modulus": "300 cm^3"}, "CRN209", "column__section_modulus", ""),
        (
            OVERHEAD,
            POST,
            {"bridge__section_modulus_horizontal": "300 cm^3"},
            "CRN210",
            "bridge__section_modulus_horizontal",
            "",
        ),
        (
            OVERHEAD,
            POST,
            {"bridge__section_modulus_vertical": "1300 cm^3"},
            "CRN210",
            "bridge__section_modulus_vertical",
            "",
        ),
        (OVERHEAD, POST, {"checks__collision_speed": "0.3 m/s"}, "CRN257", "bridge_travel__speed", ""),
        (
            OVERHEAD,
            BUFFER,
            {"bridge_travel__buffers__largest_speed": "0.5 m/s"},
            "CRN283",
            "bridge_travel__buffers__largest_speed",
            "bridge_travel__speed",
        ),
        (
            OVERHEAD,
            BUFFER,
            {"checks__collision_speed": "0.8 m/s"},
            "CRN283",
            "checks__collision_speed",
            "bridge_travel__speed",
        ),
        (RACK, CAUGHT, {"checks__fork_caught_factor": 3}, "CRN284", "hoisting__limiter__reaction", ""),
        (
            RACK,
            CAUGHT,
            {
                "checks__fork_caught_factor": 3,
                "hoisting__limiter__reaction": "5 ms",
                "hoisting__limiter__force": "25 kN",
            },
            "CRN284",
            "hoisting__limiter__force",
            "",
        ),
        (RACK, PUSH, {"fork__rating": "3 kN"}, "CRN288", "fork__speed", ""),
        (RACK, RAIL, {"rail__step": "5 mm"}, "CRN293", "rail__step", "travel__speed"),
        (RACK, RAIL, {"rail__gap": "120 mm"}, "CRN293", "rail__gap", "travel__speed"),
        (
            RACK,
            RAIL,
            {"rail__waviness": {"height": "20 mm", "length": "0.4 m"}},
            "CRN293",
            "rail__waviness__height",
            "travel__speed",
        ),
        (RACK, RAIL, {"rail__waviness__length": "0.22 m"}, "CRN294", "rail__waviness__length", "travel__speed"),
    ],
)
def test_what_governs_is_blamed_and_its_repair_passes(
    name: str, scene: dict[str, Any], changes: dict[str, Any], code: str, blamed: str, repaired: str
) -> None:
    data = _data(name, scene, changes)
    one = _judged(data, code, repairs=True)
    assert one.verdict is Verdict.FAIL
    assert one.blame.path == tuple(blamed.split("__"))
    assert one.repair is not None
    key = repaired or blamed
    assert one.repair.path == tuple(key.split("__"))
    value = f"{one.repair.value!r} {one.repair.quantity.si}"
    assert _judged(changed(data, **{key: value}), code).verdict is Verdict.PASS


def test_a_buffer_that_bottoms_out_does_not_pass_for_its_force() -> None:
    """The energy of the impact is more than the buffers take: the end stop is hit, with no upper end of the force."""
    short = _data(OVERHEAD, BUFFER, {"bridge_travel__buffers__stroke": "100 mm"})
    assert _judged(short, "CRN281").verdict is Verdict.FAIL
    hit = _judged(short, "CRN282", repairs=True)
    assert hit.verdict is Verdict.FAIL
    assert hit.blame.path == ("bridge_travel", "buffers", "stroke")
    assert hit.repair is not None
    longer = changed(short, bridge_travel__buffers__stroke=f"{hit.repair.value!r} m")
    assert _judged(longer, "CRN282").verdict is Verdict.PASS
    enough = _data(OVERHEAD, BUFFER, {})
    assert _judged(enough, "CRN282").verdict is Verdict.PASS
