"""A conveyor as plain SI numbers, twice: as a design file, and as finite elements of its own (`belt_fem`).

Imports nothing from `ptmcalc`: resistances, masses, forces and static tensions are worked out here again.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from support.belt_fem import Length, Motion, Plan, Roller, no_pull, simulate

_FAST = 1e30


@dataclass(frozen=True)
class Drive:
    """One drum with its motors."""

    torque: float = 2000.0
    count: int = 1
    rotor: float = 5.0
    ratio: float = 20.0
    efficiency: float = 0.94
    diameter: float = 1.0
    wrap: float = 3.5
    friction: float | None = 0.35
    drum: float = 200.0
    at: str = "head"
    delay: float = 0.0

    @property
    def mass(self) -> float:
        """At the rim [kg]."""
        radius = self.diameter / 2
        return (self.count * self.rotor * self.ratio**2 * self.efficiency + self.drum) / radius**2

    @property
    def force(self) -> float:
        """At the rim [N]."""
        return self.count * self.torque * self.ratio * self.efficiency * 2 / self.diameter

    def data(self) -> dict[str, Any]:
        drum = {"diameter": f"{self.diameter!r} m", "wrap": f"{self.wrap!r} rad", "inertia": f"{self.drum!r} kg*m^2"}
        if self.friction is not None:
            drum["friction"] = self.friction
        return {
            "motor": {
                "count": self.count,
                "inertia": f"{self.rotor!r} kg*m^2",
                "mean_starting_torque": f"{self.torque!r} N*m",
            },
            "coupling_inertia": "0 kg*m^2",
            "gear": {"ratio": self.ratio, "efficiency": self.efficiency},
            "drum": drum,
        }


@dataclass(frozen=True)
class Brake:
    """A brake on a drum."""

    torque: float
    delay: float = 0.0
    rise: float = 0.0
    at: str = "head"

    def capacity(self, radius: float) -> Callable[[float], float]:
        """At the rim over time [N]."""

        def force(time: float) -> float:
            if time <= self.delay:
                return 0.0
            share = min((time - self.delay) / self.rise, 1.0) if self.rise else 1.0
            return self.torque / radius * share

        return force


@dataclass(frozen=True)
class Rig:
    """A conveyor: sections (length, lift) from the tail, masses per length, resistance, drives, take-up."""

    sections: tuple[tuple[float, float], ...] = ((500.0, 0.0),)
    belt: float = 20.0
    stiffness: float = 40e6
    carry_idlers: float = 20.0
    back_idlers: float = 8.0
    load: float = 120.0
    friction: float = 0.022
    secondary: float = 1.1
    start_factor: float = 1.0
    speed: float = 4.0
    drives: dict[str, Drive] = field(default_factory=lambda: {"head": Drive()})
    brakes: tuple[Brake, ...] = ()
    tension: float = 120e3
    rigid: bool = False
    weight: float | None = None
    tail_inertia: float = 50.0
    tail_diameter: float = 0.8
    gravity: float = 9.81

    # -- as a design file ------------------------------------------------------------------------------------

    def data(self, *scenes: dict[str, Any], **more: Any) -> dict[str, Any]:
        """The design file of this machine, without what the elements do not have: waves that go along with the belt."""
        takeup: dict[str, Any] = {"type": "rigid" if self.rigid else "gravity", "tension": f"{self.tension!r} N"}
        if self.weight is not None:
            takeup["mass"] = f"{self.weight!r} kg"
        one = list(self.drives) == ["head"]
        drives = {
            name: drive.data() | {"at": drive.at, "delay": f"{drive.delay!r} s"} for name, drive in self.drives.items()
        }
        return {
            "kind": "conveyor",
            "route": {"sections": [{"length": f"{part!r} m", "lift": f"{lift!r} m"} for part, lift in self.sections]},
            "belt": {"mass": f"{self.belt!r} kg/m", "stiffness": f"{self.stiffness!r} N"},
            "idlers": {
                "carry": {"line_mass": f"{self.carry_idlers!r} kg/m"},
                "return": {"line_mass": f"{self.back_idlers!r} kg/m"},
            },
            "load": {"mass": f"{self.load!r} kg/m"},
            "resistance": {
                "coefficient": self.friction,
                "secondary": self.secondary,
                "start_factor": self.start_factor,
            },
            "speed": f"{self.speed!r} m/s",
            **({"drive": self.drives["head"].data()} if one else {"drives": drives}),
            "brakes": {
                f"b{number}": {
                    "torque": f"{brake.torque!r} N*m",
                    "delay": f"{brake.delay!r} s",
                    "rise_time": f"{brake.rise!r} s",
                    "at": brake.at,
                }
                for number, brake in enumerate(self.brakes)
            },
            "takeup": takeup,
            "tail_drum": {"inertia": f"{self.tail_inertia!r} kg*m^2", "diameter": f"{self.tail_diameter!r} m"},
            "scenes": list(scenes),
            "effects": {"moving_belt": "off"} | ({} if self.rigid or self.weight else {"takeup_mass": "off"}),
            "gravity": f"{self.gravity!r} m/s^2",
        } | more

    # -- sums ------------------------------------------------------------------------------------------------

    def lengths(self, loaded: str = "full", factor: float = 1.0) -> tuple[Length, ...]:
        """The belt from the head's run-off round the tail."""
        per = self.friction * factor * self.secondary * self.gravity
        back, carry = [], []
        for part, lift in self.sections:
            cosine = math.sqrt(1 - (lift / part) ** 2)
            full = {"full": True, "empty": False, "uphill": lift > 0, "downhill": lift < 0}[loaded]
            on_it = self.belt + (self.load if full else 0.0)
            carry.append(
                Length(
                    part,
                    on_it + self.carry_idlers,
                    self.stiffness,
                    per * (on_it * cosine + self.carry_idlers),
                    on_it * self.gravity * lift / part,
                )
            )
            back.append(
                Length(
                    part,
                    self.belt + self.back_idlers,
                    self.stiffness,
                    per * (self.belt * cosine + self.back_idlers),
                    -self.belt * self.gravity * lift / part,
                )
            )
        return (*reversed(back), *carry)

    def belt_mass(self, loaded: str = "full") -> float:
        return sum(one.length * one.line_mass for one in self.lengths(loaded))

    @property
    def tail_mass(self) -> float:
        return self.tail_inertia * 4 / self.tail_diameter**2

    def mass(self, loaded: str = "full") -> float:
        """All that moves, at the rim [kg]."""
        return self.belt_mass(loaded) + self.tail_mass + sum(drive.mass for drive in self.drives.values())

    def resistance(self, loaded: str = "full", factor: float = 1.0) -> float:
        """Static resistance of the whole belt at the rim [N]."""
        return sum(one.length * (one.friction + one.climb) for one in self.lengths(loaded, factor))

    def contour(self, loaded: str = "full") -> float:
        """Time of a wave once round [s]."""
        return sum(one.length * math.sqrt(one.line_mass / one.stiffness) for one in self.lengths(loaded))

    # -- finite elements ---------------------------------------------------------------------------------------

    def running(self, lengths: tuple[Length, ...], elements: int) -> np.ndarray:
        """Tension of every element less gravity's part, of the steadily running belt."""
        counts = counts_of(lengths, elements)
        h = np.concatenate([np.full(n, one.length / n) for one, n in zip(lengths, counts, strict=True)])
        w = np.concatenate([np.full(n, one.friction) for one, n in zip(lengths, counts, strict=True)]) * h
        c = np.concatenate([np.full(n, one.climb) for one, n in zip(lengths, counts, strict=True)]) * h
        rubbed = np.cumsum(w) - w / 2
        whole = sum(one.length * (one.friction + one.climb) for one in lengths)
        forces = {name: drive.force for name, drive in self.drives.items()}
        at_tail = sum(force for name, force in forces.items() if self.drives[name].at == "tail") / sum(forces.values())
        rubbed[sum(counts[: len(counts) // 2]) :] -= at_tail * whole
        if not self.rigid:
            return self.tension + rubbed
        risen = rubbed + np.cumsum(c) - c / 2
        return self.tension - float(risen @ h) / float(h.sum()) + rubbed

    def relaxed(self, lengths: tuple[Length, ...], elements: int) -> np.ndarray:
        """Tension of every element less gravity's part, of a belt without friction in it."""
        counts = counts_of(lengths, elements)
        if not self.rigid:
            return np.full(sum(counts), self.tension)
        h = np.concatenate([np.full(n, one.length / n) for one, n in zip(lengths, counts, strict=True)])
        c = np.concatenate([np.full(n, one.climb) for one, n in zip(lengths, counts, strict=True)]) * h
        return np.full(sum(counts), self.tension - float((np.cumsum(c) - c / 2) @ h) / float(h.sum()))

    def plan(
        self,
        lengths: tuple[Length, ...],
        pulls: dict[str, Callable[[float, float], float]] | None = None,
        brakes: tuple[Brake, ...] = (),
        holds: dict[str, Callable[[float], float]] | None = None,
        rated: float = math.inf,
    ) -> Plan:
        """Drums, brakes and take-up for the finite elements; `holds` are brakes besides, on every drum of an end.

        Motors hold their drums at the `rated` speed once these have it.
        """
        ends: dict[str, list[Roller]] = {"head": [], "tail": []}
        for name, drive in self.drives.items():
            grip = drive.friction * drive.wrap if drive.friction is not None else None
            pull = no_pull if pulls is None else pulls.get(name, no_pull)
            extra = self.tail_mass if drive.at == "tail" and not ends["tail"] else 0.0
            ends[drive.at].append(Roller(drive.mass + extra, pull, exponent=grip, rated=rated, strength=drive.force))
        radii = {"head": [d.diameter / 2 for d in self.drives.values() if d.at == "head"][-1]}
        radii["tail"] = self.tail_diameter / 2
        if not ends["tail"]:
            ends["tail"].append(Roller(self.tail_mass))
        else:
            radii["tail"] = [d.diameter / 2 for d in self.drives.values() if d.at == "tail"][-1]
        for at in ends:
            acting = [brake.capacity(radii[at]) for brake in brakes if brake.at == at]
            held = [] if holds is None or at not in holds else [holds[at]]
            last = len(ends[at]) - 1
            for number, roller in enumerate(ends[at]):
                there = [*held, *(acting if number == last else ())]
                if there:

                    def together(time: float, acting: list[Callable[[float], float]] = there) -> float:
                        return sum(one(time) for one in acting)

                    ends[at][number] = replace(roller, hold=together)
        takeup = None if self.rigid else (self.tension, self.weight or 0.0)
        return Plan(
            lengths, len(lengths) // 2, tuple(ends["head"]), tuple(ends["tail"]), takeup, belt_line_mass=self.belt
        )

    # -- scenes ------------------------------------------------------------------------------------------------

    def stopped(self, window: float, elements: int, loaded: str = "full", braked: bool = True) -> Motion:
        """The drives fall out at full speed."""
        lengths = self.lengths(loaded)
        plan = self.plan(lengths, brakes=self.brakes if braked else ())
        return simulate(plan, elements, window, self.running(lengths, elements), self.speed)

    def jammed(self, at: str, window: float, elements: int) -> Motion:
        """A drum is blocked; the drives at the other end pull on as they did."""
        lengths = self.lengths()
        whole = sum(one.length * (one.friction + one.climb) for one in lengths)
        all_force = sum(drive.force for drive in self.drives.values())
        pulls = {
            name: _constant(drive.force / all_force * whole) for name, drive in self.drives.items() if drive.at != at
        }
        plan = self.plan(lengths, pulls, holds={at: lambda time: _FAST})
        return simulate(plan, elements, window, self.running(lengths, elements), self.speed)

    def started(
        self,
        rise: Callable[[float], float],
        window: float,
        elements: int,
        loaded: str = "full",
        relaxed: bool = False,
        aborted: tuple[float, float] | None = None,
    ) -> Motion:
        """The drives come up by `rise` (0 to 1 over time), broken off once where `aborted` gives run and pause.

        Until they pull harder than the belt does, the drums of an end are held; once a drum has rated speed, its motor
        keeps it there.
        """
        lengths = self.lengths(loaded, self.start_factor)
        tension = self.relaxed(lengths, elements) if relaxed else self.running(lengths, elements)

        def share(time: float, delay: float) -> float:
            def since(after: float) -> float:
                return rise(after) if after >= 0 else 0.0

            if aborted is None:
                return since(time - delay)
            run, pause = aborted
            return since(time - delay) if time < run else since(time - run - pause - delay)

        def pull_of(drive: Drive) -> Callable[[float, float], float]:
            return lambda time, speed: drive.force * share(time, drive.delay)

        pulls = {name: pull_of(drive) for name, drive in self.drives.items()}
        climbs = sum(one.length * one.climb for one in lengths)
        whole = sum(one.length * (one.friction + one.climb) for one in lengths)
        forces = {at: sum(d.force for d in self.drives.values() if d.at == at) for at in ("head", "tail")}
        shares = {at: force / sum(forces.values()) for at, force in forces.items()}
        pulled = {at: part * whole for at, part in shares.items()}
        if relaxed:
            pulled = {"head": float(tension[-1] - tension[0]) + climbs, "tail": 0.0}
        holds = {at: self._held(pulls, at, pulled[at]) for at in ("head", "tail") if forces[at]}
        plan = self.plan(lengths, pulls, holds=holds, rated=self.speed)
        return simulate(plan, elements, window, tension, 0.0)

    def _held(
        self, pulls: dict[str, Callable[[float, float], float]], at: str, pulled: float
    ) -> Callable[[float], float]:
        """Holds an end until its drives pull harder than the belt does."""
        loose: list[bool] = []

        def hold(time: float) -> float:
            there = sum(pulls[name](time, 0.0) for name, drive in self.drives.items() if drive.at == at)
            if not loose and there < pulled:
                return _FAST
            loose.append(True)
            return 0.0

        return hold


def _constant(force: float) -> Callable[[float, float], float]:
    return lambda time, speed: force


def counts_of(lengths: tuple[Length, ...], elements: int) -> list[int]:
    """Elements of every length, as `belt_fem` shares them out."""
    transit = [one.length * math.sqrt(one.line_mass / one.stiffness) for one in lengths]
    return [max(round(elements * t / sum(transit)), 1) for t in transit]


@dataclass(frozen=True)
class Found:
    """Loads of a motion as the tool names them."""

    loads: dict[str, float]

    def __getitem__(self, name: str) -> float:
        return self.loads[name]


def loads_of(rig: Rig, motion: Motion, until: float | None = None) -> Found:
    """Largest and smallest tensions, slip, way and time to rest at the head [SI]."""
    head, times = motion.head, motion.times
    kept = times <= (times[-1] if until is None else until)
    on, off, belt = (np.array(part)[kept] for part in (head.on, head.off, head.belt))
    loads = {
        "tension_run_on_max": float(on.max()),
        "tension_run_off_min": float(off.min()),
        "tension_max": float(max(motion.highest.max(), on.max())),
        "tension_min": float(min(motion.lowest.min(), off.min())),
    }
    behind = motion.behind[kept]
    way = np.cumsum(belt - behind) * (times[1] - times[0]) / 2
    loads["takeup_movement"] = float(max(way.max(), 0.0) - min(way.min(), 0.0))
    for at, spot in (("head", motion.head), ("tail", motion.tail)):
        names = [name for name, drive in rig.drives.items() if drive.at == at]
        between = np.array(spot.between)
        for j, name in enumerate(names):
            drive = rig.drives[name]
            tight = np.maximum(between[kept, j], between[kept, j + 1])
            slack = np.minimum(between[kept, j], between[kept, j + 1])
            loads[f"tension_run_on_max[{name}]"] = float(between[kept, j].max())
            loads[f"tension_run_off_min[{name}]"] = float(between[kept, j + 1].min())
            if drive.friction is None:
                continue
            lift = rig.belt * np.array(spot.belt)[kept] ** 2
            used = (tight - lift) / (slack - lift) * math.exp(-drive.friction * drive.wrap)
            loads[f"slip_utilisation_max[{name}]"] = float(used.max())
            loads[f"slip_distance[{name}]"] = float(spot.slid[j])
            loads[f"slip_heat[{name}]"] = float(spot.heat[j])
    rest = np.flatnonzero(belt <= 1e-9)
    if len(rest):
        last = int(rest[0])
        loads["stop_time"] = float(times[last])
        loads["stop_distance"] = float(belt[:last].sum() - belt[0] / 2) * float(times[1] - times[0])
    return Found(loads)
