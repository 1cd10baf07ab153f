"""The paper's statements, tables and figures, and our own promises, run again.

``claims/`` holds one file a statement, numbered in the order of the paper:
what is claimed, the verdict that is expected, and a variant that the machine
must not fall for.
"""
