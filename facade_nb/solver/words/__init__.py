"""Words of a pattern that can fit the canvas (the paper's 5.1, Eq. 7)."""
