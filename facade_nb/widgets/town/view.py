"""The views of a town: widgets of one kilobyte that name the channel and the part to show."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Self

from traitlets import Bool, Int, List, Unicode

from ...render.pipeline.scene import Scene
from ...render.pipeline.viewpoint import CameraPath, Viewpoint
from ...render.town import Town
from ..shared.pictured import PartView, check_side
from .channel import TownChannel
from .following import awaited
from .model import TownModel
from .still import SAVED, image, still

__all__ = ["PipelineView", "TownView"]


class _TownWidget(PartView):
    """A view of a town or of a scene; which one, says the class.

    Parameters
    ----------
    source
        A town, a scene, or the `model` of another view. Views of one model follow each other.
    viewpoint
        Where one stands at first: a `Viewpoint`, or the name of one of `model.views`.
    hour
        Of the day, 0 to 24.
    path
        A way through the town.
    tile_megabytes
        What tiles may take of the graphics card, from 1 MB; by default 64.
    """

    height = Int(0, help="Pixels of the picture; 0: as it suits its width.").tag(sync=True)

    def __init__(
        self,
        source: TownModel | Town | Scene,
        viewpoint: Viewpoint | str | None = None,
        *,
        hour: float | None = None,
        path: CameraPath | Sequence[dict[str, object]] | None = None,
        tile_megabytes: float | None = None,
        **options: Any,
    ) -> None:
        self.model = source if isinstance(source, TownModel) else TownModel(source)
        if hour is not None:
            self.model.hour = hour
        if tile_megabytes is not None:
            self.model.tile_megabytes = tile_megabytes
        super().__init__(channel=TownChannel.of(self.model), part=self._shows, **options)
        if viewpoint is not None:
            self.viewpoint = viewpoint
        if path is not None:
            self.path = path

    @property
    def viewpoint(self) -> Viewpoint:
        """Where one stands."""
        return self.model.viewpoint

    @viewpoint.setter
    def viewpoint(self, place: Viewpoint | str) -> None:
        if isinstance(place, str):
            self.model.look(place)
        else:
            self.model.viewpoint = place

    @property
    def path(self) -> CameraPath | None:
        """A way through the town, which the view plays; None: there is none."""
        return self.model.path

    @path.setter
    def path(self, path: CameraPath | Sequence[dict[str, object]] | None) -> None:
        if path is None or isinstance(path, CameraPath):
            self.model.path = path
        else:
            self.model.travel(list(path))

    @property
    def hour(self) -> float:
        """Of the day, 0 to 24."""
        return float(self.model.hour)

    @hour.setter
    def hour(self, hour: float) -> None:
        self.model.hour = hour

    def keep(self, side: int = 64) -> Self:
        """Put all that is drawn into the view's saved state, so that one flies in pages without a kernel, too.

        Elsewise the page asks the kernel for it, block by block. A hamlet of 20 houses takes about 0.3 MB with
        tiles up to 32 pixels, and 0.8 MB with 64.

        Parameters
        ----------
        side
            The largest side of the tiles that are kept, in pixels.

        Returns
        -------
        The view itself.

        Raises
        ------
        ValueError
            For a side that is no number of pixels.
        """
        self.channel.keep(check_side(side))
        return self

    def __repr__(self) -> str:
        town = self.model.town
        what = f"{len(self.model.source.chunks)} chunks" if town is None else f"{len(town.plan):,} buildings"
        return f"{type(self).__name__}({what})"

    def to_html(self) -> str:
        """The static form: a picture for pages where no widget can run; empty where there is none."""
        return image(self.model, still(self.model, SAVED, hasty=True))

    def _carried(self) -> str:
        """Where somebody waits for the view, it comes first, and the picture when the page has what it needs."""
        return "" if awaited() and self.channel.promise_picture() else self.to_html()


class TownView(_TownWidget):
    """The town: fly and walk, day to night; a click tells of a building, whose style and grammar can be changed.

    Attributes
    ----------
    controls
        Whether there are buttons, sliders, inspector and editor.
    """

    _shows = "view"

    controls = Bool(True).tag(sync=True)


class PipelineView(_TownWidget):
    """Every buffer of the pipeline side by side, with what each pass reads and writes.

    Attributes
    ----------
    off
        Names of passes that are left out.
    enlarged
        The buffer that is shown large; empty: the last one.
    """

    _shows = "pipeline"

    off = List(Unicode()).tag(sync=True)
    enlarged = Unicode().tag(sync=True)
