"""A mast on a base that moves: finite elements, modes, and its march through drive, brake, contact and rest."""
