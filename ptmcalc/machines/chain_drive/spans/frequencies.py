"""Transverse natural frequencies of the free spans of a drive, compared with teeth and shafts."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ptmcalc.base.estimate import Estimate
from ptmcalc.contract.result import Found, Result
from ptmcalc.contract.solver import Fidelity, Solver
from ptmcalc.laws import sag
from ptmcalc.laws.threadline import transverse_frequency
from ptmcalc.machines.chain_drive.machine.layout import TwoShafts
from ptmcalc.machines.chain_drive.machine.model import filled, span, tail_teeth, useful_pull
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run

FloatArray = NDArray[np.float64]

SPANS = ("slack", "tight")


def excitations(spec: ChainDrive) -> Mapping[str, float]:
    """Frequencies that excite the spans of a drive: tooth engagement and the rotation of both shafts [Hz].

    Both sprockets engage their teeth at the same frequency z n = v/p.
    """
    teeth = spec.speed / spec.chain.pitch
    return {
        "teeth": teeth,
        "drive shaft": teeth / spec.sprocket.teeth,
        "driven shaft": teeth / tail_teeth(spec),
    }


def run(spec: ChainDrive, scene: Run, carried: frozenset[str], level: int) -> Result:
    """Natural frequencies of both spans, and the nearest frequency of teeth and shafts.

        f_k = (k/(2 l)) (P/q)/(P/q + v^2)^(1/2),   P = q g l/(8 h) for the slack span, plus F for the tight one

        d = min over k and f of |f/f_k - 1|,   f = v/p, n_1, n_2

    **Range** drives between shafts in steady running, unsupported spans.
    **Error** the sag h changes in service: the error bar covers all values between its ends. The curvature of the slack
    span raises odd modes in its own plane (`laws.threadline`).
    **Source** `laws.threadline.transverse_frequency`; `laws.sag.tension_at_sag`.
    """
    asked, layout = spec.checks.span_resonance, spec.layout
    if asked is None or not isinstance(layout, TwoShafts):
        return Result({}, work=1)
    orders, pull = np.arange(1, asked.modes + 1), useful_pull(spec) if scene.load == "full" else 0.0
    found = {}
    for name, added in zip(SPANS, (0.0, pull), strict=True):
        middle, slowest, fastest = (
            _frequencies(spec, orders, depth, added)
            for depth in (layout.slack_sag, filled(layout.slack_sag_most), filled(layout.slack_sag_least))
        )
        found[f"span_frequency_{name}"] = Found(_between(middle[0], slowest[0], fastest[0]))
        found[f"span_separation_{name}"] = _separation(excitations(spec), middle, slowest, fastest)
    return Result(found, work=1)


def _frequencies(spec: ChainDrive, orders: NDArray[np.int64], depth: float, added: float) -> FloatArray:
    """Of a span whose slack side sags by `depth`, with a tension `added` to that of the slack side [Hz]."""
    length, mass = span(spec), spec.chain.mass
    tension = sag.tension_at_sag(mass * spec.gravity * length, depth) + added
    return transverse_frequency(orders, length, mass, tension, spec.speed)


def _between(value: float, low: float, high: float) -> Estimate:
    low, high = min(low, value), max(high, value)
    return Estimate(value, low, high, model=max(value - low, high - value))


def _separation(excited: Mapping[str, float], middle: FloatArray, slowest: FloatArray, fastest: FloatArray) -> Found:
    """Smallest relative distance of an excitation from a mode, with the nearest pair in the note.

    Between its ends, the frequency of a mode takes every value: the distance reaches 0 where an excitation is between.
    """
    force = np.array(list(excited.values()))[:, None]
    now, least, most = (np.abs(force / one - 1) for one in (middle, slowest, fastest))
    inside = (force >= slowest) & (force <= fastest)
    low = float(np.where(inside, 0.0, np.minimum(np.minimum(least, most), now)).min())
    high = float(np.maximum(np.maximum(least, most), now).min())
    row, column = np.unravel_index(int(now.argmin()), now.shape)
    name = list(excited)[row]
    note = f"mode {column + 1} at {middle[column]:.3g} Hz, {name} at {excited[name]:.3g} Hz"
    return Found(_between(float(now.min()), low, high), note=note)


SPAN_FREQUENCIES: Solver[ChainDrive, Run] = Solver(
    name="span_frequencies",
    title="transverse natural frequencies of the free spans",
    fidelity=Fidelity.FORMULA,
    scenes=frozenset({Run}),
    represents=frozenset(),
    gives=frozenset(f"span_{what}_{name}" for what in ("frequency", "separation") for name in SPANS),
    run=run,
    cost=lambda spec, scene, carried, level: 2e-4,
    source="moving string (Skutch 1897; Wickert and Mote 1988)",
)
