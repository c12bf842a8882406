"""Where a file is written: what a path leads to, and why nothing can be written there.

A file is replaced as a whole, and links to it are kept. What is no file (a device, a pipe, an open descriptor such as
``/dev/stdout``) is written into: to put a file in its place would destroy it.
"""

from __future__ import annotations

import errno
import os
import re
from dataclasses import dataclass
from pathlib import Path
from secrets import token_hex
from stat import S_ISCHR, S_ISDIR, S_ISREG, S_ISSOCK
from unicodedata import normalize

from .errors import DesignError, Fault

__all__ = ["Target", "fault", "locate", "one_file", "scratch_beside", "try_out"]

_DESCRIPTORS = ("/proc/self/fd", "/proc/thread-self/fd", "/dev/fd")
_STANDARD = {1: "standard output", 2: "standard error"}
_MOST_LINKS = 40  # as Linux follows them


@dataclass(frozen=True, slots=True)
class Target:
    """Where something is to be written.

    Attributes
    ----------
    name
        As it was asked for.
    file
        The file, all links followed; of a stream, its path as it is.
    state
        What is there now; None: nothing.
    descriptor
        The number of the open descriptor that it stands for; None: it has to be opened.
    """

    name: str
    file: Path
    state: os.stat_result | None
    descriptor: int | None = None

    @property
    def is_stream(self) -> bool:
        """Whether it is written into, and not replaced."""
        return self.descriptor is not None or (self.state is not None and not S_ISREG(self.state.st_mode))

    @property
    def is_null(self) -> bool:
        """Whether it drops whatever is written, as ``/dev/null`` does."""
        if self.state is None or not S_ISCHR(self.state.st_mode):
            return False
        return os.path.samestat(self.state, Path(os.devnull).stat())


def locate(path: str | Path | int) -> Target:
    """Find out what a path leads to; a number is an open descriptor.

    Raises
    ------
    DesignError
        Naming the path, where nothing can be written.
    """
    try:
        return _located(path)
    except (OSError, ValueError) as error:
        raise DesignError(fault(path, error)) from error


def fault(path: str | Path | int, error: Exception) -> Fault:
    """What is told of a path that cannot be written."""
    reason = getattr(error, "strerror", None) or str(error)
    if isinstance(path, int):
        return Fault(_STANDARD.get(path, f"descriptor {path}"), f"cannot be written: {reason}")
    return Fault(str(path), f"cannot write this file: {reason}")


def _located(path: str | Path | int) -> Target:
    name = str(path)
    number = path if isinstance(path, int) else _descriptor(name)
    if number is not None:
        state = os.fstat(number)
        if not _open_for_writing(number):
            raise PermissionError("it is open for reading only")
        return Target(name, Path(name), state, number)
    if not name:
        raise FileNotFoundError("expected the name of a file; found none")
    try:
        found = Path(name).stat()
    except FileNotFoundError:
        found = None
    if found is not None and S_ISDIR(found.st_mode):
        raise IsADirectoryError("it is a folder")
    if name.endswith(tuple(filter(None, (os.sep, os.altsep)))):
        raise IsADirectoryError("this is how a folder is written")
    if found is not None and S_ISSOCK(found.st_mode):
        raise OSError("it is a socket")
    if found is not None and not os.access(name, os.W_OK):
        raise PermissionError("it is write-protected")
    if found is not None and not S_ISREG(found.st_mode):
        return Target(name, Path(name), found)
    file = Path(os.path.realpath(name))
    if not file.parent.is_dir():
        raise FileNotFoundError(f"No such file or directory: there is no folder {str(file.parent)!r}")
    return Target(name, file, found)


def _descriptor(name: str) -> int | None:
    """The number of this process's open descriptor that a path stands for: ``/dev/stdout``, ``/dev/fd/3``."""
    folders = {os.path.realpath(folder) for folder in _DESCRIPTORS}
    for _ in range(_MOST_LINKS):
        folder, last = os.path.split(name)
        folder = re.sub("^/+", "/", os.path.realpath(folder or os.curdir))
        if folder in folders and re.fullmatch("[0-9]{1,9}", last):
            return int(last)
        link = Path(folder, last)
        if not link.is_symlink():
            break
        name = str(link.parent / link.readlink())
    return None


def _open_for_writing(number: int) -> bool:
    try:
        import fcntl
    except ImportError:  # Windows: writing will tell
        return True
    return fcntl.fcntl(number, fcntl.F_GETFL) & os.O_ACCMODE != os.O_RDONLY


def scratch_beside(target: Path) -> Path:
    """A name for a file that is to take another's place, in the same folder; as short as any name may have to be."""
    return target.with_name(f".facade-nb-{token_hex(6)}.tmp")


def try_out(target: Target) -> None:
    """Make sure that a file can be made beside a target: only trying tells for every file system.

    Raises
    ------
    DesignError
        Naming the target, if none can.
    """
    if target.is_stream:
        return
    scratch = scratch_beside(target.file)
    try:
        try:
            scratch.touch(exist_ok=False)
        finally:
            scratch.unlink(missing_ok=True)
    except OSError as error:
        raise DesignError(fault(target.name, error)) from error


def one_file(a: Target, b: Target) -> bool:
    """Whether two targets are one file, whatever their names."""
    if a.state is not None and b.state is not None:
        return os.path.samestat(a.state, b.state)
    if a.state is not None or b.state is not None or not a.file.parent.samefile(b.file.parent):
        return False
    names = (a.file.name, b.file.name)
    folded = {normalize("NFKC", normalize("NFKC", name).casefold()) for name in names}
    return names[0] == names[1] or (len(folded) == 1 and _taken_as_one(a.file.parent, *names))


def _taken_as_one(folder: Path, a: str, b: str) -> bool:
    """Whether a folder takes two names of new files for one, as those do that know of no upper and lower case."""
    key = token_hex(3)
    made, other = (folder / f".{key}-{name}" for name in (a, b))
    try:
        made.touch(exist_ok=False)
        return other.exists()
    except OSError as error:
        # The names are too long for an addition: what is like enough to be one is taken for one.
        return error.errno == errno.ENAMETOOLONG
    finally:
        made.unlink(missing_ok=True)
