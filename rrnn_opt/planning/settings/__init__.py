"""What may be chosen: the settings of each planner, as frozen data."""
