"""Chains whose exact numbers once moved with what was asked for."""

from support.edges import load, report_on


def test_the_bound_of_the_polygon_effect_has_a_bar() -> None:
    """The same machine at two accuracies: more harmonics move the sum of the absolute ones."""
    one, other = report_on("chain_drive/exact-moves-a"), report_on("chain_drive/exact-moves-b")
    for scene in one.scenes:
        if any(found.info.name == "tension_polygon_bound" for found in scene.loads):
            first = load(one, "tension_polygon_bound", scene.name)
            second = load(other, "tension_polygon_bound", scene.name)
            assert first.low <= second.high
            assert second.low <= first.high
