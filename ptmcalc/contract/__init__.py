"""Classes that a machine kind fills in, and classes of a report."""
