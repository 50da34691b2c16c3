"""Checks of the rail."""

from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, Sense, at, blames, no_needs, only
from ptmcalc.contract.limits import fixed, key
from ptmcalc.machines.crane.stacking.machine.judging import OneCheck
from ptmcalc.machines.crane.stacking.machine.rack import RackStacker
from ptmcalc.machines.crane.stacking.machine.scenes import (
    RailScene,
    StackerScene,
)
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.rail.base import roll_of
from ptmcalc.machines.crane.stacking.rail.rolling import wave_share
from ptmcalc.spec.scene import Scene

ROLLS: frozenset[type[Scene]] = frozenset({RailScene})


def _rail_key(spec: Stacker, scene: StackerScene) -> KeyPath:
    """What takes most of the wheel's load off."""
    assert isinstance(spec, RackStacker)
    assert isinstance(scene, RailScene)
    roll = roll_of(spec, scene)
    keys: list[KeyPath] = [*([("rail", "step")] if roll.step else []), *([("rail", "gap")] if roll.gap else [])]
    less = {
        key: roll.acceleration / roll.gravity * down
        for key, (_, down) in zip(keys, roll.pulses(roll.frequency), strict=True)
    }
    if roll.wave_length:
        less["rail", "waviness", "height"] = wave_share(roll)
    return max(less, key=less.__getitem__)


CONTACT: OneCheck = Check(
    code="CRN293",
    hazard=True,
    title="wheel load ratio on uneven rail",
    question="Do the wheels keep contact on steps, gaps and waves of the rail?",
    failure="wheel leaves the uneven rail",
    scenes=ROLLS,
    loads=("rail_contact",),
    sense=Sense.AT_LEAST,
    limit=fixed(
        0.0,
        meaning="0: the wheel stays on its rail",
        valid="any wheel",
        error="none: a wheel transmits no tension",
        source="equilibrium",
    ),
    needs=no_needs,
    blame=lambda spec, scene, loads: _rail_key(spec, scene),
    repair=at("travel", "speed"),
    what="The wheel load stays at or above zero on steps, gaps and waves of the rail, so that the wheels keep contact.",
    why="A wheel that leaves the rail lands with an impact. The impact makes the mast oscillate.",
    formula="1 - (pi/2)^2 v^2/(g r) max(-u) >= 0,   1 - T (h/2) (2 pi v/lambda)^2/g >= 0",
    source="one vertical mode over a cosine step; `laws.rail`",
)


RESONANCE: OneCheck = only(lambda spec, scene: isinstance(spec, RackStacker) and spec.rail.waviness is not None)(
    Check(
        code="CRN294",
        title="rail wave separation from resonance",
        question="Is the passing frequency of the rail waves away from the natural frequencies?",
        failure="rail waves excite a resonance of the machine",
        scenes=ROLLS,
        loads=("rail_detuning",),
        sense=Sense.AT_LEAST,
        limit=key(
            "checks.rail_detuning",
            meaning="Minimum separation from resonance, 0.2 by default",
            valid="uniform waves",
            error="none: an engineering rule",
            source="handbooks: separation of 20 to 30 % from a natural frequency",
        ),
        needs=no_needs,
        blame=blames("rail", "waviness", "length"),
        repair=at("travel", "speed"),
        what="The relative separation of the rail wave frequency from each natural frequency is at least the limit."
        " The natural frequencies are those of the mast and of the machine on its wheels.",
        why="A rail ground in uniform waves excites the mast at one speed: v = f lambda.",
        formula="|v/(lambda f) - 1| >= 0.2 for wheels and mast",
        source="resonance; `laws.rail.resonance_speed`",
    ),
)

CHECKS_OF_THE_RAIL: tuple[AnyCheck, ...] = (CONTACT, RESONANCE)
