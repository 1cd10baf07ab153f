"""Obstacles: signed distances, and half-spaces that hold them."""
