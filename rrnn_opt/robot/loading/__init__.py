"""Robots from URDF files and pinocchio models: read, restricted, given a body."""
