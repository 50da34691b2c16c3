"""Checks of traction: belt slip at the drive pulleys, and its heat."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, needs, no_needs, no_repair
from ptmcalc.contract.limits import key
from ptmcalc.contract.result import of
from ptmcalc.machines.conveyor.machine.brakes import brakes_of, braking
from ptmcalc.machines.conveyor.machine.governing_keys import TENSION, blame_tension, starting_torque_key, takeup_tension
from ptmcalc.machines.conveyor.machine.keys.drives import Drive
from ptmcalc.machines.conveyor.machine.model import belt_line, starting_force
from ptmcalc.machines.conveyor.machine.scenes import (
    ANY_MOTION,
    IN_MOTION,
    ConveyorScene,
    EmergencyStop,
    Jam,
    Start,
    Stop,
)
from ptmcalc.machines.conveyor.machine.spec import Conveyor

Loads = Mapping[str, Estimate]
Checks = Iterable[AnyCheck]

_GRIPPING = ANY_MOTION - {Jam}
"""Scenes in which a drum has to hold the belt: over a jammed one it must slip."""


_LEAST_WRAP = 2.8
"""Wrap angle below which a failed check names it as the cause [rad]: 160 deg. An engineering choice. A larger value
names the wrap more often; no verdict depends on it."""


_LEAST_GRIP = 0.6931471805599453
"""Exponent mu alpha below which a failed check names the friction as the cause [1]: at ln 2 a pulley transmits the
leaving tension. An engineering choice. A larger value names the friction more often; no verdict depends on it."""


_NO_RESERVE = math.nextafter(1, 0)  # just below any k_T


_STRONG_START = 1.5
"""Starting force relative to static resistance above which a failed check names the start as the cause [1]: the usual
upper limit of practice. A smaller value names the start more often; no verdict depends on it."""


def _slip_value(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Estimate:
    """Traction reserve by the definition in the file: of the force, or of the tension ratio (1/U).

    The force reserve neglects the centrifugal tension. A belt at U = 1 slips for any force reserve, and its reserve is
    0.

    **Range** any state of the pulley; infinite if it transmits no force.
    **Error** that of the load.
    **Source** `laws.capstan`.
    """
    used = loads["slip_utilisation_max"]
    if spec.checks.slip.definition == "force":
        left = loads["slip_reserve_min"]
        value, low, high = (
            min(reserve, _NO_RESERVE) if state >= 1 else reserve
            for reserve, state in ((left.value, used.value), (left.low, used.high), (left.high, used.low))
        )
        return Estimate(value, low, high, left.numerical, left.model)
    value, low, high = (_inverse(part) for part in (used.value, used.high, used.low))
    return Estimate(value, low, high, used.numerical / used.value**2, used.model / used.value**2)


def _inverse(value: float) -> float:
    return 1 / value if value > 0 else float("inf")


def _blame_slip(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> KeyPath:
    """The key that stands out: a small wrap, a poor friction, a violent start; else the take-up tension."""
    return _blame_grip(spec, scene, spec.main_path, spec.main_drive)


def _blame_grip(spec: Conveyor, scene: ConveyorScene, path: KeyPath, drive: Drive) -> KeyPath:
    drum = drive.drum
    if drum.wrap < _LEAST_WRAP:
        return (*path, "drum", "wrap")
    if drum.friction is not None and drum.friction * drum.wrap < _LEAST_GRIP:
        return (*path, "drum", "friction")
    if isinstance(scene, Start) and starting_force(spec) > _STRONG_START * max(
        belt_line(spec, scene).static_resistance, 0
    ):
        return TENSION if scene.profile.imposes_speed else starting_torque_key(spec, path)
    if isinstance(scene, Stop | EmergencyStop) and (acting := brakes_of(spec, scene)):
        return ("brakes", max(acting, key=lambda name: braking(spec, acting[name]).force), "torque")
    return TENSION


def _slip_checks(spec: Conveyor, scene: ConveyorScene) -> Iterator[Check[Conveyor, ConveyorScene]]:
    """The drum's own, or one for each drum where there are several."""
    if len(spec.all_drives) == 1:
        yield SLIP
        return
    for name, drive in spec.all_drives.items():
        path = spec.drive_path(name)
        used, left = of("slip_utilisation_max", name), of("slip_reserve_min", name)
        yield replace(
            SLIP,
            each=None,
            element=name,
            loads=(left, used),
            value=_slip_value_of(left, used),
            needs=needs((*path, "drum", "friction")),
            blame=_blames_grip(path, drive),
        )


def _slip_value_of(left: str, used: str) -> Callable[[Conveyor, ConveyorScene, Loads], Estimate]:
    def value(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Estimate:
        return _slip_value(spec, scene, {"slip_reserve_min": loads[left], "slip_utilisation_max": loads[used]})

    return value


def _blames_grip(path: KeyPath, drive: Drive) -> Callable[[Conveyor, ConveyorScene, Loads], KeyPath]:
    return lambda spec, scene, loads: _blame_grip(spec, scene, path, drive)


SLIP: Check[Conveyor, ConveyorScene] = Check(
    code="CNV101",
    hazard=True,
    title="drive pulley traction reserve",
    question="Can every drive pulley transmit its force without belt slip?",
    failure="traction reserve at the drive pulley is too small",
    limit_state=LimitState("belt slips at the drive pulley", 1),
    scenes=_GRIPPING,
    loads=("slip_reserve_min", "slip_utilisation_max"),
    value=_slip_value,
    sense=Sense.AT_LEAST,
    limit=key(
        "checks.slip.reserve",
        meaning="k_T of the file",
        valid="at least 1",
        source="lecture notes Kramatorsk 2007: 1.1 to 1.5; 1.2 is the usual value of handbooks",
    ),
    needs=lambda spec, scene: ((*spec.main_path, "drum", "friction"),),
    blame=_blame_slip,
    repair=takeup_tension,
    each=_slip_checks,
    what="The traction of every drive pulley exceeds the force that it transmits by the reserve k_T. The criterion"
    " applies at every moment and in both directions of the force.",
    why="A slipping belt wears the pulley lagging, overheats and can burn. Slip does not end by itself.",
    formula="k = S_slack (exp(mu alpha) - 1)/(S_tight - S_slack) >= k_T, and U < 1   (definition `force`)\n"
    "1/U >= k_T,  U = (S_tight - rho_B v^2)/((S_slack - rho_B v^2) exp(mu alpha))   (definition `ratio`)",
    source="Euler-Eytelwein; k_T 1.1 to 1.5, lecture notes Kramatorsk 2007; 1.2 in handbooks",
)


_HEAT_LIMIT = key(
    "checks.slip_heat",
    meaning="Permissible slip heat given in the file",
    valid="any scene in motion with a given limit",
    source="data of the lagging manufacturer",
)


def _heat_checks(spec: Conveyor, scene: ConveyorScene) -> Checks:
    if spec.checks.slip_heat is None:
        return
    for name, drive in spec.all_drives.items():
        path = (*spec.drive_path(name), "drum", "friction")
        if drive.drum.friction is not None:
            yield HEAT.of(name, _HEAT_LIMIT, path)


HEAT: Check[Conveyor, ConveyorScene] = Check(
    code="CNV111",
    title="slip heat at the drive pulley",
    question="Is the frictional heat of belt slip within the limit of the pulley?",
    failure="belt slip heats the drive pulley too much",
    scenes=IN_MOTION - {Jam},
    loads=("slip_heat",),
    sense=Sense.AT_MOST,
    limit=_HEAT_LIMIT,
    needs=no_needs,
    blame=blame_tension,
    repair=no_repair,
    each=_heat_checks,
    what="The frictional heat of temporary belt slip at a drive pulley is at most the limit of the file.",
    why="A slipping pulley sets the belt on fire before the operator notices.",
    formula="integral of |S_on - S_off| |v_drum - v_belt| dt <= limit",
    source="work of friction",
)
