"""What waves that still go round the belt at the end of a start can yet do to its loads."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ptmcalc.base.estimate import Interval
from ptmcalc.contract.result import Found, family, of
from ptmcalc.laws import capstan
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.curves.loads import bend_names
from ptmcalc.machines.conveyor.machine import tension_loads
from ptmcalc.machines.conveyor.machine.load_sharing import pull_together, shares_at
from ptmcalc.machines.conveyor.machine.loads import LOWEST, SLIPS, TAKEUP_CLEARANCES, TAKEUP_TOTAL
from ptmcalc.machines.conveyor.machine.model import BeltLine, FloatArray, grips, starting_force
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.numerics.free_waves import Row, swings

_STRANDS = (RETURN, CARRY)
_X = np.linspace(0.0, 1.0, 129)
"""Points of a strand as fractions of its length [1] at which tensions are bounded, as in `start_enclosure`; a
numerical choice. More points find the extreme more closely and take longer."""
_ALL, _HALVINGS = 8.0, 40
"""Traction in use after a start; numerical choices. `_ALL`: utilisation above which it counts as infinite [1].
`_HALVINGS`: bisections, which resolve it to 7e-12. A larger `_ALL` reports larger numbers of a slipping pulley; fewer
halvings are faster and coarser."""
Place = tuple[int, int]
"""A strand, and its first (0) or last place (-1)."""
_FALL = frozenset({*LOWEST, "belt_safety_min", "slip_reserve_min", "starting_reserve"})
"""Families of loads that are worst when smallest."""


MODES = 256
"""Maximum number of springs of a belt whose modes are computed. A numerical choice: time grows with its cube. A smaller
number takes the modes of a coarser grid."""
AT_SPEED = 0.99
"""Speed of a pulley relative to that of steady running [1] from which on it counts as reached. An engineering choice. A
larger value reports more starts as unfinished."""


@dataclass(frozen=True, slots=True)
class Ending:
    """A belt at the end of the window of a start, whose drums are held at their speed.

    `row` are its masses and springs, `tail` which of the masses is at the tail; None where drums are too slow or slip:
    nothing then bounds what follows, and `state` says how the belt stands. It `drifts` where the belt carries its
    strain along: speeds held at head and tail then leave ever less of the load to one of the drives.
    """

    row: Row | None
    tail: int
    state: str = ""
    slips: bool = False
    drifts: bool = False


def ending(goal: float, drum: float, slips: bool, row: Row, tail: int) -> Ending:
    """The end of a start to a speed, whose slowest drum has another one [m/s]."""
    slow = drum < AT_SPEED * goal
    how = ", the pulley slips" if slips else ""
    state = f"belt at {drum:.3g} of {goal:.3g} m/s{how}" if slow or slips else ""
    return Ending(None if state else row, tail, state, slips)


def still_to_come(spec: Conveyor, line: BeltLine, end: Ending, loads: Mapping[str, Found]) -> dict[str, Interval]:
    """Offsets by which loads of a start can still change after its window, once the drums are held at their speed.

        |T(s, t) - T_even(s)| <= sum_k A_k |psi_k(s)|

    over the natural modes of the belt whose drums are held, with the amplitudes that the waves have at the end.

    **Range** a start whose drums have their speed at the end; resistances as during the start.
    **Error** a bound for a straight belt; of one that sags the stiffness of the end holds.
    **Source** `numerics.free_waves.swings`; derived there.
    """
    after = _After(spec, line, end)
    offsets = {}
    for name, found in loads.items():
        kind = family(name)
        if kind in SLIPS:
            used = after.loads.get("slip_utilisation_max" + name[len(kind) :], math.inf)
            offset = Interval(0.0, math.inf if end.slips or used >= 1 else 0.0)
        elif kind in ("takeup_movement", TAKEUP_TOTAL):
            offset = Interval(0.0, max(after.way, 2 * after.way - loads["takeup_movement"].estimate.high))
        elif kind in TAKEUP_CLEARANCES:
            offset = Interval(-after.way, 0.0)
        elif name not in after.loads:
            continue
        elif kind in _FALL:
            offset = Interval(min(after.loads[name] - found.estimate.low, 0.0), 0.0)
        else:
            offset = Interval(0.0, max(after.loads[name] - found.estimate.high, 0.0))
        if offset.low < 0 or offset.high > 0:
            offsets[name] = offset
    return offsets


def _part(shares: FloatArray, most: float) -> FloatArray:
    """Shares of what may be infinite; none of it is 0."""
    return np.asarray(shares * most) if math.isfinite(most) else np.where(shares > 0, most, 0.0)


class _After:
    """The belt once its drums are held: the least and the most tension at the places `_X` of both strands, and the most
    by which its run-off strays from where it is in even running [m]."""

    def __init__(self, spec: Conveyor, line: BeltLine, end: Ending) -> None:
        self.spec, self.line = spec, line
        even = np.array([line.static(strand, _X) for strand in _STRANDS])
        swing, self.way, self.tail = np.full(even.shape, math.inf), math.inf, end.tail
        self.swings = None if end.row is None or end.drifts else swings(end.row)
        offset = 0.0
        if end.row is not None:
            found, cells = self.swings or swings(end.row), np.cumsum(end.row.compliances) - end.row.compliances / 2
            parts = (slice(0, end.tail), slice(end.tail, None))
            for strand, part in zip(_STRANDS, parts, strict=True):
                ends = np.cumsum(end.row.compliances)[[part.start - 1, (part.stop or 0) - 1]] * [part.start > 0, 1]
                swing[strand] = np.interp(_X, (cells[part] - ends[0]) / (ends[1] - ends[0]), found.pulls[part])
            self.way = found.way_of_weight(end.row)
            if end.tail in end.row.held:
                own = end.row.compliances[end.tail :]
                offset = float(own @ end.row.pulls[end.tail :]) / float(own.sum())
        if line.keeps_run_off and not spec.takeup_weight:
            swing[RETURN, 0] = 0.0
        even[CARRY] += offset
        self.even, self.least, self.most = even, even - swing, even + swing
        if end.drifts:
            side, sense = (self.most, 1) if offset > 0 else (self.least, -1)
            side[CARRY] = sense * math.inf

    @cached_property
    def loads(self) -> dict[str, float]:
        """The worst that every load can come to."""
        line = self.line
        high, lows = float(self.most.max()), (float(self.least[RETURN].min()), float(self.least[CARRY].min()))
        on, off = float(self.most[CARRY, -1]), float(self.least[RETURN, 0])
        worst = {
            "tension_run_on_max": on,
            "tension_dynamic_run_on_max": on - line.run_on,
            "tension_run_off_min": off,
            "tension_max": high,
            "tension_min": min(lows),
        }
        courses = tuple((_X * line.strand(which).length, self.least[which]) for which in _STRANDS)
        worst |= tension_loads.derived_loads(line, high, lows, tension_loads.spans_at(line, courses))
        needed = line.tail_pull + self._together((CARRY, -1), (RETURN, 0), (1.0, -1.0))
        worst["starting_force_needed"] = needed
        worst["starting_reserve"] = starting_force(self.spec) / needed if needed > 0 else math.inf
        for curve in self.spec.route.hollows:
            touched = np.abs(_X * line.carry.length - curve.place) <= curve.tangent + line.carry.length / len(_X)
            worst[of("tension_curve_max", str(curve.number))] = float(self.most[CARRY, touched].max())
        return worst | dict(self._of_bends()) | dict(self._of_drives())

    def _of_bends(self) -> Iterator[tuple[str, float]]:
        """Tensions of horizontal curves."""
        for low, high, strand, bend in bend_names(self.spec):
            which = CARRY if strand == "carry" else RETURN
            whole = self.line.strand(which).length
            ends = (bend.start, bend.end) if strand == "carry" else (whole - bend.end, whole - bend.start)
            near = whole / (len(_X) - 1)  # one point beside each end at least
            touched = (whole * _X >= ends[0] - near) & (whole * _X <= ends[1] + near)
            yield low, float(self.least[which, touched].min())
            yield high, float(self.most[which, touched].max())

    def _of_drives(self) -> Iterator[tuple[str, float]]:
        """Tensions and grip of every drive; drives at one place share what the belt takes as in steady running."""
        friction, spec, used, left = grips(self.spec), self.spec, [], []
        lift = self.line.centrifugal_at_speed
        for place, first, last in (("head", (CARRY, -1), (RETURN, 0)), ("tail", (RETURN, -1), (CARRY, 0))):
            names = [name for name, drive in spec.all_drives.items() if drive.at == place]
            shares = np.concatenate([[0.0], np.cumsum(shares_at(spec, self.line, place))])
            least, most = (
                _part(1 - shares, float(side[first])) + _part(shares, float(side[last]))
                for side in (self.least, self.most)
            )
            apart = not pull_together(spec, self.line, place)
            if apart:  # how drives that work against each other share the force of a wave is not known
                least[1:-1], most[1:-1] = -math.inf, math.inf
            for index, name in enumerate(names):
                yield of("tension_run_on_max", name), float(most[index])
                yield of("tension_run_off_min", name), float(least[index + 1])
                if name not in friction:
                    continue
                sides = shares[index], shares[index + 1]
                grip = max(self._used(first, last, pair, lift, friction[name]) for pair in (sides, sides[::-1]))
                bare = max(self._used(first, last, pair, 0.0, friction[name]) for pair in (sides, sides[::-1]))
                used.append(math.inf if apart else grip)
                left.append(0.0 if apart else float(capstan.slip_reserve_ratio(bare, friction[name])))
                yield of("slip_utilisation_max", name), used[-1]
                yield of("slip_reserve_min", name), left[-1]
        if used:
            yield "slip_utilisation_max", max(used)
            yield "slip_reserve_min", min(left)

    def _used(self, first: Place, last: Place, shares: tuple[float, float], lift: float, exponent: float) -> float:
        """Most of a drum's grip that is ever in use, where its tight and its slack side lie between two sides of the
        drums of its place.

            exp(-mu alpha) (T_tight - rho v^2) <= u (T_slack - rho v^2)   at all times for any u above it
        """
        tight, slack = ((1 - share, share) for share in shares)
        squeeze = math.exp(-exponent)

        def exceeds(used: float) -> bool:
            weights = squeeze * tight[0] - used * slack[0], squeeze * tight[1] - used * slack[1]
            return self._together(first, last, weights) > (squeeze - used) * lift

        if self.swings is None or exceeds(_ALL):
            return math.inf
        if not exceeds(0.0):  # a rope of so many turns holds anything
            return 0.0
        low, high = 0.0, _ALL
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if exceeds(middle) else (low, middle)
        return high

    def _together(self, first: Place, last: Place, weights: tuple[float, float]) -> float:
        """The most that a weighted sum of the tensions at two places ever comes to [N]."""
        if self.swings is None:
            return math.inf
        springs = {self._spring(first): weights[0], self._spring(last): weights[1]}
        if self.line.keeps_run_off and not self.spec.takeup_weight:
            springs = {spring: weight for spring, weight in springs.items() if spring > 0}  # its tension is kept
        even = weights[0] * self.even[first] + weights[1] * self.even[last]
        return float(even) + self.swings.together(springs)

    def _spring(self, place: Place) -> int:
        """The spring at an end of a strand."""
        strand, end = place
        if strand == RETURN:
            return 0 if end == 0 else self.tail - 1
        assert self.swings is not None
        return self.tail if end == 0 else len(self.swings.bent) - 1
