"""Checks of the transverse resonance of the free spans."""

from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath
from ptmcalc.contract.check import Check, Sense, no_needs, only
from ptmcalc.machines.chain_drive.machine.layout import TwoShafts
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive, Run, SpanResonance


def _asked(spec: ChainDrive, scene: Run) -> bool:
    return spec.checks.span_resonance is not None and isinstance(spec.layout, TwoShafts)


def _band(spec: ChainDrive, scene: Run) -> Estimate:
    """Required separation of the excitation from the natural frequencies of a span, 15 % by default.

    **Range** the lowest modes, three by default.
    **Error** none: a chosen limit.
    **Source** engineering rule: outside 15 %, the amplitude is at most four times the static one.
    """
    return Estimate.exact((spec.checks.span_resonance or SpanResonance()).band)


def _length_key(spec: ChainDrive, scene: Run) -> KeyPath:
    """Key of the length of the spans."""
    given = isinstance(spec.layout, TwoShafts) and spec.layout.centre_distance is not None
    return ("layout", "centre_distance") if given else ("layout", "pitches")


def _length_repair(spec: ChainDrive, scene: Run) -> KeyPath:
    path = _length_key(spec, scene)
    return path if path[-1] == "centre_distance" else ()


def _of(code: str, name: str) -> Check[ChainDrive, Run]:
    return Check(
        code=code,
        title=f"{name} span separation from resonance",
        question=f"Are tooth and shaft frequencies far enough from the transverse modes of the {name} span?",
        failure=f"{name} span is excited close to a transverse natural frequency",
        scenes=frozenset({Run}),
        loads=(f"span_separation_{name}",),
        sense=Sense.AT_LEAST,
        limit=_band,
        needs=no_needs,
        blame=lambda spec, scene, loads: _length_key(spec, scene),
        repair=_length_repair,
        forbids_band=True,
        what=f"The relative distance of the tooth frequency and of both shaft frequencies from each transverse natural"
        f" frequency of the {name} span is at least the band.",
        why="A span in resonance oscillates sideways and up and down: the whip of a chain. It hits guards, jumps teeth"
        " and wears the link joints.",
        formula="min over k of |f/f_k - 1| >= band,   f = v/p, n_1, n_2,   f_k = (k/(2 l)) (P/q)/(P/q + v^2)^(1/2)",
        source="`laws.threadline.transverse_frequency`; the band is an engineering rule",
    )


SLACK_SPAN = only(_asked)(_of("CHN132", "slack"))
TIGHT_SPAN = only(_asked)(_of("CHN133", "tight"))
