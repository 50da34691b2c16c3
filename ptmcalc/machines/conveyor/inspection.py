"""Values of a file that disagree with each other."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.result import Finding
from ptmcalc.machines.conveyor.machine.motion import on_slip_lines
from ptmcalc.machines.conveyor.machine.plausible import implausible
from ptmcalc.machines.conveyor.machine.scenes import EmergencyStop, Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.waves.effects.damping import jumps

_SPEED_TOLERANCE = 0.05
"""Difference of two belt speeds of a file from which on SPC201 is reported [1]. An engineering choice: a smaller value
reports rounded ratios and diameters, a larger one accepts wrong entries."""
_WEIGHT_TOLERANCE = 0.05
"""Difference of the take-up tension from half of the weight from which on SPC201 is reported [1]. An engineering
choice: a smaller value reports rounded masses, a larger one accepts the whole weight as tension."""
_MOST_FRICTION = 1.0
"""Friction coefficient of belt and pulley above which SPC201 is reported [1]. An engineering choice above the 0.8 of
ceramic tiles. A smaller value reports valid linings; a larger one accepts percentages and misprints."""
_STEEP = 0.309
"""Sine of 18 degrees [1]: the slope above which `small_angle` is reported, where the cosine is 5 % below 1. An
engineering choice; a smaller value reports slopes whose cosine is close to 1."""


def inspect(spec: Conveyor) -> Iterator[Finding]:
    """Values of the file that disagree with each other."""
    for name, drive in spec.all_drives.items():
        motor = drive.motor.speed
        rim = motor / drive.gear.ratio * drive.drum.diameter / 2 if motor is not None else spec.speed
        if abs(rim / spec.speed - 1) > _SPEED_TOLERANCE:
            whose = f" of `{name}`" if len(spec.all_drives) > 1 else ""
            yield Finding(
                "SPC201",
                f"motor speed, gear ratio and pulley{whose} result in {units.show(rim, units.SPEED)} at the pulley"
                f" surface, the belt runs at {units.show(spec.speed, units.SPEED)}",
                ("speed",),
                "correct the speed, the ratio or the diameter",
            )
        grip = drive.drum.friction
        if grip is not None and grip > _MOST_FRICTION:
            yield Finding(
                "SPC201",
                f"a friction coefficient of {grip:.4g} between belt and pulley: dry rubber lagging reaches 0.45,"
                " ceramic lagging 0.8",
                (*spec.drive_path(name), "drum", "friction"),
                "write `friction: 0.35` for rubber lagging, or the manufacturer's value",
            )
    pull = spec.takeup.mass * spec.gravity / 2 if spec.takeup.mass is not None else spec.takeup.tension
    if abs(pull / spec.takeup.tension - 1) > _WEIGHT_TOLERANCE:
        yield Finding(
            "SPC201",
            f"a take-up weight on two falls results in half of its weight force, {units.show(pull, units.FORCE)};"
            f" the tension is {units.show(spec.takeup.tension, units.FORCE)}",
            ("takeup", "mass"),
            f"write `mass: {units.show(2 * spec.takeup.tension / spec.gravity, units.MASS)}`, or correct the tension",
        )
    yield from implausible(spec)
    yield from _of_scenes(spec)
    yield from _of_curves(spec)
    if spec.route.inclination == "small_angle" and abs(spec.route.climb) > _STEEP * spec.route.span:
        yield Finding(
            "SPC201",
            "the slope is above 18 degrees: its cosine is not 1",
            ("route", "inclination"),
            "write `inclination: exact`",
        )


def _of_curves(spec: Conveyor) -> Iterator[Finding]:
    """Curves between equal slopes, and curves that do not fit between their neighbours."""
    parts, curves = spec.route.parts, {curve.number: curve for curve in spec.route.curves}
    reach = [0.0] * (len(parts) + 1)
    for number, curve in curves.items():
        reach[number - 1] = curve.tangent
    for index, part in enumerate(parts):
        path: KeyPath = ("route", "sections", index, "curve_radius")
        if part.curve_radius is not None and index + 1 not in curves:
            yield Finding(
                "SPC201", "the section before has the same slope: there is no curve", path, "delete `curve_radius`"
            )
        if reach[index] + reach[index + 1] > part.length * (1 + 1e-9):
            taken, given = (units.show(value, units.SPAN) for value in (reach[index] + reach[index + 1], part.length))
            at = index if index + 1 in curves else index + 1
            yield Finding(
                "SPC201",
                f"the vertical curves at its ends require {taken}; section {index + 1} has a length of {given}",
                ("route", "sections", at, "curve_radius"),
                "write a smaller `curve_radius`, or longer sections",
            )


def _of_scenes(spec: Conveyor) -> Iterator[Finding]:
    """What a scene asks for and the machine does not have."""
    late = [name for name, drive in spec.all_drives.items() if drive.delay > 0]
    for index, scene in enumerate(spec.scenes or ()):
        path: KeyPath = ("scenes", index)
        lifts = [part.lift for part in spec.route.parts]
        if (scene.load == "uphill" and max(lifts) <= 0) or (scene.load == "downhill" and min(lifts) >= 0):
            does = "climbs" if scene.load == "uphill" else "falls"
            yield Finding(
                "SPC201", f"no section of the route {does}: the belt is empty", (*path, "load"), "write `load: empty`"
            )
        if jumps(spec, scene):
            yield Finding(
                "SPC201",
                "the force of a Kelvin-Voigt belt is infinite at a pulley that stops at once: the jam is computed"
                " without damping",
                path,
                "write `time: 50 ms`, the stopping time of the pulley",
            )
        if isinstance(scene, EmergencyStop) and not spec.brakes:
            yield Finding(
                "SPC201",
                "there are no `brakes`: the belt coasts",
                (*path, "type"),
                "add `brakes: {disc: {torque: 3000 N*m}}`, or write `type: coast`",
            )
        if isinstance(scene, Start) and scene.profile.imposes_speed and late and not on_slip_lines(spec, scene):
            yield Finding(
                "SPC201",
                f"an imposed speed turns all pulleys at once: the `delay` of `{late[0]}` has no effect",
                (*path, "profile"),
                "write `control: torque`",
            )
