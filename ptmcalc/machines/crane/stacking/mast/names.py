"""Names of the effects of the column's motion."""

FLEXIBLE, MASS, MODES, GRAVITY = "mast_flexibility", "column_mass", "column_modes", "mast_gravity"
CONTACT, HOLDING, GUIDE = "obstacle_contact", "brake_sticking", "top_guide"
