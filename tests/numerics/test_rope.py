"""A load on a rope with mass, and on one that gets shorter: closed forms, finite elements, integrations of our own."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.rope import rule
from ptmcalc.numerics.rope.equations import Hauled, Rod, U, W, Z
from ptmcalc.numerics.rope.march import March, Played, energy
from ptmcalc.numerics.rope.parts import NONE, Course, Governed, Haul, Lines, Smooth, Stage, Structure, Tripped

G = 9.81
M, K, V0 = 5000.0, 1.2e6, 0.25
Q = M * G
SURE = Course(values=(1e9 * Q,))


def lifting(**changes: object) -> Haul:
    """A load lifted off the ground by a drive of 18 t that keeps its speed as long as that takes no more than 1e9 Q."""
    one = Haul(
        18000.0, 0.0, M, Q, (1.0, 1.0), (1.0, 1.0), None, True, 0.0, V0, 1,
        set_speed=Course(values=(V0,)), capacity=SURE,
    )  # fmt: skip
    return replace(one, **changes)  # type: ignore[arg-type]


def stopping(**changes: object) -> Haul:
    """A load lowered at 0.4 m/s, then braked, with losses."""
    one = Haul(
        18000.0, 2000.0, M, Q, (0.93, 2 - 1 / 0.93), (0.97, 0.96), None, False, 0.0, -0.4, -1,
        motor_brake=Tripped(Course((0.0, 0.1, 0.2), (0.0, 0.0, 2 * Q), (0.0, 20 * Q, 0.0))),
    )  # fmt: skip
    return replace(one, **changes)  # type: ignore[arg-type]


def played(haul: Haul, rope: Rod | Hauled, end: float, finer: float = 1.0) -> Played:
    """A motion whose energy closes."""
    march = March(haul, rope, finer)
    found = march.play(end)
    left, scale = energy(march, found)
    assert left <= 1e-11 * scale
    return found


def most(found: Played, what: str) -> float:
    return rule.largest(found.stack(what))[0]


# -- waves in closed form -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("share", [0.05, 0.3, 1.0])
def test_a_held_load_sees_the_wave_come_doubled_again_and_again(share: float) -> None:
    """With a kept speed the force at the load rises by 2 Z v at every second transit until it lifts the load."""
    rod = Rod(K, share * M)
    step, tau = 2 * math.sqrt(K * share * M) * V0, math.sqrt(share * M / K)
    blows = math.floor(Q / step) + 1
    found = played(lifting(), rod, 3.0)
    lifted = next(time for time, what in found.events if what == "lift")
    assert lifted == pytest.approx((2 * blows - 1) * tau, rel=1e-12)
    for panel in found.panels:
        middle = panel.start + panel.length / 2
        if middle < lifted:
            assert panel.bottom == pytest.approx(
                np.full(rule.COUNT, step * math.floor((middle / tau + 1) / 2)), abs=1e-8 * Q
            )


def test_the_load_follows_the_first_wave_in_closed_form() -> None:
    """Held drum, load let go by half its weight: M v' = F - Q, F = 2 f - Z v decays exponentially until the echo."""
    rod = Rod(K, M)
    z = rod.impedance
    haul = lifting(lifts=False, speed=0.0, set_speed=None, capacity=NONE, motor_brake=Tripped(SURE))
    march = March(haul, rod)
    mode, y = march.begin()
    assert mode.turn == 0
    march.begin = lambda: (mode, np.where(np.arange(7) == 4, 0.1, y))  # type: ignore[method-assign]
    found = march.play(0.9 * 2 * rod.transit)
    for panel in found.panels:
        t = panel.start + panel.length * rule.NODES
        assert panel.bottom == pytest.approx(Q - 0.1 * z * np.exp(-z / M * t), rel=1e-11)


def test_a_rod_of_no_mass_to_speak_of_is_a_spring() -> None:
    """First peak of a kept speed: 1 + v (K/M)^(1/2)/g, up to steps of the waves."""
    for share, part in ((1e-3, 0.08), (1e-4, 0.025)):
        found = played(lifting(), Rod(K, share * M), 1.0)
        assert most(found, "bottom") / Q == pytest.approx(1 + V0 * math.sqrt(K / M) / G, abs=part)


# -- finite elements ------------------------------------------------------------------------------------------------


def chain_forces(structure: Structure | None, share: float, pieces: int, end: float) -> tuple[float, float, float]:
    """Largest force at drum and load and in the structure, of bars with linear shapes: a hanging load is started by a
    force that rises slowly."""
    n = pieces + 1 + (structure is not None)
    mass, stiff = np.zeros((n, n)), np.zeros((n, n))
    for k in range(pieces):
        rows = [k, k + 1]
        mass[np.ix_(rows, rows)] += share * M / pieces / 6 * np.array([[2.0, 1.0], [1.0, 2.0]])
        stiff[np.ix_(rows, rows)] += K * pieces * np.array([[1.0, -1.0], [-1.0, 1.0]])
    turn = np.eye(n)
    mass[pieces, pieces] += M
    if structure is not None:  # top of the rope = drum - sag
        turn[0, -1] = -1.0
        mass, stiff = turn.T @ mass @ turn, turn.T @ stiff @ turn
        mass[-1, -1] += structure.mass
        stiff[-1, -1] += structure.stiffness
    mass[0, 0] += 18000.0
    inverse = np.linalg.inv(mass)

    def rate(t: float, y: np.ndarray) -> np.ndarray:
        push = np.zeros(n)
        push[0] = 0.5 * Q * min(t / 0.8, 1.0)
        return np.concatenate([y[n:], inverse @ (push - stiff @ y[:n])])

    run = solve_ivp(rate, (0, end), np.zeros(2 * n), method="DOP853", rtol=1e-10, atol=1e-12, dense_output=True)
    times = np.linspace(0, end, 4001)
    y = run.sol(times)
    x = turn @ y[:n]
    a = turn @ (
        inverse @ (np.where(np.arange(n)[:, None] == 0, 0.5 * Q * np.minimum(times / 0.8, 1.0), 0) - stiff @ y[:n])
    )
    first = K * pieces * (x[0] - x[1]) + share * M / pieces / 6 * (2 * a[0] + a[1])
    load = M * a[pieces] + Q
    sag = structure.stiffness * y[n - 1] if structure is not None else np.zeros(1)
    return float(first.max()) + Q, float(load.max()), float(sag.max()) + Q


@pytest.mark.parametrize("structure", [None, Structure(8 * K, 0.7 * M, 0.0)])
@pytest.mark.parametrize("share", [0.1, 0.5])
def test_a_slow_rise_agrees_with_finite_elements(structure: Structure | None, share: float) -> None:
    law = Course((0.0, 0.8), (Q, 1.5 * Q), (0.5 * Q / 0.8, 0.0))
    haul = lifting(lifts=False, speed=0.0, structure=structure, set_speed=Course(values=(1e3,)), capacity=law)
    found = played(haul, Rod(K, share * M), 1.5)
    top, bottom, bridge = chain_forces(structure, share, 60, 1.5)
    assert most(found, "top") == pytest.approx(top, rel=2e-5)
    assert most(found, "bottom") == pytest.approx(bottom, rel=2e-5)
    if structure is not None:
        sag = rule.largest(found.stack("states")[:, :, Z])[0]
        assert structure.stiffness * sag == pytest.approx(bridge, rel=2e-5)


# -- a rope that is hauled in ---------------------------------------------------------------------------------------


def integrated(haul: Haul, rope: Hauled, end: float) -> np.ndarray:
    """Times and forces of a kept speed that hauls a load off the ground, by DOP853."""
    c, length = rope.extensional, rope.length

    def pull(y: np.ndarray) -> np.ndarray:
        return np.asarray(c * (length - y[1] - y[2] - y[3]) / y[3])

    def rate(t: float, y: np.ndarray, free: bool) -> list[float]:
        f = float(pull(y))
        a = (f - Q) / M if free else 0.0
        z = haul.structure
        assert z is not None
        return [a, y[0], y[4], -V0 / (1 + f / c), (f - z.stiffness * y[2]) / z.mass]

    def off(t: float, y: np.ndarray, free: bool) -> float:
        return float(pull(y)) - Q

    off.terminal, off.direction = True, 1  # type: ignore[attr-defined]
    options = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14, "dense_output": True}
    first = solve_ivp(rate, (0, end), [0.0, 0.0, 0.0, length, 0.0], args=(False,), events=off, **options)
    second = solve_ivp(rate, (first.t[-1], end), first.y[:, -1], args=(True,), **options)
    times = np.linspace(first.t[-1], end, 200001)
    return np.array([times, pull(second.sol(times))])


def test_hauling_agrees_with_an_integration_of_our_own() -> None:
    haul, rope = lifting(structure=Structure(6 * K, 0.5 * M, 0.0)), Hauled(K * 10, 10.0, 0.0, Q / (K * 10))
    found = played(haul, rope, 6.0)
    times, force = integrated(haul, rope, 6.0)
    assert most(found, "top") == pytest.approx(force.max(), rel=1e-7)
    inside = [panel for panel in found.panels if panel.start > times[0] + 1e-9]
    for panel in inside[:: max(len(inside) // 20, 1)]:
        t = panel.start + panel.length / 2
        ours = float((rule.to(np.array([0.5])) @ panel.top)[0])
        assert ours == pytest.approx(np.interp(t, times, force), rel=1e-5)


@pytest.mark.parametrize("shorter", [15.0, 60.0])
def test_a_swing_grows_as_the_fourth_root_while_it_is_hauled_in(shorter: float) -> None:
    """3 t hauled up from 120 m: the force's swing grows by (l0/l1)^(1/4), 1.68 to 15 m."""
    c, mass = 1.05e11 * 1.6e-4, 3000.0
    weight, v = mass * G, 0.5
    haul = replace(lifting(load_mass=mass, weight=weight, speed=v), lifts=False, set_speed=Course(values=(v,)))
    rope = Hauled(c, 120.0, 0.0, weight / c)
    march = March(haul, rope)
    mode, y = march.begin()
    y[4] *= 0.9  # a swing small beside the weight
    march.begin = lambda: (mode, y)  # type: ignore[method-assign]
    end = (120.0 - shorter) / v
    found = march.play(end)
    force = np.concatenate([panel.top for panel in found.panels]) - weight
    starts = np.concatenate([panel.start + panel.length * rule.NODES for panel in found.panels])
    first, last = (np.abs(force[(starts >= a) & (starts <= b)]).max() for a, b in ((0.0, 1.2), (end - 1.2, end)))
    assert last / first == pytest.approx((120 / shorter) ** 0.25, rel=0.02)


def test_the_longer_rope_the_more_it_is_a_spring() -> None:
    apart = []
    for longer in (1.0, 10.0, 100.0):
        rope = Hauled(K * 10 * longer, 10.0 * longer, 0.0, Q / (K * 10 * longer))
        apart.append(abs(most(played(lifting(), rope, 1.0), "top") / Q - 1 - V0 * math.sqrt(K / M) / G))
    assert apart[0] > 8 * apart[1] > 64 * apart[2]


# -- drives, brakes, losses -----------------------------------------------------------------------------------------


def step(force: float, **until: float) -> Stage:
    return Stage(Lines(np.zeros(1), np.array([force * Q])), **until)


DRIVES = {
    "line": {"stages": (Stage(Lines(np.array([0.0, V0]), np.array([3 * Q, 0.0]), True)),)},
    "stages": {"stages": (step(1.2, until=0.1), step(1.6))},
    "by time": {"stages": (step(0.8, until_time=0.3), step(1.6))},
    "smooth": {"stages": (Stage(Smooth(lambda w: 2.5 * Q * (1 - (w / V0) ** 3))),)},
    "governed": {"stages": (Stage(Governed(Course((0.0, 0.5), (0.0, V0), (V0 / 0.5, 0.0)), 40 * Q, 2 * Q)),)},
    "limited speed": {"set_speed": Course(values=(V0,)), "capacity": Course(values=(1.5 * Q,))},
    "ramp of speed": {
        "set_speed": Course((0.0, 0.4), (0.0, V0), (V0 / 0.4, 0.0)),
        "capacity": Course(values=(1.5 * Q,)),
    },
    "limiter": {
        "set_speed": Course(values=(V0,)),
        "capacity": Course(values=(1.5 * Q,)),
        "gate": Tripped(Course(values=(1.0,)), Course((0.0, 0.05), (1.0, 0.0), (0.0, 0.0))),
        "motor_brake": Tripped(Course(), Course((0.0, 0.1), (0.0, 2 * Q), (0.0, 0.0))),
        "level": 1.1 * Q,
    },
}  # fmt: skip


@pytest.mark.parametrize("rope", [Rod(K, 0.2 * M), Hauled(K * 10, 10.0, 2e3, Q / (K * 10))], ids=["rod", "hauled"])
@pytest.mark.parametrize("drive", DRIVES)
@pytest.mark.parametrize("structure", [None, Structure(8 * K, 0.5 * M, 1e3), Structure(8 * K, 0.0, 0.0)])
def test_energy_closes_and_finer_panels_change_nothing(
    drive: str, rope: Rod | Hauled, structure: Structure | None
) -> None:
    speed = 0.0 if drive in ("stages", "by time", "governed", "ramp of speed") else V0
    parts = {"set_speed": None, "capacity": NONE} | DRIVES[drive]
    haul = lifting(
        gear=(0.93, 2 - 1 / 0.93), tackle=(0.97, 0.96), drum_mass=900.0, structure=structure, speed=speed, **parts
    )
    one, other = played(haul, rope, 1.5), played(haul, rope, 1.5, 1.4)
    assert one.events, "nothing happened"
    for what in ("top", "bottom"):
        assert most(one, what) == pytest.approx(most(other, what), rel=1e-8)


@pytest.mark.parametrize("rope", [Rod(K, 0.2 * M), Hauled(K * 10, 10.0, 0.0, Q / (K * 10))], ids=["rod", "hauled"])
@pytest.mark.parametrize("on_drum", [False, True])
def test_a_brake_stops_the_load_and_holds_it(rope: Rod | Hauled, on_drum: bool) -> None:
    haul = stopping()
    if on_drum:
        haul = replace(haul, motor_brake=Tripped(), drum_brake=haul.motor_brake)
    found = played(haul, rope, 3.0)
    assert found.mode.turn == 0
    assert found.state[W] == 0
    assert found.state[U] < -0.04  # it fell at least while the brake was open


def test_an_exponential_brake_is_that_of_its_formula() -> None:
    """A drive alone, no rope to speak of: w' = -B (1 - exp(-t/T))/m until it stands."""
    rise, full = 0.2, 5e3
    course = Course((0.0,), (full,), (0.0,), -full, rise, 0.0)
    haul = Haul(1000.0, 0.0, 1.0, 9.81, (1.0, 1.0), (1.0, 1.0), None, True, 50.0, 0.5, 1, motor_brake=Tripped(course))
    found = played(haul, Hauled(1e3, 10.0, 0.0, 1e-2), 1.0)

    def speed(t: float) -> float:
        return 0.5 - full / 1000 * (t - rise * (1 - math.exp(-t / rise)))

    assert speed(found.rests[0]) == pytest.approx(0.0, abs=1e-10)


def test_a_rope_with_mass_that_goes_slack_ends_there() -> None:
    haul = stopping(speed=3.0, way=1, motor_brake=Tripped(Course(values=(8 * Q,))))
    found = March(haul, Rod(K, 0.2 * M)).play(3.0)
    assert math.isfinite(found.slack_at)
    assert found.time == found.slack_at


def test_a_hauled_rope_goes_slack_and_snatches() -> None:
    haul = stopping(speed=2.0, way=1, motor_brake=Tripped(Course(values=(8 * Q,))))
    found = played(haul, Hauled(K * 10, 10.0, 0.0, Q / (K * 10)), 3.0)
    assert [what for _, what in found.events if what in ("slack", "taut")][:2] == ["slack", "taut"]
    assert min(panel.top.min() for panel in found.panels) > -1e-6 * Q


@pytest.mark.parametrize("structure", [None, Structure(8 * K, 0.5 * M, 1e3)])
def test_a_load_that_lands_loses_what_it_moved_with(structure: Structure | None) -> None:
    """Lowered by 30 mm at the speed it hangs with, its blow on the ground is in the ledger."""
    haul, rope = lifting(speed=-V0, way=-1, set_speed=Course(values=(-V0,)), structure=structure), Hauled(
        K * 10, 10.0, 0.0, Q / (K * 10)
    )  # fmt: skip
    march = March(haul, rope)
    mode, y = march.begin()
    strain, sag = Q / (K * 10), Q / (8 * K) if structure is not None else 0.0
    y[Z], y[U], y[4] = sag, 0.03, -V0
    y[6] = (10.0 * strain + sag + 0.03) / (1 + strain)
    hanging = mode._replace(ground=False)
    march.begin = lambda: (hanging, y.copy())  # type: ignore[method-assign]
    found = march.play(0.4)
    landed = next(time for time, what in found.events if what == "land")
    assert landed == pytest.approx(0.03 / V0, rel=1e-6)
    assert found.lost == pytest.approx(M * V0**2 / 2, rel=1e-6)
    left, scale = energy(march, found)
    assert left <= 1e-11 * scale


def test_what_cannot_be_resolved_is_said() -> None:
    haul = lifting(set_speed=None, capacity=NONE, stages=(Stage(Smooth(lambda w: np.full(w.shape, np.nan))),))
    with pytest.raises(NumericsError):
        March(haul, Rod(K, 0.1 * M)).play(1.0)


@pytest.mark.parametrize("rope", ["rod", "hauled"])
def test_a_finer_march_has_panels_so_much_shorter(rope: str) -> None:
    given = Rod(K, 0.3 * M) if rope == "rod" else Hauled(K * 20.0, 20.0, 0.01, Q / K / 20.0)
    one = March(lifting(), given).longest
    assert [one / March(lifting(), given, finer).longest for finer in (2.0, 7.0)] == pytest.approx([2.0, 7.0])
    if rope == "rod":
        assert one <= math.sqrt(0.3 * M / K), "no longer than a wave takes"
