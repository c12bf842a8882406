"""Processes with all that comes of them, so that nothing of a step that is over goes on running."""

from __future__ import annotations

import contextlib
import time

import psutil

__all__ = ["Family"]


class Family:
    """A process and its descendants.

    Servers and browsers are in sessions of their own, where no signal to a group reaches them; and whose parent has
    been killed is nobody's child. So descendants are looked for again and again, and remembered.
    """

    def __init__(self, pid: int) -> None:
        self._known: dict[int, psutil.Process] = {}
        with contextlib.suppress(psutil.NoSuchProcess):
            self._known[pid] = psutil.Process(pid)

    def look(self) -> None:
        """Find those that have come since the last look."""
        # A number may have been given to another process since.
        self._known = {pid: one for pid, one in self._known.items() if one.is_running()}
        found = True
        while found:
            found = False
            for one in psutil.process_iter():
                with contextlib.suppress(psutil.Error):
                    if one.pid not in self._known and one.ppid() in self._known:
                        self._known[one.pid] = one
                        found = True

    def end(self) -> list[str]:
        """Kill whoever is left, and whoever they start meanwhile; returns their names."""
        names: list[str] = []
        for _ in range(200):
            self.look()
            left = [one for one in self._known.values() if _is_alive(one)]
            if not left:
                break
            for one in left:
                with contextlib.suppress(psutil.Error):
                    names.append(one.name())
                    one.kill()
            time.sleep(0.05)  # their parents wait for them, and not this one
        return names


def _is_alive(process: psutil.Process) -> bool:
    with contextlib.suppress(psutil.Error):
        return bool(process.is_running() and process.status() != psutil.STATUS_ZOMBIE)
    return False
