"""Keys of a drive train: inertias, links, gears, brakes, torques."""
