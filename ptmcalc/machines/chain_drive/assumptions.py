"""What is filled in where a design file leaves it out, and how wrong that may be."""

from collections.abc import Iterator

from ptmcalc.base import units
from ptmcalc.base.estimate import Interval
from ptmcalc.components.plate_motor import of_the_plate
from ptmcalc.contract.machine import Assumption, Use
from ptmcalc.machines.chain_drive.holding.scenes import asks_for_hold
from ptmcalc.machines.chain_drive.layout import ConveyorLayout
from ptmcalc.machines.chain_drive.model import drive_of, filled
from ptmcalc.machines.chain_drive.spec import ChainDrive, Start, Stopping
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
        lambda spec: 1.2 if spec.chain.count > 1 else None,
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

_OF_TWO_SHAFTS: tuple[Assumption[ChainDrive], ...] = (
    Assumption(
        ("layout", "service_factor"),
        units.RATIO,
        lambda spec: 1.4,
        lambda spec: Interval(1.0, 2.1),
        "ISO 10823: 1 for smooth to 2.1 for heavily shocked machines",
    ),
)


def assumptions(spec: ChainDrive) -> Iterator[Assumption[ChainDrive]]:
    """What is assumed of the chain, of where it runs, of its drive and of its wear."""
    yield from _OF_THE_CHAIN
    if spec.drive is not None:
        yield from of_the_plate(("drive", "motor"), spec.drive.motor, Use(scenes=frozenset({Start})))
    yield from _MOVED
    yield from _OF_A_CONVEYOR if isinstance(spec.layout, ConveyorLayout) else _OF_TWO_SHAFTS
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
    if spec.wear is not None:
        yield Assumption(
            ("wear", "elongation"),
            units.RATIO,
            lambda spec: 0.04,
            lambda spec: Interval(0.03, 0.06),
            "3 to 6 % by the type of chain and sprocket (lecture notes, Kramatorsk 2007)",
        )
