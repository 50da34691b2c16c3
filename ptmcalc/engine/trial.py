"""A key under trial: how far checks are from their limits as functions of its value, and where they pass."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.progress import step
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Sense
from ptmcalc.engine.ends import Key
from ptmcalc.engine.judge import Ruling
from ptmcalc.engine.levers import Lever
from ptmcalc.engine.load import Loaded
from ptmcalc.engine.plan import plan_scene
from ptmcalc.engine.run import settle
from ptmcalc.engine.solve import FINEST, Clearance, SearchPurse, variants
from ptmcalc.spec.machine import MachineSpec

_ONE = 1.0
"""Predicted seconds of a scene with a trial value. A numerical choice: next to a limit every refinement would run; a
larger value comes nearer to the limit and takes longer."""
_PROBE = 0.1
"""Decades to a trial value that shows whether a key matters. A numerical choice: a larger one
looks past narrow windows, a smaller one sees only what lies near."""
_MOVES = 1e-3
"""Change of a relative clearance by a trial value that counts as one [1]. A numerical choice: less is no lever."""
_HOPELESS = 3.0
"""Decades to the limit along a straight line from which a key is given up. A numerical choice: a larger value looks
further along curves that bend."""
_WINDOWS = 0.4
"""Decades within which a key that a check offers as repair is tried, though it gets worse on the way: a ramp passes at
whole periods of an oscillation. A numerical choice: a larger value finds windows further off and takes longer."""
_FINE, _CHEAP = 0.05, 0.05
"""Decades between two trial values in that range, if one takes no more than so many predicted seconds. Numerical
choices: smaller steps and a larger price find narrower windows and take longer."""
_PARTS = 3
"""Checks, those next to their limits, of which one at least is to pass where not all can. A numerical choice: a larger
value finds values that pass more of them, and takes longer."""
_CLOSE, _JUST, _MOST_STEPS = 0.01, 0.01, 12
"""When a value is near enough to the limit: relative width of the bracket [1], or five times that with this relative
clearance [1], and steps that narrow it. Numerical choices: smaller widths and more steps take longer."""
OVERHEAD = 0.01
"""Seconds that a scene takes besides its runs, to be read and planned, predicted too. A numerical choice: a larger
value tries fewer values."""
OPEN = (Verdict.FAIL, Verdict.UNDECIDED)
End = tuple[KeyPath, float]
"""An assumed value, and an end of its interval."""


@dataclass
class Machine:
    """A machine, and checks that are looked at in it."""

    purse: SearchPurse
    loaded: Loaded
    wanted: tuple[Key, ...]
    _trials: dict[str, "Trial"] = field(default_factory=dict)
    _present: dict[tuple[str, End | None], Mapping[Key, float]] = field(default_factory=dict)

    def trial(self, lever: Lever) -> "Trial":
        """What is known of a key."""
        return self._trials.setdefault(lever.name, Trial(self, lever, self.wanted))

    @property
    def scenes(self) -> list[str]:
        """The scenes of the wanted checks, the worst first."""
        labels = dict.fromkeys(scene for scene, _, _ in self.wanted)
        return sorted(labels, key=lambda label: min(self.present(label, None).values()))

    def present(self, label: str, end: End | None) -> Mapping[Key, float]:
        """The clearances of a scene of the machine as it is, with an assumed value at an end."""
        if (label, end) not in self._present:
            assert self.loaded.spec is not None
            self._present[label, end] = self.clearances(self.loaded.spec, label, end)
        return self._present[label, end]

    def clearances(self, spec: MachineSpec | None, label: str, end: End | None) -> Mapping[Key, float]:
        """The clearances relative to the limits in a scene of a changed machine; a check that is not made there does
        not pass."""
        found = {key: -math.inf for key in self.wanted if key[0] == label}
        scene = next((one for one in spec.all_scenes if one.label == label), None) if spec is not None else None
        kind = self.loaded.kind
        if spec is None or scene is None or kind is None:
            return found
        spec = spec.model_copy(update={"accuracy": None})
        spec = spec if end is None else spec.with_value(*end)
        settled = settle(
            kind,
            spec,
            plan_scene(kind, spec, scene),
            verdicts={(code, element) for _, code, element in found},
            budget=_ONE,
            until=lambda rung: rung.level <= FINEST,
        )
        self.purse.pay(settled.spent + OVERHEAD)
        return found | {(label, one.check.code, one.check.element): _clearance(one) for one in settled.rulings}

    def ends(self, wanted: tuple[Key, ...]) -> Iterator[End]:
        """The ends of the assumed values that checks can depend on."""
        spec, kind = self.loaded.spec, self.loaded.kind
        assert spec is not None
        assert kind is not None
        codes = {code for _, code, _ in wanted}
        checks = [one for one in kind.checks if one.code in codes]
        for one, end, _ in variants(spec, self.loaded.assumed):
            if any(one.read_by(check) for check in checks):
                yield one.path, end


@dataclass
class Trial:
    """A key of a machine under trial: the clearances of some checks as functions of its value."""

    machine: Machine
    lever: Lever
    wanted: tuple[Key, ...]
    sides: tuple[int, int] = (1, -1)
    """up and down, first the one that helps"""
    _specs: dict[float, MachineSpec | None] = field(default_factory=dict)
    _known: dict[tuple[float, str, End | None], Mapping[Key, float]] = field(default_factory=dict)

    def seems_to_need(self) -> tuple[float, float] | None:
        """How many of the checks a trial value does not bring nearer, and the decades that the others seem to need at
        most, by the straight line through it; of a value on the other side, where the first helps none. The worst scene
        speaks for the others where the key moves it. None where the key moves none of them."""
        for scene in self.machine.scenes:
            moved, best = False, (math.inf, math.inf)
            here = self.machine.present(scene, None)
            for side in self.sides:
                there = self.of_scene(self._value(side * _PROBE), scene, None)
                needs = [_decades(here[key], there[key]) for key in here]
                moved = moved or any(_differ(here[key], there[key]) for key in here)
                finite = [one for one in needs if math.isfinite(one)]
                found = (float(len(needs) - len(finite)), max(finite, default=0.0))
                if found < best:
                    best, self.sides = found, (side, -side)
                if len(finite) == len(needs):
                    break
            if moved:
                return best
        return (math.inf, math.inf) if self.own else None

    @property
    def own(self) -> bool:
        """Whether one of the checks offers the key as its repair: it is tried further, whatever trial values show."""
        return any(code in self.lever.repairs for _, code, _ in self.wanted)

    def best(self) -> float | None:
        """The value nearest to the present one at which all checks pass, or as many as pass together where one of them
        just passes; None where none does."""
        value = self.nearest(self.wanted)
        if value is not None or len(self.wanted) == 1:
            return value
        here = {key: found for scene in self.machine.scenes for key, found in self.machine.present(scene, None).items()}
        near = sorted(self.wanted, key=lambda key: -here[key])[:_PARTS]
        alone = [found for key in near if (found := self.nearest((key,))) is not None]
        alone.sort(key=lambda one: abs(math.log(one / self.lever.present)))
        return max(alone, key=lambda one: sum(found >= 0 for found in self.at(one).values()), default=None)

    def nearest(self, wanted: tuple[Key, ...]) -> float | None:
        """The value nearest to the present one at which some checks pass, on the side that helps, else on the other."""
        clearance = partial(self._least, wanted=wanted, ends=(None,))
        return self._along_sides(clearance) if clearance(self.lever.present) < 0 else self.sound(wanted)

    def sound(self, wanted: tuple[Key, ...]) -> float | None:
        """The same with each assumed value at both ends."""
        clearance = partial(self._least, wanted=wanted, ends=(None, *self.machine.ends(wanted)))
        return self._along_sides(clearance) if clearance(self.lever.present) < 0 else None

    def _along_sides(self, clearance: Clearance) -> float | None:
        for side in self.sides:
            found = self._along(side, clearance)
            if found is not None:
                return found
        return None

    def _along(self, side: int, clearance: Clearance) -> float | None:
        """The first value on a side that passes, by steps as the straight line through the last two shows, within a
        decade; none where it gets worse."""
        bad = start = self.lever.present
        before, reached = clearance(bad), 0.0
        worst, decades = before, _PROBE
        near, purse = _WINDOWS if self.own else 0.0, self.machine.purse
        while True:
            value = self._value(side * decades)
            spent = -purse.spent
            now = clearance(value)
            spent += purse.spent
            if now >= 0:
                return self.lever.grid.rounded(clearance, start, self._narrowed(clearance, bad, value))
            if decades >= 1 or (decades > near and math.isfinite(worst) and now < worst - _MOVES):
                return None
            rise = (now - before) / (decades - reached)
            known = math.isfinite(rise) and rise > 0
            wanted = 1.2 * (decades - now / rise) if known else 0.0
            if known and wanted > _HOPELESS and decades > near:
                return None
            bad, before, reached = value, now, decades
            decades = min(max(wanted, 1.5 * decades), 3 * decades, 1.0)
            if self.own and reached < near and spent < _CHEAP:
                decades = min(decades, reached + _FINE)

    def _narrowed(self, clearance: Clearance, bad: float, good: float) -> float:
        """A value that passes next to one that fails: by straight lines to just beyond the limit, where no refinement
        has to run, halved where they do not serve."""
        grid = self.lever.grid
        for place in range(_MOST_STEPS):
            below, above = clearance(bad), clearance(good)
            width = abs(good - bad) / abs(good)
            if grid.close(bad, good) or width <= _CLOSE or (above <= _JUST and width <= 5 * _CLOSE):
                break
            share = (_JUST / 2 - below) / (above - below) if math.isfinite(below) and place % 3 != 2 else 0.5
            middle = grid.between(bad, good, min(max(share, 0.05), 0.95))
            bad, good = (bad, middle) if clearance(middle) >= 0 else (middle, good)
        return good

    def _value(self, decades: float) -> float:
        """A value so far from the present one; of a count the next one at least."""
        grid, present = self.lever.grid, self.lever.present
        value = grid.on(present * 10**decades)
        return value if value != present else present + math.copysign(1.0, decades)

    def at(self, value: float) -> Mapping[Key, float]:
        """The clearances relative to the limits at a value of the key."""
        return {key: found for scene in self.machine.scenes for key, found in self.of_scene(value, scene, None).items()}

    def of_scene(self, value: float, scene: str, end: End | None) -> Mapping[Key, float]:
        """Those of a scene, with an assumed value at an end."""
        if value == self.lever.present:
            return self.machine.present(scene, end)
        if value not in self._specs:
            self._specs[value] = self.lever.set_to(self.machine.loaded, value).spec
        if (value, scene, end) not in self._known:
            step(f"{self.lever.name} = {self.lever.told(value)}")
            self._known[value, scene, end] = self.machine.clearances(self._specs[value], scene, end)
        return self._known[value, scene, end]

    def _least(self, value: float, wanted: tuple[Key, ...], ends: tuple[End | None, ...]) -> float:
        """The least clearance of some checks; where one fails, no further scene and no further end is tried."""
        least = math.inf
        for end in ends:
            for scene in self.machine.scenes:
                own = [key for key in wanted if key[0] == scene]
                if own:
                    found = self.of_scene(value, scene, end)
                    least = min(least, *(found[key] for key in own))
                if least < 0:
                    return least
        return least


def _clearance(ruling: Ruling) -> float:
    """How far the whole error bar lies on the sound side of the limit, relative to it; the check passes from 0 up."""
    value, limit = ruling.value, ruling.limit
    if ruling.found or value is None or limit is None or ruling.verdict not in (Verdict.PASS, *OPEN):
        return -math.inf
    at_least = ruling.check.sense is Sense.AT_LEAST
    clearance = value.low - limit.high if at_least else limit.low - value.high
    if not math.isfinite(clearance) and clearance < 0:  # a bar without an end fails; its middle shows which way to go
        clearance = min(value.value - limit.high if at_least else limit.low - value.value, -_MOVES)
    scale = abs(limit.value) or abs(value.value) or 1.0
    return -math.inf if math.isnan(clearance) else clearance / scale if math.isfinite(scale) else clearance


def _decades(here: float, there: float) -> float:
    """Decades to where a clearance is 0, along the straight line through the trial value; infinite where it leads
    away."""
    if here >= 0 or there >= 0:
        return 0.0 if here >= 0 else _PROBE * (here / (here - there) if math.isfinite(here) else 1.0)
    if not (math.isfinite(here) and math.isfinite(there)):
        return _PROBE * 10 if there > here else math.inf
    return _PROBE * here / (here - there) if there - here > _MOVES else math.inf


def _differ(here: float, there: float) -> bool:
    """Whether two clearances differ visibly."""
    if math.isfinite(here) and math.isfinite(there):
        return abs(there - here) > _MOVES
    return here != there
