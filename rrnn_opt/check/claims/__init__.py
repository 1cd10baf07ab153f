"""The judge of claims: reads a claim and its certificate, and says what holds."""
