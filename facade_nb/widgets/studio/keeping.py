"""What a studio keeps beside its notebook, so that a design outlives its kernel (docs/widgets.md)."""

from __future__ import annotations

import asyncio
import json
import os
import re
import secrets
import socket
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal
from weakref import WeakValueDictionary

from ...design import Design, DesignError
from ...design.files import write_atomically
from .model import FacadeModel

__all__ = ["FOLDER", "Keeper", "Kept", "kept_path", "studio_name"]

FOLDER = ".facade_nb"
"""The folder beside the notebook."""

State = Literal["on", "restored", "offered", "elsewhere", "failed"]

_FORMAT = "facade-nb/kept/1"
_DELAY = 0.3
_STEPS = 40
"""So many steps of undo are kept, and as many of redo."""
_SELF = {"host": socket.gethostname(), "pid": os.getpid(), "token": secrets.token_hex(8)}
_counts: dict[str, int] = {}


@dataclass(frozen=True, slots=True)
class Kept:
    """A design that was kept: what its cell began with, how it was last, its history, who wrote it, and when."""

    origin: Design
    design: Design
    past: tuple[Design, ...]
    future: tuple[Design, ...]
    writer: Mapping[str, Any]
    when: float

    @classmethod
    def read(cls, path: Path) -> Kept | None:
        """What a file has; None where there is none, or none that can be read."""
        try:
            document = json.loads(path.read_text(encoding="utf-8"))
            if document["format"] != _FORMAT:
                return None
            one = Design.from_dict
            return cls(
                one(document["origin"]),
                one(document["design"]),
                tuple(map(one, document["past"])),
                tuple(map(one, document["future"])),
                dict(document["writer"]),
                float(document["when"]),
            )
        except (OSError, ValueError, TypeError, KeyError, DesignError):
            return None

    @property
    def alive(self) -> bool:
        """Whether the kernel that wrote it still runs, as far as can be told from here."""
        pid = self.writer.get("pid")
        elsewhere = self.writer.get("host") != _SELF["host"]
        if elsewhere or (
            os.name == "nt" and pid != os.getpid()
        ):  # there, to ask a process is to interrupt it
            return time.time() - self.when < 3600.0
        if not isinstance(pid, int) or pid <= 0:
            return False
        if pid == os.getpid():
            return self.writer.get("token") == _SELF["token"]
        try:
            os.kill(pid, 0)
        except ProcessLookupError:
            return False
        except OSError:
            return True
        return True


class Keeper:
    """Keeps a model's design in a file while it is edited, and brings back what was kept.

    Parameters
    ----------
    model
        What is kept.
    path
        The file.
    told
        Called when there is something new to say.

    Attributes
    ----------
    state
        ``on``; ``restored``: a kernel that has gone had kept this design, and it was brought back; ``offered``:
        something else was kept, and can be brought back; ``elsewhere``: another kernel keeps it there, and nothing
        is written; ``failed``: it cannot be written.
    """

    def __init__(self, model: FacadeModel, path: Path, told: Callable[[], None] = lambda: None) -> None:
        self.model = model
        self.path = path
        self._told = told
        self.state: State = "on"
        self.reason = ""
        self._origin = self._last = model.design
        self._timer: asyncio.TimerHandle | None = None
        if path in _keepers:
            _keepers[path].catch_up()
        _keepers[path] = self
        self._found = Kept.read(path)
        self._mine = False
        self._begin()
        model.observe(self._on_version, "version")

    def _begin(self) -> None:
        found = self._found
        if found is None or found.design == self._origin:
            return
        own = found.writer.get("token") == _SELF["token"]
        if found.alive and not own:
            self.state = "elsewhere"
        elif found.origin == self._origin and not own:
            self.restore()
            self.state = "restored"
        else:
            self.state = "offered"

    def describe(self) -> dict[str, Any]:
        """What a view says of it."""
        found = self._found
        when = time.strftime("%H:%M", time.localtime(found.when)) if found is not None else ""
        name = found.design.name if found is not None else ""
        return {
            "state": self.state,
            "name": name,
            "when": when,
            "reason": self.reason,
            "file": self.path.name,
        }

    def restore(self) -> None:
        """Bring back what was kept, with its history. What stands here now is one step of undo away."""
        found = self._found
        if found is None:
            return
        here = self.model.design
        past = found.past if here == self._origin and found.origin == here else (*found.past, here)
        self.model.resume(past, found.design, found.future)
        self.settle()

    def settle(self) -> None:
        """Say no more of what was found; where another kernel kept it, write over that from now on."""
        self.state = "on"
        self._mine = True
        self._on_version(None)

    def anew(self) -> None:
        """Begin anew with what the cell says, as a step that can be undone."""
        self.model.load(self._origin)
        self.settle()

    def close(self) -> None:
        """Write what is not yet written, and keep no more."""
        self.model.unobserve(self._on_version, "version")
        self.catch_up()

    def catch_up(self) -> None:
        """Write what is not yet written: a cell that is run again at once finds it."""
        if self._timer is not None:
            self.write()

    def _on_version(self, _: object) -> None:
        if self.model.design == self._last or self._timer is not None:
            return
        try:
            self._timer = asyncio.get_running_loop().call_later(_DELAY, self.write)
        except RuntimeError:
            self.write()

    def write(self) -> None:
        """Write the file now, unless it is another kernel's."""
        before = self.state
        self._write()
        if self.state != before:
            self._told()

    def _write(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        if self.state == "elsewhere" or not self._may_write():
            return
        past, future = self.model.history
        document = {
            "format": _FORMAT,
            "origin": self._origin.to_dict(),
            "design": self.model.design.to_dict(),
            "past": [design.to_dict() for design in past[-_STEPS:]],
            "future": [design.to_dict() for design in future[-_STEPS:]],
            "writer": _SELF,
            "when": time.time(),
        }
        try:
            _make(self.path.parent)
            write_atomically(self.path, json.dumps(document, ensure_ascii=False))
        except OSError as error:
            self.state, self.reason = "failed", str(error)
        else:
            self._last = self.model.design
            if self.state == "failed":
                self.state, self.reason = "on", ""

    def _may_write(self) -> bool:
        """Whether the file is ours, or nobody's; what stands there of another model is put beside it once."""
        if self._mine:
            there = Kept.read(self.path)
            if there is None or there.writer.get("token") == _SELF["token"] or not there.alive:
                return True
            if self._last != self._origin or self.state != "on":
                self.state, self._found = "elsewhere", there
                return False
            return True
        there = Kept.read(self.path)
        if there is not None and there.alive and there.writer.get("token") != _SELF["token"]:
            self.state, self._found = "elsewhere", there
            return False
        if there is not None and there.design != self.model.design:
            with suppress(OSError):
                write_atomically(self.path.with_suffix(".before.json"), self.path.read_bytes())
        self._mine = True
        return True


_keepers: WeakValueDictionary[Path, Keeper] = WeakValueDictionary()
"""Who keeps what in which file; of several the last."""


def _make(folder: Path) -> None:
    """Make the folder; what is in it is nobody's to commit."""
    folder.mkdir(parents=True, exist_ok=True)
    top = next(parent for parent in (folder, *folder.parents) if parent.name == FOLDER)
    ignore = top / ".gitignore"
    if not ignore.exists():
        ignore.write_text("*\n", encoding="utf-8")


def studio_name() -> tuple[str, str] | None:
    """The names of the notebook and of the studio that its running cell makes; None where there is no notebook.

    A cell keeps its name when it is run again; its second studio has another one.
    """
    session = os.environ.get("JPY_SESSION_NAME", "")
    try:
        from IPython import get_ipython
    except ImportError:
        return None
    shell = get_ipython()
    if not session or shell is None or not hasattr(shell, "kernel"):
        return None
    parent = shell.get_parent() or {}
    cell = parent.get("metadata", {}).get("cellId")
    if not cell:
        return None
    run = f"{parent.get('header', {}).get('msg_id')} {cell}"
    number = _counts[run] = _counts.get(run, 0) + 1
    return _plain(Path(session).stem), _plain(cell) + (f"-{number}" if number > 1 else "")


def kept_path(notebook: str, studio: str) -> Path:
    """The file of a studio."""
    return Path.cwd() / FOLDER / _plain(notebook) / f"{_plain(studio)}.json"


def _plain(name: str) -> str:
    return re.sub(r"[^\w-]+", "-", name).strip("-") or "studio"
