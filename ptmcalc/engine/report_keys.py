"""Keys in a report by the names that the file uses."""

from dataclasses import replace

from ptmcalc.contract.report import FileReport, Judgement
from ptmcalc.spec.alias import as_written, said_as_written
from ptmcalc.text.document import Document


def as_written_in_file(report: FileReport, document: Document) -> FileReport:
    """A report that names keys as the file does."""

    def judgement(one: Judgement) -> Judgement:
        repair = replace(one.repair, path=document.as_written(one.repair.path)) if one.repair else None
        path = one.blame.path
        reason, tried = (as_written(text, document, path) for text in (one.reason, one.tried))
        return replace(
            one, blame=replace(one.blame, path=document.as_written(path)), repair=repair, reason=reason, tried=tried
        )

    return replace(
        report,
        diagnostics=tuple(said_as_written(one, document) for one in report.diagnostics),
        assumed=tuple(replace(one, path=document.as_written(one.path)) for one in report.assumed),
        scenes=tuple(replace(scene, checks=tuple(map(judgement, scene.checks))) for scene in report.scenes),
    )
