"""Emergency stops: peak speed, stopping time, travel, heat and wear of the brake."""
