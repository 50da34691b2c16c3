"""What can be said about a stop without simulating it: the rigid conveyor, and intervals that hold the waves.

For belts in which a wave goes round a thousand times while they stop. As long as all of the belt slides forward, its
friction is a constant force and the belt is linear. Its drive falls out and its brakes come in as steps of force, at
once or one after another: their sum, sign or not, is F, and J = F/M. Then, with r and b of `laws.loop_bounds`,

    |S - S_static + a r| <= J b                                      tension anywhere
    |v_head - V| <= w = F (1/m - 1/M)/w_1                            modes of the drum, sum phi_n(0)^2 = 1/m - 1/M
    |x_head - X| <= 2 F (1/m - 1/M)/w_1^2

with V and X of the rigid body. Tension and speed of the head go round with the waves P, N = S +- Z v, so that no part
of the belt differs from V by more than

    u = 2 w + 3 J (b + |r|)/Z_min                                    J |r| for the jumps of a itself

and nothing turns round before V is down to u. From that moment on friction may change its sense; it only takes energy
out. The swing there is, J (b + |r|), is then counted once more, and the head comes to rest within three times the time
the rigid body still needs and one round of a wave.

**Range** one slope, one drive, all brakes at the head, no take-up weight, friction that does not go with the speed, a
softening by sag below 5 %.
**Error** derived up to the moment at which something may turn round; the rest after it is calibrated: finite elements
of the coverage tests came to a third of it.
**Source** `laws.loop_bounds`; d'Alembert.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.result import family, of
from ptmcalc.laws import loop_bounds, sag
from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses
from ptmcalc.machines.conveyor import bounds
from ptmcalc.machines.conveyor.brakes import brakes_of, braking
from ptmcalc.machines.conveyor.braking import rigid_stop
from ptmcalc.machines.conveyor.driving import running
from ptmcalc.machines.conveyor.loads import PER_DRIVE, SLIPS
from ptmcalc.machines.conveyor.model import BeltLine, loop_masses
from ptmcalc.machines.conveyor.spec import Coast, Conveyor, ConveyorScene, Stopping

_X = np.linspace(0.0, 1.0, 33)
_STRANDS = (RETURN, CARRY)
_SOFTEST = 0.05
_ON_AND_ON = 2.0
"""Times of the rigid body's last moments that the head may need besides them."""


@dataclass(frozen=True, slots=True)
class ShortStop:
    """A stop of the rigid conveyor in numbers: its accelerations and what its waves can add."""

    spec: Conveyor
    scene: ConveyorScene
    line: BeltLine
    masses: LoopMasses
    slowing: tuple[float, float]
    """least and largest deceleration of the rigid body, 0 among them [m/s^2]"""
    jumps: float
    """J: all changes of the force over the whole mass [m/s^2]"""
    swing: float
    """J (b + |r|) [N]"""
    stray: float
    """J b + J (b + |r|): what a tension may be off by [N]"""

    @property
    def softening(self) -> float:
        """By sag, at the lowest tension there can be."""
        spans = [span for span in (self.line.back.span_weight, self.line.carry.span_weight) if span]
        low = min(self._tensions(which, self.stray)[0] for which in _STRANDS)
        return max((float(sag.softening(self.line.stiffness, span, low)) for span in spans), default=0.0)

    def _tensions(self, which: int, more: float = 0.0) -> tuple[float, float]:
        """Lowest and highest tension of a strand [N]: straight between its ends, as r and the static tension are."""
        ends = np.array([0.0, 1.0])
        static, r = self.line.static(which, ends), loop_bounds.quasi_static(self.masses, which, ends)
        found = [static - a * r for a in self.slowing]
        return float(np.min(found)) - more, float(np.max(found)) + more

    def _at_drum(self, which: int, more: float = 0.0) -> tuple[float, float]:
        end = np.array([1.0 if which == CARRY else 0.0])
        static = float(self.line.static(which, end)[0])
        r = float(loop_bounds.quasi_static(self.masses, which, end)[0])
        if which == RETURN and not self.line.fixed_length:
            return static, static
        found = [static - a * r for a in self.slowing]
        return min(found) - more, max(found) + more

    # -- loads ---------------------------------------------------------------------------------------------------

    def loads(self, more: float = 0.0) -> dict[str, float]:
        """Loads of the rigid conveyor, or the worst ones if every tension but a constant one may be off by so much."""
        line = self.line
        strands = [self._tensions(which, more) for which in _STRANDS]
        on, off = (self._at_drum(which, more) for which in (CARRY, RETURN))
        found = {
            "tension_run_on_max": on[1],
            "tension_dynamic_run_on_max": on[1] - line.run_on,
            "tension_run_off_min": off[0],
            "tension_max": max(high for _, high in strands),
            "tension_min": min(low for low, _ in strands),
        }
        found |= bounds.derived_loads(line, found["tension_max"], tuple(low for low, _ in strands))
        if line.grip_exponent is not None:
            lift = line.centrifugal_at_speed
            states = [bounds.Sides(on[1], off[0], lift), bounds.Sides(on[0], off[1], lift), self._before]
            found |= bounds.slip_loads(line.grip_exponent, states)
        return found

    @property
    def _before(self) -> bounds.Sides:
        return bounds.Sides(self.line.run_on, self.line.run_off, self.line.centrifugal_at_speed)

    def held(self) -> dict[str, Interval]:
        """Intervals of the loads: from those of the belt that still runs evenly to the worst."""
        line, worst = self.line, self.loads(self.stray)
        least = bounds.even_loads(line)
        if line.grip_exponent is not None:
            least |= bounds.slip_loads(line.grip_exponent, [self._before])
        return {name: Interval(min(least[name], worst[name]), max(least[name], worst[name])) for name in least}

    def rest(self) -> tuple[Interval, Interval]:
        """Time and way to rest of the belt at the head [s], [m]; unknown where it may turn round from the first."""
        masses, force = self.masses, self.jumps * self.masses.total_mass
        slowest = loop_bounds.lowest_frequency_bound(masses) / math.sqrt(1 + self.softening)
        drum = force * (1 / masses.drive_mass - 1 / masses.total_mass)
        apart = 2 * drum / slowest + 3 * self.swing / min(map(self.line.impedance, _STRANDS))
        if not apart < self.line.speed:
            return Interval(0.0, math.inf), Interval(0.0, math.inf)
        first, way_first = rigid_stop(self.spec, self.scene, self.line, apart)
        last, way = rigid_stop(self.spec, self.scene, self.line)
        more = _ON_AND_ON * (last - first) + self.line.contour_time
        off = 2 * drum / slowest**2
        return Interval(first, last + more), Interval(max(way_first - off, 0.0), way + off + apart * more)


def short_stop(spec: Conveyor, scene: ConveyorScene) -> ShortStop | None:
    """A stop for which the bounds hold; None out of their range."""
    acting = brakes_of(spec, scene).values()
    plain = isinstance(scene, Stopping) and len(spec.all_drives) == 1 and all(one.at == "head" for one in acting)
    if not plain or spec.takeup.mass is not None or spec.resistance.speed_share > 0:
        return None
    line = running(spec, scene)
    if not (line.carry.even and line.back.even) or math.isinf(rigid_stop(spec, scene, line)[0]):
        return None
    masses = loop_masses(line, imposed=False)
    brakes = sum(braking(spec, one).force for one in acting)
    whole = masses.total_mass
    slowing = (line.static_resistance / whole, (line.static_resistance + brakes) / whole)
    jumps = (abs(line.static_resistance) + brakes) / whole
    largest, pulled = (
        max(float(np.abs(law(masses, which, _X)).max()) for which in _STRANDS)
        for law in (loop_bounds.stray, loop_bounds.quasi_static)
    )
    swing = jumps * (largest + pulled)
    least, most = min(0.0, *slowing), max(0.0, *slowing)
    found = ShortStop(spec, scene, line, masses, (least, most), jumps, swing, swing + jumps * largest)
    return found if math.isfinite(swing) and found.softening < _SOFTEST else None


def loads(stop: ShortStop) -> dict[str, float]:
    """Loads of the rigid conveyor that stops, those of its drive by name."""
    found = stop.loads()
    (drive,) = stop.spec.all_drives
    found |= {of(name, drive): found[name] for name in PER_DRIVE & found.keys()}
    if stop.line.grip_exponent is not None:
        found |= {of(name, drive): 0.0 for name in SLIPS}
    time, way = rigid_stop(stop.spec, stop.scene, stop.line)
    return found | {"stop_time": time, _way_of(stop.scene): way}


def offsets(stop: ShortStop, values: Mapping[str, Estimate]) -> dict[str, Interval]:
    """How far each load may lie from that of the rigid conveyor."""
    held = stop.held()
    held["stop_time"], held[_way_of(stop.scene)] = stop.rest()
    return {
        name: Interval(held[family(name)].low - one.value, held[family(name)].high - one.value)
        for name, one in values.items()
        if family(name) in held
    }


def _way_of(scene: ConveyorScene) -> str:
    return "coast_distance" if isinstance(scene, Coast) else "stop_distance"
