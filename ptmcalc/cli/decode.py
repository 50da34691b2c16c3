"""`ptmcalc decode`: torques from a measured speed record."""

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ptmcalc.base.errors import UsageError
from ptmcalc.cli.output import say

if TYPE_CHECKING:
    from ptmcalc.base.units import Quantity
    from ptmcalc.machines.shaft.records.decoding import Decoded


class Phase(StrEnum):
    """What a record shows."""

    RUN_UP = "run_up"
    RUN_OUT = "run_out"
    BRAKE = "brake"


class Format(StrEnum):
    """Output format."""

    TABLE = "table"
    JSON = "json"


def decode(
    path: Annotated[str, typer.Argument(help="A design file of a shaft.")],
    record: Annotated[str, typer.Argument(help="A CSV file with the columns time and speed, of the main shaft.")],
    phase: Annotated[Phase, typer.Option("--phase", help="Type of motion in the record.")],
    start: Annotated[str, typer.Option("--from", help="Angle of the main shaft at the first sample.")] = "0 deg",
    window: Annotated[
        str, typer.Option("--window", help="Length of the fitted segments, e.g. 50 ms; default: automatic.")
    ] = "",
    form: Annotated[Format, typer.Option("--format", help="Output format.")] = Format.TABLE,
) -> None:
    """Decode a measured speed record: motor curve, losses or brake torque, with their uncertainty.

    Columns are in s and rad/s unless their heads state other units: `time [ms],speed [rpm]`. The machine runs without
    its useful load.
    """
    from pathlib import Path

    import numpy as np

    from ptmcalc.base import units
    from ptmcalc.contract.report import FileReport, exit_status
    from ptmcalc.engine.load import load_file
    from ptmcalc.machines.shaft.machine.model import machine_of
    from ptmcalc.machines.shaft.machine.spec import Shaft
    from ptmcalc.machines.shaft.records.decoding import decoded
    from ptmcalc.report import Format as Plain
    from ptmcalc.report import render
    from ptmcalc.text.record import read_columns, rising

    angle = _option("--from", start, units.ANGLE)
    length = _option("--window", window, units.TIME) if window else None
    if length is not None and length <= 0:
        raise UsageError(f"`--window`: `{window}` is out of range: it must be greater than 0 s", "write e.g. `50 ms`")
    loaded = load_file(Path(path), Path(path).as_posix())
    if loaded.spec is None:
        report = FileReport(loaded.document.name, diagnostics=loaded.diagnostics)
        say(render(Plain.PLAIN, [report]), err=True)
        raise typer.Exit(exit_status((report,)))
    if not isinstance(loaded.spec, Shaft):
        raise UsageError(f"`{path}` describes no shaft", "a record is decoded with the inertia of a `kind: shaft`")
    file = Path(record)
    times, speeds = read_columns(file, {"time": units.TIME, "speed": units.ANGULAR_SPEED})
    rising(file, times, "time")
    found = decoded(machine_of(loaded.spec, "idle"), phase.value, np.array(times), np.array(speeds), angle, length)
    say(_json(found) if form is Format.JSON else _table(found))


def _option(name: str, text: str, quantity: "Quantity") -> float:
    from ptmcalc.base.units import UnitError, read

    try:
        return read(text, quantity)
    except UnitError as error:
        raise UsageError(f"`{name}`: {error.reason}", error.hint) from None


def _json(found: "Decoded") -> str:
    from ptmcalc.report import json

    rows: list[dict[str, Any]] = [
        {"time": row.time, "speed": row.speed, "torque": row.torque, "uncertainty": row.uncertainty}
        for row in found.rows
    ]
    values = [
        {"name": one.name, "value": one.value, "uncertainty": one.uncertainty, "unit": one.quantity.si}
        for one in found.values
    ]
    head = {"schema_version": json.SCHEMA_VERSION, "phase": found.phase, "shaft": found.shaft}
    return json.dump(head | {"noise": found.noise, "window": found.window, "values": values, "rows": rows})


def _table(found: "Decoded") -> str:
    from shutil import get_terminal_size

    from ptmcalc.base import units
    from ptmcalc.report.table import listing

    width = get_terminal_size((120, 40)).columns
    shaft = f"{found.shaft} shaft"
    columns = ("time", f"speed, {shaft}", f"torque, {shaft}", "uncertainty (2.6 s)")
    cells = [
        [
            f"{row.time:.4g} s",
            units.show(row.speed, units.ANGULAR_SPEED),
            units.show(row.torque, units.TORQUE),
            units.show(row.uncertainty, units.TORQUE, 2),
        ]
        for row in found.rows
    ]
    text = listing(columns, cells, width=width)
    for one in found.values:
        text += f"{one.title}: {units.show(one.value, one.quantity)} ± {units.show(one.uncertainty, one.quantity, 2)}\n"
    noise = units.show(found.noise, units.ANGULAR_SPEED, 2)
    return text + f"noise of a sample {noise}; fitted over {units.show(found.window, units.TIME, 2)}\n"
