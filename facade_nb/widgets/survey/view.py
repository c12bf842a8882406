"""The editor of a survey: rectangles over a photograph."""

from __future__ import annotations

from base64 import b64encode
from html import escape
from pathlib import Path
from typing import Any

from traitlets import Int

from ...design import Design, DesignError
from ...design.errors import Fault
from ...survey import Survey
from ..shared.pictured import PartView
from .channel import SurveyChannel
from .model import Drawn, SurveyModel

__all__ = ["SurveyEditor"]

_MOST = 30_000_000
"""Bytes of a photograph."""


class SurveyEditor(PartView):
    """A façade drawn by hand: a photograph made straight by four corners, windows and doors drawn over it.

    Parameters
    ----------
    source
        A survey to go on with, or the `model` of another editor.
    photo
        A file of a photograph (JPEG, PNG, WebP), or its bytes. One can be opened in the page as well, and then stays
        in the page: neither the kernel nor the notebook gets it.
    height
        Of the picture, pixels at most.

    Raises
    ------
    DesignError
        For a photograph that cannot be read.
    """

    _shows = "survey"

    height = Int(520).tag(sync=True)

    def __init__(
        self,
        source: Survey | SurveyModel | None = None,
        photo: str | Path | bytes | None = None,
        **options: Any,
    ) -> None:
        if isinstance(source, SurveyModel):
            self.model = source
        else:
            self.model = SurveyModel(Drawn.of_survey(source) if source is not None else None)
        super().__init__(channel=SurveyChannel.of(self.model), part=self._shows, **options)
        if photo is not None:
            self.channel.show(_read(photo))

    @property
    def survey(self) -> Survey:
        """What is drawn."""
        return self.model.survey

    @survey.setter
    def survey(self, survey: Survey) -> None:
        self.model.survey = survey

    def infer(self, name: str = "") -> Design:
        """The design of what is drawn (`facade_nb.survey.infer`)."""
        return self.model.infer(name)

    def save(self, path: str | Path | None = None) -> str:
        """The survey as the text of a file, which `load_survey` reads; with `path` it is also written there."""
        return self.model.to_json(path)

    def __repr__(self) -> str:
        count = len(self.model.drawn.openings)
        return f"SurveyEditor({count} opening{'' if count == 1 else 's'})"

    def to_html(self) -> str:
        """The static form: the rectangles alone."""
        own = self.model.drawn
        wide = 360.0
        scale = wide / own.width
        fills = {"window": "#7aa6d6", "door": "#b5794a"}
        body = "".join(
            f'<rect x="{left * scale:.1f}" y="{(own.height - top) * scale:.1f}" width="{(right - left) * scale:.1f}" '
            f'height="{(top - bottom) * scale:.1f}" fill="{fills[kind]}"/>'
            for kind, (left, bottom, right, top) in own.openings
        )
        drawn = (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide:g}" height="{own.height * scale:.1f}">'
            f'<rect width="100%" height="100%" fill="#eceae4" stroke="#999"/>{body}</svg>'
        )
        data = b64encode(drawn.encode()).decode("ascii")
        return f'<img alt="{escape(repr(self))}" src="data:image/svg+xml;base64,{data}">'


_SIGNS = (b"\xff\xd8\xff", b"\x89PNG", b"RIFF", b"GIF8")


def _read(photo: str | Path | bytes) -> bytes:
    place = "photo" if isinstance(photo, bytes) else str(photo)
    try:
        data = photo if isinstance(photo, bytes) else Path(photo).read_bytes()
    except (OSError, ValueError) as error:
        raise DesignError(
            Fault(place, f"cannot be read: {getattr(error, 'strerror', None) or error}")
        ) from None
    if not data.startswith(_SIGNS):
        raise DesignError(Fault(place, "expected a photograph in JPEG, PNG or WebP"))
    if len(data) > _MOST:
        raise DesignError(Fault(place, f"expected a photograph of at most {_MOST // 10**6} MB"))
    return data
