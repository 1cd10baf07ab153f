"""TODO-DOC study."""
