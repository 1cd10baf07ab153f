"""TODO-DOC motion."""
