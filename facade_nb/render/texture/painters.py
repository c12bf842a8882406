"""Who evaluates a grammar for a picture: OSMesa, EGL, or NumPy alone. All agree (docs/texture.md says how closely)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...design.errors import nearest
from ..backends import BackendError
from .evaluating import evaluate
from .gl import EGL, OSMESA
from .question import Question
from .shot import Painter, Shot, spread
from .view import Looks, Sight

__all__ = ["PAINTERS", "choose_painter", "has_card"]


class _Cpu:
    """NumPy alone: it is always there."""

    name = "cpu"
    why_not = ""
    available = True

    def paint(
        self, question: Question, sight: Sight, *, mips: bool = False, color_only: bool = False
    ) -> Shot:
        return self.paint_at(question, sight.looks(), mips=mips, color_only=color_only)

    def paint_at(
        self, question: Question, looks: Looks, *, mips: bool = False, color_only: bool = False
    ) -> Shot:
        inside = looks.inside
        points, rays, footprint = looks.points, looks.rays, looks.footprint
        if not inside.all():
            points, rays, footprint = (
                points[inside],
                None if rays is None else rays[inside],
                footprint[inside],
            )
        margin = np.zeros(len(points), np.float32) if mips else None
        shade = np.zeros(len(points), np.float32) if question.relief else None
        surface = evaluate(
            question,
            points,
            rays,
            footprint if mips else None,
            looks.spread,
            margin=margin,
            color_only=color_only,
            shade=shade,
        )
        margin = np.zeros(len(points), np.float32) if margin is None else margin
        return spread(Shot(surface, margin, shade=shade), inside)


PAINTERS: dict[str, Painter] = {"osmesa": OSMESA, "egl": EGL, "cpu": _Cpu()}
"""The backends by name."""


def choose_painter(name: str | None = None) -> Painter:
    """The backend of that name, or the best that works here.

    That is EGL where there is a graphics card, else OSMesa, else EGL, else NumPy.

    Raises
    ------
    ValueError
        For an unknown name.
    BackendError
        If the one asked for cannot be used here; its text says what would help.
    """
    if name is None:
        order = ("egl", "osmesa", "cpu") if has_card() else ("osmesa", "egl", "cpu")
        return next(PAINTERS[one] for one in order if PAINTERS[one].available)
    if name not in PAINTERS:
        known = ", ".join(PAINTERS)
        raise ValueError(f"backend: expected one of {known}; found {name!r}{nearest(name, PAINTERS)}")
    if PAINTERS[name].why_not:
        raise BackendError(f"{PAINTERS[name].why_not}; the backend 'cpu' works everywhere")
    return PAINTERS[name]


def has_card() -> bool:
    """Whether there seems to be a graphics card."""
    return Path("/dev/nvidia0").exists() or any(Path("/dev/dri").glob("renderD*"))
