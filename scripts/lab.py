"""Start JupyterLab on the studio notebook and print its address once it answers.

Usage: python scripts/lab.py [NOTEBOOK] [JupyterLab's own options]

Run with the Python of `.venv`. Works as root and without a display; ends with JupyterLab (Ctrl-C twice stops it).
"""

from __future__ import annotations

import os
import secrets
import signal
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

from jupyter_server.serverapp import list_running_servers

ROOT = Path(__file__).resolve().parent.parent
PATIENCE = 120.0  # seconds that a slow machine has to start JupyterLab


def has_display() -> bool:
    if sys.platform == "darwin":
        return "SSH_CONNECTION" not in os.environ
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def find_server(pid: int) -> dict[str, str] | None:
    """Return what JupyterLab wrote about itself, once it answers."""
    for server in list_running_servers():
        if server["pid"] == pid:
            try:
                with urllib.request.urlopen(f"{server['url']}api", timeout=2):
                    return server
            except OSError:
                return None
    return None


def main(notebook: str, options: list[str]) -> int:
    # What JupyterLab says of itself would bury the address: warnings only, and no line about a token, which it
    # prints where it makes one itself.
    quiet = ["--ServerApp.log_level=WARN", "--LabApp.log_level=WARN"]
    quiet.append(
        "--ServerApp.jpserver_extensions=notebook_shim=False"
    )  # reads old settings; warns at every start
    environment = {"JUPYTER_TOKEN": secrets.token_hex(16), **os.environ}
    command = [sys.executable, "-m", "jupyterlab", notebook, f"--ServerApp.root_dir={ROOT}", *quiet]
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        command.append("--allow-root")
    if not has_display():
        command.append("--no-browser")
    print("[lab] starting JupyterLab", flush=True)
    lab = subprocess.Popen([*command, *options], cwd=ROOT, env=environment)
    # Ctrl-C reaches JupyterLab too, which asks whether it is meant; a polite end from outside is passed on.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda received, _frame: lab.send_signal(received))

    end = time.monotonic() + PATIENCE
    while lab.poll() is None and time.monotonic() < end:
        if server := find_server(lab.pid):
            token = f"?token={server['token']}" if server["token"] else ""
            print(f"\n[lab] Studio:  {server['url']}lab/tree/{notebook}{token}", flush=True)
            print("[lab] Ctrl-C twice stops it.\n", flush=True)
            break
        time.sleep(0.2)
    else:
        if lab.poll() is None:
            print("[lab] JupyterLab does not answer yet; see what it prints below", flush=True)
    return lab.wait()


if __name__ == "__main__":
    arguments = sys.argv[1:]
    first = arguments.pop(0) if arguments and not arguments[0].startswith("-") else "notebooks/studio.ipynb"
    sys.exit(main(first, arguments))
