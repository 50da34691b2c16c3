"""What `ptmcalc scale` prints: the loads of a physical model beside those of the machine."""

import math
import re
from dataclasses import asdict
from pathlib import Path
from shutil import get_terminal_size
from typing import Any

from ptmcalc.base.errors import UsageError
from ptmcalc.base.units import digits, without_commas
from ptmcalc.cli.output import say
from ptmcalc.contract.report import FileReport, exit_status
from ptmcalc.engine.load import Loaded, load_file
from ptmcalc.engine.scale import ModelLoad, ModelReport, PhysicalModel, physical_model, report_on
from ptmcalc.report import Format, json, render, words
from ptmcalc.report.drawing import paragraph
from ptmcalc.report.table import listing

_SMALLEST, _LARGEST = 1e-6, 1e6
_NUMBER = r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
_RATIO = re.compile(rf"\s*({_NUMBER})\s*(?::\s*({_NUMBER})\s*)?")


def show_scale(
    path: str, scenes: tuple[str, ...], law: str, length: str, others: dict[str, str], *, as_json: bool
) -> int:
    """Print what a model shows; `others` are the ratios of modulus, density and gravity, empty where not given.

    The exit status is that of the file: 0, or 2 when it is invalid.
    """
    given = {name: ratio(f"--{name}", text) for name, text in others.items() if text}
    model = physical_model(law, ratio("--length", length), **given)
    loaded = load_file(Path(path), Path(path).as_posix())
    if loaded.kind is None or loaded.spec is None:
        report = FileReport(loaded.document.name, diagnostics=loaded.diagnostics)
        say(render(Format.PLAIN, [report]), err=True)
        return exit_status((report,))
    found = report_on(loaded.kind, loaded.spec, model, scenes)
    say(_document(found) if as_json else _tables(loaded, found))
    return 0


def ratio(option: str, text: str) -> float:
    """Model over prototype as the command line says it: `1:10` or `0.1`.

    Raises:
        UsageError: it is no ratio, or none that a model can have.
    """
    match = _RATIO.fullmatch(text)
    if match is None:
        plain = without_commas(text.strip())
        raise UsageError(f"{option} `{text}` is not a ratio", f"write {plain or 'model to prototype, 1:10 or 0.1'}")
    model, prototype = float(match[1]), float(match[2] or 1)
    found = model / prototype if prototype else math.inf
    if not (model > 0 and prototype > 0 and _SMALLEST <= found <= _LARGEST):
        raise UsageError(
            f"{option} `{text}` is out of range", f"a ratio of model to prototype is {_SMALLEST:g} to {_LARGEST:g}"
        )
    return found


# -- JSON -----------------------------------------------------------------------------------------------------------


def _document(found: ModelReport) -> str:
    model = found.model
    ratios = {"modulus": model.modulus, "density": model.density, "gravity": model.gravity}
    return json.dump(
        {
            "schema_version": json.SCHEMA_VERSION,
            "law": model.law,
            "rows": [_row(load) for load in found.loads],
            "scales": asdict(model.scales) | ratios,
            "follows": model.follows or None,
            "distortions": list(found.distortions),
            "findings": [{"code": finding.code, "message": finding.message} for finding in found.findings],
        }
    )


def _row(load: ModelLoad) -> dict[str, Any]:
    model = load.model
    row: dict[str, Any] = {
        "scene": load.scene,
        "load": load.info.name,
        "prototype": json.finite(load.prototype.value),
        "model": json.finite(model.value if model else None),
        "low": json.finite(model.low if model else None),
        "high": json.finite(model.high if model else None),
        "scale": load.scale,
        "unit": load.info.quantity.si,
    }
    if model and not model.bounded:
        row["unbounded"] = True
    if load.scale is None:
        row |= {"distorted": True, "similar": json.finite(load.similar)}
    return row


# -- tables ---------------------------------------------------------------------------------------------------------


def _tables(loaded: Loaded, found: ModelReport) -> str:
    assert loaded.spec is not None
    title = "  ".join(filter(None, (loaded.document.name, loaded.spec.kind, loaded.spec.name)))
    wide = get_terminal_size((120, 40)).columns
    scales = [[name, digits(value)] for name, value in asdict(found.model.scales).items()]
    loads = [_cells(load) for load in found.loads if load.info.headline]
    said = [line for text in words.printable(found.distortions) for line in paragraph(text, wide, "  - ", "    ")]
    remarks = [line for one in words.printable(found.findings) for line in paragraph(f"{one.code} {one.message}", wide)]
    return "\n".join(
        [
            str(words.printable(title)),
            f"model by the law `{found.model.law}`: {_ratios(found.model)}",
            "",
            "Scales",
            listing(("quantity", "model/prototype"), scales, width=wide),
            "Loads",
            listing(("scene", "load", "prototype", "scale", "model"), loads, width=wide),
            "What this model distorts",
            "",
            *said,
            *("", *remarks) * bool(remarks),
            "",
        ]
    )


def _ratios(model: PhysicalModel) -> str:
    ratios = {"length": model.length, "modulus": model.modulus, "density": model.density, "gravity": model.gravity}
    return ", ".join(
        f"{name} {digits(value)}{' (follows)' * (name == model.follows)}" for name, value in ratios.items()
    )


def _cells(load: ModelLoad) -> list[str]:
    quantity = load.info.quantity
    return [
        load.scene,
        load.info.title,
        words.amount(load.prototype, quantity),
        "distorted" if load.scale is None else digits(load.scale),
        words.amount(load.model, quantity) if load.model else "unknown",
    ]
