"""What a hoist designer reads: rope, drum, motor, brake first, then what moves."""

from pathlib import Path

from support.command import ROOT, ptmcalc


def test_the_report_begins_with_rope_and_drum(tmp_path: Path) -> None:
    spec = tmp_path / "crane.yaml"
    text = (ROOT / "specs" / "hoist" / "crane_hoist_m5.yaml").read_text("utf-8")
    spec.write_text(text[: text.index("scenes:")] + "scenes: [{type: run}, {type: lower_brake}]\n", encoding="utf-8")
    done = ptmcalc("check", spec, "--format", "table")
    assert done.status == 0
    rows = [
        "rope pull at drum",
        "rope safety factor Z_p",
        "drum ratio D/d (h1)",
        "drum torque, hoisting",
        "motor torque, steady hoisting",
        "motor torque, rms",
        "brake holding torque reserve",
        "total rope force at hook",
        "lowering stopping distance",
    ]
    loads = done.out[: done.out.index("Checks")]
    places = [loads.index(row) for row in rows]
    assert places == sorted(places)
