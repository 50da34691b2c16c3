"""JUnit XML: a suite for each file, a case for each check of a scene, for the test reports of CI servers.

A failed check is a failure; one that is undecided or was not made, and a file that is invalid, is an error; a waived
check, and an effect of the physics that was left out, is skipped. The counts are those of the summary.
"""

from xml.etree import ElementTree as Xml

from ptmcalc.base.diagnostic import Severity, Verdict
from ptmcalc.contract.effect import EffectState
from ptmcalc.contract.report import EffectReport, FileReport
from ptmcalc.report import words
from ptmcalc.report.entries import Entry, entries

_OUTCOMES = {
    Verdict.FAIL: "failure",
    Verdict.UNDECIDED: "error",
    Verdict.NOT_CHECKED: "error",
    Verdict.WAIVED: "skipped",
    Verdict.OFF: "skipped",
}


def render(reports: tuple[FileReport, ...], *, width: int, color: bool, verbose: bool = False) -> str:
    """The document."""
    suites = [_suite(report) for report in words.printable(reports)]
    totals = {key: str(sum(int(suite.attrib[key]) for suite in suites)) for key in ("tests", "failures", "errors")}
    root = Xml.Element("testsuites", {"name": "ptmcalc"} | totals)
    root.extend(suites)
    Xml.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + Xml.tostring(root, encoding="unicode") + "\n"


def _suite(report: FileReport) -> Xml.Element:
    found = list(entries(report))
    cases = [_validity(report, found)]
    cases += [_check(report, entry) for entry in found if isinstance(entry.state, Verdict)]
    for scene in report.scenes:
        cases += [_effect(report, scene.name, one) for one in scene.present if one.state is EffectState.SKIPPED]
    counted = {
        name: str(sum(case.find(tag) is not None for case in cases))
        for name, tag in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped"))
    }
    suite = Xml.Element("testsuite", {"name": report.path, "tests": str(len(cases))} | counted)
    suite.extend(cases)
    remarks = [entry for entry in found if isinstance(entry.state, Severity) and entry.state is not Severity.ERROR]
    if remarks:
        Xml.SubElement(suite, "system-out").text = "\n".join(f"{one.state.value} {_told(one)}" for one in remarks)
    return suite


def _validity(report: FileReport, found: list[Entry]) -> Xml.Element:
    """Whether the file can be read as a machine at all."""
    case = _case(report, "the file is valid", "")
    for entry in found:
        if entry.state is Severity.ERROR:
            Xml.SubElement(case, "error", {"type": entry.code, "message": entry.message}).text = _told(entry)
    return case


def _check(report: FileReport, entry: Entry) -> Xml.Element:
    case = _case(report, f"{entry.code} {entry.title}", entry.scene, entry)
    if entry.state in _OUTCOMES:
        assert isinstance(entry.state, Verdict)
        said = {"type": entry.state.value, "message": entry.message}
        Xml.SubElement(case, _OUTCOMES[entry.state], said).text = _told(entry)
    return case


def _effect(report: FileReport, scene: str, effect: EffectReport) -> Xml.Element:
    case = _case(report, f"effect {effect.name}", scene)
    because = effect.note or (words.compared(effect.criterion) if effect.criterion else "")
    Xml.SubElement(case, "skipped", {"type": "effect", "message": f"{effect.title} left out: {because}"})
    return case


def _case(report: FileReport, name: str, scene: str, entry: Entry | None = None) -> Xml.Element:
    place = {"line": str(entry.span.line)} if entry and entry.span else {}
    classname = f"{report.path}.{scene}" if scene else report.path
    return Xml.Element("testcase", {"classname": classname, "name": name, "file": report.path} | place)


def _told(entry: Entry) -> str:
    where = f"{words.place(entry.span)}: " if entry.span else ""
    return f"{where}{entry.about}: {entry.message}"
