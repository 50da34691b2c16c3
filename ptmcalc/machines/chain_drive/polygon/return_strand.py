"""The return strand in front of a driven tail: both sprockets move it, and nothing of it reaches the working strand.

It is a chain of its own. Against the travel it starts at the run-on of the tail. It ends at the run-off of the drive
where a screw keeps its length, at a constant tension where a weight keeps that. A drive that gives way moves the
working strand alone: the return strand takes its sprocket at constant speed.
"""

from dataclasses import dataclass

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout
from ptmcalc.machines.chain_drive.machine.model import (
    FloatArray,
    chain_line,
    damping,
    has_driven_tail,
    held_frequencies,
    tail_teeth,
)
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.machines.chain_drive.machine.strength import STILL
from ptmcalc.machines.chain_drive.polygon.excitation import (
    FAR,
    ended,
    excites_far,
    harmonics,
    peaks_of,
    residual,
    still,
    tooth_frequency,
)
from ptmcalc.numerics.harmonic import parts
from ptmcalc.numerics.harmonic.parts import Chain, Excitation
from ptmcalc.numerics.harmonic.response import polygon_response


@dataclass(frozen=True, slots=True)
class OfReturn:
    """Largest and smallest dynamic tension of the return strand at the tail and at the run-off [N]."""

    tail_largest: Estimate = STILL
    tail_smallest: Estimate = STILL
    off_largest: Estimate = STILL
    off_smallest: Estimate = STILL
    bound: float = 0.0


def return_chain(spec: ChainDrive, scene: Run) -> Chain | None:
    """The return strand of a driven tail; None without one."""
    if not has_driven_tail(spec):
        return None
    line = chain_line(spec, scene)
    own = parts.Line(line.back.length, line.back.line_mass, line.back.stiffness)
    if line.fixed_length:
        return Chain((own,), damping(spec, scene), parts.HELD)
    return Chain((own,), damping(spec, scene), parts.FREE, far_mass=line.takeup_mass / 4)


_LIGHT = 1e-12
"""Mass at the end of a strand with constant tension relative to that of the strand [1]. A numerical choice, as 0 would
divide by 0. A larger value lowers the frequencies by this share."""


def return_frequencies(spec: ChainDrive, scene: Run, count: int) -> FloatArray:
    """Its lowest natural circular frequencies, the tail held, shape (count,) [rad/s]."""
    line = chain_line(spec, scene)
    mass = np.inf if line.fixed_length else max(line.takeup_mass / 4, _LIGHT * line.back.mass)
    return held_frequencies(line.back, mass, count)


def return_place(spec: ChainDrive) -> float | None:
    """Place of the joints at the run-off of the drive relative to those at the run-on of the tail [1]; None where the
    phase is unknown. Either is half a turn away from the other side of its sprocket."""
    assert isinstance(spec.layout, ConveyorLayout)
    phase = spec.layout.tail.phase
    return None if phase is None else (spec.sprocket.teeth / 2 - tail_teeth(spec) / 2 - phase) % 1.0


def return_excitations(
    spec: ChainDrive, chain: Chain, carried: frozenset[str], count: int
) -> tuple[Excitation, Excitation | None]:
    """Of the tail, and of the drive where it moves the other end."""
    speeds = np.array([spec.speed])
    tail = Excitation(harmonics(spec, speeds, tail_teeth(spec), 1.0, count))
    tail = tail if FAR in carried else still(tail)
    if not excites_far(spec, chain):
        return tail, None
    return tail, Excitation(
        harmonics(spec, speeds, spec.sprocket.teeth, residual(spec), count), return_place(spec) or 0.0
    )


def of_return(spec: ChainDrive, scene: Run, carried: frozenset[str], count: int) -> OfReturn:
    """Dynamic tensions of the return strand of a driven tail in steady running; 0 without one."""
    chain = return_chain(spec, scene)
    if chain is None:
        return OfReturn()
    near, far = return_excitations(spec, chain, carried, count)
    w, placed = tooth_frequency(spec, [spec.speed]), return_place(spec) is not None
    ends = [peaks_of(chain, w, near, far, placed, at_far_end=end) for end in _ends(spec, chain)]
    bound = float(max(one.bound[0] for one in ends))
    at_tail = ended(ends[0])
    off = ended(ends[1]) if len(ends) == 2 else (STILL, STILL)
    return OfReturn(at_tail[0], at_tail[1], off[0], off[1], bound)


def return_bound(spec: ChainDrive, scene: Run, carried: frozenset[str], count: int, near: bool) -> float:
    """Sum of the absolute terms of that tension at the larger end: of both sprockets, or of the tail alone [N]."""
    chain = return_chain(spec, scene)
    if chain is None:
        return 0.0
    tail, drive = return_excitations(spec, chain, carried, count)
    if drive is not None and not near:
        drive = still(drive)
    w = tooth_frequency(spec, [spec.speed])
    return max(float(polygon_response(chain, w, tail, drive, at_far_end=end).bound[0]) for end in _ends(spec, chain))


def _ends(spec: ChainDrive, chain: Chain) -> tuple[bool, ...]:
    """Which ends have a force: that of the tail, and the other one where something moves it."""
    return (False, True) if excites_far(spec, chain) else (False,)
