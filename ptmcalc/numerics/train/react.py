"""What follows an event: the contact state that holds from now on.

Links and drives go to the next state of the guard that crossed. Whatever is at rest under friction is tried: held
first, then moving either way; the first combination whose guards all stay at 0 or above just after the event is
taken. The sign of a guard is that of its first derivative that is not 0 (`Look.sides`), so a combination that would
break at once is never taken, and static friction is set-valued, not a steep slope.
"""

import itertools
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ptmcalc.base.errors import NumericsError
from ptmcalc.numerics.motion import Look, Reaction
from ptmcalc.numerics.piecewise import JAMMED
from ptmcalc.numerics.record import Event
from ptmcalc.numerics.train import drives, links
from ptmcalc.numerics.train.parts import RIGID, Governed
from ptmcalc.numerics.train.signals import FloatArray, Now, Signal
from ptmcalc.numerics.train.state import NO_FRICTION, Change, State

if TYPE_CHECKING:
    from ptmcalc.numerics.train.system import TrainSystem

_FRICTION = ("turning", "slip", "hold")
_TRIED = (0, 1, -1)
"""Held first, then moving either way."""
_MOST_CHANGES = 100
_SETTLED = 1e-12
_ROUNDING = 8 * float(np.finfo(float).eps)
_AT_REST = 1e-13
"""Share of the largest speed in the train below which a speed after an event is 0."""
STICKS_BELOW = 1e-14
"""Speed of a rebound, as a share of the first impact's, below which a rigid contact stays shut (Zeno)."""
_LAST_DIGITS = 1e-14
_LEAST_LOSS = 1e-6
"""Share of its energy that a bounce loses at least, where it is asked how low rounding lets it fall."""
_TURNING = {1: "forward", -1: "backward", 0: "at rest", 2: "free"}
_SLIPPING = {1: "slips forward", -1: "slips backward", 0: "locked"}
_LIMITED = {1: "at its limit", -1: "at its limit backward", 0: "in control"}
_WORDS = {"whole": "closed", "firm": "closed", "over": "closed", "shut": "closed", "lift": "open", "open": "open"}


class Reactor:
    """Finds the state after an event."""

    def __init__(self, system: "TrainSystem", state: State, time: float, z: FloatArray) -> None:
        self.system, self.state, self.time, self.z = system, state, time, z.copy()
        self.before, self.lost = state, 0.0
        self.resting = {group for group, turn in enumerate(state.turning) if turn == 0}
        self.locked = {index for index, slip in zip(system.clutches, state.clutches, strict=True) if slip == 0}
        self.jammed: list[Event] = []

    def go(self, fired: int | None) -> Reaction:
        """The reaction to a guard that crossed, or to a break of time."""
        if fired is None:
            self._breaks()
        else:
            self._apply(self.system.changes(self.state)[fired])
        for _ in range(_MOST_CHANGES):
            self._calm()
            broken = self._grip()
            if not broken:
                break
            self._apply(broken[0])
        else:
            raise NumericsError("NUM101", f"no contact state holds at {self.time:.9g} s")
        return Reaction(self.state, self.z, self._events(), self.lost, self._over())

    def _over(self) -> bool:
        system = self.system
        if not system.train.rest_ends:
            return False
        waiting = system.next_break(self.state, self.time) < float("inf")
        return not waiting and all(turn == 0 for turn in self.state.turning)

    # -- time ----------------------------------------------------------------------------------------------------

    def _breaks(self) -> None:
        system, time = self.system, self.time
        pieces = list(self.state.signals)
        for index, (signal, now) in enumerate(zip(system.signals, pieces, strict=True)):
            if now.piece >= 0:
                since = time - now.start + 4 * np.finfo(float).eps * time
                pieces[index] = Now(max(signal.piece(since), now.piece), now.start)
                if signal.decay and abs(time - now.start - signal.decay_start) <= 1e-12 * time:
                    self.z[system.own + system.inputs.decay_index(signal)] = 1.0
        self.state = self.state._replace(signals=tuple(pieces))
        for index, (drive, one) in enumerate(zip(system.train.drives, self.state.drives, strict=True)):
            if drives.stage_breaks(drive, one) <= time:
                self._stage(index, one[0] + 1)
        self._impulses()

    def _impulses(self) -> None:
        speeds = self.system.speed @ self.z
        hit = [one for one in self.system.train.impulses if one.time == self.time]
        for impulse in hit:
            group = self.system.groups.of[impulse.body]
            if group not in self.system.guided:
                inertia = self.system.groups.inertias(self.system.train)[group]
                speeds[group] += impulse.size * self.system.groups.ratio[impulse.body] / inertia
        if hit:
            self._set_speeds(speeds)
            self._collide()

    def _set_speeds(self, speeds: FloatArray) -> None:
        """New speeds of the groups; the energy that goes with the change is entered as lost (or brought in)."""
        system, old = self.system, self.system.speed @ self.z
        before = system.energy(self.state, self.z)
        self._put(speeds)
        self.lost += before - system.energy(self.state, self.z)
        change = np.abs(speeds - old)
        struck = change > _AT_REST * float(np.maximum(np.abs(speeds), np.abs(old)).max(initial=0.0))
        self.resting -= set(np.flatnonzero(struck).tolist())
        of = system.groups.of
        self.locked -= {
            index
            for index, grip in ((index, system.train.grips[index]) for index in system.clutches)
            if struck[of[grip.first]] or struck[of[grip.second or 0]]
        }

    # -- single elements ---------------------------------------------------------------------------------------

    def _apply(self, change: Change) -> None:
        if change.kind == "contact":
            self._contact(change.index, change.to)
        elif change.kind == "drive":
            self._drive(change.index, change.to)
        elif change.kind == "signal":
            self._start(self.system.signals[change.index], change.index)
        elif change.kind == "turning":
            self._stop(change.index)
        elif change.kind == "slip":
            self._meet(change.index)

    def _contact(self, index: int, to: links.Contact) -> None:
        spring = self.system.train.springs[index]
        self._set_contact(index, to)
        if spring.law == RIGID and to[0] == "shut":
            self._collide(index)

    def _set_contact(self, index: int, to: links.Contact) -> None:
        contacts = list(self.state.contacts)
        contacts[index] = to
        self.state = self.state._replace(contacts=tuple(contacts))

    def _collide(self, met: int | None = None) -> None:
        """Velocities after an impact: v' = -e v at every rigid contact that is closed (or was `met`) and closing, by
        impulses between its bodies that only push. Contacts that are closed when struck act at once.

            v' = v - W p,   p >= 0,   v' + e max(v, 0) <= 0,   p (v' + e max(v, 0)) = 0

        **Source** Newton's law of impact; Moreau, Unilateral contact and dry friction, 1988.
        """
        system, state = self.system, self.state
        springs = system.train.springs
        shut = [index for index, (phase, _) in enumerate(state.contacts) if phase == "shut"]
        if not shut:
            return
        speeds = system.speed @ self.z
        sides = [state.contacts[index][1] for index in shut]
        rows = np.array(
            [
                side * system.groups.row(springs[index].first, springs[index].second)
                for index, side in zip(shut, sides, strict=True)
            ]
        )
        closing, largest = rows @ speeds, np.abs(rows) @ np.abs(speeds)
        closing[np.abs(closing) <= _AT_REST * largest] = 0.0
        rebound = np.maximum(closing, 0.0) * [springs[index].restitution for index in shut]
        for place, index in enumerate(shut):
            first = system.first_impacts[index] = max(system.first_impacts.get(index, 0.0), closing[place])
            if rebound[place] <= STICKS_BELOW * first or self._invisible(index, rebound[place]):
                rebound[place] = 0.0
        inertia = system.groups.inertias(system.train)
        mobile = np.array([0.0 if group in system.guided else 1.0 for group in range(len(inertia))]) / inertia
        push, after = _pushes((rows * mobile) @ rows.T, closing, rebound, self.time)
        if closing.max() > 0:
            self._set_speeds(speeds - mobile * (push @ rows))
        for place, (index, side) in enumerate(zip(shut, sides, strict=True)):
            at = system.coordinates.places[index]
            if after[place] < 0:
                self._set_contact(index, links.OPEN)
            elif at is not None and (index == met or push[place] > 0):
                self.z[system.groups.count + at] = 0.0
            if index == met and at is not None and after[place] >= 0:
                self.z[at] = side * springs[index].play / 2

    def _invisible(self, index: int, rebound: float) -> bool:
        """Whether a rebound v is lower than rounding sees: v^2/(2 a) under the last digits of the position, or under
        the dust beside the largest state (`Look`).

        A guard is seen to cross when it is below 0 by its dust d, so every impact comes with 2 a d too much of v^2, and
        bounces that lose a share 1 - e^2 of it would go on for ever at a height of d e^2/(1 - e^2).
        """
        system, spring = self.system, self.system.train.springs[index]
        of, count = system.stretches[index], system.groups.count
        motion = system.motion(self.before)
        back = abs(float(of.rate[count : system.own] @ (motion.rate @ self.z)[count : system.own]))
        size = float(np.abs(of.x) @ np.abs(self.z)) + spring.play
        dust = float(np.abs(of.x[: system.own]) @ Look(system, self.z).dust)
        hidden = _LAST_DIGITS * size + 2 * dust / max(1 - spring.restitution**2, _LEAST_LOSS)
        return rebound**2 <= 2 * back * hidden

    def _drive(self, index: int, to: drives.DriveState) -> None:
        if to[0] != self.state.drives[index][0]:
            self._stage(index, to[0])
            return
        states = list(self.state.drives)
        states[index] = to
        self.state = self.state._replace(drives=tuple(states))

    def _stage(self, index: int, number: int) -> None:
        drive = self.system.train.drives[index]
        states = list(self.state.drives)
        states[index] = (number, drives.law_now(drive.stages[number].law, *self.system.seen(self.z, drive.body)))
        self.state = self.state._replace(drives=tuple(states))

    def _start(self, signal: Signal, index: int) -> None:
        pieces = list(self.state.signals)
        pieces[index] = Now(0, self.time)
        self.state = self.state._replace(signals=tuple(pieces))
        if signal.decay and signal.decay_start == 0:
            self.z[self.system.own + self.system.inputs.decay_index(signal)] = 1.0

    # -- friction ---------------------------------------------------------------------------------------------

    def _stop(self, group: int) -> None:
        """A group whose speed crossed 0 stands still."""
        self.resting.add(group)

    def _meet(self, clutch: int) -> None:
        """The sides of a clutch whose slip crossed 0 turn alike."""
        self.locked.add(clutch)

    def _calm(self) -> None:
        """What is at rest or locked, and was not struck, is so to the last digit, with all that is tied to it.

        Left alone where rounding already hides what is missing, for to put it right moves all other speeds by rounding.
        """
        system = self.system
        key = (frozenset(self.resting), frozenset(self.locked), self.state.contacts)
        ties = system.ties.get(key)
        if ties is None:
            ties = system.ties[key] = self._ties()
        joined, zeros, sizes = ties
        if not len(zeros) or (np.abs(zeros @ self.z) <= sizes @ np.abs(self.z)).all():
            return
        speeds = system.speed @ self.z
        grounded = {int(np.flatnonzero(row)[0]) for row in joined if np.count_nonzero(row) == 1}
        still = sorted(self.resting | grounded)
        speeds[still] = 0.0
        reached = set(still)
        for anchor in (*still, *system.guided, *range(len(speeds))):
            waiting = [anchor]
            reached.add(anchor)
            while waiting:
                here = waiting.pop()
                for row in (row for row in joined if row[here]):
                    for there in set(np.flatnonzero(row).tolist()) - reached:
                        speeds[there] = -row[here] / row[there] * speeds[here]
                        reached.add(there)
                        waiting.append(there)
        self._put(speeds)

    def _ties(self) -> "Ties":
        system, train = self.system, self.system.train
        joined = [system.groups.row(train.grips[index].first, train.grips[index].second) for index in self.locked]
        joined += [
            system.groups.row(spring.first, spring.second)
            for spring, (phase, _) in zip(train.springs, self.state.contacts, strict=True)
            if phase == "shut"
        ]
        zeros = np.array([*system.speed[sorted(self.resting)], *(system.apart(row) for row in joined)])
        return Ties(joined, zeros, _ROUNDING * np.abs(zeros))

    def _put(self, speeds: FloatArray) -> None:
        """The state with these speeds; a coordinate that cancels to rounding is 0, or its sign would mean something."""
        count, inverse = self.system.groups.count, self.system.coordinates.inverse
        rates = inverse @ speeds
        rates[np.abs(rates) <= _ROUNDING * (np.abs(inverse) @ np.abs(speeds))] = 0.0
        self.z[count : self.system.own] = rates

    def _grip(self) -> list[Change]:
        """Choose what holds and what slips, so that every guard of friction and of the meshes holds on.

        Returns the other guards that do not.
        """
        for _ in range(2):
            look = Look(self.system, self.z)
            for candidate in self._candidates():
                fitted = self._with_signs(candidate, look)
                if fitted is not None:
                    self.state, broken = fitted
                    return broken
            self._jam()
        raise NumericsError("NUM101", f"no state of friction holds at {self.time:.9g} s")

    def _candidates(self) -> Iterator[State]:
        """Every way in which what is at rest and what does not slip could go on, held first."""
        system, state = self.system, self.state
        speeds = (system.speed @ self.z).tolist()
        largest = max(map(abs, speeds), default=0.0)
        system.fastest = max(system.fastest, largest)
        ways: list[tuple[int, ...]] = []
        for group, (turn, speed) in enumerate(zip(state.turning, speeds, strict=True)):
            beside = system.fastest if group in system.guided else largest
            if turn == NO_FRICTION:
                ways.append((NO_FRICTION,))
            else:
                ways.append(_TRIED if group in self.resting or abs(speed) <= _AT_REST * beside else (_sign(speed),))
        for index, row in system.clutch_rows.items():
            apart = float(row @ speeds)
            met = index in self.locked or abs(apart) <= _AT_REST * largest
            ways.append(_TRIED if met else (_sign(apart),))
        key = (state, tuple(ways))
        known = system.candidates.get(key)
        if known is None:
            known = system.candidates[key] = Candidates(_combined(system.clutch_rows, state, ways))
        return iter(known)

    def _with_signs(self, state: State, look: Look) -> tuple[State, list[Change]] | None:
        """The candidate with signs of its mesh torques that agree with the motion, and the other guards it breaks.

        None where friction itself does not hold in it.
        """
        system = self.system
        others = itertools.product((1, -1), repeat=len(system.lossy)) if system.locking else ()
        for signs in itertools.chain([state.meshes], others):
            tried = state._replace(meshes=tuple(signs))
            for _ in range(4 ** len(system.lossy) + 1):
                motion, changes = system.described(tried)
                sides = zip(look.told(motion), changes, strict=True)
                broken = [change for side, change in sides if side < 0]
                wrong = [one for one in broken if one.kind == "mesh"][:1]
                wrong += [one for one in broken if one.kind == "released"]
                if not wrong:
                    if not any(one.kind in _FRICTION for one in broken):
                        return tried, broken
                    break
                for one in wrong:
                    tried = _flipped(tried, one)
        return None

    def _jam(self) -> None:
        """A mesh that cannot be driven at all stops its bodies at once."""
        system = self.system
        speeds = system.speed @ self.z
        for index in system.lossy:
            mesh = system.train.meshes[index]
            group = system.groups.of[mesh.inner]
            if mesh.reverse < 0 and speeds[group] != 0:
                speeds[group] = 0.0
                self.jammed.append(Event(self.time, mesh.name, "turning", JAMMED))
        if self.jammed:
            self._set_speeds(speeds)
            self._collide()

    # -- what happened ----------------------------------------------------------------------------------------

    def _events(self) -> tuple[Event, ...]:
        if self.before == self.state:
            return (*self.jammed,)
        words = self.system.words.get((self.before, self.state))
        if words is None:
            words = self.system.words[self.before, self.state] = [one for one in self._words() if one[1] != one[2]]
        return (*self.jammed, *(Event(self.time, *one) for one in words))

    def _words(self) -> Iterator[tuple[str, str, str]]:
        """Element, state before and state after, of everything."""
        system, train, old, new = self.system, self.system.train, self.before, self.state
        for spring, was, now in zip(train.springs, old.contacts, new.contacts, strict=True):
            yield spring.name, _contact_word(was), _contact_word(now)
        for group, (turned, turns) in enumerate(zip(old.turning, new.turning, strict=True)):
            yield system.friction_name(group), _TURNING[turned], _TURNING[turns]
        for index, slipped, slips in zip(system.clutches, old.clutches, new.clutches, strict=True):
            yield train.grips[index].name, _SLIPPING[slipped], _SLIPPING[slips]
        for drive, was_drive, now_drive in zip(train.drives, old.drives, new.drives, strict=True):
            stages = (was_drive[0], now_drive[0])
            yield drive.name, f"stage {stages[0] + 1}", f"stage {stages[1] + 1}"
            if isinstance(drive.stages[now_drive[0]].law, Governed) and stages[0] == stages[1]:
                yield drive.name, _LIMITED[was_drive[1]], _LIMITED[now_drive[1]]
        for signal, was_now, now_now in zip(system.signals, old.signals, new.signals, strict=True):
            if signal.trigger is not None:
                before, after = ("waiting" if one.piece < 0 else "started" for one in (was_now, now_now))
                yield system.signal_name(signal), before, after


class Ties(NamedTuple):
    """What is at rest, locked or shut: what is joined (rows over the groups), what is 0 (functionals), its rounding."""

    joined: list[FloatArray]
    zeros: FloatArray
    rounding: FloatArray


class Candidates:
    """Contact states to try in this order, each made when it is first asked for."""

    def __init__(self, states: Iterator[State]) -> None:
        self._made: list[State] = []
        self._others = states

    def __iter__(self) -> Iterator[State]:
        yield from self._made
        for state in self._others:
            self._made.append(state)
            yield state


def _sign(value: float) -> int:
    return (value > 0) - (value < 0)


def _combined(clutches: Mapping[int, FloatArray], state: State, options: list[tuple[int, ...]]) -> Iterator[State]:
    """The contact states of all ways; a clutch between two groups at rest slips as they begin to move."""
    count = len(state.turning)
    pairs = [(place, _ends(row)) for place, row in enumerate(clutches.values(), count)]
    between = [(place, ends) for place, ends in pairs if all(options[group] == _TRIED for group, _ in ends)]
    for ways in itertools.product(*options):
        if all(_agrees(ways[place], [ways[group] * side for group, side in ends]) for place, ends in between):
            yield state._replace(turning=ways[:count], clutches=ways[count:])


def _ends(row: FloatArray) -> list[tuple[int, int]]:
    """Groups in a row with the signs they have in it."""
    return [(int(group), int(np.sign(row[group]))) for group in np.flatnonzero(row)]


def _agrees(slip: int, ways: list[int]) -> bool:
    """Whether a clutch can slip this way while its two sides begin to move so from rest."""
    return ways[0] * ways[1] < 0 or slip == int(np.sign(sum(ways)))


def _contact_word(contact: links.Contact) -> str:
    phase, side = contact
    word = _WORDS[phase]
    return word if word == "open" or side > 0 else f"{word} backward"


def _flipped(state: State, change: Change) -> State:
    """The state with another sign of the torque through a mesh."""
    if change.kind == "mesh":
        meshes = tuple(-sign if i == change.index else sign for i, sign in enumerate(state.meshes))
        return state._replace(meshes=meshes)
    return state._replace(released=state.released ^ {(change.to, change.index)})


def _pushes(
    mobility: FloatArray, closing: FloatArray, rebound: FloatArray, time: float
) -> tuple[FloatArray, FloatArray]:
    """Impulses of closed rigid contacts, and the closing speeds after them."""
    count = len(closing)
    small = _SETTLED * float(np.abs(closing).max())
    for size in range(count, -1, -1):
        for pushing in itertools.combinations(range(count), size):
            push, active = np.zeros(count), list(pushing)
            wanted = (closing + rebound)[active]
            push[active] = np.linalg.lstsq(mobility[np.ix_(active, active)], wanted, rcond=1e-13)[0]
            speed = closing - mobility @ push
            excess = speed + rebound
            excess[np.abs(excess) <= small] = 0.0
            worth = mobility.diagonal() * push
            if (excess <= 0).all() and (excess[active] == 0).all() and (worth >= -small).all():
                speed[np.abs(speed) <= small] = 0.0
                return push, speed
    raise NumericsError("NUM101", f"prescribed motions drive bodies into each other at {time:.9g} s")
