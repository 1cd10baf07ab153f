"""Engines propose certificates, one a file or folder; none of them decides."""
