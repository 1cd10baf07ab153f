"""TODO-DOC emit."""
