"""Files written whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from secrets import token_hex

from .errors import DesignError, Fault

__all__ = ["write_atomically", "write_together"]


def write_atomically(path: str | Path, data: str | bytes) -> None:
    """Write a file through a temporary one beside it, so that nobody ever sees half of it.

    Text is written as UTF-8. On failure the old file stays and nothing new is left behind.

    Raises
    ------
    DesignError
        Naming the path, if it cannot be written.
    """
    write_together([(path, data)])


def write_together(files: Sequence[tuple[str | Path, str | bytes]]) -> None:
    """Write several files: all contents first, beside their targets, and only then any of them in its place.

    Raises
    ------
    DesignError
        Naming the path that cannot be written. No target has been touched then.
    """
    ready: list[tuple[Path, Path]] = []
    try:
        for path, data in files:
            ready.append(_prepare(path, data))
        for scratch, target in ready:
            scratch.replace(target)
    finally:
        for scratch, _ in ready:
            scratch.unlink(missing_ok=True)


def _prepare(path: str | Path, data: str | bytes) -> tuple[Path, Path]:
    """Write the content beside its target; returns the scratch file and the target."""
    try:
        target = Path(os.path.realpath(path))  # a link keeps pointing at the file that is replaced
        if target.is_dir():
            raise IsADirectoryError("it is a folder")
        if target.exists() and not os.access(target, os.W_OK):
            raise PermissionError("it is write-protected")
        scratch = target.with_name(f".{target.name[:100]}.{token_hex(6)}.tmp")
        try:
            with scratch.open("xb") as file:
                file.write(data.encode() if isinstance(data, str) else data)
                file.flush()
                os.fsync(file.fileno())
        except BaseException:
            scratch.unlink(missing_ok=True)
            raise
        return scratch, target
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise DesignError(Fault(str(path), f"cannot write this file: {reason}")) from error
