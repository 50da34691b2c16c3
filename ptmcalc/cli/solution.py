"""What `ptmcalc solve` prints: the value at which a check just passes, what the others say there, a boundary curve."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from ptmcalc.base.diagnostic import Verdict
from ptmcalc.base.errors import UsageError
from ptmcalc.base.estimate import Estimate
from ptmcalc.base.span import KeyPath, dotted, key_path
from ptmcalc.base.units import UnitError, read, show
from ptmcalc.cli.listing import listed
from ptmcalc.cli.output import say
from ptmcalc.cli.progress import shown
from ptmcalc.cli.study import loaded_or_told
from ptmcalc.contract.check import AnyCheck
from ptmcalc.contract.report import FileReport, Judgement
from ptmcalc.engine.check import Options, check
from ptmcalc.engine.load import Loaded, changed
from ptmcalc.engine.solve import Solution, Spare, boundary, solve
from ptmcalc.engine.sweep import axis
from ptmcalc.report import json, words
from ptmcalc.spec.alias import key_of

_ACROSS = "="
Key = tuple[str, str, str]
"""Scene, code of a check, part of the machine."""


def show_solution(path: str, code: str, vary: Sequence[str], scene: str, margin: str, *, as_json: bool) -> int:
    """Print the value at which a check just passes, or the curve of such values over a second key; the exit status."""
    loaded = loaded_or_told(path, Options(scenes=(scene,) if scene else ()))
    if isinstance(loaded, int):
        return loaded
    wanted = _check(loaded, code)
    keys, ranges = ([one for one in vary if (_ACROSS in one) is across] for across in (False, True))
    if len(keys) != 1 or len(ranges) > 1:
        raise UsageError(
            "one key is solved for, and at most one more gives the curve",
            "e.g. --vary takeup.tension, and for the curve --vary 'belt.mass=10 kg/m:30 kg/m:5'",
        )
    spare = _spare(loaded, wanted, margin)
    assert loaded.spec is not None
    varied = loaded.document.as_written(key_of(key_path(keys[0]), type(loaded.spec), loaded.document.data))
    if ranges:
        return _show_boundary(loaded, wanted, varied, ranges[0], scene, spare, as_json=as_json)
    with shown():
        solution = solve(loaded, wanted, varied, scene, spare=spare)
    if solution is None:
        say(f"ptmcalc: within three decades no value of `{keys[0]}` changes the verdict of {wanted.code}\n", err=True)
        return 1
    with shown():
        now, then = (_verdicts(one, scene) for one in (loaded, changed(loaded, solution.path, solution.value)))
    if as_json:
        say(json.dump(_entry(solution) | {"checks": [_row(key, then[key], now.get(key)) for key in then]}))
        return 0
    where = f" in {scene}" if scene else ""
    beside = f" by {margin}" if margin else ""
    say(f"{dotted(solution.path)}: {_values(solution)}   {wanted.code} just passes{beside}{where}\n")
    others = {key: one for key, one in then.items() if one.code != wanted.code}
    sound = {key for key, one in others.items() if one.verdict is Verdict.PASS and one.verdict is _verdict(now, key)}
    rows = [_cells(key, one, now.get(key)) for key, one in others.items() if key not in sound]
    if rows:
        say("The other checks there\n" + listed(("verdict", "was", "check", "scene", "value", "limit", "margin"), rows))
    if sound:
        say(f"{len(sound)} other {'checks pass' if len(sound) > 1 else 'check passes'} there as before\n")
    return 0


def _verdict(found: Mapping[Key, Judgement], key: Key) -> Verdict | None:
    return found[key].verdict if key in found else None


def _check(loaded: Loaded, code: str) -> AnyCheck:
    kind, spec = loaded.kind, loaded.spec
    assert kind is not None
    assert spec is not None
    wanted = next((one for one in kind.checks if one.code == code.upper()), None)
    if wanted is None:
        codes = ", ".join(one.code for one in kind.checks)
        raise UsageError(f"a {kind.label} has no check `{code}`", f"checks: {codes}")
    if spec.settings.switched_off(wanted.code):
        raise UsageError(f"{wanted.code} is switched off in this file", f"delete `{wanted.code}` under `checks`")
    return wanted


def _spare(loaded: Loaded, wanted: AnyCheck, margin: str) -> Spare:
    """The margin that is wanted beside a limit: a share of it, or a number in its unit."""
    if not margin:
        return lambda limit: 0.0
    assert loaded.kind is not None
    assert loaded.spec is not None
    quantity = loaded.kind.quantity_of(loaded.spec, wanted)
    share = margin.strip().endswith("%")
    try:
        number = float(margin.strip().removesuffix("%")) / 100 if share else read(margin, quantity)
    except (UnitError, ValueError) as error:
        hint = error.hint if isinstance(error, UnitError) else ""
        raise UsageError(f"`--margin {margin}` is not a margin", hint or "write e.g. `10 %`") from None
    if not (math.isfinite(number) and number >= 0):
        raise UsageError(f"`--margin {margin}` is not a margin", "write one from 0 up, e.g. `10 %`")

    def spare(limit: Estimate) -> float:
        if share and limit.value == 0:
            raise UsageError(
                f"the limit of {wanted.code} is 0: no share of it is a margin", f"write it in {quantity.si}"
            )
        return number * abs(limit.value) if share else number

    return spare


def _verdicts(loaded: Loaded, scene: str) -> dict[Key, Judgement]:
    """The verdicts of a machine by (scene, check, part), the worst first."""
    report: FileReport = check(loaded, Options(scenes=(scene,) if scene else (), repairs=False))
    return {(name, one.code, one.element): one for name, one in words.worst_first(report)}


def _values(solution: Solution) -> str:
    ends = [solution.value] if solution.other is None else sorted((solution.value, solution.other))
    return " or ".join(show(value, solution.quantity, 6) for value in ends)


def _entry(solution: Solution) -> dict[str, object]:
    found: dict[str, object] = {"path": list(solution.path), "value": solution.value, "unit": solution.quantity.si}
    return found if solution.other is None else found | {"other": solution.other}


def _row(key: Key, one: Judgement, before: Judgement | None) -> dict[str, object]:
    scene, code, element = key
    numbers: dict[str, object] = {
        "value": None if one.value is None else json.finite(one.value.value),
        "limit": None if one.limit is None else json.finite(one.limit.value),
        "margin": None if one.margin is None else json.finite(one.margin),
    }
    verdicts: dict[str, object] = {"verdict": one.verdict.value, "was": before.verdict.value if before else None}
    about: dict[str, object] = {"scene": scene, "code": code, "unit": one.quantity.si}
    return about | verdicts | numbers | ({"element": element} if element else {})


def _cells(key: Key, one: Judgement, before: Judgement | None) -> list[str]:
    was = before.verdict.value.replace("_", " ") if before and before.verdict is not one.verdict else ""
    value, limit = words.value(one), words.amount(one.limit, one.quantity) if one.limit else ""
    return [
        one.verdict.value.replace("_", " "),
        was,
        f"{one.code} {words.subject(one)}",
        key[0],
        value,
        f"{words.SIGN[one.sense]} {limit}" if limit else "",
        words.margin(one),
    ]


def _show_boundary(
    loaded: Loaded, wanted: AnyCheck, path: KeyPath, text: str, scene: str, spare: Spare, *, as_json: bool
) -> int:
    """The curve over the second key on which the check just passes."""
    along = axis(loaded, text, counted=True)
    values = along.at(np.linspace(0, 1, along.count)).tolist()
    with shown():
        found = list(boundary(loaded, wanted, path, along.key.path, values, scene, spare))
    if as_json:
        rows = [
            {
                "along": {"path": list(along.key.path), "value": value, "unit": along.key.quantity.si},
                "solution": _entry(one) if one else None,
            }
            for value, one in found
        ]
        say(json.rows(rows))
    else:
        cells = [
            (show(value, along.key.quantity, 6), _values(one) if one else "none within three decades")
            for value, one in found
        ]
        say(f"{wanted.code} just passes\n" + listed((along.key.name, dotted(path)), cells))
    return 0 if any(one for _, one in found) else 1
