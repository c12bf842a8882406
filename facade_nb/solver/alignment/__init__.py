"""Alignment: columns, their rules and their price, and the searches for the best of them (the paper's 5.2)."""
