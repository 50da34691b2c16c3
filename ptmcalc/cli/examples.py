"""An example of each finding: a small file that brings it up, the command, and the line that is said.

Tests run each of them; `ptmcalc explain CODE` and the handbook show them.
"""

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from ptmcalc.contract.example import Example

_CHECK = "ptmcalc check design.yaml"

_TRAIN = """\
kind: drivetrain
inertias: {motor: {inertia: 1 kg*m^2}, fan: {inertia: 2 kg*m^2}}
links: {shaft: {between: [motor, fan], stiffness: 1 kN*m/rad, limit: 100 N*m}}
torques: {drive: {at: motor, type: constant, torque: 10 N*m}}
scenes: [{type: run, duration: 1 s}]
"""
"""The smallest sound machine: each faulty file below is this one with one fault."""

_CHAIN = """\
kind: chain_drive
layout:
  type: conveyor
  length: 40 m
  load: 120 kg/m
  resistance: {coefficient: 0.1, turn_factor: 1}
  takeup: {type: gravity, tension: 20 kN}
chain:
  pitch: 320 mm
  mass: 80 kg/m
  breaking_load: 1300 kN
  stiffness: 329.6 MN
  damping: {ratio: 0.05}
sprocket: {teeth: 8}
speed: 1.31 m/s
"""


def _with(old: str, new: str, text: str = _TRAIN) -> str:
    if text.count(old) != 1:
        raise ValueError(f"`{old}` does not stand once in the example")
    return text.replace(old, new)


def _examples() -> Iterator[tuple[str, Example]]:
    yield "BUG101", Example(f"PTMCALC_TRACEBACK=1 {_CHECK}", "", _TRAIN)
    yield "TXT101", Example("ptmcalc check no_such_file.yaml", "no_such_file.yaml: error TXT101")
    yield "TXT102", Example("ptmcalc check docs", "docs: error TXT102")
    linked = "mkdir designs && ln -s ../design.yaml designs && ptmcalc check designs"
    yield "TXT113", Example(linked, "designs/design.yaml: error TXT113", _TRAIN)
    for code, line, file in _FAULTS:
        yield code, Example(_CHECK, f"design.yaml:{line}: {_severity(code)} {code}", file)
    train, chain = _TRAIN, _CHAIN
    yield (
        "NUM101",
        Example("ptmcalc check tests/stability/specs/hoist_gear_with_play.yaml --scene stop_loaded", "NUM101"),
    )
    yield "NUM102", Example(_CHECK, "design.yaml:13:12: warning NUM102", _with("ratio: 0.05", "ratio: 0", chain))
    yield "NUM103", Example(f"{_CHECK} --budget 0s", "design.yaml:1:1: warning NUM103", train)
    yield "NUM104", Example("ptmcalc check specs/hoist.yaml --scene winding_loaded --format table", "warning NUM104")
    yield "NUM105", Example(f"{_CHECK} --accuracy 1e-12", "warning NUM105", _SLIPPING_MOTOR)
    yield "NUM106", Example(_CHECK, "warning NUM106", _CHATTERING)
    yield "NUM107", Example("ptmcalc check specs/chain_drive.yaml --format table", "note NUM107")
    yield "NUM108", Example(f"{_CHECK} --format table", "NUM108", _with("length: 40 m", "length: 25 m", chain))
    yield "NUM109", Example(_CHECK, "design.yaml:15:8: warning NUM109", _with("1.31 m/s", "0.95 m/s", chain))
    swinging = "tests/stability/specs/travelling_brake_beside_a_heavy_load.yaml"
    yield "NUM110", Example(f"ptmcalc check {swinging}", "warning NUM110")
    yield "NUM111", Example(_CHECK, "", train)
    yield "NUM112", Example("ptmcalc check tests/edges/conveyor/unequal-drives.yaml --format table", "note NUM112")
    yield "NUM113", Example("ptmcalc check tests/edges/hoist/limiter.yaml --format table", "note NUM113")
    yield (
        "SPC204",
        Example(_CHECK, "design.yaml:6:9: warning SPC204", f"{_TRAIN}checks: {{DRV101: {{off: a test rig}}}}\n"),
    )
    yield "SPC205", Example("ptmcalc check tests/edges/hoist/huge-drum.yaml", "error SPC205")


def _severity(code: str) -> str:
    return "warning" if code.startswith("SPC2") else "error"


_SLIPPING_MOTOR = """\
kind: drivetrain
inertias: {motor: {inertia: 1 kg*m^2}, fan: {inertia: 2 kg*m^2}}
links: {shaft: {between: [motor, fan], stiffness: 1 kN*m/rad, limit: 500 N*m}}
motors:
  main:
    at: motor
    motor: {type: induction, power: 11 kW, speed: 960 rpm, synchronous_speed: 1000 rpm, overload: 2.4}
scenes: [{type: start}]
"""
_CHATTERING = """\
kind: drivetrain
inertias: {flap: {inertia: 1 kg*m^2}}
links: {stop: {between: [flap, ground], stiffness: 1 MN*m/rad, gap: 0.2 mrad, limit: 900 N*m}}
torques: {wind: {at: flap, type: constant, torque: 10 N*m}}
scenes: [{type: run, duration: 9 s}]
"""
_GEARED = """\
kind: drivetrain
inertias: {motor: {inertia: 1 kg*m^2}, fan: {inertia: 2 kg*m^2}}
gears: {worm: {from: motor, to: fan, ratio: 20, efficiency: 0.7, reverse_efficiency: 0.8}}
torques: {drive: {at: motor, type: constant, torque: 10 N*m}}
scenes: [{type: run, duration: 1 s}]
"""
_OLD_ENCODING = """\
# saved as Latin-1, not as UTF-8
kind: drivetrain
name: M\N{LATIN SMALL LETTER U WITH DIAERESIS}hle
"""

_FAULTS = (
    ("TXT103", "3:8", _OLD_ENCODING),
    ("TXT104", "1:1", "# a comment and nothing else\n"),
    ("TXT105", "2:7", "kind: drivetrain\nname: 'no end\n"),
    ("TXT106", "6:1", f"{_TRAIN}scenes: [{{type: run, duration: 2 s}}]\n"),
    ("TXT107", "6:7", f"{_TRAIN}name: !!python/name:os.system\n"),
    ("TXT108", "1:113", f"description: {'[' * 101}{']' * 101}\n"),
    ("TXT109", "6:1", f"{_TRAIN}---\nkind: shaft\n"),
    ("TXT110", "6:7", f"{_TRAIN}name: *other\n"),
    ("TXT111", "6:3", f"{_TRAIN}? [name, description]\n: fan\n"),
    ("TXT112", "1:1", "- kind: drivetrain\n"),
    ("SPC101", "1:1", _with("kind: drivetrain\n", "")),
    ("SPC102", "1:7", _with("kind: drivetrain", "kind: drive_train")),
    ("SPC103", "5:10", _with(", duration: 1 s", "")),
    ("SPC104", "6:1", f"{_TRAIN}nme: fan\n"),
    ("SPC105", "2:29", _with("1 kg*m^2}, ", "1 kg}, ")),
    ("SPC106", "4:54", _with("10 N*m}", "10}")),
    ("SPC107", "2:29", _with("1 kg*m^2}, ", "1,5 kg*m^2}, ")),
    ("SPC108", "4:54", _with("10 N*m}", "10 kgf*m}")),
    ("SPC109", "4:54", _with("10 N*m}", ".nan}")),
    ("SPC110", "2:29", _with("1 kg*m^2}, ", "-1 kg*m^2}, ")),
    ("SPC111", "2:11", _with("{motor: {inertia: 1 kg*m^2}, fan: {inertia: 2 kg*m^2}}", "12 kg*m^2")),
    ("SPC112", "4:36", _with("type: constant", "type: steady")),
    ("SPC113", "5:38", _with("1 s}]", "1 s}, {type: run, duration: 9 s}]")),
    ("SPC114", "4:54", _with("10 N*m}", "ten N*m}")),
    ("SPC201", "3:86", _GEARED),
    ("SPC202", "6:61", f'{_TRAIN}waive: [{{check: DRV101, reason: "a test rig of old", until: 2020-01-31}}]\n'),
    ("SPC203", "6:17", f'{_TRAIN}waive: [{{check: DRV101, reason: "a test rig", until: 2999-01-31}}]\n'),
)

EXAMPLES: Mapping[str, Example] = MappingProxyType(dict(_examples()))
