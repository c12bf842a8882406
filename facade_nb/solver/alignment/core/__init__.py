"""The best-first search compiled: what a solve runs. `reference` is the same, step by step, for reading."""
