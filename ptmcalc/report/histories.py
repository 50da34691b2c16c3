"""Loads over time, or over speed, as CSV, one line a moment: what a spreadsheet or a plotting program reads."""

import csv
from collections.abc import Sequence
from io import StringIO

from ptmcalc.contract.report import FileReport
from ptmcalc.report.csv import safe

COLUMNS = ("file", "scene", "load", "unit", "time", "value", "over")
"""`time` in s, or what `over` names instead in its SI unit; `value` in the unit of its line, an SI one."""


def render(reports: Sequence[FileReport]) -> str:
    """The histories of all loads of all files, with every digit; the heading alone where there are none."""
    out = StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    for report in reports:
        for scene in report.scenes:
            for load in scene.loads:
                course = load.history
                if course is not None:
                    head = (safe(report.path), scene.name, load.info.name, course.quantity.si)
                    moments = zip(course.times, course.values, strict=True)
                    writer.writerows((*head, time, value, course.over.name) for time, value in moments)
    return out.getvalue()
