"""One report of every sort, from toys: what every format must be able to say."""

import math
from dataclasses import replace

from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.base.units import FORCE, RATIO
from ptmcalc.contract.report import FileReport
from ptmcalc.contract.result import Event, Finding, Found, History, LoadInfo, Result
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import load_text
from support.toy_kind import OVERLOAD, PULL, SHOCK, STATICS, Hang, Toy
from support.toys import KN, effect, kind_of, loaded, pull, report, solver

_SWING = (("rope", "taut", "slack"), ("rope", "slack", "taut"))
RESERVE = LoadInfo("reserve", "reserve of the hook", RATIO)


def passing() -> FileReport:
    """Simulated beside the textbook, with every state of an effect, forced ones too."""
    rich = replace(
        solver("rich", pull(0), carries=("waves", "sag"), levels=2),
        run=lambda spec, scene, carried, level: Result(
            {"pull": Found(pull(8.9, 9.1) if "sag" in carried else pull(8.7, 8.9), {"time": 1.5})},
            work=1000,
            window=(0.0, 4.0),
            health={"energy_residual": 1e-9, "steps": 500.0},
        ),
    )
    effects = [
        effect("waves", 3.0),
        effect("sag", 0.15),
        effect("wind", 0.01, Interval(-0.1 * KN, 0.1 * KN)),
        effect("frost", 5.0, Interval(-0.05 * KN, 0.0)),
        effect("rain", 5.0),
        effect("fog", number=None),
    ]
    textbook = solver("textbook", Estimate.unknown(12 * KN), decides=False, carries=("waves",))
    return report(kind_of(rich, textbook, effects=effects), name="Sound hook", effects={"rain": "off"})


def failing() -> FileReport:
    """The weight of the load key is blamed, and the weight that passes is told; a second scene passes."""
    scenes = [{"type": "hang", "name": "gust", "share": 1}, {"type": "hang", "name": "calm", "share": 0.5}]
    return report(kind_of(STATICS), name="Overloaded hook", load="12 kN", shock=1.1, scenes=scenes)


def undecided() -> FileReport:
    """The verdict hangs on a value the file does not give."""
    return report(kind_of(STATICS, assumptions=(SHOCK,)), load="8.5 kN")


def open_bar() -> FileReport:
    """An effect without a bound that no solver carries."""
    return report(kind_of(STATICS, effects=[effect("waves", math.inf, ANYTHING)]))


def not_checked() -> FileReport:
    """The strength is not given."""
    return report(kind_of(STATICS), strength=None)


def switched_off() -> FileReport:
    """The only check is switched off: nothing to judge."""
    return report(kind_of(STATICS), checks={"TOY101": {"off": "a show piece"}})


def infinite() -> FileReport:
    """A hook that transmits nothing has an infinite reserve, which passes."""
    kind = kind_of(
        solver("top", lambda carried, level: {"pull": pull(0), "reserve": Estimate.exact(math.inf)}, gives=("pull",)),
        loads=(PULL, RESERVE),
        checks=(OVERLOAD, replace(OVERLOAD, code="TOY102", loads=("reserve",), sense=OVERLOAD.sense.AT_LEAST)),
    )
    return report(kind)


def moving() -> FileReport:
    """A hook and a rope, each with its load and its check; in the first scene they swing: events and histories."""

    def swings(spec: Toy, scene: Hang, carried: frozenset[str], level: int) -> Result:
        return Result(
            {"pull[hook]": Found(pull(8 * scene.share), {"time": 0.5}), "pull[rope]": Found(pull(9 * scene.share))},
            window=(0.0, 1.0),
            events=tuple(Event(0.0123456789 * n, *_SWING[n % 2]) for n in range(35)) if scene.share == 1 else (),
            histories=lambda: {"pull[hook]": History(FORCE, (0.0, 0.5, 1.0), (0.0, 8 * KN, 1 / 3))},
        )

    parts = ("hook", "rope")
    kind = kind_of(
        replace(STATICS, run=swings),
        parts=lambda spec: tuple(PULL.of(part) for part in parts),
        checks=(
            replace(
                OVERLOAD, each=lambda spec, scene: [OVERLOAD.of(part, OVERLOAD.limit, ("load",)) for part in parts]
            ),
        ),
    )
    scenes = [{"type": "hang", "name": "gust", "share": 1}, {"type": "hang", "name": "calm", "share": 0.5}]
    return check(loaded(kind, name="Swinging hook", scenes=scenes), Options(histories=True))


def warned() -> FileReport:
    """A solver remarks on its own numbers."""
    remark = Finding("NUM104", "the rope was slack for a moment", ("load",), "hang it gently")
    return report(
        kind_of(replace(STATICS, run=lambda s, c, e, n: Result({"pull": Found(pull(9))}, findings=(remark,))))
    )


def broken() -> FileReport:
    """The numerics gave no number."""
    return report(kind_of(solver("top", Estimate.exact(math.nan))))


def invalid() -> FileReport:
    """A file with two mistakes."""
    return check(load_text(b"kind: conveyor\nspeed: 2.5\nrote: {length: 1 m}\n", "invalid.yaml"), Options())


def unreadable() -> FileReport:
    """A file without a single key."""
    return check(load_text(b"", "unreadable.yaml"), Options())


SAMPLES = {
    sample.__name__: sample()
    for sample in (
        passing,
        failing,
        undecided,
        open_bar,
        not_checked,
        switched_off,
        infinite,
        moving,
        warned,
        broken,
        invalid,
        unreadable,
    )
}
