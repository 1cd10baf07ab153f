"""A plan result drawn: one picture, one page that opens offline."""
