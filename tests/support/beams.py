"""Beams and frames of finite elements with cubic shapes: a reference that shares nothing with the laws of the
column."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def element(length: float, bending: float, mass: float, axial: float = 0.0) -> tuple[FloatArray, FloatArray]:
    """Stiffness and mass of a beam element between (shift, turn) of its ends; `axial` is a pull."""
    h = length
    k = bending / h**3 * np.array(
        [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
         [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]
    )  # fmt: skip
    g = axial / (30 * h) * np.array(
        [[36, 3 * h, -36, 3 * h], [3 * h, 4 * h * h, -3 * h, -h * h],
         [-36, -3 * h, 36, -3 * h], [3 * h, -h * h, -3 * h, 4 * h * h]]
    )  # fmt: skip
    m = mass / 420 * np.array(
        [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
         [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]]
    )  # fmt: skip
    return k + g, m


def beam(
    length: float, bending: float, mass: float, count: int, axial: float = 0.0, root_rotation: float = 0.0
) -> tuple[FloatArray, FloatArray]:
    """Cantilever: its root does not shift, and turns on a spring of compliance `root_rotation`."""
    size = 2 * (count + 1)
    k, m = np.zeros((size, size)), np.zeros((size, size))
    for i in range(count):
        at = slice(2 * i, 2 * i + 4)
        one_k, one_m = element(length / count, bending, mass / count, axial)
        k[at, at] += one_k
        m[at, at] += one_m
    k[1, 1] += 1 / root_rotation if root_rotation else 0.0
    first = 1 if root_rotation else 2
    return k[first:, first:], m[first:, first:]


def masted(one: Any, count: int) -> tuple[FloatArray, FloatArray, int | None, int]:
    """Stiffness and mass of a column with base, root, load and guide, and the rows of base and load."""
    lengths = [one.place] * (one.place < 1) + [1 - one.place if one.place < 1 else 1.0]
    nodes = sum(count for _ in lengths) + 1
    size = 2 * nodes + 1  # the base comes first
    k, m = np.zeros((size, size)), np.zeros((size, size))
    node = 0
    for share in lengths:
        for _ in range(count):
            at = slice(1 + 2 * node, 5 + 2 * node)
            one_k, one_m = element(one.length * share / count, one.flexural_stiffness, one.column_mass * share / count)
            k[at, at] += one_k
            m[at, at] += one_m
            node += 1
    load = 1 + 2 * count
    m[load, load] += one.tip_mass
    m[-2, -2] += one.top_mass
    k[-2, -2] += one.guide_stiffness
    m[1, 1] += one.root_mass
    free = np.isfinite(one.base_mass)
    if free:
        m[0, 0] += one.base_mass
    keep = list(range(size))
    join = np.eye(size)
    if one.root_translation:
        spring = 1 / one.root_translation
        k[:2, :2] += spring * np.array([[1, -1], [-1, 1]])
    else:
        join[1, 0] = 1.0
        keep.remove(1)
    if one.root_rotation:
        k[2, 2] += 1 / one.root_rotation
    else:
        keep.remove(2)
    k, m = join.T @ k @ join, join.T @ m @ join
    if not free:
        keep.remove(0)
    return k[np.ix_(keep, keep)], m[np.ix_(keep, keep)], (keep.index(0) if free else None), keep.index(load)


def frame_tip(
    column: float,
    column_moment: float,
    span: float,
    vertical: float,
    horizontal: float,
    gauge: float,
    place: float,
    ends: str,
    wheels: str,
    along: str,
    elasticity: float = 210e9,
) -> float:
    """Displacement of the tip of a column under two girders per unit force, by girders of two elements in each plane
    that are joined by a rigid trolley, written out as energies of a few shared motions."""
    rigid = 1e9

    def girder(bending: float) -> FloatArray:
        """Stiffness at the section under the trolley for (shift, turn)."""
        k = np.zeros((6, 6))
        for at, part in ((slice(0, 4), place), (slice(2, 6), span - place)):
            k[at, at] += element(part, bending, 0.0)[0]
        held = [0, 4] if ends == "supported" else [0, 1, 4, 5]
        left = [i for i in range(6) if i not in held and i not in (2, 3)]
        inner = k[np.ix_([2, 3], [2, 3])]
        if left:
            cross = k[np.ix_([2, 3], left)]
            inner = inner - cross @ np.linalg.solve(k[np.ix_(left, left)], cross.T)
        return inner

    up, side = girder(elasticity * vertical), girder(elasticity * horizontal)
    mast = element(column, elasticity * column_moment, 0.0)[0]
    if along == "trolley":  # both girders turn with the trolley, and may sag
        k = np.zeros((4, 4))  # sag, pitch, tip shift, tip turn
        k[:2, :2] += 2 * up
        root = np.zeros((4, 4))
        root[1, 1] = root[2, 2] = root[3, 3] = 1.0
        k += root.T @ mast @ root
        return float(np.linalg.solve(k, [0, 0, 1, 0])[2])
    # motions: roll of the trolley, slope of each girder, shift, yaw of the trolley, slope of the girders, tip
    k = np.zeros((8, 8))
    roll, slope_a, slope_b, shift, yaw, slope, tip, turn = range(8)
    for sign, own in ((0.5, slope_a), (-0.5, slope_b)):
        move = np.zeros((2, 8))
        move[0, roll], move[1, own] = sign * gauge, 1.0
        k += move.T @ up @ move
    across = np.zeros((2, 8))
    across[0, shift], across[1, slope] = 1.0, 1.0
    k += 2 * across.T @ side @ across
    flanges = np.zeros(8)  # the wheels' flanges keep the trolley in line with the girders
    flanges[slope], flanges[yaw] = 1.0, -1.0
    k += rigid * 1e3 * np.outer(flanges, flanges)
    if wheels == "braked":  # and the girders do not stretch as it turns
        k[yaw, yaw] += rigid * gauge**2 * 1e3
    link = np.zeros((4, 8))
    link[0, shift] = link[1, roll] = link[2, tip] = link[3, turn] = 1.0
    k += link.T @ mast @ link
    return float(np.linalg.solve(k, np.eye(8)[tip])[tip])
