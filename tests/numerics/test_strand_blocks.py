"""A loop advanced in blocks and panels: against one step after the other, all pairs of samples, the echo series."""

from dataclasses import replace

import numpy as np
import pytest
from support import echoes

from ptmcalc.numerics import exponential_step, panel_interpolation, strand, strand_delays, strand_drum, strand_envelopes
from ptmcalc.numerics.collocation import gauss
from ptmcalc.numerics.loop import Drive, Grid, Grip, Loop, Strand, at_end, match, panelled, steps_of

SEEDS = range(12)


def drawn(seed: int, grip: bool) -> tuple[Loop, Drive, float, Grid]:
    """A loop, what drives it, a window that ends anywhere in a step, and a grid; unlike in everything."""
    rng = np.random.default_rng(seed)
    stiffness, length = 10 ** rng.uniform(6, 8), 10 ** rng.uniform(1, 3)
    low, middle, high = np.sort(rng.uniform(2e4, 2e5, 3)) if seed % 3 else (5e4, 5e4, 5e4)
    carry, back = (
        Strand(length, 10 ** rng.uniform(1, 2.5), stiffness, *ends) for ends in ((middle, high), (low, middle))
    )
    loop = Loop(
        carry,
        back,
        10 ** rng.uniform(0, 4.5),
        rng.choice([0.0, 2e3]),
        fixed_length=bool(seed % 2),
        grip=Grip(rng.uniform(0.5, 1.5), 12.0) if grip else None,
        impedance_jump=bool(seed % 5),
    )
    rise, force = rng.uniform(0.05, 2) * carry.transit, rng.uniform(1e4, 8e4)
    ramp = Drive(force=lambda t: force * np.clip(t / rise, 0, 1))
    drive = ramp if seed % 4 else Drive(speed=lambda t: 3.0 * np.clip(t / rise, 0, 1))
    window = rng.uniform(0.02, 6) * carry.transit
    return loop, drive, window, match(carry.transit, back.transit, int(rng.integers(3, 60)), 1e-3, at_most=200)


def by_steps(loop: Loop, drive: Drive, steps: int, grid: Grid) -> np.ndarray:
    """The waves that leave drum, tail, tail and run-off, one step after the other."""
    times = np.arange(steps + 1) * grid.step
    z_carry, z_back = loop.impedances
    z_off = z_back if loop.fixed_length else 0.0

    def node(mass: float, z: float, v: float, before: float, after: float) -> float:
        if mass == 0:
            return after / z
        x = z / mass * grid.step
        late = 1 + np.expm1(-x) / x
        return float(np.exp(-x) * v + (-(np.expm1(-x) + late) * before + late * after) / z)

    waves = np.zeros((4, steps + 1))
    belt = tail = tail_before = 0.0
    force = drive.force(times) if drive.force else 0 * times
    speeds = drive.speed(times) if drive.speed else None
    drum_before = force[0]
    for k in range(1, steps + 1):
        n_on, p_tail = (waves[i, k - grid.carry] if k >= grid.carry else 0.0 for i in (1, 0))
        p_off, n_tail = (waves[i, k - grid.back] if k >= grid.back else 0.0 for i in (2, 3))
        pushed = force[k] - n_on + (p_off if loop.fixed_length else 0.0)
        if speeds is not None:
            belt = speeds[k]
        else:
            belt = node(loop.drum_mass, z_carry + z_off, belt, drum_before, pushed)
        tail = node(loop.tail_mass, z_carry + z_back, tail, tail_before, p_tail - n_tail)
        drum_before, tail_before = pushed, p_tail - n_tail
        waves[:, k] = (
            n_on + 2 * z_carry * belt,
            p_tail - 2 * z_carry * tail,
            n_tail + 2 * z_back * tail,
            p_off - 2 * z_back * belt if loop.fixed_length else -p_off,
        )
    return waves


@pytest.mark.parametrize("seed", SEEDS)
def test_blocks_are_the_steps_one_after_the_other(seed: int) -> None:
    loop, drive, window, grid = drawn(seed, grip=False)
    motion = strand.march(loop, drive, window, grid)
    expected = by_steps(loop, drive, steps_of(window, grid)[0], grid)
    assert motion.waves == pytest.approx(expected, rel=1e-10, abs=1e-10 * np.abs(expected).max())


def test_a_belt_that_slips_and_sticks_within_a_block_goes_as_step_by_step(monkeypatch: pytest.MonkeyPatch) -> None:
    cases = [drawn(seed, grip=True) for seed in range(30)]
    blocks = [strand.march(*case) for case in cases]
    monkeypatch.setattr(strand_drum.Drum, "_stuck", lambda *_: 0)
    steps = [strand.march(*case) for case in cases]
    assert 5 < sum(one.slipped for one in steps) < 25
    for one, other in zip(blocks, steps, strict=True):
        assert one.slipped == other.slipped
        scale = np.abs(other.waves).max() + np.abs(other.run_on).max()
        assert one.waves == pytest.approx(other.waves, rel=0, abs=1e-11 * scale)
        assert one.drum_speed == pytest.approx(other.drum_speed, rel=1e-10, abs=1e-12)


def meetings(
    part: Strand, waves: np.ndarray, cells: int, steps: int, share: float, step: float
) -> list[tuple[float, float, int]]:
    """Tension, time and half cell from the start of every place at which a sample of either wave meets one of the
    other, and of all nodes at the end of the window."""
    p, n = waves
    seen = []
    for j in range(2 * cells + 1):
        static = part.static(np.array([j / (2 * cells)]))[0]
        count = steps + 1 - j % 2 - (share < 0.5 and j % 2)
        tension = static + (p[(j + 1) // 2 :][:count] + n[cells - j // 2 :][:count]) / 2
        if not j % 2:
            if len(tension) < 3:
                tension[-1] = tension[-2] + share * (tension[-1] - tension[-2])
            else:
                a, b, c = tension[-3:]
                tension[-1] = b + share * (c - a) / 2 + share**2 * (c - 2 * b + a) / 2
        seen += [(value, (i + j % 2 / 2) * step, j) for i, value in enumerate(tension)]
    return seen


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("grip", [False, True])
def test_extremes_are_those_of_all_pairs(seed: int, grip: bool) -> None:
    """Every place at every time that a sample of either wave meets one of the other, in a table."""
    loop, drive, window, grid = drawn(seed, grip)
    motion = strand.march(loop, drive, window, grid)
    steps, share = steps_of(window, grid)
    for part, cells, pair, top, bottom, ahead in (
        (loop.carry, grid.carry, motion.waves[:2], motion.carry_max, motion.carry_min, loop.back.length),
        (loop.back, grid.back, motion.waves[2:], motion.back_max, motion.back_min, 0.0),
    ):
        seen = meetings(part, np.concatenate([np.zeros((2, cells)), pair], axis=1), cells, steps, share, grid.step)
        values = np.array([one[0] for one in seen])
        rounding = 1e-12 * np.abs(values).max()
        for found, best in ((top, values.max()), (bottom, values.min())):
            assert found.value == pytest.approx(best, rel=0, abs=rounding)
            near = [one for one in seen if abs(one[0] - best) <= rounding]
            place = (found.position - ahead) / part.length * 2 * cells
            assert any(abs(when - found.time) < 1e-9 * window + 1e-12 and abs(j - place) < 1e-6 for _, when, j in near)


@pytest.mark.parametrize("seed", range(40))
def test_extremes_of_waves_of_any_shape_are_those_of_all_pairs(seed: int) -> None:
    """Drawn without any order, on a strand whose static tension rises or falls as much as they do."""
    rng = np.random.default_rng(seed)
    cells, steps, share = int(rng.integers(1, 9)), int(rng.integers(1, 30)), float(rng.uniform(0.01, 1.0))
    part = Strand(100.0, 50.0, 1e7, *rng.uniform(-3.0, 3.0, 2))
    loop = Loop(part, part, 1.0, 0.0, fixed_length=True)
    delays = strand_delays.Delays(loop, Grid(0.01, cells, cells, 0.0), steps, share)
    waves = delays.carry if seed % 2 else delays.back
    waves[:, cells + 1 :] = rng.normal(size=(2, waves.shape[1] - cells - 1))
    seen = meetings(part, waves[:, : cells + steps + 1], cells, steps, share, 0.01)
    values = [one[0] for one in seen]
    for found, best in zip(delays.extremes(part, bool(seed % 2)), (max(values), min(values)), strict=True):
        assert found.value == pytest.approx(best, rel=0, abs=1e-12)
        place = found.position / part.length * 2 * cells
        near = [(when, j) for value, when, j in seen if abs(value - best) <= 1e-12]
        assert any(abs(when - found.time) < 1e-9 and abs(j - place) < 1e-6 for when, j in near)


def test_a_tension_that_rests_is_found_where_it_begins_to() -> None:
    even = Strand(100.0, 100.0, 1e8, 5e4, 5e4)
    loop = Loop(even, even, 0.0, 0.0, fixed_length=False)
    motion = strand.march(loop, Drive(force=lambda t: np.full_like(t, 1e4)), 0.15, Grid(1e-3, 100, 100, 0.0))
    assert motion.carry_max.value == pytest.approx(6e4, rel=1e-12)
    assert (motion.carry_max.position, motion.carry_max.time) == pytest.approx((100.0, 0.101)), "once it is at the tail"


def test_a_tension_that_rests_in_waves_that_grow_apart_is_found_where_it_begins_to() -> None:
    """As in a belt that is pulled ever faster: both waves grow, their sum at an end does not, but for rounding."""
    part = Strand(100.0, 50.0, 1e7, 0.0, 0.0)
    for cells in (3, 7, 10):
        loop = Loop(part, part, 1.0, 0.0, fixed_length=True)
        delays = strand_delays.Delays(loop, Grid(0.01, cells, cells, 0.0), 90, 1.0)
        waves = delays.carry
        waves[0, cells:] = 0.1 * np.arange(waves.shape[1] - cells)
        waves[1, cells:] = -waves[0, cells:]
        top, bottom = delays.extremes(part, True)
        assert (top.value, bottom.value) == pytest.approx((0.05 * cells, -0.05 * cells), rel=1e-12)
        assert (top.time, top.position) == pytest.approx((0.01 * cells, 100.0), rel=1e-12)
        assert (bottom.time, bottom.position) == pytest.approx((0.01 * cells, 0.0), rel=1e-12)


@pytest.mark.parametrize(("share", "meets"), [(0.498, False), (0.5, True), (0.502, True), (1.0, True)])
def test_waves_that_meet_half_a_step_before_the_last_sample_do_so_within_the_window_or_not(
    share: float, meets: bool
) -> None:
    part = Strand(100.0, 50.0, 1e7, 0.0, 0.0)
    loop = Loop(part, part, 1.0, 0.0, fixed_length=True)
    delays = strand_delays.Delays(loop, Grid(0.01, 4, 4, 0.0), 6, share)
    delays.back[0, 8] = delays.back[1, 7] = 1.0  # 4 + 5.5 steps after the strand was empty of both
    top = delays.extremes(part, False)[0]
    assert (top.value == 1.0) == meets
    if meets:
        assert (top.time, top.position) == pytest.approx((0.055, 62.5), rel=1e-12)


def test_what_a_corner_between_samples_adds_is_told() -> None:
    """A wave with a roof between two of them, 1 a step up and down: half a step, of which a tension has half."""
    part = Strand(100.0, 50.0, 1e7, 0.0, 0.0)
    delays = strand_delays.Delays(Loop(part, part, 1.0, 0.0, fixed_length=True), Grid(0.01, 4, 4, 0.0), 12, 1.0)
    for waves in (delays.back[0], delays.back[1]):
        delays.back[:] = 0.0
        waves[4:] = 20.0 - np.abs(np.arange(len(waves) - 4) - 6.5)
        top = delays.extremes(part, False)[0]
        assert top.value == pytest.approx(9.75, rel=1e-14)
        assert top.missed == pytest.approx(0.25, rel=1e-14)


def test_of_equal_tensions_one_at_an_end_is_told() -> None:
    """Both waves are 1 from a sample on: first in the middle of the strand, later at its ends."""
    part = Strand(100.0, 50.0, 1e7, 0.0, 0.0)
    delays = strand_delays.Delays(Loop(part, part, 1.0, 0.0, fixed_length=True), Grid(0.01, 4, 4, 0.0), 12, 1.0)
    delays.back[:, 8:] = 1.0
    top = delays.extremes(part, False)[0]
    assert top.value == 1.0
    assert top.position in (0.0, 100.0)
    assert top.time == pytest.approx(0.08, rel=1e-12)


@pytest.mark.parametrize("seed", range(8))
def test_extremes_of_waves_that_cancel_a_steep_static_tension(seed: int) -> None:
    """All places are nearly alike: which is the highest, or the lowest, is told by what the waves have beside."""
    rng = np.random.default_rng(seed)
    cells, steps = 10, 40
    rise, sign = rng.choice([-1e3, 1e3]), 1 if seed % 2 else -1
    part = Strand(100.0, 50.0, 1e7, 500.0, 500.0 + rise)
    delays = strand_delays.Delays(
        Loop(part, part, 1.0, 0.0, fixed_length=True), Grid(0.01, cells, cells, 0.0), steps, 1.0
    )
    along, noise = rise / cells * np.arange(steps + 1), rng.normal(size=(2, steps + 1))
    p, n = delays.carry[:, : cells + steps + 1]
    p[cells:], n[cells:] = sign * 2e4 - along + noise[0], sign * 2e4 + along + noise[1]
    u, v = np.meshgrid(np.arange(len(p)), np.arange(len(p)), indexing="ij")
    meet = (np.abs(u - v) <= cells) & (u + v >= cells) & (u + v - cells <= 2 * steps)
    tension = np.where(meet, 500.0 + rise * (u - v + cells) / (2 * cells) + (p[:, None] + n) / 2, -sign * np.inf)
    found = delays.extremes(part, True)[0 if sign > 0 else 1]
    assert found.value == pytest.approx(sign * (sign * tension).max(), rel=1e-12)


@pytest.mark.parametrize(("cells", "steps"), [(7, 9), (7, 10), (8, 9), (8, 10)])
@pytest.mark.parametrize("rise", [0.0, 40.0])
def test_what_rests_is_largest_and_smallest_from_the_beginning(cells: int, steps: int, rise: float) -> None:
    part = Strand(100.0, 50.0, 1e7, 500.0, 500.0 + rise)
    delays = strand_delays.Delays(
        Loop(part, part, 1.0, 0.0, fixed_length=True), Grid(0.01, cells, cells, 0.0), steps, 1.0
    )
    largest, smallest = delays.extremes(part, True)
    assert (largest.value, smallest.value) == (500.0 + rise, 500.0)
    assert largest.time == smallest.time == 0.0
    if rise:
        assert (largest.position, smallest.position) == (100.0, 0.0)


@pytest.mark.parametrize("window", [0.4, 2.2, 6.13])
@pytest.mark.parametrize("seed", range(6))
def test_largest_and_smallest_tensions_along_the_belt(seed: int, window: float) -> None:
    """Both waves of each strand moved on from node to node, every sample; the last one by a parabola."""
    loop, drive, _, grid = drawn(seed, grip=False)
    window *= loop.carry.transit
    motion = strand.march(loop, drive, window, grid)
    steps, share = steps_of(window, grid)
    places, highest, lowest = strand_envelopes.envelopes(loop, motion, window)
    middle = int(np.flatnonzero(np.diff(places) == 0)[0]) + 1  # the tail, the end of one and the beginning of the other
    for part, cells, (enter_end, enter_start), ahead, shown in (
        (loop.back, grid.back, motion.waves[2:], 0.0, slice(0, middle)),
        (loop.carry, grid.carry, motion.waves[:2], loop.back.length, slice(middle, None)),
    ):
        along, tensions = np.zeros((2, cells + 1)), []
        for k in range(steps + 1):
            along[0, :-1], along[1, 1:] = along[0, 1:].copy(), along[1, :-1].copy()
            along[0, -1], along[1, 0] = enter_end[k], enter_start[k]
            tensions.append(part.static(np.arange(cells + 1) / cells) + along.sum(axis=0) / 2)
        tensions[-1] = at_end(np.array(tensions), share)
        nodes = (places[shown] - ahead) / part.length * cells
        whole = np.rint(nodes).astype(int)
        assert nodes == pytest.approx(whole, abs=1e-9 * cells)
        assert (whole[0], whole[-1]) == (0, cells), "its ends are among them"
        assert np.diff(whole).min() > 0
        assert np.diff(whole).max() <= cells // 50 + 1
        scale = 1e-12 * np.abs(tensions).max()
        assert highest[shown] == pytest.approx(np.max(tensions, axis=0)[whole], rel=0, abs=scale)
        assert lowest[shown] == pytest.approx(np.min(tensions, axis=0)[whole], rel=0, abs=scale)


@pytest.mark.parametrize("fixed", [False, True])
def test_a_belt_that_holds_is_never_looked_at_step_by_step(fixed: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Tensions in the ratio of 2 to 2.4, with a grip of 3: as many steps one by one as without any grip."""
    looked = []
    one_by_one = strand_drum.Drum._gripped
    monkeypatch.setattr(strand_drum.Drum, "_gripped", lambda *given: looked.append(1) or one_by_one(*given))
    carry, back = Strand(400.0, 120.0, 2e7, 3e4, 6e4), Strand(400.0, 40.0, 2e7, 3e4, 3e4)
    drive = Drive(force=lambda t: np.full_like(t, 5e3))
    for exponent, steps in ((np.log(3.0), 0), (np.log(2.05), 1)):
        loop = Loop(carry, back, 2e4, 0.0, fixed, Grip(exponent, 12.0))
        motion = strand.march(loop, drive, 0.5, match(carry.transit, back.transit, 40, 1e-3))
        assert motion.slipped == bool(steps)
        assert (len(looked) > 0) == bool(steps)


class TestPanels:
    @pytest.mark.parametrize("x", [1e-9, 1e-3, 0.7, 30.0, 1e3, 1e12, np.inf])
    @pytest.mark.parametrize("panel", [1, 4, 12])
    def test_weights_are_exact_for_polynomials(self, x: float, panel: int) -> None:
        """Of (s/n)^m, m to n: y' = x (g - y) over whole panels, against the integral by parts or its series."""
        weights, nodes = exponential_step.panel_weights(x, panel), np.arange(panel + 1) / panel
        for m in range(panel + 1):
            for i in (1, panel):
                end = i / panel
                slow = x * panel
                if slow < 1e-5:
                    expected = slow * end ** (m + 1) / (m + 1) - slow**2 * end ** (m + 2) / ((m + 1) * (m + 2))
                elif slow > 10 * panel:
                    expected, term = 0.0, end**m
                    for k in range(m + 1):
                        expected += term
                        term *= -(m - k) / (slow * end) if np.isfinite(slow) else 0.0
                    if m == 0:
                        expected -= np.exp(-slow * end)
                else:
                    at, shares = gauss(60)
                    expected = float(np.sum(shares * end * slow * np.exp(-slow * end * (1 - at)) * (at * end) ** m))
                assert weights[i - 1] @ nodes**m == pytest.approx(expected, rel=1e-9, abs=1e-12)

    @pytest.mark.parametrize(("panel", "order"), [(2, 3.5), (4, 5.5), (6, 7.0)])
    def test_order_through_every_echo(self, panel: int, order: float) -> None:
        carry, back = Strand(1000.0, 245.0, 138e6, 5e5, 5e5), Strand(1000.0, 0.16 * 245.0, 138e6, 5e5, 5e5)
        loop = Loop(carry, back, 45_120.0, 0.0, fixed_length=False)
        errors = []
        for cells in (10, 20):
            grid = panelled(match(carry.transit, back.transit, cells, 1e-12, at_most=cells), panel)
            motion = strand.march(loop, Drive(force=lambda t: np.full_like(t, 6e4)), 9.0, grid)
            exact = echoes.run_on(6e4, loop.impedances, 45_120.0, (carry.transit, back.transit), motion.times)
            errors.append(float(np.abs(motion.run_on - 5e5 - exact)[:-1].max()))
        assert np.log2(errors[0] / errors[1]) > order

    @pytest.mark.parametrize("fixed", [False, True])
    @pytest.mark.parametrize("longer", ["carry", "back"])
    def test_masses_at_both_ends_move_as_by_small_steps(self, longer: str, fixed: bool) -> None:
        """Panels of four steps against one step after the other, twenty times as short."""
        carry, back = Strand(500.0, 80.0, 2e7, 5e4, 5e4), Strand(500.0, 20.0, 2e7, 5e4, 5e4)
        if longer == "back":
            carry, back = back, carry
        loop = Loop(carry, back, 9e3, 4e3, fixed_length=fixed)
        drive = Drive(force=lambda t: 3e4 * np.sin(2.0 * t))
        grid = panelled(match(carry.transit, back.transit, 8, 1e-12, at_most=16), 4)
        motion = strand.march(loop, drive, 5.0, grid)
        fine = replace(grid, step=grid.step / 20, carry=20 * grid.carry, back=20 * grid.back, panel=1)
        steps = len(motion.times) - 1
        expected = by_steps(loop, drive, 20 * steps, fine)[:, ::20]
        assert motion.waves == pytest.approx(expected, rel=0, abs=2e-4 * np.abs(expected).max())

    def test_a_history_between_its_samples(self) -> None:
        when = np.linspace(0.0, 1.3, 77)
        grid = Grid(0.02, 70, 70, 0.0, 7)
        samples = np.sin(3 * np.arange(71) * grid.step)
        assert panel_interpolation.between(samples, grid, when) == pytest.approx(np.sin(3 * when), abs=1e-11)


@pytest.mark.parametrize("seed", range(40))
def test_the_best_pair_is_that_of_all(seed: int) -> None:
    """Of numbers without any order; those at the beginning stand for a strand at rest, where every pair is one."""
    rng = np.random.default_rng(seed)
    cells, last = int(rng.integers(1, 12)), int(rng.integers(1, 30))
    one, other = rng.normal(size=(2, 2 * cells + last + 3))
    found = strand_delays.best_pair(one, other, cells, last)
    u, v = np.meshgrid(np.arange(len(one)), np.arange(len(other)), indexing="ij")
    meet = (np.abs(u - v) <= cells) & (u + v >= cells) & (u + v - cells <= last)
    assert meet[found]
    if seed % 2:  # the best of the pairs after rest
        one[: cells + 1] = other[: cells + 1] = -9.0
        found = strand_delays.best_pair(one, other, cells, last)
        meet &= (u > cells) | (v > cells)
        both = np.where(meet, one[:, None] + other, -np.inf)
        if both.max() > -9.0:
            assert one[found[0]] + other[found[1]] == both.max()


@pytest.mark.parametrize("panel", [2, 3, 7])
def test_a_history_ends_with_its_last_sample(panel: int) -> None:
    samples = np.arange(6 * panel + 1.0) ** 2
    end = 3.0 * panel
    when = np.array([0.0, 3.5, 5.0, end - 0.25, end])
    assert panel_interpolation.between(samples, Grid(0.5, 6 * panel, 6 * panel, 0.0, panel), when) == pytest.approx(
        (2 * when) ** 2, rel=1e-12, abs=1e-10
    )


def test_a_history_of_single_steps_is_straight_between_them() -> None:
    found = panel_interpolation.between(
        np.array([1.0, 5.0, 2.0]), Grid(0.5, 2, 2, 0.0), np.array([0.0, 0.25, 0.75, 1.0])
    )
    assert found == pytest.approx([1.0, 3.0, 3.5, 2.0], rel=1e-14)


@pytest.mark.parametrize("decay", [0.0, 0.3, 0.97, 1.0])
@pytest.mark.parametrize("count", [1, 31, 32, 33, 127, 128, 129, 600, 5000])
def test_what_fades_is_advanced_at_once_as_step_by_step(decay: float, count: int) -> None:
    given = np.random.default_rng(count).normal(size=count)
    value, expected = 3.0, []
    for one in given.tolist():
        value = decay * value + one
        expected.append(value)
    found = exponential_step.Fading(decay).run(3.0, given)
    assert found == pytest.approx(np.array(expected), rel=1e-12, abs=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize("began", [0, 3, 9])
def test_a_tension_that_rests_does_so_from_its_first_sample_on(began: int) -> None:
    """Both waves are 1 from a sample on. Up to the last half step the first pair at the place counts; beyond it is
    what was read at the end of the window, between two samples, which has no pair."""
    cells, steps = 4, 20
    delays = strand_delays.Delays.__new__(strand_delays.Delays)
    delays.steps = steps
    wave = np.where(np.arange(cells + steps + 1) < cells + began, 0.0, 1.0)
    last = 2 * steps - 2
    for ahead in (-2, 0, 2):  # half cells from the middle
        for halves, first in ((last - 2, True), (last, True), (last + 2, False)):
            u, v = (halves + cells + ahead) // 2, (halves + cells - ahead) // 2
            found = delays._first(wave, wave, (u, v), last, 1e-15)
            back = min(u, v) - (cells + began) if first else 0
            assert found == (u - back, v - back)
