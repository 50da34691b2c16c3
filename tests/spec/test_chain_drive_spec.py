"""A chain drive as a file writes it: what it says, and what it answers where something is wrong."""

from typing import Any

import pytest
import yaml
from support.chains import CH_05, MOTOR, ROLLER, chain_of
from support.command import ptmcalc
from support.machines import changed

from ptmcalc.base.diagnostic import Diagnostic
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout, TwoShafts
from ptmcalc.machines.chain_drive.machine.spec import Run, Start


def problems(data: dict[str, Any]) -> list[Diagnostic]:
    return list(load_text(yaml.safe_dump(data, sort_keys=False).encode(), "case.yaml").diagnostics)


def faulty(data: dict[str, Any], *path: str | int) -> Diagnostic:
    """The only error of a file, at a place."""
    found = [one for one in problems(data) if one.severity == "error"]
    assert [one.path for one in found] == [path], [(one.path, one.message) for one in found]
    return found[0]


def lines(text: str) -> list[str]:
    return text.strip().splitlines()


class TestBadInput:
    def test_an_odd_number_of_pitches(self) -> None:
        found = faulty(changed(ROLLER, layout__pitches=117, layout__centre_distance=None), "layout", "pitches")
        assert found.code == "SPC113"
        assert "117 pitches cannot be closed" in found.message
        assert "pitches: 118" in found.hint
        assert "cranked_link: yes" in found.hint

    def test_a_cranked_link_in_an_even_chain(self) -> None:
        found = faulty(changed(ROLLER, layout__pitches=118, layout__cranked_link="yes"), "layout", "cranked_link")
        assert "even" in found.message

    @pytest.mark.parametrize("teeth", [3, 0, -8])
    def test_three_teeth(self, teeth: int) -> None:
        found = faulty(changed(CH_05, sprocket__teeth=teeth), "sprocket", "teeth")
        assert f"a sprocket cannot have {teeth} teeth" in found.message
        assert "teeth: 8" in found.hint

    def test_teeth_in_quotes_are_answered_by_themselves_without_quotes(self) -> None:
        found = faulty(changed(CH_05, sprocket__teeth="11"), "sprocket", "teeth")
        assert found.hint == "write `teeth: 11`"

    def test_what_is_added_for_a_missing_part_is_one_that_passes(self) -> None:
        data = changed(CH_05, sprocket=None)
        hint = faulty(data, "sprocket").hint
        assert not problems(data | yaml.safe_load(hint.removeprefix("add ").strip("`")))
        assert faulty(changed(CH_05, layout=None), "layout").hint.count("type: conveyor") == 1

    def test_three_teeth_at_the_tail(self) -> None:
        assert faulty(changed(CH_05, layout__tail__teeth=3), "layout", "tail", "teeth").code == "SPC113"
        assert faulty(changed(ROLLER, layout__driven__teeth=2), "layout", "driven", "teeth").code == "SPC113"

    def test_more_teeth_than_anybody_cuts(self) -> None:
        assert "300" in faulty(changed(ROLLER, layout__driven__teeth=1000), "layout", "driven", "teeth").hint

    @pytest.mark.parametrize(("teeth", "near"), [(8.5, 8), (63.04, 63), (10.9, 11), (0.6, 8), (1e300, 8)])
    def test_a_part_of_a_tooth_is_answered_by_a_count_near_it(self, teeth: float, near: int) -> None:
        found = faulty(changed(CH_05, sprocket__teeth=teeth), "sprocket", "teeth")
        assert found.code == "SPC111"
        assert found.hint == f"write `teeth: {near}`"

    def test_a_pitch_larger_than_the_sprocket(self) -> None:
        found = faulty(changed(CH_05, sprocket__diameter="300 mm"), "sprocket", "diameter")
        assert "320 mm is not smaller than the sprocket diameter, 300 mm" in found.message

    def test_a_diameter_that_is_not_that_of_its_teeth(self) -> None:
        found = faulty(changed(CH_05, sprocket__diameter="900 mm"), "sprocket", "diameter")
        assert "836.2 mm" in found.message
        assert "diameter: 836.2 mm" in found.hint
        assert chain_of(changed(CH_05, sprocket__diameter="836.2 mm")).sprocket.diameter == pytest.approx(0.8362)
        faulty(changed(ROLLER, layout__driven__diameter="1 m"), "layout", "driven", "diameter")
        faulty(changed(CH_05, layout__tail__diameter="1 m"), "layout", "tail", "diameter")

    def test_shafts_inside_the_sprockets(self) -> None:
        found = faulty(changed(ROLLER, layout__centre_distance="250 mm"), "layout", "centre_distance")
        assert "307.7 mm" in found.message

    def test_a_conveyor_shorter_than_its_sprockets(self) -> None:
        found = faulty(changed(CH_05, chain__pitch="160 m"), "layout", "length")
        assert "the sprockets touch" in found.message

    def test_a_chain_too_short_for_its_sprockets(self) -> None:
        found = faulty(changed(ROLLER, layout__centre_distance=None, layout__pitches=40), "layout", "pitches")
        assert "40 pitches" in found.message

    def test_a_chain_too_short_for_its_sprockets_whatever_their_distance(self) -> None:
        found = faulty(changed(ROLLER, layout__pitches=20, layout__centre_distance="1 m"), "layout", "pitches")
        assert "20 pitches are too few for both sprockets" in found.message

    def test_neither_stiffness_nor_section(self) -> None:
        found = faulty(changed(CH_05, chain__section=None, chain__modulus=None), "chain")
        assert "`stiffness` or `section`" in found.message

    def test_stiffness_and_modulus(self) -> None:
        faulty(changed(CH_05, chain__stiffness="3 MN"), "chain", "modulus")

    @pytest.mark.parametrize(
        ("damping", "key"),
        [
            ({"law": "zener", "time": "10 ms", "stiffening": 0.2, "ratio": 0.05}, "ratio"),
            ({"law": "hysteretic", "time": "10 ms"}, "time"),
            ({"ratio": 0.05, "time": "10 ms"}, "time"),
            ({"ratio": 0.05, "stiffening": 0.2}, "stiffening"),
        ],
    )
    def test_damping_with_numbers_of_another_law(self, damping: dict[str, Any], key: str) -> None:
        faulty(changed(CH_05, chain__damping=damping), "chain", "damping", key)

    def test_zener_without_its_time(self) -> None:
        found = faulty(changed(CH_05, chain__damping={"law": "zener", "stiffening": 0.2}), "chain", "damping")
        assert "`zener` needs its `time`" in found.message

    def test_load_twice_or_not_at_all(self) -> None:
        faulty(changed(CH_05, layout__capacity="100 t/h"), "layout", "capacity")
        assert "`load` or `capacity`" in faulty(changed(CH_05, layout__load=None), "layout").message

    def test_a_conveyor_that_rises_more_than_it_is_long(self) -> None:
        faulty(changed(CH_05, layout__lift="41 m"), "layout", "lift")

    def test_a_screw_with_a_mass(self) -> None:
        data = changed(CH_05, layout__takeup={"type": "screw", "tension": "20 kN", "mass": "4 t"})
        faulty(data, "layout", "takeup", "mass")

    def test_a_phase_of_a_tail_that_is_not_driven(self) -> None:
        faulty(changed(CH_05, layout__tail__phase=0.3), "layout", "tail", "phase")

    def test_a_share_of_a_tail_that_is_not_driven(self) -> None:
        assert "driven: on" in faulty(changed(CH_05, layout__tail__share=0.3), "layout", "tail", "share").hint

    def test_a_tail_that_is_synchronised_without_a_drive(self) -> None:
        faulty(changed(CH_05, layout__tail__synchronised="on"), "layout", "tail", "synchronised")

    @pytest.mark.parametrize("share", [-0.1, 1.1])
    def test_a_share_beyond_the_whole(self, share: float) -> None:
        tail = {"teeth": 8, "driven": "on", "share": share}
        faulty(changed(CH_05, layout__tail=tail), "layout", "tail", "share")

    def test_power_and_torque(self) -> None:
        faulty(changed(ROLLER, layout__torque="2 kN*m"), "layout", "torque")

    def test_neither_distance_nor_pitches(self) -> None:
        found = faulty(changed(ROLLER, layout__centre_distance=None), "layout")
        assert "`centre_distance` or `pitches`" in found.message

    def test_an_empty_range_of_speeds(self) -> None:
        faulty(changed(CH_05, operating={"lowest": "1 m/s", "highest": "1 m/s"}), "operating", "highest")

    def test_wear_by_two_models(self) -> None:
        archard = {"coefficient": "1e-17 m^2/N", "reference_pressure": "20 MPa"}
        faulty(changed(CH_05, wear={"coefficient": "1e-12 Hz/N", "archard": archard}), "wear", "archard")
        faulty(changed(CH_05, wear={"archard": archard, "tensions": "mean"}), "wear", "tensions")

    def test_a_start_without_a_drive(self) -> None:
        found = faulty(changed(CH_05, scenes=[{"type": "run"}, {"type": "start"}]), "scenes", 1)
        assert "drive: {motor:" in found.hint

    def test_nothing_runs_back_between_shafts(self) -> None:
        faulty(changed(ROLLER, scenes=[{"type": "backstop"}]), "scenes", 0)

    def test_a_start_along_a_curve_the_motor_does_not_have(self) -> None:
        data = changed(CH_05, drive=MOTOR, scenes=[{"type": "start", "profile": {"shape": "curve"}}])
        faulty(data, "scenes", 0, "profile", "shape")

    def test_a_band_of_no_width(self) -> None:
        faulty(changed(CH_05, checks={"resonance": {"band": 0}}), "checks", "resonance", "band")

    def test_the_type_of_the_layout(self) -> None:
        found = problems(changed(CH_05, layout__type="conveyer"))
        assert found[0].path == ("layout", "type")
        assert "conveyor" in found[0].hint

    def test_several_mistakes_are_all_shown(self) -> None:
        data = changed(CH_05, sprocket__teeth=3, chain__pitch="320", layout__lift="99 m", layout__tail__phase=0.3)
        assert len(problems(data)) == 4

    def test_the_place_is_printed(self, tmp_path: Any) -> None:
        file = tmp_path / "chain.yaml"
        text = yaml.safe_dump(changed(CH_05, sprocket__teeth=3), sort_keys=False)
        file.write_text(text, encoding="utf-8")
        line = next(k for k, one in enumerate(lines(text), 1) if "teeth: 3" in one)
        done = ptmcalc("check", file)
        assert done.status == 2
        assert f"chain.yaml:{line}:3: error SPC113" in done.out


class TestNotes:
    def test_a_motor_that_does_not_fit_the_speed(self) -> None:
        data = changed(CH_05, drive=MOTOR, drive__motor__speed="1470 rpm", drive__gear__ratio=100)
        found = [one for one in problems(data) if one.code == "SPC201"]
        assert [one.path for one in found] == [("speed",)]
        assert problems(changed(data, drive__gear__ratio=125.44)) == []

    def test_a_take_up_weight_that_pulls_otherwise(self) -> None:
        found = problems(changed(CH_05, layout__takeup__mass="2000 kg"))
        assert [one.path for one in found] == [("layout", "takeup", "mass")]
        assert "4.077 t" in found[0].hint
        assert problems(changed(CH_05, layout__takeup__mass="4077 kg")) == []

    def test_a_speed_outside_its_range(self) -> None:
        found = problems(changed(CH_05, operating={"lowest": "0.6 m/s", "highest": "1 m/s"}))
        assert [one.path for one in found] == [("operating",)]

    def test_a_distance_that_is_not_that_of_its_pitches(self) -> None:
        found = problems(changed(ROLLER, layout__pitches=130))
        assert [one.path for one in found] == [("layout", "pitches")]
        assert "pitches: 118" in found[0].hint


class TestWhatIsLeftOut:
    def test_scenes(self) -> None:
        assert [type(scene) for scene in chain_of(changed(CH_05, scenes=None)).all_scenes] == [Run, Run]
        driven = chain_of(changed(CH_05, scenes=None, drive=MOTOR))
        assert [type(scene) for scene in driven.all_scenes] == [Run, Run, Start, Start]

    def test_the_two_layouts(self) -> None:
        assert isinstance(chain_of(CH_05).layout, ConveyorLayout)
        assert isinstance(chain_of(ROLLER).layout, TwoShafts)

    def test_what_is_assumed_is_said_with_its_interval(self) -> None:
        data = changed(
            CH_05, chain__modulus=None, chain__damping=None, chain__count=2, layout__resistance={"coefficient": 0.1}
        )
        assumed = {one.path: one for one in load_text(yaml.safe_dump(data).encode(), "case.yaml").assumed}
        assert set(assumed) == {
            ("chain", "modulus"),
            ("chain", "damping", "ratio"),
            ("chain", "unevenness"),
            ("layout", "resistance", "turn_factor"),
        }
        assert assumed["chain", "modulus"].value == pytest.approx(0.65 * 206e9)
        assert assumed["chain", "modulus"].interval.low == pytest.approx(103e9)

    def test_factors_of_starts_and_stops_only_where_there_are_some(self) -> None:
        data = changed(CH_05, drive=MOTOR, scenes=[{"type": "start"}, {"type": "stop"}])
        paths = {one.path[-1] for one in load_text(yaml.safe_dump(data).encode(), "case.yaml").assumed}
        assert {"start_factor", "stop_factor"} <= paths


NUMBERED = changed(ROLLER, chain={"number": "16B-2", "damping": {"law": "hysteretic", "ratio": 0.04}})
"""The roller drive by the number of its chain."""


class TestNumberOfAChain:
    def test_what_the_number_fills_in(self) -> None:
        loaded = load_text(yaml.safe_dump(NUMBERED).encode(), "case.yaml")
        chain = loaded.spec.chain  # type: ignore[union-attr]
        assert (chain.pitch, chain.breaking_load, chain.rows, chain.count) == (25.4e-3, 106e3, 2, 1)
        assert chain.bush_length == pytest.approx(2 * 25.45e-3)
        assumed = {one.path[-1]: one for one in loaded.assumed}
        assert assumed["mass"].interval.width > 0
        assert assumed["pitch"].interval.width == 0
        assert "16B-2" in assumed["breaking_load"].source
        assert {"pitch", "mass", "breaking_load", "pin_diameter", "bush_length", "stiffness", "unevenness"} <= set(
            assumed
        )

    def test_keys_next_to_it_override(self) -> None:
        own = changed(NUMBERED, chain__mass="6 kg/m", chain__breaking_load="120 kN", chain__stiffness="11 MN")
        loaded = load_text(yaml.safe_dump(own).encode(), "case.yaml")
        chain = loaded.spec.chain  # type: ignore[union-attr]
        assert (chain.mass, chain.breaking_load, chain.stiffness, chain.pitch) == (6.0, 120e3, 11e6, 25.4e-3)
        assert not {"mass", "breaking_load", "stiffness"} & {one.path[-1] for one in loaded.assumed}

    def test_parallel_chains_of_a_number(self) -> None:
        loaded = load_text(yaml.safe_dump(changed(NUMBERED, chain__count=2)).encode(), "case.yaml")
        chain = loaded.spec.chain  # type: ignore[union-attr]
        assert (chain.rows, chain.mass, chain.breaking_load) == (4, pytest.approx(2 * 5.292), 106e3)

    def test_a_number_and_the_same_sizes_give_the_same_loads(self) -> None:
        """A chain of one row by its number, and by the values of the table."""
        by_hand = {"pitch": "25.4 mm", "mass": "2.646 kg/m", "breaking_load": "60 kN", "stiffness": "7.8 MN"}
        by_hand |= {
            "pin_diameter": "8.28 mm",
            "bush_length": "25.45 mm",
            "damping": {"law": "hysteretic", "ratio": 0.04},
        }
        found = []
        for chain in ({"number": "16B-1", "damping": by_hand["damping"]}, by_hand):
            loaded = load_text(yaml.safe_dump(changed(ROLLER, chain=chain)).encode(), "case.yaml")
            (scene,) = check(loaded, Options(repairs=False)).scenes
            found.append({one.info.name: one.estimate.value for one in scene.loads})
        assert found[0].keys() == found[1].keys()
        for name, value in found[0].items():
            assert value == pytest.approx(found[1][name], rel=1e-9, nan_ok=True), name

    @pytest.mark.parametrize(("number", "near"), [("17B-1", "16B-1"), ("16B-4", "16B-3"), ("ANSI 85", "80-1")])
    def test_an_unknown_number(self, number: str, near: str) -> None:
        found = faulty(changed(NUMBERED, chain__number=number), "chain", "number")
        assert f"`{number}`" in found.message
        assert f"number: {near}" in found.hint
        assert not problems(changed(NUMBERED, chain__number=near))

    def test_a_number_without_quotes_that_is_no_text(self) -> None:
        assert "number: 16B-1" in faulty(changed(NUMBERED, chain__number=80), "chain", "number").hint

    def test_neither_number_nor_pitch(self) -> None:
        found = faulty(changed(ROLLER, chain__pitch=None), "chain")
        assert "`pitch` is missing" in found.message
        assert "`number`" in found.message

    def test_sprockets_fit_the_pitch_of_the_number(self) -> None:
        wrong = changed(NUMBERED, sprocket__diameter="20 mm")
        assert "a pitch of 25.4 mm is not smaller" in faulty(wrong, "sprocket", "diameter").message


class TestRatingAndSpans:
    def test_service_and_service_factor(self) -> None:
        both = changed(ROLLER, layout__service={"driver": "smooth", "machine": "heavy"})
        assert "not both" in faulty(both, "layout", "service_factor").message

    def test_spans_of_a_conveyor(self) -> None:
        found = faulty(changed(CH_05, checks={"span_resonance": {}}), "checks", "span_resonance")
        assert "supported" in found.message

    def test_sag_in_service(self) -> None:
        less = changed(ROLLER, layout__slack_sag="1 %", layout__slack_sag_most="0.5 %")
        assert "smaller than `slack_sag`" in faulty(less, "layout", "slack_sag_most").message
        more = changed(ROLLER, layout__slack_sag="1 %", layout__slack_sag_least="2 %")
        assert "larger than `slack_sag`" in faulty(more, "layout", "slack_sag_least").message
