"""The compiled tree search of one robot: asked through arrays, answered in paths."""
