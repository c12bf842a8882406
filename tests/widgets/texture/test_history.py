"""Undo and redo of whatever is edited of a texture model."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from traitlets import TraitError

from facade_nb.render import Grammar
from facade_nb.widgets import TextureModel
from facade_nb.widgets.shared import history as module
from facade_nb.widgets.texture.channel import TextureChannel

RED = "S -> Mat(Color, 0, 1, 0, 0, 1)"
BLUE = "S -> Mat(Color, 0, 0, 0, 1, 1)"


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """A clock that is set by hand."""
    made = SimpleNamespace(now=100.0)
    monkeypatch.setattr(module, "time", SimpleNamespace(monotonic=lambda: made.now))
    return made


@pytest.mark.parametrize(
    ("name", "value"),
    [("size", (20.0, 5.0)), ("seed", (3.0, 6.0)), ("hour", 22.0), ("lit", False), ("text", BLUE)],
)
def test_every_edit_is_undone_and_redone(name: str, value: Any) -> None:
    model = TextureModel(RED)
    before = getattr(model, name)
    assert (model.can_undo, model.can_redo) == (False, False)
    if name == "text":
        model.enter(value)
    else:
        setattr(model, name, value)
    assert (model.can_undo, model.can_redo) == (True, False)
    model.undo()
    assert (getattr(model, name), model.can_undo, model.can_redo) == (before, False, True)
    model.undo()  # there is none: nothing happens
    model.redo()
    assert (getattr(model, name), model.can_undo, model.can_redo) == (value, True, False)
    model.redo()
    assert getattr(model, name) == value


def test_typing_is_one_step_until_it_rests(clock: SimpleNamespace) -> None:
    model = TextureModel(RED)
    for end in range(1, 5):
        clock.now += 0.2
        model.enter(RED + " # r"[:end])
    clock.now += 1.1
    model.enter(RED + " # re")
    model.undo()
    assert model.text == RED + " # r"
    model.undo()
    assert (model.text, model.can_undo) == (RED, False)


def test_a_slider_is_one_step_and_each_assignment_one_of_its_own(clock: SimpleNamespace) -> None:
    model = TextureModel(RED)
    for width in (13.0, 14.0, 15.0):
        model.adjust("size", (width, 9.0))
    for height in (10.0, 11.0):  # another slider
        model.adjust("size", (15.0, height))
    model.adjust("lit", False)
    model.adjust("lit", True)
    model.hour = 5.0
    model.hour = 6.0
    seen = []
    while model.can_undo:
        model.undo()
        seen.append((model.size, model.lit, model.hour))
    assert seen == [
        ((15.0, 11.0), True, 5.0),
        ((15.0, 11.0), True, 11.0),
        ((15.0, 11.0), False, 11.0),
        ((15.0, 11.0), True, 11.0),
        ((15.0, 9.0), True, 11.0),
        ((12.0, 9.0), True, 11.0),
    ]


def test_a_faulty_text_comes_back_with_the_grammar_it_was_shown_with(clock: SimpleNamespace) -> None:
    model = TextureModel("")
    for text in ("Nonsense", RED, "Nonsense again", BLUE, "At last"):
        clock.now += 5
        model.enter(text)

    def state() -> tuple[str, str | None, bool]:
        return model.text, model.grammar and model.grammar.text, bool(model.faults)

    wanted = [
        ("", None, True),
        ("Nonsense", None, True),
        (RED, RED, False),
        ("Nonsense again", RED, True),
        (BLUE, BLUE, False),
        ("At last", BLUE, True),
    ]
    seen = [state()]
    while model.can_undo:
        model.undo()
        seen.append(state())
    assert seen == wanted[::-1]
    seen = [state()]
    while model.can_redo:
        model.redo()
        seen.append(state())
    assert seen == wanted


def test_an_edit_forgets_what_was_undone_and_a_refused_one_does_not() -> None:
    model = TextureModel(RED)
    model.hour = 5.0
    model.undo()
    with pytest.raises(TraitError, match="hour"):
        model.adjust("hour", 25.0)
    assert (model.hour, model.can_redo) == (11.0, True)
    model.hour = 6.0
    assert not model.can_redo


def test_observers_see_a_step_that_is_whole() -> None:
    model = TextureModel(RED, tiles=None)
    model.enter(BLUE)
    seen: list[tuple[str, str | None, int]] = []

    def look(_: Any) -> None:
        assert isinstance(model.grammar, Grammar)
        seen.append((model.text, model.grammar.text, len(model.faults)))

    model.observe(look, ["text", "grammar"])
    model.undo()
    assert set(seen) == {(RED, RED, 0)}


def test_the_page_asks_and_is_told(clock: SimpleNamespace) -> None:
    model = TextureModel(RED)
    channel = TextureChannel.of(model)
    seq = 0

    def ask(op: str, **arguments: Any) -> None:
        nonlocal seq
        seq += 1
        channel._receive(channel, {"op": op, "client": "a", "seq": seq, **arguments}, [])
        assert channel.ack == {"client": "a", "seq": seq}

    assert (channel.can_undo, channel.can_redo) == (False, False)
    ask("set", name="text", value=BLUE)
    for hour in (12, 13):
        ask("set", name="hour", value=hour)
    assert (channel.can_undo, channel.can_redo) == (True, False)
    ask("undo")
    assert (channel.hour, channel.text, channel.can_redo) == (11, BLUE, True)
    scene = channel.scene
    ask("undo")
    assert (channel.text, channel.can_undo, channel.scene != scene) == (RED, False, True)
    ask("undo")  # there is none: answered all the same
    ask("redo")
    assert (channel.text, channel.can_undo, channel.can_redo) == (BLUE, True, True)
