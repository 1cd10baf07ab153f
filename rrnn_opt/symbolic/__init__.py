"""TODO-DOC symbolic."""
