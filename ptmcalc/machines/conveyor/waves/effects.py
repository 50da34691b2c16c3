"""The effects a conveyor in motion may call for.

Bounds marked *calibrated* have the form that perturbation theory gives, with a factor from the seeded samples of
`tests/coverage` (about 1900 machines, seeds 11 and 21) and a margin on its largest value; the coverage tests hold
them on other seeds.
"""

import math
from collections.abc import Mapping

from ptmcalc.base.estimate import NOTHING, Estimate, Interval
from ptmcalc.base.memory import kept_for
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.contract.result import family
from ptmcalc.laws import sag, start_profile, wave
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor.drives import moving_mass, running
from ptmcalc.machines.conveyor.loads import CHANGED_BY_MOTION, DRIVE, OF_STOP
from ptmcalc.machines.conveyor.model import (
    DAMPING_THRESHOLD,
    SPEED_SHARE_THRESHOLD,
    TRAVEL_THRESHOLD,
    BeltLine,
    StartCase,
    belt_line,
    belt_travel,
    damping_change,
    delay_lines_do,
    grips,
    inertia_of_weight,
    is_plain,
    slides_at_rest,
    start_case,
    takeup_numbers,
    thrown_back,
)
from ptmcalc.machines.conveyor.motion import moving, rough_utilisation
from ptmcalc.machines.conveyor.spec import (
    IN_MOTION,
    Coast,
    Conveyor,
    ConveyorScene,
    EmergencyStop,
    Jam,
    Start,
    Stop,
    Stopping,
)
from ptmcalc.machines.conveyor.stopping import stiff_bounds
from ptmcalc.machines.conveyor.stopping.rigid import GearChange, changing_sides, deceleration
from ptmcalc.machines.conveyor.waves import bounds
from ptmcalc.machines.conveyor.waves.bounds import Change

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]

WAVE_THRESHOLD = 0.05
JUMP_THRESHOLD = 0.02
TAIL_MASS_THRESHOLD = 0.01
SAG_THRESHOLD = 0.05
COULOMB_THRESHOLD = 0.1

_JUMP_FACTOR = 2.5
_TAIL_MASS_FACTOR = 5.0
_SAG_FACTOR = 0.4
_SCENE_SAG_FACTOR = 1.0
_GENTLE_SAG = 0.5
_COULOMB_FACTOR = {"loop": 0.75, "free": 1.5}
_TAKEUP_FACTOR, _TAKEUP_OF_GRIP = 9.0, 3.0
_SPEED_FACTOR = {"start": 3.0, "stop": 12.0}
_SPEED_OF_FIRST_WAVES = 2.0
_DAMPING_FACTOR, _DAMPING_OF_GRIP = 6.0, 3.0
_DAMPING_OF_SLOPES = 1.0
_TRAVEL_OF_SWING = {"loop": 3.0, "start": 4.0, "jam": 20.0}
_TRAVEL_OF_STOP = {"loop": (4.0, 10.0, 2.5), "free": (10.0, 5.0, 5.0)}
_TRAVEL_OF_GRIP = 3.0
_TRAVEL_OF_STRAY = {"loop": 3.0, "step": 3.0, "rise": 10.0}


def _anything(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """No bound for any load that the motion of the belt can change; a belt that never stops does so whatever its waves
    are."""
    drives = isinstance(scene, Start) and scene.profile.imposes_speed
    return {
        name: bounds.anything(name, load)
        for name, load in loads.items()
        if (family(name) in CHANGED_BY_MOTION and not (family(name) in OF_STOP and load.low == math.inf))
        or (drives and name in DRIVE)
    }


def _moved(
    spec: Conveyor, scene: ConveyorScene, line: BeltLine, loads: Loads, change: float | Change, off: bool = False
) -> Offsets:
    """Offsets of the loads of any scene when tensions may be off by a change, every one by the same [N] if it is a
    number. The tension at the run-off is constant only where a take-up weight has no inertia."""
    off = off or spec.takeup_weight > 0
    slowing = deceleration(spec, scene, line) if isinstance(scene, Stopping) else 0.0
    asked = 0
    if isinstance(scene, Start) and scene.profile.imposes_speed:
        asked = len({drive.at for drive in spec.all_drives.values()})
    parts = change if isinstance(change, Change) else Change.any_time(change)
    return bounds.moved(line, loads, parts, slowing, grips(spec), off, asked)


def wave_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Largest stray of the tension from the rigid body's, over the static tension of the same section.

        E = max over the belt of a b(s) g / S_static(s)           start
        E = m_belt |a| / S_static,min                             stop, a the largest rigid deceleration
        E = max(Z) v / S_static,min                               jam

    with a b(s) the bound of a step (`laws.loop_bounds.stray`) and g what the profile leaves of it
    (`laws.start_profile.phases`).

    **Range** any start; infinite where a section has no static tension.
    **Error** an upper bound of the ratio.
    **Source** derived in `laws.loop_bounds`; the threshold of 5 % is an engineering choice.
    """
    value = bounds.stray_ratio(start_case(spec, scene)) if isinstance(scene, Start) else _shock(spec, scene)
    return Criterion(
        "E", value, WAVE_THRESHOLD, "tension the belt's waves can add, over the static tension", "laws.loop_bounds"
    )


def _shock(spec: Conveyor, scene: ConveyorScene) -> float:
    """Tension that a stop or a jam can add over the smallest static one."""
    line = running(spec, scene)
    least = float(min((*line.static_ends(RETURN), *line.static_ends(CARRY))))
    added = _belt_mass(line) * deceleration(spec, scene, line)
    if isinstance(scene, Jam):
        added = max(line.impedance(CARRY), line.impedance(RETURN)) * line.speed
    return added / least if least > 0 else math.inf


def _belt_mass(line: BeltLine) -> float:
    return line.carry.line_mass * line.carry.length + line.back.line_mass * line.back.length


def wave_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Interval of every load of the rigid body that holds all waves of the belt.

        S_static + a r - a b g <= S <= S_static + a r + a b g,   phase by phase

    A belt softened by sag is a linear belt of lower stiffness as long as the softening is the same over the swing:
    below 5 % anywhere, or changing by less than 5 % over the swing; then the lowest frequency is taken of the softest
    belt. A belt that sags more is unbounded.

    What a take-up weight, a resistance that goes with the speed and the running of the belt do to it besides is
    added from their own bounds. A stop of a short belt has bounds of its own (`stopping.stiff_bounds`).

    **Range** linear undamped belt without slip, one slope, one drive, a start from the frozen running profile; any jump
    of impedance and tail mass. Anything else is unbounded.
    **Error** a bound; at the run-on of a gravity take-up under a torque step it is attained.
    **Source** derived in `laws.loop_bounds` (completeness of the modes, Cauchy-Schwarz, Dunkerley).
    """
    if isinstance(scene, Stopping) and (stop := stiff_bounds.short_stop(spec, scene)) is not None:
        return _carried_along(spec, scene, loads, stiff_bounds.offsets(stop, loads))
    if not isinstance(scene, Start) or not is_plain(spec, scene):
        return _anything(spec, scene, loads)
    if not _slides_on(spec, scene) and spec.effects.get("coulomb_idlers") != "off":
        return _anything(spec, scene, loads)
    enclosure = _enclosed(spec, start_case(spec, scene))
    if enclosure is None:
        return _anything(spec, scene, loads)
    found: Offsets = bounds.offsets(start_case(spec, scene), enclosure, loads)
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


def _enclosed(spec: Conveyor, case: StartCase) -> bounds.Enclosure | None:
    softening = None if spec.effects.get("sag") == "off" else bounds.largest_softening(case)
    if softening is None or softening < SAG_THRESHOLD:
        return bounds.enclose(case, softening or 0.0)
    return _gently_sagging(case)


def _gently_sagging(case: StartCase) -> bounds.Enclosure | None:
    """The enclosure of a belt that sags, if its stiffness hardly changes over the swing of any section."""
    softest = bounds.largest_softening(case)
    if softest is None or not math.isfinite(softest):
        return None
    enclosure = bounds.enclose(case, softest)
    for which, part in ((RETURN, enclosure.strands[0]), (CARRY, enclosure.strands[1])):
        lowest = float(min(case.line.static_ends(which)))
        if lowest <= 0 or 3 * softest / (1 + softest) * (lowest - part.smallest.low) / lowest > SAG_THRESHOLD:
            return None
    return enclosure


def jump_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Part of a wave that the tail sends back because carry and return strand differ.

        r = |Z1 - Z2|/(Z1 + Z2)

    **Range** any belt.
    **Error** exact.
    **Source** `laws.wave.reflection`; the threshold of 2 % is an engineering choice.
    """
    line = belt_line(spec, scene)
    value = abs(wave.reflection(line.impedance(CARRY), line.impedance(RETURN)))
    return Criterion("r", value, JUMP_THRESHOLD, "part of a wave the tail reflects", "laws.wave.reflection")


def jump_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension when the return strand is given the impedance of the carry strand.

        d = r a M_belt + min(2.5 r sqrt(1 + n), 2) a b_max g

    The first term is the change of the return strand's mass (2 r of it); the second grows with the number n of
    contour times in the window and is capped by the stray of both motions.

    **Range** r below 0.02; unbounded above.
    **Error** calibrated: the largest value of the sample was 1.6 in place of 2.5.
    **Source** perturbation of the reflected waves; coverage sample.
    """
    r = jump_criterion(spec, scene).value
    return _small_change(spec, scene, loads, r, r < JUMP_THRESHOLD, _JUMP_FACTOR)


def tail_mass_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Mass of the tail drum over that of belt and load.

        m_t/m_belt

    **Range** any belt.
    **Error** exact.
    **Source** the threshold of 1 % is an engineering choice.
    """
    line = belt_line(spec, scene)
    value = line.tail_mass / _belt_mass(line)
    return Criterion("m_t/m_b", value, TAIL_MASS_THRESHOLD, "tail drum over belt and load", "Newton's law")


def tail_mass_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension when the tail drum is taken without mass.

        d = e a M_belt + min(5 e sqrt(1 + n), 2) a b_max g,   e = m_t/m_belt

    The first term is the pull of the drum itself; the second as in `jump_bound`.

    **Range** m_t/m_belt below 0.01; unbounded above.
    **Error** calibrated: the largest value of the sample was 3.4 in place of 5.
    **Source** perturbation of the tail's equation of motion; coverage sample.
    """
    share = tail_mass_criterion(spec, scene).value
    return _small_change(spec, scene, loads, share, share < TAIL_MASS_THRESHOLD, _TAIL_MASS_FACTOR)


def _small_change(
    spec: Conveyor, scene: ConveyorScene, loads: Loads, share: float, known: bool, factor: float
) -> Offsets:
    if not known or not isinstance(scene, Start):
        return _anything(spec, scene, loads)
    if share == 0:
        return {}
    case = start_case(spec, scene)
    change = share * case.acceleration * case.masses.belt_mass + _grown(case, factor * share)
    return bounds.spread(case, loads, change)


def _grown(case: StartCase, share: float) -> float:
    """A share of the largest stray that grows with the root of the echoes, capped by two strays [N]."""
    contours = case.window / case.line.contour_time
    return min(share * math.sqrt(1 + contours), 2.0) * bounds.largest_stray(case)


def sag_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion | None:
    """Softening of the belt by sag at the lowest tension the waves can bring.

        f = EA (w l)^2/(12 S_low^3)

    S_low is the lower end of the wave bound in a start, and the smallest static tension in a stop or a jam.

    **Range** idler pitches given; infinite where the belt can lose its tension.
    **Error** in a start an upper bound.
    **Source** Ernst (`laws.sag.softening`); the threshold of 5 % is an engineering choice.
    """
    if isinstance(scene, Start):
        value = bounds.largest_softening(start_case(spec, scene))
    else:
        line = running(spec, scene)
        value = _softening(line, float(min((*line.static_ends(RETURN), *line.static_ends(CARRY)))))
    if value is None:
        return None
    return Criterion("f", value, SAG_THRESHOLD, "give of the sagging spans over that of the belt", "laws.sag.softening")


def _softening(line: BeltLine, lowest: float) -> float | None:
    """Softening of the belt by sag at a tension; None without idler pitches."""
    spans = [span for span in (line.back.span_weight, line.carry.span_weight) if span]
    if not spans:
        return None
    return max(float(sag.softening(line.stiffness, span, lowest)) for span in spans)


def sag_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension when the sagging spans are taken as straight.

        d = min(0.4 f sqrt(1 + n), 2) a b_max g,   f at the lowest tension the run found       start
        d = min(1.0 f sqrt(1 + n), 2) (S_max - S_min)/2                                        any other scene

    **Range** f below 0.05 (a plain start, where a richer solver carries sag) or 0.5 at the lowest tension of the run;
    unbounded above, and where the run does not know it.
    **Error** calibrated: the largest value of the sample was 0.17 in place of 0.4; of 218 stops and starts of a relaxed
    belt, nonlinear elements with Ernst spans against the same without, 0.45 in place of 1.0 (the next one 0.27).
    **Source** perturbation of the compliance; coverage samples.
    """
    lowest = loads["tension_min"].low if "tension_min" in loads else -math.inf
    line = belt_line(spec, scene)
    softest = _softening(line, lowest)
    if softest is None:
        return {}
    plain = isinstance(scene, Start) and delay_lines_do(spec, scene)
    if softest >= (SAG_THRESHOLD if plain else _GENTLE_SAG) or "tension_max" not in loads:
        return _anything(spec, scene, loads)
    if isinstance(scene, Start) and plain:
        case = start_case(spec, scene)
        return bounds.spread(case, loads, _grown(case, _SAG_FACTOR * softest))
    contours = moving(spec, scene).window / line.contour_time
    swing = (loads["tension_max"].value - loads["tension_min"].value) / 2
    return _moved(spec, scene, line, loads, min(_SCENE_SAG_FACTOR * softest * math.sqrt(1 + contours), 2.0) * swing)


def slip_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion | None:
    """Most of a drum's grip that the scene can use.

        U_b = (S_on - rho v^2)/((S_off - rho v^2) exp(mu alpha)) at the bounds of both sides       start, one drive
        the same with the rigid body's tensions, the dynamic part twice, drum by drum             anything else

    **Range** the friction of a drum given.
    **Error** an upper bound in a start with one drive, else an estimate.
    **Source** Euler-Eytelwein (`laws.capstan`), tensions from `laws.loop_bounds`; the threshold is 1/k_T of the file.
    """
    if all(drive.drum.friction is None for drive in spec.all_drives.values()):
        return None
    if isinstance(scene, Start) and is_plain(spec, scene):
        case = start_case(spec, scene)
        value = bounds.enclosed_loads(case, bounds.enclose(case, 0.0))["slip_utilisation_max"].high
    else:
        value = rough_utilisation(spec, scene)
    limit = 1 / spec.checks.slip.reserve
    return Criterion("U_b", value, limit, "maximum traction utilisation of a pulley in the scene", "laws.capstan")


def slip_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """A belt that never comes to the limit of its grip never slips: then nothing changes, else anything.

        U_max < 1 with its whole bar  =>  no change

    **Range** any run that knows the utilisation.
    **Error** exact.
    **Source** slip starts where U reaches 1 (`laws.capstan`).
    """
    used = loads.get("slip_utilisation_max")
    return {} if used is not None and used.high < 1 else _anything(spec, scene, loads)


def coulomb_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Idler friction over the force that accelerates the belt.

        W_idlers/(m_belt a);   0 for a start of a belt with the running friction frozen in it

    **Range** any scene in motion. A belt that starts from the frozen profile slides forward from the first moment on,
    unless an imposed speed rises so sharply that waves turn it back (`model.thrown_back`).
    **Error** exact.
    **Source** balance of a friction front; the threshold of 10 % is an engineering choice.
    """
    line = belt_line(spec, scene)
    pulled = _belt_mass(line) * (
        start_case(spec, scene).acceleration if isinstance(scene, Start) else deceleration(spec, scene, line)
    )
    idlers = line.back.friction[-1] + line.carry.friction[-1]
    value = idlers / pulled if pulled > 0 else math.inf
    if _slides_on(spec, scene):
        value = 0.0
    return Criterion("W/(m a)", value, COULOMB_THRESHOLD, "idler friction over the belt's inertia", "Newton's law")


def coulomb_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension when a relaxed belt is taken as one with the running friction frozen in it.

        d = k W_idlers,   k = 1.5, and 0.75 of a loop of fixed length

    The tension profiles differ by W_idlers before the start; a front that meets half the friction arrives with so much
    more force. A loop of fixed length keeps its mean tension, so a half of what differs goes to either side.

    **Range** W_idlers/(m_belt a) below 0.1; unbounded above.
    **Error** calibrated: of 360 starts the belt in cells was off by 0.94 at most in place of 1.5, and by 0.51 in place
    of 0.75.
    **Source** front speeds with Coulomb friction (F - w x/2 against F - w L), lecture notes Kramatorsk 2007 completed.
    """
    criterion = coulomb_criterion(spec, scene)
    if not isinstance(scene, Start) or criterion.exceeded:
        return _anything(spec, scene, loads)
    if _slides_on(spec, scene):
        return {}
    line = belt_line(spec, scene)
    factor = _COULOMB_FACTOR["loop" if line.fixed_length else "free"]
    return _moved(spec, scene, line, loads, factor * (line.back.friction[-1] + line.carry.friction[-1]))


def _slides_on(spec: Conveyor, scene: ConveyorScene) -> bool:
    """Whether the whole belt slides forward from the first moment of a start on."""
    return isinstance(scene, Start) and scene.belt == "frozen" and not thrown_back(spec, scene)


def takeup_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """How far the inertia of the take-up weight changes the run-off tension.

        max(kappa/0.1, (a_0/g)/0.03),   kappa = T_0 w_1/(2 g Z_2),   a_0 = |F|/m_drive;   0 of a rigid take-up

    a_0 is the acceleration of the drum alone, w_1 a lower bound of the lowest frequency.

    **Range** a gravity take-up.
    **Error** an estimate.
    **Source** take-up weight on two falls; thresholds are an engineering choice.
    """
    value = 0.0
    if spec.takeup_weight:
        line = running(spec, scene)
        value = inertia_of_weight(spec, line, _force_on_drum(spec, scene, line))
    return Criterion("kappa", value, 1.0, "inertia of the take-up weight", "take-up weight on two falls")


def _force_on_drum(spec: Conveyor, scene: ConveyorScene, line: BeltLine) -> float:
    """Largest force that sets the belt in motion or stops it [N]."""
    if isinstance(scene, Start):
        return start_case(spec, scene).excess
    return deceleration(spec, scene, line) * moving_mass(line)


def takeup_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension when the take-up weight is taken without inertia.

        d = k T_0 a_0/(2 g),   k = 9, and 3 at a drum while its grip is worst

    The weight follows half of what the belt's ends at the take-up differ by; what it pulls more or less is as its
    acceleration, and that, in a linear belt, as the one of the drum alone, a_0. Echoes add to it; kappa below its
    threshold, the weight is too light to hold them up. The grip is worst when the run-on is highest, and the run-off is
    lowest at another time.

    **Range** below the threshold; unbounded above, and where the belt slides on its drum before it starts.
    **Error** calibrated: of 300 starts and stops the largest value was 6.5 in place of 9, the next one 3.5; of 240
    others, 1.7 in place of 3.
    **Source** take-up weight on two falls; coverage sample.
    """
    if not spec.takeup_weight:
        return {}
    if takeup_criterion(spec, scene).exceeded or _slides_first(spec, scene):
        return _anything(spec, scene, loads)
    line = running(spec, scene)
    _, drum = takeup_numbers(spec, line, _force_on_drum(spec, scene, line))
    unit = line.takeup_tension * drum / (2 * spec.gravity)
    change = Change(_TAKEUP_FACTOR * unit, _TAKEUP_FACTOR * unit, _TAKEUP_OF_GRIP * unit)
    return _moved(spec, scene, line, loads, change, off=True)


def _slides_first(spec: Conveyor, scene: ConveyorScene) -> bool:
    """Whether the belt slides back on its drum before a start: its idlers' friction turns round."""
    return isinstance(scene, Start) and slides_at_rest(spec, scene).exceeded


def speed_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Part of the idlers' resistance at rated speed that is proportional to the speed.

        s = W_v(v_rated)/W(v_rated)

    **Range** any scene in motion; 0 where the file says nothing of it.
    **Error** exact: an input.
    **Source** running resistance grows with the speed; the threshold of 5 % is an engineering choice.
    """
    share = spec.resistance.speed_share
    meaning = "part of the idler resistance proportional to speed"
    return Criterion("s", share, SPEED_SHARE_THRESHOLD, meaning, "an input")


def speed_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension when all of the resistance is taken as independent of the speed.

        d = k s W_idlers,   k = 3 a start, 12 any other scene, 2 the lowest tensions and the grip of a stop

    At rest W_idlers is too large by s W_idlers; a wave that finds so much less against it may double it. A stop goes on
    longer with less resistance, and fronts that meet once more before the belt sticks add up. The lowest tensions of
    a stop and its worst grip come with its first waves, while the belt still runs at nearly the speed at which both
    resistances are the same.

    **Range** s below 5 %; unbounded above, and where the belt slides on its drum before it starts.
    **Error** calibrated on 250 machines: the largest k were 2.1 and 8.9, the next one of a stop 2.9; on 240 others 0.8
    of the lowest tension in a stop, 1.5 of that at the run-off, and 0.6 of those that make the grip worst.
    **Source** balance of the belt.
    """
    share = spec.resistance.speed_share
    if share == 0:
        return {}
    if share >= SPEED_SHARE_THRESHOLD or _slides_first(spec, scene):
        return _anything(spec, scene, loads)
    line = belt_line(spec, scene)
    factor = _SPEED_FACTOR["start" if isinstance(scene, Start) else "stop"]
    first = _SPEED_OF_FIRST_WAVES if isinstance(scene, Stopping) else factor
    unit = share * (line.back.friction[-1] + line.carry.friction[-1])
    return _moved(spec, scene, line, loads, Change(factor * unit, first * unit, first * unit))


def damping_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion | None:
    """How far the belt's damping moves the frequency of its slowest wave.

        d = |EA*/EA - 1|/2 at w = pi/(2 T);   infinite in a jam, whose front holds every frequency

    **Range** a file that gives `belt.damping`; not a jam from one moment to the next of a Kelvin-Voigt belt, whose
    answer to a jump of speed is an infinite force.
    **Error** an estimate: the slowest wave of a uniform loop stands for that of any loop.
    **Source** `laws.belt_damping`; the threshold of 0.1 % is an engineering choice: a swing then loses 0.3 %, the fifth
    echo 3 %.
    """
    if spec.belt.damping is None or jumps(spec, scene):
        return None
    value = math.inf if isinstance(scene, Jam) else damping_change(spec, belt_line(spec, scene))
    return Criterion("d", value, DAMPING_THRESHOLD, "what damping makes of the slowest wave", "laws.belt_damping")


def jumps(spec: Conveyor, scene: ConveyorScene) -> bool:
    """Whether a Kelvin-Voigt belt is stopped from one moment to the next."""
    damping = spec.belt.damping
    return isinstance(scene, Jam) and not scene.time and damping is not None and damping.model == "kelvin_voigt"


def damping_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension when the belt is taken as elastic.

        c = min(k sqrt(d (1 + n)), 2) (S_max - S_min)/2,   n the contour times of the window
        k = T/t_r a start of a running profile that rises over t_r, a contour time T at least; else 6, and 3 at a drum
            while its grip is worst

    A front that has gone round n times is about sqrt(d n) of the contour wide, and peaks are made of fronts that meet.
    A rise of a contour time or more sends no front but a slope, of which dampers round the corners only: by the rise
    over the width of a front.

    **Range** d below 0.001; unbounded above, and in a jam.
    **Error** calibrated: the largest value of the sample was 3.8 in place of 6; of 360 others 4.9, 2.0 in place of 3,
    and 0.55 in place of 1.
    **Source** width of a front in a Kelvin-Voigt belt, sqrt(2 t_r t); coverage sample.
    """
    criterion = damping_criterion(spec, scene)
    if criterion is None:
        return {}
    if criterion.exceeded or "tension_max" not in loads or "tension_min" not in loads:
        return _anything(spec, scene, loads)
    line = running(spec, scene)
    contours = moving(spec, scene).window / line.contour_time
    swing = (loads["tension_max"].value - loads["tension_min"].value) / 2
    factor, of_grip = _DAMPING_FACTOR, _DAMPING_OF_GRIP
    if isinstance(scene, Start) and scene.belt == "frozen" and delay_lines_do(spec, scene):
        rise = start_case(spec, scene).rise_time or 0.0
        if rise >= line.contour_time:
            factor = of_grip = _DAMPING_OF_SLOPES * line.contour_time / rise
    width = math.sqrt(criterion.value * (1 + contours))
    change, at_grip = (min(one * width, 2.0) * swing for one in (factor, of_grip))
    return _moved(spec, scene, line, loads, Change(change, change, at_grip))


def travel_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Speed of the belt over that of its slowest wave.

        v/c

    **Range** any scene in motion.
    **Error** exact.
    **Source** Doppler's shift of waves on a moving string. A round trip changes by (v/c)^2 only, but waves that meet do
    so elsewhere and at another time, by v/c.
    """
    value = belt_travel(belt_line(spec, scene))
    return Criterion("v/c", value, TRAVEL_THRESHOLD, "belt speed over that of its slowest wave", "numerics.belt.travel")


def travel_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of any tension when waves are taken to run both ways at one speed.

        d = k (v/c) (S_max - S_min)/2       k = 4 a start, 3 sqrt(1 + n) of a loop of fixed length, 20 a jam
        d = k (v/c) a b_max g               k = 3 by a torque at once, 10 any rise, 3 (1 + n) a loop of fixed length

    In a stop k = 10 of the highest tensions and 5 of the lowest, of a loop of fixed length 4 and 10. At a drum while
    its grip is worst k = 3 of (S_max - S_min)/2 in a start, 5 in a stop, 2.5 in a stop of such a loop.

    The lesser of both in a plain start, with a b_max g the largest stray of the tension from the rigid body's
    (`laws.loop_bounds.stray`); n are the contour times of the window. Waves that run round a closed loop either way
    part by v/c in each; elsewhere every wave runs both ways, and its round trip changes by (v/c)^2 only.

    **Range** v/c below 0.03; unbounded above.
    **Error** calibrated on 900 machines: the largest k were 2.2, 1.3 sqrt(1 + n), 8.9 of a jam; over the stray 1.8, 6.3
    and 1.5 (1 + n). On 490 others: of a stop 5.9 and 2.6, of a loop 1.7 and 5.5; of the grip 1.7, 3.6
    and 1.5.
    **Source** waves that meet are displaced by v/c of their way; coverage samples.
    """
    line = running(spec, scene)
    share = belt_travel(line)
    if share >= TRAVEL_THRESHOLD or "tension_max" not in loads or "tension_min" not in loads:
        return _anything(spec, scene, loads)
    high, low = loads["tension_max"], loads["tension_min"]
    swing = ((high.high if high.bounded else high.value) - (low.low if low.bounded else low.value)) / 2
    closed = line.fixed_length
    if isinstance(scene, Jam):
        return _moved(spec, scene, line, loads, _TRAVEL_OF_SWING["jam"] * share * swing)
    if not isinstance(scene, Start):
        parts = (k * share * swing for k in _TRAVEL_OF_STOP["loop" if closed else "free"])
        return _moved(spec, scene, line, loads, Change(*parts))
    rounds = 1 + moving(spec, scene).window / line.contour_time if closed else 1.0
    change = _TRAVEL_OF_SWING["loop" if closed else "start"] * share * math.sqrt(rounds) * swing
    at_grip = min(change, _TRAVEL_OF_GRIP * share * swing)
    if not delay_lines_do(spec, scene):
        return _moved(spec, scene, line, loads, Change(change, change, at_grip))
    case = start_case(spec, scene)
    factor = _TRAVEL_OF_STRAY["loop" if closed else "step" if case.shape == start_profile.STEP else "rise"]
    change = min(change, factor * share * rounds * bounds.largest_stray(case))
    return bounds.spread(case, loads, change, at_grip)


GEAR_THRESHOLD = 0.001
"""Change of the stopping time from which on the side of the gear losses is reported; an engineering choice."""
_GEAR_WAVES, _GEAR_MARGIN = 2.0, 1.2
"""A force that appears at once raises a wave of at most twice its size; the belt at the head changes its speed earlier
or later than the rigid body by less than a fifth of the change."""


def gear_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Relative change of the stopping time when the losses of each gear are on the side that is driven.

        |t_changing - t_fixed|/t_fixed   of the rigid conveyor

    **Range** any stop; 0 where the belt does not stop.
    **Error** that of the integration, below 1e-4.
    **Source** power through a gear: losses are on the driven side (`stopping.rigid.changing_sides`).
    """
    meaning = "change of the stopping time by the side of the gear losses"
    return Criterion("dt/t", _gear_change(spec, scene).relative, GEAR_THRESHOLD, meaning, "gear losses")


@kept_for(64)
def _gear_change(spec: Conveyor, scene: ConveyorScene) -> GearChange:
    return changing_sides(spec, scene, running(spec, scene))


def gear_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """Change of the loads of a stop when the losses of its gears change their side during it.

        dS = 2 dF,   dF the largest difference of the gear's force;   dt, ds: 1.2 times those of the rigid conveyor

    A pulley that slips already keeps its grip.

    **Range** any stop.
    **Error** a bound of the waves; the belt at the head follows the rigid body within a fifth of the change.
    **Source** `stopping.rigid.changing_sides`.
    """
    change = _gear_change(spec, scene)
    if not change.force:
        return {}
    line = running(spec, scene)
    found = dict(_moved(spec, scene, line, loads, _GEAR_WAVES * change.force))
    for name, load in loads.items():
        kind = family(name)
        used = loads.get(name.replace(kind, "slip_utilisation_max", 1))
        if kind in bounds.OF_GRIP and used is not None and used.low >= 1:
            found.pop(name, None)
        if kind in OF_STOP and math.isfinite(load.value):
            by = _GEAR_MARGIN * (change.time if kind == "stop_time" else change.way)
            found[name] = Interval(min(by, 0.0), max(by, 0.0))
    return found


EFFECTS = (
    Effect("belt_wave", "belt elasticity (longitudinal waves)", IN_MOTION, wave_criterion, wave_bound),
    Effect(
        "tail_jump",
        "wave reflection at the tail pulley",
        IN_MOTION,
        jump_criterion,
        jump_bound,
        part_of="belt_wave",
        calibrated=True,
    ),
    Effect(
        "tail_mass",
        "mass of the tail pulley",
        IN_MOTION,
        tail_mass_criterion,
        tail_mass_bound,
        part_of="belt_wave",
        calibrated=True,
    ),
    Effect(
        "sag",
        "belt sag between idlers",
        IN_MOTION,
        sag_criterion,
        sag_bound,
        part_of="belt_wave",
        calibrated=True,
    ),
    Effect(
        "coulomb_idlers",
        "stick-slip of the belt on the idlers",
        IN_MOTION,
        coulomb_criterion,
        coulomb_bound,
        part_of="belt_wave",
        calibrated=True,
    ),
    Effect(
        "takeup_mass",
        "inertia of the take-up weight",
        IN_MOTION,
        takeup_criterion,
        takeup_bound,
        part_of="belt_wave",
        calibrated=True,
    ),
    Effect(
        "viscous_idlers",
        "speed-dependent resistance",
        IN_MOTION,
        speed_criterion,
        speed_bound,
        part_of="belt_wave",
        calibrated=True,
    ),
    Effect(
        "belt_damping",
        "internal damping of the belt",
        IN_MOTION,
        damping_criterion,
        damping_bound,
        part_of="belt_wave",
        calibrated=True,
    ),
    Effect(
        "moving_belt",
        "convection of waves by the moving belt",
        IN_MOTION,
        travel_criterion,
        travel_bound,
        part_of="belt_wave",
        calibrated=True,
    ),
    Effect("slip", "belt slip at the drive pulleys", IN_MOTION, slip_criterion, slip_bound),
    Effect(
        "gear_losses",
        "side of the gear losses during a stop",
        frozenset({Stop, EmergencyStop, Coast}),
        gear_criterion,
        gear_bound,
    ),
)
