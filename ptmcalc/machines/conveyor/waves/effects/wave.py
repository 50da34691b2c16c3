"""Belt elasticity: longitudinal waves."""

import math

from ptmcalc.base.estimate import NOTHING
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.machine.drives import running
from ptmcalc.machines.conveyor.machine.plain_start import is_plain
from ptmcalc.machines.conveyor.machine.rigid_stop import deceleration
from ptmcalc.machines.conveyor.machine.scenes import IN_MOTION, ConveyorScene, Jam, Start, Stopping
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import StartCase, start_case
from ptmcalc.machines.conveyor.stopping import stiff_bounds
from ptmcalc.machines.conveyor.waves import start_enclosure, start_intervals
from ptmcalc.machines.conveyor.waves.effects.idlers import slides_on, speed_bound
from ptmcalc.machines.conveyor.waves.effects.moving_belt import travel_bound
from ptmcalc.machines.conveyor.waves.effects.sag import SAG_THRESHOLD
from ptmcalc.machines.conveyor.waves.effects.shared import Loads, Offsets, anything, belt_mass
from ptmcalc.machines.conveyor.waves.effects.takeup import takeup_bound

WAVE_THRESHOLD = 0.05
"""Bound of the tension that waves add, relative to the static tension [1], from which on belt elasticity is simulated.
An engineering choice. Below it the rigid belt is used. In a plain start its error bar is at most 5 % of the static
tension of each section; in other scenes it is that of `stiff_bounds`, or there is none."""


def wave_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Maximum deviation of the tension from that of the rigid body, relative to the static tension of the same section.

        E = max over the belt of a b(s) g / S_static(s)           start
        E = m_belt |a| / S_static,min                             stop, a the maximum rigid deceleration
        E = max(Z) v / S_static,min                               jam

    a b(s) is the bound for a torque step (`laws.loop_bounds.stray`), and g the share that remains with the profile
    (`laws.start_profile.phases`).

    **Range** any start; infinite if a section has no static tension.
    **Error** an upper bound of the ratio.
    **Source** derived in `laws.loop_bounds`; the threshold of 5 % is an engineering choice.
    """
    value = start_enclosure.stray_ratio(start_case(spec, scene)) if isinstance(scene, Start) else _shock(spec, scene)
    return Criterion(
        "E", value, WAVE_THRESHOLD, "maximum tension added by belt waves / static tension", "laws.loop_bounds"
    )


def _shock(spec: Conveyor, scene: ConveyorScene) -> float:
    """Tension that a stop or a jam can add over the smallest static one."""
    line = running(spec, scene)
    least = float(min((*line.static_ends(RETURN), *line.static_ends(CARRY))))
    added = belt_mass(line) * deceleration(spec, scene, line)
    if isinstance(scene, Jam):
        added = max(line.impedance(CARRY), line.impedance(RETURN)) * line.speed
    return added / least if least > 0 else math.inf


def wave_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Interval of every load of the rigid body that contains all waves of the belt.

        S_static + a r - a b g <= S <= S_static + a r + a b g,   phase by phase

    A belt softened by sag is a linear belt of lower stiffness if the softening is constant over the oscillation: below
    5 % anywhere, or with a change of less than 5 % over the oscillation. The lowest frequency is then that of the
    softest belt. For a belt with more sag there is no bound.

    The bounds of take-up weight, speed-dependent resistance and belt speed are added. A stop of a short belt has bounds
    of its own (`stopping.stiff_bounds`).

    **Range** linear undamped belt without slip, one slope, one drive, a start with the running tensions; any jump of
    impedance and tail mass. All other cases are unbounded.
    **Error** a bound; it is attained at the entering strand with a gravity take-up and a torque step.
    **Source** derived in `laws.loop_bounds` (completeness of the modes, Cauchy-Schwarz, Dunkerley).
    """
    if isinstance(scene, Stopping) and (stop := stiff_bounds.short_stop(spec, scene)) is not None:
        return _carried_along(spec, scene, loads, stiff_bounds.offsets(stop, loads))
    if not isinstance(scene, Start) or not is_plain(spec, scene):
        return anything(spec, scene, loads)
    if not slides_on(spec, scene) and spec.effects.get("coulomb_idlers") != "off":
        return anything(spec, scene, loads)
    enclosure = _enclosed(spec, start_case(spec, scene))
    if enclosure is None:
        return anything(spec, scene, loads)
    found: Offsets = start_intervals.offsets(start_case(spec, scene), enclosure, loads)
    for name, bound in (("takeup_mass", takeup_bound), ("viscous_idlers", speed_bound)):
        if spec.effects.get(name) != "off":
            found = _both(found, bound(spec, scene, loads))
    return _carried_along(spec, scene, loads, found)


def _carried_along(spec: Conveyor, scene: ConveyorScene, loads: Loads, found: Offsets) -> Offsets:
    """Offsets of waves that run both ways at one speed, with what the running belt makes of them."""
    if spec.effects.get("moving_belt") == "off":
        return found
    waves = {name: load.widened(found.get(name, NOTHING)) for name, load in loads.items()}
    return _both(found, travel_bound(spec, scene, waves))


def _both(one: Offsets, other: Offsets) -> Offsets:
    """Offsets of two effects together."""
    return {name: one.get(name, NOTHING) + other.get(name, NOTHING) for name in one.keys() | other.keys()}


def _enclosed(spec: Conveyor, case: StartCase) -> start_enclosure.Enclosure | None:
    softening = None if spec.effects.get("sag") == "off" else start_intervals.largest_softening(case)
    if softening is None or softening < SAG_THRESHOLD:
        return start_enclosure.enclose(case, softening or 0.0)
    return _gently_sagging(case)


def _gently_sagging(case: StartCase) -> start_enclosure.Enclosure | None:
    """The enclosure of a belt that sags, if its stiffness hardly changes over the swing of any section."""
    softest = start_intervals.largest_softening(case)
    if softest is None or not math.isfinite(softest):
        return None
    enclosure = start_enclosure.enclose(case, softest)
    for which, part in ((RETURN, enclosure.strands[0]), (CARRY, enclosure.strands[1])):
        lowest = float(min(case.line.static_ends(which)))
        if lowest <= 0 or 3 * softest / (1 + softest) * (lowest - part.smallest.low) / lowest > SAG_THRESHOLD:
            return None
    return enclosure


BELT_WAVE = Effect("belt_wave", "belt elasticity (longitudinal waves)", IN_MOTION, wave_criterion, wave_bound)
