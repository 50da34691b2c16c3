"""Starts, stops and runs through speeds of a chain against finite elements and the equations of motion, by scipy."""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from support import chain_fem
from support.chain_starts import KIND, built, random_chain, scraper
from support.machines import load_of, report_of

from ptmcalc.contract.result import Result
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, ChainScene

G = 9.81


def solved(name: str, spec: ChainDrive, scene: ChainScene, level: int = 0) -> Result:
    """A run of a solver by its name."""
    solver = next(one for one in KIND.solvers if one.name == name)
    return solver.run(spec, scene, solver.always, level)


@dataclass(frozen=True)
class Numbers:
    """A scraper's numbers, worked out here from what the file says."""

    length: float = 40.0
    chain: float = 22.0
    load: float = 90.0
    lift: float = 5.0
    stiffness: float = 64e6
    takeup: float = 12e3
    pitch: float = 0.16
    teeth: int = 8
    speed: float = 0.5
    ratio: float = 42.0
    eta: float = 0.93
    torque: float = 300.0
    rotor: float = 0.40
    sprocket: float = 15.0
    tail: float = 12.0
    fixed: bool = False

    @property
    def arm(self) -> float:
        return self.pitch * self.teeth / (2 * math.pi)

    def resistance(self, grown: float) -> tuple[float, float, float]:
        """Of return and working strand, and the whole of what the drive pulls."""
        level = math.sqrt(self.length**2 - self.lift**2)
        back = 1.1 * grown * 0.25 * self.chain * G * level
        working = 1.1 * grown * (0.25 * self.chain + 0.4 * self.load) * G * level
        return back, working, back + working + self.load * G * self.lift

    @property
    def tail_mass(self) -> float:
        return self.tail / self.arm**2

    @property
    def moving(self) -> float:
        return self.length * (2 * self.chain + self.load) + self.tail_mass

    def drive_mass(self, losses: float) -> float:
        return (losses * self.rotor * self.ratio**2 + self.sprocket) / self.arm**2

    def elements(self, pieces: int, drive: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Lumped mass and stiffness from the run-on on, rows of tensions; the drive's mass at the run-on."""
        strands = tuple(
            chain_fem.Strand(self.length, line, self.stiffness) for line in (self.chain + self.load, self.chain)
        )
        mass, stiff = chain_fem.matrices(chain_fem.Chain(strands, self.tail_mass), pieces, lumped=True)
        rows = np.zeros((len(mass) - 1, len(mass)))
        for k in range(len(mass) - 1):
            rows[k, [k, k + 1]] = stiff[k, k + 1] * np.array([-1, 1])
        mass[0, 0] += drive
        if self.fixed:
            join = np.eye(len(mass), len(mass) - 1)
            join[-1, 0] = 1.0
            mass, stiff, rows = join.T @ mass @ join, join.T @ stiff @ join, rows @ join
        return np.diag(mass), stiff, rows


def file(numbers: Numbers, **changed: Any) -> dict[str, Any]:
    data = scraper(**changed)
    if numbers.fixed:
        data["layout"]["takeup"] = {"type": "screw", "tension": "40 kN"}
    return data


def first_frequency(numbers: Numbers) -> float:
    """With the sprocket held, by elements."""
    m, k, _ = numbers.elements(120, 0.0)
    from scipy.linalg import eigh

    return float(np.sqrt(eigh(k[1:, 1:], np.diag(m[1:]), eigvals_only=True, subset_by_index=[0, 0])[0]))


def stepped(
    numbers: Numbers, drive: float, force: Any, window: float, pieces: int, steps: int, eta: float
) -> np.ndarray:
    """Tensions of the elements over time, shape (steps + 1, elements): M u'' + eta K u' + K u = F(t) at the drive, F
    straight over each step, from rest, by the exponential of its first-order form."""
    m, k, rows = numbers.elements(pieces, drive)
    n, dt = len(m), window / steps
    rate = np.zeros((2 * n + 2, 2 * n + 2))
    rate[:n, n : 2 * n] = np.eye(n)
    rate[n : 2 * n, :n], rate[n : 2 * n, n : 2 * n] = -k / m[:, None], -eta * k / m[:, None]
    rate[n, 2 * n] = 1 / m[0]
    rate[2 * n, 2 * n + 1] = 1.0
    map_ = expm(rate * dt)
    state, found = np.zeros(2 * n), [np.zeros(len(rows))]
    for j in range(steps):
        f0, f1 = force(j * dt + 1e-12), force((j + 1) * dt - 1e-12)
        state = (map_ @ np.concatenate([state, [f0, (f1 - f0) / dt]]))[: 2 * n]
        found.append(rows @ (state[:n] + eta * state[n:]))
    return np.array(found)


STARTS = {
    "step": ({"shape": "step"}, lambda t: 1.0),
    "ramp": ({"shape": "ramp", "time": "0.3 s", "control": "torque"}, lambda t: min(t / 0.3, 1.0)),
}


class TestStart:
    @pytest.mark.parametrize("fixed", [False, True])
    @pytest.mark.parametrize("shape", STARTS)
    def test_waves_are_those_of_finite_elements(self, fixed: bool, shape: str) -> None:
        numbers = Numbers(fixed=fixed)
        profile, rise = STARTS[shape]
        spec = built(file(numbers, scenes=[{"type": "start", "profile": profile}]))
        found = solved("chain_start_waves", spec, spec.all_scenes[0], 1)
        assert found.window is not None
        available = numbers.eta * numbers.torque * numbers.ratio / numbers.arm
        needed = numbers.resistance(1.2)[2]
        eta = 0.1 / first_frequency(numbers)

        mass = numbers.drive_mass(numbers.eta) + numbers.moving
        ticks = np.linspace(0.0, found.window[1], 200001)
        pull = np.array([max(available * rise(t) - needed, 0.0) for t in ticks])
        speeds = np.concatenate([[0.0], np.cumsum((pull[1:] + pull[:-1]) / 2) * ticks[1]]) / mass
        at_speed = float(np.interp(numbers.speed, speeds, ticks))

        def force(t: float) -> float:
            """What the motors pull above the resistance, until the chain has its speed."""
            return max(available * rise(t) - needed, 0.0) if t < at_speed else 0.0

        pieces = 60
        tensions = stepped(numbers, numbers.drive_mass(numbers.eta), force, found.window[1], pieces, 1500, eta)
        dynamic = found.loads["tension_dynamic_start"].estimate
        # the first element's tension stands half an element behind the run-on
        at_run_on = (3 * tensions[:, 0] - tensions[:, 1]) / 2
        assert dynamic.value == pytest.approx(at_run_on.max(), rel=6e-3)
        course = found.histories()["tension_start"]
        truth = np.interp(course.times, found.window[1] * np.arange(1501) / 1500, at_run_on)
        swing = np.array(course.values) - course.values[0]
        assert swing == pytest.approx(truth, abs=0.02 * at_run_on.max())
        back = numbers.resistance(1.2)[0]
        rises = np.array([0.0, back - numbers.chain * G * 5, back - numbers.chain * G * 5,
                          numbers.resistance(1.2)[2]])  # fmt: skip
        begin = 12e3 if not fixed else 40e3 - (rises[1] / 2 + (rises[1] + rises[3]) / 2) / 2
        x = (np.arange(pieces) + 0.5) / pieces
        static = np.concatenate([begin + rises[3] - x * (rises[3] - rises[1]), begin + rises[1] * (1 - x)])
        smallest = found.loads["tension_min"].estimate
        # it lies at an end of a strand: half an element beside the next one
        assert smallest.value == pytest.approx((static + tensions).min(), abs=0.006 * at_run_on.max() + rises[3] / 120)

    def test_teeth_of_a_start_against_a_drive_that_gives_way(self) -> None:
        """M u'' + C u' + K u = F + m_drive p'' at the drive, p the run-on's polygon, by DOP853 tooth after tooth."""
        numbers = Numbers(torque=260.0, speed=0.9, pitch=0.2, teeth=6, rotor=0.25)
        data = file(numbers, scenes=[{"type": "start"}], speed="0.9 m/s", sprocket={"teeth": 6, "inertia": "15 kg*m^2"})
        data["layout"]["tail"]["teeth"] = 6
        data["chain"]["pitch"] = "200 mm"
        data["drive"]["motor"] = {"inertia": "0.2 kg*m^2", "mean_starting_torque": "260 N*m"}
        spec = built(data)
        found = solved("chain_start_teeth", spec, spec.all_scenes[0], 1)
        plain = solved("chain_start_waves", spec, spec.all_scenes[0], 1).loads["tension_dynamic_start"].estimate
        assert found.window is not None
        drive = numbers.drive_mass(numbers.eta)
        m, k, rows = numbers.elements(20, drive)
        eta, n = 0.1 / first_frequency(numbers), len(m)
        excess = numbers.eta * numbers.torque * numbers.ratio / numbers.arm - numbers.resistance(1.2)[2]
        a, half = excess / (drive + numbers.moving), math.pi / numbers.teeth
        radius, window = numbers.pitch / 2 / math.sin(half), found.window[1]
        at_speed, gained = numbers.speed / a, numbers.speed**2 / a / 2
        peaks = []
        for lead in (0.0, 0.25, 0.5, 0.75):
            state, now, tooth, most = np.zeros(2 * n), 0.0, 0, 0.0
            while now < window - 1e-12:
                way = (tooth + 1 - lead) * numbers.pitch
                speeds_up = now < at_speed - 1e-12
                engages = math.sqrt(2 * way / a) if way < gained else at_speed + (way - gained) / numbers.speed
                end = min(engages, at_speed if speeds_up else window)

                def motion(
                    t: float, y: np.ndarray, tooth: int = tooth, lead: float = lead, speeds_up: bool = speeds_up
                ) -> np.ndarray:
                    rate, speed = (a, a * t) if speeds_up else (0.0, numbers.speed)
                    gone = a * t * t / 2 if speeds_up else gained + numbers.speed * (t - at_speed)
                    phi = 2 * half * (gone / numbers.pitch + lead - tooth - 0.5)
                    turned = rate / numbers.arm * math.cos(phi) - (speed / numbers.arm) ** 2 * math.sin(phi)
                    force = -(k @ (y[:n] + eta * y[n:]))
                    force[0] += (excess if speeds_up else 0.0) + drive * (radius * turned - rate)
                    return np.concatenate([y[n:], force / m])

                run = solve_ivp(motion, (now, end), state, "DOP853", np.linspace(now, end, 60), rtol=1e-7, atol=1e-11)
                tensions = rows[:2] @ (run.y[:n] + eta * run.y[n:])
                most = max(most, float((1.5 * tensions[0] - 0.5 * tensions[1]).max()))
                state, now, tooth = run.y[:, -1], end, tooth + (end == engages)
            peaks.append(most)
        estimate = found.loads["tension_dynamic_start"].estimate
        assert estimate.value == pytest.approx(max(peaks), rel=0.03)
        assert estimate.value > plain.high, "the teeth are felt"

    def test_acceleration_time_and_reduced_inertia(self) -> None:
        numbers = Numbers()
        spec = built(file(numbers))
        found = solved("chain_rigid_start", spec, spec.all_scenes[0]).loads
        needed, mass = numbers.resistance(1.2)[2], numbers.moving

        def speeds(t: float, y: np.ndarray) -> list[float]:
            """Motor shaft: what its torque leaves accelerates all there is through the gear."""
            whole = (
                numbers.rotor
                + (mass + numbers.sprocket / numbers.arm**2) * (numbers.arm / numbers.ratio) ** 2 / numbers.eta
            )
            return [(numbers.torque - needed * numbers.arm / numbers.ratio / numbers.eta) / whole]

        full = numbers.speed / numbers.arm * numbers.ratio
        run = solve_ivp(speeds, (0, 10), [0.0], events=lambda t, y: y[0] - full, rtol=1e-10, dense_output=True)
        assert found["start_time"].estimate.value == pytest.approx(float(run.t_events[0][0]), rel=1e-8)
        eps = speeds(0.0, np.zeros(1))[0]
        assert found["acceleration_motor"].estimate.value == pytest.approx(eps, rel=1e-12)
        assert found["reduced_inertia"].estimate.value == pytest.approx(
            (numbers.torque - needed * numbers.arm / numbers.ratio / numbers.eta) / eps, rel=1e-12
        )

    def test_textbook_of_the_worked_case_stands_beside(self) -> None:
        """CH-01 through a file: 42 t of chain and load on a sprocket of 0.65 m, 90 N*m on the motor shaft."""
        radius, pitch = 0.325, 2 * 0.325 * math.sin(math.pi / 8)
        static = 90.0 * 40.0 * 0.9 / radius
        spec = built({
            "kind": "chain_drive",
            "layout": {"type": "conveyor", "length": "100 m", "load": "400 kg/m",
                       "resistance": {"coefficient": static / (420 * 100 * G), "turn_factor": 1, "start_factor": 1,
                                      "stop_factor": 1},
                       "takeup": {"type": "gravity", "tension": "20 kN"}, "tail": {"inertia": "0 kg*m^2"}},
            "chain": {"pitch": f"{pitch:.12g} m", "mass": "10 kg/m", "breaking_load": "1 MN", "stiffness": "200 MN"},
            "sprocket": {"teeth": 8, "inertia": "0 kg*m^2"},
            "speed": f"{980 * math.pi / 30 / 40 * radius:.12g} m/s",
            "drive": {"motor": {"inertia": "0.35 kg*m^2", "mean_starting_torque": "160 N*m"},
                      "coupling_inertia": "0 kg*m^2", "gear": {"ratio": 40, "efficiency": 0.9}},
            "scenes": [{"type": "start"}],
        })  # fmt: skip
        beside = solved("chain_start_notes", spec, spec.all_scenes[0]).loads
        assert beside["reduced_inertia"].estimate.value == pytest.approx(3.43073, rel=1e-5)
        assert beside["acceleration_motor"].estimate.value == pytest.approx(20.4038, rel=1e-5)
        assert beside["start_time"].estimate.value == pytest.approx(5.02971, rel=1e-5)
        assert beside["tension_dynamic_start"].estimate.value == pytest.approx(6962.81, rel=1e-5)

    def test_a_descent_drives_its_motor(self) -> None:
        """An empty motor under an overhauling load: the losses help the motor, and the balance says so."""
        data = file(Numbers())
        data["layout"] |= {"lift": "-32 m"}
        data["drive"]["motor"]["mean_starting_torque"] = "1 N*m"
        spec = built(data)
        found = solved("chain_rigid_start", spec, spec.all_scenes[0]).loads
        pull = found["static_resistance"].estimate.value
        assert pull < 0
        numbers = Numbers()
        a = found["acceleration_motor"].estimate.value / numbers.ratio * numbers.arm
        mesh = (numbers.moving + numbers.sprocket / numbers.arm**2) * a + pull
        assert mesh < 0
        left = 1.0 - numbers.rotor * a * numbers.ratio / numbers.arm
        assert mesh == pytest.approx(left * numbers.ratio / numbers.arm / numbers.eta, rel=1e-9)


class Teeth:
    """Elements of the scraper with its run-on moved by a polygon, by DOP853 from engagement to engagement."""

    def __init__(self, numbers: Numbers, drive: float, pieces: int) -> None:
        self.numbers = numbers
        self.mass, self.stiff, self.rows = numbers.elements(pieces, drive if math.isfinite(drive) else 0.0)
        self.drive = drive
        self.eta = 0.1 / first_frequency(numbers)

    def run(self, begin: float, rate: float, window: float, lead: float) -> np.ndarray:
        """Tensions of the elements at 60 places of every pass; coordinates go with the even motion of the sprocket."""
        n, numbers = len(self.mass), self.numbers
        half = math.pi / numbers.teeth
        radius = numbers.pitch / 2 / math.sin(half)
        held = not math.isfinite(self.drive)
        m, k = (self.mass[1:], self.stiff[1:, 1:]) if held else (self.mass, self.stiff)
        count = len(m)
        state, now, found = np.zeros(2 * count), 0.0, []
        way = lambda t: begin * t + rate * t * t / 2  # noqa: E731
        tooth = 0
        while now < window - 1e-12:
            wanted = (tooth + 1 - lead) * numbers.pitch
            root = begin**2 + 2 * rate * wanted
            end = min(2 * wanted / (begin + math.sqrt(root)) if root >= 0 else math.inf, window)

            def polygon(t: float, tooth: int = tooth) -> tuple[float, float, float]:
                """Of the run-on against the even motion: way, speed, acceleration."""
                v, phi = (begin + rate * t) / numbers.arm, 2 * half * (way(t) / numbers.pitch + lead - tooth - 0.5)
                e = rate / numbers.arm
                return (radius * (math.sin(phi) - phi * math.sin(half) / half),
                        radius * v * (math.cos(phi) - math.sin(half) / half),
                        radius * (e * (math.cos(phi) - math.sin(half) / half) - v * v * math.sin(phi)))  # fmt: skip

            def motion(t: float, y: np.ndarray, polygon: Any = polygon) -> np.ndarray:
                u, v = y[:count], y[count:]
                _, _, a = polygon(t)
                # y relative to the moved run-on: every mass feels the acceleration of the run-on
                pull = -(k @ (u + self.eta * v)) / m
                base = -(rate + a) * np.ones(count)
                return np.concatenate([v, pull + base])

            run = solve_ivp(motion, (now, end), state, "DOP853", np.linspace(now, end, 60), rtol=1e-6, atol=1e-9)
            both = run.y[:count] + self.eta * run.y[count:]
            whole = np.vstack([np.zeros(both.shape[1]), both]) if held else both
            found.append(self.rows @ whole)
            state, now, tooth = run.y[:, -1], end, tooth + 1
        assert n == count + held
        return np.concatenate(found, axis=1)


class TestSpeedRange:
    def test_a_run_up_through_resonance(self) -> None:
        numbers = Numbers()
        spec = built(
            file(numbers, scenes=[{"type": "speed_range", "from": "0.25 m/s", "to": "0.6 m/s", "time": "6 s"}])
        )
        found = solved("chain_run_through", spec, spec.all_scenes[0], 1)
        estimate = found.loads["tension_speed_range"].estimate
        teeth = Teeth(numbers, math.inf, 14)
        # the first element lies behind the node that the sprocket moves: its half mass is at the sprocket
        most = max(float(teeth.run(0.25, 0.35 / 6, 6.0, lead)[0].max()) for lead in (0.0, 0.5))
        assert estimate.value == pytest.approx(most, rel=0.03)
        assert estimate.low <= most * 1.02
        assert most * 0.98 <= estimate.high

    def test_the_resonance_is_on_the_way(self) -> None:
        """The same change of speed beside any resonance pulls far less."""
        through = [{"type": "speed_range", "from": "0.5 m/s", "to": "0.75 m/s", "time": "10 s"}]
        beside = [{"type": "speed_range", "from": "0.9 m/s", "to": "1.1 m/s", "time": "10 s"}]
        one, other = (
            solved("chain_run_through", spec, spec.all_scenes[0]).loads["tension_speed_range"].estimate
            for spec in (built(scraper(scenes=scene)) for scene in (through, beside))
        )
        assert one.low > other.high

    def test_slower_is_nearer_to_the_even_speed(self) -> None:
        """A very slow run through a resonance comes to the peak of steady running there, and not beyond."""
        scenes = [{"type": "speed_range", "from": "0.6 m/s", "to": "0.75 m/s", "time": "60 s"}, {"type": "run"}]
        data = scraper(scenes=scenes)
        steady = []
        for speed in np.linspace(0.6, 0.75, 16):
            spec = built(data | {"speed": f"{speed:.4f} m/s"})
            run = solved("distributed_strand", spec, spec.all_scenes[1])
            steady.append(run.loads["tension_dynamic_polygon"].estimate.value)
        spec = built(data)
        passed = solved("chain_run_through", spec, spec.all_scenes[0], 1).loads["tension_speed_range"].estimate
        assert passed.value == pytest.approx(max(steady), rel=0.08)


class TestStop:
    @pytest.mark.parametrize("lift", [5.0, -25.0])
    @pytest.mark.parametrize("brake", [
        {"torque": "150 N*m", "delay": "0.1 s", "rise_time": "0.3 s"},
        {"torque": "9 kN*m", "shaft": "sprocket", "rise_time": "0.2 s"},
        {"torque": "60 N*m"},
    ])  # fmt: skip
    def test_way_and_time_are_those_of_the_equations_of_motion(self, lift: float, brake: dict[str, str]) -> None:
        numbers = replace(Numbers(), lift=lift)
        data = file(numbers, brake=brake, scenes=[{"type": "emergency_stop"}])
        data["layout"] |= {"lift": f"{lift} m"}
        spec = built(data)
        found = solved("chain_stop", spec, spec.all_scenes[0]).loads
        needed = numbers.resistance(0.8)[2]
        mass = numbers.moving + numbers.sprocket / numbers.arm**2
        full = float(brake["torque"].split()[0]) * (1e3 if "kN" in brake["torque"] else 1.0)
        delay, rise = (float(brake.get(key, "0 s").split()[0]) for key in ("delay", "rise_time"))

        def motion(t: float, y: np.ndarray) -> list[float]:
            """Motor shaft and chain with the torque between them, losses by its sign."""
            held = full * (0.0 if t < delay else min((t - delay) / rise, 1.0) if rise else 1.0)
            on_chain = needed + (held / numbers.arm if brake.get("shaft") == "sprocket" else 0.0)
            on_motor = 0.0 if brake.get("shaft") == "sprocket" else held
            step = numbers.ratio / numbers.arm
            for losses in (numbers.eta, 1 / numbers.eta):
                a = -(on_motor * step / losses * 1.0 + on_chain) / (mass + numbers.rotor * step**2 / losses)
                through = -mass * a - on_chain  # what the chain pushes into the gear
                if (through >= 0) == (losses < 1):
                    break
            return [a, y[0]]

        if needed < 0 and motion(100.0, np.zeros(2))[0] >= 0:
            assert found["stop_time"].estimate.value == math.inf
            return
        run = solve_ivp(motion, (0, 100), [numbers.speed, 0.0], events=_at_rest, rtol=1e-10, atol=1e-12, max_step=0.002)
        assert found["stop_time"].estimate.value == pytest.approx(float(run.t_events[0][0]), rel=1e-5)
        assert found["stop_distance"].estimate.value == pytest.approx(float(run.y_events[0][0][1]), rel=1e-5)

    @pytest.mark.parametrize("lift", ["2 m", "-25 m"])
    def test_the_torque_it_asks_for_stops_it_in_that_way(self, lift: str) -> None:
        data = scraper(brake={"torque": "1 N*m"}, checks={"stop_distance": "60 mm"}, scenes=[{"type": "stop"}])
        data["layout"] |= {"lift": lift}
        spec = built(data)
        torque = solved("chain_stop", spec, spec.all_scenes[0]).loads["brake_torque_required"].estimate.value
        assert torque > 0
        again = built(data | {"brake": {"torque": f"{torque:.15g} N*m"}})
        way = solved("chain_stop", again, again.all_scenes[0]).loads["stop_distance"].estimate.value
        assert way == pytest.approx(0.06, rel=1e-9)

    def test_overload_of_the_worked_case(self) -> None:
        """ST-02: m v^2/(2 s)."""
        spec = built(
            scraper(brake={"torque": "100 N*m"}, checks={"stop_distance": "100 mm"}, scenes=[{"type": "stop"}])
        )
        found = solved("chain_stop", spec, spec.all_scenes[0]).loads["tension_overload_braking"].estimate
        assert found.value == pytest.approx(Numbers().moving * 0.5**2 / 0.2, rel=1e-12)

    def test_a_measured_way_tells_the_resistance(self) -> None:
        """A run-out computed with a coefficient gives that coefficient back."""
        data = scraper(scenes=[{"type": "coast", "measured_distance": "1 m"}])
        data["layout"]["resistance"] = {"coefficient": 0.25, "turn_factor": 1.1, "start_factor": 1.2, "stop_factor": 1}
        spec = built(data)
        way = solved("chain_stop", spec, spec.all_scenes[0]).loads["coast_distance"].estimate.value
        data["scenes"] = [{"type": "coast", "measured_distance": f"{way:.15g} m"}]
        spec = built(data)
        found = solved("chain_stop", spec, spec.all_scenes[0]).loads["resistance_coefficient_identified"].estimate
        assert found.value == pytest.approx(0.25, rel=1e-6)

    def test_waves_are_those_of_finite_elements(self) -> None:
        """An elastic run-out with next to no losses in the gear: both directions of the power are one."""
        numbers = replace(Numbers(), eta=1.0)
        data = file(numbers, scenes=[{"type": "coast"}])
        data["drive"]["gear"]["efficiency"] = 1.0
        spec = built(data)
        found = solved("chain_stop_waves", spec, spec.all_scenes[0], 1)
        assert found.window is not None
        needed = numbers.resistance(0.8)[2]
        tensions = stepped(numbers, numbers.drive_mass(1.0), lambda t: -needed, found.window[1], 60, 1500,
                           0.1 / first_frequency(numbers))  # fmt: skip
        back, _, whole = numbers.resistance(0.8)
        x = (np.arange(60) + 0.5) / 60
        at_tail = 12e3 + back - numbers.chain * G * 5
        static = np.concatenate([12e3 + whole - x * (12e3 + whole - at_tail), at_tail + x * (12e3 - at_tail)])
        assert found.loads["tension_min"].estimate.value == pytest.approx((static + tensions).min(), abs=0.01 * needed)


def _at_rest(t: float, y: np.ndarray) -> float:
    return float(y[0])


_at_rest.terminal = True  # type: ignore[attr-defined]


class TestBackstop:
    def test_of_the_worked_case(self) -> None:
        """ST-01 through a file: weights 1500 and 800 N/m, 60 m at 20 degrees, resistance 0.08, radius 0.325 m."""
        pitch = 0.325 * 2 * math.pi / 8
        spec = built({
            "kind": "chain_drive",
            "layout": {"type": "conveyor", "length": "60 m", "lift": f"{60 * math.sin(math.radians(20)):.15g} m",
                       "load": f"{1500 / G:.15g} kg/m", "takeup": {"type": "gravity", "tension": "20 kN"},
                       "resistance": {"coefficient": 0.08, "turn_factor": 1, "stop_factor": 1}},
            "chain": {"pitch": f"{pitch:.15g} m", "mass": f"{800 / G:.15g} kg/m", "breaking_load": "1 MN",
                      "stiffness": "200 MN"},
            "sprocket": {"teeth": 8}, "speed": "0.5 m/s", "scenes": [{"type": "backstop"}],
        })  # fmt: skip
        found = solved("chain_hold", spec, spec.all_scenes[0]).loads["backstop_torque"].estimate
        assert found.value == pytest.approx(5459.74, rel=1e-5)


def test_a_driving_sprocket_without_inertia_turns_with_none() -> None:
    """Left out it is 0, in starts and stops as in runs; one that is not makes the start slower."""
    scenes = [{"type": "start"}, {"type": "stop"}]
    times = []
    for inertia in ({}, {"inertia": "0 kg*m^2"}, {"inertia": "15 kg*m^2"}):
        data = scraper(scenes=scenes)
        data["sprocket"] = {"teeth": data["sprocket"]["teeth"]} | inertia
        start = next(one for one in report_of(data).scenes if one.type == "start")
        times.append(load_of(start, "start_time").estimate.value)
    assert times[0] == times[1] < times[2]


def test_seeded_machines_have_loads_that_are_numbers() -> None:
    """Nothing breaks and nothing is NaN over the whole sample, whatever the shape of the start."""
    rng = np.random.default_rng(77)
    for _ in range(12):
        spec = built(random_chain(rng))
        for name in ("chain_rigid_start", "chain_start_notes"):
            result = solved(name, spec, spec.all_scenes[0])
            assert not any(math.isnan(found.estimate.value) for found in result.loads.values())


class TestRelaxedChain:
    def test_is_wound_up_before_its_load_breaks_loose(self) -> None:
        """Two masses by scipy: the peak lies above that of a chain with its running tensions in it."""
        data = scraper(scenes=[{"type": "start", "chain": "relaxed"}, {"type": "start", "name": "again"}])
        data["chain"]["damping"] = {"ratio": 0}
        spec = built(data)
        relaxed, again = spec.all_scenes
        found = solved("chain_breakaway", spec, relaxed).loads["tension_start"].estimate.value
        numbers = Numbers()
        drive, load = numbers.drive_mass(numbers.eta), numbers.moving
        force, needed = numbers.eta * numbers.torque * numbers.ratio / numbers.arm, numbers.resistance(1.2)[2]
        # until it breaks loose the drive swings alone on the spring; then both, about the rigid body's tension
        even, left = needed + (force - needed) * load / (drive + load), needed * (2 * force - needed)
        peak = even + math.sqrt((even - needed) ** 2 + left * load / (drive + load))
        assert found == pytest.approx(12e3 + peak, rel=1e-6)
        assert found > solved("chain_start_waves", spec, again).loads["tension_start"].estimate.high

    def test_no_bar_is_claimed_for_it(self) -> None:
        spec = built(scraper(scenes=[{"type": "start", "chain": "relaxed"}]))
        scene = spec.all_scenes[0]
        loads = {name: one.estimate for name, one in solved("chain_breakaway", spec, scene).loads.items()}
        effect = next(one for one in KIND.effects if one.name == "higher_modes")
        assert not any(offset.bounded for offset in effect.bound(spec, scene, loads).values())
        assert effect.bound(spec, scene, loads)
