"""Bars of starts and stops hold on random chains whose tail sprocket keeps the speed of the driving one.

The reference is finite elements of each strand whose ends are moved, and of both strands on sprockets that are coupled,
braked by a force. Tensions at rest are worked out here from the numbers of the file.
"""

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from support.bars import MACHINES, WIDEST, Limit, Trial, claim_of, misses, near, numbers, opposites, tried, wide
from support.chain_starts import KIND, built
from support.driven_tails import SEED, Machine, random_machine, stacked, total
from support.held_fem import Motion, moved_by_ends, on_one_shaft, profile, teeth

from ptmcalc.base.estimate import Estimate
from ptmcalc.engine.plan import plan_scene
from ptmcalc.machines.chain_drive.machine.strength import safety

ALWAYS = 6
MESHES = (16, 1.0), (32, 0.5)
LATER, LEADS = 1.4, 5
LIMIT = Limit("safety_start", ("checks", "safety_start"), least=1e-6)
LOADS = ("tension_dynamic_start", "tension_start", "safety_start", "tension_min")
WAYS = {
    "rigid": ("chain_rigid_start", {"tooth_passing": "off"}),
    "waves": ("chain_start_waves", {"tooth_passing": "off"}),
    "bounded teeth": ("chain_start_waves", {}),
    "teeth": ("chain_start_teeth", {}),
}


# -- starts ---------------------------------------------------------------------------------------------------------


def of_strand(machine: Machine, strand: int, window: float, pieces: int, fine: float, toothed: bool) -> np.ndarray:
    """Dynamic tensions of a strand, shape (steps, pieces + 2, places of the joints)."""
    bar = machine.bars[strand]
    element = bar.length / pieces * math.sqrt(bar.line_mass / bar.stiffness)
    times = np.arange(0.0, window, fine * min(element, machine.time / 40))
    mean = profile(machine.shape, machine.time, machine.speed, times)
    still: Motion = (np.zeros_like(times), np.zeros_like(times), np.zeros_like(times))
    dt, free = float(times[1]), strand == 0 and not machine.fixed
    if not toothed:
        one = stacked([mean])
        return moved_by_ends(bar, pieces, dt, None if free else one, one)
    head_teeth, tail_teeth = machine.teeth
    half = (head_teeth / 2) % 1.0  # the leaving strand is half a turn behind
    leads = [k / LEADS for k in range(LEADS)]
    heads = [teeth(mean, machine.pitch, head_teeth, lead + (half if strand == 0 else 0)) for lead in leads]
    tails = [teeth(mean, machine.pitch, tail_teeth, lead) for lead in leads]
    near, far = [total(mean, one) for one in heads] + [still] * LEADS, [mean] * LEADS + tails
    first, last = (far, near) if strand == 1 else (near, far)
    found = moved_by_ends(bar, pieces, dt, None if free else stacked(first), stacked(last))
    pairs = [found[:, :, i] + found[:, :, LEADS + j] for i in range(LEADS) for j in range(LEADS)]
    return np.stack(pairs, axis=2)


def loads_of_start(machine: Machine, window: float, mesh: tuple[int, float], toothed: bool) -> dict[str, float]:
    """The largest entering tension and the smallest of any section, the worst of all places of the joints."""
    pieces, fine = mesh
    back, working = (of_strand(machine, strand, window, pieces, fine, toothed) for strand in (0, 1))
    entering = max(float(working[:, -1].max()), 0.0)
    lows = [
        min(float((machine.resting(k, pieces)[:, None] + part.min(axis=0)).min()), min(machine.static[k]))
        for k, part in enumerate((back, working))
    ]
    return {
        "tension_dynamic_start": entering,
        "tension_start": machine.static[1][1] + entering,
        "tension_min": min(lows),
    }


def truth_of(machine: Machine, spec: Any, window: float, toothed: bool) -> dict[str, Estimate]:
    """Loads by finite elements with what two meshes say of them."""
    coarse, fine = (loads_of_start(machine, LATER * window, mesh, toothed) for mesh in MESHES)
    off = {name: 1.5 * abs(fine[name] - coarse[name]) + 1e-4 * machine.static[1][1] for name in fine}
    truth = {name: Estimate.within(value, off[name]) for name, value in fine.items()}
    centrifugal = machine.back.line_mass * machine.speed**2
    ends = [safety(spec, fine["tension_start"] + sign * off["tension_start"] + centrifugal) for sign in (1, -1)]
    return truth | {"safety_start": Estimate(sum(ends) / 2, ends[0], ends[1])}


@cache
def trial(number: int, way: str) -> Trial:
    """A machine whose chain stays taut by the claim that is on trial."""
    name, effects = WAYS[way]
    solver = next(one for one in KIND.solvers if one.name == name)
    tries = 0
    while True:
        machine = random_machine(1000 * (number + 1) + tries)
        tries += 1
        spec = built(machine.data | {"effects": effects})
        (scene,) = spec.all_scenes
        plan = plan_scene(KIND, spec, scene)
        claims = claim_of(plan, spec, solver, solver.always, 0)
        if claims["tension_min"].low > 0 and claims["tension_start"].bounded:
            break
    window = solver.run(spec, scene, solver.always, 0).window
    assert window is not None
    truth = truth_of(machine, spec, window[1], "teeth" in way)
    rng = np.random.default_rng((SEED, 7, number))
    return tried(number, rng, KIND, spec, scene, {way: {one: claims[one] for one in LOADS}}, truth, [LIMIT])


@pytest.fixture(scope="module", params=numbers(ALWAYS, MACHINES))
def some(request: pytest.FixtureRequest) -> range:
    found = request.param
    assert isinstance(found, range)
    return found


@pytest.mark.parametrize("way", WAYS)
def test_the_bar_of_a_start_with_a_driven_tail_holds(way: str, some: range) -> None:
    trials = [trial(number, way) for number in some]
    assert misses(trials, way) == []
    assert opposites(trials) == []
    if way in ("waves", "teeth"):
        assert wide(trials, way) <= WIDEST
    assert near(trials) >= 0.4


@pytest.mark.parametrize("index", [50011, 50033, 50034, 50043, 50050])
def test_the_bar_of_a_start_with_a_take_up_weight_holds(index: int) -> None:
    """A light weight behind the driving sprocket changes the return strand alone, by less than its bound."""
    machine = random_machine(index)
    own = machine.back.length * machine.back.line_mass
    hung = own * float(np.random.default_rng((SEED, 5, index)).uniform(0.02, 0.2))
    machine.data["layout"]["takeup"]["mass"] = f"{hung!r} kg"
    spec = built(machine.data | {"effects": {"tooth_passing": "off"}})
    (scene,) = spec.all_scenes
    solver = next(one for one in KIND.solvers if one.name == "chain_start_waves")
    claim = claim_of(plan_scene(KIND, spec, scene), spec, solver, solver.always, 0)["tension_min"]
    window = solver.run(spec, scene, solver.always, 0).window
    assert window is not None
    assert claim.bounded
    element = machine.back.length / 32 * math.sqrt(machine.back.line_mass / machine.back.stiffness)
    times = np.arange(0.0, LATER * window[1], min(element, machine.time / 40) / 2)
    mean = stacked([profile(machine.shape, machine.time, machine.speed, times)])
    found = moved_by_ends(machine.back, 32, float(times[1]), None, mean, hung / 4)[:, :, 0]
    other = of_strand(machine, 1, LATER * window[1], 32, 0.5, toothed=False)[:, :, 0]
    lows = [float((machine.resting(k, 32) + part.min(axis=0)).min()) for k, part in enumerate((found, other))]
    low = min(*lows, *machine.static[0], *machine.static[1])
    assert claim.low - 1e-3 * machine.static[1][1] <= low <= claim.high + 1e-3 * machine.static[1][1]


# -- starts by torque -----------------------------------------------------------------------------------------------


def masses_of(machine: Machine) -> tuple[float, float]:
    """Both sprockets with the drive, and everything [kg]."""
    arms = [machine.pitch * z / (2 * math.pi) for z in machine.teeth]
    tail = float(machine.data["layout"]["tail"]["inertia"].split()[0]) / arms[1] ** 2
    sprockets = (0.40 * 40**2 + 10) / arms[0] ** 2 + tail
    return sprockets, sprockets + sum(bar.length * bar.line_mass for bar in machine.bars)


def stepped(machine: Machine, force: float, toothed: bool, window: float, pieces: int) -> dict[str, float]:
    """Loads of a start by a step of force over the resistance, which ends when the chain has its speed; with teeth the
    worst of several places of the joints of both sprockets."""
    sprockets, whole = masses_of(machine)
    dt = min(bar.length / pieces * math.sqrt(bar.line_mass / bar.stiffness) for bar in machine.bars) / 2
    times = np.arange(0.0, window, dt)
    a, end = force / whole, machine.speed * whole / force
    forces = np.where(times < end, force, 0.0)
    before = np.minimum(times, end)
    mean = a * before**2 / 2 + machine.speed * np.maximum(times - end, 0.0), a * before, a * (times < end)
    places = [k / LEADS for k in range(0, LEADS, 2)] if toothed else [0.0]
    leads = [(one, other) for one in places for other in places]
    entering, low = 0.0, min(*machine.static[0], *machine.static[1])
    for head, tail in leads:
        ends: tuple[Motion | None, ...] = (None,) * 4
        if toothed:
            near, far = machine.teeth
            leaving = teeth(mean, machine.pitch, near, head + (near / 2) % 1.0)
            moved, entry = teeth(mean, machine.pitch, far, tail), teeth(mean, machine.pitch, near, head)
            ends = (None if not machine.fixed else leaving), moved, moved, entry
        found = on_one_shaft(machine.bars, not machine.fixed, sprockets, pieces, dt, forces, ends)
        entering = max(entering, float(found[1][:, -1].max()))
        low = min(low, *(float((part.min(axis=0) + machine.resting(k, pieces)).min()) for k, part in enumerate(found)))
    return {
        "tension_dynamic_start": entering,
        "tension_start": machine.static[1][1] + entering,
        "tension_min": low,
    }


@pytest.mark.parametrize("way", ["waves", "bounded teeth", "teeth"])
@pytest.mark.parametrize("index", [1, 2, 3, *(pytest.param(k, marks=pytest.mark.study) for k in range(4, MACHINES))])
def test_the_bar_of_a_start_by_torque_with_a_driven_tail_holds(index: int, way: str) -> None:
    """Both sprockets and the drive are one mass, which a step of force brings to its speed."""
    toothed = way != "waves"
    machine = random_machine(index, synchronised=True, type="start")
    arm = machine.pitch * machine.teeth[0] / (2 * math.pi)
    pull = machine.pull
    force = abs(pull) * float(np.random.default_rng((SEED, 3, index)).uniform(0.3, 1.0))
    machine.data["drive"]["motor"]["mean_starting_torque"] = f"{(pull + force) * arm / 40!r} N*m"
    spec = built(machine.data | {"effects": WAYS[way][1]})
    (scene,) = spec.all_scenes
    solver = next(one for one in KIND.solvers if one.name == WAYS[way][0])
    claims = claim_of(plan_scene(KIND, spec, scene), spec, solver, solver.always, 0)
    result = solver.run(spec, scene, solver.always, 0)
    assert result.window is not None
    window = min(LATER * result.window[1], 8.0 if toothed else 30.0)
    coarse, fine = (stepped(machine, force, toothed, window, pieces) for pieces in (12, 24))
    for name, value in fine.items():
        slack = 1.5 * abs(value - coarse[name]) + 1e-3 * machine.static[1][1]
        one = claims[name]
        if one.bounded:
            assert one.low - slack <= value <= one.high + slack, (name, one)
    assert claims["tension_min"].low <= 0 or claims["tension_start"].bounded


# -- ranges of speeds -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("level", [0, 1])
@pytest.mark.parametrize("index", [1, 2, 3, 4, *(pytest.param(k, marks=pytest.mark.study) for k in range(5, MACHINES))])
def test_the_bar_of_a_speed_range_with_a_driven_tail_holds(index: int, level: int) -> None:
    """Both sprockets are turned faster or slower at a constant rate; the worst of all places of the joints counts."""
    rng = np.random.default_rng((SEED, 13, index))
    first, last, time = float(rng.uniform(0.1, 0.4)), float(rng.uniform(0.1, 0.4)), float(rng.uniform(1.0, 4.0))
    scene_data = {"from": f"{first!r} m/s", "to": f"{last!r} m/s", "time": f"{time!r} s"}
    machine = random_machine(index, type="speed_range", **scene_data)
    spec = built(machine.data)
    (scene,) = spec.all_scenes
    solver = next(one for one in KIND.solvers if one.name == "chain_run_through")
    claim = claim_of(plan_scene(KIND, spec, scene), spec, solver, solver.always, level)["tension_speed_range"]
    bar, (head, tail), rate = machine.working, machine.teeth, (last - first) / time
    element = bar.length / 32 * math.sqrt(bar.line_mass / bar.stiffness)
    times = np.arange(0.0, time, element / 2)
    gained: Motion = (rate * times**2 / 2, rate * times, np.full_like(times, rate))
    still: Motion = (np.zeros_like(times), np.zeros_like(times), np.zeros_like(times))
    whole: Motion = (first * times + gained[0], first + gained[1], gained[2])
    leads = [k / LEADS for k in range(LEADS)]
    near = [total(gained, teeth(whole, machine.pitch, head, lead)) for lead in leads] + [still] * LEADS
    far = [gained] * LEADS + [teeth(whole, machine.pitch, tail, lead) for lead in leads]
    found = moved_by_ends(bar, 32, float(times[1]), stacked(far), stacked(near), running=True)[:, -1]
    worst = max(float((found[:, i] + found[:, LEADS + j]).max()) for i in range(LEADS) for j in range(LEADS))
    assert claim.bounded
    assert claim.low * 0.98 <= max(worst, 0.0) <= claim.high * 1.02
    assert level == 0 or claim.high <= 3 * max(worst, 1e-3 * machine.static[1][1])


# -- stops ----------------------------------------------------------------------------------------------------------


def brake_force(machine: Machine, torque: float, times: np.ndarray) -> np.ndarray:
    """What is taken from the sprockets: the pull of the drive at once, the torque of the brake from 0.1 s on [N]."""
    arm = machine.pitch * machine.teeth[0] / (2 * math.pi)
    rises = np.clip((times - 0.1) / 0.2, 0.0, 1.0)
    return -(machine.pull + torque * 40 / arm * rises)


@pytest.mark.parametrize("way", ["chain_stop", "chain_stop_waves"])
@pytest.mark.parametrize("index", [0, 1, 2, 3, *(pytest.param(k, marks=pytest.mark.study) for k in range(4, MACHINES))])
def test_the_bar_of_a_stop_with_a_driven_tail_holds(index: int, way: str) -> None:
    """Both sprockets and the drive are one mass, which the force of the brake slows down until it rests."""
    machine = random_machine(index, 0.8, synchronised=True, type="stop")
    torque = 100.0
    data = machine.data | {"brake": {"torque": f"{torque} N*m", "delay": "0.1 s", "rise_time": "0.2 s"}}
    spec = built(data)
    (scene,) = spec.all_scenes
    solver = next(one for one in KIND.solvers if one.name == way)
    claims = claim_of(plan_scene(KIND, spec, scene), spec, solver, solver.always, 0)
    sprockets, whole = masses_of(machine)
    transit = machine.back.length * math.sqrt(machine.back.line_mass / machine.back.stiffness)
    dt = min(transit / 64, 2e-3)
    times = np.arange(0.0, 60.0, dt)
    forces = brake_force(machine, torque, times)
    rest = int(np.argmax(machine.speed + np.cumsum(forces) * dt / whole <= 0)) or len(times)
    found = on_one_shaft(machine.bars, not machine.fixed, sprockets, 32, dt, forces[: max(rest, 2)])
    slack = 2e-3 * machine.static[1][1]
    resting = [machine.resting(k, 32) for k in (0, 1)]
    low = min(float((part.min(axis=0) + at).min()) for part, at in zip(found, resting, strict=True))
    low = min(low, *machine.static[0], *machine.static[1])  # the chain runs until the drives are switched off
    high = max(float((part.max(axis=0) + at).max()) for part, at in zip(found, resting, strict=True))
    least = claims["tension_min"]
    assert least.low - slack <= low <= least.high + slack
    if least.low > 0:
        strong = safety(
            spec, max(high, *machine.static[0], *machine.static[1]) + machine.back.line_mass * machine.speed**2
        )
        assert claims["safety_start"].bounded
        assert claims["safety_start"].low <= strong * 1.01
        assert strong <= claims["safety_start"].high * 1.01
