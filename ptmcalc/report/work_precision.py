"""Work against precision as a page: a panel per scene, both axes logarithmic, drawn as SVG inside HTML.

No plotting library: a page of a few lines opens anywhere, is the same bytes for the same numbers, names every point
under the pointer, and costs no import. matplotlib would take longer to load than most machines take to measure.
"""

import math
from collections.abc import Iterable, Sequence
from html import escape

from ptmcalc.contract.cost import CostReport, Outcome, Role, Setting
from ptmcalc.report.cost import conclusion, seconds, share

_WIDTH, _HEIGHT = 640, 400
_LEFT, _RIGHT, _TOP, _BOTTOM = 70, 20, 20, 50
_LEAST = 1e-12
_COLOURS = ("#1b6ca8", "#c8553d", "#588b49", "#7a4fa3", "#b8860b", "#2f8f8b", "#8a3b5e", "#555555")
_STYLE = (
    "body{font:14px sans-serif;max-width:720px;margin:2em auto;color:#222}svg{background:#fff}"
    "text{font:12px sans-serif;fill:#333}.grid{stroke:#ddd}.axis{stroke:#333}.link{stroke:#bbb;stroke-dasharray:3 3}"
    ".front{fill:none;stroke:#333;stroke-width:1.5}li{margin:.2em 0}"
)

Point = tuple[float, float]


def render(report: CostReport) -> str:
    """The page of one machine."""
    panels = "".join(_panel(report, scene) for scene in report.scenes)
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"/>'
        f"<title>ptmcalc cost {escape(report.path)}</title><style>{_STYLE}</style></head>\n<body>\n"
        f"<h1>{escape(report.path)}</h1>\n<p>{escape(conclusion(report))}</p>\n"
        "<p>Filled: the widest reported bar. Hollow: the largest true error, or the most it can be. The line joins the"
        " settings that prove the most for the least time.</p>\n"
        f"{panels}</body></html>\n"
    )


def _panel(report: CostReport, scene: str) -> str:
    settings = [one for one in report.of_scene(scene) if one.outcome is Outcome.MEASURED and one.seconds]
    bars = [(one, one.bar) for one in settings if one.role is not Role.FORMULA and _finite(one.bar)]
    errors = [(one, one.worst.at_most) for one in settings if one.worst is not None and _finite(one.worst.at_most)]
    drawn = {one.name for one, _ in (*bars, *errors)}
    beside = [one for one in report.of_scene(scene) if one.name not in drawn]
    parts = [f"<h2>{escape(scene)}</h2>\n"]
    if drawn:
        parts.append(_drawing(bars, errors))
    if beside:
        parts.append("<ul>" + "".join(f"<li>{escape(_reason(one))}</li>" for one in beside) + "</ul>\n")
    return "".join(parts)


def _finite(value: float | None) -> bool:
    return value is not None and math.isfinite(value)


def _reason(one: Setting) -> str:
    """Why a setting is no point."""
    if one.outcome is Outcome.FAILED:
        return f"{one.name} failed: {one.reason}"
    if one.outcome is Outcome.NOT_RUN:
        return f"{one.name} not run: {one.reason}, predicted {seconds(one.predicted_seconds)}"
    return f"{one.name}, {seconds(one.seconds)}: " + ("no bound" if one.loads else "no governing load")


def _drawing(bars: Sequence[tuple[Setting, float | None]], errors: Sequence[tuple[Setting, float | None]]) -> str:
    points = [(one.seconds or 0.0, max(value or 0.0, _LEAST)) for one, value in (*bars, *errors)]
    x_low, x_high = _decades(x for x, _ in points)
    y_low, y_high = _decades(y for _, y in points)

    def place(x: float, y: float | None) -> Point:
        across = (math.log10(x) - x_low) / (x_high - x_low)
        up = (math.log10(max(y or 0.0, _LEAST)) - y_low) / (y_high - y_low)
        return _LEFT + across * (_WIDTH - _LEFT - _RIGHT), _HEIGHT - _BOTTOM - up * (_HEIGHT - _TOP - _BOTTOM)

    parts = [f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" width="{_WIDTH}" height="{_HEIGHT}" role="img">\n']
    for decade in range(x_low, x_high + 1):
        x, _ = place(10.0**decade, 10.0**y_low)
        parts.append(f'<line class="grid" x1="{x:.1f}" y1="{_TOP}" x2="{x:.1f}" y2="{_HEIGHT - _BOTTOM}"/>')
        text = escape(seconds(10.0**decade))
        parts.append(f'<text x="{x:.1f}" y="{_HEIGHT - _BOTTOM + 16}" text-anchor="middle">{text}</text>\n')
    for decade in range(y_low, y_high + 1):
        _, y = place(10.0**x_low, 10.0**decade)
        parts.append(f'<line class="grid" x1="{_LEFT}" y1="{y:.1f}" x2="{_WIDTH - _RIGHT}" y2="{y:.1f}"/>')
        parts.append(f'<text x="{_LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{escape(share(10.0**decade))}</text>\n')
    parts.append(f'<text x="{_WIDTH / 2:.0f}" y="{_HEIGHT - 10}" text-anchor="middle">time of a run</text>')
    parts.append(f'<text transform="translate(14 {_HEIGHT / 2:.0f}) rotate(-90)" text-anchor="middle">error</text>\n')
    solvers = list(dict.fromkeys(one.solver for one, _ in (*bars, *errors)))
    colour = {name: _COLOURS[k % len(_COLOURS)] for k, name in enumerate(solvers)}
    front = sorted((one.seconds or 0.0, value) for one, value in bars if one.front_of_bars)
    if len(front) > 1:
        joined = " ".join(f"{x:.1f},{y:.1f}" for x, y in (place(*point) for point in front))
        parts.append(f'<polyline class="front" points="{joined}"/>\n')
    for one, value in errors:
        parts.append(
            _point(place(one.seconds or 0.0, value), colour[one.solver], one, f"error {share(value or 0.0)}", "")
        )
    for one, value in bars:
        parts.append(
            _point(place(one.seconds or 0.0, value), colour[one.solver], one, f"bar {share(value or 0.0)}", "b")
        )
    for k, name in enumerate(solvers):
        y = _TOP + 14 + 16 * k
        parts.append(f'<circle cx="{_WIDTH - 190}" cy="{y - 4}" r="4" fill="{colour[name]}"/>')
        parts.append(f'<text x="{_WIDTH - 180}" y="{y}">{escape(name)}</text>\n')
    return "".join((*parts, "</svg>\n"))


def _point(at: Point, colour: str, one: Setting, said: str, filled: str) -> str:
    fill = colour if filled else "none"
    title = escape(f"{one.name}: {seconds(one.seconds)}, {said}")
    return (
        f'<circle class="{"bar" if filled else "error"}" cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="5" fill="{fill}"'
        f' stroke="{colour}"><title>{title}</title></circle>\n'
    )


def _decades(values: Iterable[float]) -> tuple[int, int]:
    """Whole decades round all values, at least one."""
    logs = [math.log10(value) for value in values]
    low, high = math.floor(min(logs)), math.ceil(max(logs))
    return low, max(high, low + 1)
