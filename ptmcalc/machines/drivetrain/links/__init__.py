"""Links: peak torque, elasticity, backlash, wear."""
