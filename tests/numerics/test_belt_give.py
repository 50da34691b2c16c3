"""Sag and damping in the cells: against modal series, a slow pull in closed form, and finite elements with dashpots."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from support.belt_scenes import Brake, Drive, Rig
from support.machines import spec_of
from support.sagging_scenes import Swing, swing

from ptmcalc.base.errors import NumericsError
from ptmcalc.machines.conveyor.machine.motion import moving
from ptmcalc.machines.conveyor.waves.cells import set_up
from ptmcalc.numerics.belt.course import Course, Reach, lay_out
from ptmcalc.numerics.belt.give import Give, Rubber
from ptmcalc.numerics.belt.march import Drawn, march, place_at
from ptmcalc.numerics.belt.station import Drum, Station, TakeUp

RHO, EA, LENGTH, ACCELERATION = 100.0, 1e8, 1000.0, 0.3
SPEED = math.sqrt(EA / RHO)
CONTOUR = 2 * LENGTH / SPEED
TAKEUP = 1e5


# -- damping against its modes ----------------------------------------------------------------------------------------


def pulled(rubber: Rubber, cells: int, window: float) -> Drawn:
    """A uniform loop whose drum is accelerated evenly from rest."""
    reach = Reach.even(LENGTH, RHO, EA * (1 + rubber.stiffer))
    course = lay_out((reach, reach), 1, cells)
    head = Station(place_at(course, 0, 0.0), [Drum("head", 0.0)], TakeUp(TAKEUP), lambda time: ACCELERATION * time)
    tail = Station(place_at(course, course.tail, 0.0), [Drum("tail", 0.0)])
    tension = np.full(course.cells, TAKEUP)
    return march(course, head, tail, tension, 0.0, window, give=Give(course, rubber, EA))


def series(modulus: tuple[np.ndarray, np.ndarray], times: np.ndarray, modes: int) -> np.ndarray:
    """S/(rho L a) at the drum for a modulus EA p(s)/q(s): every mode answers w^2 p/(s (s^2 q + w^2 p))."""
    p, q = modulus
    found, left = np.zeros_like(times), 1.0
    for n in range(1, modes + 1):
        w = (2 * n - 1) * math.pi * SPEED / (4 * LENGTH)
        below = np.polyadd(np.polymul([1.0, 0.0, 0.0], q), w * w * p)
        slope = np.polyder(below)
        answer = np.ones_like(times)  # the residue at s = 0
        for root in np.roots(below):
            residue = w * w * np.polyval(p, root) / (root * np.polyval(slope, root))
            answer += (residue * np.exp(root * times)).real
        weight = 8 / ((2 * n - 1) ** 2 * math.pi**2)
        found += weight * answer
        left -= weight
    return found + left  # the quickest modes stand still at once


RETARDATION = 0.06
STIFFENING, RELAXATION = 0.3, 0.2
MODULI = {
    "kelvin_voigt": (np.array([RETARDATION, 1.0]), np.array([1.0])),
    "zener": (np.array([(1 + STIFFENING) * RELAXATION, 1.0]), np.array([RELAXATION, 1.0])),
}


def rubber(model: str, cells: int) -> Rubber:
    return Rubber.voigt(RETARDATION, CONTOUR, cells) if model == "kelvin_voigt" else Rubber(STIFFENING, RELAXATION)


def errors(model: str, counts: tuple[int, ...]) -> list[tuple[float, float, float]]:
    """Errors of the run-on tension over rho L a on some grids: root mean square, of the peak; and the energy's."""
    found = []
    for cells in counts:
        drawn = pulled(rubber(model, cells), cells, 5 * CONTOUR)
        mine = (np.array([seen.tensions[0] for seen in drawn.head]) - TAKEUP) / (RHO * 2 * LENGTH * ACCELERATION)
        exact = series(MODULI[model], drawn.times, 4000)
        apart = math.sqrt(float(np.mean((mine - exact) ** 2)))
        found.append((apart, abs(float(mine.max()) - float(exact.max())), drawn.energy_residual))
    return found


def test_a_kelvin_voigt_belt_swings_as_its_modes_do() -> None:
    coarse, fine = errors("kelvin_voigt", (80, 320))
    assert fine[0] < 5e-4
    assert fine[1] < 4e-4
    assert fine[0] < 0.4 * coarse[0]
    assert max(coarse[2], fine[2]) < 1e-12


def test_a_zener_belt_swings_as_its_modes_do() -> None:
    coarse, fine = errors("zener", (80, 320))
    assert fine[0] < 5e-6
    assert fine[0] < 0.1 * coarse[0]
    assert max(coarse[2], fine[2]) < 1e-12


def test_the_published_peak_of_a_damped_start() -> None:
    """BW-09: 1.8057 of the quasi-static tension at 2.4 % damping of the slowest wave, 2 without."""
    slowest = math.pi * SPEED / (4 * LENGTH)
    drawn = pulled(Rubber.voigt(2 * 0.024 / slowest, CONTOUR, 240), 240, 1.2 * 2 * CONTOUR)
    peak = max(seen.tensions[0] for seen in drawn.head) - TAKEUP
    assert peak / (RHO * 2 * LENGTH * ACCELERATION) == pytest.approx(1.8057, rel=2e-3)


# -- sag ------------------------------------------------------------------------------------------------------------


def nodes(span: float) -> tuple[Course, Give]:
    course = lay_out((replace(Reach.even(100.0, 50.0, 1e7), span=span),) * 2, 1, 20)
    return course, Give(course, None, 1e7)


def test_spans_pulled_slowly_give_what_their_parabola_does() -> None:
    """Strain (w l)^2/24 (1/S0^2 - 1/S1^2), summed over the belt, whatever the step."""
    span, first, last = 900.0, 5e3, 50e3
    course, give = nodes(span)
    give.begin(np.full(course.cells - 1, first))
    quiet = np.zeros(course.cells - 1)
    drawn = 0.0
    before = give.length
    for tension in np.linspace(first, last, 2000):
        waves = np.full(course.cells - 1, tension)
        before_it, behind_it = give.pass_on(waves, waves, quiet, quiet)
        drawn += float((behind_it - before_it).sum()) * course.step
    given = span**2 / 24 * (1 / first**2 - 1 / last**2) * 200.0
    assert drawn == pytest.approx(given, rel=2e-3)
    assert drawn == pytest.approx(give.length - before, rel=1e-9)


def test_spans_that_hang_slack_at_the_start_are_refused() -> None:
    course, give = nodes(900.0)
    with pytest.raises(NumericsError, match="slack"):
        give.begin(np.full(course.cells - 1, -1.0))


def test_a_front_stretches_spans_taut_within_a_step() -> None:
    """From 2 kN to 400 kN at once, and back: no step makes energy, and none fails."""
    course, give = nodes(900.0)
    give.begin(np.full(course.cells - 1, 2e3))
    quiet = np.zeros(course.cells - 1)
    for tension in (4e5, 4e5, 4e5, 2e3, 2e3, 2e3, -1e4, 5e3):
        stored, lost = give.stored, give.lost
        before, behind = give.pass_on(*(np.full(course.cells - 1, tension),) * 2, quiet, quiet)
        assert np.isfinite(before).all()
        assert np.isfinite(behind).all()
        assert give.lost >= lost - 1e-9 * abs(stored)


# -- both, with friction, against finite elements ----------------------------------------------------------------------

RIG = Rig(
    sections=((500.0, 10.0),),
    stiffness=30e6,
    speed=3.0,
    drives={"head": Drive(torque=3000.0)},
    brakes=(Brake(4e3, 0.2, 0.5),),
)
PITCHES = (1.2, 3.0)
WINDOW = 6.0
DAMPING = 0.03
SCENES = {
    "stop, gravity": (replace(RIG, tension=35e3), {"type": "emergency_stop"}),
    "stop, rigid": (replace(RIG, tension=33e3, rigid=True), {"type": "emergency_stop"}),
    "start of a relaxed belt": (replace(RIG, tension=14e3), {"type": "start", "belt": "relaxed"}),
    "start, rigid": (replace(RIG, tension=50e3, rigid=True), {"type": "start", "belt": "relaxed"}),
}


def cells_of(rig: Rig, scene: dict[str, object], damping: float, cells: int, sags: bool) -> Drawn:
    data = rig.data(scene)
    data["idlers"]["carry"]["pitch"], data["idlers"]["return"]["pitch"] = (f"{pitch} m" for pitch in PITCHES)
    carried = {"coulomb_idlers", "tail_mass", "tail_jump"} | ({"sag"} if sags else set())
    if damping:
        data["belt"]["damping"] = {"model": "kelvin_voigt", "time": f"{damping} s"}
        carried.add("belt_damping")
    spec = spec_of(data)
    (made,) = spec.all_scenes
    case = replace(moving(spec, made), window=WINDOW)
    ready = set_up(case, frozenset(carried), cells)
    return march(ready.course, ready.head, ready.tail, ready.tension, case.speed, WINDOW, give=ready.give)


def pull_of(rig: Rig, scene: dict[str, object]) -> Callable[[float], float] | None:
    force = rig.drives["head"].force
    return (lambda time: force) if scene["type"] == "start" else None


@pytest.mark.parametrize("name", SCENES)
def test_sag_damping_and_friction_agree_with_finite_elements(name: str) -> None:
    rig, scene = SCENES[name]
    theirs = swing(
        rig, PITCHES, WINDOW, 240, sags=True, force=pull_of(rig, scene), relaxed="belt" in scene, retardation=DAMPING
    )
    drawn = cells_of(rig, scene, DAMPING, 240, sags=True)
    mine = Swing(
        max(drawn.back_max.value, drawn.carry_max.value),
        min(drawn.back_min.value, drawn.carry_min.value),
        max(seen.tensions[0] for seen in drawn.head),
    )
    assert mine.apart(theirs) < 0.015 * theirs.highest
    straight = cells_of(rig, scene, DAMPING, 240, sags=False)
    assert abs(min(straight.back_min.value, straight.carry_min.value) - theirs.lowest) > 2 * mine.apart(theirs)
    assert drawn.energy_residual < 1e-10


@pytest.mark.parametrize("name", ["stop, rigid", "start, rigid"])
def test_a_closed_loop_that_sags_and_damps_keeps_its_length(name: str) -> None:
    drawn = cells_of(*SCENES[name], DAMPING, 120, sags=True)
    assert abs(drawn.stretched) < 1e-10 * 1000.0
