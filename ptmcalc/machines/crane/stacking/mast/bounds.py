"""How far a column of two masses may be from one with all its modes, and one without weights from one with them."""

import math
from collections.abc import Iterable, Mapping

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.base.estimate import ANYTHING, Estimate, Interval
from ptmcalc.base.memory import kept_for
from ptmcalc.contract.result import of
from ptmcalc.laws import mast_modes
from ptmcalc.machines.crane.stacking.machine import model, travelling
from ptmcalc.machines.crane.stacking.machine.columns import buckling_share, swinging
from ptmcalc.machines.crane.stacking.machine.loads import MODES
from ptmcalc.machines.crane.stacking.machine.scenes import Brake, DrivenScene, ObstacleScene, StackerScene, Stand, Start
from ptmcalc.machines.crane.stacking.machine.spec import Stacker
from ptmcalc.machines.crane.stacking.mast import march
from ptmcalc.machines.crane.stacking.mast.march import Happening
from ptmcalc.machines.crane.stacking.mast.names import GRAVITY
from ptmcalc.machines.crane.stacking.mast.resting import at_rest
from ptmcalc.machines.crane.stacking.mast.two_mass import course_of, lumped
from ptmcalc.machines.crane.stacking.mechanisms import starts
from ptmcalc.machines.crane.stacking.strength.derived import bounds_of_derived
from ptmcalc.numerics.mast.modes import Mast
from ptmcalc.numerics.mast.parts import FloatArray
from ptmcalc.numerics.mast.run import Course, play

Loads = Mapping[str, Estimate]
Offsets = Mapping[str, Interval]
_ELEMENTS = 10
"""Beam elements [1] of the mast whose frequencies and modes enter the bounds. A numerical choice: fewer elements raise
the frequencies and neglect modes. More elements cost time, which grows with the cube of their number."""
_GRAVITY, _LEAST = 2.0, 1.0
"""Times the difference of two runs, one with the weights, and times what they change of the stiffness: calibrated."""
_MOMENT = 3.0
"""Times what weights change of the stiffness, of the moment at the root in a collision, in which the higher modes have
a good part: calibrated."""
_SETTLES = 1.5
"""Times the same, of the swing that settles: calibrated."""
_JUST_BEFORE = 1e-9
"""Share [1] of the time of the first standstill by which the run ends earlier, so that the base still moves. A
numerical choice: it is above the rounding of the time and changes the acceleration by about 1e-9. A smaller value risks
the acceleration of the held base."""
_FREQUENCY = 2.0
"""Times the difference of two runs, one with the exact frequency: calibrated."""
_KICK = 2.0
"""Times the kick of a base that is held a little earlier or later, and perhaps let go and held again: calibrated."""
_GRAZES = 0.1
"""Share of its mean deceleration below which a base comes to rest so softly that its time is not known."""


def modes_bound(spec: Stacker, scene: DrivenScene, loads: Loads) -> dict[str, Interval]:
    """What the shapes left out may change of the loads of two masses.

    Deflection and moment at rest are exact, but for what the shape of a force at the far end misses of the weights: a
    force at the far end leaves an error of second order of them, even acceleration one of the first order; of
    what swings the first mode has the share g_1/g_s, all others together no more than sum |g_k|:

        |dx| <= P (s_1 |g_s - g_1| + sum_(k > 1) s_k |g_k|)   beside a base that rolls, P the force that comes
              + a (|h_s - h_1| + sum_(k > 1) |h_k|)           as it stops, a its deceleration; 2 a s_k along a ramp
              + 2 |x(w) - x(w_1)|                             two masses with the frequency of the exact column
              + 2 |d - d_1| x/d                               d, d_1 under even acceleration: two masses, the column
              + sum |p_k L_k| min(2 V w_k, 2 a)/w_k^2         held-base modes, kicked by the speed V, a the step
                                                              of acceleration that comes so much earlier or later

    s_k = 1, or 2/(w_k t_r) for what comes up in the time t_r: a mode is set off by each kink of it. V is how far the
    speed of the rolling base may be off, by which it is held earlier or later:

        V = P/m^2 ( sum_(k > 1) s_k L_k^2/w_k + s_1 |L_1^2/w_1 - L^2/w| )

    with the momentum L_k^2/(m w_k) P that a mode swings with against the base, m all that rolls; L and w of two masses.
    Of the moment at the root the same, g_k and h_k that of the inertia of a mode less that of the weights on it, and
    d, d_1 the moments under even acceleration: a root that turns under the column alone, while girders shift under the
    trolley too, leans the weights otherwise than the one shape says, however little that is of the whole deflection.
    The time in which the swing settles is that of a window so much narrower or wider. All of it with the weights on the
    column and without, as the run may have been either; a file that leaves weights out, or insists on them, tells.

    **Range** every start and stop of two masses; nothing is known where the base comes to rest so softly that the time
    of it is open: with less than a tenth of the deceleration P/m.
    **Error** the sums are bounds; the factors 2 are calibrated on a seeded sample.
    **Source** modal analysis: a mode strays from rest under its force by no more than its share of each jump.
    """
    try:
        told = _either(_offsets(spec, scene, gravity=gravity) for gravity in _weights(spec))
    except NumericsError:
        return _unknown_swing(spec, scene, loads)
    spread = {name: offset for name, offset in told.items() if name in loads}
    return bounds_of_derived(spec, scene, loads, _above_zero(spread, loads))


_NOT_OF_THE_SWING = ("natural_frequency", "period", "column_stiffness", "rest_deflection", "starts_ratio")


def _unknown_swing(spec: Stacker, scene: DrivenScene, loads: Loads) -> dict[str, Interval]:
    """Nothing is known of the swing; of the time of the event what momentum says of it."""
    moved = {name: ANYTHING for name in loads if not name.startswith(_NOT_OF_THE_SWING)}
    return {**moved, **time_bound(spec, scene, loads)}


def _weights(spec: Stacker) -> tuple[bool, ...]:
    """Whether a run has the weights on the column, or may have them or not."""
    return {"off": (False,), "on": (True,)}.get(spec.effects.get(GRAVITY, "auto"), (False, True))


def _either(found: Iterable[dict[str, Interval]]) -> dict[str, Interval]:
    """Offsets that hold those of each."""
    told: dict[str, Interval] = {}
    for one in found:
        for name, offset in one.items():
            known = told.get(name, offset)
            told[name] = Interval(min(known.low, offset.low), max(known.high, offset.high))
    return told


def _offsets(spec: Stacker, scene: DrivenScene, *, gravity: bool) -> dict[str, Interval]:
    moves = march.happening(spec, scene, gravity=gravity)
    length, stiffness = spec.column.length, swinging(spec, scene).stiffness
    exact = Mast.of(moves.column.column, _ELEMENTS, (length,))
    own = lumped(spec, scene, moves, gravity=gravity)
    evenly, exactly = _even(own, length), _even(exact, length)
    heavier = float((own.frequencies[0] / exact.frequencies[0]) ** 2)
    plain, right = (course_of(spec, scene, gravity=gravity, heavier=factor) for factor in (1.0, heavier))
    if moves.follows:
        sums = [_strays(exact, length, math.inf, moves.rise, 2 * moves.jump)]
    else:
        deceleration = max(plain.largest("acceleration")[0], right.largest("acceleration")[0])
        sums = [_strays(exact, length, math.inf, 0.0, deceleration)]
        sums.append(_strays(exact, length, moves.base.mass, moves.rise, moves.jump))
        paces = _last_pace(plain), _last_pace(right)
        if min(paces) < _GRAZES * moves.jump / plain.system.total:
            raise NumericsError(
                "NUM103", "the instant of standstill of the base is not determined: the final impact is too small"
            )
        sums.append(_kicked(exact, own, length, moves, max(paces)))
    shift, turn = (sum(one[k] for one in sums) for k in (0, 1))
    reached = plain.largest("deflection")[0] / evenly[0]
    shift, turn = (
        one + _FREQUENCY * (abs(plain.largest(what)[0] - right.largest(what)[0]) + abs(ours - theirs) * reached)
        for one, what, ours, theirs in zip((shift, turn), ("deflection", "moment"), evenly, exactly, strict=True)
    )
    told = {
        "mast_deflection_max": Interval(-shift, shift),
        "mast_force_max": Interval(-stiffness * shift, stiffness * shift),
        "mast_moment_max": Interval(-turn, turn),
    }
    settles = _settling(spec, scene, plain, right, _SETTLES * shift)
    return told if settles is None else told | {"settling_time": settles}


def _even(mast: Mast, place: float) -> tuple[float, float]:
    """Deflection at a place and moment at the root at rest under an even acceleration of 1 m/s^2, one against the
    other."""
    built = mast.elements
    bent = mast.flexibility @ built.carried
    return float(built.row(place) @ bent), float(built.moment - built.righted @ bent)


def _strays(mast: Mast, place: float, base: float, rise: float, jump: float) -> tuple[float, float]:
    """How far deflection at a place and moment at the root may stray as a force or an acceleration comes up."""
    built = mast.elements
    total = built.total + base
    values, shapes = (mast.frequencies, mast.shapes) if math.isinf(base) else mast.rolling(base)
    pushed = built.carried @ shapes
    per = pushed / values**2 if math.isinf(base) else pushed / values**2 / total
    inertia = built.turned @ shapes
    if math.isfinite(base):
        inertia = inertia - built.moment * pushed / total
    strays = np.minimum(1.0, 2 / (values * rise)) if rise > 0 else np.ones(len(values))
    found = []
    for gains in ((built.row(place) @ shapes) * per, (inertia * values**2 - built.righted @ shapes) * per):
        others = float(np.abs(gains[1:]) @ strays[1:])
        first = abs(float(gains[1:].sum())) * float(strays[0])
        found.append((others + first) * abs(jump))
    return found[0], found[1]


def _above_zero(offsets: dict[str, Interval], loads: Loads) -> dict[str, Interval]:
    """Offsets that leave magnitudes and times at 0 or above."""
    return {name: Interval(max(one.low, -max(loads[name].low, 0.0)), one.high) for name, one in offsets.items()}


@kept_for(64)
def _last_pace(course: Course) -> float:
    """Acceleration with which the base came to where it was first held, whichever way it was moved [m/s^2]."""
    held = next((float(event.time) for event in course.record.events if event.element == "base"), 0.0)
    if not held > 0:
        return 0.0
    before = play(course.case, held * (1 - _JUST_BEFORE))
    forward = 1.0 if course.case.base.speed == 0 else -1.0
    return forward * float(before.record.last[before.system.watched["acceleration", 0]])


def _kicked(exact: Mast, own: Mast, place: float, moves: Happening, pace: float) -> tuple[float, float]:
    """What a base that is held a little earlier or later does to deflection and moment; its acceleration ends there."""
    base, total = moves.base.mass, exact.elements.total + moves.base.mass

    def swings(mast: Mast) -> FloatArray:
        values, shapes = mast.rolling(base)
        strays = np.minimum(1.0, 2 / (values * moves.rise)) if moves.rise > 0 else np.ones(len(values))
        return np.asarray(strays * (mast.elements.carried @ shapes) ** 2 / values)

    each, one = swings(exact), swings(own)
    speed = _KICK * moves.jump / total**2 * (float(each[1:].sum()) + abs(float(each[0] - one[0])))
    kicks = np.abs(exact.participation) * np.minimum(speed * exact.frequencies, 2 * pace)
    turned = np.abs(exact.elements.turned @ exact.shapes - exact.elements.righted @ exact.shapes / exact.frequencies**2)
    return float(np.abs(exact.at(place)) @ (kicks / exact.frequencies**2)), float(turned @ kicks)


def _settling(spec: Stacker, scene: DrivenScene, plain: Course, right: Course, doubt: float) -> Interval | None:
    """Offsets of the settling time from that of the plain run."""
    window = spec.settling.window
    if window is None or spec.column.log_decrement is None or not isinstance(scene, Brake):
        return None
    if not (plain.stays and right.stays):
        return ANYTHING
    value = at_rest(spec, scene, plain, window).time
    if math.isinf(value):
        return None
    found = at_rest(spec, scene, right, window, min(doubt, window))
    return Interval(min(found.low - value, 0.0), max(found.high - value, 0.0))


# -- weights --------------------------------------------------------------------------------------------------------


def gravity_bound(spec: Stacker, scene: StackerScene, loads: Loads) -> dict[str, Interval]:
    """What weights may change of a run without them.

    At rest the work of the weights on any shape is at most r times its strain energy, r the share of the weight that
    buckles the column, so that by Courant's principle

        w_k (1 - r)^(1/2) <= w_k' <= w_k (1 + r)^(1/2)

    where a column that hangs only gets stiffer, one that stands only softer. Of a start or stop twice the difference of
    two runs of two masses, with weights and without, its time by `time_bound`; of a collision twice what the stiffness
    changes, of the moment at the root three times. Of the contact nothing is known: it opens and closes again, and
    weights move the later blows against the swing of the column, so that the largest force may be another one.

    **Range** columns that their weights do not buckle.
    **Error** the first line is a bound, the factors of the others are calibrated on a seeded sample.
    **Source** R. Courant, Methods of mathematical physics; `laws.mast`.
    """
    if buckling_share(spec, scene) >= 1:
        return dict.fromkeys(loads, ANYTHING)
    told = weighted_frequencies(spec, scene, loads)
    if isinstance(scene, Stand):
        return told
    if isinstance(scene, ObstacleScene):
        given = swinging(spec, scene)
        rise = abs(given.weight) / given.stiffness
        factors = {"collision_force": _GRAVITY, "collision_deflection": _GRAVITY, "mast_moment_max": _MOMENT}
        for name, factor in factors.items():
            if name in loads and math.isfinite(loads[name].value):
                size = factor * rise * loads[name].value
                told[name] = Interval(-min(size, max(loads[name].low, 0.0)), size)
        if "contact_force" in loads:
            told["contact_force"] = ANYTHING
        return bounds_of_derived(spec, scene, loads, told)
    assert isinstance(scene, DrivenScene)
    try:
        told |= {name: offset for name, offset in _weighted(spec, scene).items() if name in loads}
    except NumericsError:
        return {**_unknown_swing(spec, scene, loads), **told}
    told |= time_bound(spec, scene, loads)
    return bounds_of_derived(spec, scene, loads, _above_zero(told, loads))


def weighted_frequencies(spec: Stacker, scene: StackerScene, loads: Loads) -> dict[str, Interval]:
    """What weights may do to frequencies, the first line of `gravity_bound`, and to the stiffness at the far end, which
    is that of the shape with the least energy, so that c (1 - r) <= c' <= c (1 + r); a guide at the head only adds to
    the strain energy that they are compared with.

    **Range** columns that their weights do not buckle; of others nothing is known.
    **Error** a bound.
    **Source** R. Courant, Methods of mathematical physics.
    """
    share, told = buckling_share(spec, scene), {}
    low, high = (0.0, share) if model.hangs(spec) else (-share, 0.0)
    for name, one in loads.items():
        if not name.startswith(("natural_frequency", "period", "column_stiffness")):
            continue
        if share >= 1:
            told[name] = ANYTHING
        elif name == "column_stiffness":
            told[name] = Interval(one.value * low, one.value * high)
        elif name == "period":
            told[name] = Interval(one.value * (1 / math.sqrt(1 + high) - 1), one.value * (1 / math.sqrt(1 + low) - 1))
        else:
            told[name] = Interval(one.value * (math.sqrt(1 + low) - 1), one.value * (math.sqrt(1 + high) - 1))
    return told


def guided_frequencies(spec: Stacker, scene: DrivenScene, loads: Loads) -> dict[str, Interval]:
    """What a guide without play at the head of the column does to frequencies: it is one spring more, and between the
    modes of the column with it and without it lies none of either.

        w_k <= w_k' <= w_(k+1)

    **Range** a guide that travels with the base; with play a small swing does not touch it.
    **Error** a bound.
    **Source** Rayleigh's theorem on one constraint.
    """
    guide = spec.column.top_guide
    if guide is None or guide.stiffness is None or guide.gap:
        return {}
    push = travelling.push_of(spec, scene)
    one = swinging(spec, scene, push.rotors)
    free = one.exact if push.kind == "force" else one.held
    told = {}
    for k, mode in enumerate(MODES, 1):
        name = of("natural_frequency", mode)
        if name in loads:
            told[name] = Interval(0.0, max(mast_modes.mast_frequency(free, k + 1) - loads[name].value, 0.0))
    if "period" in loads:
        shortest = 2 * math.pi / mast_modes.mast_frequency(free, 2)
        told["period"] = Interval(min(shortest - loads["period"].value, 0.0), 0.0)
    return told


def time_bound(spec: Stacker, scene: DrivenScene, loads: Loads) -> dict[str, Interval]:
    """What the swing of the column, with its weights, may make of the time of a start or a stop.

    **Range** every start and stop; without end where something holds the head, or the base may slip again.
    **Error** a bound: `starts.time` takes the softer of the columns with weights and without.
    **Source** momentum; `starts.time`.
    """
    assert isinstance(scene, Start | Brake)
    ends, told = starts.time(spec, scene), {}
    for name in ("start_time", "brake_time"):
        if name in loads:
            low, high = loads[name].low, loads[name].high
            told[name] = Interval(
                0.0 if low <= ends.low else ends.low - low, 0.0 if high >= ends.high else ends.high - high
            )
    if "brake_time" in told and not starts.stands_at_once(spec, scene):
        told["brake_time"] = Interval(told["brake_time"].low, math.inf)
    return told


def _weighted(spec: Stacker, scene: DrivenScene) -> dict[str, Interval]:
    plain, heavy = (course_of(spec, scene, gravity=gravity) for gravity in (False, True))
    stiffness = swinging(spec, scene).stiffness
    shift, turn = (
        _GRAVITY * abs(plain.largest(what)[0] - heavy.largest(what)[0]) + _LEAST * heavy.largest(what)[0] * share
        for what, share in (("deflection", _weight_share(spec, scene)), ("moment", _weight_share(spec, scene)))
    )
    told = {
        "mast_deflection_max": Interval(-shift, shift),
        "mast_force_max": Interval(-stiffness * shift, stiffness * shift),
        "mast_moment_max": Interval(-turn, turn),
    }
    settles = _settling(spec, scene, plain, heavy, shift)
    if settles is None:
        return told
    swing = math.pi / float(heavy.case.mast.frequencies[0])  # it settles from swing to swing
    return told | {"settling_time": Interval(settles.low - swing, settles.high + swing)}


def _weight_share(spec: Stacker, scene: DrivenScene) -> float:
    """What weights add to the stiffness, or take from it, as a share of it."""
    given = swinging(spec, scene)
    return abs(given.weight) / given.stiffness
