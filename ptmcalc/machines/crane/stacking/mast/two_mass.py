"""The column as two coupled masses, marched from event to event: one shape, the consistent masses of it."""

import math

import numpy as np

from ptmcalc.base.memory import remembered
from ptmcalc.laws import mast as law
from ptmcalc.machines.crane.stacking.machine.columns import Swinging, swinging
from ptmcalc.machines.crane.stacking.machine.scenes import DrivenScene, StackerScene
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.machine.travelling import push_of
from ptmcalc.machines.crane.stacking.mast import march
from ptmcalc.machines.crane.stacking.mast.march import Happening
from ptmcalc.numerics.mast.assumed import one_shape
from ptmcalc.numerics.mast.case import Case
from ptmcalc.numerics.mast.modes import Mast
from ptmcalc.numerics.mast.parts import Column
from ptmcalc.numerics.mast.run import Course, play

SWINGS = 3.0
"""Periods of the column beside a base at rest that are looked at after the event."""
_DOUBLINGS = 5
"""Most extensions [1] of the simulated time until the base is held permanently, as in `mast_modal`. A numerical choice:
fewer miss a late standstill, more allow longer runs."""
_MOST_WORK = 2e4
"""Panels of a run that nobody looks at: a column that rings some thousand times before it lets its base rest is left to
the others, and bounds nothing."""


def lumped(spec: Stacker, scene: StackerScene, moves: Happening, gravity: bool, heavier: float = 1.0) -> Mast:
    """The column of a scene that keeps to the shape of a force at its far end.

    `heavier`: factor on the mass that swings beside a base at rest, by which a frequency may be set right.
    """
    return _lumped(swinging(spec, scene, push_of(spec, scene).rotors), moves.column.column, gravity, heavier)


def _lumped(given: Swinging, column: Column, gravity: bool, heavier: float) -> Mast:
    gives, one = given.compliance, given.exact
    rotation, translation = gives.rotation_share, gives.translation_share

    def shape(place: float) -> float:
        return float(law.tip_shape(place / one.length, rotation, translation))

    _, both, square = given.masses
    mean = both + square
    on_column = given.total - one.base_mass
    at = one.place * one.length
    bent = translation / 2 + rotation / 3 + (1 - rotation - translation) * law.FIRST_MOMENT
    turned = one.tip_mass * at * shape(at) + one.column_mass * one.length * bent
    pull = column.pull if gravity else 0.0
    return one_shape(
        column,
        shape,
        given.stiffness + (given.weight if gravity else 0.0),
        (square * heavier, mean),
        on_column,
        (one.tip_mass * at + one.column_mass * one.length / 2, turned, pull * (mean - translation * on_column)),
    )


def course_of(spec: Stacker, scene: DrivenScene, gravity: bool, heavier: float = 1.0, *, keep: bool = False) -> Course:
    """A start or a stop of two masses, until the base is held for good and some swings beyond."""
    moves = march.happening(spec, scene, gravity=gravity)
    given = swinging(spec, scene, push_of(spec, scene).rotors)
    if keep:
        case = _case(given, moves, gravity, heavier, spec.column.log_decrement)
        return _until_held(case, moves, scene.window_factor, keep)
    return _course(given, moves, gravity, heavier, spec.column.log_decrement, scene.window_factor)


@remembered(64)
def _course(
    given: Swinging, moves: Happening, gravity: bool, heavier: float, decrement: float | None, factor: float
) -> Course:
    """Every bound asks for the same few; another limit in the file makes no other machine."""
    return _until_held(_case(given, moves, gravity, heavier, decrement), moves, factor, keep=False)


def _case(given: Swinging, moves: Happening, gravity: bool, heavier: float, decrement: float | None) -> Case:
    two = _lumped(given, moves.column.column, gravity, heavier)
    ratios = np.array([march.damping_ratio(decrement, moves, two)])
    return Case(two, ratios, moves.base, (given.exact.length,))


def _until_held(case: Case, moves: Happening, factor: float, keep: bool) -> Course:
    after = factor * SWINGS * 2 * math.pi / float(case.mast.frequencies[0])
    end = moves.lasts + after
    most = math.inf if keep else _MOST_WORK
    course = play(case, end, keep=keep, most_work=most)
    for _ in range(_DOUBLINGS):
        since = course.held_since
        if since + after <= course.record.time * (1 + 1e-9):
            break
        end = since + after if math.isfinite(since) else 2 * end
        course = play(case, end, keep=keep, most_work=most)
    return course
