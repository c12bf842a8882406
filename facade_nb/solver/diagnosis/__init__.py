"""Why a design has no layout, and what would help."""
