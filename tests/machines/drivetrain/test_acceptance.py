"""Hard motions through the whole tool, against a state machine integrated by scipy and against solutions by hand."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq
from support.drivetrains import data_of
from support.hybrid import Course, Link, Machine, Torque, simulate
from support.machines import load_of, report_of, scene_of

from ptmcalc.contract.report import SceneReport


def scene(text: str) -> SceneReport:
    """The only scene of a train."""
    return scene_of(report_of(data_of(text)))


def value(found: SceneReport, name: str) -> float:
    return load_of(found, name).estimate.value


def test_a_clamped_gap_over_many_contacts() -> None:
    """Free inertias, started from rest by a torque: over 20 contacts, peak and end against the state machine."""
    stiffness, damping, play, torque, end = 1e5, 20.0, math.radians(2), 100.0, 0.6
    found = scene(
        f"""
        kind: drivetrain
        inertias: {{a: {{inertia: 1 kg*m^2}}, b: {{inertia: 3 kg*m^2}}}}
        links:
          gap: {{between: [a, b], stiffness: {stiffness} N*m/rad, damping: {damping} N*m*s/rad, gap: {play} rad}}
        torques: {{drive: {{at: a, type: constant, torque: {torque} N*m}}}}
        checks: {{DRV101: {{off: "looked at by itself"}}}}
        scenes: [{{type: run, duration: {end} s}}]
        """
    )
    reference = simulate(
        Machine(
            inertias=(1.0, 3.0),
            positions=(0.0, 0.0),
            speeds=(0.0, 0.0),
            links=(Link(0, 1, stiffness, damping, play, "clamped"),),
            torques=(Torque(0, Course.constant(torque)),),
        ),
        end,
    )
    contacts = [event for event in found.events if event.element == "gap"]
    assert len(contacts) >= 20
    peak = max(reference.highest["link", 0], -reference.lowest["link", 0])
    assert value(found, "torque_peak[gap]") == pytest.approx(peak, rel=1e-9)
    assert value(found, "speed_end[b]") == pytest.approx(reference.speeds[1], rel=1e-8)
    assert value(found, "energy_residual") < 1e-9


def test_a_brake_that_stops_a_mass_holds_it() -> None:
    """v^2/(2 a) and v/a by hand; from then on the speed is 0 to the last digit, against a pull below the friction."""
    found = scene(
        """
        kind: drivetrain
        inertias: {sled: {mass: 100 kg, speed: 1 m/s}}
        brakes: {shoe: {at: sled, torque: 90 N, applied: always}}
        torques: {pull: {at: sled, type: constant, torque: 40 N}}
        scenes: [{type: run, duration: 1000 s}]
        """
    )
    assert value(found, "speed_end[sled]") == 0.0
    assert value(found, "angle_end[sled]") == pytest.approx(1.0, rel=1e-13)
    (stop,) = found.events
    assert (stop.element, stop.after) == ("shoe", "at rest")
    assert stop.time == pytest.approx(2.0, rel=1e-13)


def test_a_lossy_gear_under_a_sine_torque() -> None:
    """Backward, stuck, forward, stuck: each phase by hand, on the motor's side.

    (J1 + e J2/u) v' = A sin(W t) - e L, with e = 1/(u eta) forward and e = (2 - 1/eta)/u backward; at rest the mesh
    holds while the torque lies between both e L.
    """
    small, big, ratio, eta, load, size, omega = 1.0, 40.0, 10.0, 0.6, 100.0, 18.0, 2.0
    forward, back = load / (ratio * eta), load * (2 - 1 / eta) / ratio

    def turned(start: float, time: float, held: float) -> float:
        return size / omega * (math.cos(omega * start) - math.cos(omega * time)) - held * (time - start)

    first = brentq(lambda t: turned(0.0, t, back), 0.05, 1.0, xtol=1e-15)
    second = math.asin(forward / size) / omega
    third = brentq(lambda t: turned(second, t, forward), second + 0.2, second + 1.2, xtol=1e-15)
    fourth = (math.pi - math.asin(back / size)) / omega
    assert back < size * math.sin(omega * first) < forward
    assert back < size * math.sin(omega * third) < forward

    found = scene(
        f"""
        kind: drivetrain
        inertias: {{motor: {{inertia: {small} kg*m^2}}, wheel: {{inertia: {big} kg*m^2}}}}
        gears: {{worm: {{from: motor, to: wheel, ratio: {ratio}, efficiency: {eta}}}}}
        torques:
          sine: {{at: motor, type: sine, amplitude: {size} N*m, angular_frequency: {omega} rad/s}}
          weight: {{at: wheel, type: constant, torque: {-load} N*m}}
        checks: {{DRV107: {{off: "no link to resonate"}}}}
        scenes: [{{type: run, duration: {fourth + 0.01} s}}]
        """
    )
    changes = [(event.after, event.time) for event in found.events if event.element == "worm"]
    assert [name for name, _ in changes] == ["at rest", "forward", "at rest", "backward"]
    assert [time for _, time in changes] == pytest.approx([first, second, third, fourth], abs=1e-9)
    inertia = small + big * forward / load / ratio
    speed = max(turned(second, t, forward) / inertia for t in np.linspace(second, third, 20001))
    assert value(found, "speed_max[motor]") == pytest.approx(speed, rel=1e-7)


@pytest.mark.parametrize("stiffness", [1e6, 1e9, 1e12])
def test_a_stiff_damped_link_needs_no_smaller_steps(stiffness: float) -> None:
    """The steps of a run do not grow with the stiffness once the link's own vibration has died away."""
    damping = 0.2 * math.sqrt(stiffness * 0.75)
    found = scene(
        f"""
        kind: drivetrain
        inertias: {{a: {{inertia: 1 kg*m^2}}, b: {{inertia: 3 kg*m^2}}}}
        links: {{s: {{between: [a, b], stiffness: {stiffness} N*m/rad, damping: {damping} N*m*s/rad}}}}
        torques: {{drive: {{at: a, type: constant, torque: 100 N*m}}}}
        checks: {{DRV101: {{off: "looked at by itself"}}}}
        scenes: [{{type: run, duration: 2 s}}]
        """
    )
    assert found.health["steps"] < 2000
    zeta = damping / (2 * math.sqrt(stiffness * 0.75))
    step = 1 + math.exp(-math.pi * zeta / math.sqrt(1 - zeta**2))
    assert value(found, "torque_peak[s]") >= 75 * step * (1 - 1e-9)
    assert value(found, "speed_end[b]") == pytest.approx(50.0, rel=1e-6)
