"""Check of the guide force of a skewing crane."""

from ptmcalc.contract.check import Check, Sense, at, blames, needs
from ptmcalc.contract.limits import key
from ptmcalc.machines.crane.travelling.machine.judging import OneCheck
from ptmcalc.machines.crane.travelling.machine.scenes import Skew

GUIDE: OneCheck = Check(
    code="CRN174",
    hazard=True,
    title="skewing guide force",
    question="Is the skewing force on the front guide within its rating?",
    failure="skewing force overloads the guide",
    scenes=frozenset({Skew}),
    loads=("skew_force",),
    sense=Sense.AT_MOST,
    limit=key(
        "guide.rating",
        meaning="Permissible force of a guide",
        valid="flanges and guide rollers",
        error="none: a limit of the file",
    ),
    needs=needs(("guide", "rating")),
    blame=blames("guide", "rating"),
    repair=at("guide", "rating"),
    what="The force of the rail on the foremost guide is at most the rating of flange, roller and rail.",
    why="Skewing is the main cause of wear of flanges and rails. It bends end carriages and runway sideways.",
    formula="S = sum f xi G_i (1 - d_i/h),   f = 0.3 (1 - exp(-250 alpha))",
    source="EN 13001-2, ISO 8686-1, EN 1991-3",
)
