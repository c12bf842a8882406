"""Names of the files that are written beside an OBJ, which nobody asked for: no file of somebody else's is lost."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from itertools import count
from pathlib import Path

__all__ = ["HEAD", "Beside"]

HEAD = "# facade_nb"
"""What an MTL of ours begins with."""

_PICTURE = "map_Kd "


class Beside:
    """The MTL of an OBJ and its pictures.

    A file that is there already is written anew where it is ours: an MTL that begins as ours do, a picture that such an
    MTL calls for. Where it is somebody else's, another name is taken: ``house~2.mtl``.

    Parameters
    ----------
    materials
        Where the MTL is written, if nothing stands in the way.
    stem
        What the names of pictures begin with.
    """

    def __init__(self, materials: Path, stem: str) -> None:
        self.materials = _free(materials, lambda file: bool(_lines(file)))
        self._stem = stem
        self._ours = {
            line.removeprefix(_PICTURE) for line in _lines(self.materials) if line.startswith(_PICTURE)
        }

    def picture(self, number: int) -> str:
        """The name of a picture."""
        file = self.materials.with_name(f"{self._stem}-rule-{number}.png")
        return _free(file, lambda own: own.name in self._ours).name


def _free(file: Path, ours: Callable[[Path], bool]) -> Path:
    """The file, or the first one after it that there is not, or that is ours."""
    return next(own for own in _names(file) if not _is_there(own) or ours(own))


def _names(file: Path) -> Iterator[Path]:
    yield file
    for k in count(2):
        yield file.with_stem(f"{file.stem}~{k}")


def _is_there(file: Path) -> bool:
    """Whether there is a file; of a folder in its place, writing tells."""
    try:
        return file.exists() and not file.is_dir()
    except OSError:
        return False


def _lines(file: Path) -> list[str]:
    """The lines of an MTL of ours; none of anything else."""
    with suppress(OSError, UnicodeDecodeError):
        if file.is_file():
            with file.open(encoding="utf-8") as text:
                if text.readline().rstrip() == HEAD:
                    return [HEAD, *(line.rstrip() for line in text)]
    return []
