"""Sizing: one least-squares problem for an axis (the paper's 5.3, supplement 3.4 and 3.5)."""
