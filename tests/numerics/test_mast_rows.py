"""The equations of every state of a mast, against the statics of a bar and Newton's law for two lumps and a base.

The column has no mass but two lumps, so two modes are all there are, and every other point of it stands where the
lumps and the forces at these points ask for: w = F f with the flexibility of a clamped bar, a^2 (3 b - a)/(6 E I).
"""

import itertools
import math
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.linalg import eigh

from ptmcalc.numerics.mast.base import Base, Grip, Guide, Obstacle, Signal
from ptmcalc.numerics.mast.case import FREE, LOOSE, MOVED, TOUCH, Case, State
from ptmcalc.numerics.mast.modes import Mast
from ptmcalc.numerics.mast.parts import Column, Lump, Prop, Segment
from ptmcalc.numerics.mast.system import MastSystem
from ptmcalc.numerics.piecewise import JAMMED

ROLLS, BENDING, PROP = 40.0, 3e4, 2e4
LUMPS, MASSES, RATIOS = (1.2, 2.0), np.array([9.0, 5.0]), np.array([0.03, 0.08])
POINTS = (*LUMPS, 0.5, 1.5, 0.8, 1.8)
"""lumps, prop, guide, obstacle, one more that is read"""
GUIDE, STIFF, DAMPING, GAP, PLAY = 7e4, 9e4, 600.0, 0.05, 0.02
CLOCK, BREAK = 0.3, 0.5
PUSH, CAPACITIES, PATH = (70.0, -40.0), ((90.0, 25.0), (150.0, -60.0)), (1.7, 0.9)
"""what each signal is at the break, and its slope from there on"""
SPEEDS = (-0.5, 0.4)


def signal(value: float, slope: float) -> Signal:
    return Signal((0.0, BREAK), (33.0, value), (0.0, slope))


def now(value: float, slope: float) -> float:
    return value + slope * CLOCK


def bar() -> np.ndarray:
    """Stiffness of the column at its points, with the prop."""
    gives = np.empty((len(POINTS), len(POINTS)))
    for (i, one), (j, other) in itertools.product(enumerate(POINTS), repeat=2):
        near, far = sorted((one, other))
        gives[i, j] = near**2 * (3 * far - near) / (6 * BENDING)
    stiff = np.linalg.inv(gives)
    stiff[2, 2] += PROP
    return np.asarray(stiff)


@dataclass
class Told:
    """What a state means for the lumps and the base."""

    watched: dict[tuple[str, int], float]
    guards: list[float]
    pace: float
    lumps: np.ndarray
    energy: float


def reference(state: State, kind: str, x: float, v: float, w: np.ndarray, u: np.ndarray) -> Told:
    """x, v of the base; w, u of the lumps beside it. `kind` of the obstacle: "", "hard", "damped" or "rigid"."""
    stiff, lumps, others = bar(), slice(0, 2), slice(2, None)
    inner, across = stiff[others, others], stiff[others, lumps]
    rides = -np.linalg.solve(inner, across)  # how each other point goes with the lumps
    bare = kind in ("damped", "rigid")  # then no force of the obstacle bends the column between the lumps
    off = x - GAP
    springs, pressed = np.zeros(4), np.zeros(4)
    if state.guide:
        springs[1], pressed[1] = GUIDE, GUIDE * state.guide * PLAY
    if state.contact == TOUCH and not bare:
        springs[2], pressed[2] = STIFF, -STIFF * off
    rest = np.linalg.solve(inner + np.diag(springs), pressed - across @ w)
    guide = float(pressed[1] - springs[1] * rest[1])
    needs = stiff[lumps, lumps] @ w + across.T @ rest
    at, deep, fast = rides[2], off + float(rides[2] @ w if bare else rest[2]), v + float(rides[2] @ u)
    contact = 0.0
    if state.contact == TOUCH:
        contact = -STIFF * deep - (DAMPING * fast if kind == "damped" else 0.0)

    condensed = stiff[lumps, lumps] + across.T @ rides
    squares, p = eigh(condensed, np.diag(MASSES))
    damped = np.diag(MASSES) @ p @ np.diag(2 * RATIOS * np.sqrt(squares)) @ p.T @ np.diag(MASSES)
    held = state.base // 2 if state.base > 0 and state.base % 2 else None
    push = 0.0 if state.base == MOVED else now(*PUSH)
    grips = [0.0, 0.0]
    if state.base != MOVED:
        for j in range(2):
            if j != held:
                grips[j] = now(*CAPACITIES[j]) * (1 if state.base <= 2 * j else -1)

    # unknown: pace of the base, those of the lumps, what holds the base, the obstacle where the point stands still
    a, right = np.zeros((5, 5)), np.zeros(5)
    a[0, 0], a[0, 1:3], a[0, 3], right[0] = ROLLS + MASSES.sum(), MASSES, -1.0, push + sum(grips)
    a[1:3, 0], a[1:3, 1:3], right[1:3] = MASSES, np.diag(MASSES), -needs - damped @ u
    if bare or state.contact == JAMMED:
        a[1:3, 4] = -at
    a[0, 4] = -1.0
    if held is None and state.base != MOVED:
        a[3, 3] = 1.0
    else:
        a[3, 0], right[3] = 1.0, now(*PATH) if state.base == MOVED else 0.0
    if state.contact == JAMMED:
        a[4, 0], a[4, 1:3] = 1.0, at
    else:
        a[4, 4], right[4] = 1.0, contact
    pace, *lump, hold, contact = np.linalg.solve(a, right).tolist()
    paces = np.array(lump)

    root = contact * POINTS[4] + guide * POINTS[3] - PROP * POINTS[2] * rest[0]
    root -= float((MASSES * LUMPS) @ (pace + paces))
    watched = {
        ("way", 0): x, ("speed", 0): v, ("acceleration", 0): pace, ("moment", 0): root, ("contact", 0): -contact,
        ("guide", 0): guide, ("drive", 0): hold if state.base == MOVED else 0.0, ("push", 0): push,
        ("dash", 0): DAMPING * fast if kind == "damped" and state.contact == TOUCH else 0.0,
        ("dash_rate", 0): fast if kind == "damped" else 0.0,
    }  # fmt: skip
    watched |= {("deflection", i): float(one) for i, one in enumerate((*w, *rest))}
    watched |= {("grip", j): hold if j == held else grips[j] for j in range(2)}
    guards: list[float] = []
    if held is not None:
        capacity = now(*CAPACITIES[held])
        guards += [capacity - hold, capacity + hold]
    elif state.base != MOVED:
        guards += [v - SPEEDS[j] for j in (0, 1) if state.base == 2 * j + 2]
        guards += [SPEEDS[j] - v for j in (0, 1) if state.base == 2 * j]
    if kind:
        pushes = STIFF * deep + DAMPING * fast
        guards += {
            FREE: [-deep],
            TOUCH: [deep, pushes] if kind == "damped" else [deep],
            LOOSE: [deep, -pushes],
            JAMMED: [-contact],
        }[state.contact]
    guards += [-state.guide * guide / GUIDE] if state.guide else [PLAY - rest[1], PLAY + rest[1]]
    every = np.concatenate([w, rest])
    energy = ROLLS * v**2 / 2 + float(MASSES @ (v + u) ** 2) / 2 + float(every @ stiff @ every) / 2
    energy += GUIDE * (rest[1] - state.guide * PLAY) ** 2 / 2 if state.guide else 0.0
    energy += STIFF * deep**2 / 2 if state.contact == TOUCH else 0.0
    return Told(watched, guards, pace, paces, energy)


KINDS = {"": (FREE,), "hard": (FREE, TOUCH), "damped": (FREE, TOUCH, LOOSE), "rigid": (FREE, JAMMED)}


@pytest.mark.parametrize(("kind", "contact"), [(kind, one) for kind, known in KINDS.items() for one in known])
@pytest.mark.parametrize("base", [MOVED, 0, 1, 2, 3, 4])
@pytest.mark.parametrize("guide", [0, 1, -1])
def test_every_state_is_newtons_law_for_lumps_and_base(kind: str, contact: str, base: int, guide: int) -> None:
    column = Column(
        (Segment(2.0, BENDING),), tuple(Lump(*one) for one in zip(LUMPS, MASSES.tolist(), strict=True)),
        props=(Prop(POINTS[2], PROP),),
    )  # fmt: skip
    mast = Mast.of(column, 20)
    assert len(mast.frequencies) == 2
    obstacle = {
        "": None,
        "hard": Obstacle(POINTS[4], STIFF, GAP),
        "damped": Obstacle(POINTS[4], STIFF, GAP, DAMPING),
        "rigid": Obstacle(POINTS[4], math.inf, GAP),
    }[kind]
    moved = Base(
        ROLLS, 0.2, signal(*PUSH),
        tuple(Grip(f"{j}", signal(*CAPACITIES[j]), SPEEDS[j]) for j in range(2)),
        signal(*PATH) if base == MOVED else None,
    )  # fmt: skip
    system = MastSystem(Case(mast, RATIOS, moved, POINTS, obstacle, Guide(POINTS[3], GUIDE, PLAY)))
    state = State(base, contact, guide, 1)
    rng = np.random.default_rng(11)
    x, v, w, u = 0.07, 0.3, rng.normal(size=2) * 0.03, rng.normal(size=2)
    back = np.linalg.inv([mast.at(place) for place in LUMPS])
    z = np.concatenate([[x, v], back @ w, back @ u, [1.0, CLOCK]])
    told = reference(state, kind, x, v, w, u)

    motion = system.motion(state)
    rate = motion.rate @ z
    assert rate[:2] == pytest.approx([v, told.pace], rel=1e-9, abs=1e-12)
    assert rate[2:4] == pytest.approx(z[4:6], rel=1e-12)
    assert np.linalg.inv(back) @ rate[4:6] == pytest.approx(told.lumps, rel=1e-8)
    assert rate[6:].tolist() == [0.0, 1.0]
    seen = dict(zip(system.watched, motion.watch @ z, strict=True))
    for name, value in told.watched.items():
        assert seen.pop(name) == pytest.approx(value, rel=1e-8, abs=1e-9), name
    assert list(seen.values()) == pytest.approx(z[4:6], rel=1e-12)
    assert motion.guards @ z == pytest.approx(told.guards, rel=1e-8, abs=1e-9)
    assert system.energy(state, z) == pytest.approx(told.energy, rel=1e-9)
