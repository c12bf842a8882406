"""Undo and redo, as states and steps."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from facade_nb.widgets.shared.history import History


def test_keystrokes_in_one_field_are_one_step_until_there_is_a_pause() -> None:
    history = History("", pause=1.0)
    for now, text in ((0.0, "a"), (0.5, "ab"), (1.4, "abc"), (9.0, "abcd")):
        history.record(text, key="field", now=now)
    assert history.undo() == "abc"
    assert history.undo() == ""


def test_other_fields_and_edits_without_a_field_are_steps_of_their_own() -> None:
    history = History(0)
    for value, key in ((1, "x"), (2, "y"), (3, None), (4, None)):
        history.record(value, key=key, now=0.0)
    assert [history.undo() for _ in range(4)] == [3, 2, 1, 0]


def test_typing_after_an_undo_begins_a_new_step() -> None:
    history = History(0)
    history.record(1, key="x", now=0.0)
    history.undo()
    history.record(2, key="x", now=0.1)
    assert history.undo() == 0
    assert not history.can_undo


def test_what_is_not_there_cannot_be_undone() -> None:
    history = History(0)
    history.record(0, key="x", now=0.0)
    with pytest.raises(IndexError):
        history.undo()
    with pytest.raises(IndexError):
        history.redo()


def test_the_oldest_states_are_forgotten() -> None:
    history = History(0, limit=3)
    for value in range(1, 10):
        history.record(value, key=None, now=0.0)
    assert [history.undo() for _ in range(3)] == [8, 7, 6]
    assert not history.can_undo


@given(st.lists(st.one_of(st.integers(0, 5), st.sampled_from(["undo", "redo"])), max_size=40))
def test_is_a_line_of_states_with_a_present_one(actions: list[int | str]) -> None:
    history = History(-1)
    line, at = [-1], 0
    for action in actions:
        if action == "undo":
            if history.can_undo:
                at -= 1
                assert history.undo() == line[at]
        elif action == "redo":
            if history.can_redo:
                at += 1
                assert history.redo() == line[at]
        elif action != line[at]:
            history.record(int(action), key=None, now=0.0)
            line[at + 1 :] = [int(action)]
            at += 1
        assert history.present == line[at]
        assert history.can_undo == (at > 0)
        assert history.can_redo == (at < len(line) - 1)
