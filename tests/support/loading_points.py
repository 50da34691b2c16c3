"""Conveyors with several loading points as plain numbers: sums along the route, and lengths for finite elements.

Nothing of `ptmcalc` is used. The load at a place is that of all points before it; a point other than the first
accelerates its material with Q (v - v_0) over (v^2 - v_0^2)/(2 g 0.6).
"""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from support.belt_fem import Length
from support.belt_scenes import Rig

SLIDES = 0.6


@dataclass(frozen=True)
class Point:
    """A loading point: place [m], mass flow [kg/s], speed of the material along the belt [m/s]; plates: width and
    length [m]."""

    at: float
    flow: float
    speed: float = 0.0
    plates: tuple[float, float] | None = None

    def data(self) -> dict[str, Any]:
        found: dict[str, Any] = {"at": f"{self.at!r} m", "capacity": f"{self.flow!r} kg/s"}
        found["speed"] = f"{self.speed!r} m/s"
        if self.plates:
            width, length = self.plates
            found["skirt"] = {"width": f"{width!r} m", "length": f"{length!r} m", "friction": 0.6}
        return found


@dataclass(frozen=True)
class PointedRig(Rig):
    """A conveyor with loading points, of which some feed."""

    points: tuple[Point, ...] = ()
    feeding: tuple[int, ...] | None = None
    density: float = 1600.0
    own_force: float | None = None
    """secondary resistances at the tail [N]; then every point accelerates its material by itself"""

    def name_of(self, number: int) -> str:
        return f"point_{number}"

    def data(self, *scenes: dict[str, Any], **more: Any) -> dict[str, Any]:
        data = super().data(*scenes, **more)
        points = {self.name_of(number): point.data() for number, point in enumerate(self.points)}
        data["load"] = {"density": f"{self.density!r} kg/m^3", "loading_points": points}
        if self.own_force is not None:
            del data["resistance"]["secondary"]
            data["resistance"]["secondary_force"] = f"{self.own_force!r} N"
        return data

    @property
    def active(self) -> tuple[int, ...]:
        return tuple(range(len(self.points))) if self.feeding is None else self.feeding

    @property
    def span(self) -> float:
        return sum(length for length, _ in self.sections)

    def flow_at(self, place: float, active: tuple[int, ...]) -> float:
        """Mass flow of the points before a place [kg/s]."""
        return sum(self.points[k].flow for k in active if self.points[k].at < place)

    def zone(self, number: int) -> float:
        """[m]"""
        point = self.points[number]
        plates = point.plates[1] if point.plates else 0.0
        if not self.accelerates(number):
            return plates
        return max(plates, abs(self.speed**2 - point.speed**2) / (2 * self.gravity * SLIDES), 1.0)

    def accelerates(self, number: int) -> bool:
        first = min(range(len(self.points)), key=lambda k: self.points[k].at)
        return self.own_force is not None or number != first

    def pushed(self, number: int, place: float, active: tuple[int, ...]) -> float:
        """Force of a point [N], with the load of a place in its zone."""
        point, force = self.points[number], 0.0
        if number in active and self.accelerates(number):
            force = point.flow * (self.speed - point.speed)
        if point.plates:
            width, length = point.plates
            high = self.flow_at(place, active) / (self.density * self.speed * width)
            force += 0.6 * self.density * self.gravity * length * high**2
        return force

    def density_of_force(self, place: float, active: tuple[int, ...]) -> float:
        """Forces of loading points per length at a place [N/m]."""
        whole = 0.0
        for number, point in enumerate(self.points):
            length = min(self.zone(number), self.span - point.at)
            if point.at < place < point.at + length:
                whole += self.pushed(number, place, active) / length
        return whole

    def cuts(self) -> list[float]:
        """Ends of uniform lengths along the route [m]."""
        ends = np.cumsum([0.0, *(length for length, _ in self.sections)]).tolist()
        marks = [*ends, *(point.at for point in self.points)]
        marks += [min(point.at + self.zone(number), self.span) for number, point in enumerate(self.points)]
        return sorted(set(marks))

    def section_at(self, place: float) -> tuple[float, float]:
        ends = np.cumsum([length for length, _ in self.sections])
        return self.sections[int(np.searchsorted(ends, place))]

    def lengths(self, loaded: str = "full", factor: float = 1.0) -> tuple[Length, ...]:
        """The belt from the head's run-off round the tail; both strands in the same lengths."""
        per = self.friction * factor * self.gravity * (self.secondary if self.own_force is None else 1.0)
        back, carry = [], []
        for first, last in pairwise(self.cuts()):
            middle, long = (first + last) / 2, last - first
            length, lift = self.section_at(middle)
            cosine, climb = math.sqrt(1 - (lift / length) ** 2), lift / length * self.gravity
            full = {"full": True, "empty": False, "uphill": lift > 0, "downhill": lift < 0}[loaded]
            active = self.active if full else ()
            on_it = self.belt + self.flow_at(middle, active) / self.speed
            rubs = per * (on_it * cosine + self.carry_idlers) + self.density_of_force(middle, active)
            carry.append(Length(long, on_it + self.carry_idlers, self.stiffness, rubs, on_it * climb))
            rubs = per * (self.belt * cosine + self.back_idlers)
            back.append(Length(long, self.belt + self.back_idlers, self.stiffness, rubs, -self.belt * climb))
        return (*reversed(back), *carry)
