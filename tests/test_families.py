"""What a step of the tests has started ends with it, however far away it has gone (scripts/families.py)."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import psutil
import pytest

TREE = """
import subprocess, sys, time
depth = int(sys.argv[1])
if depth:
    command = [sys.executable, __file__, str(depth - 1)]
    child = subprocess.Popen(command, start_new_session=True, stdout=subprocess.PIPE, text=True)
    print(child.pid, child.stdout.readline(), end="", flush=True)
else:
    print(flush=True)
time.sleep(600)
"""


@pytest.fixture
def module(root: Path, monkeypatch: pytest.MonkeyPatch) -> type:
    monkeypatch.syspath_prepend(str(root / "scripts"))
    return __import__("families").Family  # type: ignore[no-any-return]


@pytest.mark.parametrize("killed", [False, True])
def test_nobody_is_left(module: type, killed: bool, tmp_path: Path) -> None:
    """Each is in a session of its own; of the second kind, those in the middle have gone before."""
    script = tmp_path / "tree.py"
    script.write_text(TREE)
    first = subprocess.Popen([sys.executable, script, "3"], stdout=subprocess.PIPE, text=True)
    assert first.stdout is not None
    later = [psutil.Process(int(pid)) for pid in first.stdout.readline().split()]
    stranger = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
    try:
        assert len(later) == 3
        family = module(first.pid)
        family.look()
        if killed:
            later[1].kill()
            first.kill()
            first.wait()
        family.end()
        assert not [one for one in later if one.is_running() and one.status() != psutil.STATUS_ZOMBIE]
        assert first.wait() != 0
        assert stranger.poll() is None
        assert family.end() == []
    finally:
        for one in (stranger, first):
            one.kill()
            one.wait()
        first.stdout.close()
