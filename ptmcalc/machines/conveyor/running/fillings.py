"""Tensions of a steadily running belt over all that its loading points can put on it."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce

import numpy as np

from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.drives import running
from ptmcalc.machines.conveyor.machine.loading import Piece, choices, in_operation, load_line_mass, pieces
from ptmcalc.machines.conveyor.machine.model import BeltLine, FloatArray, carried_on
from ptmcalc.machines.conveyor.machine.resistances import extra_forces
from ptmcalc.machines.conveyor.machine.scenes import Run
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.numerics.lanes import number


@dataclass(frozen=True, slots=True)
class Option:
    """What may lie on each length of the belt, over the empty one: added to the tension of the carrying strand at the
    downstream end of the length, and at all places [N], and to that of the return strand [N]."""

    pulls: FloatArray
    everywhere: FloatArray
    back: FloatArray


@dataclass(frozen=True, slots=True)
class Fillings:
    """The belt over all choices of what lies on each length: the empty belt, the other options of each length, and the
    marks between the lengths [m]; `sections` are the first length of each section of the file, and its end."""

    empty: BeltLine
    options: tuple[Option, ...]
    marks: FloatArray
    sections: tuple[int, ...]
    own: bool
    """whether a section is loaded all over or not at all; else the material on a part of it moves along"""

    def at(self, places: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Least and most tension at places along the carrying strand [m].

            S(x) = S(0) + sum_k dS_k;   least: the smallest dS_k that the length k can have,   most: the largest one

        **Source** `laws.strand_tension.worst_loading`: a linear function on a cube has its extreme at a corner.
        """
        base = self.empty.static(CARRY, places / self.empty.carry.length)
        gains = self._gains(places)
        least, most = (_extreme(which, gains) for which in (np.minimum, np.maximum))
        return base + least.sum(axis=1), base + most.sum(axis=1)

    def within(self, section: int, loaded: bool) -> tuple[float, float]:
        """Least and most tension in a section, counted from 0, that is itself loaded or empty [N].

        In a length of one load the tension is linear between its ends, whatever else is loaded. Where material moves
        along the section, the rest of it carries whatever makes the tension at a place extreme: over a length the most
        is convex and the least concave, so that the ends have the extremes.
        """
        places = self.marks[self.sections[section] : self.sections[section + 1] + 1]
        if not self.own:
            least, most = self.at(places)
            return number(least.min()), number(most.max())
        gains = self._gains(places)
        base = self.empty.static(CARRY, places / self.empty.carry.length) + (gains[0][:, section] if loaded else 0.0)
        others = [np.delete(one, section, axis=1) for one in gains]
        least, most = (base + _extreme(which, others).sum(axis=1) for which in (np.minimum, np.maximum))
        return number(least.min()), number(most.max())

    def _gains(self, places: FloatArray) -> list[FloatArray]:
        """What the options add to the tension at places [N]."""
        passed = np.clip((places[:, None] - self.marks[:-1]) / np.diff(self.marks), 0, 1)
        return [passed * one.pulls + one.everywhere for one in self.options]

    def on_return(self, section: int) -> tuple[float, float]:
        """Least and most tension of the return strand below a section, counted from 0 [N]."""
        ends = self.marks[[self.sections[section], self.sections[section + 1]]]
        base = self.empty.static(RETURN, (self.empty.back.length - ends) / self.empty.back.length)
        least, most = (_extreme(which, [one.back for one in self.options]) for which in (np.minimum, np.maximum))
        return number(base.min() + least.sum()), number(base.max() + most.sum())


def _extreme(which: Callable[..., FloatArray], gains: list[FloatArray]) -> FloatArray:
    """The smallest or the largest of the options and of nothing."""
    return reduce(which, gains[1:], which(gains[0], 0))


def fillings(spec: Conveyor, scene: Run) -> Fillings:
    """All fillings of a conveyor in steady running.

    Each length between places where the load may change carries what any of the loading points in operation before it
    may bring, whatever lies on the others: every point on or off at any time, its material moving along. A belt without
    loading points is loaded section by section. A load adds its pull to the tension downstream of it, less the share
    that drives at the tail take; in a fixed loop the mean of that is taken off everywhere. All is linear in the pull of
    each length; on the curves of motors the share of the tail is the secant between the empty and the full belt.
    """
    curves = spec.route.curves
    cuts = [curve.place + side * curve.tangent for curve in curves for side in (-1, 1)]
    lengths = pieces(spec, cuts)
    feeding = in_operation(spec, scene)
    kept = pieces(spec)
    empty, full = (
        running(spec, scene, [tuple(name for name in one.points if name in some) for one in kept])
        for some in ((), feeding)
    )
    marks = np.array([*(one.start for one in lengths), full.carry.length])
    load_at_tail = full.tail_force - empty.tail_force
    share = 0.0
    if full.tail_pull or empty.tail_pull:
        more = full.tail_pull - empty.tail_pull
        pulled = full.static_resistance - empty.static_resistance + more
        share = more / pulled if pulled else 0.0
    options = []
    for pulls in pulls_of(spec, scene, lengths):
        everywhere = np.array([load_at_tail] + [0.0] * (len(lengths) - 1))
        options.append(_option(full, marks, np.array(pulls), everywhere, share))
    firsts = [next(k for k, one in enumerate(lengths) if one.section == n) for n in range(len(spec.route.parts))]
    own = spec.load.loading_points is None
    return Fillings(empty, tuple(options), marks, (*firsts, len(lengths)), own)


def _option(full: BeltLine, marks: FloatArray, pulls: FloatArray, everywhere: FloatArray, share: float) -> Option:
    """What pulls of each length, and forces at the tail, add all round the loop."""
    if share:
        everywhere = everywhere - share * (pulls + everywhere)
    step, whole = everywhere, full.carry.length
    if full.weight_at_tail:  # half of what the load adds at the tail pulley lowers the tension before it
        everywhere = everywhere / 2
    if full.fixed_length:
        rest = np.diff(marks) / 2 + whole - marks[1:]
        everywhere = everywhere - (pulls * rest + everywhere * whole) / (whole + full.back.length)
    return Option(pulls, everywhere, everywhere - step)


def pulls_of(spec: Conveyor, scene: Run, lengths: tuple[Piece, ...]) -> list[list[float]]:
    """Options of what a load adds to the tension over each length [N]: of the full one, or of the choices of loading
    points the smallest and the largest, where 0 is one too.

    Between loading zones the pull is linear in the load: all points or none are the extremes.
    """
    extra, feeding = extra_forces(spec, load_line_mass(spec)), in_operation(spec, scene)
    every: list[list[float]] = []
    for one in lengths:
        names = tuple(name for name in one.points if name in feeding)
        some = choices(names) if one.zones else ((), names)
        ends = [carried_on(spec, scene, one, these, extra) for these in some]
        rises = [end.friction + end.climb for end in ends]
        every.append([rise - rises[0] for rise in rises])
    if spec.load.loading_points is None:
        return [[gains[1] for gains in every]]
    return [[min(gains) for gains in every], [max(gains) for gains in every]]
