"""A designer's way out: the stop button of a notebook, in the midst of a search that would not end."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from queue import Empty

import pytest
from jupyter_client.blocking.client import BlockingKernelClient
from jupyter_client.manager import KernelManager, start_new_kernel

SETUP = """
from facade_nb import gallery, solve
from tests.oracle.nasty import NASTY
"""


@pytest.fixture(scope="module")
def kernel() -> Iterator[tuple[KernelManager, BlockingKernelClient]]:
    manager, client = start_new_kernel()
    try:
        yield manager, client
    finally:
        client.stop_channels()
        manager.shutdown_kernel(now=True)


def answer(client: BlockingKernelClient, sent: str, timeout: float | None = None) -> dict[str, object]:
    """What became of a cell."""
    while True:
        reply = client.get_shell_msg(timeout=timeout)
        if reply["parent_header"].get("msg_id") == sent:
            content: dict[str, object] = reply["content"]
            return content


def value(client: BlockingKernelClient, text: str) -> str:
    """An expression's value in the kernel."""
    content: dict[str, object] = {}
    while content.get("status") != "ok":  # what comes right after an error may be passed over
        content = answer(client, client.execute("", user_expressions={"it": text}))
    found = content["user_expressions"]["it"]  # type: ignore[index]
    assert found["status"] == "ok", found
    return str(found["data"]["text/plain"])


@pytest.mark.parametrize("seconds", [0.1, 0.6])
@pytest.mark.parametrize("name", ["six counters, no layout", "40 layers"])
def test_the_stop_button(
    kernel: tuple[KernelManager, BlockingKernelClient], name: str, seconds: float
) -> None:
    manager, client = kernel
    assert answer(client, client.execute(SETUP))["status"] == "ok"
    sent = client.execute(f"solve(NASTY[{name!r}], time_limit=None)", stop_on_error=False)
    while client.get_iopub_msg(timeout=None)["msg_type"] != "execute_input":
        pass
    time.sleep(seconds)  # wherever it is by then: words, candidates, alignment
    content = None
    while content is None:  # a kernel takes no notice of what comes just before a cell begins
        manager.interrupt_kernel()
        with suppress(Empty):
            content = answer(client, sent, timeout=2.0)
    assert content["status"] == "error" and content["ename"] == "KeyboardInterrupt"
    # Nothing that is kept between calls is spoilt: the same kernel solves on, twice alike.
    same = "[solve(gallery.load('qualifiers-a'), time_limit=None).to_dict() for _ in 'ab']"
    assert value(client, f"(lambda a, b: a == b and b['complete'])(*{same})") == "True"


SIGNALS = """
import os, signal, threading
from facade_nb import NoLayout, solve
from facade_nb.solver import solution as solving
from tests.bench.designs import harder

design = harder()["terraced-house (harder)"]  # seconds in compiled code

class Over(Exception):
    pass

def over(number, frame):
    raise Over

def interrupted(number, seconds, error):
    threading.Timer(seconds, os.kill, (os.getpid(), number)).start()
    try:
        while True:  # until it comes
            solving.forget()
            solve(design, time_limit=None)
    except error:
        return True

handler = signal.getsignal(signal.SIGINT)
assert all(interrupted(signal.SIGINT, 0.2 + 0.06 * k, KeyboardInterrupt) for k in range(10))
if hasattr(signal, "SIGALRM"):
    signal.signal(signal.SIGALRM, over)
    assert all(interrupted(signal.SIGALRM, 0.2 + 0.06 * k, Over) for k in range(5))
    assert signal.getsignal(signal.SIGALRM) is over
assert signal.getsignal(signal.SIGINT) is handler
print("well")
"""


def test_signals_while_compiled_code_runs() -> None:
    """What a handler raises must not leave wasmtime's callback: that brought the process down, now and then."""
    ran = subprocess.run([sys.executable, "-c", SIGNALS], capture_output=True, text=True)
    assert (ran.returncode, ran.stdout, ran.stderr) == (0, "well\n", "")
