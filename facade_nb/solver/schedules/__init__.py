"""In what order a solve asks its axes: each apart, both tied by a counter, or at growing tolerances (section 5)."""
