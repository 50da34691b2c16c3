"""Faults of keys and conflicts between them come together, each once, whatever else is wrong in the file."""

from collections.abc import Iterator
from typing import Annotated, Any, Literal

import pytest
from pydantic import Field, ValidationError

from ptmcalc.base.span import KeyPath
from ptmcalc.spec.fields import PositiveLength, PositiveRatio, PositiveSpan
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one, exactly_one, together
from ptmcalc.spec.problems import path_of
from ptmcalc.spec.shape import did_you_mean, example_like, keys_at


class Leg(Fragment):
    """A leg with two ways to say its size, and a foot."""

    length: PositiveSpan | None = None
    share: PositiveRatio | None = None
    foot: PositiveLength = 0.1
    form: Literal["round", "square"] = "round"

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        yield from exactly_one(given, "length", "share")
        yield from together(given, "share", "foot", "a share needs the foot")
        foot, length = given.number("foot"), given.number("length")
        if foot is not None and length is not None and foot > length:
            yield Conflict(("foot",), "the foot is longer than the leg", "swap them")


class Swing(Fragment):
    """One of two moves."""

    type: Literal["swing"] = "swing"
    share: PositiveRatio


class Turn(Fragment):
    """The other."""

    type: Literal["turn"] = "turn"


class Stool(Fragment):
    """Three legs."""

    left: Leg
    right: Leg | None = None
    moves: Annotated[tuple[Annotated[Swing | Turn, Field(discriminator="type")], ...], Field(min_length=1)] | None = (
        None
    )
    top: PositiveSpan

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        left = given.block("left")
        if left and left.word("form") == "square":
            yield Conflict(("left", "form"), "a stool stands on round legs", "write `round`")


def faults(data: Any, model: type[Fragment] = Stool) -> list[tuple[str, str]]:
    """Key and reason of all that is wrong."""
    with pytest.raises(ValidationError) as caught:
        model.model_validate(data)
    return [(".".join(map(str, error["loc"])), error["msg"]) for error in caught.value.errors()]


def keys(data: Any, model: type[Fragment] = Stool) -> list[str]:
    return sorted(key for key, _ in faults(data, model))


LEG = {"length": "1 m"}


def test_a_sound_description_is_read() -> None:
    stool = Stool.model_validate({"left": LEG, "right": {"share": 1, "foot": "9 m"}, "top": "1 m"})
    assert (stool.left.length, stool.right and stool.right.foot) == (1.0, 9.0)


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        ({"left": {}, "top": "1 m"}, ["left"]),
        ({"left": {}, "top": "1"}, ["left", "top"]),
        ({"left": {"length": "1 m", "share": 1}, "top": "1 kg"}, ["left", "left.share", "top"]),
        ({"left": {"length": "1 m", "foot": "2 m", "form": "oval"}}, ["left.foot", "left.form", "top"]),
        ({"left": LEG | {"form": "square"}, "right": {"x": 1}, "top": 5}, ["left.form", "right", "right.x", "top"]),
        ({"left": 5, "top": "1 m", "moves": [{"type": "swing"}, {"type": "turn"}]}, ["left", "moves.0.swing.share"]),
    ],
)
def test_conflicts_and_faults_come_together(data: Any, expected: list[str]) -> None:
    assert keys(data) == expected


@pytest.mark.parametrize(
    "data",
    [
        {"length": "1 kg", "foot": "2 m"},  # whether the foot is longer cannot be said
        {"length": "1 m", "foot": "two metres"},
        {"length": "1 m", "foot": "-2 m"},
    ],
)
def test_a_conflict_of_a_faulty_value_is_not_guessed(data: dict[str, Any]) -> None:
    assert len(faults(data, Leg)) == 1


def test_a_key_left_empty_is_left_out() -> None:
    assert keys({"length": None}, Leg) == [""]
    assert keys({"length": None, "share": 1, "foot": None}, Leg) == ["", "foot"]


def test_a_misspelt_key_counts_as_the_one_it_means() -> None:
    assert keys({"lenght": "1 m"}, Leg) == ["lenght"]
    assert keys({"lenght": "1 m", "foot": "2 m"}, Leg) == ["foot", "lenght"]
    assert keys({"length": "1 m", "lenght": "3 m", "foot": "2 m"}, Leg) == ["foot", "lenght"]


def test_what_the_file_gives() -> None:
    given = Given(Stool, {"left": {"lenght": "2 m", "form": "oval", "foot": "2 kg"}, "right": 5, "top": None})
    left = given.block("left")
    assert left is not None
    assert ("left" in given, "top" in given, "length" in left, "share" in left) == (True, False, True, False)
    assert (left.number("length"), left.number("foot"), left.number("share")) == (2.0, None, None)
    assert (left.word("form"), Given(Leg, {}).word("form"), Given(Leg, {}).number("foot")) == (None, "round", 0.1)
    assert given.block("right") is None
    assert given.blocks("moves") == []
    moves = Given(Stool, {"moves": [{"type": "turn"}, 5]}).blocks("moves")
    assert [move and move.model for move in moves] == [Turn, None]


def test_the_hint_for_a_missing_key_can_be_copied() -> None:
    given = Given(Leg, {})
    (missing,) = exactly_one(given, "length", "share")
    assert missing.hint == "add `length: 850 m`"
    assert list(at_most_one(given, "length", "share")) == []


@pytest.mark.parametrize(
    ("location", "path"),
    [
        (("left", "foot"), ("left", "foot")),
        (("moves", 0, "swing", "share"), ("moves", 0, "share")),
        (("moves", 1, "turn", "turn"), ("moves", 1, "turn")),
        (("moves", 1, "turn", "swing"), ("moves", 1, "swing")),
        (("moves", 1), ("moves", 1)),
    ],
)
def test_a_tag_of_a_union_is_no_key_of_the_file(location: tuple[str | int, ...], path: KeyPath) -> None:
    assert path_of(location, Stool) == path


def test_the_keys_of_a_block_are_those_of_its_type() -> None:
    data = {"moves": [{"type": "turn"}, {"type": "swing"}, {"type": "fly"}]}
    assert [list(keys_at(Stool, ("moves", index), data)) for index in range(3)] == [
        ["type"],
        ["type", "share"],
        ["type", "share"],
    ]


def test_an_example_has_the_form_of_what_is_asked_for() -> None:
    fields = keys_at(Stool, (), {})
    assert example_like(fields["left"].annotation) == "{length: 850 m}"
    assert example_like(Swing | Turn) == "{type: swing, share: 0.94}"
    assert example_like(Swing | Turn, "turn") == "{type: turn}"


def test_a_word_like_none_gets_all() -> None:
    assert did_you_mean("Lenght", ["length", "foot"]) == "did you mean `length`?"
    assert did_you_mean("zzz", ["length", "foot"], "keys: ") == "keys: length, foot"
