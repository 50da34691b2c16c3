"""What resists the motion of the belt: idlers by ISO 5048 and DIN 22101 or by CEMA, and the forces with a name."""

from dataclasses import dataclass

from ptmcalc.laws import belt_resistance, resistance
from ptmcalc.machines.conveyor.machine.keys.resistance import Cema, ExtraForce
from ptmcalc.machines.conveyor.machine.spec import Conveyor
from ptmcalc.numerics.lanes import value

_CEMA_RETURN = 0.015
"""Resistance of the return strand relative to the weight of the belt [1], CEMA (`cema_effective_tension`). The
resistance of the return strand is proportional to it."""


def filled(value: float | None) -> float:
    """A value the file or an assumption has given by now."""
    assert value is not None, "assumptions are filled in before anything is computed"
    return value


def idler_friction(
    spec: Conveyor, grown: float, carries: bool, line_load: float, idlers: float, cosine: float, pitch: float | None
) -> float:
    """Resistance of the idlers to one metre of a strand [N/m], `grown` times the running one.

        f C g (q cos(delta) + q_R)                                     ISO 5048, DIN 22101
        K_t (K_x + K_y w_B) + K_y w_M  carry,   0.015 K_t w_B  return   CEMA, K_x for both strands on the carry strand

    `line_load` is belt and load per length, `idlers` the rotating mass per length [kg/m].
    """
    given = spec.resistance
    if given.cema is None:
        factor = 1.0 if given.secondary_force is not None else filled(given.secondary)
        coefficient = filled(given.coefficient) * grown
        return factor * resistance.main_resistance_per_length(coefficient, spec.gravity, line_load, idlers, cosine)
    weight = spec.belt.mass * spec.gravity
    if not carries:
        return grown * given.cema.temperature * _CEMA_RETURN * weight
    load = line_load - spec.belt.mass
    drag = belt_resistance.cema_idler_resistance(
        spec.belt.mass, load, spec.gravity, idler_drag(given.cema), filled(pitch)
    )
    flexure = filled(given.cema.flexure)
    return grown * (given.cema.temperature * (drag + flexure * weight) + flexure * load * spec.gravity)


def idler_drag(cema: Cema) -> float:
    """A_i of one carry set [N]."""
    return cema.idler_drag if cema.idler_drag is not None else belt_resistance.CEMA_IDLER_DRAG[cema.roll or ""]


@dataclass(frozen=True, slots=True)
class Extra:
    """Special resistances by place, of all strands: those that always act, and those that the load makes [N]."""

    always: dict[str, float]
    of_load: dict[str, float]

    def at_tail(self, loaded: bool) -> float:
        """What acts at the tail, where the load falls on, or none does."""
        return self.always["tail"] + (self.of_load["tail"] if loaded else 0.0)

    def along(self, strand: str, loaded: bool) -> float:
        """What acts along a strand that is loaded all over, or not at all."""
        return self.always[strand] + (self.of_load[strand] if loaded else 0.0)


def extra_forces(spec: Conveyor, load_line_mass: float) -> Extra:
    """Special resistances at the tail and along each strand."""
    places = ("tail", "carry", "return")
    found = Extra(dict.fromkeys(places, 0.0), dict.fromkeys(places, 0.0))
    for one in spec.resistance.forces.values():
        there = found.of_load if one.skirt or one.loading else found.always
        there[one.at] += _force(spec, one, load_line_mass * spec.speed)
    return found


def _force(spec: Conveyor, one: ExtraForce, stream: float) -> float:
    """A special resistance at a stream of material [kg/s]."""
    if one.skirt is not None:
        plates = one.skirt
        return value(
            belt_resistance.skirt_resistance,
            stream,
            filled(spec.load.density),
            spec.speed,
            plates.width,
            plates.length,
            filled(plates.friction),
            spec.gravity,
        )
    if one.scraper is not None:
        blade = one.scraper
        area = blade.count * blade.width * blade.thickness
        return value(belt_resistance.scraper_resistance, area, blade.pressure, filled(blade.friction))
    if one.loading is not None:
        return value(belt_resistance.loading_resistance, stream, spec.speed, one.loading.speed)
    return filled(one.force)
