"""Checks of stresses per combination, and of what keeps a rack stacker upright."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import AnyCheck, Check, LimitState, Sense, at, blames, needs, no_needs, no_repair, only
from ptmcalc.contract.limits import key
from ptmcalc.machines.crane.stacking.machine import model
from ptmcalc.machines.crane.stacking.machine.judging import Loads, OneCheck
from ptmcalc.machines.crane.stacking.machine.overhead import OverheadStacker
from ptmcalc.machines.crane.stacking.machine.rack import RackStacker
from ptmcalc.machines.crane.stacking.machine.scenes import (
    Brake,
    ForkCaught,
    ForkPush,
    ObstacleScene,
    RailScene,
    SafetyGearScene,
    StackerScene,
    Stand,
    Start,
)
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.strength import stresses
from ptmcalc.spec.scene import Scene

Shares = Callable[[Stacker, StackerScene, stresses.Event], dict[str, float]]


_STABILITY_LIMIT = key(
    "checks.stability",
    meaning="1: the stabilising moment is at least the tipping moment; the file may require more",
    valid="a machine on its wheels",
    error="none: an equilibrium at 1",
    source="equilibrium of moments; the additional reserve differs between standards",
)


def _on_a_side(side: str, wanted: Callable[[Any, Any], bool]) -> Callable[[OneCheck], OneCheck]:
    """A check of one of the two directions in which a machine may tip."""

    def of(check: OneCheck) -> OneCheck:
        def each(spec: Stacker, scene: StackerScene) -> Iterable[OneCheck]:
            if not wanted(spec, scene):
                return ()
            blamed = check.blame(spec, scene, {})
            return (check.of(side, check.limit, blamed, check.needs(spec, scene), check.repair(spec, scene)),)

        return replace(check, each=each)

    return of


def _travels(spec: Stacker, scene: StackerScene) -> bool:
    return isinstance(spec, RackStacker)


ALONG: OneCheck = _on_a_side("along", _travels)(
    Check(
        code="CRN207",
        hazard=True,
        title="stability ratio along the aisle",
        question="Does the machine keep both wheels on the rail in a start or stop?",
        failure="stability ratio along the aisle is too small",
        limit_state=LimitState("machine tips along the aisle", 1),
        scenes=frozenset({Start, Brake}),
        loads=("stability_reserve",),
        sense=Sense.AT_LEAST,
        limit=_STABILITY_LIMIT,
        needs=no_needs,
        blame=blames("base", "wheel_base"),
        repair=at("base", "wheel_base"),
        what="The stabilising moment of the weights is at least the required multiple of the tipping moment about"
        " either wheel. The tipping moment includes the inertia of the mast that oscillates in a start or stop, and"
        " the eccentric weights.",
        why="Combination 2 of table 11.2 covers stability. A moment of twice the steady moment of the mast lifts a"
        " wheel.",
        formula="sum G_i d_i >= k (M_0 + F_0 z_0 + m_1 a z_1 + |Q e + G b|)",
        source="balance of moments; N. Yu. Dorokhov, lecture notes, Kramatorsk 2007, table 11.2",
        types=frozenset({"rack_stacker"}),
    )
)


def _leans(spec: Stacker, scene: StackerScene) -> bool:
    leaning = isinstance(scene, ForkPush) or model.eccentric_moment(spec, scene, "across") != 0
    return isinstance(spec, RackStacker) and leaning


def _across_needs(spec: Stacker, scene: StackerScene) -> tuple[KeyPath, ...]:
    assert isinstance(spec, RackStacker)
    guide = spec.column.top_guide
    held = spec.base.gauge is not None or (guide is not None and guide.rating is not None)
    return () if held else (("column", "top_guide", "rating"),)


def _across_key(spec: Stacker, scene: StackerScene) -> KeyPath:
    assert isinstance(spec, RackStacker)
    return ("base", "gauge") if spec.base.gauge is not None else ("column", "top_guide", "rating")


ACROSS: OneCheck = _on_a_side("across", _leans)(
    Check(
        code="CRN208",
        hazard=True,
        title="stability ratio across the aisle",
        question="Do rails or the top guide hold the machine against the extended fork?",
        failure="stability ratio across the aisle is too small",
        limit_state=LimitState("machine tips across the aisle", 1),
        scenes=frozenset({Stand, ForkPush}),
        loads=("stability_reserve",),
        sense=Sense.AT_LEAST,
        limit=_STABILITY_LIMIT,
        needs=_across_needs,
        blame=lambda spec, scene, loads: _across_key(spec, scene),
        repair=_across_key,
        what="The stabilising moment of two rails or of the top guide is at least the required multiple of the tipping"
        " moment. The tipping moment includes the load on the extended fork and the reaction of the rack.",
        why="On a single rail, only the top guide prevents the machine from tipping into the rack.",
        formula="sum G_i B/2 + F_g H >= k (|Q e + G b| + F_f (z_0 + s))",
        source="balance of moments",
        types=frozenset({"rack_stacker"}),
    )
)

EVENTS: frozenset[type[Scene]] = frozenset(
    {Stand, Start, Brake, ObstacleScene, ForkCaught, ForkPush, RailScene, SafetyGearScene}
)

UNDER_A_BRIDGE: frozenset[type[Scene]] = frozenset({Stand, Start, Brake, ObstacleScene, ForkCaught})


def _of_travel(spec: Stacker, scene: StackerScene) -> bool:
    return model.mechanism(spec, scene) != "rotation"


def _governs(part: str, shares: Shares) -> Callable[[Stacker, StackerScene, Loads], KeyPath]:
    """The key by which the largest share of a stress goes."""

    def governing(spec: Stacker, scene: StackerScene, loads: Loads) -> KeyPath:
        happens = stresses.event(spec, scene, {name: one.value for name, one in loads.items()})
        parts = shares(spec, scene, happens if happens is not None else stresses.Event())
        return (part, max(parts, key=parts.__getitem__))

    return governing


COLUMN: OneCheck = only(lambda spec, scene: spec.column.section_modulus is not None and _of_travel(spec, scene))(
    Check(
        code="CRN209",
        hazard=True,
        title="mast stress",
        question="Is the stress at the mast root within the permissible stress in every load combination?",
        failure="mast is overstressed",
        scenes=EVENTS,
        loads=("column_stress",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.column_stress",
            meaning="Permissible mast stress, given in the file",
            valid="any combination",
            error="none: a limit of the file",
            source="material and rules of the file",
        ),
        needs=needs(("checks", "column_stress")),
        blame=_governs("column", stresses.column_stresses),
        repair=no_repair,
        repairs_blame=True,
        what="The stress of the mast root under the weights and the dynamic load of each combination is at most the"
        " permissible stress.",
        why="The governing combination depends on the machine. No combination may be omitted. An overstressed mast"
        " yields or cracks at its root.",
        formula="M/W + M_y/W_y + N/A <= sigma_0",
        source="bending of beams; tables 11.1 and 11.2 of the lecture notes, Kramatorsk 2007",
    )
)


def _has_girders(spec: Stacker, scene: StackerScene) -> bool:
    if not isinstance(spec, OverheadStacker) or not _of_travel(spec, scene):
        return False
    return spec.bridge.section_modulus_vertical is not None and spec.bridge.section_modulus_horizontal is not None


BRIDGE: OneCheck = only(_has_girders)(
    Check(
        code="CRN210",
        hazard=True,
        title="bridge girder stress",
        question="Is the girder stress within the permissible stress in every load combination?",
        failure="bridge girder is overstressed",
        scenes=UNDER_A_BRIDGE,
        loads=("bridge_stress",),
        sense=Sense.AT_MOST,
        limit=key(
            "checks.bridge_stress",
            meaning="Permissible girder stress, given in the file",
            valid="any combination",
            error="none: a limit of the file",
            source="material and rules of the file",
        ),
        needs=needs(("checks", "bridge_stress")),
        blame=_governs("bridge", stresses.bridge_stresses),
        repair=no_repair,
        repairs_blame=True,
        what="The stress of the more heavily loaded girder under the weights and the dynamic load of each combination"
        " is at most the permissible stress.",
        why="The mast pulls one girder down and pushes the other up while both bend sideways. An overstressed girder"
        " yields or cracks.",
        formula="M_v/W_v + M_h/W_h <= sigma_0",
        source="bending of beams; table 11.1 of the lecture notes, Kramatorsk 2007",
        types=frozenset({"overhead_stacker"}),
    )
)

CHECKS_OF_STRENGTH: tuple[AnyCheck, ...] = (ALONG, ACROSS, COLUMN, BRIDGE)
