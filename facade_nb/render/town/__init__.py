"""A town: its plan, the styles of its houses, and the scene that is drawn."""
