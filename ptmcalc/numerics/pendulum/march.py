"""One run of the motion: which mode holds, what follows an event, and what a break of an input does."""

import math
from bisect import bisect_right

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.collocation import Rule
from ptmcalc.numerics.pendulum.equations import (
    HIGH,
    KEEP,
    LAW,
    LOW,
    OFF,
    POSITION,
    SPEED,
    WORKS,
    Held,
    Leg,
    Mode,
    N,
    W,
    kept_speed,
)
from ptmcalc.numerics.pendulum.guards import NOISE, Guards
from ptmcalc.numerics.pendulum.parts import LINEAR, Case, Follow, Jib, Push, Straight
from ptmcalc.numerics.pendulum.steps import Stepper
from ptmcalc.numerics.pendulum.track import Step, Track
from ptmcalc.numerics.record import Event

FloatArray = NDArray[np.float64]

_MOST_AT_ONCE = 60
"""Events without progress in time."""
_PLACED = 1e-7
"""Share of the speeds by which a crossing may have missed the speed it is about."""
_SWINGS = 0.05
"""Speed of the pivot over (g L)^(1/2) that its load may give it, for the scale."""


class March:
    """The way through all events."""

    def __init__(self, case: Case, end: float, tolerance: float, rule: Rule, most_steps: int) -> None:
        self.case, self.end, self.most_steps = case, end, most_steps
        self.kept = kept_speed(case)
        self.omega = math.sqrt(case.gravity / float(case.load.length.at(0.0)))
        self.approach = 1
        self.stage = self._first_stage()
        scale = self._scales()
        self.speeds = float(scale[SPEED])
        self.guards = Guards(
            float(scale[POSITION]), self.speeds, self.force, case.load.mass * case.gravity, self.approach
        )
        self.stepper = Stepper(rule, tolerance, scale, self.omega)
        self.places = [buffer.place for buffer in case.axis.buffers]
        self.events: list[Event] = []
        self.jerks = dict.fromkeys(WORKS, 0.0)

    def go(self) -> Track:
        time, state, finished = 0.0, self._start(), ""
        steps: list[Step] = []
        still, mode = 0, None
        mode, state = self._choose(time, state, None, {})
        leg = self._leg(mode, time)
        while True:
            stop = min(self.end, self._next_break(time))
            step, fired = self._until_event(self.stepper.step(leg, time, state, stop))
            steps.append(step)
            if len(steps) > self.most_steps:
                raise NumericsError("NUM103", f"more than {self.most_steps} steps by {time:.6g} s")
            still = still + 1 if step.end <= time * (1 + 4e-16) else 0
            if still > _MOST_AT_ONCE:
                raise NumericsError("NUM101", f"contacts change without end at {time:.6g} s")
            reached = step.used == 1.0 and step.length >= stop - time
            time = stop if reached and fired is None else step.end
            state = step.last()
            self._normalise(state)
            if fired == "solid":
                finished = fired
                self._tell(time, "buffer", "pressed", "solid")
                break
            if fired is not None:
                before = mode
                mode, state = self._react(time, state, mode, fired, leg if time >= stop else None)
                self._say(time, before, mode)
                leg = self._leg(mode, time)
            elif time >= self.end:
                break
            elif time >= stop:
                before = mode
                self._jerk(time, leg, state)
                mode, state = self._choose(time, state, mode, {})
                self._say(time, before, mode)
                leg = self._leg(mode, time)
        return Track(steps, tuple(self.events), finished, [step.start for step in steps], self.jerks)

    def _jerk(self, time: float, leg: Leg, state: FloatArray) -> None:
        """A sudden change of the rope's or the radius' speed: the impulse in the rope, what it does to an axis that is
        free to give way, and its work, mean speeds times impulse."""
        case, n, mass = self.case, state[N], self.case.load.mass
        after = self._leg(leg.mode, time)
        arm, out = 1.0, 0.0
        rope = _rate(after.length, time) - _rate(leg.length, time)
        reel = _rate(after.length, time) + _rate(leg.length, time)
        if leg.radius is not None and after.radius is not None:
            arm = float(np.ravel(leg.radius(np.array([time])))[0])
            out = _rate(after.radius, time) - _rate(leg.radius, time)
        if abs(rope) + abs(out) <= NOISE * (abs(reel) + abs(out)):
            return
        free = leg.mode.side != 0 and leg.mode.drive != KEEP
        pull = -rope - out * float(n[1])
        gear = case.axis.gear
        whole = case.axis.inertia + leg.factor * gear.rotor + mass * (arm * float(n[0])) ** 2
        change = mass * arm * float(n[0]) * pull / whole if free else 0.0
        impulse = mass * (pull - arm * float(n[0]) * change)
        pivot = np.array([arm * change, out, 0.0])
        length = float(case.load.length.at(time))
        state[W] -= (pivot - float(n @ pivot) * n) / length
        v = float(state[SPEED]) + change / 2
        state[SPEED] += change
        self.jerks["hoist"] -= impulse * reel / 2
        if leg.radius is not None and after.radius is not None:
            self.jerks["luff"] -= impulse * float(n[1]) * (_rate(after.radius, time) + _rate(leg.radius, time)) / 2
        self.jerks["gear"] -= (leg.factor - 1) * gear.rotor * change * v if free else 0.0
        self.jerks["motor"] -= 0.0 if free else impulse * float(n[0]) * arm * v

    def _until_event(self, step: Step) -> tuple[Step, str | None]:
        """A step up to the first event in it."""
        if step.length == 0:
            return step, None
        fired = self.guards.first(step)
        if fired is None:
            return step, None
        share, name = fired
        return Step(step.leg, step.start, step.length, share, step.state, step.row), name

    # --- what follows -------------------------------------------------------------------------------------------

    def _react(
        self, time: float, state: FloatArray, mode: Mode, fired: str, ending: Leg | None
    ) -> tuple[Mode, FloatArray]:
        """What follows a guard that has crossed; `ending` are the equations where an input breaks at the same time."""
        if fired == "tension":
            raise NumericsError("NUM102", f"the rope goes slack at {time:.6g} s")
        forced: dict[str, object] = {}
        state = state.copy()
        if fired == "stop":
            state[SPEED] = 0.0
        elif fired in ("ahead", "back"):
            forced["side"] = 1 if fired == "ahead" else -1
        elif fired == "gear":
            forced["forward"] = not mode.forward
            forced["side"] = mode.side
        elif fired in ("high", "low"):
            forced["drive"] = HIGH if fired == "high" else LOW
            if mode.side:
                forced["side"] = mode.side
        elif fired in ("met", "reached"):
            if abs(state[SPEED] - self._kept(time)) <= _PLACED * self.speeds:  # not where a jerk has led beyond it
                state[SPEED] = self._kept(time)
            if fired == "reached":
                self.stage = KEEP if self._limit() > 0 else OFF
                self._tell(time, "drive", LAW, "speed reached")
        elif fired.startswith("knot"):
            forced["piece"] = mode.piece + (1 if fired == "knot_up" else -1)
            if mode.side:
                forced["side"] = mode.side
        elif fired.startswith("buffer"):
            k = int(fired.split()[1])
            met = not mode.contacts[k]
            forced["contacts"] = tuple(met if i == k else one for i, one in enumerate(mode.contacts))
            if mode.side:
                forced["side"] = mode.side
        if ending is not None:
            self._jerk(time, ending, state)
            forced = {name: one for name, one in forced.items() if name in ("contacts", "drive")}
        return self._choose(time, state, mode, forced)

    def _choose(
        self, time: float, state: FloatArray, before: Mode | None, forced: dict[str, object]
    ) -> tuple[Mode, FloatArray]:
        """The mode that holds from now on."""
        axis = self.case.axis
        contacts = forced.get("contacts", before.contacts if before else self._first_contacts(state))
        assert isinstance(contacts, tuple)
        drive = forced.get("drive") or self._drive(time, state)
        assert isinstance(drive, str)
        at, z = np.array([time]), state[:, None]
        if drive == KEEP:
            state = state.copy()
            state[SPEED] = self._kept(time)
            z = state[:, None]
            mode = Mode(KEEP, 0, self._heading(time), True, contacts)
            leg = self._leg(mode, time)
            if mode.side and leg.lossy:
                pushed = float(leg.forces(at, z, leg.now(at, z))[0][0]) * mode.side >= 0
                mode = mode._replace(forward=bool(forced.get("forward", pushed)))
                leg = self._leg(mode, time)
            motor = float(leg.forces(at, z, leg.now(at, z))[1][0])
            if abs(motor) > self._limit() * (1 + NOISE):
                drive = HIGH if motor > 0 else LOW
            if drive == KEEP:
                return mode, state
        piece = -1
        if drive == LAW and isinstance(axis.drive, Push) and isinstance(axis.drive.law, Straight):
            piece = bisect_right(axis.drive.law.knots, float(state[SPEED])) - 1
            if "piece" in forced:
                assert isinstance(forced["piece"], int)
                piece = forced["piece"]
        side = forced.get("side")
        if side is None:
            side = self._side(time, state, Mode(drive, piece, 0, True, contacts))
        assert isinstance(side, int)
        contacts = self._released(state, side, contacts)
        if (
            piece >= 0
            and "piece" not in forced
            and isinstance(axis.drive, Push)
            and isinstance(axis.drive.law, Straight)
        ):
            leg = self._leg(Mode(drive, piece, side, True, contacts), time)
            slows = float(leg.now(at, z).acceleration[0]) < 0
            if state[SPEED] == axis.drive.law.knots[piece] and (slows or (side < 0 and state[SPEED] == 0)):
                piece -= 1
        mode = Mode(drive, piece, side, True, contacts)
        leg = self._leg(mode, time)
        if side and leg.lossy:
            forward = forced.get("forward")
            if forward is None:
                forward = float(leg.into_gear(at, z, leg.now(at, z))[0]) * side >= 0
            mode = mode._replace(forward=bool(forward))
        return mode, state

    def _side(self, time: float, state: FloatArray, rest: Mode) -> int:
        """Sign of the motion that goes on; at rest, where friction does not hold it, where it is pushed to."""
        leg, v = self._leg(rest, time), float(state[SPEED])
        if not leg.sided:
            return 1
        if abs(v) > 1e-14 * self.speeds:
            return 1 if v > 0 else -1
        state[SPEED] = 0.0
        ahead, back = leg.margins(np.array([time]), state[:, None])
        noise = NOISE * self.force
        if ahead[0] < -noise:
            return 1
        return -1 if back[0] < -noise else 0

    def _released(self, state: FloatArray, side: int, contacts: tuple[bool, ...]) -> tuple[bool, ...]:
        """Buffers that do not push back stay where they were pressed to."""
        kept = list(contacts)
        for k, buffer in enumerate(self.case.axis.buffers):
            if contacts[k] and buffer.law != LINEAR:
                self.places[k] = float(state[POSITION])
                kept[k] = side != -buffer.side
        return tuple(kept)

    def _first_contacts(self, state: FloatArray) -> tuple[bool, ...]:
        return tuple(buffer.side * (state[POSITION] - buffer.place) > 0 for buffer in self.case.axis.buffers)

    def _first_stage(self) -> str:
        drive = self.case.axis.drive
        if isinstance(drive, Push):
            if drive.reaches is not None:
                self.approach = 1 if self.case.axis.speed < drive.reaches else -1
                if self.case.axis.speed == drive.reaches:
                    return KEEP if drive.limit > 0 else OFF
            return LAW
        return KEEP if drive is not None else OFF

    def _drive(self, time: float, state: FloatArray) -> str:
        drive = self.case.axis.drive
        if drive is None or time >= drive.until or self.stage == OFF:
            return OFF
        if self.stage == LAW:
            return LAW
        if isinstance(drive, Push) and not any(drive.gate.coefficients[drive.gate.piece(time)]):
            return OFF
        off = float(state[SPEED]) - self._kept(time)
        if abs(off) <= NOISE * self.speeds:
            return KEEP
        if not math.isfinite(drive.limit):
            raise NumericsError("NUM102", f"a drive without a limit cannot take up a jump of its speed at {time:.6g} s")
        return HIGH if off < 0 else LOW

    def _kept(self, time: float) -> float:
        assert self.kept is not None
        return float(self.kept.at(time))

    def _heading(self, time: float) -> int:
        """Sign of the kept speed from now on, by its first derivative that is not 0."""
        assert self.kept is not None
        for k, c in enumerate(self.kept.around(time)):
            if abs(c) > NOISE * self.speeds * self.omega**k:
                return 1 if c > 0 else -1
        return 0

    def _limit(self) -> float:
        drive = self.case.axis.drive
        return drive.limit if drive is not None else 0.0

    def _leg(self, mode: Mode, time: float) -> Leg:
        return Leg(self.case, mode, time, tuple(self.places), self.kept)

    def _next_break(self, time: float) -> float:
        case, axis = self.case, self.case.axis
        pieces = [
            case.load.length,
            case.load.wind_along,
            case.load.wind_across,
            axis.outer,
            axis.brake,
            axis.gear.brake,
        ]
        if isinstance(case.pivot, Jib):
            pieces.append(case.pivot.radius)
        if isinstance(axis.drive, Push):
            pieces.append(axis.drive.gate)
        if self.kept is not None:
            pieces.append(self.kept)
        breaks = [one.next_break(time) for one in pieces]
        if axis.drive is not None and axis.drive.until > time:
            breaks.append(axis.drive.until)
        return min(breaks)

    def _tell(self, time: float, element: str, before: str, after: str) -> None:
        self.events.append(Event(float(time), element, before, after))

    def _say(self, time: float, before: Mode, after: Mode) -> None:
        """What has changed."""
        if before.drive != after.drive:
            self._tell(time, "drive", before.drive, after.drive)
        if before.side != after.side:
            words = {0: "rest", 1: "forward", -1: "backward"}
            self._tell(time, "axis", words[before.side], words[after.side])
        for k, (one, two) in enumerate(zip(before.contacts, after.contacts, strict=True)):
            if one != two:
                self._tell(time, f"buffer {k}", "met" if one else "free", "met" if two else "free")

    # --- the start ----------------------------------------------------------------------------------------------

    def _scales(self) -> FloatArray:
        """Sizes of the states, of forces on the axis and of the rope's pull."""
        axis, load = self.case.axis, self.case.load
        pivot = self.case.pivot
        arm = max(abs(c[0]) for c in pivot.radius.coefficients) if isinstance(pivot, Jib) else 1.0
        weight = load.mass * self.case.gravity
        drive, speeds, forces = axis.drive, [abs(axis.speed)], [axis.friction]
        for pieces in (axis.outer, axis.brake, axis.gear.brake):
            forces += [abs(c[0]) for c in pieces.coefficients]
        if isinstance(drive, Follow):
            speeds += [abs(c[0]) for c in drive.speed.coefficients]
        elif isinstance(drive, Push):
            if drive.reaches is not None:
                speeds.append(abs(drive.reaches))
            if isinstance(drive.law, Straight):
                forces += [abs(value) for value in drive.law.values]
            else:
                forces.append(abs(drive.law) if isinstance(drive.law, int | float) else drive.law.size)
        self.force = max([*forces, 1e-3 * weight * arm])
        if max(speeds) == 0:
            whole = axis.inertia + axis.gear.rotor
            speeds.append(max(forces) / (whole * self.omega) if whole > 0 else 0.0)
        speed = max([*speeds, _SWINGS * self.case.gravity / self.omega / arm])
        w = self.omega
        return np.array([speed / w, speed, 1.0, 1.0, 1.0, w, w, w])

    def _start(self) -> FloatArray:
        load, axis = self.case.load, self.case.axis
        g = Leg(self.case, Mode(OFF, 0, 0, True, (False,) * len(self.places)), 0.0, (), None).gravity(
            np.array([axis.position])
        )
        down = np.array([float(np.ravel(one)[0]) for one in g])
        along = load.along + math.atan2(down[0], -down[2])
        across = load.across + math.atan2(down[1], -down[2])
        if across == 0 == load.across_rate:
            n = np.array([math.sin(along), 0.0, -math.cos(along)])
            rate = load.along_rate * np.array([math.cos(along), 0.0, math.sin(along)])
        else:
            straight = np.array([math.tan(along), math.tan(across), -1.0])
            turned = np.array([load.along_rate / math.cos(along) ** 2, load.across_rate / math.cos(across) ** 2, 0.0])
            size = float(np.linalg.norm(straight))
            n = straight / size
            rate = (turned - n * float(n @ turned)) / size
        z = np.concatenate([[axis.position, axis.speed], n, rate])
        if isinstance(self.case.pivot, Jib):
            z[5] += axis.speed * n[1]
            z[6] -= axis.speed * n[0]
        return z

    @staticmethod
    def _normalise(state: FloatArray) -> None:
        """Back onto the sphere, from which rounding and the step have led a little."""
        n = state[N] / np.linalg.norm(state[N])
        state[N] = n
        state[W] -= float(n @ state[W]) * n


def _rate(held: Held, time: float) -> float:
    return float(np.ravel(held(np.array([time]), 1))[0])
