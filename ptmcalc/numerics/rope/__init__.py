"""A drive that hauls a load on a rope with a life of its own: one with mass, or one that gets shorter."""
