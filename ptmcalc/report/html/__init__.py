"""Pages to look at, to print and to hand on: one for each file, and an index. A page needs nothing but itself.

jinja2 writes them and matplotlib draws their figures; both come with the extra `report` and are imported where a page
is written.
"""

import base64
import hashlib
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cache
from importlib.util import find_spec
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Any

from ptmcalc import __version__
from ptmcalc.base.errors import UsageError
from ptmcalc.contract.report import FileReport, SceneReport, count
from ptmcalc.report import words
from ptmcalc.report.html import view

if TYPE_CHECKING:
    from jinja2 import Environment

_FOLDER = Path(__file__).parent
_COLUMNS = ("verdict", "file", "kind", "governs", "#value", "#limit", "#margin", "#passed", "#others")
INDEX = "index.html"
_AT_A_TIME = 64
"""Reports, and pages, of a large folder that are in memory together."""


def require() -> None:
    """See that what writes and draws pages is installed, before anything is computed for them.

    Raises:
        UsageError: it is not.
    """
    missing = [name for name in ("jinja2", "matplotlib") if find_spec(name) is None]
    if missing:
        needs = " and ".join(missing)
        raise UsageError(f"--html needs {needs}", 'install the extra: python -m pip install "ptmcalc[report]"')


def page(report: FileReport, text: str, back: str = "") -> str:
    """The page of a file, of whose text it shows what verdicts blame; `back` leads to the index."""
    report = words.printable(report)
    shown = view.page(report, view.Source(text))
    shown["pictures"] = [found for k, scene in enumerate(report.scenes, 1) if (found := _pictures(scene, k))]
    title = f"{report.verdict}: {report.name or report.path}"
    return _rendered("page.html.jinja", title, shown | {"back": back, "parts": view.parts_of(shown)})


def index(rows: Iterable[view.Entry], totals: dict[str, int]) -> str:
    """The page that leads to those of all files."""
    script = (_FOLDER / "sort.js").read_text("utf-8")
    known = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    shown = {
        "counted": words.summary(totals),
        "columns": _COLUMNS,
        "files": view.worst_first(rows),
        "script": _markup(script),
        "script_policy": f"; script-src 'sha256-{known}'",
    }
    return _rendered("index.html.jinja", "Design check", shown)


def site(
    reports: Sequence[FileReport], text_of: Callable[[FileReport], str], each: Callable[..., Iterable[str]] = map
) -> Iterator[tuple[str, str]]:
    """Name and text of each page of a folder, and of the index at last; `each` is a `map`, maybe by other processes."""
    rows = []
    names = page_names([report.path for report in reports])
    totals: dict[str, int] = {}
    for first in range(0, len(reports), _AT_A_TIME):
        some = [reports[k] for k in range(first, min(first + _AT_A_TIME, len(reports)))]
        pages = each(page, some, map(text_of, some), [INDEX] * len(some))
        for report, name, text in zip(some, names[first:], pages, strict=False):
            for key, number in count([report]).items():
                totals[key] = totals.get(key, 0) + number
            rows.append(view.row(words.printable(report), name))
            yield name, text
    yield INDEX, index(rows, totals or count([]))


def page_names(paths: Sequence[str]) -> list[str]:
    """Names of pages: the way from the folder that all files have in common, of letters that every system takes."""
    split = [PurePosixPath(path).parts for path in paths]
    common = 0
    while split and all(len(parts) > common + 1 and parts[common] == split[0][common] for parts in split):
        common += 1
    taken = {INDEX}
    names = []
    for parts in split:
        stem = re.sub(r"\.ya?ml$", "", "-".join(parts[common:]), flags=re.IGNORECASE)
        plain = re.sub(r"[^A-Za-z0-9._-]+", "_", stem).strip(".-_")[:100] or "file"
        name, number = f"{plain}.html", 2
        while name.lower() in taken:
            name, number = f"{plain}-{number}.html", number + 1
        taken.add(name.lower())
        names.append(name)
    return names


def _pictures(scene: SceneReport, number: int) -> view.Entry | None:
    """The figures of a scene, and the strip of its events."""
    from ptmcalc.report.html import draw

    shown: list[view.Entry] = []
    for k, figure in enumerate(scene.figures, 1):
        if figure.missing:
            shown.append({"title": figure.title, "missing": figure.missing, "told": []})
            continue
        drawing = draw.courses(figure, f"f{number}-{k}")
        told = view.told(one for curve in figure.curves for one in curve.told)
        shown.append(
            {
                "title": figure.title,
                "missing": "",
                "svg": _markup(drawing.svg),
                "legend": drawing.keys,
                "told": told,
            }
        )
    if scene.events:
        drawing = draw.events(scene, f"e{number}")
        shown.append(
            {"title": "Events", "missing": "", "svg": _markup(drawing.svg), "legend": drawing.keys, "told": []}
        )
    return {"name": scene.name, "type": scene.type, "figures": shown} if shown else None


def _rendered(template: str, title: str, shown: dict[str, Any]) -> str:
    fixed = {"title": title, "style": _markup((_FOLDER / "style.css").read_text("utf-8")), "version": __version__}
    text: str = _environment().get_template(template).render({"script_policy": "", **fixed, **shown})
    return text


def _markup(text: str) -> Any:
    """Text of our own that is HTML already."""
    from markupsafe import Markup

    return Markup(text)


@cache
def _environment() -> "Environment":
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    return Environment(
        loader=FileSystemLoader(_FOLDER),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
