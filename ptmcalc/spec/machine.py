"""Keys common to every machine description."""

from collections.abc import Iterator, Mapping, Sequence
from datetime import date
from functools import cache
from types import MappingProxyType
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ptmcalc.base.span import KeyPath
from ptmcalc.base.units import Quantity
from ptmcalc.base.words import quote
from ptmcalc.spec.described import Described
from ptmcalc.spec.fields import Day, Efficiency, Measure, PositiveAcceleration
from ptmcalc.spec.fragment import Conflict, Fragment, Given
from ptmcalc.spec.optional import Setting
from ptmcalc.spec.scene import Scene
from ptmcalc.spec.tolerance import Tolerance

Accuracy = Efficiency
"""A requested relative error: above 0, at most 1."""


_Line = Annotated[str, Field(min_length=1, max_length=100)]


class Project(Fragment):
    """Head of the report of a design; each key is optional."""

    number: _Line | None = Field(default=None, examples=["P-2031"])
    """number of the project or drawing"""
    revision: _Line | None = Field(default=None, examples=["B"])
    """revision of the design"""
    author: _Line | None = Field(default=None, examples=["A. Designer"])
    """designer"""
    checked_by: _Line | None = Field(default=None, examples=["C. Checker"])
    """checker of the design"""

    @property
    def given(self) -> tuple[tuple[str, str], ...]:
        """The keys that are given, with their texts."""
        return tuple((key, text) for key, text in self if text)


class CheckSwitch(Fragment):
    """Switches off one check of this file, with the reason."""

    off: Annotated[str, Field(min_length=1)]
    """why the check does not apply to this machine"""


class Waiver(Fragment):
    """A temporary exemption from a check: its verdict is `waived`, with the reason, until the given day."""

    check: str = Field(examples=["CNV101"])
    """code of the check"""
    reason: Annotated[str, Field(min_length=1, examples=["the new drum comes in May"])]
    """why it may fail"""
    until: Annotated[date, Day()] = Field(examples=[Day.EXAMPLE])
    """last day on which it is waived"""


class CheckSettings(Described):
    """Limits of a standard or a company, and checks switched off by code: `CNV104: {off: "reason"}`.

    Codes are open here because the kind, not the model, knows them; the loader refuses any other extra key.
    """

    model_config = ConfigDict(extra="allow", frozen=True, defer_build=True)
    __pydantic_extra__: dict[str, CheckSwitch]

    def switched_off(self, code: str) -> str:
        """The reason in the file for switching off this check, or an empty text."""
        switch = (self.__pydantic_extra__ or {}).get(code)
        return switch.off if switch else ""


class MachineSpec(Fragment):
    """Base of every kind's description."""

    kind: str
    name: str = Field(default="", max_length=200)
    """name of the machine in the report"""
    description: str = ""
    """remarks for readers of the file"""
    project: Project | None = None
    """head of the report: `number`, `revision`, `author`, `checked_by`"""
    gravity: Annotated[PositiveAcceleration, Setting("the place: on Earth it is within 0.3 % of 9.81 m/s^2")] = 9.81
    """acceleration of gravity; 9.81 m/s^2 when left out"""
    accuracy: Annotated[Accuracy | None, Setting("without it, verdicts determine the error bars")] = None
    """required relative error of the governing loads, e.g. `1 %`; without it only as accurate as the
    verdicts require"""
    effects: dict[str, Literal["auto", "on", "off"]] = Field(default_factory=dict)
    """effects of the physics forced on or off; every verdict without a forced-off effect is marked"""

    tolerances: dict[str, Tolerance] = Field(default_factory=dict, max_length=100)
    """distributions of values, by key: `takeup.tension: {normal: {sd: 2 kN}}`; read by `tolerances`"""

    waive: tuple[Waiver, ...] = ()
    """temporarily waived checks, each with its reason and its last day"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Scenes are told apart by their names, waivers by the check."""
        waivers: set[str] = set()
        for index, waiver in enumerate(given.blocks("waive")):
            code = waiver.raw.get("check") if waiver else None
            if isinstance(code, str):
                if code in waivers:
                    yield Conflict(("waive", index), f"{quote(code)} is waived twice", "delete one of them")
                waivers.add(code)
        seen = set()
        for index, scene in enumerate(given.blocks("scenes")):
            label = _label(scene) if scene else ""
            if label and label in seen:
                reason = f"two scenes have the name {quote(label)}"
                yield Conflict(("scenes", index), reason, "give this one a `name:` of its own")
            seen.add(label)

    @property
    def all_scenes(self) -> Sequence[Scene]:
        """The scenes of the file, or the kind's default ones."""
        raise TypeError(f"{type(self).__name__} defines no scenes")

    @property
    def settings(self) -> CheckSettings:
        """The limits and switches of the file's `checks:` block."""
        return CheckSettings()

    def quantity_at(self, path: KeyPath, measure: Measure) -> Quantity:
        """The quantity of the number at `path`, where its field leaves a choice."""
        return measure.quantity

    def with_value(self, path: KeyPath, value: object) -> Self:
        """A copy in which the value at `path` (SI, already valid) is replaced."""
        changed: Self = replaced(self, path, value)
        return changed

    def value_at(self, path: KeyPath) -> Any:
        """The value at `path`, or None where the file leaves a part of the way out."""
        node: Any = self
        for step in path:
            if isinstance(node, BaseModel):
                node = getattr(node, attribute(node, str(step)), None)
            elif isinstance(node, dict):
                node = node.get(step)
            elif isinstance(node, tuple | list) and isinstance(step, int) and step < len(node):
                node = node[step]
            else:
                return None
        return node


def _label(scene: Given) -> str:
    """The name of a scene as far as its faults leave it known, else an empty text."""
    try:
        read = scene.model.model_validate(scene.raw)
    except ValidationError:
        name = scene.raw.get("name")
        return name if isinstance(name, str) else ""
    return read.label if isinstance(read, Scene) else ""


def attribute(model: BaseModel, key: str) -> str:
    """The attribute that holds a key of the file: the same word, unless the key is a reserved one."""
    return _attributes(type(model)).get(key, key)


@cache
def _attributes(model: type[BaseModel]) -> Mapping[str, str]:
    """The attributes that are not called as their keys."""
    return MappingProxyType({field.alias: name for name, field in model.model_fields.items() if field.alias})


def replaced(node: Any, path: KeyPath, value: object) -> Any:
    """A copy of a model, list or mapping with the value at `path` replaced."""
    if not path:
        return value
    step, rest = path[0], path[1:]
    if isinstance(node, BaseModel):
        name = attribute(node, str(step))
        return node.model_copy(update={name: replaced(getattr(node, name), rest, value)})
    if isinstance(node, tuple | list) and isinstance(step, int):
        return type(node)(replaced(item, rest, value) if i == step else item for i, item in enumerate(node))
    return {**node, step: replaced(node.get(step), rest, value)}
