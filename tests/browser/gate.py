"""A gate between a browser and a server: shut, it cuts all connections, as a network does."""

from __future__ import annotations

import contextlib
import select
import socket
import threading
from typing import Self
from urllib.parse import urlsplit

__all__ = ["Gate"]


class Gate:
    """Passes connections on to a server, while it is open.

    Attributes
    ----------
    address
        Where to come in.
    """

    def __init__(self, address: str) -> None:
        parts = urlsplit(address)
        self._server = (parts.hostname, parts.port)
        self._door = socket.create_server(("127.0.0.1", 0))
        self.address = f"http://127.0.0.1:{self._door.getsockname()[1]}"
        self._open = threading.Event()
        self._open.set()
        self._held = False
        self._ended = False
        self._through: set[socket.socket] = set()

    def __enter__(self) -> Self:
        threading.Thread(target=self._accept, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended = True
        self._door.close()
        self.shut()

    def shut(self) -> None:
        """Cut all connections, and let no new ones in."""
        self._open.clear()
        for end in list(self._through):
            with contextlib.suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)

    def hold(self) -> None:
        """Swallow what comes, without a word to either side."""
        self._held = True

    def open(self) -> None:
        """Let everything through."""
        self._held = False
        self._open.set()

    def _accept(self) -> None:
        while not self._ended:
            try:
                client, _ = self._door.accept()
            except OSError:
                return
            if not self._open.is_set():
                client.close()
                continue
            threading.Thread(target=self._pass, args=(client,), daemon=True).start()

    def _pass(self, client: socket.socket) -> None:
        with client, contextlib.suppress(OSError), socket.create_connection(self._server) as server:
            ends = {client: server, server: client}
            self._through.update(ends)
            try:
                while True:
                    for end in select.select(list(ends), [], [])[0]:
                        data = end.recv(65536)
                        if not data:
                            return
                        if not self._held:
                            ends[end].sendall(data)
            finally:
                self._through.difference_update(ends)
