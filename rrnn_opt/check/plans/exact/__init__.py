"""What doubles proved, proved again in balls and rationals."""
