"""Engines "sos" and "products": identities of squares and products."""
