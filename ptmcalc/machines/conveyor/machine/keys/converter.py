"""Keys of the frequency converters of a conveyor: of their own frequency, or following the torque of another drive."""

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Protocol, Self, TypeVar

from pydantic_core import PydanticCustomError

from ptmcalc.base import units
from ptmcalc.components.motor import AnyMotor, TableMotor, TorquePoint
from ptmcalc.components.starting_gear import Converter
from ptmcalc.spec.fields import Measure, PositiveRatio
from ptmcalc.spec.fragment import Conflict, Given, together
from ptmcalc.spec.optional import Absent, Assumed

Deviation = Annotated[float, Measure(units.SHARE, above=-1, at_most=1)]


class DriveConverter(Converter):
    """A frequency converter between the mains and each motor of a drive."""

    follows: str | None = None
    """name of the drive whose torque it follows: the torque of its motors relative to their rated torque is that of the
    motors of the other drive; a converter without it holds its own frequency"""
    torque_ratio: Annotated[PositiveRatio, Absent("drives share the load as their rated torques")] = 1.0
    """torque relative to the rated torque, relative to that of the followed drive; with `follows`"""
    deviation: Annotated[Deviation | None, Assumed()] = None
    """deviation of the torque from that ratio; with `follows` 0 is assumed, from -5 % to 5 %"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """A converter follows a torque or holds a frequency."""
        yield from super().conflicts(given)
        for key in ("torque_ratio", "deviation"):
            yield from together(given, key, "follows", f"`{key}` belongs to a converter that follows another drive")
        if given.number("droop") and "follows" in given:
            reason = "a converter that follows a torque holds no frequency that could fall"
            yield Conflict(("droop",), reason, "delete `droop`, or give it to the followed drive")


class Following(DriveConverter):
    """The converter of a drive with the drive that it follows."""

    leader: Any
    """drive that it follows, with its own converter"""
    turns: float
    """turn of its motor shafts per travel of the belt, relative to that of the followed drive [1]"""

    def behind(self, motor: AnyMotor) -> TableMotor:
        """The torque of a motor over its speed at the rated frequency of the followed converter.

            M = M_n min(r (1 + d) M_1/M_n1, lambda)

        M_1 is the torque of the followed motor at the same speed of the belt, r the ratio of the torques, d its
        deviation.

        **Range** up to rated speed.
        **Error** the torque follows without delay; converters take 1 to 50 ms.
        **Source** derived.
        """
        first, rated = self.leader.running_curve, motor.rated
        assert rated is not None
        (low, most), (high, _) = ((one.speed, one.torque) for one in first.points)
        top, width, asked = (low + high) / 2, (high - low) / 2, self._share(rated, first.rated) * most
        part = min(1.0, self.torque_limit * rated / asked)
        knots = (top - part * width, part * asked), (top + part * width, -part * asked)
        points = tuple(TorquePoint.model_construct(speed=self.turns * speed, torque=torque) for speed, torque in knots)
        return TableMotor.model_construct(type="table", points=points, rated_torque=rated, largest_torque=None)

    def largest(self, rated: float) -> float:
        """The largest torque of a motor: its own limit, or what the followed motor reaches [N*m]."""
        first = self.leader.motor.rated_torque
        followed: float = self._share(rated, first) * self.leader.converter.largest(first)
        return min(super().largest(rated), followed)

    def _share(self, rated: float, first: float) -> float:
        """Torque of a motor over that of a motor of the followed drive [1]."""
        return self.torque_ratio * (1 + (self.deviation or 0.0)) * rated / first


class _Driven(Protocol):
    """A drive, as far as a converter follows it."""

    @property
    def converter(self) -> DriveConverter | None: ...

    @property
    def turns(self) -> float: ...

    def model_copy(self, *, update: Mapping[str, Any] | None = None) -> Self: ...


D = TypeVar("D", bound=_Driven)


def linked(drives: Mapping[str, D]) -> dict[str, D]:
    """Drives with converters that know the drive which they follow."""
    found: dict[str, D] = {}

    def of(name: str) -> D:
        drive = drives[name]
        if name not in found:
            found[name] = drive
            if drive.converter is not None and (follows := drive.converter.follows) is not None:
                leader = of(follows)
                keys = {key: getattr(drive.converter, key) for key in DriveConverter.model_fields}
                one = Following.model_construct(leader=leader, turns=drive.turns / leader.turns, **keys)
                found[name] = drive.model_copy(update={"converter": one})
        return found[name]

    return {name: of(name) for name in drives}


def leaders(drives: Mapping[str, D]) -> dict[str, str]:
    """The drive at the head of those that follow each other, for each that follows another."""
    found = {}
    for name in drives:
        last = name
        while (converter := drives[last].converter) is not None and converter.follows is not None:
            last = converter.follows
        if last != name:
            found[name] = last
    return found


def follows_wrongly(given: Given) -> Iterator[Conflict]:
    """Drives that follow no other drive with a converter."""
    several, single = given.raw.get("drives"), given.raw.get("drive")
    if isinstance(single, dict) and _followed(single) is not None:
        reason = "the conveyor has no other drive to follow"
        yield Conflict(("drive", "converter", "follows"), reason, "delete `follows`, or give several `drives`")
    if not isinstance(several, dict):
        return
    for name, drive in several.items():
        first = _followed(drive)
        if first is None:
            continue
        reason, hint = _fault(several, str(name), first)
        if reason:
            yield Conflict(("drives", name, "converter", "follows"), reason, hint)
        elif _delayed(drive):
            reason = f"it starts with `{first}`, whose torque it follows"
            yield Conflict(("drives", name, "delay"), reason, f"delete `delay`, or give it to `{first}`")


def _fault(drives: Mapping[Any, Any], name: str, first: str) -> tuple[str, str]:
    """What is wrong with the drive that another one follows, and what to write; empty where nothing is."""
    others = [str(one) for one, drive in drives.items() if str(one) != name and _holds(drive)]
    hint = f"write `follows: {others[0]}`" if others else "delete `follows`"
    if first == name:
        return "the drive follows itself", hint
    if first not in drives:
        return f"no drive is called `{first}`", hint
    if not isinstance(drives[first], dict) or not isinstance(drives[first].get("converter"), dict):
        return f"`{first}` has no converter, whose torque could be followed", f"add `converter: {{}}` to `{first}`"
    seen, following = [name], _followed(drives[first])
    seen.append(first)
    while following is not None and following in drives and following not in seen:
        seen.append(following)
        following = _followed(drives[following])
    if following == name:
        return f"drives follow each other in a circle: {', '.join(seen)}", "delete `follows` of one of them"
    return "", ""


def _followed(drive: Any) -> str | None:
    """The drive that a drive follows, as the file writes it."""
    converter = drive.get("converter") if isinstance(drive, dict) else None
    follows = converter.get("follows") if isinstance(converter, dict) else None
    return None if follows is None else str(follows)


def _delayed(drive: Any) -> bool:
    """Whether a drive starts after others, as far as its delay can be read."""
    try:
        return Measure(units.TIME).read(drive.get("delay", "0 s")) != 0
    except PydanticCustomError:
        return False


def _holds(drive: Any) -> bool:
    """Whether a drive has a converter that holds its own frequency."""
    return isinstance(drive, dict) and isinstance(drive.get("converter"), dict) and _followed(drive) is None
