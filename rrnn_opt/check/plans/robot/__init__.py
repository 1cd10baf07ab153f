"""The robot of a plan as plain arrays: where it is, and how far it can move."""
