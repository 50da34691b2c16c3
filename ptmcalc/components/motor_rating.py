"""The rating of a motor: its rated torque, the key that states it, and its agreement with that of the curve."""

from collections.abc import Iterator, Mapping
from typing import Any

from ptmcalc.base import units
from ptmcalc.base.span import KeyPath
from ptmcalc.components.motor import AnyMotor, InductionBase, Motor
from ptmcalc.laws import motor
from ptmcalc.spec.fragment import Conflict, Given
from ptmcalc.spec.shape import keys_of


def number_at(path: KeyPath, curve: AnyMotor | None, *, rated: bool = False) -> KeyPath:
    """The number that a key stands for: where it names the curve of a motor, the one all its torques grow with; none
    where there is no such number. The power of a motor that the file gives besides the curve (`rated`) is none: it
    cannot change in one place alone.
    """
    if path[-1] != "curve":
        return path
    if curve is None or not curve.size_key or (rated and curve.size_key == "power"):
        return ()
    return (*path, curve.size_key)


def braking_number_at(path: KeyPath, curve: AnyMotor | None, *, rated: bool = False) -> KeyPath:
    """The number that the braking torque of a motor's curve at `path` grows with, as `number_at`; of an induction motor
    with a given power the overload, with which its breakdown torque grows."""
    if rated and isinstance(curve, InductionBase):
        return (*path, "overload")
    return number_at(path, curve, rated=rated)


def rated_torque_of(given: float | None, curve: AnyMotor | None) -> float | None:
    """Rated torque of a motor: as given, else that of its curve; None where neither is known [N*m]."""
    return given if given is not None or curve is None else curve.rated


def rating_key(power: float | None, rated_torque: float | None, curve: AnyMotor | None) -> KeyPath:
    """The key below a motor that states its rating; `rated_torque` where nothing does."""
    if power is not None:
        return ("power",)
    if rated_torque is not None or curve is None or curve.rated is None:
        return ("rated_torque",)
    return ("curve", "power" if getattr(curve, "power", None) is not None else "rated_torque")


_AGREES = 0.01
"""Difference of two ratings of one motor up to which they agree: catalogues round power and speed to three digits."""


def ratings_that_differ(given: Given) -> Iterator[Conflict]:
    """The rating of a motor and that of its curve are those of one motor: power, rated torque, rated speed.

    The speed of a converter's curve is not compared: it is the speed asked for, not a rated one.
    """
    known = keys_of(given.model)
    curve = given.block("curve") if "curve" in given else None
    if curve is None:
        return
    kind, own = curve.raw.get("type"), {key: _told(given, known, key) for key in ("power", "speed", "rated_torque")}
    induction = kind in ("induction", "rheostat")
    pairs = [("power", units.POWER)] if induction or kind == "converter" else []
    pairs += [("speed", units.ANGULAR_SPEED)] if induction else []
    for key, quantity in pairs:
        yield from _differs(key, own[key], curve.number(key), quantity)
    rated = _rated_by(curve)
    yield from _differs("rated_torque", own["rated_torque"], rated, units.TORQUE)
    if kind in ("constant", "linear", "table") and own["power"] is not None and own["speed"] is not None:
        torque = motor.rated_torque(own["power"], own["speed"])
        if rated is not None and abs(rated / torque - 1) > _AGREES:
            shown = units.show(torque, units.TORQUE)
            reason = f"it differs from the rated torque by `power` and `speed`, {shown}"
            yield Conflict(("curve", kind, "rated_torque"), reason, f"write `rated_torque: {shown}`, or delete it")


def _told(given: Given, known: Mapping[str, Any], key: str) -> float | None:
    return given.number(key) if key in known and key in given else None


def _rated_by(curve: Given) -> float | None:
    """Rated torque of a curve, as far as it can be read."""
    return curve.model.rated_by(curve) if issubclass(curve.model, Motor) else None


def _differs(key: str, own: float | None, of_curve: float | None, quantity: units.Quantity) -> Iterator[Conflict]:
    if own is None or of_curve is None or abs(own / of_curve - 1) <= _AGREES:
        return
    shown = units.show(of_curve, quantity)
    reason = f"the `curve` is that of a motor with {shown}"
    yield Conflict((key,), reason, f"write `{key}: {shown}`, or correct the `curve`")
