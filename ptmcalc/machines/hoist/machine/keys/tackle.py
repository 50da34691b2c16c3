"""What carries the load, as a designer writes it: reeving, rope, drum, and the structure it hangs on."""

import math
from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from ptmcalc.base import units
from ptmcalc.spec.fields import (
    Efficiency,
    FactorFromOne,
    Fraction,
    Inertia,
    Mass,
    Measure,
    PositiveArea,
    PositiveForce,
    PositiveFraction,
    PositiveLength,
    PositiveLineMass,
    PositiveSpan,
    PositiveStiffness,
    PositiveStress,
    Span,
)
from ptmcalc.spec.fragment import Conflict, Fragment, Given, at_most_one, exactly_one
from ptmcalc.spec.optional import Absent, Assumed, Checked, Limit, OneOf, Setting

MOST_FALLS = 64
"""Falls of rope that a file may state; an engineering choice. It rejects misprints: a larger number accepts more of
them, a smaller one refuses heavy hoists."""

Wraps = Annotated[float, Measure(units.FACTOR, at_least=0, at_most=100)]


class Reeving(Fragment):
    """Reeving between drum, sheaves and hook block."""

    falls: Annotated[int, Field(strict=True)]
    """total number of rope falls at the hook block"""
    ropes: Literal[1, 2] = 1
    """number of ropes on the drum: 2 for a twin reeving with an equalising sheave"""
    sheave_efficiency: Annotated[Efficiency | None, Assumed()] = None
    """of a sheave of the reeving; 0.98 is assumed when it is left out"""
    deflection_sheaves: Annotated[
        int, Field(ge=0, le=40, strict=True), Absent("no sheaves between drum and hook block reeving")
    ] = 0
    """deflection sheaves between drum and hook block reeving, per rope"""
    deflection_efficiency: Annotated[Efficiency | None, Assumed()] = None
    """of a deflection sheave; default: that of the reeving sheaves"""
    sheave_diameter: Annotated[PositiveLength | None, Checked()] = None
    """of the sheaves at the bottom of the groove; needed to check the sheave ratio"""
    equaliser_diameter: Annotated[PositiveLength | None, Checked()] = None
    """of the equalising sheave at the bottom of the groove"""
    lead_length: Annotated[Span, Absent("vertical falls to the hook block, the stiffest case")] = 0.0
    """rope length between drum and first sheave; 0 for a vertical fall to the hook block"""
    lead_offset: Annotated[Span, Setting("the middle of the rope travel, the usual drum layout")] = 0.0
    """offset of the first sheave, or of the hook block, from the middle of the rope travel along the drum, towards the
    last wraps"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The load hangs on a rope; a twin tackle has an even number of falls."""
        falls, ropes = whole(given, "falls"), given.raw.get("ropes", 1)
        if falls is None:
            return
        if falls < 1:
            reason = f"a load cannot hang on {falls} rope falls"
            yield Conflict(("falls",), reason, "write the number of falls at the hook block, e.g. `falls: 4`")
        elif falls > MOST_FALLS:
            yield Conflict(("falls",), f"{falls} falls are too many", f"write at most `falls: {MOST_FALLS}`")
        elif ropes == 2 and falls % 2:
            reason = f"{falls} falls cannot be divided between two ropes"
            yield Conflict(("falls",), reason, f"write `falls: {falls + 1}`, or `ropes: 1`")


class Rope(Fragment):
    """The wire rope."""

    diameter: PositiveLength
    """nominal diameter"""
    construction: Annotated[str, Field(max_length=200)] = ""
    """designation of the manufacturer, e.g. `6x36WS-IWRC 1960 sZ`"""
    area: Annotated[PositiveArea | None, OneOf("fill_factor")] = None
    """metallic area, or give `fill_factor`"""
    fill_factor: Annotated[PositiveFraction | None, Assumed()] = None
    """metallic area / area of the circumscribed circle; 0.5 is assumed when neither is given"""
    modulus: Annotated[PositiveStress | None, Assumed()] = None
    """modulus of elasticity of the rope on its metallic area, not of its wire; 105 GPa is assumed when left out"""
    mass: Annotated[PositiveLineMass | None, Assumed()] = None
    """per length; assumed from the diameter when it is left out"""
    breaking_force: Annotated[PositiveForce | None, Checked()] = None
    """minimum breaking force; needed to check the safety of the rope"""
    rotation_resistant: Literal["yes", "no"] = "no"
    """whether it is a rotation-resistant rope, which has a smaller permissible fleet angle"""
    damping: Annotated[Fraction, Absent("without damping, forces are maximum")] = 0.0
    """damping ratio of the load on its rope; 0 when left out, on the safe side"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The area is given in one way."""
        yield from at_most_one(given, "area", "fill_factor")


class DrumShell(Fragment):
    """Stress of the drum shell and its flanges, to check it against the yield strength."""

    material: Literal["S235", "S275", "S355"] | None = None
    """steel of EN 10025-2; the yield strength follows from the thickness"""
    yield_strength: Annotated[PositiveStress | None, OneOf("material")] = None
    """of shell and flanges, instead of `material`"""
    safety: Annotated[FactorFromOne, Limit()] = 1.5
    """yield strength / permissible stress; default: 1.5 of FEM 1.001, case I, to be compared"""
    load_factor: Annotated[FactorFromOne | None, Checked()] = None
    """phi, dynamic factor of the rope pull; default: phi_2 of the hoisting class"""
    layers: Literal["elastic", "dnv"] = "elastic"
    """pressure of several layers: of elastic layers, or 1.75 of DNV 2.22:2011 for two; `checks.layer_factor` overrides
    both"""
    modulus: Annotated[
        float,
        Measure(units.STRESS, above=0),
        Assumed(2.1e11, 2.0e11, 2.12e11, "steel 200 to 212 GPa; write that of iron"),
    ] = 2.1e11
    """modulus of elasticity of the shell"""
    span: Annotated[PositiveSpan | None, Setting("the wound length of all parts")] = None
    """distance of the bearings; default: the wound length of all parts"""
    flange_thickness: Annotated[PositiveLength | None, Checked()] = None
    """of the flanges; needed to check their stress under several layers"""
    flange_pressure: Annotated[
        float,
        Measure(units.RATIO, at_least=0, at_most=1),
        Assumed(0.4, 0.3, 0.5, "axial pressure on the flange 0.3 to 0.5 of the radial pressure, an engineering value"),
    ] = 0.4
    """axial pressure of the layers on the flanges / their radial pressure"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The strength is given in one way."""
        yield from exactly_one(given, "material", "yield_strength")


_THICKEST = 0.1
"""Thickness up to which `material` has a yield strength [m]: the end of the table of EN 10025-2 (`laws.drum_shell`)."""


class Drum(Fragment):
    """The drum."""

    diameter: PositiveLength
    """at the bottom of the grooves"""
    length: PositiveLength
    """axial length of the part for one rope"""
    surface: Literal["grooved", "smooth"] = "grooved"
    """of the barrel"""
    pitch: Annotated[PositiveLength | None, Assumed()] = None
    """groove pitch; default: 1.12 rope diameters on a grooved drum, the rope diameter on a smooth drum"""
    layers: Annotated[int, Field(ge=1, le=20, strict=True), Absent("a drum for one layer")] = 1
    """number of rope layers of the drum design"""
    dead_wraps: Annotated[Wraps, Assumed(3.0, 2.0, 5.0, "EN 14492-2: at least two dead wraps; three in practice")] = 3.0
    """dead wraps with the hook at its lowest position"""
    flange_height: Annotated[PositiveLength | None, Checked()] = None
    """of the flanges above the surface; needed for more than one layer"""
    shell_thickness: Annotated[PositiveLength | None, Checked()] = None
    """of the shell below the grooves; needed to check its stress"""
    inertia: Annotated[Inertia | None, Assumed()] = None
    """of drum and attached parts, on the drum shaft; 0 when left out"""
    shell: DrumShell | None = None
    """material and flanges, to check the equivalent stress of the shell of `shell_thickness`"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """The yield strength of a steel is known for its thickness; a shell is thinner than its drum."""
        shell, thick, size = given.block("shell"), given.number("shell_thickness"), given.number("diameter")
        if shell is None or "shell" not in given:
            return
        for key, one in (("shell_thickness", thick), ("flange_thickness", shell.number("flange_thickness"))):
            if one is not None and one > _THICKEST and "material" in shell:
                path = ("shell", key) if key == "flange_thickness" else (key,)
                reason = f"the yield strength of {units.show(one, units.LENGTH)} is not known"
                yield Conflict(path, reason, "write `yield_strength` under `shell` instead of `material`")
        if thick is not None and size is not None and 4 * thick > size:
            wall, found = units.show(thick, units.LENGTH), units.show(size, units.LENGTH)
            reason = f"a drum of {found} with a wall of {wall} is no thin shell"
            yield Conflict(("shell_thickness",), reason, "correct it, or delete `shell`")


class Structure(Fragment):
    """The supporting structure: a bridge, a jib, a trestle. Without it the support is rigid."""

    stiffness: PositiveStiffness
    """force / deflection at the hoist"""
    mass: Annotated[Mass, Absent("a massless structure follows at once")] = 0.0
    """effective mass; for a simple bridge about half of its mass, plus the trolley"""
    damping: Annotated[Fraction, Absent("without damping, forces are maximum")] = 0.0
    """damping ratio of its vibration"""


class Limiter(Fragment):
    """A rated capacity limiter: it switches the motor off."""

    factor: Annotated[
        float,
        Measure(units.FACTOR, above=0),
        Assumed(1.1, 1.1, 1.25, "EN 14492-2: set between 1.1 and 1.25 of the rated load"),
    ] = 1.1
    """trip force of the rope / static force of the rated load"""
    delay: Annotated[
        float, Measure(units.TIME, at_least=0), Assumed(0.0, 0.0, 0.2, "contactors and load cells: up to 0.2 s")
    ] = 0.0
    """from tripping to motor switch-off and brake command"""


class Winding(Fragment):
    """Arrangement of the rope in several layers on the drum."""

    packing: Literal["nested", "square"] = "nested"
    """`nested`: a layer is in the valleys of the one below; `square`: on top of it"""
    crossovers: Annotated[
        int, Field(ge=1, le=4, strict=True), Setting("two crossovers per turn, as on drums with parallel grooves")
    ] = 2
    """crossovers per turn to the next groove"""
    crossover: Annotated[Annotated[float, Measure(units.ANGLE, above=0)] | None, Assumed()] = None
    """drum angle of a crossover; 60 deg is assumed when it is left out"""
    paper_modulus: Annotated[PositiveStress | None, Setting("value of a textbook formula that decides no verdict")] = (
        None
    )
    """modulus in the formula of the winding paper; default: that of the wire, 210 GPa"""

    @classmethod
    def conflicts(cls, given: Given) -> Iterator[Conflict]:
        """Between the crossovers the rope lies in its valleys."""
        arc, count = given.number("crossover"), whole(given, "crossovers") or 2
        if arc is not None and count > 0 and arc * count >= 2 * math.pi:
            reason = f"{count} crossovers of {units.show(arc, units.ANGLE)} exceed one turn"
            yield Conflict(("crossover",), reason, "write e.g. `crossover: 60 deg`")


def _why_not_wound(pitch: float, d: float, layers: int, nested: bool) -> str | None:
    """Reason why turns of a rope of diameter d cannot be wound at a pitch p; None where they can.

    A nested layer is (d^2 - (p/2)^2)^(1/2) above the one below: at p = 2 d it is no layer, the rope reaches the drum.
    The third layer is in line with the first one: two steps of at least d are p of at most 3^(1/2) d.
    """
    thick, found = units.show(d, units.LENGTH), units.show(pitch, units.LENGTH)
    if pitch < d:
        return f"the pitch of a rope of {thick} is at least its diameter, not {found}"
    if pitch >= 2 * d:
        return f"the pitch of a rope of {thick} is less than two diameters, not {found}: another wrap would fit between"
    if nested and layers > 2 and pitch > math.sqrt(3) * d:
        most = units.show(math.sqrt(3) * d, units.LENGTH)
        return f"a third nested layer of a rope of {thick} requires a pitch of at most {most}, not {found}"
    return None


def whole(given: Given, key: str) -> int | None:
    """A whole number the file writes, as far as it is one."""
    number = given.raw.get(key)
    if isinstance(number, str) and number.lstrip("-").isdigit():
        number = int(number)
    return number if isinstance(number, int) and not isinstance(number, bool) else None


def layers_that_do_not_fit(drum: Given, rope: Given, nested: bool) -> Iterator[Conflict]:
    """Rope and drum fit together; paths begin at the machine."""
    d, big = rope.number("diameter"), drum.number("diameter")
    if d is None or big is None:
        return
    thick, size = units.show(d, units.LENGTH), units.show(big, units.LENGTH)
    if d >= big:
        reason = f"a rope of {thick} cannot be wound on a drum of {size}"
        yield Conflict(("drum", "diameter"), reason, f"write e.g. `diameter: {units.show(18 * d, units.LENGTH)}`")
        return
    pitch, length, layers = drum.number("pitch"), drum.number("length"), whole(drum, "layers") or 1
    if pitch is not None and (unwound := _why_not_wound(pitch, d, layers, nested)):
        yield Conflict(("drum", "pitch"), unwound, f"write e.g. `pitch: {units.show(1.12 * d, units.LENGTH)}`")
        return
    if length is not None and length < 3 * (pitch or d):
        reason = "it is too short for three adjacent wraps of the rope"
        yield Conflict(("drum", "length"), reason, f"write e.g. `length: {units.show(20 * d, units.LENGTH)}`")
    flange = drum.number("flange_height")
    if layers > 1 and "flange_height" not in drum:
        example = units.show(layers * d + 2 * d, units.LENGTH)
        reason = f"{layers} layers require flanges: their height is missing"
        yield Conflict(("drum", "layers"), reason, f"add `flange_height: {example}`")
    step = d if not nested else (d**2 - ((pitch or d) / 2) ** 2) ** 0.5
    if flange is not None and layers > 1 and d + (layers - 1) * step > flange:
        holds = 1 + int((flange - d) / step) if flange >= d else 0
        reason = f"flanges of {units.show(flange, units.LENGTH)} are high enough for {holds} layers, not {layers}"
        needed = units.show(d + (layers - 1) * step + 1.5 * d, units.LENGTH)
        fix = f"write `layers: {holds}`, or" if holds else "write"
        yield Conflict(("drum", "layers"), reason, f"{fix} `flange_height: {needed}`")
