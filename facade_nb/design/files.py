"""Files written whole or not at all."""

from __future__ import annotations

import os
from pathlib import Path
from secrets import token_hex

from .errors import DesignError, Fault

__all__ = ["write_atomically"]


def write_atomically(path: str | Path, data: str | bytes) -> None:
    """Write a file through a temporary one beside it, so that nobody ever sees half of it.

    Text is written as UTF-8. On failure the old file stays and nothing new is left behind.

    Raises
    ------
    DesignError
        Naming the path, if it cannot be written.
    """
    content = data.encode() if isinstance(data, str) else data
    try:
        target = Path(os.path.realpath(path))  # a link keeps pointing at the file that is replaced
        if target.is_dir():
            raise IsADirectoryError("it is a folder")
        if target.exists() and not os.access(target, os.W_OK):
            raise PermissionError("it is write-protected")
        scratch = target.with_name(f".{target.name[:100]}.{token_hex(6)}.tmp")
        try:
            with scratch.open("xb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            scratch.replace(target)
        except BaseException:
            scratch.unlink(missing_ok=True)
            raise
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise DesignError(Fault(str(path), f"cannot write this file: {reason}")) from error
