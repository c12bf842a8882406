"""What the studio tells of words and letters: only what a view asks for, and after all else."""

from __future__ import annotations

import asyncio
from typing import Any

from facade_nb import gallery
from facade_nb.design.edit import with_pattern
from facade_nb.solver.cache import CACHE
from facade_nb.widgets import FacadeModel
from facade_nb.widgets.studio.channel import Channel
from facade_nb.widgets.studio.words import describe_modes, describe_words


def house() -> FacadeModel:
    return FacadeModel(gallery.load("residential-house"))


def reasons(told: dict[str, Any]) -> list[str]:
    return [word["reason"] for axis in told["axes"] for word in axis["words"]]


def test_words_are_told_with_the_chosen_one_and_why_the_others_are_not() -> None:
    told = describe_words(house(), "Bx")
    assert reasons(told) == ["looser", "chosen", "looser", "looser", "too long"]
    (axis,) = told["axes"]
    assert (axis["axis"], axis["canvas"], axis["more"]) == ("x", 6.0, 1)
    chosen = axis["words"][1]
    assert [symbol for symbol, _, _ in chosen["letters"]] == list("ABABABA")
    assert [place for *_, place in chosen["letters"]] == [0, 2, 3, 2, 3, 2, 3]
    assert (chosen["size"], chosen["miss"], chosen["counters"]) == (5.6, 0.4, {"k": 3})


def test_they_are_told_where_there_is_no_layout() -> None:
    model = house()
    model.enter("patterns.Bx.text", "A^40")
    assert model.message
    assert reasons(describe_words(model, "Bx")) == ["too long"]
    model.enter("patterns.Bx.text", "A(BA^k")  # a draft: the words are those of the text before
    assert describe_words(model, "Bx")["text"] == "A^40"


def test_it_is_said_why_there_are_none() -> None:
    model = house()
    model.edit(with_pattern(with_pattern(model.design, "spare", "AA"), "blank", "ε"))
    assert describe_words(model, "spare")["note"] == "No visible layer uses it."
    assert describe_words(model, "blank")["note"] == "It has no letters yet."
    assert describe_words(model, "gone") == {}


def test_letters_know_their_places_as_a_browser_counts() -> None:
    model = house()
    channel = Channel.of(model)
    assert channel.words == {}
    model.enter("patterns.Bx.text", "A #😀\r\n\r\nB := B")
    assert model.drafts  # B does not stand in the control pattern
    model.enter("patterns.Bx.text", "#😀\r\nA(BA)^k")
    told = channel.letters["x"]["Bx"]
    assert told["text"] == "#😀\nA(BA)^k"
    text = told["text"].encode("utf-16-le")
    written = [text[2 * place : 2 * place + 2].decode("utf-16-le") for _, place, *_ in told["letters"]]
    assert "".join(written) == "ABABABA"
    ends = [end for *_, end, _ in told["letters"]]
    assert [start for _, _, start, *_ in told["letters"]] == [0.0, *ends[:-1]] and ends[-1] == 6.0


def test_a_cut_letter_lies_from_its_first_piece_to_its_last() -> None:
    model = house()
    channel = Channel.of(model)
    channel.publish()
    assert model.layout is not None
    pieces = [one for one in model.layout.x.row("columns").letters if one.symbol == "e"]
    assert len(pieces) > 1
    symbol, place, start, end, flags = channel.letters["x"]["Cx"]["letters"][1]
    assert (symbol, place, flags) == ("e", 1, "t")
    assert (start, end) == (round(pieces[0].start, 4), round(pieces[-1].end, 4))


def test_words_come_after_the_layout_and_only_where_they_are_looked_at() -> None:
    async def session() -> None:
        model = house()
        model.wait()
        channel = Channel.of(model)
        channel.want("words:Bx", "me", True)
        channel.publish()
        assert channel.words == {}  # no answer waits for them
        while not channel.words:
            await asyncio.sleep(0.001)
        assert list(channel.words) == ["Bx"]
        before = CACHE.words.misses
        first = channel.words
        channel.publish()
        await asyncio.sleep(0)
        assert channel.words is first and CACHE.words.misses == before
        channel.want("words:Bx", "me", False)
        channel.publish()
        while channel.words:
            await asyncio.sleep(0.001)
        channel.close()

    asyncio.run(session())


def test_modes_are_drawn_from_what_the_language_makes_of_them() -> None:
    modes = {mode["sign"]: mode for mode in describe_modes()}
    assert list(modes) == ["", "~", "|", ".", ":", "@"]
    assert modes["@"]["name"] == "pivot total"
    assert modes["@"]["words"]["2"] == "E k G k' E k G k' E'"
    assert modes[""]["words"]["-1"] == "G' k' E'"
    assert {mode["words"]["0"] for mode in modes.values()} == {""}
