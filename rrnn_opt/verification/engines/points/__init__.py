"""Points that break a claim, or keep its hypotheses; exact values there."""
