"""A weight on a hook: the smallest kind of machine, and everything a kind needs.

The file is a kind on its own: as `__init__.py` of a folder in `ptmcalc.machines`, or named by an entry point. Tests
of the engine take it apart and put other solvers, effects and checks into it.
"""

from collections.abc import Mapping, Sequence
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, Sense
from ptmcalc.contract.effect import Criterion, Effect
from ptmcalc.contract.machine import Assumption, MachineKind
from ptmcalc.contract.result import Found, LoadInfo, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.spec.fields import PositiveForce, PositiveRatio
from ptmcalc.spec.machine import CheckSettings, MachineSpec
from ptmcalc.spec.scene import Scene

SWING = 0.05  # rad


class Hang(Scene):
    """The weight hangs."""

    type: Literal["hang"] = "hang"
    share: PositiveRatio = 1.0
    """part of the load on the hook"""


class Toy(MachineSpec):
    """A hook."""

    kind: Literal["toy"]
    load: PositiveForce
    """weight on the hook"""
    shock: PositiveRatio | None = None
    """pull over weight when the weight is set down; 1.1 is assumed when it is left out"""
    strength: PositiveForce | None = None
    """pull the hook bears; without it the hook cannot be checked"""
    checks: CheckSettings = CheckSettings()
    """checks switched off by code"""
    scenes: Annotated[tuple[Hang, ...], Field(min_length=1)] | None = None
    """what happens to the hook; it hangs when left out"""

    @property
    def all_scenes(self) -> Sequence[Hang]:
        return self.scenes or (Hang(),)

    @property
    def settings(self) -> CheckSettings:
        return self.checks


def run(spec: Toy, scene: Hang, carried: frozenset[str], level: int) -> Result:
    """Pull of a weight that is set down.

        S = shock share W

    **Range** a stiff rope.
    **Error** exact for that model.
    **Source** definition of the shock factor.
    """
    return Result({"pull": Found(Estimate.exact((spec.shock or 1.0) * scene.share * spec.load))}, work=1)


def swing_criterion(spec: Toy, scene: Hang) -> Criterion:
    """Pull that a swing adds, over the weight.

        e = 2 (1 - cos(a)), about a^2

    **Range** an amplitude a of 0.05 rad.
    **Error** an upper bound.
    **Source** energy of a pendulum; the threshold of 1 % is an engineering choice.
    """
    return Criterion("e", SWING**2, 0.01, "pull that the swing adds, over the weight", "energy of a pendulum")


def swing_bound(spec: Toy, scene: Hang, loads: Mapping[str, Estimate]) -> Mapping[str, Interval]:
    """A swinging weight pulls up to a^2 of its weight more at the lowest point, and less at the ends.

        -a^2/2 W <= change <= a^2 W

    **Range** an amplitude a of 0.05 rad.
    **Error** a bound.
    **Source** energy of a pendulum.
    """
    return {"pull": Interval(-(SWING**2) / 2 * spec.load, SWING**2 * spec.load)}


def limit(spec: Toy, scene: Hang) -> Estimate:
    """Strength of the hook.

    **Range** any hook.
    **Error** none: a given value.
    **Source** the file.
    """
    assert spec.strength is not None
    return Estimate.exact(spec.strength)


def _load_key(spec: Toy, scene: Hang, *loads: object) -> KeyPath:
    return ("load",)


PULL = LoadInfo("pull", "pull on the hook", units.FORCE)

STATICS: Solver[Toy, Hang] = Solver(
    name="hanging",
    title="force of a weight set down",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Hang}),
    represents=frozenset(),
    gives=frozenset({"pull"}),
    run=run,
    cost=lambda spec, scene, carried, level: 1e-5,
    source="definition of the shock factor",
)

SWINGING: Effect[Toy, Hang] = Effect("swing", "swing of the weight", frozenset({Hang}), swing_criterion, swing_bound)

OVERLOAD: Check[Toy, Hang] = Check(
    code="TOY101",
    title="weight on the hook",
    question="Does the hook carry the weight?",
    failure="hook is overloaded",
    scenes=frozenset({Hang}),
    loads=("pull",),
    sense=Sense.AT_MOST,
    limit=limit,
    needs=lambda spec, scene: (("strength",),),
    blame=_load_key,
    repair=_load_key,
    what="The pull does not exceed the strength of the hook.",
    why="An overloaded hook opens.",
    formula="S <= strength",
    source="the file",
)

SHOCK: Assumption[Toy] = Assumption(
    ("shock",), units.RATIO, lambda spec: 1.1, lambda spec: Interval(1.0, 1.2), "a smooth crane driver"
)

TEMPLATE = """\
# A weight on a hook.
kind: toy
name: Hook of the toy crane
load: 8 kN
strength: 10 kN
# shock: 1.1     # pull over weight when the weight is set down
"""

KIND = MachineKind(
    name="toy",
    title="a weight on a hook",
    spec=Toy,
    loads=(PULL,),
    effects=(SWINGING,),
    solvers=(STATICS,),
    checks=(OVERLOAD,),
    starting=lambda: TEMPLATE,
    assumptions=(SHOCK,),
)
