"""The examples of docs/patterns.md say what the code does."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path

import pytest

from facade_nb.design import PatternError, parse

TEXT = (Path(__file__).parents[2] / "docs" / "patterns.md").read_text(encoding="utf-8")


def rows() -> list[tuple[str, dict[str, int], list[str]]]:
    """Rows of every table headed pattern, counters, words."""
    found = []
    for table in re.findall(r"\| pattern \| counters \| words \|\n\|[-|]+\n((?:\|.*\n)+)", TEXT):
        for line in table.splitlines():
            pattern, counters, words = (
                re.findall(r"`([^`]*)`", cell.replace("\\|", "|"))
                for cell in re.split(r"(?<!\\)\|", line)[1:-1]
            )
            values = dict(counter.split(" = ") for counter in counters)
            found.append((pattern[0], {name: int(value) for name, value in values.items()}, words))
    return found


def block(after: str) -> list[str]:
    """Lines of the first code block after a heading."""
    section = TEXT[TEXT.index(f"## {after}\n") :]
    return re.search(r"```\w*\n(.*?)```", section, re.DOTALL)[1].splitlines()  # type: ignore[index]


def test_every_table_is_found() -> None:
    assert len(rows()) == TEXT.count("\n| `") - 3  # the table of letters has three rows of its own


@pytest.mark.parametrize(("pattern", "counters", "words"), rows())
def test_tables(pattern: str, counters: dict[str, int], words: list[str]) -> None:
    assert ["".join(map(str, word)) for word in parse(pattern).words(counters)] == words


def test_letters_of_the_first_table_are_symbols() -> None:
    for text in ("A", "b2", "Δ", "漢", "<window>", "<front door>"):
        assert len(parse(text).symbols) == 1


def test_examples_without_results_can_be_read() -> None:
    for line in TEXT[TEXT.index("```\n") + 4 :].split("```")[0].splitlines():
        assert parse(re.split(r"\s{3,}", line)[0]).solids
    assert parse("\n".join(block("Substitution"))) == parse("yBmAm^-1By; m := (AB)^k")


def test_faults() -> None:
    lines = block("Faults")
    for text, told in zip(lines[::2], lines[1::2], strict=True):
        with pytest.raises(PatternError) as error:
            parse(text)
        fault = error.value.fault
        assert fault.excerpt == f"{text}\n{told[: told.index('^') + 1]}"
        assert fault.message == told[told.index("^") + 2 :]


def test_python() -> None:
    output = io.StringIO()
    with contextlib.redirect_stdout(output):
        exec("\n".join(block("In Python")), {})
    assert output.getvalue() == "y B A B A B' A' B y\n"
    pattern = parse("yBmAm^-1By; m := (AB)^k")
    assert (pattern.counters, pattern.symbols) == (("k",), ("y", "B", "A"))
