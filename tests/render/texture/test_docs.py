"""docs/texture.md: its tables are those of the operator table, and its examples work."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from facade_nb.render import Grammar
from facade_nb.render.texture.limits import MAX_FACES, MAX_FRAMES, MAX_SEEDS, MAX_STEPS
from facade_nb.render.texture.painters import PAINTERS
from scripts.docs.texture import refresh

PAGE = Path(__file__).parents[3] / "docs" / "texture.md"


def test_the_page_has_the_tables_of_the_code() -> None:
    text = PAGE.read_text("utf-8")
    assert refresh(text) == text, "run: python -m scripts.docs.texture docs/texture.md"
    assert "| 13 | `MatAlpha(" in text and "`Repeat" in text


def test_the_page_has_the_limits_of_the_code() -> None:
    told = f"more than {MAX_FRAMES} Layer operators inside each other (the lowest layer does not count), "
    assert told + f"{MAX_SEEDS} RandStack, {MAX_FACES} Intrusion, or {MAX_STEPS} steps" in PAGE.read_text(
        "utf-8"
    )


def test_the_examples_work() -> None:
    text = PAGE.read_text("utf-8")
    (example,) = re.findall(r'Grammar\.parse\("""(.*?)"""\)', text, re.DOTALL)
    grammar = Grammar.parse(example)
    assert f"grammar.report()                                # '{grammar.report()[:34]}" in text
    surface = grammar.evaluate([(1.2, 1.5)], size=(12, 9), seed=(1, 2))
    assert np.isfinite(surface.color).all()
    assert grammar.steps((1.2, 1.5), size=(12, 9))
    (namespace,) = re.findall(r"```\n(namespace .*?)```", text, re.DOTALL)
    assert [rule.name for rule in Grammar.parse(namespace).rules][3:6] == [
        "bank.S",
        "bank.Window",
        "bank.Pane",
    ]


def test_the_pictures_work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = PAGE.read_text("utf-8")
    (example,) = re.findall(r"```python\n(from facade_nb.render.texture import .*?)```", text, re.DOTALL)
    monkeypatch.chdir(tmp_path)
    code = example.replace("(800, 600)", "(80, 60)")
    exec(code, {"grammar": Grammar.parse("S -> Mat(Color, Rep:brick, 0, 0, 0.5, 0.5)")})
    assert {path.name for path in tmp_path.iterdir()} == {"flat.png", "street.png"}


def test_the_page_names_the_backends() -> None:
    table = re.findall(r"^\| `(\w+)` \| [^|]*(?:moderngl|nothing)", PAGE.read_text("utf-8"), re.MULTILINE)
    assert table == list(PAINTERS)
