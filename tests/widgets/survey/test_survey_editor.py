"""A survey drawn by hand: it is a survey, can be undone, scaled by a known length, saved, opened and inferred from."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from facade_nb import DesignError, solve
from facade_nb.survey import Survey, SurveyError, compare, load_survey
from facade_nb.widgets import SurveyEditor, SurveyModel
from facade_nb.widgets.survey.model import Drawn

CORNERS = [[0.1, 0.9], [0.9, 0.8], [0.9, 0.1], [0.2, 0.1]]


def drawn(count: int = 3) -> dict[str, Any]:
    windows = [{"kind": "window", "rect": [1 + 3 * i, 1, 2 + 3 * i, 2.5]} for i in range(count)]
    return {"name": "house", "width": 10, "height": 3.5, "openings": windows, "corners": CORNERS}


def ask(editor: SurveyEditor, op: str, seq: int = 1, **more: Any) -> None:
    editor.channel._receive(editor.channel, {"op": op, "client": "c", "seq": seq, **more}, [])


def test_what_is_drawn_is_a_survey_that_can_be_undone_and_inferred_from() -> None:
    editor = SurveyEditor()
    ask(editor, "set", name="drawn", value=drawn(2))
    ask(editor, "set", 2, name="drawn", value=drawn())
    assert editor.channel.ack == {"client": "c", "seq": 2} and editor.channel.trouble == ""
    survey = editor.survey
    assert (survey.building, survey.width, survey.height, len(survey.openings)) == ("house", 10, 3.5, 3)
    design = editor.infer()
    assert design.name == "house" and compare(solve(design), survey.openings) > 0.98
    ask(editor, "undo", 3)
    assert (
        len(editor.survey.openings) == 2
        and editor.channel.can_redo
        and editor.channel.drawn["corners"] == CORNERS
    )
    editor.survey = Survey("other", 5, 4, ({"kind": "door", "rect": [1, 0, 2, 2]},))
    assert editor.channel.drawn["openings"] == [{"kind": "door", "rect": [1, 0, 2, 2]}]
    assert editor.channel.drawn["corners"] == CORNERS  # of the same photograph
    assert repr(editor) == "SurveyEditor(1 opening)" and "svg" in editor.to_html()


def test_keys_in_a_run_are_one_step() -> None:
    model = SurveyModel(Drawn.of(drawn()))
    for place in (1.01, 1.02, 1.03):
        own = drawn()
        own["openings"][0]["rect"][0] = place
        model.draw(Drawn.of(own), key="0 place 0")
    model.undo()
    assert model.drawn == Drawn.of(drawn()) and not model.can_undo


def test_a_known_length_scales_all_of_it() -> None:
    """The first window is drawn 1 m wide, and is 1.2."""
    editor = SurveyEditor(Survey("", 10, 3.5, tuple(drawn()["openings"])))
    ask(editor, "scale", axis="x", length=1.0, known=1.2)
    assert editor.survey.width == 12 and editor.survey.height == 3.5
    assert [o["rect"] for o in editor.survey.openings][1] == [4.8, 1, 6, 2.5]
    ask(editor, "scale", 2, axis="y", length=1.5, known=-1)
    assert "expected a positive number of metres" in editor.channel.trouble and editor.survey.width == 12


def test_a_file_is_read_back_by_all(tmp_path: Path) -> None:
    editor = SurveyEditor()
    ask(editor, "set", name="drawn", value=drawn())
    editor.save(tmp_path / "house.json")
    survey = load_survey("house", tmp_path / "house.json")
    assert survey == editor.survey
    other = SurveyEditor()
    ask(other, "open", text=editor.save())
    assert other.survey == survey and other.model.can_undo
    ask(other, "open", 2, text="{")
    assert "this is not JSON" in other.channel.trouble and other.survey == survey
    ask(other, "open", 3, text='{"facades": []}')
    assert "expected one façade, found 0" in other.channel.trouble


def test_a_photograph_that_python_has_is_shown_and_none_else(tmp_path: Path) -> None:
    buffer = BytesIO()
    Image.new("RGB", (40, 30), "red").save(buffer, "JPEG")
    (tmp_path / "house.jpg").write_bytes(buffer.getvalue())
    editor = SurveyEditor(photo=tmp_path / "house.jpg")
    assert editor.channel.photo == buffer.getvalue()
    for here in (True, False):
        ask(editor, "view", here=here)
    assert editor.channel.photo == b""
    with pytest.raises(DesignError, match="expected a photograph in JPEG, PNG or WebP"):
        SurveyEditor(photo=b"%PDF")
    with pytest.raises(DesignError, match=r"none\.jpg: cannot be read"):
        SurveyEditor(photo=tmp_path / "none.jpg")


def test_what_cannot_be_drawn_is_told_and_leaves_what_is() -> None:
    editor = SurveyEditor()
    ask(editor, "set", name="drawn", value=drawn())
    for change, said in (
        ({"width": -1}, "width: expected a positive number"),
        ({"height": "high"}, "height: expected metres"),
        ({"openings": [{"kind": "window", "rect": [2, 1, 1, 2]}]}, "openings[0].rect: expected left < right"),
    ):
        ask(editor, "set", 2, name="drawn", value=drawn() | change)
        assert said in editor.channel.trouble and len(editor.survey.openings) == 3
        assert editor.channel.ack["seq"] == 2
    with pytest.raises(SurveyError, match="width"):
        SurveyEditor(Survey("", 0, 0, ()))
