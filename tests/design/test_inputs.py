"""One way of reading text from files, for designs, surveys, grammars and traces."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from facade_nb import Design, DesignError
from facade_nb.design.inputs import read_json_text, read_text
from facade_nb.solver.trace.trace import Trace


def test_text_is_utf_8_with_a_byte_order_mark_or_without(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    for data in (b"\xc3\xa9\r\nb\r", b"\xef\xbb\xbf\xc3\xa9\nb\n"):
        path.write_bytes(data)
        assert read_text(path) == read_text(str(path)) == "é\nb\n"
    path.write_bytes(b"")
    assert read_text(path) == ""


@pytest.mark.parametrize(
    ("data", "told"),
    [
        ("é".encode("utf-16"), "it is not text in UTF-8; it looks like UTF-16"),
        ("é".encode("utf-16-be"), "it is not text in UTF-8; byte 1 is none"),
        (b"\xfe\xff\x00A", "it is not text in UTF-8; it looks like UTF-16"),
        ("é".encode("utf-32"), "it is not text in UTF-8; it looks like UTF-32"),
        (b"ab\xff", "it is not text in UTF-8; byte 2 is none"),
    ],
)
def test_other_codings_are_told(tmp_path: Path, data: bytes, told: str) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes(data)
    with pytest.raises(DesignError) as error:
        read_text(path, "a grammar")
    assert str(error.value) == f"{path}: cannot be read as a grammar: {told}"


def test_what_cannot_be_opened_is_told(tmp_path: Path) -> None:
    for path, told in [
        (tmp_path / "none", "No such file or directory"),
        (tmp_path, "Is a directory"),
        (tmp_path / "a\0b", "null"),
    ]:
        with pytest.raises(DesignError, match=rf"cannot be read: .*{told}"):
            read_text(path)


def test_json_is_told_with_line_and_column() -> None:
    assert read_json_text('{"a": 1, "a": 2}').repeated == ["a"]
    with pytest.raises(DesignError, match=r"place, line 2, column 1: this is not JSON: expecting value"):
        read_json_text("[1,\n]", "place")
    with pytest.raises(DesignError, match="nested too deeply"):
        read_json_text("[" * 100_000)
    with pytest.raises(DesignError, match="too many digits"):
        read_json_text("9" * 5000)


def test_a_trace_may_begin_with_a_byte_order_mark(tmp_path: Path) -> None:
    path = tmp_path / "trace.json"
    text = Trace([]).to_json()
    path.write_text("\ufeff" + text, encoding="utf-8")
    assert Trace.from_json(path).to_json() == Trace.from_json("\ufeff" + text).to_json() == text


def test_a_design_too(tmp_path: Path) -> None:
    path = tmp_path / "design.json"
    path.write_text("\ufeff" + json.dumps(Design().to_dict()), encoding="utf-8")
    assert Design.from_json(path) == Design()
