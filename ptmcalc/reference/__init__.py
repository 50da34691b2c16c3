"""Second methods: what `cost` holds the solvers of the ladder against. Never imported by a check.

They integrate by scipy's Runge-Kutta steps or finite elements, and know nothing of the propagators in `numerics`.
"""
