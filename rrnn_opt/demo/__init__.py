"""TODO-DOC demo."""
