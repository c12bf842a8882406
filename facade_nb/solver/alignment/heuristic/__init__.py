"""An alignment soon: local search over the rows of tall stacks."""
