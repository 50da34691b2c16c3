"""Resistance of the idlers: stick-slip of the belt on them, and its dependence on speed."""

import math

from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.machines.conveyor.machine.model import belt_line
from ptmcalc.machines.conveyor.machine.plain_start import SPEED_SHARE_THRESHOLD, thrown_back
from ptmcalc.machines.conveyor.machine.rigid_stop import deceleration
from ptmcalc.machines.conveyor.machine.scenes import IN_MOTION, ConveyorScene, Start, Stopping
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import start_case
from ptmcalc.machines.conveyor.waves.effects.shared import Loads, Offsets, anything, belt_mass, moved_by, slides_first
from ptmcalc.machines.conveyor.waves.load_errors import Change

COULOMB_THRESHOLD = 0.1
"""Idler friction relative to the accelerating force of the belt [1] from which on stick-slip on the idlers is
simulated. An engineering choice. Below it the error bar of a start is at most 15 % of that force, and 7.5 % of a loop
of fixed length; in other scenes there is none."""
_COULOMB_FACTOR = {"loop": 0.75, "free": 1.5}
"""Change of tension relative to the idler friction [1]: of a loop of fixed length, and of one with a take-up weight.
Calibrated: the largest values of 360 starts were 0.51 and 0.94. Smaller values lose the safety of the bound; larger
ones widen it."""
_SPEED_FACTOR = {"start": 3.0, "stop": 12.0}
"""Change of tension relative to the part of the idler friction that grows with the speed [1]. Calibrated: the largest
values of 250 machines were 2.1 in a start and 8.9 in other scenes. Smaller values lose the safety of the bound; larger
ones widen it."""
_SPEED_OF_FIRST_WAVES = 2.0
"""The same for the lowest tensions and the worst traction of a stop [1]. Calibrated: the largest value of 240 machines
was 1.5, of the leaving tension. A smaller value loses the safety of the bound; a larger one widens it."""


def coulomb_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Ratio of the idler friction to the accelerating force of the belt.

        W_idlers/(m_belt a);   0 for a start with the running tensions

    **Range** any scene in motion. A belt that starts with its running tensions slides forward from the beginning,
    unless an imposed speed rises so fast that waves reverse it (`model.thrown_back`).
    **Error** exact.
    **Source** force balance of a friction front; the threshold of 10 % is an engineering choice.
    """
    line = belt_line(spec, scene)
    pulled = belt_mass(line) * (
        start_case(spec, scene).acceleration if isinstance(scene, Start) else deceleration(spec, scene, line)
    )
    idlers = line.back.friction[-1] + line.carry.friction[-1]
    value = idlers / pulled if pulled > 0 else math.inf
    if slides_on(spec, scene):
        value = 0.0
    return Criterion("W/(m a)", value, COULOMB_THRESHOLD, "idler friction / inertia force of the belt", "Newton's law")


def coulomb_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension if a relaxed belt is assumed to start with its running tensions.

        d = k W_idlers,   k = 1.5, and 0.75 of a loop of fixed length

    The tension profiles differ by W_idlers before the start; a front against half the friction arrives with a
    correspondingly larger force. A loop of fixed length keeps its mean tension, so that half of the difference acts on
    either side.

    **Range** W_idlers/(m_belt a) below 0.1; unbounded above.
    **Error** calibrated: over 360 starts, k was at most 0.94 instead of 1.5, and 0.51 instead of 0.75.
    **Source** front speeds with Coulomb friction (F - w x/2 against F - w L), lecture notes Kramatorsk 2007 completed.
    """
    criterion = coulomb_criterion(spec, scene)
    if not isinstance(scene, Start) or criterion.exceeded:
        return anything(spec, scene, loads)
    if slides_on(spec, scene):
        return {}
    line = belt_line(spec, scene)
    factor = _COULOMB_FACTOR["loop" if line.fixed_length else "free"]
    return moved_by(spec, scene, line, loads, factor * (line.back.friction[-1] + line.carry.friction[-1]))


def slides_on(spec: Conveyor, scene: ConveyorScene) -> bool:
    """Whether the whole belt slides forward from the first moment of a start on."""
    return isinstance(scene, Start) and scene.belt == "frozen" and not thrown_back(spec, scene)


def speed_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Part of the idler resistance at rated speed that is proportional to the speed.

        s = W_v(v_rated)/W(v_rated)

    **Range** any scene in motion; 0 if the file does not give it.
    **Error** exact: an input.
    **Source** running resistance increases with the speed; the threshold of 5 % is an engineering choice.
    """
    share = spec.resistance.speed_share
    meaning = "part of the idler resistance proportional to speed"
    return Criterion("s", share, SPEED_SHARE_THRESHOLD, meaning, "an input")


def speed_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension if the whole resistance is assumed independent of the speed.

        d = k s W_idlers,   k = 3 a start, 12 any other scene, 2 the minimum tensions and the traction of a stop

    At standstill W_idlers is too large by s W_idlers; a wave reflection may double this difference. A stop lasts longer
    with less resistance, and fronts that meet again before standstill add up. The minimum tensions and the worst
    traction of a stop occur with its first waves, while the belt still runs near rated speed, where both resistances
    are equal.

    **Range** s below 5 %; unbounded above, and if the belt slips on its pulley before it starts.
    **Error** calibrated on 250 machines: the largest k were 2.1 and 8.9, the second largest of a stop 2.9; on 240
    others 0.8 for the minimum tension in a stop, 1.5 for the leaving tension, and 0.6 for the tensions of the worst
    traction.
    **Source** force balance of the belt.
    """
    share = spec.resistance.speed_share
    if share == 0:
        return {}
    if share >= SPEED_SHARE_THRESHOLD or slides_first(spec, scene):
        return anything(spec, scene, loads)
    line = belt_line(spec, scene)
    factor = _SPEED_FACTOR["start" if isinstance(scene, Start) else "stop"]
    first = _SPEED_OF_FIRST_WAVES if isinstance(scene, Stopping) else factor
    unit = share * (line.back.friction[-1] + line.carry.friction[-1])
    return moved_by(spec, scene, line, loads, Change(factor * unit, first * unit, first * unit))


COULOMB_IDLERS = Effect(
    "coulomb_idlers",
    "stick-slip of the belt on the idlers",
    IN_MOTION,
    coulomb_criterion,
    coulomb_bound,
    part_of="belt_wave",
    calibrated=True,
)

VISCOUS_IDLERS = Effect(
    "viscous_idlers",
    "speed-dependent resistance",
    IN_MOTION,
    speed_criterion,
    speed_bound,
    part_of="belt_wave",
    calibrated=True,
)
