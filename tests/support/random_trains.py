"""Random trains of two to five inertias: chains of springs with gaps, gears with losses, clutches, with brakes and
drives on them. Frequencies lie between 3 and 100 rad/s and torques near what brakes hold, so that much happens."""

import numpy as np

from support.hybrid import Brake, Course, Gear, Link, Machine, Torque

LAWS = ("linear", "kelvin", "no_pull", "clamped", "hunt_crossley")


def machine(seed: int, curves: bool = False, most_bodies: int = 5) -> Machine:
    """A train of its own for every seed; `curves` lets the law of Hunt and Crossley in."""
    random = np.random.default_rng(seed)
    count = int(random.integers(2, most_bodies + 1))
    inertias = 10 ** random.uniform(-0.5, 1.0, count)
    links: list[Link] = []
    gears: list[Gear] = []
    brakes: list[Brake] = []
    ratio = np.ones(count)
    speeds = np.zeros(count)
    for body in range(1, count):
        kind = random.choice(["spring", "spring", "gear", "clutch", "both"])
        if kind == "gear":
            ratio_here = float(random.choice([-1, 1]) * 10 ** random.uniform(-0.3, 0.7))
            forward = float(random.choice([1.0, random.uniform(0.6, 0.98)]))
            reverse = 2 - 1 / forward
            gears.append(Gear(body - 1, body, ratio_here, forward, reverse))
            ratio[body] = ratio[body - 1] / ratio_here
        if kind in ("spring", "both"):
            links.append(_link(random, body - 1, body, float(inertias[body - 1 : body + 1].min()), curves))
        if kind in ("clutch", "both"):
            brakes.append(_brake(random, body - 1, body))
    if random.random() < 0.3:
        links.append(_link(random, count - 1, None, float(inertias[-1]), curves))
    brakes += [_brake(random, body, None) for body in range(count) if random.random() < 0.4]
    geared = {gear.outer for gear in gears}
    for body in range(count):
        if body in geared:
            speeds[body] = speeds[body - 1] * ratio[body] / ratio[body - 1]
        elif random.random() < 0.4:
            speeds[body] = random.normal()
    torques = [_torque(random, body) for body in range(count) if body == 0 or random.random() < 0.3]
    return Machine(
        tuple(map(float, inertias)),
        (0.0,) * count,
        tuple(map(float, speeds)),
        tuple(links),
        tuple(gears),
        tuple(brakes),
        tuple(torques),
    )


def _link(random: np.random.Generator, first: int, second: int | None, inertia: float, curves: bool) -> Link:
    law = str(random.choice(LAWS[: 5 if curves else 4]))
    frequency = 10 ** random.uniform(0.5, 2.0)
    stiffness = inertia * frequency**2
    damping = 2 * random.choice([0.0, 0.02, 0.1, 0.7, 2.0]) * inertia * frequency
    play = 0.0 if law == "linear" else float(random.choice([0.0, 0.02, 0.3]))
    side = 0 if law == "linear" else int(random.choice([0, 0, 1, -1]))
    if law == "hunt_crossley":
        return Link(
            first, second, float(stiffness), 0.0, play, law, side,
            dissipation=float(random.choice([0.0, 0.05, 0.4])), exponent=float(random.choice([1.0, 1.5])),
        )  # fmt: skip
    return Link(first, second, float(stiffness), float(damping), play, law, side)


def _brake(random: np.random.Generator, first: int, second: int | None) -> Brake:
    size = float(10 ** random.uniform(-0.5, 1.0))
    course = Course.constant(size)
    if random.random() < 0.3:  # applied after a delay, with a rise
        delay, rise = random.uniform(0.2, 1.0, 2)
        course = Course(((0.0, 0.2 * size, 0.0), (delay, 0.2 * size, 0.8 * size / rise), (delay + rise, size, 0.0)))
    return Brake(first, second, course, float(random.choice([1.0, 1.3])))


def _torque(random: np.random.Generator, body: int) -> Torque:
    size = float(random.choice([-1, 1]) * 10 ** random.uniform(0.0, 1.2))
    kind = random.integers(4)
    if kind == 0:
        return Torque(body, Course.constant(size))
    if kind == 1:
        wave = (size, float(10 ** random.uniform(0.0, 1.2)), float(random.uniform(0, 6)))
        return Torque(body, Course(((0.0, 0.3 * size, 0.0),), (wave,)))
    if kind == 2:
        at = float(random.uniform(0.3, 1.5))
        return Torque(body, Course(((0.0, size, 0.0), (at, -0.5 * size, 0.0))))
    at = float(random.uniform(0.5, 1.5))
    return Torque(body, Course(((0.0, 0.0, size / at), (at, size, 0.0))))
