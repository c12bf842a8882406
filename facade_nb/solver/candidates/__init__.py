"""Candidates: one word for each pattern under one value of each counter (the paper's 5.1, supplement 3.2)."""
