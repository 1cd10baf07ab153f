"""TODO-DOC verification."""
