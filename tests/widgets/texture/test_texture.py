"""The shared state of the texture views, and what the browser is told."""

from __future__ import annotations

import numpy as np
import pytest
from traitlets import TraitError

from facade_nb import gallery
from facade_nb.render import Grammar
from facade_nb.widgets import GrammarEditor, TextureModel, TextureView
from facade_nb.widgets.shared.bundled import AS_RUN, as_run
from facade_nb.widgets.texture.channel import TextureChannel
from facade_nb.widgets.texture.packet import grammar_table

RED = "S -> Mat(Color, 0, 1, 0, 0, 1)"


def test_a_text_with_faults_keeps_the_grammar() -> None:
    model = TextureModel(RED)
    before = model.grammar
    model.enter("S -> Matt(Color, 0, 1, 0, 0, 1)")
    assert model.grammar is before
    assert model.text.startswith("S -> Matt")
    assert [(fault.line, fault.column) for fault in model.faults] == [(1, 6)]
    model.enter(RED)
    assert model.faults == ()


def test_the_derivation_follows_grammar_and_size() -> None:
    model = TextureModel(RED)
    assert [step.operator for step in model.pick((1, 1))] == ["Mat"]
    model.enter("S -> RepeatX(2, A)  A -> Mat(Color, 0, 1, 0, 0, 1)")
    assert [step.operator for step in model.derivation] == ["RepeatX", "Mat"]
    model.size = (0.5, 9.0)
    assert model.derivation == ()


def test_bad_values_are_refused() -> None:
    model = TextureModel(RED)
    for name, value in (("size", (0.0, 1.0)), ("hour", 25.0), ("seed", (1e17, 0.0))):
        with pytest.raises(TraitError, match=name):
            setattr(model, name, value)


@pytest.mark.parametrize("name", gallery.grammars())
def test_the_table_says_what_the_texture_holds(name: str) -> None:
    grammar = Grammar.parse(gallery.grammar(name))
    texture = grammar.texture()
    places = set()
    for row in grammar_table(grammar):
        for pixel in row["pixels"]:
            x, y = pixel["at"]
            places.add((x, y))
            shown = [float(value.replace("−", "-")) for _, value in pixel["channels"]]
            np.testing.assert_allclose(shown, texture[y, x].astype(float), rtol=1e-3, atol=1e-6)
            for (label, _), value in zip(pixel["channels"], texture[y, x], strict=True):
                assert label or value == 0
    assert len(places) == grammar.encoding.pixels


def test_messages_of_the_page() -> None:
    model = TextureModel(RED)
    channel = TextureChannel.of(model)
    scene = channel.scene
    channel._receive(
        channel, {"op": "set", "name": "text", "value": "S -> Skip(0)", "client": "a", "seq": 3}, []
    )
    assert (model.text, channel.text) == ("S -> Skip(0)", "S -> Skip(0)")
    assert channel.ack == {"client": "a", "seq": 3}
    assert channel.scene != scene
    channel._receive(channel, {"op": "set", "name": "hour", "value": 22, "client": "a", "seq": 4}, [])
    assert model.hour == 22
    channel._receive(channel, {"op": "set", "name": "hour", "value": 25, "client": "a", "seq": 5}, [])
    assert (model.hour, channel.hour, channel.ack["seq"]) == (22, 22, 5)  # refused, and answered
    assert "hour: expected 0 to 24" in channel.trouble
    channel._receive(channel, {"op": "set", "name": "hour", "value": 8, "client": "a", "seq": 6}, [])
    assert channel.trouble == ""
    channel._receive(channel, {"op": "pick", "point": [1, 1], "ray": None}, [])
    assert [step["operator"] for step in channel.steps] == ["Skip"]
    assert channel.trouble == ""


def test_a_page_that_cannot_draw_is_sent_pictures() -> None:
    model = TextureModel(RED, size=(4, 3), lit=False)
    channel = TextureChannel.of(model)
    assert channel.still == b""
    channel._receive(channel, {"op": "still"}, [])
    first = channel.still
    assert first.startswith(b"\x89PNG")
    model.enter("S -> Mat(Color, 0, 0, 1, 0, 1)")
    assert channel.still.startswith(b"\x89PNG")
    assert channel.still != first


def test_views_share_a_channel_and_have_a_static_form() -> None:
    view = TextureView(RED)
    editor = GrammarEditor(view.model)
    assert editor.channel is view.channel
    assert view.to_html().startswith("<img alt=")
    assert view._repr_mimebundle_()[0]["text/html"] == as_run(view.to_html())
    assert AS_RUN in as_run(view.to_html())
    assert editor.to_html() == "<table><tr><td>1</td><td>S -&gt; Mat(Color, 0, 1, 0, 0, 1)</td></tr></table>"
