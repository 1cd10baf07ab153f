"""TODO-DOC planning."""
