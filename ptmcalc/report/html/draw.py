"""Figures as SVG that stands inside a page: its colours are those of the page, its words those of its caption.

matplotlib draws them; it is imported where the first one is drawn. Inside a picture stand numbers and letters only,
which its caption explains: nothing overlaps at any width, and no name of a file has to be fitted in.
"""

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
from io import StringIO
from string import ascii_lowercase, ascii_uppercase
from typing import TYPE_CHECKING, Any, Literal

from ptmcalc.base.units import TIME, Quantity, digits, display_unit, unit_of
from ptmcalc.contract.figure import Curve, FigureReport, Spot
from ptmcalc.contract.report import SceneReport
from ptmcalc.report import words

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SHAPES = ("", "6 2", "2 1.5", "7 2 1.5 2", "4 1 1 1 1 1")
"""Dashes of curves, so that they can be told apart without their colours."""
COLOURS = 6
MOST_CURVES = 8
_WIDE, _HIGH = 4.9, 2.75  # inches: at 390 pixels a point of the picture is about a pixel
_SIZE = 9.5
_INK, _GRID, _BAD, _LIMIT, _PAGE = "#010101", "#020202", "#030303", "#040404", "#060606"
_INKS = {
    _INK: "currentColor",
    _GRID: "var(--grid)",
    _BAD: "var(--fail)",
    _LIMIT: "var(--limit)",
    _PAGE: "var(--page)",
} | {f"#0505{number:02x}": f"var(--c{number})" for number in range(1, COLOURS + 1)}
_STYLE = {
    "svg.hashsalt": "ptmcalc",
    "svg.fonttype": "none",
    "text.parse_math": False,
    "font.size": _SIZE,
    "axes.edgecolor": _INK,
    "axes.labelcolor": _INK,
    "xtick.color": _INK,
    "ytick.color": _INK,
    "text.color": _INK,
    "grid.color": _GRID,
    "axes.linewidth": 0.8,
    "lines.linewidth": 1.5,
}
_SEEN = 0.004
"""Width of an interval over the height of the picture from which it is drawn."""
_ROOM = 1.2
"""How far a limit may be from the curves, in heights of them, to be in the picture."""
_APART = 0.045
"""Share of the width within which two letters stand side by side as one."""


@dataclass(frozen=True, slots=True)
class Key:
    """What explains a part of a picture: its sign, drawn or a letter, and the words."""

    sign: str
    says: str
    colour: int = 0
    dashes: str = ""
    letter: str = ""


@dataclass(frozen=True, slots=True)
class Drawing:
    """A picture and what explains it."""

    svg: str
    keys: tuple[Key, ...]


def colour(number: int) -> int:
    """The colour of the curve of that number, from 1."""
    return number % COLOURS + 1


def _ink(number: int) -> str:
    return f"#0505{colour(number):02x}"


# -- courses --------------------------------------------------------------------------------------------------------


def courses(figure: FigureReport, ident: str) -> Drawing:
    """A figure of courses of loads."""
    curves = figure.curves[:MOST_CURVES]
    over, quantity = curves[0].history.over, curves[0].history.quantity
    across, upright = _unit(over, (curve.history.times for curve in curves)), _unit(quantity, _heights(curves))
    x, y = unit_of(across)[0], unit_of(upright)[0]
    keys: list[Key] = []

    def draw(axes: "Axes") -> None:
        ends = [end / x for curve in curves for end in (curve.history.times[0], curve.history.times[-1])]
        ends += [spot.at / x for spot in figure.marks.spots]
        left, right = _padded(min(ends), max(ends), 0.0)
        low, high = _frame(figure, curves, y)
        axes.set_xlim(left, right)
        axes.set_ylim(low, high)
        for number, curve in enumerate(curves):
            values = [value / y for value in curve.history.values]
            line = axes.plot([time / x for time in curve.history.times], values, color=_ink(number), zorder=3)[0]
            if dashes := SHAPES[number % len(SHAPES)]:
                line.set_dashes([float(part) for part in dashes.split()])
            keys.append(Key("line", curve.title, colour(number), SHAPES[number % len(SHAPES)]))
            keys.extend(_intervals(axes, curve, number, y, (low, high)))
        _bands(axes, figure, x, keys)
        _thresholds(axes, figure, (low, high), (y, quantity), keys)
        _moments(axes, figure, (left, right), (x, over), keys)
        _spots(axes, figure, (left, right, low, high), (x, y, over, quantity), keys)

    labels = f"{figure.across} [{across}]", f"{figure.upright} [{upright}]"
    svg = _svg(draw, labels, ident, figure.title, _description(figure, curves, quantity, over))
    if len(figure.curves) > MOST_CURVES:
        more = ", ".join(curve.title for curve in figure.curves[MOST_CURVES:])
        keys.append(Key("", f"not shown for lack of space: {more}"))
    return Drawing(svg, tuple(keys))


def _heights(curves: Iterable[Curve]) -> Iterable[Sequence[float]]:
    return (curve.history.values for curve in curves)


def _unit(quantity: Quantity, rows: Iterable[Sequence[float]]) -> str:
    """The unit in which the largest of the values reads best."""
    return display_unit(max((abs(value) for row in rows for value in row), default=0.0), quantity)


def _padded(low: float, high: float, share: float) -> tuple[float, float]:
    """A range with some room at its ends; of a single value one around it."""
    if high - low <= 1e-9 * max(abs(low), abs(high)):
        room = abs(high) * 0.1 or 1.0
        return low - room, high + room
    return low - share * (high - low), high + share * (high - low)


def _frame(figure: FigureReport, curves: Sequence[Curve], unit: float) -> tuple[float, float]:
    """What the picture shows of the values: the curves, the marked points, and limits that are not far from them."""
    values = [value / unit for row in _heights(curves) for value in row]
    values += [spot.value / unit for spot in figure.marks.spots]
    low, high = _padded(min(values), max(values), 0.0)
    room = _ROOM * (high - low)
    near = [one.value / unit for one in figure.marks.thresholds if low - room <= one.value / unit <= high + room]
    ends = [end / unit for curve in curves for told in _of(curve) for end in (told[1], told[2])]
    near += [end for end in ends if low - room / 2 <= end <= high + room / 2]
    low, high = min([low, *near]), max([high, *near])
    if 0 < low < 0.35 * high or (high < 0 and high > 0.35 * low):
        low, high = min(low, 0.0), max(high, 0.0)
    return _padded(low, high, 0.06)


def _of(curve: Curve) -> Iterable[tuple[str, float, float]]:
    """Title and interval of what is told of a curve in its own quantity."""
    for told in curve.told:
        ends = told.ends
        if told.quantity.si == curve.history.quantity.si and all(map(math.isfinite, ends)):
            yield told.title, *ends


def _intervals(axes: "Axes", curve: Curve, number: int, unit: float, frame: tuple[float, float]) -> Iterable[Key]:
    """What the numbers of a curve are known to lie in, as bands; those too narrow to be seen are in the table."""
    low, high = frame
    for title, least, most in _of(curve):
        if (most - least) / unit > _SEEN * (high - low):
            ends = max(least / unit, low), min(most / unit, high)
            axes.axhspan(*ends, color=_ink(number), alpha=0.16, linewidth=0, zorder=1)
            says = f"interval of: {title}"
            cut = " (continues outside the figure)" if least / unit < low or most / unit > high else ""
            yield Key("band", says + cut, colour(number))


def _bands(axes: "Axes", figure: FigureReport, unit: float, keys: list[Key]) -> None:
    for band in figure.marks.bands:
        axes.axvspan(
            band.low / unit, band.high / unit, color=_BAD if band.forbidden else _GRID, alpha=0.2, linewidth=0, zorder=0
        )
    keys.extend(Key("forbidden", title) for title in dict.fromkeys(band.title for band in figure.marks.bands))


def _thresholds(
    axes: "Axes", figure: FigureReport, frame: tuple[float, float], unit: tuple[float, Quantity], keys: list[Key]
) -> None:
    """Limits, each with a letter at the right edge."""
    low, high = frame
    found: dict[str, list[float]] = {}
    for one in figure.marks.thresholds:
        found.setdefault(one.title, []).append(one.value)
    placed: list[tuple[float, str]] = []
    for letter, (title, values) in zip(ascii_uppercase, found.items(), strict=False):
        said = " and ".join(words.number(value, unit[1]) for value in values)
        inside = [value / unit[0] for value in values if low <= value / unit[0] <= high]
        for value in inside:
            axes.axhline(value, color=_LIMIT, linewidth=1.3, dashes=(5, 2), zorder=2)
            placed.append(((value - low) / (high - low), letter))
        beyond = "" if inside else ", outside the figure"
        keys.append(Key("limit" if inside else "", f"{title}: {said}{beyond}", letter=letter if inside else ""))
    for up, letters in _apart(placed, 2 * _APART):
        axes.text(1.012, up, letters, transform=axes.transAxes, va="center", ha="left")


def _apart(placed: list[tuple[float, str]], least: float) -> Iterable[tuple[float, str]]:
    """Places of letters; those that would stand on each other are one."""
    found: list[tuple[float, str]] = []
    for at, letter in sorted(placed):
        if found and at - found[-1][0] < least:
            found[-1] = found[-1][0], f"{found[-1][1]},{letter}"
        else:
            found.append((at, letter))
    return found


def _moments(
    axes: "Axes", figure: FigureReport, ends: tuple[float, float], unit: tuple[float, Quantity], keys: list[Key]
) -> None:
    """Times at which something happens, each with a letter at the upper edge."""
    left, right = ends
    placed: list[tuple[float, str]] = []
    moments = [one for one in figure.marks.moments if left <= one.at / unit[0] <= right]
    for letter, moment in zip(ascii_lowercase, sorted(moments, key=lambda one: one.at), strict=False):
        placed.append(((moment.at / unit[0] - left) / (right - left), letter))
        axes.axvline(moment.at / unit[0], color=_INK, linewidth=0.8, dashes=(1, 2), zorder=2)
        keys.append(Key("moment", f"{moment.title}: {_in(moment.at, unit[1], unit[0])}", letter=letter))
    for share, letters in _apart(placed, _APART):
        axes.text(share, 1.025, letters, transform=axes.transAxes, ha="center", va="bottom")


def _spots(
    axes: "Axes",
    figure: FigureReport,
    frame: tuple[float, float, float, float],
    unit: tuple[float, float, Quantity, Quantity],
    keys: list[Key],
) -> None:
    """Marked points, each with a number; those that fall together share their place."""
    left, right, low, high = frame
    x, y, over, quantity = unit
    placed: list[tuple[float, float, list[int]]] = []
    for number, spot in enumerate(_once(figure.marks.spots), 1):
        at, value = spot.at / x, spot.value / y
        axes.plot([at], [value], marker="o", markersize=4.5, color=_INK, linestyle="none", zorder=4, clip_on=False)
        across, up = (at - left) / (right - left), (value - low) / (high - low)
        near = next((one for one in placed if abs(one[0] - across) < _APART and abs(one[1] - up) < 2 * _APART), None)
        if near is None:
            placed.append((across, up, [number]))
        else:
            near[2].append(number)
        where = f"{figure.across} {_in(spot.at, over, x)}"
        says = f"{spot.title}: {words.number(spot.value, quantity)} at {where}"
        keys.append(Key("spot", says, letter=str(number)))
    for across, up, numbers in placed:
        inside = across < 0.9
        axes.annotate(
            ",".join(map(str, numbers)),
            (across, up),
            xycoords="axes fraction",
            xytext=(5 if inside else -5, -6 if up > 0.88 else 6),
            textcoords="offset points",
            ha="left" if inside else "right",
            va="top" if up > 0.88 else "bottom",
            bbox={"facecolor": _PAGE, "alpha": 0.75, "linewidth": 0, "pad": 0.4},
            zorder=5,
        )


def _in(value: float, quantity: Quantity, factor: float) -> str:
    """A value in the unit of its axis."""
    unit = next(name for name in (*quantity.display, quantity.si) if unit_of(name)[0] == factor)
    return f"{digits(value / factor)} {unit}".removesuffix(" 1")


def _once(spots: Iterable[Spot]) -> Iterable[Spot]:
    """Spots without those that say the same of the same point."""
    seen: dict[tuple[float, float], Spot] = {}
    for spot in spots:
        seen.setdefault((spot.at, spot.value), spot)
    return seen.values()


def _description(figure: FigureReport, curves: Sequence[Curve], quantity: Quantity, over: Quantity) -> str:
    """What somebody hears who cannot see the picture."""
    parts = []
    for curve in curves:
        times, values = curve.history.times, curve.history.values
        ends = f"{words.number(min(values), quantity)} to {words.number(max(values), quantity)}"
        way = " to ".join(_in(end, over, unit_of(_unit(over, [times]))[0]) for end in (times[0], times[-1]))
        parts.append(f"{curve.title}: from {ends} over {figure.across} from {way}.")
    return " ".join(parts)


# -- events ---------------------------------------------------------------------------------------------------------


def events(scene: SceneReport, ident: str) -> Drawing:
    """Which part of a scene was in which state, as strips."""
    elements = list(dict.fromkeys(event.element for event in scene.events))
    shown = elements[:MOST_CURVES]
    end = max([event.time for event in scene.events] + [load.window[1] for load in scene.loads if load.window])
    states = list(dict.fromkeys(state for event in scene.events for state in (event.before, event.after)))
    unit = display_unit(end, TIME)
    factor = unit_of(unit)[0]

    def draw(axes: "Axes") -> None:
        axes.set_xlim(0.0, end / factor or 1.0)
        axes.set_ylim(len(shown) - 0.5, -0.5)
        axes.set_yticks(range(len(shown)), [str(number) for number in range(1, len(shown) + 1)])
        for row, element in enumerate(shown):
            own = [event for event in scene.events if event.element == element]
            begin, state = 0.0, own[0].before
            for event in own:
                _strip(axes, row, (begin, event.time), states.index(state), factor)
                begin, state = event.time, event.after
            _strip(axes, row, (begin, end), states.index(state), factor)
            axes.plot(
                [event.time / factor for event in own], [row] * len(own), "|", color=_INK, markersize=11, zorder=4
            )

    said = " ".join(f"{element}: {_changes(scene, element)}." for element in shown)
    svg = _svg(draw, (f"time [{unit}]", "part"), ident, f"Events of {scene.name}", said, grid="x")
    keys = [Key("part", element, letter=str(number)) for number, element in enumerate(shown, 1)]
    if len(elements) > len(shown):
        keys.append(Key("", f"not shown for lack of space: {', '.join(elements[len(shown) :])}"))
    keys += [Key("state", state, colour(number)) for number, state in enumerate(states)]
    return Drawing(svg, tuple(keys))


def _strip(axes: "Axes", row: int, ends: tuple[float, float], state: int, factor: float) -> None:
    begin, end = ends
    hatch = ("", "///", "...", "xxx")[(state // COLOURS) % 4] or None
    axes.barh(
        row,
        (end - begin) / factor,
        left=begin / factor,
        height=0.5,
        color=_ink(state),
        alpha=0.55,
        linewidth=0,
        hatch=hatch,
    )


def _changes(scene: SceneReport, element: str) -> str:
    own = [event for event in scene.events if event.element == element]
    first = f"{own[0].before} until {digits(own[0].time)} s"
    return f"{first}, {len(own)} change{'s' * (len(own) != 1)}, at last {own[-1].after}"


# -- SVG ------------------------------------------------------------------------------------------------------------


def _svg(
    draw: Any, labels: tuple[str, str], ident: str, title: str, description: str, grid: Literal["both", "x"] = "both"
) -> str:
    """What was drawn, as SVG for a page."""
    import warnings

    import matplotlib as mpl
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure
    from matplotlib.ticker import MaxNLocator

    ours: dict[Any, Any] = {name: mpl.rcParamsDefault[name] for name in mpl.rcParamsDefault if _is_drawn(name)}
    ours |= _STYLE
    out = StringIO()
    with warnings.catch_warnings(), mpl.rc_context(ours):
        warnings.simplefilter("ignore")  # a glyph that our font lacks is the reader's to draw
        picture = Figure(figsize=(_WIDE, _HIGH))
        FigureCanvasSVG(picture)
        axes = picture.add_axes((0.145, 0.175, 0.785, 0.735))
        axes.patch.set_visible(False)
        picture.patch.set_visible(False)
        axes.spines[["top", "right"]].set_visible(False)
        axes.xaxis.set_major_locator(MaxNLocator(6))
        axes.yaxis.set_major_locator(MaxNLocator(5))
        axes.grid(axis=grid, linewidth=0.6)
        axes.set_axisbelow(True)
        draw(axes)
        axes.set_xlabel(labels[0])
        axes.set_ylabel(labels[1])
        axes.yaxis.set_label_coords(-0.13, 0.5)  # clear of `−600` in a browser's wider font
        picture.savefig(out, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    return _for_page(out.getvalue(), ident, title, description)


def _is_drawn(name: str) -> bool:
    """Whether a setting is one of how pictures look, not of what shows them: a user's own are left out of a report."""
    return not name.startswith(("backend", "interactive", "toolbar", "webagg", "tk.", "macosx"))


def _for_page(text: str, ident: str, title: str, description: str) -> str:
    """SVG of matplotlib as a part of a page: no prologue, no addresses, the page's colours, names of its own."""
    body = text[text.index("<svg") :]
    head, _, rest = body.partition(">")
    box = re.search(r'viewBox="([^"]*)"', head)
    assert box is not None
    rest = re.sub(r"<metadata>.*?</metadata>\s*", "", rest, flags=re.DOTALL)
    rest = re.sub(r"<!--.*?-->\s*", "", rest, flags=re.DOTALL)
    used = set(re.findall(r"url\(#([^)]+)\)|xlink:href=\"#([^\"]+)\"", rest))
    names = {name for pair in used for name in pair if name}
    rest = re.sub(r' id="([^"]*)"', lambda one: f' id="{ident}-{one[1]}"' if one[1] in names else "", rest)
    rest = re.sub(r"url\(#([^)]+)\)", rf"url(#{ident}-\1)", rest)
    rest = re.sub(r'xlink:href="#([^"]+)"', rf'href="#{ident}-\1"', rest)
    rest = re.sub(r'style="font: ([0-9.]+)px [^;"]*', r'style="font-size: \1px', rest)
    for ink, of_page in _INKS.items():
        rest = rest.replace(ink, of_page)
    rest = re.sub(r"\n\s*", "\n", rest)
    return (
        f'<svg viewBox="{box[1]}" role="img" aria-labelledby="{ident}-title {ident}-desc">'
        f'<title id="{ident}-title">{escape(title)}</title><desc id="{ident}-desc">{escape(description)}</desc>{rest}'
    )
