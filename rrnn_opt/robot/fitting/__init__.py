"""Collision spheres for a URDF: fitted to its geometry, and proved to cover it."""
