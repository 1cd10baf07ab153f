"""What a claim's graph is worth: at a point, over boxes, and as polynomials."""
