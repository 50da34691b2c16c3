"""Checks of wheel loads and stability."""

from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, at, blames, needs, no_needs
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.crane.travelling.machine.judging import (
    MOVES,
    RUNNING,
    OneCheck,
)
from ptmcalc.machines.crane.travelling.machine.scenes import (
    Storm,
)

WHEEL: OneCheck = Check(
    code="CRN157",
    hazard=True,
    title="maximum wheel load",
    question="Is the largest wheel load within the rating of wheel and rail?",
    failure="wheel load exceeds its rating",
    scenes=MOVES | RUNNING,
    loads=("wheel_load_max",),
    sense=Sense.AT_MOST,
    limit=key(
        "wheels.rating",
        meaning="Rated wheel load",
        valid="any wheel and rail",
        error="none: a limit of the file",
        source="the manufacturer of wheel or rail",
    ),
    needs=needs(("wheels", "rating")),
    blame=blames("wheels", "rating"),
    repair=at("wheels", "rating"),
    what="The load of every wheel is at most its rating. The trolley is in its worst position, and the crane starts or"
    " stops.",
    why="Wheel treads pit and rails roll out. The runway is designed for this load.",
    formula="N = sum G b_s/2 +- (m a h + H h_r + F_w h_w)/B",
    source="equilibrium of the crane",
)


LIFTS: OneCheck = Check(
    code="CRN158",
    hazard=True,
    title="minimum wheel load",
    question="Do all wheels stay in contact with the rail?",
    failure="wheel lifts off the rail",
    scenes=MOVES | RUNNING,
    loads=("wheel_load_min",),
    sense=Sense.AT_LEAST,
    limit=fixed(
        0.0,
        meaning="0: the wheel stays on its rail",
        valid="any crane",
        error="none: a wheel transmits no tension",
        source="equilibrium",
    ),
    needs=no_needs,
    blame=blames("wheels", "base"),
    repair=at("wheels", "base"),
    what="The load of every wheel is at least zero, so that every wheel stays on the rail. The trolley is in its worst"
    " position, and the crane starts or stops.",
    why="A wheel without contact does not drive, brake or guide. A high gantry on a short wheel base tips.",
    formula="N = sum G b_s/2 +- (m a h + H h_r + F_w h_w)/B >= 0",
    source="equilibrium of the crane",
)


TIPS: OneCheck = Check(
    code="CRN159",
    hazard=True,
    title="stability ratio",
    question="Do the stabilising moments exceed the tipping moments by the required ratio?",
    failure="stability ratio is too small",
    limit_state=LimitState("crane tips", 1),
    scenes=MOVES | RUNNING | {Storm},
    loads=("stability_reserve",),
    sense=Sense.AT_LEAST,
    limit=key(
        "checks.stability",
        meaning="1: the stabilising moment is at least the tipping moment, both with partial factors",
        valid="any crane",
        error="none: an equilibrium; the factors are those of the edition",
        source="EN 13001-2, FEM 1.001",
    ),
    needs=no_needs,
    blame=blames("wheels", "base"),
    repair=at("wheels", "base"),
    what="About each tipping edge of the wheels, the stabilising moment is at least the required multiple of the"
    " tipping moment. The partial factors of the edition (`class.stability`) apply: they increase loads, drive forces"
    " and wind, and reduce the stabilising weight.",
    why="Equal moments do not prove stability, because weights, loads and wind are not known with that accuracy.",
    formula="sum k_h G b / (sum k_o G b' + k_l (m a h + H h_r) + k_w F_w h_w) >= 1",
    source="equilibrium; EN 13001-2, ISO 8686-1; FEM 1.001",
)

CHECKS_OF_WHEELS: tuple[AnyCheck, ...] = (WHEEL, LIFTS, TIPS)
