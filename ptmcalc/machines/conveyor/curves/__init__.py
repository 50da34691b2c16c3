"""Horizontal curves: the tension of the belt in them, and its drift on the idlers."""
