"""Stopping distances and times to rest of the conveyor against other methods, to a fraction of a per cent.

The rigid body by its momentum, with brakes that come late and rise, and with a resistance that the stop factor scales;
the belt in cells by finite elements, which also follow the point that goes farthest.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from support.belt_scenes import Brake, Drive, Rig, loads_of
from support.machines import changed, load_of, report_of, scene_of, spec_of

from ptmcalc.contract.report import SceneReport
from ptmcalc.machines.conveyor.machine.drives import running
from ptmcalc.machines.conveyor.machine.motion import moving
from ptmcalc.machines.conveyor.stopping.gear_losses import changing_sides
from ptmcalc.machines.conveyor.waves import cell_runs
from ptmcalc.machines.conveyor.waves.unfinished_stop import time_to_rest

FACTOR = 0.7
HILL = Rig(sections=((200.0, -6.0), (300.0, 24.0)), brakes=(Brake(14e3, 1.0, 1.5), Brake(3e3, 2.5)))
WAYS = ("stop_distance", "stop_distance_max")


def stopped(rig: Rig, **more: Any) -> SceneReport:
    """The stop of a rig of which the file gives so much more resistance that its stop factor leaves the rig's own."""
    data = changed(rig.data({"type": "stop"}, **more), resistance__coefficient=rig.friction / FACTOR)
    return scene_of(report_of(changed(data, resistance__stop_factor=FACTOR)))


def rigid_rest(rig: Rig) -> tuple[float, float]:
    """Time and way to rest of one mass: m v = m v_0 - W t - sum of the impulses of the brakes."""
    radius = rig.drives["head"].diameter / 2

    def impulse(brake: Brake, time: float) -> float:
        since = max(time - brake.delay, 0.0)
        rising = min(since, brake.rise)
        grown = rising**2 / 2 / brake.rise if brake.rise else 0.0
        return brake.torque / radius * (grown + since - rising)

    def speed(time: float) -> float:
        taken = rig.resistance() * time + sum(impulse(brake, time) for brake in rig.brakes)
        return rig.speed - taken / rig.mass()

    time = float(brentq(speed, 0.0, 1e3, xtol=1e-13))
    marks = [mark for brake in rig.brakes for mark in (brake.delay, brake.delay + brake.rise) if 0 < mark < time]
    return time, float(quad(speed, 0.0, time, points=marks or None, epsabs=1e-12)[0])


@pytest.mark.parametrize(
    "brakes",
    [(), (Brake(8e3),), (Brake(8e3, 1.0),), (Brake(8e3, 0.0, 2.0),), HILL.brakes],
    ids=["none", "at once", "late", "rising", "two"],
)
def test_the_textbook_stop_is_that_of_momentum(brakes: tuple[Brake, ...]) -> None:
    rig = replace(HILL, brakes=brakes)
    time, way = rigid_rest(rig)
    scene = stopped(rig)
    for name, value in {"stop_time": time, **dict.fromkeys(WAYS, way)}.items():
        formula = load_of(scene, name).formula
        assert formula is not None
        assert formula.value == pytest.approx(value, rel=1e-8), name


@pytest.mark.parametrize(
    ("sections", "more"),
    [(((90.0, 4.0),), {"belt_wave": "off"}), (HILL.sections, {"belt_wave": "off"}), (((1.0, 0.05),), {})],
    ids=["waves left out", "waves left out of two slopes", "one metre"],
)
def test_a_stop_without_waves_is_that_of_momentum(
    sections: tuple[tuple[float, float], ...], more: dict[str, str]
) -> None:
    rig = replace(HILL, sections=sections)
    time, way = rigid_rest(rig)
    scene = stopped(rig, effects=rig.data()["effects"] | more)
    for name, value in {"stop_time": time, **dict.fromkeys(WAYS, way)}.items():
        load = load_of(scene, name)
        assert load.solver == "stiff_stop"
        assert load.estimate.value == pytest.approx(value, rel=1e-8), name


def test_a_stiff_short_belt_in_cells_stops_by_its_stop_factor() -> None:
    rig = replace(HILL, sections=((90.0, 3.0),), stiffness=4e8, tension=300e3, friction=0.1, brakes=())
    time, way = rigid_rest(rig)
    scene = stopped(rig)
    assert load_of(scene, "stop_distance").solver == "network"
    assert load_of(scene, "stop_distance").estimate.value == pytest.approx(way, rel=3e-3)
    assert load_of(scene, "stop_distance_max").estimate.value == pytest.approx(way, rel=3e-3)
    assert load_of(scene, "stop_time").estimate.value == pytest.approx(time, rel=1e-2)


LEVEL = replace(
    HILL,
    sections=((500.0, 0.0),),
    load=1e-3,
    carry_idlers=8.0,
    rigid=True,
    tension=250e3,
    tail_inertia=400.0,
    drives={"head": Drive(friction=None)},
    brakes=(Brake(40e3, 0.2, 0.3),),
)
"""Both strands are alike: the tail is the last to know of the brake."""
ELASTIC = {
    "weight": replace(HILL, weight=2 * 120e3 / 9.81, brakes=(Brake(30e3, 0.2, 0.3),)),
    "late": HILL,
    "screw": replace(HILL, rigid=True, tension=190e3),
    "tail": LEVEL,
}


@pytest.mark.parametrize("name", ELASTIC)
def test_an_elastic_belt_stops_as_its_finite_elements(name: str) -> None:
    """At the head, and where it goes farthest: behind a take-up, within the loop, or at the tail."""
    rig = ELASTIC[name]
    scene = stopped(rig)
    window = load_of(scene, "tension_max").window
    assert window is not None
    motion = rig.stopped(window[1], 400)
    found = loads_of(rig, motion).loads
    longest = float(motion.farthest.max())
    values = {load: found[load] for load in ("stop_time", "stop_distance")} | {"stop_distance_max": longest}
    assert longest > 1.02 * found["stop_distance"]
    if name == "tail":
        assert abs(int(motion.farthest.argmax()) - motion.tail_element) <= 1
        assert load_of(scene, "stop_distance_max").at["position"] == pytest.approx(500.0, rel=1e-9)
    for load, value in values.items():
        assert load_of(scene, load).estimate.value == pytest.approx(value, rel=5e-3), load


def geared_rest(rig: Rig, motor: Brake, brake: Brake) -> tuple[float, float]:
    """Time and way to rest with a brake on the motor shaft and one on the drum: at each moment the losses of the gear
    are on the side that is driven."""
    drive = rig.drives["head"]
    radius, turns = drive.diameter / 2, drive.ratio * 2 / drive.diameter
    rotor = drive.count * drive.rotor * turns**2
    belt = rig.mass() - rotor * drive.efficiency
    on_motor, on_drum = motor.capacity(1 / turns), brake.capacity(radius)

    def slowing(time: float) -> float:
        outside, inside = rig.resistance() + on_drum(time), on_motor(time)
        for k in (1 / drive.efficiency, drive.efficiency):
            found = (outside + k * inside) / (belt + k * rotor)
            if (inside >= rotor * found) == (k > 1):
                return float(found)
        raise AssertionError("one of both senses holds")

    times = np.linspace(0.0, 10.0, 20_001)
    slows = np.array([slowing(time) for time in times.tolist()])
    lost = np.concatenate([[0.0], np.cumsum(slows[1:] + slows[:-1])]) * times[1] / 2
    speeds = rig.speed - lost
    last = int(np.flatnonzero(speeds <= 0)[0])
    return float(times[last]), float(speeds[:last].sum() - speeds[0] / 2) * float(times[1])


@pytest.mark.parametrize("delay", [0.0, 1.0])
def test_a_stop_whose_gear_losses_change_their_side(delay: float) -> None:
    """A brake on the motor shaft that the rotor overcomes once that of the drum comes in."""
    motor, brake = Brake(40.0, 0.8), Brake(12e3, delay, 0.5)
    rig = replace(HILL, drives={"head": Drive(friction=None, efficiency=0.8, rotor=8.0)}, brakes=(brake,))
    data = changed(rig.data({"type": "stop"}), resistance__stop_factor=1)
    data["brakes"]["motor"] = {"torque": "40 N*m", "delay": "0.8 s", "shaft": "motor"}
    spec = spec_of(data)
    (scene,) = spec.all_scenes
    change = changing_sides(spec, scene, running(spec, scene))
    load = scene_of(report_of(data))
    fixed = {name: load_of(load, name).formula for name in ("stop_time", "stop_distance")}
    time, way = geared_rest(rig, motor, brake)
    assert fixed["stop_time"] is not None
    assert fixed["stop_distance"] is not None
    assert change.way < -0.005 * way
    assert fixed["stop_time"].value + change.time == pytest.approx(time, rel=1e-3)
    assert fixed["stop_distance"].value + change.way == pytest.approx(way, rel=1e-3)


def test_a_coasting_distance_gives_the_coefficient_with_its_stop_factor() -> None:
    """m v^2/2 = s W: the coefficient that the belt coasted with comes out of the way by hand."""
    rig = replace(HILL, brakes=())
    way = rig.mass() * rig.speed**2 / 2 / rig.resistance()
    data = changed(
        rig.data({"type": "coast", "measured_distance": f"{way!r} m"}),
        resistance__coefficient=rig.friction / FACTOR,
        resistance__stop_factor=FACTOR,
    )
    found = load_of(scene_of(report_of(data)), "resistance_coefficient_identified").estimate.value
    assert found == pytest.approx(rig.friction, rel=1e-9)


@pytest.mark.parametrize("kind", ["stop", "emergency_stop"])
def test_the_brake_of_a_stopping_distance_keeps_it(kind: str) -> None:
    """M = (m v^2/(2 s) - W) R by hand, W with the stop factor."""
    rig, limit = replace(HILL, brakes=(Brake(8e3),)), 9.0
    data = changed(
        rig.data({"type": kind}, checks={"stop_distance": f"{limit} m"}),
        resistance__coefficient=rig.friction / FACTOR,
        resistance__stop_factor=FACTOR,
    )
    torque = load_of(scene_of(report_of(data)), "brake_torque_required").estimate.value
    assert rigid_rest(replace(rig, brakes=(Brake(torque),)))[1] == pytest.approx(limit, rel=1e-9)


def test_a_slipping_stop_goes_on_for_the_time_that_its_grip_asks_for() -> None:
    """M v/(W + T_2 (1 - exp(-mu alpha))) by hand, v the mean of the last contour time, T_2 without m v^2: the pulley is
    held, the belt slides on, and the take-up keeps its tension."""
    head = Drive(friction=0.1)
    rig = replace(HILL, sections=((500.0, 0.0),), drives={"head": head}, brakes=(Brake(400e3),))
    spec = spec_of(changed(rig.data({"type": "stop"}), resistance__stop_factor=1))
    (scene,) = spec.all_scenes
    case = moving(spec, scene)
    drawn = cell_runs.marched(case, frozenset({"slip", "tail_mass"}), 400, False, 400).drawn
    assert drawn.head.drums[-1][0] == 0
    speed = float(drawn.head.belt[drawn.times > drawn.times[-1] - rig.contour()].mean())
    grip = (rig.tension - rig.belt * speed**2) * (1 - math.exp(-head.wrap * 0.1))
    left = (rig.belt_mass() + rig.tail_mass) * speed / (rig.resistance() + grip)
    assert time_to_rest(case, drawn) == pytest.approx(left, rel=5e-3)
