"""Cranes as files describe them: the type of a crane, and every fault said once, at its place, with what to write."""

from typing import Any

import pytest
import yaml
from support.command import ptmcalc
from support.machines import changed, loaded
from support.slewing import COURSE, YARD

from ptmcalc.contract.report import exit_status
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.engine.registry import load_kind


def problems(data: dict[str, Any]) -> list[tuple[str, str, str]]:
    """Code, message and hint of each fault of a file."""
    result = load_text(yaml.safe_dump(data, sort_keys=False).encode(), "crane.yaml")
    assert result.spec is None
    return [(one.code, one.message, one.hint) for one in result.diagnostics]


# -- the type -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "place", "code", "said", "hint"),
    [
        ("kind: crane\n", (1, 1), "SPC103", "`type` is missing: a crane is one of `slewing`", "add `type: slewing`"),
        ("kind: crane\ntyp: slewing\n", (1, 1), "SPC103", "`type` is missing", "is `typ` meant for it?"),
        ("kind: crane\ntype: slewng\n", (2, 7), "SPC112", "`type` is `slewng`, not one of", "did you mean `slewing`?"),
        ("kind: crane\ntype: 3\n", (2, 7), "SPC112", "`type` is `3`, not one of", "write one of slewing"),
        ("kind: crane\ntype: [slewing]\n", (2, 7), "SPC112", "`type` is a list, not one of", "write one of"),
        ("kind: crane\ntype:\n", (2, 6), "SPC112", "`type` is nothing, not one of", "write one of"),
    ],
)
def test_a_missing_or_unknown_type_is_one_message_at_its_place(
    text: str, place: tuple[int, int], code: str, said: str, hint: str
) -> None:
    (problem,) = load_text(text.encode(), "crane.yaml").diagnostics
    assert problem.code == code
    assert problem.span is not None
    assert (problem.span.line, problem.span.column) == place
    assert said in problem.message
    assert hint in problem.hint


def test_every_type_has_its_template() -> None:
    for one in load_kind("crane").types:
        done = ptmcalc("new", "crane", one.type)
        assert (done.status, done.out) == (0, one.template)
        result = load_text(one.template.encode(), "new.yaml")
        assert result.diagnostics == ()
        assert result.kind is one


def test_a_type_that_is_not_there_is_told() -> None:
    done = ptmcalc("new", "crane", "slewng")
    assert done.status == 2
    assert "did you mean `slewing`?" in done.err
    done = ptmcalc("new", "hoist", "slewing")
    assert done.status == 2
    assert "a hoist is of no type" in done.err


def test_every_type_has_a_schema() -> None:
    done = ptmcalc("schema")
    for one in load_kind("crane").types:
        assert f'"$ref": "#/$defs/crane.{one.type}"' in done.out


# -- slewing --------------------------------------------------------------------------------------------------------

FAULTS: dict[str, tuple[dict[str, Any], str, str]] = {
    "zero radius": ({"load__radius": "0 m"}, "SPC110", "greater than 0 m"),
    "zero mass": ({"load__mass": "0 kg"}, "SPC110", "greater than 0 kg"),
    "zero speed": ({"speed": "0 rpm"}, "SPC110", "greater than 0 rpm"),
    "zero rope": ({"load__rope_length": "0 m"}, "SPC110", "greater than 0 m"),
    "negative wind area": (
        {"wind": {"area": "-3 m^2", "arm": "4 m", "steady_pressure": "50 Pa"}},
        "SPC110",
        "greater than 0 mm^2",
    ),
    "negative wind": ({"wind__steady": "-3 N*m"}, "SPC110", "at least 0 N*m"),
    "wind without an arm": ({"wind": {"area": "3 m^2", "steady_pressure": "50 Pa"}}, "SPC113", "`arm` is missing"),
    "pressure without an area": ({"wind": {"steady_pressure": "50 Pa"}}, "SPC113", "`area` is missing"),
    "area without a pressure": ({"wind": {"area": "3 m^2", "arm": "4 m"}}, "SPC113", "has no pressure"),
    "torque and pressure": (
        {"wind": {"steady": "1 kN*m", "steady_pressure": "50 Pa", "area": "3 m^2", "arm": "4 m"}},
        "SPC113",
        "they state the same quantity",
    ),
    "largest wind below the steady one": ({"wind__maximum": "1 kN*m"}, "SPC113", "below the steady wind"),
    "not a number": ({"friction": "nan N*m"}, "SPC109", "not a finite number"),
    "huge": ({"friction": "1e30 N*m"}, "SPC110", "out of range"),
    "no unit": ({"speed": 2}, "SPC106", "has no unit"),
    "wrong unit": ({"speed": "2 m/s"}, "SPC105", "`2 m/s`"),
    "no speed": ({"speed": None}, "SPC103", "`speed` is missing"),
    "no load beside the parts": ({"load": None}, "SPC113", "the load is one of the slewing parts"),
    "nothing that slews": (
        {"slewing_part": None, "counterweight": None, "jib": None},
        "SPC113",
        "give `inertia`, or the slewing parts",
    ),
    "parts without inertia": (
        {
            "slewing_part": {"mass": "8 t", "radius": "0 m"},
            "counterweight": {"mass": "0 kg", "radius": "2 m"},
            "jib": None,
        },
        "SPC113",
        "no inertia about the slewing axis",
    ),
    "efficiency above 1": ({"gear__efficiency": 1.2}, "SPC110", "at most 1"),
    "open stage above the whole": ({"gear__open__ratio": 1000}, "SPC113", "the whole ratio is 900 only"),
    "open stage with more loss than all": ({"gear__open__efficiency": 0.5}, "SPC113", "the whole efficiency is 0.72"),
    "nothing that starts": ({"motor__mean_starting_torque": None}, "SPC113", "the start is not defined"),
    "two starting torques": (
        {"motor__largest_starting_torque": "9 N*m", "motor__smallest_starting_torque": "8 N*m"},
        "SPC113",
        "not both",
    ),
    "half a starting torque": (
        {"motor__mean_starting_torque": None, "motor__largest_starting_torque": "9 N*m", "cycle__start_time": "4 s"},
        "SPC113",
        "are given together",
    ),
    "power without speed": ({"motor__speed": None}, "SPC113", "the rated torque is power over speed"),
    "two start inputs": ({"cycle__start_time": "4 s", "cycle__start_angle": "5 deg"}, "SPC113", "not both"),
    "stop longer than the rotation": ({"cycle__brake_angle": "190 deg"}, "SPC113", "exceeds the whole slewing angle"),
    "ring curve out of order": (
        {"ring": {"curve": [{"axial": "5 kN", "moment": "3 kN*m"}, {"axial": "2 kN", "moment": "3 kN*m"}]}},
        "SPC113",
        "sort the points",
    ),
    "spectrum with a hole": (
        {"class": {"cycles": 1000, "load_spectrum": [{"share": 0.5, "load": 1}]}},
        "SPC113",
        "add up to 0.5",
    ),
    "scene of another kind": ({"scenes": [{"type": "travel"}]}, "SPC112", "not one of `slew`"),
    "half a load": ({"scenes": [{"type": "slew", "load": "half"}]}, "SPC112", "not one of `full`, `empty`"),
    "misspelt block": ({"countrweight": {"mass": "1 t", "radius": "1 m"}}, "SPC104", "unknown key `countrweight`"),
    "a check of another kind": ({"checks": {"HST101": {"off": "none"}}}, "SPC104", "no check has the code"),
    "an effect of another kind": ({"effects": {"slip": "on"}}, "SPC104", "unknown effect `slip`"),
}


@pytest.mark.parametrize("case", FAULTS)
def test_a_fault_is_said_once_with_what_to_write(case: str) -> None:
    changes, code, said = FAULTS[case]
    ((found, message, hint),) = problems(changed(YARD, **changes))
    assert found == code
    assert said in f"{message}; {hint}"
    assert hint


def test_all_faults_are_said_at_once() -> None:
    data = changed(YARD, speed=None, friction="-1 N*m", load__radius="0 m", gear__efficiency=2, moter={})
    assert sorted(code for code, _, _ in problems(data)) == ["SPC103", "SPC104", "SPC110", "SPC110", "SPC110"]


def test_parts_beside_an_inertia_are_said_one_by_one() -> None:
    found = problems(changed(YARD, inertia="1e6 kg*m^2"))
    assert [message.split("`")[1] for _, message, _ in found] == ["slewing_part", "counterweight", "jib"]


def test_a_load_heavier_than_the_whole_inertia_is_refused() -> None:
    ((code, message, hint),) = problems(changed(COURSE, load={"mass": "5 t", "radius": "5 m"}))
    assert code == "SPC113"
    assert "the load alone has 125000 kg*m^2" in message
    assert "126250 kg*m^2" in hint


def test_a_slope_needs_the_masses() -> None:
    ((code, message, _),) = problems(changed(COURSE, slope="1 deg"))
    assert code == "SPC113"
    assert "an inertia does not determine the weights on a slope" in message


# -- what is said of sound files ------------------------------------------------------------------------------------


def test_a_stall_is_named_and_nothing_more_is_asked_of_it() -> None:
    """Acceptance: a start torque below friction."""
    result = load_text(yaml.safe_dump(changed(YARD, motor__mean_starting_torque="5 N*m")).encode(), "crane.yaml")
    report = check(result, Options(repairs=False))
    failed = {judgement.code for _, judgement in report.judgements if judgement.verdict.value == "fail"}
    assert failed == {"CRN101", "CRN102", "CRN112"}
    assert "undecided" not in {judgement.verdict.value for _, judgement in report.judgements}
    assert exit_status((report,)) == 1
    assert any("the motor stalls" in one.message for one in report.diagnostics)


def test_a_motor_that_cannot_hold_the_wind_fails_with_a_torque_that_can() -> None:
    result = load_text(yaml.safe_dump(changed(YARD, wind__maximum="9 kN*m")).encode(), "crane.yaml")
    report = check(result, Options())
    (judgement,) = (one for _, one in report.judgements if one.code == "CRN112")
    assert judgement.verdict.value == "fail"
    assert judgement.repair is not None
    assert judgement.repair.path == ("motor", "mean_starting_torque")
    assert judgement.repair.value == pytest.approx(11000 / 648, rel=1e-2)


def test_what_only_the_handbook_uses_moves_nothing_else() -> None:
    def values(data: dict[str, Any]) -> list[tuple[str, float]]:
        report = check(loaded(data), Options(repairs=False))
        return [(load.info.name, load.estimate.value) for load in report.scenes[0].loads]

    assert values(YARD | {"handbook": {"start_time": "8 s", "rotor_eta_rule": "inverse"}}) == values(YARD)


def test_a_start_that_fits_its_torque_is_not_warned_of() -> None:
    assert loaded(changed(YARD, handbook__start_time="4.85 s")).diagnostics == ()
    (warning,) = loaded(changed(YARD, cycle__start_time="6 s")).diagnostics
    assert "`cycle.start_time` in line" in warning.message


def test_a_motor_of_another_speed_is_told() -> None:
    (warning,) = loaded(changed(YARD, speed="2 rpm")).diagnostics
    assert "motor and gear result in a slewing speed of 1 rpm, the file states 2 rpm" in warning.message


def test_a_coupling_that_is_not_given_is_assumed() -> None:
    assumed = loaded(changed(YARD, motor__coupling_factor=None)).assumed
    assert {one.path: one.value for one in assumed}["motor", "coupling_factor"] == 1.7


def test_a_wind_by_area_is_the_wind_by_torque() -> None:
    def start(wind: dict[str, str]) -> float:
        scene = check(loaded(YARD | {"wind": wind}), Options(repairs=False)).scenes[0]
        return next(load.estimate.value for load in scene.loads if load.info.name == "torque_steady")

    area = {"area": "10 m^2", "arm": "3 m", "steady_pressure": "50 Pa", "maximum_pressure": "100 Pa"}
    assert start(area) == pytest.approx(start({"steady": "1.5 kN*m", "maximum": "3 kN*m"}))
