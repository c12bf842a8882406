"""What is said where no graphics library can draw."""

from __future__ import annotations

from ..design.errors import FacadeError

__all__ = ["BackendError"]


class BackendError(FacadeError, RuntimeError):
    """A backend that was asked for cannot be used here; the text says what would help."""
