"""Transverse resonance of the free spans between two shafts."""

from ptmcalc.base import units
from ptmcalc.contract.result import LoadInfo
from ptmcalc.contract.topic import Topic
from ptmcalc.machines.chain_drive.machine.spec import ChainDrive
from ptmcalc.machines.chain_drive.spans.checks import SLACK_SPAN, TIGHT_SPAN
from ptmcalc.machines.chain_drive.spans.frequencies import SPAN_FREQUENCIES

SPANS: Topic[ChainDrive] = Topic(
    loads=(
        LoadInfo("span_frequency_slack", "slack span, transverse natural frequency", units.FREQUENCY),
        LoadInfo("span_frequency_tight", "tight span, transverse natural frequency", units.FREQUENCY),
        LoadInfo("span_separation_slack", "slack span separation from resonance", units.SHARE),
        LoadInfo("span_separation_tight", "tight span separation from resonance", units.SHARE),
    ),
    solvers=(SPAN_FREQUENCIES,),
    checks=(SLACK_SPAN, TIGHT_SPAN),
)
