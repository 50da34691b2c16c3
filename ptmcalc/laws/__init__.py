"""Floor 1: the formulas of the field on SI floats or arrays alike; no description of a machine in any signature.

Each docstring holds the equation, the meaning and unit of every symbol, the range, the error and the source.
"""
