"""Roles of a footprint's edges."""

from __future__ import annotations

__all__ = ["COURT", "PARTY", "ROLES", "SIDE", "STREET"]

STREET, SIDE, COURT, PARTY = range(4)
"""On a street; a free wall beside or behind; on a courtyard or a back garden; against a neighbour."""

ROLES = ("street", "side", "court", "party")
"""Their names."""
