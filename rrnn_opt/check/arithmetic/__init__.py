"""Numbers whose error is known: intervals, balls, sine and cosine, definiteness."""
