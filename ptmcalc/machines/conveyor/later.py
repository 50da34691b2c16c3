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
from ptmcalc.machines.conveyor import bounds
from ptmcalc.machines.conveyor.loads import LOWEST, SLIPS
from ptmcalc.machines.conveyor.model import BeltLine, FloatArray, drive_force, grips, starting_force
from ptmcalc.machines.conveyor.spec import Conveyor
from ptmcalc.machines.conveyor.static_loads import hollows
from ptmcalc.numerics import lanes

_STRANDS = (RETURN, CARRY)
_X = np.linspace(0.0, 1.0, 129)
_FALL = frozenset({*LOWEST, "belt_safety_min", "slip_reserve_min", "starting_reserve"})
"""Families of loads that are worst when smallest."""


@dataclass(frozen=True, slots=True)
class Ending:
    """A belt at the end of the window of a start, whose drums are held at their speed.

    `energy` is that of the rates of its waves [J/s^2], `slips` whether a drum slips, and `carry_offset` the mean
    tension of the carry strand over the static one where drives hold both of its ends [N]. It `drifts` where the belt
    carries its strain along: speeds held at both ends then leave ever less of the load to one of the drives.
    """

    energy: float
    slips: bool
    carry_offset: float = 0.0
    drifts: bool = False


AT_SPEED = 0.99
"""Part of its speed from which on a drum counts as having it."""


def ending(line: BeltLine, drum: float, energy: float, slips: bool) -> tuple[Ending, str]:
    """The end of a start whose slowest drum has a speed [m/s], and what is to be said where it is none: drums that are
    too slow or slip are not held, and nothing bounds what follows."""
    slow = drum < AT_SPEED * line.speed
    how = ", the pulley slips" if slips else ""
    state = f"belt at {drum:.3g} of {line.speed:.3g} m/s{how}" if slow or slips else ""
    return Ending(math.inf if state else energy, slips), state


def still_to_come(spec: Conveyor, line: BeltLine, ending: Ending, loads: Mapping[str, Found]) -> dict[str, Interval]:
    """Offsets by which loads of a start can still change after its window, once the drums are held at their speed.

        |T(s, t) - T_even(s)| <= sqrt(2 E m(s))

    with E the energy of the rates of the waves at the end of the window, and m(s) the mass between the take-up and the
    section, a quarter of that of its weight included. Of a strand of which both ends are held, at a fixed take-up or
    between two drives, m is the larger of the masses to both sides.

    **Range** a start whose drums have their speed at the end; resistances as during the start.
    **Error** a bound for a straight belt; of one that sags the stiffness of the end holds.
    **Source** `laws.loop_bounds.held_swing`; derived there.
    """
    after = _After(spec, line, ending).loads
    offsets = {}
    for name, found in loads.items():
        kind = family(name)
        if kind in SLIPS:
            used = after.get("slip_utilisation_max" + name[len(kind) :], math.inf)
            offset = Interval(0.0, math.inf if ending.slips or used >= 1 else 0.0)
        elif kind == "takeup_movement":
            reach = _stretch(line, ending.energy)
            offset = Interval(0.0, max(reach, 2 * reach - found.estimate.high))
        elif name not in after:
            continue
        elif kind in _FALL:
            offset = Interval(min(after[name] - found.estimate.low, 0.0), 0.0)
        else:
            offset = Interval(0.0, max(after[name] - found.estimate.high, 0.0))
        if offset.low < 0 or offset.high > 0:
            offsets[name] = offset
    return offsets


def _masses(line: BeltLine, weight: float) -> FloatArray:
    """Mass between the take-up and the sections at the places `_X` of both strands, shape (2, n) [kg]."""
    found = []
    before = weight / 4
    for strand in _STRANDS:
        part = line.strand(strand)
        sums = np.concatenate([[0.0], np.cumsum(np.diff(part.marks) * np.array(part.masses))])
        found.append(before + lanes.interpolated(_X * part.length, part.marks, sums))
        before += float(sums[-1]) + line.tail_mass
    return np.array(found)


def _swing(energy: float, mass: FloatArray) -> FloatArray:
    """sqrt(2 E m), 0 where no mass is [N]."""
    swing = np.zeros_like(mass)
    swing[mass > 0] = np.sqrt(2 * energy * mass[mass > 0])
    return swing


def _part(shares: FloatArray, most: float) -> FloatArray:
    """Shares of what may be infinite; none of it is 0."""
    return np.asarray(shares * most) if math.isfinite(most) else np.where(shares > 0, most, 0.0)


def _stretch(line: BeltLine, energy: float) -> float:
    """Most by which the elongation of the belt strays from that of even running [m]."""
    swing = _swing(energy, _masses(line, 0.0))
    return sum(float(swing[strand].mean()) * line.strand(strand).length for strand in _STRANDS) / line.stiffness


class _After:
    """The belt once its drums are held: the least and the most tension at the places `_X` of both strands."""

    def __init__(self, spec: Conveyor, line: BeltLine, ending: Ending) -> None:
        self.spec, self.line = spec, line
        mass = _masses(line, spec.takeup_weight)
        even = np.array([line.static(strand, _X) for strand in _STRANDS])
        if has_tail_drive(spec):
            even[CARRY] += ending.carry_offset
            mass[CARRY] = float(mass[CARRY, -1] - mass[CARRY, 0])
        if line.fixed_length:
            mass = np.maximum(mass, mass[CARRY, -1] - mass)
        swing = _swing(ending.energy, mass)
        self.least, self.most = even - swing, even + swing
        if ending.drifts:
            side, sense = (self.most, 1) if ending.carry_offset > 0 else (self.least, -1)
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
        worst |= bounds.derived_loads(line, high, lows)
        needed = on - off + line.tail_pull
        worst["starting_force_needed"] = needed
        worst["starting_reserve"] = starting_force(self.spec) / needed if needed > 0 else math.inf
        for curve in hollows(self.spec):
            touched = np.abs(_X * line.carry.length - curve.place) <= curve.tangent + line.carry.length / len(_X)
            worst[of("tension_curve_max", str(curve.number))] = float(self.most[CARRY, touched].max())
        return worst | dict(self._of_drives())

    def _of_drives(self) -> Iterator[tuple[str, float]]:
        """Tensions and grip of every drive; drives at one place share what the belt takes by their starting forces."""
        friction, spec, used, left = grips(self.spec), self.spec, [], []
        lift = self.line.centrifugal_at_speed
        for place, first, last in (("head", (CARRY, -1), (RETURN, 0)), ("tail", (RETURN, -1), (CARRY, 0))):
            names = [name for name, drive in spec.all_drives.items() if drive.at == place]
            forces = np.array([drive_force(spec.all_drives[name]) for name in names])
            shares = np.concatenate([[0.0], np.cumsum(forces) / forces.sum()]) if names else np.zeros(1)
            least, most = (
                _part(1 - shares, float(side[first])) + _part(shares, float(side[last]))
                for side in (self.least, self.most)
            )
            for index, name in enumerate(names):
                yield of("tension_run_on_max", name), float(most[index])
                yield of("tension_run_off_min", name), float(least[index + 1])
                if name not in friction:
                    continue
                pairs = [(float(most[a]), float(least[b])) for a, b in ((index, index + 1), (index + 1, index))]
                grip = max(float(capstan.slip_utilisation(*pair, lift, friction[name])) for pair in pairs)
                bare = max(float(capstan.slip_utilisation(*pair, 0.0, friction[name])) for pair in pairs)
                used.append(grip)
                left.append(float(capstan.slip_reserve_ratio(bare, friction[name])))
                yield of("slip_utilisation_max", name), grip
                yield of("slip_reserve_min", name), left[-1]
        if used:
            yield "slip_utilisation_max", max(used)
            yield "slip_reserve_min", min(left)


def has_tail_drive(spec: Conveyor) -> bool:
    """Whether a drive turns the tail drum."""
    return any(drive.at == "tail" for drive in spec.all_drives.values())
