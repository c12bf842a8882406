"""Tests of the design room: pattern language, documents, edits."""
