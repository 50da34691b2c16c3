"""Fork: snagged by the rack, or pushed against it."""
