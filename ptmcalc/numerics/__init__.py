"""Floor 1: numerical methods on numpy alone; they know no machine and no formula of the field."""
