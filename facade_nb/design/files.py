"""Files written whole or not at all; devices, pipes and open descriptors are written into (see `targets`)."""

from __future__ import annotations

import os
import select
import shutil
import sys
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from .errors import DesignError
from .targets import Target, fault, locate, scratch_beside

__all__ = ["NotWritten", "remove_scratch", "write_atomically", "write_together"]

_scratch: set[Path] = set()
"""Scratch files that are on the disk now."""


class NotWritten(DesignError):
    """What could not be written though its place is sound: the disk is full, a pipe was closed.

    Attributes
    ----------
    closed
        Whether the reader of a pipe went away: everything else has been written then.
    """

    closed = False


def write_atomically(path: str | Path, data: str | bytes) -> None:
    """Write a file through a temporary one beside it, so that nobody ever sees half of it.

    Text is written as UTF-8. On failure the old file stays and nothing new is left behind. A file that is there keeps
    its permissions, and a link goes on pointing at it.

    Raises
    ------
    DesignError
        Naming the path, if it cannot be written.
    """
    write_together([(path, data)])


def write_together(files: Sequence[tuple[str | Path | int, str | bytes]]) -> None:
    """Write several files: all contents first, beside their targets, and only then any of them in its place.

    A number stands for an open descriptor. Streams are written once the contents of all files are on the disk, and
    stay open until the files are in their places: whoever reads a pipe to its end finds them there.

    Raises
    ------
    DesignError
        Naming the path where nothing can be written. Nothing has been written then.
    NotWritten
        Naming the path that could not be written in the end. No file has been touched then, unless `closed` is set.
    """
    pairs = [
        (locate(path), data.encode() if isinstance(data, str) else data) for path, data in files
    ]  # all places first
    ready: list[tuple[Path, Target]] = []
    opened: list[int] = []
    closed: NotWritten | None = None
    try:
        for target, content in pairs:
            if not target.is_stream:
                ready.append((_prepare(target, content), target))
        for target, content in pairs:
            if target.is_stream:
                closed = _stream(target, content, opened) or closed
        for scratch, target in ready:
            try:
                scratch.replace(target.file)
            except OSError as error:
                raise NotWritten(fault(target.name, error)) from error
    finally:
        for number in opened:
            with suppress(OSError):
                os.close(number)
        for scratch, _ in ready:
            _remove(scratch)
    if closed is not None:
        raise closed


def remove_scratch() -> None:
    """Remove scratch files that are still there, where a signal kept them from being removed."""
    for scratch in tuple(_scratch):
        _remove(scratch)


def _remove(scratch: Path) -> None:
    scratch.unlink(missing_ok=True)
    _scratch.discard(scratch)


def _prepare(target: Target, content: bytes) -> Path:
    """Write the content beside its target; returns the scratch file."""
    scratch = scratch_beside(target.file)
    _scratch.add(scratch)  # before it is there, so that it is known whenever it is
    try:
        with scratch.open("xb") as file:
            if target.state is not None:
                _take_on(scratch, target.file, target.state)
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
    except BaseException as error:
        _remove(scratch)
        if isinstance(error, OSError):
            raise NotWritten(fault(target.name, error)) from error
        raise
    return scratch


def _take_on(scratch: Path, old: Path, state: os.stat_result) -> None:
    """Give a scratch file the owner and the permissions of the file whose place it will take."""
    if hasattr(os, "chown"):
        for owner in ((state.st_uid, -1), (-1, state.st_gid)):
            with suppress(OSError):  # not everyone may give files away
                os.chown(scratch, *owner)
    shutil.copystat(old, scratch)


def _stream(target: Target, content: bytes, opened: list[int]) -> NotWritten | None:
    """Write into a stream; returns the error of one whose reader has gone."""
    place = target.name if target.descriptor is None else target.descriptor
    try:
        if target.descriptor is None:
            flags = os.O_WRONLY | getattr(os, "O_NOCTTY", 0) | getattr(os, "O_BINARY", 0)
            number = os.open(target.file, flags)  # a pipe's waits for a reader
            opened.append(number)
        else:
            number = target.descriptor
            for own in (sys.stdout, sys.stderr):  # what was printed before comes before
                if own is not None:
                    own.flush()
        _pour(number, content)
    except BrokenPipeError as error:
        gone = NotWritten(fault(place, OSError("it was closed before everything was written")))
        gone.closed = True
        gone.__cause__ = error
        return gone
    except OSError as error:
        raise NotWritten(fault(place, error)) from error
    return None


def _pour(number: int, content: bytes) -> None:
    rest = memoryview(content)
    while rest:
        try:
            rest = rest[os.write(number, rest) :]
        except BlockingIOError:  # its other end asked for it not to wait
            select.select([], [number], [])
