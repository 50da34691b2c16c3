"""The one currency of everything said about a file: code, place, reason, fix."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType

from ptmcalc.base.span import KeyPath, Span


class Severity(StrEnum):
    """How much a diagnostic weighs: only an error makes a file invalid."""

    NOTE = "note"
    WARNING = "warning"
    ERROR = "error"

    @property
    def rank(self) -> int:
        return list(Severity).index(self)


class Verdict(StrEnum):
    """Result of a check, in the order of reports: the worst first, checks switched off by the file last."""

    FAIL = "fail"
    UNDECIDED = "undecided"
    NOT_CHECKED = "not_checked"
    WAIVED = "waived"
    PASS = "pass"
    OFF = "off"

    @property
    def rank(self) -> int:
        return list(Verdict).index(self)


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One thing said about a file, at its place, with the reason and a fix that can be copied."""

    code: str
    message: str
    span: Span | None = None
    path: KeyPath = ()
    hint: str = ""
    severity: Severity = Severity.ERROR


@dataclass(frozen=True, slots=True)
class CodeText:
    """What `explain CODE` says about a diagnostic."""

    title: str
    why: str
    fix: str


BROKEN = "BUG101"
"""What is said of a file that our own program could not cope with."""

CODES: Mapping[str, CodeText] = MappingProxyType(
    {
        "BUG101": CodeText(
            "internal error of ptmcalc",
            "The program broke down on this file; the other files of the run are not touched by it.",
            "Please report it with the file and the output of the same command under PTMCALC_TRACEBACK=1.",
        ),
        "TXT101": CodeText(
            "unreadable file",
            "The path does not exist, is not a file, or may not be opened.",
            "Check the path and its permissions.",
        ),
        "TXT102": CodeText(
            "folder without design files",
            "No file ending in .yaml or .yml stands in the folder or below it, so nothing was checked.",
            "Name the folder that holds the design files; `ptmcalc new conveyor > conveyor.yaml` writes a first one.",
        ),
        "TXT103": CodeText(
            "text encoding other than UTF-8",
            "A design file is UTF-8 text; another encoding would silently change characters.",
            "Save the file as UTF-8.",
        ),
        "TXT104": CodeText(
            "empty file",
            "The file holds no YAML document.",
            "`ptmcalc new conveyor` prints a commented template to start from.",
        ),
        "TXT105": CodeText(
            "invalid YAML",
            "The YAML parser stopped at this place; nothing behind it could be read. Control characters and the line"
            " breaks U+0085, U+2028 and U+2029, which few editors show, are refused as well.",
            "Mend the place named; indentation by tabs and a missing space after a colon are the usual causes.",
        ),
        "TXT106": CodeText(
            "duplicate key",
            "YAML tools keep the last of two equal keys and drop the first without a word.",
            "Delete one of them.",
        ),
        "TXT107": CodeText(
            "YAML tag",
            "A design file is data; tags ask the reader to construct objects and are refused.",
            "Delete the tag (the word that starts with an exclamation mark).",
        ),
        "TXT108": CodeText(
            "file size limit exceeded",
            "A file may have 1 MiB, 50 000 nodes with its aliases expanded, 100 levels, 10 000 characters in a key or a"
            " value, and 1000 faults.",
            "Split the file, remove the nested aliases, or shorten the text; of many faults mend the first.",
        ),
        "TXT109": CodeText(
            "more than one document",
            "A design file describes one machine; `---` starts a second one.",
            "Put each machine into a file of its own.",
        ),
        "TXT110": CodeText(
            "unresolved alias or merge",
            "An alias must follow its anchor, and `<<` takes a mapping or a list of mappings.",
            "Define the anchor first, outside the value that uses it.",
        ),
        "TXT111": CodeText(
            "non-scalar key",
            "Keys are plain words; a list or a mapping cannot be a key.",
            "Write `key: value`.",
        ),
        "TXT112": CodeText(
            "document is not a mapping",
            "A design file is a mapping of keys to values and starts with `kind:`.",
            "Start the file with `kind: conveyor` or another kind of `ptmcalc kinds`.",
        ),
        "TXT113": CodeText(
            "link outside the folder",
            "A file found in a folder, or by a pattern, is a link to one outside that folder and its repository. Who"
            " checks the files of others does not want to have any file of the machine read.",
            "Name the file itself, or put it into the folder.",
        ),
        "SPC101": CodeText(
            "missing machine kind",
            "Every design file names the kind of machine it describes.",
            "Add `kind: conveyor` or another kind of `ptmcalc kinds`.",
        ),
        "SPC102": CodeText(
            "unknown machine kind",
            "No machine of that name is installed.",
            "`ptmcalc kinds` lists the kinds.",
        ),
        "SPC103": CodeText(
            "missing key",
            "The machine cannot be computed without it and no default is honest.",
            "Add the key; `ptmcalc schema KIND` describes it.",
        ),
        "SPC104": CodeText(
            "unknown key",
            "A key that is not read would be lost without a word, so it is refused.",
            "Correct the spelling or delete it.",
        ),
        "SPC105": CodeText(
            "wrong unit dimension",
            "The value is a different physical quantity from the one the key takes.",
            "Write the value in a unit of the right dimension.",
        ),
        "SPC106": CodeText(
            "missing unit",
            "A bare number is a guess about its unit; only ratios are written without one.",
            "Write the unit behind the number.",
        ),
        "SPC107": CodeText(
            "decimal comma",
            "`3,5` reads as 35 in some tools and as 3.5 in others; between braces the comma ends the value.",
            "Write a decimal point.",
        ),
        "SPC108": CodeText(
            "unknown unit",
            "The table of units is closed, so that no unit is guessed.",
            "Use an SI or engineering unit.",
        ),
        "SPC109": CodeText(
            "non-finite number",
            "NaN compares false with everything and infinity spoils every sum.",
            "Write a finite number.",
        ),
        "SPC110": CodeText(
            "value out of range",
            "No machine has this value, or the formulas do not hold there. Whatever the key, a value other than 0 lies"
            " between 1e-12 and 1e15 in SI units.",
            "Write a value inside the range named.",
        ),
        "SPC111": CodeText(
            "wrong value type",
            "The key takes another form: a mapping, a list, a word, a number with a unit.",
            "Write it in the form named.",
        ),
        "SPC112": CodeText(
            "invalid choice",
            "The key takes one of a few words.",
            "Use one of the words named.",
        ),
        "SPC113": CodeText(
            "conflicting inputs",
            "Two keys say the same thing twice, leave a gap, or contradict each other.",
            "Keep one of them, or give the missing one.",
        ),
        "SPC114": CodeText(
            "invalid number",
            "The value is not a number with a unit.",
            "Write digits, a decimal point, a space and the unit.",
        ),
        "SPC201": CodeText(
            "inconsistent inputs",
            "Two values of the file that should agree do so only roughly; the check goes on with the first.",
            "Correct the one that is wrong.",
        ),
        "SPC202": CodeText(
            "expired waiver",
            "The day until which the file waives a check has passed, so its verdict counts again.",
            "Repair the design, or renew `until` with a reason that still holds.",
        ),
        "SPC204": CodeText(
            "file without any check",
            "No check of the file was made: all are switched off, or none applies to its scenes. A file that checked"
            " nothing has not passed.",
            "Delete an `off`, or add a scene to which checks apply.",
        ),
        "SPC205": CodeText(
            "effects that are forced and conflict",
            "An effect that the file forces on cannot be simulated together with others that it forces on or off.",
            "Set one of the effects named to `auto`.",
        ),
        "SPC203": CodeText(
            "unused waiver",
            "The check that it waives does not fail in any scene; it would hide the next failure without a word.",
            "Delete it.",
        ),
        "NUM101": CodeText(
            "computation not converged",
            "The numerics could not reach a trustworthy number; the verdicts that need it are undecided.",
            "See the message; report the file if the machine is a sound one.",
        ),
        "NUM102": CodeText(
            "model range exceeded",
            "The simulation left the range in which its equations hold; what came after is not trusted.",
            "Change the design so that the range is kept, or judge the event by other means.",
        ),
        "NUM103": CodeText(
            "work budget exceeded",
            "A finer or richer computation would be needed and its predicted work is over the budget, or it takes more"
            " memory than there is.",
            "Raise `--budget`, relax `accuracy`, or simplify the scene (`ptmcalc cost FILE` shows what it takes).",
        ),
        "NUM104": CodeText(
            "approximate model state",
            "The simulation met a state that its model treats only roughly; the numbers stand, with that remark.",
            "See the message.",
        ),
        "NUM105": CodeText(
            "requested accuracy not reached",
            "The file or the command asks for governing loads more accurate than the finest solver knows them.",
            "Ask for less (`ptmcalc cost FILE` shows what is in reach), or read the bars: verdicts already account for"
            " them.",
        ),
        "NUM106": CodeText(
            "persistent contact chatter",
            "A link or a brake changes its state over and over to the end of the scene; its loads hold for the window"
            " computed, not beyond it.",
            "Give the link damping, or the load that keeps it closed; look at the events.",
        ),
        "NUM107": CodeText(
            "textbook formula deviates from the computation",
            "A formula used within its own range differs from the computed load by more than a tenth and the bar.",
            "Design by the computed load; the formula leaves out an effect that matters here.",
        ),
        "NUM108": CodeText(
            "textbook table discontinuity",
            "A textbook's table jumps near this value: its formula is off by a sixth to a seventh on either side.",
            "Design by the computed load; the formula is shown for comparison only.",
        ),
        "NUM111": CodeText(
            "loads that contradict each other",
            "A relation that holds for every machine, such as that the largest tension anywhere is at least that at the"
            " pulley, does not hold between the intervals of two loads. Every check that reads one of them is"
            " undecided.",
            "Please report it with the file: one of the error bars is wrong.",
        ),
        "NUM113": CodeText(
            "safety device in operation",
            "A limiter or a slip clutch does in the scene what it is made for.",
            "Nothing: the loads are those with the device.",
        ),
        "NUM112": CodeText(
            "window ends before the motion is steady",
            "The computation ends while the machine still moves otherwise than it will. Loads that can still grow have"
            " no bound beyond the window.",
            "Choose a longer window with `window_factor` of the scene.",
        ),
        "NUM110": CodeText(
            "motion not completed",
            "The drive stalls, the brake does not hold, or a limiter ends the motion: what the scene is about does not"
            " happen; the loads are those of what happens instead.",
            "See the message for the phase it ends in.",
        ),
        "NUM109": CodeText(
            "operating speed near resonance",
            "A harmonic of the excitation lies so near a natural frequency that the answer is many times the static"
            " one, or changes much with little.",
            "Run at one of the speeds named, or change the pitch, the mass or the stiffness.",
        ),
    }
)
"""Every code that is not a check of a machine. Codes are never reused."""
