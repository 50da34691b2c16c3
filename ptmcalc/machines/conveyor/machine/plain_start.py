"""Starts that the plain models of the belt cover: one slope, one drive, no stick-slip, no damping."""

import math

from ptmcalc.base.memory import kept_for
from ptmcalc.contract.effect import Criterion
from ptmcalc.laws import capstan
from ptmcalc.laws.loop_bounds import RETURN
from ptmcalc.machines.conveyor.machine.model import BeltLine, belt_line
from ptmcalc.machines.conveyor.machine.scenes import ConveyorScene, Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import lowest_frequency, start_case


def is_plain(spec: Conveyor, scene: ConveyorScene) -> bool:
    """Whether a scene is a start of a uniform belt on one slope by one drive."""
    return not plainness(spec, scene).exceeded


SPEED_SHARE_THRESHOLD = 0.05
"""Share of the idler resistance that is proportional to the speed [1] from which on it is simulated. An engineering
choice. Below it the error bar is at most 15 % of the idler resistance in a start; in other scenes it is 60 %, and 10 %
of the lowest tensions and the worst traction of a stop."""


def delay_lines_do(spec: Conveyor, scene: Start) -> bool:
    """Whether strands that are pure delays carry all of a start: nothing sticks, turns back or damps on the way, and no
    weight swings."""
    steady = spec.resistance.speed_share < SPEED_SHARE_THRESHOLD
    damped = spec.belt.damping is not None and spec.effects.get("belt_damping") != "off"
    slides = scene.belt == "frozen" and not (spec.effects.get("coulomb_idlers") != "off" and thrown_back(spec, scene))
    light = not spec.takeup_weight or takeup_inertia(spec, scene) < 1
    return is_plain(spec, scene) and slides and light and steady and not damped


def takeup_inertia(spec: Conveyor, scene: Start) -> float:
    """Inertia of the take-up weight in a start relative to the threshold of its effect.

        max(kappa/0.1, (a_0/g)/0.03),   kappa = T_0 w_1/(2 g Z_2),   a_0 = |F|/m_drive

    **Range** a gravity take-up with the weight that its tension requires.
    **Error** an estimate: w_1 is a lower bound of the lowest natural frequency.
    **Source** take-up weight on two falls; thresholds are an engineering choice.
    """
    line = belt_line(spec, scene)
    return inertia_of_weight(spec, line, start_case(spec, scene).excess)


def inertia_of_weight(spec: Conveyor, line: BeltLine, force: float) -> float:
    """`takeup_inertia` for a force on the drive drum alone [N]."""
    kappa, drum = takeup_numbers(spec, line, force)
    return max(kappa / 0.1, drum / spec.gravity / 0.03)


def takeup_numbers(spec: Conveyor, line: BeltLine, force: float) -> tuple[float, float]:
    """kappa [1], and the acceleration of the drum alone under a force [m/s^2]."""
    slowest = math.pi / (2 * line.contour_time)
    kappa = line.takeup_tension * slowest / (2 * spec.gravity * line.impedance(RETURN))
    return kappa, force / line.drive_mass


_SHARP = 0.75
"""Rise of an imposed speed relative to the longest period of the waves [1] from which on no part of the belt turns
back. Calibrated: none of 600 random belts turned back above 0.57. A larger value simulates stick-slip more often; a
smaller one loses the safety."""


def thrown_back(spec: Conveyor, scene: Start) -> bool:
    """Whether an imposed speed rises so sharply that waves may turn some of the belt back.

        t_rise w_1/(2 pi) < 0.75

    **Range** one drive; a force never turns the belt back that it starts.
    **Error** w_1 is a lower bound. A uniform loop turns back below 0.39 (ramp), 0.5 (cosine); of 600 random ones none
    did above 0.57.
    **Source** residual of a rise at the free end of a quarter-wave, 4/pi times that of an oscillator.
    """
    case = start_case(spec, scene)
    if not case.imposed_speed:
        return False
    return case.rise_time * lowest_frequency(case) < _SHARP * 2 * math.pi


@kept_for(64)
def slides_at_rest(spec: Conveyor, scene: Start) -> Criterion:
    """Whether the drum cannot hold the belt that lies with the friction of its running frozen in it.

        U_0 = S_tight/(S_slack exp(mu alpha)),   0 without friction given, or where slip is forced off

    Such a belt slides back on its drum before it starts, and the friction of its idlers turns round.

    **Range** one drive.
    **Error** exact.
    **Source** Euler-Eytelwein.
    """
    line = belt_line(spec, scene)
    used = 0.0
    if line.grip_exponent is not None and spec.effects.get("slip") != "off":
        tight, slack = max(line.run_on, line.run_off), min(line.run_on, line.run_off)
        used = float(capstan.slip_utilisation(tight, slack, 0.0, line.grip_exponent))
    meaning = "traction utilisation at standstill: at 1 the belt slips on its pulley before it starts"
    return Criterion("U_0", used, 1.0, meaning, "laws.capstan")


@kept_for(64)
def plainness(spec: Conveyor, scene: ConveyorScene) -> Criterion:
    """Whether a solver of the plain start can take the machine.

        n = slopes and loads along a strand + drives + 1 for an aborted start, + 1 for a motor's curve or a table, + 1
        for a take-up weight at the tail or with known stops, + 1 for horizontal curves, + 1 for converters with
        their own data

    A relaxed belt is taken as one with the running friction frozen in it; the effect `coulomb_idlers` says by how much.

    **Range** any start.
    **Error** exact: a count.
    **Source** the plain start has one of each, n = 2.
    """
    line = belt_line(spec, scene)
    parts = max(1 if strand.even else len(strand.masses) for strand in (line.carry, line.back))
    unusual = isinstance(scene, Start) and (scene.aborted is not None) + (scene.profile.shape in ("curve", "table"))
    count = (
        parts
        + len(spec.all_drives)
        + unusual
        + (line.weight_at_tail or (spec.takeup.budgeted and not line.fixed_length))
        + bool(spec.route.bends)
        + any(drive.converter is not None for drive in spec.all_drives.values())
    )
    meaning = "slopes, drives, aborted starts, curves and tables: 2 for one slope and one drive"
    return Criterion("n", count, 3, meaning, "count")
