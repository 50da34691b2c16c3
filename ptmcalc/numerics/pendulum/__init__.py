"""Loads that swing under a pivot that moves: `linear` exactly, `swing` with finite angles, on a rail or a jib.

What is moved is said in `parts`, over time in `pieces`; angles [rad] are from the plumb line.

    linear.linear_swing(LinearCase, end)         -> LinearSwing     small angles in a plane; speed- or force-driven
    swing.swing(Case, end)                       -> Swing           a trolley on a rail or a load on a slewing jib

Either keeps its whole motion: `at(name, times)`, `largest(name, since, until)` and `smallest(...)` look at any signal
in any stretch of time; a `Peak` knows its time and its numerical bar. A `Swing` also knows when a signal goes through
a level (`crossing`), its events and its energy balance (`works`). Both raise `NumericsError` where they cannot be
trusted.
"""
