"""Studies of our own promises: seeded, run in slices, written where one asks."""
