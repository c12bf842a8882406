"""The studio: one shared observable design, and the parts that show and edit it (docs/widgets.md)."""
