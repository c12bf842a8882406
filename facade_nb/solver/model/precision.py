"""How exactly lengths and costs are compared: the one place where that is said."""

from __future__ import annotations

__all__ = ["EPS"]

EPS = 1e-9
"""Metres: costs and sizes closer than this are equal."""
