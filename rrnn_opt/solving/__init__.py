"""TODO-DOC solving."""
