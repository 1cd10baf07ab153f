"""What ``python -m benchmarks`` measures: ratios, both sides in one run."""
