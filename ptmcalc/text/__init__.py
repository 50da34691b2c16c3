"""Floor 1: bytes of a design file to data that knows where each key and value stands."""
