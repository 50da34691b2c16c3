"""Classes of every machine description."""
