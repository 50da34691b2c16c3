"""Two trains of the performance study, as the trains of our numerics.

P4: a trolley with a hanging load brakes and strikes a buffer. P5: a hoist train with play in a stiff gear, a slack
rope, an induction motor, a load that lifts off the ground, and a brake.
"""

import math

import numpy as np

from ptmcalc.numerics.piecewise import march
from ptmcalc.numerics.record import Record
from ptmcalc.numerics.train.parts import Body, Drive, Grip, Smooth, Spring, Stage, Train
from ptmcalc.numerics.train.signals import Signal
from ptmcalc.numerics.train.system import TrainSystem

TROLLEY, LOAD, ROPE, BRAKE, BUFFER, PLACE, SPEED, END = 12_000.0, 3_000.0, 94.5e3, 7.5e3, 2e6, 1.5, 2.0, 20.0
DAMPING = 2 * 0.01 * math.sqrt(ROPE * TROLLEY * LOAD / (TROLLEY + LOAD))
P4 = Train(
    bodies=(Body("trolley", TROLLEY, 0.0, SPEED), Body("load", LOAD, 0.0, SPEED)),
    springs=(
        Spring("rope", 0, 1, ROPE, DAMPING),
        Spring("buffer", 0, None, BUFFER, play=2 * PLACE, law="clamped", side=1),
    ),
    grips=(Grip("brake", 0, None, Signal.constant(BRAKE)),),
)
STIFFNESSES = (1e9, 1e10, 1e11, 1e12)
BREAKDOWN, SLIP, SYNCHRONOUS = 300e3, 0.12, 0.6
MOTOR, DRUM, HOISTED, WEIGHT = 8_900.0, 555.0, 10_000.0, 98_100.0
PLAY, SLACK, OFF, P5_END = 0.5e-3, 20e-3, 2.0, 4.0


def played(train: Train, end: float, tolerance: float) -> tuple[TrainSystem, Record]:
    system = TrainSystem(train)
    return system, march(system, *system.start(), end, tolerance=tolerance)


class Counted:
    """The curve of Kloss as a force over the rope's speed, and how often it was evaluated."""

    def __init__(self) -> None:
        self.count = 0

    def value(self, speed: np.ndarray) -> np.ndarray:
        self.count += np.size(speed)
        slip = 1 - speed / SYNCHRONOUS
        return 2 * BREAKDOWN * slip * SLIP / (slip**2 + SLIP**2)

    @staticmethod
    def slope(speed: float) -> float:
        slip = 1 - speed / SYNCHRONOUS
        return -2 * BREAKDOWN * SLIP * (SLIP**2 - slip**2) / (slip**2 + SLIP**2) ** 2 / SYNCHRONOUS


def hoist(stiffness: float, curve: Counted) -> Train:
    gear = 2 * 0.1 * math.sqrt(stiffness * MOTOR * DRUM / (MOTOR + DRUM))
    rope = 2 * 0.02 * math.sqrt(2e6 * HOISTED)
    law = Smooth("speed", curve.value, curve.slope, BREAKDOWN, 2 * BREAKDOWN / SLIP / SYNCHRONOUS / 2.5)
    return Train(
        bodies=(Body("motor", MOTOR), Body("drum", DRUM), Body("load", HOISTED)),
        springs=(
            Spring("gear", 0, 1, stiffness, gear, PLAY, "clamped"),
            Spring("rope", 1, 2, 2e6, rope, 2 * SLACK, "clamped", 1),
            Spring("ground", 2, None, 0.0, law="rigid", side=-1),
        ),
        grips=(Grip("brake", 0, None, Signal((0.0, OFF), (0.0, 250e3), (0.0, 0.0))),),
        drives=(
            Drive("motor", 0, (Stage(law),), Signal((0.0, OFF), (1.0, 0.0), (0.0, 0.0))),
            Drive.of("weight", 2, Signal.constant(-WEIGHT)),
        ),
    )
