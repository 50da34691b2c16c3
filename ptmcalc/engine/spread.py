"""What the `tolerances:` of a design file say, in numbers: each is about a key, in the unit of that key."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from pydantic import ValidationError
from pydantic_core import PydanticCustomError

from ptmcalc.base.diagnostic import Diagnostic
from ptmcalc.base.span import KeyPath, dotted, key_path
from ptmcalc.base.words import quote
from ptmcalc.spec.fields import Measure
from ptmcalc.spec.shape import Model, did_you_mean, keys_at, measure_of, value_at
from ptmcalc.spec.tolerance import Tolerance
from ptmcalc.text.document import Document, Unread

BLOCK = "tolerances"


@dataclass(frozen=True, slots=True)
class Spread:
    """The distribution of a value, SI: Gauss with a standard deviation, without one every value is as likely between
    `low` and `high`. Where no `mean` is given, Gauss stands about the value of the file; `plus` and `minus` are about
    it too."""

    sd: float | None = None
    mean: float | None = None
    low: float = -math.inf
    high: float = math.inf
    plus: float | None = None
    minus: float | None = None

    @property
    def about_the_file(self) -> bool:
        """Whether it needs the value of the file."""
        return self.plus is not None or (self.sd is not None and self.mean is None)


def tolerance_problems(model: Model, data: Mapping[str, Any], document: Document) -> Iterator[Diagnostic]:
    """What is wrong with the tolerances of a file, besides their form."""
    block = data.get(BLOCK)
    for name, given in block.items() if isinstance(block, dict) else ():
        path = (BLOCK, name)
        measure = measure_of_key(model, key_path(name), data)
        if measure is None:
            known = [dotted(one) for one in _numbers(model, (), data, data)]
            reason = f"{quote(name)} is not a numerical key of this file"
            hint = did_you_mean(name, known, "keys: ")
            yield Diagnostic("SPC104", reason, document.key_span(path), path, hint)
            continue
        try:
            tolerance = Tolerance.model_validate(given)
        except ValidationError:  # told with the form of the rest
            continue
        yield from _faults(spread_of(tolerance, measure, path), document)


def measure_of_key(model: Model, path: KeyPath, data: Mapping[str, Any]) -> Measure | None:
    """Quantity and range of the key at a path of a file; None where no number with a quantity stands there."""
    if not path or any(value_at(data, path[:length]) is None for length in range(1, len(path) - 1)):
        return None
    known = keys_at(model, path[:-1], data).get(str(path[-1]))
    measure = measure_of(known) if known else None
    if measure is None or measure.or_else is None:
        return measure
    return replace(measure, quantity=measure.quantity_of(value_at(data, path)), or_else=None)


def _numbers(model: Model, path: KeyPath, node: Any, data: Mapping[str, Any]) -> Iterator[KeyPath]:
    """The keys of a file behind which a number with a quantity stands."""
    if path[:1] == (BLOCK,):
        return
    items = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for key, value in items:
        one = (*path, key)
        if isinstance(value, dict | list):
            yield from _numbers(model, one, value, data)
        elif isinstance(key, str) and value is not Unread.VALUE and measure_of_key(model, one, data) is not None:
            yield one


Said = tuple[Spread | None, list[tuple[KeyPath, str, str, str]]]
"""A distribution, and what is wrong with it: where, code, reason, hint."""


def spread_of(tolerance: Tolerance, measure: Measure, path: KeyPath) -> Said:
    """What a tolerance says in SI units."""
    faults: list[tuple[KeyPath, str, str, str]] = []
    width = Measure(measure.quantity, above=0)
    side = Measure(measure.quantity, at_least=0)

    def number(value: object, about: Measure, *at: str) -> float | None:
        if value is None:
            return None
        try:
            return about.read(value)
        except PydanticCustomError as error:
            context = error.context or {}
            faults.append(((*path, *at), context["code"], context["reason"], context["hint"]))
            return None

    if tolerance.normal is not None:
        gauss = tolerance.normal
        low, high = (number(getattr(gauss, end), measure, "normal", end) for end in ("min", "max"))
        mean = number(gauss.mean, measure, "normal", "mean")
        found = Spread(
            number(gauss.sd, width, "normal", "sd"),
            mean,
            -math.inf if low is None else low,
            math.inf if high is None else high,
        )
        ends: KeyPath = (*path, "normal", "max")
    elif tolerance.uniform is not None:
        low, high = (number(getattr(tolerance.uniform, end), measure, "uniform", end) for end in ("min", "max"))
        found = Spread(low=-math.inf if low is None else low, high=math.inf if high is None else high)
        ends = (*path, "uniform", "max")
    else:
        plus, minus = (number(getattr(tolerance, end), side, end) for end in ("plus", "minus"))
        found = Spread(plus=plus or 0.0, minus=minus or 0.0)
        ends = path
        if not faults and not (plus or minus):
            faults.append(
                (path, "SPC113", "a tolerance of plus and minus zero has no effect", "write e.g. `plus: 5 mm`")
            )
    if not faults and found.low >= found.high:
        faults.append((ends, "SPC113", "the maximum is not above the minimum", "check both values"))
    return (None if faults else found), faults


def _faults(said: Said, document: Document) -> Iterator[Diagnostic]:
    for path, code, reason, hint in said[1]:
        span = document.key_span(path) if code == "SPC113" else document.value_span(path)
        yield Diagnostic(code, f"{quote(dotted(path))}: {reason}", span, path, hint)
