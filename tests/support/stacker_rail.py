"""Rack stackers on uneven rails, drawn by a number, and their motion integrated by DOP853: nothing of ptmcalc is used.

The machine is one mass on the spring and damper of its wheels, which follow a cosine of the path or leave it. The
column swings in the shape that a force at its carriage bends a beam of finite elements to; its base tilts as one wheel
after the other runs over step or gap. Steady swings on waves are found by shooting: the one start that comes back to
itself.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

from support.beams import beam
from support.stacker_statics import STEEL, Statics, random_stacker
from support.travelling_statics import G, number, text

State = np.ndarray
_TIGHT = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-14, "dense_output": True}
_PERIODS, _ELEMENTS, _SEEN, _NEAR = 3, 4, 401, 0.01


def random_rail(rng: np.random.Generator) -> dict[str, Any]:
    """A stacker in an aisle on a rail with a step, a gap or waves, or with some of them."""

    def even(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    data, rail = random_stacker(rng, "rack_stacker"), {}
    has = rng.random(3) < (0.6, 0.4, 0.6)
    if has[0] or not has.any():
        rail["step"] = text(10 ** even(-3.2, -2.1), "m")
    if has[1]:
        rail["gap"] = text(10 ** even(-2.3, -1.3), "m")
    if has[2]:
        rail["waviness"] = {"height": text(10 ** even(-3.7, -2.5), "m"), "length": text(even(1, 6), "m")}
    rail["frequency"] = text(even(5, 20), "Hz")
    if rng.random() < 0.4:
        rail["damping"] = even(0.01, 0.2)
    if rng.random() < 0.5:
        del data["base"]["gauge"]
    if rng.random() < 0.1:
        data["column"]["top_guide"] = {"stiffness": "1e6 N/m"}
    data["base"]["wheel_diameter"] = text(even(0.2, 0.6), "m")
    data["travel"]["speed"] = text(even(1, 5), "m/s")
    place = number(data["column"]["foot"]) + even(0.1, 1) * number(data["column"]["length"])
    scene = {"type": "rail", "speed_share": even(0.3, 1), "height": text(place, "m")}
    return data | {"rail": rail, "scenes": [scene | {"load": str(rng.choice(["full", "empty"]))}]}


def _most(of: Callable[[State], Any], run: Any) -> float:
    """Largest value of a signal of a run: every turn that comes near the largest value seen is looked at closely."""
    times = np.linspace(run.t[0], run.t[-1], _SEEN)
    seen = of(run.sol(times))
    best = float(seen.max())
    turns = np.flatnonzero((seen[1:-1] >= seen[:-2]) & (seen[1:-1] >= seen[2:])) + 1
    for k in turns[seen[turns] > best - _NEAR * abs(best)]:
        found = minimize_scalar(
            lambda t: -float(of(run.sol(t))), bounds=times[[k - 1, k + 1]], method="bounded", options={"xatol": 1e-9}
        )
        best = max(best, -float(found.fun))
    return best


def _steady(frequency: float, ratio: float, rate: float, push: Callable[[float], float]) -> Any:
    """The swing of period 2 pi/rate of x'' + 2 z w x' + w^2 x = push(t), as a run over one period."""

    def moves(forced: float) -> Callable[[float, State], list[float]]:
        return lambda t, y: [y[1], forced * push(t) - 2 * ratio * frequency * y[1] - frequency**2 * y[0]]

    period = 2 * math.pi / rate
    ends = [
        solve_ivp(moves(forced), (0, period), start, **_TIGHT).y[:, -1]
        for forced, start in ((1.0, [0.0, 0.0]), (0.0, [1.0, 0.0]), (0.0, [0.0, 1.0]))
    ]
    start = np.linalg.solve(np.eye(2) - np.column_stack(ends[1:]), ends[0])
    return solve_ivp(moves(1.0), (0, period), start, **_TIGHT)


@dataclass(frozen=True)
class Pulse:
    """An acceleration of a wheel that is a half turn of a cosine or a whole one [s, 1, m/s^2]."""

    lasts: float
    half_turns: int
    size: float

    def at(self, time: float) -> float:
        return self.size * math.cos(self.half_turns * math.pi * time / self.lasts)


class OnRail:
    """A stacker of such a file."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.data, (self.scene,), self.rail = data, data["scenes"], data["rail"]
        self.statics = Statics(data, joint=True)
        self.speed = self.scene["speed_share"] * number(data["travel"]["speed"])
        self.radius, self.base = number(data["base"]["wheel_diameter"]) / 2, number(data["base"]["wheel_base"])
        self.frequency = 2 * math.pi * number(self.rail["frequency"])
        self.damping = float(self.rail.get("damping", 0.0))
        waves = self.rail.get("waviness")
        self.wave = (number(waves["height"]), number(waves["length"])) if waves else None

    def pulses(self) -> Iterator[Pulse]:
        """Up a step, down it, over a gap: the path is h (1 - cos)/2, or what falls into the gap and comes out."""
        size = (math.pi / 2 * self.speed) ** 2 / self.radius
        if "step" in self.rail:
            lasts = math.sqrt(2 * number(self.rail["step"]) * self.radius) / self.speed
            yield Pulse(lasts, 1, size)
            yield Pulse(lasts, 1, -size)
        if "gap" in self.rail:
            yield Pulse(number(self.rail["gap"]) / self.speed, 2, -size)

    # -- wheels --------------------------------------------------------------------------------------------------

    def wheel(self, pulse: Pulse, *, leaves: bool) -> tuple[float, float]:
        """Largest and least load of a wheel over the static one; one that leaves the rail lands when spring and rail
        meet again, one that does not is held to it."""
        w, c = self.frequency, 2 * self.damping * self.frequency
        w2 = w * w

        def load(y: State) -> Any:
            return 1 - (w2 * y[0] + c * y[1]) / G

        def lifted(t: float, y: State) -> float:
            return float(load(y))

        def lands(t: float, y: State) -> float:
            return float(y[0] - G / w2)

        lifted.terminal, lifted.direction = lands.terminal, lands.direction = True, -1  # type: ignore[attr-defined]
        size = abs(pulse.size)
        end = pulse.lasts + _PERIODS * 2 * math.pi / w + 4 * size / G * min(pulse.lasts, 1 / w)
        time, y, on, high, low = 0.0, np.zeros(2), True, 1.0, 1.0
        while time < end:
            stop = pulse.lasts if time < pulse.lasts else end

            def moves(t: float, y: State, on: bool = on, stop: float = stop) -> list[float]:
                path = pulse.at(t) if stop == pulse.lasts else 0.0
                return [y[1], (-w2 * y[0] - c * y[1] if on else -G) - path]

            event = (lifted if on else lands) if leaves else None
            run = solve_ivp(moves, (time, stop), y, events=event, **_TIGHT)
            if on:
                high, low = max(high, _most(load, run)), min(low, -_most(lambda y: -load(y), run))
            time, y = float(run.t[-1]), run.y[:, -1]
            if run.status == 1:
                on = not on
        return high, low

    def wheel_on_waves(self) -> float:
        """What even waves add to the load of a wheel, over the static one."""
        if self.wave is None:
            return 0.0
        rate, half = 2 * math.pi * self.speed / self.wave[1], self.wave[0] / 2
        run = _steady(self.frequency, self.damping, rate, lambda t: half * rate**2 * math.sin(rate * t))
        w2, c = self.frequency**2, 2 * self.damping * self.frequency
        return _most(lambda y: np.abs(w2 * y[0] + c * y[1]) / G, run)

    # -- column --------------------------------------------------------------------------------------------------

    def column(self) -> tuple[float, float, float, float]:
        """Frequency [rad/s], lever of the tilt [m], swing of the head per swing of the carriage, stiffness [N/m]."""
        given = self.data["column"]
        length, mass = number(given["length"]), number(given["mass"])
        place = min(number(self.scene["height"]) - number(given["foot"]), length)
        bending, joint = STEEL * number(given["second_moment"]), 1 / number(given["root_stiffness"])
        k, m = beam(place, bending, mass * place / length, _ELEMENTS, root_rotation=joint)
        force = np.zeros(len(k))
        force[-2] = 1.0
        bent = np.linalg.solve(k, force)
        shape, gives = bent / bent[-2], float(bent[-2])
        turns = np.zeros(len(k))  # of a base that tilts by 1 nodes shift by their height and turn by 1, the root first
        turns[0::2], turns[1::2] = 1.0, np.arange(1, _ELEMENTS + 1) * place / _ELEMENTS
        above, carried = length - place, self.statics.climbing(self.scene)
        line, slope = mass / length, float(shape[-1])
        swings = float(shape @ m @ shape) + carried + line * above * (1 + slope * above + (slope * above) ** 2 / 3)
        driven = float(shape @ m @ turns) + carried * place
        driven += line * above * (place + (1 + slope * place) * above / 2 + slope * above**2 / 3)
        return 1 / math.sqrt(gives * swings), driven / swings, 1 + slope * above, 1 / gives

    def swing(self, frequency: float, lever: float) -> float:
        """Largest swing at the carriage over step and gap, both wheels one after the other, and steady on waves [m]."""
        best = [0.0]
        for pulse in self.pulses():
            y, begin = np.zeros(2), 0.0
            after = self.base / self.speed
            for stop, sign, start in (
                (pulse.lasts, -1.0, 0.0),
                (after, 0.0, 0.0),
                (after + pulse.lasts, 1.0, after),
                (after + pulse.lasts + 2 * math.pi / frequency, 0.0, 0.0),
            ):

                def moves(
                    t: float, y: State, of: Pulse = pulse, sign: float = sign, start: float = start
                ) -> list[float]:
                    push = sign * lever / self.base * of.at(t - start) if sign else 0.0
                    return [y[1], push - frequency**2 * y[0]]

                run = solve_ivp(moves, (begin, stop), y, **_TIGHT)
                best.append(_most(lambda y: np.abs(y[0]), run))
                begin, y = stop, run.y[:, -1]
        if self.wave is not None:
            rate, half, behind = 2 * math.pi * self.speed / self.wave[1], self.wave[0] / 2, self.base / self.speed

            def push(t: float) -> float:
                apart = math.sin(rate * t) - math.sin(rate * (t - behind))
                return lever * half * rate**2 * apart / self.base

            best.append(_most(lambda y: np.abs(y[0]), _steady(frequency, 0.0, rate, push)))
        return max(best)

    # -- loads ---------------------------------------------------------------------------------------------------

    def static_wheel(self) -> float:
        """Of the axle that bears more [N]."""
        given, on = self.data["base"], self.data["carriage"]
        foot = number(given["column"])
        load = self.statics.climbing(self.scene) - self.statics.carriage - self.statics.cab
        bears = [
            (number(given["mass"]), number(given["centre"])),
            (self.statics.column, foot),
            (load, foot + number(on["load_arm"])),
            (self.statics.carriage, foot + number(on["own_arm"])),
            (self.statics.cab, foot + number(self.data["cab"]["arm"])),
        ]
        front = G * sum(mass * place for mass, place in bears) / self.base
        rear = G * sum(mass * (self.base - place) for mass, place in bears) / self.base
        return max(front, rear) / (2 if "gauge" in given else 1)

    def loads(self) -> dict[str, float]:
        """All that a rail does to it; what a wheel that jumps on waves does is not known."""
        waves, pulses = self.wheel_on_waves(), list(self.pulses())
        held = [self.wheel(pulse, leaves=False) for pulse in pulses]
        least = min([low for _, low in held] + [1 - waves])
        found = {"rail_contact": least}
        if waves <= 1:
            free = [self.wheel(pulse, leaves=True) for pulse in pulses] if least < 0 else held
            found["phi4"] = max([high for high, _ in free] + [1 + waves])
            found["wheel_force"] = found["combination_force[11.2,5]"] = found["phi4"] * self.static_wheel()
        modes, given = [self.frequency], self.data["column"]
        if "top_guide" not in given:
            frequency, lever, outreach, stiffness = self.column()
            modes.append(frequency)
            swing = self.swing(frequency, lever)
            found |= {
                "mast_deflection_max": outreach * swing,
                "mast_force_max": stiffness * swing,
                "mast_moment_max": stiffness * swing * lever,
            }
            along, aside = (abs(self.statics.moment(self.scene, across)) for across in (False, True))
            stress = (along + found["mast_moment_max"]) / number(given["section_modulus"])
            stress += aside / number(given["section_modulus_across"])
            climbs = self.statics.climbing(self.scene) * G * (1 + self.statics.ropes / self.statics.falls)
            found["column_stress"] = stress + (self.statics.column * G + climbs) / number(given["area"])
        if self.wave is not None:
            passes = self.speed / self.wave[1]
            found["rail_detuning"] = min(abs(2 * math.pi * passes / mode - 1) for mode in modes)
        return found
