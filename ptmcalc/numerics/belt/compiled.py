"""The compiled steps of a belt: `march.c`, which the installation compiles to a shared library beside this file.

The library is loaded when the first belt is simulated, and compiled again before that where `march.c` changed. Each
class here has the members of the struct of its name in `march.c`, in that order; arrays are passed by their address, so
their owner keeps them.
"""

import ctypes
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from ptmcalc.base.errors import NumericsError, UsageError
from ptmcalc.numerics.belt.compiler import LIBRARY, SOURCE, checksum, compiled, compiler
from ptmcalc.numerics.belt.course import FloatArray
from ptmcalc.numerics.belt.curve import SHAPES, MotorForce

_CURE = "run `python -m pip install -e .` in the project's folder, or `python -m pip install .`"
_ASK = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_double, ctypes.c_double, ctypes.POINTER(ctypes.c_double))
_RAISED, _OFF_THE_GRID = 5, 6
NOT_FINITE, LOST_GRIP = 7, 2
"""A fault that Python finds too; `March.ended` where a slipping drum lost its belt."""
_FAULTS = {
    1: "the spans of the belt find no tension",
    2: "stick and slip of the drums alternate without end at {time:.4g} s",
    3: "a drum without mass is driven by more than can hold it at any speed",
    4: "a drive's force rises with speed far too steeply for its drum and the step",
    7: "the waves of the belt are beyond all numbers at {time:.4g} s",
}
_REAL, _WHOLE, _ADDRESS = ctypes.c_double, ctypes.c_int64, ctypes.c_void_p


def _members(**kinds: str) -> list[tuple[str, type]]:
    """Members of a struct by their kind: `real`, `whole`, `array` (an address), each as words."""
    found: list[tuple[str, type]] = []
    for name, words in kinds.items():
        kind = {"real": _REAL, "whole": _WHOLE, "array": _ADDRESS}[name.partition("_")[0]]
        found += [(word, kind) for word in words.split()]
    return found


class Stage(ctypes.Structure):
    """Torque of a motor over its speed until the next stage."""

    _fields_ = _members(
        array="speeds torques", whole="knots extends", real="breakdown slip stator synchronous until_speed until_time"
    )


class Curve(ctypes.Structure):
    """Motors on their curve."""

    _fields_ = _members(
        array="stages points",
        whole="count point_count shape",
        real="turns drives brakes delay off again reference ramp falls_from fill soft_from soft_time",
    )


class Law(ctypes.Structure):
    """A force [N] by time and speed, or another value by time: nothing, samples with ramps, motors on their curve, or a
    function."""

    _fields_ = (
        ("samples", _ADDRESS), ("count", _WHOLE), ("step", _REAL), ("ramps", _ADDRESS), ("ramp_count", _WHOLE),
        ("curve", _ADDRESS), ("asked", _ASK),
    )  # fmt: skip


class Drum(ctypes.Structure):
    """A drum and its state."""

    _fields_ = (
        *_members(real="mass grip hold share", whole="one_way"),
        ("force", Law), ("brake", Law),
        *_members(whole_1="slip", real="speed slid heat pull", whole_2="slipped"),
        *_members(real="next first last rate first_given last_given", array="leader", whole_3="apart"),
    )  # fmt: skip


class End(ctypes.Structure):
    """A station at a time: tensions before and behind its drums [N], speeds of the belt there [m/s]."""

    _fields_ = _members(real="on off comes leaves")


class Station(ctypes.Structure):
    """A station and its state."""

    _fields_ = (
        *_members(
            real_1="before after climb_on climb_off friction_on friction_off drag_on drag_off line_mass",
            whole="has_takeup", real_2="takeup_tension takeup_mass",
        ),
        ("imposed", Law),
        *_members(whole_1="is_imposed", real_1="hold", whole_2="drum_count", array="drums tensions"),
        *_members(real="belt behind leaves gives tension calm lifts creep work n_on p_off"),
        *_members(whole="held has_arrived has_pulls fault"),
        ("earlier", End),
    )  # fmt: skip


class Give(ctypes.Structure):
    """What nodes give, and its state."""

    _fields_ = _members(
        whole_1="nodes", real_1="step eager settled",
        array_1="before after climb sags rate hang between damped yields inner heats lengths",
        array_2="tension slackness viscous late retarded tried passed change",
        real_2="stored span_heat rubber_heat", whole_2="rounds",
    )  # fmt: skip


class Travel(ctypes.Structure):
    """What a running belt carries along."""

    _fields_ = _members(
        whole="cells tail every carried", real="step stiffness",
        array="climb_within impedance goes cell_back cell_ahead node_back node_ahead tension speed way strain",
    )  # fmt: skip


class March(ctypes.Structure):
    """A belt on its way through a window."""

    _fields_ = _members(
        whole_1="cells tail k", real_1="step", array_1="before after friction drag yields impedance climb_within",
        array_2="give travel head low against along speeds speeds_before doubled doubled_before behind ways",
        array_3="highest highest_at lowest lowest_at longest longest_at lows head_row tail_row",
        real_2="lost rubbed flow exchanged carried rests_for grips_from presses rested", whole_2="ended",
    )  # fmt: skip


_STRUCTS = (Stage, Curve, Law, Drum, Station, Give, Travel, March)


def _compile_where_older() -> None:
    if not SOURCE.exists() or (LIBRARY.exists() and checksum(SOURCE).encode() in LIBRARY.read_bytes()):
        return
    fault = "older than its source" if LIBRARY.exists() else "missing"
    try:
        compiled(SOURCE, LIBRARY)
    except (OSError, subprocess.CalledProcessError) as error:
        failed = error.strerror if isinstance(error, OSError) else "the compiler failed"
        why = failed if compiler() else "no C compiler"
        what = f"the compiled part of the belt simulation, {LIBRARY.name}"
        raise UsageError(f"{what}, is {fault} and cannot be compiled: {why}", _CURE) from None


@cache
def library() -> ctypes.CDLL:
    """The compiled steps.

    Raises:
        UsageError: they are not compiled from the present `march.c`, and cannot be.
    """
    _compile_where_older()
    try:
        found = ctypes.CDLL(str(LIBRARY))
    except OSError as error:
        missing = "missing" if not LIBRARY.exists() else f"not usable ({error})"
        raise UsageError(f"the compiled part of the belt simulation, {LIBRARY.name}, is {missing}", _CURE) from None
    sizes = (_WHOLE * len(_STRUCTS))()
    found.belt_sizes(sizes)
    assert list(sizes) == [ctypes.sizeof(one) for one in _STRUCTS]
    for name in ("advance", "begin", "pass_on", "march"):
        getattr(found, f"belt_{name}").restype = _WHOLE
    for name in ("velocity", "given", "energy", "force"):
        getattr(found, f"belt_{name}").restype = _REAL
    for name in ("hang", "carry", "start", "exponential", "forces", "rigid_start"):
        getattr(found, f"belt_{name}").restype = None
    for name, kinds in (
        ("advance", [_ADDRESS, *[_REAL] * 4]),
        ("begin", [_ADDRESS, *[_REAL] * 3]),
        ("pass_on", [_ADDRESS] * 7),
        ("march", [_ADDRESS, _WHOLE]),
        ("velocity", [*[_REAL] * 3, _ADDRESS, _ADDRESS, _REAL, _ADDRESS]),
        ("given", [_ADDRESS]),
        ("energy", [_ADDRESS]),
        ("force", [_ADDRESS, *[_REAL] * 2, _ADDRESS]),
        ("hang", [_ADDRESS] * 2),
        ("carry", [_ADDRESS] * 6),
        ("start", [_ADDRESS]),
        ("exponential", [_REAL, _ADDRESS]),
        ("forces", [_ADDRESS, _WHOLE, *[_ADDRESS] * 3]),
        ("rigid_start", [_ADDRESS, _WHOLE, *[_REAL] * 5, _WHOLE, _ADDRESS]),
    ):
        getattr(found, f"belt_{name}").argtypes = kinds
    return found


def address(values: FloatArray) -> int:
    """Where an array lies that C reads or writes."""
    assert values.dtype == np.float64
    assert values.flags.c_contiguous
    return values.ctypes.data


def address_of(made: ctypes.Structure | ctypes.Array[Any]) -> int:
    """Where a struct of C lies."""
    return ctypes.addressof(made)


def forces(given: MotorForce, times: FloatArray, speeds: FloatArray) -> FloatArray:
    """Forces of motors on their curve at times [s] and rim speeds [m/s], of equal shape [N]."""
    laws = Laws()
    law, found = laws.of_speed(given), np.empty(np.shape(times))
    at, turning = (np.ascontiguousarray(values, float) for values in (times, speeds))
    library().belt_forces(address_of(law), at.size, address(at), address(turning), address(found))
    return found


def start_on_curves(
    curves: Sequence[MotorForce],
    resistance: float,
    mass: float,
    goal: float,
    steady: float,
    step: float,
    steps: int,
) -> tuple[float, float, float]:
    """A rigid belt that its motors start, by Heun's rule with equal steps.

        m v' = sum F(t, v) - W,   v >= 0

    Args:
        curves: motors of the drives.
        resistance: W [N].
        mass: m [kg].
        goal, steady: speeds that are looked for [m/s].
        step: length of a step [s].
        steps: most steps.

    Returns:
        When the belt has the speed `goal` [s], how far it went by then [m], and the end of the step at which it has
        `steady` [s]; the end where it does not get there.

    **Error** of second order: half the step leaves a quarter of it.
    """
    laws = Laws()
    made = (Law * len(curves))(*map(laws.of_speed, curves))
    found = np.zeros(3)
    library().belt_rigid_start(
        address_of(made), len(curves), resistance, mass, goal, steady, step, steps, address(found)
    )
    time, way, end = found.tolist()
    return time, way, end


def check(fault: int, time: float, raised: Sequence[BaseException] = ()) -> None:
    """Nothing, where a step went well.

    Raises:
        NumericsError: NUM101 when the step has no solution, or no finite one.
        BaseException: a law of the caller raised it.
    """
    if fault == _RAISED:
        raise raised[0]
    if fault == _OFF_THE_GRID:
        raise IndexError(f"a law over time has no sample at {time:.4g} s")
    if fault:
        raise NumericsError("NUM101", _FAULTS[fault].format(time=time))


@dataclass(frozen=True, slots=True, eq=False)
class OverTime:
    """A value sampled on a grid of time, with ramps on top of the samples.

        f(t) = samples[t/dt] + sum of size min((t - delay)/rise, 1) over the ramps with t > delay

    The nearest sample counts; `ramps` are (size, delay, rise).
    """

    samples: FloatArray
    step: float
    ramps: tuple[tuple[float, float, float], ...] = ()


class Laws:
    """Laws of a station as C reads them, with what they need to live on and what their functions raised."""

    def __init__(self) -> None:
        self.raised: list[BaseException] = []
        self._alive: list[object] = []

    def of_time(self, given: OverTime | Callable[[float], float] | None) -> Law:
        """A value over time."""
        if given is None or isinstance(given, OverTime):
            return self._sampled(given)
        return self.of_speed(lambda time, speed: (given(time), 0.0))

    def of_speed(self, given: OverTime | Callable[[float, float], tuple[float, float]] | None) -> Law:
        """A force over time and speed, and its slope over the speed."""
        if given is None or isinstance(given, OverTime):
            return self._sampled(given)
        if isinstance(given, MotorForce):
            return self._on_curve(given)

        def asked(time: float, speed: float, found: "ctypes._Pointer[ctypes.c_double]") -> int:
            try:
                found[0], found[1] = given(time, speed)
            except BaseException as error:
                self.raised.append(error)
                return 1
            return 0

        self._alive.append(kept := _ASK(asked))
        return Law(asked=kept)

    def _on_curve(self, given: MotorForce) -> Law:
        stages = (Stage * len(given.stages))()
        for made, stage in zip(stages, given.stages, strict=True):
            knots = np.array(stage.knots, float).reshape(-1, 2)
            speeds, torques = np.ascontiguousarray(knots[:, 0]), np.ascontiguousarray(knots[:, 1])
            made.speeds, made.torques, made.knots = address(speeds), address(torques), len(knots)
            made.extends = stage.extends
            if stage.kloss is not None:
                made.breakdown, made.slip = stage.kloss.torque, stage.kloss.slip
                made.stator, made.synchronous = stage.kloss.stator, stage.kloss.synchronous
            made.until_speed, made.until_time = stage.until_speed, stage.until_time
            self._alive += [speeds, torques]
        numbers = [getattr(given, name) for name, kind in Curve._fields_ if kind is _REAL]
        points = np.array(() if isinstance(given.shape, str) else given.shape, float)
        shape = SHAPES.index(given.shape) if isinstance(given.shape, str) else 0
        curve = Curve(address_of(stages), address(points), len(stages), len(points), shape, *numbers)
        self._alive += [stages, points, curve]
        return Law(curve=address_of(curve))

    def _sampled(self, given: OverTime | None) -> Law:
        if given is None:
            return Law()
        samples, ramps = (np.ascontiguousarray(values, float) for values in (given.samples, given.ramps))
        self._alive += [samples, ramps]
        return Law(address(samples), len(samples), given.step, address(ramps), len(ramps))
