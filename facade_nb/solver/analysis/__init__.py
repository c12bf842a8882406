"""Pattern analysis: what can be said of counters and unsized symbols before any word is made (supplement 3.1)."""
