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

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.belt.friction_step import velocity
from ptmcalc.numerics.exponential_step import weights

Torque = Callable[[float, float], tuple[float, float]]
"""Force of a drive at the rim by time [s] and rim speed [m/s]: the force [N] and its slope over the speed [N*s/m]."""
_ALTERNATIONS = 12
_SAME = 1e-12
_HELD = 1 + 1e-9
"""Friction of a belt at rest holds no more than this share of itself: its tension is a difference of large ones."""


def no_force(time: float, speed: float) -> tuple[float, float]:
    """A drum without a motor."""
    return 0.0, 0.0


def no_brake(time: float) -> float:
    """A drum without a brake."""
    return 0.0


@dataclass(frozen=True, slots=True)
class Drum:
    """A drum: mass at the rim [kg], drive, brake capacity over time [N], grip exponent mu alpha (None: never slips)."""

    name: str
    mass: float
    force: Torque = no_force
    brake: Callable[[float], float] = no_brake
    exponent: float | None = None
    one_way: bool = False
    """held by a backstop: never turns back"""
    hold: float = math.inf
    """speed of its motor at the pulley surface [m/s]: once the drum has it, the motor holds it while it is on"""


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


@dataclass(slots=True)
class _Slack:
    """Tension behind the drums over a step: from `first` to `last` less `yields` times the belt speed."""

    first: float
    last: float
    yields: float
    friction: float


@dataclass(slots=True)
class _Move:
    """One try of a step: belt speed and acceleration at its end, force of every drive at its start and end, how
    friction acts (1 against forward motion, between -1 and 1 at rest), and what a backstop holds."""

    belt: float
    acceleration: float
    forces: list[tuple[float, float]]
    held: float
    holds: float


class Station:
    """Drums at one place, in the order in which the belt meets them.

    `imposed` is a speed over time [m/s] where the drives control it, and `shares` how they then share the force.
    """

    def __init__(
        self,
        place: Place,
        drums: Sequence[Drum],
        takeup: TakeUp | None = None,
        imposed: Callable[[float], float] | None = None,
        shares: Sequence[float] = (),
    ) -> None:
        self.place, self.drums, self.takeup, self.imposed = place, tuple(drums), takeup, imposed
        self.hold = max((drum.hold for drum in self.drums), default=math.inf)
        self.held = False
        """whether motors hold their speed now"""
        count = len(self.drums)
        self.shares = tuple(shares) or tuple(1 / count for _ in self.drums)
        self.grips = [math.exp(drum.exponent) if drum.exponent is not None else math.inf for drum in self.drums]
        self.slid, self.heat = [0.0] * count, [0.0] * count
        """way [m] and heat [J] of slip so far"""
        self.work = 0.0
        """done by drives less what brakes took [J]"""
        self.lifts = 0.0
        """speed whose centrifugal tension acts in a step [m/s]"""
        self.creep = 0.0
        """by how much the belt leaves the drums faster than it comes, its stretch being less there [m/s]"""

    def begin(self, speed: float, n_on: float, p_off: float) -> Seen:
        """Everything at one speed at time 0."""
        count = len(self.drums)
        self.belt = float(self.imposed(0.0) if self.imposed else speed)
        self.behind, self.tension = float(speed), math.nan
        self.gives = math.copysign(1.0, speed) if speed else 0.0
        self.speeds, self.slips = [self.belt] * count, [0] * count
        self.pulls: list[float] | None = None
        self.arrived: tuple[float, float] | None = None
        return self.advance(0.0, float(n_on), float(p_off), 0.0)

    def advance(self, time: float, n_on: float, p_off: float, step: float) -> Seen:
        """The state at a time, `step` after the last one, where the waves `n_on` and `p_off` arrive."""
        p_off -= (self.place.after + self.place.drag_off) * self.creep  # from here on as if none left faster
        if not (self.drums or self.takeup or self.imposed):
            return self._carried(n_on, p_off)
        old, drums, slips = self.belt, tuple(self.speeds), tuple(self.slips)
        self.lifts = old
        if self.held and not any(drum.force(time, old)[0] for drum in self.drums):  # the motors are off
            self.held, self.imposed = False, None
        for _ in range(_ALTERNATIONS):
            slack = self._slack(p_off, step)
            move = self._moved(time, n_on, slack, old, step)
            tensions = self._tensions(time, n_on, slack, move)
            change = self._breaks_loose(tensions, move.belt)
            if change is not None:
                self.slips[change[0]] = change[1]
            elif not self._gives_way(p_off, tensions[-1], 0.0 if step else move.belt - old):
                if step or not any(self.slips) or abs(move.belt - self.lifts) <= _SAME * abs(old):
                    break
                self.lifts = move.belt  # a jump: the belt presses on its drums with the speed after it
        else:
            raise NumericsError("NUM101", f"stick and slip of the drums alternate without end at {time:.4g} s")
        speeds, forces = self._turned(time, tensions, move, drums, step)
        caught = [j for j, sense in enumerate(slips) if sense and sense * (speeds[j] - move.belt) <= 0 and step]
        for j in caught:
            move = self._caught(j, move, speeds[j], (old, drums[j]), time, n_on, slack, step)
        if caught:
            tensions = self._tensions(time, n_on, slack, move)
            if self.imposed is not None:
                tensions = self._at_its_limit(caught, tensions, time, n_on, slack, move)
            speeds = [move.belt if not sense else speed for speed, sense in zip(speeds, self.slips, strict=True)]
        self._account(time, tensions, move, forces, speeds, (old, drums), step)
        self.belt, self.speeds, self.arrived = move.belt, speeds, (n_on, p_off)
        self.pulls = [above - behind for above, behind in itertools.pairwise(tensions)]
        if self.takeup:
            self._settle(self.takeup, p_off, tensions[-1])
        behind = (self.behind if self.takeup else move.belt) + self.creep
        return Seen(tensions, move.belt, behind, tuple(speeds), tuple(self.slips), self.creep)

    def _carried(self, n_on: float, p_off: float) -> Seen:
        """The state where nothing acts but the belt and its friction: it is in balance at any time."""
        place = self.place
        on, off, rubs = n_on + place.climb_on, p_off + place.climb_off, place.friction_on + place.friction_off
        push, before, after = off - on, place.before + place.drag_on, place.after + place.drag_off
        rest = abs(push) - rubs
        if rest > 0:
            self.belt = math.copysign(rest / (before + after), push)
            held = math.copysign(1.0, push)
        else:
            self.belt, held = 0.0, push / rubs if rubs else 0.0
        belt = self.belt
        tensions = on + before * belt + held * place.friction_on, off - after * belt - held * place.friction_off
        return Seen(tensions, belt, belt + self.creep, (), (), self.creep)

    # -- the belt ---------------------------------------------------------------------------------------------

    def _moved(self, time: float, n_on: float, slack: _Slack, old: float, step: float, share: float = 0.0) -> _Move:
        """Try a step with the present choice of what slips; `share` of the waves' step is over when it begins."""
        place, lift, start = self.place, self.place.belt_line_mass * self.lifts * self.lifts, time - step
        grip, mass, slope = 1.0, 0.0, 0.0
        push_early = push_late = 0.0
        rubs = grinds = place.friction_on
        given: list[tuple[float, float, float]] = []
        held_by, sticks = 0.0, False
        for j, (drum, sense) in enumerate(zip(self.drums, self.slips, strict=True)):
            at = self.speeds[j] if sense else old
            force, rate = drum.force(time, at)
            first = drum.force(start, at)[0] if step else force
            given.append((first, force, rate))
            if sense:
                grip *= self.grips[j] ** sense
                continue
            sticks = True
            held_by = held_by or grip * drum.one_way
            mass += grip * drum.mass
            slope += grip * rate
            push_early += grip * (first - rate * at)
            push_late += grip * (force - rate * at)
            if drum.brake is not no_brake:
                rubs += grip * drum.brake(start if step else time)
                grinds += grip * drum.brake(time)
        against = place.before + place.drag_on - slope + grip * slack.yields
        before = n_on if self.arrived is None else self.arrived[0]
        wave, behind = before + share * (n_on - before), slack.first + share * (slack.last - slack.first)
        early = push_early + grip * behind + (1 - grip) * lift - wave - place.climb_on
        late = push_late + grip * slack.last + (1 - grip) * lift - n_on - place.climb_on
        rubs, grinds = rubs + grip * slack.friction, grinds + grip * slack.friction
        holds = 0.0
        if self.imposed is not None and (sticks or not self.drums):
            belt = self.imposed(time)
            acceleration = (belt - old) / step if step else 0.0
            held = math.copysign(1.0, belt) if belt else 0.0
        else:
            belt = velocity(old, mass, against, (rubs, grinds), (early, late), step)
            if held_by and belt < 0:
                belt = 0.0
            held = math.copysign(1.0, belt) if belt else (max(-1.0, min(1.0, late / grinds)) if grinds else 0.0)
            left = late - against * belt - held * grinds
            if held_by and not belt and left < 0:
                holds, left = -left / held_by, 0.0
            acceleration = left / mass if mass > 0 else 0.0
            if sticks and belt > self.hold and any(force > 0 for _, force, _ in given):
                belt, self.held, self.imposed = self.hold, True, lambda _: self.hold
                acceleration, held = (belt - old) / step if step else 0.0, 1.0
        forces = [
            (first, force if sense else force + rate * (belt - old))
            for (first, force, rate), sense in zip(given, self.slips, strict=True)
        ]
        return _Move(belt, acceleration, forces, held, holds)

    def _slack(self, p_off: float, step: float) -> _Slack:
        """What is behind the drums over the coming step.

        A weight on two falls goes with half of y = v - v_r, the speed the belt loses to it:

            M/4 y' = T0 - T,   T = P - R - Z v_r

        by the exponential step for forcing linear in time, which leaves T linear in the belt speed at its end.
        """
        place, takeup = self.place, self.takeup
        impedance, arriving = place.after + place.drag_off, p_off + place.climb_off
        if not takeup:
            before = p_off if self.arrived is None else self.arrived[1]
            return _Slack(before + place.climb_off, arriving, impedance, place.friction_off)
        weight = takeup.mass / 4
        if weight <= 0:
            return _Slack(takeup.tension, takeup.tension, 0.0, 0.0)
        friction, apart = self.gives * place.friction_off, self.belt - self.behind
        if not step:
            if (
                self.gives or not place.friction_off
            ):  # whatever the belt does at once, it does to both sides of the weight
                return _Slack(arriving, arriving - friction + impedance * apart, impedance, 0.0)
            held = min(max(takeup.tension, arriving - place.friction_off), arriving + place.friction_off)
            return _Slack(held, held, 0.0, 0.0)
        if not self.gives and place.friction_off:  # the weight goes with the belt alone: it adds to the drums' mass
            yields = weight / step
            return _Slack(self.tension + yields * self.belt, takeup.tension + yields * self.belt, yields, 0.0)
        calm = (arriving - friction - takeup.tension) / impedance
        decay, early, late = weights(impedance / weight * step)
        settled = self.belt - self.calm
        last = arriving - friction + impedance * (decay * apart + early * settled - late * calm)
        yields = impedance * (1 - late)
        return _Slack(self.tension + yields * self.belt, last, yields, 0.0)

    def _gives_way(self, p_off: float, tension: float, jump: float) -> bool:
        """Whether the belt behind a heavy take-up cannot be held by its friction, or goes with a jump of the belt."""
        friction, left = self.place.friction_off, p_off + self.place.climb_off - tension
        if not (self.takeup and self.takeup.mass and friction) or self.gives:
            return False
        if not jump and abs(left) <= friction * _HELD:
            return False
        self.gives = math.copysign(1.0, jump or left)
        return True

    def _settle(self, takeup: TakeUp, p_off: float, tension: float) -> None:
        """Belt speed behind the take-up: Z v_r = P - T - R."""
        place, arriving = self.place, p_off + self.place.climb_off
        impedance, friction, left = place.after + place.drag_off, place.friction_off, arriving - tension
        turns = takeup.mass > 0 and friction > 0 and self.gives * left <= 0
        pull = 0.0 if turns else max(abs(left) - friction, 0.0)
        self.behind = math.copysign(pull / impedance, left) if pull else 0.0
        self.gives = math.copysign(1.0, left) if pull else 0.0
        self.tension, self.calm = tension, (arriving - self.gives * friction - takeup.tension) / impedance

    # -- the drums --------------------------------------------------------------------------------------------

    def _tensions(self, time: float, n_on: float, slack: _Slack, move: _Move) -> tuple[float, ...]:
        """Tensions before, between and behind the drums."""
        place, belt = self.place, move.belt
        on = n_on + place.climb_on + (place.before + place.drag_on) * belt + move.held * place.friction_on
        found = [slack.last - slack.yields * belt - move.held * slack.friction]
        if len(self.drums) < 2:
            return on, found[0]
        lift = place.belt_line_mass * belt * belt
        needed = self._needed(on, found[0], lift, move.acceleration) if self.imposed is not None else 0.0
        stuck = [j for j, (drum, sense) in enumerate(zip(self.drums, self.slips, strict=True)) if not sense]
        holding = next((j for j in stuck if self.drums[j].one_way), None)
        for j in range(len(self.drums) - 1, 0, -1):
            drum, sense = self.drums[j], self.slips[j]
            if sense:
                above = lift + self.grips[j] ** sense * (found[-1] - lift)
            elif self.imposed is not None:
                above = found[-1] + self.shares[j] * needed - drum.mass * move.acceleration
            else:
                braked = move.held * drum.brake(time)
                above = found[-1] + move.forces[j][1] - drum.mass * move.acceleration - braked
                above += move.holds if j == holding else 0.0
            found.append(above)
        found.append(on)
        return tuple(reversed(found))

    def _needed(self, on: float, off: float, lift: float, acceleration: float) -> float:
        """Force that drives at an imposed speed share: what their drums' mass and those that slip leave of it."""
        without, factor = off, 0.0
        for drum, sense, grip, share in zip(reversed(self.drums), reversed(self.slips), reversed(self.grips),
                                            reversed(self.shares), strict=True):  # fmt: skip
            if sense:
                without, factor = lift + grip**sense * (without - lift), grip**sense * factor
            else:
                without, factor = without - drum.mass * acceleration, factor + share
        return (on - without) / factor if factor else 0.0

    def _breaks_loose(self, tensions: tuple[float, ...], belt: float) -> tuple[int, int] | None:
        """A drum that sticks though its tensions ask for more than its grip, and the sense in which it slips."""
        lift = self.place.belt_line_mass * belt * belt
        for j, sense in enumerate(self.slips):
            if sense or math.isinf(self.grips[j]):
                continue
            above, behind = tensions[j] - lift, tensions[j + 1] - lift
            if above > self.grips[j] * behind and above > behind:
                return j, 1
            if behind > self.grips[j] * above and behind > above:
                return j, -1
        return None

    def _turned(
        self, time: float, tensions: tuple[float, ...], move: _Move, before: tuple[float, ...], step: float
    ) -> tuple[list[float], list[tuple[float, float]]]:
        """Speeds of the drums at the end, and their drives' forces at start and end.

        Either the belt's speed, or their own where they slip: m v' = F - pull - B sgn v.
        """
        if not any(self.slips):
            return [move.belt] * len(self.drums), move.forces
        speeds, forces = [], list(move.forces)
        for j, (drum, sense) in enumerate(zip(self.drums, self.slips, strict=True)):
            if not sense:
                speeds.append(move.belt)
                continue
            if self.imposed is not None:
                speeds.append(self.imposed(time))
                continue
            pull, rate = tensions[j] - tensions[j + 1], drum.force(time, before[j])[1]
            first, force = move.forces[j]
            pulled = first - rate * before[j] - (self.pulls[j] if self.pulls else pull)
            brakes = drum.brake(time - step if step else time), drum.brake(time)
            new = velocity(before[j], drum.mass, -rate, brakes, (pulled, force - rate * before[j] - pull), step)
            new = 0.0 if new < 0 and drum.one_way else new
            held = new > drum.hold and force > 0
            new = drum.hold if held else new
            forces[j] = first, pull if held else force + rate * (new - before[j])
            speeds.append(new)
        return speeds, forces

    def _caught(
        self,
        j: int,
        move: _Move,
        drum: float,
        before: tuple[float, float],
        time: float,
        n_on: float,
        slack: _Slack,
        step: float,
    ) -> _Move:
        """A slipping drum comes to the belt's speed inside the step: from there on they move as one."""
        apart, ends = before[1] - before[0], drum - move.belt
        share = apart / (apart - ends) if apart != ends else 0.0
        share = min(max(share, 0.0), 1.0)
        meets = before[1] + share * (drum - before[1])
        self.slips[j] = 0
        return self._moved(time, n_on, slack, meets, (1 - share) * step, share)

    def _at_its_limit(
        self, caught: list[int], tensions: tuple[float, ...], time: float, n_on: float, slack: _Slack, move: _Move
    ) -> tuple[float, ...]:
        """Tensions where drums that have come to the speed of others that stick cannot give their share of the force:
        these give all that their grip allows, at that speed."""
        for _ in caught:
            change = self._breaks_loose(tensions, move.belt)
            if change is None or change[0] not in caught or self.slips.count(0) < 2:
                break
            self.slips[change[0]] = change[1]
            tensions = self._tensions(time, n_on, slack, move)
        return tensions

    def _account(
        self,
        time: float,
        tensions: tuple[float, ...],
        move: _Move,
        forces: list[tuple[float, float]],
        speeds: list[float],
        before: tuple[float, tuple[float, ...]],
        step: float,
    ) -> None:
        """Add up slip, its heat, and the work of drives and brakes over the step, by the trapezium rule."""
        if not step:
            return
        for j, drum in enumerate(self.drums):
            apart = (abs(speeds[j] - move.belt) + abs(before[1][j] - before[0])) / 2
            pull = tensions[j] - tensions[j + 1]
            earlier = self.pulls[j] if self.pulls else pull
            self.slid[j] += apart * step
            self.heat[j] += apart * (abs(pull) + abs(earlier)) / 2 * step
            turned = (speeds[j] + before[1][j]) / 2
            if self.imposed is not None:  # what the drum passes on and what it takes to turn it so
                self.work += step * (pull + earlier) / 2 * turned + drum.mass * (speeds[j] - before[1][j]) * turned
                continue
            brake = (drum.brake(time) + drum.brake(time - step)) / 2 if drum.brake is not no_brake else 0.0
            self.work += step * ((forces[j][0] + forces[j][1]) / 2 * turned - brake * abs(turned))
