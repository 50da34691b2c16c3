"""Keys of a belt conveyor that its parts share: route, belt, idlers, damping, resistance."""
