"""Dynamic factor of a load lifted off the ground as the crane standards put it: by class, without the machine.

EN 13001-2 and ISO 8686-1 agree on the classes HC1 to HC4; for the drive classes HD1, HD3 and HD5 sources differ in
the smallest factor, which is why the edition is an argument.
"""

BETA = {"HC1": 0.17, "HC2": 0.34, "HC3": 0.51, "HC4": 0.68}
"""beta_2 [s/m] by stiffness class."""
LEAST = {"HC1": 1.05, "HC2": 1.10, "HC3": 1.15, "HC4": 1.20}
"""Smallest phi_2 by stiffness class."""
LEAST_CONTROLLED = 1.05
"""Smallest phi_2 of the drive classes HD3 and HD5 in the newer edition, for every stiffness class."""
LEAST_HARD = {"HC1": 1.10, "HC2": 1.20, "HC3": 1.30, "HC4": 1.40}
"""Smallest phi_2 of the drive class HD1 where an edition raises it; quoted from memory, to be confirmed."""
BY_CLASS, BY_DRIVE, RAISED = "by_class", "by_drive", "raised"
"""Editions: the smallest factor by stiffness class alone, lower for the drives HD3 and HD5, or higher for HD1."""
EDITIONS = (BY_CLASS, BY_DRIVE, RAISED)
FEM_SLOPE = {"bridge": 0.6, "jib": 0.3}
"""xi of FEM 1.001 [s/m]: bridge cranes and jib cranes."""
FEM_SPEED, FEM_LEAST = 1.0, 1.15
"""Speed up to which FEM 1.001 lets its factor grow [m/s], and the least factor: of FEM alone, not of EN 13001-2."""
DRIVES = ("HD1", "HD2", "HD3", "HD4", "HD5")
FILLED, PRINTED = "filled", "printed"
"""Speeds of HD1 and HD3 in C1, for which EN 13001-2 prints a dash: filled in as an open code does, or refused."""
REGULAR, EXCEPTIONAL = "regular", "exceptional"
"""Load combinations A1 and B1, and C1."""
STIFFNESS_LIMITS = ((0.8, "HC1"), (0.3, "HC2"), (0.15, "HC3"))
"""Least static deflection of the load under its weight [m] of each class but the stiffest."""


def stiffness_class(deflection: float) -> str:
    """Stiffness class of a hoist from how far the load hangs lower under its weight.

        HC1: delta >= 0.8 m,  HC2: >= 0.3 m,  HC3: >= 0.15 m,  HC4 below

    Args:
        deflection: delta, of the load on rope and structure [m].

    Returns:
        class: HC1 to HC4.

    **Range** delta >= 0.
    **Error** none: a definition.
    **Source** EN 13001-2, table of stiffness classes (limits as quoted in open design codes).
    """
    return next((name for least, name in STIFFNESS_LIMITS if deflection >= least), "HC4")


def class_lift_off_speed(
    drive_class: str, combination: str, main_speed: float, creep_speed: float, edition: str = FILLED
) -> float:
    """Hoisting speed that the standard takes at lift-off.

        A1, B1:  HD1 v_max,  HD2 and HD3 v_creep,  HD4 0.5 v_max,  HD5 0
        C1:      HD1, HD2, HD4 v_max,  HD3, HD5 0.5 v_max

    Args:
        drive_class: HD1 (no creep speed), HD2 (creep at the operator's choice), HD3 (creep until the load is off the
            ground), HD4 (stepless, by the operator), HD5 (stepless, automatic).
        combination: `regular` (A1, B1) or `exceptional` (C1).
        main_speed: v_max, of the hook [m/s].
        creep_speed: v_creep, of the hook [m/s].
        edition: `filled` or `printed`.

    Returns:
        v_h [m/s].

    **Range** those classes.
    **Error** none: a definition; where EN 13001-2 prints a dash (C1 of HD1 and HD3) `filled` follows an open design
    code.
    **Source** EN 13001-2 and ISO 8686-1, table of lift-off speeds.

    Raises:
        ValueError: for another class, combination or edition, and for a speed that is not printed.
    """
    if drive_class not in DRIVES or combination not in (REGULAR, EXCEPTIONAL) or edition not in (FILLED, PRINTED):
        raise ValueError(f"a drive class is one of {DRIVES}, a combination {REGULAR} or {EXCEPTIONAL}")
    if edition == PRINTED and combination == EXCEPTIONAL and drive_class in ("HD1", "HD3"):
        raise ValueError(f"the standard prints no lift-off speed of {drive_class} for the exceptional combination")
    if combination == EXCEPTIONAL:
        return main_speed if drive_class in ("HD1", "HD2", "HD4") else main_speed / 2
    speeds = {"HD1": main_speed, "HD2": creep_speed, "HD3": creep_speed, "HD4": main_speed / 2}
    return speeds.get(drive_class, 0.0)


def standard_lift_off_factor(stiffness: str, drive_class: str, speed: float, edition: str) -> float:
    """Dynamic factor of lifting a load off the ground by the standard.

        phi_2 = phi_2,min + beta_2 v_h

    Args:
        stiffness: class HC1 to HC4.
        drive_class: HD1 to HD5.
        speed: v_h, of `class_lift_off_speed` [m/s].
        edition: `by_class` (ISO 8686-1, older EN 13001-2), `by_drive` (newer: 1.05 at least for HD3 and HD5) or
            `raised` (1.1 to 1.4 at least for HD1).

    Returns:
        phi_2, largest force over the weight [1].

    **Range** those classes.
    **Error** none bound: it knows neither mass nor stiffness; beside the speed source theory it gives 0.5 to 0.95 of
    the dynamic part.
    **Source** EN 13001-2 and ISO 8686-1; numbers as four open design codes quote them. `by_drive` is found in one of
    them, `raised` quoted from memory only: compare with the text of the edition that applies.

    Raises:
        ValueError: for another class or edition.
    """
    if stiffness not in BETA or drive_class not in DRIVES or edition not in EDITIONS:
        raise ValueError(f"no factor for {stiffness}, {drive_class} in the edition {edition}")
    least = LEAST[stiffness]
    if edition == BY_DRIVE and drive_class in ("HD3", "HD5"):
        least = LEAST_CONTROLLED
    elif edition == RAISED and drive_class == "HD1":
        least = LEAST_HARD[stiffness]
    return least + BETA[stiffness] * speed


def fem_lift_off_factor(structure: str, speed: float) -> float:
    """Dynamic factor of lifting a load off the ground by FEM 1.001.

        psi = 1 + xi v, v up to 1 m/s, at least 1.15

    Args:
        structure: `bridge` or `jib`.
        speed: v, of hoisting [m/s].

    Returns:
        psi, largest force over the weight [1].

    **Range** those structures; its least value belongs to FEM: a report that puts it into EN 13001-2 mixes rules.
    **Error** no bound: the factor depends on neither mass nor stiffness.
    **Source** FEM 1.001, booklet 2; numbers as quoted in handbooks, to be compared with the edition in force.

    Raises:
        ValueError: for another structure.
    """
    if structure not in FEM_SLOPE:
        raise ValueError(f"FEM 1.001 knows a structure of {' or '.join(FEM_SLOPE)}")
    return max(1 + FEM_SLOPE[structure] * min(speed, FEM_SPEED), FEM_LEAST)
