"""What the page of disagreements says of the sources, worked out here from first principles: nothing of ptmcalc."""

import math
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh
from scipy.optimize import brentq

PAGE = (Path(__file__).parents[2] / "docs" / "disagreements.md").read_text("utf-8")
G = 9.81


def row(begin: str) -> str:
    """The row of the page that begins so."""
    (found,) = (line for line in PAGE.splitlines() if line.startswith(f"| {begin}"))
    return found


def says(begin: str, *told: str) -> None:
    """That a row has these words; they are built from numbers that the test has computed."""
    for words in told:
        assert words in row(begin)


# -- chains ---------------------------------------------------------------------------------------------------------


def polygon_force(ratio: float, damping: float, teeth: int = 8) -> tuple[float, float]:
    """Largest and smallest force at the driven end of a rod with a free tail, over m a_max.

    The end moves by the acceleration -sin(phi)/sin(pi/z) a_max from tooth to tooth; Kelvin and Voigt's material, the
    ratio that of the first mode, pi/2 for m = l = c = 1. Every harmonic exactly: F = m a tanh(s)/s, s = i w/E^(1/2).
    """
    w = ratio * math.pi / 2
    k = np.arange(1, 1501)
    b = 2 * math.pi * k / ((math.pi * k) ** 2 - (math.pi / teeth) ** 2)
    s = 1j * k * w / np.sqrt(1 + 2j * damping * k * w / (math.pi / 2))
    spectrum = np.zeros(8192, complex)
    spectrum[1:1501] = b * np.tanh(s) / s
    force = np.imag(np.fft.ifft(spectrum) * len(spectrum))
    return float(force.max()), float(force.min())


def test_three_times_the_mass_times_the_acceleration_is_no_bound() -> None:
    found = [polygon_force(ratio, 0.01)[0] for ratio in (1 / 20, 1 / 3, 1.0)]
    says(
        "Polygon force `3 m a_max`",
        "{:.1f} at 1/20, {:.0f} at 1/3, {:.0f} at the first natural frequency".format(*found),
    )
    pulls, sinks = (
        brentq(lambda zeta, of=of: max(of(polygon_force(r, zeta)) for r in (0.97, 0.98, 0.99, 1.0)) - 3, 0.05, 0.2)
        for of in (max, lambda pair: -min(pair))
    )
    assert 0.0895 < pulls < 0.0905
    says("Polygon force `3 m a_max`", f"below {100 * pulls:.0f} % of damping, {100 * sinks:.0f} % on the slack side")


def test_above_the_resonance_it_is_far_too_much() -> None:
    light, heavy = (3 / polygon_force(1.5, zeta)[0] for zeta in (0.01, 0.05))
    names = {4: "four", 8: "eight"}
    told = f"{names[round(light)]} times too high at 1.5 times the frequency with 1 % of damping, {names[round(heavy)]}"
    says("The same above the resonance", told)


def test_the_resonance_of_one_strand_without_the_other() -> None:
    """Steel, 16 cm^2, two strands of 40 m, 200 kg/m and 80 kg/m, the sprocket held: finite elements."""
    stiffness, length, pieces = 2.06e11 * 16e-4, 40.0, 200
    h = length / pieces
    masses, k = np.zeros(2 * pieces + 1), np.zeros((2 * pieces + 1, 2 * pieces + 1))
    for element in range(2 * pieces):
        masses[element : element + 2] += (200 if element < pieces else 80) * h / 2
        k[element : element + 2, element : element + 2] += stiffness / h * np.array([[1, -1], [-1, 1]])
    both = math.sqrt(eigh(k[1:, 1:], np.diag(masses[1:]), eigvals_only=True, subset_by_index=[0, 0])[0])
    alone = math.pi / 2 / length * math.sqrt(stiffness / 200)
    says("Resonance speed from one uniform strand", f"{100 * (alone / both - 1):.0f} % high")


# -- hoists and cranes ----------------------------------------------------------------------------------------------


def test_losses_term_by_term() -> None:
    """10 t on a drum of 0.2 m, ratio 40, efficiency 0.85, 60 rad/s^2 at the motor: through the mesh goes one torque."""
    radius, ratio, eta, rotor = 0.2, 40.0, 0.85, 0.9
    off = []
    for sign, way in ((-1, 1), (-1, -1)):
        weight, inertia = 1e4 * G * radius, 1e4 * radius**2 * sign * 60 / ratio

        def at_motor(torque: float, way: int = way) -> float:
            return torque / ratio * (1 / eta if torque * way > 0 else eta)

        right = rotor * sign * 60 + at_motor(weight + inertia)
        off.append(100 * ((rotor * sign * 60 + at_motor(weight) + at_motor(inertia)) / right - 1))
    says("Efficiency term by term", f"{off[0]:+.1f} % and {off[1]:+.1f} % in case C04")


def over_a_joint(number: float, sign: float, waves: int) -> tuple[float, float]:
    """Of a mass on a spring, over the push: the most it feels while its wheel is on the joint, and behind it."""

    def rate(t: float, y: np.ndarray) -> list[float]:
        return [y[1], number**2 * (sign * math.cos(t) - y[0])]

    end = waves * math.pi
    run = solve_ivp(rate, (0, end), [0, 0], "DOP853", np.linspace(0, end, 2001), rtol=1e-8, atol=1e-10)
    return float(np.abs(run.y[0]).max()), float(np.hypot(run.y[0, -1], run.y[1, -1] / number))


def test_a_joint_is_felt_before_its_swing_is_over() -> None:
    numbers = np.linspace(1.02, 2.6, 80)
    most = [max(max(over_a_joint(float(a), *kind)) for a in numbers) for kind in ((1.0, 1), (-1.0, 2))]
    (step, behind_step), (gap, behind_gap) = over_a_joint(3.0, 1.0, 1), over_a_joint(2.0, -1.0, 2)
    assert max(behind_step, behind_gap) < 1e-6
    says(
        "Rail joint by the residual oscillation",
        f"nothing against {step:.2f} on a step at alpha = 3, against {gap:.2f} in a gap at 2",
        f"at most {most[0]:.2f} and {most[1]:.2f}",
    )


def test_start_of_the_course_project() -> None:
    inertia, speed, steady, ratio, eta, rotor = 60826.0, 4 * math.pi / 60, 983.8 + 2184.4, 400, 0.7, 0.021 * 1.7 * 1.15
    whole = inertia + rotor * ratio**2 * eta
    time, torque = whole * speed / (37 * ratio * eta - steady), (whole * speed / 8 + steady) / (ratio * eta)
    says("Start of 8 s", f"37 N·m starts it in {time:.2f} s, 8 s needs {torque:.1f} N·m")

    def equivalent(start: float, torque: float) -> float:
        even = (math.pi - speed * start / 2 - math.pi / 12) / speed
        parts = np.array([start, even, 2.5]), np.array([torque, steady, 7617.8])
        return float((parts[0] @ parts[1] ** 3 / parts[0].sum()) ** (1 / 3))

    both = equivalent(8, 37 * ratio * eta)
    off = [100 * (both / one - 1) for one in (equivalent(time, 37 * ratio * eta), equivalent(8, torque * ratio * eta))]
    says("Start of 8 s", f"{off[0]:.0f} to {off[1]:.0f} % conservative")


# -- stacker cranes -------------------------------------------------------------------------------------------------


def test_rollers_of_a_carriage_feel_its_acceleration() -> None:
    """Moments about the rope of a load and a carriage that are hoisted ever faster: balance of momentum by hand."""
    load, carriage, a, b, h, up = 1000.0, 800.0, 0.9, 0.35, 2.0, 0.6
    rope = (load + carriage) * (G + up)  # its line is the origin: it has no moment
    turning = load * a * up + carriage * b * up  # rate of the angular momentum of what moves straight up
    weights = load * G * a + carriage * G * b
    rollers = (weights + turning) / h
    assert rope > 0
    assert rollers / (weights / h) == pytest.approx(1 + up / G)
    says("Rollers loaded by the weights alone", "`psi (Q a + G b)/h`, `psi = 1 + a/g`", "by `a/g` of the force")


# -- shafts and winding ---------------------------------------------------------------------------------------------


def run_up(factor: float) -> float:
    """Time to 0.95 of the synchronous speed of a shaft with J = 30 + 8 sin^2, a cage motor of 5.5 kW, ratio 12."""
    slip, synchronous = 0.04 * (2.3 + math.sqrt(2.3**2 - 1)), 50 * math.pi
    most = 2.3 * 5500 / (48 * math.pi)

    def rate(t: float, y: np.ndarray) -> list[float]:
        s = 1 - 12 * y[1] / synchronous
        torque = 2 * most / (s / slip + slip / s)
        return [y[1], (12 * factor * torque - 35 - y[1] ** 2 * 4 * math.sin(2 * y[0])) / (34 - 4 * math.cos(2 * y[0]))]

    def reached(t: float, y: np.ndarray) -> float:
        return float(y[1]) - 0.95 * synchronous / 12

    reached.terminal = True  # type: ignore[attr-defined]
    return float(solve_ivp(rate, (0, 10), [0, 0], "DOP853", events=reached, rtol=1e-9, atol=1e-11).t[-1])


def test_run_up_without_the_losses_of_the_gear() -> None:
    right = run_up(0.94)
    assert right == pytest.approx(0.882493, rel=1e-5)
    says("Run-up steps without the gear efficiency", f"{100 * (1 - run_up(1.0) / right):.0f} % too short")


def climb(modulus: float, falls: int, amplitude: float) -> tuple[float, float]:
    """Frequency of 5 t on 160 m of rope of 114 mm^2, and the dynamic over the mean stress as it climbs a layer."""
    k = falls * math.sqrt(modulus * 114e-6 / (5000 * 160))
    rate: Callable[[float, Sequence[float]], list[float]] = lambda t, y: [  # noqa: E731
        y[1],
        math.exp(-3 * t) - math.exp(-96 * t) - k * k * y[0],
    ]
    run = solve_ivp(rate, (0, 5), [0, 0], "DOP853", np.linspace(0, 5, 5001), rtol=1e-9, atol=1e-12)
    return k, k * k * float(run.y[0].max()) * amplitude / (falls * G)


def test_the_paper_on_winding() -> None:
    speed, rope = 0.4 * math.pi, 0.0175
    paper = climb(2.1e11, 1, speed**2 * rope)
    jump = speed * math.sqrt(3) / 2 * rope / (1 / 3 - 1 / 96)  # the pulse comes to the jump of the rope's speed
    right, wire = climb(1.05e11, 4, jump), climb(2.1e11, 4, jump)
    assert wire[0] / paper[0] == pytest.approx(4)
    says("Multilayer winding: k without the reeving", "frequency four times too low on four falls")
    says("The same: 9200 in the response", f"{100 * (96**2 / 9200 - 1):.2f} %")
    told = f"{100 * paper[1]:.2f} % by them, {100 * right[1]:.2f} % corrected"
    says("The same: dynamic stress 7 to 18 % of the mean", told)
