"""A command each folder or file: ``python -m benchmarks[.NAME]``."""
