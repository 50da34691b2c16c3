"""Choice of the chain: static safety, wear life, geometry, rated power."""
