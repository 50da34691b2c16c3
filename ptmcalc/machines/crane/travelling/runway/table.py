"""Tables of the actions on the runway, for the report."""

from collections.abc import Iterator, Mapping, Sequence

from ptmcalc.contract.report import Amount, Cell, Column, LoadReport, SceneReport, TableReport
from ptmcalc.contract.result import of
from ptmcalc.laws import skew
from ptmcalc.machines.crane.travelling.assumptions import assumptions
from ptmcalc.machines.crane.travelling.machine.keys.actions import Actions
from ptmcalc.machines.crane.travelling.machine.scenes import Runway
from ptmcalc.machines.crane.travelling.machine.spec import Travelling
from ptmcalc.machines.crane.travelling.runway import loads as told
from ptmcalc.machines.crane.travelling.runway import phis
from ptmcalc.machines.crane.travelling.runway.groups import (
    DYNAMIC_TEST,
    EDITION,
    GROUPS,
    LIGHT,
    LOADED,
    OUT_OF_SERVICE,
    REMAINING,
    STATIC_TEST,
    Group,
)
from ptmcalc.machines.crane.travelling.runway.rails import driven_per_rail
from ptmcalc.machines.crane.travelling.runway.runway_actions import RUNWAY_ACTIONS

Known = Mapping[str, LoadReport]
_NONE, _MISSING = "-", "missing"
"""An action that a group does not contain, and one that the file has no data for."""
_VERTICAL = tuple(zip(("Q_r,max", "Q_r,(max)", "Q_r,(min)", "Q_r,min"), told.WHEELS, strict=True))
_HORIZONTAL = (
    ("H_L", told.DRIVES[1]),
    ("H_T,1", told.DRIVES[2]),
    ("H_T,2", told.DRIVES[3]),
    ("H_T,3", told.TROLLEY),
    ("H_B,1", told.BUFFER),
    ("H_B,2", told.TROLLEY_BUFFER),
)
"""Heading and load of each column; the first load of the drives is K, which a note describes."""
_WIND = ("F_W", told.WIND)
_FACTORS = {DYNAMIC_TEST: "1.1 phi6", STATIC_TEST: "1.25", REMAINING: "eta"}


def tables(spec: Travelling, scenes: Sequence[SceneReport]) -> Iterator[TableReport]:
    """The groups of loads, the skewing forces by wheel pair and the fatigue wheel load of a crane with a `runway`."""
    given = spec.runway
    scene = next((one for one in scenes if one.type == "runway"), None)
    if given is None or scene is None:
        return
    known = {load.info.name: load for load in scene.loads}
    own = {info.name for info in told.parts(spec)}
    yield _of_wheels(spec, given, known, own)
    yield _of_forces(spec, given, known, own)
    if told.GUIDE.of(LIGHT).name in known:
        yield _of_pairs(spec, known)
    if given.fatigue_class is not None:
        yield _of_fatigue(given, known)


def _amount(known: Known, name: str) -> Cell:
    found = known.get(name)
    return _MISSING if found is None else Amount(found.estimate, found.info.quantity)


def _of_wheels(spec: Travelling, given: Actions, known: Known, own: set[str]) -> TableReport:
    columns = (
        Column("group", "group"),
        *(Column(info.name, heading) for heading, info in _VERTICAL),
        Column("factors", "factors of crane and hoist load"),
    )
    rows = tuple(
        (
            group.name,
            *(_cell(known, own, of(info.name, group.name)) for _, info in _VERTICAL),
            f"{group.crane}, {_FACTORS.get(group.hoist, group.hoist) if group.hoist is not None else _NONE}",
        )
        for group in GROUPS
    )
    title = f"Wheel loads on the runway, {EDITION}: characteristic values"
    return TableReport("runway", title, columns, rows, tuple(_notes_on_wheels(spec, given, known)))


def _of_forces(spec: Travelling, given: Actions, known: Known, own: set[str]) -> TableReport:
    """Horizontal forces of the groups that contain one; H_TA is one of a guided load."""
    shown = (*_HORIZONTAL, _WIND) if spec.wind is not None else _HORIZONTAL
    guided = given.suspension == "guided"
    columns = (
        Column("group", "group"),
        *(Column(info.name, heading) for heading, info in shown),
        Column("S", "S"),
        *([Column("H_TA", "H_TA")] if guided else []),
    )
    rows: list[tuple[Cell, ...]] = []
    for group in GROUPS:
        cells = [_cell(known, own, of(info.name, group.name)) for _, info in shown]
        cells.append(_guide_force(known) if group.skewing else _NONE)
        if guided:
            cells.append(_MISSING if group.tilting else _NONE)
        if any(one != _NONE for one in cells):
            rows.append((group.name, *cells))
    title = f"Horizontal forces on the runway, {EDITION}: characteristic values"
    return TableReport("runway forces", title, columns, tuple(rows), tuple(_notes_on_forces(spec, given, known)))


def _cell(known: Known, own: set[str], name: str) -> Cell:
    return _amount(known, name) if name in own else _NONE


def _guide_force(known: Known) -> Cell:
    """The larger skewing force of both rails."""
    both = [known[name] for rail in (LIGHT, LOADED) if (name := told.GUIDE.of(rail).name) in known]
    return _amount({"S": max(both, key=lambda one: one.estimate.value)}, "S") if both else _MISSING


def _notes_on_wheels(spec: Travelling, given: Actions, known: Known) -> Iterator[str]:
    """What the wheel loads mean, and what is missing or to be compared."""
    yield (
        "loads of one wheel; Q_r,(max) and Q_r,(min) accompany Q_r,max and Q_r,min on the other rail; the unloaded"
        " crane is without hook block"
    )
    factors = phis.of_actions(spec, given)
    yield ", ".join(f"{name} {factors[name]:.4g}" for name in phis.PHIS if name in factors)
    yield f"groups 6 to 10: quoted from memory, to be compared with {EDITION}"
    yield "partial factors are not included: 1.35 unfavourable, test 1.1, accidental 1.0 (to be compared with annex A)"
    for group in GROUPS:
        if group.hoist is not None and told.WHEELS[0].of(group.name).name not in known:
            yield f"missing: group {group.name} needs {_keys_of(group)}"


def _keys_of(group: Group) -> str:
    """What gives the factor on the hoist load."""
    key = "phi6" if group.hoist == DYNAMIC_TEST else "phi2"
    return f"`class.hoisting` and `suspension.hoist_speed`, or `runway.{key}`"


def _notes_on_forces(spec: Travelling, given: Actions, known: Known) -> Iterator[str]:
    """What the horizontal forces mean, and what is missing or to be compared."""
    yield (
        "H_L of each rail; H_T,1 of the light and H_T,2 of the loaded rail are couples; forces of different groups are"
        " not added"
    )
    if told.DRIVES[0].of("4").name in known:
        state = "has the factor of its group (K_with_phi: true)" if given.K_with_phi else "is that of static loads"
        yield f"the drive force K {state}; group 2 has the load shares of group 1, group 3 those of the loaded crane"
    yield (
        "H_T,3 and H_B,2 are 10 % of trolley and hoist load; they and the actions of groups 6 to 10 are quoted from"
        f" memory, to be compared with {EDITION}"
    )
    for reason in dict.fromkeys(_missing(spec, given, known)):
        yield f"missing: {reason}"


def _missing(spec: Travelling, given: Actions, known: Known) -> Iterator[str]:
    """What the file has no data for."""
    if driven_per_rail(spec) is not None:
        for group in GROUPS:
            if group.drives and told.DRIVES[2].of(group.name).name not in known:
                yield f"H_T of group {group.name} needs {_keys_of(group)}"
    else:
        yield "H_L and H_T need equal numbers of driven wheels on both rails (`wheels.driven`)"
    if told.GUIDE.of(LIGHT).name not in known:
        angle = "runway_skew_angle" in known
        yield "skewing forces of a crane with an unloaded rail" if angle else "S and H_S need `guide` or `skew_angle`"
    if spec.buffers is None:
        yield "H_B,1 needs `buffers`"
    elif told.BUFFER.of("9").name not in known:
        yield "H_B,1 of buffers that bottom out has no upper limit (scene `collision`)"
    if spec.wind is None:
        yield "F_W needs `wind`, for a crane outdoors"
    elif any(told.WIND.of(one.name).name not in known for one in GROUPS if one.wind == OUT_OF_SERVICE):
        yield "F_W out of service needs `wind.pressure_storm`"
    if given.suspension == "guided":
        yield "H_T,3, H_B,2 and H_TA of a guided load are not computed"


def _of_pairs(spec: Travelling, known: Known) -> TableReport:
    columns = (
        Column("pair", "front guide on, wheel pair"),
        *(
            Column(info.name, heading)
            for heading, info in zip(("H_S,L", "H_S,1,T", "H_S,2,T", "S - H_S,1,T"), told.BY_PAIR, strict=True)
        ),
    )
    forces = set(known)
    rows = tuple(
        (f"{rail}, {number}", *(_cell(known, forces, of(info.name, f"{rail}, {number}")) for info in told.BY_PAIR))
        for rail in (LIGHT, LOADED)
        for number in (1, 2)
    )
    return TableReport(
        "runway skewing", f"Skewing forces of group 5, {EDITION}", columns, rows, tuple(_notes_on_skewing(spec, known))
    )


def _notes_on_skewing(spec: Travelling, known: Known) -> Iterator[str]:
    angle, share = (known[name].estimate.value for name in ("runway_skew_angle", "runway_skew_share"))
    guide, given = spec.guide, spec.runway
    if guide is None or (given is not None and given.skew_angle is not None):
        yield f"alpha {angle:.4g} rad of the file, f {share:.4g}"
    else:
        used = skew.skew_play(guide.clearance, skew.LEAST_PLAY[guide.type], skew.EN_1991_3)
        yield (
            f"alpha {angle:.4g} rad, f {share:.4g}: clearance {1000 * used:.4g} mm (0.75 x, at least"
            f" {1000 * skew.LEAST_PLAY[guide.type]:.4g} mm), wear {1000 * (guide.wear or 0.0):.4g} mm, tolerance"
            f" {guide.tolerance:.4g} rad; EN 13001-2 (CRN174) has another clearance and therefore another force"
        )
        yield from _with_other_wear(spec)
    yield (
        "rail 1 is that of the front guide; H_S,L acts on both rails, in opposite directions; flanges of the"
        " front wheel take S - H_S,1,T; a pair is the front or rear corners of both rails"
    )


def _with_other_wear(spec: Travelling) -> Iterator[str]:
    """The skewing force at both ends of the interval of an assumed wear, or of a stated one of the same size."""
    path = ("guide", "wear")
    unworn = spec.with_value(path, None)
    assumed = next(one for one in assumptions(unworn) if one.path == path)
    if spec.value_at(path) != assumed.value(unworn):
        return
    interval = assumed.interval(unworn)
    ends = (interval.low, interval.high)
    runs = [RUNWAY_ACTIONS.run(spec.with_value(path, end), Runway(), frozenset(), 0).loads for end in ends]
    low, high = (max(one[told.GUIDE.of(rail).name].estimate.value for rail in (LIGHT, LOADED)) for one in runs)
    yield (
        f"S is {low / 1000:.4g} to {high / 1000:.4g} kN for a wear of {1000 * interval.low:.4g} to"
        f" {1000 * interval.high:.4g} mm, the interval of an assumed wear"
    )


def _of_fatigue(given: Actions, known: Known) -> TableReport:
    loads = [info for info in told.SINGLE if info.name.startswith("runway_fatigue")]
    columns = (Column("class", "S class"), *(Column(one.name, one.title.split(", ")[1]) for one in loads))
    row: tuple[Cell, ...] = (given.fatigue_class or "", *(_amount(known, one.name) for one in loads))
    notes = [f"lambda of {EDITION}, table 2.12; static wheel load of group 4 with phi4 = 1, one crane"]
    if given.fatigue_factor == "larger":
        notes.append("the larger of both factors is on crane and hoist load (fatigue_factor: larger)")
    if loads[0].name not in known:
        notes.append("missing: Q_e needs `class.hoisting` and `suspension.hoist_speed`, or `runway.phi2`")
    return TableReport("runway fatigue", f"Fatigue wheel load, {EDITION}", columns, (row,), tuple(notes))
