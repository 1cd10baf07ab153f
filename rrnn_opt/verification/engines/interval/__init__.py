"""Interval arithmetic on tapes, and branch and bound with it."""
