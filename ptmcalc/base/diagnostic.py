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
            "The program failed on this file. The other files of the run are not affected.",
            "Report the error with the file and the output of the same command under PTMCALC_TRACEBACK=1.",
        ),
        "TXT101": CodeText(
            "unreadable file",
            "The path does not exist, is not a file, or has no read permission.",
            "Check the path and its permissions.",
        ),
        "TXT102": CodeText(
            "folder without design files",
            "The folder and its subfolders contain no file that ends in .yaml or .yml. Nothing was checked.",
            "Name the folder that contains the design files. `ptmcalc new conveyor > conveyor.yaml` writes a first"
            " design file.",
        ),
        "TXT103": CodeText(
            "text encoding other than UTF-8",
            "A design file is UTF-8 text. Another encoding would change characters without a message.",
            "Save the file as UTF-8.",
        ),
        "TXT104": CodeText(
            "empty file",
            "The file contains no YAML document.",
            "Start from the commented template that `ptmcalc new conveyor` prints.",
        ),
        "TXT105": CodeText(
            "invalid YAML",
            "The YAML parser stopped at this place and read nothing after it. Control characters and the line breaks"
            " U+0085, U+2028 and U+2029 are also rejected. Few editors display these characters.",
            "Correct the stated place. The usual causes are indentation by tabs and a missing space after a colon.",
        ),
        "TXT106": CodeText(
            "duplicate key",
            "YAML tools keep the last of two equal keys and drop the first without a message.",
            "Delete one of the two keys.",
        ),
        "TXT107": CodeText(
            "tag in the YAML text",
            "A design file contains data only. A tag requests the construction of an object and is rejected.",
            "Delete the tag (the word that starts with an exclamation mark).",
        ),
        "TXT108": CodeText(
            "file size limit exceeded",
            "A file may have at most 1 MiB, 50 000 nodes with its aliases expanded, 100 levels and 1000 faults. A key"
            " or a value may have at most 10 000 characters.",
            "Split the file, remove the nested aliases, or shorten the text. Of many faults, correct the first.",
        ),
        "TXT109": CodeText(
            "more than one document",
            "A design file describes one machine. `---` starts a second document.",
            "Write each machine into its own file.",
        ),
        "TXT110": CodeText(
            "unresolved alias or merge",
            "An alias must follow its anchor. `<<` takes a mapping or a list of mappings.",
            "Define the anchor first, outside the value that uses it.",
        ),
        "TXT111": CodeText(
            "non-scalar key",
            "A key is a plain word. A list or a mapping cannot be a key.",
            "Write `key: value`.",
        ),
        "TXT112": CodeText(
            "document is not a mapping",
            "A design file is a mapping of keys to values. It starts with `kind:`.",
            "Start the file with `kind: conveyor` or another kind of `ptmcalc kinds`.",
        ),
        "TXT113": CodeText(
            "link outside the folder",
            "A file found in a folder, or by a pattern, is a link to a file outside that folder and its repository."
            " The rejection protects other files of the computer when design files of other persons are checked.",
            "Name the file itself, or put it into the folder.",
        ),
        "SPC101": CodeText(
            "missing machine kind",
            "Every design file states the kind of machine it describes.",
            "Add `kind: conveyor` or another kind of `ptmcalc kinds`.",
        ),
        "SPC102": CodeText(
            "unknown machine kind",
            "No machine kind of that name is installed.",
            "Use one of the kinds that `ptmcalc kinds` lists.",
        ),
        "SPC103": CodeText(
            "missing key",
            "This input is required; no default value can be justified.",
            "Add the key. `ptmcalc schema KIND` describes it.",
        ),
        "SPC104": CodeText(
            "unknown key",
            "An unknown key would be ignored without a message. It is therefore rejected.",
            "Correct the spelling or delete the key.",
        ),
        "SPC105": CodeText(
            "wrong unit dimension",
            "The physical quantity of the value differs from the one that the key takes.",
            "Write the value in a unit of the required dimension.",
        ),
        "SPC106": CodeText(
            "missing unit",
            "The unit of a bare number is unknown. Only ratios are written without a unit.",
            "Write the unit after the number.",
        ),
        "SPC107": CodeText(
            "decimal comma",
            "Some tools read `3,5` as 35 and others as 3.5. Between braces, the comma ends the value.",
            "Write a decimal point.",
        ),
        "SPC108": CodeText(
            "unknown unit",
            "The table of units is closed. No unit is guessed.",
            "Use an SI or engineering unit.",
        ),
        "SPC109": CodeText(
            "non-finite number",
            "Every comparison with NaN is false. Infinity makes every sum invalid.",
            "Write a finite number.",
        ),
        "SPC110": CodeText(
            "value out of range",
            "No machine has this value, or the formulas do not apply to it. For every key, a value other than 0 is"
            " between 1e-12 and 1e15 in SI units.",
            "Write a value inside the stated range.",
        ),
        "SPC111": CodeText(
            "wrong value type",
            "The key takes another form: a mapping, a list, a word, or a number with a unit.",
            "Write the value in the stated form.",
        ),
        "SPC112": CodeText(
            "invalid choice",
            "The key takes one of a few words.",
            "Use one of the stated words.",
        ),
        "SPC113": CodeText(
            "conflicting inputs",
            "Two keys state the same input twice, leave an input undefined, or contradict each other.",
            "Keep one of the keys, or add the missing key.",
        ),
        "SPC114": CodeText(
            "invalid number",
            "The value is not a number with a unit.",
            "Write digits, a decimal point, a space and the unit.",
        ),
        "SPC201": CodeText(
            "inconsistent inputs",
            "Two values of the file that must agree do so only approximately. The check continues with the first"
            " value.",
            "Correct the wrong value.",
        ),
        "SPC202": CodeText(
            "expired waiver",
            "The date until which the file waives a check has passed. The verdict of the check counts again.",
            "Correct the design, or renew `until` with a reason that still applies.",
        ),
        "SPC204": CodeText(
            "file without any check",
            "No check of the file was made: all are switched off, or none applies to its scenes. A file without any"
            " check has not passed.",
            "Delete an `off`, or add a scene to which checks apply.",
        ),
        "SPC205": CodeText(
            "conflicting forced effects",
            "An effect that the file forces on cannot be simulated with other effects that the file forces on or off.",
            "Set one of the stated effects to `auto`.",
        ),
        "SPC203": CodeText(
            "unused waiver",
            "The waived check does not fail in any scene. The waiver would hide the next failure without a message.",
            "Delete the waiver.",
        ),
        "NUM101": CodeText(
            "computation not converged",
            "The numerical method did not reach a reliable value. The verdicts that require this value are undecided.",
            "See the message. Report the file if the machine is a valid design.",
        ),
        "NUM102": CodeText(
            "model range exceeded",
            "The simulation left the range in which its equations apply. Later results are not reliable.",
            "Change the design so that the range is kept, or assess the event by another method.",
        ),
        "NUM103": CodeText(
            "work budget exceeded",
            "A finer computation, or one with more effects, is required. Its predicted work exceeds the work budget,"
            " or it requires more memory than available.",
            "Raise `--budget`, relax `accuracy`, or simplify the scene. `ptmcalc cost FILE` shows the required work.",
        ),
        "NUM104": CodeText(
            "approximate model state",
            "The simulation reached a state that its model treats only approximately. The results apply with this"
            " restriction.",
            "See the message.",
        ),
        "NUM105": CodeText(
            "requested accuracy not reached",
            "The file or the command requires a higher accuracy of governing loads than the finest solver reaches.",
            "Request a lower accuracy (`ptmcalc cost FILE` shows the attainable one), or use the error bars. The"
            " verdicts already account for the error bars.",
        ),
        "NUM106": CodeText(
            "persistent contact chatter",
            "A link or a brake changes its state repeatedly until the end of the scene. Its loads apply to the"
            " computed window, not beyond it.",
            "Add damping to the link, or the load that keeps it closed. Check the events.",
        ),
        "NUM107": CodeText(
            "textbook formula deviates from the computation",
            "A formula used within its own range is outside the error bar of the computed load by more than a tenth.",
            "Design with the computed load. The formula neglects an effect that is significant here.",
        ),
        "NUM108": CodeText(
            "textbook table discontinuity",
            "A textbook table is discontinuous near this value. Its formula is wrong by a sixth to a seventh on either"
            " side.",
            "Design with the computed load. The formula is shown for comparison only.",
        ),
        "NUM111": CodeText(
            "contradictory loads",
            "The intervals of two loads violate a relation that applies to every machine. An example: the maximum"
            " tension anywhere is at least the tension at the pulley. Every check that reads one of the two loads"
            " is undecided.",
            "Report the error with the file. One of the error bars is wrong.",
        ),
        "NUM113": CodeText(
            "safety device in operation",
            "A limiter or a slip clutch acts in the scene as intended.",
            "No action is required. The loads are those with the device.",
        ),
        "NUM112": CodeText(
            "unsteady motion at the end of the window",
            "The computation ends before the motion of the machine is steady. Loads that can still grow have no bound"
            " beyond the window.",
            "Choose a longer window with `window_factor` of the scene.",
        ),
        "NUM110": CodeText(
            "motion not completed",
            "The drive stalls, the brake does not hold, or a limiter ends the motion. The motion of the scene is not"
            " completed. The loads are those of the actual motion.",
            "See the message for the phase in which the motion ends.",
        ),
        "NUM109": CodeText(
            "operating speed near resonance",
            "A harmonic of the excitation is near a natural frequency. The response is many times the static response,"
            " or it is very sensitive to small changes.",
            "Run at one of the stated speeds, or change the pitch, the mass or the stiffness.",
        ),
    }
)
"""Every code that is not a check of a machine. Codes are never reused."""
