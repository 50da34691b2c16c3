"""Work against precision as a page: a panel per scene, both axes logarithmic, drawn as SVG inside HTML.

No plotting library: a page of a few lines opens anywhere, is the same bytes for the same numbers, names every point
under the pointer, and costs no import. matplotlib would take longer to load than most machines take to measure. It
looks as the pages of `check --html` do, and has their style; under each drawing its numbers stand as a table.
"""

import math
from collections.abc import Iterable, Sequence
from functools import cache
from html import escape
from pathlib import Path

from ptmcalc import __version__
from ptmcalc.contract.cost import CostReport, Outcome, Role, Setting
from ptmcalc.report.cost import conclusion, seconds, share

_WIDTH, _HEIGHT = 460, 340
_LEFT, _RIGHT, _TOP, _BOTTOM = 70, 24, 14, 46
_APART = 56
"""Least way between two numbers at the lower axis; decades closer than this go without."""
_LEAST = 1e-12
_COLOURS = 6
_STYLE = (
    "main{max-width:44rem}svg.plot{width:100%;height:auto;display:block}"
    ".plot text{font:12px system-ui,sans-serif;fill:var(--ink)}.grid{stroke:var(--grid)}"
    ".front{fill:none;stroke:var(--ink);stroke-width:1.5}.dot{width:.8rem;height:.8rem;border-radius:50%;flex:none;"
    "align-self:center;background:var(--c)}.plot circle{stroke:var(--c)}.plot .bar{fill:var(--c)}"
    ".plot .error{fill:var(--page)}"
    + "".join(f".c{k}{{--c:var(--c{k})}}" for k in range(1, _COLOURS + 1))
    + ".s1 circle,.dot.s1{stroke-dasharray:3 2;opacity:.75}.dot.s1{border-radius:0}"
)

Point = tuple[float, float]


def render(report: CostReport) -> str:
    """The page of one machine."""
    panels = "".join(_panel(report, scene, number) for number, scene in enumerate(report.scenes, 1))
    path = escape(report.path)
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"/>'
        '<meta name="viewport" content="width=device-width, initial-scale=1"/>'
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline';"
        " base-uri 'none'; form-action 'none'\"/>"
        '<meta name="color-scheme" content="light dark"/>'
        f"<title>ptmcalc cost {path}</title><style>{_shared_style()}{_STYLE}</style></head>\n<body>\n"
        '<a class="skip" href="#main">Skip to the report</a>\n'
        f'<header><h1>Work against precision</h1><p class="muted"><code>{path}</code></p></header>\n<main id="main">\n'
        f"<p>{escape(conclusion(report))}</p>\n"
        '<p class="muted">Filled: the widest reported error bar. Open: the maximum true error, or its upper bound. The'
        " line joins the settings with the narrowest error bars for their time.</p>\n"
        f"{panels}</main>\n<footer>ptmcalc {__version__}. The page is self-contained and requires no network."
        "</footer></body></html>\n"
    )


@cache
def _shared_style() -> str:
    """The style of all pages."""
    return (Path(__file__).parent / "html" / "style.css").read_text("utf-8")


def _panel(report: CostReport, scene: str, number: int) -> str:
    settings = [one for one in report.of_scene(scene) if one.outcome is Outcome.MEASURED and one.seconds]
    bars = [(one, one.bar) for one in settings if one.role is not Role.FORMULA and _finite(one.bar)]
    errors = [(one, one.worst.at_most) for one in settings if one.worst is not None and _finite(one.worst.at_most)]
    drawn = {one.name for one, _ in (*bars, *errors)}
    beside = [one for one in report.of_scene(scene) if one.name not in drawn]
    parts = [f"<h2>{escape(scene)}</h2>\n"]
    if drawn:
        parts += [_drawing(bars, errors, scene), _table(scene, number, bars, errors)]
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


def _table(
    scene: str,
    number: int,
    bars: Sequence[tuple[Setting, float | None]],
    errors: Sequence[tuple[Setting, float | None]],
) -> str:
    """The numbers of a drawing, for those who cannot see it and those who want to copy them."""
    bar, error = ({one.name: share(value or 0.0) for one, value in found} for found in (bars, errors))
    settings = dict.fromkeys(one for one, _ in (*bars, *errors))
    rows = "".join(
        f'<tr><th scope="row">{escape(one.name)}</th><td class="number">{escape(seconds(one.seconds))}</td>'
        f'<td class="number">{escape(bar.get(one.name, ""))}</td>'
        f'<td class="number">{escape(error.get(one.name, ""))}</td></tr>\n'
        for one in sorted(settings, key=lambda one: one.seconds or 0.0)
    )
    head = "".join(f'<th scope="col" class="number">{name}</th>' for name in ("time", "widest bar", "error at most"))
    title = escape(f"Numbers of {scene}")
    return (
        f'<div class="wrap" tabindex="0" role="region" aria-label="{title}"><table id="numbers-{number}">'
        f"<caption>{title}</caption>"
        f'<thead><tr><th scope="col">setting</th>{head}</tr></thead>\n'
        f"<tbody>{rows}</tbody></table></div>\n"
    )


def _drawing(
    bars: Sequence[tuple[Setting, float | None]], errors: Sequence[tuple[Setting, float | None]], scene: str
) -> str:
    points = [(one.seconds or 0.0, max(value or 0.0, _LEAST)) for one, value in (*bars, *errors)]
    x_low, x_high = _decades(x for x, _ in points)
    y_low, y_high = _decades(y for _, y in points)

    def place(x: float, y: float | None) -> Point:
        across = (math.log10(x) - x_low) / (x_high - x_low)
        up = (math.log10(max(y or 0.0, _LEAST)) - y_low) / (y_high - y_low)
        return _LEFT + across * (_WIDTH - _LEFT - _RIGHT), _HEIGHT - _BOTTOM - up * (_HEIGHT - _TOP - _BOTTOM)

    label = escape(f"Error over the time of a run, {scene}; the values are in the table below")
    parts = [f'<figure><svg class="plot" viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img" aria-label="{label}">\n']
    every = math.ceil(_APART * (x_high - x_low) / (_WIDTH - _LEFT - _RIGHT))
    for decade in range(x_low, x_high + 1):
        x, _ = place(10.0**decade, 10.0**y_low)
        parts.append(f'<line class="grid" x1="{x:.1f}" y1="{_TOP}" x2="{x:.1f}" y2="{_HEIGHT - _BOTTOM}"/>')
        text = escape(seconds(10.0**decade)) if (decade - x_low) % every == 0 else ""
        parts.append(f'<text x="{x:.1f}" y="{_HEIGHT - _BOTTOM + 16}" text-anchor="middle">{text}</text>\n')
    for decade in range(y_low, y_high + 1):
        _, y = place(10.0**x_low, 10.0**decade)
        parts.append(f'<line class="grid" x1="{_LEFT}" y1="{y:.1f}" x2="{_WIDTH - _RIGHT}" y2="{y:.1f}"/>')
        parts.append(f'<text x="{_LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{escape(share(10.0**decade))}</text>\n')
    parts.append(f'<text x="{_WIDTH / 2:.0f}" y="{_HEIGHT - 10}" text-anchor="middle">time of a run</text>')
    parts.append(f'<text transform="translate(14 {_HEIGHT / 2:.0f}) rotate(-90)" text-anchor="middle">error</text>\n')
    solvers = list(dict.fromkeys(one.solver for one, _ in (*bars, *errors)))
    colour = {name: f"c{k % _COLOURS + 1} s{k // _COLOURS}" for k, name in enumerate(solvers)}
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
    keys = "".join(f'<li><span class="dot {colour[name]}"></span><span>{escape(name)}</span></li>' for name in solvers)
    return "".join((*parts, f'</svg><figcaption><ul class="keys">{keys}</ul></figcaption></figure>\n'))


def _point(at: Point, colour: str, one: Setting, said: str, filled: str) -> str:
    title = escape(f"{one.name}: {seconds(one.seconds)}, {said}")
    return (
        f'<g class="{colour}"><circle class="{"bar" if filled else "error"}" cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="5">'
        f"<title>{title}</title></circle></g>\n"
    )


def _decades(values: Iterable[float]) -> tuple[int, int]:
    """Whole decades round all values, at least one."""
    logs = [math.log10(value) for value in values]
    low, high = math.floor(min(logs)), math.ceil(max(logs))
    return low, max(high, low + 1)
