"""Files of text and JSON, all read in one way: UTF-8, with a byte-order mark or without."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from .errors import DesignError, Fault
from .text import fault_at

__all__ = ["Members", "read_json_text", "read_text"]

_MARKS = (
    (b"\xff\xfe\x00\x00", "UTF-32"),
    (b"\x00\x00\xfe\xff", "UTF-32"),
    (b"\xff\xfe", "UTF-16"),
    (b"\xfe\xff", "UTF-16"),
)


class Members(dict[str, Any]):
    """A JSON object that remembers which of its keys stand in it twice."""

    def __init__(self, pairs: list[tuple[str, Any]]) -> None:
        super().__init__(pairs)
        self.repeated: list[str] = []
        if len(self) < len(pairs):
            seen: set[str] = set()
            for key, _ in pairs:
                if key in seen:
                    self.repeated.append(key)
                seen.add(key)


def read_text(path: str | Path, what: str = "") -> str:
    """The text of a file, without a byte-order mark, lines ended by newlines.

    Parameters
    ----------
    what
        What the file is to be: ``a grammar``.

    Raises
    ------
    DesignError
        For a file that cannot be opened, or is not text in UTF-8, with its path as the place.
    """
    head = f"cannot be read as {what}" if what else "cannot be read"
    try:
        return Path(path).read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        coding = next((name for mark, name in _MARKS if error.object.startswith(mark)), "")
        found = f"it looks like {coding}" if coding else f"byte {error.start} is none"
        raise DesignError(Fault(str(path), f"{head}: it is not text in UTF-8; {found}")) from error
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise DesignError(Fault(str(path), f"{head}: {reason}")) from error


def read_json_text(text: str, place: str = "") -> Any:
    """What a JSON text says, its objects as `Members`.

    Raises
    ------
    DesignError
        For text that is not JSON, with line and column.
    """
    try:
        return json.loads(text, object_pairs_hook=Members)
    except json.JSONDecodeError as error:
        reason = error.msg[:1].lower() + error.msg[1:]
        raise DesignError(fault_at(text, error.pos, f"this is not JSON: {reason}", place)) from error
    except RecursionError as error:
        raise DesignError(Fault(place, "lists and objects are nested too deeply")) from error
    except ValueError as error:  # an integer of thousands of digits
        raise DesignError(Fault(place, "a number has too many digits")) from error
