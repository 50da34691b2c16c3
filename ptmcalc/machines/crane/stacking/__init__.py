"""What the stacker cranes have in common: a column with a carriage that climbs it, and what may happen to both."""
