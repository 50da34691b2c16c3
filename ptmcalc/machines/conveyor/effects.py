"""The effects a start of a conveyor may call for.

Bounds marked *calibrated* have the form that perturbation theory gives, with a factor from the seeded samples of
`tests/coverage` (about 1900 machines, seeds 11 and 21) and a margin on its largest value; the coverage tests hold
them on other seeds.
"""

import math
from collections.abc import Mapping

import numpy as np

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.laws import loop_bounds, sag, wave
from ptmcalc.laws.loop_bounds import CARRY, RETURN
from ptmcalc.machines.conveyor import bounds
from ptmcalc.machines.conveyor.model import StartCase, start_case
from ptmcalc.machines.conveyor.spec import Conveyor, Start

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]

WAVE_THRESHOLD = 0.05
JUMP_THRESHOLD = 0.02
TAIL_MASS_THRESHOLD = 0.01
SAG_THRESHOLD = 0.05

_JUMP_FACTOR = 2.5
_TAIL_MASS_FACTOR = 5.0
_SAG_FACTOR = 0.4

_X = np.linspace(0.0, 1.0, 33)


def _anything(case: StartCase, loads: Loads) -> Offsets:
    """No bound for any load that the motion of the belt can change."""
    return {name: ANYTHING for name in bounds.changed_by_motion(case) if name in loads}


def wave_criterion(spec: Conveyor, scene: Start) -> Criterion:
    """Largest stray of the tension from the rigid body's, over the static tension of the same section.

        E = max over the belt of a b(s) g / S_static(s)

    with a b(s) the bound of a step (`laws.loop_bounds.stray`) and g what the profile leaves of it
    (`laws.start_profile.phases`).

    **Range** any start; infinite where a section has no static tension.
    **Error** an upper bound of the ratio.
    **Source** derived in `laws.loop_bounds`; the threshold of 5 % is an engineering choice.
    """
    value = bounds.stray_ratio(start_case(spec, scene))
    return Criterion(
        "E", value, WAVE_THRESHOLD, "tension the belt's waves can add, over the static tension", "laws.loop_bounds"
    )


def wave_bound(spec: Conveyor, scene: Start, loads: Loads) -> Offsets:
    """Interval of every load of the rigid body that holds all waves of the belt.

        S_static + a r - a b g <= S <= S_static + a r + a b g,   phase by phase

    A belt softened by sag is a linear belt of lower stiffness as long as the softening is the same over the swing:
    below 5 % anywhere, or changing by less than 5 % over the swing; then the lowest frequency is taken of the softest
    belt. A belt that sags more is unbounded.

    **Range** linear undamped belt without slip; any jump of impedance and tail mass.
    **Error** a bound; at the run-on of a gravity take-up under a torque step it is attained.
    **Source** derived in `laws.loop_bounds` (completeness of the modes, Cauchy-Schwarz, Dunkerley).
    """
    case = start_case(spec, scene)
    softening = None if spec.effects.get("sag") == "off" else bounds.largest_softening(case)
    if softening is None or softening < SAG_THRESHOLD:
        return bounds.offsets(case, bounds.enclose(case, softening or 0.0), loads)
    enclosure = _gently_sagging(case)
    return bounds.offsets(case, enclosure, loads) if enclosure else _anything(case, loads)


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


def jump_criterion(spec: Conveyor, scene: Start) -> Criterion:
    """Part of a wave that the tail sends back because carry and return strand differ.

        r = |Z1 - Z2|/(Z1 + Z2)

    **Range** any belt.
    **Error** exact.
    **Source** `laws.wave.reflection`; the threshold of 2 % is an engineering choice.
    """
    line = start_case(spec, scene).line
    value = abs(wave.reflection(line.impedance(CARRY), line.impedance(RETURN)))
    return Criterion("r", value, JUMP_THRESHOLD, "part of a wave the tail reflects", "laws.wave.reflection")


def jump_bound(spec: Conveyor, scene: Start, loads: Loads) -> Offsets:
    """Change of any tension when the return strand is given the impedance of the carry strand.

        d = r a M_belt + min(2.5 r sqrt(1 + n), 2) a b_max g

    The first term is the change of the return strand's mass (2 r of it); the second grows with the number n of
    contour times in the window and is capped by the stray of both motions.

    **Range** r below 0.02; unbounded above.
    **Error** calibrated: the largest value of the sample was 1.6 in place of 2.5.
    **Source** perturbation of the reflected waves; coverage sample.
    """
    r = jump_criterion(spec, scene).value
    return _small_change(start_case(spec, scene), loads, r, r < JUMP_THRESHOLD, _JUMP_FACTOR)


def tail_mass_criterion(spec: Conveyor, scene: Start) -> Criterion:
    """Mass of the tail drum over that of belt and load.

        m_t/m_belt

    **Range** any belt.
    **Error** exact.
    **Source** the threshold of 1 % is an engineering choice.
    """
    masses = start_case(spec, scene).masses
    value = masses.tail_mass / (masses.return_mass + masses.carry_mass)
    return Criterion("m_t/m_b", value, TAIL_MASS_THRESHOLD, "tail drum over belt and load", "Newton's law")


def tail_mass_bound(spec: Conveyor, scene: Start, loads: Loads) -> Offsets:
    """Change of any tension when the tail drum is taken without mass.

        d = e a M_belt + min(5 e sqrt(1 + n), 2) a b_max g,   e = m_t/m_belt

    The first term is the pull of the drum itself; the second as in `jump_bound`.

    **Range** m_t/m_belt below 0.01; unbounded above.
    **Error** calibrated: the largest value of the sample was 3.4 in place of 5.
    **Source** perturbation of the tail's equation of motion; coverage sample.
    """
    share = tail_mass_criterion(spec, scene).value
    return _small_change(start_case(spec, scene), loads, share, share < TAIL_MASS_THRESHOLD, _TAIL_MASS_FACTOR)


def _small_change(case: StartCase, loads: Loads, share: float, known: bool, factor: float) -> Offsets:
    if not known:
        return _anything(case, loads)
    if share == 0:
        return {}
    change = share * case.acceleration * case.masses.belt_mass + _grown(case, factor * share)
    return bounds.spread(case, loads, change)


def _grown(case: StartCase, share: float) -> float:
    """A share of the largest stray that grows with the root of the echoes, capped by two strays [N]."""
    contours = case.window / case.line.contour_time
    swing = case.acceleration * max(float(loop_bounds.stray(case.masses, which, _X).max()) for which in (RETURN, CARRY))
    factor = max(phase.stray for phase in case.phases(loop_bounds.lowest_frequency_bound(case.masses)))
    return min(share * math.sqrt(1 + contours), 2.0) * swing * factor


def sag_criterion(spec: Conveyor, scene: Start) -> Criterion | None:
    """Softening of the belt by sag at the lowest tension the waves can bring.

        f = EA (w l)^2/(12 S_low^3)

    **Range** any start with idler pitches given; infinite where the belt can lose its tension.
    **Error** an upper bound, as S_low is the lower end of the wave bound.
    **Source** Ernst (`laws.sag.softening`); the threshold of 5 % is an engineering choice.
    """
    value = bounds.largest_softening(start_case(spec, scene))
    if value is None:
        return None
    return Criterion("f", value, SAG_THRESHOLD, "give of the sagging spans over that of the belt", "laws.sag.softening")


def sag_bound(spec: Conveyor, scene: Start, loads: Loads) -> Offsets:
    """Change of any tension when the sagging spans are taken as straight.

        d = min(0.4 f sqrt(1 + n), 2) a b_max g,   f at the lowest tension the run found

    **Range** f below 0.05 at the lowest tension of the run; unbounded above, and where the run does not know it.
    **Error** calibrated: the largest value of the sample was 0.17 in place of 0.4.
    **Source** perturbation of the compliance; coverage sample.
    """
    case = start_case(spec, scene)
    lowest = loads["tension_min"].low if "tension_min" in loads else -math.inf
    spans = [span for span in (case.line.back.span_weight, case.line.carry.span_weight) if span]
    if not spans:
        return {}
    softest = max(float(sag.softening(case.line.stiffness, span, lowest)) for span in spans)
    if softest >= SAG_THRESHOLD:
        return _anything(case, loads)
    return bounds.spread(case, loads, _grown(case, _SAG_FACTOR * softest))


def slip_criterion(spec: Conveyor, scene: Start) -> Criterion | None:
    """Most of the drum's grip that the start can use, by the wave bound.

        U_b = (S_on - rho v^2)/((S_off - rho v^2) exp(mu alpha)) at the bounds of both sides

    **Range** any start with the friction of the drum given.
    **Error** an upper bound.
    **Source** Euler-Eytelwein (`laws.capstan`), tensions from `laws.loop_bounds`; the threshold is 1/k_T of the file.
    """
    case = start_case(spec, scene)
    if case.line.grip_exponent is None:
        return None
    held = bounds.enclosed_loads(case, bounds.enclose(case))["slip_utilisation_max"]
    return Criterion(
        "U_b",
        held.high,
        1 / spec.checks.slip.reserve,
        "most of the drum's grip the start can use",
        "laws.capstan",
    )


def slip_bound(spec: Conveyor, scene: Start, loads: Loads) -> Offsets:
    """A belt that never comes to the limit of its grip never slips: then nothing changes, else anything.

        U_max < 1 with its whole bar  =>  no change

    **Range** any run that knows the utilisation.
    **Error** exact.
    **Source** slip starts where U reaches 1 (`laws.capstan`).
    """
    used, case = loads.get("slip_utilisation_max"), start_case(spec, scene)
    return {} if used is not None and used.high < 1 else _anything(case, loads)


_START = frozenset({Start})

EFFECTS = (
    Effect("belt_wave", "belt elasticity: waves", _START, wave_criterion, wave_bound),
    Effect(
        "tail_jump",
        "impedance jump at the tail",
        _START,
        jump_criterion,
        jump_bound,
        part_of="belt_wave",
        calibrated=True,
    ),
    Effect(
        "tail_mass",
        "mass of the tail drum",
        _START,
        tail_mass_criterion,
        tail_mass_bound,
        part_of="belt_wave",
        calibrated=True,
    ),
    Effect(
        "sag",
        "sag of the belt between idlers",
        _START,
        sag_criterion,
        sag_bound,
        part_of="belt_wave",
        calibrated=True,
    ),
    Effect("slip", "slip at the drive drum", _START, slip_criterion, slip_bound),
)
