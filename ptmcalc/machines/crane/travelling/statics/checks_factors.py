"""Checks of the factors of the standards with which the structure has been calculated."""

from collections.abc import Callable

from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, Sense, at, blames, needs, no_needs, no_repair, only
from ptmcalc.contract.limits import key
from ptmcalc.machines.crane.travelling.machine.judging import HITS, RUNNING, STEPS, OneCheck
from ptmcalc.machines.crane.travelling.machine.scenes import TravelScene
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.spec.scene import Scene


def _declared(name: str) -> Callable[[Travelling, TravelScene], bool]:
    return lambda spec, scene: getattr(spec.declared, name) is not None


def _factor(
    code: str,
    name: str,
    what: str,
    formula: str,
    scenes: frozenset[type[Scene]] = RUNNING,
    sense: Sense = Sense.AT_MOST,
    needs: Callable[[Travelling, TravelScene], tuple[KeyPath, ...]] = no_needs,
) -> OneCheck:
    """The check of one declared factor."""
    falls = sense is Sense.AT_LEAST
    repair: Callable[[Travelling, TravelScene], KeyPath] = at("declared", name) if name != "phi3" else no_repair
    return only(_declared(name))(
        Check(
            code=code,
            title=f"dynamic factor {name}",
            question=f"Is {name} covered by the declared value{', i.e. not below it' if falls else ''}?",
            failure=f"{name} {'falls below' if falls else 'exceeds'} the declared value",
            scenes=scenes,
            loads=(name,),
            sense=sense,
            limit=key(
                f"declared.{name}",
                meaning=f"The {name} with which the structure has been designed",
                valid="any crane",
                error="none: a number of the file",
            ),
            needs=needs,
            blame=blames("declared", name),
            repair=repair,
            what=what,
            why="The proof of the structure is valid only for the factors it is based on.",
            formula=formula,
            source="EN 13001-2, ISO 8686-1; numbers as open design codes quote them",
        )
    )


_HOISTING = needs(("class", "hoisting"), ("suspension", "hoist_speed"))

FACTORS: tuple[OneCheck, ...] = (
    _factor(
        "CRN180",
        "phi1",
        "phi1, the factor of the standard on the crane weight while a load is lifted, is at most the declared value.",
        "phi_1 = 1 + a,   a <= 0.1",
    ),
    _factor(
        "CRN181",
        "phi2",
        "phi2, the factor of lifting a load off the ground, is at most the declared value. It depends on hoisting"
        " class, drive class and hoisting speed.",
        "phi_2 = phi_2,min + beta_2 v_h",
        needs=_HOISTING,
    ),
    _factor(
        "CRN182",
        "phi3",
        "phi3, the factor of the sudden release of a part of the load, is at least the declared value. The factor"
        " describes a relief or an upward force.",
        "phi_3 = 1 - dm/m (1 + beta_3)",
        sense=Sense.AT_LEAST,
    ),
    _factor(
        "CRN183",
        "phi4",
        "phi4, the factor of travelling over the largest step and gap of the rail, is at most the declared value. It is"
        " computed from the complete response of the crane.",
        "phi_4 = 1 + (pi/2)^2 v^2/(g r) max u",
        scenes=STEPS,
    ),
    _factor(
        "CRN184",
        "phi5",
        "phi5, the factor on changes of the drive forces, is at most the declared value. It depends on the control and"
        " the backlash of the drive.",
        "phi_5 = 1 to 1.5 smooth, 1.5 to 2 sudden, 3 with considerable backlash",
    ),
    _factor(
        "CRN185",
        "phi6",
        "phi6, the factor on the load of the dynamic test, is at most the declared value.",
        "phi_6 = (1 + phi_2)/2",
        needs=_HOISTING,
    ),
    _factor(
        "CRN186",
        "phi7",
        "phi7, the factor on buffer forces, is at most the declared value. It depends on the buffer curve shape.",
        "phi_7 = 1.25 + 0.7 (xi - 0.5), at least 1.25",
        scenes=HITS,
    ),
)
