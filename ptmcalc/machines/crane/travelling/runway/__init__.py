"""Actions of the crane on its runway."""
