"""Forces in the links of a train that moves steadily."""

from dataclasses import replace

import numpy as np

from ptmcalc.numerics.train.parts import LINEAR, RIGID, Grip, Guide, Mesh, Train
from ptmcalc.numerics.train.state import State
from ptmcalc.numerics.train.system import TrainSystem

_ROUNDS = 4


def link_forces(train: Train, held: int) -> list[float]:
    """Force in every link while the held body keeps its speed and everything turns with it without acceleration.

    The links' extensions y solve A_vy y + A_vv y' + A_vu u = 0, with losses in the meshes and friction by the
    direction of motion. At rest there is no direction: friction and losses are left out.

    **Error** exact for links that stay closed; a share of a load that links in parallel carry is by their stiffness.
    """
    moves = any(body.speed for body in train.bodies)
    springs = tuple(replace(one, law=LINEAR) for one in train.springs if one.law != RIGID)
    meshes = train.meshes if moves else tuple(Mesh(m.name, m.inner, m.outer, m.ratio) for m in train.meshes)
    grips = tuple(grip for grip in train.grips if moves and _always(grip))
    drives = tuple(drive for drive in train.drives if drive.gate.values == (1.0,))
    plain = Train(train.bodies, meshes, springs, grips, drives, (Guide("held", held),))
    system = TrainSystem(plain)
    state, z = system.start()
    count, own = system.groups.count, system.own
    places = [place for place in system.coordinates.places if place is not None]
    for _ in range(_ROUNDS if places else 0):
        held_state = system.react(state, 0.0, z, None).mode
        assert isinstance(held_state, State)
        state = held_state
        rate = system.motion(state).rate[count : 2 * count]
        known = rate[:, count:own] @ z[count:own] + rate[:, own:] @ z[own:]
        z[places] = -np.linalg.lstsq(rate[:, places], known, rcond=None)[0]
    found = iter(float(spring.stiffness * (of.x @ z)) for spring, of in zip(springs, system.stretches, strict=True))
    return [0.0 if spring.law == RIGID else next(found) for spring in train.springs]


def _always(grip: Grip) -> bool:
    """Whether friction acts from the start on, as that of a bearing does."""
    return grip.capacity.trigger is None and len(grip.capacity.times) == 1 and not grip.capacity.decay
