"""The judge of plans: limits, collisions, start and goal of what was delivered."""
