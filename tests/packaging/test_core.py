"""`scripts/core.py --check` tells a compiled search that its sources did not make."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def core(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The script, at work on a copy of the sources and of the module."""
    monkeypatch.syspath_prepend(str(ROOT / "scripts"))
    monkeypatch.delitem(sys.modules, "core", raising=False)
    import core

    monkeypatch.setattr(core, "MODULE", tmp_path / "core" / core.MODULE.name)
    shutil.copytree(core.CORE, tmp_path / "core")
    monkeypatch.setattr(core, "CORE", tmp_path / "core")
    return core


def test_the_committed_module_is_what_was_made_of_its_sources(core: ModuleType) -> None:
    assert core.is_current()


@pytest.mark.parametrize("name", ["core.cpp", "edges.hpp"])
def test_a_changed_source_is_told(core: ModuleType, name: str) -> None:
    with (core.CORE / name).open("a") as source:
        source.write("\n")
    assert not core.is_current()


def test_a_new_compiler_is_told(core: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(core, "pinned", lambda package: "99.0")
    assert not core.is_current()


@pytest.mark.parametrize("harm", [lambda b: b"", lambda b: b[:-1], lambda b: b[:99] + b"\0" + b[99:]])
def test_a_module_that_is_not_whole_is_told(core: ModuleType, harm: Callable[[bytes], bytes]) -> None:
    core.MODULE.write_bytes(harm(core.MODULE.read_bytes()))
    assert not core.is_current()
