"""Wear of the joints of a chain and the life it leaves, by the textbook and by Archard's law.

Every device (sprocket, guided curve) bends each joint once as the chain runs on, under its tension there, and once as
it runs off. Tensions are kept in pairs: what runs off one device is not what runs on to the next.

Source of the textbook forms: N. Yu. Dorokhov, "Dynamics of hoisting and conveying machines", lecture notes,
Kramatorsk 2007 (the chapter on the life of the chain), which counts in centimetres.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

SUM, MEAN = "sum", "mean"


def sprocket_path(pin_diameter: float, teeth: int) -> float:
    """Path of friction in a joint that bends once on a sprocket.

        l = (d/2) (2 pi/z) = pi d/z

    Args:
        pin_diameter: d [m].
        teeth: z.

    Returns:
        l [m].

    **Range** a joint that bends by the whole angle of one pitch.
    **Error** exact.
    **Source** lecture notes Kramatorsk 2007.
    """
    return np.pi * pin_diameter / teeth


def guide_path(pin_diameter: float, pitch: float, radius: float) -> float:
    """Path of friction in a joint that bends once on a guided curve.

        l = (d/2) p/R

    Args:
        pin_diameter: d [m].
        pitch: p [m].
        radius: R, of the curve through the pins, well above the pitch [m].

    Returns:
        l [m].

    **Range** R > p/2.
    **Error** the angle is 2 arcsin(p/(2 R)): (p/R)^2/24 too small.
    **Source** lecture notes Kramatorsk 2007.
    """
    return pin_diameter / 2 * (pitch / radius)


def contact_time(pitch: float, chain_speed: float) -> float:
    """Time in which a joint bends on a sprocket.

        t_B = p/V

    Args:
        pitch: p [m].
        chain_speed: V [m/s].

    Returns:
        t_B, the period of the teeth [s].

    **Range** a joint bends while one tooth passes.
    **Error** exact.
    **Source** lecture notes Kramatorsk 2007.
    """
    return pitch / chain_speed


def wear_per_revolution(
    tension_in: FloatArray,
    tension_out: FloatArray,
    path: FloatArray,
    contact_time: FloatArray,
    coefficient: FloatArray,
    form: str,
) -> float:
    """Growth of the pitch of a chain in one revolution, by the textbook.

        sum:  D = sum (S_in + S_out) l f t_B      mean: half of it

    Args:
        tension_in: S_in, as the chain runs on to each device [N].
        tension_out: S_out, as it runs off [N].
        path: l, of one bend on each device [m].
        contact_time: t_B, of each device [s].
        coefficient: f, of wear, from tests at the speed of the machine [Hz/N].
        form: `sum` (recommended: l is the path of one bend, and each joint bends twice) or `mean` (l the path of both).

    Returns:
        D [m].

    **Range** the speed at which f was measured: the law has time and path, so at a fixed f half the speed doubles the
    wear of the same path, which no other law confirms.
    **Error** that of f, a factor of 2 and more; `mean` doubles the life.
    **Source** lecture notes Kramatorsk 2007.

    Raises:
        ValueError: for another form.
    """
    if form not in (SUM, MEAN):
        raise ValueError(f"the tensions count as `{SUM}` or as `{MEAN}`, not as `{form}`")
    pair = np.asarray(tension_in, float) + np.asarray(tension_out, float)
    whole = float(np.sum(pair * path * coefficient * contact_time))
    return whole if form == SUM else whole / 2


def archard_wear(
    tension_in: FloatArray,
    tension_out: FloatArray,
    path: FloatArray,
    joint_area: float,
    coefficient: float,
    reference_pressure: float,
    exponent: float,
) -> float:
    """Growth of the pitch of a chain in one revolution, by pressure and sliding path.

        D = sum k l (p_in (p_in/p_0)^(m-1) + p_out (p_out/p_0)^(m-1)),   p = S/A

    Args:
        tension_in: S_in, as the chain runs on to each device [N].
        tension_out: S_out, as it runs off [N].
        path: l, of one bend on each device [m].
        joint_area: A, projected area of pin and bush [m^2].
        coefficient: k, depth of wear over pressure and path at the pressure p_0 [m^2/N].
        reference_pressure: p_0, of the test [N/m^2].
        exponent: m; recommended 1 (Archard, Vorobyev), 1.5 with scant and 3 with good lubrication (Reshetov) [1].

    Returns:
        D [m].

    **Range** S >= 0; another model than `wear_per_revolution`, without its time.
    **Error** that of k, a factor of 2 and more.
    **Source** J. F. Archard, "Contact and rubbing of flat surfaces", J. Appl. Phys. 24 (1953); exponents: D. N.
    Reshetov, "Machine Elements", as quoted by secondary sources.
    """
    pressures = np.stack([np.asarray(tension_in, float), np.asarray(tension_out, float)]) / joint_area
    return float(
        np.sum(coefficient * np.asarray(path, float) * pressures * (pressures / reference_pressure) ** (exponent - 1))
    )


def allowed_growth(pitch: float, share: float) -> float:
    """How much the pitch of a chain may grow.

        D_D = e p

    Args:
        pitch: p [m].
        share: e, 0.03 to 0.06 by the type of chain and sprocket; the smaller for many teeth [1].

    Returns:
        D_D [m].

    **Range** the limit of the maker or standard decides.
    **Error** exact.
    **Source** lecture notes Kramatorsk 2007.
    """
    return pitch * share


def chain_life(allowed: ArrayLike, wear: ArrayLike, chain_length: float, chain_speed: float) -> FloatArray:
    """Running time in which a chain wears to its limit.

        T = (D_D/D) L/V

    Args:
        allowed: D_D, of `allowed_growth` [m].
        wear: D, per revolution, of `wear_per_revolution` or `archard_wear` [m].
        chain_length: L, of the whole chain [m].
        chain_speed: V [m/s].

    Returns:
        T; infinite without wear [s].

    **Range** wear that stays even over the life.
    **Error** that of D.
    **Source** lecture notes Kramatorsk 2007.
    """
    limit, each = np.broadcast_arrays(np.asarray(allowed, float), np.asarray(wear, float))
    revolutions = np.divide(limit, each, out=np.full(limit.shape, np.inf), where=each > 0)
    return np.asarray(revolutions * (chain_length / chain_speed))
