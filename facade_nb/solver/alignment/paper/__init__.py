"""The paper's alignment search, part by part (5.2, supplement 1.2, 3.3); docs/alignment-search.md goes through it.

`ida.search_ida` puts the parts together.
"""
