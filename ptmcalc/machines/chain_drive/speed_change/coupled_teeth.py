"""Teeth that pass while motors follow their curve: chain, drive and motors in one run."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.memory import kept_for
from ptmcalc.laws import chain_resonance, loop_bounds
from ptmcalc.laws.loop_bounds import CARRY
from ptmcalc.machines.chain_drive.machine.alike import moving_alike
from ptmcalc.machines.chain_drive.machine.model import FloatArray, has_driven_tail
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Start
from ptmcalc.machines.chain_drive.polygon.excitation import residual
from ptmcalc.machines.chain_drive.starting.bounds import static_at
from ptmcalc.machines.chain_drive.starting.motor_curve_waves import (
    LEFT,
    ORDERS,
    RESPONSE,
    CurveStart,
    between_sections,
    curve_start_of,
    judged,
    unfollowed,
)
from ptmcalc.machines.chain_drive.starting.rigid_curve import rigid_start
from ptmcalc.machines.chain_drive.starting.waves import Sections, position_of, sections_of
from ptmcalc.numerics import toothed_modes
from ptmcalc.numerics.driven_body import Followed, Places, Plan
from ptmcalc.numerics.toothed_modes import Teeth

_LEADS = 4
"""Positions of the first joint within the pitch at the coarsest level; twice as many at each finer one. A numerical
choice: the difference from half as many is in the error bar. More narrow it and take longer."""
_EVERY = 2
"""Every so many positions are run with longer steps and with fewer modes; a numerical choice."""
_MOST = 10_000
"""Most steps of one march. A numerical choice: a start that takes more keeps the bound of both limiting drives."""
_ROUND_ABOUT = 2.0
"""Predicted time of a march relative to that of the rigid start [1]."""
_SECONDS, _PER_ENGAGEMENT = 2e-4, 1e-4
"""Predicted seconds per step, and per tooth and mode; measured once. Only the ratio to those of other solvers matters:
a wrong value changes their order, no load."""
_PER_TOOTH = 16.0
"""Steps per tooth at the highest speed, twice as many at each finer level. A numerical choice: the difference from
steps twice as long is in the error bar. More take longer."""


@dataclass(frozen=True, slots=True)
class Coupled:
    """A start with the teeth of its driving sprocket: largest dynamic entering tension and smallest tension anywhere
    [N], when and where they act, first joint behind the largest [pitches], end [s], steps."""

    largest: Estimate
    smallest: Estimate
    time: float
    where: dict[str, float]
    lead: float
    end: float
    steps: int


def polygon_ahead(spec: ChainDrive) -> Callable[[float], tuple[float, float, float]]:
    """How far the entering chain is ahead of the mean motion of its sprocket, with two derivatives over the travel.

    u = R sin(phi) - p x,   phi = 2 h x,   h = pi/z
    """
    share, pitch, half = residual(spec), spec.chain.pitch, math.pi / spec.sprocket.teeth
    radius, turn = pitch / (2 * math.sin(half)), 2 * half / pitch

    def ahead(place: float) -> tuple[float, float, float]:
        sine, cosine = math.sin(2 * half * place), math.cos(2 * half * place)
        return (
            share * (radius * sine - pitch * place),
            share * (radius * turn * cosine - 1),
            -share * radius * turn**2 * sine,
        )

    return ahead


def _places(start: CurveStart, sections: Sections) -> Places:
    """Tensions at the entering strand and at sections."""
    loop, w = start.case.masses, start.body.frequencies
    whole = loop.total_mass
    all_places: Sections = ((CARRY, np.ones(1)), *sections)
    gains = np.concatenate([chain_resonance.modal_tensions(loop, w, *one) for one in all_places], axis=1)
    quasi = np.concatenate([loop_bounds.quasi_static(loop, *one) for one in all_places])
    rest = np.concatenate([chain_resonance.modal_rest(loop, w, *one) for one in all_places])
    return Places(gains / whole, quasi / whole, rest / whole, np.zeros(len(quasi)))


@dataclass(frozen=True, slots=True)
class _Marched:
    """A start as marches with teeth take it."""

    start: CurveStart
    sections: Sections
    places: Places
    plan: Plan
    pitch: float
    ahead: Callable[[float], tuple[float, float, float]]

    def run(self, plan: Plan, lead: float) -> Followed:
        start, teeth = self.start, Teeth(self.start.case.masses.drive_mass, self.pitch, lead, self.ahead)
        return toothed_modes.follow(start.body, start.gear, start.force, self.places, plan, teeth)


def _step(spec: ChainDrive, start: CurveStart, fastest: float, level: int) -> float:
    """Longest step [s]."""
    step: float = min(start.step, spec.chain.pitch / (_PER_TOOTH * 2.0**level * fastest))
    steep = max(start.force.steepest(stage) for stage in range(len(start.force.motors.stages)))
    return min(step, RESPONSE * start.body.drive_mass / steep) if steep > 0 else step


def _marched(spec: ChainDrive, scene: Start, level: int) -> _Marched | None:
    """The start of a level; None where the teeth do not run with the motors.

    It ends two stretches after that without teeth: each two teeth and one period of the lowest mode long, or longer.
    """
    start, rigid = curve_start_of(spec, scene, level), rigid_start(spec, scene)
    if rigid is None or has_driven_tail(spec) or start.case.masses.fixed_length:
        return None
    body, pitch, running = start.body, spec.chain.pitch, float(rigid.speeds[-1])
    step = _step(spec, start, rigid.fastest, level)
    end = judged(spec, scene, level).end
    stretch = max(2 * pitch / running if running > 0 else 0.0, 2 * math.pi / float(body.frequencies[0]))
    marks = (end, end + stretch)
    if (marks[1] + stretch - start.force.release) / step > _MOST:
        return None
    sections = sections_of(start.case, len(body.frequencies))
    left = LEFT * abs(start.case.line.run_on)
    plan = Plan(
        start.force.release, step, RESPONSE, left, len(body.frequencies), latest=marks[1] + stretch, marks=marks
    )
    return _Marched(start, sections, _places(start, sections), plan, pitch, polygon_ahead(spec))


def coupled_teeth(spec: ChainDrive, scene: Start, level: int) -> Coupled | None:
    """The teeth of the driving sprocket in one run with chain and motors; None where they are not.

    Raises:
        NumericsError: NUM101 where the start takes too many steps.
    """
    return _coupled_teeth(*moving_alike(spec, scene), level)


@kept_for(16)
def _coupled_teeth(spec: ChainDrive, scene: Start, level: int) -> Coupled | None:
    """The same of the machine that represents all that move alike."""
    whole = _marched(spec, scene, level)
    if whole is None:
        return None
    body, plan = whole.start.body, whole.plan
    count, half = _LEADS << level, max(len(body.frequencies) // 2, 1)
    leads = [k / count for k in range(count)]
    fine = [whole.run(plan, lead) for lead in leads]
    middle, coarse, fewer = (
        [whole.run(one, lead) for lead in leads[::_EVERY]]
        for one in (plan.coarser(2), plan.coarser(4), replace(plan.coarser(4), felt=half))
    )
    first, second = _apart(fine[::_EVERY], middle), _apart(middle, coarse)
    order = min(max(math.log2(second / first), ORDERS[0]), ORDERS[1]) if 0 < first < second else ORDERS[0]
    off = (first / (2**order - 1) if first else 0.0) + unfollowed(body, half) * _apart(coarse, fewer)
    return _with_bars(whole, fine, off, judged(spec, scene, level).late)


def entering(spec: ChainDrive, scene: Start, level: int, lead: float) -> tuple[FloatArray, FloatArray]:
    """Times [s] and dynamic entering tensions [N] of a start with a first joint."""
    whole = _marched(spec, scene, level)
    assert whole is not None
    found = replace(whole, places=_places(whole.start, ())).run(replace(whole.plan, keep=True), lead)
    seen = np.concatenate([np.zeros((1, 2)), *found.samples])
    return seen[:, 0], seen[:, 1]


def _apart(some: list[Followed], others: list[Followed]) -> float:
    """Largest difference of an extreme of marches with the same first joints [N]."""
    return max(
        max(float(np.abs(one.largest - other.largest).max()), float(np.abs(one.smallest - other.smallest).max()))
        for one, other in zip(some, others, strict=True)
    )


def _with_bars(whole: _Marched, found: list[Followed], off: float, late: tuple[float, float]) -> Coupled:
    """The loads of marches with several first joints.

    The largest of all first joints is at least that of those looked at; what it may exceed it by is the difference
    from half as many. Steady teeth are periodic: what comes after the end exceeds the last stretch by what is left of
    the start, twice, and by as much as this stretch exceeds the one before.
    """
    start, sections = whole.start, whole.sections
    tops = np.array([one.largest[0] for one in found])
    which = int(tops.argmax())
    bound = max(float(one.largest_high[0]) for one in found)
    low, value = max(float(one.largest_low[0]) for one in found), float(tops.max())
    apart = value - float(min(tops[::2].max(), tops[1::2].max()))
    before, last = (max(float(one.parts_high[part][0]) for one in found) for part in (1, 2))
    high = max(bound, value, last + max(last - before, 0.0) + 2 * late[0]) + off + apart
    largest = Estimate(value, max(min(low, value) - off, 0.0), high, numerical=off + apart)

    static = np.concatenate([static_at(start.case, strand, x) for strand, x in sections])
    values = np.array([static + one.smallest[1:] for one in found])
    lead, section = (int(one) for one in np.unravel_index(int(values.argmin()), values.shape))
    dips, between = values.min(axis=1), max(between_sections(start, sections, one) for one in found)
    value = float(dips.min())
    apart = float(max(dips[::2].min(), dips[1::2].min())) - value
    bound = min(float((static + np.minimum(one.smallest_low[1:] - between, 0.0)).min()) for one in found)
    falls = [np.min([one.parts_low[part][1:] for one in found], axis=0) - between for part in (1, 2)]
    after = static + falls[1] + np.minimum(falls[1] - falls[0], 0.0) - 2 * late[1]
    low = min(bound, value, float(after.min())) - off - apart
    high = max(
        min(min(float((static + one.smallest_high[1:]).min()) for one in found) + off, float(static.min())), value
    )
    smallest = Estimate(value, low, high, numerical=max(value - low, high - value))
    where = {
        "time": float(found[lead].smallest_time[1 + section]),
        "position": position_of(start.case, sections, section),
    }
    at = float(found[which].largest_time[0])
    steps = sum(one.steps for one in found)
    return Coupled(largest, smallest, at, where, which / len(found), found[which].end, steps)


def coupled_cost(spec: ChainDrive, scene: Start, level: int) -> float | None:
    """Predicted seconds of all marches; None where there are none."""
    start, rigid = curve_start_of(spec, scene, level), rigid_start(spec, scene)
    if rigid is None or has_driven_tail(spec) or start.case.masses.fixed_length:
        return None
    steps = _ROUND_ABOUT * (rigid.end - rigid.release) / _step(spec, start, rigid.fastest, level)
    if steps > _MOST:
        return None
    marches = (_LEADS << level) * (1 + 1 / _EVERY)
    teeth = float(rigid.travels[-1]) / spec.chain.pitch
    return marches * (_SECONDS * steps + _PER_ENGAGEMENT * teeth * len(start.body.frequencies))
