"""Numbers that are many at once: one run of ordinary code computes a machine for thousands of values of its keys.

A `Lanes` stands where a float stands and holds one value for each of some machines, its lanes. Arithmetic goes lane by
lane. Where code asks whether a comparison holds and the lanes do not agree, the run ends with `SplitError`, and
`parted` runs the code again on either part: every lane goes the way that its own numbers go, so nothing is written
twice and no branch is guessed. What cannot be done lane by lane (a conversion to float, a hash, a function of `math`)
raises an error: a lane is never dropped in silence.

Code that is to be run by lanes says `number(x)` for `float(x)`, `value(law, ...)` for `float(law(...))`, and takes
`exp`, `sqrt` and the like from here; with floats these are those of Python and of `math`, to the last bit.
"""

import math
import operator
from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Values = NDArray[Any]
Indices = NDArray[np.intp]
T = TypeVar("T")


class LanesError(TypeError):
    """Something was asked of lanes that only one number can do."""


class SplitError(Exception):
    """The lanes do not agree on a comparison; `holds` says where it holds."""

    def __init__(self, holds: NDArray[np.bool_]) -> None:
        super().__init__("the lanes part here")
        self.holds = holds


def _refused(what: str) -> Any:
    def refuse(self: "Lanes", *args: Any) -> Any:
        raise LanesError(f"lanes have no {what}")

    return refuse


def _binary(operation: Any, *, swapped: bool = False) -> Any:
    def apply(self: "Lanes", other: Any) -> Any:
        if isinstance(other, Lanes):
            other = other.values
        elif isinstance(other, np.ndarray):
            return _over(lambda one: operation(one, self) if swapped else operation(self, one), other)
        elif not isinstance(other, int | float):
            return NotImplemented
        with np.errstate(all="ignore"):  # what comes of it is looked at where a float's would be
            return Lanes(operation(other, self.values) if swapped else operation(self.values, other))

    return apply


def _unary(operation: Any) -> Any:
    def apply(self: "Lanes") -> "Lanes":
        with np.errstate(all="ignore"):
            return Lanes(operation(self.values))

    return apply


class Lanes:
    """One value for each lane: shape (n,)."""

    __slots__ = ("values",)

    def __init__(self, values: Values) -> None:
        self.values = values

    def __repr__(self) -> str:
        return f"Lanes({self.values!r})"

    def __bool__(self) -> bool:
        holds = self.values.astype(bool)
        first = bool(holds[0])
        if holds.all() if first else not holds.any():
            return first
        raise SplitError(holds)

    __add__, __radd__ = _binary(operator.add), _binary(operator.add, swapped=True)
    __sub__, __rsub__ = _binary(operator.sub), _binary(operator.sub, swapped=True)
    __mul__, __rmul__ = _binary(operator.mul), _binary(operator.mul, swapped=True)
    __truediv__, __rtruediv__ = _binary(operator.truediv), _binary(operator.truediv, swapped=True)
    __pow__, __rpow__ = _binary(operator.pow), _binary(operator.pow, swapped=True)
    __lt__, __le__ = _binary(operator.lt), _binary(operator.le)
    __gt__, __ge__ = _binary(operator.gt), _binary(operator.ge)
    __eq__, __ne__ = _binary(operator.eq), _binary(operator.ne)
    __neg__, __abs__, __pos__ = _unary(operator.neg), _unary(operator.abs), _unary(operator.pos)
    __float__, __int__, __index__ = _refused("float"), _refused("whole number"), _refused("index")
    __hash__ = None  # type: ignore[assignment]

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **more: Any) -> Any:
        """A function of numpy, lane by lane; of an array and lanes, element by element of the array."""
        if method != "__call__" or any(one is not None for one in more.values()):
            raise LanesError(f"lanes are not taken by {ufunc.__name__}.{method}")
        inputs = tuple(np.asarray(one) if isinstance(one, list | tuple) else one for one in inputs)
        arrays = [one for one in inputs if isinstance(one, np.ndarray) and one.ndim]
        if not arrays:
            with np.errstate(all="ignore"):
                return Lanes(ufunc(*(one.values if isinstance(one, Lanes) else one for one in inputs)))
        if len(arrays) == 1:
            at = next(k for k, one in enumerate(inputs) if one is arrays[0])
            return _over(lambda one: ufunc(*inputs[:at], one, *inputs[at + 1 :]), arrays[0])
        raise LanesError(f"lanes are not taken by {ufunc.__name__} with several arrays")


def _over(function: Callable[[Any], Any], array: Values) -> Values:
    """A function of every element of an array: an array of what it gives."""
    made = np.empty(array.shape, object)
    for at in np.ndindex(array.shape):
        made[at] = function(array[at])
    return made


# -- what code says that is to be run by lanes ----------------------------------------------------------------------


def number(value: Any) -> float:
    """`float(value)`; lanes stay lanes, which the types of numbers do not know."""
    found: Any = value if isinstance(value, Lanes) else float(value)
    return found  # type: ignore[no-any-return]


def value(law: Callable[..., Any], *given: Any) -> float:
    """`float(law(*given))` of a law that works on floats or arrays alike; lane by lane where lanes are given."""
    size = next((one.values.size for one in given if isinstance(one, Lanes)), None)
    if size is None:
        return float(law(*given))
    if any(isinstance(one, np.ndarray) for one in given):
        raise LanesError("a law of lanes takes no other arrays")
    found = law(*(one.values if isinstance(one, Lanes) else one for one in given))
    return Lanes(np.broadcast_to(found, (size,)))  # type: ignore[return-value]


def _of(name: str, array: np.ufunc) -> Callable[[float], float]:
    plain: Callable[[float], float] = getattr(math, name)

    def function(x: Any) -> float:
        found: Any = array(x) if isinstance(x, Lanes) else plain(x)
        return found  # type: ignore[no-any-return]

    return function


exp, expm1, sqrt = _of("exp", np.exp), _of("expm1", np.expm1), _of("sqrt", np.sqrt)
sin, cos, tan, asin = _of("sin", np.sin), _of("cos", np.cos), _of("tan", np.tan), _of("asin", np.arcsin)


def interpolated(x: Values, marks: Sequence[float], values: Values) -> Values:
    """`numpy.interp`, element by element where lanes are among them."""
    if not any(np.asarray(one).dtype == object for one in (x, marks, values)):
        return np.interp(x, marks, values)
    return _over(lambda one: _between(one, marks, values), np.asarray(x))


def _between(x: float, marks: Sequence[float], values: Values) -> float:
    """The value at one place."""
    if x <= marks[0]:
        return values[0]  # type: ignore[no-any-return]
    for k in range(1, len(marks)):
        if x <= marks[k]:
            slope = (values[k] - values[k - 1]) / (marks[k] - marks[k - 1])
            return slope * (x - marks[k - 1]) + values[k - 1]  # type: ignore[no-any-return]
    return values[-1]  # type: ignore[no-any-return]


def alike(values: Sequence[float]) -> bool:
    """Whether all are equal to the first, as `len(set(values)) == 1` says of numbers that may be hashed."""
    return all(one == values[0] for one in values[1:])


def of(found: Any, size: int) -> Values:
    """The values of a number in each of so many lanes."""
    return found.values if isinstance(found, Lanes) else np.full(size, found)


# -- runs by lanes --------------------------------------------------------------------------------------------------


def parted(lanes: Indices, compute: Callable[[Indices], T], most: int) -> Iterator[tuple[Indices, T | None]]:
    """What `compute` gives of lanes, part by part: it is run again on either part wherever a run of it ends because the
    lanes part. After `most` runs nothing is computed of what is left."""
    waiting = [lanes] if lanes.size else []
    while waiting:
        some = waiting.pop()
        if most <= 0:
            yield some, None
            continue
        most -= 1
        try:
            found = compute(some)
        except SplitError as split:
            waiting += [some[~split.holds], some[split.holds]]
            continue
        yield some, found
