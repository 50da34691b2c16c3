"""Equations of a load under a pivot with one way to go, in the frame of the pivot, without a singular position.

The rope has the direction n (unit vector from the pivot to the load), w is its rate against space; both are told along
the axis, across it and up. With the pivot's acceleration c + b s'' (b the arm along the axis: 1 on a rail, R on a jib),
gravity g, wind f and the tension T

    L w' = A - (A n) n - 2 L' w - L w^2 n,      A = g + f/M - c - b s''
    T/M = A n + L w^2 - L''
    (I + e I_r + M b^2 n_1^2) s'' = X + e F + M b n_1 h,      h = (g + f/M - c) n + L w^2 - L''

X is what acts on the axis behind the gear, F in front of it, e its factor, I_r the rotor. In the frame that turns with
a jib each vector changes by its own rate less omega x vector.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics.pendulum.parts import CONSTANT, LINEAR, Case, Follow, Jib, Push, Rail, Smooth, Straight
from ptmcalc.numerics.pendulum.pieces import Pieces

FloatArray = NDArray[np.float64]

OFF, LAW, KEEP, HIGH, LOW = "off", "law", "keep", "high", "low"
"""A drive without force, with its own law, that keeps a speed, and at either limit on its way back to that speed."""

POSITION, SPEED = 0, 1
N, W = slice(2, 5), slice(5, 8)
STATES = 8
SIGNALS = (
    "position", "speed", "acceleration", "along", "across", "sway", "along_rate", "across_rate", "tension",
    "pull_along", "pull_across", "drive", "motor", "grip", "buffer", "amplitude",
)  # fmt: skip
WORKS = ("motor", "inner_brake", "gear", "grip", "buffer", "outer", "wind", "hoist", "luff")
_NEWTON = 80


class Mode(NamedTuple):
    """What holds between two events: state of the drive, piece of its law, sign of the motion (0 at rest), whether
    power flows forward through the gear, and the buffers that are met."""

    drive: str
    piece: int
    side: int
    forward: bool
    contacts: tuple[bool, ...]


class Held:
    """One piece of a quantity over time, with two derivatives."""

    def __init__(self, pieces: Pieces, time: float) -> None:
        self.start = pieces.starts[pieces.piece(time)]
        row = pieces.coefficients[pieces.piece(time)]
        self.rows = [row]
        for _ in range(2):
            row = tuple(k * c for k, c in enumerate(row) if k) or (0.0,)
            self.rows.append(row)
        self.zero = not any(self.rows[0])

    def __call__(self, time: FloatArray, derivative: int = 0) -> FloatArray | float:
        row = self.rows[derivative]
        if len(row) == 1:
            return row[0]
        since = time - self.start
        total: FloatArray | float = row[-1]
        for c in row[-2::-1]:
            total = total * since + c
        return total


class Now(NamedTuple):
    """What the equations are made of at some times and states."""

    length: FloatArray | float
    length_rate: FloatArray | float
    radius_rate: FloatArray | float
    turn: FloatArray | float
    arm: FloatArray | float
    gravity: tuple[FloatArray | float, ...]
    wind: tuple[FloatArray | float, ...]
    spin: FloatArray
    """w^2"""
    pulled: FloatArray
    """h, and the mass that is felt at the axis"""
    felt: FloatArray
    other: FloatArray
    """what acts behind the gear but the grip"""
    acceleration: FloatArray
    field: tuple[FloatArray | float, ...]
    """A"""


class Leg:
    """The equations of one mode in one piece of every input."""

    def __init__(self, case: Case, mode: Mode, time: float, places: tuple[float, ...], kept: Pieces | None) -> None:
        axis, load = case.axis, case.load
        self.case, self.mode, self.places = case, mode, places
        self.length = Held(load.length, time)
        self.winds = Held(load.wind_along, time), Held(load.wind_across, time)
        self.outer, self.brake = Held(axis.outer, time), Held(axis.brake, time)
        self.inner = Held(axis.gear.brake, time)
        self.gate = Held(axis.drive.gate, time) if isinstance(axis.drive, Push) else None
        self.kept = Held(kept, time) if kept is not None else None
        self.radius = Held(case.pivot.radius, time) if isinstance(case.pivot, Jib) else None
        gear = axis.gear
        self.factor = gear.forward if mode.forward else 1 / gear.reverse
        self.lossy = gear.forward != 1 or gear.reverse != 1
        held = axis.friction == 0 and self.brake.zero and self.inner.zero
        self.sided = self.lossy or not held or any(buffer.law != LINEAR for buffer in axis.buffers)
        """whether anything depends on the sign of the motion"""
        self.drive = axis.drive
        self.limit = axis.drive.limit if axis.drive is not None else math.inf

    # --- what acts ----------------------------------------------------------------------------------------------

    def driven(self, time: FloatArray, speed: FloatArray) -> FloatArray | float:
        """Force of the drive in front of the gear, unless it keeps a speed."""
        mode = self.mode.drive
        if mode == OFF or self.drive is None:
            return 0.0
        if mode in (HIGH, LOW):
            return self.limit if mode == HIGH else -self.limit
        assert isinstance(self.drive, Push) and self.gate is not None  # noqa: PT018 - LAW is a push
        law, gate = self.drive.law, self.gate(time)
        if isinstance(law, Smooth):
            return np.asarray(gate * law.value(speed))
        if isinstance(law, Straight):
            first, last = self.mode.piece, self.mode.piece + 1
            if first < 0 or last >= len(law.knots):
                return gate * law.values[max(first, 0)]
            slope = (law.values[last] - law.values[first]) / (law.knots[last] - law.knots[first])
            return gate * (law.values[first] + slope * (speed - law.knots[first]))
        return gate * law

    def holds(self, time: FloatArray, side: int) -> FloatArray | float:
        """What friction, the outer brake and pressed buffers of constant force can hold against a motion."""
        total = self.case.axis.friction + self.brake(time)
        for buffer, met in zip(self.case.axis.buffers, self.mode.contacts, strict=True):
            if met and buffer.law == CONSTANT and buffer.side == side:
                total = total + buffer.size
        return total

    def gripped(self, time: FloatArray) -> FloatArray | float:
        """Friction and outer brake as they act on what moves."""
        return -self.mode.side * (self.case.axis.friction + self.brake(time))

    def pressed(self, z: FloatArray) -> FloatArray | float:
        """Force of the buffers on what moves; a constant one counts only while it is pressed on."""
        total: FloatArray | float = 0.0
        for buffer, met, place in zip(self.case.axis.buffers, self.mode.contacts, self.places, strict=True):
            if not met:
                continue
            if buffer.law == LINEAR:
                total = total - buffer.size * (z[POSITION] - place)
            elif self.mode.side == buffer.side:
                total = total - buffer.side * (buffer.size if buffer.law == CONSTANT else buffer.size * z[SPEED] ** 2)
        return total

    def behind(self, gear_input: FloatArray | float, side: int) -> FloatArray:
        """What comes out of the gear for a force into it, moving to a side."""
        given = np.asarray(gear_input, float)
        gear = self.case.axis.gear
        return np.where(given * side >= 0, given * gear.forward, given / gear.reverse)

    def gravity(self, position: FloatArray) -> tuple[FloatArray | float, ...]:
        """Along, across and up."""
        g, pivot = self.case.gravity, self.case.pivot
        if isinstance(pivot, Rail):
            return -g * math.sin(pivot.slope), 0.0, -g * math.cos(pivot.slope)
        if pivot.tilt == 0:
            return 0.0, 0.0, -g
        angle, pull = position - pivot.downhill, g * math.sin(pivot.tilt)
        return -pull * np.sin(angle), pull * np.cos(angle), -g * math.cos(pivot.tilt)

    # --- motion -------------------------------------------------------------------------------------------------

    def now(self, time: FloatArray, z: FloatArray) -> Now:
        """Everything at some times, states of shape (states, times)."""
        case, axis = self.case, self.case.axis
        mass, v = case.load.mass, z[SPEED]
        nt, nr, nz, wt, wr, wz = z[2], z[3], z[4], z[5], z[6], z[7]
        length = self.length(time)
        gravity = self.gravity(z[POSITION])
        wind = self.winds[0](time), self.winds[1](time)
        along, across = gravity[0] + wind[0] / mass, gravity[1] + wind[1] / mass
        arm: FloatArray | float = 1.0
        turn: FloatArray | float = 0.0
        out: FloatArray | float = 0.0
        weight = axis.inertia
        if self.radius is not None:
            assert isinstance(case.pivot, Jib)
            arm, turn, out, weight = self.radius(time), v, self.radius(time, 1), case.pivot.unbalance
            along = along - 2 * out * v
            across = across - self.radius(time, 2) + arm * v * v
        spin = wt * wt + wr * wr + wz * wz
        pulled = along * nt + across * nr + gravity[2] * nz + length * spin - self.length(time, 2)
        reach = arm * nt
        felt = mass * reach * reach
        other = mass * reach * pulled + (weight * gravity[0] + self.outer(time))
        if axis.buffers:
            other = other + self.pressed(z)
        if axis.field is not None:
            other = other + axis.field(time, z[POSITION], v)
        acceleration = self._acceleration(time, v, felt, other)
        return Now(
            length, self.length(time, 1), out, turn, arm, gravity, wind, spin, pulled, felt, other, acceleration,
            (along - arm * acceleration, across, gravity[2]),
        )  # fmt: skip

    def _acceleration(self, time: FloatArray, v: FloatArray, felt: FloatArray, other: FloatArray) -> FloatArray:
        mode, axis = self.mode, self.case.axis
        if mode.drive == KEEP:
            assert self.kept is not None
            return np.zeros_like(v) + self.kept(time, 1)
        if mode.side == 0:
            return np.zeros_like(v)
        into = self.driven(time, v) - mode.side * self.inner(time)
        whole = axis.inertia + self.factor * axis.gear.rotor + felt
        return np.asarray((other + self.gripped(time) + self.factor * into) / whole)

    def rate(self, time: FloatArray, z: FloatArray) -> FloatArray:
        """z' at some times, shape (states, times)."""
        now = self.now(time, z)
        n, w, field = z[N], z[W], now.field
        straight = field[0] * n[0] + field[1] * n[1] + field[2] * n[2]
        out = np.empty_like(z)
        out[POSITION], out[SPEED] = z[SPEED], now.acceleration
        out[N] = w
        out[W] = (straight / now.length + now.spin) * -n
        if not (isinstance(now.length_rate, float) and now.length_rate == 0):
            out[W] -= 2 * now.length_rate / now.length * w
        for k, one in enumerate(field):
            out[W.start + k] += one / now.length
        if self.radius is not None:
            out[2] -= now.turn * n[1]
            out[3] += now.turn * n[0]
            out[5] -= now.turn * w[1]
            out[6] += now.turn * w[0]
        return out

    # --- what is asked ------------------------------------------------------------------------------------------

    def forces(self, time: FloatArray, z: FloatArray, now: Now) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Drive behind the gear, motor in front of it, grip; at rest the grip holds what it can."""
        mode, axis, v = self.mode, self.case.axis, z[SPEED]
        if mode.drive == KEEP:
            asked = (axis.inertia + now.felt) * now.acceleration - now.other
            if mode.side == 0:
                most = axis.friction + self.brake(time)
                grip = np.clip(asked, -most, most)
                return asked - grip, asked - grip, grip
            grip = np.zeros_like(v) + self.gripped(time)
            drive = asked - grip
            into = drive / self.factor + axis.gear.rotor * now.acceleration
            return drive, into + mode.side * self.inner(time), grip
        motor = np.zeros_like(v) + self.driven(time, v)
        if mode.side == 0:
            return motor, motor, -now.other - motor
        into = motor - mode.side * self.inner(time) - axis.gear.rotor * now.acceleration
        return self.factor * into, motor, np.zeros_like(v) + self.gripped(time)

    def into_gear(self, time: FloatArray, z: FloatArray, now: Now) -> FloatArray:
        """Force into the gear, of what moves freely."""
        into = self.driven(time, z[SPEED]) - self.mode.side * self.inner(time)
        return np.asarray(into - self.case.axis.gear.rotor * now.acceleration)

    def margins(self, time: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """What is missing at rest to move forward and to move backward."""
        now = self.now(time, z)
        motor, inner = self.driven(time, z[SPEED]), self.inner(time)
        ahead = self.holds(time, 1) - now.other - self.behind(motor - inner, 1)
        back = self.holds(time, -1) + now.other + self.behind(motor + inner, -1)
        return np.asarray(ahead), np.asarray(back)

    def tension(self, now: Now, z: FloatArray) -> FloatArray:
        """Of the rope."""
        return np.asarray(self.case.load.mass * (now.pulled - now.arm * z[2] * now.acceleration))

    def signals(self, names: tuple[str, ...], time: FloatArray, z: FloatArray) -> FloatArray:
        """Signals at some times, shape (names, times)."""
        now = self.now(time, z)
        found = [np.zeros_like(time) + self._signal(name, time, z, now) for name in names]
        return np.stack(found)

    def _signal(self, name: str, time: FloatArray, z: FloatArray, now: Now) -> FloatArray | float:
        n = z[N]
        g = now.gravity
        match name:
            case "position" | "speed":
                return np.asarray(z[POSITION if name == "position" else SPEED])
            case "acceleration":
                return now.acceleration
            case "along" | "across":
                k = int(name == "across")
                return np.asarray(np.arctan2(n[k], -n[2]) - np.arctan2(g[k], -g[2]))
            case "sway":
                return _between(n, g)
            case "along_rate" | "across_rate":
                return self._angle_rate(int(name == "across_rate"), z, now)
            case "tension":
                return self.tension(now, z)
            case "pull_along" | "pull_across":
                return np.asarray(self.tension(now, z) * n[int(name == "pull_across")])
            case "drive" | "motor" | "grip":
                return self.forces(time, z, now)[("drive", "motor", "grip").index(name)]
            case "buffer":
                return self.pressed(z)
            case "amplitude":
                return _amplitude(n, z[W], g, now.length)
        raise ValueError(f"a pendulum has no {name}")

    def _angle_rate(self, k: int, z: FloatArray, now: Now) -> FloatArray:
        n, w = z[N], z[W]
        sides = (w[0] - now.turn * n[1], w[1] + now.turn * n[0])
        rate = (n[k] * w[2] - n[2] * sides[k]) / (n[k] ** 2 + n[2] ** 2)
        if isinstance(self.case.pivot, Jib) and self.case.pivot.tilt:
            g = now.gravity
            turned = (-g[1], g[0])[k] * now.turn  # gravity in a frame that turns
            rate = rate - (-g[2] * turned) / (g[k] ** 2 + g[2] ** 2)
        return np.asarray(rate)

    def powers(self, time: FloatArray, z: FloatArray) -> FloatArray:
        """Power of everything that does work, shape (works, times)."""
        now = self.now(time, z)
        drive, motor, grip = self.forces(time, z, now)
        v, axis = z[SPEED], self.case.axis
        inner = -self.mode.side * self.inner(time) * v
        moved = v if self.mode.side or self.mode.drive == KEEP else np.zeros_like(v)
        rotor = axis.gear.rotor * now.acceleration
        outer = self.outer(time) + (axis.field(time, z[POSITION], v) if axis.field is not None else 0.0)
        pull = self.tension(now, z)
        speed = self.load_speed(z, now)
        return np.stack(
            [
                motor * moved,
                inner + 0 * v,
                drive * moved - (motor * moved + inner - rotor * moved),
                grip * moved,
                self.pressed(z) * v + 0 * v,
                outer * v + 0 * v,
                now.wind[0] * speed[0] + now.wind[1] * speed[1],
                -pull * now.length_rate,
                -pull * z[3] * now.radius_rate,
            ]
        )

    def load_speed(self, z: FloatArray, now: Now) -> FloatArray:
        """Velocity of the load against space, shape (3, times)."""
        speed = now.length_rate * z[N] + now.length * z[W]
        speed[0] += now.arm * z[SPEED]
        speed[1] += now.radius_rate
        return np.asarray(speed)

    def stored(self, time: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Kinetic energy, and energy of the heights."""
        now = self.now(time, z)
        axis, mass = self.case.axis, self.case.load.mass
        speed = self.load_speed(z, now)
        moving = (axis.inertia + axis.gear.rotor) * z[SPEED] ** 2 / 2 + mass * (speed**2).sum(axis=0) / 2
        g = now.gravity
        down = now.length * (g[0] * z[2] + g[1] * z[3] + g[2] * z[4])
        if isinstance(self.case.pivot, Jib):
            height = -mass * (down + g[1] * now.arm) - self.case.pivot.unbalance * g[1]
        else:
            height = -mass * (down + g[0] * z[POSITION]) - axis.inertia * g[0] * z[POSITION]
        return np.asarray(moving), np.asarray(height)


def _between(n: FloatArray, g: tuple[FloatArray | float, ...]) -> FloatArray:
    """Angle between two directions, also a small one."""
    across = np.sqrt(
        (n[1] * g[2] - n[2] * g[1]) ** 2 + (n[2] * g[0] - n[0] * g[2]) ** 2 + (n[0] * g[1] - n[1] * g[0]) ** 2
    )
    return np.asarray(np.arctan2(across, n[0] * g[0] + n[1] * g[1] + n[2] * g[2]))


def _amplitude(
    n: FloatArray, w: FloatArray, g: tuple[FloatArray | float, ...], length: FloatArray | float
) -> FloatArray:
    """Largest angle from the plumb line of a free spherical pendulum, x = 1 - cos:

    (e - k x) x (2 - x) = h^2/2,  k = g/L, e = w^2/2 + k x_now, h the turn about the plumb line; the larger root below 2
    """
    size = math.sqrt(float(np.max(np.square(g[0]) + np.square(g[1]) + np.square(g[2]))))
    k = size / length
    down = np.stack([np.zeros_like(n[0]) + one / size for one in g])
    x = 2 * np.sin(_between(n, g) / 2) ** 2
    energy = (w * w).sum(axis=0) / 2 + k * x
    spin = (np.cross(n.T, w.T).T * down).sum(axis=0) ** 2 / 2
    high = np.minimum(energy / k, 2.0)
    for _ in range(_NEWTON):
        value = (energy - k * high) * high * (2 - high) - spin
        slope = (2 * energy - 2 * high * (energy + 2 * k)) + 3 * k * high**2
        step = np.divide(value, slope, out=np.zeros_like(slope), where=slope < 0)
        following = np.clip(high - step, x, high)
        if np.all(high - following <= 1e-15 * high):
            break
        high = following
    return np.asarray(2 * np.arcsin(np.sqrt(np.clip(high / 2, 0.0, 1.0))))


def kept_speed(case: Case) -> Pieces | None:
    """The speed over time that a drive keeps."""
    drive = case.axis.drive
    if isinstance(drive, Follow):
        return drive.speed
    if isinstance(drive, Push) and drive.reaches is not None:
        return Pieces.constant(drive.reaches)
    return None
