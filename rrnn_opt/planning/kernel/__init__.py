"""The formulas of the tree search, from SX to C, in front of runtime/."""
