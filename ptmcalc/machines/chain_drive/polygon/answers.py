"""Dynamic tensions of a chain in steady running: of what vibrates with the drive, and of a return strand by itself."""

import math

import numpy as np

from ptmcalc.base.estimate import Estimate
from ptmcalc.machines.chain_drive.machine.model import FloatArray, vibrating
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run
from ptmcalc.machines.chain_drive.machine.strength import STILL, Answer, Tail
from ptmcalc.machines.chain_drive.polygon.excitation import (
    HARMONICS,
    ended,
    excitations,
    excites_far,
    mass_of_drive,
    still,
    swept,
    tooth_frequency,
    unbounded,
)
from ptmcalc.machines.chain_drive.polygon.return_strand import OfReturn, of_return, return_bound
from ptmcalc.numerics.harmonic.inside import Extremes, joint_response
from ptmcalc.numerics.harmonic.parts import Chain
from ptmcalc.numerics.harmonic.response import polygon_response


def answer(spec: ChainDrive, scene: Run, carried: frozenset[str], count: int) -> Answer:
    """Dynamic tensions of steady running at the speed of the file; without bound at a resonance without damping."""
    if unbounded(spec, scene, carried):
        most, least = Estimate.exact(math.inf), Estimate.exact(-math.inf)
        return Answer(most, least, most, least, Tail(most, least, most, least), math.inf, None, most, least)
    chain = vibrating(spec, scene, mass_of_drive(spec, carried))
    speeds = np.array([spec.speed])
    on = swept(spec, chain, speeds, carried, count)
    far = None
    if excites_far(spec, chain):
        far = swept(spec, chain, speeds, carried, count, at_far_end=True)
    inside = _at_joint(spec, chain, speeds, carried, count)
    back = of_return(spec, scene, carried, count)
    bounds = [float(one.bound[0]) for one in (on, far, *inside) if one is not None]
    return Answer(
        *ended(on),
        *(ended(far) if far else (STILL, STILL)),
        Tail(*(one for side in inside for one in _of_joint(side))) if inside else _behind(back),
        max(*bounds, back.bound),
        float(on.place[0]) if on.place is not None else None,
        back.off_largest,
        back.off_smallest,
    )


def _behind(back: OfReturn) -> Tail:
    """The return strand at a driven tail; the working strand ends there."""
    return Tail(STILL, STILL, back.tail_largest, back.tail_smallest)


def _at_joint(
    spec: ChainDrive, chain: Chain, speeds: FloatArray, carried: frozenset[str], count: int
) -> tuple[Extremes, ...]:
    """Forces of both strands at the tail, where both vibrate."""
    if len(chain.lines) == 1:
        return ()
    near, far = excitations(spec, chain, speeds, carried, count)
    return joint_response(chain, tooth_frequency(spec, speeds), near, far)


def _of_joint(side: Extremes) -> tuple[Estimate, Estimate]:
    error = float(side.error[0])
    return tuple(Estimate.within(float(one[0]), error) for one in (side.largest, side.smallest))  # type: ignore[return-value]


def answer_bound(spec: ChainDrive, scene: Run, carried: frozenset[str], near: bool) -> float:
    """Sum of the absolute terms of the dynamic tension at the larger end, whatever the phases: of all that moves the
    chain, or of the far end alone, a driven tail for either strand [N]."""
    chain = vibrating(spec, scene, mass_of_drive(spec, carried))
    own, far = excitations(spec, chain, np.array([spec.speed]), carried, HARMONICS[0])
    back = return_bound(spec, scene, carried, HARMONICS[0], near)
    if not near:
        if far is None:
            return back
        own = still(own)
    w = tooth_frequency(spec, [spec.speed])
    ends = (False, True) if excites_far(spec, chain) else (False,)
    bounds = [polygon_response(chain, w, own, far, at_far_end=end).bound for end in ends]
    if len(chain.lines) == 2:
        bounds += [side.bound for side in joint_response(chain, w, own, far)]
    return max(back, *(float(one[0]) for one in bounds))
