"""Conveyors with several loading points: integrals along the route of random conveyors, finite elements of starts and
stops, and a conveyor computed by hand."""

import functools
import itertools
import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.linalg import eigh
from support.belt_scenes import Brake, Drive, loads_of
from support.loading_points import Point, PointedRig
from support.machines import changed, load_of, report_of, scene_of

from ptmcalc.contract.report import SceneReport

MACHINES, SEED = 64, 20261128
PARTS = 4_000
"""Parts of the route of the integrals."""
WIDTH, MIDDLE, ANGLE, SURCHARGE = 1.2, 0.465, math.radians(35), math.radians(15)
PITCHES = 1.2, 3.0


def drawn(index: int) -> tuple[PointedRig, bool]:
    """A random conveyor with two to four loading points, and whether its weight is at the tail."""
    rng = np.random.default_rng((SEED, index))
    lengths = rng.uniform(80, 400, int(rng.integers(1, 5))).tolist()
    sections = tuple((length, length * float(rng.uniform(-0.06, 0.12))) for length in lengths)
    speed = float(rng.uniform(1.5, 5))
    points = []
    for number in range(int(rng.integers(2, 5))):
        plates = (float(rng.uniform(0.5, 0.8)), float(rng.uniform(2, 6))) if rng.random() < 0.4 else None
        at = 0.0 if number == 0 and rng.random() < 0.5 else float(rng.uniform(0, 0.95)) * sum(lengths)
        points.append(Point(at, float(rng.uniform(20, 120)), float(rng.uniform(-1, 1.2 * speed)), plates))
    feeding = tuple(k for k in range(len(points)) if rng.random() < 0.7) if index % 2 else None
    rigid, at_tail = bool(rng.integers(2)), bool(rng.random() < 0.3)
    rig = PointedRig(
        sections=sections,
        points=tuple(points),
        feeding=feeding or None,
        speed=speed,
        belt=float(rng.uniform(12, 35)),
        tension=float(rng.uniform(60e3, 150e3)),
        rigid=rigid,
        own_force=float(rng.uniform(1e3, 6e3)) if rng.random() < 0.4 else None,
        drives={"head": Drive(torque=6000.0, count=2)},
    )
    return rig, at_tail and not rigid


def file_of(rig: PointedRig, at_tail: bool, curved: int) -> dict[str, Any]:
    scene: dict[str, Any] = {"type": "run"}
    if rig.feeding is not None:
        scene["loading_points"] = [rig.name_of(number) for number in rig.feeding]
    data = changed(
        rig.data(scene),
        belt__width=f"{WIDTH!r} m",
        idlers__carry__trough={"angle": "35 deg", "middle_roll": f"{MIDDLE!r} m"},
        load__surcharge_angle="15 deg",
        **{f"route__sections__{curved}__horizontal_curve": {"radius": "3000 m", "banking": "5 deg"}},
    )
    data["idlers"]["return"]["trough"] = {"angle": "15 deg", "middle_roll": "0 mm"}
    data["idlers"]["carry"] |= {
        "pitch": "1.2 m",
        "roll": {"diameter": "133 mm", "load_share": 0.6, "dynamic_factor": 1},
    }
    data["idlers"]["return"]["pitch"] = "3 m"
    return changed(data, takeup__at="tail") if at_tail else data


class Integral:
    """Sums over many short parts of the route, from the tail."""

    def __init__(self, rig: PointedRig, at_tail: bool) -> None:
        self.rig, self.at_tail = rig, at_tail
        marks = np.unique(np.concatenate([np.linspace(0, rig.span, PARTS + 1), rig.cuts()]))
        self.parts, self.middles = np.diff(marks), (marks[1:] + marks[:-1]) / 2
        ends = np.cumsum([length for length, _ in rig.sections])
        which = np.searchsorted(ends, self.middles)
        self.sections = which
        self.slopes = np.array([lift / length for length, lift in rig.sections])[which]
        self.empty, _, self.spans_empty = self.carried(())
        per = rig.friction * rig.gravity * (rig.secondary if rig.own_force is None else 1.0)
        cosines = np.sqrt(1 - self.slopes**2)
        rubs = per * (rig.belt * cosines + rig.back_idlers) - rig.belt * rig.gravity * self.slopes
        self.back = rubs * self.parts
        self.tail = rig.own_force or 0.0

    def carried(self, active: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Rise of the tension over each part [N], flow there [kg/s], weight on an idler pitch [N]."""
        rig = self.rig
        flow, forces = np.zeros(len(self.middles)), np.zeros(len(self.middles))
        for number in active:
            flow += rig.points[number].flow * (self.middles > rig.points[number].at)
        for number, point in enumerate(rig.points):
            length = min(rig.zone(number), rig.span - point.at)
            within = (self.middles > point.at) & (self.middles < point.at + length)
            if not within.any():
                continue
            if number in active and rig.accelerates(number):
                forces += within * point.flow * (rig.speed - point.speed) / length
            if point.plates:
                width, long = point.plates
                high = flow / (rig.density * rig.speed * width)
                forces += within * 0.6 * rig.density * rig.gravity * long * high**2 / length
        on_it = rig.belt + flow / rig.speed
        cosines = np.sqrt(1 - self.slopes**2)
        per = rig.friction * rig.gravity * (rig.secondary if rig.own_force is None else 1.0)
        rises = per * (on_it * cosines + rig.carry_idlers) + on_it * rig.gravity * self.slopes + forces
        return rises * self.parts, flow, on_it * cosines * rig.gravity * PITCHES[0]

    def around(self, carry: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Tension of the return strand and of the carrying strand at the ends of the parts, from the tail on."""
        up = np.concatenate([[0.0], np.cumsum(self.back[::-1])])
        over = up[-1] + self.tail + np.concatenate([[0.0], np.cumsum(carry)])
        start = self.rig.tension
        if self.rig.rigid:
            whole = self.parts[::-1] @ (up[1:] + up[:-1]) / 2 + self.parts @ (over[1:] + over[:-1]) / 2
            start -= whole / (2 * self.rig.span)
        if self.at_tail:
            start -= up[-1] + self.tail / 2
        return start + up[::-1], start + over

    def extremes(self, section: int, active: tuple[int, ...]) -> tuple[float, float]:
        """Least and largest tension of the carrying strand in a section, whatever lies where: by parts."""
        some = [one for count in range(len(active) + 1) for one in itertools.combinations(active, count)]
        gains = np.array([self.carried(one)[0] - self.empty for one in some])
        low, high = gains.min(axis=0), gains.max(axis=0)
        _, base = self.around(self.empty)
        ends = np.flatnonzero(self.sections == section)
        found = []
        whole = np.sum(self.parts)
        rest = (whole - np.cumsum(self.parts) + self.parts / 2) / (2 * whole)
        marks = np.searchsorted(self.middles, self.rig.cuts())
        for place in {*range(ends[0], ends[-1] + 2, max(len(ends) // 20, 1)), ends[-1] + 1, *marks}:
            if not ends[0] <= place <= ends[-1] + 1:
                continue
            weight = (np.arange(len(self.parts)) < place).astype(float)
            if self.rig.rigid:
                weight -= rest
            least = np.minimum(weight * low, weight * high).sum()
            most = np.maximum(weight * low, weight * high).sum()
            found.append((base[place] + least, base[place] + most))
        return min(low for low, _ in found), max(high for _, high in found)


def held_by_trough(slope: float) -> float:
    """Cross-section of a full trough with three rolls and a parabola on it, by ISO 5048 [m^2]."""
    wide = 0.9 * WIDTH - 0.05
    across = MIDDLE + (wide - MIDDLE) * math.cos(ANGLE)
    heap = across**2 * math.tan(SURCHARGE) / 6
    water = (MIDDLE + (wide - MIDDLE) / 2 * math.cos(ANGLE)) * (wide - MIDDLE) / 2 * math.sin(ANGLE)
    steep = abs(slope)
    cosine = math.cos(steep) ** 2 - math.cos(SURCHARGE) ** 2
    return water + heap * math.sqrt(cosine / (1 - math.cos(SURCHARGE) ** 2))


@pytest.mark.parametrize("index", range(MACHINES))
def test_steady_running_is_the_integral_along_the_route(index: int) -> None:
    rig, at_tail = drawn(index)
    curved = index % len(rig.sections)
    scene = scene_of(report_of(file_of(rig, at_tail, curved)))
    sums, active = Integral(rig, at_tail), rig.active
    carry, flow, weights = sums.carried(active)
    back, over = sums.around(carry)
    whole = carry.sum() + sums.back.sum() + sums.tail
    steps = [
        sums.carried(some)[0] for count in range(len(active) + 1) for some in itertools.combinations(active, count)
    ]
    known = {
        "tension_run_on_max": over[-1],
        "tension_run_off_min": back[-1],
        "tension_max": max(back.max(), over.max()),
        "tension_min": min(back.min(), over.min()),
        "effective_tension": whole,
        "effective_tension_worst": np.max(steps, axis=0).sum() + sums.back.sum() + sums.tail,
        "power_drive_running": whole * rig.speed,
        "roll_load_max[carry]": 0.6 * weights.max() + rig.carry_idlers * PITCHES[0] * rig.gravity / 3,
        "section_fill": max(
            flow[sums.sections == k].max() / (rig.density * rig.speed * held_by_trough(math.asin(lift / length)))
            for k, (length, lift) in enumerate(rig.sections)
        ),
    }
    ends = np.minimum(over[1:], over[:-1])
    sags = np.where(ends > 0, weights / (8 * np.where(ends > 0, ends, 1)), np.inf)
    for k in range(len(rig.sections)):
        known[f"sag_carry[{k + 1}]"] = sags[sums.sections == k].max()
    least, most = sums.extremes(curved, active)
    known[f"tension_bend_min[{curved + 1}_carry_full]"] = known[f"tension_bend_min[{curved + 1}_carry_empty]"] = least
    known[f"tension_bend_max[{curved + 1}_carry_full]"] = known[f"tension_bend_max[{curved + 1}_carry_empty]"] = most
    size = max(abs(over).max(), abs(back).max())
    for name, value in known.items():
        found = load_of(scene, name).estimate
        scale = size if name.startswith(("tension", "effective")) else abs(value)
        assert found.low <= found.value <= found.high
        assert found.value == pytest.approx(value, abs=(3e-4 if name.startswith("sag") else 3e-5) * scale), name


# --- motion ----------------------------------------------------------------------------------------------------------

HILL = PointedRig(
    sections=((300.0, 0.0), (300.0, 24.0)),
    points=(Point(0.0, 200.0), Point(330.0, 300.0, 1.0)),
    drives={"head": Drive(torque=4800.0)},
    start_factor=1.2,
    brakes=(Brake(14e3, delay=1.0, rise=1.5),),
)
SIDE = replace(HILL, feeding=(1,))
THREE = replace(HILL, points=(Point(40.0, 150.0), Point(200.0, 150.0, 3.0), Point(330.0, 200.0, 1.0)), rigid=True)
RAMP_TIME = 3.0
RAMP = {"shape": "ramp", "control": "torque", "time": f"{RAMP_TIME} s"}
COARSE, FINE = 240, 480


def started(rig: PointedRig, window: float, elements: int) -> Any:
    return rig.started(lambda time: min(time / RAMP_TIME, 1.0), window, elements)


def stopped(rig: PointedRig, window: float, elements: int) -> Any:
    return rig.stopped(window, elements)


CASES: dict[str, tuple[PointedRig, dict[str, Any], Callable[[PointedRig, float, int], Any]]] = {
    "start, all points": (HILL, {"type": "start", "profile": RAMP}, started),
    "start, side belt": (SIDE, {"type": "start", "profile": RAMP, "loading_points": ["point_1"]}, started),
    "stop, all points": (HILL, {"type": "stop"}, stopped),
    "stop, side belt": (SIDE, {"type": "stop", "loading_points": ["point_1"]}, stopped),
    "stop, three points, screw": (replace(THREE, tension=190e3), {"type": "stop"}, stopped),
}


@functools.cache
def told(case: str) -> SceneReport:
    rig, scene, _ = CASES[case]
    return scene_of(report_of(rig.data(scene)))


@pytest.mark.parametrize("case", CASES)
def test_starts_and_stops_are_those_of_finite_elements(case: str) -> None:
    rig, _, motion = CASES[case]
    window = load_of(told(case), "tension_max").window
    assert window is not None
    coarse, fine = (loads_of(rig, motion(rig, window[1], elements)).loads for elements in (COARSE, FINE))
    seen = 0
    for load in told(case).loads:
        name = load.info.name
        if name not in fine or not load.estimate.bounded:
            continue
        seen += 1
        own = 2 * abs(fine[name] - coarse[name])
        size = fine["tension_max"] if name.startswith("tension") else abs(fine[name])
        slack = own + 1e-9 * size
        assert load.estimate.low - slack <= fine[name] <= load.estimate.high + slack, (name, fine[name], load.estimate)
        apart = abs(fine[name] - load.estimate.value)
        assert apart <= (0.05 if name.startswith("slip") else 0.01) * size + own, (name, fine[name], load.estimate)
    assert seen >= 7


def test_natural_frequencies_are_those_of_lumped_masses_where_they_are() -> None:
    scene = told("start, all points")
    found = [load_of(scene, f"natural_frequency[{number}]").estimate.value for number in (1, 2, 3)]
    lengths, masses, stiffs = HILL.lengths(), [], []
    for one in lengths:
        count = max(round(one.length / 0.5), 1)
        masses += [one.line_mass * one.length / count] * count
        stiffs += [one.stiffness * count / one.length] * count
    tail = sum(max(round(one.length / 0.5), 1) for one in lengths[: len(lengths) // 2])
    diagonal = np.concatenate([[0.0], masses]) / 2 + np.concatenate([masses, [0.0]]) / 2
    diagonal[tail] += HILL.tail_mass
    diagonal[-1] += HILL.drives["head"].mass
    sums = np.concatenate([stiffs, [0.0]]) + np.concatenate([[0.0], stiffs])
    matrix = np.diag(sums) - np.diag(stiffs, 1) - np.diag(stiffs, -1)
    roots = np.sqrt(np.abs(eigh(matrix, np.diag(diagonal), eigvals_only=True, subset_by_index=(0, 3))))
    assert found == pytest.approx(roots[1:4].tolist(), rel=1e-4)


# --- horizontal curves -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("code", ["CNV150", "CNV151"])
def test_the_drift_is_at_least_that_of_every_choice_of_points(code: str) -> None:
    """Each choice alone is one of the partial loadings: less load, or less tension, may drift further."""

    def drift(feeding: tuple[int, ...] | None) -> float:
        data = file_of(replace(HILL, rigid=False, feeding=feeding), False, 1)
        data = changed(data, route__sections__1__horizontal_curve={"radius": "3000 m", "banking": "5 deg"})
        (found,) = [one for one in scene_of(report_of(data)).checks if (one.code, one.element) == (code, "2_carry")]
        assert found.value is not None
        return found.value.value

    every = drift(None)
    some = [drift(feeding) for feeding in ((0,), (1,), (0, 1))]
    assert every >= max(some) - 1e-9
