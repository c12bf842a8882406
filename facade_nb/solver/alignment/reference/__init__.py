"""The best-first search in Python: the readable reference of the compiled one (`core`)."""
