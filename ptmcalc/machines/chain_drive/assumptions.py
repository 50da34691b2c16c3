"""What is filled in where a design file leaves it out, and how wrong that may be."""

from collections.abc import Iterator
from dataclasses import replace

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.components.motor import ConverterMotor
from ptmcalc.components.motor_starts import constant_losses
from ptmcalc.components.plate_motor import of_the_plate
from ptmcalc.contract.machine import Assumption, Use
from ptmcalc.laws import chain_selection
from ptmcalc.machines.chain_drive.holding.scenes import asks_for_hold
from ptmcalc.machines.chain_drive.machine.chain_data import TailSprocket
from ptmcalc.machines.chain_drive.machine.layout import ConveyorLayout, TwoShafts
from ptmcalc.machines.chain_drive.machine.model import drive_of, filled
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Start, Stopping
from ptmcalc.machines.chain_drive.starting.permitted_starts import PERMITTED
from ptmcalc.numerics.harmonic.parts import ZENER
from ptmcalc.spec.scene import Scene

_STEEL = 2.06e11
"""Modulus of elasticity of steel [Pa], a handbook value. The assumed modulus of a chain is 0.5 to 0.8 of it; an error
of 2 % moves the frequencies by 1 %, far below that interval."""


def _needs_modulus(spec: ChainDrive) -> float | None:
    return 0.65 * _STEEL if spec.chain.stiffness is None else None


def _needs_ratio(spec: ChainDrive) -> float | None:
    damping = spec.chain.damping
    return 0.05 if damping.law != ZENER and damping.time is None else None


def _has(spec: ChainDrive, *types: type[Scene]) -> bool:
    return any(isinstance(scene, types) for scene in spec.all_scenes)


_STIFFNESS = (130.0, 80.0, 240.0)
"""Tensile stiffness EA of a standard chain relative to its breaking load [1]: middle and ends. Plates that break at 700
to 1000 MPa on their section, with an effective modulus of 0.4 to 0.8 of that of steel. A larger value raises the
natural frequencies, with its square root."""
_BUSH = 0.03
"""Error of the bearing length of a standard chain, which one table alone states [1]. The bearing pressure is inversely
proportional to the length."""


def _of_the_number(spec: ChainDrive) -> Iterator[Assumption[ChainDrive]]:
    """What the number of a roller chain stands for."""
    chain = spec.chain.standard
    if chain is None:
        return
    count, title = spec.chain.count, chain.title

    def between(
        key: str, quantity: units.Quantity, ends: tuple[float, float, float], source: str
    ) -> Assumption[ChainDrive]:
        value, low, high = ends
        stated = f"{title}: {source}"
        return Assumption(("chain", key), quantity, lambda spec: value, lambda spec: Interval(low, high), stated)

    def exactly(key: str, quantity: units.Quantity, value: float, source: str) -> Assumption[ChainDrive]:
        return between(key, quantity, (value, value, value), source)

    yield exactly("pitch", units.LENGTH, chain.pitch, "ISO 606")
    yield exactly("breaking_load", units.FORCE, chain.breaking_load, f"minimum tensile strength, {chain.edition}")
    yield exactly("pin_diameter", units.LENGTH, chain.pin_diameter, "largest pin diameter, ISO 606")
    mass = (count * chain.mass, count * chain.mass_low, count * chain.mass_high)
    yield between("mass", units.LINE_MASS, mass, "range of manufacturers; the standard does not fix it")
    length = chain.pin_length
    ends = (length, length * (1 - _BUSH), length * (1 + _BUSH))
    yield between("bush_length", units.LENGTH, ends, "width over the inner link, all rows; from one table")
    if spec.chain.section is None:
        strength = spec.chain.given_breaking_load or chain.breaking_load
        middle, low, high = (share * strength for share in _STIFFNESS)
        source = "80 to 240 times the breaking load, from the section of the plates; measure it"
        yield between("stiffness", units.FORCE, (middle, low, high), source)


_OF_THE_CHAIN: tuple[Assumption[ChainDrive], ...] = (
    Assumption(
        ("chain", "modulus"),
        units.STRESS,
        _needs_modulus,
        lambda spec: Interval(0.5 * _STEEL, 0.8 * _STEEL),
        "clearance of pins and bushes reduces the modulus to 0.5 to 0.8 of that of steel"
        " on the section of the plates; measure it",
    ),
    Assumption(
        ("chain", "damping", "ratio"),
        units.RATIO,
        _needs_ratio,
        lambda spec: Interval(0.03, 0.08),
        "conveyor chains: damping ratio 0.03 to 0.08 in the first mode; measure it",
    ),
    Assumption(
        ("chain", "unevenness"),
        units.RATIO,
        lambda spec: 1.2 if spec.chain.rows > 1 else None,
        lambda spec: Interval(1.1, 1.25),
        "load distribution factor of parallel chains 1.1 to 1.25",
    ),
)

_ROTOR_SHARE = 0.05
"""Upper limit of the inertia of a sprocket that the file omits, relative to the rotors on the same shaft [1]. An
engineering choice. A larger value widens the error bars; a smaller one excludes heavy sprockets."""


def _sprocket(spec: ChainDrive) -> Interval:
    """Inertia of a sprocket on the shaft of the drive sprocket."""
    if spec.drive is None:
        return Interval(0.0, 0.0)
    motor = spec.drive.motor
    return Interval(0.0, _ROTOR_SHARE * motor.count * filled(motor.inertia) * spec.drive.gear.ratio**2)


_SLIP = 0.3
"""Tolerance of the rated slip of a motor relative to it [1]: IEC 60034-1, 20 %, below 1 kW 30 %. The larger one covers
gears and unequal heating. A larger value widens the interval of the share of a driven tail."""


def _own_slip_lines(spec: ChainDrive, tail: TailSprocket) -> bool:
    """Whether both drives share their load by the slip of several equal motors on the mains: the teeth keep both
    sprockets at one speed, and so both motors where the sprockets are equal."""
    drive = spec.drive
    if drive is None or drive.motor.count == 1 or tail.synchronised == "on" or drive.fluid_coupling is not None:
        return False
    if any(isinstance(scene, Start) and scene.profile.imposes_speed for scene in spec.all_scenes):
        return False  # on converters
    motor = drive.motor
    slips = motor.has_plate or (motor.curve is not None and not isinstance(motor.curve, ConverterMotor))
    return slips and tail.teeth in (None, spec.sprocket.teeth)


def _of_driven_tail(tail: TailSprocket, spec: ChainDrive) -> Assumption[ChainDrive]:
    """Share of a driven tail in the effective chain pull.

    F_i = c_i (n_0 - n), c_i = M_n/s_i, one n:   s = (k/s_t)/(k/s_t + (N - k)/s_h),   1 <= k <= N - 1 of N motors
    """
    interval, source = Interval(0.0, 1.0), "the control of both drives or the position of a shaft sets it: 0 to 1"
    if _own_slip_lines(spec, tail):
        others = drive_of(spec).motor.count - 1
        least = (1 - _SLIP) / (1 - _SLIP + others * (1 + _SLIP))
        interval = Interval(least, 1 - least)
        source = "equal motors on their slip lines, one or more at either sprocket, slips within 30 % (IEC 60034-1)"
    value = 0.5 if tail.driven == "on" else None
    return Assumption(("layout", "tail", "share"), units.RATIO, lambda spec: value, lambda spec: interval, source)


_OF_A_CONVEYOR: tuple[Assumption[ChainDrive], ...] = (
    Assumption(
        ("layout", "tail", "inertia"),
        units.INERTIA,
        lambda spec: 0.0 if spec.drive is not None and _has(spec, Start, Stopping) else None,
        _sprocket,
        "neglected; seldom above 5 % of the rotor inertia at the shaft of the drive sprocket",
    ),
    Assumption(
        ("layout", "resistance", "turn_factor"),
        units.RATIO,
        lambda spec: 1.1,
        lambda spec: Interval(1.05, 1.2),
        "deflections at two sprockets cause 5 to 20 % of the resistances",
    ),
    Assumption(
        ("layout", "resistance", "start_factor"),
        units.RATIO,
        lambda spec: 1.2 if _has(spec, Start) else None,
        lambda spec: Interval(1.0, 1.5),
        "common practice: 1.2 to 1.5 times the running resistance",
        Use(scenes=frozenset({Start})),
    ),
    Assumption(
        ("layout", "resistance", "stop_factor"),
        units.RATIO,
        lambda spec: 0.8 if _has(spec, Stopping) or any(asks_for_hold(spec, one) for one in spec.all_scenes) else None,
        lambda spec: Interval(0.6, 1.0),
        "a warm running chain has 0.6 to 1 times its design resistance",
    ),
)

_MOVED: tuple[Assumption[ChainDrive], ...] = (
    Assumption(
        ("sprocket", "inertia"),
        units.INERTIA,
        lambda spec: 0.0 if spec.drive is not None and _has(spec, Start, Stopping) else None,
        _sprocket,
        "neglected; seldom above 5 % of the rotor inertia at the same shaft",
    ),
)

_SERVICE: Assumption[ChainDrive] = Assumption(
    ("layout", "service_factor"),
    units.RATIO,
    lambda spec: 1.4,
    lambda spec: Interval(1.0, 2.1),
    "ISO 10823: 1 for smooth to 2.1 for heavily shocked machines",
)


def _of_two_shafts(layout: TwoShafts) -> Assumption[ChainDrive]:
    """Application factor f_1, by the classes of the file where it gives them."""
    if layout.service is None:
        return _SERVICE
    driver, machine = layout.service.driver, layout.service.machine
    factor = chain_selection.application_factor(driver, machine)
    return replace(
        _SERVICE,
        value=lambda spec: factor,
        interval=lambda spec: Interval(factor, factor),
        source=f"ISO 10823:2004: {driver} driver, driven machine {machine}",
    )


_SAG_SHARE = 0.5
"""Change of the sag of the slack strand in service, relative to it [1]: 1 to 3 % of the span at a mean of 2 %, the
usual range of chain drives. A larger value widens the error bars of the natural frequencies of the spans."""


def _sag_in_service(spec: ChainDrive, layout: TwoShafts) -> Iterator[Assumption[ChainDrive]]:
    """Ends of the sag, where the natural frequencies of the spans are checked."""
    if spec.checks.span_resonance is None:
        return
    yield _sag_end("slack_sag_least", (1 - _SAG_SHARE) * layout.slack_sag)
    yield _sag_end("slack_sag_most", (1 + _SAG_SHARE) * layout.slack_sag)


def _sag_end(key: str, sag: float) -> Assumption[ChainDrive]:
    return Assumption(
        ("layout", key),
        units.RATIO,
        lambda spec: sag,
        lambda spec: Interval(sag, sag),
        "wear and tensioning change the sag of a slack strand by a half: 1 to 3 % at a mean of 2 %",
    )


def assumptions(spec: ChainDrive) -> Iterator[Assumption[ChainDrive]]:
    """What is assumed of the chain, of where it runs, of its drive and of its wear."""
    yield from _of_the_number(spec)
    yield from _OF_THE_CHAIN
    if spec.drive is not None:
        yield from of_the_plate(("drive", "motor"), spec.drive.motor, Use(scenes=frozenset({Start})))
    yield from _MOVED
    if isinstance(spec.layout, ConveyorLayout):
        yield from _OF_A_CONVEYOR
        yield _of_driven_tail(spec.layout.tail, spec)
    else:
        yield _of_two_shafts(spec.layout)
        yield from _sag_in_service(spec, spec.layout)
    if spec.drive is not None:
        ratio = spec.drive.gear.ratio
        yield Assumption(
            ("drive", "gear", "efficiency"),
            units.RATIO,
            lambda spec: 0.94,
            lambda spec: Interval(1.0, 1.0) if ratio == 1 else Interval(0.90, 0.97),
            "two to three stages of helical or bevel gears, 0.98 to 0.99 each",
        )
        yield Assumption(
            ("drive", "coupling_inertia"),
            units.INERTIA,
            lambda spec: 0.15 * filled(drive_of(spec).motor.inertia),
            lambda spec: Interval(*(part * filled(drive_of(spec).motor.inertia) for part in (0.10, 0.25))),
            "couplings and gear increase the rotor inertia by a factor of 1.1 to 1.25 (lecture notes, Kramatorsk 2007)",
        )
        if spec.drive.motor.no_load_starts is not None:
            yield constant_losses(("drive", "motor"), Use(frozenset({Start}), frozenset({PERMITTED.name})))
    if spec.wear is not None:
        yield Assumption(
            ("wear", "elongation"),
            units.RATIO,
            lambda spec: 0.04,
            lambda spec: Interval(0.03, 0.06),
            "3 to 6 % by the type of chain and sprocket (lecture notes, Kramatorsk 2007)",
        )
