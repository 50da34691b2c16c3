"""A place where drums act on the belt: the head or the tail, with the take-up behind the head's drums.

Belt speed v and tensions follow from the waves that arrive, N from upstream and P from downstream:

    S_on = N + Z_u v + R_u sgn v        S_off = P - Z_d v - R_d sgn v   (no take-up)   or   T   (take-up)

Drums stand in a row from the tight side to the slack side. A drum that sticks adds its mass; one that slips passes
on e = exp(+-mu alpha) times what is behind it, both less the centrifugal tension l:

    S_above - l = e (S_behind - l)          m_j v' = F_j + S_behind - S_above - B_j sgn v   (sticking)

Multiplied up from the slack side this is one equation for the belt,

    sum E_j m_j v' = sum E_j (F_j - B_j sgn v) + E S_off + (1 - E) l - S_on,   E_j the product of e above drum j

of first order in v and advanced by the exponential step for forcing linear in time; without a sticking drum it is
algebraic. Brakes B and friction R are set-valued: a belt at rest stays so while the forces on it are within them.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple, overload

import numpy as np

from ptmcalc.numerics.belt import compiled
from ptmcalc.numerics.belt.compiled import Laws, OverTime, address, check, library
from ptmcalc.numerics.belt.course import FloatArray

Torque = Callable[[float, float], tuple[float, float]]
"""Force of a drive at the rim by time [s] and rim speed [m/s]: the force [N] and its slope over the speed [N*s/m]."""


def no_force(time: float, speed: float) -> tuple[float, float]:
    """A drum without a motor."""
    return 0.0, 0.0


def no_brake(time: float) -> float:
    """A drum without a brake."""
    return 0.0


@dataclass(frozen=True, slots=True)
class Drum:
    """A drum: mass at the rim [kg], drive, brake capacity over time [N], grip exponent mu alpha (None: never slips).

    A drive or brake given as a function is called from C in every step, which takes longer than samples over time.
    """

    name: str
    mass: float
    force: Torque | OverTime = no_force
    brake: Callable[[float], float] | OverTime = no_brake
    exponent: float | None = None
    one_way: bool = False
    """held by a backstop: never turns back"""
    hold: float = math.inf
    """speed of its motor at the pulley surface [m/s]: once the drum has it, the motor holds it while it is on"""
    leader: str = ""
    """drum whose speed its force follows instead of its own"""


@dataclass(frozen=True, slots=True)
class TakeUp:
    """A weight behind the head's drums: belt tension it asks for [N], and its mass [kg], 0 for a constant tension."""

    tension: float
    mass: float = 0.0


@dataclass(frozen=True, slots=True)
class Place:
    """Where drums stand: impedances [N*s/m], gravity's tensions [N], friction lumps [N] and drags [N*s/m] on both
    sides, and the mass per length of the bare belt [kg/m]."""

    before: float
    after: float
    climb_on: float
    climb_off: float
    friction_on: float
    friction_off: float
    drag_on: float
    drag_off: float
    belt_line_mass: float


class Seen(NamedTuple):
    """A station at a time: tensions before, between and behind its drums [N], speeds [m/s], slip of each drum, and by
    how much the belt leaves the drums faster than it comes."""

    tensions: tuple[float, ...]
    belt: float
    behind: float
    drums: tuple[float, ...]
    slips: tuple[int, ...]
    creep: float = 0.0


class Track(Sequence[Seen]):
    """A station over time, as arrays with one row a step; each item is the station at one time.

    Args:
        rows: belt speed, speed behind, creep, tensions, speeds of the drums, their slips; shape (steps, width).
        drums: number of drums.
    """

    def __init__(self, rows: FloatArray, drums: int) -> None:
        self._rows, self._count = rows, drums
        turning = rows.shape[1] - 2 * drums
        self.belt, self.behind, self.creep = rows[:, 0], rows[:, 1], rows[:, 2]
        self.tensions, self.drums = rows[:, 3:turning], rows[:, turning : turning + drums]
        self.slips = rows[:, turning + drums :]

    @staticmethod
    def width(drums: int) -> int:
        """Length of a row."""
        return 3 + max(drums + 1, 2) + 2 * drums

    def __len__(self) -> int:
        return len(self._rows)

    @overload
    def __getitem__(self, index: int) -> Seen: ...

    @overload
    def __getitem__(self, index: slice) -> "Track": ...

    def __getitem__(self, index: int | slice) -> "Seen | Track":
        if isinstance(index, slice):
            return Track(self._rows[index], self._count)
        return self._seen(self._rows[index].tolist())

    def __iter__(self) -> Iterator[Seen]:
        return map(self._seen, self._rows.tolist())

    def _seen(self, row: list[float]) -> Seen:
        turning = len(row) - 2 * self._count
        slips = tuple(map(int, row[turning + self._count :]))
        return Seen(
            tuple(row[3:turning]), row[0], row[1], tuple(row[turning : turning + self._count]), slips, row[2]
        )  # fmt: skip


def follow(*stations: "Station") -> None:
    """Connect drums with those whose speed their force follows, at their own station or at another one."""
    places = {drum.name: (one, index) for one in stations for index, drum in enumerate(one.drums)}
    for station in stations:
        for index, drum in enumerate(station.drums):
            if drum.leader:
                there, which = places[drum.leader]
                station.turning[index].leader = compiled.address_of(there.turning[which])
                station.turning[index].apart = int(there is not station)


class Station:
    """Drums at one place, in the order in which the belt meets them. The steps are those of `march.c`.

    `imposed` is a speed over time [m/s] where the drives control it, and `shares` how they then share the force.
    """

    def __init__(
        self,
        place: Place,
        drums: Sequence[Drum],
        takeup: TakeUp | None = None,
        imposed: Callable[[float], float] | OverTime | None = None,
        shares: Sequence[float] = (),
    ) -> None:
        self.place, self.drums, self.takeup = place, tuple(drums), takeup
        count, self._laws = len(self.drums), Laws()
        self.shares = tuple(shares) or (1 / max(count, 1),) * count
        self.raised = self._laws.raised
        """errors of laws that are functions"""
        self._tensions = np.zeros(max(count + 1, 2))
        self.turning = (compiled.Drum * max(count, 1))()
        """the drums as C has them"""
        for made, drum, share in zip(self.turning, self.drums, self.shares, strict=False):
            made.mass, made.hold, made.share, made.one_way = drum.mass, drum.hold, share, int(drum.one_way)
            made.grip = math.exp(drum.exponent) if drum.exponent is not None else math.inf
            made.force = self._laws.of_speed(None if drum.force is no_force else drum.force)
            made.brake = self._laws.of_time(None if drum.brake is no_brake else drum.brake)
        self.state = state = compiled.Station(
            place.before, place.after, place.climb_on, place.climb_off, place.friction_on, place.friction_off,
            place.drag_on, place.drag_off, place.belt_line_mass,
        )  # fmt: skip
        if takeup:
            state.has_takeup, state.takeup_tension, state.takeup_mass = 1, takeup.tension, takeup.mass
        state.imposed, state.is_imposed = self._laws.of_time(imposed), imposed is not None
        state.hold = max((drum.hold for drum in self.drums), default=math.inf)
        state.drum_count, state.tensions = count, address(self._tensions)
        state.drums = compiled.address_of(self.turning)
        self.at = compiled.address_of(state)
        """where C finds it"""

    def begin(self, speed: float, n_on: float, p_off: float) -> Seen:
        """Everything at one speed at time 0."""
        check(library().belt_begin(self.at, speed, n_on, p_off), 0.0, self.raised)
        return self._seen()

    def advance(self, time: float, n_on: float, p_off: float, step: float) -> Seen:
        """The state at a time, `step` after the last one, where the waves `n_on` and `p_off` arrive.

        Raises:
            NumericsError: NUM101 when what sticks and slips alternates without end, or a drive has no motion.
            BaseException: a law of a drum raised it.
        """
        check(library().belt_advance(self.at, time, n_on, p_off, step), time, self.raised)
        return self._seen()

    def _seen(self) -> Seen:
        state, turning = self.state, self.turning[: len(self.drums)]
        drums, slips = tuple(one.speed for one in turning), tuple(one.slip for one in turning)
        return Seen(tuple(self._tensions.tolist()), state.belt, state.leaves, drums, slips, state.creep)

    @property
    def imposes(self) -> bool:
        """Whether the drives impose a speed, or hold that of their motors now."""
        return bool(self.state.is_imposed or self.state.held)

    @property
    def creep(self) -> float:
        """By how much the belt leaves the drums faster than it comes, its stretch being less there [m/s]."""
        return float(self.state.creep)

    @creep.setter
    def creep(self, creep: float) -> None:
        self.state.creep = creep

    @property
    def slid(self) -> list[float]:
        """Way of slip of each drum so far [m]."""
        return [one.slid for one in self.turning[: len(self.drums)]]

    @property
    def heat(self) -> list[float]:
        """Heat of slip of each drum so far [J]."""
        return [one.heat for one in self.turning[: len(self.drums)]]

    @property
    def work(self) -> float:
        """Work of the drives less that of the brakes so far [J]."""
        return float(self.state.work)
