"""What is rigidly geared moves as one; coordinates in which no link force reaches the travel of the whole."""

from dataclasses import dataclass

import numpy as np

from ptmcalc.numerics.train.parts import Spring, Train
from ptmcalc.numerics.train.signals import FloatArray


@dataclass(frozen=True, slots=True)
class Groups:
    """Bodies that rigid gears tie together: the group of each body, and its speed over the group's."""

    of: tuple[int, ...]
    ratio: FloatArray
    count: int

    @classmethod
    def among(cls, train: Train) -> "Groups":
        """The groups of a train.

        Raises:
            ValueError: a mesh closes a loop of gears.
        """
        of, ratio = list(range(len(train.bodies))), np.ones(len(train.bodies))
        for mesh in train.meshes:
            inner, outer = of[mesh.inner], of[mesh.outer]
            if inner == outer:
                raise ValueError(f"{mesh.name} closes a loop of gears")
            factor = ratio[mesh.inner] / mesh.ratio / ratio[mesh.outer]
            for body, group in enumerate(of):
                if group == outer:
                    of[body], ratio[body] = inner, ratio[body] * factor
        names = {group: index for index, group in enumerate(dict.fromkeys(of))}
        return cls(tuple(names[group] for group in of), ratio, len(names))

    def row(self, first: int, second: int | None) -> FloatArray:
        """Speed of a body less that of another, over the speeds of the groups."""
        row = np.zeros(self.count)
        row[self.of[first]] += self.ratio[first]
        if second is not None:
            row[self.of[second]] -= self.ratio[second]
        return row

    def link(self, spring: Spring) -> FloatArray:
        """Rate of a link's extension over the speeds of the groups."""
        row = self.row(spring.first, spring.second)
        if spring.over is not None:
            row[self.of[spring.over]] -= self.ratio[spring.over]
        return row

    def inertias(self, train: Train) -> FloatArray:
        """Inertia of each group at its own speed, without losses."""
        weights = np.array([body.inertia for body in train.bodies]) * self.ratio**2
        total: FloatArray = np.bincount(self.of, weights, self.count).astype(float)
        return total


@dataclass(frozen=True, slots=True)
class Coordinates:
    """Extensions of the links that span the train, and for every part that can travel its mean position.

        y = inverse theta,   theta = basis y

    The mean is weighted with inertia: forces between the bodies of a part cancel in it, so travel and vibration do not
    mix and the frequency of travel is 0, not the root of a rounding error.
    """

    basis: FloatArray
    inverse: FloatArray
    travels: int
    """number of parts that can travel"""
    places: tuple[int | None, ...]
    """for every spring the coordinate that is its extension, if one is"""

    @classmethod
    def of(cls, train: Train, groups: Groups) -> "Coordinates":
        inertia = groups.inertias(train)
        shape = np.ones(groups.count)
        part = list(range(groups.count))
        grounded = [False] * groups.count
        rows: list[FloatArray] = []
        places: list[int | None] = []
        for spring in train.springs:
            place = _spans(spring, groups, part, shape, grounded)
            places.append(len(rows) if place else None)
            if place:
                rows.append(groups.link(spring))
        free = [one for one in dict.fromkeys(part) if not grounded[one]]
        for one in free:
            inside = np.array([member == one for member in part])
            weighted = np.where(inside, shape * inertia, 0.0)
            rows.append(weighted / float(weighted @ shape))
        inverse = np.array(rows).reshape(groups.count, groups.count)
        return cls(np.asarray(np.linalg.inv(inverse), float), inverse, len(free), tuple(places))


def _spans(spring: Spring, groups: Groups, part: list[int], shape: FloatArray, grounded: list[bool]) -> bool:
    """Whether a spring joins what was apart; then its parts are made one. `shape` is the travel of each group in it.

    Raises:
        ValueError: what a link runs over can travel.
    """
    if spring.over is not None and not grounded[part[groups.of[spring.over]]]:
        raise ValueError(f"what {spring.name} runs over is not held by a link before it")
    row = groups.row(spring.first, spring.second)
    first = groups.of[spring.first]
    second = first if spring.second is None else groups.of[spring.second]
    if part[first] == part[second]:
        if grounded[part[first]] or abs(float(row @ shape)) <= 1e-12 * float(np.abs(row) @ np.abs(shape)):
            return False
        grounded[part[first]] = True
        return True
    if grounded[part[first]] and grounded[part[second]]:
        return False
    old, new = part[second], part[first]
    factor = -row[first] * shape[first] / (row[second] * shape[second])
    for group, one in enumerate(part):
        if one == old:
            part[group], shape[group] = new, shape[group] * factor
    grounded[new] = grounded[new] or grounded[old]
    return True
