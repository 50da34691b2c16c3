"""How the parts of a train hang together: what is said of names, of quantities and of gears, at the line at fault."""

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from ptmcalc.base.span import KeyPath
from ptmcalc.base.units import UnitError
from ptmcalc.base.words import quote, with_article
from ptmcalc.spec.fragment import Conflict, Given
from ptmcalc.spec.shape import (
    annotation_at,
    did_you_mean,
    inner,
    keys_of,
    meant,
    measure_of,
    model_of,
    models_of,
    value_at,
    words_of,
)

GROUND = "ground"
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_SAME = 1e-9
"""Relative difference of two gear ratios that counts as rounding [1], above the resolution 2e-16 of the floating point.
Gears that close a loop are always rejected; it decides between a contradiction and an undetermined load share."""
_ROUNDED = 1e-3
"""Relative difference of two speeds of one shaft up to which they count as equal [1]: speeds are written with few
digits. An engineering choice. A larger value accepts contradictions; a smaller one rejects rounded speeds."""

Bodies = Mapping[str, Given]


@dataclass(frozen=True, slots=True)
class _Part:
    """A part of the train as the file writes it."""

    path: KeyPath
    given: Given

    @property
    def kind(self) -> object:
        """The block it stands in."""
        return self.path[0]

    @property
    def ends(self) -> list[tuple[KeyPath, str]]:
        """Every place at which it names an inertia, or the ground."""
        raw = self.given.raw
        between = raw["between"] if isinstance(raw.get("between"), list) else []
        found = [((*self.path, "between", index), name) for index, name in enumerate(between)]
        found += [((*self.path, key), raw[key]) for key in ("at", "against", "from", "to") if key in raw]
        return [(path, name) for path, name in found if isinstance(name, str)]

    @property
    def is_whole(self) -> bool:
        """Whether it names all that it should: what is missing, or no name, is said of the key itself."""
        wanted = {"links": 2, "gears": 2}.get(str(self.kind), 1)
        most = 2 if self.kind in ("links", "gears", "brakes") else 1
        return wanted <= len(self.ends) <= most


def wiring(given: Given, parts: tuple[str, ...]) -> Iterator[Conflict]:
    """What does not fit between the parts of a train."""
    return (_located(given, one) for one in _wiring(given, parts))


def _located(given: Given, conflict: Conflict) -> Conflict:
    """The same with the tags of unions in its path, by which validation tells their members apart."""
    path: KeyPath = ()
    annotation: object = given.model
    for index, step in enumerate(conflict.path):
        raw = value_at(given.raw, conflict.path[:index])
        model = model_of(annotation, raw)
        if model is not None and len(models_of(annotation)) > 1:
            path = (*path, words_of(keys_of(model)["type"].annotation)[0])
        path, annotation = (*path, step), inner(annotation, step, raw)
    return Conflict(path, conflict.reason, conflict.hint)


def _wiring(given: Given, parts: tuple[str, ...]) -> Iterator[Conflict]:
    yield from _names(given, ("inertias",))
    yield from _names(given, parts)
    written = given.raw.get("inertias")
    if not isinstance(written, dict) or not written:
        return  # said of the block
    known = [name for name in written if isinstance(name, str)]
    bodies = {str(path[1]): body for path, body in _named(given, "inertias")}
    found = [_Part(path, part) for kind in parts for path, part in _named(given, kind)]
    sound = []
    for part in found:
        wrong = list(_ends(part, known))
        yield from wrong
        if not wrong and part.is_whole:
            sound.append(part)
    for name, body in bodies.items():
        turns = _turns(body)
        if turns is not None:
            yield from _quantities(_Part(("inertias", name), body), turns)
    for part in sound:
        yield from _motion(part, bodies)
    yield from _about(given, bodies, known)
    ties = _Ties()
    yield from _gears([part for part in sound if part.kind == "gears"], ties)
    yield from _speeds(bodies, [part for part in sound if part.kind == "motions"], ties)
    if not any(key not in keys_of(given.model) and meant(str(key), ("gears",)) for key in given.raw):
        yield from _massless(bodies, [part for part in found if part.kind == "gears"])


def _named(given: Given, kind: str) -> Iterator[tuple[KeyPath, Given]]:
    raw = given.raw.get(kind)
    for name, item in raw.items() if isinstance(raw, dict) else ():
        model = model_of(annotation_at(given.model, (kind, name), given.raw), item)
        if isinstance(item, dict) and model is not None:
            yield (kind, name), Given(model, item)


def _names(given: Given, kinds: tuple[str, ...]) -> Iterator[Conflict]:
    seen: dict[str, str] = {}
    for kind in kinds:
        raw = given.raw.get(kind)
        for name in raw if isinstance(raw, dict) else ():
            if not isinstance(name, str) or not _NAME.fullmatch(name) or name == GROUND:
                reason = (
                    f"{quote(str(name))} is not a name: a letter, then letters, digits, `_` and `-`; not `{GROUND}`"
                )
                yield Conflict((kind, name), reason, "give it another name")
            elif name in seen:
                yield Conflict((kind, name), f"`{name}` is also one of the `{seen[name]}`", "give it a name of its own")
            seen.setdefault(name, kind)


def _unknown(path: KeyPath, name: str, known: list[str]) -> Conflict:
    return Conflict(path, f"unknown inertia {quote(name)}", did_you_mean(name, known, "inertias: "))


def _ends(part: _Part, known: list[str]) -> Iterator[Conflict]:
    """Names of inertias that are not there, and parts tied to one inertia twice."""
    for path, name in part.ends:
        may_be_ground = part.kind == "links" or (part.kind == "brakes" and path[-1] == "against")
        if name == GROUND and not may_be_ground:
            yield Conflict(path, "the ground does not move", "name an inertia")
        elif name != GROUND and name not in known:
            yield _unknown(path, name, known)
    names = [name for _, name in part.ends]
    if len(names) == 2 and names[0] == names[1]:
        yield Conflict(part.ends[1][0], f"both ends are {quote(names[0])}", "name two different ones")


def _turns(body: Given) -> bool | None:
    """Whether an inertia turns, not travels; None where the file says both or nothing."""
    ways = {key != "mass" for key in ("inertia", "mass", "body") if key in body}
    return ways.pop() if len(ways) == 1 else None


def _motion(part: _Part, bodies: Bodies) -> Iterator[Conflict]:
    """Parts that join turning and travelling, and quantities of the other kind."""
    kinds = [(path, _turns(bodies[name]) if name in bodies else None) for path, name in part.ends if name != GROUND]
    turning = [turns for _, turns in kinds if turns is not None]
    if len(turning) < len(kinds):
        return
    if part.kind == "gears":
        yield from _gear_motion(part, turning)
    elif len(turning) == 2 and turning[0] is not turning[1]:
        yield Conflict(kinds[1][0], "one end rotates, the other travels", "put a gear with a `radius` between them")
    elif part.kind == "motors" and not turning[0]:
        hint = "put it on a rotating inertia, with a gear of a `radius` between; or write its force under `torques`"
        yield Conflict(kinds[0][0], "a motor rotates, and this inertia travels", hint)
    else:
        if "clearance" in part.given and not turning[0]:
            reason = "the clearance of a gear is the backlash of a shaft, and these inertias travel"
            yield Conflict((*part.path, "clearance"), reason, "write the clearance as `gap`")
        yield from _quantities(part, turning[0])


def _gear_motion(part: _Part, turns: list[bool]) -> Iterator[Conflict]:
    ways = [key for key in ("radius", "ratio") if key in part.given]
    if ways == ["radius"] and turns != [True, False]:
        reason = "a `radius` converts rotation into travel: `from` rotates and `to` travels"
        yield Conflict((*part.path, "radius"), reason, "write a `ratio`, or swap `from` and `to`")
    elif ways == ["ratio"] and turns[0] is not turns[1]:
        reason = "one side rotates, the other travels: a ratio without unit cannot connect them"
        yield Conflict((*part.path, "ratio"), reason, "write the `radius` of drum, wheel or pinion")


def _quantities(part: _Part, turns: bool) -> Iterator[Conflict]:
    """Numbers of a part whose unit is of the other kind of motion."""
    for path, given in _blocks(part):
        for key, about in keys_of(given.model).items():
            measure, value = measure_of(about), given.raw.get(key)
            if measure is None or measure.or_else is None or not isinstance(value, str):
                continue
            wanted = measure.quantity if turns else measure.or_else
            try:
                is_wanted = measure.quantity_of(value) is wanted
                measure.read(value)
            except (UnitError, ValueError):
                continue  # said by the key itself
            if not is_wanted:
                doing = "turns" if turns else "travels"
                reason = f"{quote(value)}: the inertia {doing}, so this is {with_article(wanted.name)}"
                yield Conflict((*path, key), reason, f"write e.g. `{wanted.example}`")


def _blocks(part: _Part) -> Iterator[tuple[KeyPath, Given]]:
    """A part and the points of its table."""
    yield part.path, part.given
    for index, point in enumerate(part.given.blocks("points")):
        if point is not None:
            yield (*part.path, "points", index), point


def _about(given: Given, bodies: Bodies, known: list[str]) -> Iterator[Conflict]:
    """Scenes about an inertia that is not there, or in quantities of the other kind; the way of a stop."""
    motors = [motor.raw.get("at") for _, motor in _named(given, "motors")]
    usual = motors[0] if motors else known[0]
    if motors and isinstance(usual, str) and usual in bodies and _turns(bodies[usual]) is False:
        usual = None  # a motor on what travels: that is said of the motor
    stops: bool | None = None
    for index, scene in enumerate(given.blocks("scenes")):
        name = scene.raw.get("of", usual) if scene else None
        if scene is None or not isinstance(name, str):
            continue
        part = _Part(("scenes", index), scene)
        turns = _turns(bodies[name]) if name in bodies else None
        if "of" in scene and name not in known:
            yield _unknown((*part.path, "of"), name, known)
        elif turns is not None:
            yield from _quantities(part, turns)
            if scene.word("type") == "stop":
                if stops is not None and turns is not stops:
                    path = (*part.path, "of") if "of" in scene else part.path
                    reason = (
                        "stopping distances are compared: one scene refers to a rotating"
                        " inertia, one to a travelling one"
                    )
                    yield Conflict(path, reason, "make it a file of its own")
                stops = turns if stops is None else stops
    if stops is None and isinstance(usual, str) and usual in bodies:
        stops = _turns(bodies[usual])
    checks = given.block("checks")
    if checks is not None and stops is not None:
        yield from _quantities(_Part(("checks",), checks), stops)


@dataclass(slots=True)
class _Ties:
    """Inertias that gears tie together, and their speeds over that of one of them."""

    above: dict[str, tuple[str, float]] = field(default_factory=dict)

    def root(self, name: str) -> tuple[str, float]:
        """The one that stands for all, and the speed of this one over its speed."""
        above, ratio = self.above.get(name, (name, 1.0))
        if above == name:
            return name, ratio
        top, further = self.root(above)
        return top, ratio * further

    def join(self, name: str, other: str, ratio: float) -> float | None:
        """Tie two together, name over other; the ratio they have already where they are tied."""
        (first, one), (second, two) = self.root(name), self.root(other)
        if first == second:
            return one / two
        self.above[second] = (first, one / ratio / two)
        return None


def _gears(gears: list[_Part], ties: _Ties) -> Iterator[Conflict]:
    """Gears that close a loop: they contradict each other, or share a load nobody can tell apart."""
    for gear in gears:
        ratio, radius = gear.given.number("ratio"), gear.given.number("radius")
        speeds = ratio if ratio else 1 / radius if radius else None
        if speeds is None:
            continue
        implied = ties.join(str(gear.given.raw["from"]), str(gear.given.raw["to"]), speeds)
        if implied is None:
            continue
        if abs(implied - speeds) > _SAME * abs(speeds):
            fits = f"ratio {implied:.6g}" if ratio else f"radius {1 / implied:.6g} m"
            reason = f"it contradicts the other gears, which make the {fits}"
        else:
            reason = "it closes a loop of gears: the load share of each is undetermined"
        yield Conflict(gear.path, reason, "delete one of the gears")


def _speeds(bodies: Bodies, motions: list[_Part], ties: _Ties) -> Iterator[Conflict]:
    """Speeds at the start, and prescribed motions, of inertias that gears tie together."""
    known: dict[str, tuple[str, float]] = {}
    for name, body in bodies.items():
        speed = body.number("speed") if "speed" in body else None
        if speed is None:
            continue
        root, ratio = ties.root(name)
        other, top = known.setdefault(root, (name, speed / ratio))
        if abs(speed / ratio - top) > _ROUNDED * max(abs(speed / ratio), abs(top)):
            reason = f"`{other}`, connected by gears, has a different speed"
            yield Conflict(("inertias", name, "speed"), reason, "give the speed of one of the two")
    guided: dict[str, str] = {}
    for motion in motions:
        name = motion.ends[0][1]
        root, _ = ties.root(name)
        if root in guided:
            reason = f"the motion of {quote(name)} is already prescribed by `{guided[root]}`"
            yield Conflict((*motion.path, "at"), reason, "delete one of the two")
        guided.setdefault(root, str(motion.path[1]))


def _massless(bodies: Bodies, gears: list[_Part]) -> Iterator[Conflict]:
    """Nodes without inertia that no gear ties to one."""
    heavy = {name for name, body in bodies.items() if _heavy(body)}
    grown = True
    while grown:
        grown = False
        for gear in gears:
            pair = {name for _, name in gear.ends}
            if pair & heavy and not pair <= heavy:
                heavy |= pair
                grown = True
    for name in bodies:
        if name not in heavy:
            reason = "a node without inertia has no motion of its own"
            key = "mass" if "mass" in bodies[name] else "inertia"
            yield Conflict(
                ("inertias", name, key), reason, "give it an inertia, or combine the links on both sides of it"
            )


def _heavy(body: Given) -> bool:
    sizes = [body.number(key) for key in ("inertia", "mass") if key in body]
    return all(size is None or not math.isclose(size, 0.0, abs_tol=0.0) for size in sizes)
