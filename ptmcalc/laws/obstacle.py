"""A column that strikes an obstacle: the force where it strikes, and the most that its column can get.

The energy formulas of the lecture notes, with either reading of the mass that counts, are in `laws.buffer`. The contact
is short beside the swing of the column: its force goes by the mass at the tip alone.
"""

import math

_HALVINGS = 200
_NEAR = 0.05
_TERMS = 14


def elastic_contact_force(speed: float, stiffness: float, tip_mass: float) -> float:
    """Largest force where the end of a column strikes something elastic.

        F = v (k m_2)^(1/2)

    Args:
        speed: v [m/s].
        stiffness: k, of the contact [N/m].
        tip_mass: m_2, at the end of the column [kg].

    Returns:
        F [N].

    **Range** a contact much stiffer than the column.
    **Error** without damping too low by about the column's own force and by (c/k)^(1/2) of itself; the stiffness of a
    contact is seldom known.
    **Source** energy m v^2 = F^2/k.
    """
    return speed * math.sqrt(stiffness) * math.sqrt(tip_mass)


def damped_contact(
    speed: float, tip_mass: float, force: float, indentation: float, exponent: float, damping: float
) -> tuple[float, float]:
    """Largest force and indentation of a contact whose damping grows with its indentation.

        F = F_r (x/x_r)^n (1 + l x'),   l = 3/2 c_e
        x^(n+1) = (n + 1) (m_2 x_r^n/F_r) (G(v) - G(x')),   G(u) = (l u - ln(1 + l u))/l^2
        largest where   n x' = (n + 1) l (G(v) - G(x'))

    Unlike a spring with a plain damper it begins without a jump of the force.

    Args:
        speed: v, at first contact [m/s].
        tip_mass: m_2 [kg].
        force: F_r, at the indentation x_r [N].
        indentation: x_r [m].
        exponent: n, 1 for a spring, 3/2 for a ball on a plane [1].
        damping: c_e, 1 - e over v for a coefficient e of restitution near 1 [s/m].

    Returns:
        F [N], x [m].

    **Range** a contact much stiffer than the column; c_e >= 0.
    **Error** exact for that contact: a closed form but for one root.
    **Source** K. H. Hunt, F. R. E. Crossley, Coefficient of restitution interpreted as damping in vibroimpact, 1975;
    integral and place of the peak derived.
    """
    rate = 1.5 * damping * speed
    low, high = 0.0, 1.0
    whole = _lag(rate, 0.0)
    for _ in range(_HALVINGS):  # the share y of the speed that is left at the peak
        y = (low + high) / 2
        if not low < y < high:
            break
        rising = exponent * y < (exponent + 1) * rate * _lag(rate, y)
        low, high = (y, high) if rising else (low, y)
    base = (exponent + 1) * (tip_mass / force) * speed * (speed / indentation)

    def share(lag: float) -> float:
        return float((base * lag) ** (1 / (exponent + 1)))

    return force * share(_lag(rate, low)) ** exponent * (1 + rate * low), indentation * share(whole)


def _lag(rate: float, left: float) -> float:
    """(G(v) - G(y v))/v^2 for l v = rate: (1 - y^2)/2 without damping."""
    gap = 1 - left
    if rate < _NEAR:  # sum of (-rate)^k (1 - y^(k+2))/(k+2)
        return sum((-rate) ** k * (1 - left ** (k + 2)) / (k + 2) for k in range(_TERMS))
    return (gap - math.log1p(rate * gap / (1 + rate * left)) / rate) / rate


def column_force_bound(
    mass: float, stiffness: float, speed: float, push: float, contact_force: float, indentation: float, exponent: float
) -> float:
    """Most a column can get when its end strikes an obstacle that gives, whatever is lost at the contact.

        F <= P + (P^2 + c (m v^2 + 2 E_c))^(1/2),   E_c = P x_r (P/F_r)^(1/n) n/(n + 1)

    Until the base stops a drive P works over the deflection of the column and over the indentation; what it gives to
    the indentation beyond what that stores is E_c at most. Brake, friction and the contact only take.

    Args:
        mass: m, of all that travels: base, column and load [kg].
        stiffness: c, of the column at the place that strikes [N/m].
        speed: v [m/s].
        push: P, of a drive that is still on, at least 0 [N].
        contact_force: F_r, of the contact at the indentation x_r [N].
        indentation: x_r, 0 for a rigid obstacle [m].
        exponent: n, of the contact [1].

    Returns:
        F, stiffness times deflection [N].

    **Range** any contact whose force is at least F_r (x/x_r)^n as it is pressed in; a column without weight, or one
    that hangs.
    **Error** a bound for columns with mass too: no shape of the same deflection stores less than c x^2/2. Without the
    indentation (`laws.buffer.collision_force_bound`) a drive that pushes a soft contact exceeds it, 1.5 % in one case.
    **Source** derived: energy.
    """
    give = 0.0
    if push > 0 and indentation > 0:
        give = push * indentation * (push / contact_force) ** (1 / exponent) * exponent / (exponent + 1)
    return push + math.hypot(push, math.hypot(speed * math.sqrt(mass), math.sqrt(2 * give)) * math.sqrt(stiffness))
