"""Floor 4: machine parts several kinds assemble: spec fragment, laws bound to it, check factories."""
