"""What can be said about a stop without simulating it: the rigid conveyor, and intervals that hold the waves.

For belts in which a wave goes round a thousand times while they stop. As long as all of the belt slides forward, its
friction is a constant force and the belt is linear. Its drive falls out and its brakes come in as steps or ramps of
force, at once or one after another; no mode answers a ramp of time t with more than 2/(w_1 t) of what it answers a step
with. With J the sum of all steps, sign or not, over M, J' the same with ramps that count so, and e, C, G of
`laws.loop_bounds`,

    |v - V| <= u = J' e                                              speed anywhere
    |x - X| <= 2 J M max C                                           no mode displaces by more than twice its mean
    int rho v'^2 ds <= n^2 = M J^2 + M^2 J'^2 (1/m - 1/M)            F phi_n(0) of every mode, the rigid one in it

with V and X of the rigid body: nothing turns round before V is down to u. From that moment on friction and brakes may
change their sense. They are monotone in the speed: of two motions of the belt the distance sqrt(int rho dv^2 + dS^2/EA)
never grows, and of one and the same a moment later neither, so that n bounds the accelerations to the end (Brezis). A
brake that still comes in by then adds its step to n in full, J' = J. With friction between its two senses, by Cauchy
and Schwarz,

    S_static - 2 phi_below - n sqrt(G) <= S <= S_static + 2 phi_above + n sqrt(G)

G that of a drum at imposed speed, and M/4 more of a take-up weight M on two falls: it enters the norm with M y'^2/4, y
the speed that the belt loses to it, and does not move with the rigid body, so that neither J, nor e, nor F phi_n(0)
change; its own period enters w_1 (Dunkerley). phi_below is the friction behind the section, that of a fixed loop
weighted with the share of compliance behind its place, phi_above (none with a gravity take-up) the friction ahead of it
with the share ahead. The head comes to rest within twice the time the rigid body still needs and half a round of a
wave.

**Range** one slope, one drive, all brakes at the head, friction that does not go with the speed, a
softening by sag below 5 %.
**Error** derived, but for the last moments of the head, which are calibrated: finite elements of 24 seeded machines
came to a sixth of them, of 200 others in no case to their end.
**Source** `laws.loop_bounds`; d'Alembert; H. Brezis, Operateurs maximaux monotones (1973): the speed of a semigroup of
contractions never grows.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.contract.result import family, of
from ptmcalc.laws import loop_bounds, sag
from ptmcalc.laws.loop_bounds import CARRY, RETURN, LoopMasses
from ptmcalc.machines.conveyor.machine import tension_loads
from ptmcalc.machines.conveyor.machine.brakes import brakes_of, braking
from ptmcalc.machines.conveyor.machine.drives import running
from ptmcalc.machines.conveyor.machine.loads import OF_BRAKES, PER_DRIVE, SLIPS, WAYS_OF_STOP, ways_of
from ptmcalc.machines.conveyor.machine.model import BeltLine, loop_masses
from ptmcalc.machines.conveyor.machine.rigid_stop import rigid_stop
from ptmcalc.machines.conveyor.machine.scenes import ControlledStop, ConveyorScene, Stopping
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.stopping.brake_heat import moved_heat, rigid_heat

FloatArray = NDArray[np.float64]

_X = np.linspace(0.0, 1.0, 65)
"""Points of a strand as fractions of its length [1] at which bounds are evaluated; a numerical choice. More points find
the extreme more closely and take longer."""
_STRANDS = (RETURN, CARRY)
_SOFTEST = 0.05
"""Softening of the belt by sag, relative to its compliance, below which the bounds apply [1]. An engineering choice. A
larger value admits belts with more sag, and widens the speed bound and the period by the root of 1 + softening."""
_ON_AND_ON = 1.0
"""Additional time of the head, relative to the last interval of the rigid body's stop [1]. Calibrated with `_ROUNDS`:
finite elements of 24 machines needed a sixth of both, none of 200 others all of it. A smaller value loses the safety of
the bound; a larger one lengthens the stop."""
_ROUNDS = 0.5
"""Additional time of the head, in contour times [1]. Calibrated as `_ON_AND_ON`. A smaller value loses the safety of
the bound; a larger one lengthens the stop."""


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
    felt: float
    """J': the same with ramps as far as the modes feel them [m/s^2]"""

    @property
    def weight(self) -> float:
        """Take-up weight as mass of the speed that the belt loses to it, M/4 [kg]."""
        return self.spec.takeup_weight / 4

    @property
    def reach(self) -> float:
        """n: bound of the accelerations [N/kg^(1/2)]."""
        masses, felt = self.masses, self.felt if self._settled else self.jumps
        parts = 1 / masses.drive_mass - 1 / masses.total_mass
        return math.sqrt(masses.total_mass * self.jumps**2 + (masses.total_mass * felt) ** 2 * parts)

    @property
    def _settled(self) -> bool:
        """Whether all brakes have come in before anything may turn round."""
        brakes = [braking(self.spec, one) for one in brakes_of(self.spec, self.scene).values()]
        apart = self.apart * math.sqrt(1 + _SOFTEST)
        if not brakes or not apart < self.line.speed:
            return not brakes
        return max(one.delay + one.rise for one in brakes) <= rigid_stop(self.spec, self.scene, self.line, apart)[0]

    @property
    def apart(self) -> float:
        """u: most by which a speed differs from that of the rigid body [m/s]."""
        return self.felt * max(float(loop_bounds.speed_stray(self.masses, which, _X).max()) for which in _STRANDS)

    def strays(self, which: int, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Most by which a tension may be below and above the static one [N]."""
        held = replace(self.masses, imposed_speed=True)
        swing = self.reach * np.sqrt(loop_bounds.tension_green(held, which, x) + self.weight)
        below, above = self._rubbed(which, x)
        return swing + 2 * below, swing + 2 * above

    def _rubbed(self, which: int, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """phi_below and phi_above of sections [N]."""
        back, carry, tail = self.line.back.friction[-1], self.line.carry.friction[-1], self.line.tail_force
        if not self.line.fixed_length:
            return (back * x if which == RETURN else back + tail + carry * x), np.zeros_like(x)
        whole = self.masses.return_compliance + self.masses.carry_compliance
        first, last = self.masses.return_compliance / whole, self.masses.carry_compliance / whole
        if which == RETURN:
            ahead = carry * last / 2 + tail * last + back * ((1 - x) - first * (1 - x**2) / 2)
            return back * first * x**2 / 2, ahead
        behind = back * first / 2 + tail * first + carry * (first * x + last * x**2 / 2)
        return behind, carry * last * (1 - x) ** 2 / 2

    @property
    def softening(self) -> float:
        """By sag, at the lowest tension there can be."""
        spans = [span for span in (self.line.back.span_weight, self.line.carry.span_weight) if span]
        low = min(self._tensions(which, _X, strays=True)[0] for which in _STRANDS)
        return max((float(sag.softening(self.line.stiffness, span, low)) for span in spans), default=0.0)

    def _tensions(self, which: int, x: FloatArray, *, strays: bool = False) -> tuple[float, float]:
        """Lowest and highest tension at places of a strand [N]: of the rigid conveyor, or of all that may be."""
        static, r = self.line.static(which, x), loop_bounds.quasi_static(self.masses, which, x)
        rigid = [static - a * r for a in self.slowing]
        low, high = np.minimum(*rigid), np.maximum(*rigid)
        if strays:
            below, above = self.strays(which, x)
            low, high = np.minimum(low, static - below), np.maximum(high, static + above)
        return float(low.min()), float(high.max())

    def _at_drum(self, which: int, *, strays: bool = False) -> tuple[float, float]:
        end = np.array([1.0 if which == CARRY else 0.0])
        if which == RETURN and not self.line.fixed_length:
            static = float(self.line.static(which, end)[0])
            stray = self.reach * math.sqrt(self.weight) if strays else 0.0
            return static - stray, static + stray
        return self._tensions(which, end, strays=strays)

    # -- loads ---------------------------------------------------------------------------------------------------

    def loads(self, *, strays: bool = False) -> dict[str, float]:
        """Loads of the rigid conveyor, or the worst ones if every tension but a constant one may stray."""
        line = self.line
        strands = [self._tensions(which, _X, strays=strays) for which in _STRANDS]
        on, off = (self._at_drum(which, strays=strays) for which in (CARRY, RETURN))
        found = {
            "tension_run_on_max": on[1],
            "tension_dynamic_run_on_max": on[1] - line.run_on,
            "tension_run_off_min": off[0],
            "tension_max": max(high for _, high in strands),
            "tension_min": min(low for low, _ in strands),
        }
        found |= tension_loads.derived_loads(line, found["tension_max"], tuple(low for low, _ in strands))
        if line.grip_exponent is not None:
            lift = line.centrifugal_at_speed
            states = [tension_loads.Sides(on[1], off[0], lift), tension_loads.Sides(on[0], off[1], lift), self._before]
            found |= tension_loads.slip_loads(line.grip_exponent, states)
        return found

    @property
    def _before(self) -> tension_loads.Sides:
        return tension_loads.Sides(self.line.run_on, self.line.run_off, self.line.centrifugal_at_speed)

    def held(self) -> dict[str, Interval]:
        """Intervals of the loads: from those of the belt that still runs evenly to the worst."""
        line, worst = self.line, self.loads(strays=True)
        least = tension_loads.even_loads(line)
        if line.grip_exponent is not None:
            least |= tension_loads.slip_loads(line.grip_exponent, [self._before])
        return {name: Interval(min(least[name], worst[name]), max(least[name], worst[name])) for name in least}

    def rest(self) -> tuple[Interval, Interval]:
        """Time to rest of the belt at the head [s], way to rest of any point of the belt [m]; unknown where it may turn
        round from the first."""
        masses, soft = self.masses, 1 + self.softening
        apart = self.apart * math.sqrt(soft)
        if not apart < self.line.speed:
            return Interval(0.0, math.inf), Interval(0.0, math.inf)
        first, way_first = rigid_stop(self.spec, self.scene, self.line, apart)
        last, way = rigid_stop(self.spec, self.scene, self.line)
        more = _ON_AND_ON * (last - first) + _ROUNDS * self.line.contour_time
        gives = max(float(loop_bounds.give(masses, which, x)) for which in _STRANDS for x in _X)
        off = 2 * self.jumps * masses.total_mass * gives * soft
        return Interval(first, last + more), Interval(max(way_first - off, 0.0), way + off + apart * more)


def short_stop(spec: Conveyor, scene: ConveyorScene) -> ShortStop | None:
    """A stop for which the bounds hold; None out of their range."""
    acting = brakes_of(spec, scene).values()
    held = isinstance(scene, Stopping) and not isinstance(scene, ControlledStop)
    plain = held and len(spec.all_drives) == 1 and all(one.at == "head" for one in acting)
    if not plain or spec.resistance.speed_share > 0:
        return None
    line = running(spec, scene)
    if line.weight_at_tail or (spec.takeup.budgeted and not line.fixed_length):
        return None
    if not (line.carry.even and line.back.even) or math.isinf(rigid_stop(spec, scene, line)[0]):
        return None
    masses = loop_masses(line, imposed=False)
    brakes = [braking(spec, one) for one in acting]
    whole, resistance = masses.total_mass, line.static_resistance
    whole_loop = masses.return_compliance + masses.carry_compliance
    slowest = 1 / math.sqrt(loop_bounds.lowest_frequency_bound(masses) ** -2 + spec.takeup_weight / 4 * whole_loop)
    slowest /= math.sqrt(1 + _SOFTEST)
    shares = [_answered(slowest * one.rise) for one in brakes]
    full = sum(one.force for one in brakes)
    felt = sum(one.force * share for one, share in zip(brakes, shares, strict=True))
    slowing = (resistance / whole, (resistance + full) / whole)
    least, most = min(0.0, *slowing), max(0.0, *slowing)
    jumps, felt = ((abs(resistance) + force) / whole for force in (full, felt))
    found = ShortStop(spec, scene, line, masses, (least, most), jumps, felt)
    return found if math.isfinite(found.reach) and found.softening < _SOFTEST else None


def _answered(turned: float) -> float:
    """Share of a step that a mode answers a ramp with at most, from w t."""
    return 1.0 if turned <= 2.0 else 2.0 / turned


def loads(stop: ShortStop) -> dict[str, float]:
    """Loads of the rigid conveyor that stops, those of its drive by name."""
    found = stop.loads()
    (drive,) = stop.spec.all_drives
    found |= {of(name, drive): found[name] for name in PER_DRIVE & found.keys()}
    if stop.line.grip_exponent is not None:
        found |= {of(name, drive): 0.0 for name in SLIPS}
    time, way = rigid_stop(stop.spec, stop.scene, stop.line)
    found |= rigid_heat(stop.spec, stop.scene)
    return found | {"stop_time": time} | dict.fromkeys(ways_of(stop.scene), way)


def offsets(stop: ShortStop, values: Mapping[str, Estimate]) -> dict[str, Interval]:
    """How far each load may lie from that of the rigid conveyor."""
    held = stop.held()
    held["stop_time"], way = stop.rest()
    held |= dict.fromkeys(ways_of(stop.scene), way)
    ways = [one for name, one in values.items() if name in WAYS_OF_STOP]
    apart = max((max(way.high - one.value, one.value - way.low) for one in ways), default=math.inf)
    heats = {name: moved_heat(stop.spec, name, apart) for name in values if family(name) in OF_BRAKES}
    return heats | {
        name: Interval(held[family(name)].low - one.value, held[family(name)].high - one.value)
        for name, one in values.items()
        if family(name) in held
    }
