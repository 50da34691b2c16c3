"""Motors: peak torque, heating, overhauling loads."""
