"""Plans without end, each delivered motion followed by foreign distances."""
