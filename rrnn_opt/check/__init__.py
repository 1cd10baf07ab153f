"""TODO-DOC check."""
