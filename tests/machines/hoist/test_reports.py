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
        "rope pull at the drum",
        "rope safety Zp",
        "D/d of the drum",
        "torque at the drum",
        "motor torque, hoisting evenly",
        "heating motor torque",
        "brake torque over that of the load",
        "largest rope force, at the hook",
        "way of the lowered load to its stop",
    ]
    loads = done.out[: done.out.index("Checks")]
    places = [loads.index(row) for row in rows]
    assert places == sorted(places)
