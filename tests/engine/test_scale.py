"""Loads of a physical model: against a machine whose file has every value at the model's scale, and by hand."""

import math
import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
import yaml
from support.toy_kind import PULL, STATICS, Hang, Toy
from support.toys import KN, effect, kind_of, loaded, pull, solver

from ptmcalc.base import units
from ptmcalc.base.errors import NumericsError, UsageError
from ptmcalc.base.estimate import Estimate, Interval
from ptmcalc.base.units import Dimension, Quantity, unit_of
from ptmcalc.contract.machine import AnyKind
from ptmcalc.contract.result import Finding, Found, LoadInfo, Result
from ptmcalc.engine.load import Loaded, load_text
from ptmcalc.engine.plan import plan
from ptmcalc.engine.registry import kind_names, load_kind
from ptmcalc.engine.run import settle
from ptmcalc.engine.scale import ModelLoad, ModelReport, physical_model, report_on, scale_of
from ptmcalc.text.document import parse

TENTH = 0.1**0.5
GRID = 0.002
"""What two grids may make of a load whose bar has no end, since the motion goes on after the window."""
GIVEN: dict[str, tuple[tuple[Any, ...], tuple[float, float, float, float]]] = {
    # law, ratios: scales of mass, length, time and gravity by the table of scales
    "full": (("full", 0.1), (1e-3, 0.1, TENTH, 1.0)),
    "full, in a centrifuge": (("full", 0.1, 1.0, 1.0), (1e-3, 0.1, 0.1, 10.0)),
    "geometric": (("geometric", 0.1), (1e-3, 0.1, 0.1, 1.0)),
    "geometric, of plastic": (
        ("geometric", 0.25, 0.015, 0.15),
        (0.15 / 64, 0.25, 0.25 * (0.15 / 0.015) ** 0.5, 1.0),
    ),
    "ballast": (("ballast", 0.1), (1e-2, 0.1, TENTH, 1.0)),
}


def report(kind: AnyKind, *ratios: Any, **data: Any) -> ModelReport:
    """The model of a toy."""
    spec = loaded(kind, **data).spec
    assert spec is not None
    return report_on(kind, spec, physical_model(*ratios))


def only(found: ModelReport, name: str = "pull") -> ModelLoad:
    (load,) = (load for load in found.loads if load.info.name == name)
    return load


# -- every value of the file at its scale ---------------------------------------------------------------------------


def at_scale(node: Any, scale: Callable[[Dimension], float]) -> Any:
    """The data of a file with every value times the scale of its dimension."""
    if isinstance(node, dict):
        return {key: at_scale(value, scale) for key, value in node.items()}
    if isinstance(node, list):
        return [at_scale(value, scale) for value in node]
    written = re.fullmatch(r"([-+]?[0-9.]+(?:e[-+]?[0-9]+)?) (\S+)", node) if isinstance(node, str) else None
    if written is None:
        return node
    return f"{float(written[1]) * scale(unit_of(written[2])[1])!r} {written[2]}"


def built(machine: Loaded, scales: tuple[float, float, float, float]) -> Loaded:
    """The model as a machine of its own, in its own gravity; what the file leaves to assumptions is at scale too."""

    def scale(dimension: Dimension) -> float:
        return math.prod(ratio**power for ratio, power in zip(scales[:3], dimension[:3], strict=True))

    data = at_scale(machine.document.data, scale)
    for value in machine.assumed:
        *parents, key = value.path
        node = data
        for step in parents:
            node = node[step] if isinstance(step, int) else node.setdefault(step, {})
        changed = value.value * scale(value.quantity.dimension)
        node[key] = changed if value.quantity.si == "1" else f"{changed!r} {value.quantity.si}"
    assert machine.spec is not None
    data["gravity"] = f"{machine.spec.gravity * scales[3]!r} m/s^2"
    model = load_text(yaml.safe_dump(data, sort_keys=False).encode(), "model.yaml")
    assert model.spec is not None, model.diagnostics
    return model


@pytest.mark.parametrize("given", GIVEN)
@pytest.mark.parametrize("name", kind_names())
def test_the_model_is_the_machine_with_every_value_at_its_scale(name: str, given: str) -> None:
    """The template of every kind gives all its values, so that its model can be written down and computed."""
    ratios, scales = GIVEN[given]
    text = load_kind(name).template.encode()
    machine = load_text(text, "machine.yaml")
    model = built(replace(machine, document=parse(text, "machine.yaml")), scales)
    assert machine.kind is not None
    assert machine.spec is not None
    assert model.spec is not None
    shown = report_on(machine.kind, machine.spec, physical_model(*ratios))
    computed = {
        (one.scene.label, load): best.estimate
        for one in plan(machine.kind, model.spec).scenes
        for load, best in settle(machine.kind, model.spec, one).loads.items()
    }
    assert len(shown.loads) > 15
    for load in shown.loads:
        if load.model is None:  # an effect that the model does not call for has no loads of its own
            assert (load.scene, load.info.name) not in computed
            continue
        other = computed[load.scene, load.info.name]
        bounded = load.model.bounded and other.bounded
        bars = load.model.bar + other.bar if bounded else GRID * abs(other.value)
        assert load.model.value == pytest.approx(other.value, rel=1e-6, abs=bars + 1e-12), load.info.name


# -- scales by dimension --------------------------------------------------------------------------------------------

BY_NAME: dict[str, Quantity] = {
    "length": units.LENGTH,
    "displacement": units.SPAN,
    "force": units.FORCE,
    "stress": units.STRESS,
    "mass": units.MASS,
    "stiffness": units.STIFFNESS,
    "frequency": units.FREQUENCY,
    "time": units.TIME,
    "velocity": units.SPEED,
    "acceleration": units.ACCELERATION,
    "moment": units.TORQUE,
    "inertia": units.INERTIA,
    "torsion": units.TORSIONAL_STIFFNESS,
    "damping": units.DAMPING,
}


@pytest.mark.parametrize("given", GIVEN)
def test_a_scale_by_dimension_is_that_of_the_law(given: str) -> None:
    of = physical_model(*GIVEN[given][0]).scales
    for name, quantity in BY_NAME.items():
        assert scale_of(quantity, of) == pytest.approx(getattr(of, name), rel=1e-12), name
    assert scale_of(units.ANGULAR_FREQUENCY, of) == pytest.approx(of.frequency, rel=1e-12)
    assert scale_of(units.TORQUE, of) == pytest.approx(scale_of(units.ENERGY, of), rel=1e-12)
    assert (scale_of(units.ANGLE, of), scale_of(units.RATIO, of), scale_of(units.SHARE, of)) == (1, 1, 1)


POWERS = {  # of the length scale, for one material: the three columns of the table of scales
    "force": (3, 2, 2),
    "mass": (3, 3, 2),
    "stiffness": (2, 1, 1),
    "frequency": (-0.5, -1, -0.5),
    "time": (0.5, 1, 0.5),
    "velocity": (0.5, 0, 0.5),
    "moment": (4, 3, 3),
    "stress": (1, 0, 0),
}


@pytest.mark.parametrize("length", [0.1, 0.04])
@pytest.mark.parametrize("name", POWERS)
def test_scales_are_those_of_the_table(name: str, length: float) -> None:
    """The first column with C_rho = C_g = 1, where the modulus follows as C_l."""
    for law, power in zip(("full", "geometric", "ballast"), POWERS[name], strict=True):
        of = physical_model(law, length).scales
        assert scale_of(BY_NAME[name], of) == pytest.approx(length**power, rel=1e-12), law


# -- ratios that are left out ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("ratios", "follows", "value"),
    [
        ((), "modulus", 0.1),
        ((None, 2.0, 3.0), "modulus", 0.6),
        ((0.5,), "density", 5.0),
        ((0.5, None, 2.0), "density", 2.5),
        ((1.0, 0.5), "gravity", 20.0),
    ],
)
def test_under_the_full_law_one_ratio_follows(ratios: tuple[Any, ...], follows: str, value: float) -> None:
    model = physical_model("full", 0.1, *ratios)
    assert model.follows == follows
    assert getattr(model, follows) == pytest.approx(value, rel=1e-12)
    assert model.modulus == pytest.approx(model.density * model.gravity * 0.1, rel=1e-12)


@pytest.mark.parametrize("law", ["geometric", "ballast"])
def test_under_the_others_what_is_left_out_is_1(law: str) -> None:
    model = physical_model(law, 0.1)
    assert (model.modulus, model.density, model.gravity, model.follows) == (1, 1, 1, "")


@pytest.mark.parametrize(
    ("ratios", "said"),
    [
        (("full", 0.1, 1.0, 1.0, 1.0), "needs a density scale of 10, not 1"),
        (("ballast", 2.0), "ballast cannot be taken off it"),
        (("free", 0.1), "a law of similarity is full, geometric or ballast"),
    ],
)
def test_a_model_that_cannot_be_is_refused(ratios: tuple[Any, ...], said: str) -> None:
    with pytest.raises(UsageError, match=said):
        physical_model(*ratios)


# -- gravity --------------------------------------------------------------------------------------------------------

WEIGHT = LoadInfo("weight", "weight on the hook", units.FORCE)
SAG = LoadInfo("sag", "sag of the rope", units.RATIO)
ROPE, SPAN = 3.0, 4.0  # kg/m, m


def _rope(spec: Toy, scene: Hang, carried: frozenset[str], level: int) -> Result:
    """A rope that the load pulls taut: its own weight, and the sag w l/(8 S) over its span."""
    own = ROPE * spec.gravity * SPAN
    found = {"pull": spec.load, "weight": own, "sag": own / (8 * spec.load)}
    return Result({name: Found(Estimate.exact(value)) for name, value in found.items()})


TAUT = kind_of(replace(STATICS, run=_rope, gives=frozenset({"pull", "weight", "sag"})), loads=(PULL, WEIGHT, SAG))


@pytest.mark.parametrize(("length", "modulus", "density"), [(0.1, 1.0, 1.0), (0.25, 0.015, 0.15)])
def test_a_copy_shows_the_weight_of_its_own_mass(length: float, modulus: float, density: float) -> None:
    """Weight C_rho C_l^3, external forces C_E C_l^2: the sag of the copy is by C_rho C_l/C_E too small."""
    found = report(TAUT, "geometric", length, modulus, density)
    force, own = modulus * length**2, density * length**3
    assert only(found).scale == pytest.approx(force, rel=1e-12)
    taut = only(found).model
    assert taut is not None
    assert taut.value == pytest.approx(8 * KN * force, rel=1e-12)
    weight, sag = only(found, "weight"), only(found, "sag")
    assert (weight.scale, sag.scale) == (None, None)
    assert weight.model is not None
    assert sag.model is not None
    assert weight.model.value == pytest.approx(ROPE * 9.81 * SPAN * own, rel=1e-12)
    assert weight.similar == pytest.approx(ROPE * 9.81 * SPAN * force, rel=1e-12)
    assert sag.model.value == pytest.approx(sag.prototype.value * own / force, rel=1e-12)
    assert sag.similar == pytest.approx(sag.prototype.value, rel=1e-12)
    said = " ".join(found.distortions)
    assert "gravity affects `weight`, `sag`: the model shows of them what the prototype would show under" in said
    assert f"under {own / force:.4g} times its gravity" in said


@pytest.mark.parametrize("ratios", [("full", 0.1), ("full", 0.1, 1.0), ("ballast", 0.1)])
def test_laws_with_gravity_distort_no_load(ratios: tuple[Any, ...]) -> None:
    found = report(TAUT, *ratios)
    assert all(load.scale is not None for load in found.loads)
    assert only(found, "sag").model == only(found, "sag").prototype
    assert "gravity affects" not in " ".join(found.distortions)


def test_a_copy_in_the_gravity_it_asks_for_distorts_no_load() -> None:
    found = report(TAUT, "geometric", 0.1, 1.0, 1.0, 10.0)
    assert [load.scale for load in found.loads] == [pytest.approx(0.01), pytest.approx(0.01), 1.0]
    assert "gravity affects" not in " ".join(found.distortions)


def test_a_machine_without_weight_is_said_to_have_none() -> None:
    found = report(kind_of(STATICS), "geometric", 0.1, shock=1.0)
    assert only(found).scale == pytest.approx(0.01)
    said = " ".join(found.distortions)
    assert "gravity affects no load of this machine as the file describes it" in said
    assert "applied as 0.01 of the prototype's force, 0.001 of its torque; the weight of the copied mass is 0.1" in said


def test_what_moves_within_its_numerical_bars_is_not_distorted() -> None:
    def rough(spec: Toy, scene: Hang, carried: frozenset[str], level: int) -> Result:
        noise = 5.0 if spec.gravity < 9 else 0.0
        return Result({"pull": Found(Estimate.within(8 * KN + noise, 3.0))})

    found = report(kind_of(replace(STATICS, run=rough)), "geometric", 0.1)
    assert only(found).scale == pytest.approx(0.01)
    model = only(found).model
    assert model is not None
    assert (model.value, model.low, model.high, model.numerical) == pytest.approx((80, 79.97, 80.03, 0.03))


def test_a_load_the_model_has_not_is_distorted_without_a_value() -> None:
    def brittle(spec: Toy, scene: Hang, carried: frozenset[str], level: int) -> Result:
        if spec.gravity < 9:
            raise NumericsError("NUM101", "it floats")
        return Result({"pull": Found(Estimate.exact(8 * KN))})

    found = report(kind_of(replace(STATICS, run=brittle)), "geometric", 0.1)
    assert (only(found).scale, only(found).model, only(found).similar) == (None, None, pytest.approx(80))
    assert ["it floats" in finding.message for finding in found.findings] == [True]


@pytest.mark.parametrize("scale", ["1e-9 m/s^2", "1e12 m/s^2"])
def test_a_gravity_that_is_out_of_range_is_refused(scale: str) -> None:
    with pytest.raises(UsageError, match="out of range"):
        report(TAUT, "geometric", 1e-4 if scale < "1e0" else 1e4, gravity=scale)


# -- what is reported -----------------------------------------------------------------------------------------------


def test_bars_are_at_scale_too() -> None:
    kind = kind_of(solver("rich", pull(8.9, 9.1)), effects=[effect("wind", 0.01, Interval(-0.1 * KN, 0.2 * KN))])
    model = only(report(kind, "geometric", 0.1)).model
    assert model is not None
    assert (model.value, model.low, model.high) == pytest.approx((90, 88, 93))
    assert (model.numerical, model.model) == pytest.approx((1, 2))


def test_an_infinite_load_stays_infinite() -> None:
    found = only(report(kind_of(solver("top", Estimate.exact(math.inf))), "geometric", 0.1))
    assert found.model == Estimate.exact(math.inf)
    assert found.scale == pytest.approx(0.01)


def test_a_load_that_gravity_makes_infinite_is_distorted() -> None:
    def weak(spec: Toy, scene: Hang, carried: frozenset[str], level: int) -> Result:
        return Result({"pull": Found(Estimate.exact(8 * KN if spec.gravity > 9 else math.inf))})

    found = only(report(kind_of(replace(STATICS, run=weak)), "geometric", 0.1))
    assert (found.scale, found.model) == (None, Estimate.exact(math.inf))


def test_figures_of_the_numerics_are_not_loads_of_a_model() -> None:
    def run(spec: Toy, scene: Hang, carried: frozenset[str], level: int) -> Result:
        found = {"pull": Found(Estimate.exact(1.0)), "weight": Found(Estimate.exact(1e-12))}
        return Result(found, health={"weight": 1e-12, "steps": 3.0})

    found = report(kind_of(replace(STATICS, run=run), loads=(PULL, WEIGHT)), "ballast", 0.1)
    assert [load.info.name for load in found.loads] == ["pull"]


def test_scenes_may_be_chosen() -> None:
    scenes = [{"type": "hang", "name": "gust", "share": 1}, {"type": "hang", "name": "calm", "share": 0.5}]
    kind = kind_of(STATICS)
    spec = loaded(kind, scenes=scenes, shock=1.0).spec
    assert spec is not None
    model = physical_model("ballast", 0.5)
    assert [load.scene for load in report_on(kind, spec, model).loads] == ["gust", "calm"]
    (calm,) = report_on(kind, spec, model, ("calm",)).loads
    assert calm.model is not None
    assert (calm.scene, calm.model.value) == ("calm", pytest.approx(KN))
    with pytest.raises(UsageError, match="unknown scene `storm`"):
        report_on(kind, spec, model, ("storm",))


def test_findings_are_handed_on_once() -> None:
    remark = Finding("NUM104", "the rope was slack for a moment")

    def run(spec: Toy, scene: Hang, carried: frozenset[str], level: int) -> Result:
        return Result({"pull": Found(pull(8))}, findings=(remark,))

    found = report(kind_of(replace(STATICS, run=run)), "geometric", 0.1)
    assert found.findings == (remark,)


@pytest.mark.parametrize("law", ["full", "geometric", "ballast"])
def test_what_no_law_scales_is_always_said(law: str) -> None:
    said = " ".join(report(kind_of(STATICS), law, 0.1).distortions)
    for part in ("damping ratio", "friction coefficients", "slope of a motor curve", "clearance", "delays"):
        assert part in said, part
    assert ("strength of a material" in said) == (law == "full")  # whose material is another one


def test_numbers_in_the_sentences() -> None:
    said = " ".join(report(kind_of(STATICS), "full", 0.25).distortions)
    assert "it has to be 0.25 times the prototype's, as an angle the same" in said
    assert "they have to be 0.5 times the prototype's, rotational speeds 2 times" in said
    assert "only with a strength 0.25 times the prototype's" in said
