"""The effects a conveyor in motion may call for.

Bounds marked *calibrated* have the form that perturbation theory gives, with a factor from the seeded samples of
`tests/coverage` (about 1900 machines, seeds 11 and 21) and a margin on its largest value; the coverage tests hold
them on other seeds.
"""
