"""Checks of the links: torque and wear."""

import math
from collections.abc import Iterator

from ptmcalc.contract.check import Check, Sense, blames, no_needs, no_repair
from ptmcalc.contract.limits import fixed
from ptmcalc.machines.drivetrain.machine.judging import ALL, NO_LIMIT, AnyCheck, exactly
from ptmcalc.machines.drivetrain.machine.spec import Drivetrain, TrainScene

WORN_OUT, WORN_OUT_OPEN = 0.25, 0.40
"""Largest worn part of a tooth [1], lecture notes Kramatorsk 2007 (15 to 25 % and 40 %): in gearboxes and gear
couplings (`WORN_OUT`), and in open gears (`WORN_OUT_OPEN`). A smaller value requires an earlier renewal."""


def _torque_checks(spec: Drivetrain, scene: TrainScene) -> Iterator[AnyCheck]:
    """One for each link with a limit; where none has one, the first says so."""
    limited = {name: link.limit for name, link in spec.links.items() if link.limit is not None}
    if not limited and spec.links:
        first = next(iter(spec.links))
        yield TORQUE.of(first, NO_LIMIT, ("links", first, "limit"), needs=(("links", first, "limit"),))
    for name, limit in limited.items():
        path = ("links", name, "limit")
        yield TORQUE.of(name, exactly(limit), path, repair=path)


TORQUE: AnyCheck = Check(
    code="DRV101",
    hazard=True,
    title="peak link torque",
    question="Is the peak torque or force of every rated link within its limit?",
    failure="link is overloaded",
    scenes=ALL,
    loads=("torque_peak",),
    sense=Sense.AT_MOST,
    limit=fixed(
        math.inf,
        meaning="Permissible torque of a link, given in the file",
        valid="each link that has a `limit`",
        source="the manufacturer's data",
    ),
    needs=no_needs,
    blame=blames("links"),
    repair=no_repair,
    each=_torque_checks,
    what="The peak torque (or force) of every link with a `limit` is at most this limit.",
    why="A coupling, shaft or rope breaks at its peak load, not at its mean load.",
    formula="max |T(t)| <= T_limit",
    source="the manufacturer's limit of the part",
)


def _wear_checks(spec: Drivetrain, scene: TrainScene) -> Iterator[AnyCheck]:
    for name, link in spec.links.items():
        if link.clearance is not None and link.clearance.wear:
            most = WORN_OUT_OPEN if link.clearance.kind == "open_gear" else WORN_OUT
            path = ("links", name, "clearance", "wear")
            yield WEAR.of(name, exactly(most), path, repair=path)


WEAR: AnyCheck = Check(
    code="DRV108",
    title="gear tooth wear",
    question="Is the tooth wear within the permissible share of the tooth thickness?",
    failure="gear teeth are worn beyond the limit",
    scenes=ALL,
    loads=("wear_share",),
    sense=Sense.AT_MOST,
    limit=fixed(
        WORN_OUT,
        meaning="Permissible tooth wear relative to the tooth thickness: 25 % in gearboxes and couplings, 40 % in open"
        " gears",
        valid="links with a backlash from a `clearance` with a module",
        source="lecture notes Kramatorsk 2007 (15 to 25 % and 40 % of the tooth thickness)",
    ),
    needs=no_needs,
    blame=blames("links"),
    repair=no_repair,
    each=_wear_checks,
    what="The wear of gear teeth is at most 25 % of their thickness, and at most 40 % for open gears.",
    why="A worn tooth has a lower strength. Its backlash multiplies the impact torque of every start.",
    formula="w/(pi m/2) <= 0.25 or 0.40",
    source="lecture notes Kramatorsk 2007",
)

CHECKS_OF_LINKS = (TORQUE, WEAR)
