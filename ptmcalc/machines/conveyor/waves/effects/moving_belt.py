"""Convection of waves by the moving belt."""

import math

from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.laws import start_profile, wave
from ptmcalc.machines.conveyor.machine.drives import running
from ptmcalc.machines.conveyor.machine.model import BeltLine, belt_line
from ptmcalc.machines.conveyor.machine.motion import moving
from ptmcalc.machines.conveyor.machine.plain_start import delay_lines_do
from ptmcalc.machines.conveyor.machine.scenes import IN_MOTION, ConveyorScene, Jam, Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import start_case
from ptmcalc.machines.conveyor.waves import load_errors, start_enclosure
from ptmcalc.machines.conveyor.waves.effects.shared import Loads, Offsets, anything, moved_by
from ptmcalc.machines.conveyor.waves.load_errors import Change

_TRAVEL_OF_SWING = {"loop": 3.0, "start": 4.0, "jam": 20.0}
"""Change of tension relative to v/c times the amplitude [1]. Calibrated: the largest values of 900 machines were 1.3 of
a loop of fixed length, 2.2 of other starts and 8.9 of a jam. Smaller values lose the safety of the bound; larger ones
widen it."""


_TRAVEL_OF_STOP = {"loop": (4.0, 10.0, 2.5), "free": (10.0, 5.0, 5.0)}
"""The same of a stop [1]: of the highest tensions, of the lowest, and at a pulley while its traction is worst.
Calibrated: the largest values of 490 machines were 1.7, 5.5 and 1.5 of a loop of fixed length, 5.9, 2.6 and 3.6 of
others. Smaller values lose the safety of the bound; larger ones widen it."""
_TRAVEL_OF_GRIP = 3.0
"""The same at a pulley of a start while its traction is worst [1]. Calibrated: the largest value of 490 machines was
1.7. A smaller value loses the safety of the bound; a larger one widens it."""
_TRAVEL_OF_STRAY = {"loop": 3.0, "step": 3.0, "rise": 10.0}
"""Change of tension of a plain start relative to v/c times the deviation from the rigid body [1]. Calibrated: the
largest values of 900 machines were 1.5 of a loop of fixed length, 1.8 of a step and 6.3 of any rise. Smaller values
lose the safety of the bound; larger ones widen it."""
TRAVEL_THRESHOLD = 0.03
"""Belt speed relative to that of its slowest wave [1] from which on convection is simulated. An engineering choice;
theory of moving strings requires no smaller one. Below it the error bar is at most 12 % of half the tension range in a
start, 30 % in a stop and 60 % in a jam."""


def belt_travel(line: BeltLine) -> float:
    """Speed of the belt over that of its slowest wave, v/c."""
    return line.speed / wave.wave_speed(line.stiffness, max(*line.carry.masses, *line.back.masses))


def travel_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Ratio of the belt speed to the speed of its slowest wave.

        v/c

    **Range** any scene in motion.
    **Error** exact.
    **Source** Doppler shift of waves on a moving string. A round trip changes by (v/c)^2 only, but the place and time
    at which waves meet change by v/c.
    """
    value = belt_travel(belt_line(spec, scene))
    return Criterion("v/c", value, TRAVEL_THRESHOLD, "belt speed / speed of the slowest wave", "numerics.belt.travel")


def travel_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension if waves are assumed to travel both ways at the same speed.

        d = k (v/c) (S_max - S_min)/2       k = 4 a start, 3 sqrt(1 + n) of a loop of fixed length, 20 a jam
        d = k (v/c) a b_max g               k = 3 by a torque at once, 10 any rise, 3 (1 + n) a loop of fixed length

    In a stop k = 10 of the highest tensions and 5 of the lowest, of a loop of fixed length 4 and 10. At a pulley at its
    worst traction k = 3 of (S_max - S_min)/2 in a start, 5 in a stop, 2.5 in a stop of such a loop.

    The smaller of both applies in a plain start; a b_max g is the maximum deviation of the tension from the rigid body
    (`laws.loop_bounds.stray`), n the number of wave circuits in the window. Waves that travel around a closed loop in
    opposite directions separate by v/c per circuit; elsewhere every wave travels both ways, and its round trip changes
    by (v/c)^2 only.

    **Range** v/c below 0.03; unbounded above.
    **Error** calibrated on 900 machines: the largest k were 2.2, 1.3 sqrt(1 + n), 8.9 of a jam; relative to the
    deviation 1.8, 6.3 and 1.5 (1 + n). On 490 others: 5.9 and 2.6 for a stop, 1.7 and 5.5 for a loop of fixed length;
    1.7, 3.6 and 1.5 for the traction.
    **Source** the meeting point of waves shifts by v/c of their path; coverage samples.
    """
    line = running(spec, scene)
    share = belt_travel(line)
    if share >= TRAVEL_THRESHOLD or "tension_max" not in loads or "tension_min" not in loads:
        return anything(spec, scene, loads)
    high, low = loads["tension_max"], loads["tension_min"]
    swing = ((high.high if high.bounded else high.value) - (low.low if low.bounded else low.value)) / 2
    closed = line.fixed_length
    if isinstance(scene, Jam):
        return moved_by(spec, scene, line, loads, _TRAVEL_OF_SWING["jam"] * share * swing)
    if not isinstance(scene, Start):
        parts = (k * share * swing for k in _TRAVEL_OF_STOP["loop" if closed else "free"])
        return moved_by(spec, scene, line, loads, Change(*parts))
    rounds = 1 + moving(spec, scene).window / line.contour_time if closed else 1.0
    change = _TRAVEL_OF_SWING["loop" if closed else "start"] * share * math.sqrt(rounds) * swing
    at_grip = min(change, _TRAVEL_OF_GRIP * share * swing)
    if not delay_lines_do(spec, scene):
        return moved_by(spec, scene, line, loads, Change(change, change, at_grip))
    case = start_case(spec, scene)
    factor = _TRAVEL_OF_STRAY["loop" if closed else "step" if case.shape == start_profile.STEP else "rise"]
    change = min(change, factor * share * rounds * start_enclosure.largest_stray(case))
    return load_errors.spread(case, loads, change, at_grip)


MOVING_BELT = Effect(
    "moving_belt",
    "convection of waves by the moving belt",
    IN_MOTION,
    travel_criterion,
    travel_bound,
    part_of="belt_wave",
    calibrated=True,
)
