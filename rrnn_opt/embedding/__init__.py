"""TODO-DOC embedding."""
