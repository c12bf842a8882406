"""Tests; a package, so that `python -m tests.bench` finds this one before any other of the name."""
