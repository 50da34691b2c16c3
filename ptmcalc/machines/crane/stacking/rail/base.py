"""The base of a rack stacker on an uneven rail, and the column that it swings: what file and scene come to."""

import math
from dataclasses import dataclass

import numpy as np

from ptmcalc.laws import rail
from ptmcalc.machines.crane.stacking.machine import columns, model
from ptmcalc.machines.crane.stacking.machine.model import filled
from ptmcalc.machines.crane.stacking.machine.rack import RackStacker
from ptmcalc.machines.crane.stacking.machine.scenes import RailScene

_NODES = 5
"""Of the quadrature of a column's shape: exact for its polynomials."""


@dataclass(frozen=True, slots=True)
class Swinger:
    """The column over a base that tilts, as one mode at the carriage: SI."""

    frequency: float
    """[rad/s]"""
    driven: float
    """acceleration of the mode over that of the tilt [m]"""
    outreach: float
    """deflection of the head over that at the carriage [1]"""
    mass: float = 1.0
    """that swings, at the carriage [kg]"""
    stiffness: float = 1.0
    """at the carriage [N/m]"""


@dataclass(frozen=True, slots=True)
class Roll:
    """A base that runs over what is uneven in its rail: SI."""

    speed: float
    radius: float
    gravity: float
    frequency: float
    """of the machine on its wheels [rad/s]"""
    damping: float
    step: float
    gap: float
    wave_height: float
    wave_length: float
    base: float
    column: Swinger | None

    @property
    def acceleration(self) -> float:
        """Of a wheel over a step or gap [m/s^2]."""
        return rail.rail_acceleration(self.speed, self.radius)

    def pulses(self, frequency: float) -> list[tuple[float, float]]:
        """(more, less) of a mode over the wheel's acceleration, of step and gap, either way over the step."""
        found = []
        if self.step:
            number = rail.step_number(frequency, self.speed, self.radius, self.step)
            up = max(rail.step_extremes(number))
            found.append((up, up))
        if self.gap:
            found.append(rail.gap_extremes(rail.gap_number(frequency, self.speed, self.gap)))
        return found

    @property
    def wave_rate(self) -> float:
        """Of the waves of the rail, 0 without them [rad/s]."""
        return 2 * math.pi * self.speed / self.wave_length if self.wave_length else 0.0


def swinger(spec: RackStacker, scene: RailScene) -> Swinger | None:
    """The column as one mode with the carriage on it, its shape that of a force at the carriage.

        f = alpha x^2 (3 z - x)/(2 z^3) + beta x/z below the carriage, straight on above it
        w^2 = c/(m_2 + m_c/l int f^2),   alpha and beta the shares of bending and of the root

    None where a guide at its head holds it along the aisle.
    """
    column, z = spec.column, model.carriage_place(spec, scene)
    if z <= 0 or (column.top_guide is not None and column.top_guide.stiffness is not None):
        return None
    gives, line, mass = (
        columns.compliance_at(spec, scene, z),
        column.mass / column.length,
        model.climbing_mass(spec, scene),
    )
    beta = gives.rotation_share
    slope = (1.5 * (1 - beta) + beta) / z
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    below, above = (nodes + 1) * z / 2, z + (nodes + 1) * (column.length - z) / 2
    shapes = (1 - beta) * below**2 * (3 * z - below) / (2 * z**3) + beta * below / z, 1 + slope * (above - z)
    spans = z / 2, (column.length - z) / 2
    both = list(zip((below, above), shapes, spans, strict=True))
    swings = mass + line * sum(float(weights @ shape**2) * half for _, shape, half in both)
    lever = mass * z + line * sum(float(weights @ (shape * x)) * half for x, shape, half in both)
    return Swinger(
        math.sqrt(gives.stiffness / swings), lever / swings, 1 + slope * (column.length - z), swings, gives.stiffness
    )


def roll_of(spec: RackStacker, scene: RailScene) -> Roll:
    """A base on an uneven rail."""
    given, waves = spec.rail, spec.rail.waviness
    return Roll(
        scene.speed_share * spec.travel.speed,
        spec.base.wheel_diameter / 2,
        spec.gravity,
        2 * math.pi * filled(given.frequency),
        given.damping,
        given.step,
        given.gap,
        waves.height if waves is not None else 0.0,
        waves.length if waves is not None else 0.0,
        spec.base.wheel_base,
        swinger(spec, scene),
    )


def wheel_load(spec: RackStacker, scene: RailScene) -> float:
    """Largest static load of a wheel: two on one rail, four on two [N]."""
    base, carriage, length = spec.base, spec.carriage, spec.base.wheel_base
    foot = base.column if base.column is not None else length / 2
    weights = [
        (base.mass, base.centre if base.centre is not None else length / 2),
        (spec.column.mass, foot),
        (model.payload(spec, scene), foot + carriage.load_arm),
        (carriage.mass, foot + carriage.own_arm),
    ]
    if spec.cab is not None:
        weights.append((spec.cab.mass, foot + spec.cab.arm))
    whole = sum(mass for mass, _ in weights) * spec.gravity
    front = sum(mass * place for mass, place in weights) * spec.gravity / length
    return max(front, whole - front) / (2 if base.gauge is not None else 1)
