"""TODO-DOC networks."""
