"""Freedom from collision for all times, by subdivision in time, in doubles."""
