"""Conveyors drawn by a number, and what sums of forces and the energy of a rigid body say of them.

The machine is a `Rig` of plain numbers; nothing of `ptmcalc` is used.
"""

import math
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np

from support.belt_scenes import Brake, Drive, Rig

G = 9.81
OFF = {code: {"off": "on trial elsewhere"} for code in ("CNV101", "CNV102", "CNV103", "CNV105", "CNV106", "CNV107")}


@dataclass(frozen=True)
class Statics:
    """A conveyor and what its file says besides."""

    rig: Rig
    stop_factor: float
    pitches: tuple[float, float]
    """of the carry and the return idlers [m]"""
    breaking: float
    elongation: float
    way: float
    """in which it is to stop [m]"""
    coefficient: float
    """that its run-out was measured with"""

    # -- as a file -------------------------------------------------------------------------------------------

    def data(self, *scenes: dict[str, Any], **checks: Any) -> dict[str, Any]:
        data = self.rig.data(*scenes, checks={"slack_sag": 0.04, "sag": 0.012, "slip": {"reserve": 1.25}} | checks)
        data["idlers"]["carry"]["pitch"] = f"{self.pitches[0]!r} m"
        data["idlers"]["return"]["pitch"] = f"{self.pitches[1]!r} m"
        data["belt"] |= {"breaking_force": f"{self.breaking!r} N", "carcass": "textile"}
        data["resistance"] |= {"stop_factor": self.stop_factor, "rest_factor": self.stop_factor}
        data["takeup"] |= {"permanent_elongation": self.elongation, "stroke": "1000 m"}
        data["backstop"] = {"torque": "1 N*m", "reserve": 1.5}
        return data

    def running(self) -> dict[str, Any]:
        return self.data({"type": "run"})

    def standing(self) -> dict[str, Any]:
        """Stops and standstill, with nothing asked of the waves."""
        coast = {"type": "coast", "load": "empty", "measured_distance": f"{self.measured()!r} m"}
        ways = {"stop_distance": f"{self.way!r} m", "emergency_stop_distance": f"{0.7 * self.way!r} m"}
        return self.data({"type": "stop"}, {"type": "emergency_stop"}, {"type": "backstop"}, coast, **ways, **OFF)

    # -- steady running --------------------------------------------------------------------------------------

    def run(self) -> dict[str, float]:
        rig = self.rig
        parts, whole = rig.lengths(), rig.resistance()
        forces = {name: drive.force for name, drive in rig.drives.items()}
        shares = {name: force / sum(forces.values()) for name, force in forces.items()}
        at_tail = sum(share for name, share in shares.items() if rig.drives[name].at == "tail") * whole
        lengths = np.array([part.length for part in parts])
        back, carry, mean = self.courses(at_tail)
        off = float(back[0])
        highest, lowest = max(back.max(), carry.max()), min(back.min(), carry.min())
        empty = rig.resistance("empty")
        weights = [
            np.array(self._spans(carries=True)) * self.pitches[0] * G,
            np.array(self._spans(carries=False)[::-1]) * self.pitches[1] * G,
        ]
        lows = [np.minimum(course[1:], course[:-1]) for course in (carry, back)]
        sags = [weight / 8 / low for weight, low in zip(weights, lows, strict=True)]
        asked = [weight.max() / 8 for weight in weights]
        grip = sum((drive.friction or 0.0) * drive.wrap for drive in rig.drives.values() if drive.at == "head")
        found = {
            "static_resistance": whole - at_tail,
            "effective_tension": whole,
            "effective_tension_worst": self._worst(),
            "tension_run_on_max": carry[-1],
            "tension_run_off_min": off,
            "tension_max": highest,
            "tension_min": lowest,
            "belt_safety_min": self.breaking / highest if highest > 0 else math.inf,
            "slack_margin_min": min(low.min() - one / 0.04 for low, one in zip(lows, asked, strict=True)),
            "power_drive_running": whole * rig.speed,
            "power_drive_empty": empty * rig.speed,
            "power_motor_running": self._at_motors(whole * rig.speed, shares),
            "power_motor_empty": self._at_motors(empty * rig.speed, shares),
            "sag_tension_required": max(asked) / 0.012,
            "slack_side_tension_required": 1.25 * max(whole - at_tail, 0.0) / (math.exp(grip) - 1),
            "belt_cycle_time": lengths.sum() / rig.speed,
            "takeup_travel": lengths.sum() / 2 * ((off + mean - rig.tension) / rig.stiffness + self.elongation),
        }
        if min(low.min() for low in lows) > 0:
            found["sag_relative_max"] = max(part.max() for part in sags)
            found |= {f"sag_carry[{number}]": sag for number, sag in enumerate(sags[0], 1)}
            found |= {f"sag_return[{number}]": sag for number, sag in enumerate(sags[1][::-1], 1)}
        if not rig.rigid:
            found["takeup_mass"] = 2 * rig.tension / G
        found |= self._grips({"head": off, "tail": float(carry[0])}, shares, whole)
        return {name: float(value) for name, value in found.items()}

    def courses(self, at_tail: float) -> tuple[np.ndarray, np.ndarray, float]:
        """Tensions from the head's run-off to the tail and from there to the head, with what the drives at the tail
        pull, and the mean of them above the run-off."""
        rig, half = self.rig, len(self.rig.sections)
        parts = rig.lengths()
        rises = [part.length * (part.friction + part.climb) for part in parts]
        back, carry = np.concatenate([[0.0], np.cumsum(rises[:half])]), np.concatenate([[0.0], np.cumsum(rises[half:])])
        carry = carry + back[-1] - at_tail
        lengths = np.array([part.length for part in parts])
        means = np.concatenate([(back[1:] + back[:-1]) / 2, (carry[1:] + carry[:-1]) / 2])
        mean = float(means @ lengths / lengths.sum())
        off = rig.tension - (mean if rig.rigid else 0.0)
        return back + off, carry + off, mean

    def _spans(self, carries: bool) -> list[float]:
        """Belt and load per length square to the belt [kg/m]."""
        on_it = self.rig.belt + (self.rig.load if carries else 0.0)
        return [on_it * math.sqrt(1 - (lift / part) ** 2) for part, lift in self.rig.sections]

    def _worst(self) -> float:
        """The largest pull of all fillings of the sections."""
        rig = self.rig
        pulls = [
            rig.load * G * (rig.friction * rig.secondary * math.sqrt(part**2 - lift**2) + lift)
            for part, lift in rig.sections
        ]
        fillings = product((0, 1), repeat=len(pulls))
        return rig.resistance("empty") + max(float(np.dot(filling, pulls)) for filling in fillings)

    def _at_motors(self, power: float, shares: dict[str, float]) -> float:
        drives = self.rig.drives
        return sum(
            share * (power / drives[name].efficiency if power > 0 else power * drives[name].efficiency)
            for name, share in shares.items()
        )

    def _grips(self, behind: dict[str, float], shares: dict[str, float], whole: float) -> dict[str, float]:
        """Tensions at the drums by the shares of their drives, from the last drum of an end on."""
        rig, found = self.rig, {}
        lift = rig.belt * rig.speed**2
        for name, drive in reversed(rig.drives.items()):
            slack = behind[drive.at]
            tight = slack + shares[name] * whole
            behind = behind | {drive.at: tight}
            most, least, grip = max(slack, tight), min(slack, tight), math.exp((drive.friction or 0.0) * drive.wrap)
            used = (most - lift) / (least - lift) / grip if least > lift else math.inf
            reserve = least * (grip - 1) / (most - least) if least > 0 else 0.0
            found |= {
                f"tension_run_on_max[{name}]": tight,
                f"tension_run_off_min[{name}]": slack,
                f"slip_utilisation_max[{name}]": used,
                f"slip_reserve_min[{name}]": reserve,
            }
        for name, pick in (("slip_utilisation_max", max), ("slip_reserve_min", min)):
            found[name] = pick(value for load, value in found.items() if load.startswith(name))
        return found

    # -- standing --------------------------------------------------------------------------------------------

    def stop(self, way: float) -> dict[str, float]:
        """What brings the rigid body to rest on the way, besides the resistance."""
        rig = self.rig
        slowing = rig.speed**2 / 2 / way
        force = rig.mass() * slowing - rig.resistance(factor=self.stop_factor)
        drum = next(iter(rig.drives.values()))
        return {
            "brake_torque_required": max(force, 0.0) * drum.diameter / 2,
            "tension_overload_braking": (rig.belt_mass() + rig.tail_mass) * slowing,
        }

    def hold(self) -> dict[str, float]:
        """What runs back of the full belt, or of one that is full where it climbs; what runs forward of the full belt,
        or of one that is full where it falls."""
        drum = next(iter(self.rig.drives.values()))

        def pull(load: str, sense: int) -> float:
            lengths = self.rig.lengths(load)
            return sum(part.length * (sense * part.climb - self.stop_factor * part.friction) for part in lengths)

        back, forward = (
            max(0.0, pull("full", sense), pull(load, sense)) * drum.diameter / 2
            for load, sense in (("uphill", 1), ("downhill", -1))
        )
        falls = any(lift < 0 for _, lift in self.rig.sections)
        return {"backstop_torque": back} | ({"forward_torque": forward} if falls else {})

    def measured(self) -> float:
        """Way of the empty conveyor that runs out with its true coefficient, a rigid body [m]."""
        parts = self.rig.lengths("empty", self.coefficient / self.rig.friction)
        slowing = sum(part.length * (part.friction + part.climb) for part in parts) / self.rig.mass("empty")
        return self.rig.speed**2 / 2 / slowing


def drawn(rng: np.random.Generator) -> Statics:
    """A conveyor of one to four slopes, with one or two drives."""

    def even(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    lengths = np.exp(rng.uniform(math.log(15), math.log(600), int(rng.integers(1, 5))))
    sections = tuple((float(length), float(length * rng.uniform(-0.06, 0.22))) for length in lengths)
    places = [("head",), ("head",), ("head", "head"), ("head", "tail")][int(rng.integers(4))]
    drives = {
        ("head" if len(places) == 1 else f"drive_{number}"): Drive(
            torque=even(500, 4000), rotor=even(0.5, 8), ratio=even(10, 35), efficiency=even(0.85, 0.97),
            diameter=even(0.5, 1.2), wrap=even(3.0, 3.8), friction=even(0.2, 0.4), drum=even(10, 400), at=at,
        )
        for number, at in enumerate(places, 1)
    }  # fmt: skip
    rig = Rig(
        sections=sections,
        belt=even(8, 40),
        stiffness=even(5e6, 80e6),
        carry_idlers=even(8, 30),
        back_idlers=even(3, 12),
        load=even(20, 250),
        friction=even(0.016, 0.04),
        secondary=even(1.05, 1.5),
        speed=even(0.8, 5),
        drives=drives,
        brakes=(Brake(even(500, 2e4)),),
        rigid=bool(rng.random() < 0.5),
        tail_inertia=even(0, 80),
    )
    pull = abs(rig.resistance()) + sum(abs(part.length * part.climb) for part in rig.lengths())
    rig = Rig(**{**rig.__dict__, "tension": even(0.7, 2.5) * pull + 20e3})
    climb = sum(part.length * part.climb for part in rig.lengths("empty"))
    friction = sum(part.length * part.friction for part in rig.lengths("empty"))
    least = max(-climb / friction, 0.0) * 1.1 + 0.6  # a coefficient with which it comes to rest
    return Statics(
        rig, even(0.5, 1.0), (even(0.9, 1.5), even(2.4, 3.2)), even(3, 12) * rig.tension, even(0, 0.01), even(0.2, 5),
        rig.friction * even(least, 1.6 * least),
    )  # fmt: skip
