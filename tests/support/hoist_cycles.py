"""Cycles of given motor torques: drawn by a number, and by quadrature and integration in time.

Nothing of `ptmcalc` is used.
"""

import math
from typing import Any

import numpy as np
from scipy.integrate import quad, solve_ivp

from support.travelling_statics import COOLING, number


def random_cycle(rng: np.random.Generator) -> dict[str, Any]:
    """A motor with its losses, and a cycle of three to nine parts."""
    parts: list[dict[str, Any]] = []
    for _ in range(int(rng.integers(3, 10))):
        phase = str(rng.choice(["running", "running", "starting", "rest"]))
        part: dict[str, Any] = {"torque": "0 N*m", "time": f"{rng.uniform(0.3, 300)!r} s", "phase": phase}
        if phase != "rest":
            part["torque"] = f"{rng.uniform(-200, 250)!r} N*m"
            if rng.random() < 0.5:
                part["to"] = f"{rng.uniform(-200, 250)!r} N*m"
        parts.append(part)
    parts[0] |= {"torque": "120 N*m", "phase": "running"}
    return {
        "motor__rated_torque": f"{rng.uniform(60, 200)!r} N*m",
        "motor__rated_duty": float(rng.choice([1.0, rng.uniform(0.25, 0.9)])),
        "motor__cooling": str(rng.choice(list(COOLING))),
        "duty__cycle": parts,
        "duty__losses": {
            "constant": f"{rng.uniform(50, 900)!r} W",
            "copper": f"{rng.uniform(200, 2000)!r} W",
            "temperature_rise": f"{rng.uniform(60, 120)!r} K",
            "time_constant": f"{rng.uniform(300, 4000)!r} s",
        },
    }


def reference(data: dict[str, Any]) -> dict[str, float]:
    """The same by quadrature of each part, and the temperature by integration in time until it repeats."""
    motor, cycle, losses = data["motor"], data["duty"]["cycle"], data["duty"]["losses"]
    at_rest, share = COOLING[motor["cooling"]], motor["rated_duty"]
    torque = number(motor["rated_torque"]) * math.sqrt(share / (share + at_rest * (1 - share)))
    # heat of the rated torque in its own cycle, that of a motor that always runs: M^2 ED = M_1^2 (ED + k (1 - ED))
    constant, copper = number(losses["constant"]), number(losses["copper"])
    rise, tau = number(losses["temperature_rise"]), number(losses["time_constant"])
    squares = heat = cooled = whole = on = 0.0
    pieces = []
    for part in cycle:
        time, begin = number(part["time"]), number(part["torque"])
        end = number(part["to"]) if "to" in part else begin
        k = {"running": 1.0, "starting": (1 + at_rest) / 2, "rest": at_rest}[part["phase"]]
        runs = part["phase"] != "rest"

        def at(t: float, a: float = begin, b: float = end, length: float = time) -> float:
            return a + (b - a) * t / length

        def loss(t: float, runs: bool = runs, at: Any = at) -> float:
            return constant + copper * (at(t) / torque) ** 2 if runs else 0.0

        squares += quad(lambda t, at=at: at(t) ** 2, 0, time, epsabs=0, epsrel=1e-12)[0]
        heat += quad(loss, 0, time, epsabs=1e-9, epsrel=1e-12)[0]
        cooled, whole, on = cooled + k * time, whole + time, on + (time if runs else 0.0)
        pieces.append((time, k, loss))
    per_kelvin = (constant + copper) / rise

    def once(start: float) -> tuple[float, float]:
        now, top = start, start
        for time, k, loss in pieces:
            found = solve_ivp(
                lambda t, y, k=k, loss=loss: [(loss(t) - k * per_kelvin * y[0]) / (tau * per_kelvin)],
                (0, time),
                [now],
                rtol=1e-10,
                atol=1e-10,
                max_step=time / 100,
            )
            now, top = float(found.y[0, -1]), max(top, float(found.y[0].max()))
        return now, top

    free, kept = once(0.0)[0], once(1.0)[0] - once(0.0)[0]
    return {
        "cycle_torque_weighted": math.sqrt(squares / cooled),
        "cycle_torque_whole": math.sqrt(squares / whole),
        "cycle_torque_running": math.sqrt(squares / on),
        "cycle_duty_factor": on / whole,
        "cycle_utilisation": math.sqrt(squares / cooled) / torque,
        "cycle_loss_mean": heat / cooled,
        "cycle_loss_utilisation": heat / cooled / (constant + copper),
        "cycle_temperature_max": once(free / (1 - kept))[1],
    }
