"""A drive that takes up a chain without tension and breaks its load loose: two masses, a spring that never pushes, a
load that sticks and slides.

    m v_1' = F(t) - S,   S = max(0, K x + b x') for x > 0,   x' = v_1 - v_2
    M v_2' = S - W while the load slides; it sticks as long as S <= W

Exact between its events by the exponential of each state (`numerics.train`): taut and slack, stick and slide.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics.piecewise import march
from ptmcalc.numerics.train.parts import NO_PULL, Body, Drive, Grip, Spring, Train
from ptmcalc.numerics.train.signals import Signal
from ptmcalc.numerics.train.system import TrainSystem

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class TwoMassStart:
    """Largest force of the spring and its time; when the load breaks loose, None where it never does; how often the
    spring goes slack after it was taut; speeds of drive and load at the end; steps taken."""

    largest: float
    largest_time: float
    breaks_loose: float | None
    slack: int
    speeds: tuple[float, float]
    work: int


def two_mass_start(
    drive_mass: float,
    load_mass: float,
    stiffness: float,
    damping: float,
    resistance: float,
    times: FloatArray,
    forces: FloatArray,
    window: float,
) -> TwoMassStart:
    """The start from rest without tension.

    Args:
        drive_mass: m [kg].
        load_mass: M [kg].
        stiffness: K [N/m].
        damping: b, of the spring [N*s/m].
        resistance: W, Coulomb friction of the load, the same at rest and sliding [N].
        times: of the drive's force, from 0 on, shape (n,) [s].
        forces: F at these times, straight between them, the last one holding on, shape (n,) [N].
        window: end [s].

    Returns:
        what happens until then.

    **Error** rounding.
    **Source** equations of motion of either state, their exponential; events on the exact solution.
    """
    force = Signal.constant(float(forces[0]))
    if len(times) > 1:
        force = Signal.through(tuple(zip(times.tolist(), forces.tolist(), strict=True)))
    train = Train(
        bodies=(Body("drive", drive_mass), Body("load", load_mass)),
        springs=(Spring("chain", 0, 1, stiffness, damping, law=NO_PULL, side=1),),
        grips=(Grip("resistance", 1, None, Signal.constant(resistance)),) if resistance > 0 else (),
        drives=(Drive.of("motor", 0, force),),
    )
    system = TrainSystem(train)
    record = march(system, *system.start(), end=window)
    at = system.watched
    loose = [float(one.time) for one in record.events if one.element == "resistance"]
    slack = sum(one.element == "chain" and one.after == "open" for one in record.events)
    return TwoMassStart(
        largest=float(record.top.values[at["link", 0]]),
        largest_time=float(record.top.at[at["link", 0]]),
        breaks_loose=(loose[0] if loose else None) if resistance > 0 else 0.0,
        slack=slack,
        speeds=(float(record.last[at["speed", 0]]), float(record.last[at["speed", 1]])),
        work=record.steps,
    )
