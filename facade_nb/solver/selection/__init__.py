"""Which candidate: the search of an axis over its candidates (the paper's 5.1 and 5.2 together)."""
