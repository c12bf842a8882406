"""Undo and redo, as states and steps."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from facade_nb import gallery
from facade_nb.widgets import FacadeModel, SurveyModel, TextureModel
from facade_nb.widgets.shared import history as module
from facade_nb.widgets.shared.history import History
from facade_nb.widgets.texture.channel import TextureChannel


def test_keystrokes_in_one_field_are_one_step_until_there_is_a_pause() -> None:
    history = History("", pause=1.0)
    for now, text in ((0.0, "a"), (0.5, "ab"), (1.4, "abc"), (9.0, "abcd")):
        history.record(text, key="field", now=now)
    assert history.undo() == "abc"
    assert history.undo() == ""


def test_what_comes_late_and_in_pieces_is_one_step_if_it_was_typed_in_one_go() -> None:
    history = History("", pause=1.0)
    for now, after, text in ((0.0, None, "a"), (7.0, 0.2, "ab"), (7.1, 3.0, "abc"), (20.0, 1.0, "abcd")):
        history.record(text, key="field", now=now, after=after)
    assert history.undo() == "ab"  # a pause of three seconds, though they arrived one after the other
    assert history.undo() == ""


def test_a_hand_has_its_own_clock_in_every_model() -> None:
    """The front end says when something was entered; what has another model's hand, or none, has no such time."""
    texture = TextureModel("A -> Mat(Color, 0, 1, 0, 0, 1)")
    for model in (texture, SurveyModel(), FacadeModel(gallery.load("figure-7"))):
        for after, expected in ((0.25, 0.25), (None, None), ("soon", None), (2, 2.0)):
            with model.by_hand(after):
                assert model.after == expected
            assert model.after is None


def test_a_text_is_one_step_however_late_its_letters_arrive(monkeypatch: pytest.MonkeyPatch) -> None:
    times = iter(range(0, 1000, 9))
    monkeypatch.setattr(module, "time", SimpleNamespace(monotonic=lambda: float(next(times))))
    model = TextureModel(text := "A -> Mat(Color, 0, 1, 0, 0, 1)")
    wire = TextureChannel.of(model)
    for seq, (typed, after) in enumerate(((" ", 30.0), (" #", 0.1), (" # A", 0.4), (" # AB", 5.0)), start=1):
        message = {
            "op": "set",
            "name": "text",
            "value": text + typed,
            "after": after,
            "client": "c",
            "seq": seq,
        }
        wire._receive(wire, message, [])
    model.undo()
    assert model.text == f"{text} # A"
    model.undo()
    assert model.text == text


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
