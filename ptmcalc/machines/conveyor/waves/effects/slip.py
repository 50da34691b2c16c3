"""Belt slip at the drive pulleys."""

from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.machines.conveyor.machine.motion import rough_utilisation
from ptmcalc.machines.conveyor.machine.plain_start import is_plain
from ptmcalc.machines.conveyor.machine.scenes import IN_MOTION, ConveyorScene, Start
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.machines.conveyor.machine.start_case import start_case
from ptmcalc.machines.conveyor.waves import start_enclosure, start_intervals
from ptmcalc.machines.conveyor.waves.effects.shared import Loads, Offsets, anything


def slip_criterion(spec: Conveyor, scene: ConveyorScene) -> Criterion | None:
    """Maximum traction utilisation of a pulley in the scene.

        U_b = (S_on - rho v^2)/((S_off - rho v^2) exp(mu alpha)) at the bounds of both sides       start, one drive
        the same with the tensions of the rigid body, twice the dynamic part, each pulley   all other scenes

    **Range** given friction of the pulley.
    **Error** an upper bound in a start with one drive, otherwise an estimate.
    **Source** Euler-Eytelwein (`laws.capstan`), tensions from `laws.loop_bounds`; the threshold is 1/k_T of the file.
    """
    if all(drive.drum.friction is None for drive in spec.all_drives.values()):
        return None
    if isinstance(scene, Start) and is_plain(spec, scene):
        case = start_case(spec, scene)
        value = start_intervals.enclosed_loads(case, start_enclosure.enclose(case, 0.0))["slip_utilisation_max"].high
    else:
        value = rough_utilisation(spec, scene)
    limit = 1 / spec.checks.slip.reserve
    return Criterion("U_b", value, limit, "maximum traction utilisation of a pulley in the scene", "laws.capstan")


def slip_bound(spec: Conveyor, scene: ConveyorScene, loads: Loads) -> Offsets:
    """A belt that never reaches its traction limit never slips: zero change; otherwise unbounded.

        U_max < 1 with its error bar  =>  no change

    **Range** any run that computes the utilisation.
    **Error** exact.
    **Source** slip starts where U reaches 1 (`laws.capstan`).
    """
    used = loads.get("slip_utilisation_max")
    return {} if used is not None and used.high < 1 else anything(spec, scene, loads)


SLIP = Effect("slip", "belt slip at the drive pulleys", IN_MOTION, slip_criterion, slip_bound)
