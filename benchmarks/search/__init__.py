"""The planner's search, family by family."""
