"""The printed schemes, rolled out in time by the compiled runtime."""
