"""Torque limiter on the sprocket shaft: does it trip, is the chain safe in a jam, is it set high enough."""
