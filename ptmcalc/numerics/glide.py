"""Long panels over what moves fast: the slow part is resolved, the fast one lies within its envelope.

A gear as stiff as a wall rings at 1e5 times the frequency of the rope behind it and is heard long after it has ceased
to matter. Where no guard can reach 0 with the whole envelope against it, a panel may be as long as the slow part
allows; a summit is looked for only where the slow part and the envelope could top the highest value found.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ptmcalc.numerics.flow import Flow
from ptmcalc.numerics.panels import NODES, TO_BERNSTEIN, WEIGHTS, FloatArray


class Bands(NamedTuple):
    """Where guards and signals lie in each of some panels."""

    nodes: FloatArray
    """at their nodes, shape (panels, nodes, rows)"""
    low: FloatArray
    high: FloatArray
    """bounds of all they come to in between, shape (panels, rows)"""
    envelope: FloatArray
    """how much of the bounds is the fast part, shape (panels, rows)"""

    def part(self, panels: slice, first: int = 0) -> "Bands":
        """Some of the panels, without the rows before `first`."""
        return Bands(*(one[panels, ..., first:] for one in self))


class Glide:
    """The long panels of a flow."""

    def __init__(self, flow: Flow) -> None:
        self.flow = flow
        self._rows = np.concatenate([flow.guards, flow.watch])
        self._lengths: dict[float, _Length | None] = {}

    def bands(self, panel: float, states: FloatArray) -> Bands | None:
        """Where all rows lie in panels of one length from these states on; None where the length is too long for a
        component that cannot be told from the others.

            row(t) = slow(t) + Re sum_j a_j e^(lambda_j t) s_j
            |row - slow| <= sum_j |a_j| |s_j| max(1, |e^(lambda_j h)|)

        with j over the components that the panel does not resolve; the slow part lies between the Bernstein
        coefficients of its polynomial.
        """
        length = self._length(panel)
        if length is None:
            return None
        nodes = np.matmul(states, length.seen).transpose(1, 0, 2)
        found = self.flow.components.amplitudes(states)[:, length.fast]
        fast = np.matmul(found[:, None, :] * length.turned, length.shapes).real
        envelope = (np.abs(found) * length.growth) @ length.sights
        coefficients = np.matmul(TO_BERNSTEIN, nodes - fast)
        low, high = coefficients.min(axis=1) - envelope, coefficients.max(axis=1) + envelope
        return Bands(nodes, low, high, envelope)

    def clear(self, bands: Bands, states: FloatArray) -> int:
        """How many panels in a row no guard can reach 0 in; `states` are those between them, both ends among them."""
        low = bands.low[:, : len(self.flow.guards)] < -self.flow.noise(states)
        reached: NDArray[np.bool_] = np.any(low, axis=1)
        return int(reached.argmax()) if reached.any() else len(reached)

    def watched(self, bands: Bands, panels: slice = slice(None)) -> Bands:
        """The signals in some of the panels, without the guards."""
        return bands.part(panels, len(self.flow.guards))

    def _length(self, panel: float) -> "_Length | None":
        if panel not in self._lengths:
            self._lengths[panel] = self._measured(panel)
        return self._lengths[panel]

    def _measured(self, panel: float) -> "_Length | None":
        components = self.flow.components
        fast = components.speeds * panel > self.flow.resolved * (1 + 1e-9)
        if (fast & ~components.posed).any() or self.flow.input_speed * panel > self.flow.resolved * (1 + 1e-9):
            return None
        seen = (self._rows @ self.flow.chunk(panel).at_nodes).transpose(0, 2, 1)
        turned = np.exp(components.values[fast] * panel * NODES[:, None])
        growth = np.maximum(1.0, np.abs(turned[-1]))
        return _Length(fast, seen, turned, growth, components.shapes[fast], components.sights[fast])

    def works(self, squares: dict[float, FloatArray], products: NDArray[np.intp]) -> FloatArray:
        """Integrals of products of signals over panels that were passed, shape (products,); of the panels of each
        length the sum of z z^T over the states they start from.

            sum z^T W(2 h) z = tr(W(h) (Q + E Q E^T)),   Q = sum z z^T,   W(h) = h sum_i w_i (r_a E_i)^T (r_b E_i)

        handed down to panels that resolve everything, whose quadrature is the same for all products.
        """
        waiting, found = dict(squares), np.zeros(len(products))
        first, second = products.T
        while waiting:
            length = max(waiting)
            square = waiting.pop(length)
            if length > self.flow.finest:
                change = self.flow.end(length / 2) + np.eye(len(square))
                waiting[length / 2] = waiting.get(length / 2, 0.0) + square + change @ square @ change.T
                continue
            seen = np.matmul(self.flow.watch, self.flow.chunk(length).at_nodes)
            at_nodes = np.matmul(np.matmul(seen, square), seen.transpose(0, 2, 1))
            found += length * (WEIGHTS @ at_nodes[:, first, second])
        return found


@dataclass(frozen=True, slots=True)
class _Length:
    """What panels of one length need: which components they do not resolve, and how those turn."""

    fast: NDArray[np.bool_]
    seen: FloatArray
    turned: NDArray[np.complex128]
    growth: FloatArray
    shapes: NDArray[np.complex128]
    sights: FloatArray
