"""The figures of the paper, drawn again from our own runs."""
